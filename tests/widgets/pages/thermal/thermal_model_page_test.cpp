// SPDX-License-Identifier: GPL-3.0-or-later
// The page of models over time in the real window, on a log whose output is a known lag of a known input.
#include "widgets/pages/thermal/thermal_model_page.h"

#include <QComboBox>
#include <QPushButton>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/workflows/log_campaign.h"
#include "tests/widgets/support/page_test.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/common/message_page.h"
#include "widgets/pages/compensate/log_compensate_page.h"
#include "widgets/pages/report/report_page.h"
#include "widgets/panels/thermal/iso_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

constexpr double tau_s = 3000.0;
constexpr double gain = 12.0;  // um at 3000 rpm

class ThermalPages : public PageTest {
 protected:
  /// 20 h at 30 s: speed in steps, the output a first-order lag of it with 0.1 um of noise, one sensor that knows
  /// nothing.
  std::filesystem::path writeLog() {
    Random random(4);
    std::string text = "time_s,spindle_rpm,ez_um,T_room_degC\n";
    double state = 0;
    double speed = 0;
    for (int i = 0; i < 2400; ++i) {
      if (i % 120 == 0) speed = 1000.0 * std::floor(random.uniform(0.0, 4.0));
      text += std::to_string(30 * i) + "," + exactNumber(speed) + "," +
              exactNumber(gain * state + random.normal(0, 0.1)) + "," +
              exactNumber(20 + 0.3 * std::sin(i / 300.0) + random.normal(0, 0.02)) + "\n";
      state += (1 - std::exp(-30.0 / tau_s)) * (speed / 3000.0 - state);
    }
    folder_.write("spindle run.csv", text);
    return folder_ / "spindle run.csv";
  }
};

TEST_F(ThermalPages, ALogIsOpenedAndItsModelIdentified) {
  open(writeLog());
  auto* page = go<ThermalModelPage>(StepId::Model);
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::NotStarted);
  EXPECT_EQ(page->seriesPlot()->series().size(), 1U);
  ASSERT_EQ(page->seriesPlot()->spans().size(), 2U);
  press();
  EXPECT_EQ(window_->workflow().status(StepId::Model).state, StepState::Current);
  ASSERT_NE(page->result(), nullptr);
  EXPECT_LT(page->result()->test.rmse, 0.2 * page->result()->plain.front().test.rmse);
  EXPECT_EQ(page->seriesPlot()->series().size(), 2U);
  ASSERT_EQ(page->comparison()->rowCount(), 3);
  EXPECT_NE(page->comparison()->rows()[1].cells[0].text.indexOf(QStringLiteral("no model")), -1);
  // The step response of the speed ends where the truth does.
  const auto& steps = page->result()->step_responses;
  const auto speed =
      std::find_if(steps.begin(), steps.end(), [](const StepResponse& s) { return s.input == "spindle_rpm"; });
  ASSERT_NE(speed, steps.end());
  EXPECT_NEAR(speed->final_value, gain * speed->step / 3000.0, 5.0 * speed->final_sigma + 0.1);
  EXPECT_FALSE(page->stepPlot()->empty());
  exportAll();

  // Reopening shows the same.
  const QString session = QString::fromStdString(window_->session().folder().string());
  const double rms = page->result()->test.rmse;
  window_->closeSession();
  window_->open(session);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  page = go<ThermalModelPage>(StepId::Model);
  ASSERT_TRUE(waitForJobs(*window_, 30));
  ASSERT_NE(page->result(), nullptr);
  EXPECT_DOUBLE_EQ(page->result()->test.rmse, rms);
}

