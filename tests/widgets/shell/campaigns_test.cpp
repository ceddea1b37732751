// SPDX-License-Identifier: GPL-3.0-or-later
// Two campaigns in one session: what was worked out, changed or taken back for one never ends up in the other.
#include <gmock/gmock.h>

#include <QAction>
#include <QApplication>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTableView>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <atomic>
#include <set>
#include <thread>

#include "core/base/text.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/observation.h"
#include "tests/widgets/support/select_campaign.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/compensate/compensate_page.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/page.h"
#include "widgets/shell/command_palette.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/tour.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

const QString reading = QStringLiteral("M3/P2/EZ");

class CampaignsTest : public StoryTest {
 protected:
  /// Opens both; the first is at hand.
  void openTwo() {
    open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Discrepancy);
    first_ = session().campaignId();
    const std::filesystem::path other = folder_ / "other";
    std::filesystem::copy(session().campaign()->folder, other, std::filesystem::copy_options::recursive);
    (void)folder_.write("other/note.txt", "so that its content is another");
    window_->addCampaign(QString::fromStdString(other.string()));
    wait();
    second_ = session().campaignId();
    ASSERT_NE(first_, second_);
    ASSERT_EQ(session().campaigns().size(), 2U);
    select(first_);
  }
  void select(std::int64_t campaign) {
    selectCampaign(session(), campaign);
    QTest::qWait(1);
  }
  SessionModel& session() { return window_->session(); }
  void run(StepId step) {
    window_->workflow().goTo(step);
    wait();
    window_->currentPage()->runAll();
    wait();
  }
  [[nodiscard]] std::vector<std::string> kinds(std::int64_t campaign) {
    std::vector<std::string> all;
    for (const StoredResult& r : session().session()->results(campaign)) all.push_back(r.kind);
    return all;
  }
  [[nodiscard]] QStringList running() {
    QStringList titles;
    for (const JobEntry& job : window_->jobs().entries()) titles << job.title;
    return titles;
  }
  /// Numbers of the jobs that read the fit, as long as `here` lives.
  void collectReadings(QObject* here, std::set<int>& begun) {
    QObject::connect(&window_->jobs(), &JobRunner::changed, here, [this, &begun] {
      for (const JobEntry& job : window_->jobs().entries())
        if (job.title == QLatin1String("Reading the fit")) begun.insert(job.id);
    });
  }
  [[nodiscard]] bool said(const QString& text) {
    const auto& messages = window_->jobBar()->log().messages();
    return std::any_of(messages.begin(), messages.end(), [&](const Message& m) { return m.text.contains(text); });
  }
  /// A command as the list of commands has it.
  [[nodiscard]] Command command(const char* title) {
    for (Command& c : window_->commands())
      if (c.title == QLatin1String(title)) return c;
    ADD_FAILURE() << "no command " << title;
    return {};
  }
  [[nodiscard]] QString whyNot(const char* title) { return command(title).why_not; }
  void trigger(const char* title) { command(title).run(); }
  /// The pages of the models of the campaign at hand show what is stored for it.
  void expectShownIsStored(const char* when) {
    SCOPED_TRACE(when);
    window_->workflow().goTo(StepId::Model);
    wait();
    const RowsModel* shown = nullptr;
    for (const auto* table : window_->currentPage()->findChildren<QTableView*>())
      if (table->accessibleName() == QLatin1String("Parameters"))
        shown = qobject_cast<const RowsModel*>(table->model());
    ASSERT_NE(shown, nullptr);
    ASSERT_GE(shown->rowCount(), nine_parameter_count);
    const nlohmann::json& fit = session().latest("fit")->payload.at("parameters");
    for (std::size_t i = 0; i < nine_parameter_count; ++i) {
      const nlohmann::json& stored = fit.at(std::string(nine_parameter_names[i]));
      if (stored.at("value").is_null()) continue;
      const std::string text = withUncertainty(stored.at("value"), stored.at("standard_uncertainty"),
                                               nineParameterUnit(static_cast<int>(i)));
      EXPECT_EQ(shown->rows()[i].cells[1].text, shownNumbers(fromCore(text))) << nine_parameter_names[i];
    }
    window_->workflow().goTo(StepId::Compensate);
    wait();
    auto* compensate = page<CompensatePage>();
    ASSERT_NE(compensate, nullptr);
    ASSERT_NE(compensate->plan(), nullptr);
    EXPECT_EQ(compensate->plan()->json(), session().latest("compensation")->payload);
  }
  [[nodiscard]] QAction* action(const char* title) {
    for (QAction* a : window_->findChildren<QAction*>())
      if (a->text().remove(QLatin1Char('&')) == QLatin1String(title)) return a;
    return nullptr;
  }

  std::int64_t first_ = 0;
  std::int64_t second_ = 0;
};

