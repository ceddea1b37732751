// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/contrast_curve.h"

#include <cmath>

namespace spindrift {

double contrastAt(const Eigen::VectorXd& shape, double gain, double peak_um, double height_mm) {
  const double u = height_mm - peak_um * 1e-3;
  double H = 1.0;
  for (Eigen::Index t = 0; t < shape.size(); ++t) H += shape(t) * std::pow(u, t + 2);
  return 1.0 / (gain * H);
}

double contrastGain(const FocusSet& set, const Eigen::VectorXd& shape, double peak_um) {
  SPINDRIFT_ASSERT(!set.height_mm.empty(), "no point to tell the gain");
  double log_gain = 0.0;
  for (std::size_t i = 0; i < set.height_mm.size(); ++i)
    log_gain += std::log(contrastAt(shape, 1.0, peak_um, set.height_mm[i]) / set.normalised[i]);
  return std::exp(log_gain / static_cast<double>(set.height_mm.size()));
}

}  // namespace spindrift