TEST_F(ThermalPages, DraggingTheTrainingRangeChangesItAndUndoBringsItBack) {
  open(writeLog());
  auto* page = go<ThermalModelPage>(StepId::Model);
  press();
  const TimeRange before = page->request().train;
  Plot* plot = page->seriesPlot();
  QWidget* canvas = plot->childAt(plot->rect().center());
  ASSERT_NE(canvas, nullptr);
  // From the end of training to 5 h.
  const int y = plot->height() / 2;
  const QPoint from(static_cast<int>(plot->pixelOfX(plot->spans()[0].to)) - 3, y);
  const QPoint to(static_cast<int>(plot->pixelOfX(5.0)), y);
  QTest::mousePress(canvas, Qt::LeftButton, Qt::NoModifier, from);
  QTest::mouseMove(canvas, (from + to) / 2);
  QTest::mouseMove(canvas, to);
  QTest::mouseRelease(canvas, Qt::LeftButton, Qt::NoModifier, to);
  EXPECT_NEAR(page->request().train.to_s, 5.0 * 3600, 200);
  EXPECT_EQ(page->request().train.from_s, before.from_s);
  EXPECT_EQ(page->callout()->tone(), Tone::Outdated);
  press();
  EXPECT_NE(page->callout()->tone(), Tone::Outdated);
  EXPECT_NEAR(page->result()->model.train_to_s, 5.0 * 3600, 200);
  // The model of the range as it was holds again, and is the one that is shown.
  window_->undoStack().undo();
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_EQ(page->request().train.to_s, before.to_s);
  EXPECT_NE(page->callout()->tone(), Tone::Outdated);
  EXPECT_NEAR(page->result()->model.train_to_s, before.to_s, 200);
}

TEST_F(ThermalPages, InputsAndMethodAreChosen) {
  open(writeLog());
  auto* page = go<ThermalModelPage>(StepId::Model);
  ASSERT_EQ(page->inputs()->rowCount(), 2);
  const int room = page->inputs()->rowOf(QStringLiteral("T_room_degC"));
  ASSERT_GE(room, 0);
  page->inputs()->setData(page->inputs()->index(room, 0), Qt::Unchecked, Qt::CheckStateRole);
  EXPECT_EQ(page->request().inputs, (std::vector<std::string>{"spindle_rpm"}));
  for (auto* box : page->findChildren<QComboBox*>()) {
    if (box->accessibleName() == QLatin1String("How the model is found")) {
      box->setCurrentIndex(1);
      Q_EMIT box->activated(1);
    }
  }
  EXPECT_EQ(page->request().method, "arx");
  press();
  ASSERT_NE(page->result(), nullptr);
  EXPECT_EQ(page->result()->inputs, (std::vector<std::string>{"spindle_rpm"}));
  // The slowest pole is the truth's time constant.
  double slowest = 0;
  for (const auto& t : page->result()->structure.at("time_constants"))
    slowest = std::max(slowest, t["value_s"].get<double>());
  EXPECT_NEAR(slowest, tau_s, 0.25 * tau_s);
  EXPECT_GT(page->lags()->rowCount(), 0);
}

/// As the page does: what is chosen is evaluated, and shown.
void showTest(IsoPanel& panel, const TimeSeries& series, const Iso230Choice& choice = {}) {
  panel.set(std::make_shared<TimeSeries>(series), choice);
  panel.show(std::make_shared<const StandardTest>(
      standardTestOf(series, [&](const TimeSeries& of) { return choice.request(of); })));
}

