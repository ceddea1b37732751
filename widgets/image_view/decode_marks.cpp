// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/image_view/decode_marks.h"

#include <algorithm>

namespace spindrift::gui {

std::vector<ImageMark> marksOf(const DecodeResult& result, const FiducialPattern& pattern) {
  std::vector<ImageMark> marks;
  const double scale = result.map.pixel_length_um > 0 ? 1.0 / result.map.pixel_length_um : 0.0;
  for (const Subpattern& s : result.subpatterns) {
    ImageMark mark;
    mark.centre_px = {s.x_px, s.y_px};
    mark.radius_x_px = pattern.semi_axis_x_um * scale;
    mark.radius_y_px = pattern.semi_axis_y_um * scale;
    mark.tilt_rad = s.tilt_rad;
    mark.label = QStringLiteral("%1 %2").arg(s.row).arg(s.column);
    mark.tone = s.from_neighbours ? Tone::Attention : Tone::Good;
    marks.push_back(mark);
  }
  for (const CircleMark& c : result.circles) {
    ImageMark mark;
    mark.centre_px = {c.x_px, c.y_px};
    mark.radius_x_px = mark.radius_y_px = pattern.circle_radius_um * scale * 1.25;
    mark.tone = Tone::Accent;
    marks.push_back(mark);
  }
  return marks;
}

QImage toImage(const GrayImage& gray) {
  QImage image(gray.width(), gray.height(), QImage::Format_Grayscale8);
  for (int y = 0; y < gray.height(); ++y) {
    std::copy_n(gray.row(y), gray.width(), image.scanLine(y));
  }
  return image;
}

}  // namespace spindrift::gui
