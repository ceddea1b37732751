// SPDX-License-Identifier: GPL-3.0-or-later
// Images and clouds of a scenario lead back to what the virtual machine hides, and wrong scenarios are refused.
#include "core/simulation/virtual_captures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <stop_token>

#include "core/base/error.h"
#include "core/imaging/evaluate_fiducials.h"
#include "core/machine/campaign.h"
#include "core/scanning/evaluate_scans.h"
#include "core/scanning/scan_evaluation.h"
#include "core/simulation/virtual_campaign.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

nlohmann::json scenarioJson(const std::string& name) {
  return JsonNode::read(spindrift::testing::sourceFolder() / "resources/scenarios" / (name + ".json")).value();
}

Scenario parsed(const nlohmann::json& json) {
  return Scenario::parse(JsonNode::parse(json.dump(), "scenario.json"), "scenario.json");
}

void expectRefused(const nlohmann::json& json, const std::string& part) {
  try {
    (void)parsed(json);
    ADD_FAILURE() << "accepted although wrong: " << part;
  } catch (const InputError& e) {
    EXPECT_THAT(std::string(e.what()), ::testing::HasSubstr(part));
  }
}

TEST(VirtualCaptures, ImagesLeadBackToTheHiddenDeviation) {
  nlohmann::json json = scenarioJson("fiducials");
  json["microscope"].update({{"fiducials", {"F1", "F3"}},
                             {"width_px", 760},
                             {"height_px", 540},
                             {"pixel_length_um", 2.4},
                             {"defocus_px_per_um", 0.010},
                             {"steps_mm", {-0.1016, 0.0, 0.1016}}});
  const VirtualCampaign made = simulateCampaign(parsed(json), std::nullopt, {});
  ASSERT_NE(made.captures, nullptr);
  EXPECT_EQ(made.captures->images(), 2U * 2U * 14U);
  const testing::TempFolder folder;
  writeCampaign(made, folder / "campaign");
  JobContext job;
  const InstrumentEvaluation evaluation = evaluateFiducials(Campaign::read(folder / "campaign"), job);
  std::map<std::tuple<std::string, std::string, std::string>, double> truth;
  const nlohmann::json hidden = truthJson(made).at("captures");
  for (const auto& row : hidden) {
    truth[{row["state"], row["point"], row["component"]}] = row["value"];
  }
  int compared = 0;
  double largest = 0.0;
  for (const Observation& o : evaluation.observations.rows) {
    if (o.state != "M1") continue;
    const double expected = truth.at({o.state, o.point, std::string(toString(o.component))});
    EXPECT_NEAR(o.value, expected, 4.0 * std::sqrt(2.0) * o.sigma) << o.point << toString(o.component);
    largest = std::max(largest, std::abs(expected));
    ++compared;
  }
  EXPECT_EQ(compared, 6);
  EXPECT_GT(largest, 5.0) << "the machine has to be bent for this to mean anything";
}

/// The truth of a scan is what its evaluation should say: at the centroid of the surface, however the scans are made.
TEST(VirtualCaptures, ScansLeadBackToTheHiddenDeviation) {
  for (const char* model : {"rigid", "push_broom"}) {
    nlohmann::json json = scenarioJson("scans");
    json["machine"]["profiler"]["scan_model"] = model;
    const VirtualCampaign made = simulateCampaign(parsed(json), std::nullopt, {});
    const testing::TempFolder folder;
    writeCampaign(made, folder / "campaign");
    JobContext job;
    const InstrumentEvaluation evaluation = evaluateScans(Campaign::read(folder / "campaign"), "", job);
    std::map<std::tuple<std::string, std::string, std::string>, double> truth;
    const nlohmann::json hidden = truthJson(made).at("captures");
    for (const auto& row : hidden) truth[{row["state"], row["point"], row["component"]}] = row["value"];
    int compared = 0;
    double largest_tilt = 0.0;
    for (const Observation& o : evaluation.observations.rows) {
      const double expected = truth.at({o.state, o.point, std::string(toString(o.component))});
      EXPECT_NEAR(o.value, expected, 5.0 * o.sigma) << model << " " << o.state << o.point << toString(o.component);
      if (o.component == Component::EA) largest_tilt = std::max(largest_tilt, std::abs(expected));
      ++compared;
    }
    EXPECT_GT(compared, 10);
    if (std::string(model) == "rigid") {
      EXPECT_GT(largest_tilt, 1.0) << "20 mm of lever have to show";
    }
  }
}

