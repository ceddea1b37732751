// SPDX-License-Identifier: GPL-3.0-or-later
// Every page of every demo with its help, the pages without a session, windows, dialogs and menus in another language:
// no text that a person reads is left out of the translation.
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAbstractItemModel>
#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QTabBar>
#include <QTabWidget>
#include <QTableView>
#include <QTextDocumentFragment>
#include <QTranslator>
#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/discrepancy/catalogue.h"
#include "core/machine/campaign.h"
#include "core/plant/batch_queue.h"
#include "core/plant/plant_store.h"
#include "core/reporting/report_language.h"
#include "core/tasks/report_task.h"
#include "core/workflows/file_reference.h"
#include "core/workflows/manual.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/help_text.h"
#include "widgets/common/languages.h"
#include "widgets/common/preferences.h"
#include "widgets/common/quantity_box.h"
#include "widgets/export/exportable.h"
#include "widgets/jobs/activity_dialog.h"
#include "widgets/pages/page.h"
#include "widgets/pages/plant/plant_page.h"
#include "widgets/panels/scanning/artefact_designer.h"
#include "widgets/plots/plot.h"
#include "widgets/plots/surface_plot.h"
#include "widgets/shell/command_palette.h"
#include "widgets/shell/new_measurement_dialog.h"
#include "widgets/shell/news_dialog.h"
#include "widgets/shell/notes_dialog.h"
#include "widgets/shell/preferences_dialog.h"
#include "widgets/teaching/exercise_dialog.h"
#include "widgets/teaching/what_if_window.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

constexpr auto begin_mark = u'‹';
constexpr auto end_mark = u'›';
constexpr int rows_looked_at = 12;

/// Marks what the catalogue knows: a text without marks on screen is one that nobody can translate.
class Marks : public QTranslator {
 public:
  Marks() { EXPECT_TRUE(catalogue_.load(QStringLiteral("spindrift_de"), QStringLiteral(":/translations"))); }
  [[nodiscard]] bool isEmpty() const override { return false; }
  [[nodiscard]] QString translate(const char* context, const char* source, const char* disambiguation,
                                  int n) const override {
    if (catalogue_.translate(context, source, disambiguation, n).isEmpty()) return {};
    QString text = QString::fromUtf8(source);
    if (text.trimmed().isEmpty() || text.startsWith(QStringLiteral("Ctrl"))) return {};
    return QChar(begin_mark) + text.remove(QLatin1Char('&')) + QChar(end_mark);
  }

 private:
  QTranslator catalogue_;
};

/// What stands outside of all marks.
QString unmarked(const QString& text) {
  QString out;
  int depth = 0;
  for (const QChar c : text) {
    if (c == QChar(begin_mark)) {
      ++depth;
      out += QLatin1Char(' ');
    } else if (c == QChar(end_mark)) {
      depth = std::max(0, depth - 1);
    } else if (depth == 0) {
      out += c;
    }
  }
  return out;
}

/// Words of the text that are neither names of columns, files and axes nor units.
QStringList wordsOf(const QString& text) {
  static const QRegularExpression name(QStringLiteral("\\S*[_/\\\\.:@=\\d]\\S*|\\b[A-Z]{2,}\\w*"));
  static const QRegularExpression word(QStringLiteral("\\b[A-Za-z]{3,}\\b"),
                                       QRegularExpression::UseUnicodePropertiesOption);
  static const std::set<QString> same_everywhere = {
      QStringLiteral("Spindrift"), QStringLiteral("rms"),      QStringLiteral("min"),     QStringLiteral("mrad"),
      QStringLiteral("degC"),      QStringLiteral("µrad"),     QStringLiteral("English"), QStringLiteral("Deutsch"),
      QStringLiteral("ARX"),       QStringLiteral("CalculiX"), QStringLiteral("dir"),     QStringLiteral("Strg"),
      QStringLiteral("arcsec"),    QStringLiteral("rpm"),      QStringLiteral("Umschalt")};
  QString plain = text;
  plain.replace(name, QStringLiteral(" "));
  QStringList words;
  for (auto i = word.globalMatch(plain); i.hasNext();) {
    const QString one = i.next().captured();
    if (!same_everywhere.contains(one)) words << one;
  }
  return words;
}

