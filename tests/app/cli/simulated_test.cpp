// SPDX-License-Identifier: GPL-3.0-or-later
// simulate, fit, heatmap, discrepancy and report on a campaign of the virtual machine.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <memory>

#include "core/base/atomic_file.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

const std::string scenario = sourceFolder().string() + "/resources/scenarios/discrepancy_vertical.json";

class Simulated : public ::testing::Test {
 public:
  static void SetUpTestSuite() {
    folder() = std::make_unique<TempFolder>();
    const Outcome made = runCli({"simulate", scenario, "--out", campaign()});
    ASSERT_EQ(made.status, 0) << made.error;
    before() = contentOf(campaign());
  }
  static void TearDownTestSuite() {
    EXPECT_EQ(contentOf(campaign()), before()) << "a command altered the campaign";
    folder().reset();
  }

 protected:
  static std::unique_ptr<TempFolder>& folder() {
    static std::unique_ptr<TempFolder> kept;
    return kept;
  }
  static std::map<std::string, std::string>& before() {
    static std::map<std::string, std::string> kept;
    return kept;
  }
  static std::string campaign() { return (*folder() / "campaign").string(); }
  /// A fresh copy to spoil.
  static std::filesystem::path copy() {
    const auto path = *folder() / "copy";
    copyCampaign(campaign(), path);
    return path;
  }
  static std::string in(const std::string& name) { return (*folder() / name).string(); }
};

TEST_F(Simulated, SameSeedSameFilesAndNoFolderIsOverwritten) {
  const nlohmann::json j = jsonOf({"simulate", scenario, "--out", in("again")});
  EXPECT_GT(j["observations"].get<int>(), 100);
  std::map<std::string, std::string> names;
  for (const char* file : {"campaign.json", "machine.json", "log.csv", "observations.csv", "simulation.csv"}) {
    EXPECT_EQ(textOf(in("again") + "/" + file), textOf(campaign() + "/" + file)) << file;
  }
  ASSERT_EQ(runCli({"simulate", scenario, "--out", in("other"), "--seed", "77"}).status, 0);
  EXPECT_NE(textOf(in("other/observations.csv")), textOf(campaign() + "/observations.csv"));
  expectBadInput({"simulate", scenario, "--out", campaign()}, {campaign(), "empty"});
  expectBadInput({"simulate", campaign() + "/machine.json", "--out", in("nothing")},
                 {"machine.json", "$.format", "spindrift-machine", "spindrift-scenario"});
  expectBadInput({"simulate", scenario, "--out", in("nothing"), "--seed", "-1"}, {"--seed", "-1"});
  EXPECT_FALSE(std::filesystem::exists(in("nothing")));
}

TEST_F(Simulated, TimesOfTheMachineAndOfWritingAreToldApart) {
  // A machine is simulated in milliseconds, its images are not: what was said to take 23 ms took minutes.
  nlohmann::json json = nlohmann::json::parse(textOf(sourceFolder().string() + "/resources/scenarios/fiducials.json"));
  json["microscope"].update({{"fiducials", {"F1"}}, {"width_px", 640}, {"height_px", 480}});
  writeText(in("images.json"), json.dump());
  const auto started = std::chrono::steady_clock::now();
  const nlohmann::json j = jsonOf({"simulate", in("images.json"), "--out", in("images")});
  const double took_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
  EXPECT_DOUBLE_EQ(j["elapsed_ms"].get<double>(), j["plant_ms"].get<double>() + j["writing_ms"].get<double>());
  EXPECT_GT(j["writing_ms"].get<double>(), j["plant_ms"].get<double>());
  EXPECT_GT(j["elapsed_ms"].get<double>(), 0.2 * took_ms);  // the rest is the start of the program
  EXPECT_LE(j["elapsed_ms"].get<double>(), took_ms);
  const Outcome people = runCli({"simulate", scenario, "--out", in("people")});
  EXPECT_NE(people.output.find("machine simulated in"), std::string::npos) << people.output;
  EXPECT_NE(people.output.find("files written in"), std::string::npos) << people.output;
}

