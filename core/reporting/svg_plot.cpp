// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

// Okabe and Ito's palette without yellow, which is too pale for thin lines on white.
constexpr std::array<const char*, 7> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#56b4e9", "#e69f00", "#333333"};

struct Limits {
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
  Limits x, y;

  [[nodiscard]] double px(double v) const { return left + (v - x.low) / (x.high - x.low) * width; }
  [[nodiscard]] double py(double v) const { return top + (y.high - v) / (y.high - y.low) * height; }
};

std::string axes(const Frame& f, const PlotOptions& options) {
  std::string out;
  const std::vector<double> x_ticks =
      roundTicks(f.x.low, f.x.high, std::max(3, static_cast<int>(f.width / (options.compact ? 50 : 90))));
  std::vector<double> y_ticks = roundTicks(f.y.low, f.y.high, std::max(4, static_cast<int>(f.height / 32)));
  // A scale needs two marks at least, better three.
  if (y_ticks.size() < 3) y_ticks = roundTicks(f.y.low, f.y.high, 2 * std::max(4, static_cast<int>(f.height / 32)));
  const double x_step = x_ticks.size() > 1 ? x_ticks[1] - x_ticks[0] : 1.0;
  const double y_step = y_ticks.size() > 1 ? y_ticks[1] - y_ticks[0] : 1.0;
  for (const double t : x_ticks) {
    out += fmt::format(R"(<line class="grid" x1="{0:.1f}" x2="{0:.1f}" y1="{1:.1f}" y2="{2:.1f}"/>)", f.px(t), f.top,
                       f.top + f.height);
    out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle">{}</text>)", f.px(t), f.top + f.height + 16,
                       tickText(t, x_step));
  }
  for (const double t : y_ticks) {
    out += fmt::format(R"(<line class="{3}" x1="{0:.1f}" x2="{1:.1f}" y1="{2:.1f}" y2="{2:.1f}"/>)", f.left,
                       f.left + f.width, f.py(t), std::abs(t) < 1e-12 * std::abs(y_step) ? "zero" : "grid");
    out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)", f.left - 6, f.py(t) + 4,
                       tickText(t, y_step));
  }
  out += fmt::format(R"(<rect class="frame" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)", f.left, f.top,
                     f.width, f.height);
  out += fmt::format(R"(<text x="{:.1f}" y="{}" text-anchor="middle">{}</text>)", f.left + f.width / 2,
                     options.height_px - 6, escapedXml(options.x_label));
  out += fmt::format(
      R"svg(<text x="14" y="{0:.1f}" text-anchor="middle" transform="rotate(-90 14 {0:.1f})">{1}</text>)svg",
      f.top + f.height / 2, escapedXml(options.y_label));
  return out;
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
std::string manyPoints(const PlotSeries& s, const Frame& f, const std::string& colour,
                       const std::vector<std::size_t>& rows) {
  std::string bars;
  std::string dots;
  for (const std::size_t i : rows) {
    if (i < s.sigma.size() && std::isfinite(s.sigma[i])) {
      bars += fmt::format("M{:.1f} {:.1f}V{:.1f}", f.px(s.x[i]), f.py(s.y[i] - s.sigma[i]), f.py(s.y[i] + s.sigma[i]));
    }
    dots += fmt::format("M{:.1f} {:.1f}h0.1", f.px(s.x[i]), f.py(s.y[i]));
  }
  std::string out;
  if (!bars.empty()) {
    out += fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1" opacity="0.3"/>)", bars, colour);
  }
  return out + fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="2.4" stroke-linecap="round"/>)", dots,
                           colour);
}

std::string markerAt(PlotMarker marker, double x, double y, double radius, const std::string& colour) {
  switch (marker) {
    case PlotMarker::Circle:
      break;
    case PlotMarker::Square:
      return fmt::format(R"(<rect x="{0:.1f}" y="{1:.1f}" width="{2:.1f}" height="{2:.1f}" fill="{3}"/>)",
                         x - 0.9 * radius, y - 0.9 * radius, 1.8 * radius, colour);
    case PlotMarker::Triangle:
      return fmt::format(R"(<polygon points="{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}" fill="{}"/>)", x,
                         y - 1.25 * radius, x - 1.1 * radius, y + 0.75 * radius, x + 1.1 * radius, y + 0.75 * radius,
                         colour);
  }
  return fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:g}" fill="{}"/>)", x, y, radius, colour);
}

