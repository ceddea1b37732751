// SPDX-License-Identifier: GPL-3.0-or-later
// Marks of points with labels that cover neither each other nor a mark.
#pragma once

#include <QPainter>
#include <optional>
#include <vector>

#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

/// What of the points is emphasised, and where no label may stand.
struct PointEmphasis {
  QString selected;  ///< ring and framed label
  QString hovered;   ///< label always shown
  std::vector<QRectF> keep_out;
};

struct PlacedLabel {
  const ViewPoint* point = nullptr;
  QPointF mark;  ///< pixels
  QRectF box;
  bool with_value = true;
  bool leader = false;  ///< so far from its mark that a line is needed
};

/// Where there is no room for all labels, the selected and hovered points come first, then the larger values; a label
/// that finds no place loses its value, then is left out. The selected and the hovered point always have theirs. In the
/// order of importance.
[[nodiscard]] std::vector<PlacedLabel> placeLabels(const Camera& camera, const QSizeF& size,
                                                   const std::vector<ViewPoint>& points, const PointEmphasis& emphasis);

void paintPoints(QPainter& painter, const Camera& camera, const QSizeF& size, const std::vector<ViewPoint>& points,
                 const std::optional<ColourScale>& scale, const PointEmphasis& emphasis);

}  // namespace spindrift::gui
