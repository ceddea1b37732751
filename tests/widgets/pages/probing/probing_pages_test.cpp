// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of the touch probe in the real window, on cycles made by the virtual probe.
#include <QComboBox>
#include <QTableView>

#include "core/base/atomic_file.h"
#include "tests/core/probing/probing_machines.h"
#include "tests/widgets/support/page_test.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/probing/cycle_model_page.h"
#include "widgets/pages/probing/touch_capture_page.h"
#include "widgets/pages/probing/touch_evaluation_page.h"
#include "widgets/panels/probing/reference_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

using namespace probing_test;

class ProbingPages : public PageTest {
 protected:
  /// Four cycles; in M2 one touch is bad by 40 um, in M3 one is missing.
  void openCycles(bool holes, const std::string& bar = "\"hole_diameter_mm\":12") {
    std::string machine_text = holes ? holeMachineText() : ballMachineText();
    const std::string plain_bar = "\"hole_diameter_mm\":12";
    if (holes) machine_text.replace(machine_text.find(plain_bar), plain_bar.size(), bar);
    const MachineDescription machine = machineFrom(machine_text);
    VirtualRun run = runCycles(machine, 4, {}, 11);
    truth_ = run.truth;
    for (Touch& t : run.list.touches) {
      if (t.cycle == "M2" && t.feature == (holes ? "H3" : "B3") && t.touch == 1 && t.stylus == "p0" && t.c_deg == 0.0) {
        t.position_mm += 0.04 * t.approach;
        bad_ = QString::fromStdString(t.id());
      }
      if (t.cycle == "M2" && t.feature == (holes ? "H2" : "B2") && t.touch == 1 && t.stylus == "p0" && t.c_deg == 0.0)
        other_ = QString::fromStdString(t.id());
    }
    removeTouches(run.list, [&](const Touch& t) {
      return t.cycle == "M3" && t.feature == (holes ? "H5" : "B4") && t.touch == 2 && t.stylus == "p0" &&
             t.c_deg == 0.0;
    });
    std::filesystem::create_directories(folder_ / "campaign/captures");
    folder_.write("campaign/machine.json", machine_text);
    folder_.write("campaign/campaign.json",
                  R"({"format":"spindrift-campaign","version":1,"name":"cycles","start_utc":"2026-01-31T08:00:00Z"})");
    folder_.write("campaign/captures/touches.csv", run.list.csv());
    open(folder_ / "campaign");
  }
  QString cell(const RowsModel& model, const QString& id, std::size_t column) {
    const int row = model.rowOf(id);
    EXPECT_GE(row, 0) << id.toStdString();
    return row < 0 ? QString() : model.rows()[static_cast<std::size_t>(row)].cells[column].text;
  }

  std::vector<std::vector<double>> truth_;
  QString bad_;
  QString other_;  ///< a good one
};

TEST_F(ProbingPages, CaptureSaysWhatBecameOfEveryTouch) {
  openCycles(true);
  auto* page = go<TouchCapturePage>(StepId::Capture);
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(page->cycleRows()->rowCount(), 4);
  EXPECT_EQ(window_->workflow().status(StepId::Capture).state, StepState::NotStarted);
  EXPECT_TRUE(page->callout()->sentence().contains(QStringLiteral("none is checked")));
  press();
  EXPECT_EQ(window_->workflow().status(StepId::Capture).state, StepState::Attention);
  EXPECT_EQ(cell(*page->cycleRows(), QStringLiteral("M2"), 3), QStringLiteral("1"));
  EXPECT_EQ(cell(*page->cycleRows(), QStringLiteral("M3"), 4), QStringLiteral("1"));
  EXPECT_EQ(cell(*page->cycleRows(), QStringLiteral("M1"), 3), QStringLiteral("0"));
  // The sentence names both, and its button goes to the first.
  auto* show_it = page->callout()->findChild<QPushButton*>();
  ASSERT_NE(show_it, nullptr);
  EXPECT_TRUE(page->callout()->sentence().contains(QStringLiteral("(M2 ")) &&
              page->callout()->sentence().contains(QStringLiteral(" and M3 ")))
      << page->callout()->sentence().toStdString();
  page->selectCycle(QStringLiteral("M0"));
  QTest::mouseClick(show_it, Qt::LeftButton);
  EXPECT_EQ(page->pickedItem(), bad_);
  EXPECT_EQ(cell(*page->touchRows(), bad_, 1), QStringLiteral("rejected"));
  // The bad touch misses by 40 um.
  const double residual = cell(*page->touchRows(), bad_, 2).replace(QChar(0x2212), QLatin1Char('-')).toDouble();
  EXPECT_NEAR(std::abs(residual), 40.0, 3.0);
  page->selectCycle(QStringLiteral("M3"));
  EXPECT_EQ(page->touchRows()->rows().back().cells[1].text, QStringLiteral("missing"));
  EXPECT_FALSE(page->view()->shapes().empty());
  exportAll();
}

