// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of the laser profiler in the real window, on scans made by the virtual profiler.
#include <QApplication>
#include <QComboBox>
#include <QMouseEvent>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/scanning/cloud_file.h"
#include "core/scanning/scan_evaluation.h"
#include "core/simulation/virtual_profiler.h"
#include "tests/widgets/support/page_test.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/scanning/axis_errors_page.h"
#include "widgets/pages/scanning/profiler_calibration_page.h"
#include "widgets/pages/scanning/scan_capture_page.h"
#include "widgets/panels/scanning/cloud_painter.h"
#include "widgets/panels/scanning/scan_mask_bar.h"
#include "widgets/plots/plot.h"
#include "widgets/plots/plot_grid.h"
#include "widgets/plots/surface_plot.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr const char* bad_scan = "captures/clouds/A2_C2.pcd";

class ScanningPages : public PageTest {
 protected:
  /// Two artefacts in three cycles. `spoil` cuts a third off the last scan, with a correct header.
  void openScans(const std::string& model, bool spoil, const std::string& axis = "Y") {
    VirtualScanCampaign c;
    c.mounting.scan_model = model;
    c.mounting.alpha_rad = 0.003;
    c.mounting.beta_rad = -0.002;
    c.mounting.offset_mm = {1.2, -0.7, 3.1};
    c.optics.profile_points = 640;
    c.optics.profile_interval_mm = 0.05;
    c.optics.profile_spacing_mm = 0.3;
    c.pocket.circle_mm = {0.0, 0.0, 0.0, 9.0};
    c.pocket.scan_from_mm = -11.0;
    c.pocket.scan_to_mm = 11.0;
    for (const auto& [id, y] : {std::pair<const char*, double>{"A1", 350.0}, {"A2", 1250.0}}) {
      VirtualArtefact a;
      a.id = id;
      a.y_mm = y;
      a.surface.bumps = {{{3.0, 9.0}, 2.5, 0.5}, {{8.0, 30.0}, 3.0, -0.4}};
      c.artefacts.push_back(a);
    }
    c.cycles = {{"C0", 0.0, 40.0}, {"C1", 1800.0, 40.0}, {"C2", 7200.0, 40.0}};
    c.error = [](double time_s, double y_mm) {
      const double q = 1.0 - std::exp(-time_s / 3600.0);
      SmallError e;
      e.translation_mm = q * Eigen::Vector3d(-0.002, 0.005 + 2e-5 * y_mm, 0.012);
      e.rotation_rad = q * Eigen::Vector3d(25e-6, 0.0, -8e-6);
      return e;
    };
    JobContext job;
    const std::filesystem::path folder = folder_ / "campaign";
    writeVirtualScanCampaign(c, folder, 5, job);
    if (spoil) {
      PointCloud cloud = readCloud(folder / bad_scan);
      const std::size_t profiles = 2 * cloud.profileCount() / 3;
      cloud.points_mm.resize(cloud.profile_start[profiles]);
      cloud.profile_start.resize(profiles + 1);
      writeCloud(cloud, folder / bad_scan);
    }
    if (axis != "Y") {
      const std::filesystem::path file = folder / "machine.json";
      nlohmann::json machine = nlohmann::json::parse(std::ifstream(file));
      machine["profiler"]["axis"] = axis;
      writeFileAtomically(file, machine.dump(1));
    }
    open(folder);
  }
  std::vector<Cell> cells(const RowsModel& model, const QString& id) {
    const int row = model.rowOf(id);
    EXPECT_GE(row, 0) << id.toStdString();
    return row < 0 ? std::vector<Cell>(8) : model.rows()[static_cast<std::size_t>(row)].cells;
  }
};

