// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/table_angle.h"

#include <QCoreApplication>

#include "widgets/theme/numbers.h"

namespace spindrift::gui {

QString withTableAngle(const QString& what, double c_deg) {
  return QCoreApplication::translate("TableAngle", "%1, table at %2°").arg(what, decimalText(c_deg, 'g', 6));
}

}  // namespace spindrift::gui
