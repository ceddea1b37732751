// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/image_view/image_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "widgets/common/parts.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

ImageView::ImageView(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(tr("Image"));
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] { update(); });
}

void ImageView::setImage(const QImage& image) {
  const bool same_size = image.size() == image_.size();
  image_ = image;
  if (!same_size || fitted_) fit();
  update();
}

void ImageView::setMarks(std::vector<ImageMark> marks) {
  marks_ = std::move(marks);
  update();
}

void ImageView::setMarksVisible(bool visible) {
  marks_visible_ = visible;
  update();
}

void ImageView::setCaption(const QString& text) {
  caption_ = onScreen(text);
  update();
}

void ImageView::setEmptyText(const QString& title, const QString& how) {
  empty_title_ = title;
  empty_how_ = how;
  update();
}

void ImageView::fit() {
  fitted_ = true;
  if (image_.isNull() || width() < 2 || height() < 2) return;
  scale_ = std::min(static_cast<double>(width()) / image_.width(), static_cast<double>(height()) / image_.height());
  offset_ = QPointF((width() - scale_ * image_.width()) / 2, (height() - scale_ * image_.height()) / 2);
  update();
}

void ImageView::paintMarks(QPainter& painter, double scale) const {
  painter.setRenderHint(QPainter::Antialiasing);
  // Marks lie on a dark image in both themes: the dark table's colours read best.
  const Theme& t = Theme::dark();
  painter.setFont(textFont(sizes::font_secondary, QFont::Medium));
  for (const ImageMark& mark : marks_) {
    const QPointF centre((mark.centre_px.x() + 0.5) * scale, (mark.centre_px.y() + 0.5) * scale);
    painter.save();
    painter.translate(centre);
    const QColor colour = t.tone(mark.tone);
    painter.setPen(QPen(colour, 1.6));
    painter.setBrush(Qt::NoBrush);
    painter.save();
    painter.rotate(mark.tilt_rad * 180 / std::numbers::pi);
    if (mark.cross) {
      const double arm = std::max(6.0, mark.radius_x_px * scale);
      painter.drawLine(QPointF(-arm, 0), QPointF(arm, 0));
      painter.drawLine(QPointF(0, -arm), QPointF(0, arm));
    } else {
      painter.drawEllipse(QPointF(0, 0), mark.radius_x_px * scale, mark.radius_y_px * scale);
    }
    painter.restore();
    if (!mark.label.isEmpty() && (mark.cross || mark.radius_x_px * scale > 18)) {
      const QFontMetricsF metrics(painter.font());
      const double w = metrics.horizontalAdvance(mark.label);
      QRectF box(-w / 2 - 4, mark.radius_y_px * scale - 3, w + 8, metrics.height());
      QColor back(0, 0, 0, 170);
      painter.setPen(Qt::NoPen);
      painter.setBrush(back);
      painter.drawRoundedRect(box, 3, 3);
      painter.setPen(colour);
      painter.drawText(box, Qt::AlignCenter, mark.label);
    }
    painter.restore();
  }
}

void ImageView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), image_.isNull() ? theme().surface_alt : QColor(0x10, 0x13, 0x15));
  if (image_.isNull()) {
    drawEmptyText(painter, rect(), empty_title_, empty_how_);
    return;
  }
  painter.save();
  painter.translate(offset_);
  painter.setRenderHint(QPainter::SmoothPixmapTransform, scale_ < 3);
  painter.drawImage(QRectF(0, 0, scale_ * image_.width(), scale_ * image_.height()), image_);
  if (marks_visible_) paintMarks(painter, scale_);
  painter.restore();
  if (!caption_.isEmpty()) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(textFont(sizes::font_secondary));
    const QFontMetricsF metrics(painter.font());
    const QRectF box(8, 8, metrics.horizontalAdvance(caption_) + 16, metrics.height() + 8);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(0, 0, 0, 180));
    painter.drawRoundedRect(box, 6, 6);
    painter.setPen(QColor(0xE7, 0xEC, 0xEE));
    painter.drawText(box, Qt::AlignCenter, caption_);
  }
  if (hasFocus()) {
    painter.setPen(QPen(theme().accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(rect()).adjusted(1, 1, -1, -1));
  }
}

QImage ImageView::annotated() const {
  QImage picture = image_.convertToFormat(QImage::Format_RGB32);
  QPainter painter(&picture);
  paintMarks(painter, 1.0);
  return picture;
}

void ImageView::zoomAt(double factor, const QPointF& at) {
  if (image_.isNull()) return;
  const double larger = std::clamp(scale_ * factor, 0.02, 40.0);
  offset_ = at - (at - offset_) * (larger / scale_);
  scale_ = larger;
  fitted_ = false;
  update();
}

void ImageView::resizeEvent(QResizeEvent*) {
  if (fitted_) fit();
}

void ImageView::mousePressEvent(QMouseEvent* event) {
  last_ = event->position();
}

void ImageView::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons() != Qt::NoButton) {
    offset_ += event->position() - last_;
    last_ = event->position();
    fitted_ = false;
    update();
    return;
  }
  const QPointF p = toImage(event->position());
  const int x = static_cast<int>(std::floor(p.x()));
  const int y = static_cast<int>(std::floor(p.y()));
  Q_EMIT hovered(image_.rect().contains(x, y)
                     ? tr("x %1 px, y %2 px: grey level %3").arg(x).arg(y).arg(qGray(image_.pixel(x, y)))
                     : QString());
}

void ImageView::mouseDoubleClickEvent(QMouseEvent*) {
  fit();
}

void ImageView::wheelEvent(QWheelEvent* event) {
  zoomAt(std::pow(1.0015, event->angleDelta().y()), event->position());
  event->accept();
}

void ImageView::keyPressEvent(QKeyEvent* event) {
  const QPointF middle(width() / 2.0, height() / 2.0);
  const auto move = [this](double x, double y) {
    offset_ += QPointF(x, y);
    fitted_ = false;
    update();
  };
  switch (event->key()) {
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      zoomAt(1.25, middle);
      return;
    case Qt::Key_Minus:
      zoomAt(0.8, middle);
      return;
    case Qt::Key_R:
    case Qt::Key_Home:
      fit();
      return;
    case Qt::Key_Left:
      move(40, 0);
      return;
    case Qt::Key_Right:
      move(-40, 0);
      return;
    case Qt::Key_Up:
      move(0, 40);
      return;
    case Qt::Key_Down:
      move(0, -40);
      return;
    default:
      QWidget::keyPressEvent(event);
  }
}

void ImageView::leaveEvent(QEvent* event) {
  Q_EMIT hovered({});
  QWidget::leaveEvent(event);
}

}  // namespace spindrift::gui
