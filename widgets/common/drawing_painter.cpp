// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/drawing_painter.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>

#include "widgets/theme/fonts.h"

namespace spindrift::gui {
namespace {

QColor colourOf(PictureColour colour, double opacity = 1.0) {
  QColor out(colour.red, colour.green, colour.blue);
  out.setAlphaF(static_cast<float>(opacity));
  return out;
}

void usePaint(QPainter& painter, const Paint& paint) {
  painter.setRenderHint(QPainter::Antialiasing, !paint.crisp);
  painter.setPen(paint.stroke ? QPen(colourOf(*paint.stroke, paint.opacity), paint.width, Qt::SolidLine,
                                     paint.round ? Qt::RoundCap : Qt::FlatCap, Qt::RoundJoin)
                              : QPen(Qt::NoPen));
  painter.setBrush(paint.fill ? QBrush(colourOf(*paint.fill, paint.opacity)) : QBrush(Qt::NoBrush));
}

/// One for each kind of shape.
struct Painter {
  QPainter& painter;

  void operator()(const Drawing::Rectangle& r) const {
    usePaint(painter, r.paint);
    painter.drawRect(QRectF(r.x, r.y, r.width, r.height));
  }
  void operator()(const Drawing::Disc& d) const {
    usePaint(painter, d.paint);
    painter.drawEllipse(QPointF(d.x, d.y), d.radius, d.radius);
  }
  void operator()(const Drawing::Path& p) const {
    usePaint(painter, p.paint);
    QPainterPath path;
    for (const auto& stroke : p.strokes) {
      if (stroke.empty()) continue;
      path.moveTo(stroke.front()[0], stroke.front()[1]);
      for (std::size_t i = 1; i < stroke.size(); ++i) path.lineTo(stroke[i][0], stroke[i][1]);
      if (p.closed) path.closeSubpath();
    }
    painter.drawPath(path);
  }
  void operator()(const Drawing::Text& t) const {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    const QFont font = textFont(static_cast<int>(t.look.size + 0.5), t.look.bold ? QFont::DemiBold : QFont::Normal);
    painter.setFont(font);
    painter.setPen(colourOf(t.look.colour));
    const QString text = QString::fromStdString(t.text);
    const double width = QFontMetricsF(font).horizontalAdvance(text);
    painter.translate(t.x, t.y);
    if (t.look.upwards) painter.rotate(-90.0);
    const double left = t.look.anchor == TextAnchor::Start    ? 0.0
                        : t.look.anchor == TextAnchor::Middle ? -0.5 * width
                                                              : -width;
    painter.drawText(QPointF(left, 0.0), text);
    painter.restore();
  }
  void operator()(const Drawing::Picture&) const {}
  void operator()(const Drawing::Window& w) const {
    painter.save();
    painter.setClipRect(QRectF(w.x, w.y, w.width, w.height), Qt::IntersectClip);
  }
  void operator()(const Drawing::WindowEnd&) const { painter.restore(); }
};

}  // namespace

PictureColour pictureColour(const QColor& colour) {
  return {static_cast<std::uint8_t>(colour.red()), static_cast<std::uint8_t>(colour.green()),
          static_cast<std::uint8_t>(colour.blue())};
}

void paintDrawing(QPainter& painter, const Drawing& drawing) {
  painter.save();
  for (const Drawing::Shape& shape : drawing.shapes()) std::visit(Painter{painter}, shape);
  painter.restore();
}

}  // namespace spindrift::gui
