// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/virtual_microscope.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/csv.h"
#include "core/simulation/virtual_fiducials.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

TEST(VirtualMicroscope, CentroidOfACircleIsWhereItShouldBe) {
  MicroscopeScene scene;
  scene.width_px = 320;
  scene.height_px = 240;
  scene.noise_level = 0.0;
  for (const double shift : {0.0, 0.3, 0.71}) {
    const Eigen::Vector2d at(160.0 + shift, 120.0 - 0.5 * shift);
    scene.map = poseAt(320, 240, 1.2, 0.3, standardPattern().circleCentre(3, 4), at);
    const GrayImage image = renderFiducial(standardPattern(), scene, 1);
    double sum = 0.0, x = 0.0, y = 0.0;
    for (int v = 85; v <= 155; ++v) {
      for (int u = 125; u <= 196; ++u) {
        if (std::hypot(u - at.x(), v - at.y()) > 32.0) continue;
        const double w = image.at(u, v) - 35.0;
        sum += w;
        x += w * u;
        y += w * v;
      }
    }
    EXPECT_NEAR(x / sum, at.x(), 0.004);
    EXPECT_NEAR(y / sum, at.y(), 0.004);
  }
}

TEST(VirtualMicroscope, SameSeedSameImage) {
  MicroscopeScene scene;
  scene.width_px = 200;
  scene.height_px = 150;
  scene.map = poseAt(200, 150, 2.0, 0.3, {700, 700}, {100, 75});
  scene.dust = 5;
  const GrayImage a = renderFiducial(standardPattern(), scene, 9);
  const GrayImage b = renderFiducial(standardPattern(), scene, 9);
  EXPECT_TRUE(std::equal(a.data(), a.data() + 200 * 150, b.data()));
}

TEST(VirtualFiducials, WritesACampaignThatDecodesToItsDeviation) {
  const spindrift::testing::TempFolder folder;
  VirtualFiducialOptions options;
  options.width_px = 800;
  options.height_px = 600;
  options.cor_px = {402.0, 305.0};
  options.pixel_length_um = 1.6;
  options.flicker = 0.0;
  options.spindle_repeatability_um = 0.0;
  options.axis_repeatability_um = 0.0;
  options.rotations_deg = {-8.0, 0.0, 8.0};
  options.steps_mm = {0.0, 0.05};
  options.heights_mm = {0.0};
  options.fiducials = {{"F1", {20.0, 15.0}, 0.02, {1400.0, 1400.0}}};
  options.states = {{"M0", 0.0, {{0, 0, 0}}}, {"M1", 600.0, {{500.0, -20.0, 5.0}}}};
  JobContext job;
  writeVirtualFiducialCampaign(folder.path(), standardPattern(), options, 4, job);
  const CsvTable table = CsvTable::read(folder.path() / "captures" / "fiducials.csv");
  ASSERT_EQ(table.rowCount(), 16U);
  const auto under = [&](std::size_t row) {
    const DecodeResult r =
        decodeImage(readImage(folder.path() / std::string(table.text(row, table.column("image")))), standardPattern());
    EXPECT_TRUE(r.usable()) << r.message;
    return r.map.patternOf(options.cor_px);
  };
  // What lies under the spindle's axis moves with the tool; it stays where it is while the spindle turns.
  const Eigen::Vector2d cold = under(1);
  EXPECT_LT((under(0) - cold).norm(), 0.1);
  const Eigen::Rotation2Dd turn(0.02);
  const Eigen::Vector2d moved = turn * (under(9) - cold);
  EXPECT_NEAR(moved.x(), 500.0, 0.1);
  EXPECT_NEAR(moved.y(), -20.0, 0.1);
  const Eigen::Vector2d stepped = turn * (under(4) - cold);
  EXPECT_NEAR(stepped.x(), 50.0, 0.1);
  EXPECT_NEAR(stepped.y(), 0.0, 0.1);
}

}  // namespace
}  // namespace spindrift
