// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plant/publish.h"

#include <gmock/gmock.h>

#include "core/simulation/virtual_campaign.h"
#include "tests/core/plant/both_stores.h"
#include "tests/support/refusal.h"
#include "tests/support/session_steps.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

using ::spindrift::testing::addResult;
using ::spindrift::testing::OnBothStores;
using ::spindrift::testing::refusal;
using ::spindrift::testing::TempFolder;
using ::spindrift::testing::TemporaryPostgres;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class PublishTest : public OnBothStores {
 protected:
  /// A session with one campaign and a fit of it.
  [[nodiscard]] Session session(const std::string& name) const {
    Session s = Session::create(folder_ / name);
    const std::int64_t id = s.newCampaign("warm-up", "2026-01-31T08:00:00Z",
                                          R"({"format":"spindrift-machine","version":1,"name":"mill",
                                              "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]}]})");
    folder_.write(name + "/campaigns/warm-up/captures/images/0.jpg", "0");
    s.addCaptureRows(id, "fiducials.csv", "time_s,image", {"0,captures/images/0.jpg"});
    addResult(s, id, "fit", {{"points", {"F1"}}},
              {{"status", "converged"},
               {"state", "M1"},
               {"parameters",
                {{"EX_um", {{"value", 1.5}, {"standard_uncertainty", 0.2}}},
                 {"EY_um", {{"value", nullptr}, {"standard_uncertainty", nullptr}}}}},
               {"parameter_order", {"EX_um", "EY_um"}},
               {"covariance", {{0.04, nullptr}, {nullptr, nullptr}}}});
    addResult(s, id, "report", {}, {{"file", "a.html"}});
    return s;
  }
};
INSTANTIATE_TEST_SUITE_P(On, PublishTest, ::testing::Values("sqlite", "postgresql"), testing::storeName);

TEST_P(PublishTest, TheResultThatHoldsIsPublished) {
  (void)make();
  Session s = session("a");
  folder_.write("a/campaigns/warm-up/observations.csv",
                "time_s,state,point,x_mm,y_mm,z_mm,component,value,sigma\n"
                "0,M0,F1,0,0,0,EX,0,0.2\n60,M1,F1,0,0,0,EX,1.5,0.2\n60,M1,F2,100,0,0,EX,1.5,0.2\n");
  const auto fit = [&s](double ex_um) {
    const CampaignState state = CampaignState::read(s, 1);
    const TaskLedger nothing_runs;
    ASSERT_TRUE(s.keepResult(state.tasks(s, nothing_runs).origin("fit"),
                             {{"status", "converged"},
                              {"state", "M1"},
                              {"parameters", {{"EX_um", {{"value", ex_um}, {"standard_uncertainty", 0.2}}}}}})
                    .has_value());
  };
  fit(1.5);
  s.exclude(1, "M1/F2/EX", "disturbed");
  fit(9.0);
  s.restore(1, "M1/F2/EX");  // so that the first of them holds again
  const PublishOutcome outcome = publishFromSession(s, {1}, address());
  EXPECT_EQ(outcome.count.results_new, 1U);
  EXPECT_THAT(outcome.warnings, ::testing::IsEmpty());
  {
    PlantStore store = PlantStore::open(address());
    const PlantCampaign c = store.campaign(store.campaigns("mill").at(0).id);
    ASSERT_EQ(c.results.at(0).parameters.size(), 1U);
    EXPECT_EQ(c.results[0].parameters[0].value, 1.5);
  }
  s.exclude(1, "M1/F1/EX", "disturbed");  // now neither holds: the newest is published, and said to be outdated
  EXPECT_THAT(
      publishFromSession(s, {1}, address()).warnings,
      ::testing::ElementsAre(::testing::AllOf(HasSubstr("Published although it is outdated: the fitted model of "),
                                              HasSubstr("Changed since: 1 exclusion more, 1 taken back."))));
}

