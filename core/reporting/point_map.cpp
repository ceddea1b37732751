// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/point_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/reporting/heatmap_picture.h"
#include "core/reporting/plot_picture.h"

namespace spindrift {
namespace {

constexpr PictureColour map_ink = picture_ink;
constexpr PictureColour map_grid{227, 231, 235};
constexpr PictureColour map_grey{120, 130, 140};
constexpr double coverage = 2.0;  ///< of the bars at the tips, in standard uncertainties

/// mm to px with one scale in both directions.
struct MapView {
  double left = 72.0, top = 64.0, width = 0.0, height = 0.0;
  double x_from = 0.0, y_from = 0.0, px_per_mm = 1.0;
  [[nodiscard]] double px(double x_mm) const { return left + (x_mm - x_from) * px_per_mm; }
  [[nodiscard]] double py(double y_mm) const { return top + height - (y_mm - y_from) * px_per_mm; }
};

MapView viewOf(const std::vector<PointDisplacement>& points, int width_px) {
  constexpr double right = 110.0;
  Eigen::Array2d low = points.front().position_mm.head<2>(), high = low;
  for (const PointDisplacement& p : points) {
    low = low.min(p.position_mm.head<2>().array());
    high = high.max(p.position_mm.head<2>().array());
  }
  // Room for arrows and labels around the points.
  const double margin = 0.16 * (high - low).maxCoeff();
  low -= margin;
  high += margin;
  MapView view;
  view.width = width_px - view.left - right;
  const Eigen::Array2d span = high - low;
  view.px_per_mm = view.width / span.x();
  view.height = span.y() * view.px_per_mm;
  const double tallest = 0.8 * view.width;
  if (view.height > tallest) {
    view.px_per_mm *= tallest / view.height;
    view.height = tallest;
    low.x() -= 0.5 * (view.width / view.px_per_mm - span.x());
  }
  view.x_from = low.x();
  view.y_from = low.y();
  return view;
}

/// 1, 2 or 5 times a power of ten, not above `value`.
double roundDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= value) return factor * power;
  return power;
}

/// How many times as long arrows may be drawn so that each, with the bars at its tip, ends inside the frame.
double factorInside(const std::vector<PointDisplacement>& points, const MapView& v) {
  constexpr double room_px = 6.0;  ///< for the head of an arrow
  double factor = std::numeric_limits<double>::infinity();
  for (const PointDisplacement& p : points) {
    if (!std::isfinite(p.change_um.x()) || !std::isfinite(p.change_um.y())) continue;
    const double x = v.px(p.position_mm.x()) - v.left, y = v.py(p.position_mm.y()) - v.top;
    const std::array<double, 2> before{x - room_px, v.height - y - room_px};
    const std::array<double, 2> behind{v.width - x - room_px, y - room_px};
    for (int i = 0; i < 2; ++i) {
      const double bar_um = coverage * p.sigma_um[i];
      const auto limit = [&](double reach_um, double room) {
        if (reach_um > 0.0) factor = std::min(factor, room * um_per_mm / (reach_um * v.px_per_mm));
      };
      limit(bar_um - p.change_um[i], before[static_cast<std::size_t>(i)]);
      limit(bar_um + p.change_um[i], behind[static_cast<std::size_t>(i)]);
    }
  }
  return factor;
}

void drawMapAxes(Drawing& canvas, const MapView& v) {
  const double bottom = v.top + v.height, right = v.left + v.width;
  const std::vector<double> xs =
      roundTicks(v.x_from, v.x_from + v.width / v.px_per_mm, std::max(3, static_cast<int>(v.width / 90)));
  const std::vector<double> ys =
      roundTicks(v.y_from, v.y_from + v.height / v.px_per_mm, std::max(3, static_cast<int>(v.height / 60)));
  for (const double x : xs) {
    canvas.line(v.px(x), v.top, v.px(x), bottom, map_grid, 1.0);
    canvas.text(v.px(x), bottom + 19.0, tickText(x, xs.size() > 1 ? xs[1] - xs[0] : 1.0), 12.0, TextAnchor::Middle);
  }
  for (const double y : ys) {
    canvas.line(v.left, v.py(y), right, v.py(y), map_grid, 1.0);
    canvas.text(v.left - 8.0, v.py(y) + 4.0, tickText(y, ys.size() > 1 ? ys[1] - ys[0] : 1.0), 12.0, TextAnchor::End);
  }
  for (const auto& [x1, y1, x2, y2] :
       {std::array{v.left, v.top, right, v.top}, std::array{v.left, bottom, right, bottom},
        std::array{v.left, v.top, v.left, bottom}, std::array{right, v.top, right, bottom}}) {
    canvas.line(x1, y1, x2, y2, map_grey, 1.0);
  }
  canvas.text(v.left + 0.5 * v.width, bottom + 38.0, "X / mm", 13.0, TextAnchor::Middle);
  canvas.text(20.0, v.top + 0.5 * v.height, "Y / mm", 13.0, TextAnchor::Middle, false, true);
}

