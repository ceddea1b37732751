// SPDX-License-Identifier: GPL-3.0-or-later
// The step Review in the real window: four thermal states of a plain table, then scans.
#include <fmt/format.h>

#include <QComboBox>
#include <QMouseEvent>
#include <QSlider>
#include <QTableView>
#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/simulation/virtual_profiler.h"
#include "tests/widgets/support/page_test.h"
#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/review/review_page.h"
#include "widgets/panels/review/review_pane.h"
#include "widgets/plots/plot.h"
#include "widgets/shell/help_panel.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/overlay.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

class Review : public PageTest {
 protected:
  /// Nine points on a table of 300 mm; state k has EX = 3 k (1 + x / 300) um, EY = -k um, EZ = 2 k um.
  std::filesystem::path writeStates(const std::string& name, double gain) {
    const std::filesystem::path folder = folder_ / name;
    std::filesystem::create_directories(folder);
    writeFileAtomically(
        folder / "campaign.json",
        fmt::format(R"({{"format":"spindrift-campaign","version":1,"name":"{}","start_utc":"2026-01-31T08:00:00Z"}})",
                    name));
    writeFileAtomically(folder / "machine.json",
                        R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-(C)-t]","axes":[
{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,300]},{"name":"Z","travel_mm":[0,200]}]})");
    std::string csv = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
    for (int state = 0; state < 4; ++state)
      for (int p = 0; p < 9; ++p) {
        const double x = 30.0 + 120.0 * (p % 3), y = 30.0 + 120.0 * (p / 3);
        for (const auto& [c, v] : {std::pair<const char*, double>{"EX", 3.0 * state * (1.0 + x / 300.0)},
                                   {"EY", -1.0 * state},
                                   {"EZ", 2.0 * state}})
          csv += fmt::format("{},M{},P{},{},{},0,0,{},{:.4f},0.2,microscope,fit\n", 3600 * state, state, p + 1, x, y, c,
                             gain * v);
      }
    writeFileAtomically(folder / "observations.csv", csv);
    return folder;
  }
};

TEST_F(Review, IsDoneWhenItHasBeenLookedAtAndOutdatedWhenSomethingChanged) {
  open(writeStates("looked", 1.0));
  const auto state = [&] { return window_->workflow().status(StepId::Review).state; };
  EXPECT_EQ(state(), StepState::NotStarted);
  window_->workflow().goTo(StepId::Review);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(state(), StepState::Current);
  window_->workflow().goTo(StepId::Machine);
  window_->session().setExcluded({{QStringLiteral("M1/P2/EX"), QStringLiteral("bumped")}});
  EXPECT_EQ(state(), StepState::Outdated);
  EXPECT_NE(window_->workflow().status(StepId::Review).sentence.indexOf(QStringLiteral("1 exclusion more")), -1)
      << window_->workflow().status(StepId::Review).sentence.toStdString();
  window_->workflow().goTo(StepId::Review);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(state(), StepState::Current);
}

