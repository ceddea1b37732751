// SPDX-License-Identifier: Apache-2.0
#include "core/probing/evaluate_touches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/count_text.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/machine/parameter_meanings.h"
#include "core/math/statistics.h"
#include "core/probing/closed_forms.h"

namespace spindrift {
namespace {

/// Cycles of an artefact whose touches lie exactly where those of an earlier one lie, with that. No probe repeats so.
std::vector<std::pair<std::string, std::string>> copiedCycles(const TouchList& list, const std::string& artefact) {
  constexpr std::size_t telling_touches = 6;
  using Place = std::tuple<std::string, std::string, double, int, double, double, double>;
  std::vector<std::pair<std::string, std::vector<Place>>> cycles;
  for (const Touch& t : list.touches) {
    if (t.artefact != artefact) continue;
    auto at = std::find_if(cycles.begin(), cycles.end(), [&](const auto& c) { return c.first == t.cycle; });
    if (at == cycles.end()) at = cycles.insert(at, {t.cycle, {}});
    at->second.emplace_back(t.feature, t.stylus, t.c_deg, t.touch, t.position_mm.x(), t.position_mm.y(),
                            t.position_mm.z());
  }
  std::vector<std::pair<std::string, std::string>> copied;
  std::map<std::vector<Place>, std::string> seen;
  for (auto& [cycle, places] : cycles) {
    if (places.size() < telling_touches) continue;
    std::sort(places.begin(), places.end());
    const auto [first, fresh] = seen.try_emplace(std::move(places), cycle);
    if (!fresh) copied.emplace_back(cycle, first->second);
  }
  return copied;
}

void addCommon(const CycleEvaluation& evaluation, const TouchEvaluation& all, const MachineDescription& machine,
               InstrumentEvaluation& out) {
  const Artefact& artefact = *machine.findArtefact(evaluation.artefact);
  out.observations.append(cycleObservations(evaluation, all.touches, machine, artefact));
  for (const RejectedTouch& r : evaluation.rejected) {
    out.rejected.push_back({all.touches.touches[r.touch].label(), r.reason});
  }
  out.warnings.insert(out.warnings.end(), evaluation.warnings.begin(), evaluation.warnings.end());
  out.good_enough = out.good_enough && evaluation.good_enough;
  nlohmann::json cycles = cyclesJson(evaluation);
  for (auto& cycle : cycles["cycles"]) out.details["cycles"].push_back(std::move(cycle));
  cycles.erase("cycles");
  out.details["artefacts"].push_back(std::move(cycles));

  std::string noise;
  double freedom = 0.0;
  for (std::size_t g = 0; g < evaluation.fit.group_sigma_mm.size(); ++g) {
    noise += fmt::format("{}{:.3f} µm {}", g > 0 ? ", " : "", evaluation.fit.group_sigma_mm[g] * um_per_mm,
                         g == 0 ? "across" : "along the axis");
    freedom += evaluation.fit.group_degrees_of_freedom[g];
  }
  out.summary += fmt::format("{}: {}, {}, {} left out; touch noise {}{}\n", evaluation.artefact,
                             countOf(evaluation.cycles.size(), "cycle"),
                             countOf(evaluation.problem.rows.size(), "touch", "touches"), evaluation.rejected.size(),
                             noise, freedom > 0.5 ? "" : " (assumed)");
  const std::size_t all_touches = evaluation.problem.rows.size() + evaluation.rejected.size();
  if (2 * evaluation.rejected.size() > all_touches) {
    out.good_enough = false;
    out.warnings.push_back(
        fmt::format("{} of {} touches of {} do not fit: the columns x_mm and y_mm swapped, approach vectors of the "
                    "wrong sign, or a diameter or stylus in machine.json that is not the one used?",
                    evaluation.rejected.size(), all_touches, evaluation.artefact));
  }
  for (const auto& [copy, original] : copiedCycles(all.touches, evaluation.artefact)) {
    out.good_enough = false;
    out.warnings.push_back(fmt::format(
        "Cycle {} of {} holds the positions of cycle {} digit for digit: a copy is no second measurement; remove it or "
        "measure again.",
        copy, evaluation.artefact, original));
  }
  if (evaluation.cycles.size() < 2) {
    out.good_enough = false;
    return;
  }
  const std::size_t last = evaluation.cycles.size() - 1;
  out.summary += fmt::format("in {} since {}:\n", evaluation.cycles[last], evaluation.cycles.front());
  for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
    const CycleParameter& parameter = evaluation.parameters[last][p];
    const ErrorParameter known = describedParameter(evaluation.names[p]);
    out.summary +=
        fmt::format("  {:<10} {:<18} {}\n", known.symbolWithIso(),
                    parameter.determined ? withUncertainty(parameter.value, parameter.standard_uncertainty, known.unit)
                                         : std::string("not determined"),
                    known.meaning);
  }
}

/// Lengths of the bar against its certificate, per cycle.
nlohmann::json certificateJson(const HoleCycleResult& holes) {
  nlohmann::json list = nlohmann::json::array();
  for (const CertifiedLengths& c : holes.against_certificate) {
    nlohmann::json features = nlohmann::json::array();
    for (const CertifiedLengths::Hole& h : c.holes) {
      features.push_back({{"feature", h.feature},
                          {"certified_mm", h.certified_mm},
                          {"error_um", jsonNumber(h.error_um)},
                          {"standard_uncertainty_um", jsonNumber(h.standard_uncertainty_um)}});
    }
    list.push_back({{"cycle", c.cycle},
                    {"axis", holes.setup.linear},
                    {"temperature_degC", jsonNumber(c.temperature_degC)},
                    {"slope_um_per_m",
                     {{"value", jsonNumber(c.slope_um_per_m)},
                      {"standard_uncertainty", jsonNumber(c.standard_uncertainty_um_per_m)}}},
                    {"chi2", jsonNumber(c.chi2)},
                    {"degrees_of_freedom", c.degrees_of_freedom},
                    {"holes", features}});
  }
  return list;
}

nlohmann::json closedFormsJson(const std::vector<HeadComparison>& comparisons) {
  nlohmann::json list = nlohmann::json::array();
  const auto vector = [](const Eigen::Vector3d& v) -> nlohmann::json {
    return {jsonNumber(v.x()), jsonNumber(v.y()), jsonNumber(v.z())};
  };
  for (const HeadComparison& c : comparisons) {
    list.push_back({{"cycle", c.cycle},
                    {"ball", c.ball},
                    {"head_rotation_urad", c.closed_form_urad ? vector(*c.closed_form_urad) : nlohmann::json()},
                    {"joint_head_rotation_urad", vector(c.joint_urad)},
                    {"joint_standard_uncertainty_urad", vector(c.joint_sigma_urad)},
                    {"spindle_drift_um", c.spindle_drift_um},
                    {"joint_spindle_drift_um", jsonNumber(c.joint_drift_um)},
                    {"message", c.message}});
  }
  return list;
}

nlohmann::json growthJson(const HoleCycleResult& holes) {
  nlohmann::json list = nlohmann::json::array();
  for (const ExpectedGrowth& g : holes.growth) {
    list.push_back({{"cycle", g.cycle},
                    {"expected_um_per_m",
                     {{"value", jsonNumber(g.expected_um_per_m)},
                      {"standard_uncertainty", jsonNumber(g.expected_sigma_um_per_m)}}},
                    {"measured_um_per_m",
                     {{"value", jsonNumber(g.measured_um_per_m)},
                      {"standard_uncertainty", jsonNumber(g.measured_sigma_um_per_m)}}}});
  }
  return list;
}

}  // namespace

