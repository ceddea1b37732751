// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_titles.h"
#include "core/discrepancy/percent_text.h"
#include "core/machine/driver_words.h"

namespace spindrift {

nlohmann::json DiscrepancyResult::json() const {
  using nlohmann::json;
  json list = json::array();
  for (const FoundEffect& e : effects) {
    json parameters = json::object();
    json uncertainty = json::object();
    for (const FittedParameter& p : e.parameters) {
      parameters[p.name] = jsonNumber(p.value);
      uncertainty[p.name] = jsonNumber(p.standard_uncertainty);
    }
    list.push_back({{"id", e.id},
                    {"title", e.title.empty() ? effectTitle(e.id) : e.title},
                    {"rivals", e.rivals},
                    {"containers", e.containers},
                    {"confidence", jsonNumber(e.confidence)},
                    {"parameters", parameters},
                    {"standard_uncertainty", uncertainty},
                    {"drivers", e.drivers},
                    {"rms_um", jsonNumber(e.rms_um)},
                    {"delta_bic", jsonNumber(e.delta_bic)},
                    {"heldout_rms_before_um", jsonNumber(e.heldout_rms_before_um)},
                    {"heldout_rms_after_um", jsonNumber(e.heldout_rms_after_um)},
                    {"crossvalidated_rms_before_um", jsonNumber(e.crossvalidated_rms_before_um)},
                    {"crossvalidated_rms_after_um", jsonNumber(e.crossvalidated_rms_after_um)},
                    {"delta_chi2", jsonNumber(e.delta_chi2)},
                    {"margin", jsonNumber(e.margin)},
                    {"forced", e.forced}});
  }
  json places = json::array();
  for (const DisagreementPlace& p : where) {
    places.push_back({{"component", std::string(toString(p.component))},
                      {"points", p.points},
                      {"from_s", jsonNumber(p.from_s)},
                      {"to_s", jsonNumber(p.to_s)},
                      {"excess_um", jsonNumber(p.excess_um)},
                      {"p_value", jsonNumber(p.p_value)},
                      {"condition", p.condition.empty() ? json() : json(p.condition)}});
  }
  json steps_list = json::array();
  for (const DiscrepancyStep& s : steps) {
    steps_list.push_back({{"id", s.id},
                          {"accepted", s.accepted},
                          {"delta_bic", jsonNumber(s.delta_bic)},
                          {"delta_chi2", jsonNumber(s.delta_chi2)},
                          {"reason", s.reason}});
  }
  json out;
  out["verdict"] = std::string(toString(verdict));
  out["decided"] = decided;
  out["message"] = message;
  out["effects"] = list;
  out["where"] = places;
  out["gap"] = {{"rms_before_um", jsonNumber(gap.rms_before_um)},
                {"rms_after_um", jsonNumber(gap.rms_after_um)},
                {"noise_um", jsonNumber(gap.noise_um)},
                {"unit", gap.rotations ? "urad" : "um"},
                {"heldout_rms_before_um", jsonNumber(gap.heldout_rms_before_um)},
                {"heldout_rms_after_um", jsonNumber(gap.heldout_rms_after_um)}};
  out["suggestion"] = nullptr;
  if (suggestion) {
    json programme = json::array();
    for (const ProgrammeStep& step : suggestion->programme) {
      programme.push_back({{"from_s", jsonNumber(step.from_s)},
                           {"to_s", jsonNumber(step.to_s)},
                           {"action", step.action},
                           {"as_logged", step.as_logged},
                           {"spindle_rpm", jsonNumber(step.spindle_rpm)},
                           {"feed_mm_min", step.feed_mm_min},
                           {"speed_c_rpm", jsonNumber(step.c_rpm)},
                           {"coolant", step.coolant},
                           {"position_mm", step.position_mm}});
    }
    out["suggestion"] = {{"points", suggestion->points},
                         {"times_s", suggestion->times_s},
                         {"c_deg", suggestion->c_deg},
                         {"conditions", suggestion->conditions},
                         {"separates", suggestion->separates},
                         {"expected_delta_bic", jsonNumber(suggestion->expected_delta_bic)},
                         {"programme", programme},
                         {"restart_instrument", suggestion->restart_instrument},
                         {"expected_information_nats", jsonNumber(suggestion->expected_information_nats)},
                         {"present_entropy_nats", jsonNumber(suggestion->present_entropy_nats)},
                         {"probability_alone_now", jsonNumber(suggestion->probability_alone_now)},
                         {"probability_alone_expected", jsonNumber(suggestion->probability_alone_expected)}};
  }
  out["leftover"] = leftover.empty() ? json() : json(leftover);
  out["model"] = model ? model->json() : json();
  out["steps"] = steps_list;
  out["warnings"] = warnings;
  json sensor_roles = json::object();
  for (const SensorReading& s : sensors) {
    sensor_roles[s.column] = {{"role", std::string(toString(s.role))}, {"from", s.from}};
  }
  out["sensor_roles"] = sensor_roles;
  out["unmatched_observations"] = unmatched;
  json noise_json = json::object();
  for (const NoiseEstimate& n : noise) {
    noise_json[std::string(toString(n.component))] = {
        {"scale", jsonNumber(n.scale)},
        {"scale_uncertainty", jsonNumber(n.scale_uncertainty)},
        {"common_um", jsonNumber(n.common_um)},
        {"correlated_part", jsonNumber(n.correlated_part)},
        {"correlation_time_s", jsonNumber(n.correlation_time_s)},
        {"drift_um", jsonNumber(n.drift_um)},
        {"drift_correlation_time_s", jsonNumber(n.drift_correlation_time_s)}};
  }
  out["noise"] = noise_json;
  out["tail_dof"] = tail_dof > 0.0 ? jsonNumber(tail_dof) : json();
  json shift_list = json::array();
  for (const StateShift& s : shifts) {
    shift_list.push_back({{"state", s.state},
                          {"component", std::string(toString(s.component))},
                          {"time_s", jsonNumber(s.time_s)},
                          {"shift_um", jsonNumber(s.shift_um)},
                          {"standard_uncertainty", jsonNumber(s.standard_uncertainty)}});
  }
  out["state_shifts"] = shift_list;
  json candidate_list = json::array();
  for (const EffectCandidate& c : candidates) {
    candidate_list.push_back({{"id", c.id}, {"probability", jsonNumber(c.probability)}, {"rejected", c.rejected}});
  }
  out["candidates"] = candidate_list;
  json outlier_rows = json::array();
  json outlier_list = json::array();
  for (const OutlyingReading& o : outliers) {
    outlier_rows.push_back(o.row + 1);
    outlier_list.push_back({{"row", o.row + 1}, {"deviation", jsonNumber(o.deviation)}});
  }
  out["outliers"] = outlier_rows;
  out["outlying_readings"] = outlier_list;
  out["clock_offset_s"] = jsonNumber(clock_offset_s);
  out["clock_offset_uncertainty_s"] =
      clock_offset_uncertainty_s > 0.0 ? jsonNumber(clock_offset_uncertainty_s) : json();
  json remainder_json = json::object();
  for (const ComponentRemainder& r : remainder) {
    remainder_json[std::string(toString(r.component))] = {{"rms_um", jsonNumber(r.rms_um)},
                                                          {"evidence", jsonNumber(r.evidence)}};
  }
  out["remainder"] = remainder_json;
  if (!twins.empty()) out["twins"] = twins;
  out["explained_fraction"] = jsonNumber(explained_fraction);
  return out;
}

std::string DiscrepancyResult::summary() const {
  const char* unit = gap.rotations ? "µrad" : "µm";
  std::string text = fmt::format("{}: {}\n", toString(verdict), message);
  for (const FoundEffect& e : effects) {
    text += fmt::format("  {}  {}\n    {}\n", e.id, e.title.empty() ? effectTitle(e.id) : e.title,
                        driversInWords(e.drivers));
    text += fmt::format("    confidence {}, gain in BIC {:.0f}, held-out rms {:.2f} → {:.2f} {}\n",
                        percentText(e.confidence), printed(e.delta_bic), e.heldout_rms_before_um,
                        e.heldout_rms_after_um, unit);
    if (!e.rivals.empty()) text += fmt::format("    cannot be distinguished from {}\n", joinedList(e.rivals, "or"));
    for (const FittedParameter& p : e.parameters) {
      text += fmt::format("    {}: {}\n", parameterTitle(p.name), withUncertainty(p.value, p.standard_uncertainty, ""));
    }
  }
  for (const DisagreementPlace& p : where) {
    text += fmt::format("  where: {} {} from {:.2f} h to {:.2f} h{}: {:.2f} {} beyond the noise ({})\n",
                        toString(p.component), shortenedList(p.points, 12), printed(p.from_s / 3600.0),
                        printed(p.to_s / 3600.0), p.condition.empty() ? "" : ", " + p.condition, p.excess_um,
                        printedUnit(unitOf(p.component)), pValueText(p.p_value));
  }
  text += fmt::format("  gap: {:.2f} {} before, {:.2f} {} after, noise {:.2f} {}\n", gap.rms_before_um, unit,
                      gap.rms_after_um, unit, gap.noise_um, unit);
  if (!leftover.empty()) text += fmt::format("  remains: {}\n", leftover);
  if (suggestion) {
    text += fmt::format(
        "  measure next, to distinguish {}: {}. Expected probability of a unique result afterwards {:.2f} (most "
        "probable effect now {:.2f})\n",
        suggestion->separates, suggestion->conditions, suggestion->probability_alone_expected,
        suggestion->probability_alone_now);
  }
  for (const std::string& w : warnings) text += fmt::format("  note: {}\n", w);
  return text;
}

}  // namespace spindrift
