// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/overlay.h"

#include <QCoreApplication>
#include <QFontMetricsF>
#include <QLineF>
#include <QPainterPath>
#include <QTransform>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/text.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
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

constexpr double bar_width = 14;
constexpr double triad_side_px = 92;  // at most
constexpr int table_scale_px = 11;
/// Between numbers along an axis in space.
constexpr double tick_px = 28;

/// What stands on the colour bar, and how wide it makes it.
struct BarLayout {
  QString title;
  std::vector<double> ticks;
  double step = 1.0;
  double text_width = 0.0;
  double panel_width = 0.0;

  explicit BarLayout(const ColourScale& scale)
      : title(scale.title.isEmpty() ? QString() : scale.title + QStringLiteral(" / ")), ticks(scale.ticks()) {
    title += shownUnit(scale.unit).name;
    const QFontMetricsF metrics(textFont(sizes::font_secondary));
    if (ticks.size() > 1) step = ticks[1] - ticks[0];
    for (const double v : ticks) text_width = std::max(text_width, metrics.horizontalAdvance(scale.text(v, step)));
    panel_width = std::max(bar_width + 10 + text_width, metrics.horizontalAdvance(title)) + 2 * sizes::step + 4;
  }
};

int verticalAxis(const MachineBodies& bodies) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(bodies.vertical[i]) > 0.5) return i;
  }
  return 2;
}

}  // namespace

double colourBarWidth(const ColourScale& scale) {
  return BarLayout(scale).panel_width + 2 * sizes::step;
}

double colourBarHeight() {
  return 2 * QFontMetricsF(textFont(sizes::font_secondary)).height() + bar_width + 3 * sizes::step;
}

QRectF paintColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale, bool lying) {
  const Theme& t = theme();
  painter.save();
  const auto [title, ticks, step, text_width, panel_width] = BarLayout(scale);
  painter.setFont(textFont(sizes::font_secondary));
  const QFontMetricsF metrics(painter.font());
  constexpr double longest = 300;
  const double length = std::min((lying ? area.width() - triad_side_px : area.height()) - 2 * sizes::step, longest);
  const QSizeF panel_size = lying ? QSizeF(length, colourBarHeight() - sizes::step) : QSizeF(panel_width, length);
  const QRectF panel(QPointF(area.right() - panel_size.width() - sizes::step,
                             lying ? area.bottom() - panel_size.height() - sizes::step : area.top() + sizes::step),
                     panel_size);
  QColor back = t.surface;
  back.setAlphaF(0.88F);
  painter.setPen(QPen(t.border, 1));
  painter.setBrush(back);
  painter.drawRoundedRect(panel, 6, 6);
  painter.setPen(t.text);
  painter.drawText(QPointF(panel.left() + sizes::step + 2, panel.top() + 6 + metrics.ascent()), title);
  const QPointF corner(panel.left() + sizes::step + 2 + (lying ? text_width / 2 : 0),
                       panel.top() + metrics.height() + (lying ? 8 : 16));
  const QRectF bar(corner, lying ? QSizeF(panel.right() - sizes::step - 2 - text_width / 2 - corner.x(), bar_width)
                                 : QSizeF(bar_width, panel.bottom() - 12 - corner.y()));
  QImage strip(256, 1, QImage::Format_RGB32);
  for (int i = 0; i < 256; ++i) strip.setPixel(i, 0, colourTable(scale.map)[static_cast<std::size_t>(i)]);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(bar, lying ? strip : strip.transformed(QTransform().rotate(-90)));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(t.border_strong, 1));
  painter.drawRect(bar);
  // On a short bar every second number, or fewer; zero is among them.
  const double apart = (lying ? bar.width() : bar.height()) * step / (scale.high - scale.low);
  const int every = std::max(1, static_cast<int>(std::ceil((lying ? text_width + 6 : metrics.height()) / apart)));
  for (const double v : ticks) {
    if (std::lround(v / step) % every != 0) continue;
    const double share = (v - scale.low) / (scale.high - scale.low);
    const QString text = scale.text(v, step);
    const double width = metrics.horizontalAdvance(text);
    const QPointF at = lying ? QPointF(bar.left() + share * bar.width(), bar.bottom())
                             : QPointF(bar.right(), bar.bottom() - share * bar.height());
    painter.setPen(QPen(t.text_secondary, 1));
    painter.drawLine(at, at + (lying ? QPointF(0, 4) : QPointF(4, 0)));
    painter.setPen(t.text);
    painter.drawText(lying ? QPointF(at.x() - width / 2, at.y() + 4 + metrics.ascent())
                           : QPointF(at.x() + 8 + text_width - width, at.y() + metrics.ascent() / 2 - 1),
                     text);
  }
  painter.restore();
  return panel;
}

