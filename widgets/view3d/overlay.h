// SPDX-License-Identifier: GPL-3.0-or-later
// What is painted over the 3D picture with the program's own font: colour bar, axes, labels, marks, arrows.
#pragma once

#include <QPainter>

#include "widgets/view3d/machine_bodies.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

/// Vertical colour bar at the right edge, with unit and round ticks. Returns the rectangle it took.
QRectF paintColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale);
/// Three short axes with their names at the bottom left.
void paintTriad(QPainter& painter, const QRectF& area, const Camera& camera);
/// Travels of the linear axes as double arrows with "X 300 mm".
void paintMotions(QPainter& painter, const Camera& camera, const QSizeF& size, const MachineBodies& bodies);
/// Numbers in mm along two edges of the table.
void paintTableScale(QPainter& painter, const Camera& camera, const QSizeF& size, const MachineBodies& bodies);
void paintArrows(QPainter& painter, const Camera& camera, const QSizeF& size, const std::vector<ViewArrow>& arrows,
                 double exaggeration);
/// Spacing of the table grid, mm: about ten lines on the longer side.
[[nodiscard]] double gridSpacing_mm(const MachineBodies& bodies);

}  // namespace spindrift::gui
