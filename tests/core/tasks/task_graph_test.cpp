// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/tasks/task_graph.h"

#include <gmock/gmock.h>

#include <set>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/reporting/report_language.h"
#include "core/tasks/report_task.h"
#include "core/tasks/task_work.h"
#include "tests/core/tasks/tasks_support.h"

namespace spindrift {
namespace {

using ::spindrift::testing::TaskSession;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(TaskGraph, WhatIsNeededRunsFirstAndWhatHoldsIsNotRunAgain) {
  TaskSession s;
  EXPECT_EQ(s.status("evaluate").state, TaskState::NotRun);
  EXPECT_EQ(s.status("fit").state, TaskState::Blocked);
  EXPECT_THAT(s.status("fit").reason, HasSubstr("Evaluate the captures first"));
  EXPECT_THAT(s.graph().needed("fit"), ElementsAre("evaluate", "fit"));
  s.run("evaluate");
  EXPECT_THAT(s.graph().needed("fit"), ElementsAre("fit"));
  s.run("fit");
  EXPECT_THAT(s.graph().needed("fit"), IsEmpty());
  EXPECT_THAT(s.graph().needed("compensation"), ElementsAre("compensation"));
  s.session_.exclude(s.id_, "captures/images/0.jpg", "blurred");
  EXPECT_THAT(s.graph().needed("fit"), ElementsAre("evaluate", "fit"));
  EXPECT_THROW((void)s.graph().needed("discrepancy"), InputError) << "there is no simulation";
}

TEST(TaskGraph, AnInputThatAnEarlierVersionDidNotKnowHasNotChangedWhileThereIsNone) {
  TaskSession s;
  s.run("evaluate");
  ResultOrigin origin = s.graph().origin("report");
  ASSERT_EQ(origin.inputs.at("check-warm-up"), "");
  origin.inputs.erase("check-warm-up");
  s.session_.keepResult(origin, nlohmann::json::object());
  EXPECT_TRUE(s.status("report").current);
  s.run("check-warm-up", {{"status", "converged"}, {"settled", true}, {"reason", "Settled."}});
  EXPECT_THAT(s.status("report").changed, ElementsAre("the check of the warm-up"));
}

TEST(TaskGraph, AResultIsOutdatedByWhatItWasMadeFromAndSaysByWhat) {
  TaskSession s;
  s.run("evaluate");
  s.run("fit");
  ASSERT_TRUE(s.status("fit").current);
  const auto changedBy = [&](auto change, auto back) {
    change();
    const TaskStatus status = s.status("fit");
    EXPECT_EQ(status.state, TaskState::Outdated);
    back();
    EXPECT_EQ(s.status("fit").state, TaskState::Current) << "taken back";
    return status.changed.empty() ? std::string() : status.changed.front();
  };
  EXPECT_EQ(changedBy([&] { s.session_.exclude(s.id_, "a", "x"); }, [&] { s.session_.restore(s.id_, "a"); }),
            "1 exclusion more");
  EXPECT_EQ(changedBy(
                [&] {
                  s.option("nine-parameter", {{"robust", 1}});
                },
                [&] { s.option("nine-parameter", nlohmann::json::object()); }),
            "the options");
  EXPECT_EQ(changedBy(
                [&] {
                  s.session_.setSetting(Session::machineKey(s.id_), {{"name", "other"}});
                },
                [&] { s.session_.setSetting(Session::machineKey(s.id_), nlohmann::json::object()); }),
            "the machine");
  EXPECT_TRUE(s.status("evaluate").current) << "options of a fit are no business of the evaluation";
  s.capture(1);
  EXPECT_THAT(s.status("evaluate").changed, ElementsAre("files of the campaign"));
}

// The one that comparing each result with the files alone cannot see.
TEST(TaskGraph, AFitOfAnOldEvaluationStaysOutdatedWhenTheCapturesAreEvaluatedAgain) {
  TaskSession s;
  s.run("evaluate");
  s.session_.exclude(s.id_, "captures/images/0.jpg", "blurred");
  s.run("fit");  // of the observations that are there: those of the old evaluation
  TaskStatus fit = s.status("fit");
  EXPECT_EQ(fit.state, TaskState::Outdated);
  EXPECT_THAT(fit.changed, ElementsAre("the evaluation is outdated"));
  s.run("evaluate");
  fit = s.status("fit");
  EXPECT_EQ(fit.state, TaskState::Outdated) << "it was made from the other evaluation";
  EXPECT_THAT(fit.changed, ElementsAre("the evaluation"));
  s.run("fit");
  EXPECT_TRUE(s.status("fit").current);
  s.run("evaluate");  // the same once more
  EXPECT_TRUE(s.status("fit").current);
}

// Begun with other options that were taken back meanwhile: it is stored, and what holds is shown.
TEST(TaskGraph, WorkThatEndsLaterTakesNothingAwayFromAResultThatHolds) {
  TaskSession s;
  s.run("evaluate");
  s.run("fit", {{"of", "first"}});
  s.option("nine-parameter", {{"robust", 1}});
  const ResultOrigin begun = s.graph().origin("fit");
  s.option("nine-parameter", nlohmann::json::object());
  s.session_.keepResult(begun, {{"of", "second"}});
  EXPECT_TRUE(s.status("fit").current);
  EXPECT_EQ(s.graph().latest("fit")->payload.at("of"), "first");
  s.run("compensation");
  s.option("nine-parameter", {{"robust", 1}});
  EXPECT_TRUE(s.status("fit").current) << "not run again for that";
  EXPECT_EQ(s.graph().latest("fit")->payload.at("of"), "second");
  EXPECT_EQ(s.session_.resultHeads(s.id_, "fit").size(), 2U) << "referred to, not copied";
  s.option("nine-parameter", {{"robust", 2}});
  EXPECT_FALSE(s.status("fit").current);
  EXPECT_EQ(s.graph().latest("fit")->payload.at("of"), "second") << "none holds: the newest";
}

TEST(TaskGraph, AnotherVersionOfTheProgramOutdatesWhatItCalculatesAnotherWayAlone) {
  TaskSession s;
  s.run("evaluate");
  s.run("fit");
  StoredResult fit = *s.graph().latest("fit");
  fit.provenance.program_version = "0.1.0";
  EXPECT_THAT(s.graph().changes(fit), IsEmpty());
  ASSERT_EQ(fit.provenance.inputs.at("revision"), taskKind("fit", s.graph().facts()).revision);
  fit.provenance.inputs["revision"] = taskKind("fit", s.graph().facts()).revision - 1;
  EXPECT_THAT(s.graph().changes(fit), ElementsAre("the version of the program"));
  fit.provenance.inputs.erase("revision");
  EXPECT_EQ(s.graph().changes(fit).empty(), taskKind("fit", s.graph().facts()).revision == 1)
      << "of versions that did not count";
}

TEST(TaskGraph, WhatWasWorkedOutNowIsComparedWithAStoredResultAsTheGraphComparesIt) {
  TaskSession s;
  s.run("evaluate");
  const ResultOrigin now = s.graph().origin("fit");
  ResultOrigin earlier = now;
  ASSERT_GT(earlier.options.size(), 1U);
  for (auto it = earlier.options.begin(); it != earlier.options.end();)
    it = it.key() == "model" ? std::next(it) : earlier.options.erase(it);
  s.session_.keepResult(earlier, nlohmann::json::object());
  ASSERT_TRUE(s.status("fit").current) << "an earlier version wrote less";
  EXPECT_THAT(s.graph().changes(*s.graph().latest("fit"), now), IsEmpty());
}

TEST(TaskGraph, ASearchWithASimulatorHoldsForThatSimulatorAndForTheVersionItWrote) {
  TaskSession s;
  s.run("evaluate");
  EXPECT_EQ(s.status("simulation").state, TaskState::Blocked);
  EXPECT_THAT(s.status("simulation").reason, HasSubstr("no simulator"));
  EXPECT_THAT(s.graph().tasks(), ::testing::Not(::testing::Contains("simulation")));
  s.folder_.write("s/sim/simulator.json", "one");
  s.option(option_keys::simulator, "sim/simulator.json");
  EXPECT_EQ(s.status("simulation").state, TaskState::NotRun);
  EXPECT_THAT(s.graph().tasks(), ::testing::Contains("simulation"));
  s.run("simulation");
  EXPECT_TRUE(s.status("simulation").current);
  s.option(option_keys::discrepancy, {{"added", {"spindle.growth.z"}}});
  EXPECT_TRUE(s.status("simulation").current) << "terms on top of the simulation are not searched among";
  s.option(option_keys::discrepancy, {{"rejected", {"spindle.growth.z"}}});
  EXPECT_THAT(s.status("simulation").changed, ElementsAre("the options"));
  s.option(option_keys::discrepancy, nullptr);
  s.folder_.write("s/sim/simulator.json", "another");
  EXPECT_THAT(s.status("simulation").changed, ElementsAre("the simulator"));
  s.folder_.write("s/sim/simulator.json", "one");
  EXPECT_TRUE(s.status("simulation").current);
  // What it names belongs to it.
  const std::string names_a_file = R"({"scenario": "scenario.json", "elsewhere": "../machine.json"})";
  s.folder_.write("s/sim/simulator.json", names_a_file);
  s.folder_.write("s/sim/scenario.json", "cold");
  const std::string before = simulatorFingerprint(s.folder_ / "s/sim/simulator.json");
  s.folder_.write("s/sim/scenario.json", "warm");
  EXPECT_NE(simulatorFingerprint(s.folder_ / "s/sim/simulator.json"), before);
  s.folder_.write("s/sim/simulator.json", "one");
  // It writes a new version, which is taken from then on.
  ResultOrigin origin = s.graph().origin("simulation");
  s.folder_.write("s/v2/simulator.json", "two");
  origin.options["version"] = "v2/simulator.json";
  origin.options["written"] = simulatorFingerprint(s.folder_ / "s/v2/simulator.json");
  s.session_.keepResult(origin, nlohmann::json::object());
  EXPECT_TRUE(s.status("simulation").current) << "of the one it was made from";
  s.option(option_keys::simulator, "v2/simulator.json");
  EXPECT_TRUE(s.status("simulation").current) << "of the one it wrote";
  s.folder_.write("s/v2/simulator.json", "edited");
  EXPECT_THAT(s.status("simulation").changed, ElementsAre("the simulator"));
  s.option(option_keys::simulator, "elsewhere/simulator.json");
  EXPECT_THAT(s.status("simulation").changed, ElementsAre("the simulator"));
}

TEST(TaskGraph, WhatChangesWhileTheWorkGoesOnMakesTheResultOutdated) {
  TaskSession s;
  const ResultOrigin started = s.graph().origin("evaluate");
  s.ledger_.started(started);
  EXPECT_EQ(s.status("evaluate").state, TaskState::Running);
  s.capture(1);
  s.session_.keepResult(started, 1);
  s.ledger_.ended(started);
  EXPECT_EQ(s.status("evaluate").state, TaskState::Outdated);
}

TEST(TaskLedger, KnowsOnWhatSomethingRuns) {
  TaskLedger ledger;
  const ResultOrigin plain{1, "evaluate", {}, {{"files", "a"}}};
  ResultOrigin other = plain;
  other.inputs["files"] = "b";
  ledger.started(plain);
  ledger.started(other);
  EXPECT_TRUE(ledger.running(plain));
  ledger.ended(plain);
  EXPECT_FALSE(ledger.running(plain));
  EXPECT_TRUE(ledger.running(other));
  EXPECT_TRUE(ledger.running(1, "evaluate"));
  ledger.failed(other, "why");
  EXPECT_FALSE(ledger.running(1, "evaluate"));
}

TEST(TaskGraph, AFailureHoldsForTheInputsItFailedWith) {
  TaskSession s;
  const ResultOrigin started = s.graph().origin("evaluate");
  s.ledger_.started(started);
  s.ledger_.failed(started, "no image can be read.");
  EXPECT_EQ(s.status("evaluate").state, TaskState::Failed);
  EXPECT_EQ(s.status("evaluate").reason, "no image can be read.");
  s.session_.exclude(s.id_, "captures/images/0.jpg", "blurred");
  EXPECT_EQ(s.status("evaluate").state, TaskState::NotRun);
  s.session_.restore(s.id_, "captures/images/0.jpg");
  EXPECT_EQ(s.status("evaluate").state, TaskState::Failed);
  s.run("evaluate");
  EXPECT_EQ(s.status("evaluate").state, TaskState::Current);
}

TEST(TaskGraph, AReportHasToBeWrittenAgainWhenItWouldTellAnotherResult) {
  TaskSession s;
  s.run("evaluate");
  s.run("report");
  EXPECT_TRUE(s.status("report").current);
  s.run("verify", {{"verdict", "met"}});
  EXPECT_THAT(s.status("report").changed, ElementsAre("the comparison of before and after"));
  s.run("report");
  EXPECT_TRUE(s.status("report").current);
  s.option(option_keys::warm_statement, {{"settled", true}, {"by", "operator"}});
  EXPECT_FALSE(s.status("report").current);
}

TEST(TaskGraph, AReportHasToBeWrittenAgainWhenWhatItPrintsIsOther) {
  TaskSession s;
  s.run("evaluate");
  s.session_.exclude(s.id_, "captures/images/0.jpg", "blurred");
  s.run("report");
  ASSERT_THAT(s.status("report").changed, ElementsAre("the evaluation is outdated"));
  s.session_.exclude(s.id_, "captures/images/0.jpg", "out of focus");
  EXPECT_THAT(s.status("report").changed, ::testing::Contains("reasons of exclusions"));
  s.session_.exclude(s.id_, "captures/images/0.jpg", "blurred");
  const std::int64_t note = s.session_.addNote(s.id_, "Capture", "the door was open");
  EXPECT_THAT(s.status("report").changed, ::testing::Contains("the notes"));
  s.session_.removeNote(note);
  s.option(option_keys::plan, {{"format", "spindrift-plan"}, {"version", 1}});
  EXPECT_THAT(s.status("report").changed, ::testing::Contains("the measurement plan"));
  s.option(option_keys::plan, nullptr);
  EXPECT_THAT(s.status("report").changed, ElementsAre("the evaluation is outdated"));
  s.run("evaluate");
  s.run("report");
  EXPECT_TRUE(s.status("report").current);
  EXPECT_TRUE(s.status("evaluate").current) << "notes, plan and reasons are no business of an evaluation";
}

TEST(TaskGraph, AReportIsMadeFromWhatIsStoredAndSaysWhatDoesNotHold) {
  TaskSession s;
  CampaignEvaluation evaluation;
  evaluation.instruments.emplace_back().instrument = "microscope";
  for (const char* point : {"F1", "F2"}) {
    Observation o;
    o.state = "M0";
    o.point = point;
    o.sigma = 0.5;
    evaluation.observations.rows.push_back(o);
  }
  s.run("evaluate", payloadOf(evaluation));
  s.run("verify", {{"verdict", "met"}, {"reason", "all is well."}});
  ReportTask task = ReportTask::of(s.graph(), {{"M0/F2/EX", "disturbed"}});
  ASSERT_TRUE(task.options.evaluated.has_value()) << "not evaluated again";
  EXPECT_EQ(task.options.evaluated->observations.rows[0].use, ObservationUse::Fit);
  EXPECT_EQ(task.options.evaluated->observations.rows[1].use, ObservationUse::Exclude) << "as the pages take it";
  EXPECT_THAT(task.options.stored.changed, IsEmpty());
  s.option(option_keys::verify, {{"goal_um", 7}});
  s.capture(1);
  task = ReportTask::of(s.graph(), {});
  EXPECT_FALSE(task.options.evaluated.has_value()) << "the captures are others";
  EXPECT_EQ(task.options.stored.verification.at("verdict"), "met") << "told all the same";
  EXPECT_EQ(task.options.stored.changed.at("verify"),
            "files of the campaign, the options and the evaluation is outdated");
}

/// A campaign of observations that begin at zero and end at `last_um`.
void writeCampaign(const testing::TempFolder& folder, const std::string& name, double last_um) {
  folder.write(name + "/campaign.json", R"({"format":"spindrift-campaign","version":1,"name":")" + name +
                                            R"(","start_utc":"2026-01-31T08:00:00Z"})");
  folder.write(name + "/machine.json",
               R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
                   "axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,300]},
                           {"name":"Z","travel_mm":[0,300]}]})");
  ObservationSet observations;
  for (const char* point : {"P1", "P2"})
    for (const double time_s : {0.0, 3600.0, 7200.0}) {
      Observation o;
      o.time_s = time_s;
      o.state = "M" + std::to_string(static_cast<int>(time_s / 3600.0));
      o.point = point;
      o.sigma = 0.1;
      o.value = last_um * time_s / 7200.0 + (point[1] == '2' ? 0.01 : 0.0);
      o.instrument = "probe";
      observations.rows.push_back(o);
    }
  observations.write(folder / name / "observations.csv");
}