/// Names that people gave: every text of the machine's description, and the ids of kinds and sources. What the demos
/// are called, and where their sensors sit, has words in every language.
std::set<QString> namesIn(const nlohmann::json& document) {
  std::set<QString> names;
  const nlohmann::json flat = document.flatten();
  for (const auto& [key, value] : flat.items()) {
    if (value.is_string() && key != "/name" && !key.ends_with("/place"))
      names.insert(QString::fromStdString(value.get<std::string>()));
  }
  return names;
}

void forEachText(QWidget& root, const std::function<void(const QString&)>& take) {
  const auto all = root.findChildren<QWidget*>();
  for (QWidget* w : all) {
    if (!w->isVisible()) continue;
    take(w->toolTip());
    if (const auto* plot = qobject_cast<Plot*>(w)) {
      for (const QString& title : plot->axisTitles()) take(title);
    }
    if (const auto* surface = qobject_cast<SurfacePlot*>(w)) {
      for (const QString& title : {surface->data().x_title, surface->data().y_title, surface->data().value_title})
        take(shownTitle(title));
    }
    if (const auto* box = qobject_cast<QDoubleSpinBox*>(w)) take(box->suffix());
    if (const auto* text = qobject_cast<HelpText*>(w)) {
      for (const QString& line : text->toPlainText().split(QLatin1Char('\n'))) take(line);
    }
    if (const auto* label = qobject_cast<QLabel*>(w)) take(label->text());
    if (const auto* button = qobject_cast<QAbstractButton*>(w)) take(button->text());
    if (const auto* box = qobject_cast<QGroupBox*>(w)) take(box->title());
    if (const auto* line = qobject_cast<QLineEdit*>(w)) take(line->placeholderText());
    if (const auto* tabs = qobject_cast<QTabBar*>(w)) {
      for (int i = 0; i < tabs->count(); ++i) take(tabs->tabText(i));
    }
    if (const auto* choice = qobject_cast<QComboBox*>(w)) {
      for (int i = 0; i < choice->count(); ++i) take(choice->itemText(i));
    }
    if (const auto* view = qobject_cast<QAbstractItemView*>(w); view != nullptr && view->model() != nullptr) {
      const QAbstractItemModel& model = *view->model();
      for (int c = 0; c < model.columnCount(); ++c) {
        if (qobject_cast<const QTableView*>(view) != nullptr) take(model.headerData(c, Qt::Horizontal).toString());
        for (int r = 0; r < std::min(rows_looked_at, model.rowCount()); ++r) {
          take(model.index(r, c).data().toString());
          take(model.index(r, c).data(Qt::ToolTipRole).toString());
        }
      }
    }
  }
}

/// Of the effects, the longest first: a short one is part of others.
const QStringList& formulas() {
  static const QStringList all = [] {
    QStringList out;
    for (const Effect& effect : everyEffect()) out << QString::fromStdString(effect.formula);
    std::sort(out.begin(), out.end(), [](const QString& a, const QString& b) { return a.size() > b.size(); });
    return out;
  }();
  return all;
}

