// SPDX-License-Identifier: GPL-3.0-or-later
// What the mouse and the keys do in the 3D view, and what stands under the cursor.
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/scene.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr double pick_radius_px = 12;

}  // namespace

QString View3D::pointAt(const QPointF& pixel) const {
  QString best;
  double nearest = pick_radius_px;
  double depth = 1e300;
  for (const ViewPoint& point : points_) {
    const auto p = camera_.project(point.position_mm, viewSize());
    if (!p) continue;
    const double d = std::hypot(p->x() - pixel.x(), p->y() - pixel.y());
    const double z = camera_.depth_mm(point.position_mm);
    if (d < nearest - 2 || (d <= nearest && z < depth)) {
      nearest = std::min(nearest, d);
      depth = z;
      best = point.id;
    }
  }
  return best;
}

std::optional<View3D::Probe> View3D::probeAt(const QPointF& pixel) const {
  if (field_ == nullptr || field_->value.empty()) return std::nullopt;
  const FieldGrid& grid = field_->grid;
  const auto p = camera_.meetPlane(pixel, viewSize(), Eigen::Vector3d::Unit(grid.normal_axis), grid.z_mm);
  if (!p) return std::nullopt;
  const Eigen::Vector2d on_plane((*p)(grid.firstAxis()), (*p)(grid.secondAxis()));
  const double u = (on_plane.x() - grid.x_from_mm) / (grid.x_to_mm - grid.x_from_mm) * (grid.nx - 1);
  const double v = (on_plane.y() - grid.y_from_mm) / (grid.y_to_mm - grid.y_from_mm) * (grid.ny - 1);
  if (!(u >= 0 && v >= 0 && u <= grid.nx - 1 && v <= grid.ny - 1)) return std::nullopt;
  const int ix = std::min(static_cast<int>(u), grid.nx - 2);
  const int iy = std::min(static_cast<int>(v), grid.ny - 2);
  const double fx = u - ix;
  const double fy = v - iy;
  const auto between = [&](const std::vector<double>& a) {
    return (1 - fy) * ((1 - fx) * a[grid.index(ix, iy)] + fx * a[grid.index(ix + 1, iy)]) +
           fy * ((1 - fx) * a[grid.index(ix, iy + 1)] + fx * a[grid.index(ix + 1, iy + 1)]);
  };
  Probe probe;
  probe.xy_mm = on_plane;
  probe.value = between(field_->value);
  probe.sigma = field_->sigma.size() == field_->value.size() ? between(field_->sigma) : 0.0;
  probe.extrapolated =
      !field_->extrapolated.empty() && field_->extrapolated[grid.index(fx > 0.5 ? ix + 1 : ix, fy > 0.5 ? iy + 1 : iy)];
  return probe;
}

std::optional<std::size_t> View3D::cloudPointAt(const QPointF& pixel) const {
  if (cloud_.xyz_mm == nullptr) return std::nullopt;
  const QSizeF size = viewSize();
  double nearest = 6;
  double depth = 1e300;
  std::optional<std::size_t> best;
  const std::size_t count = cloud_.xyz_mm->size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3f>(cloud_.xyz_mm->data() + 3 * i).cast<double>();
    const auto at = camera_.project(p, size);
    if (!at) continue;
    const double dx = at->x() - pixel.x();
    const double dy = at->y() - pixel.y();
    const double d = std::sqrt(dx * dx + dy * dy);
    if (d > 6) continue;
    const double z = camera_.depth_mm(p);
    if (!best || d < nearest - 1.5 || (d < nearest + 1.5 && z < depth)) {
      nearest = std::min(nearest, d);
      depth = z;
      best = i;
    }
  }
  return best;
}

std::optional<QPointF> View3D::pixelOf(const Eigen::Vector3d& point_mm) const {
  return camera_.project(point_mm, viewSize());
}

void View3D::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  // A view that nobody has turned yet keeps showing everything.
  if (event->oldSize().isEmpty() || (fitted_ && camera_ == automatic_)) fitted_ = false;
}

void View3D::mousePressEvent(QMouseEvent* event) {
  setFocus(Qt::MouseFocusReason);
  press_position_ = last_position_ = event->position();
  dragging_ = false;
}

