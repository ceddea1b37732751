// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/interval_calibration.h"

#include <algorithm>
#include <cmath>

#include "core/math/distributions.h"

namespace spindrift {

double calibratedFactor(const std::vector<JudgedRun>& runs, double noise, double independent) {
  if (runs.empty()) return 1.0;
  double low = std::log(1e-3);
  double high = std::log(1e2);
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    double sum = std::exp(-middle);
    for (const JudgedRun& run : runs) sum += (run.squared_error / (std::exp(middle) * run.variance + noise)).mean();
    (sum > static_cast<double>(runs.size()) + 1.0 ? low : high) = middle;
  }
  const double widening = studentQuantile(0.975, std::max(2.0, independent)) / normalQuantile(0.975);
  return std::exp(high) * widening * widening;
}

double neighbourCorrelation(const Eigen::VectorXd& values) {
  const double zero = values.squaredNorm();
  if (!(zero > 0.0) || values.size() < 3) return 0.0;
  return std::clamp(values.head(values.size() - 1).dot(values.tail(values.size() - 1)) / zero, 0.0, 0.98);
}

}  // namespace spindrift
