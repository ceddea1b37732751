// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/effect_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <utility>

#include "core/machine/driver_words.h"
#include "core/reporting/heatmap_picture.h"

namespace spindrift {
namespace {

constexpr int lines_along = 8;  ///< spaces between lines of the grid
constexpr int samples_along = 96;
constexpr double default_travel_mm = 500.0;
constexpr double pole = 50.0;         ///< times the 70th percentile: nothing that can be drawn beside the rest
constexpr double least_length = 0.3;  ///< of the longest axis, as drawn
constexpr double text_px = 12.0;
constexpr double line_px = 15.0;                   ///< of a text
constexpr double letter_px = 0.53 * text_px;       ///< about what a letter takes
constexpr double title_px = 20.0, axes_px = 24.0;  ///< above a view; at its left and below
constexpr double scale_px = 36.0;                  ///< the colours with their numbers
constexpr double unit_px = 36.0;                   ///< the unit behind them
constexpr double least_legend_px = 150.0;          ///< beside the views
constexpr PictureColour on_map{20, 26, 32}, white{255, 255, 255};
constexpr std::array<const char*, 3> letters{"X", "Y", "Z"}, view_names{"Top", "Front", "Side"};

using Point = Drawing::Point;
using Sample = EffectShape::Sample;
using View = EffectShape::View;

template <class Visit>
void forEachSample(EffectShape& shape, Visit visit) {
  for (View& view : shape.views) {
    for (Sample& s : view.nodes) visit(s, view.out, true);
    for (auto& line : view.lines)
      for (Sample& s : line) visit(s, view.out, true);
    for (Sample& s : view.points) visit(s, view.out, false);
  }
}

/// Sizes of what is there. Nothing is larger than `limit`: what is has no value.
void takeSizes(EffectShape& shape, double limit) {
  shape.largest = shape.largest_out = 0.0;
  double of_grid = 0.0;
  forEachSample(shape, [&](Sample& s, int out, bool grid) {
    if (!(s.deviation.norm() <= limit)) {
      s.deviation.setConstant(std::nan(""));
      return;
    }
    shape.largest = std::max(shape.largest, s.deviation.norm());
    shape.largest_out = std::max(shape.largest_out, std::abs(s.deviation[out]));
    if (grid) of_grid = std::max(of_grid, s.deviation.norm());
  });
  shape.one_point = shape.largest > 0.0 && !(of_grid > 0.0);
}

/// Above which a deviation is at a pole.
double poleOf(EffectShape& shape) {
  std::vector<double> sizes;
  for (const View& view : shape.views)
    for (const Sample& s : view.nodes)
      if (s.deviation.allFinite()) sizes.push_back(s.deviation.norm());
  const double none = std::numeric_limits<double>::max();
  if (sizes.empty()) return none;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(0.7 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at > 0.0 ? pole * *at : none;
}

void sample(EffectShape& shape, const ShapeColumn& column, const EffectVolume& volume) {
  const auto sampleAt = [&](const Eigen::Vector3d& at_mm, const std::string& point) {
    DeviationQuery query;
    query.position_mm = at_mm;
    query.point = point;
    query.approach = Eigen::Vector3d::Ones();
    Sample s{at_mm, {}};
    for (int i = 0; i < 3; ++i)
      s.deviation[i] = column.value(query, static_cast<Component>(i + (shape.rotations ? 3 : 0)));
    return s;
  };
  Eigen::Vector3d middle_mm;
  for (int i = 0; i < 3; ++i) {
    const auto& range = shape.range_mm[static_cast<std::size_t>(i)];
    middle_mm[i] = 0.5 * (range[0] + range[1]);
  }
  constexpr std::array<std::array<int, 3>, 3> planes{{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};
  for (std::size_t n = 0; n < planes.size(); ++n) {
    View view{planes[n][0], planes[n][1], planes[n][2], {}, {}, {}};
    const auto at = [&](double a, double b) {
      const auto& h = shape.range_mm[static_cast<std::size_t>(view.across)];
      const auto& v = shape.range_mm[static_cast<std::size_t>(view.up)];
      Eigen::Vector3d p = middle_mm;
      p[view.across] = h[0] + a * (h[1] - h[0]);
      p[view.up] = v[0] + b * (v[1] - v[0]);
      return sampleAt(p, {});
    };
    constexpr int cells = EffectShape::cells;
    for (int row = 0; row <= cells; ++row)
      for (int i = 0; i <= cells; ++i) view.nodes.push_back(at(double(i) / cells, double(row) / cells));
    for (const bool across : {true, false})
      for (int line = 0; line <= lines_along; ++line) {
        std::vector<Sample>& samples = view.lines.emplace_back();
        for (int i = 0; i <= samples_along; ++i) {
          const double along = double(i) / samples_along, beside = double(line) / lines_along;
          samples.push_back(across ? at(along, beside) : at(beside, along));
        }
      }
    for (const MachinePoint& p : volume.points) view.points.push_back(sampleAt(p.position_mm, p.id));
    shape.views[n] = std::move(view);
  }
  takeSizes(shape, std::numeric_limits<double>::max());
}

std::vector<std::string> brokenIntoLines(const std::string& text, double width_px) {
  std::vector<std::string> lines(1);
  const auto most = static_cast<std::size_t>(std::max(8.0, width_px / letter_px));
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > most) lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    lines.back() += word;
  }
  return lines;
}

void drawArrow(Drawing& drawing, Point from, Point to, PictureColour colour, bool on_colours) {
  const double x = to[0] - from[0], y = to[1] - from[1];
  const double length = std::hypot(x, y);
  // Dark on the light map, and still seen where it leaves that.
  if (on_colours && length > 1.0)
    drawing.path({{from, to}}, {.stroke = white, .width = 4.0, .opacity = 0.8, .round = true});
  drawing.line(from[0], from[1], to[0], to[1], colour, 1.4);
  if (length < 4.0) return;
  const double head = std::min(6.0, 0.5 * length);
  const Point along{x / length * head, y / length * head}, across{-0.5 * along[1], 0.5 * along[0]};
  drawing.polygon({to,
                   {to[0] - along[0] + across[0], to[1] - along[1] + across[1]},
                   {to[0] - along[0] - across[0], to[1] - along[1] - across[1]}},
                  {.fill = colour});
}

std::vector<std::vector<Point>> dashes(Point from, Point to) {
  constexpr double dash_px = 4.0, period_px = 7.0;
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const auto at = [&](double along) {
    const double part = std::min(1.0, along / length);
    return Point{from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])};
  };
  std::vector<std::vector<Point>> strokes;
  for (double s = 0.0; s < length; s += period_px) strokes.push_back({at(s), at(s + dash_px)});
  return strokes;
}