TEST_F(Simulated, FitGivesTheKeysOfTheContract) {
  const nlohmann::json j = jsonOf({"fit", campaign(), "--state", "M5", "--points", "F1,F2,F3,F4,F5,F6,F7"});
  expectEstimates(j["parameters"], {"EX_um", "EY_um", "EZ_um", "EA_urad", "EB_urad", "EC_urad", "EC0Y_urad",
                                    "alpha_X_um_per_m", "alpha_Y_um_per_m"});
  ASSERT_TRUE(j["residuals"].is_array());
  EXPECT_EQ(j["residuals"].size(), 30U);
  for (const auto& r : j["residuals"]) {
    EXPECT_TRUE(r["point"].is_string() && r["component"].is_string() && r["residual_um"].is_number() &&
                r["used"].is_boolean());
  }
  for (const char* key : {"rms_fit_um", "rms_validation_um", "condition_number"})
    EXPECT_TRUE(j[key].is_number()) << key;
  const Outcome people = runCli({"fit", campaign(), "--state", "M5"});
  EXPECT_EQ(people.status, 0);
  EXPECT_NE(people.output.find("um"), std::string::npos);
  const nlohmann::json all = jsonOf({"fit", campaign(), "--state", "M5"});
  EXPECT_TRUE(all["rms_validation_um"].is_null());
}

TEST_F(Simulated, HigherOrderIsToldAndDrawn) {
  const nlohmann::json fit = jsonOf({"fit", campaign(), "--state", "M5"});
  ASSERT_TRUE(fit.contains("higher_order"));
  EXPECT_FALSE(fit["higher_order"]["reason"].get<std::string>().empty());
  const std::vector<std::string> map = {"heatmap", campaign(), "--state", "M5", "--component", "EZ"};
  EXPECT_EQ(jsonOf(map)["model"], "nine-parameter");
  std::vector<std::string> higher = map;
  const std::string csv = (*folder() / "higher.csv").string();
  higher.insert(higher.end(), {"--model", "higher-order", "--csv", csv});
  const nlohmann::json j = jsonOf(higher);
  EXPECT_EQ(j["model"], "higher-order");
  EXPECT_EQ(j["fit"]["higher_order"]["reason"], fit["higher_order"]["reason"]) << "the choice that fit makes";
  EXPECT_GT(textOf(csv).size(), 1000U);
}

TEST_F(Simulated, PlacementKeepsTheDistance) {
  for (const double distance : {50.0, 120.0}) {
    const nlohmann::json j =
        jsonOf({"placement", campaign(), "--count", "5", "--lattice", "9,7", "--distance", std::to_string(distance)});
    ASSERT_EQ(j["positions"].size(), 5U);
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_GE(std::hypot(j["positions"][a]["x_mm"].get<double>() - j["positions"][b]["x_mm"].get<double>(),
                             j["positions"][a]["y_mm"].get<double>() - j["positions"][b]["y_mm"].get<double>()),
                  distance - 1e-6);
  }
  expectBadInput({"placement", campaign(), "--count", "5", "--distance", "-3"}, {"--distance"});
}

TEST_F(Simulated, FitRefusesWhatItCannotUse) {
  expectBadInput({"fit", campaign(), "--state", "M99"}, {"observations.csv", "M99"});
  expectBadInput({"fit", campaign(), "--state", "M5", "--points", "F1,F77"}, {"F77"});
  const auto file = folder()->write("o.csv", textOf(campaign() + "/observations.csv"));
  const auto bad = [&](std::size_t line, const std::string& column, const std::string& value,
                       const std::vector<std::string>& parts) {
    writeText(file, textOf(campaign() + "/observations.csv"));
    setField(file, line, column, value);
    std::vector<std::string> all = parts;
    all.emplace_back("o.csv");
    all.push_back("line " + std::to_string(line));
    all.emplace_back("allowed");
    expectBadInput({"fit", campaign(), "--state", "M5", "--observations", file.string(), "--json", in("f.json")}, all);
    expectBadInput({"discrepancy", campaign(), "--observations", file.string(), "--json", in("f.json"), "--prediction",
                    in("f.csv"), "--html", in("f.html"), "--model-out", in("f.m")},
                   all);
  };
  bad(5, "sigma", "0", {"0"});
  bad(6, "sigma", "-0.5", {"-0.5"});
  bad(7, "value", "nan", {"nan"});
  bad(8, "value", "inf", {"inf"});
  bad(9, "component", "EQ", {"EQ"});
  bad(10, "use", "maybe", {"maybe"});
  bad(11, "x_mm", "ten", {"ten"});
  bad(12, "dir_x", "0.5", {"0.5"});
  bad(500, "time_s", "1", {"backwards"});
  writeText(file, textOf(campaign() + "/observations.csv"));
  edit(file, "sigma", "uncertainty");
  expectBadInput({"fit", campaign(), "--observations", file.string()}, {"o.csv", "sigma", "missing"});
  writeText(file, textOf(campaign() + "/observations.csv"));
  setField(file, 20, "value", "1,25");
  expectBadInput({"fit", campaign(), "--observations", file.string()}, {"o.csv", "line 20", "decimal"});
  for (const char* name : {"f.json", "f.csv", "f.html", "f.m"}) EXPECT_FALSE(std::filesystem::exists(in(name))) << name;
}

