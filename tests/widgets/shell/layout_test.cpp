// SPDX-License-Identifier: GPL-3.0-or-later
// Every page of every demo fits the window in every language: at 1440 x 900 and 1280 x 800 with the help open, on a
// small screen of 1280 x 800 and on a large one of 1920 x 1080 without it, nothing is pushed out sideways, no text is
// cut, whether of a label, a tab, a cell or a field, no plot squeezed, no table without rows, with half a row or with
// columns out of sight, no word of a file stands for one of the field, one button at most is the primary one, and that
// which runs the step is in sight, and every page comes to rest. What the tour shows beside the pages is looked at too.
#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QCoreApplication>
#include <QHeaderView>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QSplitter>
#include <QStyleOptionComboBox>
#include <QStyledItemDelegate>
#include <QTabBar>
#include <QTableView>
#include <QTemporaryDir>
#include <QTest>
#include <QTextDocumentFragment>
#include <QTextEdit>
#include <QTimer>
#include <QTreeView>
#include <QVBoxLayout>
#include <set>
#include <tuple>

#include "tests/widgets/support/story_support.h"
#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/plots/plot.h"
#include "widgets/services/incoming_service.h"
#include "widgets/shell/help_panel.h"
#include "widgets/shell/tour.h"
#include "widgets/shell/tour_details.h"
#include "widgets/shell/welcome_page.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

/// The widgets that ask for the width, from the page down: where to look when a page is too wide.
std::string whatIsWide(const QWidget& widget, int depth = 0) {
  std::string text;
  for (const QWidget* child : widget.findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
    const int width = std::max(child->minimumSizeHint().width(), child->minimumWidth());
    if (width < 280) continue;  // hidden ones too: the pages of a stack count whether shown or not
    text += "\n" + std::string(static_cast<std::size_t>(2 * depth + 2), ' ') + std::to_string(width) + " " +
            child->metaObject()->className() + " " + child->accessibleName().toStdString();
    text += whatIsWide(*child, depth + 1);
  }
  return text;
}

/// Of the widgets around it the first that is smaller than what is in it; null: all of it is seen, or can be scrolled
/// to.
const QWidget* clippedBy(const QWidget& widget) {
  QRect place = widget.rect();
  const QWidget* inner = &widget;
  for (const QWidget* w = widget.parentWidget(); w != nullptr && !inner->isWindow(); w = w->parentWidget()) {
    place.translate(inner->pos());
    if (qobject_cast<const QAbstractScrollArea*>(w) != nullptr) return nullptr;
    if (const auto* area = qobject_cast<const QAbstractScrollArea*>(w->parentWidget());
        area != nullptr && area->viewport() == w)
      return nullptr;
    if (!w->rect().contains(place)) return w;
    inner = w;
  }
  return nullptr;
}

QString shownText(const QTableView& table, const QModelIndex& index) {
  const auto* delegate = qobject_cast<const QStyledItemDelegate*>(table.itemDelegateForIndex(index));
  return delegate == nullptr ? index.data().toString() : delegate->displayText(index.data(), QLocale());
}

