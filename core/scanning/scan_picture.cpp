// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/scan_picture.h"

#include <algorithm>
#include <cmath>

#include "core/scanning/cloud_file.h"

namespace spindrift {
namespace {

void append(std::vector<float>& xyz, const PointCloud& cloud) {
  for (const Eigen::Vector3d& p : cloud.points_mm) {
    for (int k = 0; k < 3; ++k) xyz.push_back(static_cast<float>(p(k)));
  }
}

/// 1st and 99th percentile of a sample of the values: outliers do not stretch the scale.
void findRange(ScanPicture& picture, const std::vector<float>& values) {
  std::vector<float> sample;
  const std::size_t stride = std::max<std::size_t>(1, values.size() / 200'000);
  for (std::size_t i = 0; i < values.size(); i += stride) sample.push_back(values[i]);
  if (sample.empty()) return;
  const auto at = [&](double part) {
    const auto n = static_cast<std::ptrdiff_t>(part * static_cast<double>(sample.size() - 1));
    std::nth_element(sample.begin(), sample.begin() + n, sample.end());
    return static_cast<double>(sample[static_cast<std::size_t>(n)]);
  };
  picture.low = at(0.01);
  picture.high = at(0.99);
  for (float& v : sample) v = std::abs(v);
  picture.median_magnitude = at(0.5);
}

}  // namespace

ScanPicture pictureOfScan(const Campaign& campaign, const std::string& cloud, const std::string& reference,
                          ScanColouring colouring, ScanModel model, const JobContext& job) {
  ScanPicture picture;
  job.report(0.0, "reading the scan");
  auto scan = std::make_shared<PointCloud>(readCloud(campaign.path(cloud)));
  scan->name = cloud;
  picture.scan = scan;
  if (!reference.empty() && reference != cloud) {
    job.report(0.3, "reading the reference");
    auto other = std::make_shared<PointCloud>(readCloud(campaign.path(reference)));
    other->name = reference;
    picture.reference = other;
  }
  job.throwIfCancelled();
  if (picture.reference == nullptr) colouring = ScanColouring::Height;
  picture.colouring = colouring;
  auto xyz = std::make_shared<std::vector<float>>();
  auto scalar = std::make_shared<std::vector<float>>();
  xyz->reserve(3 * scan->size());
  if (colouring == ScanColouring::Overlay) {
    append(*xyz, *picture.reference);
    scalar->assign(picture.reference->size(), -1.0F);
    append(*xyz, *scan);
    scalar->resize(picture.reference->size() + scan->size(), 1.0F);
    picture.low = -1.0;
    picture.high = 1.0;
  } else if (colouring == ScanColouring::Measured || colouring == ScanColouring::Registered) {
    job.report(0.5, "comparing the scans");
    RegistrationOptions options;
    options.scan_model = model;
    const RegistrationTarget target(*picture.reference);
    RegistrationResult motion;
    motion.scan_model = model;
    if (colouring == ScanColouring::Registered) {
      motion = registerToSurface(*scan, target, options);
      if (!motion.usable() && motion.status != FitStatus::Degenerate) {
        picture.message = motion.message;
        picture.colouring = ScanColouring::Height;
      }
    }
    if (picture.colouring != ScanColouring::Height) {
      const std::vector<float> all = deviations_um(*scan, target, motion, options);
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!std::isfinite(all[i])) continue;
        for (int k = 0; k < 3; ++k) xyz->push_back(static_cast<float>(scan->points_mm[i](k)));
        scalar->push_back(all[i]);
      }
      findRange(picture, *scalar);
    }
  }
  if (picture.colouring == ScanColouring::Height) {
    append(*xyz, *scan);
    scalar->reserve(scan->size());
    for (const Eigen::Vector3d& p : scan->points_mm) scalar->push_back(static_cast<float>(p.z()));
    findRange(picture, *scalar);
  }
  picture.xyz_mm = xyz;
  picture.scalar = scalar;
  return picture;
}

}  // namespace spindrift
