// SPDX-License-Identifier: GPL-3.0-or-later
// The loop against a control that is none, in fast time: what is lost when it is killed, how sure it is, what it does
// when an operator changes the tool, homes anew, runs a programme of his own, or stops it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/base/utc_time.h"
#include "core/machine/campaign.h"
#include "core/workflows/closed_loop.h"
#include "core/workflows/closed_loop_demo.h"
#include "core/workflows/loop_models.h"
#include "core/workflows/loop_search.h"
#include "core/workflows/loop_state.h"
#include "tests/core/control/stand_in_control.h"
#include "tests/core/workflows/true_machine.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;
using Condition = ControlState::Condition;

constexpr double factor = 600.0;

/// Without a simulation: compensated by what is identified on the way.
LoopPlan identifyingPlan(double hours) {
  LoopPlan plan = demoPlan(hours);
  plan.simulation.reset();
  plan.discrepancy_s = 0.0;
  plan.identify_s = 2400.0;
  plan.measure_every_s = 240.0;
  plan.shortest_s = 200.0;
  plan.limits.rate_um_s = 1.0;
  plan.programme = {{0.0, 0.0}, {300.0, 5000.0}, {3600.0, 1500.0}, {5400.0, 6000.0}, {9000.0, 2500.0}};
  plan.patience_s = 2.0;
  return plan;
}

Eigen::Vector3d growth_um(double warmth, const Eigen::Vector3d&) {
  return {9.0 * warmth, 0.0, -30.0 * warmth};
}

LoopOperator agreeing() {
  LoopOperator who;
  who.confirm = [](const DryRun&) { return true; };
  who.wishes = std::make_shared<LoopWishes>();
  return who;
}

bool told(const LoopResult& result, const std::string& part) {
  return std::any_of(result.events.begin(), result.events.end(),
                     [&](const LoopEvent& event) { return event.text.find(part) != std::string::npos; });
}

/// The number that follows `words` where they were told.
std::optional<double> toldAfter(const LoopResult& result, const std::string& words) {
  for (const LoopEvent& event : result.events) {
    const std::size_t at = event.text.find(words);
    if (at == std::string::npos) continue;
    return std::strtod(event.text.c_str() + at + words.size(), nullptr);
  }
  return std::nullopt;
}

/// As kill -9 looks from within: nothing of the loop runs any more.
struct Killed {};