/// The English report is the same whoever writes it; what a program offers beside it makes neither outdated.
TEST(ReportTask, WritesInTheLanguageThatTheProgramOffersToo) {
  const testing::TempFolder folder;
  writeCampaign(folder, "mill-7", 7.2);
  ReportTask task;
  task.campaign = std::make_shared<Campaign>(Campaign::read(folder / "mill-7"));
  task.folder = folder / "s";
  task.name = "reports/report-1";
  JobContext job;
  const auto file = [&](const std::string& name) { return readFile(task.folder / name); };
  const WrittenReport english = task.run(job);
  EXPECT_FALSE(english.json().contains("translations"));
  EXPECT_THAT(file(english.html), HasSubstr("<html lang=\"en\">"));
  offerReportLanguage(ReportLanguage{"de", [](const std::string& text) { return "<" + text + ">"; }});
  const WrittenReport both = task.run(job);
  offerReportLanguage({});
  const nlohmann::json german = both.json().at("translations").at("de");
  EXPECT_EQ(both.html, english.html);
  EXPECT_THAT(file(both.html), HasSubstr("<html lang=\"en\">"));
  EXPECT_THAT(file(german.at("file")), HasSubstr("<html lang=\"de\">"));
  EXPECT_THAT(file(german.at("file")), HasSubstr("&lt;Campaign&gt;"));
  EXPECT_TRUE(file(german.at("pdf")).starts_with("%PDF-"));
  EXPECT_TRUE(file(both.pdf).starts_with("%PDF-"));
}

