// SPDX-License-Identifier: Apache-2.0
// The surface touches of one cycle of a hole bar against each other. A hole has one surface touch only, but those of
// all holes and table angles lie on one plane, so one that is 0.1 mm off is told even in the first cycle.
//
//   h = h0 + a . (x, y) + b . (u, v),   x, y: place across the rotary axis in MCF, u, v: the same turned with the table
// a: the axis leans against Z, b: the bar leans against the table; what the places do not determine is left open. The
// plane is found robustly (over small subsets, the one with which most agree within the floor, then with the least
// median of squares; then least squares over those that agree), so
// several bad touches do not hide each other. A touch is suspect beyond max(floor, factor * spread) * sqrt(1 +
// leverage), spread = rms of the touches that agree, with its degrees of freedom; one whose place the others do not
// determine, or with fewer than two degrees of freedom, is not judged. The same holds for changes of height since
// another cycle. Source: Rousseeuw (1984), least median of squares. Units: mm, rad, um.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace spindrift {

struct PlacedHeight {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double c_deg = 0.0;
  double height_um = 0.0;  ///< along the rotary axis, or its change
};

struct SurfaceOptions {
  double floor_um = 30.0;  ///< surfaces differ by a few um, a touch that went wrong by more than this
  double factor = 6.0;     ///< of the spread of the others
};

struct SurfaceVerdict {
  bool judged = false;
  bool suspect = false;
  double off_um = 0.0;  ///< height minus that of the plane through the others
  int others = 0;       ///< that the plane rests on
};

/// One verdict per height. `axis`: direction of the rotary axis, `centre_mm`: a point on it.
[[nodiscard]] std::vector<SurfaceVerdict> judgeSurfaceHeights(const std::vector<PlacedHeight>& heights,
                                                              const Eigen::Vector3d& centre_mm,
                                                              const Eigen::Vector3d& axis,
                                                              const SurfaceOptions& options = {});

}  // namespace spindrift