TEST_F(CampaignsTest, AResultIsFiledUnderTheCampaignItWasStartedFor) {
  openTwo();
  const PendingResult pending = session().begin("fit", {{"seed", "test"}});
  EXPECT_TRUE(session().atHand(pending));
  select(second_);
  EXPECT_FALSE(session().atHand(pending));
  EXPECT_FALSE(session().finish(pending, {{"value", 1}})) << "nothing for the page at hand to show";
  EXPECT_FALSE(session().state("fit").there) << "of the second campaign";
  select(first_);
  ASSERT_TRUE(session().state("fit").there);
  EXPECT_TRUE(session().state("fit").current);
  EXPECT_EQ(session().latest("fit")->payload.at("value"), 1);
  EXPECT_EQ(session().latest("fit")->provenance.options.at("seed"), "test");
}

TEST_F(CampaignsTest, WhatChangesWhileAResultIsWorkedOutMakesItOutdated) {
  openTwo();
  const PendingResult pending = session().begin("fit");
  window_->undoStack().push(new ExcludeCommand(session(), {reading}, QStringLiteral("disturbed")));
  EXPECT_TRUE(session().finish(pending, {{"value", 1}}));
  EXPECT_TRUE(session().state("fit").there);
  EXPECT_FALSE(session().state("fit").current) << "it was made from all readings";
  window_->undoStack().undo();
  EXPECT_TRUE(session().state("fit").current);
}

TEST_F(CampaignsTest, AnotherSessionGetsNothingOfWhatWasStartedBefore) {
  openTwo();
  const PendingResult pending = session().begin("fit");
  const QString folder = QString::fromStdString(session().folder().string());
  window_->closeSession();
  EXPECT_FALSE(session().finish(pending, {{"value", 1}}));
  window_->open(folder);
  wait();
  EXPECT_FALSE(session().finish(pending, {{"value", 1}})) << "opened again: what was given up stays given up";
  EXPECT_FALSE(session().state("fit").there);
}

TEST_F(CampaignsTest, ACampaignThatIsGoneTakesNoResult) {
  openTwo();
  const PendingResult pending = session().begin("fit");
  select(second_);
  session().session()->removeCampaign(first_);
  EXPECT_FALSE(session().finish(pending, {{"value", 1}}));
  EXPECT_TRUE(session().session()->results(second_).empty());
}

TEST_F(CampaignsTest, ChoosingAnotherCampaignInTheMiddleOfAJobLosesAndMixesNothing) {
  openTwo();
  // Every step whose page works something out for this campaign.
  int started = 0;
  for (const StepId step : {StepId::Model, StepId::Discrepancy, StepId::Compensate, StepId::Report}) {
    select(first_);
    wait();
    window_->workflow().goTo(step);
    wait();
    const std::size_t before = session().session()->results(first_).size();
    window_->currentPage()->runAll();
    if (!window_->jobs().busy()) continue;
    ++started;
    select(second_);
    wait();
    EXPECT_TRUE(session().session()->results(second_).empty()) << stepTitle(step).toStdString();
    EXPECT_GT(session().session()->results(first_).size(), before) << stepTitle(step).toStdString() << " was lost";
    select(first_);
    wait();
    for (const StoredResult& r : session().session()->results(first_))
      EXPECT_TRUE(session().session()->isCurrent(r)) << r.kind;
  }
  EXPECT_GE(started, 3);
}

