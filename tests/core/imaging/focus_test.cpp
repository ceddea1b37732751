// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/focus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/imaging/contrast_curve.h"
#include "core/simulation/virtual_microscope.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

constexpr std::array<double, 5> heights{-0.254, -0.127, 0.0, 0.127, 0.254};

/// A bell that is not of the family that is fitted.
double bell(double z_mm) {
  return std::pow(1.0 + std::pow(z_mm / 0.21, 2), -1.2) * (1.0 + 0.1 * z_mm);
}

FocusSet makeSet(Random& random, double peak_mm, double gain, double noise) {
  FocusSet set{"F1 in state M0", {}, {}};
  for (const double z : heights) {
    set.height_mm.push_back(z);
    set.normalised.push_back(gain * bell(z - peak_mm) * (1.0 + random.normal(0, noise)));
  }
  return set;
}

TEST(Focus, ShiftsAreFoundWhateverTheGain) {
  Random random(1);
  std::vector<FocusSet> sets;
  std::vector<double> truth;
  for (int i = 0; i < 8; ++i) {
    truth.push_back(random.normal(0, 0.015));
    sets.push_back(makeSet(random, truth.back(), random.uniform(0.5, 2.0), 0.0));
  }
  const FocusResult result = fitFocus(sets);
  ASSERT_EQ(result.status, FitStatus::Converged) << result.message;
  for (std::size_t i = 1; i < sets.size(); ++i) {
    EXPECT_NEAR(result.peaks[i].peak_um - result.peaks[0].peak_um, 1e3 * (truth[i] - truth[0]), 0.4) << i;
  }
  EXPECT_NEAR(result.curve(0, 0.0), sets[0].normalised[2], 0.02 * sets[0].normalised[2]);
}

TEST(Focus, TheGainOfACurveThatIsKeptIsFoundAgain) {
  const Eigen::Vector3d shape(20.0, -3.0, 40.0);
  FocusSet set{"F1 in state M0", {}, {}};
  for (const double z : heights) {
    set.height_mm.push_back(z);
    set.normalised.push_back(contrastAt(shape, 2.5, 30.0, z));
  }
  EXPECT_DOUBLE_EQ(contrastAt(shape, 2.5, 30.0, 0.03), 1.0 / 2.5);
  EXPECT_NEAR(contrastGain(set, shape, 30.0), 2.5, 1e-12);
}

TEST(Focus, CurvesAreDrawnFromWhatIsStored) {
  const Eigen::Vector3d shape(20.0, -3.0, 40.0);
  nlohmann::json curve = nlohmann::json::array();
  for (const double z : heights) curve.push_back({{"z_mm", z}, {"contrast", contrastAt(shape, 2.5, 30.0, z)}});
  curve.push_back({{"z_mm", 0.3}, {"contrast", nullptr}});
  const nlohmann::json state{{"state", "M0"}, {"focus", {{"curve", curve}, {"peak_z_um", {{"value", 30.0}}}}}};
  nlohmann::json details{{"fiducials", {{{"fiducial", "F1"}, {"states", {state, {{"state", "M1"}}}}}}},
                         {"contrast_curve", {{"shape_per_mm", {20.0, -3.0, 40.0}}}}};
  std::vector<ContrastCurve> curves = contrastCurves(details);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].fiducial, "F1");
  EXPECT_EQ(curves[0].height_um.size(), heights.size()) << "what was not measured is left out";
  ASSERT_EQ(curves[0].fitted.size(), curves[0].fitted_height_um.size());
  EXPECT_NEAR(curves[0].fitted.front(), curves[0].contrast.front(), 1e-9);
  EXPECT_NEAR(curves[0].fitted.back(), curves[0].contrast.back(), 1e-9);
  details["contrast_curve"]["shape_per_mm"] = {20.0, "x"};
  curves = contrastCurves(details);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_TRUE(curves[0].fitted.empty());
  for (const char* damaged : {"{}", "[]", "3", R"({"fiducials": 4})", R"({"fiducials": [{"states": [{"focus": 1}]}]})"})
    EXPECT_TRUE(contrastCurves(nlohmann::json::parse(damaged)).empty()) << damaged;
}

