// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/scan_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/painted_mask.h"

namespace spindrift {
namespace {

constexpr double widest_trim_mm = 0.25;
constexpr std::size_t least_points = 100;

}  // namespace

std::size_t ScanPoints::count(PointFate wanted) const noexcept {
  return static_cast<std::size_t>(std::count(fate.begin(), fate.end(), wanted));
}

PointCloud ScanPoints::used() const {
  CloudMask keep(fate.size());
  std::transform(fate.begin(), fate.end(), keep.begin(),
                 [](PointFate f) { return static_cast<std::uint8_t>(f == PointFate::Used ? 1 : 0); });
  PointCloud out = masked(cloud, keep);
  out.name = cloud.name;
  return out;
}

ScanPoints readScanPoints(const Campaign& campaign, const std::string& cloud) {
  ScanPoints scan;
  scan.cloud = readCloud(campaign.path(cloud));
  scan.cloud.name = cloud;
  requireUsableCloud(scan.cloud);
  scan.fate.assign(scan.cloud.size(), PointFate::Used);
  const auto masks = masksOf(campaign.excluded_captures);
  const auto mask = masks.find(cloud);
  const CloudMask kept = mask == masks.end() ? CloudMask(scan.cloud.size(), 1) : paintedMask(scan.cloud, mask->second);
  const PointCloud left = mask == masks.end() ? scan.cloud : masked(scan.cloud, kept);
  CloudFilterOptions options;
  CloudFilterResult filtered;
  if (left.size() >= least_points) {
    const double spacing = cloudSpacing(left).along_profile_mm;
    if (spacing > 0.0)
      options.edge_samples =
          std::clamp(static_cast<int>(std::lround(widest_trim_mm / spacing)), 2, options.edge_samples);
    filtered = filterCloud(left, options);
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < scan.fate.size(); ++i) {
    if (kept[i] == 0)
      scan.fate[i] = PointFate::Painted;
    else if (!filtered.fate.empty())
      scan.fate[i] = filtered.fate[next++];
  }
  const std::size_t used = scan.count(PointFate::Used);
  if (used < least_points)
    throw InputError(fmt::format(
        "{}: only {} of {} points are left ({} masked, {} near edges, {} outliers); at least {} are needed.", cloud,
        used, scan.cloud.size(), scan.count(PointFate::Painted), scan.count(PointFate::Edge),
        scan.count(PointFate::Outlier), least_points));
  return scan;
}

}  // namespace spindrift
