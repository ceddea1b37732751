// SPDX-License-Identifier: GPL-3.0-or-later
// register, calibrate-profiler and evaluate of scans that the virtual profiler made.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "core/base/job_context.h"
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