/// What stands in the cells that are seen but has no room there.
QStringList cutCells(const QTableView& table) {
  constexpr int padding = 6;  // of the style sheet
  QStringList cut;
  const QAbstractItemModel* model = table.model();
  for (int row = 0; model != nullptr && row < model->rowCount(); ++row) {
    for (int column = 0; column < model->columnCount(); ++column) {
      const QModelIndex index = model->index(row, column);
      const QString text = shownText(table, index);
      const QRect cell = table.visualRect(index);
      if (text.isEmpty() || !cell.isValid() || !table.viewport()->rect().contains(cell)) continue;
      if (table.indexWidget(index) != nullptr) continue;
      const QVariant font = index.data(Qt::FontRole);
      const QFontMetrics metrics(font.isValid() ? font.value<QFont>() : table.font());
      const int icon = table.iconSize().isValid()
                           ? table.iconSize().width()
                           : table.style()->pixelMetric(QStyle::PM_SmallIconSize, nullptr, &table);
      const QVariant decoration = index.data(Qt::DecorationRole);
      const bool none = decoration.isNull() || (decoration.canConvert<QIcon>() && decoration.value<QIcon>().isNull());
      const int width = cell.width() - 2 * padding - (none ? 0 : icon);
      const bool fits =
          table.wordWrap()
              ? metrics.boundingRect(QRect(0, 0, width, 10000), Qt::TextWordWrap, text).height() <= cell.height() + 1 &&
                    metrics.boundingRect(QRect(0, 0, width, 10000), Qt::TextWordWrap, text).width() <= width + 1
              : metrics.horizontalAdvance(text) <= width + 1;
      if (!fits) cut << QStringLiteral("cell of %1: %2").arg(table.accessibleName(), text);
    }
  }
  return cut;
}

/// Items of a tree that are seen, and whose text has no room in the place that the style gives it.
QStringList cutItems(const QTreeView& tree) {
  QStringList cut;
  const QRect seen = tree.viewport()->rect();
  for (QModelIndex item = tree.indexAt(QPoint(0, 0)); item.isValid(); item = tree.indexBelow(item)) {
    QStyleOptionViewItem option;
    option.initFrom(&tree);
    option.rect = tree.visualRect(item);
    if (option.rect.top() > seen.bottom()) break;
    const QString text = item.data().toString();
    if (text.isEmpty()) continue;
    const QVariant font = item.data(Qt::FontRole);
    if (font.isValid()) option.font = font.value<QFont>();
    option.fontMetrics = QFontMetrics(option.font);
    option.features = QStyleOptionViewItem::HasDisplay;
    option.text = text;
    if (tree.wordWrap()) option.features |= QStyleOptionViewItem::WrapText;
    if (item.data(Qt::CheckStateRole).isValid()) option.features |= QStyleOptionViewItem::HasCheckIndicator;
    const int margin = tree.style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, &tree) + 1;
    const QRect room =
        tree.style()->subElementRect(QStyle::SE_ItemViewItemText, &option, &tree).adjusted(margin, 0, -margin, 0);
    const QRect needed =
        option.fontMetrics.boundingRect(QRect(0, 0, room.width(), 10000), tree.wordWrap() ? Qt::TextWordWrap : 0, text);
    if (needed.width() > room.width() + 1 || needed.height() > room.height() + 1)
      cut << QStringLiteral("item of %1: %2").arg(tree.accessibleName(), text);
  }
  return cut;
}

