// SPDX-License-Identifier: GPL-3.0-or-later
// The page Compensate: live in the real window, on a control that is none and fast, and on the real one (skipped where
// that is absent). SPINDRIFT_TEST_PICTURES=FOLDER keeps what it looks like.
#include "widgets/pages/compensate/closed_loop_page.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QSettings>
#include <QTest>
#include <cmath>
#include <csignal>
#include <cstdlib>

#include "core/base/atomic_file.h"
#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/connect/hal_commands.h"
#include "core/connect/linuxcnc_shell.h"
#include "core/connect/source.h"
#include "core/control/private_control.h"
#include "core/reporting/report_language.h"
#include "core/session/session.h"
#include "core/workflows/closed_loop_demo.h"
#include "tests/core/control/stand_in_control.h"
#include "tests/core/workflows/true_machine.h"
#include "tests/support/temp_folder.h"
#include "widgets/common/parts.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/models/rows_model.h"
#include "widgets/plots/plot.h"
#include "widgets/shell/main_window.h"

namespace spindrift::gui {
namespace {

using spindrift::testing::StandInControl;
using spindrift::testing::StandInMachine;
using spindrift::testing::TempFolder;

class ClosedLoopPageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QSettings().clear();
    writeLoopExample(folder_.path(), 4.0, 100.0);
    window_ = std::make_unique<MainWindow>();
    window_->resize(1280, 800);
    window_->setTheme(ThemeKind::Light);
    window_->show();
    window_->openLiveCompensation();
    page_ = window_->liveCompensation();
  }
  void TearDown() override {
    window_->setTheme(ThemeKind::Light);
    window_.reset();
  }
  /// plan.json of the example with other values.
  QString plan(const nlohmann::json& changes) {
    nlohmann::json json = JsonNode::read(folder_ / "plan.json").value();
    json.merge_patch(changes);
    return QString::fromStdString(folder_.write("changed.json", json.dump()).string());
  }
  void useStandIn(double factor) {
    machine_ = std::make_unique<StandInMachine>(factor, [](double warmth, const Eigen::Vector3d&) {
      return Eigen::Vector3d(14.0 * warmth, 4.0 * warmth, -35.0 * warmth);
    });
    page_->service().setControl([this](const LoopPlan&) { return std::make_unique<StandInControl>(*machine_); });
  }
  template <typename Condition>
  bool waitFor(const Condition& condition, int seconds = 60) {
    QElapsedTimer clock;
    clock.start();
    while (!condition()) {
      if (clock.elapsed() > 1000 * seconds) return false;
      QTest::qWait(50);
    }
    return true;
  }
  void picture(const char* name) {
    const char* to = std::getenv("SPINDRIFT_TEST_PICTURES");
    if (to == nullptr) return;
    for (const auto& [kind, word] : {std::pair{ThemeKind::Light, "light"}, std::pair{ThemeKind::Dark, "dark"}}) {
      window_->setTheme(kind);
      QTest::qWait(300);
      EXPECT_TRUE(window_->grab().save(QStringLiteral("%1/%2-%3.png").arg(QLatin1String(to), name, word)));
    }
    window_->setTheme(ThemeKind::Light);
  }
  void click(QPushButton* button) {
    ASSERT_TRUE(button->isVisible() && button->isEnabled()) << button->text().toStdString();
    QTest::mouseClick(button, Qt::LeftButton);
  }
  [[nodiscard]] std::string said() const { return page_->callout()->sentence().toStdString(); }
  [[nodiscard]] bool told(const QString& part) const {
    for (const Row& row : page_->events()->rows()) {
      if (row.cells[1].text.contains(part)) return true;
    }
    return false;
  }

  TempFolder folder_;
  std::unique_ptr<StandInMachine> machine_;
  std::unique_ptr<MainWindow> window_;
  ClosedLoopPage* page_ = nullptr;
};

