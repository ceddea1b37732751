// SPDX-License-Identifier: Apache-2.0
// PCL's registrations, loaded when the first of them is used: points in, motion out.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/scanning/pcl_bridge.h"

namespace spindrift {

enum class CloudAlignmentOutcome {
  Done,
  TooFewPoints,   ///< after thinning; used_from and used_onto say how many
  CellsTooEmpty,  ///< for the normal distributions transform
  NoMotion,       ///< the normal distributions transform found none
};

struct CloudAlignment {
  CloudAlignmentOutcome outcome = CloudAlignmentOutcome::Done;
  std::size_t used_from = 0, used_onto = 0;
  std::size_t least = 0;  ///< points that are needed of each
  bool converged = false;
  Eigen::Matrix4f onto_from_from = Eigen::Matrix4f::Identity();
  /// Of the points, moved as found: those that lie on the surface that their neighbours in the other cloud make, to
  /// within what these neighbours themselves leave of a plane; and their root mean square distance from it.
  double agreeing_part = 0.0;
  double rms_mm = 0.0;
  double median_mm = 0.0;  ///< distance of all points from that surface
};

/// What the module exports. `ndt`: normal distributions transform, then ICP; else generalised ICP. Lengths mm; points
/// that are not finite are left out.
struct CloudAligner {
  CloudAlignment (*align)(const std::vector<Eigen::Vector3f>& from, const std::vector<Eigen::Vector3f>& onto, bool ndt,
                          const Eigen::Matrix4f& guess, const PclSettings& settings);
};

/// InputError where the installation lacks it.
[[nodiscard]] const CloudAligner& cloudAligner();

}  // namespace spindrift
