// SPDX-License-Identifier: Apache-2.0
// Does a straight look from above explain where the ellipses lie? If not: from the side, bent, or a lens that distorts.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/decoder_parts.h"
#include "core/math/distributions.h"
#include "core/math/singular_values.h"

namespace spindrift::decoding {
namespace {

/// Median distance of the ellipses from where `place` has them, px.
template <typename Place>
double medianDistance(const std::vector<Subpattern>& ellipses, const Place& place) {
  std::vector<double> off;
  for (const Subpattern& s : ellipses) off.push_back((Eigen::Vector2d(s.x_px, s.y_px) - place(s)).norm());
  if (off.empty()) return 0.0;
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
  return off[off.size() / 2];
}

/// Projection (homography) from the pattern (um) to the image through the ellipses, by the direct linear transform on
/// normalised coordinates (Hartley 1997); nothing with fewer than six.
std::optional<Eigen::Matrix3d> projectionOf(const std::vector<Subpattern>& ellipses, const FiducialPattern& pattern) {
  if (ellipses.size() < 6) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(ellipses.size());
  Eigen::Matrix2Xd from(2, n);
  Eigen::Matrix2Xd onto(2, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Subpattern& s = ellipses[static_cast<std::size_t>(k)];
    from.col(k) = pattern.ellipseCentre(s.row, s.column);
    onto.col(k) = Eigen::Vector2d(s.x_px, s.y_px);
  }
  const auto normaliser = [n](Eigen::Matrix2Xd& points) {
    const Eigen::Vector2d centre = points.rowwise().mean();
    points.colwise() -= centre;
    const double size = std::max(1e-9, points.norm() / std::sqrt(static_cast<double>(n)));
    points /= size;
    Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
    back(0, 0) = back(1, 1) = size;
    back.topRightCorner<2, 1>() = centre;
    return back;
  };
  const Eigen::Matrix3d from_back = normaliser(from);
  const Eigen::Matrix3d onto_back = normaliser(onto);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 9);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::RowVector3d p = from.col(k).homogeneous().transpose();
    A.block<1, 3>(2 * k, 0) = p;
    A.block<1, 3>(2 * k, 6) = -onto(0, k) * p;
    A.block<1, 3>(2 * k + 1, 3) = p;
    A.block<1, 3>(2 * k + 1, 6) = -onto(1, k) * p;
  }
  const Eigen::VectorXd h = singularValues(A, RightVectors::Full).right.col(8);
  Eigen::Matrix3d projection;
  projection << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), h(8);
  return Eigen::Matrix3d(onto_back * projection * from_back.inverse());
}

/// What the median distance of ellipses that lie where they should stays below, by their uncertainties alone, px. The
/// distance over the uncertainty of a coordinate is Rayleigh distributed, and the median of n is the middle order
/// statistic: with u = 1 - exp(-d^2 / 2) the odds u / (1 - u) of it follow F with 2 k and 2 (n - k + 1) degrees of
/// freedom. One image in `images` exceeds it.
double largestMedianByChance(const std::vector<Subpattern>& ellipses) {
  constexpr double images = 1e4;
  std::vector<double> sigma;
  for (const Subpattern& s : ellipses) sigma.push_back(s.sigma_px);
  const auto n = static_cast<double>(sigma.size());
  const auto middle = static_cast<std::ptrdiff_t>(sigma.size() / 2);
  std::nth_element(sigma.begin(), sigma.begin() + middle, sigma.end());
  const double k = static_cast<double>(middle) + 1.0;
  double low = 0.0;
  double high = 10.0;
  for (int i = 0; i < 40; ++i) {
    const double d = 0.5 * (low + high);
    const double odds = std::expm1(0.5 * d * d);
    (fisherTail(odds * (n - k + 1.0) / k, 2.0 * k, 2.0 * (n - k + 1.0)) > 1.0 / images ? low : high) = d;
  }
  return high * sigma[static_cast<std::size_t>(middle)];
}

}  // namespace

std::string whyThePoseDoesNotHold(const std::vector<Subpattern>& ellipses, const FiducialPattern& pattern,
                                  const PatternMap& map) {
  if (ellipses.empty()) return {};
  constexpr double of_lens_px = 0.3;  // lenses with more than k1 and damaged marks stay below 0.1
  const double tolerated_px = std::hypot(of_lens_px, largestMedianByChance(ellipses));
  const double off_px = medianDistance(
      ellipses, [&](const Subpattern& s) { return map.imageOf(pattern.ellipseCentre(s.row, s.column)); });
  if (off_px <= tolerated_px) return {};
  const auto projected = projectionOf(ellipses, pattern);
  if (projected &&
      medianDistance(ellipses, [&](const Subpattern& s) {
        return Eigen::Vector2d((*projected * pattern.ellipseCentre(s.row, s.column).homogeneous()).hnormalized());
      }) < off_px / 3.0) {
    return fmt::format(
        "the pattern is seen from the side: half of its ellipses lie more than {:.1f} px beside where a look straight "
        "from above has them; lengths would be wrong",
        off_px);
  }
  return fmt::format(
      "half of the ellipses lie more than {:.1f} px beside where the pattern has them: it is bent or seen from the "
      "side, or the lens distorts more than a microscope's",
      off_px);
}

}  // namespace spindrift::decoding
