// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/artefact_design.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/scanning/axis_errors.h"

namespace spindrift {
namespace {

TEST(ArtefactDesign, BoundAgreesWithARegistrationOfSimulatedScans) {
  const ArtefactSurface surface;
  for (const ScanModel model : {ScanModel::Rigid, ScanModel::PushBroom}) {
    Random random(7);
    const auto scan = [&] {
      PointCloud cloud;
      for (int k = 0; k < 205; ++k) {
        cloud.profile_start.push_back(cloud.size());
        for (int i = 0; i < 200; ++i) {
          const double x = 0.055 * (i + 0.5), y = 0.2 * (k + 0.5);
          cloud.points_mm.emplace_back(x, y, surface.height_mm(x, y) + random.normal(0.0, 5e-4));
        }
      }
      cloud.profile_start.push_back(cloud.size());
      return cloud;
    };
    const PointCloud target = scan(), source = scan();
    RegistrationOptions registration;
    registration.scan_model = model;
    const RegistrationResult r = registerClouds(source, target, registration);
    ASSERT_TRUE(r.usable()) << r.message;
    ArtefactDesignOptions options;
    options.scan_model = model;
    options.point_count = static_cast<double>(source.size());
    const ArtefactDesign d = designArtefact(surface, options);
    ASSERT_EQ(d.status, FitStatus::Converged) << d.message;
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(std::sqrt(d.covariance(i, i) / r.white_covariance(i, i)), 1.0, 0.15) << toString(model) << " " << i;
  }
}

TEST(ArtefactDesign, NoiseAndPointsScaleTheSigmasAndPushBroomSeesYawLess) {
  ArtefactDesignOptions options;
  const ArtefactDesign one = designArtefact({}, options);
  options.noise_um *= 2.0;
  options.point_count *= 4.0;
  const ArtefactDesign same = designArtefact({}, options);
  options.scan_model = ScanModel::PushBroom;
  const ArtefactDesign broom = designArtefact({}, options);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(one.sigma[i], same.sigma[i], 1e-9 * one.sigma[i]);
    EXPECT_GE(broom.sigma[i], 0.999 * same.sigma[i]);
  }
  EXPECT_GT(broom.sigma[5], 3.0 * same.sigma[5]);
  EXPECT_NEAR(one.largest_slope_x, 0.6, 0.01);
  EXPECT_NEAR(one.largest_slope_y, 2.5 / 6.0, 0.01);
  EXPECT_EQ(one.visible_part, 1.0);
}

TEST(ArtefactDesign, NamesWhatPlaneAndGrooveLeaveFree) {
  ArtefactSurface plane;
  plane.amplitude_x_mm = plane.amplitude_y_mm = 0.0;
  const ArtefactDesign flat = designArtefact(plane);
  EXPECT_EQ(flat.status, FitStatus::Degenerate);
  for (const std::size_t i : {0U, 1U, 5U}) EXPECT_TRUE(std::isinf(flat.sigma[i])) << i;
  for (const std::size_t i : {2U, 3U, 4U}) EXPECT_TRUE(std::isfinite(flat.sigma[i])) << i;
  EXPECT_EQ(flat.message, "The surface does not determine EX EY EC.");
  ArtefactSurface groove;
  groove.amplitude_y_mm = 0.0;
  const ArtefactDesign along = designArtefact(groove);
  EXPECT_EQ(along.message, "The surface does not determine EY.");
  ASSERT_FALSE(along.weak.empty());
  EXPECT_EQ(along.weak.front().name, "+1.00 EY");
}

TEST(ArtefactDesign, LeavesOutWhatIsTooSteep) {
  ArtefactSurface steep;
  steep.amplitude_x_mm = 3.0;
  const ArtefactDesign d = designArtefact(steep);
  EXPECT_GT(d.largest_slope_x, 1.7);
  EXPECT_LT(d.visible_part, 0.8);
  ArtefactDesignOptions blind;
  blind.steepest_slope = 0.001;
  EXPECT_EQ(designArtefact(steep, blind).status, FitStatus::Rejected);
  blind.noise_um = 0.0;
  EXPECT_THROW((void)designArtefact(steep, blind), InputError);
  steep.amplitude_xy_mm = std::nan("");
  EXPECT_THROW((void)designArtefact(steep), InputError);
}

TEST(ArtefactDesign, RefusesWhatNoMachineHolds) {
  const auto refused = [](const std::function<void(ArtefactSurface&, ArtefactDesignOptions&)>& change) {
    ArtefactSurface surface;
    surface.bumps.push_back({{5.0, 20.0}, 2.0, 0.5});
    ArtefactDesignOptions options;
    change(surface, options);
    try {
      (void)designArtefact(surface, options);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const double value : {1e308, -1e308}) {
    EXPECT_NE(refused([&](auto& s, auto&) { s.size_mm.x() = value; }), "");
    EXPECT_NE(refused([&](auto& s, auto&) { s.amplitude_y_mm = value; }), "");
    EXPECT_NE(refused([&](auto& s, auto&) { s.wave_number_x_per_mm = value; }), "");
    EXPECT_NE(refused([&](auto& s, auto&) { s.bumps[0].height_mm = value; }), "");
    EXPECT_NE(refused([&](auto& s, auto&) { s.bumps[0].centre_mm.y() = value; }), "");
    EXPECT_NE(refused([&](auto&, auto& o) { o.noise_um = value; }), "");
    EXPECT_NE(refused([&](auto&, auto& o) { o.point_count = value; }), "");
  }
  EXPECT_EQ(refused([](auto& s, auto&) { s.amplitude_x_mm = 1e308; }),
            "Amplitude of the surface: found 10³⁰⁸ mm; allowed: −10000 to 10000.");
}

TEST(ArtefactDesign, StlIsClosedAndHoldsTheVolume) {
  const ArtefactSurface surface;
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "artefact_design_test.stl";
  writeArtefactStl(file, surface, 5.0, 0.25);
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::filesystem::remove(file);
  std::uint32_t count = 0;
  std::memcpy(&count, text.data() + 80, 4);
  ASSERT_EQ(text.size(), 84U + 50U * count);
  double volume = 0.0;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::uint32_t k = 0; k < count; ++k) {
    std::array<float, 12> f{};
    std::memcpy(f.data(), text.data() + 84 + 50 * static_cast<std::size_t>(k), 48);
    const Eigen::Vector3d a(f[3], f[4], f[5]), b(f[6], f[7], f[8]), c(f[9], f[10], f[11]);
    volume += a.dot(b.cross(c)) / 6.0;
    area += (b - a).cross(c - a) / 2.0;
    EXPECT_GT((b - a).cross(c - a).dot(Eigen::Vector3d(f[0], f[1], f[2])), 0.0);
  }
  EXPECT_LT(area.norm(), 1e-3);
  const double mean = (1.0 - std::cos(6.6)) / (0.6 * 11.0) + 2.5 * 6.0 * (1.0 - std::cos(41.0 / 6.0)) / 41.0;
  const double lowest = std::sin(0.6 * 7.853981634) - 2.5;
  EXPECT_NEAR(volume, 11.0 * 41.0 * (mean - lowest + 5.0), 2.0);
  EXPECT_THROW(writeArtefactStl(file, surface, 0.0, 0.25), InputError);
  EXPECT_THROW(writeArtefactStl(file, surface, 5.0, 1e-6), InputError);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(AxisErrorSurfaces, SortsSamplesByCycleAndPositionAndLeavesGaps) {
  std::vector<AxisErrorSample> samples;
  for (int cycle = 0; cycle < 3; ++cycle)
    for (int k = 0; k < 4; ++k) {
      if (cycle == 1 && k == 2) continue;
      AxisErrorSample s;
      s.time_s = 1200.0 * cycle + 30.0 * k;
      s.position_mm = 1000.0 - 250.0 * k;
      s.value.error.translation_mm.x() = 1e-3 * (10 * cycle + k);
      s.value.error.rotation_rad.z() = 1e-6 * (cycle - k);
      s.value.covariance.diagonal() << 4e-6, 1e-6, 1e-6, 1e-12, 1e-12, 9e-12;
      s.value.covariance(3, 3) = std::numeric_limits<double>::infinity();
      samples.push_back(s);
    }
  const auto surfaces = axisErrorSurfaces(samples, 120.0);
  EXPECT_EQ(surfaces[0].unit, "um");
  EXPECT_EQ(surfaces[5].unit, "urad");
  ASSERT_EQ(surfaces[0].times_s.size(), 3U);
  ASSERT_EQ(surfaces[0].positions_mm, (std::vector<double>{250.0, 500.0, 750.0, 1000.0}));
  for (std::size_t cycle = 0; cycle < 3; ++cycle)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t at = cycle * 4 + 3 - k;
      EXPECT_TRUE(std::isnan(surfaces[3].values[at]));
      if (cycle == 1 && k == 2) {
        EXPECT_TRUE(std::isnan(surfaces[0].values[at]));
        continue;
      }
      EXPECT_NEAR(surfaces[0].values[at], 10.0 * static_cast<double>(cycle) + static_cast<double>(k), 1e-9);
      EXPECT_NEAR(surfaces[5].values[at], static_cast<double>(cycle) - static_cast<double>(k), 1e-9);
      EXPECT_NEAR(surfaces[0].sigmas[at], 2.0, 1e-9);
      EXPECT_NEAR(surfaces[5].sigmas[at], 3.0, 1e-9);
    }
}

}  // namespace
}  // namespace spindrift
