// SPDX-License-Identifier: GPL-3.0-or-later
// Every page of every demo fits the window in every language: at 1440 x 900 with the help open, and on a small screen
// of 1280 x 800 without it, nothing is pushed out sideways, no text is cut, no plot squeezed, one button at most is the
// primary one, and that which runs the step is in sight.
#include <gtest/gtest.h>

#include <QAction>
#include <QCoreApplication>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QSplitter>
#include <QTest>
#include <QTextDocumentFragment>
#include <QVBoxLayout>
#include <set>
#include <tuple>

#include "tests/widgets/support/story_support.h"
#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/plots/plot.h"
#include "widgets/shell/help_panel.h"
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

/// Texts that need more room than they have.
QStringList cutTexts(const QWidget& root) {
  QStringList cut;
  for (QWidget* w : root.findChildren<QWidget*>()) {
    if (!w->isVisible() || w->width() <= 0) continue;
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
    // Longer words beside the help: such a page may scroll sideways.
    const bool may_scroll = window_->help()->isVisible() && currentLanguage() != QLatin1String("en");
    EXPECT_GE(page->height(), page->minimumSizeHint().height()) << what << ": squeezed";
    for (const QString& squeezed : squeezedViews(*page)) {
      if (told_.insert(squeezed).second) ADD_FAILURE() << what << ": " << squeezed.toStdString();
    }
    EXPECT_TRUE(may_scroll || page->minimumSizeHint().width() <= area->viewport()->width())
        << what << ": " << page->minimumSizeHint().width() << " of " << area->viewport()->width() << whatIsWide(*page);
    const QPushButton* button = page->primaryButton();
    if (button != nullptr && button->isVisible() && !may_scroll) {
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
    for (const QString& text : cutTexts(*window_)) {
      if (told_.insert(text).second) ADD_FAILURE() << what << ": " << text.toStdString();
    }
  }

  std::set<QString> told_;
};

TEST_P(LayoutTest, NothingIsPushedOutSidewaysOrCut) {
  walk(QString::fromLatin1(std::get<0>(GetParam())), [this](const std::string& what) {
    for (const bool help : {true, false}) {
      window_->resize(help ? QSize(1440, 900) : QSize(1280, 800));
      setHelp(help);
      QTest::qWait(50);  // lines of sentences follow the width
      expectFits(what + (help ? " at 1440 with the help" : " at 1280 without help"));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(
    Demos, LayoutTest,
    ::testing::Combine(::testing::Values("fiducials", "holes", "balls", "scans", "discrepancy", "own_pattern"),
                       ::testing::Values("en", "de")),
    [](const auto& test) { return std::string(std::get<0>(test.param)) + "_" + std::get<1>(test.param); });

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
