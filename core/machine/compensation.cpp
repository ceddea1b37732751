// SPDX-License-Identifier: Apache-2.0
#include "core/machine/compensation.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/base/units.h"
#include "core/math/scattered_interpolation.h"

namespace spindrift {
namespace {

constexpr const char* axis_names = "XYZABC";

int axisNumber(const MachineDescription& machine, const std::string& axis) {
  const std::size_t number = std::string("XYZ").find(axis);
  if (axis.size() != 1 || number == std::string::npos || machine.findAxis(axis) == nullptr) {
    throw InputError(fmt::format("axis \"{}\" is not a linear axis of {}; allowed: X, Y or Z that machine.json lists.",
                                 axis, machine.name));
  }
  return static_cast<int>(number);
}

void requireCount(int count, int most) {
  if (count < 2 || count > most) {
    throw InputError(fmt::format("{} positions are not allowed; allowed: 2 to {}.", count, most));
  }
}

/// The comment that names the displacements that were not measured; empty if all were.
std::string unmeasuredComment(const std::optional<MeasuredBox>& measured) {
  std::string names;
  for (std::size_t i = 0; measured && i < 3; ++i)
    if (!measured->displacement[i]) names += fmt::format("{}E{}", names.empty() ? "" : ", ", axis_names[i]);
  return names.empty() ? std::string() : fmt::format("# not measured, so that nothing is stated of it: {}\n", names);
}

std::string fieldOf(double value, bool known) {
  return known ? fmt::format(",{:.4f}", value) : std::string(",");
}

double positionAt(const LinearAxis& axis, int i, int count) {
  return axis.travel_mm[0] + (axis.travel_mm[1] - axis.travel_mm[0]) * i / (count - 1);
}

}  // namespace

CompensationGridOptions CompensationGridOptions::travelOf(const MachineDescription& machine) {
  CompensationGridOptions options;
  for (int i = 0; i < 3; ++i) {
    if (const LinearAxis* axis = machine.findAxis(std::string(1, axis_names[i]))) {
      options.from_mm[i] = axis->travel_mm[0];
      options.to_mm[i] = axis->travel_mm[1];
    } else {
      options.nodes[static_cast<std::size_t>(i)] = 1;
    }
  }
  return options;
}

void CompensationGridOptions::validate() const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (nodes[i] < 1 || nodes[i] > 1000) {
      throw InputError(fmt::format("{} nodes along {} are not allowed; allowed: 1 to 1000.", nodes[i], axis_names[i]));
    }
  }
}

std::vector<CompensationNode> compensationGrid(const ErrorModel& model, const CompensationGridOptions& options,
                                               const DeviationQuery& conditions) {
  options.validate();
  std::vector<CompensationNode> grid;
  DeviationQuery query = conditions;
  query.point.clear();
  const auto coordinate = [&](int axis, int i) {
    const int count = options.nodes[static_cast<std::size_t>(axis)];
    return count == 1 ? options.from_mm[axis]
                      : options.from_mm[axis] + (options.to_mm[axis] - options.from_mm[axis]) * i / (count - 1);
  };
  for (int iz = 0; iz < options.nodes[2]; ++iz) {
    for (int iy = 0; iy < options.nodes[1]; ++iy) {
      for (int ix = 0; ix < options.nodes[0]; ++ix) {
        CompensationNode node;
        node.position_mm = {coordinate(0, ix), coordinate(1, iy), coordinate(2, iz)};
        query.position_mm = node.position_mm;
        for (int i = 0; i < 3; ++i) {
          const PredictedComponent predicted = model.predict(query, static_cast<Component>(i));
          node.correction_um[i] = 0.0 - predicted.value;  // not -value: a zero must not print as -0
          node.sigma_um[i] = predicted.sigma;
        }
        grid.push_back(node);
      }
    }
  }
  return grid;
}

std::string compensationGridCsv(const std::vector<CompensationNode>& nodes,
                                const std::optional<MeasuredBox>& measured) {
  const auto known = [&](Eigen::Index i) { return !measured || measured->displacement[static_cast<std::size_t>(i)]; };
  std::string text = "# correction to add to the command = minus the predicted deviation (actual minus commanded)\n" +
                     unmeasuredComment(measured) +
                     "x_mm,y_mm,z_mm,correction_x_um,correction_y_um,correction_z_um,sigma_x_um,sigma_y_um,sigma_z_um";
  text += measured ? ",extrapolated\n" : "\n";
  for (const CompensationNode& n : nodes) {
    text += fmt::format("{},{},{}", n.position_mm.x(), n.position_mm.y(), n.position_mm.z());
    for (const Eigen::Vector3d* values : {&n.correction_um, &n.sigma_um})
      for (Eigen::Index i = 0; i < 3; ++i) text += fieldOf((*values)[i], known(i));
    if (measured) text += measured->surrounds(n.position_mm) ? ",0" : ",1";
    text += '\n';
  }
  return text;
}