struct Box {
  double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
};

struct EffectLayout {
  double px_per_mm = 0.0;
  double room_px = 0.0;  ///< for the displacement, on every side of a view
  std::array<double, 3> stretch{1.0, 1.0, 1.0};
  std::array<Box, 3> views;
  Box legend;
  bool beside = false;  ///< the legend has the corner that a drawing leaves free
  std::vector<std::string> words;
};

double scaleWidth(double width) {
  return std::min(160.0, 0.3 * width);
}

EffectLayout layoutOf(const EffectShape& shape, const EffectDrawingOptions& options, const std::string& legend) {
  EffectLayout out;
  const double width = options.width_px, height = options.height_px;
  std::array<double, 3> length{};
  for (std::size_t i = 0; i < 3; ++i) length[i] = shape.range_mm[i][1] - shape.range_mm[i][0];
  const double longest = *std::max_element(length.begin(), length.end());
  for (std::size_t i = 0; i < 3; ++i) {
    out.stretch[i] = std::max(1.0, least_length * longest / length[i]);
    length[i] *= out.stretch[i];
  }
  const auto [x, y, z] = length;
  out.room_px = std::clamp(0.06 * std::min(width, height), 12.0, 36.0);
  const double more_width = 2 * out.room_px + axes_px, more_height = 2 * out.room_px + title_px + axes_px;
  out.words = brokenIntoLines(legend, width - scaleWidth(width) - unit_px - 24.0);
  const double foot_px = std::max(scale_px, line_px * static_cast<double>(out.words.size()) + 4.0);
  const double in_row =
      std::min((width - 3 * more_width) / (2 * x + y), (height - foot_px - more_height) / std::max(y, z));
  const double as_drawing = std::min((width - 2 * more_width) / (x + y), (height - 2 * more_height) / (y + z));
  if (as_drawing > in_row && width - (x * as_drawing + more_width) > least_legend_px) {
    const double s = out.px_per_mm = as_drawing;
    const double spare_x = std::max(0.0, width - 2 * more_width - (x + y) * s) / 3;
    const double spare_y = std::max(0.0, height - 2 * more_height - (y + z) * s) / 3;
    const double second_x = 2 * spare_x + more_width + x * s, second_y = 2 * spare_y + more_height + y * s;
    out.views = {Box{spare_x, spare_y, more_width + x * s, more_height + y * s},
                 Box{spare_x, second_y, more_width + x * s, more_height + z * s},
                 Box{second_x, second_y, more_width + y * s, more_height + z * s}};
    out.legend = {second_x + 8, spare_y + title_px, width - second_x - 16, more_height + y * s};
    out.beside = true;
    out.words = brokenIntoLines(legend, out.legend.width);
    return out;
  }
  const double s = out.px_per_mm = std::max(0.0, in_row);
  const double spare_x = std::max(0.0, width - 3 * more_width - (2 * x + y) * s) / 4;
  const double high = std::max(y, z) * s + more_height;
  double left = spare_x;
  for (std::size_t i = 0; i < 3; ++i) {
    const double across = (i < 2 ? x : y) * s + more_width;
    out.views[i] = {left, std::max(0.0, height - foot_px - high) / 2, across, high};
    left += across + spare_x;
  }
  out.legend = {4.0, height - foot_px, width - 4.0, foot_px};
  return out;
}

