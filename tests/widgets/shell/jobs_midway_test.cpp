// SPDX-License-Identifier: GPL-3.0-or-later
// In the middle of every job of a page the user changes something: a result is filed under the campaign that it was
// started for, as made from what it was started with, and nothing of it appears on the page of another campaign.
//
// "In the middle" is exact: what a job gives is taken over by the event loop, which does not run between the start of
// the job and the change.
#include <gmock/gmock.h>

#include <QAbstractButton>
#include <QAbstractItemModel>
#include <QComboBox>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QTableView>
#include <QTest>
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/machine/observation.h"
#include "core/tasks/task_options.h"
#include "tests/support/source_folder.h"
#include "tests/widgets/support/select_campaign.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/machine/machine_page.h"
#include "widgets/pages/page.h"
#include "widgets/pages/probing/touch_capture_page.h"
#include "widgets/pages/report/report_page.h"
#include "widgets/pages/thermal/thermal_model_page.h"
#include "widgets/pages/thermal/warm_up_page.h"
#include "widgets/pages/verify/verify_page.h"
#include "widgets/panels/discrepancy/simulation_panel.h"
#include "widgets/panels/thermal/clock_panel.h"
#include "widgets/panels/thermal/resolution_check_panel.h"
#include "widgets/panels/thermal/update_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {
namespace {

/// What a job needs to be started, beyond its page.
enum class Start {
  RunAll,     ///< the page's own action
  Show,       ///< the campaign is chosen again: what the page shows beside stored results is worked out
  Suggest,    ///< measuring points
  Programme,  ///< of the measuring cycle
  Clock,      ///< its offset from a motion
  Updates,    ///< of the model over time
  Simulator,  ///< the search with it
  Jogs,
  Repeatability,
  SaveReport,  ///< a copy of the report
};

struct Case {
  const char* demo;
  StepId step;
  const char* title;      ///< of the job, as in the source of the page
  const char* kind = "";  ///< of the result it leaves; empty: none
  Start start = Start::RunAll;
  const char* option = "";  ///< key of an option that the result depends on; empty: none
  bool over_time = false;   ///< the step Model shows the model over time
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.demo << "/" << toString(c.step) << "/" << c.title;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"fiducials", StepId::Machine, "Choosing measuring points", "", Start::Suggest},
      {"fiducials", StepId::Capture, "Checking the captures", "check"},
      {"fiducials", StepId::Calibrate, "Evaluating the captures", "evaluate"},
      {"fiducials", StepId::Model, "Fitting the nine-parameter model", "fit", Start::RunAll,
       option_keys::nine_parameters},
      {"fiducials", StepId::Model, "Reading the points", "", Start::Show},
      {"fiducials", StepId::WarmUp, "Checking whether the instrument had settled", "check-warm-up"},
      {"fiducials", StepId::WarmUp, "Checking the jogs", "check-jogs", Start::Jogs},
      {"fiducials", StepId::WarmUp, "Checking the repeatability", "check-repeatability", Start::Repeatability},
      {"fiducials", StepId::Compensate, "Calculating the compensation", "compensation", Start::RunAll,
       option_keys::compensation},
      {"fiducials", StepId::Compensate, "Reading the compensation", "", Start::Show},
      {"fiducials", StepId::Review, "Comparing states", "", Start::Show},
      {"fiducials", StepId::Report, "Writing the report", "report", Start::RunAll, option_keys::report},
      {"fiducials", StepId::Report, "Saving the report", "", Start::SaveReport},
      {"holes", StepId::Capture, "Checking the touches", "check"},
      {"holes", StepId::Capture, "Reading the touches", "", Start::Show},
      {"holes", StepId::Capture, "Planning the measuring cycle", "", Start::Programme},
      {"holes", StepId::Calibrate, "Evaluating the touches", "evaluate"},
      {"holes", StepId::Calibrate, "Reading the evaluation", "", Start::Show},
      {"holes", StepId::Model, "Fitting all cycles", "fit", Start::RunAll, option_keys::cycles},
      {"holes", StepId::Model, "Reading the cycles", "", Start::Show},
      {"scans", StepId::Capture, "Checking the scans", "check"},
      {"scans", StepId::Calibrate, "Evaluating the scans", "evaluate"},
      {"scans", StepId::Model, "Finding the six errors", "fit", Start::RunAll, option_keys::scan_model},
      {"holes", StepId::Model, "Reading the log", "", Start::Show, "", true},
      {"holes", StepId::Model, "Identifying the model", "thermal", Start::RunAll, option_keys::thermal, true},
      {"holes", StepId::Model, "Running the updates", "", Start::Updates, "", true},
      {"story", StepId::WarmUp, "Estimating the offset of a clock", "", Start::Clock},
      {"story", StepId::Discrepancy, "Searching for what the simulation lacks", "discrepancy", Start::RunAll,
       option_keys::discrepancy},
      {"story", StepId::Discrepancy, "Searching with the simulator", "simulation", Start::Simulator},
      {"story", StepId::Verify, "Comparing before and after", "verify", Start::RunAll, option_keys::verify},
      {"story", StepId::Verify, "Reading the comparison", "", Start::Show},
      {"story", StepId::Report, "Writing the report", "report", Start::RunAll, option_keys::report},
  };
  return all;
}

