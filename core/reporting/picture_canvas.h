// SPDX-License-Identifier: Apache-2.0
// What a static picture is drawn on: the same drawing code gives SVG and PNG. Lengths in px of the layout, y down.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace spindrift {

struct PictureColour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

enum class TextAnchor { Start, Middle, End };

class PictureCanvas {
 public:
  virtual ~PictureCanvas() = default;
  virtual void rectangle(double x, double y, double width, double height, PictureColour fill) = 0;
  virtual void line(double x1, double y1, double x2, double y2, PictureColour colour, double width) = 0;
  virtual void disc(double x, double y, double radius, PictureColour fill, PictureColour border) = 0;
  /// `y` is the base line; `upwards` turns the text by 90 degrees counter-clockwise about (x, y). `halo`: white border.
  virtual void text(double x, double y, std::string_view text, double size, TextAnchor anchor, bool bold = false,
                    bool upwards = false, bool halo = false) = 0;
  /// The whole file.
  [[nodiscard]] virtual std::string finish() = 0;
};

[[nodiscard]] std::unique_ptr<PictureCanvas> makeSvgCanvas(int width, int height);
[[nodiscard]] std::unique_ptr<PictureCanvas> makePngCanvas(int width, int height, double scale);

}  // namespace spindrift
