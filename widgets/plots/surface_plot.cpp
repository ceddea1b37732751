// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plots/surface_plot.h"

#include <QFontMetricsF>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

/// Limits of an axis; a single value gets some room.
std::pair<double, double> limits(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double room = *high > *low ? 0.0 : std::max(1e-9, 0.5 * std::abs(*low) + 0.5);
  return {*low - room, *high + room};
}

}  // namespace

/// From the unit cube (x, y, value in 0 ... 1) to pixels.
struct SurfacePlot::Projection {
  double azimuth, elevation;
  QPointF centre;
  double scale;
  std::pair<double, double> x, y, v;

  [[nodiscard]] QPointF unit(double a, double b, double c) const {
    const double p = a - 0.5;
    const double q = b - 0.5;
    const double r = 0.62 * (c - 0.5);
    const double right = p * std::cos(azimuth) - q * std::sin(azimuth);
    const double away = p * std::sin(azimuth) + q * std::cos(azimuth);
    return centre + QPointF(right, -(r * std::cos(elevation) + away * std::sin(elevation))) * scale;
  }
  [[nodiscard]] double away(double a, double b) const {
    return (a - 0.5) * std::sin(azimuth) + (b - 0.5) * std::cos(azimuth);
  }
  [[nodiscard]] double u(double value) const { return (value - x.first) / (x.second - x.first); }
  [[nodiscard]] double w(double value) const { return (value - y.first) / (y.second - y.first); }
  [[nodiscard]] double h(double value) const { return (value - v.first) / (v.second - v.first); }
};

SurfacePlot::SurfacePlot(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Surface over position and time"));
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] { update(); });
}

void SurfacePlot::setAxes(const QString& x_title, const QString& y_title, const QString& value_title) {
  x_title_ = x_title;
  y_title_ = y_title;
  value_title_ = value_title;
  update();
}

void SurfacePlot::setData(SurfaceData data, const ColourScale& scale) {
  data_ = std::move(data);
  scale_ = scale;
  update();
}

void SurfacePlot::setEmptyText(const QString& title, const QString& how) {
  empty_title_ = title;
  empty_how_ = how;
  update();
}

bool SurfacePlot::empty() const {
  return std::none_of(data_.value.begin(), data_.value.end(), [](double v) { return std::isfinite(v); });
}

void SurfacePlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  paint(painter, size());
  if (hasFocus()) {
    painter.setPen(QPen(theme().accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(rect()).adjusted(1, 1, -1, -1));
  }
}

void SurfacePlot::paint(QPainter& painter, const QSizeF& size) const {
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(QRectF(QPointF(0, 0), size), theme().surface);
  if (empty()) {
    const QRectF area = QRectF(QPointF(0, 0), size).adjusted(24, 16, -24, -16);
    painter.setFont(textFont(sizes::font_body, QFont::DemiBold));
    painter.setPen(theme().text);
    painter.drawText(area.adjusted(0, 0, 0, -area.height() / 2), Qt::AlignHCenter | Qt::AlignBottom | Qt::TextWordWrap,
                     empty_title_);
    painter.setFont(textFont(sizes::font_body));
    painter.setPen(theme().text_secondary);
    painter.drawText(area.adjusted(0, area.height() / 2 + 8, 0, 0), Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap,
                     empty_how_);
    return;
  }
  Projection view{azimuth_rad_,
                  elevation_rad_,
                  QPointF(size.width() / 2, size.height() / 2 - 6),
                  std::min(size.width() / 1.75, size.height() / 1.5),
                  limits(data_.x),
                  limits(data_.y),
                  {scale_.low, scale_.high}};
  paintFrame(painter, view);
  paintSurface(painter, view);
}