TEST(LoopAtAStandIn, GoesOnWhereItWasKilledAndLosesNothing) {
  const LoopPlan plan = identifyingPlan(3.0);
  StandInMachine machine(factor, growth_um);
  const TempFolder folder;
  const std::filesystem::path campaign = folder / "campaign";
  LoopOperator who = agreeing();
  JobContext job;
  // Before there is a model, while it compensates, and in the middle of a measuring cycle.
  const std::function<bool(const LoopStatus&, const LoopResult&)> moments[] = {
      [](const LoopStatus&, const LoopResult& r) { return r.cycles.size() == 3; },
      [](const LoopStatus& s, const LoopResult&) { return s.stage == LoopStage::Identified && s.time_s > 3000.0; },
      [](const LoopStatus& s, const LoopResult& r) { return s.measuring && r.cycles.size() > 14; }};
  std::string log, observations, start;
  std::size_t cycles = 0;
  LoopStage stage = LoopStage::None;
  for (const auto& killed : moments) {
    StandInControl control(machine);
    Eigen::Vector3d first_applied = Eigen::Vector3d::Constant(std::nan(""));
    EXPECT_THROW((void)runClosedLoop(plan, control, who, campaign, job,
                                     [&](const LoopStatus& status, const LoopResult& result) {
                                       if (std::isnan(first_applied.x())) {
                                         first_applied = status.applied_um;
                                         EXPECT_GE(result.cycles.size(), cycles);
                                         EXPECT_EQ(status.stage, stage);
                                       }
                                       cycles = result.cycles.size();
                                       stage = status.stage;
                                       if (killed(status, result)) throw Killed{};
                                     }),
                 Killed);
    // The date is that of the machine's time 0, not one that the program has by heart. The stand-in's hours pass in
    // seconds, so its time 0 lies before the test.
    const std::string start_now = Campaign::read(campaign).start_utc;
    if (start.empty()) {
      const double now_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
      EXPECT_LE(*parseUtc(start_now), now_s + 1.0);
      EXPECT_GT(*parseUtc(start_now), now_s - plan.duration_s - 3600.0);
      start = start_now;
    }
    EXPECT_EQ(start_now, start);
    // What stood in the files before still does.
    const std::string log_now = readFile(campaign / "log.csv");
    const std::string observations_now = readFile(campaign / "observations.csv");
    EXPECT_TRUE(log_now.starts_with(log));
    EXPECT_TRUE(observations_now.starts_with(observations));
    EXPECT_GT(log_now.size(), log.size());
    EXPECT_GT(observations_now.size(), observations.size());
    log = log_now;
    observations = observations_now;
    // Safe meanwhile: the control lets it fade.
    std::this_thread::sleep_for(std::chrono::milliseconds(2000));
    EXPECT_LT(machine.applied_um().cwiseAbs().maxCoeff(), 0.01);
  }
  // Killed between the state and the readings: what the one has, the other gets.
  writeFileAtomically(campaign / "observations.csv", observations.substr(0, observations.rfind("M1")));
  StandInControl control(machine);
  const LoopResult result = runClosedLoop(plan, control, who, campaign, job);
  EXPECT_TRUE(result.completed);
  EXPECT_EQ(Campaign::read(campaign).start_utc, start) << "a loop that goes on began when it began";
  EXPECT_EQ(result.resumed, 3);
  ASSERT_GT(result.cycles.size(), cycles + 2);
  EXPECT_TRUE(readFile(campaign / "observations.csv").starts_with(observations));
  EXPECT_TRUE(readFile(campaign / "log.csv").starts_with(log));
  // Over the cycles of the last run, once it compensates again: how late a single one comes is up to the clock of this
  // machine.
  double with = 0.0, without = 0.0;
  for (std::size_t i = cycles + 1; i < result.cycles.size(); ++i) {
    with += result.cycles[i].with_um.z() * result.cycles[i].with_um.z();
    without += result.cycles[i].without_um.z() * result.cycles[i].without_um.z();
  }
  std::printf("%.3f of what there is without\n", std::sqrt(with / without));
  EXPECT_LT(std::sqrt(with / without), 0.15) << result.cycles.size() - cycles << " cycles";
  // It has ended, and is not begun again over what it left.
  EXPECT_THAT(refusal([&] { (void)runClosedLoop(plan, control, who, campaign, job); }), HasSubstr("reached its end"));
}

TEST(LoopAtAStandIn, NamesOfColumnsAreTextInWhatItLeaves) {
  LoopPlan plan = identifyingPlan(1.0);
  plan.temperatures = {"=1+1,\"x\""};
  StandInMachine machine(factor, growth_um);
  StandInControl control(machine);
  const TempFolder folder;
  JobContext job;
  EXPECT_THROW((void)runClosedLoop(plan, control, agreeing(), folder / "loop", job,
                                   [](const LoopStatus&, const LoopResult&) { throw Killed{}; }),
               Killed);
  EXPECT_EQ(CsvTable::read(folder / "loop" / "log.csv").columnNames().back(), plan.temperatures.front());
}

TEST(LoopAtAStandIn, IsNotTakenUpWithAnotherPlanNorOverSomethingElse) {
  LoopPlan plan = identifyingPlan(1.0);
  StandInMachine machine(factor, growth_um);
  StandInControl control(machine);
  const TempFolder folder;
  JobContext job;
  EXPECT_THROW((void)runClosedLoop(plan, control, agreeing(), folder / "loop", job,
                                   [](const LoopStatus&, const LoopResult&) { throw Killed{}; }),
               Killed);
  plan.touches.pop_back();
  EXPECT_THAT(refusal([&] { (void)runClosedLoop(plan, control, agreeing(), folder / "loop", job); }),
              HasSubstr("another plan"));
  std::filesystem::create_directories(folder / "other");
  writeFileAtomically(folder / "other" / "notes.txt", "mine");
  EXPECT_THAT(refusal([&] { (void)runClosedLoop(plan, control, agreeing(), folder / "other", job); }),
              HasSubstr("is not empty"));
}

