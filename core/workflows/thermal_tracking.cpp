// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_tracking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/math/statistics.h"
#include "core/reporting/plot_picture.h"
#include "core/workflows/compensated_data.h"

namespace spindrift {
namespace {

/// rms about one constant: deviations are known up to one.
double rmsAbout(double constant, const std::vector<double>& values) {
  std::vector<double> finite;
  for (const double v : values)
    if (std::isfinite(v)) finite.push_back(v - constant);
  return finite.empty() ? std::nan("") : rootMeanSquare(finite);
}

/// The free constant of a deviation: its mean over the rows that trained the model, over all where none did. What has
/// moved since then is an error of the compensation.
double constantOf(const std::vector<double>& values, const std::vector<char>& trained) {
  std::vector<double> in;
  std::vector<double> all;
  for (std::size_t r = 0; r < values.size(); ++r) {
    if (!std::isfinite(values[r])) continue;
    all.push_back(values[r]);
    if (trained[r] != 0) in.push_back(values[r]);
  }
  if (all.empty()) return 0.0;
  return in.empty() ? mean(all) : mean(in);
}

/// Whether both are one log: the same file, or another with the same content. Where the first is gone, its name says
/// it.
bool sameLog(const std::string& source, const std::filesystem::path& file) {
  if (file.empty()) return true;
  std::error_code error;
  if (!std::filesystem::is_regular_file(source, error))
    return std::filesystem::path(source).filename() == file.filename();
  if (std::filesystem::equivalent(source, file, error)) return true;
  return std::filesystem::file_size(source, error) == std::filesystem::file_size(file, error) &&
         readFile(source) == readFile(file);
}

/// The finite values of the rows that trained nothing.
std::vector<double> unseenOf(const std::vector<double>& values, const std::vector<char>& trained) {
  std::vector<double> unseen;
  for (std::size_t r = 0; r < values.size(); ++r) {
    if (trained[r] == 0 && std::isfinite(values[r])) unseen.push_back(values[r]);
  }
  return unseen;
}

/// Columns scaled to -1 ... 1 by their range over the record.
std::vector<std::vector<double>> contextOf(const TimeSeries& series, const TrackRequest& request) {
  if (!request.context.empty() && request.update != UpdateKind::Kalman)
    throw InputError("--context belongs to --update kalman; the other updates know no context.");
  std::vector<std::vector<double>> out;
  for (const std::string& name : request.context) {
    const Signal& signal = series.at(name);
    if (signal.kind == SignalKind::Displacement)
      throw InputError({series.file, fmt::format("column {}", name)},
                       "is a displacement and cannot be a --context; allowed: positions, speeds, temperatures.");
    std::vector<double> values = bridged(series.time_s, signal.values, holdsUntilNextRow(signal.kind));
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double middle = 0.5 * (*low + *high);
    const double half = 0.5 * (*high - *low);
    if (!(half > 0.0))
      throw InputError({series.file, fmt::format("column {}", name)},
                       "never changes, so no gain can depend on it; allowed: a --context that changes.");
    for (double& v : values) v = (v - middle) / half;
    out.push_back(std::move(values));
  }
  return out;
}

}  // namespace

TrackResult trackThermalModel(const TrackRequest& request, const JobContext& job) {
  return trackThermalModel(readTimeSeries(request.log), ThermalModel::read(request.model), request, job);
}

TrackResult trackThermalModel(const TimeSeries& all, const ThermalModel& model, const TrackRequest& request,
                              const JobContext& job) {
  if (!(request.interval_s > 0.0)) throw InputError("--interval must be positive, in s.");
  TimeSeries series = all;
  leaveOutCompensated(series);
  TrackResult result;
  result.output = request.output.empty() ? model.outputs.front().name : request.output;
  const ThermalOutput* output = model.findOutput(result.output);
  if (output == nullptr)
    throw InputError({request.model, ""},
                     fmt::format("the model has no output {}; found: {}.", result.output, model.outputs.front().name));
  if (output->terms.empty())
    throw InputError(
        {request.model, ""},
        "the model has no time constants (an ARX model with complex poles); identify with --method response or oe.");
  result.unit = output->unit;
  const ThermalPrediction prediction = model.predict(series, static_cast<std::size_t>(output - model.outputs.data()));
  result.notes = prediction.notes;
  if (series.notes.size() > all.notes.size()) result.notes.push_back(series.notes.back());
  result.time_s = series.time_s;
  result.measured = series.at(result.output).values;
  result.simulated = prediction.value;
  const bool goes_on =
      series.time_s.back() > model.train_to_s + request.interval_s && series.time_s.front() <= model.train_to_s;
  result.from_s = request.from_s.value_or(goes_on ? model.train_to_s : series.time_s.front());
  UpdateOptions options;
  options.kind = request.update;
  options.interval_s = request.interval_s;
  options.start_s = result.from_s;
  options.measurement_sigma = request.measurement_sigma;
  if (request.gain_bound > 0.0) options.gain_bound = request.gain_bound;
  double slowest = 0.0;
  for (const LagTerm& term : output->terms) slowest = std::max(slowest, term.tau_s);
  if (slowest > 0.0) options.slowest_tau_s = slowest;
  options.offset_sigma =
      std::max(2.0 * output->uncertainty_factor * output->noise_sigma, 4.0 * request.measurement_sigma);
  options.context = contextOf(series, request);
  result.run = runWithUpdates(result.time_s, result.measured, result.simulated, options);
  if (request.update == UpdateKind::Kalman) {
    const auto refused = [](const UpdateEvent& e) { return !e.used; };
    const auto first = std::find_if(result.run.events.begin(), result.run.events.end(), refused);
    if (first != result.run.events.end())
      result.notes.push_back(
          fmt::format("{} of {} measurements were more than {:.0f} standard uncertainties off the prediction and were "
                      "not used, the "
                      "first at {:.6g} s ({:.2f} off); a second one in a row on the same side would have been.",
                      std::count_if(first, result.run.events.end(), refused), result.run.events.size(),
                      options.gate_sigma, first->time_s, first->measured - first->predicted_before));
  }
  const TimeRange judged{result.from_s, 1e300};
  result.without = runQuality(result.time_s, result.measured, result.simulated, judged);
  result.with = runQuality(result.time_s, result.measured, result.run.predicted, judged);
  if (result.with.samples == 0)
    throw InputError({request.log, ""},
                     fmt::format("no value of {} is measured from {:.6g} s on.", result.output, result.from_s));
  job.throwIfCancelled();
  for (double t = result.from_s; t < series.time_s.back(); t += request.interval_s) {
    const TimeRange range{t, t + request.interval_s};
    const RunQuality q = runQuality(result.time_s, result.measured, result.run.predicted, range);
    if (q.samples > 0) result.intervals.emplace_back(range, q);
    if (result.intervals.size() >= 10000) break;
  }
  result.sweep = sweepIntervals(result.time_s, result.measured, result.simulated, options,
                                {1800.0, 3600.0, 5400.0, 7200.0, 9000.0, 10800.0});
  if (request.update == UpdateKind::Gain && result.with.p2p > result.without.p2p) {
    result.notes.push_back(
        "The gain update made the largest errors worse: the ratio measured / simulated is meaningless where the "
        "simulation is near zero; use --update "
        "kalman, or bound the gain.");
  }
  return result;
}

nlohmann::json TrackResult::json() const {
  nlohmann::json out = {{"output", output},
                        {"unit", unit},
                        {"from_s", from_s},
                        {"fit_percent", jsonNumber(with.fit_percent)},
                        {"p2p", jsonNumber(with.p2p)},
                        {"rmse", jsonNumber(with.rmse)},
                        {"without_update", without.json()},
                        {"notes", notes},
                        {"measurements", run.events.size()}};
  out["intervals"] = nlohmann::json::array();
  for (const auto& [range, q] : intervals) {
    nlohmann::json entry = q.json();
    entry["from_s"] = range.from_s;
    entry["to_s"] = range.to_s;
    out["intervals"].push_back(entry);
  }
  out["sweep"] = nlohmann::json::array();
  for (const IntervalPoint& p : sweep) {
    out["sweep"].push_back({{"interval_s", jsonNumber(p.interval_s)},
                            {"fit_percent", jsonNumber(p.fit_percent)},
                            {"p2p", jsonNumber(p.p2p)},
                            {"rmse", jsonNumber(p.rms)},
                            {"measurements", p.measurements}});
  }
  out["updates"] = nlohmann::json::array();
  for (const UpdateEvent& e : run.events) {
    out["updates"].push_back({{"time_s", e.time_s},
                              {"measured", e.measured},
                              {"predicted_before", e.predicted_before},
                              {"gain", e.gain},
                              {"offset", e.offset},
                              {"gain_standard_uncertainty", e.gain_sigma},
                              {"offset_standard_uncertainty", e.offset_sigma},
                              {"used", e.used}});
  }
  return out;
}

std::string TrackResult::summary() const {
  std::string text = fmt::format("{} from {:.6g} s, {} measurements\n", output, from_s, run.events.size());
  text += fmt::format("  without update: fit {:7.1f} %  p2p {:8.2f} {}  rms {:8.3f}\n", printed(without.fit_percent),
                      printed(without.p2p), printedUnit(unit), printed(without.rmse));
  text += fmt::format("  with updates:   fit {:7.1f} %  p2p {:8.2f} {}  rms {:8.3f}\n", printed(with.fit_percent),
                      printed(with.p2p), printedUnit(unit), printed(with.rmse));
  for (const IntervalPoint& p : sweep) {
    text += std::isfinite(p.interval_s) ? fmt::format("  every {:4.0f} min", p.interval_s / 60.0)
                                        : std::string("  never         ");
    text += fmt::format(": fit {:7.1f} %  p2p {:8.2f}  rms {:8.3f}\n", printed(p.fit_percent), printed(p.p2p),
                        printed(p.rms));
  }
  for (const std::string& n : notes) text += "note: " + n + "\n";
  return text;
}

Drawing TrackResult::diagram() const {
  PlotSeries truth{"measured", {}, {}, {}, SeriesStyle::Line};
  PlotSeries free{"without update", {}, {}, {}, SeriesStyle::Line};
  PlotSeries updated{"with updates", {}, {}, {}, SeriesStyle::Line};
  const std::size_t stride = std::max<std::size_t>(1, time_s.size() / 4000);
  for (std::size_t r = 0; r < time_s.size(); r += stride) {
    if (time_s[r] < from_s) continue;
    for (const auto& [series, value] :
         {std::pair{&truth, measured[r]}, {&free, simulated[r]}, {&updated, run.predicted[r]}}) {
      series->x.push_back(time_s[r] / 3600.0);
      series->y.push_back(value);
    }
  }
  PlotOptions over_time{.title = output,
                        .x_label = "time / h",
                        .y_label = "deviation / " + printedUnit(unit),
                        .width_px = 860,
                        .height_px = 280};
  PlotOptions over_interval = over_time;
  over_interval.x_label = "interval of the on-machine measurements / min";
  StackedPlot fit{{}, over_interval};
  StackedPlot p2p{{}, over_interval};
  fit.options.title = "fit against the interval";
  fit.options.y_label = "fit / %";
  p2p.options.title = "peak to peak against the interval";
  p2p.options.y_label = "p2p / " + printedUnit(unit);
  p2p.options.y_from = 0.0;
  fit.series =
      p2p.series = {{"without update", {}, {}, {}, SeriesStyle::Line}, {"with updates", {}, {}, {}, SeriesStyle::Line}};
  for (const IntervalPoint& p : sweep) {
    if (!std::isfinite(p.interval_s)) continue;
    for (const auto& [plot, never, value] :
         {std::tuple{&fit, without.fit_percent, p.fit_percent}, std::tuple{&p2p, without.p2p, p.p2p}}) {
      plot->series[0].x.push_back(p.interval_s / 60.0);
      plot->series[0].y.push_back(never);
      plot->series[1].x.push_back(p.interval_s / 60.0);
      plot->series[1].y.push_back(value);
    }
  }
  return plotStack({{{truth, free, updated}, over_time}, fit, p2p});
}

void TrackResult::writePrediction(const std::filesystem::path& file) const {
  std::string text = "time_s,measured,simulated,predicted,sigma\n";
  for (std::size_t r = 0; r < time_s.size(); ++r) {
    text += exactNumber(time_s[r]) + ',' + (std::isfinite(measured[r]) ? exactNumber(measured[r]) : std::string()) +
            ',' + exactNumber(simulated[r]) + ',' + exactNumber(run.predicted[r]) + ',' +
            (r < run.sigma.size() ? exactNumber(run.sigma[r]) : std::string()) + '\n';
  }
  writeFileAtomically(file, text);
}

CompensateResult compensateLog(const CompensateRequest& request, const JobContext& job) {
  return compensateLog(readTimeSeries(request.log), ThermalModel::read(request.model), request, job);
}

CompensateResult compensateLog(const TimeSeries& series, const ThermalModel& model, const CompensateRequest& request,
                               const JobContext& job) {
  CompensateResult result;
  result.cycle_s = request.cycle_s > 0.0 ? request.cycle_s : series.medianPeriod_s();
  if (!(result.cycle_s > 0.0))
    throw InputError({request.log, ""}, "has a single row, so the cycle time is unknown; give --cycle.");
  Compensator compensator;
  // A replay shows what would have come of it, also of a model that no control may load; the warnings say so.
  CompensatorLimits limits = request.limits;
  limits.forced = true;
  const std::string problem = compensator.load(model, result.cycle_s, limits);
  if (!problem.empty()) throw InputError({request.model, ""}, problem);
  for (const ThermalOutput& output : model.outputs) {
    if (!output.verdict || output.verdict->good_enough) continue;
    result.warnings.push_back(
        fmt::format("The model of {} was called not good enough when it was identified ({}); do not use this "
                    "compensation on a machine.",
                    output.name, output.verdict->reason.empty() ? "no reason given" : output.verdict->reason));
    result.forced = true;
  }
  std::vector<const Signal*> inputs;
  for (int i = 0; i < compensator.inputCount(); ++i) inputs.push_back(&series.at(compensator.inputName(i)));
  const auto steps =
      static_cast<std::size_t>((series.time_s.back() - series.time_s.front()) / result.cycle_s + 1e-9) + 1;
  if (steps > 20'000'000)
    throw InputError(fmt::format("{} cycles are too many to replay; give a longer --cycle.", steps));
  for (int o = 0; o < compensator.outputCount(); ++o) result.outputs.emplace_back().name = compensator.outputName(o);
  std::vector<double> u(inputs.size());
  std::vector<double> age(inputs.size());
  std::vector<double> out(result.outputs.size());
  std::vector<std::size_t> next(inputs.size(), 0);
  std::vector<double> seen(inputs.size(), -1e300);
  // Rows are what a log keeps of values that a controller has all the time: between two of them nothing is stale, as
  // long as neither lacks a value and they are no further apart than rows are.
  constexpr double rows_apart = 3.0;
  const double longest_s = std::max(request.limits.stale_after_s, rows_apart * series.medianPeriod_s());
  for (std::size_t k = 0; k < steps; ++k) {
    const double t = series.time_s.front() + static_cast<double>(k) * result.cycle_s;
    // The controller sees the last row at or before now: its value and its age.
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      while (next[i] < series.time_s.size() && series.time_s[next[i]] <= t + 1e-9) {
        if (std::isfinite(inputs[i]->values[next[i]])) {
          u[i] = inputs[i]->values[next[i]];
          seen[i] = series.time_s[next[i]];
        }
        ++next[i];
      }
      const std::size_t after = std::min(next[i], series.time_s.size() - 1);
      const bool between =
          next[i] > 0 && seen[i] == series.time_s[next[i] - 1] && series.time_s[after] - seen[i] <= longest_s;
      age[i] = between ? 0.0 : std::max(0.0, t - seen[i]);
    }
    const CompensatorState state = compensator.step(u.data(), age.data(), out.data());
    result.holding += state == CompensatorState::Holding;
    result.fallback += state == CompensatorState::Fallback;
    result.time_s.push_back(t);
    for (std::size_t o = 0; o < out.size(); ++o) result.outputs[o].compensation.push_back(out[o]);
    if (k % 10000 == 0) job.report(static_cast<double>(k) / static_cast<double>(steps), "compensating");
  }
  constexpr std::size_t per_worth_saying = 100;
  if (result.fallback * per_worth_saying > steps)
    result.warnings.push_back(fmt::format(
        "In {} of {} cycles the compensation faded to zero or stood there, for an input was missing, older than {:g} s "
        "or outside its range: what it achieves includes these.",
        result.fallback, steps, limits.stale_after_s));
  // Times mean the same rows only in the log that the model was identified from.
  const bool same_log = sameLog(model.source, series.file);
  std::vector<char> trained(series.time_s.size(), 0);
  std::size_t count = 0;
  for (std::size_t r = 0; r < trained.size() && same_log; ++r) {
    // A range up to the end of the record holds its last row.
    const bool before_end = series.time_s[r] < model.train_to_s || model.train_to_s >= series.time_s.back();
    trained[r] = series.time_s[r] >= model.train_from_s && before_end ? 1 : 0;
    count += trained[r] != 0 ? 1U : 0U;
  }
  const std::string from_log = model.source.empty() ? "another log" : model.source;
  if (!same_log) {
    result.unseen = fmt::format("the model was identified from {}, so no row of this log trained it", from_log);
  } else if (count == trained.size()) {
    result.unseen = "every row of this log trained the model: what it does on others is not known";
  } else {
    result.unseen = fmt::format("rows outside {:.6g} to {:.6g} s, where the model was identified", model.train_from_s,
                                model.train_to_s);
  }
  for (CompensateResult::Output& output : result.outputs) {
    for (const double v : output.compensation) output.largest = std::max(output.largest, std::abs(v));
    output.rms_before = output.rms_after = output.reduction_percent = std::nan("");
    const Signal* measured = series.find(output.name);
    if (measured == nullptr) continue;
    std::vector<double> after(series.time_s.size(), std::nan(""));
    for (std::size_t r = 0; r < after.size(); ++r) {
      const auto k = std::min(
          steps - 1, static_cast<std::size_t>((series.time_s[r] - series.time_s.front()) / result.cycle_s + 0.5));
      after[r] = measured->values[r] + output.compensation[k];
    }
    const double constant_before = constantOf(measured->values, trained);
    const double constant_after = constantOf(after, trained);
    output.rms_before = rmsAbout(constant_before, measured->values);
    output.rms_after = rmsAbout(constant_after, after);
    output.reduction_percent = 100.0 * (1.0 - output.rms_after / output.rms_before);
    CompensateResult::Output::Unseen& unseen = output.unseen;
    const std::vector<double> before = unseenOf(measured->values, trained);
    unseen.rows = before.size();
    unseen.rms_before = rmsAbout(constant_before, before);
    unseen.rms_after = rmsAbout(constant_after, unseenOf(after, trained));
    unseen.reduction_percent = 100.0 * (1.0 - unseen.rms_after / unseen.rms_before);
  }
  return result;
}

