// SPDX-License-Identifier: GPL-3.0-or-later
// Find a command (Ctrl+K): everything the window can do, found by a few letters and run with Enter.
#include <gtest/gtest.h>

#include <QApplication>
#include <QDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QScrollBar>
#include <QTableView>
#include <QTest>

#include "tests/widgets/support/story_support.h"
#include "widgets/common/languages.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/help_panel.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

void collect(const QMenu& menu, QStringList& titles) {
  for (const QAction* action : menu.actions()) {
    if (action->menu() != nullptr) {
      collect(*action->menu(), titles);
    } else if (!action->isSeparator()) {
      QString title = action->text();
      titles << title.remove(QLatin1Char('&'));
    }
  }
}

class CommandPaletteTest : public StoryTest {
 protected:
  void openPalette() {
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    QTest::keyClick(window_.get(), Qt::Key_K, Qt::ControlModifier);
    QCoreApplication::processEvents();
    palette_ = window_->findChild<QDialog*>(QStringLiteral("commandPalette"));
    ASSERT_NE(palette_, nullptr);
    ASSERT_TRUE(palette_->isVisible());
    field_ = palette_->findChild<QLineEdit*>();
    table_ = palette_->findChild<QTableView*>();
    ASSERT_NE(field_, nullptr);
    ASSERT_NE(table_, nullptr);
  }
  [[nodiscard]] QString cell(int row, int column) const {
    return table_->model()->index(row, column).data().toString();
  }
  /// All titles that are listed now.
  [[nodiscard]] QStringList titles() const {
    QStringList all;
    for (int row = 0; row < table_->model()->rowCount(); ++row) all << cell(row, 0);
    return all;
  }

  QDialog* palette_ = nullptr;
  QLineEdit* field_ = nullptr;
  QTableView* table_ = nullptr;
};

TEST_F(CommandPaletteTest, FindsByAFewLettersAndEnterRuns) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_EQ(QApplication::focusWidget(), field_);
  QTest::keyClicks(field_, QStringLiteral("ltdk"));
  EXPECT_EQ(cell(0, 0), QStringLiteral("Light or dark"));
  EXPECT_EQ(cell(0, 2), QStringLiteral("Ctrl+D"));
  const ThemeKind before = theme().kind;
  QTest::keyClick(field_, Qt::Key_Return);
  QCoreApplication::processEvents();
  EXPECT_NE(theme().kind, before);
  window_->setTheme(before);
  EXPECT_EQ(window_->findChild<QDialog*>(QStringLiteral("commandPalette")), nullptr) << "it is gone";
}

TEST_F(CommandPaletteTest, WordsMayStandInAnyOrderAndTheBestIsFirst) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  QTest::keyClicks(field_, QStringLiteral("session open"));
  EXPECT_EQ(cell(0, 0), QStringLiteral("Open session …"));
  field_->clear();
  QTest::keyClicks(field_, QStringLiteral("NEXT"));
  EXPECT_EQ(cell(0, 0), QStringLiteral("Next"));
  field_->clear();
  QTest::keyClicks(field_, QStringLiteral("qqqqxyz"));
  EXPECT_EQ(table_->model()->rowCount(), 0);
  QTest::keyClick(field_, Qt::Key_Return);  // nothing to run, nothing happens
  EXPECT_TRUE(palette_->isVisible());
}

TEST_F(CommandPaletteTest, TheBeginningOfAWordComesBeforeLettersOfSeveral) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  QTest::keyClicks(field_, QStringLiteral("pre"));
  EXPECT_EQ(cell(0, 0), QStringLiteral("Preferences …"));
  EXPECT_TRUE(titles().contains(QStringLiteral("Print the report …")));
}

TEST_F(CommandPaletteTest, KeysAreInSightInGermanToo) {
  applyLanguage(QStringLiteral("de"));
  window_ = std::make_unique<MainWindow>();
  window_->resize(1280, 800);
  window_->show();
  window_->startDemo(QStringLiteral("discrepancy"), true);
  wait();
  openPalette();
  applyLanguage(QStringLiteral("en"));
  ASSERT_FALSE(HasFatalFailure());
  wait();
  palette_->grab();  // lays out
  EXPECT_EQ(cell(0, 1), QStringLiteral("Sitzung"));
  EXPECT_EQ(table_->horizontalScrollBar()->maximum(), 0);
  EXPECT_LT(palette_->width(), window_->width());
}

