// SPDX-License-Identifier: GPL-3.0-or-later
// What every table of results can do.
#include "widgets/common/table_habits.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QScrollBar>
#include <QTableView>
#include <QTableWidget>
#include <QTest>

#include "widgets/common/editor_table.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/export/exportable.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"

namespace spindrift::gui {
namespace {

class TableHabitsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    table_.reset(makeTable(&model_, QStringLiteral("Points")));
    model_.setRows(rows({"−5.1", "12.4 ± 0.3", "–", "3.2", "100", ""}));
    table_->resize(500, 400);
    table_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(table_.get()));
  }
  static std::vector<Row> rows(const std::vector<const char*>& values) {
    std::vector<Row> rows;
    int number = 12;
    for (const char* value : values) {
      Row row;
      row.id = QStringLiteral("F%1").arg(--number);
      row.cells = {{row.id}, {QString::fromUtf8(value)}};
      rows.push_back(std::move(row));
    }
    return rows;
  }
  void clickHeader(int column) {
    QHeaderView* header = table_->horizontalHeader();
    const QPoint at(header->sectionViewportPosition(column) + 8, header->height() / 2);
    QTest::mouseClick(header->viewport(), Qt::LeftButton, Qt::NoModifier, at);
    QCoreApplication::processEvents();
  }
  [[nodiscard]] QStringList shown(int column) const {
    QStringList texts;
    for (const int row : shownRows(*table_)) texts << model_.index(row, column).data().toString();
    return texts;
  }
  QMenu* openMenu(int row) {
    const QPoint at = table_->visualRect(model_.index(row, 1)).center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, table_->viewport()->mapToGlobal(at));
    QCoreApplication::sendEvent(table_.get(), &event);
    return table_->findChild<QMenu*>(QStringLiteral("tableMenu"));
  }
  void choose(int row, const char* action) {
    QMenu* menu = openMenu(row);
    ASSERT_NE(menu, nullptr);
    auto* found = menu->findChild<QAction*>(QLatin1String(action));
    ASSERT_NE(found, nullptr) << action;
    found->trigger();
    menu->close();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QCoreApplication::processEvents();
  }

  RowsModel model_{{QStringLiteral("Point"), QStringLiteral("X / µm")}};
  std::unique_ptr<QTableView> table_;
};

// Six rows in a table that has room for two and two thirds of them.
TEST_F(TableHabitsTest, ShowsWholeRowsOnly) {
  /// First and last line of pixels with anything but the ground.
  const auto seen = [this] {
    QCoreApplication::processEvents();
    const QImage picture = table_->viewport()->grab().toImage();
    const QRgb ground = picture.pixel(picture.width() - 3, picture.height() / 2);
    std::pair<int, int> lines{-1, -1};
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        if (picture.pixel(x, y) == ground) continue;
        if (lines.first < 0) lines.first = y;
        lines.second = y;
      }
    }
    return lines;
  };
  const int row_height = table_->rowHeight(0);
  table_->resize(500, table_->horizontalHeader()->height() + row_height * 2 + 24);
  EXPECT_LT(seen().second, 2 * row_height) << "the third has no room";
  EXPECT_GT(seen().second, row_height);
  table_->scrollToBottom();
  EXPECT_LT(seen().first, row_height) << "the last two begin below the titles, where rows always do";
  EXPECT_LT(seen().second, 2 * row_height) << "what is left over is below them";
  EXPECT_GT(seen().second, row_height);
  EXPECT_EQ(table_->rowViewportPosition(4), 0);
  table_->verticalScrollBar()->setValue(1);
  EXPECT_EQ(table_->rowViewportPosition(1), 0);
}

TEST_F(TableHabitsTest, AClickSortsNumbersAsNumbersAndAThirdOneGoesBack) {
  const QStringList as_given = shown(1);
  clickHeader(1);
  EXPECT_EQ(shown(1), QStringList({"−5.1", "3.2", "12.4 ± 0.3", "100", "–", ""}));
  EXPECT_TRUE(table_->horizontalHeader()->isSortIndicatorShown());
  clickHeader(1);
  EXPECT_EQ(shown(1), QStringList({"100", "12.4 ± 0.3", "3.2", "−5.1", "–", ""})) << "nothing is last either way";
  clickHeader(1);
  EXPECT_EQ(shown(1), as_given);
  EXPECT_FALSE(table_->horizontalHeader()->isSortIndicatorShown());
  clickHeader(0);
  EXPECT_EQ(shown(0), QStringList({"F6", "F7", "F8", "F9", "F10", "F11"})) << "F9 before F10";
}

