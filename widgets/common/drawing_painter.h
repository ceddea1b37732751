// SPDX-License-Identifier: GPL-3.0-or-later
// A figure of the core library (core/reporting/drawing.h) on a widget: as in reports, with the program's own font.
#pragma once

#include <QColor>

#include "core/reporting/drawing.h"

class QPainter;

namespace spindrift::gui {

/// The upper left corner of the drawing at the origin of the painter; pictures in JPEG are left out.
void paintDrawing(QPainter& painter, const Drawing& drawing);

[[nodiscard]] PictureColour pictureColour(const QColor& colour);

}  // namespace spindrift::gui