TEST(TaskGraph, TheSecondCampaignOfAVerificationIsAnInput) {
  TaskSession s;
  s.run("evaluate");
  const auto other = s.session_.newCampaign("after", "2026-01-31T08:00:00Z",
                                            R"({"format":"spindrift-machine","version":1,"name":"mill",
                                                "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]}]})");
  const auto again = [&] {
    s.run("verify");
    return s.status("verify").current;
  };
  // As it was kept by earlier versions, and as it is now.
  for (const std::string& name :
       {s.session_.campaign(other).folder.string(), placeName(s.session_, s.session_.campaign(other).folder)}) {
    s.option(option_keys::verify, {{"after", name}});
    ASSERT_TRUE(again()) << name;
    s.session_.exclude(other, "M1/F1/EX", "somebody leant on the machine " + name);
    EXPECT_THAT(s.status("verify").changed, ElementsAre("the second campaign"));
    ASSERT_TRUE(again());
    s.session_.restore(other, "M1/F1/EX");
    s.session_.setSetting(Session::clocksKey(other), {{"touch_probe_s", name.size()}});
    EXPECT_THAT(s.status("verify").changed, ElementsAre("the second campaign"));
    ASSERT_TRUE(again());
  }
  EXPECT_TRUE(std::filesystem::path(placeName(s.session_, s.session_.campaign(other).folder)).is_relative())
      << "a session may be moved";
  s.session_.addCaptureRows(other, "touches.csv", "time_s", {"1"});
  EXPECT_THAT(s.status("verify").changed, ElementsAre("the second campaign"));
}

