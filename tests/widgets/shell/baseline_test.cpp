// SPDX-License-Identifier: GPL-3.0-or-later
// A few pages, light and dark, against pictures that a person has looked at (tests/data/baselines): pages whose content
// does not change with every better search or fit.
//
// After a change of looks that is meant: SPINDRIFT_RENEW_BASELINES=1 build/tests/baseline_test
// writes them anew into the source tree; look at every one before it is committed.
#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QImage>
#include <QPainter>
#include <QSettings>

#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"
#include "tests/widgets/support/picture_compare.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/pages/page.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/tour.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

QString baselineFile(const QString& name) {
  return QString::fromStdString((spindrift::testing::testData() / "baselines/%1.png").string()).arg(name);
}

class BaselineTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QSettings().clear();
    window_ = std::make_unique<MainWindow>();
    window_->resize(1440, 900);
    window_->setTheme(ThemeKind::Light);
    window_->show();
  }
  void TearDown() override { window_->setTheme(ThemeKind::Light); }

  /// A demo in a session of a name without time or place, so that every picture of it is the same.
  void openDemo(const std::string& name) {
    JobContext job;
    makeDemoCampaign(name, folder_ / "campaign", true, job);
    {
      Session session = Session::create(folder_ / "kept");
      (void)session.importCampaign(folder_ / "campaign", job);
    }
    window_->open(QString::fromStdString((folder_ / "kept").string()));
    ASSERT_TRUE(waitForJobs(*window_, 120));
    ASSERT_NE(window_->session().campaign(), nullptr) << window_->jobBar()->message().toStdString();
  }
  void runUpTo(StepId last) {
    for (const StepId step : all_steps) {
      window_->workflow().goTo(step);
      if (window_->currentPage() != nullptr) window_->currentPage()->runAll();
      ASSERT_TRUE(waitForJobs(*window_, 120)) << stepTitle(step).toStdString();
      if (step == last) break;
    }
  }
  QImage picture(ThemeKind kind) {
    window_->setTheme(kind);
    EXPECT_TRUE(waitForJobs(*window_, 30));
    return window_->grab().toImage();
  }
  void check(const QString& name, ThemeKind kind = ThemeKind::Light) {
    const QImage now = picture(kind);
    if (qEnvironmentVariableIsSet("SPINDRIFT_RENEW_BASELINES")) {
      ASSERT_TRUE(QDir().mkpath(QString::fromStdString((spindrift::testing::testData() / "baselines").string())));
      ASSERT_TRUE(asBaseline(now).save(baselineFile(name), "png", 0));
    }
    const QImage before(baselineFile(name));
    ASSERT_FALSE(before.isNull()) << baselineFile(name).toStdString();
    EXPECT_LT(QFile(baselineFile(name)).size(), 60'000);
    const PictureDifference difference = comparePictures(before, now);
    std::printf("%-32s %s\n", qPrintable(name), qPrintable(difference.text()));
    if (difference.alike()) return;
    const QString kept = QDir::temp().filePath(QStringLiteral("spindrift-") + name + QStringLiteral("-now.png"));
    now.save(kept);
    ADD_FAILURE() << name.toStdString() << " looks different: " << difference.text().toStdString() << "; see "
                  << kept.toStdString() << " and " << baselineFile(name).toStdString();
  }

  testing::TempFolder folder_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(BaselineTest, Welcome) {
  check(QStringLiteral("welcome-light"));
  check(QStringLiteral("welcome-dark"), ThemeKind::Dark);
}

TEST_F(BaselineTest, HoleBar) {
  openDemo("holes");
  ASSERT_FALSE(HasFatalFailure());
  window_->workflow().goTo(StepId::Machine);
  check(QStringLiteral("machine-dark"), ThemeKind::Dark);
  window_->setTheme(ThemeKind::Light);
  runUpTo(StepId::Calibrate);
  check(QStringLiteral("calibrate-light"));
  check(QStringLiteral("calibrate-dark"), ThemeKind::Dark);
  window_->workflow().goTo(StepId::Capture);
  window_->setTheme(ThemeKind::Light);
  check(QStringLiteral("capture-light"));
}

TEST_F(BaselineTest, VerticalMill) {
  openDemo("discrepancy");
  ASSERT_FALSE(HasFatalFailure());
  runUpTo(StepId::Compensate);
  ASSERT_FALSE(HasFatalFailure());
  check(QStringLiteral("compensate-light"));
  window_->workflow().goTo(StepId::Model);
  check(QStringLiteral("model-dark"), ThemeKind::Dark);
  window_->workflow().goTo(StepId::WarmUp);
  window_->setTheme(ThemeKind::Light);
  check(QStringLiteral("warm-up-light"));
}

/// What the comparison is for: each of these was a mistake once, or could be.
class WrongPictureTest : public ::testing::Test {
 protected:
  QImage good_{baselineFile(QStringLiteral("model-dark"))};
  void SetUp() override {
    ASSERT_FALSE(good_.isNull());
    good_ = good_.convertToFormat(QImage::Format_RGB32);
  }
  [[nodiscard]] bool alike(const QImage& picture) const { return comparePictures(good_, picture).alike(); }
};

TEST_F(WrongPictureTest, TheSameIsAlike) {
  EXPECT_TRUE(alike(good_));
  // A little lighter, and moved by a third of a pixel: another version of the renderer.
  QImage other(good_.size() * 3, QImage::Format_RGB32);
  QPainter painter(&other);
  painter.fillRect(other.rect(), good_.pixel(2, 2));
  painter.drawImage(QRect(1, 1, other.width(), other.height()), good_);
  painter.fillRect(other.rect(), QColor(255, 255, 255, 1));
  painter.end();
  EXPECT_TRUE(alike(other)) << comparePictures(good_, other).text().toStdString();
}

TEST_F(WrongPictureTest, AnEmptyViewIsNot) {
  // The 3D view is at the right.
  QImage empty = good_;
  QPainter painter(&empty);
  painter.fillRect(QRect(350, 130, 270, 250), good_.pixel(360, 370));
  painter.end();
  EXPECT_FALSE(alike(empty));
}

TEST_F(WrongPictureTest, ASmallMissingPartIsNot) {
  QImage empty = good_;
  QPainter painter(&empty);
  painter.fillRect(QRect(84, 330, 240, 40), good_.pixel(4, 250));
  painter.end();
  EXPECT_FALSE(alike(empty));
}

TEST_F(WrongPictureTest, APartThatLostItsOrderIsNot) {
  // The same colours in other places: a part of the plot upside down.
  QImage other = good_;
  QPainter painter(&other);
  const QRect part(120, 160, 160, 80);
  painter.drawImage(part.topLeft(), good_.copy(part).mirrored(true, true));
  painter.end();
  const PictureDifference difference = comparePictures(good_, other);
  EXPECT_LT(difference.worst_structure, 0.75) << difference.text().toStdString();
  EXPECT_FALSE(difference.alike());
}

TEST_F(WrongPictureTest, AnotherThemeIsNot) {
  QImage inverted = good_;
  inverted.invertPixels();
  EXPECT_FALSE(alike(inverted));
  EXPECT_FALSE(comparePictures(QImage(baselineFile(QStringLiteral("calibrate-light"))),
                               QImage(baselineFile(QStringLiteral("calibrate-dark"))))
                   .alike());
}

TEST_F(WrongPictureTest, AnotherPageIsNot) {
  EXPECT_FALSE(comparePictures(QImage(baselineFile(QStringLiteral("calibrate-dark"))), good_).alike());
}

TEST_F(WrongPictureTest, ACutLayoutIsNot) {
  // All that is right of the steps begins 16 px of the window further to the right.
  QImage moved = good_;
  QPainter painter(&moved);
  painter.drawImage(QPoint(107, 0), good_, QRect(100, 0, 533, good_.height()));
  painter.end();
  EXPECT_FALSE(alike(moved)) << comparePictures(good_, moved).text().toStdString();
  // Another size of window.
  EXPECT_FALSE(alike(good_.copy(0, 0, 640, 380)));
}

}  // namespace
}  // namespace spindrift::gui
