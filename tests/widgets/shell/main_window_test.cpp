// SPDX-License-Identifier: GPL-3.0-or-later
// The real window, driven by mouse and keys on the offscreen platform.
#include "widgets/shell/main_window.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTabWidget>
#include <QTableWidget>
#include <QTest>
#include <QThread>
#include <QTimer>

#include "core/base/random.h"
#include "core/machine/nine_parameter_model.h"
#include "tests/support/temp_folder.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/kinematics/nine_parameter_page.h"
#include "widgets/pages/thermal/warm_up_page.h"
#include "widgets/panels/thermal/resolution_check_panel.h"
#include "widgets/shell/new_measurement_dialog.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/tour.h"
#include "widgets/shell/welcome_page.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

/// A campaign with observations of eight points in two states.
std::filesystem::path writeCampaignWithObservations(const testing::TempFolder& folder) {
  const std::filesystem::path campaign = folder / "campaign";
  std::filesystem::create_directories(campaign);
  folder.write(
      "campaign/campaign.json",
      R"({"format":"spindrift-campaign","version":1,"name":"eight points","start_utc":"2026-01-31T08:00:00Z"})");
  std::string points;
  ObservationSet set;
  NineVector p;
  p << 18.0, -11.0, 24.0, 60.0, -45.0, 35.0, 25.0, 55.0, 40.0;
  Random random(3);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d position(20.0 + 37 * i, i % 3 == 0 ? 15.0 : i % 3 == 1 ? 60.0 : 115.0, 0.0);
    points += (i > 0 ? "," : "") + std::string("{\"id\":\"F") + std::to_string(i + 1) +
              "\",\"kind\":\"fiducial\",\"x_mm\":" + std::to_string(position.x()) +
              ",\"y_mm\":" + std::to_string(position.y()) + ",\"z_mm\":0}";
    for (int state = 0; state < 2; ++state) {
      for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
        Observation o;
        o.time_s = state * 3600 + i * 60 + static_cast<int>(c);
        o.state = state == 0 ? "M0" : "M1";
        o.point = "F" + std::to_string(i + 1);
        o.position_mm = position;
        o.component = c;
        o.sigma = 0.5;
        o.value = (state == 0 ? 0.0 : nineParameterRow(position, c).dot(p)) + random.normal(0, 0.5);
        o.instrument = "microscope";
        set.rows.push_back(o);
      }
    }
  }
  folder.write(
      "campaign/machine.json",
      R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]","axes":[)"
      R"({"name":"X","travel_mm":[0,300],"resolution_um":5},{"name":"Y","travel_mm":[0,130],"resolution_um":5},)"
      R"({"name":"Z","travel_mm":[0,150],"resolution_um":5}],"points":[)" +
          points + "]}");
  set.write(campaign / "observations.csv");
  return campaign;
}

class MainWindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QSettings().clear();
    window_ = std::make_unique<MainWindow>();
    window_->resize(1440, 900);
    window_->show();
  }
  void openEightPoints() {
    window_->open(QString::fromStdString(writeCampaignWithObservations(folder_).string()));
    ASSERT_TRUE(waitForJobs(*window_, 60));
    ASSERT_NE(window_->session().campaign(), nullptr) << window_->jobBar()->message().toStdString();
  }
  testing::TempFolder folder_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(MainWindowTest, FirstScreenOffersDemosAndIsNotGrey) {
  EXPECT_TRUE(window_->welcomeShown());
  EXPECT_GT(window_->welcome()->demoCard(0)->height(), 150);
  EXPECT_GE(window_->jobBar()->height(), 40);
}

TEST_F(MainWindowTest, OpensACampaignAndWalksThroughTheStepsByMouseAndKeys) {
  openEightPoints();
  EXPECT_FALSE(window_->welcomeShown());
  EXPECT_EQ(window_->workflow().current(), StepId::Machine);
  QTest::mouseClick(window_->nextButton(), Qt::LeftButton);
  EXPECT_EQ(window_->workflow().current(), StepId::WarmUp);
  QTest::mouseClick(window_->backButton(), Qt::LeftButton);
  EXPECT_EQ(window_->workflow().current(), StepId::Machine);
  QTest::mouseClick(window_->stepList()->button(StepId::Model), Qt::LeftButton);
  EXPECT_EQ(window_->workflow().current(), StepId::Model);
  QTest::keyClick(window_->stepList(), Qt::Key_Up);
  EXPECT_EQ(window_->workflow().current(), StepId::Calibrate);
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    ASSERT_NE(window_->currentPage(), nullptr);
    EXPECT_EQ(window_->currentPage()->step(), step);
    EXPECT_FALSE(window_->currentPage()->accessibleName().isEmpty());
  }
}