TEST_F(ClosedLoopPageTest, NothingMovesBeforeItIsConfirmedAndStopFadesToZero) {
  picture("live-empty");
  EXPECT_FALSE(page_->startButton()->isEnabled());
  EXPECT_FALSE(page_->stopButton()->isEnabled());
  page_->openPlan(QString::fromStdString(folder_.write("bad.json", "{\"format\": \"other\"}").string()));
  EXPECT_EQ(page_->callout()->tone(), Tone::Bad);

  useStandIn(400.0);
  page_->openPlan(plan({{"simulation", nullptr},
                        {"discrepancy_s", 0},
                        {"identify_s", 2400},
                        {"measure_every_s", 240},
                        {"shortest_s", 200},
                        {"limits", {{"rate_um_s", 1}}}}));
  ASSERT_TRUE(page_->startButton()->isEnabled()) << said();
  click(page_->startButton());
  EXPECT_TRUE(page_->dryRunText().contains(QStringLiteral("6 touches"))) << page_->dryRunText().toStdString();
  EXPECT_TRUE(page_->dryRunText().contains(QStringLiteral("6000 rpm")));
  QTest::qWait(600);
  EXPECT_FALSE(page_->service().running());
  picture("live-confirm");
  click(page_->confirmButton());
  ASSERT_TRUE(page_->service().running()) << said();
  ASSERT_TRUE(waitFor([&] { return page_->callout()->tone() == Tone::Attention; }, 10)) << said();
  EXPECT_NE(said().find("nothing to compensate with yet"), std::string::npos) << said();
  // Active: what is applied, how sure, how old, how many.
  ASSERT_TRUE(waitFor([&] {
    return page_->callout()->tone() == Tone::Good && std::abs(machine_->applied_um().z()) > 8.0;
  })) << said();
  EXPECT_NE(said().find("Active, by the identified models"), std::string::npos) << said();
  ASSERT_TRUE(waitFor([&] { return page_->axisTile(2)->value().contains(QStringLiteral("±")); }, 10));
  EXPECT_TRUE(page_->axisTile(2)->value().startsWith(QLatin1Char('+'))) << page_->axisTile(2)->value().toStdString();
  EXPECT_TRUE(page_->ageTile()->value().endsWith(QStringLiteral(" s")));
  EXPECT_GE(page_->cyclesTile()->value().split(QLatin1Char(' ')).front().toInt(), 5);
  EXPECT_EQ(page_->plot()->series().size(), 2U);
  EXPECT_EQ(window_->jobBar()->connections(), QStringLiteral("Compensating"));
  picture("live-active");
  // Hold or fade, while it runs.
  click(page_->silence()->button(1));
  EXPECT_TRUE(waitFor([&] { return page_->service().snapshot().status.hold_when_silent; }, 10));
  click(page_->silence()->button(0));
  // Off at the machine: said, and off.
  machine_->set(ControlState::Condition::EmergencyStop);
  ASSERT_TRUE(waitFor([&] { return page_->callout()->tone() == Tone::Attention; }, 10)) << said();
  EXPECT_NE(said().find("emergency stop"), std::string::npos) << said();
  picture("live-off");
  machine_->set(ControlState::Condition::Ready);
  ASSERT_TRUE(waitFor([&] { return page_->callout()->tone() == Tone::Good; }, 10)) << said();
  offerReportLanguage(ReportLanguage{"de", [](const std::string& text) { return "~" + text; }});
  click(page_->stopButton());
  ASSERT_TRUE(waitFor([&] { return !page_->service().running(); })) << said();
  offerReportLanguage({});
  const std::filesystem::path kept = page_->service().folder().toStdString();
  EXPECT_THAT(readFile(kept / "report.html"), ::testing::HasSubstr(">Measuring cycles<"));
  EXPECT_THAT(readFile(kept / "report.de.html"), ::testing::HasSubstr(">~Measuring cycles<"));
  EXPECT_LT(machine_->applied_um().cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_NE(said().find("compensation is at zero"), std::string::npos) << said();
  EXPECT_EQ(page_->startButton()->text(), QStringLiteral("Go on …"));
  // And it goes on where it stood.
  const std::size_t cycles = page_->service().snapshot().result.cycles.size();
  click(page_->startButton());
  click(page_->confirmButton());
  ASSERT_TRUE(waitFor([&] { return page_->callout()->tone() == Tone::Good; }, 10)) << said();
  EXPECT_GE(page_->service().snapshot().result.cycles.size(), cycles);
  EXPECT_TRUE(told(QStringLiteral("continues with")));
}

// An operator stands before it with a finger on Stop.
TEST_F(ClosedLoopPageTest, StaysWhenTheCampaignIsReadAgain) {
  auto session = std::make_unique<Session>(Session::create(folder_ / "session"));
  const std::int64_t id =
      session->newCampaign("new", "2026-01-31T08:00:00Z",
                           R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-(C)-t]",
"axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},{"name":"Z","travel_mm":[0,150]}]})");
  window_->session().adopt(std::move(session), id);
  window_->openLiveCompensation();
  ASSERT_TRUE(page_->isVisible());
  window_->session().setClockOffsets({{"log", {30.0, 2.0, "by hand"}}});
  EXPECT_TRUE(page_->isVisible()) << "a recording that ends does this";
  window_->selectCampaign(id);
  EXPECT_FALSE(page_->isVisible()) << "who chooses a campaign wants to see it";
}

TEST_F(ClosedLoopPageTest, ALostControlIsSaid) {
  useStandIn(400.0);
  page_->openPlan(plan({{"simulation", nullptr}, {"discrepancy_s", 0}, {"patience_s", 1}}));
  click(page_->startButton());
  click(page_->confirmButton());
  ASSERT_TRUE(waitFor([&] { return page_->service().snapshot().any; }, 10));
  machine_->set(ControlState::Condition::Unreachable);
  ASSERT_TRUE(waitFor([&] { return !page_->service().running(); }, 20)) << said();
  EXPECT_EQ(page_->callout()->tone(), Tone::Bad);
  EXPECT_NE(said().find("did not come back"), std::string::npos) << said();
}