TEST_F(ProbingPages, ExcludingATouchMakesResultsOutdatedAndCanBeUndone) {
  openCycles(true);
  auto* page = go<TouchCapturePage>(StepId::Capture);
  press();
  window_->undoStack().push(new ExcludeCommand(window_->session(), {bad_}, QStringLiteral("bad")));
  EXPECT_TRUE(waitForJobs(*window_, 10));
  EXPECT_EQ(window_->workflow().status(StepId::Capture).state, StepState::Outdated);
  EXPECT_EQ(page->callout()->tone(), Tone::Outdated);
  press();
  page->selectCycle(QStringLiteral("M2"));
  EXPECT_EQ(cell(*page->touchRows(), bad_, 1), QStringLiteral("excluded"));
  EXPECT_EQ(cell(*page->cycleRows(), QStringLiteral("M2"), 3), QStringLiteral("0"));
  window_->undoStack().undo();
  press();
  page->selectCycle(QStringLiteral("M2"));
  EXPECT_EQ(cell(*page->touchRows(), bad_, 1), QStringLiteral("rejected"));
}

/// What the model is made from is worked out first, by the same button, and what holds is not worked out again.
TEST_F(ProbingPages, TheModelEvaluatesFirstWhatIsOutdated) {
  openCycles(true);
  const SessionModel& session = window_->session();
  const auto kinds = [&] {
    QStringList stored;
    for (const StoredResult& r : session.session()->results(session.campaignId())) stored << r.kind.c_str();
    return stored.join(QLatin1Char(' '));
  };
  go<TouchEvaluationPage>(StepId::Calibrate);
  press();
  auto* page = go<CycleModelPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  press();
  EXPECT_EQ(kinds(), QStringLiteral("evaluate fit"));
  EXPECT_EQ(page->callout()->tone(), Tone::Attention) << "of the bad touch";
  window_->undoStack().push(new ExcludeCommand(window_->session(), {bad_}, QStringLiteral("bad")));
  ASSERT_TRUE(waitForJobs(*window_, 10));
  EXPECT_EQ(window_->workflow().status(StepId::Calibrate).state, StepState::Outdated);
  EXPECT_EQ(page->callout()->tone(), Tone::Outdated);
  press();
  EXPECT_EQ(kinds(), QStringLiteral("evaluate fit evaluate fit"));
  for (const char* kind : {"evaluate", "fit"}) EXPECT_TRUE(session.state(kind).current) << kind;
  EXPECT_NE(page->callout()->tone(), Tone::Outdated) << page->callout()->sentence().toStdString();
  // What is as it was holds again, and nothing is run for it.
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 10));
  for (const char* kind : {"evaluate", "fit"}) EXPECT_TRUE(session.state(kind).current) << kind;
  // Cancelled as one.
  window_->undoStack().push(new ExcludeCommand(window_->session(), {other_}, QStringLiteral("bad as well")));
  ASSERT_TRUE(waitForJobs(*window_, 10));
  QTest::mouseClick(page->primaryButton(), Qt::LeftButton);
  window_->jobs().cancelAll();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(kinds(), QStringLiteral("evaluate fit evaluate fit"));
  // What fails first is the reason why the rest was not run.
  const std::filesystem::path list = session.campaign()->folder / "captures/touches.csv";
  writeFileAtomically(list, "time_s,cycle\n0,M0\n");
  press();
  EXPECT_EQ(page->callout()->tone(), Tone::Bad);
  EXPECT_TRUE(page->callout()->sentence().contains(QStringLiteral("touches.csv")))
      << page->callout()->sentence().toStdString();
  EXPECT_EQ(kinds(), QStringLiteral("evaluate fit evaluate fit"));
}

