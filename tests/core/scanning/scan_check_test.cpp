// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/scan_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/evaluate_scans.h"
#include "core/scanning/painted_mask.h"
#include "core/scanning/scan_picture.h"
#include "core/scanning/scan_points.h"
#include "core/simulation/virtual_profiler.h"
#include "tests/support/child_process.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

/// One artefact in three cycles, lifted by 12 um from cycle to cycle.
void writeScans(const std::filesystem::path& folder) {
  VirtualScanCampaign c;
  c.optics.profile_points = 400;
  c.optics.profile_interval_mm = 0.05;
  c.optics.profile_spacing_mm = 0.4;
  VirtualArtefact a;
  a.surface.bumps = {{{3.0, 9.0}, 2.5, 0.5}};
  c.artefacts = {a};
  c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1000.0, 40.0}, {"C2", 2000.0, 40.0}};
  c.error = [](double time_s, double) {
    SmallError e;
    e.translation_mm.z() = 12e-6 * time_s;
    return e;
  };
  JobContext job;
  writeVirtualScanCampaign(c, folder, 9, job);
}

TEST(ScanCheck, GoodBrokenAndMissingScansAreToldApart) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  const auto cut = folder / "c/captures/clouds/A1_C1.pcd";
  PointCloud cloud = readCloud(cut);
  cloud.points_mm.resize(cloud.profile_start[cloud.profileCount() / 2]);
  cloud.profile_start.resize(cloud.profileCount() / 2 + 1);
  writeCloud(cloud, cut);
  writeFileAtomically(folder / "c/captures/clouds/A1_C2.pcd", "no cloud");
  const std::vector<ScanCheck> checks = checkScans(Campaign::read(folder / "c"), JobContext());
  ASSERT_EQ(checks.size(), 3U);
  EXPECT_TRUE(checks[0].usable);
  EXPECT_TRUE(checks[0].reason.empty()) << checks[0].reason;
  EXPECT_EQ(checks[0].completeness, 1.0);
  EXPECT_GT(checks[0].edge_points, 0U);
  EXPECT_GT(checks[0].profiles, 50U);
  EXPECT_TRUE(checks[1].usable);
  EXPECT_NEAR(checks[1].completeness, 0.5, 0.05);
  EXPECT_NE(checks[1].reason.find("cut short"), std::string::npos);
  EXPECT_FALSE(checks[2].usable);
  EXPECT_FALSE(checks[2].reason.empty());
}

TEST(ScanCheck, ExcludedScansAreLeftOut) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  Campaign campaign = Campaign::read(folder / "c");
  campaign.excluded_captures = {"captures/clouds/A1_C1.pcd"};
  EXPECT_EQ(checkScans(campaign, JobContext()).size(), 2U);
  JobContext job;
  EXPECT_EQ(evaluateScanCampaign(campaign, "", job).scans.size(), 2U);
  for (const char* cloud : {"captures/clouds/A1_C0.pcd", "captures/clouds/A1_C2.pcd"})
    campaign.excluded_captures.insert(cloud);
  EXPECT_THROW(evaluateScanCampaign(campaign, "", job), InputError);
}

