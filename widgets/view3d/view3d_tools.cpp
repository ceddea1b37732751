// SPDX-License-Identifier: GPL-3.0-or-later
// Clip plane, distances and fingers of the 3D view.
#include <QPainter>
#include <QTouchEvent>
#include <cmath>

#include "widgets/theme/shown_units.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/scene.h"
#include "widgets/view3d/view3d.h"
#include "widgets/view3d/view_tools.h"

namespace spindrift::gui {

void View3D::fit() {
  fitted_ = false;
  cameraMoved();
}

std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> View3D::extent() const {
  auto box = scene_ != nullptr ? scene_->bounds() : std::nullopt;
  for (const ViewPoint& point : points_) {
    if (!box) box = {point.position_mm, point.position_mm};
    box->first = box->first.cwiseMin(point.position_mm);
    box->second = box->second.cwiseMax(point.position_mm);
  }
  return box;
}

void View3D::setClip(const std::optional<ClipPlane>& plane) {
  if (clip_ == plane) return;
  clip_ = plane;
  if (scene_ != nullptr) scene_->setClip(clip_);
  changed();
}

void View3D::setClipping(bool on) {
  const auto box = extent();
  if (!on || !box) return setClip(std::nullopt);
  ClipPlane plane;
  camera_.vertical.cwiseAbs().maxCoeff(&plane.axis);
  plane.offset_mm = 0.5 * (box->first[plane.axis] + box->second[plane.axis]);
  setClip(plane);
}

void View3D::setMeasuring(bool on) {
  measuring_ = on;
  measured_.clear();
  setCursor(on ? Qt::CrossCursor : Qt::ArrowCursor);
  tools_->refresh();
  update();
}

std::optional<MeasuredPlace> View3D::placeAt(const QPointF& pixel) const {
  const QString id = pointAt(pixel);
  for (const ViewPoint& point : points_) {
    if (!id.isEmpty() && point.id == id)
      return MeasuredPlace{point.label.isEmpty() ? id : point.label, point.position_mm, point.deviation};
  }
  if (const auto i = cloudPointAt(pixel)) {
    const Eigen::Map<const Eigen::Vector3f> p(cloud_.xyz_mm->data() + 3 * *i);
    return MeasuredPlace{tr("scan"), p.cast<double>(), std::nullopt};
  }
  if (scene_ == nullptr) return std::nullopt;
  const auto p = scene_->surfaceAt(camera_, pixel, QSizeF(size()));
  if (!p) return std::nullopt;
  return MeasuredPlace{QString(), *p, std::nullopt};
}

void View3D::pickEnd(const QPointF& position) {
  const auto place = placeAt(position);
  if (!place) return;
  if (measured_.size() == 2) measured_.clear();
  measured_.push_back(*place);
  if (measured_.size() == 2) Q_EMIT distanceMeasured(onScreen(distanceText(measured_[0], measured_[1])));
  update();
}

void View3D::paintMeasurement(QPainter& painter, const QSizeF& size) const {
  std::vector<QPointF> ends;
  for (const MeasuredPlace& place : measured_) {
    if (const auto at = camera_.project(place.position_mm, size)) ends.push_back(*at);
  }
  paintDistance(painter, size, ends,
                measured_.size() == 2 ? onScreen(distanceText(measured_[0], measured_[1])) : QString());
}

void View3D::touch(QTouchEvent* event) {
  const auto& points = event->points();
  const QPointF first = points.front().position();
  if (event->type() == QEvent::TouchCancel) {
    fingers_ = 0;
    dragging_ = false;
    return;
  }
  if (points.size() >= 2) {
    const QPointF now[] = {first, points[1].position()};
    const QPointF before[] = {points[0].lastPosition(), points[1].lastPosition()};
    const auto span = [](const QPointF(&p)[2]) { return std::hypot(p[1].x() - p[0].x(), p[1].y() - p[0].y()); };
    if (fingers_ >= 2 && event->type() == QEvent::TouchUpdate) {
      const QPointF centre = 0.5 * (now[0] + now[1]);
      camera_.pan(centre - 0.5 * (before[0] + before[1]), viewSize());
      if (span(before) > 1.0 && span(now) > 1.0) camera_.zoom(span(now) / span(before), centre, viewSize());
      cameraMoved();
    }
    fingers_ = event->type() == QEvent::TouchEnd ? 0 : 2;
    dragging_ = true;  // what follows is no tap
    return;
  }
  if (event->type() == QEvent::TouchBegin) {
    fingers_ = 1;
    press(first);
  } else if (event->type() == QEvent::TouchUpdate && fingers_ == 1) {
    drag(first, false);
  } else if (event->type() == QEvent::TouchEnd) {
    release(first, fingers_ == 1);
    fingers_ = 0;
  }
}

}  // namespace spindrift::gui
