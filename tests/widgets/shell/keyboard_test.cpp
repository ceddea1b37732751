// SPDX-License-Identifier: GPL-3.0-or-later
// Every control of every page is reached with the Tab key alone, and nothing keeps the focus for itself.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QButtonGroup>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTest>
#include <set>

#include "tests/widgets/pages/story_support.h"
#include "widgets/common/parts.h"
#include "widgets/shell/step_list.h"

namespace spindrift::gui {
namespace {

bool isControl(const QWidget* widget) {
  return qobject_cast<const QAbstractButton*>(widget) != nullptr || qobject_cast<const QComboBox*>(widget) != nullptr ||
         qobject_cast<const QAbstractSpinBox*>(widget) != nullptr ||
         qobject_cast<const QLineEdit*>(widget) != nullptr || qobject_cast<const QTabBar*>(widget) != nullptr ||
         qobject_cast<const QAbstractItemView*>(widget) != nullptr ||
         (qobject_cast<const QAbstractSlider*>(widget) != nullptr &&
          qobject_cast<const QScrollBar*>(widget) == nullptr);
}

/// A part of another control, which answers for it: the line of a spin box, the corner of a table, the scroll buttons
/// of a row of tabs.
bool isPart(const QWidget* widget, const QWidget* page) {
  for (const QWidget* w = widget->parentWidget(); w != nullptr && w != page; w = w->parentWidget())
    if (isControl(w)) return true;
  return false;
}

std::string nameOf(const QWidget* widget) {
  const auto* button = qobject_cast<const QAbstractButton*>(widget);
  return std::string(widget->metaObject()->className()) + " \"" + widget->accessibleName().toStdString() + "\" " +
         (button != nullptr ? button->text().toStdString() : std::string());
}

class KeyboardTest : public StoryTest {
 protected:
  /// What gets the focus while Tab is pressed until it comes round.
  std::set<const QWidget*> tabbed() {
    // From the list of steps on.
    window_->stepList()->button(StepId::Machine)->setFocus(Qt::TabFocusReason);
    std::set<const QWidget*> seen;
    QWidget* first = window_->focusWidget();
    const QWidget* last = nullptr;
    for (int i = 0; i < 500; ++i) {
      QWidget* now = window_->focusWidget();
      if (now == nullptr) break;
      EXPECT_NE(now, last) << nameOf(now) << " keeps the focus";
      if (now == last) break;
      last = now;
      seen.insert(now);
      QTest::keyClick(now, Qt::Key_Tab);
      if (i > 0 && window_->focusWidget() == first) break;
    }
    return seen;
  }

  static bool reached(const std::set<const QWidget*>& seen, const QWidget* control) {
    if (seen.contains(control)) return true;
    // Arrows go along a row of tools, one of which has the focus.
    if (control->property("arrowKeys").toBool()) {
      for (const QAbstractButton* other : control->parentWidget()->findChildren<QAbstractButton*>())
        if (other->property("arrowKeys").toBool() && seen.contains(other)) return true;
    }
    // Arrows choose within a group, of which one has the focus.
    const auto* button = qobject_cast<const QAbstractButton*>(control);
    if (button == nullptr || button->group() == nullptr || !button->group()->exclusive()) return false;
    for (const QAbstractButton* other : button->group()->buttons())
      if (seen.contains(other)) return true;
    return false;
  }

  void expectAllReached(const std::string& where) {
    const std::set<const QWidget*> seen = tabbed();
    ASSERT_FALSE(seen.empty()) << where;
    for (const QWidget* control : window_->findChildren<QWidget*>()) {
      if (!isControl(control) || !control->isVisible() || !control->isEnabled()) continue;
      if (control->window() != window_.get() || isPart(control, window_.get())) continue;
      ++controls_;
      EXPECT_TRUE(reached(seen, control)) << where << ": " << nameOf(control);
    }
  }

  int controls_ = 0;
};

TEST_F(KeyboardTest, ReachesEveryControlOfEveryPage) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Machine);
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    wait();
    window_->currentPage()->runAll();
    wait();
    const std::string name = stepTitle(step).toStdString();
    expectAllReached(name);
    for (auto* tabs : window_->currentPage()->findChildren<QTabWidget*>()) {
      for (int i = 1; tabs->isVisible() && i < tabs->count(); ++i) {
        tabs->setCurrentIndex(i);
        QCoreApplication::processEvents();
        expectAllReached(name + ", tab " + tabs->tabText(i).toStdString());
      }
    }
  }
  EXPECT_GT(controls_, 200) << "the pages were there";
}

TEST_F(KeyboardTest, SeesAControlThatIsPassedOver) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Report);
  QPushButton* button = window_->currentPage()->primaryButton();
  ASSERT_TRUE(button != nullptr && button->isVisible());
  EXPECT_TRUE(reached(tabbed(), button));
  button->setFocusPolicy(Qt::ClickFocus);
  EXPECT_FALSE(reached(tabbed(), button));
}

}  // namespace
}  // namespace spindrift::gui