TEST(ScanPoints, WhatIsPaintedAwayIsNotEvaluated) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  Campaign campaign = Campaign::read(folder / "c");
  const std::string cloud = "captures/clouds/A1_C2.pcd";
  const ScanPoints before = readScanPoints(campaign, cloud);
  EXPECT_EQ(before.count(PointFate::Painted), 0U);
  EXPECT_GT(before.count(PointFate::Edge), 0U);
  const Eigen::Vector3d middle = before.cloud.centroid_mm();
  campaign.excluded_captures.insert(maskItem(
      cloud,
      {{StrokeShape::Rectangle, true, 0.0, {middle.head<2>(), (middle + Eigen::Vector3d(30, 30, 0)).head<2>()}}}));
  const ScanPoints after = readScanPoints(campaign, cloud);
  EXPECT_GT(after.count(PointFate::Painted), before.cloud.size() / 6);
  EXPECT_EQ(after.cloud.size(), before.cloud.size()) << "the scan itself is never altered";
  EXPECT_EQ(after.used().size(), after.count(PointFate::Used));
  EXPECT_EQ(checkScans(campaign, JobContext()).back().painted_points, after.count(PointFate::Painted));
  JobContext job;
  const ScanEvaluation evaluation = evaluateScanCampaign(campaign, "", job);
  ASSERT_EQ(evaluation.scans.size(), 3U);
  EXPECT_LE(evaluation.scans.back().registration.points_used, after.count(PointFate::Used));
  const ScanPicture picture = pictureOfScan(campaign, cloud, "", ScanColouring::LeftOut, ScanModel::Rigid, job);
  EXPECT_EQ(picture.counts[3], after.count(PointFate::Painted));
  EXPECT_EQ(
      pictureOfScan(campaign, cloud, "", ScanColouring::Height, ScanModel::Rigid, job, ScanPart::AsUsed).scalar->size(),
      after.count(PointFate::Used));
  // Everything masked: the scan is rejected with what took its points, the others are evaluated.
  campaign.excluded_captures.insert(
      maskItem(cloud, {{StrokeShape::Rectangle, true, 0.0, {{-1000.0, -1000.0}, {1000.0, 1000.0}}}}));
  const ScanEvaluation rest = evaluateScanCampaign(campaign, "", job);
  EXPECT_EQ(rest.scans.size(), 2U);
  ASSERT_EQ(rest.rejected.size(), 1U);
  EXPECT_NE(rest.rejected.front().reason.find("masked"), std::string::npos) << rest.rejected.front().reason;
}

TEST(ScanPicture, ShowsTheChangeAndWhatRegistrationLeaves) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  const Campaign campaign = Campaign::read(folder / "c");
  const auto picture = [&](ScanColouring colouring) {
    return pictureOfScan(campaign, "captures/clouds/A1_C2.pcd", "captures/clouds/A1_C0.pcd", colouring,
                         ScanModel::Rigid, JobContext());
  };
  const ScanPicture height = picture(ScanColouring::Height);
  EXPECT_EQ(height.scalar->size(), height.scan->size());
  EXPECT_EQ(height.xyz_mm->size(), 3 * height.scan->size());
  EXPECT_EQ(picture(ScanColouring::Overlay).scalar->size(), height.scan->size() + height.reference->size());
  // A tool that stands 24 um higher reads the surface 24 um lower.
  const ScanPicture change = picture(ScanColouring::Measured);
  EXPECT_NEAR(change.median_magnitude, 24.0, 1.0);
  EXPECT_LT(change.high, 0.0);
  EXPECT_LT(picture(ScanColouring::Registered).median_magnitude, 1.5);
  // The reference compared with itself is a picture of heights.
  EXPECT_EQ(pictureOfScan(campaign, "captures/clouds/A1_C0.pcd", "captures/clouds/A1_C0.pcd", ScanColouring::Measured,
                          ScanModel::Rigid, JobContext())
                .colouring,
            ScanColouring::Height);
}

/// It would be "exactly no error", and the surest of all rows.
TEST(EvaluateScans, ACopyIsNoSecondMeasurement) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  const auto cloud = [&](const char* name) { return folder / "c/captures/clouds" / name; };
  std::filesystem::copy_file(cloud("A1_C0.pcd"), cloud("A1_C1.pcd"), std::filesystem::copy_options::overwrite_existing);
  JobContext job;
  const InstrumentEvaluation evaluation = evaluateScans(Campaign::read(folder / "c"), "", job);
  ASSERT_EQ(evaluation.rejected.size(), 1U);
  EXPECT_NE(evaluation.rejected.front().reason.find("holds the same bytes as captures/clouds/A1_C0.pcd"),
            std::string::npos)
      << evaluation.rejected.front().reason;
  for (const Observation& o : evaluation.observations.rows) EXPECT_NE(o.state, "C1");
}

