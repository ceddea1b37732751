// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/plot_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.h"

namespace spindrift {
namespace {

// Okabe and Ito's palette without yellow, which is too pale for thin lines on white.
constexpr std::array<const char*, 7> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#56b4e9", "#e69f00", "#333333"};

struct PlotLimits {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  [[nodiscard]] bool empty() const { return low > high; }
  void widen(double part) {
    double span = high - low;
    if (!(span > 0.0)) span = std::max(1.0, std::abs(high));
    low -= part * span;
    high += part * span;
  }
};

struct Frame {
  double left, top, width, height;
  PlotLimits x, y;

  [[nodiscard]] double px(double v) const { return left + (v - x.low) / (x.high - x.low) * width; }
  [[nodiscard]] double py(double v) const { return top + (y.high - v) / (y.high - y.low) * height; }
};

constexpr PictureColour plot_grid{227, 231, 235};
constexpr PictureColour frame_colour{154, 165, 177};
constexpr PictureColour soft_colour{123, 135, 148};

void drawPlotAxes(Drawing& out, const Frame& f, const PlotOptions& options) {
  const std::vector<double> x_ticks =
      roundTicks(f.x.low, f.x.high, std::max(3, static_cast<int>(f.width / (options.compact ? 50 : 90))));
  std::vector<double> y_ticks = roundTicks(f.y.low, f.y.high, std::max(4, static_cast<int>(f.height / 32)));
  // A scale needs two marks at least, better three.
  if (y_ticks.size() < 3) y_ticks = roundTicks(f.y.low, f.y.high, 2 * std::max(4, static_cast<int>(f.height / 32)));
  const double x_step = x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1.0;
  const double y_step = y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1.0;
  const double right = f.left + f.width, bottom = f.top + f.height;
  for (const double t : x_ticks) {
    out.line(f.px(t), f.top, f.px(t), bottom, plot_grid, 1.0);
    out.text(f.px(t), bottom + 16.0, tickText(t, x_step), {.anchor = TextAnchor::Middle});
  }
  for (const double t : y_ticks) {
    const bool zero = std::abs(t) < 1e-12 * std::abs(y_step);
    out.line(f.left, f.py(t), right, f.py(t), zero ? frame_colour : plot_grid, 1.0);
    out.text(f.left - 6.0, f.py(t) + 4.0, tickText(t, y_step), {.anchor = TextAnchor::End});
  }
  out.rectangle(f.left, f.top, f.width, f.height, Paint{.stroke = frame_colour});
  out.text(f.left + f.width / 2, options.height_px - 6.0, options.x_label, {.anchor = TextAnchor::Middle});
  out.text(14.0, f.top + f.height / 2, options.y_label, {.anchor = TextAnchor::Middle, .upwards = true});
}

constexpr std::size_t most_points_drawn = 2000;

/// Rows worth drawing: all of a short series; of a long one what makes a difference in a picture of this size, that is
/// one of the points that share a pixel, or of a line the first, lowest, highest and last of every column of pixels.
std::vector<std::size_t> rowsToDraw(const PlotSeries& s, const Frame& f) {
  std::vector<std::size_t> rows;
  const std::size_t n = s.x.size();
  const auto drawn = [&](std::size_t i) { return std::isfinite(s.x[i]) && std::isfinite(s.y[i]); };
  if (n <= most_points_drawn) {
    for (std::size_t i = 0; i < n; ++i) rows.push_back(i);
    return rows;
  }
  if (s.style == SeriesStyle::Points) {
    std::set<std::pair<long, long>> pixels;
    for (std::size_t i = 0; i < n; ++i) {
      if (drawn(i) && pixels.emplace(std::lround(f.px(s.x[i])), std::lround(f.py(s.y[i]))).second) rows.push_back(i);
    }
    return rows;
  }
  for (std::size_t from = 0; from < n;) {
    if (!drawn(from)) {
      rows.push_back(from++);
      continue;
    }
    std::size_t to = from;
    std::set<std::size_t> kept{from};
    std::size_t low = from;
    std::size_t high = from;
    for (; to < n && drawn(to) && std::lround(f.px(s.x[to])) == std::lround(f.px(s.x[from])); ++to) {
      if (s.y[to] < s.y[low]) low = to;
      if (s.y[to] > s.y[high]) high = to;
    }
    kept.insert({low, high, to - 1});
    rows.insert(rows.end(), kept.begin(), kept.end());
    from = to;
  }
  return rows;
}

/// As one path each for bars and dots: readers of drawings take long over thousands of elements.
void drawManyPoints(Drawing& out, const PlotSeries& s, const Frame& f, PictureColour colour,
                    const std::vector<std::size_t>& rows) {
  std::vector<std::vector<Drawing::Point>> bars, dots;
  for (const std::size_t i : rows) {
    const double x = f.px(s.x[i]);
    if (i < s.sigma.size() && std::isfinite(s.sigma[i]))
      bars.push_back({{x, f.py(s.y[i] - s.sigma[i])}, {x, f.py(s.y[i] + s.sigma[i])}});
    dots.push_back({{x, f.py(s.y[i])}, {x + 0.1, f.py(s.y[i])}});
  }
  if (!bars.empty()) out.path(std::move(bars), {.stroke = colour, .opacity = 0.3});
  out.path(std::move(dots), {.stroke = colour, .width = 2.4, .round = true});
}

void drawMarker(Drawing& out, PlotMarker marker, double x, double y, double radius, PictureColour colour) {
  switch (marker) {
    case PlotMarker::Circle:
      out.disc(x, y, radius, colour);
      return;
    case PlotMarker::Square:
      out.rectangle(x - 0.9 * radius, y - 0.9 * radius, 1.8 * radius, 1.8 * radius, Paint{.fill = colour});
      return;
    case PlotMarker::Triangle:
      out.polygon(
          {{x, y - 1.25 * radius}, {x - 1.1 * radius, y + 0.75 * radius}, {x + 1.1 * radius, y + 0.75 * radius}},
          {.fill = colour});
      return;
  }
}

void drawPoints(Drawing& out, const PlotSeries& s, const Frame& f, PictureColour colour,
                const std::vector<std::size_t>& rows, bool bars) {
  if (s.x.size() > most_points_drawn) {
    drawManyPoints(out, s, f, colour, rows);
    return;
  }
  for (const std::size_t i : rows) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
    if (bars && s.sigma[i] > 0.0)
      out.line(f.px(s.x[i]), f.py(s.y[i] - s.sigma[i]), f.px(s.x[i]), f.py(s.y[i] + s.sigma[i]), colour, 1.0, 0.5);
    drawMarker(out, s.marker, f.px(s.x[i]), f.py(s.y[i]), 2.2, colour);
  }
}

void drawSeries(Drawing& out, const PlotSeries& s, const Frame& f, PictureColour colour) {
  const bool with_sigma = s.sigma.size() == s.x.size() && !s.sigma.empty();
  const std::vector<std::size_t> rows = rowsToDraw(s, f);
  if (s.style == SeriesStyle::Points) {
    drawPoints(out, s, f, colour, rows, with_sigma);
    return;
  }
  if (with_sigma) {
    std::vector<Drawing::Point> band;
    const auto edge = [&](std::size_t i, double sign) {
      if (std::isfinite(s.y[i]) && std::isfinite(s.sigma[i]))
        band.push_back({f.px(s.x[i]), f.py(s.y[i] + sign * 2.0 * s.sigma[i])});
    };
    for (auto i = rows.begin(); i != rows.end(); ++i) edge(*i, 1.0);
    for (auto i = rows.rbegin(); i != rows.rend(); ++i) edge(*i, -1.0);
    out.polygon(std::move(band), {.fill = colour, .opacity = 0.15});
  }
  std::vector<std::vector<Drawing::Point>> strokes;
  bool pen_down = false;
  for (const std::size_t i : rows) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) {
      pen_down = false;
      continue;
    }
    if (!pen_down) strokes.emplace_back();
    const Drawing::Point at{f.px(s.x[i]), f.py(s.y[i])};
    if (pen_down && s.style == SeriesStyle::Step) strokes.back().push_back({at[0], strokes.back().back()[1]});
    strokes.back().push_back(at);
    pen_down = true;
  }
  out.path(std::move(strokes), {.stroke = colour, .width = 1.4});
  if (s.style == SeriesStyle::Both) drawPoints(out, s, f, colour, rows, false);
}

