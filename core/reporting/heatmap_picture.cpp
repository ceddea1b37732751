// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/heatmap_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/reporting/drawing.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

constexpr double significance = 2.0;
constexpr double faded_part = 0.6;
constexpr PictureColour ink = picture_ink;
constexpr PictureColour grey{120, 130, 140};
constexpr PictureColour white{255, 255, 255};
constexpr PictureColour missing{236, 236, 236};

/// Where everything stands. px.
struct HeatmapLayout {
  double left = 78.0, top = 72.0, width = 0.0, height = 0.0;
  double bar_left = 0.0, bar_width = 18.0;
  int picture_width = 0, picture_height = 0;
  const FieldGrid* grid = nullptr;

  [[nodiscard]] double px(double x_mm) const {
    return left + (x_mm - grid->x_from_mm) / (grid->x_to_mm - grid->x_from_mm) * width;
  }
  [[nodiscard]] double py(double y_mm) const {
    return top + (grid->y_to_mm - y_mm) / (grid->y_to_mm - grid->y_from_mm) * height;
  }
};

HeatmapLayout layoutOf(const FieldGrid& grid, const HeatmapPictureOptions& options) {
  HeatmapLayout l;
  l.grid = &grid;
  // A small picture has narrow margins.
  const bool small = options.width_px < 600;
  if (small) l.left = 62.0;
  if (options.subtitle.empty()) l.top -= 10.0;
  const double right = small ? 86.0 : 118.0;           // colour bar and its labels
  const double bottom = options.legend ? 96.0 : 52.0;  // tick labels, axis label, legend
  l.picture_width = options.width_px;
  const double room = options.width_px - l.left - right;
  const double aspect = (grid.y_to_mm - grid.y_from_mm) / (grid.x_to_mm - grid.x_from_mm);
  const double tallest = 1.1 * room;
  l.width = room;
  l.height = room * aspect;
  if (l.height > tallest) {
    l.height = tallest;
    l.width = tallest / aspect;
    l.left += 0.5 * (room - l.width);
  }
  constexpr double lowest = 120.0;  // the colour bar needs room for its ticks
  l.height = std::max(l.height, lowest);
  l.bar_left = l.left + l.width + (small ? 16.0 : 24.0);
  l.picture_height = static_cast<int>(std::lround(l.top + l.height + bottom));
  return l;
}

