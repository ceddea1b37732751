// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/instrument_checks.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

constexpr auto of_instrument = "instrument";

}  // namespace

CheckResult checkResultOf(const ResolutionCheck& check) {
  CheckResult result;
  result.passed = check.passed;
  nlohmann::json axes = nlohmann::json::array();
  for (const AxisVerdict& v : check.axes) {
    axes.push_back({{"component", toString(v.component)},
                    {"count", v.count},
                    {"limit_um", jsonNumber(v.limit_um)},
                    {"largest_um", jsonNumber(v.largest_um)},
                    {"largest_sigma_um", jsonNumber(v.largest_sigma_um)},
                    {"largest_at", v.largest_at},
                    {"rms_um", jsonNumber(v.rms_um)},
                    {"standard_deviation_um", jsonNumber(v.standard_deviation_um)},
                    {"passed", v.passed}});
    result.summary +=
        fmt::format("{}  largest {:.2f} µm ({}), rms {:.2f} µm, allowed {:.2f} µm: {}\n", toString(v.component),
                    v.largest_um, v.largest_at, v.rms_um, v.limit_um, v.passed ? "passed" : "not passed");
  }
  result.summary += check.reason + "\n";
  result.json = {
      {"passed", check.passed}, {"reason", check.reason}, {"axes", axes}, {"status", toString(check.status)}};
  return result;
}

std::string warmUpNotChecked() {
  return "Not checked: a drift of the instrument would appear in every deviation as a motion of the machine.";
}

std::optional<ObservationSet> warmUpMeasurement(const Campaign& campaign, const ClockOffsets& offsets) {
  const std::filesystem::path file = campaign.path(warm_up_file);
  if (!std::filesystem::exists(file)) return {};
  ObservationSet set = ObservationSet::read(file);
  applyClockOffsets(set, offsets);
  return set;
}

CheckResult checkResultOf(const WarmUpResult& warm_up) {
  CheckResult result;
  result.passed = warm_up.settled;
  nlohmann::json axes = nlohmann::json::array();
  for (const WarmUpAxis& axis : warm_up.axes) {
    if (!axis.measured) continue;
    axes.push_back({{"component", toString(axis.component)},
                    {"drift_um_per_h",
                     {{"value", jsonNumber(axis.drift_um_per_h)},
                      {"standard_uncertainty", jsonNumber(axis.drift_sigma_um_per_h)}}},
                    {"total_um", jsonNumber(axis.total_um)},
                    {"tau_s", jsonNumber(axis.tau_s)},
                    {"amplitude_um", jsonNumber(axis.amplitude_um)},
                    {"settled_after_s", jsonNumber(axis.settled_after_s)},
                    {"time_constant", toString(axis.time_constant)},
                    {"settled", axis.verdict == WarmUpVerdict::Settled},
                    {"verdict", toString(axis.verdict)},
                    {"time_s", axis.time_s},
                    {"value_um", axis.value_um}});
    std::string tau;
    if (axis.tau_s) tau = fmt::format(", time constant {:.0f} min", *axis.tau_s / 60.0);
    if (axis.time_constant == TimeConstant::BeyondRecord) tau = ", time constant beyond the record";
    if (axis.time_constant == TimeConstant::TooShort) tau = ", time constant too short to be determined";
    result.summary += fmt::format("{}  drift {}{}: {}\n", toString(axis.component),
                                  withUncertainty(axis.drift_um_per_h, axis.drift_sigma_um_per_h, "um/h"), tau,
                                  toString(axis.verdict));
  }
  result.summary += warm_up.reason + "\n";
  if (!warm_up.cause_reason.empty()) result.summary += warm_up.cause_reason + "\n";
  result.json = {{"point", warm_up.point},
                 {"cause", warm_up.settled                            ? nlohmann::json()
                           : warm_up.cause == WarmUpCause::Instrument ? nlohmann::json(of_instrument)
                                                                      : nlohmann::json("unknown")},
                 {"cause_reason", warm_up.cause_reason},
                 {"settled", warm_up.settled},
                 {"reason", warm_up.reason},
                 {"status", toString(warm_up.status)},
                 {"drift_limit_um_per_h", warm_up.drift_limit_um_per_h},
                 {"axes", axes}};
  return result;
}

