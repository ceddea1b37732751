// SPDX-License-Identifier: GPL-3.0-or-later
// The page Verify and the model over time of a campaign with observations, in the real window.
#include "widgets/pages/verify/verify_page.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QTabWidget>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/tasks/task_options.h"
#include "tests/widgets/support/page_test.h"
#include "widgets/common/parts.h"
#include "widgets/common/table_angle.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/thermal/thermal_model_page.h"
#include "widgets/pages/thermal/warm_up_page.h"
#include "widgets/panels/thermal/clock_panel.h"
#include "widgets/panels/thermal/iso_panel.h"
#include "widgets/panels/thermal/update_panel.h"
#include "widgets/panels/verify/verify_maps.h"
#include "widgets/panels/verify/verify_series.h"
#include "widgets/plots/plot.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr double tau_s = 3000.0;
constexpr double gain = 12.0;  // um at 3000 rpm

class VerifyPages : public PageTest {
 protected:
  /// 40 h of a spindle in steps; EZ of F1 and F2 every 30 min with 0.2 um. With compensation a tenth is left.
  /// `turned_deg`: the last of the points is measured with the table at this angle.
  std::filesystem::path write(const std::string& name, bool compensating, int points = 2, double turned_deg = 0.0) {
    Random random(compensating ? 12 : 11);
    Random speeds(5);
    std::string log = "time_s,spindle_rpm,compensation_on,T_room_degC\n";
    std::string rows = "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
    double state = 0;
    double rpm = 0;
    for (int i = 0; i < 4800; ++i) {
      if (i % 240 == 0) rpm = 1000.0 * std::floor(speeds.uniform(0.0, 4.0));
      log += std::to_string(30 * i) + "," + exactNumber(rpm) + (compensating ? ",1," : ",0,") +
             exactNumber(20 + 0.5 * std::sin(i / 500.0)) + "\n";
      for (int p = 1; i % 60 == 0 && p <= points; ++p) {
        rows += std::to_string(30 * i) + ",M" + std::to_string(i / 60) + ",F" + std::to_string(p) + "," +
                std::to_string(50 * p) + (p < 3 ? ",0" : ",150") + ",0," + exactNumber(p == points ? turned_deg : 0.0) +
                ",EZ," + exactNumber(gain * state * (compensating ? 0.1 : 1.0) + random.normal(0, 0.2)) +
                ",0.2,probe,fit\n";
      }
      state += (1 - std::exp(-30.0 / tau_s)) * (rpm / 3000.0 - state);
    }
    const std::string folder = name + "/";
    folder_.write(folder + "campaign.json", R"({"format":"spindrift-campaign","version":1,"name":")" + name +
                                                R"(","start_utc":"2026-01-31T08:00:00Z"})");
    folder_.write(
        folder + "machine.json",
        R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]","axes":[)"
        R"({"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,200]}]})");
    folder_.write(folder + "log.csv", log);
    folder_.write(folder + "observations.csv", rows);
    return folder_ / name;
  }
};