/// Everything that is to be read on a page, in order.
QStringList readOn(const QWidget& page) {
  QStringList out;
  for (const QWidget* w : page.findChildren<QWidget*>()) {
    if (!w->isVisibleTo(&page)) continue;
    if (const auto* label = qobject_cast<const QLabel*>(w)) out << QStringLiteral("label: ") + label->text();
    if (const auto* line = qobject_cast<const QLineEdit*>(w)) out << QStringLiteral("line: ") + line->text();
    if (const auto* button = qobject_cast<const QAbstractButton*>(w))
      out << QStringLiteral("button: %1 %2").arg(button->text()).arg(button->isEnabled());
    if (const auto* combo = qobject_cast<const QComboBox*>(w))
      out << QStringLiteral("choice: %1 of %2").arg(combo->currentText()).arg(combo->count());
    if (const auto* plot = qobject_cast<const Plot*>(w)) {
      for (const Series& series : plot->series()) {
        double sum = 0.0;
        for (const double y : series.y) sum += y;
        out << QStringLiteral("curve: %1, %2 values, sum %3").arg(series.name).arg(series.y.size()).arg(sum);
      }
    }
    if (const auto* table = qobject_cast<const QTableView*>(w)) {
      const QAbstractItemModel* model = table->model();
      for (int row = 0; row < model->rowCount(); ++row) {
        QStringList cells;
        for (int c = 0; c < model->columnCount(); ++c) cells << model->index(row, c).data().toString();
        out << QStringLiteral("row: ") + cells.join(QStringLiteral(" | "));
      }
    }
  }
  return out;
}

/// Names of what is not in both.
std::string difference(const QStringList& before, const QStringList& after) {
  QStringList out;
  for (const QString& line : before)
    if (!after.contains(line)) out << QStringLiteral("- ") + line;
  for (const QString& line : after)
    if (!before.contains(line)) out << QStringLiteral("+ ") + line;
  return out.mid(0, 12).join(QLatin1Char('\n')).toStdString();
}

class JobsMidway : public StoryTest, public ::testing::WithParamInterface<Case> {
 protected:
  static constexpr int enough_s = 120;

  /// Opens a copy of a session with both campaigns, in which everything was worked out for the first.
  void openPrepared(const std::string& demo) {
    static testing::TempFolder kept;
    const std::filesystem::path session = kept / demo;
    if (!std::filesystem::exists(session)) prepare(demo, session);
    const std::filesystem::path own = folder_ / "session";
    std::filesystem::copy(session, own, std::filesystem::copy_options::recursive);
    window_->open(QString::fromStdString(own.string()));
    settle();
    ASSERT_EQ(session_().campaigns().size(), 2U) << window_->jobBar()->message().toStdString();
    first_ = session_().campaigns().front().id;
    second_ = session_().campaigns().back().id;
    select(first_);
    settle();
  }

  void settle() {
    ASSERT_TRUE(waitForJobs(*window_, enough_s));
    QCoreApplication::processEvents();
    ASSERT_TRUE(waitForJobs(*window_, enough_s));
  }
  void select(std::int64_t campaign) { selectCampaign(session_(), campaign); }
  void goTo(StepId step) {
    window_->workflow().goTo(step);
    settle();
  }
  SessionModel& session_() { return window_->session(); }
  [[nodiscard]] std::vector<StoredResult> results(std::int64_t campaign) {
    return session_().session()->results(campaign);
  }

