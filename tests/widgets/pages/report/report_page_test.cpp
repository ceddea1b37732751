// SPDX-License-Identifier: GPL-3.0-or-later
// The report page in the real window: write, look at the pages, save as PDF and HTML, turn outdated.
#include "widgets/pages/report/report_page.h"
#include "widgets/report/report_pages.h"

#include <poppler-qt6.h>

#include <QComboBox>
#include <QImage>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <filesystem>
#include <memory>

#include "core/base/atomic_file.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report.h"
#include "tests/support/temp_folder.h"
#include "tests/widgets/support/story_support.h"
#include "widgets/commands/commands.h"
#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/common/report_files.h"
#include "widgets/pages/discrepancy/discrepancy_page.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

/// A report of every kind of block on the disk, opened.
class PdfTest : public ::testing::Test {
 protected:
  void write(const Report& report) {
    pdf_ = pdfOf(report);
    file_ = folder_.write("report.pdf", pdf_.bytes);
    document_ = Poppler::Document::load(QString::fromStdString(file_.string()));
    ASSERT_NE(document_, nullptr);
  }
  /// Text of all pages, blanks joined.
  QString text() {
    QString all;
    for (int page = 0; page < document_->numPages(); ++page)
      all += std::unique_ptr<Poppler::Page>(document_->page(page))->text(QRectF()) + QLatin1Char('\n');
    return all.simplified();
  }
  /// Dark pixels in a part of a page, 96 dpi.
  int inkIn(int page, const QRect& area) {
    const QImage picture = std::unique_ptr<Poppler::Page>(document_->page(page))->renderToImage(96, 96);
    int dark = 0;
    for (int y = area.top(); y < std::min(area.bottom(), picture.height()); ++y) {
      for (int x = area.left(); x < std::min(area.right(), picture.width()); ++x)
        dark += qGray(picture.pixel(x, y)) < 160 ? 1 : 0;
    }
    return dark;
  }
  testing::TempFolder folder_;
  std::filesystem::path file_;
  ReportPdf pdf_;
  std::unique_ptr<Poppler::Document> document_;
};

Drawing curve() {
  return plotPicture({{"line", {0, 1, 2}, {0, 1, 0}, {}, SeriesStyle::Line}},
                     {.title = "t", .x_label = "time / h", .y_label = "EX / µm"});
}

TEST_F(PdfTest, EveryCharacterCanBeFoundAndCopied) {
  Report report("Thermal errors: Äpfel", "a machine");
  report.section("Effects").paragraph("2026-01-31T08:10:00Z  1.25 µm (3, 4); −7 ± 0.5 µrad at 21 °C, 3 × 10⁻⁵, Ω");
  report.subsection(ReportText("Thermal expansion ") + ReportText::smallPrint("ball_screw.expansion.x"));
  report.figure(curve(), "A drawing").callout(CalloutKind::Bad, "A < B & C, \"quoted\"");
  report.table({"Point", "EX / µm"}, {{"P1", "−12.3 ± 0.4"}}, "Numbers").facts({{"Name", "value"}});
  write(report);
  const QString all = text();
  for (const char* words : {"Thermal errors: Äpfel", "2026-01-31T08:10:00Z", "1.25 µm (3, 4); −7 ± 0.5 µrad at 21 °C",
                            "Ω", "Thermal expansion ball_screw.expansion.x", "EX / µm", "Figure 1: A drawing",
                            "A < B & C, \"quoted\"", "−12.3 ± 0.4", "Name", "value", "Signatures", "Page 1 of 1"})
    EXPECT_TRUE(all.contains(QString::fromUtf8(words))) << words << " in " << all.toStdString();
}

TEST_F(PdfTest, KeepsEveryPartOfALongReportWithinTheMargins) {
  Report report("Thermal errors: long", "a machine");
  for (int i = 0; i < 12; ++i) {
    report.section("Section " + std::to_string(i)).callout(CalloutKind::Good, "fine");
    report.paragraph("Some words about it.").table({"A", "B"}, {{"1", "2"}, {"3", "4"}, {"5", "6"}}, "Numbers");
    report.figure(curve(), "A figure").facts({{"Name", "value"}});
  }
  std::vector<ReportRow> rows;
  for (int i = 0; i < 120; ++i) rows.push_back({"row" + std::to_string(i), "1.0"});
  report.table({"Repeated", "Header"}, rows, "Long");
  write(report);
  ASSERT_EQ(document_->numPages(), pdf_.pages);
  EXPECT_EQ(document_->info(QStringLiteral("Title")), QStringLiteral("Thermal errors: long"));
  const QString all = text();
  EXPECT_EQ(all.count(QStringLiteral("Some words about it.")), 12);
  EXPECT_EQ(all.count(QStringLiteral("A figure")), 12);
  EXPECT_TRUE(all.contains(QStringLiteral("row119")));
  EXPECT_GE(all.count(QStringLiteral("Repeated")), 3) << "on every page of the long table";
  for (int page = 0; page < document_->numPages(); ++page) {
    EXPECT_GT(inkIn(page, QRect(68, 76, 658, 900)), 200) << "page " << page;
    EXPECT_GT(inkIn(page, QRect(600, 1060, 140, 40)), 10) << "number of page " << page;
    EXPECT_EQ(inkIn(page, QRect(0, 0, 60, ReportPages::page_height)), 0) << "page " << page;
    EXPECT_EQ(inkIn(page, QRect(734, 0, 60, ReportPages::page_height)), 0) << "page " << page;
    EXPECT_EQ(inkIn(page, QRect(68, ReportPages::page_height - 84, 658, 20)), 0) << "below the text of " << page;
  }
  // A heading stands where the outline says, and never alone at the foot of a page.
  for (const ReportPdf::Section& section : pdf_.sections) {
    const std::unique_ptr<Poppler::Page> page(document_->page(section.page));
    double x = 0, top = 0, right = 0, bottom = 0;
    ASSERT_TRUE(page->search(QString::fromStdString(section.title), x, top, right, bottom, Poppler::Page::FromTop))
        << section.title;
    EXPECT_LT(bottom, 700.0) << section.title;
  }
}