TEST_F(CommandPaletteTest, EscapeClosesAndRunsNothing) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  const ThemeKind before = theme().kind;
  QTest::keyClicks(field_, QStringLiteral("light or dark"));
  QTest::keyClick(field_, Qt::Key_Escape);
  QCoreApplication::processEvents();
  EXPECT_EQ(theme().kind, before);
  EXPECT_EQ(window_->findChild<QDialog*>(QStringLiteral("commandPalette")), nullptr);
}

TEST_F(CommandPaletteTest, HoldsEveryActionOfEveryMenuDemosAndHelp) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  const QStringList all = titles();
  QStringList wanted;
  for (const QAction* top : window_->menuBar()->actions()) collect(*top->menu(), wanted);
  EXPECT_GT(wanted.size(), 25);
  for (const QString& title : wanted) {
    if (title == QStringLiteral("Find a command …")) continue;  // it is open already
    EXPECT_TRUE(all.contains(title)) << title.toStdString();
  }
  for (const Demo& demo : demos()) EXPECT_TRUE(all.contains(demo.title)) << demo.name;
  QTest::keyClicks(field_, QStringLiteral("help discrepancy"));
  EXPECT_TRUE(cell(0, 0).contains(QStringLiteral("Discrepancy"))) << cell(0, 0).toStdString();
  QTest::keyClick(field_, Qt::Key_Return);
  QCoreApplication::processEvents();
  bool shown = false;
  for (const HelpPanel* help : window_->findChildren<HelpPanel*>()) shown = shown || help->isVisible();
  EXPECT_TRUE(shown) << "help is there without a session too";
}

TEST_F(CommandPaletteTest, WhatCannotBeRunSaysWhy) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  QTest::keyClicks(field_, QStringLiteral("go model"));
  EXPECT_EQ(cell(0, 0), QStringLiteral("Model"));
  EXPECT_TRUE(cell(0, 1).contains(QStringLiteral("Open a session first"))) << cell(0, 1).toStdString();
  QTest::keyClick(field_, Qt::Key_Return);
  QCoreApplication::processEvents();
  EXPECT_TRUE(palette_->isVisible()) << "nothing was run";
  field_->clear();
  QTest::keyClicks(field_, QStringLiteral("undo"));
  EXPECT_TRUE(cell(0, 1).contains(QStringLiteral("nothing to undo"))) << cell(0, 1).toStdString();
}

TEST_F(CommandPaletteTest, HoldsThePanelsAndTheButtonsOfThePage) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Machine);
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  QTest::keyClicks(field_, QStringLiteral("machine connections"));
  EXPECT_EQ(cell(0, 0), QStringLiteral("Connections"));
  QTest::keyClick(field_, Qt::Key_Return);
  QCoreApplication::processEvents();
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  QTest::keyClicks(field_, QStringLiteral("go model"));
  EXPECT_FALSE(cell(0, 1).contains(QStringLiteral("Open a session first"))) << cell(0, 1).toStdString();
  QTest::keyClick(field_, Qt::Key_Return);
  QCoreApplication::processEvents();
  wait();
  EXPECT_EQ(window_->workflow().current(), StepId::Model);
}

TEST_F(CommandPaletteTest, ArrowsMoveTheChoiceWhileTypingGoesOn) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_EQ(table_->currentIndex().row(), 0);
  QTest::keyClick(field_, Qt::Key_Down);
  EXPECT_EQ(table_->currentIndex().row(), 1);
  QTest::keyClick(field_, Qt::Key_Up);
  EXPECT_EQ(table_->currentIndex().row(), 0);
  EXPECT_EQ(QApplication::focusWidget(), field_);
  QTest::keyClicks(field_, QStringLiteral("a"));
  EXPECT_EQ(table_->currentIndex().row(), 0);
}

TEST_F(CommandPaletteTest, AScreenReaderIsTold) {
  openPalette();
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_FALSE(field_->accessibleName().isEmpty());
  EXPECT_FALSE(table_->accessibleName().isEmpty());
  QTest::keyClicks(field_, QStringLiteral("go model"));
  const QString spoken = table_->model()->index(0, 1).data(Qt::AccessibleTextRole).toString();
  EXPECT_TRUE(spoken.contains(QStringLiteral("Open a session first"))) << spoken.toStdString();
}

}  // namespace
}  // namespace spindrift::gui