TEST_F(ProbingPages, TheProgrammeIsCheckedBeforeItIsGivenAway) {
  for (const bool holes : {true, false}) {
    SetUp();
    std::filesystem::remove_all(folder_ / "campaign");
    openCycles(holes);
    auto* page = go<TouchCapturePage>(StepId::Capture);
    press();
    page->runAll();
    ASSERT_TRUE(waitForJobs(*window_, 60));
    ASSERT_TRUE(page->program().has_value());
    const bool good = page->program()->check.good();
    EXPECT_TRUE(good) << (page->program()->check.issues.empty() ? "" : page->program()->check.issues.front().what);
    const auto items = page->exportables();
    const auto program = std::find_if(items.begin(), items.end(),
                                      [](const Exportable& e) { return e.formats.front() == QLatin1String("nc"); });
    ASSERT_EQ(program != items.end(), good);
    const QString file = QString::fromStdString((folder_ / "cycle.nc").string());
    program->write(file);
    const std::string text = readFile(folder_ / "cycle.nc");
    EXPECT_NE(text.find("G65"), std::string::npos);
    EXPECT_EQ(text, page->program()->text);
  }
}

TEST_F(ProbingPages, EvaluationListsFeaturesAndWhatWasLeftOut) {
  openCycles(false);
  auto* page = go<TouchEvaluationPage>(StepId::Calibrate);
  ASSERT_NE(page, nullptr);
  EXPECT_TRUE(page->deviations()->empty());
  press();
  EXPECT_EQ(window_->workflow().status(StepId::Calibrate).state, StepState::Attention);
  EXPECT_EQ(page->features()->rowCount(), 12);  // four balls, three styli
  ASSERT_EQ(page->leftOut()->rowCount(), 1);
  EXPECT_EQ(page->leftOut()->idAt(0), bad_);
  EXPECT_EQ(page->deviations()->series().size(), 3U);
  exportAll();
  // Everything comes back when the session is opened again.
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(session);
  page = go<TouchEvaluationPage>(StepId::Calibrate);
  EXPECT_EQ(page->features()->rowCount(), 12);
  EXPECT_EQ(page->leftOut()->rowCount(), 1);
}

TEST_F(ProbingPages, ClosedFormsStandBesideTheJointEvaluation) {
  openCycles(false);
  auto* page = go<TouchEvaluationPage>(StepId::Calibrate);
  press();
  EXPECT_EQ(page->tabs()->tabText(3), QStringLiteral("Closed forms"));
  ASSERT_EQ(page->comparison()->rowCount(), 12) << "four balls in three cycles after the first";
  const auto numbers = [&](std::size_t column) {
    QStringList parts = cell(*page->comparison(), QStringLiteral("M1/B1"), column).split(QStringLiteral("; "));
    EXPECT_EQ(parts.size(), 3);
    std::vector<double> out;
    for (QString& part : parts)
      out.push_back(part.section(QLatin1Char(' '), 0, 0).replace(QChar(0x2212), QLatin1Char('-')).toDouble());
    return out;
  };
  const std::vector<double> closed = numbers(2);
  const std::vector<double> joint = numbers(3);
  double off = 0.0;
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(joint[p], truth_[1][p], 60.0 * 0.2) << "the joint evaluation knows the rotation";
    off = std::max(off, std::abs(closed[p] - truth_[1][p]));
  }
  EXPECT_GT(off, 40.0) << "drift and screws count as rotation in the closed forms";
  exportAll();
}

TEST_F(ProbingPages, TheCertificateStandsBesideTheTouches) {
  openCycles(true, "\"hole_diameter_mm\":12,\"certificate_uncertainty_um\":0.5");
  auto* page = go<TouchEvaluationPage>(StepId::Calibrate);
  press();
  EXPECT_EQ(page->tabs()->tabText(3), QStringLiteral("Certificate"));
  ASSERT_EQ(page->comparison()->rowCount(), 4);
  // EXX of the truth, which begins at zero, is the slope against the certificate (the bar grows by EME as well).
  const auto slope = [&](int k) {
    return cell(*page->comparison(), QStringLiteral("M%1").arg(k), 2)
        .section(QLatin1Char(' '), 0, 0)
        .replace(QChar(0x2212), QLatin1Char('-'))
        .toDouble();
  };
  const auto grown = [&](int k) {
    return truth_[static_cast<std::size_t>(k)][0] - truth_[static_cast<std::size_t>(k)][8];
  };
  EXPECT_NEAR(slope(1) - slope(0), grown(1) - grown(0), 8.0);
  exportAll();
}

