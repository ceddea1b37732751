// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/machine/observation.h"
#include "core/machine/operating_log.h"
#include "core/machine/sensor_role.h"
#include "core/reporting/plot_picture.h"
#include "core/thermal/time_series.h"

namespace spindrift {
namespace {

/// Curves over hours; of long records every n-th row, so that some 2000 are drawn.
Drawing drawCurves(const std::string& title, const std::vector<PlotSeries>& curves) {
  std::vector<PlotSeries> drawn = curves;
  for (PlotSeries& c : drawn) {
    const std::size_t stride = std::max<std::size_t>(1, c.x.size() / 2000);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < c.x.size(); i += stride, ++kept) {
      c.x[kept] = c.x[i] / 3600.0;
      c.y[kept] = c.y[i];
    }
    c.x.resize(kept);
    c.y.resize(kept);
  }
  PlotOptions options;
  options.title = title;
  options.x_label = "time / h";
  options.y_label = "change / µm, µrad";
  options.width_px = 860;
  options.height_px = 400;
  return plotPicture(drawn, options);
}

Iso230Result evaluateAxis(const Iso230Request& request) {
  const ObservationSet set = ObservationSet::read(request.observations);
  static constexpr std::array<const char*, 3> axes = {"X", "Y", "Z"};
  const auto found = std::find(axes.begin(), axes.end(), request.axis);
  if (found == axes.end())
    throw InputError(fmt::format("--axis \"{}\" is not a linear axis; allowed: X, Y, Z.", request.axis));
  const auto index = static_cast<int>(found - axes.begin());
  std::vector<AxisReading> readings;
  std::size_t without_direction = 0;
  for (const Observation& o : set.rows) {
    if (o.use == ObservationUse::Exclude || isRotation(o.component) || axisIndex(o.component) != index) continue;
    without_direction += o.approach[index] == 0.0 ? 1 : 0;
    readings.push_back({o.time_s, o.position_mm[index], o.value, o.approach[index] < 0.0 ? -1 : 1, o.point, o.sigma});
  }
  if (readings.empty()) {
    throw InputError(
        {request.observations, "column component"},
        fmt::format("there is no reading of E{}; allowed: readings of the axis at two positions.", request.axis));
  }
  if (without_direction != 0 && without_direction != readings.size()) {
    throw InputError({request.observations, fmt::format("column dir_{}", "xyz"[index])},
                     fmt::format("{} of {} readings of E{} have no direction of approach; allowed: one for every "
                                 "reading, or for none.",
                                 without_direction, readings.size(), request.axis));
  }
  Iso230Result result;
  result.test = "axis";
  try {
    result.axis = evaluateMovingAxis(std::move(readings));
  } catch (const InputError& e) {
    throw InputError({request.observations, "column component"}, e.sentence());
  }
  result.diagram =
      drawCurves("Thermal distortion caused by motion of axis " + request.axis + ", µm",
                 {{"expansion", result.axis->time_s, result.axis->expansion_over_time_um, {}, SeriesStyle::Line}});
  return result;
}

}  // namespace

Iso230Result evaluateIso230Test(const Iso230Request& request, const JobContext& job) {
  job.throwIfCancelled();
  if (request.test == "axis") {
    if (request.observations.empty())
      throw InputError("the axis test needs --observations with the readings at both ends.");
    return evaluateAxis(request);
  }
  if (request.test != "etve" && request.test != "spindle") {
    throw InputError(fmt::format("test \"{}\" is not known; allowed: etve, spindle, axis.", request.test));
  }
  if (request.log.empty()) throw InputError("the test needs a log with displacements over time.");
  return evaluateIso230Test(readTimeSeries(request.log), request);
}

