// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/machine/observation.h"
#include "core/thermal/time_series.h"

namespace spindrift {
namespace {

struct Curve {
  std::string name;
  std::vector<double> time_s;
  std::vector<double> values;
};

/// Curves over hours with axes, units and a legend. Colours that stay apart for the colour-blind (Okabe and Ito).
std::string drawCurves(const std::string& title, const std::vector<Curve>& curves) {
  static constexpr std::array<const char*, 7> colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                         "#e69f00", "#56b4e9", "#000000"};
  double t0 = 1e300, t1 = -1e300, v0 = 1e300, v1 = -1e300;
  for (const Curve& c : curves) {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (!std::isfinite(c.values[i])) continue;
      t0 = std::min(t0, c.time_s[i] / 3600.0);
      t1 = std::max(t1, c.time_s[i] / 3600.0);
      v0 = std::min(v0, c.values[i]);
      v1 = std::max(v1, c.values[i]);
    }
  }
  if (!(t1 > t0)) t1 = t0 + 1.0;
  if (!(v1 > v0)) v1 = v0 + 1.0;
  const double width = 860.0, height = 440.0, left = 70.0, right = 150.0, top = 40.0, bottom = 50.0;
  const auto x = [&](double t) { return left + (t - t0) / (t1 - t0) * (width - left - right); };
  const auto y = [&](double v) { return height - bottom - (v - v0) / (v1 - v0) * (height - top - bottom); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"white\"/>\n<text x=\"{2}\" y=\"24\" font-size=\"15\">{3}</text>\n",
      width, height, left, escapedXml(title));
  for (int k = 0; k <= 5; ++k) {
    const double t = t0 + (t1 - t0) * k / 5.0;
    const double v = v0 + (v1 - v0) * k / 5.0;
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" "
        "y=\"{3:.1f}\" text-anchor=\"middle\">{4:.1f}</text>\n",
        x(t), top, height - bottom, height - bottom + 18.0, t);
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/><text x=\"{3:.1f}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5:.2f}</text>\n",
        left, width - right, y(v), left - 8.0, y(v) + 4.0, v);
  }
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">time in h</text>\n",
                     (left + width - right) / 2.0, height - 12.0);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    std::string path;
    const std::size_t stride = std::max<std::size_t>(1, curves[c].values.size() / 2000);
    for (std::size_t i = 0; i < curves[c].values.size(); i += stride) {
      if (std::isfinite(curves[c].values[i]))
        path += fmt::format("{:.1f},{:.1f} ", x(curves[c].time_s[i] / 3600.0), y(curves[c].values[i]));
    }
    const char* colour = colours[c % colours.size()];
    svg += fmt::format(
        "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" points=\"{}\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\" "
        "fill=\"{}\">{}</text>\n",
        colour, path, width - right + 8.0, top + 16.0 * static_cast<double>(c + 1), colour, escapedXml(curves[c].name));
  }
  return svg + "</svg>\n";
}