/// Texts that need more room than they have.
QStringList cutTexts(const QWidget& root) {
  QStringList cut;
  for (QWidget* w : root.findChildren<QWidget*>()) {
    if (!w->isVisible() || w->width() <= 0) continue;
    if (const auto* label = qobject_cast<QLabel*>(w); label != nullptr && !label->text().isEmpty()) {
      if (const QWidget* by = clippedBy(*label); by != nullptr)
        cut << QStringLiteral("%1 around: %2").arg(QLatin1String(by->metaObject()->className()), label->text());
    }
    if (const auto* bar = qobject_cast<QTabBar*>(w); bar != nullptr && bar->count() > 0) {
      int all = 0;
      for (int i = 0; i < bar->count(); ++i) all += bar->isTabVisible(i) ? bar->tabRect(i).width() : 0;
      if (all > bar->width()) cut << QStringLiteral("tabs, of which the last is ") + bar->tabText(bar->count() - 1);
    }
    if (const auto* table = qobject_cast<QTableView*>(w)) cut << cutCells(*table);
    if (const auto* tree = qobject_cast<QTreeView*>(w)) cut << cutItems(*tree);
    if (const auto* plot = qobject_cast<Plot*>(w); plot != nullptr && !plot->empty()) {
      for (const QString& title : plot->drawnTitles())
        if (title.contains(QChar(0x2026))) cut << QStringLiteral("axis: ") + title;
      for (const QRectF& name : plot->spanNameAreas())
        if (!QRectF(plot->rect()).contains(name)) cut << QStringLiteral("name of a span of ") + plot->accessibleName();
    }
    if (const auto* text = qobject_cast<QTextEdit*>(w); text != nullptr && text->horizontalScrollBar()->maximum() > 0)
      cut << QStringLiteral("text of %1: %2 px of %3")
                 .arg(text->accessibleName())
                 .arg(text->viewport()->width())
                 .arg(text->document()->size().width());
    if (const auto* card = qobject_cast<DemoCard*>(w);
        card != nullptr && card->heightForWidth(card->width()) > card->height())
      cut << QStringLiteral("card of ") + card->accessibleName();
    if (const auto* field = qobject_cast<QLineEdit*>(w); field != nullptr && field->text().isEmpty()) {
      const int margins = 2 * 10;  // of the style sheet
      if (field->fontMetrics().horizontalAdvance(field->placeholderText()) > field->width() - margins)
        cut << QStringLiteral("field: ") + field->placeholderText();
    }
    if (const auto* choice = qobject_cast<QComboBox*>(w)) {
      QStyleOptionComboBox option;
      option.initFrom(choice);
      const QRect room =
          choice->style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, choice);
      if (choice->fontMetrics().horizontalAdvance(choice->currentText()) > room.width() + 1)
        cut << QStringLiteral("choice: ") + choice->currentText();
    }
    if (const auto* label = qobject_cast<QLabel*>(w);
        label != nullptr && !label->wordWrap() && !label->text().isEmpty()) {
      const QString plain = QTextDocumentFragment::fromHtml(label->text()).toPlainText();
      if (label->minimumSizeHint().width() > label->width() + 1) cut << QStringLiteral("label: ") + plain;
    }
    if (const auto* label = qobject_cast<QLabel*>(w); label != nullptr && label->wordWrap() &&
                                                      !label->text().isEmpty() &&
                                                      label->heightForWidth(label->width()) > label->height() + 1)
      cut << QStringLiteral("lines of: ") + QTextDocumentFragment::fromHtml(label->text()).toPlainText();
    if (const auto* button = qobject_cast<QPushButton*>(w); button != nullptr && !button->text().isEmpty()) {
      if (button->minimumSizeHint().width() > button->width() + 1) cut << QStringLiteral("button: ") + button->text();
    }
    if (const auto* header = qobject_cast<QHeaderView*>(w);
        header != nullptr && header->orientation() == Qt::Horizontal) {
      for (int i = 0; i < header->count(); ++i) {
        if (header->isSectionHidden(i)) continue;
        if (header->sectionSizeHint(i) > header->sectionSize(i) + 1)
          cut << QStringLiteral("column: ") + header->model()->headerData(i, Qt::Horizontal).toString();
      }
    }
  }
  return cut;
}