TEST_P(PublishTest, SessionPublishesWhatItKnowsOfTheMachine) {
  (void)make();
  Session s = session("a");
  const PublishOutcome outcome = publishFromSession(s, {1}, address());
  EXPECT_EQ(outcome.count.campaigns_new, 1U);
  EXPECT_EQ(outcome.count.results_new, 1U) << "a report says nothing about the machine";
  EXPECT_EQ(outcome.waiting, 0U);
  PlantStore store = PlantStore::open(address());
  const PlantCampaign c = store.campaign(store.campaigns("mill").at(0).id);
  EXPECT_EQ(c.fingerprint, s.campaign(1).fingerprint);
  ASSERT_EQ(c.results[0].parameters.size(), 1U) << "what has no value has no trend";
  EXPECT_EQ(c.results[0].parameters[0].name, "EX_um");
  EXPECT_EQ(c.results[0].parameters[0].state, "M1");
  EXPECT_EQ(c.results[0].parameters[0].standard_uncertainty, 0.2);
  EXPECT_EQ(c.results[0].verdict, "converged");
  EXPECT_EQ(c.results[0].covariance.at("matrix").at(0).at(0), 0.04);
  ASSERT_EQ(c.captures.size(), 2U);
  EXPECT_THAT(c.captures[1].address, HasSubstr("captures/images/0.jpg"));
  EXPECT_EQ(c.captures[1].sha256.size(), 64U);
  // The same campaign in the session of somebody else, and again in this one.
  Session other = session("b");
  EXPECT_EQ(publishFromSession(other, {1}, address()).count.campaigns_new, 0U);
  EXPECT_EQ(publishFromSession(s, {1}, address()).count.results_new, 0U);
  EXPECT_EQ(PlantStore::open(address()).campaigns().size(), 1U);
}

/// Also one that an earlier program has stored as 0 ± 0.
TEST_P(PublishTest, ARejectedFitIsPublishedAsRejectedAndWithoutParameters) {
  (void)make();
  Session s = session("a");
  addResult(s, 1, "fit", {{"points", {"F1", "F2"}}},
            {{"status", "rejected"},
             {"state", "M1"},
             {"parameters", {{"EX_um", {{"value", 0.0}, {"standard_uncertainty", 0.0}}}}},
             {"parameter_order", {"EX_um"}},
             {"covariance", {{0.0}}}});
  (void)publishFromSession(s, {1}, address());
  PlantStore store = PlantStore::open(address());
  const PlantCampaign c = store.campaign(store.campaigns("mill").at(0).id);
  ASSERT_EQ(c.results.size(), 1U);
  EXPECT_EQ(c.results[0].verdict, "rejected");
  EXPECT_THAT(c.results[0].parameters, IsEmpty());
  EXPECT_THAT(store.trend("mill", "fit", "EX_um"), IsEmpty());
}

TEST_P(PublishTest, WaitsWhileTheStoreIsAwayAndArrivesOnce) {
  (void)make();
  const auto away = folder_ / "plant.sqlite.away";
  const auto goAway = [&] {
    if (onServer())
      TemporaryPostgres::shared().stop();
    else
      std::filesystem::rename(text(), away);
  };
  const auto comeBack = [&] {
    if (onServer())
      TemporaryPostgres::shared().start();
    else
      std::filesystem::rename(away, text());
  };
  goAway();
  // A file that is away is not made anew where the folder is a share that is not mounted: opened, not made.
  {
    Session s = session("a");
    PlantAddress there = address();
    if (!onServer()) std::filesystem::create_directories(folder_ / "plant.sqlite");
    const PublishOutcome outcome = publishFromSession(s, {1}, there);
    EXPECT_EQ(outcome.waiting, 1U);
    EXPECT_THAT(outcome.reason, HasSubstr("cannot be"));
    EXPECT_EQ(publishFromSession(s, {1}, there).waiting, 1U) << "the same twice waits once";
    if (!onServer()) std::filesystem::remove_all(folder_ / "plant.sqlite");
  }
  comeBack();
  Session s = Session::open(folder_ / "a");
  ASSERT_EQ(waitingFor(s, address().text()).size(), 1U) << "survives the end of the program";
  const PublishOutcome outcome = publishFromSession(s, {}, address());
  EXPECT_EQ(outcome.count.campaigns_new, 1U);
  EXPECT_THAT(waitingFor(s, address().text()), IsEmpty());
  const PublishOutcome again = publishFromSession(s, {}, address());
  EXPECT_EQ(again.count.campaigns_new + again.count.campaigns_there, 0U);
  EXPECT_EQ(PlantStore::open(address()).campaigns().size(), 1U);
}

TEST_P(PublishTest, CampaignFolderIsEvaluatedAndPublished) {
  Scenario scenario =
      Scenario::read(spindrift::testing::sourceFolder().string() + "/resources/scenarios/hole_bar.json");
  const std::filesystem::path folder = folder_ / "campaign";
  writeCampaign(simulateCampaign(scenario, 3, JobContext()), folder);
  JobContext job;
  const PlantCampaign c = plantCampaign(folder, job);
  ASSERT_FALSE(c.results.empty());
  EXPECT_GT(c.results[0].parameters.size(), 5U);
  PlantStore store = make();
  EXPECT_EQ(store.publish(std::span(&c, 1)).campaigns_new, 1U);
  EXPECT_THAT(store.trend(c.machine, c.results[0].kind, c.results[0].parameters[0].name), ::testing::SizeIs(1));
}

}  // namespace
}  // namespace spindrift
