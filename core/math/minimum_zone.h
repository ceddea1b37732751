// SPDX-License-Identifier: Apache-2.0
// The narrowest zone of equal width that holds all deviations from a shape: form deviation after ISO 1101.
//
// Model: d = A p + r, A n x k, any rank. Found is p with the least h = max |r_i|; the zone is 2 h wide. The linear
// programme is solved by its dual, which has k + 1 rows: exact within rounding, no iteration limit to be tuned.
// Sources: ISO 1101:2017; ISO 12180 to 12781 (minimum zone elements); G. A. Watson 1980, Approximation theory and
// numerical methods, chapter 2.
#pragma once

#include <Eigen/Core>

namespace spindrift {

struct MinimumZone {
  Eigen::VectorXd parameters;  ///< p; of a shape of lower rank one of many
  double half_width = 0.0;     ///< h, in the unit of the deviations
  [[nodiscard]] double width() const noexcept { return 2.0 * half_width; }
};

/// `shape` has a row for each deviation, at least one. Non-finite numbers are our bug (asserted).
[[nodiscard]] MinimumZone minimumZone(const Eigen::MatrixXd& shape, const Eigen::VectorXd& deviation);

/// Diameter of the smallest circle that holds all points; 0 for fewer than two. Meant for a few dozen points.
[[nodiscard]] double smallestCircleDiameter(const Eigen::Matrix2Xd& points);

}  // namespace spindrift
