// SPDX-License-Identifier: GPL-3.0-or-later
// The report page in the real window: write, look at the pages, save as PDF and HTML, turn outdated.
#include "widgets/pages/report/report_page.h"
#include "widgets/pages/report/report_pages.h"

#include <QGlyphRun>
#include <QImage>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QRawFont>
#include <QTest>
#include <QTextCursor>
#include <QTextDocument>
#include <QTextLayout>
#include <filesystem>
#include <stop_token>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/reporting/html_document.h"
#include "core/reporting/report_wording.h"
#include "core/reporting/svg_plot.h"
#include "tests/support/temp_folder.h"
#include "tests/widgets/pages/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/pages/report/report_builder.h"
#include "widgets/pages/report/report_document.h"
#include "widgets/theme/fonts.h"

namespace spindrift::gui {
namespace {

/// Dark pixels in a part of a page.
int inkIn(const ReportDocument& document, int page, const QRect& area) {
  QImage picture(ReportDocument::page_width, ReportDocument::page_height, QImage::Format_RGB32);
  picture.fill(Qt::white);
  QPainter painter(&picture);
  document.drawPage(painter, page);
  painter.end();
  int dark = 0;
  for (int y = area.top(); y < area.bottom(); ++y) {
    for (int x = area.left(); x < area.right(); ++x) dark += qGray(picture.pixel(x, y)) < 160 ? 1 : 0;
  }
  return dark;
}

TEST(ReportDocumentTest, PrintedCharactersAreTheFontsOwnSoThatAPdfCanBeSearched) {
  const QString text = QStringLiteral("2026-01-31T08:10:00Z  1.25 um (3, 4); -7");
  QTextLayout layout(text, printFont(12));
  layout.beginLayout();
  layout.createLine();
  layout.endLayout();
  QList<quint32> drawn;
  QRawFont font;
  for (const QGlyphRun& run : layout.glyphRuns()) {
    drawn += run.glyphIndexes();
    font = run.rawFont();
  }
  EXPECT_EQ(drawn, font.glyphIndexesForString(text)) << "a replaced glyph has no character any more";
}

TEST(ReportDocumentTest, KeepsEveryPartOfALongReport) {
  HtmlDocument html("Thermal errors: long", "a machine");
  for (int i = 0; i < 12; ++i) {
    html.section("Section " + std::to_string(i));
    html.verdict(i % 2 == 0 ? "good" : "bad", "A < B & C, \"quoted\"");
    html.paragraph("Some words about it.");
    html.table({"A", "B"}, {{"1", "2"}, {"3", "4"}, {"5", "6"}}, "Numbers");
    html.figure(svgPlot({{"line", {0, 1, 2}, {0, 1, 0}, {}, spindrift::SeriesStyle::Line}},
                        {.title = "t", .x_label = "time / h", .y_label = "EX / um"}),
                "A figure");
    html.facts({{"Name", "value"}});
  }
  const ReportDocument document(QString::fromStdString(html.html()));
  EXPECT_EQ(document.title(), QStringLiteral("Thermal errors: long"));
  EXPECT_EQ(document.figureCount(), 12);
  EXPECT_EQ(document.tableCount(), 12);
  const auto sections = document.sections();
  ASSERT_EQ(sections.size(), 13U) << "and the signatures";
  EXPECT_GT(document.pageCount(), 4);
  for (std::size_t i = 1; i < sections.size(); ++i) {
    EXPECT_GE(sections[i].page, sections[i - 1].page);
    EXPECT_LT(sections[i].page, document.pageCount());
  }
  for (int page = 0; page < document.pageCount(); ++page) {
    EXPECT_GT(inkIn(document, page, QRect(68, 76, 658, 900)), 200) << "page " << page;
    EXPECT_GT(inkIn(document, page, QRect(600, 1060, 140, 40)), 10) << "number of page " << page;
    // Nothing in the margins.
    EXPECT_EQ(inkIn(document, page, QRect(0, 0, 60, ReportDocument::page_height)), 0) << "page " << page;
    EXPECT_EQ(inkIn(document, page, QRect(734, 0, 60, ReportDocument::page_height)), 0) << "page " << page;
  }
}

std::string longReport() {
  HtmlDocument html("Thermal errors: long", "a machine");
  for (int i = 0; i < 30; ++i) {
    html.section("Section " + std::to_string(i));
    html.figure(svgPlot({{"line", {0, 1, 2}, {0, 1, 0}, {}, spindrift::SeriesStyle::Line}}, {.title = "t"}),
                "A figure");
    html.table({"A", "B"}, {{"1", "2"}, {"3", "4"}}, "Numbers");
  }
  return html.html();
}

/// Asks to stop once that part of the work is done.
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

TEST(ReportDocumentTest, ACancelInMidRunLeavesTheEarlierFileAndNoOther) {
  const testing::TempFolder folder;
  const auto html = folder.write("report.html", longReport());
  const auto pdf = folder.write("report.pdf", "what was saved yesterday");
  const QString target = QString::fromStdString(pdf.string());
  for (const double part : {0.2, 0.6, 0.9}) {
    Impatient sink(part);
    EXPECT_THROW(saveReport(html, target, JobContext(sink.stop.get_token(), &sink)), Cancelled);
    EXPECT_GE(sink.seen, part) << "pages had been written";
    EXPECT_EQ(readFile(pdf), "what was saved yesterday");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2) << "no part is left";
  }
  std::filesystem::remove(pdf);
  Impatient sink(0.5);
  EXPECT_THROW(saveReport(html, target, JobContext(sink.stop.get_token(), &sink)), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(pdf));
  saveReport(html, target, {});
  EXPECT_TRUE(readFile(pdf).starts_with("%PDF-"));
}

TEST(ReportDocumentTest, SmallPrintUnitsAndDrawingsInDrawingsAreKept) {
  HtmlDocument html("Thermal errors: t", "s");
  html.section("Effects").subsection(effectHeading("ball_screw.expansion.x"));
  html.paragraph("30 um at 21 degC");
  html.figure(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\"><g><svg width=\"10\" "
      "height=\"10\"></svg></g><text x=\"5\" y=\"20\">EX / um</text></svg>",
      "A drawing that holds a drawing");
  html.paragraph("after the figure");
  QTextDocument text;
  ReportFigures figures;
  const QString whole = QString::fromStdString(html.html());
  const qsizetype from = whole.indexOf(QLatin1String("<main>")) + 6;
  const ReportOutline outline =
      buildReport(whole.mid(from, whole.lastIndexOf(QLatin1String("</main>")) - from), text, figures);
  EXPECT_EQ(outline.figures, 1);
  const QString plain = text.toPlainText();
  EXPECT_TRUE(plain.contains(QString::fromUtf8("30 µm at 21 °C")));
  EXPECT_TRUE(plain.contains(QStringLiteral("after the figure")));
  EXPECT_FALSE(plain.contains(QLatin1String("svg")));
  const QTextCursor id = text.find(QStringLiteral("ball_screw.expansion.x"));
  const QTextCursor title = text.find(QStringLiteral("Thermal expansion of the X ball screw"));
  ASSERT_FALSE(id.isNull() || title.isNull());
  EXPECT_LT(id.charFormat().font().pixelSize(), title.charFormat().font().pixelSize());
}

TEST(ReportColours, AxesAreThoseOfTheViewOnALightBackground) {
  const Theme light = Theme::light();
  EXPECT_EQ(light.axis_x.name().toStdString(), axisLook(0).colour);
  EXPECT_EQ(light.axis_y.name().toStdString(), axisLook(1).colour);
  EXPECT_EQ(light.axis_z.name().toStdString(), axisLook(2).colour);
}

TEST(ReportDocumentTest, RefusesWhatIsNoReport) {
  EXPECT_THROW(ReportDocument(QStringLiteral("hello")), InputError);
  EXPECT_THROW(ReportDocument(QStringLiteral("<main><p>not closed</main>")), InputError);
}

class ReportPageTest : public StoryTest {
 protected:
  void writeReport() {
    open(writeStoryCampaign(folder_, Hidden::SpindleGrowth), StepId::Report);
    page_ = page<ReportPage>();
    ASSERT_NE(page_, nullptr);
    page_->operatorName()->setText(QStringLiteral("A. Operator"));
    QTest::mouseClick(page_->primaryButton(), Qt::LeftButton);
    wait();
    ASSERT_NE(page_->document(), nullptr) << page_->callout()->sentence().toStdString();
  }
  [[nodiscard]] StepState state() const { return window_->workflow().status(StepId::Report).state; }
  ReportPage* page_ = nullptr;
};

TEST_F(ReportPageTest, WritesShowsAndSaves) {
  writeReport();
  EXPECT_EQ(state(), StepState::Current);
  const std::string html = readFile(page_->file());
  EXPECT_NE(html.find("small story"), std::string::npos);
  EXPECT_NE(html.find("A. Operator"), std::string::npos);
  EXPECT_NE(html.find("spindle.growth.z"), std::string::npos) << "the discrepancy is told";
  EXPECT_GE(page_->document()->pageCount(), 3);
  EXPECT_GE(page_->document()->figureCount(), 6);

  const QString pdf = QString::fromStdString((folder_ / "report.pdf").string());
  page_->saveTo(pdf);
  wait();
  EXPECT_EQ(page_->callout()->tone(), Tone::Good) << page_->callout()->sentence().toStdString();
  const std::string bytes = readFile(folder_ / "report.pdf");
  EXPECT_TRUE(bytes.starts_with("%PDF-"));
  // One page object a page.
  int pages = 0;
  for (std::size_t at = bytes.find("/Type /Page\n"); at != std::string::npos;
       at = bytes.find("/Type /Page\n", at + 1)) {
    ++pages;
  }
  EXPECT_EQ(pages, page_->document()->pageCount());
  page_->saveTo(QString::fromStdString((folder_ / "report.html").string()));
  wait();
  EXPECT_EQ(readFile(folder_ / "report.html"), html);
  page_->saveTo(QStringLiteral("/proc/nowhere/report.pdf"));
  wait();
  EXPECT_EQ(page_->callout()->tone(), Tone::Bad);
}

TEST_F(ReportPageTest, TurnsOutdatedWithExclusionsAndEffects) {
  writeReport();
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QStringLiteral("M3/P2/EX")}, QStringLiteral("chip on the ball")));
  EXPECT_EQ(state(), StepState::Outdated);
  QTest::qWait(20);
  EXPECT_EQ(page_->callout()->tone(), Tone::Outdated);
  page_->runAll();
  wait();
  EXPECT_EQ(state(), StepState::Current);
  EXPECT_NE(readFile(page_->file()).find("chip on the ball"), std::string::npos);

  window_->workflow().goTo(StepId::Discrepancy);
  auto* discrepancy = page<DiscrepancyPage>();
  discrepancy->runAll();
  wait();
  QTest::mouseClick(discrepancy->addButton(), Qt::LeftButton);
  wait();
  EXPECT_EQ(state(), StepState::Outdated) << "the report tells another model";
}

