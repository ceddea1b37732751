// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tasks/task_options.h"

#include <gmock/gmock.h>

#include "core/tasks/task_work.h"
#include "tests/core/tasks/tasks_support.h"

namespace spindrift {
namespace {

using ::spindrift::testing::TaskSession;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(TaskOptions, AreReadAsTheyWereWritten) {
  ThermalChoice thermal;
  thermal.output = "z_um";
  thermal.test = TimeRange{600.0, 1200.0};
  thermal.inputs = {"spindle_degC", "room_degC"};
  const auto again = optionsFrom<ThermalChoice>(optionsJson(thermal));
  EXPECT_EQ(again.output, "z_um");
  EXPECT_FALSE(again.train.has_value());
  ASSERT_TRUE(again.test.has_value());
  EXPECT_EQ(again.test->to_s, 1200.0);
  EXPECT_EQ(again.inputs, thermal.inputs);
  EXPECT_EQ(optionsJson(thermal), nlohmann::json::parse(R"({"output": "z_um", "test": [600.0, 1200.0],
      "method": "response", "inputs": ["spindle_degC", "room_degC"]})"));

  CompensationTaskOptions compensation;
  compensation.choice.reference_mm = Eigen::Vector3d(1.0, 2.0, 3.0);
  compensation.source = CompensationSource::HigherOrder;
  compensation.fit.robust = RobustLoss::Tukey;
  const nlohmann::json json = optionsJson(compensation);
  EXPECT_EQ(json, nlohmann::json::parse(R"({"options": {"state": "", "positions": 11, "reference_mm": [1.0, 2.0, 3.0]},
      "source": "higher-order", "fit": {"state": "", "points": [], "robust": 2},
      "discrepancy": {"added": [], "rejected": []}})"));
  const auto read = optionsFrom<CompensationTaskOptions>(json);
  EXPECT_EQ(read.source, CompensationSource::HigherOrder);
  EXPECT_EQ(read.fit.robust, RobustLoss::Tukey);
  EXPECT_EQ(read.choice.reference_mm->z(), 3.0);
}

/// What versions before wrote down for each task where nothing had been chosen.
TEST(TaskOptions, ResultsOfEarlierVersionsHold) {
  TaskSession s;
  s.run("evaluate");
  s.run("fit");
  const std::map<std::string, std::string> then{
      {"evaluate", "{}"},
      {"check-jogs", R"({"part": 1.0})"},
      {"check-repeatability", R"({"part": 0.5})"},
      {"fit", R"({"model": "nine-parameter", "options": {}})"},
      {"thermal", R"({"model": "thermal", "options": {}})"},
      {"discrepancy", R"({"discrepancy": {"added": [], "rejected": []}})"},
      {"simulation", R"({"simulator": "", "version": "", "choice": {"rejected": []}})"},
      {"compensation", R"({"options": {}, "source": "nine-parameter", "fit": {},
                           "discrepancy": {"added": [], "rejected": []}})"},
      {"verify", R"({"options": {"goal_um": 5.0, "goal_urad": 0.0, "criterion": "largest", "after": ""}})"},
      {"report", R"({"operator": "", "tells_discrepancy": true, "notes": null,
                     "discrepancy": {"added": [], "rejected": []}, "fit": {}, "warm": null, "simulator": null})"}};
  for (const auto& [task, options] : then) {
    ResultOrigin origin = s.graph().origin(task);
    origin.options = nlohmann::json::parse(options);
    s.session_.keepResult(origin, nlohmann::json::object());
    EXPECT_THAT(s.status(task).changed, IsEmpty()) << task;
    origin.options["part"] = 0.7;
    const StoredResult other = s.session_.keepResult(origin, nlohmann::json::object()).value();
    EXPECT_EQ(s.graph().holds(other), !task.starts_with("check-")) << task << ": an option that is not of this task";
  }
}

TEST(TaskOptions, ChoosingWhatHoldsAnywayChangesNothing) {
  TaskSession s;
  s.run("evaluate");
  s.run("fit");
  s.option(option_keys::nine_parameters, {{"state", ""}, {"robust", 0}, {"points", nlohmann::json::array()}});
  EXPECT_TRUE(s.status("fit").current);
  s.option(option_keys::nine_parameters, {{"robust", 2}});
  EXPECT_THAT(s.status("fit").changed, ElementsAre("the options"));
}

/// A session can be damaged or written by another: nothing of that may stop the window or be taken for an option.
TEST(TaskOptions, OfADamagedSessionCountAsNotChosen) {
  TaskSession s;
  s.run("evaluate");
  for (const auto& task : {"fit", "compensation", "verify", "report"}) s.run(task);
  const nlohmann::json damage = nlohmann::json::parse(R"({"state": 5, "points": "F1", "robust": 99, "source": -3,
      "positions": "eleven", "reference_mm": [1, "2", 3], "goal_um": null, "goal_urad": [], "criterion": 4, "after": {},
      "added": [1], "rejected": "all", "effects": 3, "tells_discrepancy": "no", "method": 7, "train": [1]})");
  for (const char* key : {option_keys::nine_parameters, option_keys::compensation, option_keys::verify,
                          option_keys::report, option_keys::discrepancy, option_keys::thermal})
    s.option(key, damage);
  for (const auto& task : {"fit", "compensation", "report", "verify"})
    EXPECT_THAT(s.status(task).changed, IsEmpty()) << task;
  EXPECT_EQ(chosen<ThermalChoice>(s.session_, s.id_).method, "response");
  EXPECT_FALSE(chosen<CompensationChoice>(s.session_, s.id_).source.has_value());
}

/// Earlier versions kept options for all campaigns together: what is shown is what is run and compared.
TEST(TaskOptions, KeptForAllCampaignsStandWhereOneHasNoneOfItsOwn) {
  TaskSession s;
  s.session_.setSetting(option_keys::thermal, {{"method", "arx"}});
  EXPECT_EQ(s.graph().origin("thermal").options.at("options").at("method"), "arx");
  s.option(option_keys::thermal, {{"method", "oe"}});
  EXPECT_EQ(s.graph().origin("thermal").options.at("options").at("method"), "oe");
}

}  // namespace
}  // namespace spindrift