TEST_F(CampaignsTest, WhatIsNeededFirstIsFiledAndTheRestIsNotBegunWhenAnotherCampaignIsChosen) {
  openTwo();
  window_->workflow().goTo(StepId::Compensate);
  wait();
  window_->currentPage()->runAll();
  ASSERT_TRUE(window_->jobs().busy());
  EXPECT_EQ(running(), (QStringList{QStringLiteral("Fitting the nine-parameter model")})) << "needed first";
  select(second_);
  wait();
  EXPECT_EQ(kinds(first_), (std::vector<std::string>{"fit"})) << "filed where it belongs; nothing was run after it";
  EXPECT_THAT(kinds(second_), ::testing::IsEmpty());
  EXPECT_TRUE(said(QStringLiteral("Calculating the compensation: stopped, because another campaign was chosen")));
  // And without another campaign it is run.
  select(first_);
  window_->currentPage()->runAll();
  wait();
  EXPECT_EQ(kinds(first_), (std::vector<std::string>{"fit", "compensation"}));
}

// The compensation has a fit made first; that fit is asked for by itself meanwhile. Neither is given up.
TEST_F(CampaignsTest, AskingForOneTaskStopsNoOtherThatNeedsIt) {
  openTwo();
  window_->workflow().goTo(StepId::Compensate);
  wait();
  window_->currentPage()->runAll();
  ASSERT_TRUE(window_->jobs().busy());
  window_->workflow().goTo(StepId::Model);
  window_->currentPage()->runAll();
  wait();
  EXPECT_TRUE(QTest::qWaitFor([&] { return kinds(first_).size() == 2; }, 60000));
  EXPECT_EQ(kinds(first_), (std::vector<std::string>{"fit", "compensation"}));
  EXPECT_TRUE(session().tasks().status("compensation").current);
}

TEST_F(CampaignsTest, WhatIsOutdatedIsRunAsOne) {
  openTwo();
  EXPECT_FALSE(whyNot("Run what is outdated").isEmpty()) << "nothing was run yet";
  run(StepId::Model);
  run(StepId::Discrepancy);
  run(StepId::Compensate);
  run(StepId::Report);
  const std::vector<std::string> once{"fit", "discrepancy", "compensation", "report"};
  ASSERT_EQ(kinds(first_), once);
  EXPECT_FALSE(whyNot("Run what is outdated").isEmpty()) << "all of it holds";
  trigger("Run what is outdated");
  wait();
  EXPECT_TRUE(said(QStringLiteral("Nothing that was calculated is outdated"))) << "a command is never silent";
  EXPECT_EQ(kinds(first_), once);

  window_->undoStack().push(new ExcludeCommand(session(), {reading}, QStringLiteral("disturbed")));
  for (const std::string& task : once) EXPECT_FALSE(session().state(task).current) << task;
  EXPECT_TRUE(whyNot("Run what is outdated").isEmpty());
  window_->workflow().goTo(StepId::Discrepancy);
  wait();
  trigger("Run what is outdated");
  EXPECT_TRUE(window_->jobs().busy());
  wait();
  std::vector<std::string> twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_EQ(kinds(first_), twice) << "each once, in the order in which they are made from each other";
  for (const StoredResult& r : session().session()->results(first_)) {
    const bool newest = r.id == session().session()->latestResult(first_, r.kind)->id;
    EXPECT_EQ(r.provenance.inputs.at("exclusions").size(), newest ? 1U : 0U) << r.kind;
  }
  for (const std::string& task : once) EXPECT_TRUE(session().state(task).current) << task;
  auto* shown = page<DiscrepancyPage>();
  ASSERT_NE(shown, nullptr);
  ASSERT_NE(shown->story(), nullptr);
  EXPECT_EQ(shown->story()->json(), session().latest("discrepancy")->payload) << "the page at hand shows what was run";
  EXPECT_TRUE(said(QStringLiteral("all results are current")));
  EXPECT_THAT(kinds(second_), ::testing::IsEmpty());
  for (const StepId step : {StepId::Model, StepId::Compensate, StepId::Report})
    EXPECT_NE(window_->workflow().status(step).state, StepState::Outdated) << stepTitle(step).toStdString();
  // It stands beside the steps as well.
  EXPECT_EQ(window_->stepList()->contextMenuPolicy(), Qt::ActionsContextMenu);
  EXPECT_TRUE(window_->stepList()->actions().contains(action("Run what is outdated")));
  EXPECT_TRUE(window_->stepList()->actions().contains(action("Run all steps")));
}