bool MeasuredBox::surrounds(const Eigen::Vector3d& position_mm) const {
  if (places_mm.empty()) return contains(position_mm);
  return (nearestInHull(places_mm, position_mm) - position_mm).norm() <= least_extent_mm;
}

AxisComponentTable axisComponents(const ErrorModel& model, const MachineDescription& machine, const std::string& axis,
                                  const Eigen::Vector3d& reference_mm, int count, const DeviationQuery& conditions) {
  axisNumber(machine, axis);
  requireCount(count, 10000);
  const LinearAxis& description = *machine.findAxis(axis);
  std::vector<double> positions;
  for (int i = 0; i < count; ++i) positions.push_back(positionAt(description, i, count));
  return axisComponentsAt(model, machine, axis, reference_mm, positions, conditions);
}

AxisComponentTable axisComponentsAt(const ErrorModel& model, const MachineDescription& machine, const std::string& axis,
                                    const Eigen::Vector3d& reference_mm, const std::vector<double>& position_mm,
                                    const DeviationQuery& conditions) {
  const int number = axisNumber(machine, axis);
  const LinearAxis& description = *machine.findAxis(axis);
  AxisComponentTable table;
  table.axis = axis;
  table.reference_mm = reference_mm;
  DeviationQuery query = conditions;
  query.point.clear();
  query.position_mm = reference_mm;
  const DeviationQuery reference = query;
  for (const double position : position_mm) {
    query.position_mm[number] = std::clamp(position, description.travel_mm[0], description.travel_mm[1]);
    std::array<double, 6> deviation{};
    std::array<double, 6> sigma{};
    for (const Component c : all_components) {
      const PredictedComponent change = model.predictChange(query, reference, c);
      deviation[static_cast<std::size_t>(c)] = change.value;
      sigma[static_cast<std::size_t>(c)] = change.sigma;
    }
    table.position_mm.push_back(position);
    table.deviation.push_back(deviation);
    table.sigma.push_back(sigma);
  }
  // A control goes straight from position to position: one beyond the travel has what makes it right at its end.
  const std::size_t count = position_mm.size();
  const auto extend = [&](std::size_t outer, std::size_t inner, double end_mm) {
    const double reach = end_mm - position_mm[inner];
    if (reach == 0.0) return;
    const double further = (position_mm[outer] - position_mm[inner]) / reach;
    for (std::size_t i = 0; i < 6; ++i)
      table.deviation[outer][i] =
          table.deviation[inner][i] + further * (table.deviation[outer][i] - table.deviation[inner][i]);
  };
  if (count < 2) return table;
  if (position_mm.front() < description.travel_mm[0]) extend(0, 1, description.travel_mm[0]);
  if (position_mm.back() > description.travel_mm[1]) extend(count - 1, count - 2, description.travel_mm[1]);
  return table;
}

std::array<bool, 6> knownErrors(const AxisComponentTable& table, const std::optional<MeasuredBox>& measured) {
  const auto axis = static_cast<int>(std::string_view("XYZ").find(table.axis));
  const auto somewhere = [](const std::vector<std::array<double, 6>>& rows, std::size_t i) {
    return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return row[i] != 0.0; });
  };
  std::array<bool, 6> known{};
  for (std::size_t i = 0; i < 6; ++i) {
    known[i] = !measured || (measured->extendsAlong(axis) && (i >= 3 || measured->displacement[i]) &&
                             (somewhere(table.deviation, i) || somewhere(table.sigma, i)));
  }
  return known;
}

std::string axisComponentsCsv(const AxisComponentTable& table, const std::optional<MeasuredBox>& measured) {
  const auto axis = static_cast<Eigen::Index>(std::string_view("XYZ").find(table.axis));
  SPINDRIFT_ASSERT(axis >= 0 && axis < 3, "a table of X, Y or Z");
  const bool along = !measured || measured->extendsAlong(static_cast<int>(axis));
  const std::array<bool, 6> known = knownErrors(table, measured);
  std::string header = "position_mm";
  std::string sigma_header;
  std::string unknown;
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string error = fmt::format("E{}{}", axis_names[i], table.axis);
    const std::string name = fmt::format("{}_{}", error, i < 3 ? "um" : "urad");
    header += "," + name;
    sigma_header += ",sigma_" + name;
    if (along && !known[i] && (i >= 3 || measured->displacement[i]))
      unknown += fmt::format("{}{}", unknown.empty() ? "" : ", ", error);
  }
  std::string text = fmt::format(
      "# ISO 230-1 component errors of {}: deviation = actual minus commanded, relative to that at "
      "the reference position; sigma is the standard uncertainty of this difference\n",
      table.axis);
  if (!along) {
    text += fmt::format("# nothing was measured along {} (all points lie at {:.4g} mm): no error of it is stated\n",
                        table.axis, measured->low_mm[axis]);
  } else {
    text += unmeasuredComment(measured);
    if (!unknown.empty()) text += fmt::format("# not in the model, so that nothing is stated of it: {}\n", unknown);
  }
  text += header + sigma_header + (measured ? ",extrapolated\n" : "\n");
  for (std::size_t row = 0; row < table.position_mm.size(); ++row) {
    text += fmt::format("{}", table.position_mm[row]);
    for (const auto* values : {&table.deviation[row], &table.sigma[row]})
      for (std::size_t i = 0; i < 6; ++i) text += fieldOf((*values)[i], known[i]);
    if (measured) {
      Eigen::Vector3d position = table.reference_mm;
      position[axis] = table.position_mm[row];
      text += measured->contains(position) ? ",0" : ",1";
    }
    text += '\n';
  }
  return text;
}

