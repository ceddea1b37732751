// SPDX-License-Identifier: GPL-3.0-or-later
// register, calibrate-profiler and evaluate of scans that the virtual profiler made.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

#include "core/base/job_context.h"
#include "core/scanning/cloud_file.h"
#include "core/simulation/virtual_profiler.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

class Scans : public ::testing::Test {
 public:
  static void SetUpTestSuite() {
    folder() = std::make_unique<TempFolder>();
    VirtualScanCampaign c;
    c.mounting.alpha_rad = 0.004;
    c.mounting.beta_rad = -0.006;
    c.mounting.offset_mm = {1.2, -0.7, 3.1};
    c.optics.profile_points = 400;
    c.optics.profile_interval_mm = 0.08;
    c.optics.profile_spacing_mm = 0.3;
    c.pocket.circle_mm = {0.0, 0.0, 0.0, 9.0};
    c.pocket.scan_from_mm = -11.0;
    c.pocket.scan_to_mm = 11.0;
    VirtualArtefact a;
    a.surface.bumps = {{{3.0, 9.0}, 2.5, 0.5}, {{8.0, 30.0}, 3.0, -0.4}};
    c.artefacts = {a};
    c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1800.0, 40.0}, {"C2", 3600.0, 40.0}};
    c.error = [](double time_s, double) {
      SmallError e;
      e.translation_mm = time_s / 3600.0 * Eigen::Vector3d(-0.002, 0.005, 0.012);
      return e;
    };
    JobContext job;
    writeVirtualScanCampaign(c, *folder() / "campaign", 5, job);
  }
  static void TearDownTestSuite() { folder().reset(); }

 protected:
  static std::unique_ptr<TempFolder>& folder() {
    static std::unique_ptr<TempFolder> kept;
    return kept;
  }
  static std::filesystem::path campaign() { return *folder() / "campaign"; }
  static std::string cloud(const std::string& name) { return (campaign() / "captures/clouds" / name).string(); }
  static std::string in(const std::string& name) { return (*folder() / name).string(); }
};

