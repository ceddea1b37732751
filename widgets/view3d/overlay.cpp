// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/overlay.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QPainterPath>
#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/theme/fonts.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

QColor axisColour(int i) {
  const Theme& t = theme();
  return i == 0 ? t.axis_x : i == 1 ? t.axis_y : t.axis_z;
}

/// Text with a soft halo in the colour of the background, so that it reads on anything.
void haloText(QPainter& painter, const QPointF& baseline, const QString& text, const QColor& colour) {
  QPainterPath path;
  path.addText(baseline, painter.font(), text);
  QColor halo = theme().view_top;
  halo.setAlphaF(0.85F);
  painter.save();
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(halo, 3.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
  painter.restore();
  painter.setPen(colour);
  painter.drawText(baseline, text);
}

void arrowHead(QPainter& painter, const QPointF& tip, const QPointF& direction, double length, const QColor& colour) {
  const double norm = std::hypot(direction.x(), direction.y());
  if (norm < 1e-9) return;
  const QPointF d = direction / norm;
  const QPointF n(-d.y(), d.x());
  const std::array<QPointF, 3> corners{tip, tip - d * length + n * (0.42 * length),
                                       tip - d * length - n * (0.42 * length)};
  painter.save();
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawPolygon(corners.data(), 3);
  painter.restore();
}

int verticalAxis(const MachineBodies& bodies) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(bodies.vertical[i]) > 0.5) return i;
  }
  return 2;
}

}  // namespace

QRectF paintColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale) {
  const Theme& t = theme();
  painter.save();
  painter.setFont(textFont(sizes::font_secondary));
  const QFontMetricsF metrics(painter.font());
  const std::vector<double> ticks = scale.ticks();
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  double text_width = 0;
  for (const double v : ticks) text_width = std::max(text_width, metrics.horizontalAdvance(tickText(v, step)));
  const QString unit = scale.unit;
  const QString title = scale.title.isEmpty() ? unit : scale.title + QStringLiteral(" / ") + unit;
  const double title_width = metrics.horizontalAdvance(title);
  const double bar_width = 14;
  const double panel_width = std::max(bar_width + 10 + text_width, title_width) + 2 * sizes::step + 4;
  const double panel_height = std::min(area.height() - 2 * sizes::step, 300.0);
  const QRectF panel(area.right() - panel_width - sizes::step, area.top() + sizes::step, panel_width, panel_height);
  QColor back = t.surface;
  back.setAlphaF(0.88F);
  painter.setPen(QPen(t.border, 1));
  painter.setBrush(back);
  painter.drawRoundedRect(panel, 6, 6);
  painter.setPen(t.text);
  painter.drawText(QPointF(panel.left() + sizes::step + 2, panel.top() + 6 + metrics.ascent()), title);
  const QRectF bar(panel.left() + sizes::step + 2, panel.top() + metrics.height() + 16, bar_width,
                   panel_height - metrics.height() - 28);
  QImage strip(1, 256, QImage::Format_RGB32);
  for (int i = 0; i < 256; ++i) strip.setPixel(0, i, colourTable(scale.map)[static_cast<std::size_t>(255 - i)]);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(bar, strip);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(t.border_strong, 1));
  painter.drawRect(bar);
  for (const double v : ticks) {
    const double y = bar.bottom() - (v - scale.low) / (scale.high - scale.low) * bar.height();
    painter.setPen(QPen(t.text_secondary, 1));
    painter.drawLine(QPointF(bar.right(), y), QPointF(bar.right() + 4, y));
    painter.setPen(t.text);
    const QString text = tickText(v, step);
    painter.drawText(
        QPointF(bar.right() + 8 + text_width - metrics.horizontalAdvance(text), y + metrics.ascent() / 2 - 1), text);
  }
  painter.restore();
  return panel;
}

void paintTriad(QPainter& painter, const QRectF& area, const Camera& camera) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(textFont(sizes::font_secondary, QFont::DemiBold));
  const QFontMetricsF metrics(painter.font());
  const QPointF centre(area.left() + 46, area.bottom() - 46);
  constexpr double length = 28;
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return camera.forward()[a] > camera.forward()[b];  // far ones first
  });
  for (const int i : order) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    const QPointF d(camera.right().dot(axis), -camera.up().dot(axis));
    const double shown = std::hypot(d.x(), d.y());
    const QPointF tip = centre + length * d;
    painter.setPen(QPen(axisColour(i), 2.2, Qt::SolidLine, Qt::RoundCap));
    if (shown > 0.12) {
      painter.drawLine(centre, tip);
      const QString name = QString(QLatin1Char("XYZ"[i]));
      const QPointF beyond = centre + (length + 10) / std::max(shown, 0.5) * shown * d / shown * shown;
      const QPointF at = shown > 0.5 ? centre + (length + 10.0 / shown) * d : beyond + QPointF(6, -6);
      haloText(painter, at + QPointF(-metrics.horizontalAdvance(name) / 2, metrics.ascent() / 2 - 2), name,
               axisColour(i));
    } else {
      painter.setBrush(axisColour(i));
      painter.drawEllipse(centre, 3, 3);
      const QString name = QString(QLatin1Char("XYZ"[i]));
      haloText(painter, centre + QPointF(-14, 16), name, axisColour(i));
    }
  }
  painter.restore();
}