void SurfacePlot::paintFrame(QPainter& painter, const Projection& view) const {
  const Theme& t = theme();
  painter.setFont(textFont(sizes::font_secondary));
  const QFontMetricsF metrics(painter.font());
  const QPen grid(mixed(t.surface, t.grid, 0.6), 1);
  const QPen edge(t.border_strong, 1);
  // The edges of the floor nearer to the viewer carry the numbers, the walls behind carry the lines.
  const double near_y = view.away(0.5, 0) < view.away(0.5, 1) ? 0 : 1;
  const double near_x = view.away(0, 0.5) < view.away(1, 0.5) ? 0 : 1;
  const auto label = [&](const QPointF& at, const QPointF& inward, const QString& text, double away, const QColor& c) {
    QPointF out = at - inward;
    const double n = std::max(1.0, std::hypot(out.x(), out.y()));
    out *= away / n;
    const double w = metrics.horizontalAdvance(text);
    const QPointF p = at + out;
    painter.setPen(c);
    painter.drawText(QPointF(p.x() - w / 2 + out.x() / away * w / 2, p.y() + metrics.ascent() / 2 - 1), text);
  };
  const auto floorAxis = [&](bool along_x, const std::vector<double>& ticks, const QString& title) {
    const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
    const auto point = [&](double v, double across, double height) {
      return along_x ? view.unit(view.u(v), across, height) : view.unit(across, view.w(v), height);
    };
    const double near_side = along_x ? near_y : near_x;
    for (const double v : ticks) {
      painter.setPen(grid);
      painter.drawLine(point(v, 0, 0), point(v, 1, 0));
      painter.drawLine(point(v, 1 - near_side, 0), point(v, 1 - near_side, 1));
      label(point(v, near_side, 0), point(v, 0.5, 0), tickText(v, step), 12, t.text_secondary);
    }
    const double middle = along_x ? 0.5 * (view.x.first + view.x.second) : 0.5 * (view.y.first + view.y.second);
    label(point(middle, near_side, 0), point(middle, 0.5, 0), title, 48, t.text);
  };
  floorAxis(true, roundTicks(view.x.first, view.x.second, 5), x_title_);
  floorAxis(false, roundTicks(view.y.first, view.y.second, 5), y_title_);
  // Values: along the vertical edge that stands furthest to the left.
  std::array<std::pair<double, double>, 4> corners{{{0, 0}, {0, 1}, {1, 0}, {1, 1}}};
  const auto left = *std::min_element(corners.begin(), corners.end(), [&](const auto& a, const auto& b) {
    return view.unit(a.first, a.second, 0).x() < view.unit(b.first, b.second, 0).x();
  });
  const std::vector<double> ticks = scale_.ticks();
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  for (const double v : ticks) {
    const double height = view.h(v);
    painter.setPen(v == 0.0 ? edge : grid);
    painter.drawLine(view.unit(0, 1 - near_y, height), view.unit(1, 1 - near_y, height));
    painter.drawLine(view.unit(1 - near_x, 0, height), view.unit(1 - near_x, 1, height));
    const QPointF at = view.unit(left.first, left.second, height);
    const QString text = tickText(v, step);
    painter.setPen(t.text_secondary);
    painter.drawText(QPointF(at.x() - 8 - metrics.horizontalAdvance(text), at.y() + metrics.ascent() / 2 - 1), text);
  }
  painter.setPen(edge);
  painter.drawLine(view.unit(left.first, left.second, 0), view.unit(left.first, left.second, 1));
  painter.setPen(t.text);
  const QPointF top = view.unit(left.first, left.second, 1);
  painter.drawText(QPointF(std::max(4.0, top.x() - 24), top.y() - 10), value_title_);
}