QStringList wrappedNotes(const QStringList& lines, double room, double height) {
  const QFontMetricsF metrics(textFont(sizes::font_secondary));
  const auto most = static_cast<qsizetype>(height / 3 / (metrics.height() + 3));
  QStringList out;
  for (const QString& line : lines) {
    const qsizetype before = out.size();
    QString part;
    for (const QString& word : line.split(QLatin1Char(' '))) {
      const QString longer = part.isEmpty() ? word : part + QLatin1Char(' ') + word;
      if (!part.isEmpty() && metrics.horizontalAdvance(longer) > room) {
        out << part;
        part = word;
      } else {
        part = longer;
      }
    }
    out << metrics.elidedText(part, Qt::ElideRight, room);
    if (before > 0 && out.size() > most) return out.mid(0, before);
  }
  return out;
}

QRectF notesPanel(const QStringList& lines, double room) {
  if (lines.isEmpty()) return {};
  const QFontMetricsF metrics(textFont(sizes::font_secondary));
  double width = 0;
  for (const QString& line : lines) width = std::max(width, metrics.horizontalAdvance(line));
  return {8, 8, std::min(width, room) + 16, (metrics.height() + 3) * static_cast<double>(lines.size()) + 9};
}

namespace {

/// One of the axes in the corner, from their common origin, px.
struct TriadAxis {
  QPointF tip;
  QPointF name;          ///< middle of its letter
  bool towards = false;  ///< seen along itself: a dot
};

std::array<TriadAxis, 3> triadAxes(const Camera& camera) {
  constexpr double length = 28;
  constexpr double to_letter = 10;
  constexpr double least_shown = 0.12;
  std::array<TriadAxis, 3> axes;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i);
    const QPointF d(camera.right().dot(axis), -camera.up().dot(axis));
    const double shown = std::hypot(d.x(), d.y());
    TriadAxis& one = axes[static_cast<std::size_t>(i)];
    one.tip = length * d;
    if (shown <= least_shown) {
      one = {{}, QPointF(-11, 12), true};
    } else if (shown > 0.5) {
      one.name = (length + to_letter / shown) * d;
    } else {
      one.name = 2.0 * (length + to_letter) * shown * d + QPointF(6, -6);
    }
  }
  return axes;
}

/// What they take around their origin, letters and halos among it.
QRectF triadExtent(const std::array<TriadAxis, 3>& axes) {
  constexpr double dot = 4;
  constexpr double letter = 9;
  QRectF extent(-dot, -dot, 2 * dot, 2 * dot);
  for (const TriadAxis& axis : axes)
    extent |= QRectF(axis.name - QPointF(letter, letter), QSizeF(2 * letter, 2 * letter));
  return extent;
}

}  // namespace

QRectF triadPlace(const QRectF& view, const Camera& camera) {
  constexpr double to_edge = 6;
  QRectF place = triadExtent(triadAxes(camera));
  place.moveBottomLeft(view.bottomLeft() + QPointF(to_edge, -to_edge));
  return place;
}