TEST_F(ProbingPages, ModelShowsTheTruthWithinItsUncertainty) {
  openCycles(false);
  go<TouchEvaluationPage>(StepId::Calibrate);
  press();
  auto* page = go<CycleModelPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  press();
  EXPECT_EQ(page->parameters()->rowCount(), 12);
  EXPECT_FALSE(page->view()->empty());
  EXPECT_EQ(window_->session().result("fit")->payload.at("cycles").size(), 4U);
  // Displacements dX, dY, dZ over four cycles, against the truth of the virtual machine.
  ASSERT_EQ(page->trends()->series().size(), 3U);
  for (std::size_t p = 0; p < 3; ++p) {
    const Series& s = page->trends()->series()[p];
    ASSERT_EQ(s.y.size(), 4U);
    for (std::size_t k = 1; k < 4; ++k) {
      EXPECT_NEAR(s.y[k], truth_[k][6 + p], 5.0 * s.sigma[k]) << s.name.toStdString() << ' ' << k;
      EXPECT_GT(s.sigma[k], 0.0);
    }
  }
  page->setComponent(2);
  for (int axis = 0; axis < 3; ++axis) {
    page->setPlane(axis);
    ASSERT_NE(page->field(), nullptr);
    EXPECT_EQ(page->field()->grid.normal_axis, axis);
    EXPECT_EQ(page->view()->arrows().size(), 64U);
    exportAll();
  }
}

TEST_F(ProbingPages, AReferenceInstrumentIsHeldBesideTheCycles) {
  openCycles(true);
  auto* page = go<TouchEvaluationPage>(StepId::Calibrate);
  press();
  // A grid encoder with another zero that sees the truth of EXX, every minute.
  std::string text = "time_s,value,sigma\n";
  for (int minute = 0; minute <= 50; ++minute) {
    const auto k = static_cast<std::size_t>(std::min(3, minute / 10));
    text += std::to_string(60 * minute) + "," + std::to_string(truth_[k][0] + 100.0) + ",0.05\n";
  }
  ReferencePanel* panel = page->reference();
  panel->load(QString::fromStdString(folder_.write("encoder.csv", text).string()));
  panel->setParameter(QStringLiteral("EXX_um_per_m"));
  ASSERT_EQ(panel->comparison().status, FitStatus::Converged) << panel->verdict()->sentence().toStdString();
  EXPECT_EQ(panel->comparison().points.size(), 4U);
  EXPECT_LT(panel->comparison().rms, 3.0);
  EXPECT_EQ(panel->curves()->series().size(), 2U);
  EXPECT_EQ(panel->differences()->series().front().sigma.size(), 4U);
  EXPECT_TRUE(panel->verdict()->sentence().contains(QStringLiteral("µm/m")));
  exportAll();
  // A record with a mistake changes nothing and says where it is.
  panel->load(QString::fromStdString(folder_.write("bad.csv", "time_s,value\n0,1\n0,2\n5,nan\n").string()));
  EXPECT_EQ(panel->verdict()->tone(), Tone::Bad);
  EXPECT_TRUE(panel->verdict()->sentence().contains(QStringLiteral("bad.csv")));
  // It is still there when the session is opened again, without the file it came from.
  std::filesystem::remove(folder_ / "encoder.csv");
  const QString session = QString::fromStdString(window_->session().folder().string());
  window_->closeSession();
  window_->open(session);
  page = go<TouchEvaluationPage>(StepId::Calibrate);
  EXPECT_EQ(page->reference()->comparison().points.size(), 4U);
}

TEST_F(ProbingPages, TheSecondAxisIsAnOptionThatCanBeUndone) {
  openCycles(true);
  auto* page = go<CycleModelPage>(StepId::Model);
  EXPECT_FALSE(page->primaryButton()->isEnabled()) << "touches come before the model";
  go<TouchEvaluationPage>(StepId::Calibrate);
  press();
  go<CycleModelPage>(StepId::Model);
  press();
  EXPECT_EQ(page->parameters()->rowCount(), 9);
  auto* box = page->findChild<QAbstractButton*>(QStringLiteral("secondAxis"));
  ASSERT_NE(box, nullptr);
  QTest::mouseClick(box, Qt::LeftButton, Qt::NoModifier, QPoint(10, box->height() / 2));
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->parameters()->rowCount(), 10);
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->parameters()->rowCount(), 9);
  exportAll();
}

}  // namespace
}  // namespace spindrift::gui
