// SPDX-License-Identifier: GPL-3.0-or-later
// What was left before and after compensating, on the table: two views with one camera and one colour scale, for one
// thermal state and component. Between the points the values are interpolated with their uncertainty.
#pragma once

#include <QWidget>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/field.h"
#include "core/workflows/verify_compensation.h"

class QComboBox;

namespace spindrift::gui {

class View3D;

/// The values of one state and component, before (0) and after (1), ready to be drawn.
struct VerifyMap {
  Component component = Component::EX;
  std::string state;
  std::array<std::vector<Field::Marker>, 2> points;
  std::array<std::optional<Field>, 2> fields;  ///< empty where the points span no plane
};
/// Any thread. `state` empty: the one with the largest value after compensating.
[[nodiscard]] VerifyMap verifyMap(const VerifyResult& result, const MachineDescription& machine, Component component,
                                  const std::string& state);

class VerifyMaps : public QWidget {
  Q_OBJECT
 public:
  explicit VerifyMaps(QWidget* parent = nullptr);
  /// The states that can be chosen; keeps the chosen one where it is still there.
  void setStates(const QStringList& states);
  [[nodiscard]] std::string state() const;  ///< empty: the worst
  void show(const VerifyMap& map, const MachineDescription& machine, double goal);
  void clear();
  [[nodiscard]] View3D* view(int side) const { return views_[static_cast<std::size_t>(side)]; }
  [[nodiscard]] QComboBox* stateChoice() const { return state_; }

 Q_SIGNALS:
  void stateChosen();

 private:
  QComboBox* state_;
  std::array<View3D*, 2> views_{};
};

}  // namespace spindrift::gui
