// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/widgets/support/story_support.h"

#include <fmt/format.h>

#include <QCoreApplication>
#include <QSettings>
#include <QTabWidget>
#include <cmath>

#include "core/base/random.h"
#include "core/machine/observation.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/pages/page.h"
#include "widgets/shell/tour.h"

namespace spindrift::gui {
namespace {

constexpr double sigma_um = 0.4;
constexpr double lag_s = 2400.0;
constexpr double duration_s = 28800.0;

double spindleRpm(double t) {
  return t < 1800.0 ? 0.0 : t < 14400.0 ? 6000.0 : 0.0;
}

/// 9 um at full speed after a lag, exact for the steps above.
double growth_um(double t) {
  if (t < 1800.0) return 0.0;
  const double on = 9.0 * (1.0 - std::exp(-(std::min(t, 14400.0) - 1800.0) / lag_s));
  return t < 14400.0 ? on : on * std::exp(-(t - 14400.0) / lag_s);
}

}  // namespace

std::filesystem::path writeStoryCampaign(const testing::TempFolder& folder, Hidden hidden, bool with_simulation,
                                         StorySize size) {
  const std::filesystem::path campaign = folder / "campaign";
  std::filesystem::create_directories(campaign);
  folder.write("campaign/campaign.json",
               fmt::format(R"({{"format":"spindrift-campaign","version":1,"name":"small story",)"
                           R"("start_utc":"2026-03-01T08:00:00Z"{}}})",
                           with_simulation ? R"(,"simulation":"simulation.csv")" : ""));
  std::string points;
  ObservationSet set;
  std::string table = "time_s,point,component,predicted\n";
  Random random(17);
  const double step_s = duration_s / size.states;
  for (int state = 0; state < size.states; ++state) {
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d position(50.0 + 80.0 * i, i % 2 == 0 ? 60.0 : 340.0, 40.0 * (i % 3));
      if (state == 0) {
        points += fmt::format(R"({}{{"id":"P{}","kind":"ball","x_mm":{},"y_mm":{},"z_mm":{}}})", i > 0 ? "," : "",
                              i + 1, position.x(), position.y(), position.z());
      }
      for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
        Observation o;
        o.time_s = state * step_s + i * step_s / 120.0;
        o.state = fmt::format("M{}", state);
        o.point = fmt::format("P{}", i + 1);
        o.position_mm = position;
        o.component = c;
        o.sigma = sigma_um;
        o.instrument = "probe";
        o.use = state >= size.states * 3 / 4 ? ObservationUse::Holdout : ObservationUse::Fit;
        // What the simulation knows: a slow drift along X.
        const double known = c == Component::EX ? 4.0 * o.time_s / duration_s : 0.0;
        double more = 0.0;
        if (hidden == Hidden::SpindleGrowth && c == Component::EZ) more = growth_um(o.time_s);
        if (hidden == Hidden::Oscillation && c == Component::EX) more = 3.0 * std::sin(o.time_s * 2 * M_PI / 2777.0);
        o.value = known + more + random.normal(0, sigma_um);
        set.rows.push_back(o);
        table += fmt::format("{},{},{},{}\n", o.time_s, o.point, toString(c), known);
      }
    }
  }
  std::string log = "time_s,spindle_rpm,feed_x_mm_min,T_spindle_degC,T_ambient_degC\n";
  for (int row = 0; row <= size.log_rows; ++row) {
    const double t = row * duration_s / size.log_rows;
    log += fmt::format("{},{},{},{},{}\n", t, spindleRpm(t), static_cast<int>(t / 3600.0) % 3 == 1 ? 4000 : 0,
                       22.0 + 0.9 * growth_um(t - 300.0) + random.normal(0, 0.02),
                       21.0 + 0.8 * std::sin(t / 9000.0) + random.normal(0, 0.02));
  }
  folder.write("campaign/log.csv", log);
  if (with_simulation) folder.write("campaign/simulation.csv", table);
  folder.write("campaign/machine.json",
               R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]","axes":[)"
               R"({"name":"X","travel_mm":[0,500]},{"name":"Y","travel_mm":[0,400]},{"name":"Z","travel_mm":[0,300]}],)"
               R"("spindle":{"axis":"Z","max_rpm":6000},"points":[)" +
                   points + "]}");
  set.write(campaign / "observations.csv");
  return campaign;
}

void StoryTest::SetUp() {
  QSettings().clear();
  window_ = std::make_unique<MainWindow>();
  window_->resize(1440, 900);
  window_->show();
}

void StoryTest::TearDown() {
  if (window_->session().isOpen()) sessions_.push_back(window_->session().folder());
  window_.reset();
  for (const std::filesystem::path& session : sessions_) std::filesystem::remove_all(session);
}

void StoryTest::wait() {
  ASSERT_TRUE(waitForJobs(*window_, 60));
}

void StoryTest::walk(const QString& demo, const std::function<void(const std::string& what)>& look) {
  window_->startDemo(demo, true);
  wait();
  ASSERT_NE(window_->session().campaign(), nullptr);
  for (const StepId step : all_steps) {
    window_->workflow().goTo(step);
    wait();
    window_->currentPage()->runAll();
    wait();
    QCoreApplication::processEvents();
    const std::string what = demo.toStdString() + "/" + std::string(toString(step));
    look(what);
    for (auto* tabs : window_->currentPage()->findChildren<QTabWidget*>()) {
      for (int i = 1; tabs->isVisible() && i < tabs->count(); ++i) {
        tabs->setCurrentIndex(i);
        QCoreApplication::processEvents();
        look(what + "/" + tabs->tabText(i).toStdString());
      }
      tabs->setCurrentIndex(0);
    }
  }
}

void StoryTest::open(const std::filesystem::path& campaign, StepId step) {
  window_->open(QString::fromStdString(campaign.string()));
  wait();
  ASSERT_NE(window_->session().campaign(), nullptr) << window_->jobBar()->message().toStdString();
  sessions_.push_back(window_->session().folder());
  window_->workflow().goTo(step);
}

}  // namespace spindrift::gui