WarmUpResult warmUpFrom(const nlohmann::json& json) try {
  WarmUpResult result;
  const bool judged = json.at("status").get<std::string>() == toString(FitStatus::Converged);
  result.status = judged ? FitStatus::Converged : FitStatus::Degenerate;
  result.drift_limit_um_per_h = json.value("drift_limit_um_per_h", 0.0);
  result.point = json.value("point", std::string());
  result.settled = json.at("settled").get<bool>();
  result.reason = json.at("reason").get<std::string>();
  const nlohmann::json cause = json.value("cause", nlohmann::json());
  result.cause =
      cause.is_string() && cause.get<std::string>() == of_instrument ? WarmUpCause::Instrument : WarmUpCause::Unknown;
  result.cause_reason = json.value("cause_reason", std::string());
  const auto optional = [](const nlohmann::json& value) {
    return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
  };
  for (const nlohmann::json& entry : json.value("axes", nlohmann::json::array())) {
    WarmUpAxis axis;
    axis.measured = true;
    axis.component = componentFromString(entry.at("component").get<std::string>()).value_or(Component::EX);
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    axis.drift_um_per_h = optional(entry.at("drift_um_per_h").at("value")).value_or(unknown);
    axis.drift_sigma_um_per_h = optional(entry.at("drift_um_per_h").at("standard_uncertainty")).value_or(unknown);
    axis.total_um = optional(entry.at("total_um")).value_or(unknown);
    const std::string found = entry.value("time_constant", std::string());
    for (const TimeConstant t : {TimeConstant::Determined, TimeConstant::BeyondRecord, TimeConstant::TooShort})
      if (toString(t) == found) axis.time_constant = t;
    // Checks stored before this was told apart carry a bound of the search as a result: nothing is shown of it.
    if (axis.time_constant == TimeConstant::Determined) axis.tau_s = optional(entry.at("tau_s"));
    axis.amplitude_um = optional(entry.at("amplitude_um"));
    axis.verdict = warmUpVerdict(axis.drift_um_per_h, axis.drift_sigma_um_per_h, result.drift_limit_um_per_h);
    if (axis.verdict == WarmUpVerdict::Settled) axis.settled_after_s = optional(entry.at("settled_after_s"));
    axis.time_s = entry.at("time_s").get<std::vector<double>>();
    axis.value_um = entry.at("value_um").get<std::vector<double>>();
    for (std::size_t k = 0; k < result.axes.size(); ++k)
      if (all_components[k] == axis.component) result.axes[k] = axis;
  }
  return result;
} catch (const nlohmann::json::exception& e) {
  throw InputError(fmt::format("the stored check cannot be read ({}); check again.", e.what()));
}

CheckResult checkJogs(const ObservationSet& observations, const MachineDescription& machine) {
  return checkResultOf(checkAgainstResolution(observations, machine, 1.0));
}

CheckResult checkRepeatability(const ObservationSet& observations, const MachineDescription& machine) {
  return checkResultOf(checkAgainstResolution(observations, machine, 0.5));
}

ResolutionCheck resolutionCheckFrom(const nlohmann::json& json) try {
  ResolutionCheck check;
  check.status = FitStatus::Converged;
  check.passed = json.at("passed").get<bool>();
  check.reason = json.at("reason").get<std::string>();
  for (const nlohmann::json& axis : json.value("axes", nlohmann::json::array())) {
    const auto number = [&](const char* key) {
      return axis.at(key).is_number() ? axis.at(key).get<double>() : std::numeric_limits<double>::quiet_NaN();
    };
    AxisVerdict verdict;
    verdict.component = componentFromString(axis.at("component").get<std::string>()).value_or(Component::EX);
    verdict.count = axis.at("count").get<std::size_t>();
    verdict.limit_um = number("limit_um");
    verdict.largest_um = number("largest_um");
    verdict.largest_sigma_um = number("largest_sigma_um");
    verdict.largest_at = axis.at("largest_at").get<std::string>();
    verdict.rms_um = number("rms_um");
    verdict.standard_deviation_um = number("standard_deviation_um");
    verdict.passed = axis.at("passed").get<bool>();
    check.axes.push_back(verdict);
  }
  return check;
} catch (const nlohmann::json::exception& e) {
  throw InputError(fmt::format("the stored check cannot be read ({}); check again.", e.what()));
}

}  // namespace spindrift
