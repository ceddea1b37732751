// SPDX-License-Identifier: GPL-3.0-or-later
// A user who does anything in any order, also while work goes on: after every stretch what is shown is what is stored,
// what is called current is what would come out now, and undoing everything gives the first state.
//
// 40 actions in the suite. SPINDRIFT_WALK_ACTIONS and SPINDRIFT_WALK_SEED of the environment walk longer and elsewhere.
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <cmath>
#include <map>

#include "core/base/random.h"
#include "core/tasks/steps.h"
#include "core/tasks/task_options.h"
#include "core/workflows/compensation_workflow.h"
#include "tests/widgets/pages/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/compensate/compensate_page.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {
namespace {

class RandomWalk : public StoryTest {
 protected:
  SessionModel& session() { return window_->session(); }

  /// Everything that undo is answerable for, by campaign.
  nlohmann::json stateOf(std::int64_t campaign) {
    session().selectCampaign(campaign);
    const Session& store = *session().session();
    nlohmann::json state = store.inputs(campaign);
    for (const char* task : {"fit", "discrepancy", "compensation", "verify"})
      state[task] = session().tasks().origin(task).options;
    nlohmann::json reasons = nlohmann::json::array();
    for (const Exclusion& e : store.exclusions(campaign)) reasons.push_back(e.item + ": " + e.reason);
    state["reasons"] = reasons;
    state["robust"] = session().campaignSetting(option_keys::nine_parameters, nlohmann::json::object());
    return state;
  }

  void act(Random& random) {
    switch (random.index(11)) {
      case 0:
      case 1: {  // take a reading out, or back in
        const QString item = QStringLiteral("M%1/P%2/EZ").arg(1 + random.index(5)).arg(1 + random.index(6));
        const bool out = session().excluded().contains(item);
        window_->undoStack().push(new ExcludeCommand(session(), {item}, out ? QString() : QStringLiteral("disturbed")));
        what_ = "exclude " + item.toStdString();
        break;
      }
      case 2: {  // another option of the model
        const int robust = static_cast<int>(random.index(2));
        window_->undoStack().push(new OptionsCommand(session(), QStringLiteral("loss"),
                                                     session().campaignKey(option_keys::nine_parameters),
                                                     {{"robust", robust}}, [this] { window_->workflow().refresh(); }));
        what_ = "robust";
        break;
      }
      case 3: {  // another machine
        nlohmann::json machine = session().campaign()->machine.source;
        machine["name"] = "machine " + std::to_string(random.index(3));
        window_->undoStack().push(new MachineCommand(session(), machine));
        what_ = "machine";
        break;
      }
      case 4:
      case 5: {  // the main button of a page
        const StepId steps[] = {StepId::Model, StepId::Compensate, StepId::Model, StepId::Report};
        window_->workflow().goTo(steps[random.index(4)]);
        QPushButton* button = window_->currentPage()->primaryButton();
        if (button != nullptr && button->isEnabled()) QTest::mouseClick(button, Qt::LeftButton);
        what_ = "press on " + stepTitle(window_->workflow().current()).toStdString();
        break;
      }
      case 6:
        window_->undoStack().undo();
        what_ = "undo";
        break;
      case 7:
        window_->undoStack().redo();
        what_ = "redo";
        break;
      case 8: {  // another campaign, in the middle of whatever goes on
        const auto all = session().campaigns();
        session().selectCampaign(all[random.index(all.size())].id);
        what_ = "campaign";
        break;
      }
      case 9: {
        window_->workflow().goTo(all_steps[random.index(all_steps.size())]);
        what_ = "go";
        break;
      }
      default:  // let some of it happen
        QTest::qWait(static_cast<int>(random.index(40)));
        what_ = "wait";
    }
    if (random.index(3) == 0) QTest::qWait(1);
  }