/// What is seen in words or units that belong into files.
QStringList rawWords(const QWidget& root) {
  static const QRegularExpression raw(QStringLiteral(
      "(?<![\\w.])((?<=/ |\\d )um|urad|degC|um/m|(alpha|beta|gamma)_\\w+|d[xyz]_mm|push_broom|ball_screw|"
      "rotary_encoder|linear_scale|\\d(\\.\\d+)?e[-+]?\\d+)(?![\\w.])|"
      "column_(side_)?difference|\\w+_rpm\\^|\\w\\^\\d|(um|urad)_per_|\\b(feed|pos)_[xyz]\\b(?!_)|instrument_on"));
  QStringList found;
  const auto look = [&found](const QString& text) {
    if (const auto match = raw.match(text); match.hasMatch()) found << QStringLiteral("raw: ") + text;
  };
  for (const QWidget* w : root.findChildren<QWidget*>()) {
    if (!w->isVisible()) continue;
    if (const auto* label = qobject_cast<const QLabel*>(w))
      look(QTextDocumentFragment::fromHtml(label->text()).toPlainText());
    if (const auto* choice = qobject_cast<const QComboBox*>(w)) look(choice->currentText());
    if (const auto* field = qobject_cast<const QLineEdit*>(w); field != nullptr && field->isReadOnly())
      look(field->text());
    if (const auto* text = qobject_cast<const QTextEdit*>(w); text != nullptr && text->isReadOnly())
      for (const QString& line : text->toPlainText().split(QLatin1Char('\n'))) look(line);
    if (const auto* table = qobject_cast<const QTableView*>(w); table != nullptr && table->model() != nullptr) {
      const QAbstractItemModel& model = *table->model();
      for (int column = 0; column < model.columnCount(); ++column) {
        look(model.headerData(column, Qt::Horizontal).toString());
        for (int row = 0; row < std::min(model.rowCount(), 200); ++row)
          look(shownText(*table, model.index(row, column)));
      }
    }
  }
  return found;
}

/// Plots and 3D views that have less height than they need to be read.
QStringList squeezedViews(const QWidget& root) {
  QStringList squeezed;
  for (const QWidget* w : root.findChildren<QWidget*>()) {
    if (!w->isVisible() || (qobject_cast<const Plot*>(w) == nullptr && qobject_cast<const View3D*>(w) == nullptr))
      continue;
    // A title that goes on in a second line may take the height of that line.
    const int line = w->fontMetrics().lineSpacing() + 2;
    const int least = (w->minimumHeight() > 0 ? w->minimumHeight() : w->minimumSizeHint().height()) - line;
    if (w->height() >= least) continue;
    QString around;  // where the room was lost
    for (const QWidget* p = w->parentWidget(); p != nullptr && p != &root; p = p->parentWidget())
      around += QStringLiteral("\n  %1 %2 of %3")
                    .arg(QLatin1String(p->metaObject()->className()))
                    .arg(p->height())
                    .arg(p->minimumSizeHint().height());
    squeezed << QStringLiteral("%1 is %2 px high, needs %3%4")
                    .arg(w->accessibleName())
                    .arg(w->height())
                    .arg(least)
                    .arg(around);
  }
  return squeezed;
}

/// Whether anything is drawn in a part of a view.
bool shows(const QWidget& viewport, const QRect& part) {
  const QImage picture = const_cast<QWidget&>(viewport).grab(part).toImage();
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 1; x < picture.width(); ++x)
      if (picture.pixel(x, y) != picture.pixel(0, y)) return true;
  }
  return false;
}

/// Lists and tables that show too few of their rows, half a row, or that scroll sideways. Beside the help they may show
/// fewer.
QStringList poorTables(const QWidget& root, bool beside_help) {
  const int fewest_rows = beside_help ? 2 : 3;
  constexpr int enough_px = 180;  // for sentences of several lines
  QStringList poor;
  for (const QTableView* table : root.findChildren<QTableView*>()) {
    if (!table->isVisible() || table->model() == nullptr) continue;
    if (table->model()->rowCount() == 0) {
      if (!beside_help && table->horizontalScrollBar()->isVisible())
        poor << QStringLiteral("%1 has nothing in it and scrolls sideways").arg(table->accessibleName());
      continue;
    }
    const QRect seen = table->viewport()->rect();
    int rows = 0;
    int whole = 0;
    for (int row = 0; row < table->model()->rowCount(); ++row) {
      if (table->isRowHidden(row)) continue;
      ++rows;
      const QRect place(0, table->rowViewportPosition(row), seen.width(), table->rowHeight(row));
      if (seen.contains(place)) {
        ++whole;
      } else if (seen.intersects(place) && place.height() <= seen.height() && shows(*table->viewport(), place & seen)) {
        poor << QStringLiteral("%1 shows %2 of the %3 px of row %4")
                    .arg(table->accessibleName())
                    .arg((place & seen).height())
                    .arg(place.height())
                    .arg(row + 1);
      }
    }
    if (whole < std::min(rows, fewest_rows) && seen.height() < enough_px)
      poor << QStringLiteral("%1 shows %2 of %3 rows in %4 px")
                  .arg(table->accessibleName())
                  .arg(whole)
                  .arg(rows)
                  .arg(table->height());
    if (table->horizontalHeader()->length() > seen.width() && !beside_help)
      poor << QStringLiteral("%1 is %2 px wide, its columns need %3")
                  .arg(table->accessibleName())
                  .arg(seen.width())
                  .arg(table->horizontalHeader()->length());
  }
  return poor;
}

