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
