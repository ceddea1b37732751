// SPDX-License-Identifier: GPL-3.0-or-later
// A fit that is asked for when its evaluation is outdated: the evaluation first, then the fit, each made from what is
// there when its turn comes.
#include "core/tasks/task_chain.h"

#include <gmock/gmock.h>

#include <functional>
#include <stop_token>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/simulation/scenario.h"
#include "core/simulation/virtual_campaign.h"
#include "core/tasks/task_options.h"
#include "core/workflows/instrument_checks.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::spindrift::testing::TempFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Does something when a task begins.
class AtStart : public ProgressSink {
 public:
  AtStart(std::string task, std::function<void()> what) : task_(std::move(task)), what_(std::move(what)) {}
  void report(double /*fraction*/, std::string_view stage) override {
    if (stage == task_) what_();
  }

 private:
  std::string task_;
  std::function<void()> what_;
};

/// A session with a hole bar that was touched in a few cycles.
class TaskChainTest : public ::testing::Test {
 protected:
  void SetUp() override {
    static const TempFolder kept;
    if (!std::filesystem::exists(kept / "c")) {
      Scenario scenario =
          Scenario::read(spindrift::testing::sourceFolder() / "resources" / "scenarios" / "hole_bar.json");
      writeCampaign(simulateCampaign(scenario, std::nullopt, JobContext()), kept / "c");
    }
    session_.emplace(Session::create(folder_ / "s"));
    JobContext job;
    id_ = session_->importCampaign(kept / "c", job);
    tasks_.emplace(*session_, CampaignState::read(*session_, id_));
    touches_ = TouchList::read(kept / "c/captures/touches.csv");
  }
  void exclude(std::size_t touch, const std::string& reason = "disturbed") {
    session_->exclude(id_, touches_.touches[touch].id(), reason);
  }
  std::vector<std::string> run(const std::string& task) {
    JobContext job;
    return tasks_->run(task, job);
  }
  [[nodiscard]] std::vector<std::string> kindsStored() const {
    std::vector<std::string> kinds;
    for (const StoredResult& r : session_->results(id_)) kinds.push_back(r.kind);
    return kinds;
  }
  [[nodiscard]] TaskStatus status(const std::string& task) const { return tasks_->graph().status(task); }

  TempFolder folder_;
  std::optional<Session> session_;
  std::int64_t id_ = 0;
  std::optional<CampaignTasks> tasks_;
  TouchList touches_;
};

TEST_F(TaskChainTest, RunsWhatIsNeededFirstAndWhatHoldsNotAgain) {
  EXPECT_THAT(run("fit"), ElementsAre("evaluate", "fit"));
  EXPECT_THAT(run("fit"), IsEmpty());
  EXPECT_THAT(kindsStored(), ElementsAre("evaluate", "fit"));
  exclude(3);
  EXPECT_EQ(status("fit").state, TaskState::Outdated);
  EXPECT_THAT(run("fit"), ElementsAre("evaluate", "fit"));
  EXPECT_THAT(run("fit"), IsEmpty());
  EXPECT_TRUE(status("evaluate").current);
  EXPECT_TRUE(status("fit").current);
  EXPECT_THAT(kindsStored(), ElementsAre("evaluate", "fit", "evaluate", "fit"));
  // The fit is that of the evaluation that was made for it.
  const auto evaluation = session_->latestResult(id_, "evaluate"), fit = session_->latestResult(id_, "fit");
  EXPECT_EQ(fit->provenance.inputs.at("evaluate"), evaluation->provenance.inputs_fingerprint);
  session_->setSetting(campaignKey(option_keys::cycles, id_), {{"second_axis", true}});
  EXPECT_THAT(run("fit"), ElementsAre("fit")) << "its options are no business of the evaluation";
}

TEST_F(TaskChainTest, ACompensationAndAReportHaveWhatTheyNeed) {
  EXPECT_THAT(run("compensation"), ElementsAre("evaluate", "fit", "compensation"));
  EXPECT_THAT(run("report"), ElementsAre("report"));
  EXPECT_THAT(run("report"), IsEmpty());
  EXPECT_TRUE(status("report").current);
}

