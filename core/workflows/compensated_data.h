// SPDX-License-Identifier: Apache-2.0
// Data taken while the control was compensating (log column `compensation_on`, FORMATS.md) show what is left of an
// error, not the error: no fit may use them. Every workflow leaves them out through these two functions, and says so.
#pragma once

#include <string>

#include "core/machine/campaign.h"
#include "core/thermal/time_series.h"

namespace spindrift {

inline constexpr const char* compensation_signal = "compensation_on";

/// True if the log says that the control was compensating at that time; false without such a column.
[[nodiscard]] bool wasCompensating(const OperatingLog& log, double time_s);

/// Marks observations taken while compensating `exclude`, those too that are excluded already; `log` null: none are.
/// One sentence for people, empty if there are none.
std::string leaveOutCompensated(ObservationSet& observations, const OperatingLog* log);

/// Measured outputs (displacements) become missing while compensating; a note of the series says how many values.
void leaveOutCompensated(TimeSeries& series);

}  // namespace spindrift
