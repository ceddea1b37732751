// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/comparable_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/discrepancy/log_gaps.h"
#include "core/math/statistics.h"

namespace spindrift {

ComparableRows comparableRows(const DiscrepancyInput& input, std::vector<std::string>& warnings) {
  const auto& rows = input.observations.rows;
  ComparableRows out;
  std::size_t usable = 0;
  std::size_t beyond_log = 0;
  double log_end = std::numeric_limits<double>::infinity();
  std::vector<LogGap> gaps;
  if (input.log && input.log->time_s().size() > 1) {
    const auto& t = input.log->time_s();
    std::vector<double> steps;
    for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
    log_end = t.back() + std::max(300.0, 2.0 * median(steps));
    gaps = logGaps(t);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool known = rows[i].time_s <= log_end && !inGap(gaps, rows[i].time_s);
    if (known && rows[i].use == ObservationUse::Holdout) out.held_out.push_back(i);
    if (rows[i].use == ObservationUse::Exclude) continue;
    if (!(rows[i].sigma > 0.0)) {
      throw InputError({input.observations.file, fmt::format("row {}", i + 1)},
                       fmt::format("sigma {} is not allowed; allowed: greater than zero.", rows[i].sigma));
    }
    ++usable;
    if (!std::isfinite(input.predicted[i])) {
      ++out.unmatched;
      continue;
    }
    if (rows[i].use != ObservationUse::Fit) continue;
    if (rows[i].time_s > log_end) {
      ++beyond_log;
      continue;
    }
    if (known) out.fit.push_back(i);
  }
  if (usable == 0)
    throw InputError({input.observations.file, ""}, "holds no observation to be used; allowed: at least one.");
  if (2 * (usable - out.unmatched) < usable) {
    throw InputError(
        {input.base_table.empty() ? input.observations.file : input.observations.file.parent_path() / input.base_table,
         ""},
        fmt::format("only {} of {} observations have a prediction in the simulation; allowed: at least half.",
                    usable - out.unmatched, usable));
  }
  if (out.unmatched > 0) {
    warnings.push_back(fmt::format("{} of {} observations have no prediction in the simulation and are left out.",
                                   out.unmatched, usable));
  }
  if (beyond_log > 0) {
    warnings.push_back(
        fmt::format("{} observations are later than the end of the log and are not fitted.", beyond_log));
  }
  if (out.fit.empty()) {
    throw InputError({input.observations.file, ""},
                     "holds no row to be fitted; allowed: at least one with use fit, at a time that the log covers.");
  }
  return out;
}

}  // namespace spindrift
