// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/compensator_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/math/known_values.h"

namespace spindrift {
namespace {

void aboutMean(std::vector<double>& values) {
  const double mean = meanOfKnown(values);
  for (double& v : values) v -= mean;
}

double rmsAboutMean(const std::vector<double>& time_s, const std::vector<double>& values, const TimeRange& range) {
  std::vector<double> within;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (time_s[i] >= range.from_s && time_s[i] <= range.to_s) within.push_back(values[i]);
  }
  aboutMean(within);
  return rootMeanSquareOfKnown(within);
}

}  // namespace

CompensatorRun runCompensator(const TimeSeries& series, const ThermalModel& model, const TimeRange& test,
                              const JobContext& job) {
  CompensatorRun run;
  run.result = compensateLog(series, model, {}, job);
  run.test = test;
  run.time_s = series.time_s;
  if (run.result.outputs.empty()) throw InputError("the model has no output to compensate.");
  const CompensateResult::Output& output = run.result.outputs.front();
  run.output = output.name;
  const Signal* measured = series.find(output.name);
  if (measured == nullptr) throw InputError(fmt::format("the log has no column {} that the model is of.", output.name));
  run.measured = measured->values;
  run.left = measured->values;
  const std::size_t last = output.compensation.size() - 1;
  for (std::size_t i = 0; i < run.left.size(); ++i) {
    const double cycle = (series.time_s[i] - series.time_s.front()) / run.result.cycle_s;
    run.left[i] += output.compensation[std::min(last, static_cast<std::size_t>(cycle + 0.5))];
  }
  run.before_rms = rmsAboutMean(run.time_s, run.measured, test);
  run.after_rms = rmsAboutMean(run.time_s, run.left, test);
  aboutMean(run.measured);
  aboutMean(run.left);
  return run;
}

TimeRange judgedRange(const std::optional<TimeRange>& chosen, const TimeSeries& series) {
  if (chosen) return *chosen;
  return {std::round(0.5 * (series.time_s.front() + series.time_s.back())), series.time_s.back()};
}

}  // namespace spindrift