Iso230Result evaluateAxis(const Iso230Request& request) {
  const ObservationSet set = ObservationSet::read(request.observations);
  static constexpr std::array<const char*, 3> axes = {"X", "Y", "Z"};
  const auto found = std::find(axes.begin(), axes.end(), request.axis);
  if (found == axes.end())
    throw InputError(fmt::format("--axis \"{}\" is not a linear axis; allowed: X, Y, Z.", request.axis));
  const auto index = static_cast<int>(found - axes.begin());
  std::vector<AxisReading> readings;
  for (const Observation& o : set.rows) {
    if (o.use == ObservationUse::Exclude || isRotation(o.component) || axisIndex(o.component) != index) continue;
    readings.push_back({o.time_s, o.position_mm[index], o.value, o.approach[index] < 0.0 ? -1 : 1});
  }
  if (readings.empty()) {
    throw InputError(
        {request.observations, "column component"},
        fmt::format("there is no reading of E{}; allowed: readings of the axis at two positions.", request.axis));
  }
  Iso230Result result;
  result.test = "axis";
  result.axis = evaluateMovingAxis(std::move(readings));
  result.svg = drawCurves("Expansion between both ends, axis " + request.axis + ", um",
                          {{"expansion um", result.axis->time_s, result.axis->expansion_over_time_um}});
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

Iso230Result evaluateIso230Test(const TimeSeries& series, const Iso230Request& request) {
  Iso230Result result;
  result.test = request.test;
  result.notes = series.notes;
  std::vector<ComponentSeries> components;
  std::vector<Curve> curves;
  for (const Signal& s : series.signals) {
    if (!request.columns.empty() || s.kind != SignalKind::Displacement) continue;
    components.push_back({s.name, s.name.ends_with("_urad") ? "urad" : "um", s.values, 0.0});
  }
  for (const std::string& name : request.columns)
    components.push_back({name, name.ends_with("_urad") ? "urad" : "um", series.at(name).values, 0.0});
  for (const ComponentSeries& c : components) curves.push_back({c.name, series.time_s, c.values});
  if (request.test == "etve") {
    std::string ambient = request.ambient;
    for (const char* candidate : {"T_room_degC", "T_ambient_degC"})
      if (ambient.empty() && series.find(candidate) != nullptr) ambient = candidate;
    if (ambient.empty())
      result.notes.push_back("no ambient temperature was named (--ambient): nothing is given per K.");
    result.etve =
        evaluateEtve(series.time_s, components,
                     ambient.empty() ? std::span<const double>{} : std::span<const double>(series.at(ambient).values));
    if (!result.etve->note.empty()) result.notes.push_back(result.etve->note);
    result.svg = drawCurves("Environmental variation (ETVE), um or urad", curves);
  } else {
    const Signal* speed = nullptr;
    for (const Signal& s : series.signals)
      if (speed == nullptr && s.kind == SignalKind::Speed) speed = &s;
    if (speed == nullptr)
      throw InputError({series.file, "header"}, "there is no speed column (..._rpm); allowed: spindle_rpm.");
    result.spindle = evaluateRotatingSpindle(series.time_s, bridged(series.time_s, speed->values, true), components,
                                             request.fraction);
    result.svg = drawCurves("Rotating spindle, um or urad", curves);
  }
  return result;
}

nlohmann::json Iso230Result::json() const {
  nlohmann::json out = {{"test", test}, {"notes", notes}};
  if (etve) {
    out["duration_s"] = etve->duration_s;
    out["temperature_range_K"] = etve->temperature_range_K;
    for (const EtveComponent& c : etve->components) {
      out["components"].push_back({{"name", c.name},
                                   {"unit", c.unit},
                                   {"range", c.range},
                                   {"range_standard_uncertainty", c.range_sigma},
                                   {"range_per_K", jsonNumber(c.range_per_K)},
                                   {"slope_per_K", jsonNumber(c.slope_per_K)},
                                   {"slope_standard_uncertainty", jsonNumber(c.slope_sigma)}});
    }
  }
  if (spindle) {
    out["start_s"] = spindle->start_s;
    out["stop_s"] = spindle->stop_s;
    out["fraction"] = spindle->fraction;
    for (const SpindleComponent& c : spindle->components) {
      out["components"].push_back({{"name", c.name},
                                   {"unit", c.unit},
                                   {"first_hour", jsonNumber(c.first_hour)},
                                   {"at_end", jsonNumber(c.at_end)},
                                   {"standard_uncertainty", c.change_sigma},
                                   {"range", c.range},
                                   {"time_to_fraction_s", jsonNumber(c.time_to_fraction_s)},
                                   {"after_cooling", jsonNumber(c.after_cooling)}});
    }
  }
  if (axis) {
    for (const AxisPositionResult* p : {&axis->low, &axis->high}) {
      out["positions"].push_back({{"position_mm", p->position_mm},
                                  {"change_um", p->change_um},
                                  {"standard_uncertainty_um", p->change_sigma_um},
                                  {"range_um", p->range_um},
                                  {"repeatability_um", p->repeatability_um},
                                  {"reversal_um", jsonNumber(p->reversal_um)},
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
      text += fmt::format("  {}: range {}, per K {:.3g}, slope {}\n", c.name,
                          withUncertainty(c.range, c.range_sigma, c.unit), c.range_per_K,
                          withUncertainty(c.slope_per_K, c.slope_sigma, c.unit + "/K"));
    }
  }
  if (spindle) {
    text += fmt::format("rotating spindle from {:.6g} s to {:.6g} s\n", spindle->start_s, spindle->stop_s);
    for (const SpindleComponent& c : spindle->components) {
      text += fmt::format("  {}: at the end {}, first hour {}, {:.0f} % after {:.0f} min\n", c.name,
                          withUncertainty(c.at_end, c.change_sigma, c.unit),
                          withUncertainty(c.first_hour, c.change_sigma, c.unit), 100.0 * spindle->fraction,
                          c.time_to_fraction_s / 60.0);
    }
  }
  if (axis) {
    for (const AxisPositionResult* p : {&axis->low, &axis->high}) {
      text += fmt::format("  at {:.6g} mm: change {}, range {:.2f} um, repeatability {:.2f} um\n", p->position_mm,
                          withUncertainty(p->change_um, p->change_sigma_um, "um"), p->range_um, p->repeatability_um);
    }
    text += fmt::format("  expansion {} ({:.2f} um/m)\n",
                        withUncertainty(axis->expansion_um, axis->expansion_sigma_um, "um"), axis->expansion_um_per_m);
  }
  for (const std::string& n : notes) text += "note: " + n + "\n";
  return text;
}

}  // namespace spindrift