std::string drawPoints(const PlotSeries& s, const Frame& f, const std::string& colour,
                       const std::vector<std::size_t>& rows, bool bars) {
  if (s.x.size() > most_points_drawn) return manyPoints(s, f, colour, rows);
  std::string out;
  for (const std::size_t i : rows) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
    if (bars && s.sigma[i] > 0.0) {
      out += fmt::format(R"(<line x1="{0:.1f}" x2="{0:.1f}" y1="{1:.1f}" y2="{2:.1f}" stroke="{3}" stroke-width="1" )"
                         R"(opacity="0.5"/>)",
                         f.px(s.x[i]), f.py(s.y[i] - s.sigma[i]), f.py(s.y[i] + s.sigma[i]), colour);
    }
    out += markerAt(s.marker, f.px(s.x[i]), f.py(s.y[i]), 2.2, colour);
  }
  return out;
}

std::string drawSeries(const PlotSeries& s, const Frame& f, const std::string& colour) {
  std::string out;
  const bool with_sigma = s.sigma.size() == s.x.size() && !s.sigma.empty();
  const std::vector<std::size_t> rows = rowsToDraw(s, f);
  if (s.style == SeriesStyle::Points) return drawPoints(s, f, colour, rows, with_sigma);
  if (with_sigma) {
    std::string upper;
    std::string lower;
    const auto edge = [&](std::size_t i, double sign) {
      if (!std::isfinite(s.y[i]) || !std::isfinite(s.sigma[i])) return std::string();
      return fmt::format("{:.1f},{:.1f} ", f.px(s.x[i]), f.py(s.y[i] + sign * 2.0 * s.sigma[i]));
    };
    for (auto i = rows.begin(); i != rows.end(); ++i) upper += edge(*i, 1.0);
    for (auto i = rows.rbegin(); i != rows.rend(); ++i) lower += edge(*i, -1.0);
    out += fmt::format(R"(<polygon points="{}{}" fill="{}" opacity="0.15"/>)", upper, lower, colour);
  }
  std::string path;
  bool pen_down = false;
  double last_y = 0.0;
  for (const std::size_t i : rows) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) {
      pen_down = false;
      continue;
    }
    if (pen_down && s.style == SeriesStyle::Step) path += fmt::format("L{:.1f} {:.1f}", f.px(s.x[i]), last_y);
    last_y = f.py(s.y[i]);
    path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', f.px(s.x[i]), last_y);
    pen_down = true;
  }
  out += fmt::format(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1.4"/>)", path, colour);
  if (s.style == SeriesStyle::Both) out += drawPoints(s, f, colour, rows, false);
  return out;
}

std::string colourOf(const std::vector<PlotSeries>& series, std::size_t index) {
  return series[index].colour.empty() ? palette[index % palette.size()] : series[index].colour;
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

std::string drawLegend(const std::vector<PlotSeries>& series, const std::vector<std::pair<double, int>>& places,
                       double left, double top) {
  std::string out;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double x = left + places[i].first;
    const double y = top + 18.0 * places[i].second;
    const std::string colour = colourOf(series, i);
    const SeriesStyle style = series[i].style;
    if (style == SeriesStyle::Line || style == SeriesStyle::Step || style == SeriesStyle::Both) {
      out += fmt::format(R"(<line x1="{:.1f}" x2="{:.1f}" y1="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="2"/>)", x,
                         x + 16, y - 4, y - 4, colour);
    }
    if (style == SeriesStyle::Points || style == SeriesStyle::Both)
      out += markerAt(series[i].marker, x + 8, y - 4, 3.0, colour);
    out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", x + 21, y, escapedXml(series[i].name));
  }
  return out;
}