TEST(LoopAtAStandIn, SaysHowSureItIsAndIsRightAboutIt) {
  const LoopPlan plan = identifyingPlan(2.0);
  StandInMachine machine(factor, growth_um);
  StandInControl control(machine);
  const TempFolder folder;
  JobContext job;
  const LoopResult result = runClosedLoop(plan, control, agreeing(), folder / "loop", job);
  double squares = 0.0;
  int count = 0;
  std::vector<double> sigmas;
  for (const LoopCycle& cycle : result.cycles) {
    if (cycle.stage != LoopStage::Identified) continue;
    for (const int axis : {0, 2}) {
      ASSERT_TRUE(std::isfinite(cycle.sigma_um[axis]));
      EXPECT_GT(cycle.sigma_um[axis], 0.0);
      const double off = cycle.without_um[axis] - cycle.predicted_um[axis];
      squares += off * off / (std::pow(cycle.sigma_um[axis], 2) + std::pow(plan.touch_sigma_um, 2));
      sigmas.push_back(cycle.sigma_um[axis]);
      ++count;
    }
  }
  ASSERT_GT(count, 12);
  const double pull = std::sqrt(squares / count);
  RecordProperty("pull", std::to_string(pull));
  EXPECT_GT(pull, 0.1);
  EXPECT_LT(pull, 2.0);
  // Of the model, not of the plan: it is another one for each axis and moment.
  const auto [least, most] = std::minmax_element(sigmas.begin(), sigmas.end());
  EXPECT_GT(*most, 1.05 * *least);
}

TEST(LoopAtAStandIn, NoticesAnotherToolAndHomingAnew) {
  const LoopPlan plan = identifyingPlan(3.0);
  StandInMachine machine(factor, growth_um);
  StandInControl control(machine);
  const TempFolder folder;
  JobContext job;
  LoopOperator who = agreeing();
  enum class Step { Waits, OtherTool, ToolBack, Homed, Returned } step = Step::Waits;
  double since_s = 0.0;
  std::size_t cycles = 0;
  double largest_um = 0.0;
  bool off = false;
  const LoopResult result =
      runClosedLoop(plan, control, who, folder / "loop", job, [&](const LoopStatus& status, const LoopResult& so_far) {
        const auto enter = [&](Step next) {
          step = next;
          since_s = status.time_s;
          cycles = so_far.cycles.size();
        };
        if (step == Step::Waits && status.stage == LoopStage::Identified && status.time_s > 4200.0 &&
            !status.measuring) {
          machine.changeTool(3);
          enter(Step::OtherTool);
        } else if (step == Step::OtherTool) {
          // The deviation of the machine is that of any tool; only the touches are not.
          EXPECT_EQ(so_far.cycles.size(), cycles);
          EXPECT_TRUE(status.active) << status.reason;
          largest_um = std::max(largest_um, std::abs(status.applied_um.z()));
          if (status.time_s > since_s + 700.0) {
            machine.changeTool(1);
            enter(Step::ToolBack);
          }
        } else if (step == Step::ToolBack && so_far.cycles.size() > cycles && !status.measuring) {
          machine.home({0.008, 0.0, 0.0});
          enter(Step::Homed);
        } else if (step == Step::Homed) {
          if (so_far.cycles.size() == cycles && status.time_s > since_s + 60.0) {
            off = off || !status.active;
            EXPECT_THAT(status.active ? "active" : status.reason, HasSubstr("homed anew"));
          }
          if (so_far.cycles.size() > cycles) enter(Step::Returned);
        } else if (step == Step::Returned && so_far.cycles.size() > cycles + 2) {
          who.wishes->stop = true;
        }
      });
  EXPECT_EQ(step, Step::Returned);
  EXPECT_TRUE(off);
  EXPECT_GT(largest_um, 3.0);
  EXPECT_TRUE(told(result, "tool 3 is in the spindle"));
  EXPECT_TRUE(told(result, "tool 1 is back"));
  // As the touches and the model at that moment say: within their noise of what was moved.
  const std::optional<double> shift_um = toldAfter(result, "the zero has moved by X ");
  ASSERT_TRUE(shift_um) << result.summary();
  EXPECT_NEAR(*shift_um, 8.0, 1.5);
  // The shift is nobody's heat.
  for (auto cycle = result.cycles.end() - 2; cycle != result.cycles.end(); ++cycle)
    EXPECT_LT(std::abs(cycle->with_um.x()), 3.0);
}

