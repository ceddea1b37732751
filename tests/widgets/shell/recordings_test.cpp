// SPDX-License-Identifier: GPL-3.0-or-later
// What users did (tests/data/recordings/NAME.json, written by `spindrift --record`), done again at the window of today:
// at every look it says what it said before (NAME/LOOK.txt) and looks as it did, light and dark (NAME/LOOK-light.png,
// NAME/LOOK-dark.png). The same test runs at scale 1, 1.5 and 2 against the same files.
//
// After a change that is meant: SPINDRIFT_RENEW_BASELINES=1 build/tests/recordings_test
// writes them anew into the source tree; look at every one before it is committed.
// SPINDRIFT_REPLAY=FILE build/tests/recordings_test --gtest_filter=*UsersRecording*
// does what is in one file, and says where it cannot.
#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QImage>
#include <QLineEdit>
#include <QSettings>
#include <QTest>
#include <string>
#include <vector>

#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"
#include "tests/widgets/support/picture_compare.h"
#include "tests/widgets/support/replay.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/recording/page_state.h"
#include "widgets/recording/recording.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/step_list.h"
#include "widgets/shell/tour.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

const QString kept_folder = QString::fromStdString((spindrift::testing::testData() / "recordings/").string());

std::vector<std::string> recordingNames() {
  std::vector<std::string> names;
  for (const QString& file : QDir(kept_folder).entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name))
    names.push_back(file.chopped(5).toStdString());
  return names;
}

QString textOf(const QString& file) {
  QFile in(file);
  return in.open(QIODevice::ReadOnly) ? QString::fromUtf8(in.readAll()) : QString();
}

/// The first line in which two texts differ.
std::string difference(const QString& before, const QString& now) {
  const QStringList a = before.split(QLatin1Char('\n'));
  const QStringList b = now.split(QLatin1Char('\n'));
  for (qsizetype i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (a.value(i) != b.value(i)) {
      return "line " + std::to_string(i + 1) + "\n  before: " + a.value(i).toStdString() +
             "\n  now:    " + b.value(i).toStdString();
    }
  }
  return {};
}

class RecordingsTest : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    QSettings().clear();
    window_ = std::make_unique<MainWindow>();
    window_->setTheme(ThemeKind::Light);
  }
  void TearDown() override { window_->setTheme(ThemeKind::Light); }

  /// A demo in a session of a name without time or place.
  void open(const Recording& recording) {
    window_->resize(recording.window);
    window_->show();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    if (recording.demo.isEmpty()) return;
    JobContext job;
    makeDemoCampaign(recording.demo.toStdString(), folder_ / "campaign", true, job);
    {
      Session session = Session::create(folder_ / "kept");
      (void)session.importCampaign(folder_ / "campaign", job);
    }
    window_->open(QString::fromStdString((folder_ / "kept").string()));
    ASSERT_TRUE(waitForJobs(*window_, 120));
    ASSERT_NE(window_->session().campaign(), nullptr) << window_->jobBar()->message().toStdString();
  }

  /// What is said, without the place of this run.
  [[nodiscard]] QString said(const QWidget& shown) const {
    return pageState(shown).replace(QString::fromStdString(folder_.path().string()), QStringLiteral("FOLDER"));
  }

  testing::TempFolder folder_;
  std::unique_ptr<MainWindow> window_;
};

void compare(const QString& kept, const QString& said, bool renew) {
  if (renew) {
    QFile out(kept);
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write(said.toUtf8());
    return;
  }
  const QString before = textOf(kept);
  ASSERT_FALSE(before.isEmpty()) << kept.toStdString() << " is not there";
  EXPECT_TRUE(before == said) << kept.toStdString() << ", " << difference(before, said);
}

void compare(const QString& kept, const QImage& picture, bool renew) {
  if (renew) {
    ASSERT_TRUE(asBaseline(picture).save(kept, "png", 0));
  }
  const QImage before(kept);
  ASSERT_FALSE(before.isNull()) << kept.toStdString() << " is not there";
  const PictureDifference difference = comparePictures(before, picture);
  std::printf("%s: %s\n", qPrintable(kept.mid(kept_folder.size())), qPrintable(difference.text()));
  if (difference.alike()) return;
  const QString now = QDir::temp().filePath(QStringLiteral("spindrift-") +
                                            kept.mid(kept_folder.size()).replace(QLatin1Char('/'), QLatin1Char('-')));
  picture.save(now);
  ADD_FAILURE() << kept.toStdString() << " looks different: " << difference.text().toStdString() << "; see "
                << now.toStdString();
}

