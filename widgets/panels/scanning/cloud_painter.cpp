// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/scanning/cloud_painter.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr double least_step_px = 3;
constexpr double key_step_px = 8;
constexpr double large_key_step_px = 40;

}  // namespace

CloudPainter::CloudPainter(View3D* view) : QWidget(view), view_(view) {
  setAttribute(Qt::WA_NoSystemBackground);
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setMouseTracking(true);
  setAccessibleName(tr("Paint on the scan"));
  view_->installEventFilter(this);
  resize(view_->size());
}

void CloudPainter::setTool(PaintTool tool) {
  tool_ = tool;
  painting_ = false;
  path_.clear();
  const bool looks = tool == PaintTool::Look;
  setAttribute(Qt::WA_TransparentForMouseEvents, looks);
  setFocusPolicy(looks ? Qt::NoFocus : Qt::StrongFocus);
  if (looks) {
    unsetCursor();
  } else {
    setCursor(Qt::CrossCursor);
    lookDown();
  }
  update();
}

void CloudPainter::setBrushRadius(double mm) {
  radius_mm_ = mm;
  update();
}

void CloudPainter::lookDown() {
  if (view_->camera().forward().z() < -0.9999 && view_->camera().orthographic) return;
  view_->setOrthographic(true);
  view_->resetCamera(StandardView::Top);
}

double CloudPainter::pixelsPerMm() const {
  return 0.5 * view_->height() / std::max(view_->camera().half_height_mm, 1e-9);
}

MaskStroke CloudPainter::stroke() const {
  MaskStroke s;
  s.erase = erase_;
  s.shape = tool_ == PaintTool::Brush       ? StrokeShape::Brush
            : tool_ == PaintTool::Rectangle ? StrokeShape::Rectangle
                                            : StrokeShape::Lasso;
  if (s.shape == StrokeShape::Brush) s.radius_mm = radius_mm_;
  const QPolygonF places = s.shape == StrokeShape::Rectangle ? QPolygonF({path_.front(), path_.back()}) : path_;
  for (const QPointF& pixel : places) {
    if (const auto p = view_->camera().meetPlane(pixel, QSizeF(view_->size()), Eigen::Vector3d::UnitZ(), 0.0))
      s.points_mm.emplace_back(p->head<2>());
  }
  return s;
}

void CloudPainter::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || view_->empty()) return event->ignore();
  setFocus(Qt::MouseFocusReason);
  by_keyboard_ = false;
  begin(event->position());
}

void CloudPainter::mouseMoveEvent(QMouseEvent* event) {
  by_keyboard_ = false;
  moveTo(event->position());
  if (!painting_) event->ignore();
}

void CloudPainter::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !painting_) return event->ignore();
  moveTo(event->position());
  finish();
}

void CloudPainter::begin(const QPointF& place) {
  lookDown();
  painting_ = true;
  path_ = QPolygonF({place});
  update();
}

void CloudPainter::moveTo(const QPointF& place) {
  cursor_ = place;
  update();
  if (!painting_) return;
  if (tool_ == PaintTool::Rectangle) {
    path_ = QPolygonF({path_.front(), cursor_});
  } else if ((cursor_ - path_.back()).manhattanLength() >= least_step_px) {
    path_ << cursor_;
  }
}

void CloudPainter::finish() {
  painting_ = false;
  const qsizetype least = tool_ == PaintTool::Lasso ? 3 : tool_ == PaintTool::Rectangle ? 2 : 1;
  const MaskStroke done = path_.size() >= least ? stroke() : MaskStroke{};
  path_.clear();
  update();
  if (!done.points_mm.empty()) Q_EMIT painted(done);
}

void CloudPainter::keyPressEvent(QKeyEvent* event) {
  if (tool_ == PaintTool::Look || view_->empty()) return QWidget::keyPressEvent(event);
  const double step = event->modifiers() & Qt::ShiftModifier     ? 1.0
                      : event->modifiers() & Qt::ControlModifier ? large_key_step_px
                                                                 : key_step_px;
  if (!by_keyboard_ && !painting_) cursor_ = QRectF(rect()).center();
  QPointF to = cursor_;
  switch (event->key()) {
    case Qt::Key_Left:
      to.rx() -= step;
      break;
    case Qt::Key_Right:
      to.rx() += step;
      break;
    case Qt::Key_Up:
      to.ry() -= step;
      break;
    case Qt::Key_Down:
      to.ry() += step;
      break;
    case Qt::Key_Space:
      by_keyboard_ = true;
      painting_ ? finish() : begin(cursor_);
      return;
    case Qt::Key_Escape:
      if (!painting_) return QWidget::keyPressEvent(event);
      painting_ = false;
      path_.clear();
      update();
      return;
    default:
      return QWidget::keyPressEvent(event);
  }
  by_keyboard_ = true;
  moveTo({std::clamp(to.x(), 0.0, width() - 1.0), std::clamp(to.y(), 0.0, height() - 1.0)});
}

void CloudPainter::focusOutEvent(QFocusEvent* event) {
  by_keyboard_ = false;
  update();
  QWidget::focusOutEvent(event);
}

bool CloudPainter::eventFilter(QObject* watched, QEvent* event) {
  if (watched == view_ && event->type() == QEvent::Resize) resize(view_->size());
  return QWidget::eventFilter(watched, event);
}

void CloudPainter::paintEvent(QPaintEvent*) {
  if (tool_ == PaintTool::Look) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor line = theme().tone(erase_ ? Tone::Bad : Tone::Good);
  QColor fill = line;
  fill.setAlphaF(0.25F);
  painter.setPen(QPen(line, 1.5));
  painter.setBrush(fill);
  const double radius = radius_mm_ * pixelsPerMm();
  if (painting_ && tool_ == PaintTool::Rectangle) {
    painter.drawRect(QRectF(path_.front(), path_.back()).normalized());
  } else if (painting_ && tool_ == PaintTool::Lasso) {
    painter.drawPolygon(path_);
  } else if (painting_ && path_.size() > 1) {
    painter.setPen(QPen(fill, 2 * radius, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(path_);
  }
  if (by_keyboard_) {
    constexpr double arm = 10;
    painter.setPen(QPen(line, 1.5));
    painter.drawLine(cursor_ - QPointF(arm, 0), cursor_ + QPointF(arm, 0));
    painter.drawLine(cursor_ - QPointF(0, arm), cursor_ + QPointF(0, arm));
  }
  if (tool_ == PaintTool::Brush && (painting_ || underMouse() || by_keyboard_)) {
    painter.setPen(QPen(line, 1.5));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(cursor_, radius, radius);
  }
}

}  // namespace spindrift::gui
