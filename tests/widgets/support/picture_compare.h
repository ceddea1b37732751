// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of pages against kept ones: alike for the eye, not equal bit by bit.
//
// Both are brought to the same small size and blurred, so that another version of a font or of the renderer, which
// moves edges by a fraction of a pixel, counts little; an empty view, another theme or a cut layout counts much.
// Two measures have to agree: colours (what a missing or tinted area changes) and structure (what moves or vanishes
// without changing the mean), the structural similarity of Wang, Bovik, Sheikh and Simoncelli 2004 per tile.
#pragma once

#include <QImage>
#include <QString>

namespace spindrift::gui {

constexpr int baseline_width = 640;

/// Colours from 0 to 255.
struct PictureDifference {
  double mean = 0.0;             ///< over the whole picture
  double worst_tile = 0.0;       ///< mean over the tile of 40 x 40 pixels that differs most
  double structure = 1.0;        ///< structural similarity of the brightness, mean over the tiles, at most 1
  double worst_structure = 1.0;  ///< of the tile with the least
  bool same_size = true;
  [[nodiscard]] bool alike() const;
  [[nodiscard]] QString text() const;
};

/// As a baseline is kept: half as wide as the window, 640 pixels at most, the most frequent colours only.
[[nodiscard]] QImage asBaseline(const QImage& picture);
[[nodiscard]] PictureDifference comparePictures(const QImage& baseline, const QImage& picture);

}  // namespace spindrift::gui