TEST_F(Scans, AnotherArtefactIsNoMotion) {
  VirtualScanCampaign c;
  c.optics.profile_points = 400;
  c.optics.profile_interval_mm = 0.08;
  c.optics.profile_spacing_mm = 0.3;
  VirtualArtefact a;
  a.surface.amplitude_x_mm = 0.7;
  a.surface.bumps = {{{5.0, 20.0}, 3.0, 0.6}};
  c.artefacts = {a};
  c.cycles = {{"C0", 0.0, 40.0}};
  JobContext job;
  writeVirtualScanCampaign(c, *folder() / "other", 6, job);
  const Outcome outcome = runCli({"register", cloud("A1_C1.pcd"), in("other/captures/clouds/A1_C0.pcd")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.output.find("another artefact"), std::string::npos) << outcome.output;
}

TEST_F(Scans, RegisterGivesTheKeysOfTheContract) {
  const nlohmann::json j = jsonOf({"register", cloud("A1_C1.pcd"), cloud("A1_C0.pcd")});
  ASSERT_EQ(j["target_from_source"].size(), 4U);
  for (const auto& row : j["target_from_source"]) EXPECT_EQ(row.size(), 4U);
  EXPECT_EQ(j["translation_um"].size(), 3U);
  EXPECT_EQ(j["rotation_urad"].size(), 3U);
  EXPECT_EQ(j["covariance"].size(), 6U);
  for (const char* key : {"rms_um", "points_used", "elapsed_ms"}) EXPECT_TRUE(j[key].is_number()) << key;
}

TEST_F(Scans, CloudsThatCannotBeUsedAreNamed) {
  const std::string good = cloud("A1_C0.pcd");
  const std::string text = textOf(good);
  const auto refused = [&](const std::string& name, const std::string& content) {
    const auto file = folder()->write(name, content);
    expectBadInput({"register", file.string(), good, "--json", in("r.json")}, {name});
    expectBadInput({"register", good, file.string(), "--json", in("r.json")}, {name});
    expectBadInput({"calibrate-profiler", file.string(), "--circle", "0,0,0,9", "--json", in("r.json")}, {name});
    EXPECT_FALSE(std::filesystem::exists(in("r.json")));
  };
  refused("cut.pcd", text.substr(0, text.size() / 2));
  refused("header.pcd", text.substr(0, 60));
  refused("none.csv", "x_mm,y_mm,z_mm\n");
  refused("nan.csv", "x_mm,y_mm,z_mm\nnan,nan,nan\nnan,nan,nan\n");
  refused("columns.csv", "x_mm,y_mm\n1,2\n");
  refused("cloud.stl", "solid");
}

TEST_F(Scans, EvaluateListsBadScansAndEvaluatesTheRest) {
  const auto copy = *folder() / "copy";
  copyCampaign(campaign(), copy);
  const auto bad = copy / "captures/clouds/A1_C1.pcd";
  const std::string content = textOf(bad);
  writeText(bad, content.substr(0, content.size() / 2));
  const auto before = contentOf(copy);
  const nlohmann::json j = jsonOf({"evaluate", copy.string(), "--out", in("o.csv")});
  ASSERT_EQ(j["rejected"].size(), 1U) << j["rejected"].dump();
  EXPECT_NE(j["rejected"][0]["capture"].get<std::string>().find("A1_C1.pcd"), std::string::npos);
  ASSERT_EQ(j["cycles"].size(), 2U);
  for (const auto& cycle : j["cycles"]) {
    expectEstimates(cycle["parameters"], {"EXY_um", "EYY_um", "EZY_um", "EAY_urad", "EBY_urad", "ECY_urad"});
  }
  EXPECT_EQ(contentOf(copy), before);
}

TEST_F(Scans, CalibrationErrorsAreStudied) {
  const nlohmann::json j =
      jsonOf({"study-calibration", campaign().string(), "--angle", "0.01", "--length", "1", "--trials", "400"});
  ASSERT_EQ(j["scans"].size(), 2U);
  for (const char* component : {"EX", "EY", "EZ", "EA", "EB", "EC"}) {
    const double rms = j["rms"][component];
    EXPECT_GT(rms, 0.0) << component;
    EXPECT_GE(j["largest"][component].get<double>(), rms) << component;
  }
  // A turn of the profiler by 10 mrad turns a deviation of 13 um by 0.13 um; twice the error, twice the change.
  EXPECT_NEAR(j["scans"][1]["rms_at_artefact"]["EX"].get<double>(), 0.1, 0.1);
  const nlohmann::json twice =
      jsonOf({"study-calibration", campaign().string(), "--angle", "0.02", "--length", "2", "--trials", "400"});
  EXPECT_NEAR(twice["rms"]["EX"].get<double>() / j["rms"]["EX"].get<double>(), 2.0, 0.1);
  const nlohmann::json none =
      jsonOf({"study-calibration", campaign().string(), "--angle", "0", "--length", "0", "--trials", "20"});
  EXPECT_LT(none["largest"]["EZ"].get<double>(), 1e-6);
}

/// One scan spoilt in a copy of the campaign: what `evaluate` says of it; the others must be evaluated.
class SpoiltScan : public Scans {
 protected:
  nlohmann::json evaluateWith(const std::function<void(PointCloud&)>& spoil, const std::string& name = "A1_C1.pcd") {
    const auto copy = *folder() / "spoilt";
    copyCampaign(campaign(), copy);
    const auto file = copy / "captures/clouds" / name;
    PointCloud c = readCloud(file);
    spoil(c);
    writeCloud(c, file);
    const nlohmann::json j = jsonOf({"evaluate", copy.string(), "--out", in("spoilt.csv")});
    std::filesystem::remove_all(copy);
    return j;
  }
  static std::string said(const nlohmann::json& j) { return j["rejected"].dump() + j["warnings"].dump(); }
  /// Deviation EZ of the artefact in the cycle "C1" (truth 6 um), from the observations.
  static double lift_um(const std::string& cycle, const std::string& file) {
    for (const std::string& row : linesOf(file))
      if (row.find("," + cycle + ",") != std::string::npos && row.find(",EZ,") != std::string::npos)
        return std::stod(row.substr(row.find(",EZ,") + 4));
    return std::nan("");
  }
};

TEST_F(SpoiltScan, AMirroredScanIsRejectedByName) {
  const nlohmann::json j = evaluateWith([](PointCloud& c) {
    for (auto& p : c.points_mm) p.x() = -p.x();
  });
  ASSERT_EQ(j["rejected"].size(), 1U) << said(j);
  EXPECT_NE(said(j).find("mirrored"), std::string::npos) << said(j);
  EXPECT_EQ(j["cycles"].size(), 2U);
}

TEST_F(SpoiltScan, AScanOfAnotherArtefactIsRejected) {
  const nlohmann::json j = evaluateWith([](PointCloud& c) {
    for (auto& p : c.points_mm) p.z() = 0.7 * std::sin(0.9 * p.x() + 0.3 * p.y()) + std::sin(0.45 * p.y());
  });
  ASSERT_EQ(j["rejected"].size(), 1U) << said(j);
  EXPECT_NE(said(j).find("same surface"), std::string::npos) << said(j);
  EXPECT_EQ(j["cycles"].size(), 2U);
}

TEST_F(SpoiltScan, TwoArtefactsInOneCloudAreRejected) {
  const nlohmann::json j = evaluateWith([](PointCloud& c) {
    // A second part of the same shape stands beside the first, 25 mm further along the profile.
    PointCloud both;
    for (std::size_t k = 0; k + 1 < c.profile_start.size(); ++k) {
      both.profile_start.push_back(both.size());
      for (const double shift : {0.0, 25.0})
        for (std::size_t i = c.profile_start[k]; i < c.profile_start[k + 1]; ++i)
          both.points_mm.push_back(c.points_mm[i] + Eigen::Vector3d(shift, 0.0, 0.0));
    }
    both.profile_start.push_back(both.size());
    c = both;
  });
  ASSERT_EQ(j["rejected"].size(), 1U) << said(j);
  EXPECT_NE(said(j).find("two separate surfaces"), std::string::npos) << said(j);
  EXPECT_EQ(j["cycles"].size(), 2U);
}

TEST_F(SpoiltScan, AHandInTheScanIsSaidAndTheRestIsUsed) {
  const nlohmann::json j = evaluateWith([](PointCloud& c) {
    double low = 1e9;
    double high = -1e9;
    for (const auto& p : c.points_mm) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    }
    for (auto& p : c.points_mm)
      if (p.y() > low + 0.6 * (high - low)) p.z() += 20.0 + 0.3 * std::sin(p.x());
  });
  ASSERT_TRUE(j["rejected"].empty()) << said(j);
  EXPECT_NE(said(j).find("A1_C1.pcd"), std::string::npos) << said(j);
  EXPECT_NEAR(lift_um("C1", in("spoilt.csv")), 6.0, 0.5);
}

