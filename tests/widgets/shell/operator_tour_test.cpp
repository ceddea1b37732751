// SPDX-License-Identifier: GPL-3.0-or-later
// The README's "A tour for the operator", clicked through in the real window: its points in their order, by the buttons
// and keys that it names. What is dropped onto the window: files_test.cpp, capture_pages_test.cpp.
#include <gtest/gtest.h>

#include <QApplication>
#include <QContextMenuEvent>
#include <QMenu>
#include <QPushButton>
#include <QSettings>
#include <QTableView>
#include <QTest>
#include <QThread>
#include <set>

#include "core/base/atomic_file.h"
#include "tests/support/source_folder.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/capture/arriving_panel.h"
#include "widgets/services/incoming_service.h"
#include "widgets/shell/command_palette.h"
#include "widgets/shell/help_panel.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/shell/preferences_dialog.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/tour_details.h"
#include "widgets/shell/welcome_page.h"

namespace spindrift::gui {
namespace {

std::string readme() {
  return readFile(spindrift::testing::sourceFolder() / "README.md");
}

class OperatorTour : public StoryTest {
 protected:
  void SetUp() override {
    QSettings().clear();
    StoryTest::SetUp();
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  }
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    window_->activateWindow();  // a window that was closed had the keys
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    QTest::keyClick(window_.get(), key, modifiers);
    QCoreApplication::processEvents();
  }
  [[nodiscard]] std::string message() const { return window_->jobBar()->message().toStdString(); }
};

// 1. and 2.: the first screen, and ten steps with a sentence each.
TEST_F(OperatorTour, TheFirstScreenOffersWhatTheReadmeNamesAndEveryStepSaysHowItStands) {
  const std::string text = readme();
  ASSERT_NE(
      text.find("The first screen offers five demo sessions (fiducials under a microscope, hole bar, ball artefact, "
                "laser\n   profiler, discrepancy), opening a session, and a new measurement."),
      std::string::npos);
  EXPECT_EQ(window_->welcome()->findChildren<DemoCard*>().size(), 5);
  QStringList offered;
  for (const auto* button : window_->welcome()->findChildren<QPushButton*>())
    if (button->isVisible()) offered << button->accessibleName();
  EXPECT_TRUE(offered.contains(QStringLiteral("New measurement …"))) << offered.join(QLatin1Char('|')).toStdString();
  EXPECT_TRUE(offered.contains(QStringLiteral("Open session …")));

  window_->startDemo(QStringLiteral("holes"), true);
  wait();
  QStringList steps;
  for (const StepId step : all_steps) {
    steps << stepTitle(step);
    const StepStatus& status = window_->workflow().status(step);
    EXPECT_FALSE(status.sentence.isEmpty()) << stepTitle(step).toStdString();
    if (status.state == StepState::Blocked) {
      EXPECT_FALSE(window_->stepList()->button(step)->toolTip().isEmpty()) << stepTitle(step).toStdString();
    }
  }
  EXPECT_NE(text.find("The steps on the left (" + steps.join(QStringLiteral(", ")).toStdString().substr(0, 40)),
            std::string::npos)
      << steps.join(QStringLiteral(", ")).toStdString();
  // "Their pages follow the instrument of the campaign."
  std::set<std::string> pages;
  for (const char* demo : {"holes", "scans", "discrepancy"}) {
    sessions_.push_back(window_->session().folder());
    window_->startDemo(QString::fromLatin1(demo), true);
    wait();
    window_->workflow().goTo(StepId::Capture);
    wait();
    pages.insert(window_->currentPage()->metaObject()->className());
  }
  EXPECT_EQ(pages.size(), 3U);
}

// 3.: captures as they arrive. Bad ones are asked for at once, and the plan says what comes next.
TEST_F(OperatorTour, AFolderIsWatchedBadCapturesAreAskedForAndThePlanSaysWhatIsNext) {
  window_->startDemo(QStringLiteral("fiducials"), true);
  wait();
  ASSERT_NE(window_->session().campaign(), nullptr);
  sessions_.push_back(window_->session().folder());
  ASSERT_EQ(startArriving(*window_, QString::fromStdString((folder_ / "arriving").string())), QString());
  // What has arrived says which instrument it is, and with it which page.
  auto* arriving = window_->currentPage()->findChild<ArrivingPanel*>();
  ASSERT_NE(arriving, nullptr) << window_->currentPage()->metaObject()->className();
  QPushButton* watch = nullptr;
  for (auto* button : arriving->findChildren<QPushButton*>())
    if (button->accessibleName() == QStringLiteral("Watch folder …")) watch = button;
  ASSERT_NE(watch, nullptr);
  EXPECT_TRUE(watch->isVisible());
  EXPECT_EQ(arriving->arrived()->rowCount(), 4) << "three good images and a blurred one";
  EXPECT_TRUE(arriving->retake()->isVisible());
  EXPECT_TRUE(arriving->retake()->sentence().contains(QStringLiteral("again")))
      << arriving->retake()->sentence().toStdString();
  EXPECT_TRUE(arriving->service().progress().next.has_value()) << "what to take next";
  EXPECT_FALSE(arriving->service().progress().sentence.empty());
  arriving->service().stop();
  window_->closeSession();
}

// 4.: the bar at the bottom, cancelling, and what was taken out comes back.
TEST_F(OperatorTour, WorkIsCancelledInTheBarAndWhatIsTakenOutComesBack) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  Job slow;
  slow.title = QStringLiteral("A long job");
  bool applied = false;
  slow.work = [&applied](JobContext& job) -> std::function<void()> {
    while (!job.cancelled()) QThread::msleep(5);
    job.throwIfCancelled();
    return [&applied] { applied = true; };
  };
  window_->jobs().run(std::move(slow));
  QPushButton* cancel = nullptr;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        for (auto* button : window_->jobBar()->findChildren<QPushButton*>())
          if (button->isVisible() && button->accessibleName().contains(QStringLiteral("ancel"))) cancel = button;
        return cancel != nullptr;
      },
      5000));
  QTest::mouseClick(cancel, Qt::LeftButton);
  wait();
  EXPECT_FALSE(applied);
  const auto left_out = [&] { return window_->session().excluded().size(); };
  ASSERT_EQ(left_out(), 0U);
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QStringLiteral("M3/F1/EX")}, QStringLiteral("the door was open")));
  wait();
  EXPECT_EQ(left_out(), 1U);
  key(Qt::Key_Z, Qt::ControlModifier);
  wait();
  EXPECT_EQ(left_out(), 0U);
}