void paintTriad(QPainter& painter, const QRectF& area, const Camera& camera) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(textFont(sizes::font_secondary, QFont::DemiBold));
  const QFontMetricsF metrics(painter.font());
  const std::array<TriadAxis, 3> axes = triadAxes(camera);
  const QPointF centre = triadPlace(area, camera).topLeft() - triadExtent(axes).topLeft();
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return camera.forward()[a] > camera.forward()[b];  // far ones first
  });
  for (const int i : order) {
    const TriadAxis& axis = axes[static_cast<std::size_t>(i)];
    painter.setPen(QPen(axisColour(i), 2.2, Qt::SolidLine, Qt::RoundCap));
    if (axis.towards) {
      painter.setBrush(axisColour(i));
      painter.drawEllipse(centre, 3, 3);
    } else {
      painter.drawLine(centre, centre + axis.tip);
    }
    const QString name = QString(QLatin1Char("XYZ"[i]));
    haloText(painter, centre + axis.name + QPointF(-metrics.horizontalAdvance(name) / 2, metrics.ascent() / 2 - 2),
             name, axisColour(i));
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
    const QString text = onScreen(
        QStringLiteral("%1  %2 mm").arg(motion.name, decimalText((motion.to_mm - motion.from_mm).norm(), 'f', 0)));
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
  // Round where it is read.
  const ShownUnit unit = shownUnit(QStringLiteral("mm"));
  return roundStep(unit.factor * std::max(extent.maxCoeff(), 1e-6) / 10) / unit.factor;
}

std::vector<OverlayText> tableScale(const Camera& camera, const QSizeF& size, const MachineBodies& bodies) {
  std::vector<OverlayText> texts;
  const QFontMetricsF metrics(textFont(table_scale_px));
  const auto textAt = [&](const QPointF& baseline, const QString& text) {
    const QRectF box(baseline.x(), baseline.y() - metrics.ascent(), metrics.horizontalAdvance(text), metrics.height());
    return OverlayText{baseline, text, box.adjusted(-2, 0, 2, 0)};  // with its halo
  };
  const double spacing = gridSpacing_mm(bodies);
  const ShownUnit unit = shownUnit(QStringLiteral("mm"));
  const Eigen::Vector3d& low = bodies.table_low_mm;
  const Eigen::Vector3d& high = bodies.table_high_mm;
  const int up = verticalAxis(bodies);
  const auto centre = camera.project(0.5 * (low + high), size);
  if (!centre) return texts;
  const int unit_axis = up == 0 ? 1 : 0;  // its last number carries the unit
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
    // Seen along the vertical both edges of one axis are as high: rounding must not say which.
    const bool by_height = (i == 0 || up == 1) && std::abs(p_low->y() - p_high->y()) > 1.0;
    const bool use_low = by_height ? p_low->y() >= p_high->y() : p_low->x() <= p_high->x();
    const double fixed = use_low ? low[other] : high[other];
    // The number of one place along the axis; empty where it cannot be seen.
    const auto numberAt = [&](double v, bool with_unit) -> std::optional<OverlayText> {
      Eigen::Vector3d p = low;
      p[up] = low[up];
      p[i] = v;
      p[other] = fixed;
      Eigen::Vector3d inner = p;
      inner[other] = 0.5 * (low[other] + high[other]);
      const auto at = camera.project(p, size);
      const auto inward = camera.project(inner, size);
      if (!at || !inward) return std::nullopt;
      QPointF out = *at - *inward;
      const double norm = std::hypot(out.x(), out.y());
      if (norm < 4) return std::nullopt;
      out /= norm;
      const QString text =
          decimalText(std::abs(v) < 1e-9 ? 0.0 : unit.shown(v), 'f', unit.factor * spacing < 0.999 ? 1 : 0);
      const double w = metrics.horizontalAdvance(text);
      const QPointF anchor = *at + out * 9;
      const QPointF baseline(anchor.x() - w / 2 + out.x() * w / 2, anchor.y() + metrics.ascent() / 2 - 1 + out.y() * 4);
      return textAt(baseline, with_unit ? text + QLatin1Char(' ') + unit.name : text);
    };
    // As many of them as stand apart, at even distances; the last one has the unit.
    std::vector<OverlayText> numbers;
    for (const int every : {1, 2, 5, 10, 20, 50}) {
      const double step = every * spacing;
      numbers.clear();
      for (double v = std::ceil(low[i] / step) * step; v <= high[i] + 1e-9; v += step)
        if (auto number = numberAt(v, i == unit_axis && v + step > high[i] + 1e-9)) numbers.push_back(*number);
      const auto touch = [](const OverlayText& one, const OverlayText& next) {
        return one.box.adjusted(-4, 0, 4, 0).intersects(next.box);
      };
      if (std::adjacent_find(numbers.begin(), numbers.end(), touch) == numbers.end()) break;
    }
    texts.insert(texts.end(), numbers.begin(), numbers.end());
  }
  return texts;
}

