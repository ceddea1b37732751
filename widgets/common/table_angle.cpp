// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/table_angle.h"

#include <QCoreApplication>

#include "widgets/theme/numbers.h"

namespace spindrift::gui {

QString withTableAngle(const QString& what, double c_deg) {
  return QCoreApplication::translate("TableAngle", "%1, table at %2°").arg(what, decimalText(c_deg, 'g', 6));
}

TableAngleChoice::TableAngleChoice(const QString& first) : least_(first.isEmpty() ? 0 : 1) {
  setAccessibleName(QCoreApplication::translate("TableAngle", "Angle of the table at which the values were measured"));
  if (!first.isEmpty()) addItem(first);
  hide();
}

void TableAngleChoice::setAngles(const std::vector<double>& c_deg) {
  const std::optional<double> before = chosen();
  while (count() > least_) removeItem(count() - 1);
  for (const double angle : c_deg) {
    addItem(QCoreApplication::translate("TableAngle", "Table at %1°").arg(decimalText(angle, 'g', 6)), angle);
  }
  if (count() > 0) setCurrentIndex(0);
  if (before) choose(*before);
  setVisible(several());
}

std::optional<double> TableAngleChoice::chosen() const {
  const QVariant angle = currentData();
  return angle.isValid() ? std::optional(angle.toDouble()) : std::nullopt;
}

void TableAngleChoice::choose(double c_deg) {
  if (const int index = findData(c_deg); index >= 0) setCurrentIndex(index);
}

}  // namespace spindrift::gui