bool CompensateResult::Output::worse() const noexcept {
  return std::isfinite(unseen.reduction_percent) ? unseen.rms_after >= unseen.rms_before : rms_after >= rms_before;
}

nlohmann::json CompensateResult::json() const {
  nlohmann::json out = {
      {"cycle_s", cycle_s},
      {"steps", time_s.size()},
      {"holding_steps", holding},
      {"fallback_steps", fallback},
      {"warnings", warnings},
      {"forced", forced},
      {"unseen", unseen},
      {"sign_convention",
       "compensation = minus the predicted deviation, to be added to the command; deviation = actual minus commanded, "
       "as "
       "the log measures it; rms_after is of measured deviation plus compensation, both about their mean over the rows "
       "that trained the model (over all rows where none did); reduction_percent is positive where the rms became "
       "smaller"}};
  for (const Output& o : outputs) {
    out["outputs"].push_back({{"name", o.name},
                              {"rms_before", jsonNumber(o.rms_before)},
                              {"rms_after", jsonNumber(o.rms_after)},
                              {"reduction_percent", jsonNumber(o.reduction_percent)},
                              {"unseen",
                               {{"rows", o.unseen.rows},
                                {"rms_before", jsonNumber(o.unseen.rms_before)},
                                {"rms_after", jsonNumber(o.unseen.rms_after)},
                                {"reduction_percent", jsonNumber(o.unseen.reduction_percent)}}},
                              {"largest_compensation", o.largest}});
  }
  return out;
}

