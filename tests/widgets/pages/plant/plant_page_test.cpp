// SPDX-License-Identifier: GPL-3.0-or-later
// The page Plant in the real window, on a store with machines of which one has changed. SPINDRIFT_TEST_PICTURES=FOLDER
// keeps what it looks like.
#include <gtest/gtest.h>

#include <QComboBox>
#include <QCoreApplication>
#include <QDateTime>
#include <QElapsedTimer>
#include <QItemSelectionModel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QTabWidget>
#include <QTableView>
#include <QTest>
#include <QTextBrowser>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/base/utc_time.h"
#include "core/plant/batch_queue.h"
#include "core/plant/plant_store.h"
#include "tests/support/session_steps.h"
#include "tests/support/temp_folder.h"
#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/plant/plant_page.h"
#include "widgets/panels/plant/batches_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/tour.h"
#include "widgets/shell/welcome_page.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

constexpr double week_s = 604'800.0;

/// A campaign that began so long ago.
PlantCampaign campaignOf(const std::string& machine, const std::string& name, double ago_s) {
  PlantCampaign c;
  c.machine = machine;
  c.name = name;
  c.start_s = now() - ago_s;
  c.fingerprint = machine + name;
  c.program_version = SPINDRIFT_VERSION;
  c.publisher = "anna@bench";
  return c;
}

/// A fit of it that converged, without parameters.
PlantResult fitOf(const PlantCampaign& campaign) {
  PlantResult r;
  r.kind = "fit";
  r.program_version = SPINDRIFT_VERSION;
  r.inputs_fingerprint = campaign.fingerprint;
  r.verdict = "converged";
  return r;
}

class PlantPageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QSettings().clear();
    store_ = QString::fromStdString((folder_ / "plant.sqlite").string());
    makeStore();
    window_ = std::make_unique<MainWindow>();
    window_->resize(1440, 900);
    window_->setTheme(ThemeKind::Light);
    window_->show();
  }
  void TearDown() override { window_->setTheme(ThemeKind::Light); }

  void makeStore() {
    PlantStore store = PlantStore::make(PlantAddress::parse(store_.toStdString()));
    Random random(11);
    std::vector<PlantCampaign> campaigns;
    for (const char* machine : {"DMU 50 hall 2", "gantry north", "lathe 4"}) {
      for (int week = 0; week < 60; ++week) {
        const bool changed = std::string(machine) == "gantry north" && week >= 40;
        if (std::string(machine) == "lathe 4" && week > 52) continue;
        PlantCampaign c = campaignOf(machine, "week " + std::to_string(week), week_s * (60.0 - week) + 3600.0);
        PlantResult r = fitOf(c);
        for (const char* name : {"EX_um", "EZ_um"}) {
          const double u = random.uniform(0.2, 0.6);
          r.parameters.push_back(
              {"M1", name, 8.0 + (changed ? 4.0 : 0.0) + random.normal(0.0, 0.5) + random.normal(0.0, u), u});
        }
        c.results.push_back(r);
        if (week == 20) {
          PlantResult model = r;
          model.kind = "discrepancy";
          model.verdict = "none";
          model.parameters.clear();
          model.model = {{"format", "spindrift-error-model"}};
          c.results.push_back(model);
        }
        campaigns.push_back(std::move(c));
      }
    }
    (void)store.publish(campaigns);
    store.addEvent({"gantry north", now() - week_s * 20.5, "spindle_changed", "SN 12", "anna"});
    store.addEvent({"gantry north", now() - week_s * 30.5, "note", "cleaned", "anna"});
    BatchPlan plan;
    plan.name = "monthly";
    plan.work = "hidden_effect";
    plan.seeds = 40;
    plan.chunk = 10;
    BatchQueue queue(store);
    const std::int64_t id = queue.submit(plan);
    const auto claim = queue.claim(id, "w", "local");
    std::vector<ItemAnswer> answers;
    for (std::int64_t i = 0; i < 10; ++i) answers.push_back({i, 12.0, i == 3, {{"verdict", "named"}}});
    (void)queue.finish(*claim, ChunkOutcome::Done, answers, "", 120.0);
    (void)queue.claim(id, "w", "local");
  }
  void wait() {
    ASSERT_TRUE(waitForJobs(*window_, 60));
    QCoreApplication::processEvents();
  }
  void keep(const QString& name) {
    const QString folder = qEnvironmentVariable("SPINDRIFT_TEST_PICTURES");
    if (folder.isEmpty()) return;
    for (const ThemeKind kind : {ThemeKind::Light, ThemeKind::Dark}) {
      window_->setTheme(kind);
      wait();
      window_->grab().save(folder + QLatin1Char('/') + name +
                           (kind == ThemeKind::Dark ? QStringLiteral("-dark.png") : QStringLiteral("-light.png")));
    }
    window_->setTheme(ThemeKind::Light);
  }

  /// A plan that runs a command of the shell for each of the seeds ($1) from 1 on.
  std::string planOf(const std::string& name, int seeds, const std::string& command) {
    const nlohmann::json plan = {{"format", "spindrift-batch"},
                                 {"version", 1},
                                 {"name", name},
                                 {"work", "command"},
                                 {"seeds", {1, seeds}},
                                 {"options", {{"run", {"sh", "-c", command, "sh", "{seed}"}}}}};
    return folder_.write(name + ".json", plan.dump()).string();
  }

  testing::TempFolder folder_;
  QString store_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(PlantPageTest, ShowsTheMachinesOfTheDemosInTheLanguageOfTheWindow) {
  {
    PlantStore store = PlantStore::open(PlantAddress::parse(store_.toStdString()));
    PlantCampaign c =
        campaignOf("vertical machining centre", "vertical machining centre, simulation with a gap", week_s);
    PlantResult r = fitOf(c);
    r.parameters.push_back({"M1", "EX_um", 8.0, 0.4});
    c.results.push_back(r);
    (void)store.publish(std::vector<PlantCampaign>{c});
  }
  applyLanguage(QStringLiteral("de"));
  window_ = std::make_unique<MainWindow>();
  window_->resize(1280, 800);
  window_->show();
  window_->openPlant();
  PlantPage* page = window_->plant();
  page->openStore(store_);
  wait();
  page->selectMachines({QStringLiteral("vertical machining centre")});
  wait();
  const auto shows = [](const QAbstractItemModel* model, const QString& text) {
    for (int row = 0; row < model->rowCount(); ++row)
      for (int column = 0; column < model->columnCount(); ++column)
        if (model->index(row, column).data().toString() == text) return true;
    return false;
  };
  EXPECT_TRUE(shows(page->machines()->model(), QStringLiteral("vertikales Bearbeitungszentrum")));
  EXPECT_FALSE(shows(page->machines()->model(), QStringLiteral("vertical machining centre")));
  EXPECT_TRUE(shows(page->machines()->model(), QStringLiteral("gantry north"))) << "what people wrote stays";
  EXPECT_FALSE(shows(page->campaigns()->model(), QStringLiteral("vertical machining centre, simulation with a gap")));
  EXPECT_EQ(page->parameter()->currentData().toString(), QStringLiteral("fit/EX_um"));
  EXPECT_NE(page->parameter()->currentText(), QStringLiteral("fit/EX_um"));
  keep(QStringLiteral("plant-german"));
  applyLanguage(QStringLiteral("en"));
}

