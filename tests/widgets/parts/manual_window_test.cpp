// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/manual_window.h"

#include <gtest/gtest.h>

#include <QListWidget>
#include <QSignalSpy>
#include <QTest>

#include "core/base/atomic_file.h"
#include "core/workflows/manual.h"
#include "tests/support/temp_folder.h"
#include "widgets/report/page_view.h"

namespace spindrift::gui {
namespace {

TEST(ManualWindow, ChaptersLeadToTheirPages) {
  const testing::TempFolder folder;
  const std::string file = (folder / "manual.pdf").string();
  writeFileAtomically(file, pdfOf(manual("# commands\n\n## fit\n\nFits.\n")).bytes);
  ManualWindow window(QString::fromStdString(file));
  QSignalSpy opened(&window, &ManualWindow::opened);
  window.show();
  ASSERT_TRUE(opened.wait(20'000));
  EXPECT_EQ(opened.front().front().toString(), QString());
  const QListWidget* chapters = window.chapters();
  ASSERT_GE(chapters->count(), 10);
  EXPECT_EQ(chapters->item(chapters->count() - 1)->text(), QStringLiteral("commands"));
  window.chapters()->setCurrentRow(chapters->count() - 1);
  QTest::qWait(50);
  EXPECT_EQ(window.pages()->currentPage(), chapters->item(chapters->count() - 1)->data(Qt::UserRole).toInt());
  EXPECT_GT(window.pages()->currentPage(), 20);
}

TEST(ManualWindow, ATextIsFoundOnEveryPageAndGoneThrough) {
  const testing::TempFolder folder;
  const std::string file = (folder / "manual.pdf").string();
  Report report("Title", "Version");
  report.section("first").paragraph("One Zwiebelfisch here.");
  for (int i = 0; i < 200; ++i) report.paragraph("A line that fills the page.");
  report.section("last").paragraph("Another zwiebelfisch, and a ZWIEBELFISCH.");
  writeFileAtomically(file, pdfOf(report).bytes);
  ManualWindow window(QString::fromStdString(file));
  QSignalSpy opened(&window, &ManualWindow::opened);
  QSignalSpy searched(&window, &ManualWindow::searched);
  window.show();
  ASSERT_TRUE(opened.wait(20'000));
  const auto lookFor = [&](const QString& text) {
    window.findField()->setText(text);
    return searched.wait(20'000);
  };
  ASSERT_TRUE(lookFor(QStringLiteral("zwiebelfisch")));
  const std::vector<ReportPages::Match> matches = window.pages()->matches();
  ASSERT_EQ(matches.size(), 3U);
  EXPECT_EQ(matches[0].page, 0);
  EXPECT_GT(matches[1].page, 1);
  for (const ReportPages::Match& match : matches) EXPECT_TRUE(QRectF(0, 0, 1, 1).contains(match.area));
  EXPECT_EQ(window.findText(), QStringLiteral("1 of 3"));
  QTest::keyClick(window.findField(), Qt::Key_Return);
  EXPECT_EQ(window.findText(), QStringLiteral("2 of 3"));
  EXPECT_EQ(window.pages()->currentPage(), matches[1].page);
  QTest::keyClick(window.findField(), Qt::Key_Return, Qt::ShiftModifier);
  QTest::keyClick(window.findField(), Qt::Key_Return, Qt::ShiftModifier);
  EXPECT_EQ(window.findText(), QStringLiteral("3 of 3")) << "round and round";
  ASSERT_TRUE(lookFor(QStringLiteral("onion fish")));
  EXPECT_EQ(window.findText(), QStringLiteral("Not found"));
  ASSERT_TRUE(lookFor(QString()));
  EXPECT_EQ(window.findText(), QString());
  EXPECT_TRUE(window.pages()->matches().empty());
}

TEST(ManualWindow, AFileThatIsNoneIsSaid) {
  const testing::TempFolder folder;
  ManualWindow window(QString::fromStdString(folder.write("manual.pdf", "nothing").string()));
  QSignalSpy opened(&window, &ManualWindow::opened);
  ASSERT_TRUE(opened.wait(20'000));
  EXPECT_NE(opened.front().front().toString(), QString());
  EXPECT_TRUE(window.chapters()->item(0)->text().startsWith(QStringLiteral("The manual cannot be shown")));
}

}  // namespace
}  // namespace spindrift::gui
