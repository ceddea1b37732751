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
#include <QTextLayout>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/reporting/html_document.h"
#include "core/reporting/svg_plot.h"
#include "tests/widgets/pages/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
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