std::string linuxcncCompensation(const ErrorModel& model, const MachineDescription& machine, const std::string& axis,
                                 const Eigen::Vector3d& reference_mm, int count, const DeviationQuery& conditions,
                                 LinuxcncTable table) {
  const int number = axisNumber(machine, axis);
  requireCount(count, 256);
  const LinearAxis& description = *machine.findAxis(axis);
  const auto component = static_cast<Component>(number);
  DeviationQuery query = conditions;
  query.point.clear();
  query.position_mm = reference_mm;
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double nominal = positionAt(description, i, count);
    query.position_mm[number] = nominal;
    std::array<double, 2> actual{};
    for (std::size_t direction = 0; direction < 2; ++direction) {
      query.approach = Eigen::Vector3d::Zero();
      query.approach[number] = direction == 0 ? 1.0 : -1.0;
      const double deviation_mm = model.predict(query, component).value * mm_per_um;
      actual[direction] = table == LinuxcncTable::Trim ? -deviation_mm : nominal + deviation_mm;
    }
    text += fmt::format("{:.6f} {:.6f} {:.6f}\n", nominal, actual[0], actual[1]);
  }
  return text;
}

std::string MeasuredBox::extentAlong(int axis) const {
  return fmt::format("measured from {:g} to {:g} mm; beyond that extrapolated", low_mm[axis], high_mm[axis]);
}

std::string siemensCompensation(const ErrorModel& model, const MachineDescription& machine, const std::string& axis,
                                const Eigen::Vector3d& reference_mm, int count, const DeviationQuery& conditions,
                                const std::optional<MeasuredBox>& measured) {
  const int number = axisNumber(machine, axis);
  requireCount(count, 5000);
  const LinearAxis& description = *machine.findAxis(axis);
  const auto component = static_cast<Component>(number);
  DeviationQuery query = conditions;
  query.point.clear();
  query.position_mm = reference_mm;
  const auto deviation_mm = [&](double position_mm) {
    query.position_mm[number] = position_mm;
    double sum = 0.0;
    for (const double direction : {1.0, -1.0}) {
      query.approach = Eigen::Vector3d::Zero();
      query.approach[number] = direction;
      sum += 0.5 * model.predict(query, component).value;
    }
    return sum * mm_per_um;
  };
  const double reference = deviation_mm(reference_mm[number]);
  const double first = positionAt(description, 0, count);
  const double last = positionAt(description, count - 1, count);
  const std::string name = axis + "1";
  std::string text = fmt::format(
      "%_N_{}_EEC_INI\n"
      "; value = deviation (actual minus commanded) in mm, zero at {:g} mm: a positive value moves the axis in the\n"
      "; negative direction. {} is the name of the machine axis. MD38000 must be at least {}; active with MD32700 = "
      "1.\n"
      "{}CHANDATA(1)\n",
      name, reference_mm[number], name, count,
      measured ? fmt::format("; {} {}\n", axis, measured->extentAlong(number)) : "");
  for (int i = 0; i < count; ++i) {
    const double value = deviation_mm(positionAt(description, i, count)) - reference;
    text += fmt::format("$AA_ENC_COMP[0,{},{}]={:.6f}\n", i, name, std::abs(value) < 5e-7 ? 0.0 : value);
  }
  text += fmt::format(
      "$AA_ENC_COMP_STEP[0,{0}]={1:.6f}\n$AA_ENC_COMP_MIN[0,{0}]={2:.6f}\n$AA_ENC_COMP_MAX[0,{0}]={3:.6f}\n"
      "$AA_ENC_COMP_IS_MODULO[0,{0}]=0\nM17\n",
      name, (last - first) / (count - 1), first, last);
  return text;
}

}  // namespace spindrift