/// The report would otherwise tell numbers that are neither shown nor stored.
TEST_F(TaskChainTest, AReportRunsTheFitFirstThatItTells) {
  run("fit");
  EXPECT_THAT(run("report"), ElementsAre("report"));
  session_->setSetting(campaignKey(option_keys::cycles, id_), {{"second_axis", true}});
  EXPECT_EQ(status("report").state, TaskState::Outdated) << "it tells a fit that does not hold any more";
  EXPECT_THAT(run("report"), ElementsAre("fit", "report"));
  exclude(3);
  EXPECT_THAT(run("report"), ElementsAre("evaluate", "fit", "report"));
  EXPECT_TRUE(status("fit").current);
  EXPECT_TRUE(status("report").current);
}

TEST_F(TaskChainTest, AFailureEndsItWithItsReason) {
  const std::filesystem::path list = std::filesystem::path(session_->campaign(id_).folder) / "captures/touches.csv";
  const std::string whole = readFile(list);
  writeFileAtomically(list, "time_s,cycle\n0,C1\n");
  std::string reason;
  try {
    (void)run("fit");
    FAIL() << "the list lacks its columns";
  } catch (const InputError& e) {
    reason = e.what();
  }
  EXPECT_THAT(reason, HasSubstr("touches.csv"));
  EXPECT_EQ(status("evaluate").state, TaskState::Failed);
  EXPECT_EQ(status("evaluate").reason, reason);
  EXPECT_THAT(kindsStored(), IsEmpty());
  writeFileAtomically(list, whole);
  EXPECT_THAT(run("fit"), ElementsAre("evaluate", "fit"));
}

TEST_F(TaskChainTest, AChangeAsTheFitStartsIsNotTakenForWhatItWasMadeFrom) {
  AtStart exclusion("fit", [&] { exclude(5); });
  JobContext job({}, &exclusion);
  EXPECT_THAT(tasks_->run("fit", job), ElementsAre("evaluate", "fit"));
  EXPECT_THAT(status("fit").changed, ElementsAre("the evaluation is outdated"));
  EXPECT_THAT(run("fit"), ElementsAre("evaluate", "fit"));
  EXPECT_TRUE(status("fit").current);
}

TEST_F(TaskChainTest, TheOrderFollowsTheTasksAsTheyAreNow) {
  TaskChain chain("fit");
  EXPECT_EQ(chain.next(tasks_->graph()), "evaluate");
  EXPECT_THROW((void)chain.next(tasks_->graph()), InputError) << "nothing was kept, and nothing has changed";
  TaskChain other("fit");
  EXPECT_EQ(other.next(tasks_->graph()), "evaluate");
  exclude(2);
  EXPECT_EQ(other.next(tasks_->graph()), "evaluate") << "of other inputs than before";
  run("fit");
  EXPECT_EQ(TaskChain("fit").next(tasks_->graph()), std::nullopt);
  TaskChain anew("fit", true);
  EXPECT_EQ(anew.next(tasks_->graph()), "fit");
  EXPECT_EQ(anew.next(tasks_->graph()), std::nullopt);
}

TEST_F(TaskChainTest, CancelledAsOne) {
  std::stop_source stop;
  AtStart cancel("fit", [&] { stop.request_stop(); });
  JobContext job(stop.get_token(), &cancel);
  EXPECT_THROW((void)tasks_->run("fit", job), Cancelled);
  EXPECT_THAT(kindsStored(), ElementsAre("evaluate")) << "what was worked out is kept";
  EXPECT_FALSE(tasks_->ledger().running(id_, "fit"));
  EXPECT_THAT(run("fit"), ElementsAre("fit"));
}

