// SPDX-License-Identifier: GPL-3.0-or-later
// What keeps the work safe and the user informed: crash, lost folder, notes, help, log; and no memory that is never
// given back.
#include <gtest/gtest.h>
#include <malloc.h>

#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QTableView>
#include <QTest>
#include <QTextBrowser>
#include <algorithm>
#include <cstdio>

#include "core/base/atomic_file.h"
#include "core/math/statistics.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/help_text.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/models/rows_model.h"
#include "widgets/shell/diagnostics.h"
#include "widgets/shell/help_panel.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/shell/welcome_page.h"

namespace spindrift::gui {
namespace {

using RobustnessTest = StoryTest;

TEST_F(RobustnessTest, AfterACrashTheNextStartOffersTheSession) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  const std::filesystem::path session = window_->session().folder();
  EXPECT_TRUE(window_->welcome()->recovery()->sentence().isEmpty());
  window_->closeSession();
  // What a program that was killed leaves behind.
  writeFileAtomically(session / "lock", "process 1 on a machine without power\n");
  window_ = std::make_unique<MainWindow>();
  window_->show();
  EXPECT_TRUE(window_->welcome()->recovery()->sentence().contains(QString::fromStdString(session.filename().string())))
      << window_->welcome()->recovery()->sentence().toStdString();
  QTest::mouseClick(window_->welcome()->recovery()->findChild<QPushButton*>(), Qt::LeftButton);
  wait();
  QTest::qWait(20);
  ASSERT_TRUE(window_->session().isOpen()) << window_->jobBar()->message().toStdString();
  EXPECT_TRUE(window_->jobBar()->message().contains(QStringLiteral("not closed")))
      << window_->jobBar()->message().toStdString();
  EXPECT_TRUE(window_->welcome()->recovery()->sentence().isEmpty());
}

TEST_F(RobustnessTest, AFolderThatVanishesIsSaidAndTheWindowGoesOn) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  const std::filesystem::path session = window_->session().folder();
  const std::filesystem::path away = session.string() + "-away";
  std::filesystem::rename(session, away);
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QStringLiteral("M1/P3/EX")}, QStringLiteral("loose")));
  QTest::qWait(20);
  EXPECT_TRUE(window_->jobBar()->message().contains(QStringLiteral("is not there any more")))
      << window_->jobBar()->message().toStdString();
  EXPECT_TRUE(window_->session().excluded().empty()) << "what was not stored is not shown";
  window_->workflow().goTo(StepId::Model);
  window_->currentPage()->runAll();
  wait();
  EXPECT_TRUE(window_->jobBar()->message().contains(QStringLiteral("is not there any more")))
      << window_->jobBar()->message().toStdString();
  EXPECT_FALSE(std::filesystem::exists(session));
  std::filesystem::rename(away, session);
  window_->currentPage()->runAll();
  wait();
  EXPECT_TRUE(window_->session().result("fit").has_value());
}

TEST_F(RobustnessTest, NotesAreKeptAndCanBeTakenAway) {
  EXPECT_EQ(window_->openNotes(), nullptr) << "nothing is open";
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Model);
  NotesDialog* notes = window_->openNotes();
  ASSERT_NE(notes, nullptr);
  EXPECT_EQ(notes->about()->currentText(), stepTitle(StepId::Model));
  EXPECT_FALSE(notes->addButton()->isEnabled());
  QTest::keyClicks(notes->text(), QStringLiteral("The door was open."));
  QTest::mouseClick(notes->addButton(), Qt::LeftButton);
  ASSERT_EQ(window_->session().notes().size(), 1U);
  EXPECT_EQ(window_->session().notes()[0].text, "The door was open.");
  EXPECT_EQ(window_->session().notes()[0].item, "") << "nothing is picked on this page";
  ASSERT_EQ(notes->rows()->rowCount(), 1);
  notes->findChild<QTableView*>()->setCurrentIndex(notes->rows()->index(0, 0));
  QTest::mouseClick(notes->removeButton(), Qt::LeftButton);
  EXPECT_TRUE(window_->session().notes().empty());
}