class LanguagePagesTest : public StoryTest {
 protected:
  void SetUp() override {
    applyLanguage(QStringLiteral("de"));
    marks_ = std::make_unique<Marks>();
    QCoreApplication::installTranslator(marks_.get());
    StoryTest::SetUp();
    window_->resize(1280, 800);
  }
  void TearDown() override {
    StoryTest::TearDown();
    QCoreApplication::removeTranslator(marks_.get());
    applyLanguage(QStringLiteral("en"));
  }
  /// Nothing that `root` shows, and no action of its menus, is without marks or has units as files write them.
  void expectTranslated(QWidget& root, const std::string& what) {
    std::set<QString> names = {QStringLiteral("log"),     QStringLiteral("microscope"), QStringLiteral("fiducial"),
                               QStringLiteral("surface"), QStringLiteral("probe"),      QStringLiteral("profiler")};
    if (const auto campaign = window_->session().campaign()) {
      names.merge(namesIn(nlohmann::json::parse(readFile(campaign->path("machine.json")))));
    }
    // "EX_um" is the name of a column.
    static const QRegularExpression file_unit(QStringLiteral("\\b(um|urad)\\b"));
    const auto take = [&](const QString& text) {
      if (names.contains(text)) return;
      QString plain = text.contains(QLatin1Char('<')) ? QTextDocumentFragment::fromHtml(text).toPlainText() : text;
      // Formulas are the same in every language.
      for (const QString& formula : formulas()) plain.remove(formula);
      if (file_unit.match(plain).hasMatch() && told_.insert(plain).second)
        ADD_FAILURE() << what << ": \"" << plain.toStdString() << "\" has a unit as files write it";
      const QStringList words = wordsOf(unmarked(plain));
      if (!words.isEmpty() && told_.insert(plain).second) {
        ADD_FAILURE() << what << ": \"" << plain.toStdString() << "\" (" << words.join(QLatin1Char(' ')).toStdString()
                      << ")";
      }
    };
    take(root.windowTitle());
    forEachText(root, take);
    for (const QAction* action : root.findChildren<QAction*>()) {
      take(action->text().remove(QLatin1Char('&')));
      if (action->toolTip() != action->text()) take(action->toolTip());
    }
  }
  /// Every text that a report shows, code and the small print of ids apart.
  void expectTranslated(const std::vector<ReportBlock>& blocks, const std::string& what,
                        const std::set<QString>& names) {
    const auto take = [&](const std::string& english) {
      QString plain = QString::fromStdString(english).trimmed();
      QString name = plain;  // a name that people gave may be words that the catalogue knows
      name.remove(QChar(begin_mark)).remove(QChar(end_mark));
      if (names.contains(name)) return;
      for (const QString& formula : formulas()) plain.remove(formula);
      const QStringList words = wordsOf(unmarked(plain));
      if (!words.isEmpty() && told_.insert(plain).second) {
        ADD_FAILURE() << what << ": \"" << plain.toStdString() << "\" (" << words.join(QLatin1Char(' ')).toStdString()
                      << ")";
      }
    };
    const auto takeText = [&](const ReportText& text) {
      for (const ReportText::Run& run : text.runs) {
        if (!run.small) take(run.text);
      }
    };
    for (const ReportBlock& block : blocks) {
      if (const auto* heading = std::get_if<HeadingBlock>(&block)) takeText(heading->text);
      if (const auto* text = std::get_if<TextBlock>(&block)) takeText(text->text);
      if (const auto* callout = std::get_if<CalloutBlock>(&block)) takeText(callout->text);
      if (const auto* table = std::get_if<TableBlock>(&block)) {
        take(table->caption);
        for (const ReportText& cell : table->header) takeText(cell);
        for (const ReportRow& row : table->rows) {
          for (const ReportText& cell : row) takeText(cell);
        }
      }
      if (const auto* figure = std::get_if<FigureBlock>(&block)) {
        take(figure->caption);
        std::string texts;  // a sentence may go on in the next line
        for (const Drawing::Shape& shape : figure->drawing.shapes()) {
          if (const auto* text = std::get_if<Drawing::Text>(&shape)) texts += text->text + " ";
        }
        take(texts);
      }
    }
  }

 private:
  std::unique_ptr<Marks> marks_;
  std::set<QString> told_;
};