TEST_F(TaskChainTest, WhatIsOutdatedIsRunAndNothingThatNeverWas) {
  JobContext job;
  std::vector<std::string> failures;
  EXPECT_THAT(tasks_->runOutdated(job, failures), IsEmpty()) << "nothing has been run";
  run("fit");
  run("report");
  EXPECT_THAT(tasks_->runOutdated(job, failures), IsEmpty());
  exclude(3);
  EXPECT_THAT(tasks_->runOutdated(job, failures), ElementsAre("evaluate", "fit", "report"));
  EXPECT_THAT(tasks_->runOutdated(job, failures), IsEmpty());
  EXPECT_THAT(kindsStored(), ElementsAre("evaluate", "fit", "report", "evaluate", "fit", "report"));
  for (const char* task : {"evaluate", "fit", "report"}) EXPECT_TRUE(status(task).current) << task;
  session_->setSetting(campaignKey(option_keys::cycles, id_), {{"second_axis", true}});
  EXPECT_THAT(tasks_->runOutdated(job, failures), ElementsAre("fit", "report")) << "it tells the model";
  EXPECT_THAT(failures, IsEmpty());
}

TEST_F(TaskChainTest, WhatFailsLeavesOutdatedWhatIsMadeFromItAndEndsNothingElse) {
  JobContext job;
  std::vector<std::string> failures;
  run("check");
  run("fit");
  exclude(3);
  const std::filesystem::path list = std::filesystem::path(session_->campaign(id_).folder) / "captures/touches.csv";
  const std::string whole = readFile(list);
  bool broken = false;
  AtStart breaks("evaluate", [&] {
    writeFileAtomically(list, "time_s,cycle\n0,C1\n");
    broken = true;
  });
  JobContext breaking({}, &breaks);
  EXPECT_THAT(tasks_->runOutdated(breaking, failures), ElementsAre("check"));
  EXPECT_TRUE(broken);
  ASSERT_EQ(failures.size(), 1U) << "the fit is not tried";
  EXPECT_THAT(failures.front(), HasSubstr("evaluate failed"));
  EXPECT_THAT(failures.front(), HasSubstr("touches.csv"));
  EXPECT_EQ(status("evaluate").state, TaskState::Failed);
  EXPECT_EQ(status("fit").state, TaskState::Outdated);
  writeFileAtomically(list, whole);
  failures.clear();
  EXPECT_THAT(tasks_->runOutdated(job, failures), ElementsAre("evaluate", "fit")) << "asked for again";
  EXPECT_THAT(failures, IsEmpty());
}

TEST_F(TaskChainTest, WhatIsBlockedIsSaid) {
  EXPECT_THAT(tasks_->graph().whyNot("discrepancy"), HasSubstr("without a simulation"));
  EXPECT_EQ(tasks_->graph().whyNot("fit"), "");
  EXPECT_THROW((void)run("discrepancy"), InputError);
  EXPECT_THROW((void)run("verify"), InputError) << "no second campaign was chosen";
}

TEST_F(TaskChainTest, TheCheckCountsTouchesByTheNamesThatStepsKnow) {
  run("check");
  const nlohmann::json counts = session_->latestResult(id_, "check")->payload.at("touches");
  std::size_t all = 0;
  for (const auto& [name, number] : counts.items()) {
    EXPECT_THAT((std::vector<std::string>{"plausible", "rejected", "excluded", "missing"}), ::testing::Contains(name));
    all += number.get<std::size_t>();
  }
  EXPECT_GE(all, touches_.touches.size());
}

