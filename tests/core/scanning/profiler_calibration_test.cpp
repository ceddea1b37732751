// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/profiler_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

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

/// The rotation of Rx(alpha) Ry(beta) Rz(gamma) taken apart again.
void setAngles(VirtualProfilerMounting& mounting, const Eigen::Matrix3d& r) {
  mounting.alpha_rad = std::atan2(-r(1, 2), r(2, 2));
  mounting.beta_rad = std::asin(r(0, 2));
  mounting.gamma_rad = std::atan2(-r(0, 1), r(0, 0));
}

double largestDifference_mm(const PointCloud& a, const PointCloud& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a.points_mm[i] - b.points_mm[i]).lpNorm<Eigen::Infinity>());
  return largest;
}

// Under `rigid` everything that is scanned may be turned about the axis of the pocket, profiler, artefact and error of
// the axis alike, and no cloud changes: gamma is not in the data, whatever is made of them.
TEST(ProfilerCalibration, TwoMachinesThatDifferInGammaGiveTheSameClouds) {
  const double turn = 0.016;
  const Eigen::Matrix3d s = RigidTransform::fromRotationVector({0.0, 0.0, turn}, Eigen::Vector3d::Zero()).rotation();
  VirtualProfilerMounting one;
  one.alpha_rad = 0.0014;
  one.beta_rad = 0.003;
  one.offset_mm = {5.06, -0.07, 3.42};
  VirtualProfilerMounting two = one;
  setAngles(
      two,
      s * RigidTransform::fromAlphaBetaGamma(one.alpha_rad, one.beta_rad, 0.0, Eigen::Vector3d::Zero()).rotation());
  two.offset_mm = s * one.offset_mm;
  EXPECT_NEAR(two.gamma_rad, turn, 1e-4);

  VirtualOptics optics;
  optics.profile_points = 700;
  optics.profile_interval_mm = 0.04;
  optics.profile_spacing_mm = 0.3;
  {
    Random a(3), b(3);
    const PointCloud first = virtualPocketScan({}, one, optics, a), second = virtualPocketScan({}, two, optics, b);
    ASSERT_EQ(first.size(), second.size());
    EXPECT_LT(largestDifference_mm(first, second), 1e-9);
  }
  optics.profile_points = 300;
  VirtualArtefact artefact;
  artefact.centre_mm = one.offset_mm + Eigen::Vector3d(20.5 * std::tan(0.5 * turn), 20.5, 0.0);
  VirtualArtefact turned = artefact;
  turned.centre_mm = s * artefact.centre_mm;
  turned.yaw_rad = artefact.yaw_rad + turn;
  const SmallError error{{0.0035, 0.0088, 0.0103}, {25e-6, 2e-6, -6e-6}};
  const Eigen::Vector3d lever = one.lever_mm - Eigen::Vector3d(0.0, 0.0, one.lift_mm);
  SmallError other;
  other.rotation_rad = s * error.rotation_rad;
  other.translation_mm = s * error.translation_mm + other.rotation_rad.cross(Eigen::Vector3d(s * lever - lever));
  for (const bool warm : {false, true}) {
    Random a(4), b(4);
    const PointCloud first = virtualScan(
                         artefact, one, optics, [&](double) { return warm ? error : SmallError{}; }, a),
                     second = virtualScan(
                         turned, two, optics, [&](double) { return warm ? other : SmallError{}; }, b);
    ASSERT_GT(first.size(), 10000U);
    ASSERT_EQ(first.size(), second.size());
    EXPECT_LT(largestDifference_mm(first, second), 1e-9);
  }
  // And yet the deviation at the artefact is another one, by more than the scans' noise allows a hundred times over.
  const Eigen::Vector3d u = error.at(lever + artefact.centre_mm).translation_mm;
  const Eigen::Vector3d v = other.at(lever + turned.centre_mm).translation_mm;
  EXPECT_GT(1e3 * std::abs(u.x() - v.x()), 0.8) << "um";
  EXPECT_NEAR(u.head<2>().norm(), v.head<2>().norm(), 1e-9) << "mm";
}

TEST(ProfilerCalibration, ACirclesInformationAboutGammaIsNothingUnderRigid) {
  VirtualProfilerMounting mounting;
  mounting.alpha_rad = 0.004;
  mounting.beta_rad = -0.002;
  mounting.gamma_rad = 0.012;
  mounting.offset_mm = {3.0, -1.0, 2.0};
  VirtualOptics optics;
  optics.profile_points = 800;
  optics.profile_interval_mm = 0.05;
  Random random(8);
  const PointCloud scan = virtualPocketScan({}, mounting, optics, random);
  for (const double assumed : {0.02, 0.05}) {
    CalibrationOptions options;
    options.mounting_angle_rad = assumed;
    const ProfilerCalibration c = calibrateProfiler(scan, {0.0, 0.0, 0.0, 12.496}, options);
    ASSERT_TRUE(c.usable()) << c.message;
    // The part of the information that comes from the scan, over that of the mounting.
    const double gain = std::pow(assumed / c.standardUncertainty(2), 2) - 1.0;
    EXPECT_LT(std::abs(gain), 0.02) << assumed;
    EXPECT_NE(c.message.find("γ about Z cannot be determined"), std::string::npos) << c.message;
    EXPECT_EQ(c.undetermined, std::vector<std::string>{"gamma_rad"});
    // Beside it the same scan knows alpha a thousand times better.
    EXPECT_LT(c.standardUncertainty(1), 0.01 * assumed);
  }
  mounting.scan_model = "push_broom";
  CalibrationOptions options;
  options.scan_model = ScanModel::PushBroom;
  Random again(8);
  const ProfilerCalibration seen =
      calibrateProfiler(virtualPocketScan({}, mounting, optics, again), {0.0, 0.0, 0.0, 12.496}, options);
  ASSERT_TRUE(seen.usable()) << seen.message;
  EXPECT_LT(seen.standardUncertainty(2), 2e-4) << "the carriage's direction shows it";
  EXPECT_LT(std::abs(seen.gamma_rad - mounting.gamma_rad), 4.0 * seen.standardUncertainty(2));
}

}  // namespace
}  // namespace spindrift