TEST_F(VerifyPages, BeforeAndAfterAreJudgedAgainstTheGoal) {
  const auto after = write("after", true);
  open(write("before", false));
  auto* page = go<VerifyPage>(StepId::Verify);
  ASSERT_NE(page, nullptr);
  EXPECT_FALSE(page->primaryButton()->isEnabled());
  page->setAfter(QString::fromStdString(after.string()));
  ASSERT_TRUE(page->primaryButton()->isEnabled());
  press();
  ASSERT_NE(page->result(), nullptr) << page->callout()->sentence().toStdString();
  EXPECT_EQ(page->result()->verdict, VerifyVerdict::Met);
  EXPECT_EQ(page->callout()->tone(), Tone::Good);
  EXPECT_EQ(window_->workflow().status(StepId::Verify).state, StepState::Current);
  EXPECT_EQ(page->components()->rowCount(), 1);
  // 160 values are drawn as the range over the points of a state, and every point has its row.
  ASSERT_EQ(page->plot()->series().size(), 4U);
  ASSERT_EQ(page->plot()->series().front().x.size(), 79U);  // all but the first state
  ASSERT_EQ(page->points()->rowCount(), 2);
  for (int side = 0; side < 2; ++side) {
    const Series& range = page->plot()->series()[static_cast<std::size_t>(side)];
    std::map<std::string, std::pair<double, double>> expected;
    for (const VerifyPoint& p : page->result()->points) {
      const double value = side == 0 ? p.before : p.after;
      const double reach = 2.0 * (side == 0 ? p.before_sigma : p.after_sigma);
      const auto [at, first] = expected.try_emplace(p.state, value - reach, value + reach);
      if (!first) at->second = {std::min(at->second.first, value - reach), std::max(at->second.second, value + reach)};
    }
    ASSERT_EQ(expected.count("M7"), 1U);
    EXPECT_NEAR(range.y[6] - range.sigma[6], expected["M7"].first, 1e-9);
    EXPECT_NEAR(range.y[6] + range.sigma[6], expected["M7"].second, 1e-9);
  }
  std::vector<const VerifyPoint*> first_point;
  for (const VerifyPoint& p : page->result()->points)
    if (p.point == "F1") first_point.push_back(&p);
  const VerifyFigures figures = verifyFigures(first_point, true);
  EXPECT_EQ(page->points()->rows()[0].id, QStringLiteral("F1"));
  EXPECT_EQ(page->points()->rows()[0].cells[2].text.toStdString(),
            withUncertainty(figures.rms, figures.rms_sigma, "um"));
  // A goal below what is left: outdated, and then not met.
  ASSERT_EQ(window_->workflow().status(StepId::Verify).state, StepState::Current);
  page->goal()->setValue(0.5);
  EXPECT_EQ(page->callout()->tone(), Tone::Outdated);
  EXPECT_EQ(window_->workflow().status(StepId::Verify).state, StepState::Outdated) << "the list of steps says the same";
  press();
  EXPECT_EQ(page->result()->verdict, VerifyVerdict::NotMet);
  EXPECT_EQ(page->callout()->tone(), Tone::Bad);
  exportAll();
  window_->grab().save(QString::fromStdString((folder_ / "verify.png").string()));
  if (qEnvironmentVariableIsSet("SPINDRIFT_PICTURES"))
    window_->grab().save(qEnvironmentVariable("SPINDRIFT_PICTURES") + QStringLiteral("/verify.png"));
  // What was measured while compensating is no campaign to fit: every observation is left out.
  window_->closeSession();
  open(after);
  ASSERT_EQ(window_->session().campaign()->name, "after");
  const auto set = window_->session().observations();
  ASSERT_TRUE(set != nullptr);
  for (const Observation& o : set->rows) EXPECT_EQ(o.use, ObservationUse::Exclude);
}

TEST(VerifyCurvesTest, AreOfOneAngleOfTheTable) {
  VerifyResult result;
  for (int state = 1; state <= 40; ++state)
    for (const double c_deg : {0.0, 90.0})
      for (const char* point : {"P1", "P2"})
        result.points.push_back({point,
                                 "M" + std::to_string(state),
                                 {0, 0, 0},
                                 Component::EX,
                                 c_deg == 0.0 ? 3.0 : -9.0,
                                 0.1,
                                 0.5,
                                 0.1,
                                 c_deg});
  // The range over the points of a state is none of both angles together.
  const VerifyCurves curves = verifyCurves(result, Component::EX, 90.0);
  ASSERT_EQ(curves.series[0].x.size(), 40U);
  EXPECT_DOUBLE_EQ(curves.series[0].y[7], -9.0);
  EXPECT_NEAR(curves.series[0].sigma[7], 0.2, 1e-9);
  result.points.resize(60);
  EXPECT_EQ(verifyCurves(result, Component::EX, 0.0).series[0].y, std::vector<double>(30, 3.0));
}