// 5. to 7.: nothing is lost, help, notes, the log, commands, preferences, tables, languages.
TEST_F(OperatorTour, KeysAndMenusDoWhatTheReadmeSays) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  QTest::mouseClick(window_->currentPage()->primaryButton(), Qt::LeftButton);
  wait();
  const std::filesystem::path session = window_->session().folder();
  ASSERT_TRUE(window_->session().latest("fit") != nullptr);

  key(Qt::Key_F1);
  EXPECT_TRUE(window_->help()->isVisible());
  key(Qt::Key_F1);
  EXPECT_FALSE(window_->help()->isVisible());
  key(Qt::Key_M, Qt::ControlModifier);
  auto* notes = window_->findChild<NotesDialog*>();
  ASSERT_NE(notes, nullptr);
  EXPECT_TRUE(notes->isVisible());
  notes->close();
  const auto log = folder_ / "log.txt";
  window_->saveLog(QString::fromStdString(log.string()));
  EXPECT_GT(std::filesystem::file_size(log), 100U);
  key(Qt::Key_K, Qt::ControlModifier);
  auto* palette = window_->findChild<CommandPalette*>();
  ASSERT_NE(palette, nullptr);
  palette->close();
  QCoreApplication::processEvents();
  key(Qt::Key_Comma, Qt::ControlModifier);
  auto* preferences = window_->findChild<PreferencesDialog*>();
  ASSERT_NE(preferences, nullptr);
  preferences->close();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  // "tables sort, are copied and exported where they stand": every table of results has the same menu.
  for (auto* table : window_->currentPage()->findChildren<QTableView*>()) {
    if (!table->isVisible() || table->model()->rowCount() == 0) continue;
    const QPoint at = table->visualRect(table->model()->index(0, 0)).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, table->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(table, &event);
    auto* menu = table->findChild<QMenu*>(QStringLiteral("tableMenu"));
    ASSERT_NE(menu, nullptr) << table->accessibleName().toStdString();
    EXPECT_GE(menu->actions().size(), 4) << table->accessibleName().toStdString();
    menu->close();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }

  // "Closing the window loses nothing; the next start offers the session again."
  window_->close();
  window_ = std::make_unique<MainWindow>();
  window_->show();
  QStringList offered;
  for (const auto* button : window_->welcome()->findChildren<QPushButton*>()) offered << button->text();
  EXPECT_TRUE(offered.join(QLatin1Char('|')).contains(QString::fromStdString(session.filename().string())))
      << offered.join(QLatin1Char('|')).toStdString();
  window_->openSession(QString::fromStdString(session.string()));
  wait();
  EXPECT_NE(window_->session().latest("fit"), nullptr);
}

}  // namespace
}  // namespace spindrift::gui
