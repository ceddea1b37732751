// SPDX-License-Identifier: GPL-3.0-or-later
// Preferences: each of them has its effect at once and is there at the next start.
#include "widgets/common/preferences.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTableView>
#include <QTest>
#include <QTimer>
#include <latch>

#include "core/base/atomic_file.h"
#include "core/machine/machine_description.h"
#include "core/tasks/task_options.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/common/parts.h"
#include "widgets/export/exportable.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/panels/discrepancy/effect_editor.h"
#include "widgets/panels/discrepancy/effects_panel.h"
#include "widgets/shell/tour.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/system_look.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

class PreferencesTest : public StoryTest {
 protected:
  void SetUp() override {
    StoryTest::SetUp();
    window_->setTheme(ThemeKind::Light);
  }
  void TearDown() override {
    StoryTest::TearDown();
    QSettings().clear();
    applyTheme(*qApp, ThemeKind::Light);
  }
  void openDialog() {
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    QTest::keyClick(window_.get(), Qt::Key_Comma, Qt::ControlModifier);
    QCoreApplication::processEvents();
    dialog_ = window_->findChild<QDialog*>(QStringLiteral("preferences"));
    ASSERT_NE(dialog_, nullptr);
    ASSERT_TRUE(dialog_->isVisible());
  }
  template <class Widget>
  [[nodiscard]] Widget* field(const char* name) const {
    return dialog_->findChild<Widget*>(QLatin1String(name));
  }
  void chooseLook(Preferences::Look look) {
    auto* box = field<QComboBox>("look");
    box->setCurrentIndex(box->findData(static_cast<int>(look)));
  }
  /// Answers the next question with the button that says `text`, its check box as asked.
  static void answer(const QString& text, bool never_again, QString* sentence) {
    QTimer::singleShot(50, qApp, [text, never_again, sentence] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      *sentence = box->text();
      if (never_again) box->checkBox()->setChecked(true);
      for (QAbstractButton* button : box->buttons()) {
        if (button->text().remove(QLatin1Char('&')) == text) {
          button->click();
          return;
        }
      }
      box->reject();
    });
  }
  [[nodiscard]] double goalOfTheCampaign() {
    return chosen<VerifyOptions>(*window_->session().session(), window_->session().campaignId()).request.goal_um;
  }

  QDialog* dialog_ = nullptr;
};

TEST_F(PreferencesTest, TheThemeIsLightDarkOrThatOfTheSystem) {
  openDialog();
  ASSERT_FALSE(HasFatalFailure());
  chooseLook(Preferences::Look::Dark);
  EXPECT_EQ(theme().kind, ThemeKind::Dark);
  EXPECT_EQ(preferences().look, Preferences::Look::Dark);
  const auto systemSays = [](uint scheme) {
    SystemLook::instance().take(QStringLiteral("org.freedesktop.appearance"), QStringLiteral("color-scheme"), scheme);
  };
  systemSays(2);
  EXPECT_EQ(theme().kind, ThemeKind::Dark) << "the user's choice is above the system's";
  chooseLook(Preferences::Look::System);
  EXPECT_EQ(theme().kind, ThemeKind::Light);
  systemSays(1);
  EXPECT_EQ(theme().kind, ThemeKind::Dark);
  systemSays(0);
  SystemLook::instance().take(QStringLiteral("org.gnome.desktop"), QStringLiteral("color-scheme"), 1U);
  EXPECT_EQ(theme().kind, ThemeKind::Light) << "another setting of the same name";
  // Ctrl+D is a choice, and the dialog shows it.
  window_->setTheme(ThemeKind::Dark);
  EXPECT_EQ(field<QComboBox>("look")->currentData().toInt(), static_cast<int>(Preferences::Look::Dark));
}

TEST_F(PreferencesTest, TheLanguageIsKept) {
  openDialog();
  ASSERT_FALSE(HasFatalFailure());
  auto* box = field<QComboBox>("language");
  EXPECT_GE(box->count(), 2);
  EXPECT_EQ(box->currentData().toString(), QString()) << "that of the system";
  box->setCurrentIndex(box->findData(QStringLiteral("en")));
  EXPECT_EQ(preferences().language, QStringLiteral("en"));
}

