// SPDX-License-Identifier: GPL-3.0-or-later
// `session`: what the desktop program shows as its steps, on the command line.
#include <gmock/gmock.h>

#include "core/base/atomic_file.h"
#include "core/base/job_context.h"
#include "core/session/session.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/session_steps.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

nlohmann::json stepOf(const nlohmann::json& answer, const std::string& name) {
  for (const nlohmann::json& step : answer.at("campaigns").at(0).at("steps"))
    if (step.at("step") == name) return step;
  return {};
}

TEST(SessionCommand, SaysHowFarEveryStepIsAndWhatChanged) {
  const TempFolder folder;
  const std::string place = (folder / "s").string();
  {
    Session session = Session::create(place);
    const auto id = session.newCampaign("c", "2026-01-31T08:00:00Z",
                                        R"({"format":"spindrift-machine","version":1,"name":"mill",
                                            "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]}]})");
    addCapture(session, id, "fiducials.csv", "time_s,image", "0,captures/a.jpg", folder.write("a.jpg", "a"),
               "captures/a.jpg");
    addResult(session, id, "check", nlohmann::json::object(),
              {{"captures", {{{"image", "captures/a.jpg"}, {"good", false}}}}});
    addResult(session, id, "evaluate", nlohmann::json::object(), {{"json", nlohmann::json::object()}});
  }
  // Captures are evaluated otherwise than by the first revision, which counted none.
  nlohmann::json answer = jsonOf({"session", place});
  EXPECT_EQ(stepOf(answer, "Calibrate").at("state"), "outdated");
  EXPECT_EQ(stepOf(answer, "Calibrate").at("changed"), nlohmann::json({"the version of the program"}));
  {
    Session session = Session::open(place);
    const auto id = session.campaigns().front().id;
    ResultOrigin origin{id, "evaluate", nlohmann::json::object(), session.inputs(id)};
    origin.inputs["revision"] = 2;
    ASSERT_TRUE(session.keepResult(origin, {{"json", nlohmann::json::object()}}).has_value());
  }
  answer = jsonOf({"session", place});
  EXPECT_EQ(stepOf(answer, "Capture").at("state"), "attention");
  EXPECT_EQ(stepOf(answer, "Capture").at("count"), 1);
  EXPECT_EQ(stepOf(answer, "Calibrate").at("state"), "done");
  EXPECT_EQ(stepOf(answer, "Model").at("state"), "not started");
  EXPECT_EQ(stepOf(answer, "Discrepancy").at("state"), "blocked");
  // Another program changes a capture.
  (void)folder.write("s/campaigns/c/captures/a.jpg", "b");
  const Outcome said = runCli({"session", place});
  EXPECT_EQ(said.status, 0);
  EXPECT_THAT(said.error, HasSubstr("captures/a.jpg has another content"));
  answer = jsonOf({"session", place});
  EXPECT_EQ(stepOf(answer, "Calibrate").at("state"), "outdated");
  EXPECT_EQ(stepOf(answer, "Calibrate").at("changed"), nlohmann::json({"files of the campaign"}));
  {
    // The machine as it was edited in the window is the one that is judged.
    Session session = Session::open(place);
    const auto id = session.campaigns().front().id;
    session.setSetting(Session::machineKey(id),
                       nlohmann::json::parse(R"({"format":"spindrift-machine","version":1,"name":"edited",
                           "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,400]}],
                           "points":[{"id":"P1","kind":"fiducial","x_mm":900,"y_mm":0,"z_mm":0}]})"));
  }
  answer = jsonOf({"session", place});
  EXPECT_EQ(stepOf(answer, "Machine").at("state"), "attention") << stepOf(answer, "Machine");
  EXPECT_THAT(stepOf(answer, "Machine").at("sentence").get<std::string>(), HasSubstr("P1"));
  expectBadInput({"session", place, "--campaign", "none"}, {"no campaign \"none\""});
  expectBadInput({"session", folder.path().string()}, {"is not a session"});
}

