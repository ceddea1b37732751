// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/math/statistics.h"
#include "core/reporting/plot_picture.h"
#include "core/thermal/response_fit.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/compensated_data.h"

namespace spindrift {
namespace {

std::vector<double> finiteOf(const std::vector<double>& values) {
  std::vector<double> out;
  for (const double v : values)
    if (std::isfinite(v)) out.push_back(v);
  return out;
}

/// Scatter from one recorded value to the next: second differences take out what changes slowly.
double scatterOf(const std::vector<double>& values) {
  const std::vector<double> v = finiteOf(values);
  std::vector<double> d;
  for (std::size_t i = 2; i < v.size(); ++i) d.push_back(std::abs(v[i] - 2.0 * v[i - 1] + v[i - 2]));
  return d.empty() ? 0.0 : 1.4826 * median(d) / std::sqrt(6.0);
}

double deviationOf(const std::vector<double>& values) {
  std::vector<double> v = finiteOf(values);
  const double centre = v.empty() ? 0.0 : mean(v);
  for (double& x : v) x -= centre;
  return v.empty() ? 0.0 : rootMeanSquare(v);
}

/// The column that a name stands for: itself, or the only one that begins with "NAME_".
std::string resolved(const TimeSeries& series, const std::string& name) {
  if (series.find(name) != nullptr) return name;
  std::vector<std::string> fitting;
  for (const Signal& s : series.signals)
    if (s.name.starts_with(name + "_")) fitting.push_back(s.name);
  if (fitting.size() == 1) return fitting.front();
  if (fitting.size() > 1) {
    throw InputError({series.file, ""}, fmt::format("{} may be {}; allowed: the whole name of one column.", name,
                                                    joinedList(fitting, "or")));
  }
  return series.at(name).name;  // throws and names the columns that are there
}

struct Prepared {
  TimeSeries series;
  std::map<std::string, double> sigma;
};

Prepared prepare(const ReplayRequest& request, JobContext& job) {
  if (!std::filesystem::is_directory(request.source)) {
    Prepared log{readTimeSeries(request.source), {}};
    leaveOutCompensated(log.series);
    return log;
  }
  CampaignSeries campaign = campaignSeries(request.source, job);
  return {std::move(campaign.series), std::move(campaign.sigma)};
}

AdaptiveError errorOf(const Prepared& data, const ReplayRequest& request, const std::string& given,
                      std::vector<std::string>& notes) {
  AdaptiveError error;
  error.name = resolved(data.series, given);
  const Signal& signal = data.series.at(error.name);
  const double setup_end = data.series.time_s.front() + request.setup_s;
  std::vector<double> setup;
  std::size_t after = 0;
  for (std::size_t r = 0; r < signal.values.size(); ++r) {
    if (!std::isfinite(signal.values[r])) continue;
    if (data.series.time_s[r] < setup_end) {
      setup.push_back(signal.values[r]);
    } else {
      ++after;
    }
  }
  if (setup.size() < 20 || after < 2) {
    throw InputError({data.series.file, fmt::format("column {}", error.name)},
                     fmt::format("{} values in the setup of {:.4g} h and {} after it; allowed: at least 20 and 2 (give "
                                 "another --setup).",
                                 setup.size(), request.setup_s / 3600.0, after));
  }
  const auto evaluated = data.sigma.find(error.name);
  error.measurement_sigma = request.sigma                   ? *request.sigma
                            : evaluated != data.sigma.end() ? evaluated->second
                                                            : scatterOf(signal.values);
  const double spread = deviationOf(setup);
  if (!(spread > 0.0))
    throw InputError({data.series.file, fmt::format("column {}", error.name)},
                     "does not change in the setup, so no model can be found; allowed: a longer --setup, or an output "
                     "that changes.");
  error.measurement_sigma = std::max(error.measurement_sigma, 1e-3 * spread);
  const auto own = request.limits.find(given);
  const auto all = request.limits.find("");
  error.action_limit = own != request.limits.end()   ? own->second
                       : all != request.limits.end() ? all->second
                                                     : std::max(6.0 * error.measurement_sigma, 0.2 * spread);
  error.trigger_sigma = 0.5 * error.action_limit;
  if (error.action_limit < 3.0 * error.measurement_sigma) {
    notes.push_back(
        fmt::format("The limit of {} is below three measuring uncertainties ({:.3g}): noise alone will "
                    "exceed it.",
                    error.name, error.measurement_sigma));
  }
  return error;
}

ReplayPoint pointOf(double scale, const AdaptiveResult& run) {
  ReplayPoint point{scale, run.measurements, run.reidentifications, {}};
  for (const AdaptiveErrorResult& e : run.errors) point.reduction_percent.push_back(e.adaptive_reduction_percent);
  return point;
}

}  // namespace

ReplayResult replayCompensation(const ReplayRequest& request, JobContext& job) {
  if (request.outputs.empty()) throw InputError("--outputs names no error; allowed: columns separated by commas.");
  const Prepared data = prepare(request, job);
  ReplayResult result;
  result.notes = data.series.notes;
  for (const std::string& name : request.outputs) {
    result.errors.push_back(errorOf(data, request, name, result.notes));
    result.units.push_back(unitOfSignal(result.errors.back().name));
    result.recorded.push_back(data.series.at(result.errors.back().name).values);
  }
  for (const auto& [name, limit] : request.limits) {
    const bool known =
        name.empty() || std::find(request.outputs.begin(), request.outputs.end(), name) != request.outputs.end();
    if (!known) throw InputError(fmt::format("--limit names {}, which is not among --outputs.", name));
  }
  result.inputs = request.inputs;
  if (result.inputs.empty()) result.inputs = automaticInputs(data.series, result.errors.front().name);
  for (std::string& input : result.inputs) {
    input = data.series.at(input).name;
    for (const AdaptiveError& e : result.errors)
      if (e.name == input)
        throw InputError(fmt::format("{} is an output and an input; an error cannot predict itself.", input));
  }
  AdaptiveOptions options;
  options.setup_s = request.setup_s;
  options.setup_interval_s = std::min(request.setup_interval_s, request.setup_s / 20.0);
  options.shortest_interval_s = request.shortest_interval_s;
  options.longest_interval_s = request.longest_interval_s;
  options.add_noise = false;
  result.setup_s = request.setup_s;
  result.setup_end_s = data.series.time_s.front() + request.setup_s;
  result.time_s = data.series.time_s;
  std::vector<double> scales = {1.0};
  for (const double scale : request.curve_scales)
    if (scale != 1.0) scales.push_back(scale);
  std::vector<AdaptiveResult> runs = replayAdaptive(data.series, result.errors, result.inputs, options, scales, job);
  result.run = std::move(runs.front());
  ReplayPoint none{0.0, 0, 0, {}};
  for (const AdaptiveErrorResult& e : result.run.errors) none.reduction_percent.push_back(e.static_reduction_percent);
  result.curve.push_back(std::move(none));
  for (const double scale : request.curve_scales) {
    const auto at = static_cast<std::size_t>(std::find(scales.begin(), scales.end(), scale) - scales.begin());
    result.curve.push_back(pointOf(scale, at == 0 ? result.run : runs[at]));
  }
  std::stable_sort(result.curve.begin(), result.curve.end(),
                   [](const ReplayPoint& a, const ReplayPoint& b) { return a.measurements < b.measurements; });
  return result;
}

bool ReplayResult::goodEnough() const {
  return std::all_of(run.errors.begin(), run.errors.end(), [](const AdaptiveErrorResult& e) {
    return e.rms_adaptive < e.rms_uncompensated && e.rms_adaptive <= e.rms_static;
  });
}

nlohmann::json ReplayResult::json() const {
  nlohmann::json out = {
      {"setup_s", setup_s},
      {"setup_measurements", run.setup_measurements},
      {"measurements", run.measurements},
      {"reidentifications", run.reidentifications},
      {"inputs", inputs},
      {"notes", notes},
      {"sign_convention",
       "compensation = minus the predicted deviation; residual = recorded minus predicted, each in the sign of its "
       "column; a reduction is positive where the rms became smaller, negative where it became larger"}};
  for (std::size_t e = 0; e < errors.size(); ++e) {
    const AdaptiveErrorResult& r = run.errors[e];
    out["outputs"].push_back({{"name", r.name},
                              {"unit", units[e]},
                              {"measurement_sigma", errors[e].measurement_sigma},
                              {"action_limit", errors[e].action_limit},
                              {"rms_uncompensated", jsonNumber(r.rms_uncompensated)},
                              {"rms_static", jsonNumber(r.rms_static)},
                              {"rms_adaptive", jsonNumber(r.rms_adaptive)},
                              {"static_reduction_percent", jsonNumber(r.static_reduction_percent)},
                              {"adaptive_reduction_percent", jsonNumber(r.adaptive_reduction_percent)}});
  }
  out["curve"] = nlohmann::json::array();
  for (const ReplayPoint& p : curve) {
    nlohmann::json reduction = nlohmann::json::object();
    for (std::size_t e = 0; e < errors.size(); ++e) reduction[errors[e].name] = jsonNumber(p.reduction_percent[e]);
    out["curve"].push_back({{"limit_scale", p.scale},
                            {"measurements", p.measurements},
                            {"reidentifications", p.reidentifications},
                            {"reduction_percent", reduction}});
  }
  out["events"] = nlohmann::json::array();
  for (const AdaptiveEvent& e : run.events)
    out["events"].push_back({{"time_s", e.time_s}, {"kind", toString(e.kind)}, {"text", e.text}});
  return out;
}

std::string ReplayResult::summary() const {
  std::string text =
      fmt::format("setup of {:.4g} h with {} measurements; then {} measurements in {:.4g} h, {} identifications\n",
                  setup_s / 3600.0, run.setup_measurements, run.measurements, (time_s.back() - setup_end_s) / 3600.0,
                  run.reidentifications);
  text += fmt::format("  {:<16} {:>14} {:>22} {:>22}\n", "rms (reduction)", "uncompensated", "static", "adaptive");
  for (std::size_t e = 0; e < errors.size(); ++e) {
    const AdaptiveErrorResult& r = run.errors[e];
    text += fmt::format("  {:<16} {:>14.2f} {:>11.2f} ({:>5.1f} %) {:>11.2f} ({:>5.1f} %) {}, limit {:.3g}\n", r.name,
                        printed(r.rms_uncompensated), printed(r.rms_static), printed(r.static_reduction_percent),
                        printed(r.rms_adaptive), printed(r.adaptive_reduction_percent), printedUnit(units[e]),
                        printed(errors[e].action_limit));
  }
  text +=
      "  a reduction is positive where the rms became smaller, negative where compensating made it larger;\n"
      "  compensation = minus the predicted deviation, residual = recorded minus predicted\n"
      "reduction against measurements after the setup:\n";
  for (const ReplayPoint& p : curve) {
    text += fmt::format("  {:4} measurements", p.measurements);
    for (std::size_t e = 0; e < errors.size(); ++e)
      text += fmt::format("{} {} {:.1f} %", e == 0 ? ":" : ",", errors[e].name, printed(p.reduction_percent[e]));
    text += p.scale == 0.0 ? " (static)\n" : fmt::format(" (limits times {:g})\n", p.scale);
  }
  std::size_t exceeded = 0;
  for (const AdaptiveEvent& e : run.events) exceeded += e.kind == AdaptiveEventKind::LimitExceeded ? 1U : 0U;
  text += fmt::format("{} events, the limit exceeded {} times (all in the JSON)\n", run.events.size(), exceeded);
  for (const std::string& n : notes) text += "note: " + n + "\n";
  if (!goodEnough())
    text +=
        "not good enough: an error is larger with the adaptive compensation than without, or than with the static "
        "one\n";
  return text;
}

Drawing ReplayResult::diagram() const {
  std::vector<StackedPlot> plots;
  const double last_h = time_s.back() / 3600.0;
  for (std::size_t e = 0; e < errors.size(); ++e) {
    PlotSeries measured{"uncompensated", {}, {}, {}, SeriesStyle::Points};
    PlotSeries fixed{"residual, static", {}, {}, {}, SeriesStyle::Line};
    PlotSeries adaptive{"residual, adaptive", {}, {}, {}, SeriesStyle::Line};
    const std::size_t stride = std::max<std::size_t>(1, time_s.size() / 6000);
    double zero = std::nan("");
    for (std::size_t r = 0; r < time_s.size(); ++r) {
      const double value = recorded[e][r];
      if (!std::isfinite(value)) continue;
      if (std::isnan(zero)) zero = value;
      if (stride > 1 && r % stride != 0) continue;
      measured.x.push_back(time_s[r] / 3600.0);
      measured.y.push_back(value - zero);
      if (time_s[r] < setup_end_s) continue;
      fixed.x.push_back(time_s[r] / 3600.0);
      fixed.y.push_back(value - run.errors[e].static_prediction[r]);
      adaptive.x.push_back(time_s[r] / 3600.0);
      adaptive.y.push_back(value - run.errors[e].adaptive_prediction[r]);
    }
    PlotOptions options;
    options.title = errors[e].name;
    options.x_label = "time / h";
    options.y_label = units[e].empty() ? errors[e].name : "deviation / " + printedUnit(units[e]);
    options.width_px = 860;
    options.height_px = 260;
    options.ranges = {{time_s.front() / 3600.0, std::min(last_h, setup_end_s / 3600.0), "setup"}};
    plots.push_back({{measured, fixed, adaptive}, options});
  }
  StackedPlot spent;
  for (std::size_t e = 0; e < errors.size(); ++e) {
    PlotSeries line{errors[e].name, {}, {}, {}, SeriesStyle::Line};
    for (const ReplayPoint& p : curve) {
      line.x.push_back(static_cast<double>(p.measurements));
      line.y.push_back(p.reduction_percent[e]);
    }
    spent.series.push_back(std::move(line));
  }
  spent.options.title =
      "reduction of the rms (positive: smaller) against measurements spent after the setup (0: static)";
  spent.options.x_label = "on-machine measurements after the setup";
  spent.options.y_label = "reduction / %";
  spent.options.width_px = 860;
  spent.options.height_px = 280;
  plots.push_back(std::move(spent));
  return plotStack(plots);
}

}  // namespace spindrift
