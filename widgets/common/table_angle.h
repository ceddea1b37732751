// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown of points on a rotary table is shown at one of its angles: how that is said, and how it is chosen.
#pragma once

#include <QComboBox>
#include <QString>
#include <optional>
#include <vector>

namespace spindrift::gui {

/// "M3, table at 90°". For what was measured at several angles; deg.
[[nodiscard]] QString withTableAngle(const QString& what, double c_deg);

/// The angles of the table at which something was measured; hidden where there is one.
class TableAngleChoice : public QComboBox {
 public:
  /// `first`: a choice before the angles, which names none of them; empty: none.
  explicit TableAngleChoice(const QString& first = {});
  /// Keeps the angle that is chosen where it is still there; deg.
  void setAngles(const std::vector<double>& c_deg);
  [[nodiscard]] bool several() const { return count() > least_ + 1; }
  [[nodiscard]] std::optional<double> chosen() const;  ///< nothing: the first choice, or there are no angles
  void choose(double c_deg);

 private:
  int least_;
};

}  // namespace spindrift::gui