nlohmann::json cyclesJson(const CycleEvaluation& evaluation) {
  nlohmann::json out;
  out["artefact"] = evaluation.artefact;
  out["status"] = toString(evaluation.status);
  out["message"] = evaluation.message;
  nlohmann::json cycles = nlohmann::json::array();
  const int reference = evaluation.problem.reference_cycle;
  for (std::size_t k = 0; k < evaluation.cycles.size(); ++k) {
    const CycleSolution& solution = evaluation.fit.cycles[k];
    nlohmann::json parameters = nlohmann::json::object();
    nlohmann::json open = nlohmann::json::array();
    for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
      const CycleParameter& parameter = evaluation.parameters[k][p];
      if (parameter.determined) {
        parameters[evaluation.names[p]] = {{"value", jsonNumber(parameter.value)},
                                           {"standard_uncertainty", jsonNumber(parameter.standard_uncertainty)}};
      } else {
        parameters[evaluation.names[p]] = {{"value", nullptr}, {"standard_uncertainty", nullptr}};
        open.push_back(evaluation.names[p]);
      }
    }
    nlohmann::json cycle{{"cycle", evaluation.cycles[k]},         {"artefact", evaluation.artefact},
                         {"time_s", evaluation.cycle_time_s[k]},  {"parameters", parameters},
                         {"touches_used", solution.touches_used}, {"not_determined", open}};
    if (static_cast<int>(k) == reference) {
      cycle["reference"] = true;
    } else {
      cycle["condition_number"] = jsonNumber(solution.condition_number);
      cycle["weakest_combination"] = combinationText(solution.weakest, evaluation.names);
      nlohmann::json covariance = nlohmann::json::array();
      const auto n = static_cast<int>(evaluation.names.size());
      for (int a = 0; a < n; ++a) {
        nlohmann::json row = nlohmann::json::array();
        for (int b = 0; b < n; ++b) row.push_back(jsonNumber(evaluation.covariance(static_cast<int>(k), a, b)));
        covariance.push_back(row);
      }
      cycle["covariance"] = covariance;
    }
    cycles.push_back(cycle);
  }
  out["cycles"] = cycles;
  out["parameters"] = evaluation.names;
  nlohmann::json noise = nlohmann::json::array();
  for (std::size_t g = 0; g < evaluation.fit.group_sigma_mm.size(); ++g) {
    noise.push_back({{"touches", g == 0 ? "across" : "along"},
                     {"sigma_um", jsonNumber(evaluation.fit.group_sigma_mm[g] * um_per_mm)},
                     {"degrees_of_freedom", g < evaluation.fit.group_degrees_of_freedom.size()
                                                ? jsonNumber(evaluation.fit.group_degrees_of_freedom[g])
                                                : nlohmann::json(nullptr)}});
  }
  out["touch_noise"] = noise;
  // The noise of the first cycle is common to all others: their errors share this covariance.
  if (evaluation.cycles.size() > 2) {
    const int a = reference == 0 ? 1 : 0;
    const int b = static_cast<int>(evaluation.cycles.size()) - 1;
    const Eigen::MatrixXd common = evaluation.fit.covarianceBetween(a, b);
    nlohmann::json matrix = nlohmann::json::array();
    for (Eigen::Index i = 0; i < common.rows(); ++i) {
      nlohmann::json row = nlohmann::json::array();
      for (Eigen::Index j = 0; j < common.cols(); ++j) {
        row.push_back(jsonNumber(common(i, j) * evaluation.unit[static_cast<std::size_t>(i)] *
                                 evaluation.unit[static_cast<std::size_t>(j)]));
      }
      matrix.push_back(row);
    }
    out["covariance_between_cycles"] = {
        {"of", {evaluation.cycles[static_cast<std::size_t>(a)], evaluation.cycles[static_cast<std::size_t>(b)]}},
        {"reason", "every cycle is relative to the first one, whose noise they share"},
        {"matrix", matrix}};
  }
  return out;
}

