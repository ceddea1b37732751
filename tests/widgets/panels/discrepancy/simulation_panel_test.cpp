// SPDX-License-Identifier: GPL-3.0-or-later
// The missing effect goes into the simulation itself, in the real window: a simulator is read without being run, what
// is missing is named among its parameters, put in, stored, shown again, reported and undone.
#include "widgets/panels/discrepancy/simulation_panel.h"

#include <fmt/format.h>

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>
#include <QStyleOptionViewItem>
#include <QTabWidget>
#include <QTableView>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "tests/widgets/support/select_campaign.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/common/parts.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/report/report_page.h"
#include "widgets/panels/discrepancy/simulation_views.h"
#include "widgets/plots/plot.h"
#include "widgets/shell/tour.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"
#include "widgets/workflow/simulator_choice.h"

namespace spindrift::gui {
namespace {

constexpr double true_growth_um = 9.0;
constexpr int put_in_column = 5;

/// What the spindle of the small story does after one micrometre.
double growthPerUm(double t) {
  constexpr double lag_s = 2400.0;
  if (t < 1800.0) return 0.0;
  const double on = 1.0 - std::exp(-(std::min(t, 14400.0) - 1800.0) / lag_s);
  return t < 14400.0 ? on : on * std::exp(-(t - 14400.0) / lag_s);
}

class SimulationPanelTest : public StoryTest {
 protected:
  /// The small story with a table of sensitivities beside its simulation: the growth of the spindle is switched off,
  /// the drift along X is uncertain, the stiffness changes nothing.
  /// With a twin, the seal does to the readings what the spindle does.
  std::filesystem::path writeCampaign(bool named = true, bool twin = false) {
    const std::filesystem::path campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth);
    if (named) {
      folder_.write("campaign/campaign.json", R"({"format":"spindrift-campaign","version":1,"name":"small story",)"
                                              R"("start_utc":"2026-03-01T08:00:00Z","simulation":"simulation.csv",)"
                                              R"("simulator":"sim/simulator.json"})");
    }
    std::string file = R"({"format":"spindrift-simulator","version":1,
 "kind":"sensitivities","table":"d.csv","parameters":[
 {"name":"spindle_growth","value":0,"unit":"um","standard_uncertainty":5,"min":0,"max":40,
  "what":"growth of the spindle along Z when it has warmed up","effects":["spindle.growth.z"]},
 {"name":"drift_x","value":4,"unit":"um","standard_uncertainty":0.2,"min":0,"max":10,"what":"drift of the bed along X"},
 {"name":"drift_y","value":0.5,"unit":"um","standard_uncertainty":0.3,"min":-5,"max":5,"what":"drift of the bed along Y"})";
    if (twin) {
      file += R"(,
 {"name":"seal","value":0,"unit":"um","standard_uncertainty":5,"min":0,"max":40,"what":"growth by the seal's friction",
  "effects":["spindle.growth.z"]})";
    }
    folder_.write("campaign/sim/simulator.json", file + "\n]}");
    std::string table = "time_s,point,component,parameter,d_predicted\n";
    const ObservationSet at = ObservationSet::read(campaign / "observations.csv");
    for (const Observation& o : at.rows) {
      const auto add = [&](const char* name, Component component, double value) {
        table += fmt::format("{},{},{},{},{}\n", o.time_s, o.point, toString(o.component), name,
                             o.component == component ? value : 0.0);
      };
      add("spindle_growth", Component::EZ, growthPerUm(o.time_s));
      if (twin) add("seal", Component::EZ, growthPerUm(o.time_s));
      add("drift_x", Component::EX, o.time_s / 28800.0);
      add("drift_y", Component::EY, o.time_s / 28800.0);
    }
    folder_.write("campaign/sim/d.csv", table);
    return campaign;
  }
  void openPanel(const std::filesystem::path& campaign) {
    open(campaign, StepId::Discrepancy);
    page_ = page<DiscrepancyPage>();
    ASSERT_NE(page_, nullptr);
    showPanel();
  }
  void showPanel() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return page_->simulation() != nullptr; }, 10'000));
    panel_ = page_->simulation();
    ASSERT_TRUE(page_->tabs()->isTabVisible(page_->tabs()->indexOf(panel_)));
    page_->tabs()->setCurrentWidget(panel_);
    settle();
  }
  void settle() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return !panel_->busy(); }, 10'000));
    QTest::qWait(20);
  }
  void search() {
    QTest::mouseClick(panel_->searchButton(), Qt::LeftButton);
    wait();
    settle();
  }
  [[nodiscard]] QString cell(const QTableView* table, const QString& row, int column) const {
    for (int r = 0; r < table->model()->rowCount(); ++r) {
      if (table->model()->index(r, 0).data().toString() == row)
        return table->model()->index(r, column).data().toString();
    }
    return {};
  }
  [[nodiscard]] QModelIndex tickOf(const char* parameter) const {
    const QAbstractItemModel* model = panel_->parameterTable()->model();
    for (int r = 0; r < model->rowCount(); ++r) {
      if (model->index(r, 0).data().toString() == QLatin1String(parameter)) return model->index(r, put_in_column);
    }
    return {};
  }
  [[nodiscard]] bool ticked(const char* parameter) const {
    return tickOf(parameter).data(Qt::CheckStateRole).toInt() == Qt::Checked;
  }
  /// A click of the mouse on the box.
  void tick(const char* parameter) {
    QTableView* table = panel_->parameterTable();
    const QModelIndex at = tickOf(parameter);
    ASSERT_TRUE(at.isValid()) << parameter;
    ASSERT_FALSE(table->isColumnHidden(put_in_column));
    table->scrollTo(at);
    QStyleOptionViewItem option;
    option.initFrom(table);
    option.rect = table->visualRect(at);
    option.features = QStyleOptionViewItem::HasCheckIndicator;
    option.widget = table;
    const QRect box = table->style()->subElementRect(QStyle::SE_ItemViewItemCheckIndicator, &option, table);
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, box.center());
    settle();
  }
  [[nodiscard]] std::string sentence() const { return panel_->callout()->sentence().toStdString(); }
  /// Pictures for people to look at, where the environment names a folder for them.
  void picture(const char* name) {
    const QString folder = qEnvironmentVariable("SPINDRIFT_TEST_PICTURES");
    if (folder.isEmpty()) return;
    window_->resize(1280, 800);
    for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
      window_->setTheme(kind);
      QTest::qWait(300);
      window_->grab().save(QStringLiteral("%1/simulation-%2-%3.png")
                               .arg(folder, QString::fromLatin1(name),
                                    kind == ThemeKind::Light ? QStringLiteral("light") : QStringLiteral("dark")));
    }
  }
  DiscrepancyPage* page_ = nullptr;
  SimulationPanel* panel_ = nullptr;
};

