// SPDX-License-Identifier: Apache-2.0
// A look at every scan of a campaign before anything is registered: can it be read, how complete is it, how much of it
// are edges and outliers.
#pragma once

#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/scanning/scan_evaluation.h"

namespace spindrift {

struct ScanCheck {
  ScanCapture capture;
  bool usable = false;
  std::string reason;  ///< why it cannot be used, or what is noteworthy; empty if nothing is
  std::size_t points = 0;
  std::size_t profiles = 0;
  double completeness = 0.0;  ///< points over those of the fullest scan of the same artefact, 0 ... 1
  std::size_t edge_points = 0;
  std::size_t outlier_points = 0;
  std::size_t painted_points = 0;  ///< left out by hand
};

/// A scan below this part of the fullest one of its artefact is called incomplete (still usable).
inline constexpr double complete_scan = 0.9;

/// One check per row of captures/scans.csv, in its order; scans the user excluded are left out. A cloud that cannot be
/// read is a result, not an exception. Throws InputError if the list itself cannot be read.
[[nodiscard]] std::vector<ScanCheck> checkScans(const Campaign& campaign, const JobContext& job);

}  // namespace spindrift
