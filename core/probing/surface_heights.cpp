// SPDX-License-Identifier: Apache-2.0
#include "core/probing/surface_heights.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/math/singular_values.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// Directions in which the places differ less than this part of the largest are open.
constexpr double rank_tolerance = 0.02;
constexpr double length_scale_mm = 100.0;
constexpr int most_subsets = 3000;

using Rows = std::vector<Eigen::Index>;

Eigen::MatrixXd designOf(const std::vector<PlacedHeight>& heights, const Eigen::Vector3d& centre_mm,
                         const Eigen::Vector3d& axis) {
  const Eigen::Vector3d e1 = axis.unitOrthogonal();
  const Eigen::Vector3d e2 = axis.cross(e1);
  Eigen::MatrixXd design(static_cast<Eigen::Index>(heights.size()), 5);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Eigen::Vector3d d = (heights[i].position_mm - centre_mm) / length_scale_mm;
    const double x = d.dot(e1);
    const double y = d.dot(e2);
    const double c = std::cos(heights[i].c_deg * rad_per_deg);
    const double s = std::sin(heights[i].c_deg * rad_per_deg);
    design.row(static_cast<Eigen::Index>(i)) << 1.0, x, y, c * x + s * y, c * y - s * x;
  }
  return design;
}

/// Only the combinations of the columns that the rows tell apart.
Eigen::MatrixXd reduced(const Eigen::MatrixXd& design) {
  const SingularValues svd = singularValues(design);
  return design * svd.right.leftCols(svd.rank(rank_tolerance));
}

/// The absolute residuals of the best plane over subsets: that with which most heights agree, then least median of
/// squares. The median alone may be all on one side of the bar, where a drift during the cycle looks like a tilt.
Eigen::VectorXd robustResiduals(const Eigen::MatrixXd& design, const Eigen::VectorXd& y, double floor_um) {
  const Eigen::Index n = design.rows();
  const Eigen::Index p = design.cols();
  Eigen::VectorXd best = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  double least = std::numeric_limits<double>::infinity();
  Eigen::Index fewest = n + 1;  // that disagree
  Random random(1);
  Rows all(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) all[static_cast<std::size_t>(i)] = i;
  const auto attempt = [&](const Rows& rows) {
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(design(rows, Eigen::all));
    if (!lu.isInvertible() || lu.rcond() < 1e-4) return;
    const Eigen::VectorXd residual = (y - design * lu.solve(y(rows))).cwiseAbs();
    const double middle = median(std::vector<double>(residual.begin(), residual.end()));
    const Eigen::Index apart = (residual.array() > floor_um).count();
    if (apart > fewest || (apart == fewest && middle >= least)) return;
    least = middle;
    fewest = apart;
    best = residual;
  };
  double subsets = 1.0;
  for (Eigen::Index k = 0; k < p; ++k) subsets *= static_cast<double>(n - k) / static_cast<double>(k + 1);
  if (subsets > most_subsets) {
    for (int k = 0; k < most_subsets; ++k) {
      for (Eigen::Index j = 0; j < p; ++j) {
        const auto other = static_cast<std::size_t>(random.uniform(static_cast<double>(j), static_cast<double>(n)));
        std::swap(all[static_cast<std::size_t>(j)], all[std::min(other, all.size() - 1)]);
      }
      attempt(Rows(all.begin(), all.begin() + p));
    }
    return best;
  }
  std::vector<bool> chosen(static_cast<std::size_t>(n), false);
  std::fill(chosen.begin(), chosen.begin() + p, true);
  do {
    Rows rows;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i]) rows.push_back(static_cast<Eigen::Index>(i));
    }
    attempt(rows);
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return best;
}

Rows without(const Rows& rows, Eigen::Index i) {
  Rows rest = rows;
  std::erase(rest, i);
  return rest;
}

}  // namespace

std::vector<SurfaceVerdict> judgeSurfaceHeights(const std::vector<PlacedHeight>& heights,
                                                const Eigen::Vector3d& centre_mm, const Eigen::Vector3d& axis,
                                                const SurfaceOptions& options) {
  std::vector<SurfaceVerdict> verdicts(heights.size());
  if (heights.size() < 4) return verdicts;
  const Eigen::MatrixXd design = reduced(designOf(heights, centre_mm, axis));
  const Eigen::Index n = design.rows();
  const Eigen::Index p = design.cols();
  if (n < p + 3) return verdicts;
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) y(i) = heights[static_cast<std::size_t>(i)].height_um;
  const Eigen::VectorXd residual = robustResiduals(design, y, options.floor_um);
  // Small samples make the median of squares too small (Rousseeuw and Leroy 1987).
  const double scale =
      1.4826 * (1.0 + 5.0 / static_cast<double>(n - p)) * median(std::vector<double>(residual.begin(), residual.end()));
  const double apart = std::max(options.floor_um, options.factor * scale);
  Rows agreeing;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (residual(i) <= apart) agreeing.push_back(i);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const Rows others = without(agreeing, i);
    const Eigen::MatrixXd A = design(others, Eigen::all);
    if (static_cast<Eigen::Index>(others.size()) < p + 2) continue;
    const SingularValues svd = singularValues(A);
    if (svd.rank(0.5 * rank_tolerance) < p) continue;
    const Eigen::VectorXd x = svd.right * (svd.left.transpose() * y(others)).cwiseQuotient(svd.values);
    const double spread = (y(others) - A * x).norm() / std::sqrt(static_cast<double>(A.rows() - p));
    const Eigen::VectorXd weights = (svd.right.transpose() * design.row(i).transpose()).cwiseQuotient(svd.values);
    SurfaceVerdict& v = verdicts[static_cast<std::size_t>(i)];
    v.judged = true;
    v.others = static_cast<int>(others.size());
    v.off_um = y(i) - design.row(i).dot(x);
    v.suspect = std::abs(v.off_um) >
                std::max(options.floor_um, options.factor * spread) * std::sqrt(1.0 + weights.squaredNorm());
  }
  return verdicts;
}

}  // namespace spindrift
