// SPDX-License-Identifier: GPL-3.0-or-later
// A report in another language: every text of it goes through the catalogue, and nothing else does.
#include "core/reporting/report_language.h"

#include <gmock/gmock.h>

#include <cctype>
#include <map>
#include <set>

#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Marks what it was given, and keeps it.
struct Marks {
  std::set<std::string> seen;
  [[nodiscard]] ReportLanguage language() {
    return {"xx", [this](const std::string& english) {
              seen.insert(english);
              return "[" + english + "]";
            }};
  }
};

Report sample() {
  Drawing drawing(100.0, 50.0);
  drawing.text(10.0, 10.0, "time / h");
  drawing.line(0.0, 0.0, 10.0, 10.0, picture_ink, 1.0);
  Report report("Thermal errors", "report of today");
  report.section("Noise");
  report.paragraph("A sentence.");
  report.callout(CalloutKind::Good, "The goal is met.");
  report.table({"Component", "rms"}, {{"EX", "12.4 ± 0.3 µm"}}, "What was found");
  report.facts({{"Operator", "A. Turing"}});
  report.figure(drawing, "Over time");
  report.code("$ typed");
  return report;
}

TEST(ReportLanguage, EveryTextIsTranslatedAndCodeIsNot) {
  Marks marks;
  const Report other = inLanguage(sample(), marks.language());
  for (const char* text :
       {"Thermal errors", "report of today", "Noise", "A sentence.", "The goal is met.", "Component", "rms", "EX",
        "12.4 ± 0.3 µm", "Table 1: What was found", "Operator", "Figure 1: Over time", "time / h"})
    EXPECT_THAT(marks.seen, Contains(text));
  EXPECT_THAT(marks.seen, Not(Contains("$ typed")));
  EXPECT_EQ(other.language(), "xx");
  EXPECT_EQ(other.word("Date"), "[Date]") << "what writers add";
  EXPECT_EQ(sample().word("Date"), "Date");
  EXPECT_EQ(other.figureCount(), 1);
  EXPECT_EQ(other.tableCount(), 1);
  const std::string html = htmlOf(other);
  EXPECT_THAT(html, HasSubstr("<html lang=\"xx\">"));
  EXPECT_THAT(html, HasSubstr("[time / h]"));
  EXPECT_THAT(html, HasSubstr("<pre>$ typed</pre>"));
  EXPECT_THAT(htmlOf(sample()), HasSubstr("<html lang=\"en\">"));
}

TEST(ReportLanguage, NamesThatPeopleGaveStay) {
  const ReportLanguage shouting{"xx", [](std::string english) {
                                  for (char& c : english) c = static_cast<char>(std::toupper(c));
                                  return english;
                                }};
  Report report("Thermal errors: mill and table", "by Tim");
  report.paragraph("mill and table is warmer than mill");
  report.paragraph("Time, by Tim: noise and more");
  report.paragraph("today  Capture: noise");
  report.table({"Point", "Why"}, {{"Top", "noise"}, {"Topmost", "noise here"}});
  const Report other = inLanguage(report, shouting, {{"mill", "mill and table", "Tim", ""}, {"Top", "noise", ""}});
  const auto text = [&](std::size_t block) { return std::get<TextBlock>(other.blocks()[block]).text.plain(); };
  EXPECT_EQ(other.title(), "THERMAL ERRORS: mill and table");
  EXPECT_EQ(text(0), "mill and table IS WARMER THAN mill");
  EXPECT_EQ(text(1), "TIME, BY Tim: NOISE AND MORE") << "a name is a word of its own";
  EXPECT_EQ(text(2), "TODAY  CAPTURE: noise") << "what stands behind a colon";
  const auto& rows = std::get<TableBlock>(other.blocks()[3]).rows;
  EXPECT_EQ(rows[0][0].plain() + rows[0][1].plain(), "Topnoise");
  EXPECT_EQ(rows[1][0].plain() + rows[1][1].plain(), "TOPMOSTNOISE HERE");
}

TEST(ReportLanguage, NamesThatTheProgramHasInTheLanguageAreShownSo) {
  ReportLanguage language{"xx", [](const std::string& english) {
                            return english.starts_with("Thermal errors: ") ? "Fehler: " + english.substr(16) : english;
                          }};
  language.of_names = [](const std::string& name) { return name == "hole bar" ? "Lochleiste" : name; };
  Report report("Thermal errors: hole bar", "my mill");
  report.facts({{"Campaign", "hole bar"}});
  const Report other = inLanguage(report, language, {{"hole bar", "my mill"}, {}});
  EXPECT_EQ(other.title(), "Fehler: Lochleiste");
  EXPECT_THAT(htmlOf(other), HasSubstr("Lochleiste</td>"));
  EXPECT_THAT(htmlOf(other), Not(HasSubstr("hole bar")));
  EXPECT_THAT(htmlOf(other), HasSubstr("my mill"));
}

/// Columns are aligned by what stands in them, whatever a language makes of it.
TEST(ReportLanguage, ColumnsKeepTheirAlignment) {
  Report report("t", "s");
  report.table({"a", "b"}, {{"x", "12"}});
  const Report other = inLanguage(report, {"xx", [](const std::string&) { return std::string("zwölf"); }});
  EXPECT_EQ(std::get<TableBlock>(other.blocks()[0]).of_words, std::get<TableBlock>(report.blocks()[0]).of_words);
}

/// The catalogue knows the sentence with the id in it, as core makes it; title and id stand there afterwards.
TEST(ReportLanguage, ASentenceWithAnEffectIsTranslatedAsAWhole) {
  const std::map<std::string, std::string> catalogue = {
      {"Missing in the simulation: head.tilt.a and x.", "In der Simulation fehlt: head.tilt.a und x."},
      {"tilt of the head about X", "Neigung des Spindelkopfes um X"},
      {"Tilt of the head about X ", "Neigung des Spindelkopfes um X "}};
  const ReportLanguage language{"de", [&](const std::string& english) {
                                  const auto found = catalogue.find(english);
                                  return found == catalogue.end() ? "?" + english : found->second;
                                }};
  const ReportText sentence = inLanguage(withEffectTitles("Missing in the simulation: head.tilt.a and x."), language);
  EXPECT_EQ(sentence.plain(), "In der Simulation fehlt: Neigung des Spindelkopfes um X head.tilt.a und x.");
  ASSERT_EQ(sentence.runs.size(), 3U);
  EXPECT_TRUE(sentence.runs[1].small);
  const ReportText heading = inLanguage(effectHeading("head.tilt.a"), language);
  EXPECT_EQ(heading.plain(), "Neigung des Spindelkopfes um X head.tilt.a");
  EXPECT_TRUE(heading.runs[1].small);
}

}  // namespace
}  // namespace spindrift