TEST_P(RecordingsTest, SaysAndLooksTheSame) {
  const QString name = QString::fromStdString(GetParam());
  const Recording recording = Recording::read((kept_folder + name + QStringLiteral(".json")).toStdString());
  open(recording);
  ASSERT_FALSE(HasFatalFailure());
  const bool renew = qEnvironmentVariableIsSet("SPINDRIFT_RENEW_BASELINES");
  ASSERT_TRUE(!renew || QDir().mkpath(kept_folder + name));
  int looks = 0;
  Replay replay(*window_, recording, [&](const QString& look, QWidget& shown) {
    ++looks;
    QTest::qWait(200);  // what a page makes when there is time is there
    ASSERT_TRUE(waitForJobs(*window_, 30));
    const QString kept = kept_folder + name + QLatin1Char('/') + look;
    compare(kept + QStringLiteral(".txt"), said(shown), renew);
    for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
      window_->setTheme(kind);
      ASSERT_TRUE(waitForJobs(*window_, 30));
      compare(kept + (kind == ThemeKind::Dark ? QStringLiteral("-dark.png") : QStringLiteral("-light.png")),
              shown.grab().toImage(), renew);
    }
  });
  const QString failure = replay.run(240);
  EXPECT_TRUE(failure.isEmpty()) << failure.toStdString();
  EXPECT_GT(looks, 0);
}

/// Letters, digits and underscores.
std::string nameOfCase(const ::testing::TestParamInfo<std::string>& one) {
  return one.param;
}

INSTANTIATE_TEST_SUITE_P(Kept, RecordingsTest, ::testing::ValuesIn(recordingNames()), nameOfCase);

class RecorderTest : public RecordingsTest {};

