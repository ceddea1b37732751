// SPDX-License-Identifier: Apache-2.0
// Which series a simulation misses by most, before and after something was put into it.
#pragma once

#include <string>
#include <vector>

#include "core/reporting/discrepancy_report.h"

namespace spindrift {

/// How far the simulation is off one component at one point: rms over the rows where both are known, um or urad.
struct SeriesGap {
  std::string point;
  Component component = Component::EX;
  double before = 0.0;
  double after = 0.0;
};
/// Of every series; the one that is off by most, in standard deviations of its rows, first.
[[nodiscard]] std::vector<SeriesGap> seriesGaps(const std::vector<DiscrepancyReportRow>& rows);

}  // namespace spindrift
