// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/scan_picture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/scanning/scan_points.h"

namespace spindrift {
namespace {

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
                          ScanColouring colouring, ScanModel model, const JobContext& job, ScanPart part) {
  ScanPicture picture;
  job.report(0.0, "reading the scan");
  ScanPoints scan = readScanPoints(campaign, cloud);
  for (const PointFate f : scan.fate) ++picture.counts[static_cast<std::size_t>(f)];
  std::optional<ScanPoints> other;
  if (!reference.empty() && reference != cloud) {
    job.report(0.3, "reading the reference");
    other = readScanPoints(campaign, reference);
  }
  job.throwIfCancelled();
  if (!other && colouring != ScanColouring::LeftOut) colouring = ScanColouring::Height;
  picture.colouring = colouring;
  auto xyz = std::make_shared<std::vector<float>>();
  auto scalar = std::make_shared<std::vector<float>>();
  xyz->reserve(3 * scan.cloud.size());
  scalar->reserve(scan.cloud.size());
  const auto drawn = [part](const ScanPoints& from, std::size_t i) {
    return part == ScanPart::AsScanned || from.fate[i] == PointFate::Used;
  };
  const auto add = [&](const Eigen::Vector3d& p, float value) {
    for (int k = 0; k < 3; ++k) xyz->push_back(static_cast<float>(p(k)));
    scalar->push_back(value);
  };
  if (colouring == ScanColouring::Overlay) {
    for (const auto& [from, value] : {std::pair<const ScanPoints*, float>{&*other, -1.0F}, {&scan, 1.0F}})
      for (std::size_t i = 0; i < from->cloud.size(); ++i)
        if (drawn(*from, i)) add(from->cloud.points_mm[i], value);
    picture.low = -1.0;
    picture.high = 1.0;
  } else if (colouring == ScanColouring::Measured || colouring == ScanColouring::Registered) {
    job.report(0.5, "comparing the scans");
    RegistrationOptions options;
    options.scan_model = model;
    const RegistrationTarget target(other->used());
    RegistrationResult motion;
    motion.scan_model = model;
    if (colouring == ScanColouring::Registered) {
      motion = registerToSurface(scan.used(), target, options);
      if (!motion.usable() && motion.status != FitStatus::Degenerate) {
        picture.message = motion.message;
        picture.colouring = ScanColouring::Height;
      }
    }
    if (picture.colouring != ScanColouring::Height) {
      const std::vector<float> all = deviations_um(scan.cloud, target, motion, options);
      for (std::size_t i = 0; i < all.size(); ++i)
        if (std::isfinite(all[i]) && drawn(scan, i)) add(scan.cloud.points_mm[i], all[i]);
      findRange(picture, *scalar);
    }
  } else if (colouring == ScanColouring::LeftOut) {
    for (std::size_t i = 0; i < scan.cloud.size(); ++i)
      if (drawn(scan, i)) add(scan.cloud.points_mm[i], static_cast<float>(scan.fate[i]));
    picture.low = 0.0;
    picture.high = 3.0;
  }
  if (picture.colouring == ScanColouring::Height) {
    for (std::size_t i = 0; i < scan.cloud.size(); ++i)
      if (drawn(scan, i)) add(scan.cloud.points_mm[i], static_cast<float>(scan.cloud.points_mm[i].z()));
    findRange(picture, *scalar);
  }
  picture.xyz_mm = xyz;
  picture.scalar = scalar;
  picture.fate = std::make_shared<const std::vector<PointFate>>(std::move(scan.fate));
  picture.scan = std::make_shared<const PointCloud>(std::move(scan.cloud));
  if (other) picture.reference = std::make_shared<const PointCloud>(std::move(other->cloud));
  return picture;
}

}  // namespace spindrift
