// SPDX-License-Identifier: Apache-2.0
// A scan of a campaign as the evaluation takes it: read, what is masked left out, edges trimmed, outliers
// removed (P3 section 3.3). The same for checks, pictures and evaluations.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/machine/campaign.h"
#include "core/scanning/cloud.h"

namespace spindrift {

struct ScanPoints {
  PointCloud cloud;             ///< every point of the file; its name is that in captures/scans.csv
  std::vector<PointFate> fate;  ///< one a point
  [[nodiscard]] std::size_t count(PointFate fate) const noexcept;
  /// The points that are used, with their profiles.
  [[nodiscard]] PointCloud used() const;
};

/// `cloud` as the list names it. The trim is P3's 20 samples, at most 0.25 mm. Throws InputError: a cloud that cannot
/// be read, a mask that cannot be read, or too few points left (with what took them).
[[nodiscard]] ScanPoints readScanPoints(const Campaign& campaign, const std::string& cloud);

}  // namespace spindrift
