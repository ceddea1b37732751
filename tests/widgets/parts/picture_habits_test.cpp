// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/export/picture_habits.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QMenu>
#include <QTest>
#include <QVBoxLayout>
#include <memory>

#include "widgets/image_view/image_view.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/light_colours.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

/// A window with a plot, an image and a 3D view, each with something in it.
class PictureHabitsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto* column = new QVBoxLayout(&window_);
    plot_ = new Plot;
    plot_->setAxes(QStringLiteral("Time / s"), QStringLiteral("EX / um"));
    plot_->setContent({{QStringLiteral("EX"), {0.0, 1.0, 2.0}, {0.0, 2.0, 1.0}, {}}});
    image_ = new ImageView;
    QImage image(40, 30, QImage::Format_Grayscale8);
    image.fill(100);
    image_->setImage(image);
    view_ = new View3D;
    ViewPoint point;
    point.id = QStringLiteral("F1");
    view_->setPoints({point});
    for (QWidget* widget : {static_cast<QWidget*>(plot_), static_cast<QWidget*>(image_), static_cast<QWidget*>(view_)})
      column->addWidget(widget);
    window_.resize(700, 900);
    window_.show();
    window_.activateWindow();
    QApplication::clipboard()->clear();
  }

  /// The menu that an event has opened under a widget; null if there is none.
  static QMenu* menuOf(QWidget* picture) { return picture->findChild<QMenu*>(QStringLiteral("pictureMenu")); }
  static QMenu* askForMenu(QWidget* picture, QWidget* under) {
    const QPoint at = under->rect().center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, under->mapToGlobal(at));
    QCoreApplication::sendEvent(under, &event);
    return menuOf(picture);
  }
  static void close(QMenu* menu) {
    menu->close();
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    QCoreApplication::processEvents();
  }
  static void choose(QMenu* menu, const char* name) {
    ASSERT_NE(menu, nullptr);
    auto* action = menu->findChild<QAction*>(QLatin1String(name));
    ASSERT_NE(action, nullptr) << name;
    EXPECT_TRUE(action->isEnabled()) << name;
    action->trigger();
    close(menu);
  }

  QWidget window_;
  QObject owner_;
  PictureHabits habits_{&owner_};
  Plot* plot_ = nullptr;
  ImageView* image_ = nullptr;
  View3D* view_ = nullptr;
};

TEST_F(PictureHabitsTest, APlotIsCopiedInLightColoursFineEnoughForPrint) {
  const ThemeKind before = theme().kind;
  applyTheme(*qApp, ThemeKind::Dark);
  // The right click hits the drawing inside the plot.
  auto* inside = plot_->findChild<QWidget*>();
  ASSERT_NE(inside, nullptr);
  choose(askForMenu(plot_, inside), "copyPicture");
  const QImage copied = QApplication::clipboard()->image();
  applyTheme(*qApp, before);
  ASSERT_FALSE(copied.isNull());
  EXPECT_GE(copied.width(), static_cast<int>(picture_ratio * 640.0));
  EXPECT_GT(copied.pixelColor(2, 2).lightness(), 200);
  EXPECT_EQ(menuOf(plot_), nullptr);
}

TEST_F(PictureHabitsTest, CtrlCCopiesThePictureThatHasTheFocus) {
  image_->setFocus();
  QTest::keyClick(image_, Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(QApplication::clipboard()->image().size(), QSize(40, 30));
  EXPECT_FALSE(view_->clip());
  QTest::keyClick(view_, Qt::Key_C, Qt::ControlModifier);
  EXPECT_GE(QApplication::clipboard()->image().width(), static_cast<int>(picture_ratio * 800.0));
  EXPECT_FALSE(view_->clip()) << "C alone clips";
}

TEST_F(PictureHabitsTest, TheRightButtonPansAThreeDimensionalViewAndAClickOpensItsMenu) {
  EXPECT_EQ(askForMenu(view_, view_), nullptr) << "at the press nobody knows yet";
  const QPoint at = view_->rect().center();
  QTest::mousePress(view_, Qt::RightButton, Qt::NoModifier, at);
  QTest::mouseMove(view_, at + QPoint(30, 10));
  QTest::mouseRelease(view_, Qt::RightButton, Qt::NoModifier, at + QPoint(30, 10));
  EXPECT_EQ(menuOf(view_), nullptr);
  QTest::mousePress(view_, Qt::RightButton, Qt::NoModifier, at);
  QTest::mouseRelease(view_, Qt::RightButton, Qt::NoModifier, at + QPoint(1, 1));
  choose(menuOf(view_), "showAll");
  QContextMenuEvent key(QContextMenuEvent::Keyboard, at, view_->mapToGlobal(at));
  QCoreApplication::sendEvent(view_, &key);
  ASSERT_NE(menuOf(view_), nullptr);
  close(menuOf(view_));
}

TEST_F(PictureHabitsTest, AnEmptyPictureGivesNothingAway) {
  plot_->setContent({});
  QMenu* menu = askForMenu(plot_, plot_);
  ASSERT_NE(menu, nullptr);
  for (const char* name : {"copyPicture", "savePicture", "showAll"})
    EXPECT_FALSE(menu->findChild<QAction*>(QLatin1String(name))->isEnabled()) << name;
  close(menu);
  QTest::keyClick(plot_, Qt::Key_C, Qt::ControlModifier);
  EXPECT_TRUE(QApplication::clipboard()->image().isNull());
}

TEST_F(PictureHabitsTest, OtherWidgetsKeepTheirOwnMenus) {
  EXPECT_EQ(askForMenu(&window_, &window_), nullptr);
}

}  // namespace
}  // namespace spindrift::gui
