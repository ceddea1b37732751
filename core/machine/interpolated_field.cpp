// SPDX-License-Identifier: Apache-2.0
#include "core/machine/interpolated_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/math/singular_values.h"

namespace spindrift {
namespace {

using Eigen::Index;

}  // namespace

InterpolatedField::InterpolatedField(Component component, std::vector<ScatteredValue> values)
    : component_(component), values_(std::move(values)) {
  SPINDRIFT_ASSERT(!values_.empty(), "a field through no values");
  const auto [low_value, high_value] =
      std::minmax_element(values_.begin(), values_.end(),
                          [](const ScatteredValue& a, const ScatteredValue& b) { return a.value < b.value; });
  lowest_ = low_value->value;
  highest_ = high_value->value;
  const auto n = static_cast<Index>(values_.size());
  Eigen::VectorXd v(n);
  Eigen::VectorXd noise(n);
  Eigen::Vector3d low = values_.front().position_mm;
  Eigen::Vector3d high = low;
  double mean_square = 0.0;
  for (Index i = 0; i < n; ++i) {
    const ScatteredValue& value = values_[static_cast<std::size_t>(i)];
    SPINDRIFT_ASSERT(value.sigma > 0.0 && std::isfinite(value.value), "a value without an uncertainty");
    v[i] = value.value;
    noise[i] = value.sigma * value.sigma;
    low = low.cwiseMin(value.position_mm);
    high = high.cwiseMax(value.position_mm);
    mean_square += value.value * value.value / static_cast<double>(n);
  }
  const double extent_mm = std::max(1.0, (high - low).norm());
  const double largest = std::sqrt(mean_square) + std::sqrt(noise.maxCoeff());
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
  double best = -std::numeric_limits<double>::infinity();
  for (const double length : {0.2, 0.3, 0.45, 0.7, 1.0, 1.6, 3.0}) {
    Eigen::MatrixXd correlation(n, n);
    for (Index i = 0; i < n; ++i) {
      correlation.col(i) = correlations(values_[static_cast<std::size_t>(i)].position_mm, length * extent_mm);
    }
    for (const double part : {0.0, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 1.5, 2.5, 4.0, 8.0}) {
      if (part == 0.0 && length > 0.2) continue;  // the same for every length
      Process p;
      p.length_mm = length * extent_mm;
      p.variance = part * part * largest * largest;
      Eigen::MatrixXd covariance = p.variance * correlation;
      covariance.diagonal() += noise;
      covariance.diagonal().array() += 1e-10 * largest * largest;
      p.covariance.compute(covariance);
      if (p.covariance.info() != Eigen::Success) continue;
      p.ones = p.covariance.solve(ones);
      const double information = ones.dot(p.ones);
      p.mean = p.ones.dot(v) / information;
      p.mean_variance = 1.0 / information;
      p.residual = p.covariance.solve(Eigen::VectorXd(v.array() - p.mean));
      const double log_determinant = 2.0 * p.covariance.matrixLLT().diagonal().array().log().sum();
      p.log_likelihood =
          -0.5 * (log_determinant + std::log(information) + p.residual.dot(Eigen::VectorXd(v.array() - p.mean)));
      best = std::max(best, p.log_likelihood);
      processes_.push_back(std::move(p));
    }
  }
  SPINDRIFT_ASSERT(!processes_.empty(), "a covariance that is not positive");
  std::erase_if(processes_, [&](const Process& p) { return p.log_likelihood < best - 3.0; });
  double sum = 0.0;
  for (Process& p : processes_) sum += p.weight = std::exp(p.log_likelihood - best);
  for (Process& p : processes_) p.weight /= sum;
}

Eigen::VectorXd InterpolatedField::correlations(const Eigen::Vector3d& place, double length_mm) const {
  Eigen::VectorXd out(static_cast<Index>(values_.size()));
  for (Index i = 0; i < out.size(); ++i) {
    const double distance = (values_[static_cast<std::size_t>(i)].position_mm - place).norm() / length_mm;
    out[i] = std::exp(-0.5 * distance * distance);
  }
  return out;
}

std::string InterpolatedField::description() const {
  return fmt::format("{} between {} points", toString(component_), values_.size());
}

PredictedComponent InterpolatedField::predict(const DeviationQuery& query, Component component) const {
  if (component != component_) return {0.0, std::numeric_limits<double>::infinity()};
  double mean = 0.0;
  double square = 0.0;
  for (const Process& p : processes_) {
    const Eigen::VectorXd c = p.variance * correlations(query.position_mm, p.length_mm);
    const double of_mean = 1.0 - c.dot(p.ones);
    const double value = p.mean + c.dot(p.residual);
    const double variance = p.variance - c.dot(p.covariance.solve(c)) + of_mean * of_mean * p.mean_variance;
    mean += p.weight * value;
    square += p.weight * (std::max(0.0, variance) + value * value);
  }
  const double within = std::clamp(mean, lowest_, highest_);
  return {within, std::hypot(std::sqrt(std::max(0.0, square - mean * mean)), mean - within)};
}

bool spreadsOverPlane(const std::vector<ScatteredValue>& values) {
  if (values.size() < 3) return false;
  Eigen::MatrixX2d places(static_cast<Index>(values.size()), 2);
  for (std::size_t i = 0; i < values.size(); ++i) {
    places.row(static_cast<Index>(i)) = values[i].position_mm.head<2>().transpose();
  }
  places.rowwise() -= places.colwise().mean().eval();
  const Eigen::Vector2d extent = singularValues(places).values;
  return extent[1] > 0.02 * extent[0];
}

Field fieldBetween(Component component, const std::vector<ScatteredValue>& values, const FieldGrid& grid,
                   std::size_t most_points) {
  SPINDRIFT_ASSERT(spreadsOverPlane(values), "places that do not spread over a plane");
  const std::size_t every = std::max<std::size_t>(1, (values.size() + most_points - 1) / most_points);
  std::vector<ScatteredValue> thinned;
  std::vector<Eigen::Vector2d> around;
  for (std::size_t i = 0; i < values.size(); ++i) {
    around.emplace_back(values[i].position_mm.head<2>());
    if (i % every == 0) thinned.push_back(values[i]);
  }
  return evaluateField(InterpolatedField(component, std::move(thinned)), grid, component, {}, around);
}

}  // namespace spindrift
