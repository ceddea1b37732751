// SPDX-License-Identifier: Apache-2.0
// A cloud of points as a laser profiler delivers it, and what is done to it before it is used.
//
// Frame: that of the profiler: x along the profile, y = carriage position minus the carriage position at the start of
// the scan, z height; mm. A scan keeps the order of its profiles where it has one: profile k holds the points
// profile_start[k] .. profile_start[k + 1] - 1. A cloud without that order has no profiles and is still usable.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace spindrift {

struct PointCloud {
  std::vector<Eigen::Vector3d> points_mm;
  /// First point of every profile and, at the end, the number of points. Empty: no order is known.
  std::vector<std::size_t> profile_start;
  std::string name;  ///< file or other name, for messages

  [[nodiscard]] std::size_t size() const noexcept { return points_mm.size(); }
  [[nodiscard]] bool empty() const noexcept { return points_mm.empty(); }
  [[nodiscard]] std::size_t profileCount() const noexcept {
    return profile_start.empty() ? 0 : profile_start.size() - 1;
  }
  /// Mean of all points. Throws InternalError for an empty cloud.
  [[nodiscard]] Eigen::Vector3d centroid_mm() const;
};

/// Finds the profiles of a cloud whose points come profile by profile: a new profile starts where x jumps back.
/// Leaves `profile_start` empty if the points are not in that order (fewer than 3 profiles, or y is not constant within
/// them).
void findProfiles(PointCloud& cloud);

/// Typical spacing of a scan, from its order if there is one, else from its area and number of points.
struct CloudSpacing {
  double along_profile_mm = 0.0;     ///< between neighbouring points of a profile
  double between_profiles_mm = 0.0;  ///< between neighbouring profiles
};
[[nodiscard]] CloudSpacing cloudSpacing(const PointCloud& cloud);

/// A mask: 1 keeps a point, 0 drops it.
using CloudMask = std::vector<std::uint8_t>;

/// The points whose mask is set, with their profiles (a profile that loses all its points disappears).
[[nodiscard]] PointCloud masked(const PointCloud& cloud, const CloudMask& keep);

struct CloudFilterOptions {
  /// Samples dropped on either side of every edge of the artefact, along the profile (P3: 20 samples, 250 um). An edge
  /// is the end of a profile, a gap of more than `gap_factor` spacings or a jump in height of more than `step_mm`.
  int edge_samples = 20;
  double gap_factor = 12.0;
  double step_mm = 1.0;
  /// Also this distance from the first and the last profile (mm).
  double edge_distance_mm = 0.25;
  /// A point further from the local plane of its cell than this many robust standard deviations is an outlier.
  double outlier_threshold = 6.0;
  /// Width of the cells in which outliers are looked for (mm); 0: from the spacing, about 60 points.
  double cell_mm = 0.0;

  /// Throws InputError for values that make no sense.
  void validate() const;
};

/// What became of a point.
enum class PointFate : std::uint8_t { Used, Edge, Outlier, Painted };

struct CloudFilterResult {
  CloudMask keep;
  std::vector<PointFate> fate;     ///< one a point: Used, Edge or Outlier
  std::size_t edge_points = 0;     ///< dropped near edges
  std::size_t outlier_points = 0;  ///< dropped as outliers
};

/// P3, section 3.3: trims edges (needs profiles; without them only outliers are removed), then removes outliers. The
/// outlier test is statistical: the residual from a robust local plane against the robust standard deviation of all
/// residuals, on a grid of cells, without a search tree.
[[nodiscard]] CloudFilterResult filterCloud(const PointCloud& cloud, const CloudFilterOptions& options = {});

/// Complaints about a cloud as a whole, thrown as InputError with one sentence: no points, too few points, no extent,
/// or a size that says that its unit is um or m (a laser profiler sees 0.5 ... 500 mm).
void requireUsableCloud(const PointCloud& cloud, std::size_t least_points = 100);

}  // namespace spindrift