  /// Starts the job of the case; what is started by that is in the queues, nothing of it is taken over.
  void start(const Case& c) {
    switch (c.start) {
      case Start::RunAll:
        window_->currentPage()->runAll();
        break;
      case Start::Show:
        select(second_);
        select(first_);
        break;
      case Start::Suggest:
        click("Suggest points");
        break;
      case Start::Programme:
        click("Program");
        break;
      case Start::Clock:
        page<WarmUpPage>()->clocks()->source()->setCurrentIndex(page<WarmUpPage>()->clocks()->source()->count() - 1);
        page<WarmUpPage>()->clocks()->estimate();
        break;
      case Start::Updates:
        click("Run the updates");
        break;
      case Start::Simulator:
        ASSERT_TRUE(QTest::qWaitFor([this] { return page<DiscrepancyPage>()->simulation() != nullptr; }, 10'000));
        page<DiscrepancyPage>()->simulation()->search();
        break;
      case Start::Jogs:
        page<WarmUpPage>()->jogs()->button()->click();
        break;
      case Start::Repeatability:
        page<WarmUpPage>()->repeatability()->button()->click();
        break;
      case Start::SaveReport:
        page<ReportPage>()->saveTo(QString::fromStdString((folder_ / "copy.html").string()));
        break;
    }
  }
  /// Before it can be started: what it works on is there.
  void makeReady(const Case& c) {
    if (c.start != Start::SaveReport || page<ReportPage>()->document() != nullptr) return;
    window_->currentPage()->runAll();
    settle();
  }
  void click(const char* text) {
    for (auto* button : window_->currentPage()->findChildren<QAbstractButton*>()) {
      if (!button->text().contains(QLatin1String(text))) continue;
      ASSERT_TRUE(button->isEnabled()) << text;
      return button->click();
    }
    FAIL() << "no button " << text;
  }
  /// What the step Model shows.
  void showModelOverTime(std::int64_t campaign, bool over_time) {
    session_().setSetting(campaignKey(option_keys::over_time, campaign), over_time);
    Q_EMIT session_().campaignChanged();
  }
  /// That the job runs or waits.
  void expectStarted(const Case& c) {
    const QString title = QString::fromLatin1(c.title).section(QStringLiteral("%n"), 0, 0);
    QStringList all;
    for (const JobEntry& job : window_->jobs().entries()) all << job.title;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const QString& t) { return t.startsWith(title); }))
        << "running: " << all.join(QStringLiteral(", ")).toStdString() << "; the page says "
        << window_->currentPage()->callout()->sentence().toStdString();
  }
  /// The one result that was added is that of the origin at the start.
  void expectFiled(const Case& c, const ResultOrigin& started, std::size_t before) {
    const std::vector<StoredResult> all = results(first_);
    ASSERT_EQ(all.size(), before + (*c.kind != '\0' ? 1 : 0));
    if (*c.kind == '\0') return;
    const auto latest = session_().session()->latestResult(first_, c.kind);
    ASSERT_TRUE(latest.has_value());
    EXPECT_EQ(latest->provenance.inputs, started.inputs);
    for (const auto& [name, value] : started.options.items())
      EXPECT_EQ(latest->provenance.options.value(name, nlohmann::json()), value) << name;
  }

  std::int64_t first_ = 0;
  std::int64_t second_ = 0;

 private:
  void prepare(const std::string& demo, const std::filesystem::path& kept) {
    if (demo == "story") {
      open(writeStory(), StepId::Model);
    } else {
      window_->startDemo(QString::fromStdString(demo), true);
    }
    settle();
    ASSERT_NE(session_().campaign(), nullptr);
    const std::int64_t first = session_().campaignId();
    for (const StepId step : all_steps) {
      goTo(step);
      if (step == StepId::Verify) {
        if (auto* verify = page<VerifyPage>())
          verify->setAfter(QString::fromStdString(session_().campaign()->folder.string()));
      }
      window_->currentPage()->runAll();
      settle();
      if (step != StepId::Model || demo != "holes") continue;
      showModelOverTime(first, true);
      settle();
      window_->currentPage()->runAll();
      settle();
      showModelOverTime(first, false);
    }
    const std::filesystem::path other = folder_ / "other";
    std::filesystem::copy(session_().campaign()->folder, other, std::filesystem::copy_options::recursive);
    (void)folder_.write("other/note.txt", "so that its content is another");
    if (demo == "story") {  // measured again, with smaller deviations
      ObservationSet smaller = *session_().campaign()->observations;
      for (Observation& o : smaller.rows) o.value *= 0.3;
      (void)folder_.write("other/observations.csv", smaller.csv());
    }
    window_->addCampaign(QString::fromStdString(other.string()));
    settle();
    ASSERT_EQ(session_().campaigns().size(), 2U);
    select(first);
    settle();
    const std::filesystem::path made = session_().folder();
    window_->closeSession();
    settle();
    std::filesystem::copy(made, kept, std::filesystem::copy_options::recursive);
    std::filesystem::remove_all(made);
  }
  /// The small story with a simulator beside its simulation.
  std::filesystem::path writeStory() {
    const std::filesystem::path campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth, true, {6, 60});
    folder_.write("campaign/campaign.json", R"({"format":"spindrift-campaign","version":1,"name":"small story",)"
                                            R"("start_utc":"2026-03-01T08:00:00Z","simulation":"simulation.csv",)"
                                            R"("simulator":"sim/simulator.json"})");
    folder_.write("campaign/sim/simulator.json", R"({"format":"spindrift-simulator","version":1,
 "kind":"sensitivities","table":"d.csv","parameters":[
 {"name":"growth","value":0,"unit":"um","standard_uncertainty":5,"min":0,"max":40,"what":"growth along Z"}]})");
    std::string table = "time_s,point,component,parameter,d_predicted\n";
    for (const Observation& o : ObservationSet::read(campaign / "observations.csv").rows)
      table += exactNumber(o.time_s) + "," + o.point + "," + std::string(toString(o.component)) + ",growth," +
               (o.component == Component::EZ ? exactNumber(o.time_s / 28800.0) : "0") + "\n";
    folder_.write("campaign/sim/d.csv", table);
    return campaign;
  }
};