namespace {

TimeSeries seriesWithin(const TimeSeries& series, const TimeRange& range) {
  TimeSeries part;
  part.file = series.file;
  part.notes = series.notes;
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < series.time_s.size(); ++r) {
    if (series.time_s[r] < range.from_s || series.time_s[r] >= range.to_s) continue;
    rows.push_back(r);
    part.time_s.push_back(series.time_s[r]);
  }
  if (rows.empty()) {
    throw InputError({series.file, "column time_s"},
                     fmt::format("no row lies from {:g} to {:g} s; allowed: a part of {:g} to {:g} s.", range.from_s,
                                 range.to_s, series.time_s.front(), series.time_s.back()));
  }
  for (const Signal& signal : series.signals) {
    Signal cut = signal;
    cut.values.clear();
    for (const std::size_t r : rows) cut.values.push_back(signal.values[r]);
    part.signals.push_back(std::move(cut));
  }
  return part;
}

/// The column asked for, else that of the spindle by its name, else the only one there is. Throws InputError.
const Signal* speedOf(const TimeSeries& series, const std::string& asked) {
  if (!asked.empty()) return &series.at(asked);
  std::vector<std::string> names;
  const Signal* only = nullptr;
  for (const Signal& s : series.signals) {
    if (s.kind != SignalKind::Speed) continue;
    if (s.name == "spindle_rpm") return &s;
    names.push_back(s.name);
    only = &s;
  }
  if (names.empty())
    throw InputError({series.file, "header"}, "there is no speed column (..._rpm); allowed: spindle_rpm.");
  if (names.size() > 1)
    throw InputError({series.file, "header"},
                     fmt::format("which of {} is the speed of the spindle is not known; allowed: a column spindle_rpm, "
                                 "or --speed with one of them.",
                                 joinedList(names)));
  return only;
}

}  // namespace

std::string standardTestIn(const TimeSeries& series) {
  bool moves = false;
  for (const Signal& s : series.signals) {
    if (s.kind == SignalKind::Feed)
      moves = moves || std::any_of(s.values.begin(), s.values.end(), [](double v) { return v > 0.0; });
    if (s.kind != SignalKind::Speed) continue;
    std::size_t starts = 0, running = 0;
    double first = 0.0, last = 0.0;
    for (std::size_t i = 0; i < s.values.size(); ++i) {
      const bool on = s.values[i] > 0.0;
      if (on && (i == 0 || !(s.values[i - 1] > 0.0))) ++starts;
      if (!on) continue;
      if (running++ == 0) first = series.time_s[i];
      last = series.time_s[i];
    }
    if (starts == 1 && last - first >= 1800.0) return "spindle";
    moves = moves || running > 0;
  }
  return moves ? std::string() : std::string("etve");
}

namespace {

std::vector<ComponentSeries> componentsOf(const TimeSeries& series, const Iso230Request& request) {
  std::vector<ComponentSeries> components;
  for (const Signal& s : series.signals) {
    if (!request.columns.empty() || s.kind != SignalKind::Displacement) continue;
    components.push_back({s.name, unitOfSignal(s.name), s.values, 0.0});
  }
  for (const std::string& name : request.columns)
    components.push_back({name, unitOfSignal(name), series.at(name).values, 0.0});
  return components;
}

Drawing diagramOf(const TimeSeries& series, const std::vector<ComponentSeries>& components, const std::string& test) {
  std::vector<PlotSeries> curves;
  for (const ComponentSeries& c : components) {
    PlotSeries curve{c.name, series.time_s, c.values, {}, SeriesStyle::Line};
    // What is measured along an axis has its colour; tilts follow the palette.
    const std::size_t axis = c.unit == "um" && c.name.size() > 1 && c.name[1] == '_'
                                 ? std::string("XYZ").find(c.name[0])
                                 : std::string::npos;
    if (axis != std::string::npos) curve.dress(axisLook(static_cast<int>(axis)));
    curves.push_back(std::move(curve));
  }
  return drawCurves(test == "etve" ? "Environmental temperature variation error (ETVE), µm or µrad"
                                   : "Thermal distortion caused by the rotating spindle, µm or µrad",
                    curves);
}

}  // namespace

Drawing diagramOfIso230Test(const TimeSeries& whole, const Iso230Request& request) {
  const TimeSeries series = request.range ? seriesWithin(whole, *request.range) : whole;
  return diagramOf(series, componentsOf(series, request), request.test);
}

