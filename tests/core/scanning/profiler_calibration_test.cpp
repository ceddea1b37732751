// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/profiler_calibration.h"

#include <gtest/gtest.h>

#include "core/simulation/virtual_profiler.h"

namespace spindrift {
namespace {

TEST(ProfilerCalibration, AnAngleKnownFromElsewhereIsUsedAndCarriesItsUncertainty) {
  VirtualProfilerMounting mounting;
  mounting.alpha_rad = 0.004;
  mounting.beta_rad = -0.002;
  mounting.gamma_rad = 0.012;
  mounting.offset_mm = {3.0, -1.0, 2.0};
  VirtualOptics optics;
  optics.profile_points = 800;
  optics.profile_interval_mm = 0.05;
  Random random(7);
  const PointCloud scan = virtualPocketScan({}, mounting, optics, random);
  const std::array<double, 4> circle{0.0, 0.0, 0.0, 12.496};
  // A circle cannot show gamma: without it, dx and dy hold only within the mounting's own uncertainty.
  const ProfilerCalibration blind = calibrateProfiler(scan, circle);
  ASSERT_TRUE(blind.usable()) << blind.message;
  EXPECT_EQ(blind.undetermined, std::vector<std::string>{"gamma_rad"});
  CalibrationOptions options;
  options.known_angles_rad[2] = {0.0121, 2e-4};
  const ProfilerCalibration seen = calibrateProfiler(scan, circle, options);
  ASSERT_TRUE(seen.usable()) << seen.message;
  EXPECT_TRUE(seen.undetermined.empty());
  EXPECT_NEAR(seen.gamma_rad, 0.0121, 1e-5);
  EXPECT_NEAR(seen.standardUncertainty(2), 2e-4, 1e-5);
  EXPECT_LT(seen.standardUncertainty(4), 0.05 * blind.standardUncertainty(4));
  EXPECT_LT(std::abs(seen.offset_mm.y() + 1.0), 4.0 * seen.standardUncertainty(4));
  options.known_angles_rad[2] = {0.01, 0.0};
  EXPECT_THROW((void)calibrateProfiler(scan, circle, options), InputError);
}

}  // namespace
}  // namespace spindrift
