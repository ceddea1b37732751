// SPDX-License-Identifier: GPL-3.0-or-later
// One profile of a scan as a plot: cold, present, and what was left out.
#pragma once

#include <vector>

#include "core/scanning/scan_picture.h"
#include "widgets/plots/plot.h"

namespace spindrift::gui {

/// Carriage position of a profile (mm).
[[nodiscard]] double carriageOf(const PointCloud& cloud, std::size_t profile);

/// Profile `index` of the picture's scan with the nearest one of its reference; empty if there is no such profile.
[[nodiscard]] std::vector<Series> profileSeries(const ScanPicture& picture, int index);

}  // namespace spindrift::gui