TEST(VirtualCaptures, ACancelledCampaignLeavesNothingBehind) {
  nlohmann::json json = scenarioJson("fiducials");
  json["microscope"].update({{"fiducials", {"F1"}}, {"width_px", 400}, {"height_px", 300}});
  const VirtualCampaign made = simulateCampaign(parsed(json), std::nullopt, {});
  struct Impatient final : ProgressSink {
    void report(double fraction, std::string_view stage) override {
      const std::scoped_lock lock(mutex);
      EXPECT_GE(fraction, last) << stage << ": progress never runs backwards by more than a parallel image";
      last = std::max(last, fraction - 0.1);
      if (fraction > 0.3) stop.request_stop();
    }
    std::mutex mutex;
    double last = 0.0;
    std::stop_source stop;
  } sink;
  const testing::TempFolder folder;
  JobContext job(sink.stop.get_token(), &sink);
  EXPECT_THROW(writeCampaign(made, folder / "campaign", job), Cancelled);
  EXPECT_TRUE(!std::filesystem::exists(folder / "campaign") || std::filesystem::is_empty(folder / "campaign"));
  writeCampaign(made, folder / "campaign");
  EXPECT_NO_THROW((void)Campaign::read(folder / "campaign")) << "the same folder can be used again";
}

/// A scenario can bend its artefacts: the change of shape is found in the scans and in none without it.
TEST(VirtualCaptures, AnArtefactOfAScenarioBends) {
  for (const bool bends : {false, true}) {
    nlohmann::json json = scenarioJson("scans");
    if (bends)
      json["profiler"]["artefacts"][0]["bending"] = {
          {"along_mm", 0.02}, {"twist_mm", 0.004}, {"held_at", 0.5}, {"time_constant_s", 3600.0}};
    const VirtualCampaign made = simulateCampaign(parsed(json), std::nullopt, {});
    const testing::TempFolder folder;
    writeCampaign(made, folder / "campaign");
    JobContext job;
    const ScanEvaluation e = evaluateScanCampaign(Campaign::read(folder / "campaign"), "", job);
    const std::string bent = json["profiler"]["artefacts"][0]["point"];
    int told = 0;
    for (const ScanResult& s : e.scans) {
      if (s.reference) continue;
      EXPECT_EQ(s.registration.free_form.has_value(), bends && s.capture.artefact == bent) << s.capture.cloud;
      ++told;
    }
    EXPECT_GT(told, 0);
  }
}

TEST(VirtualCaptures, WrongScenariosAreRefused) {
  nlohmann::json json = scenarioJson("fiducials");
  json["microscope"]["fiducials"] = {"F9"};
  expectRefused(json, "F9");
  json = scenarioJson("fiducials");
  json["microscope"]["rotations_deg"] = {0.0, 8.0};
  expectRefused(json, "at least 3");
  json = scenarioJson("scans");
  json["profiler"]["artefacts"][0]["point"] = "A9";
  expectRefused(json, "A9");
  for (const auto& [path, value] : {std::pair{"/profiler/profile_spacing_mm", nlohmann::json(1e-9)},
                                    std::pair{"/machine/profiler/profile_points", nlohmann::json(2000000000)}}) {
    json = scenarioJson("scans");
    json[nlohmann::json::json_pointer(path)] = value;
    expectRefused(json, "a million points per mm");
  }
  json = scenarioJson("scans");
  json["profiler"]["artefacts"][0]["bending"] = {{"held_at", 2.0}};
  expectRefused(json, "from -1 to 1");
  json["profiler"]["artefacts"][0]["bending"] = {{"time_constant_s", 0.0}};
  expectRefused(json, "time_constant_s");
  json = scenarioJson("scans");
  json["machine"]["points"][1]["x_mm"] = 1900.0;
  expectRefused(json, "along Y");
  json = scenarioJson("scans");
  json["machine"].erase("profiler");
  expectRefused(json, "profiler");
}

}  // namespace
}  // namespace spindrift
