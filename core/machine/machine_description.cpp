// SPDX-License-Identifier: Apache-2.0
#include "core/machine/machine_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/text.h"
#include "core/machine/artefact_ranges.h"

namespace spindrift {
namespace {

std::optional<double> optionalNumber(const JsonNode& node, std::string_view key) {
  const auto found = node.find(key);
  return found ? std::optional(found->number()) : std::nullopt;
}

std::optional<double> optionalPositive(const JsonNode& node, std::string_view key) {
  const auto found = node.find(key);
  return found ? std::optional(found->positiveNumber()) : std::nullopt;
}

void requireNew(std::set<std::string>& seen, const JsonNode& id) {
  if (!seen.insert(id.string()).second) id.reject("a name that was not used before in this list");
}

template <typename Item, typename Parse>
std::vector<Item> parseList(const JsonNode& root, std::string_view key, std::string_view id_key, Parse parse) {
  std::vector<Item> list;
  std::set<std::string> seen;
  if (const auto node = root.find(key)) {
    for (const JsonNode& item : node->items()) {
      list.push_back(parse(item));
      requireNew(seen, item.at(id_key));
    }
  }
  return list;
}

LinearAxis parseAxis(const JsonNode& node) {
  LinearAxis axis;
  axis.name = node.at("name").name();
  const JsonNode travel = node.at("travel_mm");
  const std::vector<double> ends = travel.numbers();
  if (ends.size() != 2 || !(ends[0] < ends[1])) travel.reject("two numbers, the smaller first");
  axis.travel_mm = {ends[0], ends[1]};
  axis.resolution_um = optionalPositive(node, "resolution_um");
  if (const auto drive = node.find("drive")) {
    axis.drive_type = drive->stringOr("type", "");
    axis.pitch_mm = optionalPositive(*drive, "pitch_mm");
    axis.fixed_bearing_mm = optionalNumber(*drive, "fixed_bearing_mm");
  }
  if (const auto scale = node.find("scale")) axis.scale = scale->oneOf({"rotary_encoder", "linear_scale"});
  axis.datum_mm = optionalNumber(node, "datum_mm");
  return axis;
}

Artefact parseArtefact(const JsonNode& node) {
  Artefact artefact;
  artefact.id = node.at("id").name();
  artefact.kind = node.at("kind").oneOf({"hole_bar", "balls"});
  if (artefact.kind == "hole_bar") {
    artefact.nominal_positions_mm = node.at("nominal_positions_mm").numbers();
    if (artefact.nominal_positions_mm.empty()) node.at("nominal_positions_mm").reject("at least one position");
    artefact.reference_hole = node.stringOr("reference_hole", "H1");
    artefact.reference_in_table_mm = node.at("reference_in_table_mm").vector3();
    if (const auto direction = node.find("direction_at_c0")) {
      const Eigen::Vector3d v = direction->vector3();
      if (std::abs(v.norm() - 1.0) > 1e-3) direction->reject("a vector of length 1");
      artefact.direction_at_c0 = v.normalized();
    }
    artefact.hole_diameter_mm = optionalPositive(node, "hole_diameter_mm");
    bool known = false;
    for (std::size_t i = 0; i < artefact.nominal_positions_mm.size(); ++i) {
      known = known || artefact.reference_hole == fmt::format("H{}", i + 1);
    }
    if (!known) {
      node.at("reference_hole").reject(fmt::format("H1 to H{}", artefact.nominal_positions_mm.size()));
    }
  } else {
    artefact.balls = parseList<ArtefactBall>(node, "balls", "id", [](const JsonNode& ball) {
      return ArtefactBall{ball.at("id").name(), ball.at("diameter_mm").positiveNumber(),
                          ball.at("certified_mm").vector3()};
    });
    if (artefact.balls.empty()) node.reject("an artefact with at least one ball under \"balls\"");
  }
  const auto within = [&](const char* key, const std::array<double, 2>& range) {
    const std::optional<double> value = optionalNumber(node, key);
    if (value && !(*value >= range[0] && *value <= range[1]))
      node.at(key).reject(fmt::format("a number from {:g} to {:g}", range[0], range[1]));
    return value;
  };
  artefact.expansion_um_per_m_K = within("expansion_um_per_m_K", artefact_expansion_range_um_per_m_K);
  if (const auto& given = artefact.expansion_um_per_m_K;
      given && *given != 0.0 && std::abs(*given) < least_artefact_expansion_um_per_m_K) {
    node.at("expansion_um_per_m_K")
        .reject(fmt::format("0, or a size of at least {:g}: µm/(m·K), where steel has 11.5, not 1/K",
                            least_artefact_expansion_um_per_m_K));
  }
  artefact.temperature_degC = within("temperature_degC", artefact_temperature_range_degC);
  if (const auto u = node.find("certificate_uncertainty_um")) {
    artefact.certificate_uncertainty_um = u->nonNegativeNumber();
  }
  return artefact;
}

ProfilerDescription parseProfiler(const JsonNode& node) {
  ProfilerDescription profiler;
  if (const auto model = node.find("scan_model")) profiler.scan_model = model->oneOf({"rigid", "push_broom"});
  profiler.axis = node.stringOr("axis", "Y");
  profiler.lift_mm = node.numberOr("lift_mm", 0.0);
  if (const auto lever = node.find("lever_mm")) profiler.lever_mm = lever->vector3();
  if (const auto count = node.find("profile_points")) {
    profiler.profile_points = count->integer();
    if (*profiler.profile_points < 2) count->reject("at least 2");
  }
  profiler.profile_interval_mm = optionalPositive(node, "profile_interval_mm");
  profiler.calibration_cloud = node.stringOr("calibration_cloud", "");
  if (const auto circle = node.find("calibration_circle")) {
    const std::vector<double> c = circle->numbers();
    if (c.size() != 4 || !(c[3] > 0.0)) circle->reject("four numbers x, y, z, r with r > 0");
    profiler.calibration_circle_mm = {c[0], c[1], c[2], c[3]};
  }
  return profiler;
}

template <typename List>
auto findById(const List& list, std::string_view id, std::string List::value_type::*member) noexcept -> const
    typename List::value_type* {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.*member == id; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

MachineDescription MachineDescription::read(const std::filesystem::path& file) {
  return parse(JsonNode::read(file), file);
}

MachineDescription MachineDescription::parse(const JsonNode& root, const std::filesystem::path& file) {
  root.requireFormat("spindrift-machine", 1);
  MachineDescription machine;
  machine.file = file;
  machine.source = root.value();
  machine.name = root.at("name").name();
  const JsonNode chain = root.at("chain");
  machine.chain = KinematicChain::parse(chain.string(), chain.place());
  machine.axes = parseList<LinearAxis>(root, "axes", "name", parseAxis);
  if (machine.axes.empty()) root.at("axes").reject("a list with at least one axis");
  if (const auto spindle = root.find("spindle")) {
    Spindle parsed;
    parsed.axis = spindle->stringOr("axis", "Z");
    parsed.max_rpm = optionalPositive(*spindle, "max_rpm");
    if (const auto nose = spindle->find("nose_offset_mm")) parsed.nose_offset_mm = nose->vector3();
    machine.spindle = parsed;
  }
  machine.rotary = parseList<RotaryAxis>(root, "rotary", "name", [](const JsonNode& node) {
    return RotaryAxis{node.at("name").name(), node.at("centre_mm").vector3()};
  });
  machine.temperature_sensors =
      parseList<TemperatureSensor>(root, "temperature_sensors", "name", [](const JsonNode& node) {
        TemperatureSensor sensor{node.at("name").name(), node.stringOr("place", "")};
        if (const auto role = node.find("role")) {
          const std::string text = role->name();
          sensor.role = sensorRoleFromString(text);
          if (!sensor.role) sensor.role = readSensorRole(text);
          if (!sensor.role) sensor.unread_role = text;
        }
        return sensor;
      });
  machine.points = parseList<MachinePoint>(root, "points", "id", [](const JsonNode& node) {
    return MachinePoint{
        node.at("id").name(), node.stringOr("kind", "fiducial"),
        Eigen::Vector3d(node.at("x_mm").number(), node.at("y_mm").number(), node.numberOr("z_mm", 0.0))};
  });
  machine.artefacts = parseList<Artefact>(root, "artefacts", "id", parseArtefact);
  machine.styli = parseList<Stylus>(root, "styli", "id", [](const JsonNode& node) {
    return Stylus{node.at("id").name(), node.at("radius_mm").positiveNumber(), node.at("offset_mm").vector3()};
  });
  if (const auto profiler = root.find("profiler")) machine.profiler = parseProfiler(*profiler);
  if (const auto table = root.find("table")) {
    if (const auto centre = table->find("centre_mm")) {
      const std::vector<double> c = centre->numbers();
      if (c.size() != 2) centre->reject("two numbers x, y");
      machine.table_centre_mm = Eigen::Vector2d(c[0], c[1]);
    }
  }
  if (const auto column = root.find("column")) {
    machine.column_base_mm = optionalNumber(*column, "base_mm");
    if (const auto overhang = column->find("overhang_mm")) {
      const std::vector<double> r = overhang->numbers();
      if (r.size() != 2 && r.size() != 3) overhang->reject("two numbers x, y (and z): spindle minus column");
      machine.column_overhang_mm = Eigen::Vector2d(r[0], r[1]);
    }
  }
  if (const auto beam = root.find("crossbeam")) {
    Crossbeam parsed;
    parsed.axis = beam->stringOr("axis", "Y");
    parsed.from_mm = beam->at("from_mm").number();
    parsed.to_mm = beam->at("to_mm").number();
    if (parsed.from_mm == parsed.to_mm) beam->reject("a beam whose ends from_mm and to_mm differ");
    machine.crossbeam = parsed;
  }
  machine.reference_temperature_degC = root.numberOr("reference_temperature_degC", 20.0);
  const auto [least_degC, most_degC] = reference_temperature_range_degC;
  if (machine.reference_temperature_degC < least_degC || machine.reference_temperature_degC > most_degC)
    root.at("reference_temperature_degC").reject(fmt::format("a number from {:g} to {:g}", least_degC, most_degC));
  return machine;
}

const LinearAxis* MachineDescription::findAxis(std::string_view id) const noexcept {
  return findById(axes, id, &LinearAxis::name);
}
const RotaryAxis* MachineDescription::findRotary(std::string_view id) const noexcept {
  return findById(rotary, id, &RotaryAxis::name);
}
const MachinePoint* MachineDescription::findPoint(std::string_view id) const noexcept {
  return findById(points, id, &MachinePoint::id);
}
const Artefact* MachineDescription::findArtefact(std::string_view id) const noexcept {
  return findById(artefacts, id, &Artefact::id);
}
const Stylus* MachineDescription::findStylus(std::string_view id) const noexcept {
  return findById(styli, id, &Stylus::id);
}

}  // namespace spindrift