TEST_F(Review, StatesStandSideBySideWithOneScaleAndOneCamera) {
  open(writeStates("states", 1.0));
  EXPECT_EQ(window_->workflow().status(StepId::Review).state, StepState::NotStarted);
  auto* page = go<ReviewPage>(StepId::Review);
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(window_->workflow().status(StepId::Review).state, StepState::Current);
  EXPECT_EQ(page->slider()->maximum(), 3);
  page->setPanes(4);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  View3D* measured = page->pane(1)->view();
  View3D* model = page->pane(2)->view();
  ASSERT_TRUE(page->pane(2)->picture().field.has_value()) << page->pane(2)->picture().message;
  EXPECT_EQ(measured->colourScale(), model->colourScale());
  EXPECT_EQ(measured->points().size(), 9U);
  // Pane 3: the residual of a model that holds; pane 4: this state minus M1, which is two thirds of M3.
  for (const ReviewPoint& p : page->pane(3)->picture().points)
    EXPECT_LT(std::abs(p.components.at(Component::EX).value), 0.05);
  EXPECT_EQ(page->pane(4)->picture().title, "M1, measured minus M3, measured");
  ASSERT_EQ(page->pane(4)->picture().points.size(), 9U) << page->pane(4)->picture().message;
  EXPECT_NEAR(page->pane(4)->picture().points[0].components.at(Component::EX).value, -2.0 * 3.0 * 1.1, 1e-3);
  EXPECT_NEAR(page->pane(4)->picture().points[0].components.at(Component::EX).sigma, 0.4, 1e-3);

  // Turning one turns all.
  QTest::keyClick(measured, Qt::Key_Right);
  QTest::keyClick(measured, Qt::Key_Up);
  for (int i = 2; i <= 4; ++i) EXPECT_EQ(page->pane(i)->view()->camera(), measured->camera());
  QTest::keyClick(measured, Qt::Key_2);

  // A row selects in all views, a point in a view selects the row.
  page->tableView()->selectRow(page->table()->rowOf(QStringLiteral("P5")));
  EXPECT_EQ(model->selected(), QStringLiteral("P5"));
  ASSERT_TRUE(waitForJobs(*window_, 30));
  const auto pixel = model->pixelOf({270.0, 30.0, 0.0});
  ASSERT_TRUE(pixel.has_value());
  QTest::mouseClick(model, Qt::LeftButton, {}, pixel->toPoint());
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(measured->selected(), QStringLiteral("P3"));
  EXPECT_EQ(page->table()->idAt(page->tableView()->currentIndex().row()), QStringLiteral("P3"));

  // The value under the cursor with its uncertainty, at the same place in every pane that has a field.
  const auto on_table = model->pixelOf({140.0, 140.0, 0.0});
  ASSERT_TRUE(on_table.has_value());
  const QPointF middle = *on_table;
  const auto valueAtMiddle = [&] {
    QMouseEvent move(QEvent::MouseMove, middle, model->mapToGlobal(middle), Qt::NoButton, Qt::NoButton, {});
    QApplication::sendEvent(model, &move);
    return page->pane(2)->value().startsWith(QStringLiteral("x ")) && page->pane(2)->value().contains(QChar(0x00B1));
  };
  EXPECT_TRUE(page->pane(2)->value().startsWith(QStringLiteral("Largest: "))) << page->pane(2)->value().toStdString();
  // A slow machine draws the picture that is pointed into a little later.
  EXPECT_TRUE(QTest::qWaitFor(valueAtMiddle, 5000)) << page->pane(2)->value().toStdString();

  // The section follows the plane EX = 9 (1 + x / 300).
  ASSERT_EQ(page->section()->series().empty(), false);
  const Series& line = page->section()->series()[1];
  EXPECT_EQ(line.style, SeriesStyle::Line);
  for (std::size_t i = 0; i < line.x.size(); ++i) EXPECT_NEAR(line.y[i], 9.0 * (1.0 + line.x[i] / 300.0), 0.05);
  page->setArrows(true);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(measured->arrows().size(), 9U);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  exportAll();
  page->setArrows(false);
  // Looks as it should: pictures for the eye.
  if (const QString folder = qEnvironmentVariable("SPINDRIFT_PICTURES"); !folder.isEmpty()) {
    ASSERT_TRUE(waitForJobs(*window_, 30));
    window_->grab().save(folder + QStringLiteral("/review.png"));
  }
}

