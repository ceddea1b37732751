// SPDX-License-Identifier: GPL-3.0-or-later
// The tour makes a picture of every page, light and dark, and none is empty.
#include "widgets/shell/tour.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QImage>
#include <set>

#include "tests/support/temp_folder.h"
#include "widgets/shell/main_window.h"

namespace spindrift::gui {
namespace {

TEST(Tour, MakesAllPictures) {
  const testing::TempFolder folder;
  MainWindow window;
  const TourResult result = runTour(window, QString::fromStdString((folder / "tour").string()));
  EXPECT_TRUE(result.failure.isEmpty()) << result.failure.toStdString();
  ASSERT_GT(result.pictures.size(), 2 * static_cast<int>(all_steps.size()));
  EXPECT_EQ(result.reports.size(), 4) << "two demos, PDF and HTML";
  for (const QString& file : result.pictures) {
    const QImage picture(file);
    ASSERT_FALSE(picture.isNull()) << file.toStdString();
    std::set<QRgb> colours;
    for (int y = 0; y < picture.height(); y += 5) {
      for (int x = 0; x < picture.width(); x += 5) colours.insert(picture.pixel(x, y));
    }
    EXPECT_GT(colours.size(), 30U) << file.toStdString();
  }
  // With the help beside it in a small window no page gets less than it needs: it scrolls sideways.
  window.startDemo(QStringLiteral("holes"), true);
  ASSERT_TRUE(waitForJobs(window, 120));
  window.resize(1024, 700);
  window.helpAction()->setChecked(true);
  for (const StepId step : all_steps) {
    window.workflow().goTo(step);
    ASSERT_TRUE(waitForJobs(window, 120));
    EXPECT_GE(window.currentPage()->width(), window.currentPage()->minimumSizeHint().width())
        << stepTitle(step).toStdString();
  }
}

}  // namespace
}  // namespace spindrift::gui
