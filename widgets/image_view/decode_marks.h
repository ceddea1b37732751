// SPDX-License-Identifier: GPL-3.0-or-later
// What was decoded in an image, as marks over it; grey images as pictures of Qt.
#pragma once

#include <QImage>
#include <vector>

#include "core/imaging/decoder.h"
#include "widgets/image_view/image_view.h"

namespace spindrift::gui {

/// Ellipses with their numbers and circles, as large as in the pattern that was decoded.
[[nodiscard]] std::vector<ImageMark> marksOf(const DecodeResult& result, const FiducialPattern& pattern);
[[nodiscard]] QImage toImage(const GrayImage& gray);

}  // namespace spindrift::gui