// Points at two angles of the table are places of two tables: one angle is shown, and each has its own map.
TEST_F(Review, PanesShowOneAngleOfTheTable) {
  const std::filesystem::path folder = writeStates("turned", 1.0);
  std::string csv = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  for (int state = 0; state < 2; ++state)
    for (const int c : {0, 120})
      for (int p = 0; p < 9; ++p)
        csv += fmt::format("{},M{},P{}@{},{},{},0,{},EX,{},0.2,touch_probe,fit\n", 3600 * state, state, p + 1, c,
                           30 + 120 * (p % 3), 30 + 120 * (p / 3), c, state * (c == 0 ? 1.0 : -1.0) * (5.0 + p));
  writeFileAtomically(folder / "observations.csv", csv);
  open(folder);
  auto* page = go<ReviewPage>(StepId::Review);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  QComboBox* angle = page->angleChoice();
  ASSERT_TRUE(angle->isVisible());
  EXPECT_EQ(angle->currentText(), QStringLiteral("Table at 0°"));
  ASSERT_EQ(page->pane(1)->picture().points.size(), 9U);
  ASSERT_TRUE(page->pane(1)->picture().field.has_value());
  for (const double v : page->pane(1)->picture().field->value) EXPECT_TRUE(v >= 5.0 && v <= 13.0) << v;
  angle->setCurrentIndex(angle->findText(QStringLiteral("Table at 120°")));
  ASSERT_TRUE(waitForJobs(*window_, 30));
  ASSERT_EQ(page->pane(1)->picture().points.size(), 9U);
  for (const double v : page->pane(1)->picture().field->value) EXPECT_TRUE(v <= -5.0 && v >= -13.0) << v;
  EXPECT_EQ(page->table()->rowCount(), 9);
  angle->setCurrentIndex(angle->findText(QStringLiteral("All angles")));
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(page->pane(1)->picture().points.size(), 18U);
  EXPECT_FALSE(page->pane(1)->picture().field.has_value());
  // One angle needs no choice.
  window_->closeSession();
  open(writeStates("still", 1.0));
  page = go<ReviewPage>(StepId::Review);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_FALSE(page->angleChoice()->isVisible());
}

TEST_F(Review, PlaybackRunsThroughTheStates) {
  open(writeStates("states", 1.0));
  auto* page = go<ReviewPage>(StepId::Review);
  page->slider()->setValue(1);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(page->pane(1)->picture().title, "M1, measured");
  page->pane(2)->choose(PaneContent::Measured, QStringLiteral("M3"));
  QTest::mouseClick(page->primaryButton(), Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor([&] { return page->pane(1)->picture().title == "M2, measured"; }, 8000));
  EXPECT_EQ(page->pane(2)->picture().title, "M3, measured") << "a fixed state stays";
  QTest::mouseClick(page->primaryButton(), Qt::LeftButton);
}

TEST_F(Review, TwoCampaignsOfOneSessionAreCompared) {
  open(writeStates("first", 1.0));
  window_->addCampaign(QString::fromStdString(writeStates("second", 1.5).string()));
  ASSERT_TRUE(waitForJobs(*window_, 30));
  ASSERT_EQ(window_->session().campaigns().size(), 2U);
  auto* page = go<ReviewPage>(StepId::Review);
  page->pane(1)->choose(PaneContent::Measured);
  QComboBox* campaigns = page->pane(2)->campaignChoice();
  ASSERT_EQ(campaigns->count(), 2);
  campaigns->setCurrentIndex(campaigns->findText(QStringLiteral("first")));
  const std::vector<JobEntry> jobs = window_->jobs().entries();
  EXPECT_TRUE(std::any_of(jobs.begin(), jobs.end(), [](const JobEntry& job) {
    return job.title == QStringLiteral("Reading first");
  })) << "the window does not wait for it";
  page->pane(2)->choose(PaneContent::Difference);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  // M3 of the first minus M3 of the second: minus half of 9 (1 + x / 300).
  const ReviewPicture& d = page->pane(2)->picture();
  ASSERT_EQ(d.points.size(), 9U) << d.message;
  EXPECT_NEAR(d.points[0].components.at(Component::EX).value, -4.5 * 1.1, 1e-3);
  ASSERT_TRUE(d.field.has_value());
  // An interpolated map, so it is compared in the middle of the points.
  const std::size_t middle = d.field->grid.index(d.field->grid.nx / 2, d.field->grid.ny / 2);
  EXPECT_NEAR(d.field->value[middle], -4.5 * 1.5, 2.0 * d.field->sigma[middle]);
  page->setHeatMaps(false);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_FALSE(page->pane(2)->picture().field.has_value());
}

