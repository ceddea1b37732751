// SPDX-License-Identifier: GPL-3.0-or-later
// Paints areas of a scan: a transparent sheet over the 3D view that turns strokes of the mouse into strokes of a mask.
// Painting looks straight down, so that what is covered on the screen is what is covered on the scan; wheel, middle and
// right button still move the picture. By keyboard: arrows move a cross (with Shift by single pixels, with Ctrl in
// large steps), Space begins a stroke where it stands and ends it. Escape gives a stroke up.
#pragma once

#include <QPolygonF>
#include <QWidget>

#include "core/scanning/painted_mask.h"

namespace spindrift::gui {

class View3D;

enum class PaintTool { Look, Brush, Rectangle, Lasso };

class CloudPainter : public QWidget {
  Q_OBJECT
 public:
  explicit CloudPainter(View3D* view);
  /// Look: the sheet lets everything through.
  void setTool(PaintTool tool);
  [[nodiscard]] PaintTool tool() const { return tool_; }
  void setErase(bool erase) { erase_ = erase; }
  void setBrushRadius(double mm);
  [[nodiscard]] double brushRadius_mm() const { return radius_mm_; }

 Q_SIGNALS:
  void painted(const spindrift::MaskStroke& stroke);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void lookDown();
  void begin(const QPointF& place);
  void moveTo(const QPointF& place);
  void finish();
  [[nodiscard]] double pixelsPerMm() const;
  [[nodiscard]] MaskStroke stroke() const;

  View3D* view_;
  PaintTool tool_ = PaintTool::Look;
  bool erase_ = true;
  double radius_mm_ = 1.0;
  bool painting_ = false;
  QPolygonF path_;  ///< pixels
  QPointF cursor_;
  bool by_keyboard_ = false;  ///< the cross is shown
};

}  // namespace spindrift::gui