TEST_F(ScanningPages, CaptureNamesTheIncompleteScanAndShowsClouds) {
  openScans("rigid", true);
  auto* page = go<ScanCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(page->scans()->rowCount(), 6);
  press();
  EXPECT_EQ(window_->workflow().status(StepId::Capture).state, StepState::Attention);
  const auto bad = cells(*page->scans(), QString::fromLatin1(bad_scan));
  EXPECT_EQ(bad[2].text, QStringLiteral("incomplete"));
  EXPECT_NEAR(bad[4].text.toDouble(), 66, 4);
  EXPECT_EQ(cells(*page->scans(), QStringLiteral("captures/clouds/A1_C1.pcd"))[2].text, QStringLiteral("good"));
  EXPECT_EQ(page->callout()->tone(), Tone::Attention);

  page->select(QStringLiteral("captures/clouds/A1_C2.pcd"));
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->picture().colouring, ScanColouring::Height);
  EXPECT_GT(page->picture().xyz_mm->size(), 50000U);
  page->setColouring(ScanColouring::Measured);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  const double before = page->picture().median_magnitude;
  page->setColouring(ScanColouring::Registered);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  // Registration takes the motion of the profiler out; noise of about a micrometre is left.
  EXPECT_GT(before, 5.0 * page->picture().median_magnitude);
  EXPECT_LT(page->picture().median_magnitude, 1.5);
  EXPECT_EQ(page->profile()->series().size(), 3U) << "cold, this scan, left out";
  page->showProfile(3);
  EXPECT_GT(page->profile()->series()[1].x.size(), 150U);
  exportAll();
}

TEST_F(ScanningPages, ExcludingAScanIsUndoneByUndo) {
  openScans("rigid", true);
  auto* page = go<ScanCapturePage>(StepId::Capture);
  press();
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QString::fromLatin1(bad_scan)}, QStringLiteral("cut")));
  ASSERT_TRUE(waitForJobs(*window_, 10));
  EXPECT_EQ(page->callout()->tone(), Tone::Outdated);
  press();
  EXPECT_EQ(page->callout()->tone(), Tone::Good);
  go<ProfilerCalibrationPage>(StepId::Calibrate);
  press();
  auto* calibrate = go<ProfilerCalibrationPage>(StepId::Calibrate);
  EXPECT_EQ(calibrate->registrations()->rowCount(), 2 * 5);
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 10));
  EXPECT_EQ(window_->workflow().status(StepId::Calibrate).state, StepState::Outdated);
  press();
  EXPECT_EQ(calibrate->registrations()->rowCount(), 2 * 6);
}

/// Both pages keep what they show beside the stored result in one place.
TEST_F(ScanningPages, WhatIsShownAsCurrentIsOfTheInputsAsTheyAre) {
  openScans("rigid", false);
  auto* calibrate = go<ProfilerCalibrationPage>(StepId::Calibrate);
  press();
  ASSERT_EQ(calibrate->registrations()->rowCount(), 2 * 6);
  window_->undoStack().push(
      new ExcludeCommand(window_->session(), {QString::fromLatin1(bad_scan)}, QStringLiteral("cut")));
  go<AxisErrorsPage>(StepId::Model);
  press();
  window_->undoStack().undo();
  calibrate = go<ProfilerCalibrationPage>(StepId::Calibrate);
  // The model was made from an evaluation of its own, without that scan; the one with all scans holds again.
  ASSERT_TRUE(waitForJobs(*window_, 60));
  ASSERT_TRUE(window_->session().state("evaluate").current);
  ASSERT_FALSE(window_->session().state("fit").current);
  EXPECT_NE(calibrate->callout()->tone(), Tone::Outdated);
  EXPECT_EQ(calibrate->registrations()->rowCount(), 2 * 6) << "current again, with all scans";
}