void paintMotions(QPainter& painter, const Camera& camera, const QSizeF& size, const MachineBodies& bodies) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(textFont(sizes::font_secondary, QFont::DemiBold));
  const QFontMetricsF metrics(painter.font());
  for (const AxisMotion& motion : bodies.motions) {
    const auto a = camera.project(motion.from_mm, size);
    const auto b = camera.project(motion.to_mm, size);
    if (!a || !b) continue;
    const QPointF d = *b - *a;
    const double length = std::hypot(d.x(), d.y());
    if (length < 24) continue;
    const QColor colour = axisColour(motion.direction);
    painter.setPen(QPen(colour, 2, Qt::SolidLine, Qt::FlatCap));
    painter.drawLine(*a + d * (6 / length), *b - d * (6 / length));
    arrowHead(painter, *b, d, 10, colour);
    arrowHead(painter, *a, -d, 10, colour);
    const QString text =
        QStringLiteral("%1  %2 mm").arg(motion.name).arg(decimalText((motion.to_mm - motion.from_mm).norm(), 'f', 0));
    const double text_width = metrics.horizontalAdvance(text);
    QPointF outward(-d.y() / length, d.x() / length);
    const QPointF middle = 0.5 * (*a + *b);
    const QPointF from_centre = middle - QPointF(size.width() / 2, size.height() / 2);
    if (outward.x() * from_centre.x() + outward.y() * from_centre.y() < 0) outward = -outward;
    const QPointF anchor = middle + outward * 12;
    double x = anchor.x() - text_width / 2 + outward.x() * text_width / 2;
    x = std::clamp(x, 4.0, std::max(4.0, size.width() - text_width - 4));
    const double y = std::clamp(anchor.y() + metrics.ascent() / 2 - 2 + outward.y() * metrics.height() / 2,
                                metrics.height(), std::max(metrics.height(), size.height() - 4));
    haloText(painter, {x, y}, text, colour);
  }
  painter.restore();
}

double gridSpacing_mm(const MachineBodies& bodies) {
  const Eigen::Vector3d extent = bodies.table_high_mm - bodies.table_low_mm;
  const double raw = std::max(extent.maxCoeff(), 1e-6) / 10;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

void paintTableScale(QPainter& painter, const Camera& camera, const QSizeF& size, const MachineBodies& bodies) {
  painter.save();
  painter.setFont(textFont(11));
  const QFontMetricsF metrics(painter.font());
  const double spacing = gridSpacing_mm(bodies);
  const Eigen::Vector3d& low = bodies.table_low_mm;
  const Eigen::Vector3d& high = bodies.table_high_mm;
  const int up = verticalAxis(bodies);
  const auto centre = camera.project(0.5 * (low + high), size);
  if (!centre) {
    painter.restore();
    return;
  }
  for (int i = 0; i < 3; ++i) {
    if (i == up) continue;
    const int other = 3 - up - i;
    // The edge nearer to the viewer carries the numbers.
    Eigen::Vector3d edge_low = low;
    Eigen::Vector3d edge_high = low;
    edge_high[other] = high[other];
    edge_low[i] = edge_high[i] = 0.5 * (low[i] + high[i]);
    const auto p_low = camera.project(edge_low, size);
    const auto p_high = camera.project(edge_high, size);
    if (!p_low || !p_high) continue;
    const bool use_low = i == 0 || up == 1 ? p_low->y() >= p_high->y() : p_low->x() <= p_high->x();
    const double fixed = use_low ? low[other] : high[other];
    double last_x = -1e9;
    double last_y = -1e9;
    for (double v = std::ceil(low[i] / spacing) * spacing; v <= high[i] + 1e-9; v += spacing) {
      Eigen::Vector3d p = low;
      p[up] = low[up];
      p[i] = v;
      p[other] = fixed;
      Eigen::Vector3d inner = p;
      inner[other] = 0.5 * (low[other] + high[other]);
      const auto at = camera.project(p, size);
      const auto inward = camera.project(inner, size);
      if (!at || !inward) continue;
      QPointF out = *at - *inward;
      const double norm = std::hypot(out.x(), out.y());
      if (norm < 4) continue;
      out /= norm;
      const QString text = decimalText(std::abs(v) < 1e-9 ? 0.0 : v, 'f', spacing < 1 ? 1 : 0);
      const double w = metrics.horizontalAdvance(text);
      const QPointF anchor = *at + out * 9;
      const QPointF baseline(anchor.x() - w / 2 + out.x() * w / 2, anchor.y() + metrics.ascent() / 2 - 1 + out.y() * 4);
      if (std::abs(baseline.x() - last_x) < w + 6 && std::abs(baseline.y() - last_y) < metrics.height()) continue;
      last_x = baseline.x();
      last_y = baseline.y();
      haloText(painter, baseline, text, theme().text_secondary);
    }
    const bool show_unit = i == 0;
    if (show_unit) {
      Eigen::Vector3d p = low;
      p[i] = high[i];
      p[other] = fixed;
      if (const auto at = camera.project(p, size)) {
        haloText(painter, *at + QPointF(14, 20), QStringLiteral("mm"), theme().text_secondary);
      }
    }
  }
  painter.restore();
}

void paintArrows(QPainter& painter, const Camera& camera, const QSizeF& size, const std::vector<ViewArrow>& arrows,
                 double exaggeration) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const ViewArrow& arrow : arrows) {
    const auto a = camera.project(arrow.from_mm, size);
    const auto b = camera.project(arrow.from_mm + 1e-3 * exaggeration * arrow.deviation_um, size);
    if (!a || !b) continue;
    const QPointF d = *b - *a;
    const double length = std::hypot(d.x(), d.y());
    if (length < 3) continue;
    const QColor colour = arrow.tone == Tone::Neutral ? theme().text : theme().tone(arrow.tone);
    QColor halo = theme().view_top;
    halo.setAlphaF(0.8F);
    const double head = std::min(11.0, 0.5 * length);
    painter.setPen(QPen(halo, 5, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(*a, *b);
    painter.setPen(QPen(colour, 2, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(*a, *b - d * (0.8 * head / length));
    arrowHead(painter, *b, d, head, colour);
  }
  painter.restore();
}

}  // namespace spindrift::gui
