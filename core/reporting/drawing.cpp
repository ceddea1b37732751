// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/drawing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/untrusted_text.h"

namespace spindrift {
namespace {

void move(Drawing::Path& path, double dx, double dy) {
  for (auto& stroke : path.strokes) {
    for (Drawing::Point& p : stroke) {
      p[0] += dx;
      p[1] += dy;
    }
  }
}
bool nowhere(const Drawing::Point& p) {
  return !std::isfinite(p[0]) || !std::isfinite(p[1]);
}

void move(Drawing::WindowEnd&, double, double) {}
template <typename Shape>
void move(Shape& shape, double dx, double dy) {
  shape.x += dx;
  shape.y += dy;
}

}  // namespace

PictureColour colourOfHex(std::string_view hex) {
  unsigned value = 0;
  const bool read = hex.size() == 7 && hex[0] == '#' &&
                    std::from_chars(hex.data() + 1, hex.data() + 7, value, 16).ptr == hex.data() + 7;
  SPINDRIFT_ASSERT(read, "a colour is # and six digits");
  return {static_cast<std::uint8_t>(value >> 16U), static_cast<std::uint8_t>(value >> 8U & 255U),
          static_cast<std::uint8_t>(value & 255U)};
}

Drawing::Drawing(double width_px, double height_px) : width_(width_px), height_(height_px) {
  rectangle(0.0, 0.0, width_px, height_px, PictureColour{255, 255, 255});
}

void Drawing::rectangle(double x, double y, double width, double height, const Paint& paint) {
  if (!std::isfinite(x + y + width + height)) return;
  shapes_.push_back(Rectangle{x, y, width, height, paint});
}
void Drawing::rectangle(double x, double y, double width, double height, PictureColour fill) {
  rectangle(x, y, width, height, Paint{.fill = fill, .crisp = true});
}
void Drawing::line(double x1, double y1, double x2, double y2, PictureColour colour, double width, double opacity) {
  path({{{x1, y1}, {x2, y2}}}, {.stroke = colour, .width = width, .opacity = opacity, .round = width > 1.0});
}
void Drawing::disc(double x, double y, double radius, PictureColour fill, std::optional<PictureColour> border) {
  if (!std::isfinite(x + y + radius)) return;
  shapes_.push_back(Disc{x, y, radius, {.fill = fill, .stroke = border}});
}
void Drawing::polygon(std::vector<Point> corners, const Paint& paint) {
  std::erase_if(corners, nowhere);
  shapes_.push_back(Path{{std::move(corners)}, true, paint});
}
void Drawing::path(std::vector<std::vector<Point>> strokes, const Paint& paint) {
  for (std::vector<Point>& stroke : strokes) std::erase_if(stroke, nowhere);
  shapes_.push_back(Path{std::move(strokes), false, paint});
}
void Drawing::text(double x, double y, std::string_view text, const TextLook& look) {
  if (std::isfinite(x + y + look.size)) shapes_.push_back(Text{x, y, printable(text), look});
}
void Drawing::text(double x, double y, std::string_view words, double size, TextAnchor anchor, bool bold, bool upwards,
                   bool halo) {
  text(x, y, words, {.size = size, .anchor = anchor, .bold = bold, .upwards = upwards, .halo = halo});
}
void Drawing::picture(double x, double y, double width, double height, std::string jpeg) {
  shapes_.push_back(Picture{x, y, width, height, std::move(jpeg)});
}
void Drawing::beginWindow(double x, double y, double width, double height) {
  shapes_.push_back(Window{x, y, width, height});
}
void Drawing::endWindow() {
  shapes_.push_back(WindowEnd{});
}

Drawing Drawing::withTexts(const std::function<std::string(const std::string&)>& words) const {
  Drawing out = *this;
  for (Shape& shape : out.shapes_) {
    if (auto* text = std::get_if<Text>(&shape)) text->text = words(text->text);
  }
  return out;
}

void Drawing::place(const Drawing& part, double x, double y) {
  for (Shape shape : part.shapes_) {
    std::visit([&](auto& s) { move(s, x, y); }, shape);
    shapes_.push_back(std::move(shape));
  }
}

Drawing drawingGrid(const std::vector<Drawing>& drawings, int columns, double gap_px) {
  SPINDRIFT_ASSERT(columns >= 1, "a grid has a column");
  const auto wide = static_cast<std::size_t>(columns);
  std::vector<double> widths(wide, 0.0), heights((drawings.size() + wide - 1) / wide, 0.0);
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    widths[i % wide] = std::max(widths[i % wide], drawings[i].width());
    heights[i / wide] = std::max(heights[i / wide], drawings[i].height());
  }
  const auto starts = [gap_px](const std::vector<double>& lengths) {
    std::vector<double> at{0.0};
    for (const double length : lengths) at.push_back(at.back() + length + (length > 0.0 ? gap_px : 0.0));
    return at;
  };
  const std::vector<double> x = starts(widths), y = starts(heights);
  const auto whole = [gap_px](const std::vector<double>& at) { return std::max(1.0, at.back() - gap_px); };
  Drawing grid(whole(x), whole(y));
  for (std::size_t i = 0; i < drawings.size(); ++i) grid.place(drawings[i], x[i % wide], y[i / wide]);
  return grid;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63U];
  }
  return out;
}

}  // namespace spindrift
