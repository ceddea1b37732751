// SPDX-License-Identifier: GPL-3.0-or-later
// From nothing to a report to sign, as a new user does it on the window: what is to be pressed next is the one primary
// button; actions and the program's own time are counted.
#include <gtest/gtest.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QPushButton>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>

#include "core/base/atomic_file.h"
#include "core/base/count_text.h"
#include "tests/support/source_folder.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/pages/report/report_page.h"

namespace spindrift::gui {
namespace {

/// Widgets that are shown as windows of their own: such a one takes the focus, and with it the keys, from the program.
class StrayWindows : public QObject {
 public:
  QStringList shown;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    const auto* widget = qobject_cast<const QWidget*>(watched);
    if (event->type() == QEvent::Show && widget != nullptr && widget->isWindow())
      shown << QString::fromLatin1(widget->metaObject()->className()) + QLatin1Char(' ') + widget->accessibleName();
    return false;
  }
};

/// Actions of the user, and how long the program took after them.
class FirstReportTest : public StoryTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void click(QPushButton* button) {
    ASSERT_TRUE(button != nullptr && button->isVisible() && button->isEnabled());
    ++clicks_;
    timer_.start();
    QTest::mouseClick(button, Qt::LeftButton);
    wait();
    QCoreApplication::processEvents();
    wait();
    program_ms_ += timer_.elapsed();
  }
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers) {
    ++keys_;
    timer_.start();
    QTest::keyClick(window_.get(), key, modifiers);
    wait();
    QCoreApplication::processEvents();
    wait();
    program_ms_ += timer_.elapsed();
  }
  void startDemo() {
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    // A click on its card makes the demo in full, which takes longer than a test may.
    ++clicks_;
    timer_.start();
    window_->startDemo(QString::fromLatin1(GetParam()), true);
    wait();
    program_ms_ += timer_.elapsed();
    ASSERT_NE(window_->session().campaign(), nullptr);
  }
  /// `way`: its row in resources/docs/first_hour.md.
  void expectReport(const std::string& way) {
    ASSERT_EQ(window_->workflow().current(), StepId::Report)
        << stepTitle(window_->workflow().current()).toStdString() << ": "
        << static_cast<int>(window_->workflow().status(window_->workflow().current()).state) << " "
        << window_->workflow().status(window_->workflow().current()).sentence.toStdString() << " | "
        << window_->jobBar()->message().toStdString();
    EXPECT_EQ(window_->workflow().status(StepId::Report).state, StepState::Current);
    const StoredResult* report = window_->session().latest("report");
    ASSERT_NE(report, nullptr);
    const auto file = window_->session().folder() / report->payload.value("pdf", std::string());
    EXPECT_EQ(readFile(file).rfind("%PDF", 0), 0U) << file;
    std::printf("%s: %s: %d clicks, %d keys, %.1f s of the program\n", GetParam(), way.c_str(), clicks_, keys_,
                static_cast<double>(program_ms_) / 1000.0);
    std::string told = readFile(spindrift::testing::sourceFolder() / "resources/docs/first_hour.md");
    const std::size_t section =
        told.find(GetParam() == std::string("holes") ? "## Hole bar" : "## Fiducials of your own artwork");
    ASSERT_NE(section, std::string::npos);
    told = told.substr(section, told.find("\n## ", section) - section);
    const std::string actions = countOf(clicks_, "click") + ", " + countOf(keys_, "key");
    EXPECT_NE(told.find("| " + way + " | " + actions + " |"), std::string::npos) << way << ": " << actions;
  }

  int clicks_ = 0;
  int keys_ = 0;
  qint64 program_ms_ = 0;
  QElapsedTimer timer_;
};

TEST_P(FirstReportTest, OneButtonLeadsFromTheDemoToTheReport) {
  startDemo();
  constexpr int most_clicks = 20;
  while (clicks_ < most_clicks && window_->workflow().status(StepId::Report).state != StepState::Current)
    click(window_->dueButton());
  expectReport("Mouse, the one primary button of each page");
  // Each step once to run it and once to leave it, at most.
  EXPECT_LE(clicks_, 2 * static_cast<int>(all_steps.size()) - 4);
}

/// What a user did before one button was marked as the one to press: runs what each page is for, where it is not done,
/// and goes on. Every enabled button in sight is one to choose from.
TEST_P(FirstReportTest, EachPagesOwnButtonsLeadToTheReport) {
  startDemo();
  qsizetype fewest = std::numeric_limits<qsizetype>::max();
  qsizetype most = 0;
  const auto choose = [&](QPushButton* button) {
    const auto buttons = window_->findChildren<QPushButton*>();
    const auto pressable = std::count_if(buttons.begin(), buttons.end(),
                                         [](const QPushButton* b) { return b->isVisible() && b->isEnabled(); });
    fewest = std::min<qsizetype>(fewest, pressable);
    most = std::max<qsizetype>(most, pressable);
    click(button);
  };
  for (std::size_t i = 0; i < all_steps.size(); ++i) {
    const StepId step = window_->workflow().current();
    ASSERT_EQ(step, all_steps[i]);
    QPushButton* run = window_->currentPage()->primaryButton();
    const bool done = window_->workflow().status(step).state == StepState::Current;
    if (run != nullptr && run->isVisible() && run->isEnabled() && !done) choose(run);
    if (step != StepId::Report) choose(window_->nextButton());
  }
  std::printf("%s: chosen among %d to %d buttons\n", GetParam(), static_cast<int>(fewest), static_cast<int>(most));
  expectReport("Mouse, the buttons of each page");
}

TEST_P(FirstReportTest, ControlReturnAloneLeadsFromTheDemoToTheReport) {
  startDemo();
  StrayWindows stray;
  qApp->installEventFilter(&stray);
  constexpr int most_keys = 20;
  while (keys_ < most_keys && window_->workflow().status(StepId::Report).state != StepState::Current) {
    press(Qt::Key_Return, Qt::ControlModifier);
  }
  expectReport("Keyboard, Ctrl+Return");
  EXPECT_TRUE(stray.shown.isEmpty()) << stray.shown.join(QStringLiteral(", ")).toStdString();
}

TEST_P(FirstReportTest, OneCommandRunsAllSteps) {
  startDemo();
  press(Qt::Key_Return, Qt::ControlModifier | Qt::ShiftModifier);
  for (int turn = 0; turn < 200 && window_->workflow().status(StepId::Report).state != StepState::Current; ++turn) {
    QTest::qWait(20);
    wait();
  }
  expectReport("Go > Run all steps, Ctrl+Shift+Return");
}

INSTANTIATE_TEST_SUITE_P(Demos, FirstReportTest, ::testing::Values("holes", "own_pattern"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace spindrift::gui