class LanguageOfPages : public LanguagePagesTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(LanguageOfPages, NoTextIsLeftOutOfTheTranslation) {
  expectTranslated(*window_, "first screen");
  window_->helpAction()->trigger();
  walk(QString::fromLatin1(GetParam()), [this](const std::string& what) { expectTranslated(*window_, what); });
  // The report of all that.
  SessionModel& session = window_->session();
  const ReportTask task = ReportTask::of(session.tasks(), session.excludedItems());
  JobContext job;
  const Report report = inLanguage(reportOfCampaign(*task.campaign, task.options, job), *offeredReportLanguage(),
                                   task.namesThatPeopleGave());
  std::set<QString> names = namesIn(nlohmann::json::parse(readFile(session.campaign()->path("machine.json"))));
  names.insert(shownName(session.campaign()->name));
  QString html = QString::fromStdString(htmlOf(report));
  for (const std::string& name : {session.campaign()->name, session.campaign()->machine.name}) {
    const QString shown = QString::fromStdString(escapedXml(shownName(name).toStdString()));
    EXPECT_TRUE(html.contains(shown)) << name;
    html.remove(shown);
    EXPECT_FALSE(html.contains(QString::fromStdString(escapedXml(name)))) << name << " is its name in English";
  }
  expectTranslated(report.blocks(), std::string(GetParam()) + ", report", names);
}

INSTANTIATE_TEST_SUITE_P(Demos, LanguageOfPages,
                         ::testing::Values("fiducials", "holes", "balls", "scans", "discrepancy", "own_pattern"),
                         [](const auto& test) { return std::string(test.param); });

class UnitsTest : public StoryTest {
 protected:
  void SetUp() override {
    StoryTest::SetUp();
    Preferences wanted;
    wanted.units = {true, true, true};
    setPreferences(wanted);
    // Typed into a file: the unit is that of its key.
    for (const char* field : {"Distance to ball 1 / mm", "Certificate ± / µm", "Calibrated position along the bar / mm",
                              "Expansion / (µm/(m·K))", "Fixed bearing\n/ mm", "From\n/ mm", "Hole diameter / mm",
                              "Pitch\n/ mm", "Radius\n/ mm", "Reference at / mm", "Resolution\n/ µm",
                              "Temperature / °C", "To\n/ mm", "x / mm", "y / mm", "z / mm", "Ø / mm", "At / mm"})
      told_.insert(QString::fromUtf8(field));
  }
  void TearDown() override {
    StoryTest::TearDown();
    setShownUnits({});
  }
  /// Nothing that `root` shows has a unit of files.
  void expectChosenUnits(QWidget& root, const std::string& what) {
    static const QRegularExpression of_files(
        QStringLiteral("(?<![\\w])(µm|mm|µrad|°C|(?<=\\d )K|(?<=/)K|(?<=[Pp]er )K)(?![\\w])"),
        QRegularExpression::UseUnicodePropertiesOption);
    forEachText(root, [&](QString text) {
      text.remove(QChar(0x2060)).replace(QChar(0x00a0), QLatin1Char(' '));  // what keeps a number with its unit
      if (of_files.match(text).hasMatch() && told_.insert(text).second)
        ADD_FAILURE() << what << ": \"" << text.toStdString() << "\"";
    });
  }

 private:
  std::set<QString> told_;
};

class UnitsOfPages : public UnitsTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(UnitsOfPages, AreThoseOfThePreferencesAndNoOthers) {
  walk(QString::fromLatin1(GetParam()), [this](const std::string& what) { expectChosenUnits(*window_, what); });
}

INSTANTIATE_TEST_SUITE_P(Demos, UnitsOfPages, ::testing::Values("fiducials", "holes", "balls", "scans", "discrepancy"),
                         [](const auto& test) { return std::string(test.param); });

class UnitsOfWindows : public UnitsTest {
 protected:
  void expectChosenUnitsAndClose(QWidget* dialog, const std::string& what) {
    ASSERT_NE(dialog, nullptr) << what;
    dialog->show();
    wait();
    QCoreApplication::processEvents();
    expectChosenUnits(*dialog, what);
    for (auto* tabs : dialog->findChildren<QTabWidget*>()) {
      for (int i = 1; i < tabs->count(); ++i) {
        tabs->setCurrentIndex(i);
        QCoreApplication::processEvents();
        expectChosenUnits(*dialog, what + ", " + tabs->tabText(i).toStdString());
      }
    }
    dialog->close();
    QCoreApplication::processEvents();
  }
};