TEST_F(CampaignsTest, RunningWhatIsOutdatedStopsWhenItIsCancelledOrAnotherCampaignIsChosen) {
  openTwo();
  run(StepId::Model);
  run(StepId::Compensate);
  window_->undoStack().push(new ExcludeCommand(session(), {reading}, QStringLiteral("disturbed")));
  const std::vector<std::string> before = kinds(first_);
  trigger("Run what is outdated");
  window_->jobs().cancel();
  wait();
  EXPECT_EQ(kinds(first_), before);
  EXPECT_FALSE(session().state("fit").current);
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Outdated) << "not running, not failed";
  trigger("Run what is outdated");
  select(second_);
  wait();
  EXPECT_THAT(kinds(second_), ::testing::IsEmpty());
  EXPECT_EQ(kinds(first_).size(), before.size() + 1) << "the one that ran is filed";
  EXPECT_TRUE(said(QStringLiteral("Running what is outdated: stopped, because another campaign was chosen")));
  select(first_);
  wait();
  EXPECT_TRUE(session().state("fit").current);
  EXPECT_FALSE(session().state("compensation").current);
  trigger("Run what is outdated");
  wait();
  EXPECT_TRUE(session().state("compensation").current);
}

TEST_F(CampaignsTest, WhatIsShownIsWhatIsStoredWhoeverRanIt) {
  openTwo();
  run(StepId::Model);
  run(StepId::Compensate);
  expectShownIsStored("run by the page");
  select(second_);
  window_->undoStack().push(new ExcludeCommand(session(), {QStringLiteral("M0/P2/EZ")}, QStringLiteral("disturbed")));
  run(StepId::Model);
  run(StepId::Compensate);
  expectShownIsStored("of the other campaign");
  select(first_);
  expectShownIsStored("the first campaign again");
  select(second_);
  expectShownIsStored("the other campaign again");
  for (const char* item : {"M0/P1/EZ", "M0/P4/EX"}) {
    window_->undoStack().push(new ExcludeCommand(session(), {QLatin1String(item)}, QStringLiteral("disturbed")));
    trigger("Run what is outdated");
    wait();
    expectShownIsStored("run from elsewhere");
  }
}

TEST_F(CampaignsTest, AFitThatIsStoredIsWorkedOutAgainBesideTheWindow) {
  openTwo();
  run(StepId::Model);
  const QString folder = QString::fromStdString(session().folder().string());
  window_->workflow().goTo(StepId::Report);
  wait();
  window_->closeSession();
  window_->open(folder);
  wait();
  QStringList begun;
  QObject here;
  QObject::connect(&window_->jobs(), &JobRunner::changed, &here, [&] { begun << running(); });
  window_->workflow().goTo(StepId::Model);
  (void)window_->currentPage();
  wait();
  EXPECT_TRUE(begun.contains(QStringLiteral("Reading the fit"))) << begun.join(", ").toStdString();
}