TEST_F(PlantPageTest, ShowsMachinesTrendsAndBatchesWithoutASession) {
  window_->openPlant();
  PlantPage* page = window_->plant();
  ASSERT_TRUE(page->isVisible());
  EXPECT_FALSE(page->publishButton()->isEnabled()) << "there is no session to publish";
  page->openStore(store_);
  wait();
  ASSERT_EQ(page->machines()->model()->rowCount(), 3);
  const auto cell = [&](int row, int column) {
    return page->machines()->model()->index(row, column).data().toString().toStdString();
  };
  EXPECT_EQ(cell(0, 0), "lathe 4") << "what is due stands first";
  EXPECT_NE(cell(0, 1).find("due for"), std::string::npos) << cell(0, 1);
  EXPECT_FALSE(page->plot()->empty()) << "the first machine is shown";
  keep(QStringLiteral("plant-first"));

  page->selectMachines({QStringLiteral("gantry north")});
  wait();
  page->parameter()->setCurrentText(QStringLiteral("fit/EX_um"));
  wait();
  EXPECT_EQ(page->plot()->series().front().x.size(), 60U);
  EXPECT_EQ(page->plot()->series().size(), 7U) << "values; moving average and both limits before and after the spindle";
  const std::string said = page->said().toStdString();
  EXPECT_NE(said.find("Step of +"), std::string::npos) << said;
  EXPECT_NE(said.find("spindle changed (SN 12)"), std::string::npos) << said;
  int gantry = 0;
  while (cell(gantry, 0) != "gantry north") ++gantry;
  EXPECT_EQ(cell(gantry, 2), "no longer holds");
  keep(QStringLiteral("plant-trend"));
  page->writeReport(QString::fromStdString((folder_ / "gantry.html").string()));
  wait();
  const std::string report = readFile(folder_ / "gantry.html");
  EXPECT_NE(report.find("gantry north"), std::string::npos);
  EXPECT_NE(report.find("no longer holds"), std::string::npos);
  // In the language of the window; what people wrote stays.
  applyLanguage(QStringLiteral("de"));
  page->writeReport(QString::fromStdString((folder_ / "gantry.de.html").string()));
  wait();
  const std::string german = readFile(folder_ / "gantry.de.html");
  applyLanguage(QStringLiteral("en"));
  EXPECT_NE(german.find("gantry north"), std::string::npos);
  EXPECT_NE(german.find("gilt nicht mehr"), std::string::npos);
  EXPECT_NE(german.find("SN 12"), std::string::npos);
  EXPECT_EQ(german.find("no longer holds"), std::string::npos);

  page->selectMachines({QStringLiteral("gantry north"), QStringLiteral("lathe 4"), QStringLiteral("DMU 50 hall 2")});
  wait();
  EXPECT_EQ(page->plot()->series().size(), 3U);
  keep(QStringLiteral("plant-machines"));

  page->tabs()->setCurrentIndex(1);
  wait();
  auto* campaigns = dynamic_cast<RowsModel*>(page->campaigns()->model());
  ASSERT_NE(campaigns, nullptr);
  ASSERT_GT(campaigns->rowCount(), 100);
  for (const int row : {0, 70}) {
    ASSERT_TRUE(campaigns->setData(campaigns->index(row, 0), Qt::Checked, Qt::CheckStateRole));
    wait();
  }
  EXPECT_EQ(page->comparison()->rowCount(), 2);
  EXPECT_EQ(page->comparison()->columnCount(), 5);
  keep(QStringLiteral("plant-campaigns"));

  page->tabs()->setCurrentIndex(2);
  wait();
  ASSERT_EQ(page->batches()->rows()->rowCount(), 1);
  EXPECT_EQ(page->batches()->rows()->index(0, 2).data().toString().toStdString(), "10 of 40 (25 %)");
  EXPECT_EQ(page->batches()->rows()->index(0, 3).data().toString().toStdString(), "1");
  keep(QStringLiteral("plant-batches"));
  page->tabs()->setCurrentIndex(3);
  auto* help = page->findChild<QTextBrowser*>();
  ASSERT_NE(help, nullptr);
  EXPECT_TRUE(help->toPlainText().contains(QStringLiteral("10,000 machines")));
  keep(QStringLiteral("plant-help"));
}

TEST_F(PlantPageTest, SaysWhatIsWrongAndComesBack) {
  window_->openPlant();
  PlantPage* page = window_->plant();
  page->openStore(QStringLiteral("postgresql:host=a password=b"));
  EXPECT_NE(page->callout()->sentence().toStdString().find("holds a password"), std::string::npos);
  page->openStore(store_ + QStringLiteral(".none"));
  wait();
  EXPECT_NE(page->callout()->sentence().toStdString().find("is not there"), std::string::npos);
  page->openStore(store_);
  wait();
  EXPECT_FALSE(page->callout()->isVisible());
  Q_EMIT page->closed();
  EXPECT_TRUE(window_->welcomeShown());
}