  void check() {
    wait();
    QTest::qWait(5);
    const TaskGraph tasks = session().tasks();
    // The list of steps says what the tasks say.
    const CaptureCounts counts = CaptureCounts::of(tasks);
    for (const StepId step : all_steps) {
      const StepReport report = stepReport(tasks, step, counts);
      EXPECT_EQ(window_->workflow().status(step).state, report.state) << toString(step);
      EXPECT_EQ(window_->stepList()->button(step)->accessibleDescription().toStdString(), report.sentence);
    }
    // What is called current is what comes out now, worked out without the graph.
    const auto set = session().observations();
    ASSERT_TRUE(set);
    const NineParameterOptions options =
        nineParameterOptions(session().campaignSetting(option_keys::nine_parameters, nlohmann::json::object()));
    if (tasks.status("fit").current) {
      ++current_fits_;
      const NineParameterFit now = fitNineParameters(*set, options);
      const nlohmann::json stored = session().latest("fit")->payload.at("parameters");
      for (int i = 0; i < nine_parameter_count; ++i) {
        const nlohmann::json& value =
            stored.at(std::string(nine_parameter_names[static_cast<std::size_t>(i)])).at("value");
        if (value.is_null()) continue;
        EXPECT_NEAR(value.get<double>(), now.parameters[i], 1e-9 + 1e-9 * std::abs(now.parameters[i]));
      }
    }
    if (tasks.status("compensation").current) {
      ++current_plans_;
      JobContext job;
      const CompensationRequest request = compensationRequest(*session().session(), session().campaignId(), true);
      const nlohmann::json now = planCompensation(*session().campaign(), *set, request, job).json();
      const nlohmann::json& stored = session().latest("compensation")->payload;
      EXPECT_EQ(now.at("rms_after_um"), stored.at("rms_after_um"));
      EXPECT_EQ(now.at("rms_before_um"), stored.at("rms_before_um"));
      // What is shown is what is stored.
      if (auto* page = qobject_cast<CompensatePage*>(window_->currentPage());
          page != nullptr && page->plan() != nullptr) {
        EXPECT_EQ(page->plan()->json().at("rms_after_um"), stored.at("rms_after_um"));
      }
    }
    // A report that is called current was written from results and exclusions as they are.
    if (const TaskStatus report = tasks.status("report"); report.current) {
      ++current_reports_;
      const nlohmann::json& inputs = session().latest("report")->provenance.inputs;
      EXPECT_EQ(inputs.at("exclusions").size(), session().excluded().size());
      const StoredResult* plan = session().latest("compensation");
      EXPECT_EQ(inputs.at("compensation"), plan == nullptr ? "" : plan->provenance.inputs_fingerprint);
    }
    EXPECT_FALSE(window_->jobs().busy());
  }

  std::string what_;
  int current_fits_ = 0;
  int current_plans_ = 0;
  int current_reports_ = 0;
};

TEST_F(RandomWalk, KeepsItsPromises) {
  const int actions = qEnvironmentVariableIntValue("SPINDRIFT_WALK_ACTIONS") > 0
                          ? qEnvironmentVariableIntValue("SPINDRIFT_WALK_ACTIONS")
                          : 40;
  Random random(static_cast<std::uint64_t>(17 + qEnvironmentVariableIntValue("SPINDRIFT_WALK_SEED")));
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth, true, {6, 60}), StepId::Model);
  const std::filesystem::path other = folder_ / "other";
  std::filesystem::copy(session().campaign()->folder, other, std::filesystem::copy_options::recursive);
  (void)folder_.write("other/note.txt", "so that its content is another");
  window_->addCampaign(QString::fromStdString(other.string()));
  wait();
  ASSERT_EQ(session().campaigns().size(), 2U);
  std::map<std::int64_t, nlohmann::json> first;
  for (const CampaignRecord& record : session().campaigns()) first[record.id] = stateOf(record.id);

  std::string trace;
  for (int i = 0; i < actions; ++i) {
    act(random);
    trace += (i > 0 ? ", " : "") + what_;
    if (i % 5 != 4) continue;
    check();
    if (HasFailure()) break;
  }
  EXPECT_FALSE(HasFailure()) << "after: " << trace;
  // Otherwise nothing would have been looked at.
  EXPECT_GT(current_fits_ + current_plans_ + current_reports_, 0);
  RecordProperty("current_fits", current_fits_);
  RecordProperty("current_plans", current_plans_);
  RecordProperty("current_reports", current_reports_);

  for (const auto& [campaign, state] : first) {
    session().selectCampaign(campaign);
    wait();
    while (window_->undoStack().canUndo()) window_->undoStack().undo();
    wait();
    EXPECT_EQ(stateOf(campaign), state) << "after: " << trace;
  }
}

}  // namespace
}  // namespace spindrift::gui