TEST_F(MainWindowTest, ANewMeasurementBeginsWithAMachineThatIsThere) {
  NewMeasurementDialog dialog(std::nullopt);
  ASSERT_EQ(dialog.choices()->count(), 4);
  for (int i = 0; i < dialog.choices()->count(); ++i) {
    dialog.choices()->setCurrentRow(i);
    EXPECT_FALSE(dialog.name()->text().isEmpty());
    const nlohmann::json machine = dialog.machine();
    EXPECT_NO_THROW((void)MachineDescription::parse(JsonNode::parse(machine.dump(), "machine.json"), "machine.json"));
  }
  dialog.name()->setText(QStringLiteral("  "));
  EXPECT_FALSE(dialog.startButton()->isEnabled()) << "a machine has a name";
  folder_.write("rubbish.json", "{\"format\":\"else\"}");
  dialog.takeFile(QString::fromStdString((folder_ / "rubbish.json").string()));
  EXPECT_EQ(dialog.choices()->count(), 4);
  EXPECT_EQ(dialog.findChild<Callout*>()->tone(), Tone::Bad);
  const auto campaign = writeCampaignWithObservations(folder_);
  dialog.takeFile(QString::fromStdString((campaign / "machine.json").string()));
  ASSERT_EQ(dialog.choices()->count(), 5);
  EXPECT_EQ(dialog.name()->text(), QStringLiteral("mill"));
  dialog.name()->setText(QStringLiteral("the mill in hall 2"));
  window_->startMeasurement(dialog.machine());
  ASSERT_NE(window_->session().campaign(), nullptr) << window_->jobBar()->message().toStdString();
  EXPECT_EQ(window_->session().campaign()->machine.name, "the mill in hall 2");
  EXPECT_EQ(window_->session().campaign()->machine.points.size(), 8U);
  EXPECT_EQ(window_->workflow().current(), StepId::Machine);
  // The machine at hand is offered next time.
  NewMeasurementDialog next(window_->session().campaign()->machine.source);
  EXPECT_EQ(next.choices()->count(), 5);
  EXPECT_EQ(next.name()->text(), QStringLiteral("the mill in hall 2"));
}

TEST_F(MainWindowTest, EnterPressesTheButtonThatHasTheFocus) {
  openEightPoints();
  window_->nextButton()->setFocus();
  QTest::keyClick(window_->nextButton(), Qt::Key_Return);
  EXPECT_EQ(window_->workflow().current(), StepId::WarmUp);
}

TEST_F(MainWindowTest, TheWordThatTheInstrumentWasWarmCanBeTakenBack) {
  openEightPoints();
  window_->workflow().goTo(StepId::WarmUp);
  auto* page = qobject_cast<WarmUpPage*>(window_->currentPage());
  ASSERT_NE(page, nullptr);
  const auto state = [&] { return window_->workflow().status(StepId::WarmUp).state; };
  EXPECT_EQ(state(), StepState::NotStarted);
  QPushButton* button = nullptr;
  for (auto* b : page->findChildren<QPushButton*>()) {
    if (b->text().contains(QStringLiteral("was warm"))) button = b;
  }
  ASSERT_NE(button, nullptr);
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(state(), StepState::Current);
  EXPECT_EQ(window_->session().warmStatement()->at("by"), "operator");
  window_->undoStack().undo();
  EXPECT_EQ(state(), StepState::NotStarted);
  EXPECT_FALSE(window_->session().warmStatement().has_value());
  window_->undoStack().redo();
  ASSERT_TRUE(button->text().contains(QStringLiteral("Withdraw"))) << button->text().toStdString();
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_EQ(state(), StepState::NotStarted);
}