/// Notes what is given another size while it exists. Layouts that answer each other without end show only as a slow
/// program otherwise.
class Resizes : public QObject {
 public:
  explicit Resizes(const QWidget& root) : root_(root) { qApp->installEventFilter(this); }
  [[nodiscard]] const QStringList& seen() const { return seen_; }
  bool eventFilter(QObject* object, QEvent* event) override {
    const auto* widget = event->type() == QEvent::Resize ? qobject_cast<const QWidget*>(object) : nullptr;
    if (widget != nullptr && root_.isAncestorOf(widget))
      seen_ << QStringLiteral("%1 %2 %3 x %4")
                   .arg(QLatin1String(widget->metaObject()->className()), widget->accessibleName())
                   .arg(widget->width())
                   .arg(widget->height());
    return false;
  }

 private:
  const QWidget& root_;
  QStringList seen_;
};

/// What still changes its size after the page has had the time to come to rest; empty: nothing does.
QStringList neverAtRest(const QWidget& root) {
  constexpr int quiet_ms = 20;
  constexpr int tries = 50;
  QStringList last;
  for (int i = 0; i < tries; ++i) {
    const Resizes resizes(root);
    QTest::qWait(quiet_ms);
    if (resizes.seen().isEmpty()) return {};
    last = resizes.seen();
  }
  return last;
}

/// Asks for another height whenever it was given one.
class Restless : public QWidget {
 public:
  using QWidget::QWidget;

 protected:
  void resizeEvent(QResizeEvent*) override {
    QTimer::singleShot(0, this, [this] { setFixedHeight(height() == 20 ? 40 : 20); });
  }
};

TEST(Rest, IsMissedWhereTwoSizesAnswerEachOther) {
  QWidget page;
  auto* column = new QVBoxLayout(&page);
  auto* restless = new Restless;
  column->addWidget(restless);
  column->addStretch(1);
  page.resize(200, 200);
  page.show();
  EXPECT_FALSE(neverAtRest(page).isEmpty());
  delete restless;
  EXPECT_TRUE(neverAtRest(page).isEmpty());
}