TEST(ReportPagesTest, SayWhenAFileIsNoReport) {
  const testing::TempFolder folder;
  ReportPages pages(folder.write("report.pdf", "hello"));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !pages.failure().isEmpty(); }, 5000));
  EXPECT_EQ(pages.pageCount(), 0);
}

TEST(ReportColours, AxesAreThoseOfTheViewOnALightBackground) {
  const Theme light = Theme::light();
  EXPECT_EQ(light.axis_x.name().toStdString(), axisLook(0).colour);
  EXPECT_EQ(light.axis_y.name().toStdString(), axisLook(1).colour);
  EXPECT_EQ(light.axis_z.name().toStdString(), axisLook(2).colour);
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
  EXPECT_EQ(window_->session().latest("report")->payload.at("figures").get<int>(), 5)
      << "residuals over time are one figure";

  const QString pdf = QString::fromStdString((folder_ / "report.pdf").string());
  page_->saveTo(pdf);
  wait();
  EXPECT_EQ(page_->callout()->tone(), Tone::Good) << page_->callout()->sentence().toStdString();
  const std::string bytes = readFile(folder_ / "report.pdf");
  EXPECT_TRUE(bytes.starts_with("%PDF-"));
  EXPECT_EQ(bytes, readFile(page_->pdf())) << "what is shown is what is saved";
  page_->saveTo(QString::fromStdString((folder_ / "report.html").string()));
  wait();
  EXPECT_EQ(readFile(folder_ / "report.html"), html);
  page_->saveTo(QStringLiteral("/proc/nowhere/report.pdf"));
  wait();
  EXPECT_EQ(page_->callout()->tone(), Tone::Bad);
}

TEST_F(ReportPageTest, AnEnglishWindowOffersNoOtherLanguage) {
  writeReport();
  EXPECT_FALSE(page_->languageChoice()->isVisible());
  EXPECT_FALSE(window_->session().latest("report")->payload.contains("translations"));
}

class GermanReportPageTest : public ReportPageTest {
 protected:
  void SetUp() override {
    applyLanguage(QStringLiteral("de"));
    ReportPageTest::SetUp();
  }
  void TearDown() override {
    ReportPageTest::TearDown();
    applyLanguage(QStringLiteral("en"));
  }
  void choose(const char* language) {
    QComboBox* choice = page_->languageChoice();
    choice->setCurrentIndex(choice->findData(QLatin1String(language)));
    Q_EMIT choice->activated(choice->currentIndex());
    wait();
  }
  /// The file that the window prints.
  [[nodiscard]] std::string printed() {
    return storedReport(window_->session().folder(), window_->session().latest("report")->payload, "pdf").string();
  }
  [[nodiscard]] QString firstSection() const { return page_->document()->sections().front().title; }
};

TEST_F(GermanReportPageTest, ProposesANameInTheLanguageOfTheWindow) {
  const std::filesystem::path campaign = writeStoryCampaign(folder_, Hidden::SpindleGrowth);
  nlohmann::json file = nlohmann::json::parse(readFile(campaign / "campaign.json"));
  file["name"] = "vertical machining centre, simulation with a gap";
  writeFileAtomically(campaign / "campaign.json", file.dump());
  open(campaign, StepId::Report);
  EXPECT_EQ(page<ReportPage>()->proposedName(),
            QString::fromUtf8("vertikales-bearbeitungszentrum-simulation-mit-lücke-bericht"));
}

/// Both are written at once: which is shown, printed and saved is the reader's choice and outdates nothing.
TEST_F(GermanReportPageTest, ShowsTheReportInEitherLanguage) {
  writeReport();
  ASSERT_TRUE(page_->languageChoice()->isVisible());
  EXPECT_EQ(firstSection(), QStringLiteral("Zusammenfassung"));
  const std::string german = readFile(page_->file());
  EXPECT_NE(german.find("<html lang=\"de\">"), std::string::npos);
  EXPECT_NE(german.find("In der Simulation"), std::string::npos) << "what was found";
  EXPECT_NE(german.find("spindle.growth.z"), std::string::npos) << "ids stay";
  EXPECT_EQ(german.find("standard uncertainty"), std::string::npos);
  EXPECT_TRUE(printed().ends_with(".de.pdf")) << printed();
  choose("en");
  EXPECT_EQ(firstSection(), QStringLiteral("Summary"));
  EXPECT_NE(readFile(page_->file()).find("<html lang=\"en\">"), std::string::npos);
  EXPECT_EQ(state(), StepState::Current);
  EXPECT_FALSE(printed().ends_with(".de.pdf")) << printed();
  EXPECT_EQ(printed(), page_->pdf().string());
  const QString saved = QString::fromStdString((folder_ / "report.pdf").string());
  page_->saveTo(saved);
  wait();
  EXPECT_EQ(readFile(folder_ / "report.pdf"), readFile(page_->pdf())) << "what is shown is what is saved";
  // The choice is remembered for the next window.
  window_ = std::make_unique<MainWindow>();
  window_->show();
  open(folder_ / "campaign", StepId::Report);
  EXPECT_EQ(page<ReportPage>()->languageChoice()->currentData().toString(), QStringLiteral("en"));
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