TEST(EvaluateScans, MetresAndACalibrationOutsideTheCampaignAreRefused) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  Campaign campaign = Campaign::read(folder / "c");
  ASSERT_TRUE(campaign.machine.profiler);
  ProfilerDescription& profiler = *campaign.machine.profiler;
  const auto complaint = [&] {
    try {
      (void)readScanList(campaign);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(), "");
  profiler.lever_mm = {0.0, -0.1, 0.34};
  EXPECT_NE(complaint().find("$.profiler.lever_mm: a lever of 0.354 mm looks like metres"), std::string::npos)
      << complaint();
  profiler.lever_mm.setZero();
  profiler.calibration_cloud = "../../x.pcd";
  EXPECT_NE(complaint().find("\"../../x.pcd\" leaves its folder"), std::string::npos) << complaint();
  profiler.calibration_cloud.clear();
  const LinearAxis* axis = campaign.machine.findAxis(profiler.axis);
  ASSERT_NE(axis, nullptr);
  folder.write("c/captures/scans.csv",
               "time_s,cycle,artefact,y_mm,cloud\n0,C0,A1,0.04,captures/clouds/A1_C0.pcd\n"
               "60,C0,A2,0.09,captures/clouds/A1_C1.pcd\n");
  EXPECT_NE(complaint().find("all carriage positions lie within 0.09 mm"), std::string::npos) << complaint();
}

/// The first scan is a plane: it fits nothing and is the one that is wrong, not those that show the artefact.
TEST(EvaluateScans, APlaneIsNotTheReference) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  const auto first = folder / "c/captures/clouds/A1_C0.pcd";
  PointCloud cloud = readCloud(first);
  Random random(5);
  for (Eigen::Vector3d& p : cloud.points_mm) p.z() = 0.002 * random.normal();
  writeCloud(cloud, first);
  std::filesystem::remove(folder / "c/captures/clouds/A1_C1.pcd");
  JobContext job;
  const InstrumentEvaluation evaluation = evaluateScans(Campaign::read(folder / "c"), "", job);
  ASSERT_EQ(evaluation.rejected.size(), 2U);
  for (const RejectedCapture& r : evaluation.rejected) EXPECT_NE(r.capture, "captures/clouds/A1_C2.pcd") << r.reason;
}

TEST(ScanCheck, ACloudThatTheMemoryCannotHoldCostsItselfAndNotTheRun) {
  const testing::TempFolder folder;
  writeScans(folder / "c");
  // All of its bytes are zero, and none of them is on the disk.
  constexpr std::size_t points = 20'000'000;
  const std::filesystem::path large = folder / "c/captures/clouds/A1_C1.pcd";
  std::ofstream(large) << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << points
                       << "\nHEIGHT 1\nPOINTS " << points << "\nDATA binary\n";
  std::filesystem::resize_file(large, std::filesystem::file_size(large) + 12 * points);
  const Campaign campaign = Campaign::read(folder / "c");
  const std::string answer = testing::inChildProcess([&] {
    if (!testing::limitMemory(400'000'000)) return std::string("no limit");
    std::string text;
    for (const ScanCheck& check : checkScans(campaign, JobContext()))
      text += check.capture.cycle + (check.usable ? " usable; " : " lost: " + check.reason + "; ");
    JobContext job;
    for (const RejectedCapture& rejected : evaluateScans(campaign, "", job).rejected)
      text += "rejected " + rejected.reason;
    return text;
  });
  if (answer == "no limit") GTEST_SKIP() << "the sanitizer takes more address space than any limit";
  EXPECT_EQ(answer,
            "C0 usable; C1 lost: there is not enough memory for the cloud; C2 usable; "
            "rejected captures/clouds/A1_C1.pcd: there is not enough memory for the cloud.");
}

TEST(ReadCloud, AFileThatIsTooLargeForACloudIsNotRead) {
  const testing::TempFolder folder;
  const std::filesystem::path file = folder.write("large.pcd", "VERSION 0.7\n");
  std::filesystem::resize_file(file, 100'000'000'000);
  const std::string answer = testing::inChildProcess([&] {
    (void)testing::limitMemory(100'000'000);
    return testing::refusal([&] { (void)readCloud(file); });
  });
  EXPECT_NE(answer.find("100000000000 bytes"), std::string::npos) << answer;
}

}  // namespace
}  // namespace spindrift