TEST_F(SimulationPanelTest, NamesTheMechanismPutsItInStoresReportsAndUndoes) {
  openPanel(writeCampaign());
  ASSERT_EQ(panel_->parameterTable()->model()->rowCount(), 3) << sentence();
  EXPECT_EQ(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 2), QStringLiteral("off"));
  EXPECT_TRUE(cell(panel_->parameterTable(), QStringLiteral("drift_x"), 2).startsWith(QStringLiteral("4.0")));
  EXPECT_FALSE(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 4).isEmpty());
  EXPECT_TRUE(panel_->runs()->text().contains(QStringLiteral("Nothing is run")))
      << panel_->runs()->text().toStdString();
  EXPECT_EQ(panel_->story(), nullptr) << "nothing is run before somebody asks for it";
  EXPECT_EQ(page_->story(), nullptr) << "the search of the page is not needed";
  EXPECT_FALSE(ticked("spindle_growth"));
  picture("before");

  search();
  ASSERT_NE(panel_->story(), nullptr) << sentence();
  ASSERT_FALSE(panel_->story()->effects.empty()) << sentence();
  EXPECT_EQ(panel_->story()->effects.front().id, "simulation.spindle_growth");
  EXPECT_TRUE(panel_->found()->text().contains(QStringLiteral("Switched off in the simulation; measured")))
      << panel_->found()->text().toStdString();
  EXPECT_TRUE(panel_->putButton()->isVisible());
  EXPECT_TRUE(panel_->putButton()->isEnabled());
  EXPECT_TRUE(ticked("spindle_growth")) << "what was found";
  EXPECT_FALSE(ticked("drift_x"));
  EXPECT_TRUE(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 1).contains(QStringLiteral("Can cause")))
      << cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 1).toStdString();
  picture("named");

  // The button asks for the folder and proposes one in the session.
  const QString folder = panel_->proposedFolder();
  EXPECT_TRUE(folder.endsWith(QStringLiteral("/simulations/small-story-2"))) << folder.toStdString();
  QTimer::singleShot(200, panel_, [&] {
    auto* dialog = panel_->findChild<QDialog*>();
    ASSERT_NE(dialog, nullptr);
    EXPECT_EQ(dialog->findChild<QLineEdit*>()->text(), folder);
    dialog->accept();
  });
  QTest::mouseClick(panel_->putButton(), Qt::LeftButton);
  wait();
  settle();
  ASSERT_NE(panel_->update(), nullptr) << sentence();
  EXPECT_EQ(panel_->callout()->tone(), Tone::Good) << sentence();
  EXPECT_EQ(panel_->update()->mechanisms, std::vector<std::string>{"spindle_growth"});
  const auto put = std::find_if(panel_->update()->parameters.begin(), panel_->update()->parameters.end(),
                                [](const FittedSimulatorParameter& p) { return p.put_in; });
  ASSERT_NE(put, panel_->update()->parameters.end());
  EXPECT_NEAR(put->value, true_growth_um, 4.0 * put->standard_uncertainty);
  EXPECT_TRUE(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 3).contains(QStringLiteral("±")));
  EXPECT_EQ(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 4), QStringLiteral("put in"));
  EXPECT_EQ(panel_->figureTable()->model()->rowCount(), 3);
  EXPECT_LT(panel_->update()->heldout_rms_after_um, 0.6);
  EXPECT_TRUE(std::filesystem::exists((folder + "/simulator.json").toStdString()));
  EXPECT_TRUE(std::filesystem::exists((folder + "/simulation.csv").toStdString()));
  EXPECT_EQ(currentSimulator(window_->session()), "simulations/small-story-2/simulator.json");
  picture("parameters");
  panel_->views()->button(1)->click();
  ASSERT_EQ(panel_->history()->plot()->series().size(), 3U);
  picture("history");
  panel_->views()->button(2)->click();
  ASSERT_NE(panel_->maps(), nullptr);
  EXPECT_TRUE(panel_->maps()->empty()) << "worked out beside the window";
  EXPECT_FALSE(settled(*window_));
  wait();
  EXPECT_FALSE(panel_->maps()->empty());
  EXPECT_EQ(panel_->maps()->view(false)->colourScale(), panel_->maps()->view(true)->colourScale());
  picture("maps");
  for (const Exportable& item : page_->exportables()) {
    const std::string file = (folder_ / ("x." + item.formats.front().toStdString())).string();
    ASSERT_NO_THROW(item.write(QString::fromStdString(file))) << item.name.toStdString();
    EXPECT_GT(std::filesystem::file_size(file), 20U) << item.name.toStdString();
  }

  // The session keeps it.
  const std::string told = sentence();
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(session);
  wait();
  window_->workflow().goTo(StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  showPanel();
  ASSERT_NE(panel_->update(), nullptr);
  EXPECT_EQ(sentence(), told);
  EXPECT_TRUE(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 3).contains(QStringLiteral("±")));

  // So does its report.
  window_->workflow().goTo(StepId::Report);
  auto* report = page<ReportPage>();
  ASSERT_NE(report, nullptr);
  report->runAll();
  wait();
  const auto stored = window_->session().result("report");
  ASSERT_TRUE(stored.has_value());
  const std::string html = readFile(window_->session().folder() / stored->payload.value("file", ""));
  EXPECT_NE(html.find("Put into the simulation"), std::string::npos);
  EXPECT_NE(html.find("spindle_growth"), std::string::npos);
}