/// A search may go back to an earlier result; a report cannot: its file is that of the last one.
TEST(TaskGraph, WhatIsWrittenOverAnEarlierOneDoesNotComeBack) {
  TaskSession s;
  s.run("evaluate");
  s.option(option_keys::operator_name, "A");
  s.run("fit");
  s.run("report");
  ASSERT_TRUE(s.status("report").current);
  s.option(option_keys::operator_name, "B");
  s.option(option_keys::nine_parameters, {{"state", "M2"}});
  s.run("fit");
  s.run("report");
  ASSERT_TRUE(s.status("report").current);
  s.option(option_keys::operator_name, "A");
  s.option(option_keys::nine_parameters, nullptr);
  EXPECT_TRUE(s.status("fit").current) << "the earlier model holds again";
  EXPECT_FALSE(s.status("report").current) << "its file says B";
}

TEST(TaskGraph, ASecondCampaignElsewhereIsAnInputToo) {
  TaskSession s;
  s.run("evaluate");
  s.folder_.write("elsewhere/observations.csv", "one\n");
  s.option(option_keys::verify, {{"after", (s.folder_ / "elsewhere").string()}});
  s.run("verify");
  EXPECT_TRUE(s.status("verify").current);
  s.folder_.write("elsewhere/observations.csv", "corrected\n");
  EXPECT_THAT(s.status("verify").changed, ElementsAre("the second campaign"));
  s.run("verify");
  ASSERT_TRUE(s.status("verify").current);
  s.folder_.write("elsewhere/captures/images/M1.png", "another image");
  EXPECT_THAT(s.status("verify").changed, ElementsAre("the second campaign"));
}