TEST_F(ScanningPages, APartIsPaintedAwayAndTakenBack) {
  openScans("rigid", false);
  const QString scan = QStringLiteral("captures/clouds/A1_C2.pcd");
  go<ProfilerCalibrationPage>(StepId::Calibrate);
  press();
  auto* page = go<ScanCapturePage>(StepId::Capture);
  press();
  page->select(scan);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  const auto before = page->picture().counts;
  EXPECT_EQ(before[3], 0U);
  EXPECT_EQ(page->picture().xyz_mm->size(), 3 * before[0]) << "after: what is used";
  const auto drag = [&](QPointF from, QPointF to) {
    QWidget* sheet = page->maskBar()->painter();
    const QSizeF size(sheet->size());
    const auto at = [&](QPointF p) { return QPoint(int(p.x() * size.width()), int(p.y() * size.height())); };
    QTest::mousePress(sheet, Qt::LeftButton, {}, at(from));
    for (int i = 1; i <= 8; ++i) {
      const QPointF p = from + (to - from) * i / 8.0;
      QMouseEvent move(QEvent::MouseMove, at(p), sheet->mapToGlobal(at(p)), Qt::NoButton, Qt::LeftButton, {});
      QApplication::sendEvent(sheet, &move);
    }
    QTest::mouseRelease(sheet, Qt::LeftButton, {}, at(to));
    ASSERT_TRUE(waitForJobs(*window_, 60));
  };
  QTest::mouseClick(page->maskBar()->tools()->button(static_cast<int>(PaintTool::Rectangle)), Qt::LeftButton);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  page->maskBar()->reason()->setEditText(QStringLiteral("a chip"));
  drag({0.4, 0.3}, {0.6, 0.45});
  const auto erased = page->picture().counts;
  EXPECT_GT(erased[3], before[0] / 30) << "points of the rectangle";
  EXPECT_LT(erased[0], before[0]);
  ASSERT_EQ(window_->session().excluded().size(), 1U);
  EXPECT_EQ(window_->session().excluded().begin()->second, QStringLiteral("a chip"));
  EXPECT_EQ(window_->workflow().status(StepId::Calibrate).state, StepState::Outdated);
  EXPECT_EQ(page->callout()->tone(), Tone::Outdated);

  QTest::mouseClick(page->maskBar()->tools()->button(static_cast<int>(PaintTool::Brush)), Qt::LeftButton);
  drag({0.45, 0.6}, {0.55, 0.62});
  EXPECT_GT(page->picture().counts[3], erased[3]);
  QTest::mouseClick(page->maskBar()->effect()->button(1), Qt::LeftButton);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->picture().colouring, ScanColouring::LeftOut) << "to be seen";
  QTest::mouseClick(page->maskBar()->tools()->button(static_cast<int>(PaintTool::Lasso)), Qt::LeftButton);
  drag({0.2, 0.2}, {0.8, 0.3});  // a lasso without area takes nothing back
  EXPECT_EQ(window_->undoStack().count(), 3);
  page->setPart(2);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_TRUE(page->viewBefore()->isVisible());
  EXPECT_EQ(page->viewBefore()->camera(), page->view()->camera());
  if (const QString folder = qEnvironmentVariable("SPINDRIFT_PICTURES"); !folder.isEmpty())
    window_->grab().save(folder + QStringLiteral("/masks.png"));

  // The evaluation leaves the part out, and undo brings everything back as it was.
  go<ProfilerCalibrationPage>(StepId::Calibrate);
  press();
  // It is done, and says what the calibration leaves open.
  EXPECT_EQ(window_->workflow().status(StepId::Calibrate).state, StepState::Attention);
  EXPECT_TRUE(window_->workflow().status(StepId::Calibrate).sentence.contains(QStringLiteral("leaves open")))
      << window_->workflow().status(StepId::Calibrate).sentence.toStdString();
  for (int i = 0; i < 3; ++i) window_->undoStack().undo();
  EXPECT_TRUE(window_->session().excluded().empty());
  page = go<ScanCapturePage>(StepId::Capture);
  EXPECT_EQ(page->picture().counts[3], 0U);
  EXPECT_EQ(page->picture().counts[0], before[0]);
  // One press takes everything back too.
  window_->undoStack().redo();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  QTest::mouseClick(page->maskBar()->clearButton(), Qt::LeftButton);
  EXPECT_TRUE(window_->session().excluded().empty());
}