/// A campaign of six points that move by `growth_um` in EX between its two states.
std::string pointsFolder(const TempFolder& folder, const std::string& name, double growth_um, double on) {
  (void)folder.write(name + "/campaign.json", R"({"format":"spindrift-campaign","version":1,"name":")" + name +
                                                  R"(","start_utc":"2026-03-01T08:00:00Z"})");
  (void)folder.write(name + "/machine.json", R"({"format":"spindrift-machine","version":1,"name":"mill",
      "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,300]},
                                          {"name":"Z","travel_mm":[0,300]}]})");
  (void)folder.write(name + "/log.csv",
                     "time_s,compensation_on\n0," + std::to_string(on) + "\n7200," + std::to_string(on) + "\n");
  std::string rows = "time_s,state,point,x_mm,y_mm,z_mm,component,value,sigma,use\n";
  for (int state = 0; state < 2; ++state)
    for (int p = 0; p < 6; ++p)
      rows += std::to_string(3600 * state + 10 * p) + ",M" + std::to_string(state) + ",P" + std::to_string(p) + "," +
              std::to_string(40 * p) + "," + std::to_string(30 * (p % 3)) + ",0,EX," +
              std::to_string(growth_um * state + 0.01 * p * (state + 1)) + ",0.3,fit\n";
  (void)folder.write(name + "/observations.csv", rows);
  return (folder / name).string();
}

TEST(SessionCommand, ResultsThatRestOnAnotherCampaignAreOutdatedWithItsFiles) {
  // The files of the second campaign were read after the first one had been judged: the first call said "done", and a
  // report of it had the old figures.
  const TempFolder folder;
  const std::string place = (folder / "s").string();
  JobContext job;
  {
    Session session = Session::create(place);
    const auto before = session.importCampaign(pointsFolder(folder, "before", 30.0, 0.0), job);
    (void)session.importCampaign(pointsFolder(folder, "after", 1.0, 1.0), job);
    session.setSetting("verify/" + std::to_string(before), {{"after", "campaigns/after"}});
  }
  EXPECT_EQ(jsonOf({"session", place, "--campaign", "before", "--run", "verify"}).at("ran"),
            nlohmann::json({"verify"}));
  EXPECT_EQ(stepOf(jsonOf({"session", place, "--campaign", "before"}), "Verify").at("state"), "done");
  (void)pointsFolder(folder, "s/campaigns/after", 20.0, 1.0);
  const nlohmann::json step = stepOf(jsonOf({"session", place, "--campaign", "before"}), "Verify");
  EXPECT_EQ(step.at("state"), "outdated") << step;
  // What is run at once is of the files as they are, and holds.
  (void)pointsFolder(folder, "s/campaigns/after", 10.0, 1.0);
  EXPECT_EQ(jsonOf({"session", place, "--campaign", "before", "--run", "verify"}).at("ran"),
            nlohmann::json({"verify"}));
  EXPECT_EQ(stepOf(jsonOf({"session", place, "--campaign", "before"}), "Verify").at("state"), "attention")
      << "10 um are left, and that is current";
}