TEST_F(PreferencesTest, DecimalsOfMeasuredLengthsChangeTheTablesAtOnce) {
  window_->startDemo(QStringLiteral("holes"), true);
  wait();
  window_->workflow().goTo(StepId::Calibrate);
  window_->currentPage()->runAll();
  wait();
  const auto decimals = [&] {
    std::set<qsizetype> found;
    for (const QTableView* table : window_->currentPage()->findChildren<QTableView*>()) {
      const QAbstractItemModel& model = *table->model();
      for (int c = 0; c < model.columnCount(); ++c) {
        if (model.headerData(c, Qt::Horizontal).toString() != QStringLiteral("x / mm")) continue;
        for (int r = 0; r < model.rowCount(); ++r) {
          const QString text = model.index(r, c).data().toString();
          if (text.contains(QLatin1Char('.'))) found.insert(text.size() - text.indexOf(QLatin1Char('.')) - 1);
        }
      }
    }
    return found;
  };
  EXPECT_EQ(decimals(), std::set<qsizetype>{4});
  openDialog();
  ASSERT_FALSE(HasFatalFailure());
  auto* box = field<QComboBox>("length_decimals");
  box->setCurrentIndex(box->findData(2));
  QCoreApplication::processEvents();
  EXPECT_EQ(decimals(), std::set<qsizetype>{2});
  QTest::mouseClick(field<QPushButton>("reset"), Qt::LeftButton);
  QCoreApplication::processEvents();
  EXPECT_EQ(decimals(), std::set<qsizetype>{4});
}

TEST_F(PreferencesTest, UnitsChangeTablesAndGoalsAtOnceAndNoFile) {
  window_->startDemo(QStringLiteral("holes"), true);
  wait();
  window_->workflow().goTo(StepId::Calibrate);
  window_->currentPage()->runAll();
  wait();
  const auto values = [&](const QString& title) {
    QStringList texts;
    for (const QTableView* table : window_->currentPage()->findChildren<QTableView*>()) {
      const QAbstractItemModel& model = *table->model();
      for (int c = 0; c < model.columnCount(); ++c) {
        if (model.headerData(c, Qt::Horizontal).toString() != title) continue;
        for (int r = 0; r < model.rowCount(); ++r) texts << model.index(r, c).data().toString();
      }
    }
    return texts;
  };
  const auto exported = [&] {
    QString all;
    for (const Exportable& item : window_->currentPage()->exportables()) {
      if (!item.formats.contains(QStringLiteral("csv"))) continue;
      const QString file = QString::fromStdString((folder_ / "table.csv").string());
      item.write(file);
      all += QString::fromStdString(readFile(file.toStdString()));
    }
    return all;
  };
  const QStringList mm = values(QStringLiteral("x / mm"));
  ASSERT_FALSE(mm.isEmpty());
  const QString files = exported();
  openDialog();
  ASSERT_FALSE(HasFatalFailure());
  field<QComboBox>("units_lengths")->setCurrentIndex(1);
  field<QComboBox>("units_angles")->setCurrentIndex(1);
  QCoreApplication::processEvents();
  EXPECT_TRUE(values(QStringLiteral("x / mm")).isEmpty());
  const QStringList inches = values(QStringLiteral("x / in"));
  ASSERT_EQ(inches.size(), mm.size());
  for (qsizetype i = 0; i < mm.size(); ++i)
    EXPECT_NEAR(typedNumber(inches[i]).value(), typedNumber(mm[i]).value() / 25.4, 1e-6) << mm[i].toStdString();
  EXPECT_EQ(exported(), files);
  // A goal is typed in the unit that is read, and kept in that of files.
  auto* goal = field<QDoubleSpinBox>("goal_um");
  EXPECT_EQ(goal->text(), QStringLiteral("197 µin"));
  goal->setFocus();
  goal->selectAll();
  QTest::keyClicks(goal, QStringLiteral("200"));
  QTest::keyClick(goal, Qt::Key_Tab);
  EXPECT_NEAR(preferences().goal_um, 5.08, 1e-6);
  EXPECT_EQ(goal->text(), QStringLiteral("200 µin"));
  QTest::mouseClick(field<QPushButton>("reset"), Qt::LeftButton);
  QCoreApplication::processEvents();
  EXPECT_EQ(values(QStringLiteral("x / mm")), mm);
  EXPECT_EQ(goal->text(), QStringLiteral("5.0 µm"));
}

