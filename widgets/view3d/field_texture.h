// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a heat map: colour by value, faded where it is within the noise, hatched where it is extrapolated.
#pragma once

#include <QImage>

#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

/// RGBA, y up the table is up in the picture. About 700 pixels on the longer side, bilinear between nodes.
[[nodiscard]] QImage fieldTexture(const Field& field, const FieldStyle& style, const ColourScale& scale);

}  // namespace spindrift::gui