TEST_F(ReportPageTest, TurnsOutdatedInTheListOfStepsWhenAStepBeforeHasAnotherResult) {
  writeReport();
  window_->session().storeResult("verify", nlohmann::json::object(), {{"reached", true}});
  EXPECT_EQ(state(), StepState::Outdated);
  EXPECT_FALSE(window_->workflow().status(StepId::Report).sentence.isEmpty());
  window_->workflow().goTo(StepId::Discrepancy);
  window_->workflow().goTo(StepId::Report);
  EXPECT_EQ(page_->callout()->tone(), Tone::Outdated);
}

TEST_F(ReportPageTest, CancelKeepsTheReportOfBefore) {
  writeReport();
  const std::string before = readFile(page_->file());
  page_->operatorName()->setText(QStringLiteral("Somebody else"));
  page_->runAll();
  window_->jobs().cancel();
  wait();
  EXPECT_EQ(readFile(page_->file()), before);
}

TEST_F(ReportPageTest, CancelledPdfLeavesNoFile) {
  writeReport();
  const QString pdf = QString::fromStdString((folder_ / "report.pdf").string());
  page_->saveTo(pdf);
  window_->jobs().cancel();
  wait();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "report.pdf"));
  EXPECT_NE(page_->callout()->tone(), Tone::Good);
}

TEST_F(ReportPageTest, IsThereAgainWhenTheSessionIsOpened) {
  writeReport();
  const int pages = page_->document()->pageCount();
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  EXPECT_EQ(page_->document(), nullptr);
  window_->open(session);
  wait();
  window_->workflow().goTo(StepId::Report);
  wait();
  ASSERT_NE(page_->document(), nullptr);
  EXPECT_EQ(page_->document()->pageCount(), pages);
}

}  // namespace
}  // namespace spindrift::gui
