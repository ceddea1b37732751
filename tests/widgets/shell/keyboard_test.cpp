// SPDX-License-Identifier: GPL-3.0-or-later
// Every control of every page of every demo, and of the windows beside them, is reached with the Tab key alone, nothing
// keeps the focus for itself, and a screen reader has a name for each control, plot, image and 3D view.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QButtonGroup>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTabBar>
#include <QTabWidget>
#include <QTest>
#include <algorithm>
#include <set>

#include "tests/widgets/support/story_support.h"
#include "widgets/common/parts.h"
#include "widgets/image_view/image_view.h"
#include "widgets/jobs/activity_dialog.h"
#include "widgets/pages/compensate/closed_loop_page.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/plant/plant_page.h"
#include "widgets/panels/discrepancy/effects_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/plots/surface_plot.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/shell/preferences_dialog.h"
#include "widgets/shell/step_list.h"
#include "widgets/teaching/exercise_dialog.h"
#include "widgets/teaching/what_if_window.h"
#include "widgets/view3d/view3d.h"

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

bool isView(const QWidget* widget) {
  return qobject_cast<const Plot*>(widget) != nullptr || qobject_cast<const SurfacePlot*>(widget) != nullptr ||
         qobject_cast<const ImageView*>(widget) != nullptr || qobject_cast<const View3D*>(widget) != nullptr;
}

/// What a screen reader says first: the name that was given, the text of a button, the label that belongs to a field.
QString saidOf(QWidget* widget) {
  QAccessibleInterface* said = QAccessible::queryAccessibleInterface(widget);
  return said == nullptr ? QString() : said->text(QAccessible::Name).trimmed();
}

std::string nameOf(const QWidget* widget) {
  const auto* button = qobject_cast<const QAbstractButton*>(widget);
  return std::string(widget->metaObject()->className()) + " \"" + widget->accessibleName().toStdString() + "\" " +
         (button != nullptr ? button->text().toStdString() : std::string());
}

class KeyboardTest : public StoryTest {
 protected:
  /// What gets the focus in a window while Tab is pressed, from `from` on, until it comes round.
  static std::set<const QWidget*> tabbed(QWidget* from) {
    const QWidget* window = from->window();
    from->setFocus(Qt::TabFocusReason);
    std::set<const QWidget*> seen;
    QWidget* first = window->focusWidget();
    const QWidget* last = nullptr;
    for (int i = 0; i < 500; ++i) {
      QWidget* now = window->focusWidget();
      if (now == nullptr) break;
      EXPECT_NE(now, last) << nameOf(now) << " keeps the focus";
      if (now == last) break;
      last = now;
      seen.insert(now);
      QTest::keyClick(now, Qt::Key_Tab);
      if (i > 0 && window->focusWidget() == first) break;
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

  void expectAllNamed(const std::string& where, const QWidget& window) {
    for (QWidget* widget : window.findChildren<QWidget*>()) {
      if (!widget->isVisible() || widget->window() != &window || isPart(widget, &window)) continue;
      if (!isView(widget) && !isControl(widget)) continue;
      if (isView(widget)) ++views_;
      EXPECT_FALSE(saidOf(widget).isEmpty())
          << where << ": a screen reader has no name for " << nameOf(widget) << " in "
          << (widget->parentWidget() != nullptr ? nameOf(widget->parentWidget()) : std::string("nothing"));
    }
  }

  /// In the window of `from`, which is a control.
  void expectAllReached(const std::string& where, QWidget* from) {
    const QWidget* window = from->window();
    const std::set<const QWidget*> seen = tabbed(from);
    ASSERT_FALSE(seen.empty()) << where;
    for (const QWidget* control : window->findChildren<QWidget*>()) {
      if (!isControl(control) || !control->isVisible() || !control->isEnabled()) continue;
      if (control->window() != window || isPart(control, window)) continue;
      ++controls_;
      EXPECT_TRUE(reached(seen, control)) << where << ": " << nameOf(control);
    }
    expectAllNamed(where, *window);
  }
  void expectAllReached(const std::string& where) {
    expectAllReached(where, window_->stepList()->button(StepId::Machine));
  }
  /// A window of its own, or what is shown in place of the steps.
  void expectAllReachedIn(const std::string& where, QWidget* shown) {
    ASSERT_NE(shown, nullptr) << where;
    QCoreApplication::processEvents();
    shown->window()->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(shown->window())) << where;
    for (QWidget* control : shown->findChildren<QWidget*>()) {
      if (!isControl(control) || !control->isVisible() || !control->isEnabled() || isPart(control, shown) ||
          (control->focusPolicy() & Qt::TabFocus) == 0)
        continue;
      expectAllReached(where, control);
      return;
    }
    FAIL() << where << " has no control";
  }

  int controls_ = 0;
  int views_ = 0;
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

/// Each instrument has pages of its own.
class KeyboardOfDemo : public KeyboardTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(KeyboardOfDemo, ReachesEveryControlOfItsPages) {
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  walk(QString::fromStdString(GetParam()), [this](const std::string& what) { expectAllReached(what); });
  EXPECT_GT(controls_, 200) << "the pages were there";
  EXPECT_GT(views_, 5) << "the plots and views were there";
}

INSTANTIATE_TEST_SUITE_P(Demos, KeyboardOfDemo, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const Demo& demo : demos()) names.push_back(demo.name);
                           return names;
                         }()),
                         [](const auto& demo) {
                           std::string name = demo.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_F(KeyboardTest, ReachesEveryControlOfWindowsBesideTheSteps) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Discrepancy);
  const auto look = [this](const char* where, QWidget* window) {
    expectAllReachedIn(where, window);
    window->close();
    QCoreApplication::processEvents();
  };
  window_->openEffects();
  auto* discrepancy = page<DiscrepancyPage>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !discrepancy->effects()->busy(); }, 10'000));
  expectAllReachedIn("effects", discrepancy);
  discrepancy->effects()->newEffect();
  expectAllReachedIn("effect editor", discrepancy);
  discrepancy->effects()->closeEditor();
  look("notes", window_->openNotes());
  look("jobs and messages", window_->openActivity());
  window_->openPreferences();
  look("preferences", window_->findChild<PreferencesDialog*>());
  look("what if", window_->openWhatIf());
  ExerciseDialog* exercise = window_->openExercise();
  exercise->startButton()->click();
  EXPECT_TRUE(QTest::qWaitFor([&] { return exercise->ready(); }, 60'000));
  look("exercise", exercise);
  window_->openPlant();
  expectAllReachedIn("plant", window_->plant());
  window_->openLiveCompensation();
  expectAllReachedIn("live loop", window_->liveCompensation());
  EXPECT_GT(controls_, 100);
}

TEST_F(KeyboardTest, SeesAControlWithoutAName) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Model);
  auto* view = window_->currentPage()->findChild<View3D*>();
  ASSERT_NE(view, nullptr);
  EXPECT_FALSE(saidOf(view).isEmpty());
  view->setAccessibleName(QString());
  EXPECT_TRUE(saidOf(view).isEmpty());
}

TEST_F(KeyboardTest, SeesAControlThatIsPassedOver) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Report);
  QPushButton* button = window_->currentPage()->primaryButton();
  ASSERT_TRUE(button != nullptr && button->isVisible());
  EXPECT_TRUE(reached(tabbed(window_->stepList()->button(StepId::Machine)), button));
  button->setFocusPolicy(Qt::ClickFocus);
  EXPECT_FALSE(reached(tabbed(window_->stepList()->button(StepId::Machine)), button));
}

}  // namespace
}  // namespace spindrift::gui
