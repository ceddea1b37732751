// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/virtual_profiler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/base/units.h"
#include "core/machine/campaign.h"
#include "core/scanning/axis_errors.h"
#include "core/scanning/profiler_calibration.h"
#include "core/scanning/scan_evaluation.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

VirtualScanCampaign smallCampaign(const std::string& model) {
  VirtualScanCampaign c;
  c.mounting.scan_model = model;
  c.mounting.alpha_rad = 0.003;
  c.mounting.beta_rad = -0.002;
  c.mounting.gamma_rad = model == "rigid" ? 0.0 : -0.009;  // rigid: a circle cannot show it
  c.mounting.offset_mm = {1.2, -0.7, 3.1};
  c.optics.profile_points = 640;
  c.optics.profile_interval_mm = 0.05;
  c.optics.profile_spacing_mm = 0.2;
  c.pocket.circle_mm = {0.0, 0.0, 0.0, 9.0};
  c.pocket.scan_from_mm = -11.0;
  c.pocket.scan_to_mm = 11.0;
  for (const auto& [id, y] : {std::pair<const char*, double>{"A1", 350.0}, {"A2", 1250.0}}) {
    VirtualArtefact a;
    a.id = id;
    a.y_mm = y;
    a.yaw_rad = 0.004;
    a.surface.bumps = {{{3.0, 9.0}, 2.5, 0.5}, {{8.0, 30.0}, 3.0, -0.4}};
    c.artefacts.push_back(a);
  }
  c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1800.0, 40.0}, {"C2", 7200.0, 40.0}};
  c.error = [](double time_s, double y_mm) {
    const double q = 1.0 - std::exp(-time_s / 3600.0);
    SmallError e;
    e.translation_mm = q * Eigen::Vector3d(-0.002, 0.005 + 2e-5 * y_mm, 0.012);
    e.rotation_rad = q * Eigen::Vector3d(25e-6 - 3e-8 * y_mm, 4e-9 * y_mm, -8e-6);
    return e;
  };
  return c;
}

void checkEvaluation(const std::string& model) {
  const testing::TempFolder folder;
  const VirtualScanCampaign plan = smallCampaign(model);
  JobContext job;
  writeVirtualScanCampaign(plan, folder.path(), 5, job);
  const ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
  ASSERT_EQ(e.scans.size(), 6U);
  EXPECT_TRUE(e.rejected.empty());
  const auto start = [&](const std::string& artefact) { return artefact == "A1" ? 0.0 : 40.0; };
  for (const ScanResult& s : e.scans) {
    if (s.reference) continue;
    // Error when the scan starts (rigid) or when the profile passes the centroid, less that of the reference scan.
    const double y = s.capture.y_mm + (model == "rigid" ? 0.0 : s.registration.centroid_mm.y());
    const SmallError truth = plan.error(s.capture.time_s, y) - plan.error(start(s.capture.artefact), y);
    const Eigen::Vector3d q = e.mounting.arm_mm(s.registration.centroid_mm, e.scan_model);
    const SmallError near = truth.at(q);
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(std::abs(s.registration.translation_mm[i] - near.translation_mm[i]),
                5.0 * s.registration.standardUncertainty(i) + 3e-4)
          << model << ' ' << s.capture.artefact << ' ' << s.capture.cycle << ' ' << i;
      if (std::isfinite(s.registration.covariance(i + 3, i + 3))) {
        EXPECT_LT(std::abs(s.registration.rotation_rad[i] - near.rotation_rad[i]),
                  4.5 * s.registration.standardUncertainty(i + 3))
            << model << ' ' << s.capture.artefact << ' ' << s.capture.cycle << ' ' << i;
      }
      if (s.axis.determined(i)) {
        EXPECT_LT(std::abs(s.axis.error.translation_mm[i] - truth.translation_mm[i]),
                  5.0 * std::sqrt(s.axis.covariance(i, i)) + 3e-4);
      }
    }
  }
}

TEST(VirtualProfiler, RigidCampaignComesBack) {
  checkEvaluation("rigid");
}
TEST(VirtualProfiler, PushBroomCampaignComesBack) {
  checkEvaluation("push_broom");
}

