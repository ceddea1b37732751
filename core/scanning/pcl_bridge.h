// SPDX-License-Identifier: Apache-2.0
// Registration with PCL: the paper's NDT followed by ICP (P3 section 3.3) and generalised ICP. The only file that sees
// PCL is pcl_bridge.cpp.
#pragma once

#include "core/scanning/cloud.h"
#include "core/scanning/registration.h"

namespace spindrift {

/// options.method NdtIcp or Gicp. Both clouds are thinned of edges and outliers first (filterCloud). PCL gives no
/// uncertainty: the covariance is point-to-plane least squares with the residuals as white noise, which is a lower
/// bound. The scan model must be rigid (InputError).
[[nodiscard]] RegistrationResult registerWithPcl(const PointCloud& source, const PointCloud& target,
                                                 const RegistrationOptions& options);

}  // namespace spindrift