TEST_F(PlantPageTest, PublishesTheOpenSession) {
  {
    Session session = Session::create(folder_ / "s");
    const auto id = session.newCampaign("warm-up", "2026-01-31T08:00:00Z",
                                        R"({"format":"spindrift-machine","version":1,"name":"new mill",
                                            "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]}]})");
    testing::addResult(session, id, "fit", {},
                       {{"status", "converged"},
                        {"state", "M1"},
                        {"parameters", {{"EX_um", {{"value", 1.0}, {"standard_uncertainty", 0.2}}}}}});
  }
  window_->open(QString::fromStdString((folder_ / "s").string()));
  wait();
  window_->openPlant();
  PlantPage* page = window_->plant();
  ASSERT_TRUE(page->publishButton()->isEnabled());
  page->openStore(store_);
  wait();
  page->publishButton()->click();
  wait();
  wait();
  EXPECT_NE(page->callout()->sentence().toStdString().find("Published: new 1 campaign and 1 result"), std::string::npos)
      << page->callout()->sentence().toStdString();
  EXPECT_EQ(page->machines()->model()->rowCount(), 4);
  Q_EMIT page->closed();
  EXPECT_FALSE(window_->welcomeShown());
}

template <class Widget>
Widget* named(const QWidget* page, const char* accessible_name) {
  for (Widget* w : page->findChildren<Widget*>()) {
    if (w->accessibleName() == QLatin1String(accessible_name)) return w;
  }
  ADD_FAILURE() << "nothing on the page is named " << accessible_name;
  return nullptr;
}

QPushButton* buttonOf(const QWidget* page, const char* words) {
  for (QPushButton* b : page->findChildren<QPushButton*>()) {
    if (b->accessibleName() == QLatin1String(words)) return b;
  }
  ADD_FAILURE() << "no button on the page says " << words;
  return nullptr;
}

TEST_F(PlantPageTest, EntersAnEventOfAMachine) {
  window_->resize(1280, 800);
  window_->openPlant();
  PlantPage* page = window_->plant();
  page->openStore(store_);
  wait();
  QPushButton* enter = buttonOf(page, "Enter event");
  auto* time = named<QLineEdit>(page, "When it was done (UTC)");
  auto* note = named<QLineEdit>(page, "Note on the event");
  auto* kind = named<QComboBox>(page, "What was done to the machine");
  page->selectMachines({QStringLiteral("gantry north"), QStringLiteral("lathe 4")});
  wait();
  EXPECT_FALSE(enter->isEnabled()) << "of one machine";
  page->selectMachines({QStringLiteral("gantry north")});
  wait();
  page->parameter()->setCurrentText(QStringLiteral("fit/EX_um"));
  wait();
  const auto entered = [&] {
    PlantStore store = PlantStore::open(PlantAddress::parse(store_.toStdString()));
    return store.events("gantry north");
  };
  const std::size_t before = entered().size();
  const auto stretches = page->plot()->series().size();

  // With the keyboard: from the kind on by Tab, and Return at the end.
  kind->setFocus();
  QTest::keyClick(kind, Qt::Key_Down);
  QTest::keyClick(kind, Qt::Key_Tab);
  ASSERT_EQ(window_->focusWidget(), time);
  time->selectAll();
  QTest::keyClicks(time, QStringLiteral("yesterday"));
  QTest::keyClick(time, Qt::Key_Return);
  EXPECT_NE(page->callout()->sentence().toStdString().find("\"yesterday\" is not a date"), std::string::npos);
  const std::string day = QDateTime::fromSecsSinceEpoch(static_cast<qint64>(now() - week_s * 19.5), Qt::UTC)
                              .toString(QStringLiteral("yyyy-MM-dd"))
                              .toStdString();
  time->selectAll();
  QTest::keyClicks(time, QString::fromStdString(day));
  QTest::keyClick(time, Qt::Key_Tab);
  ASSERT_EQ(window_->focusWidget(), note);
  QTest::keyClicks(note, QStringLiteral("after the move"));
  keep(QStringLiteral("plant-event-typed"));
  note->setFocus();
  QTest::keyClick(note, Qt::Key_Return);
  wait();
  wait();
  ASSERT_EQ(entered().size(), before + 1);
  EXPECT_EQ(page->callout()->tone(), Tone::Good) << page->callout()->sentence().toStdString();
  const auto all = entered();
  const auto found =
      std::find_if(all.begin(), all.end(), [](const MachineEvent& e) { return e.note == "after the move"; });
  ASSERT_NE(found, all.end());
  EXPECT_EQ(found->kind, "re_levelled");
  EXPECT_EQ(utcText(found->time_s).substr(0, 10), day);
  EXPECT_FALSE(found->author.empty());
  EXPECT_TRUE(note->text().isEmpty());
  EXPECT_EQ(page->plot()->series().size(), stretches)
      << "a week after the spindle there is nothing to take limits from";
  // With the mouse.
  kind->setCurrentIndex(kind->findData(QStringLiteral("note")));
  note->setText(QStringLiteral("cleaned"));
  QTest::mouseClick(enter, Qt::LeftButton);
  wait();
  wait();
  EXPECT_EQ(entered().size(), before + 2);
  keep(QStringLiteral("plant-event"));
}

