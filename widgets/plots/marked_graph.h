// SPDX-License-Identifier: GPL-3.0-or-later
// A curve whose many marks are drawn fast: the mark is drawn once and stamped on whole pixels.
#pragma once

#include "widgets/plots/qcustomplot_header.h"

namespace spindrift::gui {

/// Few marks, and all marks of a picture made of vectors or at another scale, are drawn one by one as ever.
class MarkedGraph : public QCPGraph {
 public:
  using QCPGraph::QCPGraph;

 protected:
  void drawScatterPlot(QCPPainter* painter, const QVector<QPointF>& places,
                       const QCPScatterStyle& style) const override;
};

}  // namespace spindrift::gui
