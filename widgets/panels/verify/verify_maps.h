// SPDX-License-Identifier: GPL-3.0-or-later
// What was left before and after compensating, on the table: two views with one camera and one colour scale, for one
// thermal state, angle of the table and component. Between the points the values are interpolated with their
// uncertainty.
#pragma once

#include <QWidget>
#include <array>
#include <optional>
#include <vector>

#include "core/workflows/verify_map.h"

class QComboBox;

namespace spindrift::gui {

class View3D;

class VerifyMaps : public QWidget {
  Q_OBJECT
 public:
  explicit VerifyMaps(QWidget* parent = nullptr);
  /// The states that can be chosen, each with the angles of the table where there are several; keeps the chosen one
  /// where it is still there.
  void setPoses(std::vector<VerifyPose> poses);
  [[nodiscard]] std::optional<VerifyPose> pose() const;  ///< nothing: the worst
  void show(const VerifyMap& map, const MachineDescription& machine, double goal);
  void clear();
  [[nodiscard]] View3D* view(int side) const { return views_[static_cast<std::size_t>(side)]; }
  [[nodiscard]] QComboBox* stateChoice() const { return state_; }

 Q_SIGNALS:
  void stateChosen();

 private:
  /// What is called the same is the same pose.
  [[nodiscard]] QString nameOf(const VerifyPose& pose) const;

  std::vector<VerifyPose> poses_;
  QComboBox* state_;
  std::array<View3D*, 2> views_{};
};

}  // namespace spindrift::gui