TEST_F(CampaignsTest, AFitWithTheOptionsOfAnEarlierVersionIsWorkedOutAgainOnce) {
  openTwo();
  run(StepId::Model);
  PendingResult earlier = session().begin("fit");
  for (auto it = earlier.origin.options.begin(); it != earlier.origin.options.end();)
    it = it.key() == "model" ? std::next(it) : earlier.origin.options.erase(it);
  window_->workflow().goTo(StepId::Report);
  wait();
  session().finish(earlier, session().latest("fit")->payload);
  ASSERT_TRUE(session().state("fit").current) << "it wrote less";
  const QString folder = QString::fromStdString(session().folder().string());
  window_->closeSession();
  window_->open(folder);
  wait();
  // By the number of the job: `started` tells of one again when another that was shown has ended.
  std::set<int> begun;
  QObject here;
  collectReadings(&here, begun);
  window_->workflow().goTo(StepId::Model);
  (void)window_->currentPage();
  QTest::qWait(500);
  wait();
  EXPECT_EQ(begun.size(), 1U);
}

TEST_F(CampaignsTest, WhatIsBeingReadIsNotBegunOnceMoreByARefresh) {
  openTwo();
  run(StepId::Model);
  const QString folder = QString::fromStdString(session().folder().string());
  window_->workflow().goTo(StepId::Report);
  wait();
  window_->closeSession();
  window_->open(folder);
  wait();
  std::set<int> begun;
  QObject here;
  collectReadings(&here, begun);
  window_->workflow().goTo(StepId::Model);
  for (int i = 0; i < 3; ++i) window_->currentPage()->refresh();
  EXPECT_EQ(begun.size(), 1U);
  wait();
  window_->currentPage()->refresh();
  wait();
  EXPECT_EQ(begun.size(), 1U) << "and what was read is kept";
}

TEST_F(CampaignsTest, AFileThatWasChangedWhileTheSessionWasClosedIsSaidAndItsResultsAreOutdated) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Model);
  run(StepId::Model);
  ASSERT_TRUE(session().state("fit").current);
  const QString folder = QString::fromStdString(session().folder().string());
  const std::filesystem::path file = session().campaign()->folder / "observations.csv";
  window_->closeSession();
  ObservationSet set = ObservationSet::read(file);
  set.rows.front().value += 5.0;
  set.write(file);
  window_->open(folder);
  wait();
  EXPECT_TRUE(said(QStringLiteral("observations.csv")));
  EXPECT_FALSE(session().state("fit").current);
  EXPECT_EQ(session().state("fit").changed, QStringLiteral("files of the campaign"));
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Outdated);
}

TEST_F(CampaignsTest, AnImportEndsNoWorkThatWasBegunMeanwhile) {
  openTwo();
  const std::int64_t number = session().sessionNumber();
  window_->open(QString::fromStdString((folder_ / "other").string()));
  bool done = false, cancelled = false;
  Job job;
  job.title = QStringLiteral("Begun meanwhile");
  job.work = [&done](JobContext&) -> std::function<void()> { return [&done] { done = true; }; };
  job.cancelled = [&cancelled] { cancelled = true; };
  window_->jobs().run(std::move(job));
  wait();
  EXPECT_TRUE(done);
  EXPECT_FALSE(cancelled);
  EXPECT_EQ(session().sessionNumber(), number);
  const QStringList recent = QSettings().value(QStringLiteral("recent")).toStringList();
  ASSERT_FALSE(recent.isEmpty());
  EXPECT_TRUE(Session::isSession(recent.front().toStdString()));
  EXPECT_NE(recent.front().toStdString(), session().folder().string()) << "to be opened when the work is done";
  sessions_.emplace_back(recent.front().toStdString());
}

