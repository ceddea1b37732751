// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/compensated_data.h"

#include <fmt/format.h>

#include <cmath>

namespace spindrift {
namespace {

std::string sentence(std::size_t out, std::size_t all, const char* what) {
  return fmt::format(
      "Taken while the control was compensating (compensation_on = 1) and left out: {} of {} {}. They show what the "
      "compensation leaves, not the error.",
      out, all, what);
}

}  // namespace

bool wasCompensating(const OperatingLog& log, double time_s) {
  return log.has(compensation_signal) && log.at(compensation_signal, time_s) > 0.5;
}

std::string leaveOutCompensated(ObservationSet& observations, const OperatingLog* log) {
  if (log == nullptr || !log->has(compensation_signal)) return {};
  std::size_t out = 0;
  for (Observation& o : observations.rows) {
    if (!wasCompensating(*log, o.time_s)) continue;
    o.use = ObservationUse::Exclude;
    ++out;
  }
  return out == 0 ? std::string() : sentence(out, observations.rows.size(), "observations");
}

void leaveOutCompensated(TimeSeries& series) {
  const Signal* on = series.find(compensation_signal);
  if (on == nullptr) return;
  const std::vector<double> state = bridged(series.time_s, on->values, true);
  std::size_t out = 0;
  std::size_t all = 0;
  for (Signal& s : series.signals) {
    if (s.kind != SignalKind::Displacement) continue;
    for (std::size_t r = 0; r < s.values.size(); ++r) {
      if (!std::isfinite(s.values[r])) continue;
      ++all;
      if (!(state[r] > 0.5)) continue;
      s.values[r] = std::nan("");
      ++out;
    }
  }
  if (out > 0) series.notes.push_back(sentence(out, all, "measured values"));
}

}  // namespace spindrift