TEST_F(SimulationPanelTest, UndoGoesBackToThePreviousVersion) {
  openPanel(writeCampaign());
  search();
  const QString folder = panel_->proposedFolder();
  panel_->putInto(folder);
  wait();
  settle();
  ASSERT_NE(panel_->update(), nullptr) << sentence();
  EXPECT_EQ(window_->undoStack().undoText(), QStringLiteral("put spindle_growth into the simulation"));
  window_->undoStack().undo();
  settle();
  EXPECT_EQ(panel_->update(), nullptr);
  EXPECT_TRUE(currentSimulator(window_->session()).ends_with("sim/simulator.json"));
  EXPECT_EQ(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 2), QStringLiteral("off"));
  EXPECT_TRUE(panel_->putButton()->isEnabled());
  EXPECT_TRUE(std::filesystem::exists((folder + "/simulator.json").toStdString())) << "the files stay";
  EXPECT_TRUE(panel_->proposedFolder().endsWith(QStringLiteral("-3")));
  window_->undoStack().redo();
  settle();
  ASSERT_NE(panel_->update(), nullptr);
  // The new version is the simulator now: with it nothing is missing.
  search();
  EXPECT_EQ(panel_->update(), nullptr);
  ASSERT_NE(panel_->story(), nullptr);
  EXPECT_EQ(panel_->story()->verdict, DiscrepancyVerdict::None) << sentence();
  EXPECT_EQ(panel_->callout()->tone(), Tone::Good);
  EXPECT_TRUE(cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 2).contains(QLatin1Char('9')) ||
              cell(panel_->parameterTable(), QStringLiteral("spindle_growth"), 2).contains(QLatin1Char('8')));
}