TEST_F(RobustnessTest, HelpFollowsTheStepAndIsRemembered) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  EXPECT_FALSE(window_->help()->isVisible());
  window_->helpAction()->trigger();
  ASSERT_TRUE(window_->help()->isVisible());
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    const QString text = window_->help()->text()->toPlainText();
    EXPECT_TRUE(text.startsWith(stepTitle(step))) << text.toStdString();
    EXPECT_GT(text.size(), 300) << stepTitle(step).toStdString();
    EXPECT_TRUE(text.contains(QLatin1Char('=')) || step == StepId::Capture) << "no formula: " << text.toStdString();
    EXPECT_TRUE(text.contains(QChar::ObjectReplacementCharacter)) << "no figure";
  }
  const MainWindow another;
  EXPECT_FALSE(another.help()->isHidden());
}

TEST_F(RobustnessTest, TheLogThatIsSentHoldsNothingPrivate) {
  EXPECT_EQ(withoutPrivateData(QStringLiteral("imported campaign \"Miller Ltd\" from /home/jane/secret/part 7")),
            QStringLiteral("imported campaign \"…\" from …/part 7"));
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Machine);
  const QString file = QString::fromStdString((folder_ / "log.txt").string());
  window_->saveLog(file);
  const std::string text = readFile(file.toStdString());
  EXPECT_NE(text.find("Spindrift " SPINDRIFT_VERSION), std::string::npos);
  EXPECT_NE(text.find("imported campaign"), std::string::npos) << text;
  EXPECT_EQ(text.find("small story"), std::string::npos) << text;
  EXPECT_EQ(text.find(folder_.path().string()), std::string::npos) << text;
}

TEST_F(RobustnessTest, OpeningAndClosingAHundredTimesKeepsTheMemory) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Machine);
  const QString session = QString::fromStdString(window_->session().folder().string());
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    window_->currentPage()->runAll();
    wait();
  }
  const auto cycle = [&](int i) {
    window_->closeSession();
    window_->open(session);
    wait();
    if (i % 3 != 0) return;
    for (const StepId step : {all_steps[static_cast<std::size_t>(i / 3) % all_steps.size()], StepId::Model}) {
      window_->workflow().goTo(step);
      QCoreApplication::processEvents();
    }
  };
  // With nothing open, so that what a page happens to show at the moment does not count.
  struct Heap {
    double small_MB = 0.0;
    double large_MB = 0.0;  ///< blocks that the system gives for themselves: pictures, depth and colour buffers
  };
  const auto heapNow = [&] {
    window_->closeSession();
    wait();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    const struct mallinfo2 info = mallinfo2();
    return Heap{static_cast<double>(info.uordblks) / 1048576.0, static_cast<double>(info.hblkhd) / 1048576.0};
  };
  // All pages are seen once in thirty cycles, so that a leak is in every thirty that follow each other. What a cache or
  // a job that still ran keeps is megabytes, but in few of them, and at other times on a busy machine: the lower
  // quartile of what thirty cycles add sees leaks alone.
  constexpr int round = 30, seen_every = 6;
  std::vector<Heap> heap;
  for (int i = 0; i < 7 * round; ++i) {
    cycle(i);
    if (i >= round && i % seen_every == seen_every - 1) heap.push_back(heapNow());
  }
  std::vector<double> growth_kB;
  for (std::size_t a = 0, b = round / seen_every; b < heap.size(); ++a, ++b)
    growth_kB.push_back((heap[b].small_MB - heap[a].small_MB) * 1024.0 / round);
  const double leaked_kB = quantile(growth_kB, 0.25);
  std::printf("%.2f ... %.2f MB, %.1f kB a cycle; resident %.0f MB\n", heap.front().small_MB, heap.back().small_MB,
              leaked_kB, residentMegabytes());
  EXPECT_LT(leaked_kB, 20.0) << "kB a cycle";
  // The drawing library keeps a few of its buffers or gives them back, at any time; one for every cycle is a leak.
  EXPECT_LT(heap.back().large_MB - heap.front().large_MB, 0.3 * 6 * round);
}

}  // namespace
}  // namespace spindrift::gui