/// A campaign with observations, a log and a simulation of its own: nothing is evaluated first.
TEST(TaskChain, OfObservationsRunsSearchModelCompensationAndReport) {
  const TempFolder folder;
  writeCampaign(simulateCampaign(Scenario::read(spindrift::testing::sourceFolder() / "resources" / "scenarios" /
                                                "discrepancy_vertical.json"),
                                 std::nullopt, JobContext()),
                folder / "c");
  Session session = Session::create(folder / "s");
  JobContext job;
  const std::int64_t id = session.importCampaign(folder / "c", job);
  CampaignTasks tasks(session, CampaignState::read(session, id));
  EXPECT_THAT(tasks.run("discrepancy", job), ElementsAre("discrepancy"));
  EXPECT_THAT(tasks.run("discrepancy", job), IsEmpty());
  EXPECT_THAT(tasks.run("thermal", job), ElementsAre("thermal"));
  EXPECT_THAT(tasks.run("compensation", job), ElementsAre("fit", "compensation"));
  EXPECT_THAT(tasks.run("report", job), ElementsAre("report"));
  for (const char* task : {"fit", "thermal", "discrepancy", "compensation", "report"})
    EXPECT_TRUE(tasks.graph().status(task).current) << task;
}

/// Two states of one fiducial on a machine that knows its resolution; Y is off by more than that.
TEST(TaskChain, ChecksOfTheInstrumentAreTasks) {
  const TempFolder folder;
  folder.write("c/campaign.json",
               R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})");
  folder.write("c/machine.json", R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
    "axes":[{"name":"X","travel_mm":[0,300],"resolution_um":1},{"name":"Y","travel_mm":[0,300],"resolution_um":1},
            {"name":"Z","travel_mm":[0,300],"resolution_um":1}]})");
  ObservationSet set;
  for (int state = 0; state < 2; ++state) {
    for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
      Observation o;
      o.time_s = 60.0 * state;
      o.state = state == 0 ? "M0" : "M1";
      o.point = "F1";
      o.component = c;
      o.value = state == 0 ? 0.0 : c == Component::EY ? 3.0 : 0.7;
      o.sigma = 0.1;
      o.instrument = "microscope";
      set.rows.push_back(o);
    }
  }
  set.write(folder / "c/observations.csv");
  Session session = Session::create(folder / "s");
  JobContext job;
  const std::int64_t id = session.importCampaign(folder / "c", job);
  CampaignTasks tasks(session, CampaignState::read(session, id));
  EXPECT_EQ(tasks.graph().status("check-jogs").state, TaskState::NotRun);
  EXPECT_THAT(tasks.run("check-jogs", job), ElementsAre("check-jogs"));
  EXPECT_THAT(tasks.run("check-jogs", job), IsEmpty());
  EXPECT_THAT(tasks.run("check-repeatability", job), ElementsAre("check-repeatability"));
  const auto jogs = session.latestResult(id, "check-jogs"), cold = session.latestResult(id, "check-repeatability");
  EXPECT_EQ(jogs->provenance.options, nlohmann::json({{"part", 1.0}}));
  EXPECT_EQ(cold->provenance.options, nlohmann::json({{"part", 0.5}}));
  const ResolutionCheck stored = resolutionCheckFrom(jogs->payload);
  EXPECT_FALSE(stored.passed);
  ASSERT_EQ(stored.axes.size(), 3U);
  EXPECT_TRUE(stored.axes[0].passed) << "0.7 of 1 µm";
  EXPECT_FALSE(stored.axes[1].passed);
  EXPECT_DOUBLE_EQ(stored.axes[1].largest_um, 3.0);
  EXPECT_EQ(stored.axes[1].largest_at, "F1 in state M1");
  EXPECT_FALSE(resolutionCheckFrom(cold->payload).axes[0].passed) << "0.7 of 0.5 µm";
  // An exclusion makes both outdated; they are run together.
  session.exclude(id, "M1/F1/EY", "read wrongly");
  EXPECT_THAT(tasks.graph().status("check-jogs").changed, ElementsAre("1 exclusion more"));
  std::vector<std::string> failures;
  EXPECT_THAT(tasks.runOutdated(job, failures), ElementsAre("check-jogs", "check-repeatability"));
  EXPECT_TRUE(session.latestResult(id, "check-jogs")->payload.at("passed").get<bool>());
  EXPECT_THROW((void)resolutionCheckFrom({{"passed", true}}), InputError);
}

}  // namespace
}  // namespace spindrift
