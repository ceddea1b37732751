// SPDX-License-Identifier: GPL-3.0-or-later
// An image with what was found in it drawn on top; zooms at the cursor (wheel, + and -), pans (drag, arrow keys), fits
// (double-click, R).
#pragma once

#include <QImage>
#include <QWidget>
#include <vector>

#include "widgets/theme/theme.h"

namespace spindrift::gui {

/// Something found in an image. Pixels: the centre of the top-left pixel is (0, 0).
struct ImageMark {
  QPointF centre_px;
  double radius_x_px = 4;
  double radius_y_px = 4;
  double tilt_rad = 0;  ///< from image x towards image y
  QString label;        ///< shown when there is room
  Tone tone = Tone::Good;
  bool cross = false;  ///< a cross instead of an outline
};

class ImageView : public QWidget {
  Q_OBJECT
 public:
  explicit ImageView(QWidget* parent = nullptr);

  void setImage(const QImage& image);
  void setMarks(std::vector<ImageMark> marks);
  void setMarksVisible(bool visible);
  void setCaption(const QString& text);
  void setEmptyText(const QString& title, const QString& how);
  void fit();
  [[nodiscard]] double zoom() const { return scale_; }
  [[nodiscard]] bool empty() const { return image_.isNull(); }
  /// The image with marks at full resolution.
  [[nodiscard]] QImage annotated() const;

  [[nodiscard]] QSize sizeHint() const override { return {560, 340}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {280, 180}; }

 Q_SIGNALS:
  void hovered(const QString& text);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void paintMarks(QPainter& painter, double scale) const;
  void zoomAt(double factor, const QPointF& at);
  [[nodiscard]] QPointF toImage(const QPointF& widget_px) const { return (widget_px - offset_) / scale_; }

  QImage image_;
  std::vector<ImageMark> marks_;
  bool marks_visible_ = true;
  QString caption_;
  QString empty_title_, empty_how_;
  double scale_ = 1.0;
  QPointF offset_;
  bool fitted_ = true;
  QPointF last_;
};

}  // namespace spindrift::gui