TEST_P(JobsMidway, LosesAndMixesNothing) {
  const Case& c = GetParam();
  ASSERT_NO_FATAL_FAILURE(openPrepared(c.demo));
  for (const std::int64_t campaign : {first_, second_}) showModelOverTime(campaign, c.over_time);
  select(first_);
  goTo(c.step);
  if (c.step == StepId::Verify) {  // with the other one, in the folder where it is now
    session_().setSetting(session_().campaignKey(option_keys::verify),
                          {{"after", session_().campaigns().back().folder.string()}});
    window_->currentPage()->runAll();
    settle();
  }
  const bool leaves_result = *c.kind != '\0';
  if (c.step == StepId::WarmUp && leaves_result) {  // the step says what a check has found
    ASSERT_NO_FATAL_FAILURE(start(c));
    settle();
  }
  const QStringList at_first = readOn(*window_->currentPage());

  struct Change {
    const char* name;
    std::function<QUndoCommand*()> make;
  };
  std::vector<Change> changes{
      {"an exclusion",
       [&] { return new ExcludeCommand(session_(), {QStringLiteral("M1/F1/EX")}, QStringLiteral("test")); }},
      {"the machine", [&] {
         nlohmann::json machine = session_().campaign()->machine.source;
         machine["name"] = "changed midway";
         return new MachineCommand(session_(), machine);
       }}};
  if (*c.option != '\0') {
    changes.push_back({"an option", [&] {
                         const std::string key = session_().campaignKey(c.option);
                         nlohmann::json after = session_().setting(key, nullptr);
                         if (std::string(c.option) == option_keys::scan_model) {
                           after = "push_broom";
                         } else if (std::string(c.option) == option_keys::report) {
                           after = {{"tells_discrepancy", false}};
                         } else if (std::string(c.option) == option_keys::discrepancy) {
                           after = {{"rejected", {"spindle.growth.x"}}};
                         } else if (std::string(c.option) == option_keys::verify) {
                           after["goal_um"] = 7.5;
                         } else if (std::string(c.option) == option_keys::nine_parameters) {
                           after["robust"] = 1;
                         } else if (std::string(c.option) == option_keys::cycles) {
                           after["second_axis"] = true;
                         } else if (std::string(c.option) == option_keys::thermal) {
                           after["method"] = "oe";
                         } else if (std::string(c.option) == option_keys::compensation) {
                           after["positions"] = 7;
                         }
                         return new OptionsCommand(session_(), QStringLiteral("change"), key, after, {});
                       }});
  }
  for (const Change& change : changes) {
    SCOPED_TRACE(change.name);
    makeReady(c);
    const std::size_t before = results(first_).size();
    const ResultOrigin started = leaves_result ? session_().begin(c.kind).origin : ResultOrigin();
    ASSERT_NO_FATAL_FAILURE(start(c));
    expectStarted(c);
    window_->undoStack().push(change.make());
    settle();
    ASSERT_NO_FATAL_FAILURE(expectFiled(c, started, before));
    if (leaves_result) {
      EXPECT_FALSE(session_().state(c.kind).current) << "made from what was before the change";
      EXPECT_FALSE(session_().state(c.kind).changed.isEmpty());
    }
    while (window_->undoStack().canUndo()) window_->undoStack().undo();
    settle();
    if (leaves_result) {
      EXPECT_TRUE(session_().state(c.kind).current) << "taken back";
    }
  }

  // The page of the other campaign, before anything of the first could have come to it.
  SCOPED_TRACE("another campaign");
  select(second_);
  settle();
  const QStringList other = readOn(*window_->currentPage());
  const std::size_t of_other = results(second_).size();
  select(first_);
  settle();
  makeReady(c);
  const std::size_t before = results(first_).size();
  const ResultOrigin started = leaves_result ? session_().begin(c.kind).origin : ResultOrigin();
  ASSERT_NO_FATAL_FAILURE(start(c));
  expectStarted(c);
  select(second_);
  settle();
  EXPECT_EQ(results(second_).size(), of_other);
  EXPECT_EQ(difference(other, readOn(*window_->currentPage())), "") << "the page of the other campaign";
  EXPECT_FALSE(window_->undoStack().canUndo());
  ASSERT_NO_FATAL_FAILURE(expectFiled(c, started, before));
  select(first_);
  settle();
  if (leaves_result) {
    EXPECT_TRUE(session_().state(c.kind).current);
  }
  // And the first shows what it showed at first: the same inputs, the same numbers. Reports say when they were written.
  if ((leaves_result || c.start == Start::Show) && c.step != StepId::Report) {
    EXPECT_EQ(difference(at_first, readOn(*window_->currentPage())), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Jobs, JobsMidway, ::testing::ValuesIn(cases()), [](const auto& of) {
  std::string name = std::string(of.param.demo) + "_" + std::string(toString(of.param.step)) + "_" + of.param.title +
                     (of.param.start == Start::Show ? "_shown" : "");
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; }, '_');
  return name;
});

