// SPDX-License-Identifier: Apache-2.0
#include "core/math/minimum_zone.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.h"

namespace spindrift {
namespace {

constexpr double tolerance = 1e-12;  ///< of numbers that are scaled to 1
constexpr double artificial_cost = -1e4;

/// A column of the dual: 0 ... n-1 where a deviation touches the upper border, n ... 2n-1 the lower one, then the
/// artificial ones with which the search starts.
class DualColumns {
 public:
  DualColumns(const Eigen::MatrixXd& shape, const Eigen::VectorXd& deviation) : shape_(shape), deviation_(deviation) {}
  [[nodiscard]] Eigen::Index real() const { return 2 * shape_.rows(); }
  [[nodiscard]] Eigen::VectorXd column(Eigen::Index j) const {
    const Eigen::Index k = shape_.cols();
    Eigen::VectorXd out = Eigen::VectorXd::Zero(k + 1);
    if (j >= real()) {
      out[j - real()] = 1.0;
      return out;
    }
    const bool upper = j < shape_.rows();
    out.head(k) = (upper ? 1.0 : -1.0) * shape_.row(upper ? j : j - shape_.rows()).transpose();
    out[k] = 1.0;
    return out;
  }
  [[nodiscard]] double cost(Eigen::Index j) const {
    if (j >= real()) return artificial_cost;
    return j < shape_.rows() ? deviation_[j] : -deviation_[j - shape_.rows()];
  }

 private:
  const Eigen::MatrixXd& shape_;
  const Eigen::VectorXd& deviation_;
};

}  // namespace

MinimumZone minimumZone(const Eigen::MatrixXd& shape, const Eigen::VectorXd& deviation) {
  SPINDRIFT_ASSERT(shape.rows() == deviation.size() && shape.rows() > 0 && shape.allFinite() && deviation.allFinite(),
                   "a row of the shape for each deviation, all finite");
  const Eigen::Index k = shape.cols();
  MinimumZone zone;
  zone.parameters = Eigen::VectorXd::Zero(k);
  const double size = deviation.cwiseAbs().maxCoeff();
  if (size == 0.0) return zone;
  Eigen::MatrixXd scaled = shape;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(k);
  for (Eigen::Index c = 0; c < k; ++c) {
    if (const double largest = shape.col(c).cwiseAbs().maxCoeff(); largest > 0.0) scale[c] = largest;
    scaled.col(c) /= scale[c];
  }
  const Eigen::VectorXd relative = deviation / size;
  const DualColumns columns(scaled, relative);

  std::vector<Eigen::Index> basis;
  Eigen::MatrixXd held = Eigen::MatrixXd::Identity(k + 1, k + 1);
  for (Eigen::Index r = 0; r <= k; ++r) basis.push_back(columns.real() + r);
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(k + 1, k);
  Eigen::VectorXd prices;
  for (int step = 0;; ++step) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(held);
    const Eigen::VectorXd values = lu.solve(right);
    Eigen::VectorXd costs(k + 1);
    for (Eigen::Index r = 0; r <= k; ++r) costs[r] = columns.cost(basis[static_cast<std::size_t>(r)]);
    prices = held.transpose().partialPivLu().solve(costs);
    // The deviation that lies farthest outside comes in; after many steps the first one, which cannot go in circles.
    const bool careful = step > 50 * static_cast<int>(k + 1);
    const Eigen::VectorXd fitted = scaled * prices.head(k);
    Eigen::Index enters = -1;
    double most = 1e-10;
    for (Eigen::Index j = 0; j < columns.real(); ++j) {
      const Eigen::Index i = j % relative.size();
      const double outside = (j < relative.size() ? 1.0 : -1.0) * (relative[i] - fitted[i]) - prices[k];
      if (outside <= most) continue;
      enters = j;
      if (careful) break;
      most = outside;
    }
    if (enters < 0) break;
    const Eigen::VectorXd column = columns.column(enters);
    const Eigen::VectorXd direction = lu.solve(column);
    Eigen::Index leaves = -1;
    double least = 0.0;
    for (Eigen::Index r = 0; r <= k; ++r) {
      if (direction[r] <= tolerance) continue;
      const double ratio = std::max(values[r], 0.0) / direction[r];
      const bool smaller = leaves < 0 || ratio < least - tolerance;
      const bool tie = leaves >= 0 && std::abs(ratio - least) <= tolerance;
      const auto at = [&](Eigen::Index row) { return basis[static_cast<std::size_t>(row)]; };
      if (smaller || (tie && (careful ? at(r) < at(leaves) : direction[r] > direction[leaves]))) {
        leaves = r;
        least = std::min(ratio, leaves < 0 ? ratio : (smaller ? ratio : least));
      }
    }
    if (leaves < 0 || step > 100'000) break;  // rounding only: the weights add up to one
    basis[static_cast<std::size_t>(leaves)] = enters;
    held.col(leaves) = column;
  }
  zone.parameters = (size * prices.head(k)).cwiseQuotient(scale);
  zone.half_width = (deviation - shape * zone.parameters).cwiseAbs().maxCoeff();
  return zone;
}

double smallestCircleDiameter(const Eigen::Matrix2Xd& points) {
  const Eigen::Index n = points.cols();
  if (n < 2) return 0.0;
  const double size = (points.colwise() - points.col(0)).colwise().norm().maxCoeff();
  double best = 4.0 * size;
  const auto take = [&](const Eigen::Vector2d& centre, double radius) {
    if (2.0 * radius < best && (points.colwise() - centre).colwise().norm().maxCoeff() <= radius + 1e-9 * size)
      best = 2.0 * radius;
  };
  if (size == 0.0) return 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i + 1; j < n; ++j) {
      take(0.5 * (points.col(i) + points.col(j)), 0.5 * (points.col(i) - points.col(j)).norm());
      for (Eigen::Index l = j + 1; l < n; ++l) {
        const Eigen::Vector2d a = points.col(j) - points.col(i), b = points.col(l) - points.col(i);
        const double area = 2.0 * (a.x() * b.y() - a.y() * b.x());
        if (std::abs(area) < 1e-12 * size * size) continue;
        const Eigen::Vector2d to((b.y() * a.squaredNorm() - a.y() * b.squaredNorm()) / area,
                                 (a.x() * b.squaredNorm() - b.x() * a.squaredNorm()) / area);
        take(points.col(i) + to, to.norm());
      }
    }
  }
  return best;
}

}  // namespace spindrift