TEST_F(TableHabitsTest, RowsStayWhatTheyAreForThePage) {
  table_->selectRow(3);
  clickHeader(1);
  EXPECT_EQ(table_->currentIndex().row(), 3);
  EXPECT_EQ(model_.idAt(table_->currentIndex().row()), QStringLiteral("F8"));
  // What is clicked is what is seen there: the second from the top is "3.2".
  const QRect second = table_->visualRect(model_.index(3, 0));
  EXPECT_EQ(second.top(), table_->rowHeight(0));
  QTest::mouseClick(table_->viewport(), Qt::LeftButton, Qt::NoModifier, QPoint(10, 5));
  EXPECT_EQ(model_.idAt(table_->currentIndex().row()), QStringLiteral("F11")) << "the smallest is on top";
  QTest::keyClick(table_.get(), Qt::Key_Down);
  EXPECT_EQ(model_.idAt(table_->currentIndex().row()), QStringLiteral("F8")) << "arrows go as the eye does";
}

TEST_F(TableHabitsTest, NewRowsAreSortedToo) {
  clickHeader(1);
  model_.setRows(rows({"7", "6", "5"}));
  QCoreApplication::processEvents();
  EXPECT_EQ(shown(1), QStringList({"5", "6", "7"}));
  model_.setRows(rows({"1", "3", "2"}));  // as many: no reset
  QCoreApplication::processEvents();
  EXPECT_EQ(shown(1), QStringList({"1", "2", "3"}));
}

TEST_F(TableHabitsTest, SeveralRowsAreCopiedWithHeadersAsTheyAreShown) {
  clickHeader(1);
  QTest::mouseClick(table_->viewport(), Qt::LeftButton, Qt::NoModifier, QPoint(10, 5));
  QTest::mouseClick(table_->viewport(), Qt::LeftButton, Qt::ShiftModifier, QPoint(10, 2 * table_->rowHeight(0) + 5));
  EXPECT_EQ(table_->selectionModel()->selectedRows().size(), 3);
  QTest::keyClick(table_.get(), Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(QApplication::clipboard()->text(), QStringLiteral("Point\tX / µm\nF11\t-5.1\nF8\t3.2\nF10\t12.4 ± 0.3\n"));
  choose(0, "copy");
  EXPECT_EQ(QApplication::clipboard()->text(), QStringLiteral("F11\t-5.1\nF8\t3.2\nF10\t12.4 ± 0.3\n"));
  choose(0, "selectAll");
  EXPECT_EQ(table_->selectionModel()->selectedRows().size(), 6);
  table_->clearSelection();
  choose(0, "copyWithHeaders");
  EXPECT_EQ(QApplication::clipboard()->text().count(QLatin1Char('\n')), 7) << "nothing selected: all of it";
}

TEST_F(TableHabitsTest, TheMenuSortsForWhoHasNoMouse) {
  choose(0, "sortDown");
  EXPECT_EQ(shown(1).front(), QStringLiteral("100"));
  choose(0, "unsorted");
  EXPECT_EQ(shown(1).front(), QStringLiteral("−5.1"));
}

TEST_F(TableHabitsTest, NoFormulaGetsIntoASpreadsheetAndNumbersStayNumbers) {
  model_.setRows(rows({"=1+1", "−7.5", "a, \"b\"", "two\tparts"}));
  const std::vector<int> all{0, 1, 2, 3};
  EXPECT_EQ(tableText(model_, all, {1}, false, TableText::Csv),
            QStringLiteral("'=1+1\n-7.5\n\"a, \"\"b\"\"\"\ntwo\tparts\n"));
  EXPECT_EQ(tableText(model_, all, {1}, false, TableText::Tabs), QStringLiteral("'=1+1\n-7.5\na, \"b\"\ntwo parts\n"));
  EXPECT_TRUE(tableCsv(model_).contains(QStringLiteral("F10,-7.5\n"))) << tableCsv(model_).toStdString();
}

/// The last column takes what the others leave, and never less than what is in it: at every width, whichever way it was
/// reached.
TEST(EditorTableTest, KeepsTheLastColumnWholeAtEveryWidth) {
  const std::unique_ptr<QTableWidget> table(
      makeEditor({QStringLiteral("Axis"), QStringLiteral("Fixed bearing\n/ mm"), QStringLiteral("Scale")},
                 QStringLiteral("Linear axes")));
  table->resize(700, 300);
  table->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(table.get()));
  const auto expectWhole = [&table](const char* when) {
    QCoreApplication::processEvents();
    const int needed = table->fontMetrics().horizontalAdvance(QStringLiteral("rotary encoder")) + 12;
    EXPECT_GE(table->columnWidth(2), needed) << when << " at " << table->width();
  };
  table->setRowCount(1);
  for (int column = 0; const char* text : {"X", "0", "rotary encoder"})
    setText(table.get(), 0, column++, QString::fromLatin1(text));
  expectWhole("filled");
  for (const int width : {260, 240, 220, 200, 180, 700, 180, 230}) {
    table->resize(width, 300);
    expectWhole("resized");
  }
  table->setRowCount(0);
  table->setRowCount(1);
  for (int column = 0; const char* text : {"X", "0", "rotary encoder"})
    setText(table.get(), 0, column++, QString::fromLatin1(text));
  expectWhole("filled again");
}