// Both sides of a verification are what the user sees of them.
TEST(TaskGraph, TheSecondCampaignIsComparedWithoutWhatTheUserTookOutOfIt) {
  const testing::TempFolder folder;
  JobContext job;
  Session session = Session::create(folder / "s");
  std::vector<std::int64_t> ids;
  for (const auto& [name, last_um] : {std::pair("before", 5.0), std::pair("after", 1.0)}) {
    writeCampaign(folder, name, last_um);
    ids.push_back(session.importCampaign(folder / name, job));
  }
  session.setSetting(campaignKey(option_keys::verify, ids[0]),
                     {{"after", placeName(session, session.campaign(ids[1]).folder)}, {"goal_um", 3.0}});
  const auto verified = [&] {
    const CampaignState state = CampaignState::read(session, ids[0]);
    const TaskLedger ledger;
    const TaskWork work =
        prepareTask("verify", state.tasks(session, ledger), TaskInputs::of(state.tasks(session, ledger), state));
    return work(job, TaskOutput::Payload).payload;
  };
  const nlohmann::json all = verified();
  EXPECT_EQ(all.at("verdict"), "met");
  EXPECT_EQ(all.at("points").size(), 4U);
  session.exclude(ids[1], "M2/P2/EX", "somebody leant on the machine");
  EXPECT_EQ(verified().at("points").size(), 3U);
}