TEST_F(SimulationPanelTest, PutsInAfterReopeningAndRefusesTheCampaignFolder) {
  openPanel(writeCampaign());
  search();
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(session);
  wait();
  window_->workflow().goTo(StepId::Discrepancy);
  page_ = page<DiscrepancyPage>();
  showPanel();
  ASSERT_NE(panel_->story(), nullptr);
  panel_->putInto(QString::fromStdString((window_->session().campaign()->folder / "new").string()));
  EXPECT_NE(sentence().find("never written to"), std::string::npos) << sentence();
  const std::filesystem::path full = folder_.write("full/file.txt", "x").parent_path();
  panel_->putInto(QString::fromStdString(full.string()));
  wait();
  EXPECT_NE(sentence().find("is not empty"), std::string::npos) << sentence();
  panel_->putInto(panel_->proposedFolder());
  wait();
  settle();
  ASSERT_NE(panel_->update(), nullptr) << sentence();
  EXPECT_EQ(panel_->update()->status, FitStatus::Converged) << sentence();
}

TEST_F(SimulationPanelTest, ThePutButtonRunsWhatIsMissing) {
  openPanel(writeCampaign());
  ASSERT_EQ(panel_->story(), nullptr);
  ASSERT_TRUE(panel_->putButton()->isVisible());
  ASSERT_TRUE(panel_->putButton()->isEnabled());
  panel_->putInto(panel_->proposedFolder());
  EXPECT_TRUE(window_->jobs().busy()) << "a job with progress and cancel";
  wait();
  settle();
  ASSERT_NE(panel_->update(), nullptr) << sentence();
  EXPECT_EQ(panel_->update()->mechanisms, std::vector<std::string>{"spindle_growth"});
  EXPECT_EQ(panel_->callout()->tone(), Tone::Good) << sentence();
  EXPECT_EQ(page_->story(), nullptr);
}