PictureColour colourOf(double part) {
  const auto [red, green, blue] = coolWarm(part);
  return {red, green, blue};
}

void drawView(Drawing& drawing, const EffectShape& shape, const View& view, const EffectLayout& layout, const Box& area,
              const EffectDrawingOptions& options) {
  const auto across = static_cast<std::size_t>(view.across), up = static_cast<std::size_t>(view.up);
  const double px_per_unit = 0.95 * layout.room_px / shape.largest;
  const double limit = shape.limit();
  const auto pixel = [&](double a, double b) {
    const auto& h = shape.range_mm[across];
    const auto& v = shape.range_mm[up];
    return Point{area.left + 0.5 * area.width + (a - 0.5 * (h[0] + h[1])) * layout.stretch[across] * layout.px_per_mm,
                 area.top + 0.5 * area.height - (b - 0.5 * (v[0] + v[1])) * layout.stretch[up] * layout.px_per_mm};
  };
  const auto rest = [&](const Sample& s) { return pixel(s.at_mm[view.across], s.at_mm[view.up]); };
  const auto moved = [&](const Sample& s) {
    const Point p = rest(s);
    return Point{p[0] + s.deviation[view.across] * px_per_unit, p[1] - s.deviation[view.up] * px_per_unit};
  };
  const auto placed = [&](const Sample& s) { return shape.rotations ? rest(s) : moved(s); };
  constexpr std::size_t row_length = EffectShape::cells + 1;
  for (std::size_t row = 0; row + 1 < row_length; ++row)
    for (std::size_t i = 0; i + 1 < row_length; ++i) {
      const Sample* first = &view.nodes[row * row_length + i];
      double out = 0.0;
      std::vector<Point> corners;
      for (const Sample* s : {first, first + 1, first + row_length + 1, first + row_length}) {
        out += 0.25 * s->deviation[view.out];
        corners.push_back(placed(*s));
      }
      if (std::any_of(corners.begin(), corners.end(), [](const Point& p) { return !std::isfinite(p[0] + p[1]); }) ||
          !std::isfinite(out))
        continue;
      const PictureColour colour = colourOf(out / limit);
      drawing.polygon(std::move(corners), {.fill = colour, .stroke = colour, .crisp = true});
    }
  // Where the plane is without the effect.
  const auto& h = shape.range_mm[across];
  const auto& v = shape.range_mm[up];
  const std::array<Point, 4> edge{pixel(h[0], v[0]), pixel(h[1], v[0]), pixel(h[1], v[1]), pixel(h[0], v[1])};
  for (std::size_t i = 0; i < edge.size(); ++i)
    drawing.path(dashes(edge[i], edge[(i + 1) % edge.size()]), {.stroke = options.soft});
  std::vector<std::vector<Point>> strokes;
  for (const std::vector<Sample>& line : view.lines) {
    strokes.emplace_back();
    for (const Sample& s : line) {
      if (s.deviation.allFinite()) {
        strokes.back().push_back(placed(s));
      } else if (!strokes.back().empty()) {
        strokes.emplace_back();
      }
    }
  }
  std::erase_if(strokes, [](const auto& stroke) { return stroke.size() < 2; });
  drawing.path(std::move(strokes), {.stroke = on_map, .opacity = 0.6});
  for (std::size_t row = 0; shape.rotations && row < row_length; row += 4)
    for (std::size_t i = 0; i < row_length; i += 4)
      if (const Sample& s = view.nodes[row * row_length + i]; s.deviation.allFinite())
        drawArrow(drawing, rest(s), moved(s), on_map, true);
  for (const Sample& s : view.points) {
    if (!s.deviation.allFinite()) continue;
    const Point from = rest(s);
    drawArrow(drawing, from, moved(s), on_map, true);
    drawing.disc(from[0], from[1], shape.one_point ? 4.0 : 2.5,
                 shape.one_point ? colourOf(s.deviation[view.out] / limit) : white, on_map);
  }
}

