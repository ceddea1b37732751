// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/field_texture.h"

#include <algorithm>
#include <cmath>

namespace spindrift::gui {

QImage fieldTexture(const Field& field, const FieldStyle& style, const ColourScale& scale) {
  const FieldGrid& grid = field.grid;
  constexpr int longest = 700;
  const double width_mm = std::abs(grid.x_to_mm - grid.x_from_mm);
  const double height_mm = std::abs(grid.y_to_mm - grid.y_from_mm);
  const double larger = std::max({width_mm, height_mm, 1e-9});
  const int width = std::max(16, static_cast<int>(std::lround(longest * width_mm / larger)));
  const int height = std::max(16, static_cast<int>(std::lround(longest * height_mm / larger)));
  QImage image(width, height, QImage::Format_RGBA8888);
  const bool with_sigma = style.significance > 0 && field.sigma.size() == field.value.size();
  const bool with_border = field.extrapolated.size() == field.value.size();
  const double gx = static_cast<double>(grid.nx - 1) / width;
  const double gy = static_cast<double>(grid.ny - 1) / height;
  for (int py = 0; py < height; ++py) {
    auto* line = image.scanLine(py);
    const double v = (height - 0.5 - py) * gy;
    const int iy = std::clamp(static_cast<int>(v), 0, grid.ny - 2);
    const double fy = v - iy;
    for (int px = 0; px < width; ++px) {
      const double u = (px + 0.5) * gx;
      const int ix = std::clamp(static_cast<int>(u), 0, grid.nx - 2);
      const double fx = u - ix;
      const std::size_t i = grid.index(ix, iy);
      const std::size_t j = grid.index(ix, iy + 1);
      const auto between = [&](const std::vector<double>& a) {
        return (1 - fy) * ((1 - fx) * a[i] + fx * a[i + 1]) + fy * ((1 - fx) * a[j] + fx * a[j + 1]);
      };
      const double value = between(field.value);
      QRgb colour = scale.rgb(value);
      int r = qRed(colour);
      int g = qGreen(colour);
      int b = qBlue(colour);
      const auto blend = [&](int grey, int percent) {
        r += (grey - r) * percent / 100;
        g += (grey - g) * percent / 100;
        b += (grey - b) * percent / 100;
      };
      if (with_sigma && std::abs(value) < style.significance * between(field.sigma)) blend(236, 62);
      if (with_border && field.extrapolated[grid.index(ix + (fx > 0.5 ? 1 : 0), iy + (fy > 0.5 ? 1 : 0))]) {
        const int stripe = (px + py) % 14;
        blend(236, stripe < 2 ? 75 : 18);
      }
      line[4 * px] = static_cast<uchar>(r);
      line[4 * px + 1] = static_cast<uchar>(g);
      line[4 * px + 2] = static_cast<uchar>(b);
      line[4 * px + 3] = 255;
    }
  }
  return image;
}

}  // namespace spindrift::gui