TEST_F(MainWindowTest, WhatIsTypedOnTheMachinePageStaysUntilItIsAppliedOrDiscarded) {
  openEightPoints();
  const auto nameField = [&]() -> QLineEdit* {
    for (auto* edit : window_->currentPage()->findChildren<QLineEdit*>()) {
      if (edit->accessibleName() == QStringLiteral("Name of the machine")) return edit;
    }
    return nullptr;
  };
  const auto button = [&](const QString& text) -> QPushButton* {
    for (auto* b : window_->currentPage()->findChildren<QPushButton*>()) {
      if (b->text().trimmed() == text && b->isVisibleTo(window_->currentPage())) return b;
    }
    return nullptr;
  };
  QLineEdit* name = nameField();
  ASSERT_NE(name, nullptr);
  name->setFocus();
  name->selectAll();
  QTest::keyClicks(name, QStringLiteral("another"));
  window_->workflow().goTo(StepId::Review);
  window_->workflow().goTo(StepId::Machine);
  EXPECT_EQ(name->text(), QStringLiteral("another"));
  EXPECT_EQ(window_->session().campaign()->machine.name, "mill");
  // The session is closed, or the program dies: it is on the disk with every key.
  const QString folder = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(folder);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  window_->workflow().goTo(StepId::Machine);
  ASSERT_NE(nameField(), nullptr);
  EXPECT_EQ(nameField()->text(), QStringLiteral("another"));
  EXPECT_EQ(window_->session().campaign()->machine.name, "mill");
  ASSERT_NE(button(QStringLiteral("Discard")), nullptr);
  QTest::mouseClick(button(QStringLiteral("Discard")), Qt::LeftButton);
  EXPECT_EQ(nameField()->text(), QStringLiteral("mill"));
  nameField()->setFocus();
  nameField()->selectAll();
  QTest::keyClicks(nameField(), QStringLiteral("third"));
  QPushButton* apply = nullptr;
  for (auto* b : window_->currentPage()->findChildren<QPushButton*>()) {
    if (b->text().startsWith(QStringLiteral("Apply")) && b->isVisibleTo(window_->currentPage()) && b->isEnabled())
      apply = b;
  }
  ASSERT_NE(apply, nullptr);
  QTest::mouseClick(apply, Qt::LeftButton);
  EXPECT_EQ(window_->session().campaign()->machine.name, "third");
  EXPECT_FALSE(apply->isEnabled());
}

TEST_F(MainWindowTest, FitsTheModelAndUndoesAChangeOfPoints) {
  openEightPoints();
  window_->workflow().goTo(StepId::Model);
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::NotStarted);
  QTest::mouseClick(window_->currentPage()->primaryButton(), Qt::LeftButton);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Current);
  auto* page = qobject_cast<NineParameterPage*>(window_->currentPage());
  ASSERT_NE(page, nullptr);
  EXPECT_FALSE(page->view()->empty());
  const QImage picture = page->view()->grab().toImage();
  int coloured = 0;
  for (int y = 0; y < picture.height(); y += 4) {
    for (int x = 0; x < picture.width(); x += 4) {
      const QColor c = picture.pixelColor(x, y);
      if (std::abs(c.red() - c.blue()) > 60) ++coloured;
    }
  }
  EXPECT_GT(coloured, 500);

  // Excluding data makes the model outdated; undo brings it back.
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QStringLiteral("M1/F3/EX")}, QStringLiteral("test")));
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Outdated);
  window_->undoStack().undo();
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Current);
  window_->undoStack().redo();
  EXPECT_TRUE(window_->session().excluded().contains(QStringLiteral("M1/F3/EX")));
}

TEST_F(MainWindowTest, ComparesTwoSetsOfPointsInATableAndOnTheTable) {
  openEightPoints();
  window_->session().setSetting("nine-parameter", {{"points", {"F1", "F2", "F3", "F4"}}});
  window_->workflow().goTo(StepId::Model);
  window_->currentPage()->runAll();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  auto* page = qobject_cast<NineParameterPage*>(window_->currentPage());
  ASSERT_NE(page, nullptr);
  const QImage heat_map = page->view()->grab().toImage();
  auto* tabs = page->findChild<QTabWidget*>();
  ASSERT_NE(tabs, nullptr);
  tabs->setCurrentIndex(2);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(tabs->tabText(2), QStringLiteral("Compare sets"));
  EXPECT_NE(page->view()->grab().toImage(), heat_map) << "the map of the difference";
  EXPECT_FALSE(page->view()->empty());
  tabs->setCurrentIndex(0);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_LT(std::abs(page->view()->colourScale()->high + page->view()->colourScale()->low), 1e-9);
}