TEST_F(ScanningPages, APartIsPaintedAwayByKeyboardAlone) {
  openScans("rigid", false);
  auto* page = go<ScanCapturePage>(StepId::Capture);
  page->select(QStringLiteral("captures/clouds/A1_C2.pcd"));
  ASSERT_TRUE(waitForJobs(*window_, 60));
  page->maskBar()->tools()->button(static_cast<int>(PaintTool::Rectangle))->click();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  CloudPainter* sheet = page->maskBar()->painter();
  sheet->setFocus(Qt::TabFocusReason);
  MaskStroke painted;
  QObject::connect(sheet, &CloudPainter::painted, sheet, [&painted](const MaskStroke& stroke) { painted = stroke; });
  const auto press_key = [&](Qt::Key key, int times, Qt::KeyboardModifiers with = Qt::NoModifier) {
    for (int i = 0; i < times; ++i) QTest::keyClick(sheet, key, with);
  };
  // Begun and given up: nothing is painted.
  press_key(Qt::Key_Space, 1);
  press_key(Qt::Key_Right, 3);
  press_key(Qt::Key_Escape, 1);
  EXPECT_EQ(window_->undoStack().count(), 0);
  // From the middle up to the left, then down to the right over the middle.
  press_key(Qt::Key_Up, 2);
  press_key(Qt::Key_Left, 4);
  press_key(Qt::Key_Space, 1);
  press_key(Qt::Key_Right, 1, Qt::ControlModifier);
  press_key(Qt::Key_Down, 4);
  press_key(Qt::Key_Down, 3, Qt::ShiftModifier);
  press_key(Qt::Key_Space, 1);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  ASSERT_EQ(window_->undoStack().count(), 1);
  ASSERT_EQ(window_->session().excluded().size(), 1U);
  EXPECT_EQ(painted.shape, StrokeShape::Rectangle);
  ASSERT_EQ(painted.points_mm.size(), 2U);
  // 40 pixels to the right, 35 down.
  const Eigen::Vector2d size = painted.points_mm[1] - painted.points_mm[0];
  EXPECT_GT(size.x(), 0.0);
  EXPECT_NEAR(-size.y() / size.x(), 35.0 / 40.0, 1e-6);
}

TEST_F(ScanningPages, CalibrationShowsWhatItCannotDetermine) {
  openScans("rigid", false);
  auto* page = go<ProfilerCalibrationPage>(StepId::Calibrate);
  ASSERT_NE(page, nullptr);
  press();
  ASSERT_EQ(page->calibration()->rowCount(), 6);
  // A circle looks the same after a turn about its axis.
  EXPECT_EQ(cells(*page->calibration(), QStringLiteral("gamma_rad"))[2].tone, Tone::Attention);
  EXPECT_EQ(cells(*page->calibration(), QStringLiteral("beta_rad"))[2].tone, Tone::Good);
  EXPECT_TRUE(cells(*page->calibration(), QStringLiteral("beta_rad"))[1].text.startsWith(QChar(0x2212)));
  ASSERT_FALSE(page->residuals()->empty());
  double squares = 0;
  const Series& rim = page->residuals()->series().front();
  for (const double v : rim.y) squares += v * v;
  EXPECT_LT(std::sqrt(squares / static_cast<double>(rim.y.size())), 40.0);
  // What the mounting leaves uncertain is part of every displacement.
  JobContext job;
  const ScanEvaluation evaluation = evaluateScanCampaign(Campaign::read(folder_ / "campaign"), "rigid", job);
  bool widened = false;
  for (const ScanResult& s : evaluation.scans) {
    if (s.reference) continue;
    const std::vector<Cell> shown = cells(*page->registrations(), QString::fromStdString(s.capture.cloud));
    for (int i = 0; i < 3; ++i) {
      const double sigma = s.standardUncertaintyAtArtefact(i);
      if (!std::isfinite(sigma)) continue;
      EXPECT_EQ(shown[static_cast<std::size_t>(i + 1)].text,
                quantityCell(1e3 * s.registration.translation_mm(i), 1e3 * sigma).text);
      widened = widened || sigma > 1.2 * s.registration.standardUncertainty(i);
    }
  }
  EXPECT_TRUE(widened);
  exportAll();
}

