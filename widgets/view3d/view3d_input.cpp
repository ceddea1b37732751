// SPDX-License-Identifier: GPL-3.0-or-later
// What the mouse and the keys do in the 3D view, and what stands under the cursor.
#include <QKeyEvent>
#include <QMouseEvent>
#include <QNativeGestureEvent>
#include <QPointingDevice>
#include <QTouchEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/scene.h"
#include "widgets/view3d/view3d.h"
#include "widgets/view3d/view_tools.h"

namespace spindrift::gui {
namespace {

constexpr double pick_radius_px = 12;

}  // namespace

QString View3D::pointAt(const QPointF& pixel) const {
  QString best;
  double nearest = pick_radius_px;
  double depth = 1e300;
  for (const ViewPoint& point : points_) {
    if (clip_ && !clip_->keeps(point.position_mm)) continue;
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
  if (cloud_.xyz_mm == nullptr || scene_ == nullptr) return std::nullopt;
  return scene_->cloudPointAt(camera_, viewSize(), pixel,
                              [this](const Eigen::Vector3d& p) { return !clip_ || clip_->keeps(p); });
}

std::optional<std::size_t> View3D::surfaceNodeAt(const QPointF& pixel) const {
  if (!surface_box_) return std::nullopt;
  std::optional<std::size_t> best;
  double nearest = pick_radius_px;
  for (std::size_t i = 0; i < surface_->value.size(); ++i) {
    if (!std::isfinite(surface_->value[i])) continue;
    const std::size_t columns = surface_->x.size();
    const Eigen::Vector3d place =
        surface_box_->place_mm({surface_->x[i % columns], surface_->y[i / columns], surface_->value[i]});
    const auto at = camera_.project(place, viewSize());
    if (!at) continue;
    const double distance = std::hypot(at->x() - pixel.x(), at->y() - pixel.y());
    if (distance > nearest) continue;
    nearest = distance;
    best = i;
  }
  return best;
}

std::optional<QPointF> View3D::pixelOf(const Eigen::Vector3d& point_mm) const {
  return camera_.project(point_mm, viewSize());
}

void View3D::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  tools_->refresh();
  // A view that nobody has turned yet keeps showing everything.
  if (event->oldSize().isEmpty() || (fitted_ && camera_ == automatic_)) fitted_ = false;
}

void View3D::press(const QPointF& position) {
  setFocus(Qt::MouseFocusReason);
  press_position_ = last_position_ = position;
  dragging_ = false;
}

void View3D::drag(const QPointF& position, bool pan) {
  if (!dragging_ && (position - press_position_).manhattanLength() < 4) return;
  dragging_ = true;
  const QPointF moved = position - last_position_;
  last_position_ = position;
  if (pan) {
    camera_.pan(moved, viewSize());
  } else {
    camera_.turn(-moved.x() * 0.008, moved.y() * 0.008);
  }
  cameraMoved();
}

void View3D::release(const QPointF& position, bool picks) {
  if (!dragging_ && picks && measuring_) {
    pickEnd(position);
  } else if (!dragging_ && picks) {
    const QString id = pointAt(position);
    if (!id.isEmpty()) {
      setSelected(id);
      Q_EMIT pointPicked(id);
    }
  }
  dragging_ = false;
}

void View3D::hover(const QPointF& position) {
  Q_EMIT cursorMoved(position);
  const QString id = pointAt(position);
  setHoveredPoint(id);
  if (!measuring_) setCursor(id.isEmpty() ? Qt::ArrowCursor : Qt::PointingHandCursor);
  Q_EMIT hovered(textAt(position));
}

QString View3D::textAt(const QPointF& position) const {
  const QString id = pointAt(position);
  const auto point = std::find_if(points_.begin(), points_.end(), [&](const ViewPoint& p) { return p.id == id; });
  if (!id.isEmpty() && point != points_.end() && !point->value_text.isEmpty())
    return tr("%1: %2").arg(point->label.isEmpty() ? id : point->label, onScreen(point->value_text));
  const QString unit = scale_ ? scale_->unit : QString();
  if (const auto i = surfaceNodeAt(position)) return surfaceNodeText(*surface_, unit, *i);
  if (const auto probe = probeAt(position)) {
    const FieldGrid& grid = field_->grid;
    const QString place = tr("%1 %2 mm, %3 %4 mm: %5")
                              .arg(QLatin1Char("xyz"[grid.firstAxis()]))
                              .arg(decimalText(probe->xy_mm.x(), 'f', 1))
                              .arg(QLatin1Char("xyz"[grid.secondAxis()]))
                              .arg(decimalText(probe->xy_mm.y(), 'f', 1))
                              .arg(shownNumbers(QString::fromStdString(
                                  withUncertainty(probe->value, probe->sigma, unitOf(field_->component)))));
    const QString text = onScreen(place);
    return probe->extrapolated ? text + tr(" (extrapolated)") : text;
  }
  const auto i = cloudPointAt(position);
  if (!i) return {};
  const float* p = cloud_.xyz_mm->data() + 3 * *i;
  const QString place =
      onScreen(tr("x %1 mm, y %2 mm, z %3 mm")
                   .arg(decimalText(p[0], 'f', 2), decimalText(p[1], 'f', 2), decimalText(p[2], 'f', 3)));
  if (cloud_.scalar == nullptr) return place;
  const double sigma = cloud_.sigma == nullptr ? std::nan("") : static_cast<double>((*cloud_.sigma)[*i]);
  return tr("%1: %2").arg(place, quantityWithUncertainty(static_cast<double>((*cloud_.scalar)[*i]), sigma, unit));
}

void View3D::mousePressEvent(QMouseEvent* event) {
  press(event->position());
}

void View3D::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() == Qt::NoButton) return hover(event->position());
  drag(event->position(),
       (event->buttons() & (Qt::MiddleButton | Qt::RightButton)) != 0 || (event->modifiers() & Qt::ShiftModifier) != 0);
}