PictureColour seriesColour(const std::vector<PlotSeries>& series, std::size_t index) {
  const std::string& own = series[index].colour;
  return colourOfHex(own.empty() ? palette[index % palette.size()] : std::string_view(own));
}

/// Width of a text of 12 px, generously.
double textWidth(std::string_view text) {
  const auto letters =
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
  return 6.8 * static_cast<double>(letters);
}

/// Where each name of the legend stands: x and row. Names wrap into rows of `width`.
std::vector<std::pair<double, int>> legendPlaces(const std::vector<PlotSeries>& series, double width) {
  std::vector<std::pair<double, int>> places;
  double x = 0.0;
  int row = 0;
  for (const PlotSeries& s : series) {
    const double needed = 36.0 + textWidth(s.name);
    if (x > 0.0 && x + needed - 15.0 > width) {
      x = 0.0;
      ++row;
    }
    places.emplace_back(x, row);
    x += needed;
  }
  return places;
}

void drawLegend(Drawing& out, const std::vector<PlotSeries>& series, const std::vector<std::pair<double, int>>& places,
                double left, double top) {
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double x = left + places[i].first;
    const double y = top + 18.0 * places[i].second;
    const PictureColour colour = seriesColour(series, i);
    const SeriesStyle style = series[i].style;
    if (style != SeriesStyle::Points) out.line(x, y - 4.0, x + 16.0, y - 4.0, colour, 2.0);
    if (style == SeriesStyle::Points || style == SeriesStyle::Both)
      drawMarker(out, series[i].marker, x + 8.0, y - 4.0, 3.0, colour);
    out.text(x + 21.0, y, series[i].name);
  }
}