TEST_F(UnitsOfWindows, AreThoseOfThePreferencesAndNoOthers) {
  expectChosenUnitsAndClose(window_->openWhatIf(), "what if");
  ArtefactDesigner designer;
  expectChosenUnitsAndClose(&designer, "artefact designer");
  ExerciseDialog* exercise = window_->openExercise();
  Q_EMIT exercise->startWanted({5, ExerciseLevel::Easy});
  wait();
  expectChosenUnitsAndClose(exercise, "exercise");
  window_->openLiveCompensation();
  QCoreApplication::processEvents();
  expectChosenUnits(*window_, "live compensation");
  window_->openPlant();
  QCoreApplication::processEvents();
  expectChosenUnits(*window_, "plant");
  expectChosenUnitsAndClose(window_->openNotes(), "notes");
  expectChosenUnitsAndClose(window_->openActivity(), "jobs and messages");
  NewMeasurementDialog measurement(std::nullopt);
  expectChosenUnitsAndClose(&measurement, "new measurement");
  window_->findCommand();
  expectChosenUnitsAndClose(window_->findChild<CommandPalette*>(), "find a command");
}

TEST_F(UnitsOfWindows, FollowTheChoiceWhileTheyAreOpen) {
  setPreferences({});
  WhatIfWindow* what_if = window_->openWhatIf();
  what_if->set("column.bending.a", 2.0);
  ArtefactDesigner designer;
  designer.show();
  Preferences wanted;
  wanted.units = {true, true, true};
  setPreferences(wanted);
  wait();
  expectChosenUnits(*what_if, "what if");
  expectChosenUnits(designer, "artefact designer");
  EXPECT_EQ(what_if->box("column.bending.a")->text(), QStringLiteral("3.60 °F"));
  EXPECT_EQ(what_if->box("column.bending.a")->value(), 2.0);
  designer.number("size x")->setValue(25.4);
  EXPECT_EQ(designer.number("size x")->cleanText(), QStringLiteral("1.000"));
  setPreferences({});
  EXPECT_EQ(what_if->box("column.bending.a")->text(), QStringLiteral("2.00 K"));
}

class LanguageOfWindows : public LanguagePagesTest {
 protected:
  void expectTranslatedAndClose(QWidget* dialog, const std::string& what) {
    ASSERT_NE(dialog, nullptr) << what;
    dialog->show();
    wait();
    QCoreApplication::processEvents();
    expectTranslated(*dialog, what);
    dialog->close();
    QCoreApplication::processEvents();
  }
};

TEST_F(LanguageOfWindows, NoTextOfWindowsAndDialogsIsLeftOut) {
  window_->startDemo(QStringLiteral("fiducials"), true);
  wait();
  window_->workflow().goTo(StepId::Calibrate);
  window_->currentPage()->runAll();
  wait();
  window_->openLiveCompensation();
  QCoreApplication::processEvents();
  expectTranslated(*window_, "live compensation");
  expectTranslatedAndClose(window_->openActivity(), "jobs and messages");
  expectTranslatedAndClose(window_->openNotes(), "notes");
  expectTranslatedAndClose(window_->openWhatIf(), "what if");
  expectTranslatedAndClose(window_->openExercise(), "exercise");
  window_->openPreferences();
  expectTranslatedAndClose(window_->findChild<PreferencesDialog*>(), "preferences");
  window_->findCommand();
  expectTranslatedAndClose(window_->findChild<CommandPalette*>(), "find a command");
  ArtefactDesigner designer;
  expectTranslatedAndClose(&designer, "artefact designer");
  NewMeasurementDialog measurement(std::nullopt);
  expectTranslatedAndClose(&measurement, "new measurement");
  ExportDialog exporting(window_->currentPage()->exportables(), QString());
  expectTranslatedAndClose(&exporting, "export");
  NewsDialog* news = new NewsDialog(window_.get());  // its text is a document
  expectTranslatedAndClose(news, "news");
}