TEST_F(PreferencesTest, NewSessionsGoIntoTheFolder) {
  const QByteArray before = qgetenv("SPINDRIFT_SESSIONS");
  qunsetenv("SPINDRIFT_SESSIONS");
  openDialog();
  const QString wanted = QString::fromStdString((folder_ / "my sessions").string());
  auto* edit = field<QLineEdit>("sessions_folder");
  edit->setFocus();
  QTest::keyClicks(edit, wanted);
  QTest::keyClick(edit, Qt::Key_Return);
  EXPECT_EQ(preferences().sessions_folder, wanted);
  window_->open(QString::fromStdString(writeStoryCampaign(folder_, Hidden::SpindleGrowth).string()));
  wait();
  EXPECT_EQ(window_->session().folder().parent_path(), folder_ / "my sessions");
  window_->closeSession();
  // One that cannot be written to is refused with a sentence, and what was there stays.
  openDialog();
  edit = field<QLineEdit>("sessions_folder");
  edit->setFocus();
  edit->selectAll();
  QTest::keyClicks(edit, QStringLiteral("/proc/nothing"));
  QTest::keyClick(edit, Qt::Key_Tab);
  EXPECT_EQ(preferences().sessions_folder, wanted);
  const auto* problem = dialog_->findChild<Callout*>();
  EXPECT_TRUE(problem->isVisible());
  EXPECT_TRUE(problem->sentence().contains(QStringLiteral("/proc/nothing"))) << problem->sentence().toStdString();
  qputenv("SPINDRIFT_SESSIONS", before);
}

TEST_F(PreferencesTest, ANewCampaignBeginsWithTheGoalAndKeepsItsOwn) {
  const auto campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth);
  open(campaign, StepId::Machine);
  EXPECT_DOUBLE_EQ(goalOfTheCampaign(), 5.0);
  const QString first = QString::fromStdString(window_->session().folder().string());
  openDialog();
  ASSERT_FALSE(HasFatalFailure());
  field<QDoubleSpinBox>("goal_um")->setValue(8.5);
  field<QDoubleSpinBox>("goal_urad")->setValue(20.0);
  EXPECT_DOUBLE_EQ(goalOfTheCampaign(), 5.0) << "of the campaign at hand";
  dialog_->close();
  // Imported, added, and begun with nothing.
  open(campaign, StepId::Machine);
  EXPECT_DOUBLE_EQ(goalOfTheCampaign(), 8.5);
  const testing::TempFolder other;
  window_->addCampaign(QString::fromStdString(writeStoryCampaign(other, Hidden::Nothing).string()));
  wait();
  ASSERT_EQ(window_->session().campaigns().size(), 2U);
  EXPECT_DOUBLE_EQ(goalOfTheCampaign(), 8.5);
  EXPECT_DOUBLE_EQ(
      chosen<VerifyOptions>(*window_->session().session(), window_->session().campaignId()).request.goal_urad, 20.0);
  const nlohmann::json machine = window_->session().campaign()->machine.source;
  window_->startMeasurement(machine);
  ASSERT_NE(window_->session().campaign(), nullptr);
  EXPECT_DOUBLE_EQ(goalOfTheCampaign(), 8.5);
  window_->open(first);
  wait();
  EXPECT_DOUBLE_EQ(goalOfTheCampaign(), 5.0) << "of an earlier session";
}

TEST_F(PreferencesTest, QuittingWhileWorkIsRunningIsAsked) {
  std::latch go_on(1);
  Job job;
  job.title = QStringLiteral("a long fit");
  job.work = [&go_on](JobContext&) -> std::function<void()> {
    go_on.wait();
    return {};
  };
  window_->jobs().run(std::move(job));
  QString sentence;
  answer(QStringLiteral("Cancel"), true, &sentence);
  EXPECT_FALSE(window_->close());
  EXPECT_TRUE(sentence.contains(QStringLiteral("a long fit"))) << sentence.toStdString();
  EXPECT_TRUE(window_->isVisible());
  EXPECT_TRUE(preferences().ask_before_quitting) << "who stays is asked again";
  answer(QStringLiteral("Quit"), true, &sentence);
  go_on.count_down();
  EXPECT_TRUE(window_->close());
  EXPECT_FALSE(preferences().ask_before_quitting);
}