TEST(Focus, StatedUncertaintiesHold) {
  Random random(2);
  int inside = 0;
  int total = 0;
  double z2 = 0.0;
  for (int n = 0; n < 300; ++n) {
    std::vector<FocusSet> sets;
    std::vector<double> truth;
    for (int i = 0; i < 6; ++i) {
      truth.push_back(random.normal(0, 0.01));
      sets.push_back(makeSet(random, truth.back(), random.uniform(0.8, 1.2), 0.003));
    }
    const FocusResult result = fitFocus(sets);
    ASSERT_EQ(result.status, FitStatus::Converged);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(i);
      const double error = (result.peaks[a + 3].peak_um - result.peaks[a].peak_um) - 1e3 * (truth[a + 3] - truth[a]);
      const double variance =
          result.covariance(i, i) + result.covariance(i + 3, i + 3) - 2.0 * result.covariance(i, i + 3);
      inside += error * error < 1.96 * 1.96 * variance ? 1 : 0;
      z2 += error * error / variance;
      ++total;
    }
  }
  EXPECT_GT(inside, 0.92 * total);
  EXPECT_NEAR(std::sqrt(z2 / total), 1.0, 0.1);
}

TEST(Focus, AllHeightsOnOneSideIsRefusedAndTheOthersStand) {
  Random random(3);
  std::vector<FocusSet> sets{makeSet(random, 0.0, 1.0, 0.001), makeSet(random, 0.5, 1.0, 0.001),
                             makeSet(random, -0.5, 1.0, 0.001), makeSet(random, 0.01, 1.0, 0.001)};
  sets[3].height_mm.pop_back();
  sets[3].normalised.pop_back();
  const FocusResult result = fitFocus(sets);
  EXPECT_EQ(result.peaks[0].status, FitStatus::Converged);
  EXPECT_EQ(result.peaks[1].status, FitStatus::Rejected);
  EXPECT_THAT(result.peaks[1].message, HasSubstr("one side of focus"));
  EXPECT_THAT(result.peaks[1].message, HasSubstr("up"));
  EXPECT_THAT(result.peaks[2].message, HasSubstr("down"));
  EXPECT_THAT(result.peaks[3].message, HasSubstr("at least 5"));
}

TEST(Focus, FlickerAndStrayLightDoNotChangeTheMeasure) {
  MicroscopeScene scene;
  scene.width_px = 800;
  scene.height_px = 600;
  scene.map = poseAt(800, 600, 2.2, 0.1, {1400, 1400}, {400, 300});
  scene.noise_level = 0.5;
  scene.defocus_um = 60.0;
  const double reference = measureFocus(renderFiducial(standardPattern(), scene, 1)).normalised;
  scene.illumination_gain = 0.8;
  const double darker = measureFocus(renderFiducial(standardPattern(), scene, 2)).normalised;
  scene.illumination_gain = 1.0;
  scene.ground_level += 20.0;
  scene.mark_level += 20.0;
  const double stray = measureFocus(renderFiducial(standardPattern(), scene, 3)).normalised;
  scene.ground_level -= 20.0;
  scene.mark_level -= 20.0;
  scene.defocus_um = 64.0;
  const double moved = measureFocus(renderFiducial(standardPattern(), scene, 4)).normalised;
  EXPECT_NEAR(darker / reference, 1.0, 0.003);
  EXPECT_NEAR(stray / reference, 1.0, 0.003);
  EXPECT_GT(std::abs(moved / reference - 1.0), 0.01);  // 4 um of height
}

TEST(Focus, AnEmptyImageHasNoContrast) {
  EXPECT_EQ(measureFocus(GrayImage(320, 240, 0)).normalised, 0.0);
  EXPECT_EQ(measureFocus(GrayImage(320, 240, 255)).normalised, 0.0);
}

}  // namespace
}  // namespace spindrift
