// SPDX-License-Identifier: Apache-2.0
#include "core/math/scattered_interpolation.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.h"
#include "core/math/singular_values.h"

namespace spindrift {
namespace {

/// A spread below this part of the largest is none: a slope across it would be made of rounding.
constexpr double flat = 1e-3;

/// Barycentric weights (sum 1) of the point nearest to the origin in the affine hull of `corners`.
Eigen::VectorXd affineNearest(const std::vector<Eigen::Vector3d>& corners) {
  const auto n = static_cast<Eigen::Index>(corners.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
  if (n == 1) {
    weights[0] = 1.0;
    return weights;
  }
  Eigen::MatrixXd edges(3, n - 1);
  for (Eigen::Index i = 1; i < n; ++i) edges.col(i - 1) = corners[static_cast<std::size_t>(i)] - corners[0];
  const Eigen::VectorXd t = edges.colPivHouseholderQr().solve(-corners[0]);
  weights[0] = 1.0 - t.sum();
  weights.tail(n - 1) = t;
  return weights;
}

double extentOf(const std::vector<Eigen::Vector3d>& places) {
  Eigen::Vector3d low = places.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& p : places) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

}  // namespace

Eigen::Vector3d nearestInHull(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& place) {
  SPINDRIFT_ASSERT(!points.empty(), "a hull of nothing");
  // Wolfe's algorithm with `place` as the origin: a corral of at most four corners.
  double size = 0.0;
  for (const Eigen::Vector3d& p : points) size = std::max(size, (p - place).squaredNorm());
  if (size == 0.0) return place;
  std::size_t start = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i] - place).squaredNorm() < (points[start] - place).squaredNorm()) start = i;
  }
  std::vector<std::size_t> corral{start};
  std::vector<double> weight{1.0};
  Eigen::Vector3d x = points[start] - place;
  for (int step = 0; step < 200; ++step) {
    std::size_t best = 0;
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double along = x.dot(points[i] - place);
      if (along < lowest) {
        lowest = along;
        best = i;
      }
    }
    if (lowest > x.squaredNorm() - 1e-14 * size || std::find(corral.begin(), corral.end(), best) != corral.end()) break;
    corral.push_back(best);
    weight.push_back(0.0);
    while (true) {
      std::vector<Eigen::Vector3d> corners;
      for (const std::size_t i : corral) corners.push_back(points[i] - place);
      const Eigen::VectorXd wanted = affineNearest(corners);
      double theta = 1.0;
      for (std::size_t i = 0; i < corral.size(); ++i) {
        const double w = wanted[static_cast<Eigen::Index>(i)];
        if (w < 1e-12 && weight[i] > w) theta = std::min(theta, weight[i] / (weight[i] - w));
      }
      for (std::size_t i = 0; i < corral.size(); ++i) {
        weight[i] += theta * (wanted[static_cast<Eigen::Index>(i)] - weight[i]);
      }
      bool dropped = false;
      for (std::size_t i = corral.size(); i-- > 0;) {
        if (weight[i] > 1e-12 || corral.size() == 1) continue;
        corral.erase(corral.begin() + static_cast<std::ptrdiff_t>(i));
        weight.erase(weight.begin() + static_cast<std::ptrdiff_t>(i));
        dropped = true;
      }
      x.setZero();
      const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
      for (std::size_t i = 0; i < corral.size(); ++i) {
        weight[i] /= sum;
        x += weight[i] * (points[corral[i]] - place);
      }
      if (!dropped || theta >= 1.0) break;
    }
    if (x.squaredNorm() <= 1e-24 * size) return place;
  }
  return place + x;
}

ScatteredInterpolation::ScatteredInterpolation(std::vector<Eigen::Vector3d> places) : places_(std::move(places)) {
  SPINDRIFT_ASSERT(!places_.empty(), "an interpolation without places");
  extent_ = extentOf(places_);
  // All directions of the places, and their equations where those are few enough to be solved at once.
  std::vector<std::size_t> which(places_.size());
  std::iota(which.begin(), which.end(), std::size_t{0});
  if (places_.size() <= most_places) all_ = system(std::move(which));
}

ScatteredInterpolation::System ScatteredInterpolation::system(std::vector<std::size_t> which) const {
  System s;
  s.place = std::move(which);
  const auto n = static_cast<Eigen::Index>(s.place.size());
  Eigen::Matrix3Xd centred(3, n);
  for (Eigen::Index i = 0; i < n; ++i) centred.col(i) = places_[s.place[static_cast<std::size_t>(i)]];
  s.centre = centred.rowwise().mean();
  centred.colwise() -= s.centre;
  s.scale = std::max(centred.colwise().norm().maxCoeff(), 1e-300);
  const SingularValues svd = singularValues(centred * centred.transpose() / (s.scale * s.scale));
  Eigen::Index spread = 0;
  while (spread < 3 && std::sqrt(svd.values[spread]) > flat * std::sqrt(static_cast<double>(n))) ++spread;
  s.directions = svd.left.leftCols(spread);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n + 1 + spread, n + 1 + spread);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double r = (centred.col(i) - centred.col(j)).norm() / s.scale;
      m(i, j) = m(j, i) = r * r * r;
    }
    m(i, n) = m(n, i) = 1.0;
    const Eigen::VectorXd along = s.directions.transpose() * centred.col(i) / s.scale;
    m.block(i, n + 1, 1, spread) = along.transpose();
    m.block(n + 1, i, spread, 1) = along;
  }
  s.equations.compute(m);
  return s;
}

std::vector<std::size_t> ScatteredInterpolation::nearest(const Eigen::Vector3d& place, std::size_t count) const {
  std::vector<std::pair<double, std::size_t>> order(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) order[i] = {(places_[i] - place).squaredNorm(), i};
  count = std::min(count, order.size());
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count - 1), order.end());
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(order[i].second);
  std::sort(out.begin(), out.end());
  return out;
}

ScatteredInterpolation::Weights ScatteredInterpolation::at(const Eigen::Vector3d& place) const {
  Weights out;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if ((places_[i] - place).norm() > 1e-9 * extent_) continue;
    out.place = {i};
    out.weight = {1.0};
    return out;
  }
  const Eigen::Vector3d hull = nearestInHull(places_, place);
  out.outside = (place - hull).norm();
  if (out.outside < 1e-6 * extent_) out.outside = 0.0;
  System local;
  const System* s = &all_;
  if (places_.size() > most_places) {
    // As many as it takes to spread in every direction in which all do.
    for (std::size_t count = nearest_places;; count *= 2) {
      local = system(nearest(hull, std::min(count, most_places)));
      if (local.directions.cols() == 3 || count >= most_places) break;
    }
    s = &local;
  }
  const Eigen::Vector3d base = out.outside > 0.0 ? hull : place;
  const auto n = static_cast<Eigen::Index>(s->place.size());
  const Eigen::Index spread = s->directions.cols();
  Eigen::VectorXd right(n + 1 + spread);
  const Eigen::Vector3d at = (base - s->centre) / s->scale;
  const Eigen::Vector3d onwards = (place - base) / s->scale;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d d = at - (places_[s->place[static_cast<std::size_t>(i)]] - s->centre) / s->scale;
    const double r = d.norm();
    right[i] = r * r * r + 3.0 * r * d.dot(onwards);
  }
  right[n] = 1.0;
  right.tail(spread) = s->directions.transpose() * (at + onwards);
  const Eigen::VectorXd w = s->equations.solve(right);
  out.place = s->place;
  out.weight.assign(w.data(), w.data() + n);
  return out;
}

}  // namespace spindrift