TEST_F(ScanningPages, ModelShowsTheSixErrorsUnderEitherScanModel) {
  openScans("push_broom", false);
  auto* page = go<AxisErrorsPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  EXPECT_FALSE(page->primaryButton()->isEnabled());
  go<ProfilerCalibrationPage>(StepId::Calibrate);
  press();
  go<AxisErrorsPage>(StepId::Model);
  press();
  EXPECT_EQ(page->scanModel()->current(), 1);
  page->setComponent(2);  // EZY
  EXPECT_EQ(page->values()->rowCount(), 4);
  // One panel an artefact, all on the same axes.
  const auto panels = page->series()->panels();
  ASSERT_EQ(panels.size(), 2U);
  const auto height = [](Plot* plot) { return plot->pixelOf(0, 0).y() - plot->pixelOf(0, 1).y(); };
  for (Plot* panel : panels) {
    EXPECT_EQ(panel->series().size(), 1U);
    EXPECT_NEAR(height(panel) / panel->height(), height(panels[0]) / panels[0]->height(), 0.05);
  }
  EXPECT_NE(page->series()->titleOf(0), page->series()->titleOf(1));
  ASSERT_FALSE(page->surface()->empty());
  EXPECT_EQ(page->surface()->data().x.size(), 2U);
  EXPECT_EQ(page->surface()->data().y.size(), 3U);
  // The first cycle is the reference.
  EXPECT_EQ(page->surface()->data().value.front(), 0.0);
  EXPECT_EQ(window_->session().result("fit")->payload.at("scan_model"), "push_broom");
  exportAll();

  QTest::mouseClick(page->scanModel()->button(0), Qt::LeftButton);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(window_->session().result("fit")->payload.at("scan_model"), "rigid");
  EXPECT_EQ(page->callout()->tone(), Tone::Attention) << "the machine says push broom";
  // At the artefact: with what the mounting leaves uncertain, as the observations have it.
  page->setComponent(0);
  JobContext job;
  const ScanEvaluation evaluation = evaluateScanCampaign(Campaign::read(folder_ / "campaign"), "rigid", job);
  bool widened = false;
  for (const ScanResult& s : evaluation.scans) {
    const double sigma = s.standardUncertaintyAtArtefact(0);
    if (s.reference || !std::isfinite(sigma)) continue;
    EXPECT_EQ(cells(*page->values(), QString::fromStdString(s.capture.cloud)).at(2).text,
              quantityCell(1e3 * s.registration.translation_mm(0), 1e3 * sigma).text);
    widened = widened || sigma > 1.2 * s.registration.standardUncertainty(0);
  }
  EXPECT_TRUE(widened);
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(window_->session().result("fit")->payload.at("scan_model"), "push_broom");
}

TEST_F(ScanningPages, TheErrorsAreNamedByTheAxisThatCarriesTheProfiler) {
  openScans("push_broom", false, "X");
  auto* page = go<AxisErrorsPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(page->component()->button(2)->text(), "EZX");
  EXPECT_EQ(page->component()->button(2)->accessibleName().section(QLatin1Char(' '), -1), "EZX");
  go<ProfilerCalibrationPage>(StepId::Calibrate);
  press();
  go<AxisErrorsPage>(StepId::Model);
  press();
  page->setComponent(2);
  JobContext job;
  EXPECT_EQ(evaluateScanCampaign(Campaign::read(folder_ / "campaign"), "push_broom", job).axis, "X")
      << "after which the file names them";
  EXPECT_TRUE(page->surface()->data().value_title.startsWith(QStringLiteral("EZX"))) << "and so does the surface";
  EXPECT_GE(page->observability()->rowOf(QStringLiteral("ECX")), 0);
}

}  // namespace
}  // namespace spindrift::gui