TEST_F(SimulationPanelTest, AVersionThatIsReadyLaterIsThatOfItsCampaign) {
  openPanel(writeCampaign());
  SessionModel& session = window_->session();
  const std::int64_t first = session.campaignId();
  const std::filesystem::path other = folder_ / "other";
  std::filesystem::copy(session.campaign()->folder, other, std::filesystem::copy_options::recursive);
  (void)folder_.write("other/note.txt", "so that its content is another");
  window_->addCampaign(QString::fromStdString(other.string()));
  wait();
  const std::int64_t second = session.campaignId();
  selectCampaign(session, first);
  window_->workflow().goTo(StepId::Discrepancy);
  wait();
  const std::string before = currentSimulator(session);
  const QString folder = panel_->proposedFolder();
  panel_->putInto(folder);
  EXPECT_TRUE(session.tasks().status("simulation").state == TaskState::Running) << "the tasks know of it";
  selectCampaign(session, second);
  wait();
  EXPECT_TRUE(session.session()->results(second).empty());
  EXPECT_TRUE(currentSimulator(session).ends_with("sim/simulator.json"));
  EXPECT_FALSE(window_->undoStack().canUndo()) << "nothing was done on this one";
  selectCampaign(session, first);
  wait();
  EXPECT_NE(currentSimulator(session), before) << "written and chosen";
  EXPECT_EQ(simulatorFile(session, currentSimulator(session)),
            std::filesystem::path(folder.toStdString()) / "simulator.json");
  ASSERT_TRUE(window_->undoStack().canUndo());
  window_->undoStack().undo();
  EXPECT_EQ(currentSimulator(session), before);
}

TEST_F(SimulationPanelTest, ACancelledPutChangesNothing) {
  openPanel(writeCampaign());
  const QString folder = panel_->proposedFolder();
  panel_->putInto(folder);
  window_->jobs().cancel();
  wait();
  settle();
  EXPECT_EQ(panel_->update(), nullptr);
  EXPECT_FALSE(std::filesystem::exists(folder.toStdString()));
  EXPECT_TRUE(panel_->putButton()->isEnabled());
}

TEST_F(SimulationPanelTest, WhatIsTickedIsPutInAndItsSupportIsTold) {
  openPanel(writeCampaign());
  search();
  ASSERT_TRUE(ticked("spindle_growth"));
  tick("drift_x");
  ASSERT_TRUE(ticked("drift_x"));
  ASSERT_TRUE(panel_->putButton()->isEnabled());
  panel_->putInto(panel_->proposedFolder());
  wait();
  settle();
  ASSERT_NE(panel_->update(), nullptr) << sentence();
  EXPECT_EQ(panel_->update()->mechanisms, (std::vector<std::string>{"spindle_growth", "drift_x"}));
  EXPECT_TRUE(panel_->found()->text().contains(QStringLiteral("do not support")))
      << panel_->found()->text().toStdString() << panel_->update()->summary();
  EXPECT_FALSE(panel_->found()->text().contains(QStringLiteral("spindle_growth was asked for")));
}

TEST_F(SimulationPanelTest, WithoutATickThereIsNothingToPutIn) {
  openPanel(writeCampaign());
  search();
  tick("spindle_growth");
  EXPECT_FALSE(ticked("spindle_growth"));
  EXPECT_FALSE(panel_->putButton()->isEnabled());
  EXPECT_NE(sentence().find("Tick"), std::string::npos) << sentence();
  panel_->putInto(panel_->proposedFolder());
  EXPECT_FALSE(window_->jobs().busy());
  EXPECT_NE(sentence().find("Tick"), std::string::npos) << sentence();
  // Another one alone: the gap stays, and it says so.
  tick("drift_y");
  EXPECT_TRUE(panel_->putButton()->isEnabled()) << sentence();
  panel_->putInto(panel_->proposedFolder());
  wait();
  settle();
  ASSERT_NE(panel_->story(), nullptr);
  ASSERT_TRUE(panel_->story()->update.has_value()) << sentence();
  EXPECT_EQ(panel_->story()->update->mechanisms, std::vector<std::string>{"drift_y"});
  EXPECT_NE(panel_->callout()->tone(), Tone::Good) << sentence();
}

