// SPDX-License-Identifier: GPL-3.0-or-later
// A report as blocks, and what its writers make of it.
#include "core/reporting/report.h"

#include <gmock/gmock.h>

#include <stop_token>

#include "core/base/error.h"
#include "core/reporting/plot_picture.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Drawing curve() {
  return plotPicture({{"line", {0, 1, 2}, {0, 1, 0}, {}, SeriesStyle::Line}},
                     {.title = "t", .x_label = "time / h", .y_label = "EX / µm"});
}

TEST(Report, HtmlIsOneFileThatFetchesNothing) {
  Report report("Report <1>", "mill & lathe");
  report.section("Results").paragraph("a < b").table({"name", "value"}, {{"EX", "1 ± 0.1 µm"}}, "Parameters");
  report.callout(CalloutKind::Good, "fine").facts({{"Machine", "mill"}}).figure(curve(), "A plot");
  report.figure(curve(), "Another");
  const std::string html = htmlOf(report);
  for (const char* text : {"<title>Report &lt;1&gt;</title>", "mill &amp; lathe", "a &lt; b", "Table 1: Parameters",
                           "Figure 2: Another", "<p class=\"verdict good\">fine</p>"})
    EXPECT_THAT(html, HasSubstr(text));
  EXPECT_THAT(html, Not(HasSubstr("http://www.w3.org/1999/xhtml")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_EQ(report.figureCount(), 2);
  EXPECT_EQ(report.tableCount(), 1) << "names and values are no table with a number";
}

TEST(Report, SmallPrintIsARunOfTheText) {
  Report report("t", "s");
  report.subsection(ReportText("Bending of the column ") + ReportText::smallPrint("column.bending.a & b"));
  EXPECT_THAT(htmlOf(report), HasSubstr("<h3>Bending of the column <small>column.bending.a &amp; b</small></h3>"));
}

TEST(Report, ColumnsOfWordsAreKnown) {
  Report report("t", "s");
  report.table({"Point", "EX / µm", "Verdict"}, {{"P1", "\u22123.2", "met"}, {"P2", "not determined", ""}, {"P3"}});
  const auto& table = std::get<TableBlock>(report.blocks().front());
  EXPECT_EQ(table.of_words, (std::vector<bool>{false, false, true}));
  EXPECT_EQ(table.rows[2].size(), 3U) << "every row has every cell";
  report.table({"Part", "Marks"}, {{"effect", "60 %; half of it for one that is nested with it"}, {"driver", "20 %"}});
  EXPECT_TRUE(std::get<TableBlock>(report.blocks().back()).of_words[1]) << "a sentence that begins with a number";
}

/// `sections` sections of every kind of block.
Report longReport(int sections) {
  Report report("Thermal errors: long", "a machine");
  for (int i = 0; i < sections; ++i) {
    report.section("Section " + std::to_string(i)).callout(CalloutKind::Bad, "A < B & C, \"quoted\"");
    report.paragraph("Some words about it.").table({"A", "B"}, {{"1", "2"}, {"3", "4"}}, "Numbers");
    report.figure(curve(), "A figure").facts({{"Name", "value"}});
  }
  return report;
}

TEST(ReportPdf, HasTheSectionsInOrderAndTheSignaturesAtTheEnd) {
  const ReportPdf pdf = pdfOf(longReport(12));
  EXPECT_THAT(pdf.bytes, ::testing::StartsWith("%PDF-"));
  EXPECT_GT(pdf.pages, 4);
  ASSERT_EQ(pdf.sections.size(), 13U);
  EXPECT_EQ(pdf.sections.front().title, "Section 0");
  EXPECT_EQ(pdf.sections.back().title, "Signatures");
  for (std::size_t i = 1; i < pdf.sections.size(); ++i) EXPECT_GE(pdf.sections[i].page, pdf.sections[i - 1].page);
  EXPECT_LT(pdf.sections.back().page, pdf.pages);
  EXPECT_THAT(pdf.bytes, HasSubstr("/Outlines"));
}

TEST(ReportPdf, SetsTextsAndTablesLongerThanAPage) {
  std::string text;
  for (int i = 0; i < 3000; ++i) text += "word" + std::to_string(i) + (i % 500 == 499 ? "\n" : " ");
  Report report("t", "s");
  report.paragraph(text);
  std::vector<ReportRow> rows;
  for (int i = 0; i < 200; ++i)
    rows.push_back({std::to_string(i), std::string(400, 'x'), "some words, " + text.substr(0, 90)});
  report.table({"Row", "One word that is too long", "Words"}, rows);
  report.callout(CalloutKind::Note, text.substr(0, 12000));
  const ReportPdf pdf = pdfOf(report);
  EXPECT_GT(pdf.pages, 12);
  EXPECT_LT(pdf.pages, 120);
}

/// Names and notes may hold anything: a report of it can be written, and says what stands there.
TEST(ReportPdf, HostileNamesAreSet) {
  const std::string name = "mill \xE9\xFF\x01 <b>&\u202Egood\u202C\u2066x";
  Report report(name, name);
  report.section(name).paragraph(name).callout(CalloutKind::Note, name).code(name + "\n" + name);
  report.table({name, name}, {{name, name}}, name).facts({{name, name}}).figure(curve(), name);
  Drawing drawing(200.0, 100.0);
  drawing.text(10.0, 10.0, name, {.size = 12.0});
  report.figure(std::move(drawing), "A name");
  const std::string html = htmlOf(report);
  for (const char* never : {"\xE9", "\xFF", "\x01", "<b>", "\u202E", "\u2066"})
    EXPECT_THAT(html, Not(HasSubstr(never)));
  EXPECT_THAT(html, HasSubstr("mill \uFFFD\uFFFD  &lt;b&gt;&amp;\uFFFDgood\uFFFD\uFFFDx"));
  EXPECT_GE(pdfOf(report).pages, 1);
}

TEST(ReportPdf, WhatIsHigherThanAPageGoesOnOnTheNext) {
  std::string text;
  for (int i = 0; i < 3000; ++i) text += "word" + std::to_string(i) + " ";
  const auto pagesOf = [](auto fill) {
    Report report("t", "s");
    report.withoutSignatures();
    fill(report);
    return pdfOf(report).pages;
  };
  const int of_text = pagesOf([&](Report& r) { r.paragraph(text); });
  EXPECT_GE(of_text, 4);
  EXPECT_GE(pagesOf([&](Report& r) { r.callout(CalloutKind::Bad, text); }), of_text);
  EXPECT_GE(pagesOf([&](Report& r) { r.table({"Name", "Words"}, {{"a", text}, {"b", "c"}}); }), of_text - 1);
  EXPECT_GE(pagesOf([&](Report& r) { r.facts({{"Name", text}}); }), of_text);
  EXPECT_GE(pagesOf([&](Report& r) { r.table({"Name", text}, {{"a", "b"}, {"c", "d"}}); }), of_text - 1);
}

TEST(ReportPdf, TablesMayHaveNoRowsOrVeryManyColumns) {
  Report report("t", "s");
  report.table({"Point", "EX / µm"}, {}, "Nothing");
  EXPECT_THAT(htmlOf(report), HasSubstr("<td>none</td>")) << "a table without rows is no table";
  report.facts({});
  ReportRow header, row;
  for (int i = 0; i < 80; ++i) {
    header.emplace_back("Column " + std::to_string(i));
    row.emplace_back("0.123456 ± 0.000001");
  }
  report.table(header, {row, row});
  EXPECT_LT(pdfOf(report).pages, 20);
}

struct Impatient final : ProgressSink {
  explicit Impatient(double part) : from(part) {}
  void report(double fraction, std::string_view) override {
    seen = std::max(seen, fraction);
    if (fraction >= from) stop.request_stop();
  }
  double from;
  double seen = 0.0;
  std::stop_source stop;
};

TEST(ReportPdf, CanBeCancelledBetweenPages) {
  const Report report = longReport(20);
  for (const double part : {0.0, 0.2, 0.9}) {
    Impatient sink(part);
    EXPECT_THROW((void)pdfOf(report, JobContext(sink.stop.get_token(), &sink)), Cancelled);
    EXPECT_GE(sink.seen, part);
    EXPECT_LT(sink.seen, part + 0.2) << "and at once";
  }
}

}  // namespace
}  // namespace spindrift
