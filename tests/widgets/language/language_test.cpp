// SPDX-License-Identifier: GPL-3.0-or-later
// The catalogues are complete and true to their sources; sentences of core and numbers are shown in the language of the
// window, and files keep their point.
#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFile>
#include <QImage>
#include <QLineEdit>
#include <QRegularExpression>
#include <QSettings>
#include <QTest>
#include <QTextDocument>
#include <QUrl>
#include <QXmlStreamReader>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/machine/observation.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"
#include "widgets/common/core_formats.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/editor_table.h"
#include "widgets/common/help_text.h"
#include "widgets/common/languages.h"
#include "widgets/common/preferences.h"
#include "widgets/common/words.h"
#include "widgets/export/exportable.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/theme/colour_map.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/measurement.h"

namespace spindrift::gui {
namespace {

struct Text {
  QString context;
  QString source;
  QStringList translations;  ///< one for each form of a plural
  bool unfinished = false;
};

std::vector<Text> textsOf(const QString& name) {
  QFile file(QString::fromStdString((spindrift::testing::sourceFolder() / "resources/translations/").string()) + name);
  EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << name.toStdString();
  QXmlStreamReader xml(&file);
  std::vector<Text> texts;
  QString context;
  while (!xml.atEnd()) {
    if (xml.readNext() != QXmlStreamReader::StartElement) continue;
    if (xml.name() == QLatin1String("name")) context = xml.readElementText();
    if (xml.name() == QLatin1String("source")) texts.push_back({context, xml.readElementText(), {}, false});
    if (xml.name() == QLatin1String("translation")) {
      texts.back().unfinished = xml.attributes().hasAttribute(QStringLiteral("type"));
      QString text;
      while (xml.readNext() != QXmlStreamReader::EndElement || xml.name() != QLatin1String("translation")) {
        if (xml.isStartElement()) texts.back().translations << xml.readElementText();
        if (xml.isCharacters()) text += xml.text();
      }
      if (texts.back().translations.isEmpty()) texts.back().translations << text;
    }
  }
  EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
  return texts;
}

/// "%1", "{:.2f}", ... in order of their text. Their numbers in a translation, which may turn them round, do not count.
std::multiset<QString> placeholdersOf(QString text, bool of_core) {
  static const QRegularExpression qt(QStringLiteral("%(?:[1-9]|n)"));
  static const QRegularExpression fmt(QStringLiteral("\\{[^{} ]*(?:\\{\\}[^{} ]*)*\\}"));
  static const QRegularExpression number(QStringLiteral("^\\{\\d+"));
  if (of_core) text.remove(QStringLiteral("{{")).remove(QStringLiteral("}}"));
  std::multiset<QString> found;
  for (auto i = (of_core ? fmt : qt).globalMatch(text); i.hasNext();) {
    QString one = i.next().captured();
    if (of_core) one.replace(number, QStringLiteral("{"));
    found.insert(one);
  }
  return found;
}

bool hasMnemonic(const QString& text) {
  static const QRegularExpression mnemonic(QStringLiteral("&\\w"), QRegularExpression::UseUnicodePropertiesOption);
  return mnemonic.match(text).hasMatch();
}

class CatalogueTest : public ::testing::TestWithParam<const char*> {};

TEST_P(CatalogueTest, IsCompleteAndKeepsPlaceholdersBordersAndMnemonics) {
  const std::vector<Text> texts = textsOf(QString::fromLatin1(GetParam()));
  ASSERT_FALSE(texts.empty());
  for (const Text& text : texts) {
    SCOPED_TRACE(text.context.toStdString() + ": " + text.source.toStdString());
    EXPECT_FALSE(text.unfinished);
    const bool of_core = text.context == QLatin1String("core");
    for (const QString& translation : text.translations) {
      EXPECT_FALSE(translation.isEmpty());
      if (translation.isEmpty()) continue;
      auto wanted = placeholdersOf(text.source, of_core);
      auto there = placeholdersOf(translation, of_core);
      if (text.translations.size() > 1) {  // "one cycle" may do without its number
        wanted.erase(QStringLiteral("%n"));
        there.erase(QStringLiteral("%n"));
      }
      EXPECT_EQ(wanted, there) << translation.toStdString();
      EXPECT_EQ(text.source.front().isSpace(), translation.front().isSpace()) << translation.toStdString();
      EXPECT_EQ(text.source.back().isSpace(), translation.back().isSpace()) << translation.toStdString();
      EXPECT_EQ(hasMnemonic(text.source), hasMnemonic(translation)) << translation.toStdString();
      // Units of people stay units of people.
      EXPECT_EQ(text.source.count(QChar(0x00B5)), translation.count(QChar(0x00B5))) << translation.toStdString();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, CatalogueTest, ::testing::Values("spindrift_de.ts", "spindrift_en.ts"),
                         [](const auto& test) { return std::string(test.param).substr(10, 2); });

/// The glossary of the manual has a German word for each term: sentences that have the term have that word too, by the
/// beginning of its parts (they are declined).
TEST(Glossary, TermsAreTranslatedAsItSays) {
  QFile file(QString::fromStdString((spindrift::testing::sourceFolder() / "resources/manual/70-glossary.md").string()));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const std::vector<Text> texts = textsOf(QStringLiteral("spindrift_de.ts"));
  constexpr qsizetype stem = 4;
  int terms = 0;
  int sentences = 0;
  for (const QString& line : QString::fromUtf8(file.readAll()).split(QLatin1Char('\n'))) {
    const QStringList cells = line.split(QLatin1Char('|'));
    if (cells.size() < 5 || cells[1].trimmed() == QLatin1String("Term") || cells[1].startsWith(QLatin1Char('-')))
      continue;
    const QString term = cells[1].trimmed().section(QStringLiteral(" ("), 0, 0);
    const QRegularExpression word(
        QStringLiteral("(?<![\\w\"{-])%1(?![\\w\".-]\\w|[\\w\"}-])").arg(QRegularExpression::escape(term)),
        QRegularExpression::CaseInsensitiveOption);
    ++terms;
    for (const Text& text : texts) {
      // A value that a file may hold is the same in every language.
      const bool value = text.context == QLatin1String("files") && text.translations == QStringList{text.source};
      if (value || !word.match(text.source).hasMatch()) continue;
      ++sentences;
      for (const QString& translation : text.translations) {
        bool said = false;
        for (const QString& choice : cells[2].split(QLatin1Char('/'))) {
          bool all = true;
          for (const QString& part : choice.split(QLatin1Char(' '), Qt::SkipEmptyParts))
            all = all && translation.contains(part.left(stem), Qt::CaseInsensitive);
          said = said || all;
        }
        EXPECT_TRUE(said) << term.toStdString() << ": " << text.source.toStdString() << " | "
                          << translation.toStdString();
      }
    }
  }
  EXPECT_GT(terms, 25);
  EXPECT_GT(sentences, 400);
}

/// All that a user can read: sources with their literals joined, help and manual. White space is one blank.
QString everySentence() {
  const std::filesystem::path top = spindrift::testing::sourceFolder();
  static const QRegularExpression broken(QStringLiteral("\"\\s*\\n\\s*\""));
  QString all;
  for (const char* folder : {"core", "app", "widgets", "resources/help", "resources/manual"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(top / folder)) {
      const std::string ending = entry.path().extension().string();
      if (!std::set<std::string>{".cpp", ".h", ".html", ".svg", ".md"}.contains(ending)) continue;
      QString text = QString::fromStdString(readFile(entry.path()));
      text.remove(broken).replace(QStringLiteral("\\\""), QStringLiteral("\""));
      all += text.simplified() + QLatin1Char('\n');
    }
  }
  return all;
}

/// resources/docs/sentences.md: what stands at the left is said nowhere, what stands at the right is said.
TEST(Sentences, TheWorstAreNotSaidAgain) {
  QFile file(QString::fromStdString((spindrift::testing::sourceFolder() / "resources/docs/sentences.md").string()));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QString all = everySentence();
  int sentences = 0;
  for (const QString& line : QString::fromUtf8(file.readAll()).split(QLatin1Char('\n'))) {
    const QStringList cells = line.split(QLatin1Char('|'));
    if (cells.size() != 4 || cells[1].startsWith(QLatin1Char('-')) || cells[1].trimmed() == QLatin1String("Before"))
      continue;
    ++sentences;
    EXPECT_FALSE(all.contains(cells[1].trimmed())) << cells[1].trimmed().toStdString() << " is said again";
    EXPECT_TRUE(all.contains(cells[2].trimmed())) << cells[2].trimmed().toStdString() << " is not said";
  }
  EXPECT_GE(sentences, 50);
}

/// um and urad are for files: "EX_um" is the name of a column, "um" in quotes a value that a file may hold.
TEST(Sentences, HaveUnitsAsPeopleWriteThem) {
  static const QRegularExpression file_unit(QStringLiteral("(?<![\\w\"])(um|urad)(?![\\w\"])"));
  const QString of_files = QStringLiteral("Of the gain alone, as it is written in results: um, urad, um_per_m");
  int sentences = 0;
  for (const Text& text : textsOf(QStringLiteral("spindrift_de.ts"))) {
    ++sentences;
    if (text.source == of_files || text.context == QLatin1String("files")) continue;
    EXPECT_FALSE(file_unit.match(text.source).hasMatch()) << text.source.toStdString();
  }
  EXPECT_GT(sentences, 5000);
}

/// Counts have their singular: "1 profile", never "1 profiles"; a count that may be one is a plural of the catalogue.
TEST(Sentences, CountsHaveTheirSingular) {
  static const QRegularExpression one_of_many(QStringLiteral("(?<![%\\w])1 (?!has|was)\\w{3,}s\\b"));
  static const QRegularExpression counted(QStringLiteral(
      "(?<!of )%\\d (points|cycles|profiles|touches|files|captures|scans|effects|images|outliers|rows)\\b"));
  int plurals = 0;
  for (const Text& text : textsOf(QStringLiteral("spindrift_en.ts"))) {
    ASSERT_EQ(text.translations.size(), 2) << text.source.toStdString();
    ++plurals;
    const QString one = QString(text.translations[0]).replace(QStringLiteral("%n"), QStringLiteral("1"));
    EXPECT_FALSE(one_of_many.match(one).hasMatch()) << one.toStdString();
  }
  EXPECT_GT(plurals, 30);
  for (const Text& text : textsOf(QStringLiteral("spindrift_de.ts"))) {
    if (text.translations.size() > 1) continue;
    EXPECT_FALSE(counted.match(text.source).hasMatch()) << text.source.toStdString();
  }
  applyLanguage(QStringLiteral("en"));
  EXPECT_EQ(QCoreApplication::translate("spindrift::gui::ScanCapturePage", "%n profiles", nullptr, 1),
            QStringLiteral("1 profile"));
  EXPECT_EQ(QCoreApplication::translate("spindrift::gui::ScanCapturePage", "%n profiles", nullptr, 2),
            QStringLiteral("2 profiles"));
}

class LanguageTest : public ::testing::Test {
 protected:
  void SetUp() override { QSettings().clear(); }
  void TearDown() override { applyLanguage(QStringLiteral("en")); }
};

TEST_F(LanguageTest, IsThatOfTheCallThePreferenceOrTheSystemAndElseEnglish) {
  ASSERT_GE(availableLanguages().size(), 2U);
  EXPECT_EQ(availableLanguages().front().code, QStringLiteral("en"));
  EXPECT_EQ(systemLanguage(), QStringLiteral("en")) << "tests run in the C locale";
  Preferences wanted = preferences();
  EXPECT_EQ(wanted.language, QString());
  wanted.language = QStringLiteral("de");
  setPreferences(wanted);
  applyLanguage(preferences().language);
  EXPECT_EQ(currentLanguage(), QStringLiteral("de"));
  EXPECT_EQ(QCoreApplication::translate("spindrift::gui::MainWindow", "&Help"), QStringLiteral("&Hilfe"));
  EXPECT_EQ(QCoreApplication::translate("spindrift::gui::JobBar", "%n waiting", nullptr, 1),
            QStringLiteral("1 wartet"));
  EXPECT_EQ(QCoreApplication::translate("spindrift::gui::JobBar", "%n waiting", nullptr, 3),
            QStringLiteral("3 warten"));
  EXPECT_EQ(QCoreApplication::translate("QPlatformTheme", "Cancel"), QStringLiteral("Abbrechen")) << "Qt's own dialogs";
  applyLanguage(QStringLiteral("xx"));
  EXPECT_EQ(currentLanguage(), QStringLiteral("en"));
  EXPECT_EQ(QCoreApplication::translate("spindrift::gui::MainWindow", "&Help"), QStringLiteral("&Help"));
  EXPECT_EQ(QCoreApplication::translate("spindrift::gui::ClosedLoopPage", "%n cycles", nullptr, 1),
            QStringLiteral("1 cycle"));
}

TEST_F(LanguageTest, SentencesOfCoreAreFoundAgainByTheirFormat) {
  const testing::TempFolder folder;
  folder.write("observations.csv",
               "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument\n"
               "0,M0,P1,1,2,3,0,EQ,1,0.5,probe\n");
  std::string english;
  try {
    (void)ObservationSet::read(folder / "observations.csv");
  } catch (const InputError& e) {
    english = e.what();
  }
  ASSERT_NE(english.find("component \"EQ\" is not known; allowed: EX"), std::string::npos) << english;
  EXPECT_EQ(coreSentence(english), QString::fromStdString(english)) << "English as it is";
  applyLanguage(QStringLiteral("de"));
  const QString german = coreSentence(english);
  EXPECT_TRUE(german.contains(QStringLiteral("Komponente „EQ“ ist nicht bekannt; zulässig: EX, EY")))
      << german.toStdString();
  EXPECT_TRUE(german.contains(QStringLiteral("Zeile 2"))) << german.toStdString();
  EXPECT_TRUE(german.startsWith(QString::fromStdString(folder.path().string()))) << german.toStdString();
}

TEST_F(LanguageTest, ValuesOfASentenceAreTranslatedAndNumbersWrittenAsTheLanguageDoes) {
  applyLanguage(QStringLiteral("de"));
  EXPECT_EQ(coreSentence("Sharpness 0.512, 14 ellipses and 3 circles decoded."),
            QStringLiteral("Schärfe 0,512, 14 Ellipsen und 3 Kreise decodiert."));
  EXPECT_EQ(
      coreSentence("The goal of 2.5 µm is met: largest deviation EX is 1.2 ± 0.3 µm at F1, M2."),
      QStringLiteral("Das Ziel von 2,5 µm ist erreicht: die größte Abweichung EX beträgt 1,2 ± 0,3 µm bei F1, M2."));
  EXPECT_EQ(coreSentence("All captures are checked."), QStringLiteral("Alle Aufnahmen sind geprüft."));
  EXPECT_EQ(coreSentence("3 of 12 captures are checked."), QStringLiteral("3 von 12 Aufnahmen sind geprüft."));
  EXPECT_EQ(
      coreSentence(
          "Not settled: drift of more than 0.5 µm/h: EX 0.9 ± 0.1 µm/h and EY 3 ± 1 µm/h. Not decidable yet: EZ 0.3 "
          "± 0.8 µm/h."),
      QStringLiteral(
          "Nicht thermisch stabil: Drift von mehr als 0,5 µm/h: EX 0,9 ± 0,1 µm/h und EY 3 ± 1 µm/h. Noch nicht "
          "entscheidbar: EZ 0,3 ± 0,8 µm/h."));
  EXPECT_EQ(coreSentence("Point \"Q\" was not measured in state M1; allowed: M0."),
            QStringLiteral("Punkt „Q“ wurde in Zustand M1 nicht gemessen; zulässig: M0."))
      << "a sentence that begins with a capital where its format does not";
  EXPECT_EQ(coreSentence("Nobody ever wrote such a thing 1.5 times."),
            QStringLiteral("Nobody ever wrote such a thing 1,5 times."));
}

/// What machine and sensors did, in the sentence of the warm-up: parts of parts are told apart, none keeps its English.
TEST_F(LanguageTest, ListsWithinSentencesAreTranslatedToTheirLastWord) {
  applyLanguage(QStringLiteral("de"));
  EXPECT_EQ(coreSentence("temperature of spindle by 22.2 K, temperature of housing by 13.9 K and temperature of column "
                         "front by 4.2 K")
                .toStdString(),
            "Temperatur Spindel um 22,2 K, Temperatur Gehäuse um 13,9 K und Temperatur Ständer vorn um 4,2 K");
  const QString german = coreSentence(
      "The thermal drift of the machine and a drift of the instrument cannot be separated here, because it was at work "
      "(spindle speed, feed X and feed Y) and temperatures changed (temperature of spindle by 22.2 K, temperature of "
      "housing by 13.9 K and temperature of column front by 4.2 K); measure one point of the machine at rest again and "
      "again, or state that the "
      "instrument was warm.");
  for (const char* english : {" by ", "changed", " and ", "feed", "work"})
    EXPECT_FALSE(german.contains(QLatin1String(english))) << english << " in: " << german.toStdString();
  // The page says it behind what was found of the drift.
  EXPECT_EQ(
      coreSentence(
          "Not known yet: drift of more than 1 µm/h is possible: EY -0.5 ± 0.5 µm/h; measure longer. The "
          "thermal drift of the machine and a drift of the instrument cannot be separated here, because it "
          "was at work (spindle speed) and temperatures changed (temperature of spindle by 8.8 K, temperature "
          "of housing by 6.0 K and temperature of column front by 2.4 K); measure one point of the machine at rest "
          "again and again, or state that the instrument was warm.")
          .toStdString(),
      "Noch nicht bekannt: Drift von mehr als 1 µm/h ist möglich: EY −0,5 ± 0,5 µm/h; länger messen. Die "
      "thermische Drift der Maschine und eine Drift des Messgeräts sind hier nicht trennbar, weil sie in Betrieb war "
      "(Spindeldrehzahl) und sich Temperaturen änderten (Temperatur Spindel um 8,8 K, Temperatur Gehäuse um 6,0 K und "
      "Temperatur Ständer vorn um 2,4 K); einen Punkt der ruhenden Maschine immer wieder messen oder erklären, dass "
      "das Messgerät "
      "warm war.");
}

/// Every format of core, filled with values, comes out in German: no format hides behind another one.
TEST_F(LanguageTest, EveryFormatOfCoreIsFoundWithItsValues) {
  applyLanguage(QStringLiteral("de"));
  static const QRegularExpression hole(QStringLiteral("\\{[^{} ]*(?:\\{\\}[^{} ]*)*\\}"));
  int changed = 0;
  int asked = 0;
  for (const char* format : coreFormats()) {
    QString english = QString::fromUtf8(format);
    if (english == QCoreApplication::translate("core", format) || english.contains(QStringLiteral("{{"))) continue;
    int value = 10;
    for (auto match = hole.match(english); match.hasMatch(); match = hole.match(english))
      english.replace(match.capturedStart(), match.capturedLength(), QString::number(++value));
    ++asked;
    if (coreSentence(english) != english)
      ++changed;
    else
      ADD_FAILURE() << english.toStdString();
  }
  EXPECT_EQ(changed, asked);
  EXPECT_GT(asked, 1500);
}

TEST_F(LanguageTest, NumbersOnScreenHaveTheCommaAndThoseTypedMayHaveEither) {
  EXPECT_EQ(decimalText(12.34, 'f', 1), QStringLiteral("12.3"));
  applyLanguage(QStringLiteral("de"));
  EXPECT_EQ(decimalText(12.34, 'f', 1), QStringLiteral("12,3"));
  EXPECT_EQ(decimalText(123456.0, 'f', 0), QStringLiteral("123456")) << "no separators of thousands";
  EXPECT_EQ(numberCell(-1.25, 2).text, QStringLiteral("−1,25"));
  EXPECT_EQ(quantityText(12.4, 0.3, QStringLiteral("µm")), QStringLiteral("12,4 ± 0,3 µm"));
  EXPECT_EQ(shownNumbers(QStringLiteral("12.4 ± 0.3 µm")), QStringLiteral("12,4 ± 0,3 µm"));
  EXPECT_EQ(decimalText(-12.34, 'f', 1), QStringLiteral("−12,3"));
  EXPECT_EQ(decimalText(-0.04, 'f', 1), QStringLiteral("0,0")) << "a rounded zero has no sign";
  EXPECT_EQ(shownNumbers(QStringLiteral("-12.4 ± 0.3 µm, -7 and (-1.5; 2)")),
            QStringLiteral("−12,4 ± 0,3 µm, −7 and (−1,5; 2)"));
  for (const char* as_it_is : {"2026-11-25", "M1-3 of run-2", "\"-1.x\"", "5-7 h", "ISO 230-3", "--at -x"})
    EXPECT_EQ(shownNumbers(QString::fromUtf8(as_it_is)), QString::fromUtf8(as_it_is));
  EXPECT_EQ(typedNumber(decimalText(-12.5, 'f', 1)), -12.5);
  EXPECT_EQ(shownNumbers(QStringLiteral("version 0.1.0 of run1.5/a2.5.csv")),
            QStringLiteral("version 0.1.0 of run1.5/a2.5.csv"));
  EXPECT_EQ(typedNumber(QStringLiteral(" 12,3 ")), 12.3);
  EXPECT_EQ(typedNumber(QStringLiteral("12.3")), 12.3);
  EXPECT_EQ(typedNumber(QStringLiteral("−1e-3")), -1e-3);
  EXPECT_EQ(typedNumber(QStringLiteral("1,2,3")), std::nullopt);
  EXPECT_EQ(typedNumber(QStringLiteral("x")), std::nullopt);
  EXPECT_EQ(numberOrText(QStringLiteral("12,3")), nlohmann::json(12.3)) << "a table that is edited";
  QDoubleSpinBox box;
  box.setDecimals(2);
  box.setRange(0.0, 100.0);
  EXPECT_EQ(box.textFromValue(12.5), QStringLiteral("12,50"));
  for (const char* keys : {"12.5", "12,5"}) {
    box.clear();
    QTest::keyClicks(box.findChild<QLineEdit*>(), QString::fromLatin1(keys));
    box.interpretText();
    EXPECT_EQ(box.value(), 12.5) << keys;
  }
}

TEST_F(LanguageTest, DistancesOfTheViewHaveTheComma) {
  MeasuredPlace a{QStringLiteral("F1"), {0, 0, 0}, {}};
  MeasuredPlace b{QStringLiteral("F2"), {250.5, 0, 0}, {}};
  EXPECT_EQ(distanceText(a, b), QStringLiteral("F1 to F2: 250.500 mm"));
  applyLanguage(QStringLiteral("de"));
  EXPECT_TRUE(distanceText(a, b).endsWith(QStringLiteral("250,500 mm"))) << distanceText(a, b).toStdString();
  a.deviation = PointDeviation{{0, 0, 0}, {0.3, 0.3, 0.3}};
  b.deviation = PointDeviation{{4.25, 0, 0}, {0.3, 0.3, 0.3}};
  const QString text = distanceText(a, b);
  EXPECT_TRUE(text.contains(QStringLiteral("250,5"))) << text.toStdString();
  EXPECT_TRUE(text.contains(QStringLiteral("4,2"))) << text.toStdString();
  EXPECT_FALSE(text.contains(QLatin1Char('.'))) << text.toStdString();
}

TEST_F(LanguageTest, DrawingsOfTheHelpAreInItToo) {
  const auto drawing = [](const char* language) {
    applyLanguage(QLatin1String(language));
    HelpText help(QStringLiteral("Help"));
    help.showHelp(QStringLiteral("model"));
    return help.document()
        ->resource(QTextDocument::ImageResource, QUrl(QStringLiteral("qrc:/help/model.svg")))
        .value<QImage>();
  };
  const QImage english = drawing("en");
  const QImage german = drawing("de");
  ASSERT_FALSE(english.isNull());
  ASSERT_FALSE(german.isNull());
  EXPECT_NE(english, german) << "its caption";
}

/// Menus, steps and buttons are called in the German manual as they are in the German window.
TEST(ManualLanguage, WhatIsPressedIsCalledAsInTheWindow) {
  const auto plain = [](QString text) { return text.remove(QLatin1Char('&')).remove(QChar(0x2026)).simplified(); };
  std::map<QString, std::set<QString>> window;
  for (const Text& text : textsOf(QStringLiteral("spindrift_de.ts")))
    for (const QString& translation : text.translations) window[plain(text.source)].insert(plain(translation));
  const QString folder = QString::fromStdString((spindrift::testing::sourceFolder() / "resources/manual/").string());
  static const QRegularExpression slanted(QStringLiteral("(?<!\\*)\\*([^*\\s][^*]*)\\*(?!\\*)"));
  const auto pressed = [&](const QString& name) {
    QFile file(folder + name);
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << name.toStdString();
    QStringList all;
    QString text = QString::fromUtf8(file.readAll());
    text.remove(QRegularExpression(QStringLiteral("```.*?```"), QRegularExpression::DotMatchesEverythingOption));
    for (auto found = slanted.globalMatch(text); found.hasNext();)
      for (const QString& part : found.next().captured(1).split(QLatin1String(" > "))) all << plain(part);
    return all;
  };
  int found = 0;
  for (const QString& chapter : QDir(folder).entryList({QStringLiteral("*.md")})) {
    const QStringList english = pressed(chapter);
    const QStringList german = pressed(QStringLiteral("de/") + chapter);
    ASSERT_EQ(english.size(), german.size()) << chapter.toStdString();
    for (int i = 0; i < english.size(); ++i) {
      const auto text = window.find(english[i]);
      if (text == window.end()) continue;
      ++found;
      EXPECT_TRUE(text->second.contains(german[i])) << chapter.toStdString() << ": " << german[i].toStdString();
    }
  }
  EXPECT_GE(found, 25);
}

/// A block that is not found is shown in English: none of them is.
TEST_F(LanguageTest, EveryPageOfTheHelpIsReadAndInGerman) {
  const QDir folder(QString::fromStdString((spindrift::testing::sourceFolder() / "resources/help").string()));
  const QStringList pages = folder.entryList({QStringLiteral("*.html")});
  ASSERT_GE(pages.size(), 10);
  for (const QString& page : pages) {
    const auto lines = [&](const char* language) {
      applyLanguage(QLatin1String(language));
      HelpText help(QStringLiteral("Help"));
      help.showHelp(page.section(QLatin1Char('.'), 0, 0));
      return help.toPlainText().split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    };
    const QStringList english = lines("en");
    const QStringList german = lines("de");
    EXPECT_GT(english.size(), 3) << page.toStdString() << " is read";
    ASSERT_EQ(english.size(), german.size()) << page.toStdString();
    for (int i = 0; i < english.size(); ++i) {
      EXPECT_FALSE(english[i].contains(QLatin1String("</"))) << english[i].toStdString();
      // Formulas are the same.
      if (english[i].size() > 40 && english[i].contains(QRegularExpression(QStringLiteral("[a-z]{5}")))) {
        EXPECT_NE(english[i], german[i]) << page.toStdString();
      }
    }
  }
}

TEST_F(LanguageTest, TitlesHaveUnitsAsPeopleWriteThem) {
  EXPECT_EQ(printedTitle(QStringLiteral("EX / um")), QStringLiteral("EX / µm"));
  EXPECT_EQ(printedTitle(QStringLiteral("Sprung um 2 K / um/m")), QStringLiteral("Sprung um 2 K / µm/m"));
  EXPECT_EQ(printedTitle(QStringLiteral("EX_um")), QStringLiteral("EX_um")) << "the name of a column";
  EXPECT_EQ(RowsModel({QStringLiteral("1 / urad")}).headerData(0, Qt::Horizontal, Qt::DisplayRole).toString(),
            QStringLiteral("1 / µrad"));
}

class UnitsTest : public LanguageTest {
 protected:
  void TearDown() override {
    setShownUnits({});
    LanguageTest::TearDown();
  }
};

TEST_F(UnitsTest, AreConvertedWhereTheyAreReadAndNowhereElse) {
  EXPECT_EQ(onScreen(QStringLiteral("12.4 ± 0.3 µm")), QStringLiteral("12.4 ± 0.3 µm"));
  setShownUnits({true, true, true});
  EXPECT_EQ(onScreen(QStringLiteral("12.4 ± 0.3 µm")), QStringLiteral("488 ± 12 µin"));
  EXPECT_EQ(onScreen(QStringLiteral("−12.70 µm")), QStringLiteral("−500.0 µin"));
  EXPECT_EQ(onScreen(QStringLiteral("2.54 mm and 21.0 °C")), QStringLiteral("0.1000 in and 69.8 °F"));
  EXPECT_EQ(onScreen(QStringLiteral("20.0 ± 0.5 °C")), QStringLiteral("68.0 ± 0.9 °F"))
      << "an uncertainty is a difference";
  EXPECT_EQ(onScreen(QStringLiteral("the room within 2.0 K")), QStringLiteral("the room within 3.6 °F"));
  EXPECT_EQ(onScreen(QStringLiteral("138 of 274: y 25.4 mm")), QStringLiteral("138 of 274: y 1.000 in"));
  EXPECT_EQ(onScreen(QStringLiteral("rms 3.41 → 0.58 µm")), QStringLiteral("rms 134.3 → 22.8 µin"));
  EXPECT_EQ(decimalText(9843.2, 'g', 3), QStringLiteral("9843")) << "no powers of ten where people write none";
  EXPECT_EQ(decimalText(1.5e9, 'g', 3), QStringLiteral("1.5e+09"));
  EXPECT_EQ(decimalText(98.43, 'g', 3), QStringLiteral("98.4"));
  EXPECT_EQ(onScreen(QStringLiteral("48.5 µrad")), QStringLiteral("10.00 arcsec"));
  EXPECT_EQ(onScreen(QStringLiteral("0.0 to 25.4 mm")), QStringLiteral("0.000 to 1.000 in"));
  EXPECT_EQ(onScreen(QStringLiteral("x 25.4, y 50.8, z 0.0 mm")), QStringLiteral("x 1.000, y 2.000, z 0.000 in"));
  EXPECT_EQ(onScreen(QStringLiteral("(254, 508, 0) mm")), QStringLiteral("(10.00, 20.00, 0.00) in"));
  EXPECT_EQ(onScreen(QStringLiteral("in cycle 3, 12.4 µm")), QStringLiteral("in cycle 3, 12.4 µm"))
      << "3 may be of the unit: rather the unit of the file than a wrong number";
  EXPECT_EQ(onScreen(QStringLiteral("11.5 µm/m, 1.8 µm/K")), QStringLiteral("11.5 µin/in, 39 µin/°F"));
  for (const char* other : {"488 µin", "EX_um", "M3 and K7", "0.6 rad/mm", "1/mm", "1.4571 steel"})
    EXPECT_EQ(onScreen(QString::fromUtf8(other)), QString::fromUtf8(other));
  applyLanguage(QStringLiteral("de"));
  EXPECT_EQ(onScreen(QStringLiteral("12,4 ± 0,3 µm")), QStringLiteral("488 ± 12 µin"));
  EXPECT_EQ(onScreen(QStringLiteral("2,54 mm")), QStringLiteral("0,1000 in"));
}

TEST_F(UnitsTest, ATableShowsThoseThatAreWantedAndIsExportedInThoseOfFiles) {
  RowsModel model({QStringLiteral("Point"), QStringLiteral("EX / µm"), QStringLiteral("Bar\n/ °C"),
                   QStringLiteral("Growth / (µm/m)")});
  Row row{QStringLiteral("P1"),
          {nameCell(QStringLiteral("P1")), quantityCell(12.4, 0.3), numberCell(20.0, 1), numberCell(11.5, 1)}};
  row.cells.push_back(Cell{});
  model.setRows(
      {row, Row{QStringLiteral("P2"),
                {nameCell(QStringLiteral("P2")), Cell{QStringLiteral("5 in cycle 2")}, dashCell(), dashCell()}}});
  const QString file = tableCsv(model);
  setShownUnits({true, false, true});
  const auto title = [&](int column) { return model.headerData(column, Qt::Horizontal, Qt::DisplayRole).toString(); };
  EXPECT_EQ(title(1), QStringLiteral("EX / µin"));
  EXPECT_EQ(title(2), QStringLiteral("Bar\n/ °F"));
  EXPECT_EQ(title(3), QStringLiteral("Growth / (µin/in)"));
  EXPECT_EQ(model.index(0, 1).data().toString(), QStringLiteral("488 ± 12"));
  EXPECT_EQ(model.index(0, 2).data().toString(), QStringLiteral("68.0"));
  EXPECT_EQ(model.index(0, 3).data().toString(), QStringLiteral("11.5"));
  EXPECT_EQ(model.index(1, 1).data().toString(), QStringLiteral("5 in cycle 2 µm"));
  EXPECT_EQ(model.index(1, 2).data().toString(), QStringLiteral("–"));
  EXPECT_EQ(tableCsv(model), file);
}

TEST_F(UnitsTest, AColourBarHasRoundNumbersOfTheUnitOnScreen) {
  const ColourScale scale = ColourScale::symmetric(12.0, QStringLiteral("EX"), QStringLiteral("um"));
  setShownUnits({true, false, false});
  const std::vector<double> ticks = scale.ticks();
  ASSERT_GT(ticks.size(), 3U);
  for (const double v : ticks) {
    const double shown = v / 0.0254;
    EXPECT_NEAR(shown, 100.0 * std::round(shown / 100.0), 1e-6);
  }
  EXPECT_EQ(scale.text(ticks.back(), ticks[1] - ticks[0]), QStringLiteral("400"));
}

TEST_F(LanguageTest, ATableInGermanIsExportedWithPoints) {
  applyLanguage(QStringLiteral("de"));
  RowsModel model({QStringLiteral("Punkt"), QStringLiteral("EX / µm"), QStringLiteral("EY / µm")});
  model.setRows({Row{QStringLiteral("P1"),
                     {nameCell(QStringLiteral("P1, P2")), numberCell(-12.34, 2), quantityCell(12.4, 0.3)}}});
  EXPECT_EQ(model.index(0, 1).data().toString(), QStringLiteral("−12,34"));
  EXPECT_EQ(tableCsv(model), QStringLiteral("Punkt,EX / µm,EY / µm\n\"P1, P2\",-12.34,12.4 ± 0.3\n"));
}

}  // namespace
}  // namespace spindrift::gui
