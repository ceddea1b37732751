// SPDX-License-Identifier: Apache-2.0
// Where heat comes from in the virtual machine, in watts.
//
// Bearings (after Palmgren): the viscous part of the friction moment grows with n^(2/3), so its power with n^(5/3); the
// load part is constant, so its power grows with n. Preload rises when the inner ring is warmer than the housing and
// multiplies the load part. Ball screws: power of the nut ~ v (Coulomb) + v^(5/3) (viscous).
// Source: Harris and Kotzalas, Essential Concepts of Bearing Technology (2006), chapter 10.
#pragma once

namespace spindrift {

struct BearingFriction {
  double viscous_W = 55.0;       ///< at the reference speed
  double load_W = 30.0;          ///< at the reference speed, without thermal preload
  double preload_per_K = 0.015;  ///< growth of the load part per kelvin between ring and housing
  double reference_rpm = 6000.0;
};

/// Power of a bearing at `rpm`; `ring_minus_housing_K` is limited to 0 ... 30 K.
[[nodiscard]] double bearingPower_W(const BearingFriction& friction, double rpm, double ring_minus_housing_K);

/// Losses of the spindle motor that go into the housing.
[[nodiscard]] double motorPower_W(double rpm, double reference_rpm, double power_at_reference_W);

/// Power of a nut at a mean absolute feed.
[[nodiscard]] double nutPower_W(double feed_mm_min, double power_at_10_m_min_W);

/// Convection with motion: still + gain * (speed / reference)^0.7 (turbulent flow along a moving surface).
[[nodiscard]] double convection_W_per_m2_K(double still, double gain, double speed, double reference);

}  // namespace spindrift
