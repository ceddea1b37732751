// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/units.h"
#include "core/machine/driver_words.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report_parts.h"

namespace spindrift {
namespace {

constexpr std::size_t most_curves = 7;  ///< that can be told apart by colour
constexpr int plot_width_px = 860;

/// Signals of the log that belong together.
struct LogSignals {
  std::vector<double> hours;
  std::vector<std::string> programme;      ///< speeds, feeds and switches that are ever on
  std::vector<std::string> temperatures;   ///< in the order of the log
  std::vector<std::string> displacements;  ///< _um
  std::vector<std::string> tilts;          ///< _urad
};

LogSignals signalsOf(const OperatingLog& log) {
  LogSignals out;
  for (const double t : log.time_s()) out.hours.push_back(t / seconds_per_hour);
  for (const std::string& name : log.names()) {
    const std::vector<double>& values = *log.signal(name);
    const bool ever = std::any_of(values.begin(), values.end(), [](double v) { return v > 0.0; });
    const bool programme = name == "spindle_rpm" || name.starts_with("feed_") || name.starts_with("speed_") ||
                           name == "coolant" || name == "instrument_on" || name == "compensation_on";
    if (name.ends_with("_degC")) {
      out.temperatures.push_back(name);
    } else if (programme && ever) {
      out.programme.push_back(name);
    } else if (name.ends_with("_um")) {
      out.displacements.push_back(name);
    } else if (name.ends_with("_urad")) {
      out.tilts.push_back(name);
    }
  }
  return out;
}

/// One lane a signal, filled up to its value: who reads it wants to know what ran when.
Drawing lanes(const OperatingLog& log, const LogSignals& signals) {
  constexpr double left = 210.0, right = 14.0, lane = 34.0, bar = 24.0;
  constexpr PictureColour grid{227, 231, 235}, base_line{154, 165, 177};
  constexpr Paint filled{.fill = PictureColour{159, 195, 205}, .stroke = PictureColour{11, 114, 133}};
  const double width = plot_width_px - left - right;
  const double from = signals.hours.front();
  const double span = std::max(1e-9, signals.hours.back() - from);
  const auto px = [&](double hours) { return left + (hours - from) / span * width; };
  const double bottom = 8.0 + lane * static_cast<double>(signals.programme.size());
  Drawing out(plot_width_px, bottom + 40.0);
  const std::vector<double> ticks = roundTicks(from, from + span, 8);
  for (const double t : ticks) {
    out.line(px(t), 4.0, px(t), bottom, grid, 1.0);
    out.text(px(t), bottom + 16.0, tickText(t, ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0),
             {.anchor = TextAnchor::Middle});
  }
  out.text(left + width / 2, bottom + 34.0, "time / h", {.anchor = TextAnchor::Middle});
  for (std::size_t k = 0; k < signals.programme.size(); ++k) {
    const std::vector<double>& values = *log.signal(signals.programme[k]);
    const double base = 8.0 + lane * static_cast<double>(k) + bar;
    const double largest = *std::max_element(values.begin(), values.end());
    const SignalTitle title = signalTitle(signals.programme[k]);
    out.text(left - 10.0, base - 7.0,
             title.unit.empty() ? title.name : fmt::format("{}, up to {:g} {}", title.name, largest, title.unit),
             {.anchor = TextAnchor::End});
    std::vector<Drawing::Point> edge{{px(signals.hours.front()), base}};
    double last = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double v = std::isfinite(values[i]) ? values[i] : 0.0;
      if (v == last && i + 1 < values.size()) continue;
      edge.push_back({px(signals.hours[i]), edge.back()[1]});
      edge.push_back({edge.back()[0], base - bar * v / largest});
      last = v;
    }
    edge.push_back({edge.back()[0], base});
    out.polygon(std::move(edge), filled);
    out.line(left, base, left + width, base, base_line, 1.0);
  }
  return out;
}

/// As many of the signals as can be told apart: those with the widest range, in the order of the log.
std::vector<std::string> widest(const OperatingLog& log, const std::vector<std::string>& names) {
  if (names.size() <= most_curves) return names;
  std::vector<std::pair<double, std::string>> ranges;
  for (const std::string& name : names) {
    double low = 1e300, high = -1e300;
    for (const double v : *log.signal(name)) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
    ranges.emplace_back(low - high, name);
  }
  std::stable_sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ranges.resize(most_curves);
  std::vector<std::string> kept;
  for (const std::string& name : names)
    if (std::any_of(ranges.begin(), ranges.end(), [&](const auto& r) { return r.second == name; }))
      kept.push_back(name);
  return kept;
}

/// Curves of some columns in one plot; those with an axis in their name in its colour.
void addCurves(Report& document, const OperatingLog& log, const LogSignals& signals,
               const std::vector<std::string>& names, const std::string& y_label, const std::string& caption) {
  if (names.empty()) return;
  const std::vector<std::string> shown = widest(log, names);
  std::vector<PlotSeries> curves;
  for (const std::string& name : shown) {
    PlotSeries curve{signalTitle(name).name, signals.hours, *log.signal(name), {}, SeriesStyle::Line};
    const int axis = name.size() > 1 && name[1] == '_' ? static_cast<int>(std::string("XYZ").find(name[0])) : -1;
    if (axis >= 0 && axis < 3) curve.dress(axisLook(axis));
    curves.push_back(std::move(curve));
  }
  document.figure(plotPicture(curves, {.x_label = "time / h", .y_label = y_label, .width_px = plot_width_px}),
                  names.size() > shown.size()
                      ? fmt::format("{}; the {} of {} that change most", caption, shown.size(), names.size())
                      : caption);
}

}  // namespace

void addOperatingConditions(Report& document, const OperatingLog& log) {
  if (log.empty()) return;
  document.section("Operating conditions");
  const LogSignals signals = signalsOf(log);
  if (!signals.programme.empty())
    document.figure(lanes(log, signals), "Program of the machine: what ran when, each relative to its largest value");
  addCurves(document, log, signals, signals.temperatures, "temperature / °C", "Temperatures of the log");
  addCurves(document, log, signals, signals.displacements, "displacement / µm", "Displacements of the log");
  addCurves(document, log, signals, signals.tilts, "tilt / µrad", "Tilts of the log");
  if (const std::vector<double>* on = log.signal("compensation_on");
      on != nullptr && std::any_of(on->begin(), on->end(), [](double v) { return v != 0.0; })) {
    document.callout(CalloutKind::Attention,
                     "The control was compensating during part of this campaign; observations from that time show the "
                     "residual, not the error of the machine.");
  }
}

}  // namespace spindrift