void View3D::mouseReleaseEvent(QMouseEvent* event) {
  release(event->position(), event->button() == Qt::LeftButton);
}

void View3D::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && !measuring_ && pointAt(event->position()).isEmpty()) fit();
}

void View3D::wheelEvent(QWheelEvent* event) {
  const bool touch_pad = event->pointingDevice() != nullptr &&
                         event->pointingDevice()->type() == QInputDevice::DeviceType::TouchPad &&
                         !event->pixelDelta().isNull();
  if (touch_pad && (event->modifiers() & Qt::ControlModifier) == 0) {
    camera_.pan(QPointF(event->pixelDelta()), viewSize());
  } else {
    camera_.zoom(std::pow(1.0015, event->angleDelta().y()), event->position(), viewSize());
  }
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
      fit();
      return;
    case Qt::Key_M:
      setMeasuring(!measuring_);
      return;
    case Qt::Key_C:
      setClipping(!clip_);
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
    case Qt::Key_Escape:
      if (!measuring_) break;
      setMeasuring(false);
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
      break;
  }
  QWidget::keyPressEvent(event);
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
  switch (event->type()) {
    case QEvent::TouchBegin:
    case QEvent::TouchUpdate:
    case QEvent::TouchEnd:
    case QEvent::TouchCancel:
      touch(static_cast<QTouchEvent*>(event));
      return true;
    case QEvent::NativeGesture: {  // of a touch pad
      const auto* gesture = static_cast<QNativeGestureEvent*>(event);
      if (gesture->gestureType() != Qt::ZoomNativeGesture) break;
      camera_.zoom(1.0 + gesture->value(), gesture->position(), viewSize());
      cameraMoved();
      return true;
    }
    default:
      break;
  }
  if (event->type() == QEvent::FocusIn || event->type() == QEvent::FocusOut) update();
  return QWidget::event(event);
}

}  // namespace spindrift::gui