TEST_F(CampaignsTest, LeavingTheSessionAsksWhileWorkRuns) {
  openTwo();
  std::atomic<bool> go_on{false};
  Job job;
  job.title = QStringLiteral("Long work");
  job.work = [&go_on](JobContext& context) -> std::function<void()> {
    while (!go_on && !context.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return [] {};
  };
  window_->jobs().run(std::move(job));
  QString asked;
  const auto answer = [&asked](bool leave) {
    asked.clear();
    QTimer::singleShot(50, qApp, [&asked, leave] {
      auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (question == nullptr) return;
      asked = question->text();
      for (QAbstractButton* button : question->buttons())
        if ((question->buttonRole(button) == QMessageBox::DestructiveRole) == leave) button->click();
    });
  };
  const std::int64_t number = session().sessionNumber();
  for (const char* way : {"First screen", "Pinhole targets of a microscope"}) {
    QAction* leaving = action(way);
    if (leaving == nullptr) continue;
    answer(false);
    leaving->trigger();
    EXPECT_TRUE(asked.contains(QStringLiteral("Long work"))) << way;
    EXPECT_EQ(session().sessionNumber(), number) << way;
    EXPECT_TRUE(window_->jobs().working()) << way;
  }
  answer(false);
  EXPECT_FALSE(window_->close());
  EXPECT_TRUE(asked.contains(QStringLiteral("Long work")));
  answer(true);
  action("First screen")->trigger();
  EXPECT_FALSE(session().isOpen());
  wait();
  // A batch is of no session and loses nothing when it ends: it is resumed (PlantPageTest).
  Job batch;
  batch.title = QStringLiteral("A batch");
  batch.queue = JobQueue::Batch;
  batch.work = [&go_on](JobContext& context) -> std::function<void()> {
    while (!go_on && !context.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return [] {};
  };
  window_->jobs().run(std::move(batch));
  asked.clear();
  EXPECT_TRUE(window_->close());
  EXPECT_TRUE(asked.isEmpty()) << asked.toStdString();
  go_on = true;
  wait();
}

TEST_F(CampaignsTest, UndoBelongsToTheCampaignItWasDoneOn) {
  openTwo();
  window_->undoStack().push(new ExcludeCommand(session(), {reading}, QStringLiteral("disturbed")));
  nlohmann::json machine = session().campaign()->machine.source;
  machine["name"] = "changed";
  window_->undoStack().push(new MachineCommand(session(), machine));
  ASSERT_EQ(window_->undoStack().count(), 2);
  select(second_);
  EXPECT_EQ(window_->undoStack().count(), 0);
  EXPECT_FALSE(window_->undoStack().canUndo());
  window_->undoStack().push(new ExcludeCommand(session(), {reading}, QStringLiteral("of the second")));
  select(first_);
  ASSERT_EQ(window_->undoStack().count(), 2) << "what was done before is still there";
  EXPECT_EQ(session().campaign()->machine.name, "changed");
  window_->undoStack().undo();
  window_->undoStack().undo();
  EXPECT_NE(session().campaign()->machine.name, "changed");
  EXPECT_TRUE(session().excluded().empty());
  EXPECT_FALSE(window_->undoStack().canUndo());
  select(second_);
  EXPECT_TRUE(session().excluded().contains(reading)) << "the undo of the first left it alone";
  EXPECT_FALSE(session().machineEdited());
  // Adding a campaign chooses it; the changes of the one before must not be taken back on it.
  window_->undoStack().push(new MachineCommand(session(), machine));
  const std::filesystem::path third = folder_ / "third";
  std::filesystem::copy(session().campaign()->folder, third, std::filesystem::copy_options::recursive);
  (void)folder_.write("third/note.txt", "the third");
  window_->addCampaign(QString::fromStdString(third.string()));
  wait();
  ASSERT_NE(session().campaignId(), second_);
  EXPECT_FALSE(window_->undoStack().canUndo());
}

TEST_F(CampaignsTest, OptionsOfTheModelBelongToTheCampaign) {
  openTwo();
  session().setSetting("nine-parameter", {{"state", "M5"}});  // as earlier versions kept them
  EXPECT_EQ(session().campaignSetting("nine-parameter", nullptr).at("state"), "M5");
  session().setSetting(session().campaignKey("nine-parameter"), {{"state", "M7"}});
  EXPECT_EQ(session().campaignSetting("nine-parameter", nullptr).at("state"), "M7");
  select(second_);
  EXPECT_EQ(session().campaignSetting("nine-parameter", nullptr).at("state"), "M5");
}

}  // namespace
}  // namespace spindrift::gui
