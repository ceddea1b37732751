// SPDX-License-Identifier: Apache-2.0
// A scan ready to be drawn: its points with one scalar each, beside the scan it is compared with.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/scanning/scan_evaluation.h"

namespace spindrift {

enum class ScanColouring {
  Height,      ///< z of the scan, mm
  Overlay,     ///< both scans together: reference -1, scan +1
  Measured,    ///< height of the scan over the reference surface as measured, um
  Registered,  ///< the same after registration: what the motion of the profiler does not explain, um
  LeftOut,     ///< what becomes of every point: 0 used, 1 near an edge, 2 outlier, 3 masked
};

/// Before or after trimming, outlier removal and masks.
enum class ScanPart { AsScanned, AsUsed };

struct ScanPicture {
  ScanColouring colouring = ScanColouring::Height;
  std::shared_ptr<const std::vector<float>> xyz_mm;  ///< x y z x y z ..., profiler's frame
  std::shared_ptr<const std::vector<float>> scalar;  ///< one a point
  double low = 0.0;                                  ///< of the scalar, 1st percentile
  double high = 0.0;                                 ///< 99th percentile
  double median_magnitude = 0.0;                     ///< of the scalar: what is typical, whatever outliers there are
  std::array<std::size_t, 4> counts{};               ///< of the scan's points, by PointFate
  std::shared_ptr<const PointCloud> scan;
  std::shared_ptr<const std::vector<PointFate>> fate;  ///< one a point of `scan`
  std::shared_ptr<const PointCloud> reference;         ///< null if the scan is itself the reference
  std::string message;                                 ///< of a registration that failed; then colouring is Height
};

/// `reference` is empty or a cloud of the same artefact. Heights over the reference exist only where it was seen; the
/// other points are left out of the picture. What the registration sees is always as used; `part` decides which points
/// are drawn. Throws InputError for clouds that cannot be read.
[[nodiscard]] ScanPicture pictureOfScan(const Campaign& campaign, const std::string& cloud,
                                        const std::string& reference, ScanColouring colouring, ScanModel model,
                                        const JobContext& job, ScanPart part = ScanPart::AsScanned);

}  // namespace spindrift