PictureColour mixed(PictureColour a, PictureColour b, double part) {
  const auto mix = [part](std::uint8_t p, std::uint8_t q) {
    return static_cast<std::uint8_t>(std::lround(p + (q - p) * part));
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

PictureColour colourOf(double value, double sigma, double limit) {
  if (!std::isfinite(value) || !std::isfinite(sigma)) return missing;
  // In steps that the eye does not see, so that equal neighbours can be drawn as one.
  constexpr double steps = 64.0;
  const auto [r, g, b] = coolWarm(std::round(value / limit * steps) / steps);
  const PictureColour full{r, g, b};
  return std::abs(value) < significance * sigma ? mixed(full, white, faded_part) : full;
}

void drawCells(Drawing& canvas, const HeatmapLayout& l, const Field& field, double limit) {
  const FieldGrid& g = field.grid;
  const double half_x = 0.5 * l.width / (g.nx - 1);
  const double half_y = 0.5 * l.height / (g.ny - 1);
  for (int iy = 0; iy < g.ny; ++iy) {
    const double y = l.py(g.y_mm(iy));
    const double top = std::max(l.top, y - half_y);
    const double bottom = std::min(l.top + l.height, y + half_y);
    for (int ix = 0; ix < g.nx;) {
      const PictureColour colour = colourOf(field.value[g.index(ix, iy)], field.sigma[g.index(ix, iy)], limit);
      int end = ix + 1;
      while (end < g.nx && colour == colourOf(field.value[g.index(end, iy)], field.sigma[g.index(end, iy)], limit)) {
        ++end;
      }
      const double from = std::max(l.left, l.px(g.x_mm(ix)) - half_x);
      const double to = std::min(l.left + l.width, l.px(g.x_mm(end - 1)) + half_x);
      canvas.rectangle(from, top, to - from, bottom - top, colour);
      ix = end;
    }
  }
}

/// Diagonal lines over the cells outside the measured region.
void drawHatching(Drawing& canvas, const HeatmapLayout& l, const Field& field) {
  constexpr double spacing = 9.0;
  constexpr double step = 1.5;
  const FieldGrid& g = field.grid;
  const auto extrapolated = [&](double x, double y) {
    const int ix = std::clamp(static_cast<int>(std::lround((x - l.left) / l.width * (g.nx - 1))), 0, g.nx - 1);
    const int iy =
        std::clamp(static_cast<int>(std::lround((l.top + l.height - y) / l.height * (g.ny - 1))), 0, g.ny - 1);
    return static_cast<bool>(field.extrapolated[g.index(ix, iy)]);
  };
  for (double offset = spacing; offset < l.width + l.height; offset += spacing) {
    // From the left or bottom border up to the right: x + (bottom - y) = offset.
    const double from = std::max(0.0, offset - l.height);
    const double to = std::min(l.width, offset);
    double start = -1.0;
    for (double x = from;; x += step) {
      const bool last = x >= to;
      const double at = std::min(x, to);
      const double y = l.top + (offset - at);
      const bool inside = !last && extrapolated(l.left + at, y);
      if (inside && start < 0.0) start = at;
      if (!inside && start >= 0.0) {
        canvas.line(l.left + start, l.top + offset - start, l.left + at, y, grey, 0.6);
        start = -1.0;
      }
      if (last) break;
    }
  }
}

/// Contour |value| = 2 sigma by marching squares.
void drawSignificance(Drawing& canvas, const HeatmapLayout& l, const Field& field) {
  const FieldGrid& g = field.grid;
  const auto level = [&](int ix, int iy) {
    const std::size_t i = g.index(ix, iy);
    return std::abs(field.value[i]) - significance * field.sigma[i];
  };
  for (int iy = 0; iy + 1 < g.ny; ++iy) {
    for (int ix = 0; ix + 1 < g.nx; ++ix) {
      const std::array<std::array<int, 2>, 5> corner{
          {{ix, iy}, {ix + 1, iy}, {ix + 1, iy + 1}, {ix, iy + 1}, {ix, iy}}};
      std::vector<std::array<double, 2>> crossing;
      for (std::size_t k = 0; k < 4; ++k) {
        const double a = level(corner[k][0], corner[k][1]);
        const double b = level(corner[k + 1][0], corner[k + 1][1]);
        if (!std::isfinite(a) || !std::isfinite(b) || (a < 0.0) == (b < 0.0)) continue;
        const double part = a / (a - b);
        const double x = g.x_mm(corner[k][0]) + part * (g.x_mm(corner[k + 1][0]) - g.x_mm(corner[k][0]));
        const double y = g.y_mm(corner[k][1]) + part * (g.y_mm(corner[k + 1][1]) - g.y_mm(corner[k][1]));
        crossing.push_back({l.px(x), l.py(y)});
      }
      for (std::size_t k = 0; k + 1 < crossing.size(); k += 2) {
        canvas.line(crossing[k][0], crossing[k][1], crossing[k + 1][0], crossing[k + 1][1], ink, 1.0);
      }
    }
  }
}

/// Round marks; a scale of one or two says little, then half their distance.
std::vector<double> scaleTicks(double from, double to, int wanted) {
  std::vector<double> ticks = roundTicks(from, to, wanted);
  return ticks.size() < 3 ? roundTicks(from, to, 2 * wanted) : ticks;
}

void drawAxes(Drawing& canvas, const HeatmapLayout& l, const Field& field) {
  const FieldGrid& g = field.grid;
  const double right = l.left + l.width;
  const double bottom = l.top + l.height;
  for (const auto& [x1, y1, x2, y2] :
       {std::array{l.left, l.top, right, l.top}, std::array{l.left, bottom, right, bottom},
        std::array{l.left, l.top, l.left, bottom}, std::array{right, l.top, right, bottom}}) {
    canvas.line(x1, y1, x2, y2, ink, 1.0);
  }
  const std::vector<double> xs = scaleTicks(g.x_from_mm, g.x_to_mm, std::max(3, static_cast<int>(l.width / 90)));
  const std::vector<double> ys = scaleTicks(g.y_from_mm, g.y_to_mm, std::max(3, static_cast<int>(l.height / 60)));
  const double x_step = xs.size() > 1 ? xs[1] - xs[0] : 1.0;
  const double y_step = ys.size() > 1 ? ys[1] - ys[0] : 1.0;
  for (const double x : xs) {
    canvas.line(l.px(x), bottom, l.px(x), bottom + 5.0, ink, 1.0);
    canvas.text(l.px(x), bottom + 19.0, tickText(x, x_step), 12.0, TextAnchor::Middle);
  }
  for (const double y : ys) {
    canvas.line(l.left - 5.0, l.py(y), l.left, l.py(y), ink, 1.0);
    canvas.text(l.left - 9.0, l.py(y) + 4.0, tickText(y, y_step), 12.0, TextAnchor::End);
  }
  canvas.text(l.left + 0.5 * l.width, bottom + 40.0, "x / mm", 13.0, TextAnchor::Middle);
  canvas.text(l.left - 48.0, l.top + 0.5 * l.height, "y / mm", 13.0, TextAnchor::Middle, false, true);
}

void drawColourBar(Drawing& canvas, const HeatmapLayout& l, const Field& field, double limit) {
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const double part = 1.0 - 2.0 * (i + 0.5) / steps;
    const auto [r, g, b] = coolWarm(part);
    canvas.rectangle(l.bar_left, l.top + l.height * i / steps, l.bar_width, l.height / steps + 0.5, {r, g, b});
  }
  const std::vector<double> ticks = scaleTicks(-limit, limit, std::max(3, static_cast<int>(l.height / 40)));
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : limit;
  for (const double t : ticks) {
    const double y = l.top + 0.5 * l.height * (1.0 - t / limit);
    canvas.line(l.bar_left + l.bar_width, y, l.bar_left + l.bar_width + 5.0, y, ink, 1.0);
    canvas.text(l.bar_left + l.bar_width + 9.0, y + 4.0, tickText(t, step), 12.0, TextAnchor::Start);
  }
  canvas.text(l.bar_left, l.top - 10.0,
              fmt::format("{} / {}", toString(field.component), printedUnitOf(field.component)), 13.0,
              TextAnchor::Start);
}

std::size_t lettersOf(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

double overlap(const Box& a, const Box& b) {
  const double x = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double y = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  return x > 0.0 && y > 0.0 ? x * y : 0.0;
}

struct LabelPlace {
  double x = 0.0, base = 0.0;
  double covered = 0.0;  ///< of what is there already, px^2
};

/// Where a label of a point covers least of what is there already: below, above (beyond an arrow that points up by
/// `up`), to the right or left, and once more further away; inside the frame.
LabelPlace freePlace(const HeatmapLayout& l, const std::vector<Box>& taken, double x, double y, double half,
                     double size, double up) {
  const double below = y + 20.0 + std::max(0.0, -up), above = y - 10.0 - std::max(0.0, up);
  const std::array<LabelPlace, 8> candidates{{{x, up < 0.0 ? above : below},
                                              {x, up < 0.0 ? below : above},
                                              {x + half + 9.0, y + 4.0},
                                              {x - half - 9.0, y + 4.0},
                                              {x, below + 15.0},
                                              {x, above - 15.0},
                                              {x + half + 9.0, y + 19.0},
                                              {x - half - 9.0, y - 11.0}}};
  LabelPlace best;
  double least = 1e300;
  for (LabelPlace place : candidates) {
    const double leftmost = l.left + half + 2.0;
    place.x = std::clamp(place.x, leftmost, std::max(leftmost, l.left + l.width - half - 2.0));
    place.base = std::clamp(place.base, l.top + size, l.top + l.height - 4.0);
    double covered = 0.0;
    for (const Box& box : taken)
      covered += overlap(box, {place.x - half, place.base - size, place.x + half, place.base + 3.0});
    if (covered >= least) continue;
    least = covered;
    best = place;
    best.covered = covered;
  }
  return best;
}

void drawMarkers(Drawing& canvas, const HeatmapLayout& l, const Field& field, double limit) {
  constexpr double longest = 38.0;
  constexpr double size = 12.0;
  constexpr double most_covered = 12.0;  // px^2: they touch, and can be read
  const bool across = field.component == Component::EX || field.component == Component::EB;
  std::vector<Box> taken;
  for (const Field::Marker& m : field.markers) {
    const double x = l.px(m.position_mm.x()), y = l.py(m.position_mm.y());
    taken.push_back({x - 5.0, y - 5.0, x + 5.0, y + 5.0});
  }
  for (const Field::Marker& m : field.markers) {
    const double x = l.px(m.position_mm.x());
    const double y = l.py(m.position_mm.y());
    const double length = std::clamp(m.value / limit, -1.0, 1.0) * longest;
    const double tip_x = across ? x + length : x;
    const double tip_y = across ? y : y - length;
    if (std::abs(length) > 3.0) {
      canvas.line(x, y, tip_x, tip_y, ink, 2.0);
      const double back = std::copysign(std::min(7.0, std::abs(length)), length);
      for (const double side : {-4.0, 4.0}) {
        if (across) {
          canvas.line(tip_x, tip_y, tip_x - back, tip_y + side, ink, 2.0);
        } else {
          canvas.line(tip_x, tip_y, tip_x + side, tip_y + back, ink, 2.0);
        }
      }
    }
    canvas.disc(x, y, 4.0, m.used ? ink : white, ink);
    // Where points are close the name alone, and where that would cover another nothing: the table lists them all.
    for (const std::string& label : {m.point + ": " + withUncertainty(m.value, m.sigma, ""), m.point}) {
      // About 0.55 of the size per character.
      const double half = 0.275 * size * static_cast<double>(lettersOf(label));
      const LabelPlace place = freePlace(l, taken, x, y, half, size, across ? 0.0 : length);
      if (place.covered > most_covered) continue;
      taken.push_back({place.x - half, place.base - size, place.x + half, place.base + 3.0});
      canvas.text(place.x, place.base, label, size, TextAnchor::Middle, false, false, true);
      break;
    }
  }
}

void draw(Drawing& canvas, const HeatmapLayout& l, const Field& field, const HeatmapPictureOptions& options) {
  const double limit = options.limit.value_or(roundLimit(field.largestMagnitude()));
  drawCells(canvas, l, field, limit);
  drawHatching(canvas, l, field);
  drawSignificance(canvas, l, field);
  drawAxes(canvas, l, field);
  drawColourBar(canvas, l, field, limit);
  drawMarkers(canvas, l, field, limit);
  const std::string title =
      options.title.empty() ? fmt::format("{} over the table", toString(field.component)) : options.title;
  canvas.text(16.0, 28.0, title, 18.0, TextAnchor::Start, true);
  if (!options.subtitle.empty()) canvas.text(16.0, 48.0, options.subtitle, 12.0, TextAnchor::Start);
  if (!options.legend) return;
  const std::array<std::string_view, 3> legend{"pale: below 2 standard uncertainties",
                                               "hatched: outside the measured points", "hollow point: not fitted"};
  double whole = 0.0;
  for (const std::string_view entry : legend) whole += 6.6 * static_cast<double>(entry.size()) + 24.0;
  const bool two_lines = whole > l.picture_width - 16.0;
  double x = 16.0;
  double y = l.picture_height - (two_lines ? 30.0 : 16.0);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    if (two_lines && i == 2) {
      x = 16.0;
      y += 16.0;
    }
    canvas.text(x, y, legend[i], 12.0, TextAnchor::Start);
    x += 6.6 * static_cast<double>(legend[i].size()) + 24.0;
  }
}

void check(const Field& field, const HeatmapPictureOptions& options) {
  options.validate();
  SPINDRIFT_ASSERT(field.value.size() == field.grid.size() && field.sigma.size() == field.grid.size() &&
                       field.extrapolated.size() == field.grid.size(),
                   "a field has one value per node");
}

}  // namespace

