// SPDX-License-Identifier: GPL-3.0-or-later
// The real window with a campaign folder opened in it, for the tests of pages.
#pragma once

#include <gtest/gtest.h>

#include <QDir>
#include <QFileInfo>
#include <QPushButton>
#include <QSettings>
#include <QTest>

#include "tests/support/temp_folder.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {

class PageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QSettings().clear();
    window_ = std::make_unique<MainWindow>();
    window_->resize(1440, 900);
    window_->show();
  }
  void open(const std::filesystem::path& campaign) {
    window_->open(QString::fromStdString(campaign.string()));
    ASSERT_TRUE(waitForJobs(*window_, 60));
    ASSERT_NE(window_->session().campaign(), nullptr) << window_->jobBar()->message().toStdString();
  }
  /// Goes to a step once nothing runs any more (a session that is being opened), and waits for what its page does on
  /// its own.
  template <class PageType>
  PageType* go(StepId step) {
    EXPECT_TRUE(waitForJobs(*window_, 60));
    window_->workflow().goTo(step);
    EXPECT_TRUE(waitForJobs(*window_, 60));
    auto* page = qobject_cast<PageType*>(window_->currentPage());
    EXPECT_NE(page, nullptr) << "another page is shown for " << stepTitle(step).toStdString();
    return page;
  }
  /// Presses the page's main button and waits for its job.
  void press() {
    QTest::mouseClick(window_->currentPage()->primaryButton(), Qt::LeftButton);
    ASSERT_TRUE(waitForJobs(*window_, 60)) << window_->jobBar()->message().toStdString();
  }
  /// Writes everything the page gives away; every file must hold something.
  void exportAll() {
    for (const Exportable& item : window_->currentPage()->exportables()) {
      for (const QString& format : item.formats) {
        const QString file = QString::fromStdString(
            (folder_ / ("export-" + fileNameOf(item.name).toStdString() + "." + format.toStdString())).string());
        ASSERT_NO_THROW(item.write(file)) << item.name.toStdString();
        EXPECT_GT(QFileInfo(file).size(), 20) << file.toStdString();
      }
    }
  }
  testing::TempFolder folder_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace spindrift::gui
