// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/comparable_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/discrepancy/log_gaps.h"
#include "core/discrepancy/own_effects.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// Takes out of `fit` what was measured between two rows of the log of different spindle speed: nobody knows when it
/// changed, and what follows speed at once is wrong by all of it. A log so coarse that more than a tenth of the rows
/// would go is taken as it is. Returns how many went.
std::size_t leaveOutChanges(const OperatingLog& log, double log_clock_s, const std::vector<Observation>& rows,
                            std::vector<std::size_t>& fit) {
  const std::vector<double>* rpm = log.signal("spindle_rpm");
  if (rpm == nullptr) return 0;
  const std::vector<double>& t = log.time_s();
  const auto changes = [&](std::size_t row) {
    const double time_s = rows[row].time_s + log_clock_s;
    const auto after = std::upper_bound(t.begin(), t.end(), time_s);
    if (after == t.begin() || after == t.end() || *(after - 1) == time_s) return false;
    const auto k = static_cast<std::size_t>(after - t.begin());
    return (*rpm)[k] != (*rpm)[k - 1];
  };
  const auto count = static_cast<std::size_t>(std::count_if(fit.begin(), fit.end(), changes));
  if (count == 0 || 10 * count > fit.size()) return 0;
  std::erase_if(fit, changes);
  return count;
}

}  // namespace

ComparableRows comparableRows(const DiscrepancyInput& input, double log_clock_s, std::vector<std::string>& warnings) {
  const auto& rows = input.observations.rows;
  ComparableRows out;
  std::size_t usable = 0;
  std::size_t beyond_log = 0;
  double log_end = std::numeric_limits<double>::infinity();
  std::vector<LogGap> gaps;
  // Where nothing has a memory, what happened in a gap of the log or between two of its rows is of no account.
  const bool remembers = !input.own || input.own->builtIn() || input.own->anyLag();
  if (input.log && input.log->time_s().size() > 1) {
    const auto& t = input.log->time_s();
    std::vector<double> steps;
    for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
    log_end = t.back() + std::max(300.0, 2.0 * median(steps));
    if (remembers) gaps = logGaps(t);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double time_s = rows[i].time_s + log_clock_s;
    const bool known = time_s <= log_end && !inGap(gaps, time_s);
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
    if (time_s > log_end) {
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
        fmt::format("only {} of {} observations have a prediction in the simulation{}; allowed: at least half.",
                    usable - out.unmatched, usable,
                    input.why_unmatched.empty() ? "" : " (" + input.why_unmatched + ")"));
  }
  if (out.unmatched > 0) {
    warnings.push_back(fmt::format("{} of {} observations have no prediction in the simulation and are left out{}.",
                                   out.unmatched, usable,
                                   input.why_unmatched.empty() ? "" : ": " + input.why_unmatched));
  }
  if (beyond_log > 0) {
    warnings.push_back(
        fmt::format("{} observations are later than the end of the log and are not fitted.", beyond_log));
  }
  if (const std::size_t count = input.log && remembers ? leaveOutChanges(*input.log, log_clock_s, rows, out.fit) : 0;
      count > 0) {
    warnings.push_back(fmt::format(
        "{} observations lie between two rows of the log of different spindle speed and are not fitted: when it "
        "changed is not known.",
        count));
  }
  if (out.fit.empty()) {
    throw InputError({input.observations.file, ""},
                     "holds no row to be fitted; allowed: at least one with use fit, at a time that the log covers.");
  }
  return out;
}

bool logCovers(const DiscrepancyInput& input, double offset_s) {
  if (!input.log || input.log->time_s().empty()) return true;
  const double from_s = input.log->time_s().front();
  const double to_s = input.log->time_s().back();
  double now = 0.0;
  double moved = 0.0;
  for (const Observation& o : input.observations.rows) {
    if (o.use != ObservationUse::Fit) continue;
    now += o.time_s >= from_s && o.time_s <= to_s ? 1.0 : 0.0;
    moved += o.time_s + offset_s >= from_s && o.time_s + offset_s <= to_s ? 1.0 : 0.0;
  }
  constexpr double most = 0.5;
  return moved > most * now;
}

}  // namespace spindrift