/// Widens one pair of limits so that both axes have the same scale.
void equalise(Frame& f) {
  const double per_px_x = (f.x.high - f.x.low) / f.width;
  const double per_px_y = (f.y.high - f.y.low) / f.height;
  Limits& narrow = per_px_x < per_px_y ? f.x : f.y;
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

std::string svgPlot(const std::vector<PlotSeries>& series, const PlotOptions& options) {
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

  std::string out =
      fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" height="{1}" )"
                  R"(font-family="Inter, 'DejaVu Sans', sans-serif" font-size="12" fill="#1f2933">)"
                  "<style>.grid{{stroke:#e3e7eb;stroke-width:1}}.zero{{stroke:#9aa5b1;stroke-width:1}}"
                  ".frame{{fill:none;stroke:#9aa5b1}}</style>"
                  R"(<rect width="{0}" height="{1}" fill="#ffffff"/>)",
                  options.width_px, options.height_px);
  if (titled)
    out += fmt::format(R"(<text x="{}" y="18" font-weight="600">{}</text>)", f.left, escapedXml(options.title));
  for (const PlotRange& range : options.ranges) {
    const double from = std::clamp(range.from, f.x.low, f.x.high);
    const double to = std::clamp(range.to, f.x.low, f.x.high);
    if (!(to > from)) continue;
    out += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="#7c6fa8" opacity="0.10"/>)",
                       f.px(from), f.top, f.px(to) - f.px(from), f.height);
    out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" font-size="11" fill="#5b4f87">{}</text>)", f.px(from) + 4,
                       f.top + 13, escapedXml(range.label));
  }
  out += axes(f, options);
  out += fmt::format(
      R"(<clipPath id="c{0}"><rect x="{1:.1f}" y="{2:.1f}" width="{3:.1f}" height="{4:.1f}"/></clipPath>)"
      R"svg(<g clip-path="url(#c{0})">)svg",
      options.width_px * 1000000 + options.height_px * 100 + static_cast<int>(f.top), f.left, f.top, f.width, f.height);
  for (std::size_t i = 0; i < series.size(); ++i) out += drawSeries(series[i], f, colourOf(series, i));
  out += "</g>";
  if (legend) out += drawLegend(series, places, f.left + beside, f.top - 8.0 - 18.0 * (legend_rows - 1));
  if (empty) {
    out += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="middle" fill="#7b8794">no data</text>)",
                       f.left + f.width / 2, f.top + f.height / 2);
  }
  return out + "</svg>";
}

std::string svgGrid(const std::vector<std::string>& drawings, int columns, int gap_px) {
  SPINDRIFT_ASSERT(columns >= 1, "a grid has a column");
  struct Part {
    std::string attributes, body;
    int width = 0, height = 0;
  };
  std::vector<Part> parts;
  for (const std::string& svg : drawings) {
    const std::size_t end = svg.find('>');
    const std::size_t close = svg.rfind("</svg>");
    SPINDRIFT_ASSERT(svg.starts_with("<svg") && end < close, "a drawing is one <svg>");
    Part part{svg.substr(4, end - 4), svg.substr(end + 1, close - end - 1)};
    // What only the outermost element has; font and fill go on to the group.
    for (const char* name : {"xmlns:xlink", "xmlns", "viewBox", "width", "height"}) {
      const std::string key = std::string(" ") + name + "=\"";
      const std::size_t from = part.attributes.find(key);
      if (from == std::string::npos) continue;
      const std::size_t to = part.attributes.find('"', from + key.size());
      const std::string value = part.attributes.substr(from + key.size(), to - from - key.size());
      if (key == " width=\"") part.width = std::stoi(value);
      if (key == " height=\"") part.height = std::stoi(value);
      part.attributes.erase(from, to + 1 - from);
    }
    parts.push_back(std::move(part));
  }
  std::vector<int> widths(static_cast<std::size_t>(columns), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    int& width = widths[i % widths.size()];
    width = std::max(width, parts[i].width);
  }
  std::string body;
  int x = 0, y = 0, row_height = 0, whole_width = 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0 && i % widths.size() == 0) {
      y += row_height + gap_px;
      x = row_height = 0;
    }
    body += fmt::format(R"svg(<g transform="translate({} {})"{}>{}</g>)svg", x, y, parts[i].attributes, parts[i].body);
    whole_width = std::max(whole_width, x + parts[i].width);
    x += widths[i % widths.size()] + gap_px;
    row_height = std::max(row_height, parts[i].height);
  }
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )"
                     R"(viewBox="0 0 {0} {1}" width="{0}" height="{1}">{2}</svg>)",
                     whole_width, std::max(1, y + row_height), body);
}

std::string svgPlotStack(const std::vector<StackedPlot>& plots) {
  std::vector<std::string> drawings;
  for (const StackedPlot& plot : plots) drawings.push_back(svgPlot(plot.series, plot.options));
  return svgGrid(drawings, 1);
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
