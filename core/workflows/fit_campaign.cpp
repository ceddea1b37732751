// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/fit_campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/machine/parameter_meanings.h"

namespace spindrift {
namespace {

nlohmann::json parameterJson(double value, double sigma, bool determined) {
  if (!determined) return {{"value", nullptr}, {"standard_uncertainty", nullptr}};
  return {{"value", jsonNumber(value)}, {"standard_uncertainty", jsonNumber(sigma)}};
}

std::vector<std::string> namesOf(const std::vector<int>& parameters) {
  std::vector<std::string> names;
  for (const int i : parameters) names.emplace_back(nine_parameter_names[static_cast<std::size_t>(i)]);
  return names;
}

ErrorParameter parameterOf(int i) {
  return describedParameter(nine_parameter_names[static_cast<std::size_t>(i)]);
}

}  // namespace

nlohmann::json toJson(const NineParameterFit& fit) {
  nlohmann::json parameters = nlohmann::json::object();
  nlohmann::json covariance = nlohmann::json::array();
  for (int i = 0; i < nine_parameter_count; ++i) {
    parameters[std::string(nine_parameter_names[static_cast<std::size_t>(i)])] =
        parameterJson(fit.parameters(i), fit.standardUncertainty(i), fit.determined(i));
    nlohmann::json row = nlohmann::json::array();
    for (int j = 0; j < nine_parameter_count; ++j) {
      row.push_back(fit.determined(i) && fit.determined(j) ? jsonNumber(fit.covariance(i, j)) : nlohmann::json());
    }
    covariance.push_back(row);
  }
  nlohmann::json residuals = nlohmann::json::array();
  for (const NineParameterResidual& r : fit.residuals) {
    residuals.push_back({{"point", r.point},
                         {"component", toString(r.component)},
                         {"residual_um", jsonNumber(r.residual_um)},
                         {"used", r.used},
                         {"measured_um", jsonNumber(r.value_um)},
                         {"sigma_um", jsonNumber(r.sigma_um)},
                         {"weight", r.weight}});
  }
  nlohmann::json out;
  out["model"] = "nine-parameter";
  out["status"] = toString(fit.status);
  out["message"] = fit.message;
  out["state"] = fit.state;
  out["reference_state"] = fit.reference_state.empty() ? nlohmann::json() : nlohmann::json(fit.reference_state);
  out["parameters"] = parameters;
  out["parameter_order"] = nine_parameter_names;
  out["covariance"] = covariance;
  out["undetermined"] = namesOf(fit.undetermined);
  out["residuals"] = residuals;
  out["rms_fit_um"] = jsonNumber(fit.rms_fit_um);
  out["rms_validation_um"] = jsonNumber(fit.rms_validation_um);
  out["condition_number"] = jsonNumber(fit.condition_number);
  out["chi2"] = jsonNumber(fit.chi2);
  out["degrees_of_freedom"] = fit.degrees_of_freedom;
  out["p_value"] = jsonNumber(fit.p_value);
  for (const Component c : {Component::EX, Component::EY, Component::EZ})
    out["lack_of_fit_um"][std::string(toString(c))] =
        fit.status == FitStatus::Rejected ? nlohmann::json() : jsonNumber(fit.lack_of_fit_um[static_cast<int>(c)]);
  out["warnings"] = fit.warnings;
  return out;
}

std::string summaryOf(const NineParameterFit& fit) {
  std::string text =
      fit.reference_state.empty()
          ? fmt::format("nine-parameter model of state {}\n", fit.state)
          : fmt::format("nine-parameter model of the change from state {} to {}\n", fit.reference_state, fit.state);
  for (int i = 0; i < nine_parameter_count; ++i) {
    const ErrorParameter parameter = parameterOf(i);
    text +=
        fmt::format("  {:<10} {:<18} {}\n", parameter.symbolWithIso(),
                    fit.determined(i) ? withUncertainty(fit.parameters(i), fit.standardUncertainty(i), parameter.unit)
                                      : "not determined",
                    parameter.meaning);
  }
  if (fit.rms_fit_um) text += fmt::format("rms of the fitted points {:.2f} µm\n", *fit.rms_fit_um);
  if (fit.rms_validation_um) text += fmt::format("rms of the validation points {:.2f} µm\n", *fit.rms_validation_um);
  if (std::isfinite(fit.condition_number)) text += fmt::format("condition number {:.1f}\n", fit.condition_number);
  if (fit.status != FitStatus::Converged) text += fmt::format("{}: {}\n", toString(fit.status), fit.message);
  for (const std::string& warning : fit.warnings) text += fmt::format("note: {}\n", warning);
  return text;
}

nlohmann::json toJson(const NineParameterFit& fit, const TableOrderChoice& choice) {
  nlohmann::json out = toJson(fit);
  out["higher_order"] = choice.json();
  return out;
}

std::string summaryOf(const NineParameterFit& fit, const TableOrderChoice& choice) {
  std::string text = summaryOf(fit);
  if (choice.status != FitStatus::Converged) return text;
  text += fmt::format("higher order: {}\n", choice.reason);
  if (!choice.richer()) return text;
  const std::vector<std::string> names = choice.model->basis().names();
  for (std::size_t i = nine_parameter_count; i < names.size(); ++i) {
    const auto e = static_cast<Eigen::Index>(i);
    text +=
        fmt::format("  {:<10} {}\n", names[i].substr(0, names[i].size() - 3),
                    withUncertainty(choice.model->parameters()(e), std::sqrt(choice.model->covariance()(e, e)), "um"));
  }
  return text;
}

nlohmann::json toJson(const NineParameterComparison& comparison) {
  nlohmann::json differences = nlohmann::json::object();
  for (int i = 0; i < nine_parameter_count; ++i) {
    const bool determined = std::isfinite(comparison.covariance(i, i));
    nlohmann::json entry = parameterJson(comparison.difference(i), std::sqrt(comparison.covariance(i, i)), determined);
    entry["p_value"] = determined ? jsonNumber(comparison.p_value[static_cast<std::size_t>(i)]) : nlohmann::json();
    differences[std::string(nine_parameter_names[static_cast<std::size_t>(i)])] = entry;
  }
  return {{"a", toJson(comparison.a)},
          {"b", toJson(comparison.b)},
          {"differences", differences},
          {"significant", namesOf(comparison.significant)},
          {"chi2", jsonNumber(comparison.chi2)},
          {"degrees_of_freedom", comparison.degrees_of_freedom},
          {"p_value", jsonNumber(comparison.p_value_all)}};
}

std::string summaryOf(const NineParameterComparison& comparison) {
  std::string text = fmt::format("difference of the models, second minus first, state {}\n", comparison.a.state);
  for (int i = 0; i < nine_parameter_count; ++i) {
    const double sigma = std::sqrt(comparison.covariance(i, i));
    const bool differs =
        std::find(comparison.significant.begin(), comparison.significant.end(), i) != comparison.significant.end();
    std::string value = "not determined";
    if (std::isfinite(sigma)) {
      // Parameters that rest on the same points in both sets are equal but for rounding.
      const bool equal = !(sigma > 1e-6 * comparison.a.standardUncertainty(i));
      value = equal ? "equal" : withUncertainty(comparison.difference(i), sigma, parameterOf(i).unit);
    }
    text += fmt::format("  {:<10} {:<18} {}{}\n", parameterOf(i).symbolWithIso(), value, parameterOf(i).meaning,
                        differs ? ": differs" : "");
  }
  if (std::isnan(comparison.p_value_all)) return text;
  text += fmt::format("all together: {}; {}\n", pValueText(comparison.p_value_all),
                      comparison.p_value_all < 0.05 ? "the sets of points disagree beyond their uncertainty"
                                                    : "the sets of points agree within their uncertainty");
  return text;
}

void HeatmapOptions::validate() const {
  if (nx < 2 || ny < 2 || nx > 2000 || ny > 2000) {
    throw InputError(fmt::format("a grid of {} x {} nodes is not possible; allowed: 2 to 2000 a side.", nx, ny));
  }
}

FieldGrid tableGrid(const MachineDescription& machine, int nx, int ny, double z_mm) {
  const LinearAxis* x = machine.findAxis("X");
  const LinearAxis* y = machine.findAxis("Y");
  if (x == nullptr || y == nullptr) {
    throw InputError({machine.file, "$.axes"}, "has no X or no Y axis; a heat map needs the travel of both.");
  }
  return {x->travel_mm[0], x->travel_mm[1], y->travel_mm[0], y->travel_mm[1], z_mm, nx, ny};
}

std::optional<FieldGrid> mapTable(const MachineDescription& machine, double z_mm, int nodes) {
  if (machine.findAxis("X") == nullptr || machine.findAxis("Y") == nullptr) return std::nullopt;
  FieldGrid grid = tableGrid(machine, nodes, nodes, z_mm);
  const double x = grid.x_to_mm - grid.x_from_mm, y = grid.y_to_mm - grid.y_from_mm;
  grid.nx = std::max(2, static_cast<int>(std::lround(nodes * x / std::max(x, y))));
  grid.ny = std::max(2, static_cast<int>(std::lround(nodes * y / std::max(x, y))));
  return grid;
}

Field tableField(const NineParameterFit& fit, const ErrorModel& model, const FieldGrid& grid, Component component) {
  std::vector<Eigen::Vector2d> measured;
  for (const NineParameterResidual& r : fit.residuals) {
    if (r.used) measured.emplace_back(r.position_mm.head<2>());
  }
  DeviationQuery conditions;
  conditions.state = fit.state;
  Field field = evaluateField(model, grid, component, conditions, measured);
  for (const NineParameterResidual& r : fit.residuals) {
    if (r.component == component) field.markers.push_back({r.point, r.position_mm, r.value_um, r.sigma_um, r.used});
  }
  return field;
}

nlohmann::json HeatmapResult::json() const {
  nlohmann::json out;
  out["status"] = toString(fit.status);
  out["message"] = message;
  out["fit"] = order ? toJson(fit, *order) : toJson(fit);
  out["model"] = order ? "higher-order" : "nine-parameter";
  if (!determined) return out;
  out["component"] = toString(field.component);
  out["unit"] = unitOf(field.component);
  out["grid"] = {{"nx", field.grid.nx},
                 {"ny", field.grid.ny},
                 {"x_mm", {field.grid.x_from_mm, field.grid.x_to_mm}},
                 {"y_mm", {field.grid.y_from_mm, field.grid.y_to_mm}},
                 {"z_mm", field.grid.z_mm}};
  const auto [low, high] = std::minmax_element(field.value.begin(), field.value.end());
  out["smallest"] = jsonNumber(*low);
  out["largest"] = jsonNumber(*high);
  nlohmann::json markers = nlohmann::json::array();
  for (const Field::Marker& m : field.markers) {
    markers.push_back({{"point", m.point},
                       {"x_mm", m.position_mm.x()},
                       {"y_mm", m.position_mm.y()},
                       {"value", jsonNumber(m.value)},
                       {"sigma", jsonNumber(m.sigma)},
                       {"used", m.used}});
  }
  out["points"] = markers;
  return out;
}

std::string HeatmapResult::title() const {
  return fmt::format("{} of state {}", toString(field.component), fit.state);
}

std::string HeatmapResult::subtitle() const {
  std::vector<std::string> points;
  for (const NineParameterResidual& r : fit.residuals) {
    if (r.used && std::find(points.begin(), points.end(), r.point) == points.end()) points.push_back(r.point);
  }
  constexpr std::size_t most_named = 8;
  const std::string from = points.size() <= most_named ? joinedList(points) : fmt::format("{} points", points.size());
  return fit.reference_state.empty()
             ? fmt::format("nine-parameter model from {}", from)
             : fmt::format("change from state {}; nine-parameter model from {}", fit.reference_state, from);
}

HeatmapResult heatmapOf(const Campaign& campaign, const ObservationSet& observations, const HeatmapOptions& options) {
  options.validate();
  HeatmapResult result;
  result.fit = fitNineParameters(observations, options.fit);
  result.message = result.fit.message;
  if (result.fit.status == FitStatus::Rejected) {
    result.determined = false;
    return result;
  }
  double z = 0.0;
  double count = 0.0;
  for (const NineParameterResidual& r : result.fit.residuals) {
    if (!r.used) continue;
    z += r.position_mm.z();
    count += 1.0;
  }
  const FieldGrid grid = tableGrid(campaign.machine, options.nx, options.ny, z / count);
  if (options.higher_order) {
    result.order = chooseTableOrder(result.fit);
    if (result.order->status != FitStatus::Converged) {
      result.determined = false;
      result.message =
          fmt::format("{} has no model of higher order: {}", toString(options.component), result.order->reason);
      return result;
    }
  }
  result.field = options.higher_order ? tableField(result.fit, *result.order->model, grid, options.component)
                                      : tableField(result.fit, result.fit.predictingModel(), grid, options.component);
  result.determined =
      std::all_of(result.field.sigma.begin(), result.field.sigma.end(), [](double s) { return std::isfinite(s); });
  if (!result.determined) {
    result.message = fmt::format("{} cannot be mapped: {}.", toString(options.component), result.fit.message);
  }
  return result;
}

nlohmann::json PlacementAnswer::json() const {
  nlohmann::json positions = nlohmann::json::array();
  for (const std::size_t i : result.chosen) {
    positions.push_back({{"id", ids[i]}, {"x_mm", candidates_mm[i].x()}, {"y_mm", candidates_mm[i].y()}});
  }
  nlohmann::json out{{"status", toString(result.status)},
                     {"message", result.message},
                     {"candidates", ids.size()},
                     {"exhaustive", result.exhaustive},
                     {"least_distance_mm", jsonNumber(result.least_distance_mm)},
                     {"positions", positions}};
  if (result.status != FitStatus::Converged) return out;
  out["log_det"] = jsonNumber(result.log_det);
  out["mean_sigma_um"] = jsonNumber(result.mean_sigma_um);
  out["largest_sigma_um"] = jsonNumber(result.largest_sigma_um);
  nlohmann::json sigma = nlohmann::json::object();
  for (int i = 0; i < nine_parameter_count; ++i) {
    sigma[std::string(nine_parameter_names[static_cast<std::size_t>(i)])] = jsonNumber(result.parameter_sigma(i));
  }
  out["parameter_sigma"] = sigma;
  return out;
}

std::string PlacementAnswer::summary() const {
  if (result.status != FitStatus::Converged) return result.message + "\n";
  std::string text = fmt::format("{} of {} positions{}, at least {:.3g} mm apart\n", result.chosen.size(), ids.size(),
                                 result.exhaustive ? ", all choices tried" : ", by exchange", result.least_distance_mm);
  for (const std::size_t i : result.chosen) {
    text += fmt::format("  {:<8}x {:8.1f} mm   y {:8.1f} mm\n", ids[i], printed(candidates_mm[i].x()),
                        printed(candidates_mm[i].y()));
  }
  text += fmt::format("uncertainty of the prediction over the table: mean {:.2f} µm, largest {:.2f} µm\n",
                      result.mean_sigma_um, result.largest_sigma_um);
  return text;
}

PlacementAnswer placeFiducials(const MachineDescription& machine, PlacementRequest request, const JobContext& job) {
  PlacementAnswer answer;
  const FieldGrid table = tableGrid(machine, 2, 2, 0.0);
  request.options.region_from_mm = {table.x_from_mm, table.y_from_mm};
  request.options.region_to_mm = {table.x_to_mm, table.y_to_mm};
  for (const MachinePoint& point : machine.points) {
    const bool fixed = std::find(request.fixed.begin(), request.fixed.end(), point.id) != request.fixed.end();
    if (request.lattice_nx > 0 && !fixed) continue;
    if (point.kind != "fiducial" && !fixed) continue;
    answer.ids.push_back(point.id);
    answer.candidates_mm.push_back(point.position_mm);
  }
  for (const std::string& id : request.fixed) {
    const auto found = std::find(answer.ids.begin(), answer.ids.end(), id);
    if (found == answer.ids.end()) {
      throw InputError({machine.file, "$.points"}, fmt::format("has no point \"{}\" that could be kept.", id));
    }
    request.options.fixed.push_back(static_cast<std::size_t>(found - answer.ids.begin()));
  }
  if (request.lattice_nx > 0) {
    if (request.lattice_nx < 2 || request.lattice_ny < 2 || request.lattice_nx > 100 || request.lattice_ny > 100) {
      throw InputError("a lattice needs 2 to 100 positions a side.");
    }
    const double width = table.x_to_mm - table.x_from_mm - 2.0 * request.margin_mm;
    const double depth = table.y_to_mm - table.y_from_mm - 2.0 * request.margin_mm;
    if (!(request.margin_mm >= 0.0) || !(width > 0.0) || !(depth > 0.0)) {
      throw InputError(fmt::format("a margin of {} mm leaves nothing of the table.", request.margin_mm));
    }
    for (int iy = 0; iy < request.lattice_ny; ++iy) {
      for (int ix = 0; ix < request.lattice_nx; ++ix) {
        answer.ids.push_back(fmt::format("{},{}", ix + 1, iy + 1));
        answer.candidates_mm.emplace_back(table.x_from_mm + request.margin_mm + width * ix / (request.lattice_nx - 1),
                                          table.y_from_mm + request.margin_mm + depth * iy / (request.lattice_ny - 1),
                                          0.0);
      }
    }
  }
  if (answer.ids.empty()) {
    throw InputError({machine.file, "$.points"}, "has no fiducials to choose from; give a lattice instead.");
  }
  answer.result = chooseMeasuringPoints(answer.candidates_mm, request.options, job);
  return answer;
}

}  // namespace spindrift