TEST(LoopAtAStandIn, NeverAbortsAProgrammeOfTheOperator) {
  const LoopPlan plan = identifyingPlan(1.0);
  StandInMachine machine(factor, growth_um);
  StandInControl control(machine);
  const TempFolder folder;
  JobContext job;
  LoopOperator who = agreeing();
  int aborts = 0;
  bool ran = false;
  double since_s = 0.0;
  const LoopResult result =
      runClosedLoop(plan, control, who, folder / "loop", job, [&](const LoopStatus& status, const LoopResult& so_far) {
        if (!ran && so_far.cycles.size() == 1 && status.time_s < 290.0 && status.control.ready()) {
          ran = true;
          since_s = status.time_s;
          machine.runOtherProgram(true);
          aborts = machine.aborts();
        }
        if (ran && status.time_s > since_s + 900.0) {
          EXPECT_EQ(machine.aborts(), aborts);
          who.wishes->stop = true;
        }
      });
  EXPECT_TRUE(ran);
  EXPECT_TRUE(told(result, "a program that is not the loop's"));
  EXPECT_EQ(machine.aborts(), aborts);
}

TEST(LoopAtAStandIn, StoppedItFadesWithinItsRateAndTakesHoldAndFadeMeanwhile) {
  LoopPlan plan = identifyingPlan(3.0);
  plan.limits.step_um = 2.0;
  StandInMachine machine(factor, growth_um);
  StandInControl control(machine);
  const TempFolder folder;
  JobContext job;
  LoopOperator who = agreeing();
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  double largest_step = 0.0, at_stop = 0.0;
  const LoopResult result =
      runClosedLoop(plan, control, who, folder / "loop", job, [&](const LoopStatus& status, const LoopResult&) {
        largest_step = std::max(largest_step, (status.applied_um - before).cwiseAbs().maxCoeff());
        before = status.applied_um;
        if (status.time_s > 1000.0) who.wishes->hold = true;
        if (status.time_s > 1500.0 && status.time_s < 2000.0) {
          EXPECT_TRUE(status.hold_when_silent);
        }
        if (!who.wishes->stop && std::abs(status.applied_um.z()) > 8.0) {
          at_stop = status.applied_um.z();
          who.wishes->stop = true;
        }
      });
  EXPECT_GT(std::abs(at_stop), 8.0);
  EXPECT_FALSE(result.completed);
  EXPECT_TRUE(told(result, "the compensation is at zero"));
  EXPECT_LT(machine.applied_um().cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LE(largest_step, 2.0 + 1e-6);
  EXPECT_TRUE(told(result, "the control holds the compensation"));
}

/// Readings of a machine with an effect that the simulation lacks, without a control.
struct LackingSimulation {
  LackingSimulation() : plan(demoPlan(4.0)), models(plan, [](const std::string&) {}), truth(demoTruth(4.0)) {
    double next_row_s = 0.0, next_cycle_s = 0.0;
    Random random(5);
    for (double t = 5.0; t < 4.0 * 3600.0; t += 5.0) {
      double rpm = 0.0;
      for (const LoopSpeed& speed : plan.programme) {
        if (speed.from_s <= t) rpm = speed.spindle_rpm;
      }
      truth.advance(rpm, t);
      models.drive(rpm, t);
      if (t >= next_row_s) {
        next_row_s = t + 30.0;
        std::vector<double> values{rpm};
        for (const std::string& column : plan.temperatures)
          values.push_back(truth.temperature_degC(column) + random.normal(0.0, 0.02));
        models.addRow(t, values);
      }
      if (t < next_cycle_s) continue;
      next_cycle_s = t + 600.0;
      std::vector<LoopReading> readings;
      for (const LoopTouch& touch : plan.touches) {
        const Eigen::Vector3d noise_um(random.normal(0.0, 0.3), random.normal(0.0, 0.3), random.normal(0.0, 0.3));
        const Eigen::Vector3d at = touch.target_mm - 1e-3 * (truth.deviation_um(touch.target_mm) + noise_um);
        const auto reading = models.reading(fmt::format("TOUCH {} {} {:.7f} {:.7f} {:.7f} 0 0 0", touch.point,
                                                        toString(touch.component), at.x(), at.y(), at.z()),
                                            t, LoopStage::Simulation);
        readings.push_back(*reading);
      }
      LoopCycle cycle;
      cycle.stage = LoopStage::Simulation;
      std::set<int> again;
      models.take(readings, fmt::format("M{}", cycles++), false, cycle, again);
      last = cycle;
    }
  }
  LoopPlan plan;
  LoopModels models;
  TrueMachine truth;
  LoopCycle last;
  int cycles = 0;
};

TEST(LoopChoice, EachNameIsAcceptedOrRejectedByRuleOrByTheOperator) {
  LackingSimulation lacking;
  struct Case {
    LoopAcceptance::Rule rule;
    std::vector<std::string> ids;  ///< listed, or the operator's answer
    bool anybody;
    bool accepted;
  };
  const std::string lack = "spindle.drift.x";
  const Case cases[] = {{LoopAcceptance::Rule::Listed, {lack}, false, true},
                        {LoopAcceptance::Rule::Listed, {"spindle.growth.z"}, false, false},
                        {LoopAcceptance::Rule::Ask, {lack}, true, true},
                        {LoopAcceptance::Rule::Ask, {}, true, false},
                        {LoopAcceptance::Rule::Ask, {lack}, false, false}};
  for (const Case& each : cases) {
    LoopPlan plan = lacking.plan;
    plan.accept.rule = each.rule;
    if (each.rule == LoopAcceptance::Rule::Listed) plan.accept.ids = each.ids;
    LoopOperator who;
    bool asked = false;
    if (each.anybody)
      who.choose = [&](const DiscrepancyResult& found, const std::stop_token&) {
        asked = true;
        EXPECT_FALSE(found.effects.empty());
        return each.ids;
      };
    LoopSearch search(plan, who);
    search.begin(lacking.models.discrepancyInput());
    std::optional<DiscrepancyResult> found;
    while (!(found = search.named())) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ASSERT_FALSE(found->effects.empty()) << found->message;
    std::optional<LoopSearch::Decision> decision;
    while (!(decision = search.decided())) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(asked, each.anybody);
    const bool in = std::find(decision->accepted.begin(), decision->accepted.end(), lack) != decision->accepted.end();
    EXPECT_EQ(in, each.accepted) << found->message;
    EXPECT_EQ(decision->model != nullptr, each.accepted);
    EXPECT_EQ(decision->accepted.size() + decision->rejected.size(), found->effects.size());
  }
}

TEST(LoopSureness, OfASimulationIsWhatItWasOffAndShrinksWithTheAddedEffect) {
  LackingSimulation lacking;
  LoopModels& models = lacking.models;
  const Eigen::Vector3d before = models.sigma(LoopStage::Simulation);
  EXPECT_NEAR(before.x(), std::abs(lacking.last.without_um.x() - lacking.last.predicted_um.x()), 0.8 * before.x());
  EXPECT_GT(before.x(), 3.0 * before.z());  // the effect that it lacks is one of X
  LoopPlan plan = lacking.plan;
  plan.accept = {LoopAcceptance::Rule::Listed, {"spindle.drift.x"}};
  const LoopOperator who;
  LoopSearch search(plan, who);
  search.begin(models.discrepancyInput());
  while (!search.named()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::optional<LoopSearch::Decision> decision;
  while (!(decision = search.decided())) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ASSERT_NE(decision->model, nullptr);
  const TempFolder folder;
  models.add(folder.write("model.json", decision->model->json().dump()));
  const Eigen::Vector3d after = models.sigma(LoopStage::WithEffect);
  EXPECT_LT(after.x(), 0.5 * before.x());
  EXPECT_GT(after.x(), 0.0);
}

}  // namespace
}  // namespace spindrift::testing