TEST_F(Simulated, HeatMapWritesItsPicturesAndItsTable) {
  const nlohmann::json j =
      jsonOf({"heatmap", campaign(), "--state", "M5", "--component", "EX", "--grid", "5,4", "--svg", in("m.svg"),
              "--png", in("m.png"), "--pdf", in("m.pdf"), "--csv", in("m.csv")});
  EXPECT_EQ(j["component"], "EX");
  const auto lines = linesOf(in("m.csv"));
  ASSERT_EQ(lines.size(), 21U);
  EXPECT_TRUE(lines.front().starts_with("x_mm,y_mm,z_mm,component,value,sigma")) << lines.front();
  EXPECT_NE(textOf(in("m.svg")).find("<svg"), std::string::npos);
  EXPECT_TRUE(textOf(in("m.png")).starts_with("\x89PNG"));
  EXPECT_TRUE(textOf(in("m.pdf")).starts_with("%PDF-"));
  expectBadInput({"heatmap", campaign(), "--state", "M99", "--svg", in("n.svg"), "--csv", in("n.csv")}, {"M99"});
  EXPECT_FALSE(std::filesystem::exists(in("n.svg")) || std::filesystem::exists(in("n.csv")));
}

TEST_F(Simulated, DiscrepancyGivesTheKeysOfTheContract) {
  const Outcome outcome = runCli({"discrepancy", campaign(), "--json", in("d.json"), "--prediction", in("d.csv"),
                                  "--model-out", in("model.json"), "--html", in("d.html")});
  ASSERT_TRUE(outcome.status == 0 || outcome.status == 1) << outcome.error;
  EXPECT_NE(outcome.output, "");
  const nlohmann::json j = nlohmann::json::parse(textOf(in("d.json")));
  const std::string verdict = j["verdict"];
  EXPECT_TRUE(verdict == "named" || verdict == "ambiguous" || verdict == "unknown" || verdict == "none") << verdict;
  ASSERT_FALSE(j["effects"].empty());
  for (const auto& e : j["effects"]) {
    EXPECT_TRUE(e["id"].is_string() && e["rivals"].is_array() && e["parameters"].is_object());
    EXPECT_GE(e["confidence"].get<double>(), 0.0);
    EXPECT_LE(e["confidence"].get<double>(), 1.0);
    for (const char* key : {"delta_bic", "heldout_rms_before_um", "heldout_rms_after_um"}) {
      EXPECT_TRUE(e[key].is_number()) << key;
    }
  }
  for (const auto& w : j["where"]) {
    EXPECT_TRUE(w["component"].is_string() && w["points"].is_array());
    for (const char* key : {"from_s", "to_s", "excess_um", "p_value"}) EXPECT_TRUE(w[key].is_number()) << key;
  }
  for (const char* key : {"rms_before_um", "rms_after_um", "noise_um", "heldout_rms_before_um", "heldout_rms_after_um",
                          "p2p_before_um", "p2p_after_um", "fit_before_percent", "fit_after_percent",
                          "heldout_p2p_after_um", "heldout_fit_after_percent"}) {
    EXPECT_TRUE(j["gap"][key].is_number()) << key;
  }
  for (const char* key : {"suggestion", "leftover", "model"}) EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_EQ(nlohmann::json::parse(textOf(in("model.json")))["format"], "spindrift-error-model");
  const auto predicted = linesOf(in("d.csv"));
  EXPECT_TRUE(predicted.front().starts_with("time_s,point,component,predicted"));
  EXPECT_EQ(predicted.size(), linesOf(campaign() + "/observations.csv").size());
  EXPECT_NE(textOf(in("d.html")).find("</html>"), std::string::npos);
}

TEST_F(Simulated, DiscrepancyRefusesWhatItCannotUse) {
  const auto refused = [&](const std::vector<std::string>& parts) {
    expectBadInput({"discrepancy", (*folder() / "copy").string(), "--json", in("x.json"), "--html", in("x.html")},
                   parts);
    EXPECT_FALSE(std::filesystem::exists(in("x.json")) || std::filesystem::exists(in("x.html")));
  };
  auto c = copy();
  auto lines = linesOf(c / "simulation.csv");
  lines.resize(lines.size() / 3);
  writeLines(c / "simulation.csv", lines);
  refused({"359 of 1080", "simulation", "allowed: at least half"});
  c = copy();
  setField(c / "simulation.csv", 7, "predicted", "NaN");
  refused({"simulation.csv", "line 7", "NaN"});
  c = copy();
  std::filesystem::remove(c / "simulation.csv");
  refused({"simulation.csv"});
  c = copy();
  setField(c / "log.csv", 40, "time_s", "3");
  refused({"log.csv", "line 40", "jumps back"});
  c = copy();
  edit(c / "log.csv", "time_s", "seconds");
  refused({"log.csv", "time_s", "missing"});
}