Iso230Result evaluateIso230Test(const TimeSeries& whole, const Iso230Request& request) {
  const TimeSeries series = request.range ? seriesWithin(whole, *request.range) : whole;
  Iso230Result result;
  result.test = request.test;
  result.notes = series.notes;
  const std::vector<ComponentSeries> components = componentsOf(series, request);
  if (request.test == "etve") {
    const std::vector<std::string> at_rest = requireMachineAtRest(series);
    result.notes.insert(result.notes.end(), at_rest.begin(), at_rest.end());
    std::string ambient = request.ambient;
    for (const Signal& s : series.signals) {
      if (ambient.empty() && !request.without_ambient && OperatingLog::isTemperature(s.name) &&
          readSensorRole(s.name) == SensorRole::Room) {
        ambient = s.name;
        result.notes.push_back(ambient + " is taken for the ambient temperature by its name; --ambient names another.");
      }
    }
    if (ambient.empty() && !request.without_ambient)
      result.notes.push_back("No ambient temperature was named (--ambient): nothing is given per K.");
    result.etve =
        evaluateEtve(series.time_s, components,
                     ambient.empty() ? std::span<const double>{} : std::span<const double>(series.at(ambient).values),
                     request.window_s);
    if (!result.etve->note.empty()) result.notes.push_back(result.etve->note);
  } else {
    const Signal* speed = speedOf(series, request.speed);
    const std::vector<double> rpm = bridged(series.time_s, speed->values, true);
    if (std::string note = requireOneSpeedStep(series, speed->name, rpm); !note.empty()) result.notes.push_back(note);
    result.spindle = evaluateRotatingSpindle(series.time_s, rpm, components, request.fraction, request.window_s);
  }
  result.diagram = diagramOf(series, components, request.test);
  return result;
}

StandardTest standardTestOf(const TimeSeries& series, const AskedTest& asked) {
  StandardTest out;
  try {
    if (series.time_s.size() < 2) throw InputError("the log has a single row.");
    Iso230Request request = asked(series);
    if (request.test.empty()) request.test = "etve";
    out.result.test = request.test;
    out.result = evaluateIso230Test(series, request);
  } catch (const InputError& e) {
    out.why_not = e.what();
  }
  return out;
}

nlohmann::json StandardTest::json() const {
  nlohmann::json out = result.json();
  out["status"] = toString(why_not.empty() ? FitStatus::Converged : FitStatus::Degenerate);
  out["message"] = why_not;
  return out;
}