TEST_F(SimulationPanelTest, TicksThatCannotBeCombinedSayWhy) {
  openPanel(writeCampaign(true, true));
  search();
  ASSERT_NE(panel_->story(), nullptr) << sentence();
  for (const char* name : {"spindle_growth", "seal"}) {
    if (!ticked(name)) tick(name);
  }
  EXPECT_NE(sentence().find("have the same effect on the observations"), std::string::npos) << sentence();
  EXPECT_EQ(panel_->callout()->tone(), Tone::Attention);
  EXPECT_FALSE(panel_->putButton()->isEnabled());
  tick("seal");
  EXPECT_TRUE(panel_->putButton()->isEnabled()) << sentence();
  EXPECT_EQ(sentence().find("have the same effect on the observations"), std::string::npos) << sentence();
}

TEST_F(SimulationPanelTest, StaysWithTheSearchOfThePage) {
  openPanel(writeCampaign());
  page_->runAll();
  wait();
  ASSERT_NE(page_->story(), nullptr) << page_->callout()->sentence().toStdString();
  EXPECT_EQ(page_->tabs()->currentWidget(), panel_);
  for (int i = 0; i < page_->tabs()->count(); ++i)
    EXPECT_EQ(page_->tabs()->isTabVisible(i), page_->tabs()->widget(i)->objectName() != QStringLiteral("nothingYet"));
  search();
  ASSERT_NE(panel_->story(), nullptr) << sentence();
}

TEST_F(SimulationPanelTest, TheStoryOfACampaignFromElsewhere) {
  // For pictures of a finite-element story, which takes minutes: a campaign that names its simulator.
  const QString campaign = qEnvironmentVariable("SPINDRIFT_TEST_STORY");
  if (campaign.isEmpty()) GTEST_SKIP() << "SPINDRIFT_TEST_STORY names no campaign";
  openPanel(campaign.toStdString());
  panel_->putInto(panel_->proposedFolder());
  ASSERT_TRUE(waitForJobs(*window_, 900));
  settle();
  ASSERT_NE(panel_->update(), nullptr) << sentence();
  EXPECT_EQ(panel_->update()->status, FitStatus::Converged) << sentence();
  picture("story-parameters");
  panel_->views()->button(1)->click();
  picture("story-history");
  panel_->views()->button(2)->click();
  settle();
  picture("story-maps");
}

TEST_F(SimulationPanelTest, ASimulatorThatFailsSaysItsOneSentence) {
  openPanel(writeCampaign(false));
  EXPECT_EQ(panel_->parameterTable()->model()->rowCount(), 0);
  EXPECT_FALSE(panel_->searchButton()->isVisible());
  picture("none");
  folder_.write("broken/in.txt.in", "{{h}}\n");
  const auto file = folder_.write("broken/simulator.json", R"json({"format":"spindrift-simulator","version":1,
 "kind":"command","templates":["in.txt.in"],"run":[["false"]],"result":"out.csv","parameters":[
 {"name":"h","value":1,"unit":"W/(m2 K)","standard_uncertainty":0.1,"min":0,"max":5,"what":"film"}]})json");
  panel_->chooseSimulator(QString::fromStdString(file.string()));
  settle();
  EXPECT_EQ(panel_->parameterTable()->model()->rowCount(), 1);
  EXPECT_TRUE(panel_->runs()->text().contains(QStringLiteral("false"))) << panel_->runs()->text().toStdString();
  search();
  EXPECT_EQ(panel_->callout()->tone(), Tone::Bad);
  EXPECT_NE(sentence().find("false"), std::string::npos) << sentence();
  EXPECT_EQ(sentence().find("nternal error"), std::string::npos) << sentence();
  EXPECT_EQ(panel_->story(), nullptr);
  picture("failed");
  window_->undoStack().undo();
  settle();
  EXPECT_TRUE(currentSimulator(window_->session()).empty());
  // One that cannot be read is told as well.
  panel_->chooseSimulator(QString::fromStdString(folder_.write("broken/other.json", "{}").string()));
  settle();
  EXPECT_EQ(panel_->callout()->tone(), Tone::Bad);
  EXPECT_FALSE(panel_->searchButton()->isEnabled());
}

}  // namespace
}  // namespace spindrift::gui
