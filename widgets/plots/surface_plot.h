// SPDX-License-Identifier: GPL-3.0-or-later
// A quantity over two others as a surface in space: errors of an axis over position and time. Drag turns it,
// double-click turns it back. Signed values in the diverging colours, one standard uncertainty as a bar at each node.
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

#include "widgets/theme/colour_map.h"

namespace spindrift::gui {

struct SurfaceData {
  std::vector<double> x;      ///< columns, ascending
  std::vector<double> y;      ///< rows, ascending
  std::vector<double> value;  ///< row major; NaN: no value
  std::vector<double> sigma;  ///< empty, or one a node
};

class SurfacePlot : public QWidget {
  Q_OBJECT
 public:
  explicit SurfacePlot(QWidget* parent = nullptr);
  void setAxes(const QString& x_title, const QString& y_title, const QString& value_title);
  void setData(SurfaceData data, const ColourScale& scale);
  void setEmptyText(const QString& title, const QString& how);
  [[nodiscard]] bool empty() const;
  [[nodiscard]] const SurfaceData& data() const { return data_; }
  /// By the ending: .png, .csv. Throws InputError.
  void exportTo(const QString& file) const;

  [[nodiscard]] QSize sizeHint() const override { return {480, 320}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {260, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  struct Projection;
  void paint(QPainter& painter, const QSizeF& size) const;
  void paintFrame(QPainter& painter, const Projection& view) const;
  void paintSurface(QPainter& painter, const Projection& view) const;
  void turn(double azimuth_rad, double elevation_rad);

  QString x_title_, y_title_, value_title_;
  QString empty_title_, empty_how_;
  SurfaceData data_;
  ColourScale scale_;
  double azimuth_rad_ = -0.9;
  double elevation_rad_ = 0.45;
  QPointF last_;
};

}  // namespace spindrift::gui