/// Demo and language.
class LayoutTest : public StoryTest, public ::testing::WithParamInterface<std::tuple<const char*, const char*>> {
 protected:
  void SetUp() override {
    applyLanguage(QString::fromLatin1(std::get<1>(GetParam())));
    StoryTest::SetUp();
  }
  void TearDown() override {
    StoryTest::TearDown();
    applyLanguage(QStringLiteral("en"));
  }
  void setHelp(bool open) {
    auto* help = window_->findChild<HelpPanel*>();
    ASSERT_NE(help, nullptr);
    if (help->isVisible() != open) window_->helpAction()->trigger();
    ASSERT_EQ(help->isVisible(), open);
  }
  void expectFits(const std::string& what) {
    Page* page = window_->currentPage();
    QScrollArea* area = nullptr;
    for (QWidget* w = page; w != nullptr && area == nullptr; w = w->parentWidget())
      area = qobject_cast<QScrollArea*>(w);
    ASSERT_NE(area, nullptr);
    // Longer words, or a small window, beside the help: names may be cut.
    const bool narrow =
        window_->help()->isVisible() && (currentLanguage() != QLatin1String("en") || window_->width() < 1440);
    EXPECT_GE(page->height(), page->minimumSizeHint().height()) << what << ": squeezed";
    expectHeights(what, *window_, window_->help()->isVisible());
    EXPECT_LE(page->minimumSizeHint().width(), area->viewport()->width())
        << what << ": " << page->minimumSizeHint().width() << " of " << area->viewport()->width() << whatIsWide(*page);
    const QPushButton* button = page->primaryButton();
    if (button != nullptr && button->isVisible()) {
      const QRect place(button->mapTo(window_.get(), QPoint(0, 0)), button->size());
      const QRect seen(area->viewport()->mapTo(window_.get(), QPoint(0, 0)), area->viewport()->size());
      EXPECT_TRUE(seen.contains(place)) << what;
    }
    QStringList primary;
    for (const QPushButton* one : window_->findChildren<QPushButton*>()) {
      if (one->isVisible() && one->isEnabled() && one->property("role").toString() == QLatin1String("primary"))
        primary << one->text();
    }
    EXPECT_LE(primary.size(), 1) << what << ": " << primary.join(QStringLiteral(" | ")).toStdString();
    for (const QString& text : (narrow ? QStringList() : cutTexts(*window_)) + rawWords(*window_)) {
      if (told_.insert(text).second) ADD_FAILURE() << what << ": " << text.toStdString();
    }
  }
  void expectFitsEverywhere(const std::string& what) {
    for (const auto& [size, help] : {std::pair{QSize(1440, 900), true}, std::pair{QSize(1280, 800), true},
                                     std::pair{QSize(1280, 800), false}, std::pair{QSize(1920, 1080), false}}) {
      window_->resize(size);
      setHelp(help);
      QTest::qWait(50);  // lines of sentences follow the width, pages follow their lines
      (void)QTest::qWaitFor(
          [this] {
            const Page* page = window_->currentPage();
            return page->height() >= page->minimumSizeHint().height() && squeezedViews(*page).isEmpty() &&
                   poorTables(*page, window_->help()->isVisible()).isEmpty();
          },
          1000);
      const std::string where =
          what + " at " + std::to_string(size.width()) + (help ? " with the help" : " without help");
      const QStringList restless = neverAtRest(*window_->currentPage());
      EXPECT_TRUE(restless.isEmpty()) << where << ": never at rest: " << restless.join(QLatin1Char('|')).toStdString();
      expectFits(where);
    }
  }
  /// Plots, views and tables can be read.
  void expectHeights(const std::string& what, const QWidget& shown, bool beside_help) {
    for (const QString& poor : squeezedViews(shown) + poorTables(shown, beside_help)) {
      if (told_.insert(poor).second) ADD_FAILURE() << what << ": " << poor.toStdString();
    }
  }
  /// Texts of what was opened, and its heights, as `shown` has its size.
  void expectWhole(const std::string& what, const QWidget& shown) {
    expectHeights(what, shown, false);
    for (const QString& text : cutTexts(shown) + rawWords(shown)) {
      if (told_.insert(text).second) ADD_FAILURE() << what << ": " << text.toStdString();
    }
  }

  std::set<QString> told_;
};