/// Widens one pair of limits so that both axes have the same scale.
void equalise(Frame& f) {
  const double per_px_x = (f.x.high - f.x.low) / f.width;
  const double per_px_y = (f.y.high - f.y.low) / f.height;
  PlotLimits& narrow = per_px_x < per_px_y ? f.x : f.y;
  const double wanted = per_px_x < per_px_y ? per_px_y * f.width : per_px_x * f.height;
  const double add = 0.5 * (wanted - (narrow.high - narrow.low));
  narrow.low -= add;
  narrow.high += add;
}

}  // namespace

std::vector<double> roundTicks(double from, double to, int wanted) {
  if (!(to > from) || !std::isfinite(from) || !std::isfinite(to)) return {from};
  const double raw = (to - from) / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * 0.999) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks;
  for (double i = std::ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i) ticks.push_back(i * step);
  return ticks;
}

std::string tickText(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(std::abs(step)) - 1e-9)), 0, 9);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  if (text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

Drawing plotPicture(const std::vector<PlotSeries>& series, const PlotOptions& options) {
  SPINDRIFT_ASSERT(options.width_px >= 160 && options.height_px >= 100, "a plot needs room");
  Frame f{};
  for (const PlotSeries& s : series) {
    SPINDRIFT_ASSERT(s.x.size() == s.y.size(), "x and y of a series differ in length");
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      f.x.add(s.x[i]);
      const double sigma = i < s.sigma.size() && std::isfinite(s.sigma[i]) ? s.sigma[i] : 0.0;
      f.y.add(s.y[i] - sigma);
      f.y.add(s.y[i] + sigma);
    }
  }
  const bool empty = f.x.empty() || f.y.empty();
  if (empty) {
    f.x = {0.0, 1.0};
    f.y = {0.0, 1.0};
  }
  f.x.widen(f.x.high > f.x.low ? 0.015 : 0.5);  // points at the ends stay whole
  f.y.widen(0.06);
  if (options.y_from) f.y.low = *options.y_from;
  if (options.y_to) f.y.high = *options.y_to;
  if (options.x_from) f.x.low = *options.x_from;
  if (options.x_to) f.x.high = *options.x_to;
  const bool titled = !options.title.empty();
  const bool legend = series.size() > 1 || (series.size() == 1 && !series[0].name.empty() && titled);
  f.left = options.compact ? 56.0 : 64.0;
  f.width = options.width_px - f.left - 14.0;
  const double beside = options.compact && titled ? textWidth(options.title) + 16.0 : 0.0;
  const auto places = legendPlaces(series, f.width - beside);
  const int legend_rows = legend ? places.back().second + 1 : 0;
  const int rows_above = std::max(legend_rows, options.compact ? 1 : 0) + (titled && beside == 0.0 ? 1 : 0);
  f.top = 12.0 + 18.0 * rows_above;
  f.height = options.height_px - f.top - 42.0;
  if (options.equal_scale) equalise(f);

  Drawing out(options.width_px, options.height_px);
  if (titled) out.text(f.left, 18.0, options.title, {.bold = true});
  for (const PlotRange& range : options.ranges) {
    const double from = std::clamp(range.from, f.x.low, f.x.high);
    const double to = std::clamp(range.to, f.x.low, f.x.high);
    if (!(to > from)) continue;
    out.rectangle(f.px(from), f.top, f.px(to) - f.px(from), f.height,
                  Paint{.fill = PictureColour{124, 111, 168}, .opacity = 0.10});
    out.text(f.px(from) + 4.0, f.top + 13.0, range.label, {.size = 11.0, .colour = {91, 79, 135}});
  }
  drawPlotAxes(out, f, options);
  out.beginWindow(f.left, f.top, f.width, f.height);
  for (std::size_t i = 0; i < series.size(); ++i) drawSeries(out, series[i], f, seriesColour(series, i));
  out.endWindow();
  if (legend) drawLegend(out, series, places, f.left + beside, f.top - 8.0 - 18.0 * (legend_rows - 1));
  if (empty)
    out.text(f.left + f.width / 2, f.top + f.height / 2, "no data",
             {.anchor = TextAnchor::Middle, .colour = soft_colour});
  return out;
}

Drawing plotStack(const std::vector<StackedPlot>& plots) {
  std::vector<Drawing> drawings;
  for (const StackedPlot& plot : plots) drawings.push_back(plotPicture(plot.series, plot.options));
  return drawingGrid(drawings, 1);
}

AxisLook axisLook(int axis) {
  SPINDRIFT_ASSERT(axis >= 0 && axis < 3, "there are three axes");
  // The axes of the 3D view on a light background.
  static const std::array<AxisLook, 3> looks{
      {{"#b83227", PlotMarker::Circle}, {"#2a7f46", PlotMarker::Square}, {"#2460b4", PlotMarker::Triangle}}};
  return looks[static_cast<std::size_t>(axis)];
}

AxisLook componentLook(Component component) {
  return axisLook(axisIndex(component));
}

}  // namespace spindrift