TEST_F(PreferencesTest, NothingIsAskedWhereNothingIsLost) {
  QString sentence;
  answer(QStringLiteral("Cancel"), false, &sentence);
  EXPECT_TRUE(window_->close());
  EXPECT_TRUE(sentence.isEmpty());
}

TEST_F(PreferencesTest, AnEditedEffectIsDiscardedWithoutAQuestionIfSoWished) {
  open(writeStoryCampaign(folder_, Hidden::Nothing), StepId::Discrepancy);
  window_->openEffects();
  auto* discrepancy = page<DiscrepancyPage>();
  ASSERT_NE(discrepancy, nullptr);
  const auto edit = [&] {
    discrepancy->effects()->newEffect();
    QLineEdit* id = discrepancy->effects()->editor()->id();
    id->setText(QStringLiteral("mine"));
    Q_EMIT id->textEdited(id->text());
    ASSERT_TRUE(discrepancy->effects()->hasUnsavedEdit());
  };
  ASSERT_TRUE(QTest::qWaitFor([&] { return !discrepancy->effects()->busy(); }));
  edit();
  QString sentence;
  answer(QStringLiteral("Cancel"), false, &sentence);
  EXPECT_FALSE(discrepancy->mayBeLeft());
  EXPECT_FALSE(sentence.isEmpty());
  openDialog();
  ASSERT_FALSE(HasFatalFailure());
  field<QCheckBox>("ask_before_discarding")->setChecked(false);
  dialog_->close();
  sentence.clear();
  EXPECT_TRUE(discrepancy->mayBeLeft());
  EXPECT_TRUE(sentence.isEmpty());
  EXPECT_FALSE(discrepancy->effects()->hasUnsavedEdit());
}

TEST_F(PreferencesTest, WhatCannotBeReadHasItsDefault) {
  QSettings settings;
  settings.setValue(QStringLiteral("theme"), QStringLiteral("pink"));
  settings.setValue(QStringLiteral("preferences/length_decimals"), 99);
  settings.setValue(QStringLiteral("preferences/goal_um"), QStringLiteral("nan"));
  settings.setValue(QStringLiteral("preferences/goal_urad"), -3.0);
  EXPECT_EQ(preferences(), Preferences());
  Preferences all;
  all.look = Preferences::Look::Dark;
  all.language = QStringLiteral("en");
  all.length_decimals = 0;
  all.sessions_folder = QStringLiteral("/somewhere");
  all.goal_um = 0.25;
  all.goal_urad = 12.0;
  all.ask_before_quitting = false;
  all.ask_before_discarding = false;
  setPreferences(all);
  EXPECT_EQ(preferences(), all);
  setPreferences({});
  EXPECT_EQ(preferences(), Preferences());
}

TEST_F(PreferencesTest, WhatIsKeptInATestIsKeptByThisRunAlone) {
  EXPECT_TRUE(QSettings().fileName().startsWith(QDir::tempPath())) << QSettings().fileName().toStdString();
}

TEST_F(PreferencesTest, TheFolderOfTheLastExportIsOfferedAgain) {
  open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Machine);
  const QString target = QString::fromStdString((folder_ / "exports").string());
  window_->exportTo(target);
  auto* dialog = window_->findChild<ExportDialog*>();
  ASSERT_NE(dialog, nullptr);
  EXPECT_TRUE(dialog->exportNow());
  dialog->close();
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  window_->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  QTest::keyClick(window_.get(), Qt::Key_E, Qt::ControlModifier);
  dialog = window_->findChild<ExportDialog*>();
  ASSERT_NE(dialog, nullptr);
  EXPECT_EQ(dialog->folder(), target);
  dialog->close();
}

}  // namespace
}  // namespace spindrift::gui
