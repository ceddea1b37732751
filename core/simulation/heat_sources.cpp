// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/heat_sources.h"

#include <algorithm>
#include <cmath>

namespace spindrift {

double bearingPower_W(const BearingFriction& friction, double rpm, double ring_minus_housing_K) {
  const double part = std::abs(rpm) / friction.reference_rpm;
  const double preload = 1.0 + friction.preload_per_K * std::clamp(ring_minus_housing_K, 0.0, 30.0);
  return friction.viscous_W * std::pow(part, 5.0 / 3.0) + friction.load_W * part * preload;
}

double motorPower_W(double rpm, double reference_rpm, double power_at_reference_W) {
  const double part = std::abs(rpm) / reference_rpm;
  return power_at_reference_W * (0.6 * part + 0.4 * part * part);
}

double nutPower_W(double feed_mm_min, double power_at_10_m_min_W) {
  const double part = std::abs(feed_mm_min) / 10000.0;
  return power_at_10_m_min_W * (0.7 * part + 0.3 * std::pow(part, 5.0 / 3.0));
}

double convection_W_per_m2_K(double still, double gain, double speed, double reference) {
  return still + gain * std::pow(std::abs(speed) / reference, 0.7);
}

}  // namespace spindrift