TEST(TaskGraph, WorkGoesOnWithTheEffectsItWasBegunWith) {
  TaskSession s;
  const auto campaign = std::make_shared<const Campaign>(s.graph().data());
  const std::filesystem::path file = EffectOptions::file(s.session_, s.id_);
  EffectOptions first, second;
  first.effects = {{"name", "first"}};
  second.effects = {{"name", "second"}};
  auto begun = first.applied(campaign, file);
  const auto later = second.applied(campaign, file);
  EXPECT_THAT(readFile(begun->effects), HasSubstr("first"));
  EXPECT_THAT(readFile(later->effects), HasSubstr("second"));
  EXPECT_EQ(first.applied(campaign, file)->effects, begun->effects);
  EXPECT_EQ(EffectOptions().applied(campaign, file), campaign);
  // They go with the work, and with them what a program that crashed has left of the same campaign.
  const std::filesystem::path of_begun = begun->effects;
  auto again = first.applied(campaign, file);
  begun.reset();
  EXPECT_THAT(readFile(of_begun), HasSubstr("first")) << "somebody else still works with them";
  again.reset();
  EXPECT_FALSE(std::filesystem::exists(of_begun));
  const std::filesystem::path folder = file.parent_path();
  const std::string stem = file.stem().string();
  const std::filesystem::path abandoned = folder / (stem + "-0123456789abcdef.json");
  const std::filesystem::path others = folder / (stem + "0-0123456789abcdef.json");
  for (const auto& left : {abandoned, others, folder / "mine.json"}) writeFileAtomically(left, "{}");
  again = first.applied(campaign, file);
  EXPECT_FALSE(std::filesystem::exists(abandoned));
  EXPECT_TRUE(std::filesystem::exists(others)) << "another campaign's";
  EXPECT_TRUE(std::filesystem::exists(folder / "mine.json"));
  EXPECT_THAT(readFile(again->effects), HasSubstr("first"));
  EXPECT_THAT(readFile(later->effects), HasSubstr("second")) << "still being worked with";
}