TouchEvaluation evaluateTouchList(const Campaign& campaign, TouchList touches, const HoleCycleOptions& hole_options,
                                  const BallCycleOptions& ball_options, JobContext& job) {
  TouchEvaluation evaluation;
  evaluation.touches = std::move(touches);
  evaluation.touches.checkAgainst(campaign.machine);
  if (!campaign.excluded_captures.empty()) {
    std::vector<Touch>& all = evaluation.touches.touches;
    const auto kept = std::stable_partition(
        all.begin(), all.end(), [&](const Touch& t) { return !campaign.excluded_captures.contains(t.id()); });
    evaluation.excluded.assign(kept, all.end());
    all.erase(kept, all.end());
    if (all.empty()) throw InputError({evaluation.touches.file, ""}, "has no touches left: all are excluded.");
  }
  const std::vector<std::string> artefacts = evaluation.touches.artefacts();
  for (std::size_t i = 0; i < artefacts.size(); ++i) {
    job.throwIfCancelled();
    job.report(static_cast<double>(i) / static_cast<double>(artefacts.size()), "evaluating touches");
    const Artefact& artefact = *campaign.machine.findArtefact(artefacts[i]);
    if (artefact.kind == "hole_bar") {
      evaluation.hole_cycles.push_back(evaluateHoleCycles(evaluation.touches, campaign.machine, artefact, hole_options,
                                                          campaign.log ? &*campaign.log : nullptr));
      evaluation.hole_cycles.back().bias = secondAxisBias(evaluation.hole_cycles.back(), evaluation.touches);
    } else {
      evaluation.ball_cycles.push_back(evaluateBallCycles(evaluation.touches, campaign.machine, artefact,
                                                          campaign.log ? &*campaign.log : nullptr, ball_options));
      BallCycleResult& balls = evaluation.ball_cycles.back();
      balls.closed_forms = closedFormsBeside(balls, campaign.machine);
    }
  }
  return evaluation;
}