/// evaluate and report on a session ask what the window asks: what holds is taken, what is made is kept.
TEST(SessionCommand, EvaluateAndReportShareTheTasksOfTheWindow) {
  const TempFolder folder;
  const std::string campaign = (folder / "c").string(), place = (folder / "s").string();
  ASSERT_EQ(
      runCli({"simulate", sourceFolder().string() + "/resources/scenarios/hole_bar.json", "--out", campaign}).status,
      0);
  {
    JobContext job;
    const std::string file = campaign + "/machine.json";
    nlohmann::json machine = nlohmann::json::parse(textOf(file));
    for (nlohmann::json& axis : machine.at("axes")) axis["resolution_um"] = 1.0;
    writeFileAtomically(file, machine.dump());
    Session session = Session::create(place);
    const auto id = session.importCampaign(campaign, job);
    session.exclude(id, "M0/none/EX", "to be told in the report");
  }
  EXPECT_EQ(stepOf(jsonOf({"session", place}), "Calibrate").at("state"), "not started");
  const std::string out = (folder / "o.csv").string();
  const Outcome first = runCli({"evaluate", place, "--out", out});
  EXPECT_LE(first.status, 1) << first.error;
  EXPECT_THAT(first.output, ::testing::Not(HasSubstr("still current")));
  const std::string observations = textOf(out);
  EXPECT_EQ(stepOf(jsonOf({"session", place}), "Calibrate").at("task"), "evaluate");
  EXPECT_THAT(runCli({"evaluate", place, "--out", out}).output, HasSubstr("still current"));
  EXPECT_EQ(textOf(out), observations);
  const std::string html = (folder / "r.html").string(), pdf = (folder / "r.pdf").string();
  EXPECT_EQ(runCli({"report", place, "--out", html}).status, 0);
  EXPECT_THAT(textOf(html), HasSubstr("to be told in the report"));
  EXPECT_EQ(stepOf(jsonOf({"session", place}), "Report").at("state"), "done");
  EXPECT_EQ(runCli({"report", place, "--out", pdf}).status, 0);
  EXPECT_THAT(textOf(pdf), ::testing::StartsWith("%PDF-"));
  {
    Session session = Session::open(place);
    const auto kept = session.latestResult(session.campaigns().front().id, "report");
    ASSERT_TRUE(kept);
    EXPECT_EQ(textOf(place + "/" + kept->payload.at("pdf").get<std::string>()), textOf(pdf));
    session.exclude(session.campaigns().front().id, "M1/none/EX", "another");
  }
  EXPECT_EQ(stepOf(jsonOf({"session", place}), "Report").at("state"), "outdated");
  // What is needed first is run first, and nothing twice.
  EXPECT_EQ(jsonOf({"session", place, "--run", "fit"}).at("ran"), nlohmann::json({"evaluate", "fit"}));
  EXPECT_EQ(jsonOf({"session", place, "--run", "fit"}).at("ran"), nlohmann::json::array());
  EXPECT_EQ(stepOf(jsonOf({"session", place, "--run", "report"}), "Report").at("state"), "done");
  EXPECT_TRUE(stepOf(jsonOf({"session", place}), "Model").at("changed").empty());
  expectBadInput({"session", place, "--run", "discrepancy"}, {"without a simulation"});
  expectBadInput({"session", place, "--run", "lunch"}, {"--run"});
  // Everything that is outdated, as one.
  EXPECT_EQ(jsonOf({"session", place, "--run", "outdated"}).at("ran"), nlohmann::json::array());
  {
    Session session = Session::open(place);
    session.exclude(session.campaigns().front().id, "M2/none/EX", "one more");
  }
  EXPECT_EQ(jsonOf({"session", place, "--run", "outdated"}).at("ran"), nlohmann::json({"evaluate", "fit", "report"}));
  EXPECT_EQ(stepOf(jsonOf({"session", place}), "Report").at("state"), "done");
  // Checks of the instrument are kept like everything else; command and step say the same of the warm-up.
  const Outcome warm = runCli({"warm-up", place});
  EXPECT_LE(warm.status, 1) << warm.error;
  EXPECT_THAT(runCli({"warm-up", place}).output, HasSubstr("still current"));
  const nlohmann::json answer = stepOf(jsonOf({"session", place}), "Warm-up");
  EXPECT_EQ(answer.at("task"), "check-warm-up");
  EXPECT_THAT(warm.output, HasSubstr(answer.at("sentence").get<std::string>().substr(0, 20)));
  expectBadInput({"warm-up", place, "--limit", "3"}, {"is a session"});
  const Outcome jogs = runCli({"validate-jogs", place});
  EXPECT_LE(jogs.status, 1) << jogs.error;
  EXPECT_THAT(jogs.output, ::testing::Not(HasSubstr("still current")));
  EXPECT_THAT(runCli({"validate-jogs", place}).output, HasSubstr("still current"));
  {
    Session session = Session::open(place);
    EXPECT_TRUE(session.latestResult(session.campaigns().front().id, "check-jogs"));
  }
  expectBadInput({"repeatability", place, "--observations", out}, {"is a session"});
  expectBadInput({"evaluate", place, "--exclude", "a"}, {"is a session"});
  expectBadInput({"report", place, "--campaign", "none", "--out", html}, {"no campaign \"none\""});
  expectBadInput({"report", place, "--out", (folder / "r.txt").string()}, {".html or .pdf"});
}

}  // namespace
}  // namespace spindrift::testing