TEST_F(MainWindowTest, EditingTheMachineCanBeUndone) {
  openEightPoints();
  auto* axes = window_->currentPage()->findChild<QTableWidget*>();
  ASSERT_NE(axes, nullptr);
  nlohmann::json machine = window_->session().campaign()->machine.source;
  machine["name"] = "another";
  window_->undoStack().push(new MachineCommand(window_->session(), machine));
  EXPECT_EQ(window_->session().campaign()->machine.name, "another");
  EXPECT_TRUE(window_->session().machineEdited());
  window_->undoStack().undo();
  EXPECT_EQ(window_->session().campaign()->machine.name, "mill");
  EXPECT_FALSE(window_->session().machineEdited());
}

TEST_F(MainWindowTest, ReopeningShowsTheSameState) {
  openEightPoints();
  window_->workflow().goTo(StepId::Model);
  window_->currentPage()->runAll();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  const QString folder = QString::fromStdString(window_->session().folder().string());
  // A file manager gives the file of the session rather than its folder.
  for (const QString& what : {folder, folder + QStringLiteral("/spindrift-session.json")}) {
    window_->closeSession();
    EXPECT_TRUE(window_->welcomeShown());
    window_->open(what);
    ASSERT_TRUE(waitForJobs(*window_, 60));
    EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Current) << what.toStdString();
  }
}

TEST_F(MainWindowTest, AFolderThatIsNothingGivesOneSentence) {
  const auto nothing = folder_ / "nothing";
  std::filesystem::create_directories(nothing);
  window_->open(QString::fromStdString(nothing.string()));
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_TRUE(window_->welcomeShown());
  EXPECT_TRUE(window_->jobBar()->message().contains(QStringLiteral("campaign.json")))
      << window_->jobBar()->message().toStdString();
}

// Controls are at least 40 px high and have a name, on every page (LOOK.md).
TEST_F(MainWindowTest, ButtonsAreLargeAndNamed) {
  openEightPoints();
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    ASSERT_TRUE(waitForJobs(*window_, 60));
    QTest::qWait(10);
    for (const QPushButton* button : window_->findChildren<QPushButton*>()) {
      if (!button->isVisible()) continue;
      EXPECT_GE(button->height(), 40) << button->text().toStdString() << " on " << stepTitle(step).toStdString();
      EXPECT_FALSE(button->text().isEmpty() && button->accessibleName().isEmpty());
      EXPECT_GE(button->width(), button->minimumSizeHint().width()) << button->text().toStdString();
    }
  }
}

TEST_F(MainWindowTest, SuggestedPointsAreAddedAndCanBeDiscarded) {
  openEightPoints();
  auto* page = window_->currentPage();
  QPushButton* suggest = nullptr;
  QPushButton* discard = nullptr;
  for (QPushButton* button : page->findChildren<QPushButton*>()) {
    if (button->accessibleName() == QLatin1String("Suggest points")) suggest = button;
    if (button->accessibleName() == QLatin1String("Discard") && button->isVisibleTo(page)) discard = button;
  }
  ASSERT_NE(suggest, nullptr);
  ASSERT_NE(discard, nullptr);
  const auto tables = page->findChildren<QTableWidget*>();
  const auto points = std::find_if(tables.begin(), tables.end(), [](const QTableWidget* table) {
    return table->accessibleName() == QLatin1String("Measuring points");
  });
  ASSERT_NE(points, tables.end());
  EXPECT_EQ((*points)->rowCount(), 8);
  QTest::mouseClick(suggest, Qt::LeftButton);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  ASSERT_EQ((*points)->rowCount(), 14);
  EXPECT_EQ((*points)->item(8, 0)->text(), QStringLiteral("P1"));
  EXPECT_TRUE(page->callout()->sentence().contains(QStringLiteral("6 points")))
      << page->callout()->sentence().toStdString();
  QTest::mouseClick(discard, Qt::LeftButton);
  EXPECT_EQ((*points)->rowCount(), 8);
}