TEST_F(SpoiltScan, AScanCutShortIsSaidAndUsed) {
  const nlohmann::json j = evaluateWith([](PointCloud& c) {
    const std::size_t keep = c.profileCount() / 2;
    c.points_mm.resize(c.profile_start[keep]);
    c.profile_start.resize(keep + 1);
  });
  ASSERT_TRUE(j["rejected"].empty()) << said(j);
  EXPECT_NE(said(j).find("A1_C1.pcd"), std::string::npos) << said(j);
  EXPECT_NEAR(lift_um("C1", in("spoilt.csv")), 6.0, 0.5);
}

TEST_F(SpoiltScan, ColdAndWarmSwappedGiveTheOppositeMotion) {
  const nlohmann::json forward = jsonOf({"register", cloud("A1_C2.pcd"), cloud("A1_C0.pcd")});
  const nlohmann::json swapped = jsonOf({"register", cloud("A1_C0.pcd"), cloud("A1_C2.pcd")});
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(forward["translation_um"][i].get<double>(), -swapped["translation_um"][i].get<double>(), 0.05) << i;
}

TEST_F(Scans, WrongListsAreRefusedInOneSentence) {
  const auto copy = *folder() / "copy";
  const auto wrong = [&](std::size_t line, const std::string& column, const std::string& value,
                         const std::vector<std::string>& parts) {
    copyCampaign(campaign(), copy);
    setField(copy / "captures/scans.csv", line, column, value);
    std::vector<std::string> all = parts;
    all.insert(all.end(), {"scans.csv", "line " + std::to_string(line), "allowed"});
    expectBadInput({"evaluate", copy.string(), "--out", in("refused.csv")}, all);
    EXPECT_FALSE(std::filesystem::exists(in("refused.csv")));
  };
  wrong(3, "time_s", "-1", {"backwards"});
  wrong(3, "y_mm", "inf", {"inf"});
}

}  // namespace
}  // namespace spindrift::testing
