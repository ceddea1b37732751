// SPDX-License-Identifier: GPL-3.0-or-later
// The shape of an effect on the machine, as three views of the working volume: every view is a plane through its
// middle, displaced as the effect displaces the tool for a gain of one, exaggerated, and coloured by the deviation out
// of the plane. Effects that only turn the tool are drawn as rotation vectors. Measuring points carry arrows.
#pragma once

#include <QWidget>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/machine/effect.h"
#include "core/machine/machine_description.h"
#include "widgets/theme/colour_map.h"

namespace spindrift::gui {

class EffectPicture : public QWidget {
  Q_OBJECT
 public:
  explicit EffectPicture(QWidget* parent = nullptr);
  /// `gain`: which column of its shape; what is out of range shows the first.
  void show(const Effect& effect, const MachineDescription& machine, std::size_t gain = 0);
  /// Nothing; `why` stands in its place.
  void clear(const QString& why);
  [[nodiscard]] bool empty() const { return views_.empty(); }
  /// Of all that is drawn, um or urad for a gain of one.
  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] bool rotations() const { return rotations_; }
  /// PNG; throws InputError.
  void exportTo(const QString& file) const;

  [[nodiscard]] QSize sizeHint() const override { return {600, 260}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {360, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Sample {
    Eigen::Vector3d at_mm = Eigen::Vector3d::Zero();
    Eigen::Vector3d deviation = Eigen::Vector3d::Zero();
  };
  struct View {
    int across = 0, up = 1, out = 2;  ///< axes: 0 X, 1 Y, 2 Z
    int cells = 0;
    std::vector<Sample> nodes;               ///< (cells + 1)^2, row by row
    std::vector<std::vector<Sample>> lines;  ///< of the grid
    std::vector<Sample> points;
  };
  /// Where a shape goes to infinity (refraction at the horizon) there is a gap, so that the rest is seen.
  void leaveOutPoles();
  void make(const Effect& effect, const MachineDescription& machine, std::size_t gain);
  void paint(QPainter& painter, const QSize& size) const;
  struct Layout;
  [[nodiscard]] Layout layoutFor(const QSize& size) const;
  void paintView(QPainter& painter, const View& view, const QRectF& area, const Layout& layout) const;
  void paintLegend(QPainter& painter, const QRectF& area, bool beside) const;
  void paintScale(QPainter& painter, const QRectF& area) const;

  std::vector<View> views_;
  std::array<std::array<double, 2>, 3> range_mm_{};
  std::array<double, 3> stretch_{1.0, 1.0, 1.0};  ///< of an axis that is very short beside the others
  double largest_ = 0.0;
  double largest_out_ = 0.0;
  bool rotations_ = false;
  bool one_point_ = false;  ///< only measuring points move
  ColourScale scale_;
  QString unit_;
  QString why_;
};

}  // namespace spindrift::gui