nlohmann::json Iso230Result::json() const {
  nlohmann::json out = {{"test", test}, {"notes", notes}};
  if (etve) {
    out["duration_s"] = etve->duration_s;
    out["window_s"] = etve->window_s;
    out["temperature_range_K"] = etve->temperature_range_K;
    out["temperature_range_standard_uncertainty_K"] = etve->temperature_range_sigma_K;
    for (const EtveComponent& c : etve->components) {
      out["components"].push_back({{"name", c.name},
                                   {"unit", c.unit},
                                   {"range", c.range},
                                   {"range_standard_uncertainty", c.range_sigma},
                                   {"range_per_K", jsonNumber(c.range_per_K)},
                                   {"range_per_K_standard_uncertainty", jsonNumber(c.range_per_K_sigma)},
                                   {"slope_per_K", jsonNumber(c.slope_per_K)},
                                   {"slope_standard_uncertainty", jsonNumber(c.slope_sigma)}});
    }
  }
  if (spindle) {
    out["start_s"] = spindle->start_s;
    out["stop_s"] = spindle->stop_s;
    out["fraction"] = spindle->fraction;
    out["window_s"] = spindle->window_s;
    for (const SpindleComponent& c : spindle->components) {
      out["components"].push_back({{"name", c.name},
                                   {"unit", c.unit},
                                   {"first_hour", jsonNumber(c.first_hour)},
                                   {"first_hour_standard_uncertainty", jsonNumber(c.first_hour_sigma)},
                                   {"at_end", jsonNumber(c.at_end)},
                                   {"standard_uncertainty", c.change_sigma},
                                   {"range", c.range},
                                   {"range_standard_uncertainty", c.range_sigma},
                                   {"first_hour_range", jsonNumber(c.first_hour_range)},
                                   {"first_hour_range_standard_uncertainty", jsonNumber(c.first_hour_range_sigma)},
                                   {"time_to_fraction_s", jsonNumber(c.time_to_fraction_s)},
                                   {"after_cooling", jsonNumber(c.after_cooling)},
                                   {"after_cooling_standard_uncertainty", jsonNumber(c.after_cooling_sigma)}});
    }
  }
  if (axis) {
    for (const AxisPositionResult* p : {&axis->low, &axis->high}) {
      out["positions"].push_back({{"position_mm", p->position_mm},
                                  {"change_um", p->change_um},
                                  {"standard_uncertainty_um", p->change_sigma_um},
                                  {"range_um", p->range_um},
                                  {"repeatability_um", p->repeatability_um},
                                  {"repeatability_standard_uncertainty_um", jsonNumber(p->repeatability_sigma_um)},
                                  {"reversal_um", jsonNumber(p->reversal_um)},
                                  {"reversal_standard_uncertainty_um", jsonNumber(p->reversal_sigma_um)},
                                  {"readings", p->readings}});
    }
    out["expansion_um"] = axis->expansion_um;
    out["expansion_standard_uncertainty_um"] = axis->expansion_sigma_um;
    out["expansion_um_per_m"] = axis->expansion_um_per_m;
    out["time_s"] = axis->time_s;
    out["expansion_over_time_um"] = axis->expansion_over_time_um;
  }
  return out;
}

std::string Iso230Result::summary() const {
  std::string text;
  if (etve) {
    text += fmt::format("ETVE over {:.1f} h, ambient range {:.2f} K\n", etve->duration_s / 3600.0,
                        etve->temperature_range_K);
    for (const EtveComponent& c : etve->components) {
      text +=
          fmt::format("  {}: range {}, per K {}, slope {}\n", c.name, withUncertainty(c.range, c.range_sigma, c.unit),
                      std::isfinite(c.range_per_K) ? withUncertainty(c.range_per_K, c.range_per_K_sigma, c.unit + "/K")
                                                   : "not determined",
                      std::isfinite(c.slope_per_K) ? withUncertainty(c.slope_per_K, c.slope_sigma, c.unit + "/K")
                                                   : "not determined");
    }
  }
  if (spindle) {
    text += fmt::format("rotating spindle from {:.6g} s to {:.6g} s\n", spindle->start_s, spindle->stop_s);
    for (const SpindleComponent& c : spindle->components) {
      text += fmt::format(
          "  {}: at the end {}, first hour {}, range {}, {:.0f} % after {}\n", c.name,
          withUncertainty(c.at_end, c.change_sigma, c.unit),
          std::isfinite(c.first_hour) ? withUncertainty(c.first_hour, c.first_hour_sigma, c.unit) : "not determined",
          withUncertainty(c.range, c.range_sigma, c.unit), 100.0 * spindle->fraction,
          std::isfinite(c.time_to_fraction_s) ? fmt::format("{:.0f} min", c.time_to_fraction_s / 60.0)
                                              : "not determined (the change is below three standard uncertainties)");
    }
  }
  if (axis) {
    for (const AxisPositionResult* p : {&axis->low, &axis->high}) {
      text +=
          fmt::format("  at {:.6g} mm: change {}, range {:.2f} µm, repeatability {:.2f} µm\n", printed(p->position_mm),
                      withUncertainty(p->change_um, p->change_sigma_um, "um"), p->range_um, p->repeatability_um);
    }
    text += fmt::format("  expansion {} ({:.2f} µm/m)\n",
                        withUncertainty(axis->expansion_um, axis->expansion_sigma_um, "um"),
                        printed(axis->expansion_um_per_m));
  }
  for (const std::string& n : notes) text += "note: " + n + "\n";
  return text;
}

}  // namespace spindrift