TEST_F(MainWindowTest, JogsAreHeldAgainstTheResolution) {
  openEightPoints();
  window_->workflow().goTo(StepId::WarmUp);
  auto* page = qobject_cast<WarmUpPage*>(window_->currentPage());
  ASSERT_NE(page, nullptr);
  // How many states there are is counted beside the window.
  ASSERT_TRUE(QTest::qWaitFor([&] { return page->jogs()->button()->isEnabled(); }, 5000));
  QTest::mouseClick(page->jogs()->button(), Qt::LeftButton);  // two thermal states tens of um apart are no jogs
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->jogs()->rows()->rowCount(), 3);
  EXPECT_EQ(page->jogs()->verdict()->tone(), Tone::Attention);
  EXPECT_TRUE(page->jogs()->verdict()->sentence().startsWith(QStringLiteral("Not passed")))
      << page->jogs()->verdict()->sentence().toStdString();
  // What is shown is what is stored, and says so when it does not hold any more.
  const StoredResult* stored = window_->session().latest("check-jogs");
  ASSERT_NE(stored, nullptr);
  EXPECT_TRUE(window_->session().state("check-jogs").current);
  EXPECT_EQ(stored->payload.at("axes").size(), 3U);
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QStringLiteral("M1/F1/EX")}, QStringLiteral("disturbed")));
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->jogs()->verdict()->tone(), Tone::Outdated);
  EXPECT_EQ(page->jogs()->rows()->rowCount(), 3);
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->jogs()->verdict()->tone(), Tone::Attention);
}

TEST_F(MainWindowTest, TheWarmUpPageSaysWhatTheStepSaysOfTheStoredCheck) {
  openEightPoints();
  window_->workflow().goTo(StepId::WarmUp);
  auto* page = qobject_cast<WarmUpPage*>(window_->currentPage());
  ASSERT_NE(page, nullptr);
  const auto agree = [&](StepState state) {
    EXPECT_EQ(window_->workflow().status(StepId::WarmUp).state, state);
    EXPECT_EQ(page->callout()->sentence(), window_->workflow().status(StepId::WarmUp).sentence);
  };
  agree(StepState::NotStarted);
  EXPECT_EQ(window_->session().latest("check-warm-up"), nullptr) << "nothing is judged before it is asked for";
  QTest::mouseClick(page->primaryButton(), Qt::LeftButton);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  const StoredResult* stored = window_->session().latest("check-warm-up");
  ASSERT_NE(stored, nullptr);
  EXPECT_TRUE(
      page->callout()->sentence().contains(QString::fromStdString(stored->payload.at("reason").get<std::string>())));
  agree(window_->workflow().status(StepId::WarmUp).state);
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QStringLiteral("M1/F1/EX")}, QStringLiteral("disturbed")));
  ASSERT_TRUE(waitForJobs(*window_, 60));
  agree(StepState::Outdated);
}

TEST_F(MainWindowTest, WaitingForJobsWaitsForWhatALoadedComputerPutsOff) {
  openEightPoints();
  QTest::mouseClick(window_->stepList()->button(StepId::WarmUp), Qt::LeftButton);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  QTest::qWait(300);
  bool laid_out = false;
  // As views of rows do it: when nothing else is left.
  QTimer first;
  QTimer second;
  for (QTimer* idle : {&first, &second}) idle->setSingleShot(true);
  QObject::connect(&first, &QTimer::timeout, [&] { second.start(0); });
  QObject::connect(&second, &QTimer::timeout, [&] { laid_out = true; });
  first.start(0);
  // The computer is busy elsewhere: every time is over before that.
  QTimer::singleShot(0, [] { QThread::msleep(100); });
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_TRUE(laid_out);
}

TEST_F(MainWindowTest, ThemeSwitches) {
  const QImage light = window_->grab().toImage();
  window_->setTheme(ThemeKind::Dark);
  const QImage dark = window_->grab().toImage();
  window_->setTheme(ThemeKind::Light);
  EXPECT_LT(qGray(dark.pixel(700, 700)), 90);
  EXPECT_GT(qGray(light.pixel(700, 700)), 180);
}

}  // namespace
}  // namespace spindrift::gui
