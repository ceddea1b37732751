// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plots/marked_graph.h"

#include <QPixmap>
#include <cmath>

namespace spindrift::gui {
namespace {

constexpr qsizetype few_marks = 200;

/// One mark in the middle of a picture of an odd number of pixels.
QPixmap stampOf(const QCPScatterStyle& style, double ratio) {
  const int half = static_cast<int>(std::ceil((0.5 * style.size() + style.pen().widthF() + 1.0) * ratio));
  QPixmap stamp(2 * half + 1, 2 * half + 1);
  stamp.fill(Qt::transparent);
  QCPPainter painter(&stamp);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(ratio, ratio);
  style.applyTo(&painter, style.pen());
  const double middle = (half + 0.5) / ratio;
  style.drawShape(&painter, middle, middle);
  painter.end();
  stamp.setDevicePixelRatio(ratio);
  return stamp;
}

}  // namespace

void MarkedGraph::drawScatterPlot(QCPPainter* painter, const QVector<QPointF>& places,
                                  const QCPScatterStyle& style) const {
  const bool own_scale = painter->modes() != QCPPainter::pmDefault;
  if (places.size() < few_marks || own_scale || !style.isPenDefined()) {
    QCPGraph::drawScatterPlot(painter, places, style);
    return;
  }
  const double ratio = painter->device()->devicePixelRatioF();
  const QPixmap stamp = stampOf(style, ratio);
  const int half = stamp.width() / 2;
  QPoint before(std::numeric_limits<int>::min(), 0);
  for (const QPointF& place : places) {
    if (!std::isfinite(place.x()) || !std::isfinite(place.y())) continue;
    const QPoint pixel(static_cast<int>(std::floor(place.x() * ratio)),
                       static_cast<int>(std::floor(place.y() * ratio)));
    if (pixel == before) continue;
    before = pixel;
    painter->drawPixmap(QPointF(pixel - QPoint(half, half)) / ratio, stamp);
  }
}

}  // namespace spindrift::gui
