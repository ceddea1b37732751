// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/test_part_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace spindrift {
namespace {

constexpr double largest_part = 0.08;  ///< of the side: the largest deviation as drawn
constexpr double smallest_um = 1e-6;
constexpr double margin_px = 54.0, foot_px = 30.0;
constexpr int circle_steps = 48;

/// Of datum C.
Eigen::Vector2d datumOf(const TestPart& part, std::span<const Eigen::Vector3d> deviation_um) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const PartFeature& feature : part.features()) {
    if (feature.id != "bore") continue;
    for (std::size_t i = 0; i < feature.count; ++i)
      sum += deviation_um[feature.first + i].head<2>() / static_cast<double>(feature.count);
  }
  return sum;
}

/// "20000" -> "20 000".
std::string grouped(double factor) {
  std::string text = fmt::format("{:.0f}", factor);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), "\u202f");
  return text;
}

}  // namespace

double testPartExaggeration(const TestPart& part, std::span<const Eigen::Vector3d> deviation_um) {
  const Eigen::Vector2d datum = datumOf(part, deviation_um);
  double largest = 0.0;
  for (const Eigen::Vector3d& d : deviation_um) largest = std::max(largest, (d.head<2>() - datum).norm());
  if (largest < smallest_um) return 0.0;
  const double most = largest_part * part.options().side_mm / (1e-3 * largest);
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0})
    if (step * power <= most) return step * power;
  return power;
}

Drawing testPartDrawing(const TestPart& part, std::span<const Eigen::Vector3d> deviation_um,
                        const TestPartDrawingOptions& options) {
  Drawing drawing(options.width_px, options.height_px);
  drawing.rectangle(0.0, 0.0, options.width_px, options.height_px, options.ground);
  const double factor = options.factor.value_or(testPartExaggeration(part, deviation_um));
  const Eigen::Vector2d datum = datumOf(part, deviation_um);
  const double side = part.options().side_mm;
  const double room_px = std::min(options.width_px - 2.0 * margin_px, options.height_px - 2.0 * margin_px - foot_px);
  const double scale = room_px / side;
  const Eigen::Vector2d centre = part.options().centre_mm.head<2>();
  const double middle_x = 0.5 * options.width_px, middle_y = 0.5 * (options.height_px - foot_px);
  const auto pixel = [&](const Eigen::Vector2d& p) {
    return Drawing::Point{middle_x + scale * (p.x() - centre.x()), middle_y - scale * (p.y() - centre.y())};
  };
  const auto actual = [&](std::size_t i) -> Eigen::Vector2d {
    return part.points()[i].position_mm.head<2>() + 1e-3 * factor * (deviation_um[i].head<2>() - datum);
  };
  const auto circleAt = [&](const Eigen::Vector2d& at, double diameter_mm) {
    std::vector<Drawing::Point> out;
    for (int i = 0; i <= circle_steps; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / circle_steps;
      out.push_back(pixel(at + 0.5 * diameter_mm * Eigen::Vector2d(std::cos(angle), std::sin(angle))));
    }
    return out;
  };
  std::vector<std::vector<Drawing::Point>> plain, moved, deep;
  for (const PartFeature& feature : part.features()) {
    if (feature.kind == PartFeature::Kind::Hole) {
      plain.push_back(circleAt(feature.centre_mm, feature.length_mm));
      moved.push_back(circleAt(actual(feature.first), feature.length_mm));
      deep.push_back(circleAt(actual(feature.first + feature.count - 1), feature.length_mm));
      continue;
    }
    std::vector<Drawing::Point> before, after;
    for (std::size_t i = 0; i < feature.count; ++i) {
      before.push_back(pixel(part.points()[feature.first + i].position_mm.head<2>()));
      after.push_back(pixel(actual(feature.first + i)));
    }
    if (feature.kind == PartFeature::Kind::Circle) {
      before.push_back(before.front());
      after.push_back(after.front());
    }
    plain.push_back(std::move(before));
    moved.push_back(std::move(after));
  }
  drawing.path(std::move(plain), {.stroke = options.nominal, .width = 1.2});
  // Where a hole ends below, faint: a bore that leans.
  if (factor > 0.0) drawing.path(std::move(deep), {.stroke = options.actual, .width = 1.0, .opacity = 0.45});
  if (factor > 0.0) drawing.path(std::move(moved), {.stroke = options.actual, .width = 1.8});

  TextLook small;
  small.size = 12.0;
  small.colour = options.soft;
  TextLook middle = small;
  middle.anchor = TextAnchor::Middle;
  const double half = 0.5 * room_px;
  drawing.text(middle_x, middle_y + half + 46.0, "1 (B)", middle);
  drawing.text(middle_x + half + 44.0, middle_y + 4.0, "2", middle);
  drawing.text(middle_x, middle_y - half - 38.0, "3", middle);
  drawing.text(middle_x - half - 44.0, middle_y + 4.0, "4", middle);
  for (const PartFeature& feature : part.features()) {
    if (feature.kind != PartFeature::Kind::Hole) continue;
    const Drawing::Point at = pixel(feature.centre_mm);
    drawing.text(at[0], at[1] + 4.0, feature.id == "bore" ? "C" : feature.id.substr(5), middle);
  }
  TextLook legend = middle;
  drawing.text(middle_x, options.height_px - 10.0,
               factor > 0.0 ? fmt::format(fmt::runtime(options.legend), grouped(factor)) : options.no_deviation,
               legend);
  return drawing;
}

}  // namespace spindrift