TEST(TaskGraph, AResultThatDoesNotSayWhatItWasMadeFromIsNotTakenForCurrent) {
  TaskSession s;
  ResultOrigin origin = s.graph().origin("evaluate");
  origin.inputs = nlohmann::json::object();  // as sessions of earlier versions hold it
  s.session_.keepResult(origin, 1);
  EXPECT_EQ(s.status("evaluate").state, TaskState::Outdated);
  EXPECT_THAT(s.status("evaluate").changed, ElementsAre(HasSubstr("not known")));
}

TEST(TaskGraph, EveryTaskIsDeclaredOnceWithItsWorkAndWhatItMayDo) {
  TaskSession s;
  TaskInputs inputs;
  inputs.campaign = std::make_shared<const Campaign>(s.graph().data());
  std::vector<std::string> ids, starting;
  for (const TaskKind& kind : taskKinds()) {
    if (ids.empty() || ids.back() != kind.id) ids.emplace_back(kind.id);
    EXPECT_FALSE(kind.title.empty()) << kind.id;
    EXPECT_TRUE(kind.belongs != nullptr && kind.options != nullptr && kind.options_of != nullptr) << kind.id;
    if (kind.starts_programs) starting.emplace_back(kind.id);
    try {
      (void)prepareTask(std::string(kind.id), s.graph(), inputs);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), Not(HasSubstr("no task of a campaign"))) << kind.id;
    }
  }
  for (const std::string& task : s.graph().tasks()) EXPECT_NE(taskKind(task), nullptr) << task;
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  EXPECT_THAT(starting, ElementsAre("simulation")) << "simulator.json names programs";
  EXPECT_EQ(taskKind("coffee"), nullptr);
}

}  // namespace
}  // namespace spindrift