TEST(SentenceTableTest, LinesOfTwoRowsStandFurtherApartThanThoseOfOne) {
  RowsModel model({QStringLiteral("What"), QStringLiteral("Why")});
  std::unique_ptr<QTableView> table(makeSentenceTable(&model, QStringLiteral("Reasons"), {}));
  Row row;
  row.id = QStringLiteral("F1");
  row.cells = {{row.id},
               {QStringLiteral("a sentence that needs more than one line in the room that is left for it here")}};
  model.setRows({row, row});
  table->resize(260, 400);
  table->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(table.get()));
  table->resizeRowsToContents();
  const int line = QFontMetrics(table->font()).lineSpacing();
  ASSERT_GT(table->rowHeight(0), 2 * line) << "the sentence is to have several lines";
  EXPECT_GE(table->rowHeight(0) % line, 6) << table->rowHeight(0) << " px of lines of " << line << " px";
}

TEST(NumberTileTest, TilesBesideOneWithMoreLinesKeepTheirHeight) {
  QWidget window;
  auto* line = new QHBoxLayout(&window);
  auto* brief = new NumberTile(QStringLiteral("Touches"));
  auto* wordy = new NumberTile(QStringLiteral("Length"));
  line->addWidget(brief, 1);
  line->addWidget(wordy, 1);
  brief->set(QStringLiteral("1440"), QStringLiteral("none"));
  wordy->set(QStringLiteral("0.36"),
             QStringLiteral("deviation of a hole from the line, over all cycles of the campaign"));
  window.resize(300, 200);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  const auto places = [&](NumberTile* tile) {
    std::vector<int> tops;
    for (const QLabel* label : tile->findChildren<QLabel*>()) tops.push_back(label->mapTo(&window, QPoint()).y());
    return tops;
  };
  EXPECT_EQ(places(brief), places(wordy));
}

TEST(WordsTest, ASymbolKeepsItsCaseAtTheStartOfASentence) {
  EXPECT_EQ(sentenceStart(QStringLiteral("größte Abweichung")), QStringLiteral("Größte Abweichung"));
  EXPECT_EQ(sentenceStart(QStringLiteral("überlauf")), QStringLiteral("Überlauf"));
  EXPECT_EQ(sentenceStart(QStringLiteral("α um X")), QStringLiteral("α um X"));
  Callout callout;
  callout.show(Tone::Attention, QStringLiteral("α about X cannot be determined."));
  EXPECT_EQ(callout.sentence(), QStringLiteral("α about X cannot be determined."));
}

TEST(WordsTest, NoLineEndsBetweenANumberAndItsUnit) {
  const auto shown = [](const char* text) {
    return keptTogether(QString::fromUtf8(text)).replace(QChar(0xa0), QLatin1Char('_')).toStdString();
  };
  EXPECT_EQ(shown("the noise alone is 0.55 µm."), "the noise alone is 0.55_µm.");
  EXPECT_EQ(shown("0,6 ± 0,4 µm/h in 3 states"), "0,6_±_0,4_µm/h in 3 states");
  EXPECT_EQ(shown("x 20, y 15, z 0 mm, spindle 0°"), "x_20, y_15, z_0_mm, spindle 0°");
  EXPECT_EQ(shown("Certificate ± / µm"), "Certificate ± /_µm");
  EXPECT_EQ(shown("Expansion / (µm/(m·K))"), "Expansion /_(µm/(m·K))");
  EXPECT_EQ(shown("5 measured points"), "5 measured points");
  Callout callout;
  callout.show(Tone::Attention, QStringLiteral("the noise alone is 0.55 µm."));
  EXPECT_EQ(callout.sentence(), QStringLiteral("The noise alone is 0.55 µm."));
  EXPECT_NE(callout.findChild<WrappedLabel*>()->text().indexOf(QStringLiteral("0.55\u00a0µm")), -1);
}

/// The comparison of two states becomes one of four: the titles come first, the numbers below them later.
TEST(TableOfNumbers, TheLastColumnStandsBesideTheOthersWhenThereAreMore) {
  RowsModel model({QStringLiteral("Point"), QStringLiteral("1 / µm")});
  const std::unique_ptr<QTableView> table(makeTable(&model, QStringLiteral("Points")));
  const auto fill = [&](int numbers) {
    std::vector<Row> rows(3);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].id = QStringLiteral("F%1").arg(i);
      rows[i].cells = {nameCell(rows[i].id)};
      for (int n = 0; n < numbers; ++n) rows[i].cells.push_back(numberCell(1.5 * n, 1));
    }
    QStringList titles{QStringLiteral("Point")};
    for (int n = 1; n <= numbers; ++n) titles << QStringLiteral("%1 / µm").arg(n);
    model.setHeaders(titles);
    model.setRows(std::move(rows));
  };
  for (const int numbers : {1, 2, 4}) {
    fill(numbers);
    EXPECT_FALSE(table->horizontalHeader()->stretchLastSection()) << numbers;
  }
}

}  // namespace
}  // namespace spindrift::gui
