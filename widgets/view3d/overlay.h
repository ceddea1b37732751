// SPDX-License-Identifier: GPL-3.0-or-later
// What is painted over the 3D picture with the program's own font: colour bar, axes, labels, marks, arrows.
#pragma once

#include <QPainter>

#include "widgets/view3d/machine_bodies.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

/// What the colour bar takes of the width if it stands, of the height if it lies, pixels.
[[nodiscard]] double colourBarWidth(const ColourScale& scale);
[[nodiscard]] double colourBarHeight();
/// Colour bar with unit and round ticks: standing at the right edge, or lying at the bottom right. Returns the
/// rectangle it took.
QRectF paintColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale, bool lying = false);
/// Notes in as many lines as `room` (px) asks for.
/// `height` of the view: the last notes are left out where all of them would take more than a third of it.
[[nodiscard]] QStringList wrappedNotes(const QStringList& lines, double room, double height);
/// The panel at the top left with some lines, none wider than `room`; empty without lines.
[[nodiscard]] QRectF notesPanel(const QStringList& lines, double room);
/// Three short axes with their names at the bottom left.
/// Where the axes stand in the lower left corner of a view: as much of it as they take, seen from where the camera is.
[[nodiscard]] QRectF triadPlace(const QRectF& view, const Camera& camera);
void paintTriad(QPainter& painter, const QRectF& area, const Camera& camera);
/// Travels of the linear axes as double arrows with "X 300 mm".
void paintMotions(QPainter& painter, const Camera& camera, const QSizeF& size, const MachineBodies& bodies);
/// Text over the picture and the rectangle it takes.
struct OverlayText {
  QPointF baseline;
  QString text;
  QRectF box;
};
/// Numbers in mm along two edges of the table, wherever they stand.
[[nodiscard]] std::vector<OverlayText> tableScale(const Camera& camera, const QSizeF& size,
                                                  const MachineBodies& bodies);
/// Those of them that stand in the picture, and not behind the colour bar.
void paintTableScale(QPainter& painter, const Camera& camera, const QSizeF& size, const MachineBodies& bodies,
                     const QRectF& bar = {});
/// Numbers and titles along the axes of a surface.
void paintSurfaceAxes(QPainter& painter, const Camera& camera, const QSizeF& size, const ViewSurface& surface,
                      const SurfaceBox& box, const ColourScale& scale);
/// "1.2 ± 0.3 µm" in the unit on screen, `unit` that of files; without a finite `sigma` the value alone.
[[nodiscard]] QString quantityWithUncertainty(double value, double sigma, const QString& unit);
/// Values of a surface at one node with what it is over: "Position 550 mm, Time 2 h: 1.2 ± 0.3 µm".
[[nodiscard]] QString surfaceNodeText(const ViewSurface& surface, const QString& unit, std::size_t node);
/// A ring around a place.
void paintCursorRing(QPainter& painter, const QPointF& centre);
/// A line between two places with its length beside it. One place: a mark.
void paintDistance(QPainter& painter, const QSizeF& size, const std::vector<QPointF>& ends, const QString& text);
/// Spacing of the table grid, mm: about ten lines on the longer side.
[[nodiscard]] double gridSpacing_mm(const MachineBodies& bodies);

}  // namespace spindrift::gui
