// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/axis_directions.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/core/imaging/synthetic_pose.h"

namespace spindrift {
namespace {

using testing::syntheticPose;

/// Fiducials turned by psi on the table, camera turned by phi in the spindle, spindle at `spindle_deg`.
std::vector<AxisSet> makeSets(Random& random, const std::vector<double>& psi, const std::vector<double>& phi,
                              double noise_um, double squareness_rad = 0.0, double spindle_deg = 0.0) {
  std::vector<AxisSet> sets;
  for (std::size_t f = 0; f < psi.size(); ++f) {
    AxisSet set{"F" + std::to_string(f + 1), "M0", {}, {}};
    const auto imageAt = [&](double cx, double cy) {
      // The tool moves along the real axes: Y is inclined by the squareness.
      const Eigen::Vector2d tool(1000.0 * (cx - squareness_rad * cy), 1000.0 * cy);
      const double c = std::cos(-psi[f]);
      const double s = std::sin(-psi[f]);
      const Eigen::Vector2d place(1500 + c * tool.x() - s * tool.y() + random.normal(0, noise_um),
                                  1500 + s * tool.x() + c * tool.y() + random.normal(0, noise_um));
      AxisImage image;
      image.pose = syntheticPose(1.23, psi[f] + phi[f] - spindle_deg * rad_per_deg, place, {0, 0});
      image.commanded_mm = {cx, cy};
      image.spindle_deg = spindle_deg;
      return image;
    };
    for (int i = -2; i <= 2; ++i) {
      set.x.push_back(imageAt(0.0508 * i, 0.0));
      set.y.push_back(imageAt(0.0, 0.0508 * i));
    }
    sets.push_back(set);
  }
  return sets;
}

TEST(AxisDirections, ExactWithoutNoiseForAnyOrientation) {
  Random random(1);
  for (const double spindle : {0.0, 30.0}) {
    const AxisDirections result =
        fitAxisDirections(makeSets(random, {0.02, -2.9, 1.5}, {-0.113, -0.113, -0.113}, 0.0, 0.0, spindle));
    ASSERT_EQ(result.status, FitStatus::Converged);
    EXPECT_TRUE(result.pooled);
    EXPECT_NEAR(result.phi_rad, -0.113, 1e-9);
    EXPECT_NEAR(result.sets[0].psi_rad, 0.02, 1e-9);
    EXPECT_NEAR(angleDifference(result.sets[1].psi_rad, -2.9), 0.0, 1e-9);
    EXPECT_NEAR(result.sets[0].orthogonality_rad, 0.0, 1e-9);
    EXPECT_NEAR(result.sets[0].x.scale_error, 0.0, 1e-9);
  }
}

TEST(AxisDirections, FindsTheSquarenessOfTheAxes) {
  Random random(2);
  const AxisDirections result = fitAxisDirections(makeSets(random, {0.02}, {0.1}, 0.0, 0.003));
  EXPECT_NEAR(result.sets[0].orthogonality_rad, 0.003, 1e-5);
}

TEST(AxisDirections, StatedUncertaintiesHold) {
  Random random(3);
  int inside = 0;
  int pooled = 0;
  constexpr int campaigns = 500;
  for (int n = 0; n < campaigns; ++n) {
    const AxisDirections result =
        fitAxisDirections(makeSets(random, {0.02, -0.01, 0.03, 0.0}, {0.1, 0.1, 0.1, 0.1}, 0.25));
    inside += std::abs(result.phi_rad - 0.1) < 1.96 * result.phi_sigma_rad ? 1 : 0;
    pooled += result.pooled ? 1 : 0;
  }
  EXPECT_GT(inside, 0.92 * campaigns);
  EXPECT_LT(inside, 0.98 * campaigns);
  EXPECT_GT(pooled, 0.96 * campaigns);
}

TEST(AxisDirections, ACameraThatTurnedIsNotPooled) {
  Random random(4);
  const AxisDirections result = fitAxisDirections(makeSets(random, {0.0, 0.0, 0.0}, {0.1, 0.1, 0.12}, 0.25));
  EXPECT_FALSE(result.pooled);
  EXPECT_LT(result.p_value, 1e-4);
  EXPECT_GT(result.phi_sigma_rad, 0.003);
}

// With the sign of one column wrong, errors came out along wrong axes beside a note on the camera.
TEST(AxisDirections, AxesAsInAMirrorAreRejected) {
  for (const int axis : {0, 1}) {
    Random random(5);
    auto sets = makeSets(random, {0.02, -0.01}, {0.1, 0.1}, 0.25);
    for (AxisSet& set : sets) {
      for (std::vector<AxisImage>* images : {&set.x, &set.y})
        for (AxisImage& image : *images) image.commanded_mm[axis] *= -1.0;
    }
    const AxisDirections result = fitAxisDirections(sets);
    EXPECT_EQ(result.status, FitStatus::Rejected);
    EXPECT_EQ(result.message.find("the images show the Y axis 9"), result.message.find("the images show the Y axis "))
        << result.message;
    EXPECT_NE(result.message.find("clockwise from the X axis (F1 in state M0)"), std::string::npos) << result.message;
    // One set alone does not stop the others.
    auto one = makeSets(random, {0.02, -0.01}, {0.1, 0.1}, 0.25);
    for (AxisImage& image : one[1].x) image.commanded_mm.x() *= -1.0;
    EXPECT_EQ(fitAxisDirections(one).status, FitStatus::Converged);
  }
}

TEST(AxisDirections, RepeatabilityCarriesItsUncertainty) {
  constexpr int campaigns = 400;
  double mean = 0.0, squares = 0.0, stated = 0.0;
  for (int n = 0; n < campaigns; ++n) {
    Random random(static_cast<std::uint64_t>(n));
    const AxisDirections result =
        fitAxisDirections(makeSets(random, {0.02, -0.01}, {0.1, 0.1}, 0.5), {.expected_weight = 0.0});
    mean += result.repeatability_um / campaigns;
    squares += result.repeatability_um * result.repeatability_um / campaigns;
    stated += result.repeatability_sigma_um / campaigns;
  }
  EXPECT_NEAR(mean, 0.5, 0.02);
  EXPECT_NEAR(stated / std::sqrt(squares - mean * mean), 1.0, 0.12);
}

TEST(AxisDirections, WithoutImagesDegenerate) {
  EXPECT_EQ(fitAxisDirections({}).status, FitStatus::Degenerate);
}

}  // namespace
}  // namespace spindrift
