// SPDX-License-Identifier: GPL-3.0-or-later
// The angle of the table at which a series is drawn over time: what was measured at another stood elsewhere and belongs
// to no line through these values.
#pragma once

#include <QString>

#include "core/workflows/discrepancy_story.h"

namespace spindrift::gui {

/// Where measured and simulated are furthest apart, deg.
[[nodiscard]] double clearestAngle(const DiscrepancySeries& series);
/// What is named, with the angle behind it where the series was measured at several.
[[nodiscard]] QString withShownAngle(const QString& what, const DiscrepancySeries& series, double c_deg);

}  // namespace spindrift::gui