void View3D::mouseMoveEvent(QMouseEvent* event) {
  const QPointF position = event->position();
  if (event->buttons() == Qt::NoButton) {
    QString text;
    if (const auto probe = probeAt(position)) {
      const FieldGrid& grid = field_->grid;
      text = tr("%1 %2 mm, %3 %4 mm: %5")
                 .arg(QLatin1Char("xyz"[grid.firstAxis()]))
                 .arg(decimalText(probe->xy_mm.x(), 'f', 1))
                 .arg(QLatin1Char("xyz"[grid.secondAxis()]))
                 .arg(decimalText(probe->xy_mm.y(), 'f', 1))
                 .arg(shownNumbers(
                     QString::fromStdString(withUncertainty(probe->value, probe->sigma, unitOf(field_->component)))));
      if (probe->extrapolated) text += tr(" (extrapolated)");
    }
    Q_EMIT cursorMoved(position);
    setHoveredPoint(pointAt(position));
    setCursor(hovered_point_.isEmpty() ? Qt::ArrowCursor : Qt::PointingHandCursor);
    Q_EMIT hovered(text);
    return;
  }
  if (!dragging_ && (position - press_position_).manhattanLength() < 4) return;
  dragging_ = true;
  const QPointF moved = position - last_position_;
  last_position_ = position;
  const bool pan =
      (event->buttons() & (Qt::MiddleButton | Qt::RightButton)) != 0 || (event->modifiers() & Qt::ShiftModifier) != 0;
  if (pan) {
    camera_.pan(moved, viewSize());
  } else {
    camera_.turn(-moved.x() * 0.008, moved.y() * 0.008);
  }
  cameraMoved();
}

void View3D::mouseReleaseEvent(QMouseEvent* event) {
  if (!dragging_ && event->button() == Qt::LeftButton) {
    const QString id = pointAt(event->position());
    if (!id.isEmpty()) {
      setSelected(id);
      Q_EMIT pointPicked(id);
    }
  }
  dragging_ = false;
}

void View3D::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && pointAt(event->position()).isEmpty()) {
    fitted_ = false;
    cameraMoved();
  }
}

void View3D::wheelEvent(QWheelEvent* event) {
  camera_.zoom(std::pow(1.0015, event->angleDelta().y()), event->position(), viewSize());
  cameraMoved();
  event->accept();
}

void View3D::keyPressEvent(QKeyEvent* event) {
  const bool shift = (event->modifiers() & Qt::ShiftModifier) != 0;
  const auto move = [&](double x, double y) {
    if (shift) {
      camera_.pan(QPointF(-20 * x, 20 * y), viewSize());
    } else {
      camera_.turn(0.1 * x, 0.1 * y);
    }
    cameraMoved();
  };
  const QPointF middle(width() / 2.0, height() / 2.0);
  const auto pick = [&](int step) {
    if (points_.empty()) return;
    const auto found =
        std::find_if(points_.begin(), points_.end(), [&](const ViewPoint& p) { return p.id == selected_; });
    const auto count = static_cast<std::ptrdiff_t>(points_.size());
    const std::ptrdiff_t now = found == points_.end() ? (step > 0 ? -1 : 0) : found - points_.begin();
    const QString id = points_[static_cast<std::size_t>((now + step + count) % count)].id;
    setSelected(id);
    Q_EMIT pointPicked(id);
  };
  switch (event->key()) {
    case Qt::Key_Left:
      move(-1, 0);
      return;
    case Qt::Key_Right:
      move(1, 0);
      return;
    case Qt::Key_Up:
      move(0, 1);
      return;
    case Qt::Key_Down:
      move(0, -1);
      return;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      camera_.zoom(1.2, middle, viewSize());
      cameraMoved();
      return;
    case Qt::Key_Minus:
      camera_.zoom(1 / 1.2, middle, viewSize());
      cameraMoved();
      return;
    case Qt::Key_R:
    case Qt::Key_Home:
      fitted_ = false;
      cameraMoved();
      return;
    case Qt::Key_1:
      resetCamera(StandardView::Isometric);
      return;
    case Qt::Key_2:
      resetCamera(StandardView::Top);
      return;
    case Qt::Key_3:
      resetCamera(StandardView::Front);
      return;
    case Qt::Key_4:
      resetCamera(StandardView::Right);
      return;
    case Qt::Key_P:
      setOrthographic(!camera_.orthographic);
      return;
    case Qt::Key_N:
      pick(1);
      return;
    case Qt::Key_B:
      pick(-1);
      return;
    default:
      QWidget::keyPressEvent(event);
  }
}

void View3D::setHoveredPoint(const QString& id) {
  if (hovered_point_ == id) return;
  hovered_point_ = id;
  update();
}

void View3D::leaveEvent(QEvent* event) {
  setHoveredPoint({});
  Q_EMIT hovered({});
  QWidget::leaveEvent(event);
}

bool View3D::event(QEvent* event) {
  if (event->type() == QEvent::FocusIn || event->type() == QEvent::FocusOut) update();
  return QWidget::event(event);
}

}  // namespace spindrift::gui