TEST(VirtualProfiler, BadScansAreListedAndTheRestIsEvaluated) {
  const testing::TempFolder folder;
  VirtualScanCampaign plan = smallCampaign("rigid");
  JobContext job;
  writeVirtualScanCampaign(plan, folder.path(), 6, job);
  const auto cut = folder / "captures/clouds/A1_C1.pcd";
  const std::string content = readFile(cut);
  writeFileAtomically(cut, content.substr(0, content.size() / 2));
  std::filesystem::remove(folder / "captures/clouds/A2_C2.pcd");
  const ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
  EXPECT_EQ(e.scans.size(), 4U);
  ASSERT_EQ(e.rejected.size(), 2U);
  EXPECT_NE(e.rejected[0].reason.find("truncated"), std::string::npos);
}

TEST(Calibration, TruthLiesWhereStated) {
  Random random(7);
  for (const ScanModel model : {ScanModel::Rigid, ScanModel::PushBroom}) {
    double squares = 0.0;
    constexpr int runs = 12;
    for (int run = 0; run < runs; ++run) {
      VirtualProfilerMounting m;
      m.scan_model = std::string(toString(model));
      m.alpha_rad = random.normal(0.0, 0.005);
      m.beta_rad = random.normal(0.0, 0.005);
      m.gamma_rad = random.normal(0.0, 0.01);
      m.offset_mm = {random.normal(0.0, 2.0), random.normal(0.0, 2.0), random.normal(0.0, 3.0)};
      VirtualOptics optics;
      optics.profile_points = 1000;
      optics.profile_interval_mm = 0.04;
      VirtualPocket pocket;
      pocket.profile_spacing_mm = 0.3;
      Random own = random.split();
      const PointCloud scan = virtualPocketScan(pocket, m, optics, own);
      CalibrationOptions options;
      options.scan_model = model;
      const ProfilerCalibration c = calibrateProfiler(scan, pocket.circle_mm, options);
      ASSERT_TRUE(c.usable()) << c.message;
      const std::array<double, 6> error{c.alpha_rad - m.alpha_rad,         c.beta_rad - m.beta_rad,
                                        c.gamma_rad - m.gamma_rad,         c.offset_mm.x() - m.offset_mm.x(),
                                        c.offset_mm.y() - m.offset_mm.y(), c.offset_mm.z() - m.offset_mm.z()};
      for (int i = 0; i < 6; ++i) {
        const double t = error[static_cast<std::size_t>(i)] / c.standardUncertainty(i);
        EXPECT_LT(std::abs(t), 5.0) << toString(model) << " parameter " << i;
        squares += t * t;
      }
      ASSERT_EQ(c.undetermined.size(), 1U);
      EXPECT_EQ(c.undetermined[0], model == ScanModel::Rigid ? "gamma_rad" : "alpha_rad");
    }
    EXPECT_LT(std::sqrt(squares / (6.0 * runs)), 1.6) << toString(model);
  }
}

TEST(Calibration, ErrorsOfItHardlyMatter) {
  // P3 section 5: 1e-2 rad and 1 mm against 10 um and 10 urad.
  ProfilerMounting mounting;
  mounting.calibration.status = FitStatus::Converged;
  mounting.lift_mm = 178.152;
  mounting.lever_mm = {-900.0, 0.0, -2051.0};
  const RigidTransform motion = RigidTransform::fromRotationVector({1e-5, -1e-5, 1e-5}, {0.01, -0.01, 0.01});
  const CalibrationStudy study = studyCalibrationErrors(motion, {0.0, 20.5, 0.0}, mounting);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(study.rms[i], 0.5);
  for (std::size_t i = 3; i < 6; ++i) EXPECT_LT(study.rms[i], 0.3);
}

TEST(Calibration, PaperMatrixIsReproduced) {
  ProfilerCalibration c;
  c.alpha_rad = 0.0029;
  c.beta_rad = -0.0013;
  c.gamma_rad = -0.0091;
  c.offset_mm = {2.771, -0.876, 4.219};
  const Eigen::Matrix4d m = c.tcsFromProfiler(178.152).matrix();
  EXPECT_NEAR(m(0, 1), 0.0090741, 3e-5);
  EXPECT_NEAR(m(1, 2), -0.002897, 1e-5);
  EXPECT_NEAR(m(2, 0), 0.0012751, 1e-5);
  EXPECT_NEAR(m(2, 3), -173.9324, 1e-3);
}

}  // namespace
}  // namespace spindrift
