// SPDX-License-Identifier: Apache-2.0
// A figure as the list of what is drawn, in order: made once, written as SVG, PNG or PDF with the same look and every
// character.
//
// Lengths in px of the layout, x to the right, y down. SVG keeps texts as text; PNG and PDF are set by Cairo and Pango,
// in Inter where it is installed, other letters in whatever font has them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace spindrift {

struct PictureColour {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const PictureColour&) const = default;
};
/// "#b83227".
[[nodiscard]] PictureColour colourOfHex(std::string_view hex);

/// Of texts, unless they bring their own.
inline constexpr PictureColour picture_ink{31, 41, 51};

enum class TextAnchor { Start, Middle, End };

/// How a shape is painted: its inside, its edge, or both.
struct Paint {
  std::optional<PictureColour> fill = std::nullopt;
  std::optional<PictureColour> stroke = std::nullopt;
  double width = 1.0;    ///< of the stroke
  double opacity = 1.0;  ///< 0 ... 1
  bool round = false;    ///< ends of the stroke
  bool crisp = false;    ///< not smoothed: equal cells side by side leave no seam
};

/// How a text is set. `upwards`: turned by 90 degrees counter-clockwise about its place; `halo`: with a white border.
struct TextLook {
  double size = 12.0;
  TextAnchor anchor = TextAnchor::Start;
  PictureColour colour = picture_ink;
  bool bold = false;
  bool upwards = false;
  bool halo = false;
};

class Drawing {
 public:
  using Point = std::array<double, 2>;
  struct Rectangle {
    double x, y, width, height;
    Paint paint;
  };
  struct Disc {
    double x, y, radius;
    Paint paint;
  };
  /// Strokes of two points and more, painted together.
  struct Path {
    std::vector<std::vector<Point>> strokes;
    bool closed = false;
    Paint paint;
  };
  struct Text {
    double x, y;  ///< of the base line
    std::string text;
    TextLook look;
  };
  struct Picture {
    double x, y, width, height;
    std::string jpeg;
  };
  /// What follows, up to the end of the window, is cut off outside it. Windows do not hold one another.
  struct Window {
    double x, y, width, height;
  };
  struct WindowEnd {};
  using Shape = std::variant<Rectangle, Disc, Path, Text, Picture, Window, WindowEnd>;

  /// White.
  Drawing(double width_px, double height_px);

  [[nodiscard]] double width() const { return width_; }
  [[nodiscard]] double height() const { return height_; }
  [[nodiscard]] const std::vector<Shape>& shapes() const { return shapes_; }

  void rectangle(double x, double y, double width, double height, const Paint& paint);
  void rectangle(double x, double y, double width, double height, PictureColour fill);
  void line(double x1, double y1, double x2, double y2, PictureColour colour, double width, double opacity = 1.0);
  void disc(double x, double y, double radius, PictureColour fill, std::optional<PictureColour> border = {});
  void polygon(std::vector<Point> corners, const Paint& paint);
  void path(std::vector<std::vector<Point>> strokes, const Paint& paint);
  void text(double x, double y, std::string_view text, const TextLook& look = {});
  void text(double x, double y, std::string_view text, double size, TextAnchor anchor, bool bold = false,
            bool upwards = false, bool halo = false);
  /// A JPEG.
  void picture(double x, double y, double width, double height, std::string jpeg);
  void beginWindow(double x, double y, double width, double height);
  void endWindow();

  /// The same with other words at the same places.
  [[nodiscard]] Drawing withTexts(const std::function<std::string(const std::string&)>& words) const;

  /// Another drawing as a part of this one, its upper left corner at (x, y).
  void place(const Drawing& part, double x, double y);

 private:
  double width_, height_;
  std::vector<Shape> shapes_;
};

/// Drawings side by side in `columns`, row by row. Every column is as wide as its widest drawing.
[[nodiscard]] Drawing drawingGrid(const std::vector<Drawing>& drawings, int columns, double gap_px = 0.0);

/// The whole <svg> element.
[[nodiscard]] std::string svgOf(const Drawing& drawing);
/// The bytes of a PNG file; `scale`: its pixels per px of the layout, 0.5 ... 8. Throws InputError.
[[nodiscard]] std::string pngOf(const Drawing& drawing, double scale = 2.0);
/// The bytes of a PDF file of one page as large as the drawing (96 px an inch).
[[nodiscard]] std::string pdfOf(const Drawing& drawing);

[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace spindrift
