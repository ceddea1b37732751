// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/virtual_profiler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/units.h"
#include "core/machine/campaign.h"
#include "core/scanning/axis_errors.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/evaluate_scans.h"
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

TEST(VirtualProfiler, DeviationIsGivenWhereThePointStands) {
  const testing::TempFolder folder;
  const VirtualScanCampaign plan = smallCampaign("push_broom");
  JobContext job;
  writeVirtualScanCampaign(plan, folder.path(), 5, job);
  const Campaign campaign = Campaign::read(folder.path());
  for (const ScanResult& s : evaluateScanCampaign(campaign, "", job).scans)
    EXPECT_NEAR(s.capture.y_mm + s.registration.centroid_mm.y(),
                campaign.machine.findPoint(s.capture.artefact)->position_mm.y(), 1e-9);
}

TEST(VirtualProfiler, AScanThatStartedElsewhereIsTheSameScan) {
  const testing::TempFolder folder;
  JobContext job;
  writeVirtualScanCampaign(smallCampaign("push_broom"), folder.path(), 5, job);
  const ScanEvaluation before = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
  // The same points, counted from a carriage position 0.7 mm further on.
  PointCloud cloud = readCloud(folder / "captures/clouds/A1_C1.pcd");
  for (Eigen::Vector3d& p : cloud.points_mm) p.y() -= 0.7;
  writeCloud(cloud, folder / "captures/clouds/A1_C1.pcd", CloudEncoding::Binary, false);
  std::string list = readFile(folder / "captures/scans.csv");
  const std::size_t row = list.find("C1,A1,350,");
  ASSERT_NE(row, std::string::npos);
  list.replace(row, 10, "C1,A1,350.7,");
  writeFileAtomically(folder / "captures/scans.csv", list);
  const ScanEvaluation after = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
  ASSERT_EQ(after.scans.size(), before.scans.size());
  for (std::size_t k = 0; k < after.scans.size(); ++k)
    EXPECT_LT((after.scans[k].registration.translation_mm - before.scans[k].registration.translation_mm).norm(), 2e-5)
        << before.scans[k].capture.cloud;
}

TEST(VirtualProfiler, ScansOfOneArtefactAtTheSameTimeGiveTheSame) {
  const testing::TempFolder folder;
  JobContext job;
  VirtualScanCampaign plan = smallCampaign("push_broom");
  plan.artefacts.resize(1);
  writeVirtualScanCampaign(plan, folder.path(), 5, job);
  const auto with = [&](const char* threads) {
    ::setenv("SPINDRIFT_THREADS", threads, 1);
    ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
    ::unsetenv("SPINDRIFT_THREADS");
    return e;
  };
  const ScanEvaluation one = with("1");
  const ScanEvaluation several = with("3");
  ASSERT_EQ(one.scans.size(), 3U);
  ASSERT_EQ(several.scans.size(), one.scans.size());
  for (std::size_t k = 0; k < one.scans.size(); ++k) {
    EXPECT_EQ(several.scans[k].capture.cloud, one.scans[k].capture.cloud);
    EXPECT_EQ(several.scans[k].registration.translation_mm, one.scans[k].registration.translation_mm);
    EXPECT_EQ(several.scans[k].axis.covariance, one.scans[k].axis.covariance);
  }
}