TEST_F(LanguageOfWindows, TheManualIsGerman) {
  ASSERT_TRUE(offeredReportLanguage());
  const Report manual = manualIn(*offeredReportLanguage());
  // What people wrote in German, and what stands in English on purpose, is not looked at: what the program says is.
  std::vector<ReportBlock> generated;
  bool within = false;
  for (const ReportBlock& block : manual.blocks()) {
    const auto* heading = std::get_if<HeadingBlock>(&block);
    if (heading != nullptr && heading->level == 1) {
      const QString title = QString::fromStdString(heading->text.plain());
      within = title.startsWith(QChar(begin_mark));
    }
    if (within) generated.push_back(block);
  }
  EXPECT_GT(generated.size(), 100U);
  expectTranslated(generated, "manual", {});
}

TEST_F(LanguageOfWindows, TheReferenceOfFilesIsGerman) {
  ASSERT_TRUE(offeredReportLanguage());
  const auto& translated = offeredReportLanguage()->of_files;
  static const QRegularExpression code(QStringLiteral("`[^`]*`"));
  int looked_at = 0;
  const auto expect = [&](const std::string& english, const std::string& of) {
    QString plain = QString::fromStdString(english);
    // Keys of the keyboard are left without marks.
    if (plain.startsWith(QStringLiteral("Ctrl")) || wordsOf(plain.remove(code)).isEmpty()) return;
    EXPECT_TRUE(QString::fromStdString(translated(english)).startsWith(QChar(begin_mark))) << of << ": " << english;
    ++looked_at;
  };
  for (const FileFormat& format : fileFormats()) {
    expect(format.file, format.id);
    expect(format.what, format.id);
    for (const FileKey& key : format.keys)
      for (const std::string& text : {key.without, key.allowed, key.meaning}) expect(text, format.id + " " + key.path);
  }
  EXPECT_GT(looked_at, 900);
  EXPECT_TRUE(QString::fromStdString(translated(filesMarkdown().substr(0, filesMarkdown().find("## ") - 1)))
                  .startsWith(QChar(begin_mark)));
}

TEST_F(LanguageOfWindows, NoTextOfThePlantIsLeftOut) {
  const QString file = QString::fromStdString((folder_ / "plant.sqlite").string());
  {
    PlantStore store = PlantStore::make(PlantAddress::parse(file.toStdString()));
    std::vector<PlantCampaign> campaigns;
    for (int week = 0; week < 30; ++week) {
      PlantCampaign c;
      c.machine = "M7";
      c.name = "W" + std::to_string(week);
      c.start_s = 1.7e9 + 604'800.0 * week;
      c.fingerprint = c.name;
      c.program_version = SPINDRIFT_VERSION;
      c.publisher = "A1";
      PlantResult r;
      r.kind = "fit";
      r.program_version = SPINDRIFT_VERSION;
      r.inputs_fingerprint = c.fingerprint;
      r.verdict = "converged";
      r.parameters.push_back({"M1", "EZ_um", 8.0 + (week > 20 ? 6.0 : 0.0) + 0.3 * (week % 3), 0.3});
      c.results.push_back(r);
      campaigns.push_back(std::move(c));
    }
    (void)store.publish(campaigns);
    store.addEvent({"M7", 1.7e9 + 604'800.0 * 15.5, "spindle_changed", "SN12", "A1"});
    BatchPlan plan;
    plan.name = "B1";
    plan.work = "hidden_effect";
    plan.seeds = 40;
    plan.chunk = 10;
    (void)BatchQueue(store).submit(plan);
  }
  window_->openPlant();
  window_->plant()->openStore(file);
  wait();
  auto* tabs = window_->plant()->findChild<QTabWidget*>();
  ASSERT_NE(tabs, nullptr);
  for (int i = 0; i < tabs->count(); ++i) {
    tabs->setCurrentIndex(i);
    wait();
    QCoreApplication::processEvents();
    expectTranslated(*window_, "plant, tab " + std::to_string(i + 1));
  }
}

}  // namespace
}  // namespace spindrift::gui