TEST(IsoPanelTest, DisplacementsAndRotationsHaveAnAxisEach) {
  std::string text = "time_s,T_room_degC,ez_um,ex_nm,eb_urad\n";
  for (int i = 0; i <= 240; ++i) {
    const double t = 60.0 * i;
    const double room = 20.0 + 2.0 * std::sin(t / 4000.0);
    text += exactNumber(t) + "," + exactNumber(room) + "," + exactNumber(3.0 * room) + "," + exactNumber(500.0 * room) +
            "," + exactNumber(-4.0 * room) + "\n";
  }
  IsoPanel panel;
  showTest(panel, parseTimeSeries(text, "log.csv"));
  setShownUnits({true, true, true});
  ASSERT_EQ(panel.plot()->series().size(), 2U);
  ASSERT_EQ(panel.plot(true)->series().size(), 1U);
  EXPECT_EQ(panel.plot()->axisTitles().at(1), QStringLiteral("Displacement / µin"));
  EXPECT_EQ(panel.plot(true)->axisTitles().at(1), QStringLiteral("Rotation / arcsec"));
  const double last = 2.0 * std::sin(14'400.0 / 4000.0);
  EXPECT_NEAR(panel.plot()->series()[0].y.back(), 3.0 * last, 1e-6);
  EXPECT_NEAR(panel.plot()->series()[1].y.back(), 0.5 * last, 1e-6);
  EXPECT_NEAR(panel.plot(true)->series()[0].y.back(), -4.0 * last, 1e-6);
  setShownUnits({});
  // Where nothing turns there is one picture.
  showTest(panel, parseTimeSeries("time_s,ez_um\n0,1\n60,2\n", "log.csv"));
  EXPECT_TRUE(panel.plot(true)->isHidden());
  EXPECT_FALSE(panel.plot()->isHidden());
}

/// Two speeds, neither of them called spindle_rpm: the first runs for an hour from minute 30, the second from
/// minute 60.
TEST(IsoPanelTest, TheColumnOfTheSpeedIsChosen) {
  std::string text = "time_s,main_rpm,tool_rpm,ez_um\n";
  for (int i = 0; i <= 240; ++i)
    text += exactNumber(60.0 * i) + (i >= 30 && i < 90 ? ",6000" : ",0") + (i >= 60 && i < 120 ? ",2000," : ",0,") +
            exactNumber(0.1 * i) + "\n";
  IsoPanel panel;
  const TimeSeries series = parseTimeSeries(text, "log.csv");
  showTest(panel, series);
  QObject::connect(&panel, &IsoPanel::chosen, [&](const Iso230Choice& choice) { showTest(panel, series, choice); });
  EXPECT_EQ(panel.test()->current(), 1) << "the spindle runs once";
  panel.test()->button(0)->click();
  EXPECT_FALSE(panel.speed()->isEnabled()) << "of a machine at rest";
  panel.test()->button(1)->click();
  ASSERT_EQ(panel.speed()->count(), 2);
  EXPECT_TRUE(panel.speed()->isEnabled());
  EXPECT_TRUE(panel.note()->sentence().contains(QStringLiteral("from 0.50 h to 1.50 h")))
      << panel.note()->sentence().toStdString();
  panel.speed()->setCurrentIndex(1);
  Q_EMIT panel.speed()->activated(1);
  EXPECT_TRUE(panel.note()->sentence().contains(QStringLiteral("from 1.00 h to 2.00 h")))
      << panel.note()->sentence().toStdString();
}

TEST_F(ThermalPages, GainsAreWrittenPerUnitOfTheInput) {
  open(writeLog());
  auto* page = go<ThermalModelPage>(StepId::Model);
  press();
  ASSERT_NE(page->result(), nullptr);
  int gains = 0;
  const auto look = [&](const char* per_kelvin, const char* per_rpm) {
    for (int r = 0; r < page->lags()->rowCount(); ++r) {
      const QString input = page->lags()->index(r, 0).data().toString();
      if (page->lags()->index(r, 3).data().toString() == QStringLiteral("–")) continue;
      const bool at_scale = input.contains(QStringLiteral(" at "));
      const char* unit = input.startsWith(QStringLiteral("T_")) ? per_kelvin : per_rpm;
      const QString alone = QString::fromUtf8(per_rpm).section(QLatin1Char('/'), 0, 0);
      EXPECT_EQ(page->lags()->index(r, 4).data().toString(), at_scale ? alone : QString::fromUtf8(unit))
          << input.toStdString();
      ++gains;
    }
  };
  look("µm/K", "µm/rpm");
  setShownUnits({true, true, true});
  look("µin/°F", "µin/rpm");
  setShownUnits({});
  EXPECT_GT(gains, 0);
}

TEST_F(ThermalPages, AFileThatIsNoLogGivesOneSentence) {
  folder_.write("words.csv", "a,b\nx,y\n");
  window_->open(QString::fromStdString((folder_ / "words.csv").string()));
  ASSERT_TRUE(waitForJobs(*window_, 30));
  EXPECT_TRUE(window_->welcomeShown());
  EXPECT_TRUE(window_->jobBar()->message().contains(QStringLiteral("words.csv")))
      << window_->jobBar()->message().toStdString();
  folder_.write("nothing.csv", "time_s,T_a_degC\n0,20\n1,20\n");
  EXPECT_THROW(writeLogCampaign(folder_ / "nothing.csv", folder_ / "c"), InputError);
}

TEST_F(ThermalPages, ACompensatorWhoseModelIsNotGoodEnoughIsNotPraised) {
  Random random(5);
  std::string text = "time_s,spindle_rpm,ez_um\n";
  for (int i = 0; i < 1200; ++i) {
    text += std::to_string(30 * i) + "," + (i / 150 % 2 == 0 ? "0" : "3000") + "," +
            exactNumber(random.normal(0, 1.0)) + "\n";
  }
  folder_.write("noise.csv", text);
  open(folder_ / "noise.csv");
  auto* model = go<ThermalModelPage>(StepId::Model);
  press();
  ASSERT_NE(model->result(), nullptr);
  auto* page = go<LogCompensatePage>(StepId::Compensate);
  press();
  ASSERT_NE(page->result(), nullptr) << page->callout()->sentence().toStdString();
  ASSERT_FALSE(page->result()->result.warnings.empty());
  EXPECT_EQ(page->callout()->tone(), Tone::Attention);
  EXPECT_TRUE(page->callout()->sentence().contains(QStringLiteral("do not use this compensation")))
      << page->callout()->sentence().toStdString();
}

TEST_F(ThermalPages, TheCompensatorIsRunOverALog) {
  open(writeLog());
  Workflow& workflow = window_->workflow();
  auto* page = go<LogCompensatePage>(StepId::Compensate);
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(workflow.status(StepId::Compensate).state, StepState::Blocked);
  EXPECT_TRUE(workflow.status(StepId::Compensate).sentence.contains(QStringLiteral("Model")));
  EXPECT_FALSE(page->primaryButton()->isEnabled());
  go<ThermalModelPage>(StepId::Model);
  press();
  EXPECT_EQ(workflow.status(StepId::Compensate).state, StepState::NotStarted);
  const double model_rmse = qobject_cast<ThermalModelPage*>(window_->currentPage())->result()->test.rmse;
  page = go<LogCompensatePage>(StepId::Compensate);
  press();
  ASSERT_NE(page->result(), nullptr) << page->callout()->sentence().toStdString();
  EXPECT_EQ(workflow.status(StepId::Compensate).state, StepState::Current);
  EXPECT_EQ(page->callout()->tone(), Tone::Good);
  // What the free run of the model leaves, the compensator leaves too.
  EXPECT_GT(page->result()->before_rms, 2.0);
  EXPECT_LT(page->result()->after_rms, 0.25 * page->result()->before_rms);
  EXPECT_LT(page->result()->after_rms, 1.05 * model_rmse);
  EXPECT_EQ(page->plot()->series().size(), 3U);
  exportAll();
  // The same model again changes nothing; another one: to be run again.
  go<ThermalModelPage>(StepId::Model);
  press();
  EXPECT_EQ(workflow.status(StepId::Compensate).state, StepState::Current);
  window_->session().setSetting(window_->session().campaignKey("thermal-model"), {{"method", "arx"}});
  press();
  EXPECT_EQ(workflow.status(StepId::Compensate).state, StepState::Outdated);
  // What a log alone cannot have says so, and what would be needed.
  for (const StepId step : {StepId::Verify, StepId::Review}) {
    EXPECT_EQ(workflow.status(step).state, StepState::Blocked);
    workflow.goTo(step);
    EXPECT_NE(qobject_cast<MessagePage*>(window_->currentPage()), nullptr) << stepTitle(step).toStdString();
  }
  // But it has its report, with the model and what the compensator would have achieved.
  EXPECT_EQ(workflow.status(StepId::Report).state, StepState::NotStarted);
  auto* report = go<ReportPage>(StepId::Report);
  press();
  ASSERT_TRUE(QTest::qWaitFor([&] { return report->document() != nullptr; }, 20000));
  EXPECT_EQ(workflow.status(StepId::Report).state, StepState::Current);
  const std::string html = readFile(report->file());
  EXPECT_NE(html.find("Model over time"), std::string::npos);
  EXPECT_NE(html.find("Compensation over the log"), std::string::npos);
  EXPECT_NE(html.find("of a log alone"), std::string::npos);
}

}  // namespace
}  // namespace spindrift::gui