TEST_F(Review, TheSimulationStandsBesideTheMeasurement) {
  const std::filesystem::path folder = writeStates("simulated", 1.0);
  writeFileAtomically(
      folder / "campaign.json",
      R"({"format":"spindrift-campaign","version":1,"name":"simulated","start_utc":"2026-01-31T08:00:00Z","simulation":"simulation.csv"})");
  std::string table = "time_s,point,component,predicted\n";
  for (int state = 0; state < 4; ++state)
    for (int p = 0; p < 9; ++p)
      for (const auto& [c, v] : {std::pair<const char*, double>{"EX", 3.0 * state}, {"EY", 0.0}, {"EZ", 0.0}})
        table += fmt::format("{},P{},{},{}\n", 3600 * state, p + 1, c, v);
  writeFileAtomically(folder / "simulation.csv", table);
  open(folder);
  auto* page = go<ReviewPage>(StepId::Review);
  page->setPanes(4);
  EXPECT_EQ(page->pane(2)->content(), PaneContent::Simulation);
  page->pane(4)->choose(PaneContent::CompletedLeft);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_NEAR(page->pane(2)->picture().points[0].components.at(Component::EX).value, 9.0, 1e-9);
  EXPECT_EQ(page->pane(2)->picture().title, "M3, simulation");
  // What ± is has room in the smallest of four panes, where the view keeps one note alone.
  const QStringList notes = wrappedNotes(page->pane(2)->caption().split(QLatin1Char('\n')), 320.0, 120.0);
  EXPECT_TRUE(notes.join(QLatin1Char(' ')).contains(QString::fromUtf8("± is 1 % of the simulated change")))
      << notes.join(QLatin1Char('|')).toStdString();
  EXPECT_NEAR(page->pane(3)->picture().points[0].components.at(Component::EX).value, 0.9, 1e-3);
  EXPECT_FALSE(page->pane(4)->picture().message.empty()) << "nothing was searched yet, and the pane says so";
  page->pane(4)->choose(PaneContent::SimulationLeft, QStringLiteral("M1"));
  ASSERT_TRUE(waitForJobs(*window_, 30));
  if (const QString pictures = qEnvironmentVariable("SPINDRIFT_PICTURES"); !pictures.isEmpty())
    window_->grab().save(pictures + QStringLiteral("/review_simulation.png"));
}

TEST_F(Review, AnotherSessionBringsItsOwnMachine) {
  open(writeStates("small", 1.0));
  auto* page = go<ReviewPage>(StepId::Review);
  const Camera small = page->pane(1)->view()->camera();
  window_->closeSession();
  const std::filesystem::path folder = writeStates("large", 1.0);
  std::string machine = readFile(folder / "machine.json");
  for (std::size_t at = machine.find("[0,300]"); at != std::string::npos; at = machine.find("[0,300]"))
    machine.replace(at, 7, "[0,1500]");
  writeFileAtomically(folder / "machine.json", machine);
  open(folder);
  page = go<ReviewPage>(StepId::Review);
  (void)window_->grab();
  ASSERT_TRUE(page->pane(1)->picture().field.has_value());
  EXPECT_EQ(page->pane(1)->picture().field->grid.x_to_mm, 1500.0);
  EXPECT_GT(page->pane(1)->view()->camera().half_height_mm, 2.0 * small.half_height_mm)
      << "the first campaign of every session has the same number; the view must not keep the machine of the last one";
}

TEST_F(Review, PointsOnALineAlongYHaveASectionAlongIt) {
  VirtualScanCampaign c;
  c.optics.profile_points = 640;
  c.optics.profile_interval_mm = 0.05;
  c.optics.profile_spacing_mm = 0.3;
  c.artefacts = {{}, {}};
  c.artefacts[1].id = "A2";
  c.artefacts[1].y_mm += 400.0;
  c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1800.0, 40.0}};
  c.error = [](double time_s, double y_mm) {
    return SmallError{{0.0, 0.0, 1e-9 * time_s * y_mm}, Eigen::Vector3d::Zero()};
  };
  JobContext job;
  writeVirtualScanCampaign(c, folder_ / "scans", 5, job);
  open(folder_ / "scans");
  go<Page>(StepId::Calibrate)->runAll();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  auto* page = go<ReviewPage>(StepId::Review);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->section()->axisTitles().front(), QStringLiteral("Y / mm"));
  ASSERT_FALSE(page->section()->series().empty());
  const Series& points = page->section()->series().front();
  EXPECT_EQ(points.x.size(), 2U);
  EXPECT_NEAR(std::abs(points.x.back() - points.x.front()), 400.0, 1.0);
}