/// At the lower left of a view.
void drawAxes(Drawing& drawing, const View& view, const Box& box, const EffectDrawingOptions& options) {
  const Point origin{box.left + 10, box.top + box.height - 10};
  const auto across = static_cast<std::size_t>(view.across), up = static_cast<std::size_t>(view.up);
  drawArrow(drawing, origin, {origin[0] + 26, origin[1]}, options.axes[across], false);
  drawArrow(drawing, origin, {origin[0], origin[1] - 26}, options.axes[up], false);
  drawing.text(origin[0] + 30, origin[1] + 4, letters[across], {.size = text_px, .colour = options.axes[across]});
  drawing.text(origin[0], origin[1] - 31, letters[up],
               {.size = text_px, .anchor = TextAnchor::Middle, .colour = options.axes[up]});
}

void drawLegend(Drawing& drawing, const EffectShape& shape, const EffectLayout& layout,
                const EffectDrawingOptions& options) {
  const Box& area = layout.legend;
  const TextLook soft{.size = text_px, .colour = options.soft};
  double y = area.top + text_px + 2.0;
  for (const std::string& line : layout.words) {
    drawing.text(area.left, y, line, soft);
    y += line_px;
  }
  const double bar = layout.beside ? std::min(160.0, area.width - 2 * unit_px) : scaleWidth(area.width);
  const double left = layout.beside ? area.left + 12 : area.left + area.width - bar - unit_px;
  const double top = layout.beside ? y : area.top + 6;
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i)
    drawing.rectangle(left + bar * i / steps, top, bar / steps + 0.5, 10.0,
                      {.fill = colourOf(2.0 * i / (steps - 1) - 1.0), .crisp = true});
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = 0.5 * static_cast<double>(i);
    const std::string& given = options.numbers[i];
    drawing.text(left + part * bar, top + 24.0,
                 !given.empty() ? given
                 : i == 1       ? "0"
                                : fmt::format("{}{:g}", i == 0 ? "−" : "", shape.limit()),
                 {.size = text_px, .anchor = TextAnchor::Middle, .colour = options.soft});
  }
  drawing.text(left + bar + 6, top + 10, !options.unit.empty() ? options.unit : shape.rotations ? "µrad" : "µm", soft);
}

}  // namespace

EffectVolume EffectVolume::of(const MachineDescription& machine) {
  EffectVolume volume;
  for (std::size_t i = 0; i < 3; ++i) {
    const LinearAxis* axis = machine.findAxis(letters[i]);
    auto& range = volume.travel_mm[i];
    range = axis != nullptr ? axis->travel_mm : std::array<double, 2>{0.0, default_travel_mm};
    if (!(range[1] > range[0])) range[1] = range[0] + default_travel_mm;
  }
  volume.points = machine.points;
  return volume;
}

double EffectShape::limit() const {
  return roundLimit(largest_out > 0.0 ? largest_out : largest);
}

std::optional<EffectShape> effectShape(const Effect& effect, const EffectVolume& volume, std::size_t gain) {
  if (gain >= effect.shape.size()) return std::nullopt;
  EffectShape shape;
  shape.range_mm = volume.travel_mm;
  shape.gain_unit = effect.shape[gain].gain_unit;
  for (const bool rotations : {false, true}) {
    shape.rotations = rotations;
    sample(shape, effect.shape[gain], volume);
    if (shape.largest > 0.0) break;
  }
  takeSizes(shape, poleOf(shape));
  if (!(shape.largest > 0.0)) return std::nullopt;
  return shape;
}

std::string effectLegend(const EffectShape& shape) {
  return fmt::format(
      "{} for a gain of 1 {}: at most {:.3g} {}.",
      shape.rotations ? "Rotation of the tool, as vectors," : "Deviation of the tool, drawn exaggerated,",
      gainUnit(shape.gain_unit), shape.largest, shape.rotations ? "µrad" : "µm");
}

Drawing effectDrawing(const EffectShape& shape, const EffectDrawingOptions& options) {
  const std::string legend = !options.legend.empty() ? options.legend : effectLegend(shape);
  const EffectLayout layout = layoutOf(shape, options, legend);
  Drawing drawing(options.width_px, options.height_px);
  drawing.rectangle(0.0, 0.0, options.width_px, options.height_px, options.ground);
  for (std::size_t i = 0; i < shape.views.size(); ++i) {
    const View& view = shape.views[i];
    const Box& box = layout.views[i];
    drawing.text(box.left + 4, box.top + text_px + 1,
                 !options.titles[i].empty()
                     ? options.titles[i]
                     : fmt::format("{}, colour {}", view_names[i], toString(shape.colouredIn(view))),
                 {.size = text_px, .colour = options.ink});
    drawView(drawing, shape, view, layout,
             {box.left + axes_px, box.top + title_px, box.width - axes_px, box.height - title_px - axes_px}, options);
    drawAxes(drawing, view, box, options);
  }
  drawLegend(drawing, shape, layout, options);
  return drawing;
}

}  // namespace spindrift