InstrumentEvaluation describeTouches(const TouchEvaluation& evaluation, const MachineDescription& machine) {
  InstrumentEvaluation out;
  out.instrument = "touch_probe";
  out.details["cycles"] = nlohmann::json::array();
  out.details["artefacts"] = nlohmann::json::array();
  for (const HoleCycleResult& holes : evaluation.hole_cycles) {
    addCommon(holes, evaluation, machine, out);
    nlohmann::json& details = out.details["artefacts"].back();
    nlohmann::json linearity = nlohmann::json::array();
    for (const LinearityDeviation& d : holes.linearity) {
      linearity.push_back({{"feature", d.feature},
                           {"rms_um", d.rms_um},
                           {"largest_um", d.largest_um},
                           {"largest_in", d.largest_cycle},
                           {"noise_um", d.sigma_um}});
    }
    details["deviation_from_line"] = linearity;
    details["against_certificate"] = certificateJson(holes);
    details["growth_expected"] = growthJson(holes);
    details["growth_combined"] = holes.growth_combined;
    if (holes.growth_combined)
      out.summary += "  EME: touches, and expansion coefficient with temperature, by their uncertainties\n";
    if (!holes.against_certificate.empty()) {
      const CertifiedLengths& last = holes.against_certificate.back();
      out.summary += fmt::format(
          "  against the certificate, in {}: {} deviates by {}{}\n", last.cycle, holes.setup.linear,
          withUncertainty(last.slope_um_per_m, last.standard_uncertainty_um_per_m, "um/m"),
          last.temperature_degC ? fmt::format(" (bar at {:.2f} °C)", *last.temperature_degC)
                                : std::string(" (temperature of the bar not known: taken as that of the certificate)"));
    }
    nlohmann::json per = nlohmann::json::object();
    for (std::size_t p = 0; p < holes.bias.names.size(); ++p)
      per[holes.bias.names[p]] = jsonNumber(holes.bias.bias_per_um_per_m[p]);
    details["bias_per_um_per_m_of_second_axis"] = {{"axis", holes.bias.second}, {"bias", per}};
    out.summary += fmt::format("  largest deviation from a straight line {:.2f} µm\n", holes.largest_nonlinearity_um);
  }
  for (const BallCycleResult& balls : evaluation.ball_cycles) {
    addCommon(balls, evaluation, machine, out);
    nlohmann::json& details = out.details["artefacts"].back();
    nlohmann::json distances = nlohmann::json::array();
    for (const BallDistance& d : balls.distances) {
      distances.push_back({{"cycle", d.cycle},
                           {"stylus", d.stylus},
                           {"from", d.from},
                           {"to", d.to},
                           {"error_um", d.error_um},
                           {"standard_uncertainty_um", jsonNumber(d.standard_uncertainty_um)}});
    }
    details["ball_distances"] = distances;
    details["closed_forms"] = closedFormsJson(balls.closed_forms);
  }
  return out;
}

InstrumentEvaluation evaluateTouches(const Campaign& campaign, JobContext& job) {
  const auto file = campaign.captureList("touches.csv");
  if (!file) throw InputError({campaign.path("captures/touches.csv"), ""}, "is missing.");
  return describeTouches(evaluateTouchList(campaign, TouchList::read(*file), {}, {}, job), campaign.machine);
}

}  // namespace spindrift