TEST_F(PlantPageTest, StartsCancelsAndResumesABatch) {
  window_->resize(1280, 800);
  const std::string gate = (folder_ / "gate").string();
  const std::string run = "while [ $1 -gt 2 ] && [ ! -e " + gate + " ]; do sleep 0.02; done; echo $(( $1 * $1 ))";
  const std::string plan = planOf("squares", 12, run);
  window_->openPlant();
  PlantPage* page = window_->plant();
  page->batches()->setWorkerProgram(QStringLiteral(SPINDRIFT_CLI));
  page->openStore(store_);
  wait();
  page->tabs()->setCurrentIndex(2);
  wait();
  QPushButton* start = buttonOf(page, "Start");
  QPushButton* cancel = buttonOf(page, "Cancel the batch");
  QPushButton* resume = buttonOf(page, "Resume on this computer");
  auto* file = named<QLineEdit>(page, "Plan of the batch");
  EXPECT_FALSE(start->isEnabled());
  EXPECT_FALSE(cancel->isEnabled());
  file->setFocus();
  QTest::keyClicks(file, QString::fromStdString((folder_ / "none.json").string()));
  QTest::keyClick(file, Qt::Key_Return);
  wait();
  EXPECT_NE(page->callout()->sentence().toStdString().find("none.json"), std::string::npos);

  const auto cell = [&](int column) {
    const int row = page->batches()->rows()->rowOf(QStringLiteral("2"));
    return row < 0 ? QString() : page->batches()->rows()->index(row, column).data().toString();
  };
  file->selectAll();
  QTest::keyClicks(file, QString::fromStdString(plan));
  QTest::mouseClick(start, Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return cell(2).startsWith(QStringLiteral("2 of 12")); }, 60'000))
      << cell(2).toStdString() << page->callout()->sentence().toStdString();
  EXPECT_FALSE(page->callout()->isVisible()) << "what was wrong with the other plan is told no more";
  EXPECT_TRUE(window_->jobs().busy());
  EXPECT_FALSE(window_->jobs().working()) << "a batch of hours keeps nobody from working";
  EXPECT_TRUE(window_->jobs().title().contains(QStringLiteral("squares.json")));
  // Chosen with the keyboard.
  page->batches()->table()->setFocus();
  page->batches()->table()->selectRow(page->batches()->rows()->rowOf(QStringLiteral("2")));
  ASSERT_TRUE(QTest::qWaitFor([&] { return cancel->isEnabled(); }, 10'000));
  EXPECT_NE(cell(5), QString());
  if (const QString folder = qEnvironmentVariable("SPINDRIFT_TEST_PICTURES"); !folder.isEmpty())
    window_->grab().save(folder + QStringLiteral("/plant-batch-runs-light.png"));
  QTest::mouseClick(cancel, Qt::LeftButton);
  wait();
  wait();
  EXPECT_EQ(cell(4).toStdString(), "cancelled");
  EXPECT_EQ(cell(2).toStdString(), "2 of 12 (16 %)");
  EXPECT_FALSE(cancel->isEnabled());
  ASSERT_TRUE(resume->isEnabled());
  EXPECT_NE(page->callout()->sentence().toStdString().find("is cancelled"), std::string::npos);
  keep(QStringLiteral("plant-batch-cancelled"));

  (void)folder_.write("gate", "");
  resume->setFocus();
  QTest::keyClick(resume, Qt::Key_Space);
  wait();
  wait();
  EXPECT_EQ(cell(2).toStdString(), "12 of 12 (100 %)");
  EXPECT_EQ(cell(4).toStdString(), "finished");
  EXPECT_EQ(page->callout()->sentence().toStdString(), "Batch 2 squares is finished: 12 items.");
  EXPECT_FALSE(resume->isEnabled());
  keep(QStringLiteral("plant-batch-finished"));
}

/// The window is closed while a batch runs: its workers end, and what they held is free.
TEST_F(PlantPageTest, ABatchEndsWithTheWindowAndLosesNothing) {
  const std::string plan = planOf("long", 4, "[ $1 = 1 ] || sleep 60; echo 1");
  window_->openPlant();
  PlantPage* page = window_->plant();
  page->batches()->setWorkerProgram(QStringLiteral(SPINDRIFT_CLI));
  page->openStore(store_);
  wait();
  page->batches()->start(QString::fromStdString(plan));
  const auto state = [&] {
    PlantStore store = PlantStore::open(PlantAddress::parse(store_.toStdString()));
    BatchQueue queue(store);
    const auto all = queue.all();
    return all.front().name == "long" ? all.front() : BatchState();
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return state().answered == 1 && state().running > 0; }, 60'000));
  window_->close();
  window_.reset();
  EXPECT_EQ(state().running, 0) << "given back, not left to its lease of 30 s";
  EXPECT_EQ(state().free, 3);
  window_ = std::make_unique<MainWindow>();
}

/// 260 values: from the choice to the picture.
TEST_F(PlantPageTest, DrawsATrendAtOnce) {
  {
    PlantStore store = PlantStore::open(PlantAddress::parse(store_.toStdString()));
    std::vector<PlantCampaign> campaigns;
    for (int week = 0; week < 260; ++week) {
      PlantCampaign c;
      c.machine = "old mill";
      c.name = std::to_string(week);
      c.start_s = now() - week_s * (260.0 - week);
      c.fingerprint = c.name;
      c.program_version = SPINDRIFT_VERSION;
      PlantResult r;
      r.kind = "fit";
      r.parameters = {{"M1", "EX_um", std::sin(1.7 * week), 0.1}};
      c.results.push_back(r);
      campaigns.push_back(c);
    }
    (void)store.publish(campaigns);
  }
  window_->openPlant();
  PlantPage* page = window_->plant();
  page->openStore(store_);
  wait();
  double least = 1e9;
  for (int i = 0; i < 5; ++i) {
    page->selectMachines({});
    wait();
    QElapsedTimer timer;
    timer.start();
    page->selectMachines({QStringLiteral("old mill")});
    wait();
    (void)page->plot()->grab();
    least = std::min(least, static_cast<double>(timer.nsecsElapsed()) / 1e6);
  }
  EXPECT_EQ(page->plot()->series().front().x.size(), 260U);
  std::printf("a trend of 260 values from the choice to the picture: %.0f ms\n", least);
  EXPECT_LT(least, 1000.0) << "100 ms on a computer that does nothing else";
}

}  // namespace
}  // namespace spindrift::gui
