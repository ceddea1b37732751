// SPDX-License-Identifier: Apache-2.0
#include "core/probing/star_stylus.h"

#include <cmath>

namespace spindrift {

HeadRotation closedFormRotation(const StylusCentres& before_mm, const StylusCentres& after_mm) {
  HeadRotation result;
  const auto& o = before_mm;
  const auto& n = after_mm;
  const double largest = std::max({o[0].squaredNorm(), o[1].squaredNorm(), o[2].squaredNorm(), 1e-30});
  const double denominator_a = o[2].x() * o[0].z() - o[0].x() * o[2].z();
  const double denominator_b = o[1].y() * o[0].z() - o[0].y() * o[1].z();
  const double denominator_c = o[2].y() * o[1].z() - o[1].y() * o[2].z();
  const auto open = [&](const char* angle, const char* why) {
    result.status = FitStatus::Degenerate;
    result.message = std::string("the styli leave the rotation about ") + angle + " open: " + why;
    return result;
  };
  const double tiny = 1e-9 * largest;
  if (std::abs(denominator_a) < tiny) return open("X", "styli 0 and 2 lie in one direction seen along Y");
  if (std::abs(denominator_b) < tiny) return open("Y", "styli 0 and 1 lie in one direction seen along X");
  if (std::abs(o[1].y()) * std::sqrt(largest) < tiny || std::abs(denominator_c) < tiny) {
    return open("Z", "styli 1 and 2 lie in one direction seen along X, or stylus 1 has no offset along Y");
  }
  // (7): movements along Y of styli 0 and 2.
  result.rotation_rad.x() = -((o[2].y() - n[2].y()) * o[0].x() - (o[0].y() - n[0].y()) * o[2].x()) / denominator_a;
  // (8): movements along X of styli 0 and 1.
  result.rotation_rad.y() = -((o[0].x() - n[0].x()) * o[1].y() - (o[1].x() - n[1].x()) * o[0].y()) / denominator_b;
  // (9): movements along X of styli 1 and 2.
  const double m1 = o[1].x() - n[1].x();
  const double m2 = o[2].x() - n[2].x();
  result.rotation_rad.z() = m1 / o[1].y() - (m1 * o[2].y() - m2 * o[1].y()) * o[1].z() / (o[1].y() * denominator_c);
  result.status = FitStatus::Converged;
  result.message = "converged";
  return result;
}

double spindleDrift(const Eigen::Vector3d& before_mm, const Eigen::Vector3d& after_mm) {
  return (after_mm - before_mm).norm();
}

}  // namespace spindrift