/// The same campaign on a machine whose axes are called otherwise: profiler along `axis`, `turn` into machine axes.
void renameAxes(const std::filesystem::path& folder, const std::string& axis, const Eigen::Matrix3d& turn) {
  nlohmann::json machine = nlohmann::json::parse(readFile(folder / "machine.json"));
  const auto turned = [&](const nlohmann::json& v) {
    const Eigen::Vector3d out = turn * Eigen::Vector3d(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
    return std::array<double, 3>{out.x(), out.y(), out.z()};
  };
  nlohmann::json& profiler = machine["profiler"];
  profiler["axis"] = axis;
  profiler["lever_mm"] = turned(profiler["lever_mm"]);
  const auto circle = turned(profiler["calibration_circle"]);
  for (std::size_t i = 0; i < 3; ++i) profiler["calibration_circle"][i] = circle[i];
  for (nlohmann::json& point : machine["points"]) {
    const auto at = turned({point["x_mm"], point["y_mm"], point["z_mm"]});
    point["x_mm"] = at[0];
    point["y_mm"] = at[1];
    point["z_mm"] = at[2];
  }
  nlohmann::json travel;
  for (const nlohmann::json& a : machine["axes"])
    if (a["name"] == "Y") travel = a["travel_mm"];
  for (nlohmann::json& a : machine["axes"])
    if (a["name"] == axis) a["travel_mm"] = travel;
  writeFileAtomically(folder / "machine.json", machine.dump(1));
}

TEST(VirtualProfiler, TravelsAlongAnyAxis) {
  const testing::TempFolder folder;
  JobContext job;
  writeVirtualScanCampaign(smallCampaign("push_broom"), folder / "Y", 5, job);
  const Campaign along_y = Campaign::read(folder / "Y");
  const ScanEvaluation y = evaluateScanCampaign(along_y, "", job);
  const InstrumentEvaluation rows_y = evaluateScans(along_y, "", job);
  // x of the scan frame = y x z: with heights along Z, -Y of the machine; a column that looks along -Y has X.
  Eigen::Matrix3d x_turn, z_turn;
  x_turn << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  z_turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  for (const auto& [axis, turn] : {std::pair<const char*, Eigen::Matrix3d>{"X", x_turn}, {"Z", z_turn}}) {
    std::filesystem::copy(folder / "Y", folder / axis, std::filesystem::copy_options::recursive);
    renameAxes(folder / axis, axis, turn);
    const Campaign campaign = Campaign::read(folder / axis);
    const ScanEvaluation e = evaluateScanCampaign(campaign, "", job);
    EXPECT_EQ(e.machine_from_scan, turn) << axis;
    ASSERT_EQ(e.scans.size(), y.scans.size());
    for (std::size_t k = 0; k < e.scans.size(); ++k) {
      const ScanResult& a = e.scans[k];
      const ScanResult& b = y.scans[k];
      EXPECT_LT((a.registration.translation_mm - turn * b.registration.translation_mm).norm(), 1e-9);
      EXPECT_LT((a.axis.error.translation_mm - turn * b.axis.error.translation_mm).norm(), 1e-9);
      EXPECT_LT((a.axis.error.rotation_rad - turn * b.axis.error.rotation_rad).norm(), 1e-12);
      EXPECT_EQ(a.not_observed.size(), b.not_observed.size());
      for (int i = 0; i < 3; ++i) {
        int j = 0;
        turn.row(i).cwiseAbs().maxCoeff(&j);
        for (const int half : {0, 3}) {
          EXPECT_DOUBLE_EQ(a.axis.covariance(half + i, half + i), b.axis.covariance(half + j, half + j)) << axis;
          EXPECT_DOUBLE_EQ(a.registration.covariance(half + i, half + i),
                           b.registration.covariance(half + j, half + j));
        }
      }
    }
    // Observations: the same rows in other components, at the point in machine axes.
    const InstrumentEvaluation rows = evaluateScans(campaign, "", job);
    ASSERT_EQ(rows.observations.rows.size(), rows_y.observations.rows.size());
    double squares = 0.0, squares_y = 0.0;
    for (const Observation& o : rows.observations.rows) squares += std::pow(o.value / o.sigma, 2);
    for (const Observation& o : rows_y.observations.rows) squares_y += std::pow(o.value / o.sigma, 2);
    EXPECT_NEAR(squares, squares_y, 1e-6 * squares_y);
    EXPECT_TRUE(rows.details["cycles"][1]["parameters"].contains(std::string("EX") + axis + "_um"));
  }
  renameAxes(folder / "Z", "C", Eigen::Matrix3d::Identity());
  EXPECT_THROW((void)evaluateScanCampaign(Campaign::read(folder / "Z"), "", job), InputError);
}

/// Root mean square of the deviation's error over its stated standard uncertainty, by component, over some campaigns
/// whose errors of the axis make one wave over its travel.
Eigen::Matrix<double, 6, 1> statedAgainstTrue(int campaigns, std::uint64_t seed) {
  Random random(seed);
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  double scans = 0.0;
  for (int n = 0; n < campaigns; ++n) {
    VirtualScanCampaign plan = smallCampaign("push_broom");
    plan.optics.profile_points = 300;
    plan.optics.profile_interval_mm = 0.1;
    std::array<std::array<double, 2>, 6> wave{};
    for (std::size_t i = 0; i < 6; ++i) wave[i] = {random.normal(0.0, i < 3 ? 0.01 : 1e-5), 6.3 * random.uniform()};
    plan.error = [&wave](double time_s, double y_mm) {
      SmallError e;
      for (int i = 0; i < 6; ++i) {
        const auto& [size, phase] = wave[static_cast<std::size_t>(i)];
        const double v = (1.0 - std::exp(-time_s / 3600.0)) * size * std::sin(y_mm / 286.5 + phase);
        (i < 3 ? e.translation_mm[i] : e.rotation_rad[i - 3]) = v;
      }
      return e;
    };
    const testing::TempFolder folder;
    JobContext job;
    writeVirtualScanCampaign(plan, folder.path(), random.bits(), job);
    const ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder.path()), "", job);
    EXPECT_TRUE(e.rejected.empty());
    for (const ScanResult& s : e.scans) {
      if (s.reference) continue;
      const RegistrationResult& r = s.registration;
      const double y = s.capture.y_mm + r.centroid_mm.y();
      const SmallError truth =
          (plan.error(s.capture.time_s, y) - plan.error(s.capture.artefact == "A1" ? 0.0 : 40.0, y))
              .at(e.mounting.arm_mm(r.centroid_mm, e.scan_model));
      const Eigen::Matrix<double, 6, 1> variance =
          r.covariance.diagonal() + calibrationSpread(r, e.mounting.calibration).rowwise().squaredNorm();
      for (int i = 0; i < 3; ++i) {
        squares[i] += std::pow(r.translation_mm[i] - truth.translation_mm[i], 2) / variance[i];
        squares[3 + i] += std::pow(r.rotation_rad[i] - truth.rotation_rad[i], 2) / variance[3 + i];
      }
      scans += 1.0;
    }
  }
  return (squares / scans).cwiseSqrt();
}

// An error that bends along the scan shifts a mean over it: without the second order of the drift EZ is off by 2 sigma
// and more.
TEST(VirtualProfiler, StatedUncertaintyHoldsWhenErrorsVaryAlongTheAxis) {
  const Eigen::Matrix<double, 6, 1> ratio = statedAgainstTrue(12, 21);
  for (const int i : {0, 2, 3, 4, 5}) {
    EXPECT_GT(ratio[i], 0.5) << i;
    EXPECT_LT(ratio[i], 1.5) << i;
  }
  EXPECT_LT(ratio[1], 1.5) << "EY: mostly the angle alpha that the pocket does not show, here 0.003 of 0.02 rad";
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
