// SPDX-License-Identifier: Apache-2.0
// What became of a simulation, as JSON and in words.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/discrepancy/into_simulation.h"

namespace spindrift {

using Eigen::Index;

nlohmann::json SimulationUpdate::json() const {
  nlohmann::json fitted = nlohmann::json::object();
  nlohmann::json names = nlohmann::json::array();
  for (const FittedSimulatorParameter& p : parameters) {
    names.push_back(p.parameter.name);
    fitted[p.parameter.name] = {{"value", jsonNumber(p.value)},
                                {"standard_uncertainty", jsonNumber(p.standard_uncertainty)},
                                {"before", jsonNumber(p.parameter.value)},
                                {"standard_uncertainty_before", jsonNumber(p.parameter.standard_uncertainty)},
                                {"unit", p.parameter.unit},
                                {"what", p.parameter.what},
                                {"put_in", p.put_in},
                                {"at_bound", p.at_bound},
                                {"no_influence", p.no_influence}};
  }
  nlohmann::json matrix = nlohmann::json::array();
  for (Index i = 0; i < correlation.rows(); ++i) {
    nlohmann::json row = nlohmann::json::array();
    for (Index j = 0; j < correlation.cols(); ++j) row.push_back(jsonNumber(correlation(i, j)));
    matrix.push_back(std::move(row));
  }
  nlohmann::json places = nlohmann::json::array();
  for (const DisagreementPlace& p : where) {
    places.push_back({{"component", toString(p.component)},
                      {"points", p.points},
                      {"from_s", p.from_s},
                      {"to_s", p.to_s},
                      {"excess_um", jsonNumber(p.excess_um)},
                      {"p_value", jsonNumber(p.p_value)}});
  }
  return {{"status", toString(status)},
          {"message", message},
          {"mechanisms", mechanisms},
          {"parameters", fitted},
          {"correlation", {{"parameters", names}, {"matrix", matrix}}},
          {"rms_before_um", jsonNumber(rms_before_um)},
          {"rms_after_um", jsonNumber(rms_after_um)},
          {"rms_fitted_term_um", jsonNumber(rms_fitted_term_um)},
          {"p2p_before_um", jsonNumber(p2p_before_um)},
          {"p2p_after_um", jsonNumber(p2p_after_um)},
          {"heldout_rms_before_um", jsonNumber(heldout_rms_before_um)},
          {"heldout_rms_after_um", jsonNumber(heldout_rms_after_um)},
          {"heldout_rms_fitted_term_um", jsonNumber(heldout_rms_fitted_term_um)},
          {"noise_um", jsonNumber(noise_um)},
          {"improves", improves},
          {"as_well_as_fitted_term", as_well_as_fitted_term},
          {"where", places},
          {"warnings", warnings},
          {"runs", runs},
          {"runs_to_search", runs_to_search},
          {"elapsed_s", jsonNumber(elapsed_s)}};
}

SimulationUpdate SimulationUpdate::parse(const nlohmann::json& json) {
  const auto number = [](const nlohmann::json& object, const char* key) {
    const nlohmann::json& value = object.at(key);
    return value.is_number() ? value.get<double>() : std::nan("");
  };
  SimulationUpdate out;
  for (const FitStatus status :
       {FitStatus::Converged, FitStatus::Degenerate, FitStatus::NoConvergence, FitStatus::Rejected}) {
    if (json.at("status") == std::string(toString(status))) out.status = status;
  }
  out.message = json.at("message").get<std::string>();
  out.mechanisms = json.at("mechanisms").get<std::vector<std::string>>();
  const nlohmann::json& names = json.at("correlation").at("parameters");
  const nlohmann::json& matrix = json.at("correlation").at("matrix");
  const auto count = static_cast<Index>(names.size());
  out.correlation = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto name = names[i].get<std::string>();
    const nlohmann::json& p = json.at("parameters").at(name);
    FittedSimulatorParameter fitted;
    fitted.parameter.name = name;
    fitted.parameter.value = number(p, "before");
    fitted.parameter.standard_uncertainty = number(p, "standard_uncertainty_before");
    fitted.parameter.unit = p.at("unit").get<std::string>();
    fitted.parameter.what = p.at("what").get<std::string>();
    fitted.value = number(p, "value");
    fitted.standard_uncertainty = number(p, "standard_uncertainty");
    fitted.put_in = p.at("put_in").get<bool>();
    fitted.at_bound = p.at("at_bound").get<bool>();
    fitted.no_influence = p.at("no_influence").get<bool>();
    out.parameters.push_back(std::move(fitted));
    for (std::size_t j = 0; j < names.size(); ++j) {
      const nlohmann::json& r = matrix.at(i).at(j);
      if (r.is_number()) out.correlation(static_cast<Index>(i), static_cast<Index>(j)) = r.get<double>();
    }
  }
  out.warnings = json.at("warnings").get<std::vector<std::string>>();
  out.rms_before_um = number(json, "rms_before_um");
  out.rms_after_um = number(json, "rms_after_um");
  out.rms_fitted_term_um = number(json, "rms_fitted_term_um");
  out.p2p_before_um = number(json, "p2p_before_um");
  out.p2p_after_um = number(json, "p2p_after_um");
  out.heldout_rms_before_um = number(json, "heldout_rms_before_um");
  out.heldout_rms_after_um = number(json, "heldout_rms_after_um");
  out.heldout_rms_fitted_term_um = number(json, "heldout_rms_fitted_term_um");
  out.noise_um = number(json, "noise_um");
  out.improves = json.at("improves").get<bool>();
  out.as_well_as_fitted_term = json.at("as_well_as_fitted_term").get<bool>();
  out.runs = json.at("runs").get<std::size_t>();
  out.runs_to_search = json.value("runs_to_search", out.runs_to_search);
  out.elapsed_s = number(json, "elapsed_s");
  return out;
}

std::string SimulationUpdate::summary() const {
  std::string text = "into the simulation: " + message + "\n";
  for (const FittedSimulatorParameter& p : parameters) {
    if (p.no_influence) continue;
    text += fmt::format("  {:<14} {}  (before {:g}{})\n", p.parameter.name,
                        withUncertainty(p.value, p.standard_uncertainty, p.parameter.printedUnit()),
                        printed(p.parameter.value), p.put_in ? ", put in" : "");
  }
  for (const std::string& warning : warnings) text += fmt::format("  note: {}\n", warning);
  return text;
}

}  // namespace spindrift