TEST_P(LayoutTest, NothingIsPushedOutSidewaysOrCut) {
  const QString demo = QString::fromLatin1(std::get<0>(GetParam()));
  walk(demo, [this](const std::string& what) { expectFitsEverywhere(what); });
  const QTemporaryDir scratch;
  for (const TourDetail& detail : tourDetails(demo, scratch.path())) {
    if (std::string(detail.name) == "help") continue;  // opened above
    window_->workflow().goTo(detail.step);
    wait();
    QWidget* shown = detail.show(*window_);
    ASSERT_TRUE(waitForJobs(*window_, 60));
    const std::string what = demo.toStdString() + "/" + detail.name;
    if (shown != nullptr && shown->isWindow()) {
      expectWhole(what, *shown);
    } else {
      setHelp(false);
      for (const QSize size : {QSize(1280, 800), QSize(1920, 1080)}) {
        window_->resize(size);
        QTest::qWait(50);
        (void)QTest::qWaitFor(
            [this] {
              const Page* page = window_->currentPage();
              return (page == nullptr || page->height() >= page->minimumSizeHint().height()) &&
                     cutTexts(*window_).isEmpty() && squeezedViews(*window_).isEmpty() &&
                     poorTables(*window_, false).isEmpty();
            },
            1000);
        expectWhole(what + " at " + std::to_string(size.width()), *window_);
      }
    }
    if (detail.leave) detail.leave(*window_);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Demos, LayoutTest,
    ::testing::Combine(::testing::Values("fiducials", "holes", "balls", "scans", "discrepancy", "own_pattern"),
                       ::testing::Values("en", "de")),
    [](const auto& test) { return std::string(std::get<0>(test.param)) + "_" + std::get<1>(test.param); });

/// The first screen, and the windows and places that belong to no demo.
class FirstScreenLayout : public LayoutTest {};

TEST_P(FirstScreenLayout, AndTheWindowsBesideItFit) {
  window_->resize(1280, 800);
  QTest::qWait(50);
  expectWhole("first screen", *window_);
  for (const auto& [name, open] : tourWindows()) {
    QWidget* shown = open(*window_);
    wait();
    expectWhole(name, shown != nullptr ? *shown : *window_);
    if (shown != nullptr) shown->close();
  }
  window_->startDemo(QString::fromLatin1(std::get<0>(GetParam())), true);
  wait();
  ASSERT_NE(window_->session().campaign(), nullptr);
  sessions_.push_back(window_->session().folder());
  ASSERT_EQ(startArriving(*window_, QString::fromStdString((folder_ / "arriving").string())), QString());
  wait();
  expectWhole("captures that arrive", *window_);
  IncomingService::of(window_->session()).stop();
  window_->closeSession();
}

INSTANTIATE_TEST_SUITE_P(Languages, FirstScreenLayout,
                         ::testing::Combine(::testing::Values("fiducials"), ::testing::Values("en", "de")),
                         [](const auto& test) { return std::string(std::get<1>(test.param)); });

class BordersTest : public StoryTest {};

TEST_F(BordersTest, AreKeptForTheNextStartAndNeverTurnAPageRound) {
  QSettings().clear();
  const auto campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth);
  open(campaign, StepId::Model);
  auto* splitter = window_->currentPage()->findChild<QSplitter*>();
  ASSERT_NE(splitter, nullptr);
  ASSERT_EQ(splitter->orientation(), Qt::Horizontal);
  const int total = splitter->sizes()[0] + splitter->sizes()[1];
  splitter->setSizes({total / 2 + 60, total / 2 - 60});
  const QList<int> wanted = splitter->sizes();
  window_->close();
  // What an earlier version, or another page, has left must not be taken for it.
  for (const QString& key : QSettings().allKeys()) {
    if (key.startsWith(QStringLiteral("borders/DiscrepancyPage"))) QSettings().setValue(key, QVariantList{1, 2, 3});
  }
  window_ = std::make_unique<MainWindow>();
  window_->resize(1440, 900);
  window_->show();
  open(campaign, StepId::Model);
  splitter = window_->currentPage()->findChild<QSplitter*>();
  EXPECT_EQ(splitter->orientation(), Qt::Horizontal);
  EXPECT_NEAR(splitter->sizes()[0], wanted[0], 4);
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    wait();
    for (const QSplitter* one : window_->currentPage()->findChildren<QSplitter*>()) {
      if (!one->isVisible()) continue;
      for (const int size : one->sizes()) EXPECT_GE(size, 0);
    }
  }
}