void paintTableScale(QPainter& painter, const Camera& camera, const QSizeF& size, const MachineBodies& bodies,
                     const QRectF& bar) {
  painter.save();
  painter.setFont(textFont(table_scale_px));
  const QRectF picture(QPointF(0, 0), size);
  for (const OverlayText& text : tableScale(camera, size, bodies))
    if (picture.contains(text.box) && !bar.intersects(text.box))
      haloText(painter, text.baseline, text.text, theme().text_secondary);
  painter.restore();
}

void paintDistance(QPainter& painter, const QSizeF& size, const std::vector<QPointF>& ends, const QString& text) {
  const Theme& t = theme();
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  if (ends.size() == 2) {
    painter.setPen(QPen(t.view_top, 4, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(ends[0], ends[1]);
    painter.setPen(QPen(t.accent, 2, Qt::DashLine, Qt::FlatCap));
    painter.drawLine(ends[0], ends[1]);
  }
  for (const QPointF& end : ends) {
    painter.setPen(QPen(t.view_top, 1.5));
    painter.setBrush(t.accent);
    painter.drawEllipse(end, 5, 5);
  }
  if (ends.size() == 2) {
    painter.setFont(textFont(sizes::font_secondary, QFont::DemiBold));
    const QFontMetricsF metrics(painter.font());
    const QRectF picture = QRectF(QPointF(0, 0), size).adjusted(4, 4, -4, -4);
    QRectF box(0, 0, std::min(metrics.horizontalAdvance(text) + 16, picture.width()), metrics.height() + 8);
    box.moveCenter(0.5 * (ends[0] + ends[1]) - QPointF(0, 18));
    box.moveLeft(std::clamp(box.left(), picture.left(), picture.right() - box.width()));
    box.moveTop(std::clamp(box.top(), picture.top(), picture.bottom() - box.height()));
    painter.setPen(QPen(t.accent, 1));
    painter.setBrush(t.surface);
    painter.drawRoundedRect(box, 4, 4);
    painter.setPen(t.text);
    painter.drawText(box, Qt::AlignCenter, metrics.elidedText(text, Qt::ElideRight, box.width() - 12));
  }
  painter.restore();
}

void paintSurfaceAxes(QPainter& painter, const Camera& camera, const QSizeF& size, const ViewSurface& surface,
                      const SurfaceBox& box, const ColourScale& scale) {
  const Theme& t = theme();
  painter.save();
  painter.setFont(textFont(sizes::font_secondary));
  const QFontMetricsF metrics(painter.font());
  const QRectF picture = QRectF(QPointF(0, 0), size).adjusted(4, 4, -4, -4);
  const Eigen::Vector3d& reach = SurfaceBox::size_mm;
  const auto at = [&](const Eigen::Vector3d& mm) { return camera.project(mm, size).value_or(QPointF()); };
  const auto write = [&](const QPointF& edge, const QPointF& inward, const QString& text, double away,
                         const QColor& c) {
    QPointF out = edge - inward;
    out *= away / std::max(1.0, std::hypot(out.x(), out.y()));
    const double w = metrics.horizontalAdvance(text);
    const QPointF middle = edge + out + QPointF(out.x() / away * w / 2, 0);
    const double x = std::clamp(middle.x() - w / 2, picture.left(), std::max(picture.left(), picture.right() - w));
    const double y =
        std::clamp(middle.y() + metrics.ascent() / 2 - 1, picture.top() + metrics.ascent(), picture.bottom());
    haloText(painter, {x, y}, text, c);
  };
  const auto steps = [](const std::vector<double>& ticks) { return ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0; };
  // Along the edges of the floor nearer to the viewer.
  for (int i = 0; i < 2; ++i) {
    const int other = 1 - i;
    Eigen::Vector3d edge = Eigen::Vector3d::Zero();
    edge[other] = camera.forward()[other] > 0 ? 0.0 : reach[other];
    const auto place = [&](double mm) {
      Eigen::Vector3d p = edge;
      p[i] = mm;
      Eigen::Vector3d inner = p;
      inner[other] = 0.5 * reach[other];
      return std::pair{at(p), at(inner)};
    };
    const double length = QLineF(place(0).first, place(reach[i]).first).length();
    const QString& title = i == 0 ? surface.x_title : surface.y_title;
    const ShownUnit unit = unitOfTitle(title);
    const std::vector<double> ticks = roundTicks(unit.shown(box.low[i]), unit.shown(box.high[i]),
                                                 std::clamp(static_cast<int>(length / tick_px), 1, 5));
    for (const double v : ticks) {
      const auto [outer, inner] = place((unit.stored(v) - box.low[i]) / (box.high[i] - box.low[i]) * reach[i]);
      write(outer, inner, tickText(v, steps(ticks)), 12, t.text_secondary);
    }
    const auto [outer, inner] = place(0.5 * reach[i]);
    write(outer, inner, shownTitle(title), 40, t.text);
  }
  // Along the vertical edge furthest to the left.
  Eigen::Vector3d left = Eigen::Vector3d::Zero();
  for (const double x : {0.0, reach.x()})
    for (const double y : {0.0, reach.y()})
      if (at({x, y, 0}).x() < at(left).x()) left = {x, y, 0};
  const std::vector<double> ticks = scale.ticks();
  const double high = QLineF(at(left), at({left.x(), left.y(), reach.z()})).length();
  const double apart = high * steps(ticks) / (scale.high - scale.low);
  const int every = std::max(1, static_cast<int>(std::ceil(metrics.height() / std::max(apart, 1.0))));
  for (const double v : ticks) {
    if (std::lround(v / steps(ticks)) % every != 0) continue;
    const QPointF p = at({left.x(), left.y(), (v - box.low.z()) / (box.high.z() - box.low.z()) * reach.z()});
    write(p, p + QPointF(10, 0), scale.text(v, steps(ticks)), 8, t.text_secondary);
  }
  const QPointF top = at({left.x(), left.y(), reach.z()});
  write(top, top + QPointF(0, 10), shownTitle(surface.value_title), 14, t.text);
  painter.restore();
}

QString quantityWithUncertainty(double value, double sigma, const QString& unit) {
  const ShownUnit shown = shownUnit(unit);
  return std::isfinite(sigma) ? shownNumbers(QString::fromStdString(withUncertainty(
                                    shown.shown(value), shown.factor * sigma, shown.name.toStdString())))
                              : View3D::tr("%1 %2").arg(decimalText(shown.shown(value), 'g', 4), shown.name);
}

QString surfaceNodeText(const ViewSurface& surface, const QString& unit, std::size_t node) {
  const auto quantity = [](const QString& title, double value) {  // "Position / mm": "Position 550 mm"
    const ShownUnit of = unitOfTitle(title);
    return View3D::tr("%1 %2 %3")
        .arg(title.section(QStringLiteral(" / "), 0, 0), decimalText(of.shown(value), 'g', 4), of.name);
  };
  const double sigma = surface.sigma.size() == surface.value.size() ? surface.sigma[node] : std::nan("");
  return View3D::tr("%1, %2: %3")
      .arg(quantity(surface.x_title, surface.x[node % surface.x.size()]),
           quantity(surface.y_title, surface.y[node / surface.x.size()]),
           quantityWithUncertainty(surface.value[node], sigma, unit));
}

void paintCursorRing(QPainter& painter, const QPointF& centre) {
  constexpr double radius_px = 6.5;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(theme().surface, 5));
  painter.drawEllipse(centre, radius_px, radius_px);
  painter.setPen(QPen(theme().tone(Tone::Accent), 2.5));
  painter.drawEllipse(centre, radius_px, radius_px);
  painter.restore();
}

}  // namespace spindrift::gui