void HeatmapPictureOptions::validate() const {
  if (width_px < 480 || width_px > 8000) {
    throw InputError(fmt::format("a picture of {} px is not possible; allowed: 480 to 8000 px wide.", width_px));
  }
  if (limit && !(*limit > 0.0)) {
    throw InputError(fmt::format("a colour limit of {} is not possible; allowed: greater than zero.", *limit));
  }
}

std::array<std::uint8_t, 3> coolWarm(double part) {
  // Moreland's cool-warm map at nine equal steps.
  constexpr std::array<std::array<double, 3>, 9> table{{{59, 76, 192},
                                                        {98, 130, 234},
                                                        {141, 176, 254},
                                                        {184, 208, 249},
                                                        {221, 221, 221},
                                                        {245, 196, 173},
                                                        {244, 154, 123},
                                                        {222, 96, 77},
                                                        {180, 4, 38}}};
  const double at = (std::clamp(part, -1.0, 1.0) + 1.0) * 4.0;
  const auto low = std::min<std::size_t>(7, static_cast<std::size_t>(at));
  const double rest = at - static_cast<double>(low);
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    colour[c] = static_cast<std::uint8_t>(std::lround(table[low][c] + rest * (table[low + 1][c] - table[low][c])));
  }
  return colour;
}

double roundLimit(double magnitude) {
  if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(magnitude)));
  for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) {
    if (factor * power >= magnitude * (1.0 - 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

Drawing heatmapPicture(const Field& field, const HeatmapPictureOptions& options) {
  check(field, options);
  const HeatmapLayout layout = layoutOf(field.grid, options);
  Drawing drawing(layout.picture_width, layout.picture_height);
  draw(drawing, layout, field, options);
  return drawing;
}

}  // namespace spindrift