TEST_F(VerifyPages, AnglesOfTheTableAreChosenWhereThereAreSeveral) {
  const auto after = write("after", true, 2, 90.0);
  open(write("before", false, 2, 90.0));
  auto* page = go<VerifyPage>(StepId::Verify);
  page->setAfter(QString::fromStdString(after.string()));
  press();
  ASSERT_NE(page->result(), nullptr) << page->callout()->sentence().toStdString();
  ASSERT_TRUE(page->angleChoice()->isVisible());
  ASSERT_EQ(page->angleChoice()->count(), 3) << "the worst, 0 and 90 degrees";
  const auto drawn = [&] { return page->plot()->series().front(); };
  for (const int index : {1, 2}) {
    page->angleChoice()->setCurrentIndex(index);
    Q_EMIT page->angleChoice()->activated(index);
    EXPECT_EQ(drawn().y, verifyCurves(*page->result(), Component::EZ, index == 1 ? 0.0 : 90.0).series.front().y);
    EXPECT_TRUE(page->plot()
                    ->axisTitles()
                    .join(QLatin1Char(' '))
                    .contains(index == 1 ? QString::fromUtf8("table at 0°") : QString::fromUtf8("table at 90°")));
  }
  // The table of the points is of the angle that is drawn beside it: each point was measured at one.
  const auto listed = [&] {
    EXPECT_TRUE(waitForJobs(*window_, 30));
    QStringList points;
    for (const Row& row : page->points()->rows()) points << row.id;
    return points.join(QLatin1Char(' ')) + QLatin1Char('|') + page->pointsTitle();
  };
  EXPECT_EQ(listed(), QString::fromUtf8("F2|EZ at the points, table at 90°"));
  page->angleChoice()->setCurrentIndex(1);
  Q_EMIT page->angleChoice()->activated(1);
  EXPECT_EQ(listed(), QString::fromUtf8("F1|EZ at the points, table at 0°"));
  page->setShown(1);
  QComboBox* states = page->maps()->stateChoice();
  for (const double c_deg : {0.0, 90.0}) {
    states->setCurrentText(withTableAngle(QStringLiteral("M40"), c_deg));
    Q_EMIT states->activated(states->currentIndex());
    EXPECT_EQ(listed(), c_deg == 0.0 ? QString::fromUtf8("F1|EZ at the points, table at 0°")
                                     : QString::fromUtf8("F2|EZ at the points, table at 90°"));
  }
  EXPECT_FALSE(page->angleChoice()->isVisible()) << "the states on the table name the angle";
  page->setShown(0);
  EXPECT_TRUE(page->angleChoice()->isVisible());
  EXPECT_EQ(listed(), QString::fromUtf8("F1|EZ at the points, table at 0°"));
  if (qEnvironmentVariableIsSet("SPINDRIFT_PICTURES"))
    window_->grab().save(qEnvironmentVariable("SPINDRIFT_PICTURES") + QStringLiteral("/verify_angles.png"));
}

TEST_F(VerifyPages, BeforeAndAfterStandOnTheTableWithOneScale) {
  const auto after = write("after", true, 4);
  open(write("before", false, 4));
  auto* page = go<VerifyPage>(StepId::Verify);
  page->setAfter(QString::fromStdString(after.string()));
  press();
  page->setShown(1);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  VerifyMaps* maps = page->maps();
  ASSERT_EQ(maps->view(0)->points().size(), 4U);
  EXPECT_EQ(maps->view(0)->colourScale(), maps->view(1)->colourScale());
  // The state that is worst after compensating; what is left is a tenth of what was before, within the noise.
  const auto value = [&](int side) { return std::abs(*maps->view(side)->points().front().value); };
  EXPECT_GT(value(0), 3.0);
  EXPECT_LT(value(1), 0.1 * value(0) + 1.0);
  const auto middle = maps->view(0)->probeAt(*maps->view(0)->pixelOf({125.0, 75.0, 0.0}));
  ASSERT_TRUE(middle.has_value()) << "a heat map between the points";
  EXPECT_NEAR(std::abs(middle->value), value(0), 2.0);
  maps->stateChoice()->setCurrentText(QStringLiteral("M40"));
  Q_EMIT maps->stateChoice()->activated(maps->stateChoice()->currentIndex());
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(maps->pose(), (VerifyPose{"M40", 0.0}));
  for (const VerifyPoint& p : page->result()->points) {
    if (p.state == "M40" && p.point == "F1") {
      EXPECT_EQ(*maps->view(0)->points().front().value, p.before);
    }
  }
  exportAll();
  if (qEnvironmentVariableIsSet("SPINDRIFT_PICTURES"))
    window_->grab().save(qEnvironmentVariable("SPINDRIFT_PICTURES") + QStringLiteral("/verify-table.png"));
}