TEST_F(BordersTest, AreasGoBelowOneAnotherWhereTheyHaveNoRoomSideBySide) {
  QSettings().clear();
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Model);
  auto* splitter = window_->currentPage()->findChild<QSplitter*>();
  ASSERT_NE(splitter, nullptr);
  const auto becomes = [&](Qt::Orientation wanted) {
    return QTest::qWaitFor([&] { return splitter->orientation() == wanted; }, 2000);
  };
  window_->resize(1440, 900);
  EXPECT_TRUE(becomes(Qt::Horizontal));
  window_->resize(1024, 700);
  window_->helpAction()->trigger();
  EXPECT_TRUE(becomes(Qt::Vertical));
  window_->helpAction()->trigger();
  window_->resize(1440, 900);
  EXPECT_TRUE(becomes(Qt::Horizontal));
}

TEST(Callout, IsAsHighAsItsSentenceNeedsWhenFirstShownAndWhenItChanges) {
  QWidget box;
  auto* column = new QVBoxLayout(&box);
  auto* callout = new Callout;
  column->addWidget(callout);
  column->addStretch();
  box.resize(400, 300);
  box.show();
  QCoreApplication::processEvents();
  const auto expectRoom = [&](int least_lines) {
    QCoreApplication::processEvents();
    const auto* text = callout->findChild<QLabel*>();
    ASSERT_NE(text, nullptr);
    EXPECT_GE(text->height(), text->heightForWidth(text->width()));
    EXPECT_GE(text->height(), least_lines * text->fontMetrics().height());
  };
  callout->show(Tone::Attention, QStringLiteral("One sentence that is long enough to need more than a single line in a "
                                                "callout that is four hundred pixels wide, as on a small page."));
  expectRoom(2);
  const int high = callout->height();
  callout->show(Tone::Good, QStringLiteral("Short."));
  expectRoom(1);
  EXPECT_LT(callout->height(), high);
  callout->hide();
  box.resize(250, 300);
  callout->show(Tone::Bad, QStringLiteral("Another sentence that was set while nobody saw the callout, and which needs "
                                          "three lines or more here."));
  expectRoom(3);
}

TEST(WrapLayout, GoesOnInTheNextLineAndNeverIsWiderThanItsWidestItem) {
  QWidget box;
  auto* row = new WrapLayout;
  std::vector<QWidget*> items;
  for (int i = 0; i < 5; ++i) {
    auto* item = new QWidget;
    item->setFixedSize(100, 30 + 2 * i);
    items.push_back(item);
    row->addWidget(item);
  }
  box.setLayout(row);
  EXPECT_EQ(row->minimumSize().width(), 100);
  EXPECT_EQ(row->sizeHint().width(), 5 * 100 + 4 * 8);
  EXPECT_EQ(row->heightForWidth(532), 38);
  EXPECT_EQ(row->heightForWidth(531), 36 + 8 + 38);
  EXPECT_EQ(row->heightForWidth(100), 30 + 32 + 34 + 36 + 38 + 4 * 8);
  box.resize(320, 200);
  box.show();
  QCoreApplication::processEvents();
  EXPECT_EQ(items[2]->geometry().center().y(), items[0]->geometry().center().y())
      << "items of a line share their middle";
  EXPECT_EQ(row->minimumSize().height(), row->heightForWidth(320)) << "whoever asks for no width hears of all lines";
  EXPECT_EQ(box.minimumSizeHint().height(), row->heightForWidth(320));
  EXPECT_EQ(items[3]->x(), 0);
  EXPECT_GT(items[3]->y(), items[0]->geometry().bottom());
  items[1]->hide();
  QCoreApplication::processEvents();
  EXPECT_EQ(items[3]->geometry().center().y(), items[0]->geometry().center().y()) << "what is hidden takes no place";
}

}  // namespace
}  // namespace spindrift::gui