TEST(JobsMidwayCases, EveryJobOfAPageIsAmongThem) {
  // What belongs to no campaign (plant, exercises), one picture or cloud that was picked, and what has tests of its own
  // (scanning_pages_test, simulation_panel_test, verify_page_test, compensate_page_test, nine_parameter_page_test,
  // review_page_test, campaigns_test).
  const std::set<QString> elsewhere{QStringLiteral("Decoding %1"),
                                    QStringLiteral("Reading %1"),
                                    QStringLiteral("Comparing scans"),
                                    QStringLiteral("Drawing before and after"),
                                    QStringLiteral("Running the compensator"),
                                    QStringLiteral("Putting it into the simulation"),
                                    QStringLiteral("Evaluating the test of ISO 230-3"),
                                    QStringLiteral("Reading the test of ISO 230-3"),
                                    QStringLiteral("Reading the model"),
                                    QStringLiteral("Reading the six errors"),
                                    QStringLiteral("Reading the fit"),
                                    QStringLiteral("Reading the contrast curves"),
                                    QStringLiteral("Reading the log that is being recorded"),
                                    QStringLiteral("Running what is outdated")};
  std::set<QString> tested;
  for (const Case& c : cases()) tested.insert(QString::fromLatin1(c.title));
  const QRegularExpression job(QStringLiteral(
      R"re((?:\brun_?\(|\bdisplay\(|\bshown\([\w"-]+, |\bjob\.title = |\bQString title = |pending, )\s*tr\("([^"]+)")re"));
  int found = 0;
  for (const TaskKind& kind : taskKinds()) {
    ++found;
    const QString title = QString::fromUtf8(kind.title.data(), static_cast<qsizetype>(kind.title.size()));
    EXPECT_TRUE(tested.contains(title) || elsewhere.contains(title)) << title.toStdString();
  }
  for (const char* folder : {"pages", "panels", "jobs"}) {
    QDirIterator files(
        QString::fromStdString((spindrift::testing::sourceFolder() / "widgets/").string()) + QLatin1String(folder),
        {QStringLiteral("*.cpp")}, QDir::Files, QDirIterator::Subdirectories);
    while (files.hasNext()) {
      const QString name = files.next();
      if (name.contains(QRegularExpression(QStringLiteral("/(plant|teaching|capture)/|connections_|closed_loop"))))
        continue;
      QFile file(name);
      ASSERT_TRUE(file.open(QIODevice::ReadOnly));
      auto match = job.globalMatch(QString::fromUtf8(file.readAll()));
      while (match.hasNext()) {
        const QString title = match.next().captured(1);
        ++found;
        EXPECT_TRUE(tested.contains(title) || elsewhere.contains(title))
            << name.toStdString() << ": " << title.toStdString();
      }
    }
  }
  EXPECT_GE(found, 25);
}

}  // namespace
}  // namespace spindrift::gui
