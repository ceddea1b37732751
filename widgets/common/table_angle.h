// SPDX-License-Identifier: GPL-3.0-or-later
// What is shown of points on a rotary table is shown at one of its angles: how that is said.
#pragma once

#include <QString>

namespace spindrift::gui {

/// "M3, table at 90°". For what was measured at several angles; deg.
[[nodiscard]] QString withTableAngle(const QString& what, double c_deg);

}  // namespace spindrift::gui