void SurfacePlot::paintSurface(QPainter& painter, const Projection& view) const {
  const Theme& t = theme();
  const std::size_t columns = data_.x.size();
  const std::size_t rows = data_.y.size();
  const auto value = [&](std::size_t i, std::size_t j) { return data_.value[j * columns + i]; };
  const auto node = [&](std::size_t i, std::size_t j, double v) {
    return view.unit(view.u(data_.x[i]), view.w(data_.y[j]), view.h(v));
  };
  struct Cell {
    std::size_t i, j;
    double away;
  };
  std::vector<Cell> cells;
  for (std::size_t j = 0; j + 1 < rows; ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      cells.push_back({i, j, view.away(view.u(data_.x[i]), view.w(data_.y[j]))});
    }
  }
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.away > b.away; });
  for (const Cell& c : cells) {
    const std::array<double, 4> v{value(c.i, c.j), value(c.i + 1, c.j), value(c.i + 1, c.j + 1), value(c.i, c.j + 1)};
    if (!std::all_of(v.begin(), v.end(), [](double a) { return std::isfinite(a); })) continue;
    // A cell is drawn in small pieces, each in the colour of its own value.
    constexpr int parts = 16;
    painter.setRenderHint(QPainter::Antialiasing, false);  // else the seams between the pieces show
    const auto between = [&](double a, double b) {
      return (1 - b) * ((1 - a) * v[0] + a * v[1]) + b * ((1 - a) * v[3] + a * v[2]);
    };
    const auto at = [&](double a, double b) {
      const double x = data_.x[c.i] + a * (data_.x[c.i + 1] - data_.x[c.i]);
      const double y = data_.y[c.j] + b * (data_.y[c.j + 1] - data_.y[c.j]);
      return view.unit(view.u(x), view.w(y), view.h(between(a, b)));
    };
    for (int p = 0; p < parts * parts; ++p) {
      const double a = static_cast<double>(p % parts) / parts;
      const double b = static_cast<double>(p / parts) / parts;
      const double d = 1.0 / parts;
      const std::array<QPointF, 4> corners{at(a, b), at(a + d, b), at(a + d, b + d), at(a, b + d)};
      const QColor colour = scale_.colour(between(a + d / 2, b + d / 2));
      painter.setPen(QPen(colour, 0.6));
      painter.setBrush(colour);
      painter.drawPolygon(corners.data(), 4);
    }
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(mixed(t.text, t.surface, 0.35), 1));
    const std::array<QPointF, 4> outline{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
    painter.drawPolygon(outline.data(), 4);
  }
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const double v = value(i, j);
      if (!std::isfinite(v)) continue;
      if (data_.sigma.size() == data_.value.size() && std::isfinite(data_.sigma[j * columns + i])) {
        const double s = data_.sigma[j * columns + i];
        painter.setPen(QPen(t.text_secondary, 1.4));
        painter.drawLine(node(i, j, v - s), node(i, j, v + s));
      }
      painter.setPen(QPen(t.text, 1));
      painter.setBrush(scale_.colour(v));
      painter.drawEllipse(node(i, j, v), 3.5, 3.5);
    }
  }
}

void SurfacePlot::turn(double azimuth, double elevation) {
  azimuth_rad_ += azimuth;
  elevation_rad_ = std::clamp(elevation_rad_ + elevation, 0.1, 1.45);
  update();
}

void SurfacePlot::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  last_ = event->position();
}

void SurfacePlot::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) return;
  const QPointF moved = event->position() - last_;
  last_ = event->position();
  turn(moved.x() * 0.008, moved.y() * 0.008);
}

void SurfacePlot::mouseDoubleClickEvent(QMouseEvent*) {
  azimuth_rad_ = -0.9;
  elevation_rad_ = 0.45;
  update();
}

void SurfacePlot::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return turn(-0.1, 0);
    case Qt::Key_Right:
      return turn(0.1, 0);
    case Qt::Key_Up:
      return turn(0, 0.1);
    case Qt::Key_Down:
      return turn(0, -0.1);
    default:
      QWidget::keyPressEvent(event);
  }
}

void SurfacePlot::exportTo(const QString& file) const {
  if (file.toLower().endsWith(QLatin1String(".csv"))) {
    std::string text = "x,y,value,sigma\n";
    for (std::size_t j = 0; j < data_.y.size(); ++j) {
      for (std::size_t i = 0; i < data_.x.size(); ++i) {
        const std::size_t n = j * data_.x.size() + i;
        if (!std::isfinite(data_.value[n])) continue;
        text += exactNumber(data_.x[i]) + "," + exactNumber(data_.y[j]) + "," + exactNumber(data_.value[n]) + "," +
                (n < data_.sigma.size() && std::isfinite(data_.sigma[n]) ? exactNumber(data_.sigma[n]) : "") + "\n";
      }
    }
    writeFileAtomically(file.toStdString(), text);
    return;
  }
  const QSize size(std::max(width(), 640), std::max(height(), 480));
  QImage image(size * 2, QImage::Format_RGB32);
  image.setDevicePixelRatio(2.0);
  QPainter painter(&image);
  paint(painter, size);
  painter.end();
  if (!image.save(file)) throw InputError({file.toStdString(), ""}, "the picture could not be written.");
}

}  // namespace spindrift::gui
