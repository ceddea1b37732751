// SPDX-License-Identifier: GPL-3.0-or-later
// The tour makes a picture of every page, light and dark, and none is empty.
#include "widgets/shell/tour.h"

#include <gtest/gtest.h>

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
}

}  // namespace
}  // namespace spindrift::gui