/// A recording of a user, if the environment names one.
class UsersRecordingTest : public RecordingsTest {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(UsersRecordingTest);

TEST_P(UsersRecordingTest, IsDoneAgain) {
  const Recording recording = Recording::read(GetParam());
  open(recording);
  Replay replay(*window_, recording, [&](const QString& look, QWidget& shown) {
    std::printf("%s\n%s\n", qPrintable(look), qPrintable(said(shown)));
  });
  const QString failure = replay.run(600);
  EXPECT_TRUE(failure.isEmpty()) << failure.toStdString();
  std::printf("at the end\n%s\n", qPrintable(said(*window_)));
}

std::vector<std::string> usersRecordings() {
  const std::string file = qEnvironmentVariable("SPINDRIFT_REPLAY").toStdString();
  return file.empty() ? std::vector<std::string>() : std::vector<std::string>{file};
}

INSTANTIATE_TEST_SUITE_P(One, UsersRecordingTest, ::testing::ValuesIn(usersRecordings()));

TEST_F(RecorderTest, WhatWasDoneIsRecordedAndComesOutTheSame) {
  Recording start;
  start.demo = QStringLiteral("holes");
  open(start);
  ASSERT_FALSE(HasFatalFailure());
  const std::filesystem::path file = folder_ / "done.json";
  QString first;
  {
    Recorder recorder(start.demo, QStringLiteral("en"), window_->size());
    recorder.keepIn(file);
    const auto click = [&](QWidget* control, QPoint at = {}) {
      const QPoint place = control->mapTo(control->window(), at.isNull() ? control->rect().center() : at);
      QTest::mouseClick(control->window()->windowHandle(), Qt::LeftButton, {}, place);
      ASSERT_TRUE(waitForJobs(*window_, 60));
    };
    click(window_->stepList()->button(StepId::Calibrate));
    click(window_->dueButton());
    click(window_->stepList()->button(StepId::Machine));
    // A field of the machine: pressed, emptied and typed.
    auto* field = qobject_cast<QLineEdit*>(findControl({{}, QStringLiteral("QLineEdit Name of the machine"), 0}));
    ASSERT_NE(field, nullptr);
    click(field);
    QTest::keyClick(window_->windowHandle(), Qt::Key_A, Qt::ControlModifier);
    for (const char c : std::string("Mill 7")) QTest::keyClick(window_->windowHandle(), c);
    QTest::keyClick(window_->windowHandle(), Qt::Key_Tab);
    ASSERT_TRUE(waitForJobs(*window_, 60));
    EXPECT_EQ(field->text(), QStringLiteral("Mill 7"));
    first = said(*window_);
    recorder.look(QStringLiteral("end"));
  }
  const Recording recorded = Recording::read(file);
  ASSERT_EQ(recorded.done.size(), 4U + 1U + 6U + 1U + 1U)
      << textOf(QString::fromStdString(file.string())).toStdString();
  EXPECT_EQ(recorded.done[3].control.name.section(QLatin1Char(' '), 0, 0), QStringLiteral("QLineEdit"));
  EXPECT_EQ(recorded.done[4].key, Qt::Key_A);
  EXPECT_EQ(recorded.done[5].text, QStringLiteral("M"));
  EXPECT_EQ(recorded.done[11].key, Qt::Key_Tab);
  window_->closeSession();
  window_.reset();
  std::filesystem::remove_all(folder_ / "kept");
  std::filesystem::remove_all(folder_ / "campaign");
  SetUp();
  open(recorded);
  QString again;
  Replay replay(*window_, recorded, [&](const QString&, QWidget& shown) { again = said(shown); });
  const QString failure = replay.run(120);
  EXPECT_TRUE(failure.isEmpty()) << failure.toStdString();
  EXPECT_EQ(again.toStdString(), first.toStdString());
  EXPECT_TRUE(again.contains(QStringLiteral("Mill 7")));
}

TEST_F(RecorderTest, AMissingControlIsSaid) {
  open({});
  Recording recording;
  Interaction press;
  press.control.name = QStringLiteral("QPushButton Make coffee");
  recording.done.push_back(press);
  Replay replay(*window_, recording, [](const QString&, QWidget&) {});
  EXPECT_EQ(replay.run(30), QStringLiteral("1 (QPushButton Make coffee): there is no such control"));
}

TEST(Recording, IsReadAsItWasWritten) {
  const testing::TempFolder folder;
  Recording recording;
  recording.demo = QStringLiteral("holes");
  recording.language = QStringLiteral("de");
  recording.window = QSize(1280, 800);
  Interaction drag;
  drag.kind = Interaction::Kind::Drag;
  drag.control = {QStringLiteral("QDialog"), QStringLiteral("View3D Machine"), 2};
  drag.at = {0.25, 0.5};
  drag.to = {0.75, 0.125};
  drag.button = Qt::MiddleButton;
  drag.modifiers = Qt::ControlModifier | Qt::ShiftModifier;
  Interaction cell;
  cell.kind = Interaction::Kind::DoublePress;
  cell.control.name = QStringLiteral("QWidget Captures");
  cell.part = PartOfControl{{}, 3, 1};
  Interaction entry;
  entry.control = {QStringLiteral("QMenu"), QStringLiteral("QMenu"), 0};
  entry.part = PartOfControl{QStringLiteral("Preferences…")};
  entry.button = Qt::RightButton;
  Interaction key;
  key.kind = Interaction::Kind::Key;
  key.key = Qt::Key_Return;
  key.modifiers = Qt::ControlModifier;
  recording.done = {drag, cell, entry, key};
  recording.write(folder / "r.json");
  const Recording again = Recording::read(folder / "r.json");
  again.write(folder / "again.json");
  EXPECT_EQ(textOf(QString::fromStdString((folder / "r.json").string())),
            textOf(QString::fromStdString((folder / "again.json").string())));
  ASSERT_EQ(again.done.size(), 4U);
  EXPECT_EQ(again.done[0].to, drag.to);
  EXPECT_EQ(again.done[0].modifiers, drag.modifiers);
  EXPECT_EQ(again.done[1].part->row, 3);
  EXPECT_EQ(again.done[2].part->label, QStringLiteral("Preferences…"));
  EXPECT_EQ(again.done[3].key, Qt::Key_Return);
}

TEST(Recording, WhatIsNotOneIsRefusedInOneSentence) {
  const testing::TempFolder folder;
  const auto refusal = [&](const std::string& done) {
    folder.write("r.json", R"({"format":"spindrift-recording","version":1,"done":[)" + done + "]}");
    try {
      (void)Recording::read(folder / "r.json");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal(R"({"do":"dance"})").find("dance"), std::string::npos);
  EXPECT_NE(refusal(R"({"do":"press","on":"QPushButton Fit","at":[0.5,1.5]})").find("from 0 to 1"), std::string::npos);
  EXPECT_NE(refusal(R"({"do":"key","key":"Sausage"})").find("one key"), std::string::npos);
  EXPECT_NE(refusal(R"({"do":"key","key":"A","held":"Hyper"})").find("Ctrl, Alt and Shift"), std::string::npos);
  EXPECT_NE(refusal(R"({"do":"press","at":[0,0]})").find("on"), std::string::npos);
  EXPECT_EQ(refusal(R"({"do":"press","on":"QPushButton Fit","at":[0.5,0.5]})"), "");
}

}  // namespace
}  // namespace spindrift::gui
