// SPDX-License-Identifier: Apache-2.0
// Registration with PCL: the paper's NDT followed by ICP (P3 section 3.3) and generalised ICP.
#pragma once

#include "core/scanning/cloud.h"
#include "core/scanning/registration.h"

namespace spindrift {

/// What PCL leaves to the user; lengths mm. The defaults did best in tests/benchmarks/scanning (smooth surface, spacing
/// 0.01 to 0.15 mm); a leaf of 0 takes every point.
struct PclSettings {
  float ndt_resolution_mm = 1.0F;
  float ndt_leaf_mm = 0.3F;
  double icp_distance_mm = 0.5;  ///< pairs further apart are not used
  float icp_leaf_mm = 0.0F;
  int icp_iterations = 50;
  double gicp_distance_mm = 1.0;
  float gicp_leaf_mm = 0.1F;
  int gicp_neighbours = 20;  ///< for the local covariances
  int gicp_iterations = 40;
};

/// options.method NdtIcp or Gicp. Both clouds are thinned of edges and outliers first (filterCloud). PCL gives no
/// uncertainty: the covariance is point-to-plane least squares with the residuals as white noise, which is a lower
/// bound. The scan model must be rigid (InputError).
[[nodiscard]] RegistrationResult registerWithPcl(const PointCloud& source, const PointCloud& target,
                                                 const RegistrationOptions& options, const PclSettings& settings = {});

}  // namespace spindrift