TEST_F(Simulated, ReportIsOneFile) {
  const Outcome outcome = runCli({"report", campaign(), "--no-discrepancy", "--out", in("r.html")});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  const std::string html = textOf(in("r.html"));
  EXPECT_NE(html.find("</html>"), std::string::npos);
  EXPECT_EQ(html.find("src=\"http"), std::string::npos);
}

TEST_F(Simulated, CompensateWritesTheTablesOfACompletedModel) {
  const Outcome outcome =
      runCli({"compensate", campaign(), "--model", "completed", "--accept", "column.bending.a", "--state", "M20",
              "--positions", "5", "--json", in("c.json"), "--out", in("control")});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  const nlohmann::json j = nlohmann::json::parse(textOf(in("c.json")));
  EXPECT_EQ(j["state"], "M20");
  EXPECT_LT(j["rms_after_um"].get<double>(), j["rms_before_um"].get<double>());
  ASSERT_FALSE(j["points"].empty());
  for (const auto& file : j["files"]) {
    EXPECT_FALSE(textOf(in("control/" + file["name"].get<std::string>())).empty()) << file.dump();
    const std::string said = file["name"].get<std::string>() + ": " + file["title"].get<std::string>() + ". " +
                             file["convention"].get<std::string>();
    EXPECT_NE(outcome.output.find(said), std::string::npos) << said;
  }
  expectBadInput({"compensate", campaign(), "--model", "completed"}, {"at least one effect"});
  expectBadInput({"compensate", campaign(), "--accept", "column.bending.a"},
                 {"--accept column.bending.a", "--model completed"});
  expectBadInput({"compensate", campaign(), "--reference", "1,2"}, {"--reference 1,2"});
  expectBadInput({"compensate", campaign(), "--state", "M99"}, {"M99"});
  expectBadInput({"compensate", campaign(), "--fanuc-unit", "0.1"}, {"--fanuc"});
  expectBadInput({"compensate", campaign(), "--fanuc", "up"}, {"positive", "negative"});
}

TEST_F(Simulated, AnEffectIsAcceptedOnceAndNotRejectedToo) {
  const std::string id = "column.bending.a";
  expectBadInput({"discrepancy", campaign(), "--accept", id, "--reject", id}, {id, "accepted and rejected"});
  const Outcome once = runCli({"discrepancy", campaign(), "--accept", id});
  const Outcome twice = runCli({"discrepancy", campaign(), "--accept", id, "--accept", id});
  EXPECT_EQ(once.output, twice.output);
}

TEST_F(Simulated, NoResultGoesIntoTheCampaign) {
  const std::string there = campaign() + "/result";
  for (const auto& words : std::vector<std::vector<std::string>>{{"fit", campaign(), "--state", "M5", "--json", there},
                                                                 {"heatmap", campaign(), "--csv", there},
                                                                 {"report", campaign(), "--out", there},
                                                                 {"discrepancy", campaign(), "--prediction", there},
                                                                 {"compensate", campaign(), "--out", there},
                                                                 {"evaluate", campaign(), "--out", there}}) {
    expectBadInput(words, {there, "never altered"});
  }
  EXPECT_EQ(contentOf(campaign()), before());
}

TEST_F(Simulated, NoResultReplacesWhatACommandReads) {
  const std::string log = campaign() + "/log.csv";
  const std::vector<std::string> identify{"thermal", "identify", log,      "--output", "EZ_um",
                                          "--train", "0:1000",   "--test", "1000:2000"};
  for (const auto& [option, file, sentence] : std::vector<std::array<std::string, 3>>{
           {"--prediction", log, "written over"}, {"--model-out", campaign() + "/model.json", "never altered"}}) {
    std::vector<std::string> words = identify;
    words.insert(words.end(), {option, file});
    expectBadInput(words, {file, sentence});
  }
  const TempFolder folder;
  const std::string own = (folder.path() / "own.csv").string();
  std::filesystem::copy_file(campaign() + "/observations.csv", own);
  const std::string there = readFile(own);
  expectBadInput({"fit", campaign(), "--observations", own, "--json", own}, {own, "written over"});
  expectBadInput({"heatmap", campaign(), "--csv", "-"}, {"--csv", "standard output"});
  EXPECT_EQ(readFile(own), there);
  EXPECT_EQ(contentOf(campaign()), before());
}

TEST_F(Simulated, ResultsThatCannotBeWrittenAreNamed) {
  expectBadInput({"fit", campaign(), "--state", "M5", "--json", "/proc/none/f.json"}, {"/proc/none/f.json", "written"});
}

}  // namespace
}  // namespace spindrift::testing