TEST_F(Review, ScansStandSideBySide) {
  VirtualScanCampaign c;
  c.optics.profile_points = 640;
  c.optics.profile_interval_mm = 0.05;
  c.optics.profile_spacing_mm = 0.3;
  c.artefacts.emplace_back();
  c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1800.0, 40.0}, {"C2", 7200.0, 40.0}};
  c.error = [](double time_s, double) { return SmallError{{0.0, 0.0, 1e-6 * time_s}, Eigen::Vector3d::Zero()}; };
  JobContext job;
  writeVirtualScanCampaign(c, folder_ / "scans", 5, job);
  open(folder_ / "scans");
  auto* page = go<ReviewPage>(StepId::Review);
  page->pane(1)->choose(PaneContent::ScanChange, {});
  page->pane(2)->choose(PaneContent::ScanLeftOver, {});
  ASSERT_TRUE(waitForJobs(*window_, 60));
  ASSERT_FALSE(page->pane(1)->scanView()->empty());
  ASSERT_FALSE(page->pane(2)->scanView()->empty());
  EXPECT_EQ(page->pane(1)->scanView()->colourScale(), page->pane(2)->scanView()->colourScale());
  QTest::keyClick(page->pane(1)->scanView(), Qt::Key_Right);
  EXPECT_EQ(page->pane(1)->scanView()->camera(), page->pane(2)->scanView()->camera());
  exportAll();
}

/// At 1280 x 800 beside the help the choices of one pane had room in one line and those of its neighbour had not.
TEST_F(Review, PanesSideBySideBeginAtOneHeight) {
  for (const char* language : {"en", "de"}) {
    applyLanguage(QLatin1String(language));
    window_ = std::make_unique<MainWindow>();
    window_->show();
    open(writeStates(std::string("aligned_") + language, 1.0));
    auto* page = go<ReviewPage>(StepId::Review);
    ASSERT_NE(page, nullptr);
    page->setPanes(4);
    for (const auto& [width, help] : {std::pair{1280, true}, std::pair{1280, false}, std::pair{1920, false}}) {
      window_->resize(width, width == 1280 ? 800 : 1080);
      if (window_->help()->isVisible() != help) window_->helpAction()->trigger();
      QTest::qWait(50);
      ASSERT_TRUE(waitForJobs(*window_, 30));
      for (int i = 1; i <= 4; ++i) {
        ReviewPane* pane = page->pane(i);
        EXPECT_EQ(pane->view()->mapTo(pane, QPoint()).y(), page->pane(1)->view()->mapTo(page->pane(1), QPoint()).y())
            << language << " pane " << i << " at " << width;
        const int between = pane->contentChoice()->y() - pane->stateChoice()->y();
        EXPECT_EQ(between, page->pane(1)->contentChoice()->y() - page->pane(1)->stateChoice()->y());
      }
      if (const QString folder = qEnvironmentVariable("SPINDRIFT_PICTURES"); !folder.isEmpty()) {
        for (const ThemeKind kind : {ThemeKind::Light, ThemeKind::Dark}) {
          window_->setTheme(kind);
          QTest::qWait(50);
          window_->grab().save(folder +
                               QStringLiteral("/review-%1-%2-%3-%4.png")
                                   .arg(QLatin1String(language))
                                   .arg(width)
                                   .arg(help ? QStringLiteral("help") : QStringLiteral("alone"))
                                   .arg(kind == ThemeKind::Dark ? QStringLiteral("dark") : QStringLiteral("light")));
        }
        window_->setTheme(ThemeKind::Light);
      }
    }
    window_->closeSession();
  }
  applyLanguage(QStringLiteral("en"));
}

}  // namespace
}  // namespace spindrift::gui