TEST_F(VerifyPages, ACampaignWithObservationsHasAModelOverTime) {
  open(write("before", false));
  window_->workflow().goTo(StepId::Model);
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(qobject_cast<ThermalModelPage*>(window_->currentPage()), nullptr);
  for (auto* button : window_->currentPage()->findChildren<QPushButton*>())
    if (button->text() == QLatin1String("Model over time")) button->click();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  auto* page = qobject_cast<ThermalModelPage*>(window_->currentPage());
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(page->request().output, "F1_EZ_um");
  press();
  ASSERT_NE(page->result(), nullptr) << page->callout()->sentence().toStdString();
  EXPECT_LT(page->result()->test.rmse, 0.3 * page->result()->plain.front().test.rmse);
  EXPECT_EQ(page->seriesPlot()->series().front().style, SeriesStyle::Points);
  // Kept true by measurements, and what the interval buys.
  QTest::mouseClick(page->updates()->button(), Qt::LeftButton);
  page->updates()->button()->click();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  ASSERT_NE(page->updates()->result(), nullptr);
  EXPECT_EQ(page->updates()->result()->sweep.size(), 7U);
  page->updates()->what()->button(1)->click();
  EXPECT_EQ(page->updates()->plot()->series().size(), 2U);
  // ISO 230-3 of the same series.
  page->findChild<QTabWidget*>()->setCurrentWidget(page->iso());
  ASSERT_TRUE(waitForJobs(*window_, 60));
  // The spindle ran: that is no test of environmental variation, and the panel says why.
  EXPECT_EQ(page->iso()->rows()->rowCount(), 0);
  EXPECT_TRUE(page->iso()->note()->sentence().contains(QLatin1String("spindle turns")))
      << page->iso()->note()->sentence().toStdString();
  page->iso()->test()->button(1)->click();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  // Several speeds, two hours each, are no test of the rotating spindle; one of them is.
  EXPECT_EQ(page->iso()->rows()->rowCount(), 0);
  EXPECT_TRUE(page->iso()->note()->sentence().contains(QLatin1String("several steps of speed")))
      << page->iso()->note()->sentence().toStdString();
  for (int from_s = 0; from_s < 12 * 7200 && page->iso()->rows()->rowCount() == 0; from_s += 7200) {
    page->iso()->range()->setText(QStringLiteral("%1:%2").arg(from_s).arg(from_s + 7140));
    Q_EMIT page->iso()->range()->editingFinished();
    ASSERT_TRUE(waitForJobs(*window_, 60));
  }
  EXPECT_EQ(page->iso()->rows()->rowCount(), 2);
  EXPECT_FALSE(page->iso()->plot()->empty());
  // While another part of the record is worked out, the numbers of this one are not shown beside it.
  page->iso()->range()->setText(QStringLiteral("0:86400"));
  Q_EMIT page->iso()->range()->editingFinished();
  EXPECT_EQ(page->iso()->rows()->rowCount(), 0);
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  // What is chosen belongs to the campaign, and the report tells the same test.
  const QString range = page->iso()->range()->text();
  const auto told = [&] {
    const ReportTaskOptions options =
        ReportTaskOptions::of(*window_->session().session(), window_->session().campaignId());
    return QString::fromStdString(options.iso230.range);
  };
  EXPECT_EQ(told(), range);
  // It is stored, and the report tells what is stored.
  const auto storedRange = [&] {
    const StoredResult* stored = window_->session().latest("iso-230-3");
    return stored == nullptr ? QString() : QString::fromStdString(stored->provenance.options.value("range", ""));
  };
  EXPECT_EQ(storedRange(), range);
  EXPECT_TRUE(window_->session().state("iso-230-3").current);
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_NE(page->iso()->range()->text(), range);
  EXPECT_EQ(told(), page->iso()->range()->text());
  window_->undoStack().redo();
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(page->iso()->range()->text(), range);
  EXPECT_EQ(page->iso()->rows()->rowCount(), 2);
  if (qEnvironmentVariableIsSet("SPINDRIFT_PICTURES")) {
    auto* tabs = page->findChild<QTabWidget*>();
    for (int i = 0; i < tabs->count(); ++i) {
      tabs->setCurrentIndex(i);
      window_->grab().save(qEnvironmentVariable("SPINDRIFT_PICTURES") + QStringLiteral("/over-time-%1.png").arg(i));
    }
  }
  // Offsets between clocks make results outdated, and are kept.
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Current);
  window_->session().setClockOffsets({{"probe", {120.0, 1.0, "entered"}}});
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Outdated);
  EXPECT_EQ(window_->session().observations()->rows[2].time_s, 1800.0 + 120.0);
  auto* warm_up = go<WarmUpPage>(StepId::WarmUp);
  ASSERT_EQ(warm_up->clocks()->rows()->rowCount(), 1);
  if (qEnvironmentVariableIsSet("SPINDRIFT_PICTURES")) {
    warm_up->findChild<QTabWidget*>()->setCurrentIndex(3);
    window_->grab().save(qEnvironmentVariable("SPINDRIFT_PICTURES") + QStringLiteral("/clocks.png"));
  }
  // The log knows no positions, so nothing can be estimated: said, and nothing changed.
  warm_up->clocks()->source()->setCurrentText(QStringLiteral("probe"));
  warm_up->clocks()->estimate();
  EXPECT_TRUE(window_->jobs().busy()) << "in the background";
  ASSERT_TRUE(waitForJobs(*window_, 60));
  EXPECT_EQ(warm_up->clocks()->message()->tone(), Tone::Attention);
  window_->session().setClockOffsets({});
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Current);
  warm_up->clocks()->offset()->setValue(60.0);
  EXPECT_EQ(window_->session().clockOffsets().at("probe").offset_s, 60.0);
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Outdated);
  window_->undoStack().undo();
  EXPECT_TRUE(window_->session().clockOffsets().empty());
}

}  // namespace
}  // namespace spindrift::gui
