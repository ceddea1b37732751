// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/effect_drawing.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/driver_words.h"

namespace spindrift {
namespace {

constexpr int lines = 8;   ///< spaces between lines of the grid
constexpr int steps = 32;  ///< along a line
constexpr double view_px = 190.0, view_gap_px = 26.0, head_px = 22.0, foot_px = 40.0;
constexpr double exaggerated = 0.10;  ///< of the longest axis: the largest displacement as drawn
constexpr PictureColour body_grey{205, 211, 218}, accent{11, 114, 133}, soft{82, 96, 109};

struct EffectView {
  const char* name;
  int across, up;
};
constexpr std::array<EffectView, 3> views{{{"Top", 0, 1}, {"Front", 0, 2}, {"Side", 1, 2}}};
constexpr const char* letters[3] = {"X", "Y", "Z"};

}  // namespace

std::optional<Drawing> effectDrawing(const Effect& effect, const EffectDrawingOptions& options) {
  if (options.gain >= effect.shape.size()) return std::nullopt;
  const ShapeColumn& column = effect.shape[options.gain];
  const auto& travel = options.travel_mm;
  Eigen::Vector3d middle_mm;
  double longest_mm = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto& range = travel[static_cast<std::size_t>(i)];
    middle_mm[i] = 0.5 * (range[0] + range[1]);
    longest_mm = std::max(longest_mm, range[1] - range[0]);
  }
  const auto at = [&](const EffectView& view, double a, double b) {
    Eigen::Vector3d p = middle_mm;
    const auto& h = travel[static_cast<std::size_t>(view.across)];
    const auto& v = travel[static_cast<std::size_t>(view.up)];
    p[view.across] = h[0] + a * (h[1] - h[0]);
    p[view.up] = v[0] + b * (v[1] - v[0]);
    return p;
  };
  const auto deviation = [&](const Eigen::Vector3d& p, bool rotations) {
    DeviationQuery query;
    query.position_mm = p;
    query.point = "<point>";  // of the effect of one point that slips
    query.approach = Eigen::Vector3d::Ones();
    Eigen::Vector3d d;
    for (int i = 0; i < 3; ++i) d[i] = column.value(query, static_cast<Component>(i + (rotations ? 3 : 0)));
    return d;
  };
  const auto largestOf = [&](bool rotations) {
    double largest = 0.0;
    for (const EffectView& view : views)
      for (int i = 0; i <= lines; ++i)
        for (int j = 0; j <= lines; ++j)
          if (const Eigen::Vector3d d = deviation(at(view, double(i) / lines, double(j) / lines), rotations);
              d.allFinite())
            largest = std::max(largest, d.norm());
    return largest;
  };
  double largest = largestOf(false);
  const bool rotations = !(largest > 0.0);
  if (rotations) largest = largestOf(true);
  if (!(largest > 0.0)) return std::nullopt;

  const double scale = (view_px - 2.0 * view_gap_px) / longest_mm;
  const double magnified = exaggerated * longest_mm / largest;
  double tallest = 0.0;
  for (const EffectView& view : views) {
    const auto& v = travel[static_cast<std::size_t>(view.up)];
    tallest = std::max(tallest, scale * (v[1] - v[0]));
  }
  const double height = head_px + tallest + 2.0 * view_gap_px + foot_px;
  Drawing drawing(3.0 * view_px, height);
  for (std::size_t n = 0; n < views.size(); ++n) {
    const EffectView& view = views[n];
    const double left = view_px * static_cast<double>(n) + view_gap_px;
    const double bottom = head_px + view_gap_px + tallest;
    const auto pixel = [&](const Eigen::Vector3d& p) {
      return Drawing::Point{left + scale * (p[view.across] - travel[static_cast<std::size_t>(view.across)][0]),
                            bottom - scale * (p[view.up] - travel[static_cast<std::size_t>(view.up)][0])};
    };
    drawing.text(left, 14.0, view.name, 12.0, TextAnchor::Start, true);
    drawing.beginWindow(view_px * static_cast<double>(n), head_px, view_px, height - head_px - foot_px);
    std::vector<std::vector<Drawing::Point>> plain, moved;
    for (const bool across : {true, false}) {
      for (int line = 0; line <= lines; ++line) {
        std::vector<Drawing::Point> before, after;
        for (int i = 0; i <= steps; ++i) {
          const double along = double(i) / steps, beside = double(line) / lines;
          const Eigen::Vector3d p = across ? at(view, along, beside) : at(view, beside, along);
          before.push_back(pixel(p));
          const Eigen::Vector3d d = deviation(p, false);
          if (d.allFinite()) {
            after.push_back(pixel(p + magnified * d));
          } else if (after.size() > 1) {
            moved.push_back(std::exchange(after, {}));
          } else {
            after.clear();
          }
        }
        plain.push_back(std::move(before));
        if (after.size() > 1) moved.push_back(std::move(after));
      }
    }
    drawing.path(std::move(plain), {.stroke = body_grey, .width = 0.8});
    if (rotations) {
      for (int i = 1; i < lines; i += 2) {
        for (int j = 1; j < lines; j += 2) {
          const Eigen::Vector3d p = at(view, double(i) / lines, double(j) / lines);
          const Eigen::Vector3d d = deviation(p, true);
          if (!d.allFinite()) continue;
          const Drawing::Point from = pixel(p), to = pixel(p + magnified * d);
          drawing.disc(from[0], from[1], 1.6, accent);
          drawing.line(from[0], from[1], to[0], to[1], accent, 1.4);
        }
      }
    } else {
      drawing.path(std::move(moved), {.stroke = accent, .width = 1.2});
    }
    drawing.endWindow();
    const double below = bottom + view_gap_px - 6.0;
    drawing.text(left, below, fmt::format("{} →", letters[view.across]), 10.0, TextAnchor::Start);
    drawing.text(left - 10.0, bottom, fmt::format("{} →", letters[view.up]), 10.0, TextAnchor::Start, false, true);
  }
  TextLook small;
  small.size = 10.0;
  small.colour = soft;
  std::string legend = fmt::format("largest {} for a gain of 1 {}: {:.3g} {}", rotations ? "rotation" : "displacement",
                                   gainUnit(column.gain_unit), largest, rotations ? "µrad" : "µm");
  if (!rotations) legend += fmt::format("; drawn {:.1e} times its size", 1e3 * magnified);
  drawing.text(view_gap_px, height - 10.0, legend, small);
  return drawing;
}

}  // namespace spindrift