TEST_F(ClosedLoopPageTest, TheOperatorAcceptsOrRejectsWhatIsNamed) {
  // A machine that does what the simulation knows, and a drift along X by the spindle that it does not know.
  const auto truth = std::make_shared<spindrift::testing::TrueMachine>(demoTruth(8.0));
  machine_ = std::make_unique<StandInMachine>(
      400.0, [truth, probe = std::make_shared<Random>(11)](double, const Eigen::Vector3d& place_mm) {
        constexpr double repeatability_um = 0.3;
        const Eigen::Vector3d noise(probe->normal(), probe->normal(), probe->normal());
        return Eigen::Vector3d(truth->deviation_um(place_mm) + repeatability_um * noise);
      });
  machine_->onLive([truth](double rpm, double time_s) { truth->advance(rpm, time_s); },
                   [truth](const std::string& column) { return truth->temperature_degC(column); });
  page_->service().setControl([this](const LoopPlan&) { return std::make_unique<StandInControl>(*machine_); });
  page_->openPlan(plan({{"accept", "ask"}, {"discrepancy_s", 7500}, {"identify_s", 0}, {"duration_s", 28800}}));
  click(page_->startButton());
  click(page_->confirmButton());
  ASSERT_TRUE(waitFor([&] { return page_->acceptButton()->isVisible(); }, 200)) << said();
  ASSERT_FALSE(page_->choice()->rows().empty());
  picture("live-choice");
  std::size_t drift = page_->choice()->rows().size();
  for (std::size_t i = 0; i < page_->choice()->rows().size(); ++i) {
    const bool wanted = page_->choice()->rows()[i].id == QStringLiteral("spindle.drift.x");
    if (wanted) drift = i;
    const QModelIndex box = page_->choice()->index(static_cast<int>(i), 0);
    page_->choice()->setData(box, wanted ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole);
  }
  ASSERT_LT(drift, page_->choice()->rows().size());
  click(page_->acceptButton());
  ASSERT_TRUE(waitFor([&] { return !page_->service().snapshot().result.effects.empty(); })) << said();
  EXPECT_EQ(page_->service().snapshot().result.effects, std::vector<std::string>{"spindle.drift.x"});
  EXPECT_TRUE(waitFor([&] { return said().find("with the added effect") != std::string::npos; }, 20)) << said();
}

/// Runs this program's part of the test where it has namespaces of its own; what it said, where it failed.
std::string insideItsOwnNamespaces() {
  ::setenv("SPINDRIFT_INSIDE", "1", 1);
  const std::string said = "/tmp/said.txt";
  const pid_t child = ::fork();
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int out = ::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(out, 1);
    ::dup2(out, 2);
    ::execl("/proc/self/exe", "closed_loop_page_test", "--gtest_filter=*AtARealControl", nullptr);
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? std::string() : readFile(said);
}

TEST_F(ClosedLoopPageTest, StartsAppliesAndStopsAtARealControl) {
  if (const std::string why = spindrift::whyNoPrivateControl(); !why.empty()) GTEST_SKIP() << why;
  if (std::getenv("SPINDRIFT_INSIDE") == nullptr) {
    EXPECT_EQ(spindrift::isolated(insideItsOwnNamespaces, {}, 180.0), "");
    return;
  }
  LinuxcncProcess control(folder_ / "control");
  const pid_t machine = ::fork();
  if (machine == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::execl(SPINDRIFT_CLI, SPINDRIFT_CLI, "virtual-machine", (folder_ / "truth.json").c_str(), "--truth",
            (folder_ / "truth.csv").c_str(), "--factor", "100", "--hours", "20", nullptr);
    ::_exit(127);
  }
  HalCommands watch;
  ASSERT_TRUE(waitFor(
      [&] {
        try {
          LinuxcncShell shell({});
          shell.connect({});
          watch.start();
          return true;
        } catch (const ConnectionError&) {
          return false;
        }
      },
      30));
  const auto applied_um = [&] { return 1e3 * std::stod(watch.read({"offset-z.offset"}).at(0).value_or("nan")); };
  page_->openPlan(plan({{"identify_s", 0}, {"discrepancy_s", 0}}));
  click(page_->startButton());
  click(page_->confirmButton());
  ASSERT_TRUE(waitFor([&] { return page_->callout()->tone() == Tone::Good && std::abs(applied_um()) > 3.0; }, 90))
      << said();
  EXPECT_NE(said().find("by the simulation"), std::string::npos) << said();
  const double shown = page_->service().snapshot().status.applied_um.z();
  EXPECT_NEAR(shown, applied_um(), 3.0);
  click(page_->silence()->button(1));
  EXPECT_TRUE(waitFor([&] { return watch.read({"comp-hold"}).at(0).value_or("") == "TRUE"; }, 5));
  click(page_->stopButton());
  ASSERT_TRUE(waitFor([&] { return !page_->service().running(); }, 60)) << said();
  // Faded before it left, although silence would hold it.
  EXPECT_TRUE(waitFor([&] { return std::abs(applied_um()) < 0.01; }, 10)) << applied_um();
  ::kill(machine, SIGKILL);
}

}  // namespace
}  // namespace spindrift::gui