std::string CompensateResult::summary() const {
  std::string text = fmt::format("{} cycles of {:.6g} s, {} on held inputs, {} in fall-back\n", time_s.size(), cycle_s,
                                 holding, fallback);
  for (const Output& o : outputs) {
    text += fmt::format("  {}: ", o.name);
    if (std::isfinite(o.unseen.reduction_percent)) {
      text += fmt::format("rms {:.3f} before, {:.3f} after ({:.0f} % {}) on rows not used for fitting, ",
                          o.unseen.rms_before, o.unseen.rms_after, std::abs(o.unseen.reduction_percent),
                          o.unseen.reduction_percent < 0.0 ? "more" : "less");
    }
    if (std::isfinite(o.reduction_percent)) {
      text +=
          fmt::format("{:.3f} before, {:.3f} after over all rows (about the mean of the rows that trained the model), ",
                      o.rms_before, o.rms_after);
    } else {
      text += "not measured in this log, ";
    }
    text += fmt::format("largest compensation {:.2f}\n", o.largest);
  }
  text += fmt::format("{}\n", unseen);
  text += "compensation = minus the predicted deviation, to be added to the command\n";
  return text;
}

void CompensateResult::write(const std::filesystem::path& file) const {
  std::string text = "time_s";
  for (const Output& o : outputs) text += "," + csvField("compensation_" + o.name);
  text += '\n';
  for (std::size_t k = 0; k < time_s.size(); ++k) {
    text += exactNumber(time_s[k]);
    for (const Output& o : outputs) text += ',' + exactNumber(o.compensation[k]);
    text += '\n';
  }
  writeFileAtomically(file, text);
}

}  // namespace spindrift