void drawMapColourBar(Drawing& canvas, const MapView& v, double limit) {
  constexpr int steps = 48;
  const double left = v.left + v.width + 22.0, height = std::min(v.height, 220.0);
  const double top = v.top + 0.5 * (v.height - height);
  for (int i = 0; i < steps; ++i) {
    const auto [r, g, b] = coolWarm(1.0 - 2.0 * (i + 0.5) / steps);
    canvas.rectangle(left, top + height * i / steps, 16.0, height / steps + 0.5, {r, g, b});
  }
  const std::vector<double> ticks = roundTicks(-limit, limit, 4);
  for (const double t : ticks) {
    const double y = top + 0.5 * height * (1.0 - t / limit);
    canvas.line(left + 16.0, y, left + 21.0, y, map_ink, 1.0);
    canvas.text(left + 25.0, y + 4.0, tickText(t, ticks.size() > 1 ? ticks[1] - ticks[0] : limit), 12.0,
                TextAnchor::Start);
  }
  canvas.text(left, top - 10.0, "EZ / µm", 13.0, TextAnchor::Start);
}

void drawArrow(Drawing& canvas, double x, double y, double tip_x, double tip_y) {
  const double length = std::hypot(tip_x - x, tip_y - y);
  if (length < 2.0) return;
  canvas.line(x, y, tip_x, tip_y, map_ink, 2.0);
  const double ux = (tip_x - x) / length, uy = (tip_y - y) / length;
  const double back = std::min(8.0, length), side = 0.5 * back;
  canvas.line(tip_x, tip_y, tip_x - back * ux - side * uy, tip_y - back * uy + side * ux, map_ink, 2.0);
  canvas.line(tip_x, tip_y, tip_x - back * ux + side * uy, tip_y - back * uy - side * ux, map_ink, 2.0);
}

void drawPoint(Drawing& canvas, const MapView& v, const PointDisplacement& p, double factor, double limit) {
  const double px_per_um = factor / um_per_mm * v.px_per_mm;
  const double x = v.px(p.position_mm.x()), y = v.py(p.position_mm.y());
  const bool flat = std::isfinite(p.change_um.x()) && std::isfinite(p.change_um.y());
  const bool high = std::isfinite(p.change_um.z());
  double tip_y = y;
  if (flat) {
    const double tip_x = x + p.change_um.x() * px_per_um;
    tip_y = y - p.change_um.y() * px_per_um;
    const double bar_x = coverage * p.sigma_um.x() * px_per_um, bar_y = coverage * p.sigma_um.y() * px_per_um;
    canvas.line(tip_x - bar_x, tip_y, tip_x + bar_x, tip_y, map_grey, 1.0);
    canvas.line(tip_x, tip_y - bar_y, tip_x, tip_y + bar_y, map_grey, 1.0);
    drawArrow(canvas, x, y, tip_x, tip_y);
  }
  PictureColour fill{255, 255, 255};
  if (high) {
    const auto [r, g, b] = coolWarm(p.change_um.z() / limit);
    fill = {r, g, b};
  }
  canvas.disc(x, y, 7.0, fill, map_ink);
  std::string label = p.point;
  if (high) label += ": " + withUncertainty(p.change_um.z(), p.sigma_um.z(), "");
  // On the side away from the arrow.
  canvas.text(x, tip_y > y ? y - 12.0 : y + 23.0, label, 12.0, TextAnchor::Middle, false, false, true);
}

}  // namespace

std::optional<Drawing> pointMap(const std::vector<PointDisplacement>& points, const PointMapOptions& options) {
  if (points.empty()) return std::nullopt;
  double longest = 0.0, highest = 0.0, spread = 0.0;
  for (const PointDisplacement& p : points) {
    spread = std::max(spread, (p.position_mm - points.front().position_mm).head<2>().norm());
    const double flat = p.change_um.head<2>().norm();
    if (std::isfinite(flat)) longest = std::max(longest, flat);
    if (std::isfinite(p.change_um.z())) highest = std::max(highest, std::abs(p.change_um.z()));
  }
  if (!(spread > 0.0)) return std::nullopt;
  const MapView view = viewOf(points, options.width_px);
  const double limit = roundLimit(highest);
  const double sixth = view.width / 6.0 / view.px_per_mm * um_per_mm;
  const double factor = longest > 0.0 ? roundDown(std::min(sixth / longest, factorInside(points, view))) : 1.0;
  Drawing canvas(options.width_px, std::round(view.top + view.height + 78.0));
  canvas.text(16.0, 26.0, options.title, 16.0, TextAnchor::Start, true);
  canvas.text(16.0, 46.0, options.subtitle, 12.0, TextAnchor::Start);
  drawMapAxes(canvas, view);
  drawMapColourBar(canvas, view, limit);
  for (const PointDisplacement& p : points) drawPoint(canvas, view, p, factor, limit);
  // A stroke as long as a round displacement.
  const double scale_um = roundDown(std::max(longest, 1e-3));
  const double y = view.top + view.height + 62.0;
  const double length = scale_um * factor / um_per_mm * view.px_per_mm;
  canvas.line(view.left, y - 4.0, view.left + length, y - 4.0, map_ink, 2.0);
  canvas.text(view.left + length + 10.0, y,
              fmt::format("{:g} µm in X and Y, drawn {:g} times as long; bars: 2 standard uncertainties; number: EZ",
                          scale_um, factor),
              12.0, TextAnchor::Start);
  return canvas;
}

}  // namespace spindrift
