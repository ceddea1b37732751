// SPDX-License-Identifier: GPL-3.0-or-later
// What the list of steps says of every demo, before anything is run, after everything was, and when something has
// changed since, held against what is stored.
#include <gmock/gmock.h>

#include <QTest>
#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "core/tasks/campaign_state.h"
#include "core/tasks/steps.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/pages/page.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {
namespace {

using ::testing::AnyOf;

class HonestSteps : public StoryTest, public ::testing::WithParamInterface<const char*> {
 protected:
  SessionModel& session() { return window_->session(); }

  /// As somebody sees the steps who opens what is on the disk: the command line does.
  std::map<StepId, StepReport> stepsOnDisk() {
    const Session& stored = *session().session();
    const CampaignState state = CampaignState::read(stored, session().campaignId());
    const TaskLedger nothing_runs;
    const TaskGraph graph = state.tasks(stored, nothing_runs);
    const CaptureCounts counts = CaptureCounts::of(graph);
    std::map<StepId, StepReport> all;
    for (const StepId step : all_steps) all[step] = stepReport(graph, step, counts);
    return all;
  }

  /// What the user has named is written as it was named.
  bool beginsWithAName(const std::string& sentence) {
    const std::vector<Artefact>& artefacts = session().campaign()->machine.artefacts;
    return std::any_of(artefacts.begin(), artefacts.end(),
                       [&](const Artefact& a) { return sentence.starts_with(a.id); });
  }

  /// What the stored result of a task complains about; nothing: it is as it should be.
  std::optional<std::string> complaint(const nlohmann::json& payload) {
    std::set<std::string> excluded;
    for (const Exclusion& e : session().session()->exclusions(session().campaignId())) excluded.insert(e.item);
    for (const nlohmann::json& capture : payload.value("captures", nlohmann::json::array()))
      if (!capture.value("good", true) && !excluded.contains(capture.value("image", ""))) return "a capture";
    for (const nlohmann::json& scan : payload.value("scans", nlohmann::json::array()))
      if (!scan.value("usable", true) || !scan.value("reason", "").empty()) return "a scan";
    if (payload.contains("touches") && payload["touches"].is_object())
      for (const char* state : {"rejected", "missing"})
        if (payload["touches"].value(state, 0) > 0) return "a touch";
    if (payload.contains("json") && !payload["json"].value("rejected", nlohmann::json::array()).empty())
      return "a rejected capture";
    if (payload.contains("json"))
      for (const EvaluationWarning& warning : warningsOfEvaluation(payload))
        if (warning.kind == WarningKind::Finding) return "a warning of the evaluation";
    if (!payload.value("good_enough", true)) return "not good enough";
    if (payload.value("rejected", nlohmann::json(false)) == true) return "rejected";
    if (payload.contains("status") && payload["status"] != "converged") return "status";
    if (payload.contains("settled") && payload["settled"] == false) return "not settled";
    if (payload.contains("result") && payload["result"].value("verdict", "") == "unknown") return "unknown";
    if (payload.contains("warnings") && !payload["warnings"].empty()) return "a warning";
    if (payload.contains("file") && !std::filesystem::exists(session().session()->folder() / payload.at("file")))
      return "the file is gone";
    const std::string verdict = payload.contains("verdict") ? payload.value("verdict", "") : "";
    if (verdict == "not met" || verdict == "cannot be decided") return verdict;
    return std::nullopt;
  }

  void expectHonest(const char* when) {
    SCOPED_TRACE(when);
    const std::map<StepId, StepReport> steps = stepsOnDisk();
    const TaskGraph graph = session().tasks();
    for (const StepId step : all_steps) {
      SCOPED_TRACE(toString(step));
      const StepReport& told = steps.at(step);
      const StepStatus& shown = window_->workflow().status(step);
      // What failed is known where it failed: nothing of it is stored.
      const std::string task = taskOfStep(graph, step);
      if (!task.empty() && graph.status(task).state == TaskState::Failed) {
        EXPECT_EQ(shown.state, StepState::Attention);
        continue;
      }
      EXPECT_EQ(shown.state, told.state) << shown.sentence.toStdString() << " / " << told.sentence;
      EXPECT_EQ(shown.sentence, coreSentence(told.sentence));
      EXPECT_FALSE(told.sentence.empty());
      const char first = told.sentence.front();
      EXPECT_TRUE(!(first >= 'a' && first <= 'z') || beginsWithAName(told.sentence)) << told.sentence;
      EXPECT_TRUE(told.sentence.ends_with('.')) << told.sentence;
      if (task.empty()) continue;
      const auto stored = session().session()->latestResult(session().campaignId(), task);
      const std::vector<std::string> tasks = graph.tasks();
      const bool there = std::find(tasks.begin(), tasks.end(), task) != tasks.end();
      if (!stored) {
        if (there) {
          EXPECT_NE(told.state, StepState::Current) << told.sentence;
        }
        EXPECT_NE(told.state, StepState::Outdated) << told.sentence;
        continue;
      }
      if (!graph.status(task).current) {
        EXPECT_THAT(told.state, AnyOf(StepState::Outdated, StepState::InProgress, StepState::Blocked)) << told.sentence;
        continue;
      }
      const std::optional<std::string> wrong = complaint(stored->payload);
      EXPECT_EQ(told.state == StepState::Current, !wrong) << told.sentence << " / " << wrong.value_or("nothing wrong");
    }
  }
};

TEST_P(HonestSteps, SayWhatIsStored) {
  window_->startDemo(QString::fromLatin1(GetParam()), true);
  ASSERT_TRUE(waitForJobs(*window_, 300));
  expectHonest("at the start");
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    wait();
    if (window_->workflow().status(step).state != StepState::Blocked) window_->currentPage()->runAll();
    ASSERT_TRUE(waitForJobs(*window_, 300)) << toString(step);
  }
  expectHonest("after everything was run");
  window_->undoStack().push(
      new ExcludeCommand(session(), {QStringLiteral("nothing/of/this")}, QStringLiteral("tried")));
  wait();
  expectHonest("when something has changed");
  window_->undoStack().undo();
  wait();
  expectHonest("taken back");
}

INSTANTIATE_TEST_SUITE_P(Demos, HonestSteps,
                         ::testing::Values("fiducials", "holes", "balls", "scans", "discrepancy", "own_pattern"),
                         [](const auto& of) { return std::string(of.param); });

TEST(HonestStepsDemos, EveryDemoIsAmongThem) {
  std::vector<std::string> names;
  for (const Demo& demo : demos()) names.push_back(demo.name);
  EXPECT_EQ(names, (std::vector<std::string>{"fiducials", "holes", "balls", "scans", "discrepancy", "own_pattern"}));
}

}  // namespace
}  // namespace spindrift::gui
