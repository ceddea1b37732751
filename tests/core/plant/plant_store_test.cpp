// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/plant/plant_store.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "core/plant/plant_connection.h"
#include "core/plant/plant_schema.h"
#include "tests/core/plant/both_stores.h"
#include "tests/support/child_process.h"
#include "tests/support/refusal.h"

namespace spindrift {
namespace {

using ::spindrift::testing::inChildProcess;
using ::spindrift::testing::OnBothStores;
using ::spindrift::testing::onDay;
using ::spindrift::testing::refusal;
using ::spindrift::testing::TempFolder;
using ::spindrift::testing::TemporaryPostgres;
using ::spindrift::testing::weeklyCampaign;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class PlantStoreTest : public OnBothStores {};
INSTANTIATE_TEST_SUITE_P(On, PlantStoreTest, ::testing::Values("sqlite", "postgresql"), testing::storeName);

TEST_P(PlantStoreTest, GivesBackExactlyWhatWasPublished) {
  PlantStore store = make();
  EXPECT_EQ(store.role(), PlantRole::Owner);
  PlantCampaign campaign = weeklyCampaign("mill 'A' with ü", 1, 1.0 / 3.0, 1e-17);
  campaign.results[0].model = {{"format", "spindrift-error-model"}, {"effects", nlohmann::json::array()}};
  campaign.results[0].options = {{"points", {"F1"}}, {"gain", 0.1}};
  const PublishCount count = store.publish(std::span(&campaign, 1));
  EXPECT_EQ(count.campaigns_new, 1U);
  EXPECT_EQ(count.results_new, 1U);
  ASSERT_EQ(store.campaigns().size(), 1U);
  EXPECT_EQ(store.campaign(store.campaigns()[0].id).json(), campaign.json()) << "bit for bit";
  EXPECT_EQ(store.campaigns()[0].verdict, "converged");
  const auto model = store.newestModel(campaign.machine);
  ASSERT_TRUE(model);
  EXPECT_EQ(model->model, campaign.results[0].model);
  EXPECT_THAT(refusal([&] { (void)store.campaign(99); }), HasSubstr("holds no campaign 99"));
  EXPECT_THAT(refusal([&] { (void)store.campaigns("lathe"); }), HasSubstr("allowed: mill 'A' with ü"));
}

TEST_P(PlantStoreTest, PublishingAgainByAnybodyAddsNothing) {
  PlantStore store = make();
  PlantCampaign campaign = weeklyCampaign("mill", 1);
  (void)store.publish(std::span(&campaign, 1));
  PlantCampaign of_ben = campaign;
  of_ben.publisher = "ben@office";
  of_ben.results[0].created_utc = "2026-02-01T09:00:00Z";
  const PublishCount again = store.publish(std::span(&of_ben, 1));
  EXPECT_EQ(again.campaigns_new, 0U);
  EXPECT_EQ(again.campaigns_there, 1U);
  EXPECT_EQ(again.results_new, 0U);
  EXPECT_EQ(again.results_there, 1U);
  // Worked out again with another outcome: a second result of the same campaign, and the trend takes the newer one.
  of_ben.results[0].parameters[0].value = 5.0;
  EXPECT_EQ(store.publish(std::span(&of_ben, 1)).results_new, 1U);
  const auto trend = store.trend("mill", "fit", "EZ_um");
  ASSERT_EQ(trend.size(), 1U);
  EXPECT_EQ(trend[0].value, 5.0);
}

TEST_P(PlantStoreTest, WhatIsPublishedHoldsAlsoWhereItWasThereBefore) {
  // A reading was left out and is taken back in: what was found first is true again.
  PlantStore store = make();
  PlantCampaign first = weeklyCampaign("mill", 1, 1.0);
  first.results[0].verdict = "named";
  first.results[0].model = {{"effects", 1}};
  PlantCampaign without = first;
  without.results[0].parameters[0].value = 5.0;
  without.results[0].verdict = "none";
  without.results[0].model = {{"effects", 2}};
  const auto value = [&] { return store.trend("mill", "fit", "EZ_um").at(0).value; };
  EXPECT_EQ(store.publish(std::span(&first, 1)).results_again, 0U);
  EXPECT_EQ(store.publish(std::span(&without, 1)).results_again, 0U);
  EXPECT_EQ(value(), 5.0);
  EXPECT_EQ(store.machine("mill").last_verdict, "none");
  const PublishCount again = store.publish(std::span(&first, 1));
  EXPECT_EQ(again.results_new, 0U);
  EXPECT_EQ(again.results_again, 1U);
  EXPECT_EQ(value(), 1.0);
  EXPECT_EQ(store.machine("mill").last_verdict, "named");
  EXPECT_EQ(store.campaigns("mill").at(0).verdict, "named");
  EXPECT_EQ(store.newestModel("mill")->model, first.results[0].model);
  EXPECT_EQ(store.publish(std::span(&first, 1)).results_again, 0U) << "it holds already";
  // Of the same kind without a model and a verdict: that of earlier ones is no longer true.
  PlantCampaign rejected = first;
  rejected.results[0].verdict.clear();
  rejected.results[0].model = nullptr;
  (void)store.publish(std::span(&rejected, 1));
  EXPECT_EQ(store.machine("mill").last_verdict, "");
  EXPECT_FALSE(store.newestModel("mill"));
  EXPECT_EQ(store.campaign(store.campaigns("mill").at(0).id).results.size(), 3U);
}

TEST_P(PlantStoreTest, TwoPeopleAtTheSameMomentMakeNoDuplicates) {
  (void)make();
  PublishCount total;
  std::mutex mutex;
  std::vector<std::thread> people;
  for (int person = 0; person < 4; ++person) {
    people.emplace_back([&] {
      PlantStore store = PlantStore::open(address());
      for (int week = 0; week < 20; ++week) {
        const PlantCampaign campaign = weeklyCampaign("mill", week);
        const PublishCount count = store.publish(std::span(&campaign, 1));
        const std::scoped_lock lock(mutex);
        total += count;
      }
    });
  }
  for (std::thread& t : people) t.join();
  EXPECT_EQ(total.campaigns_new, 20U);
  EXPECT_EQ(total.campaigns_there, 60U);
  EXPECT_EQ(total.results_new, 20U);
  EXPECT_EQ(PlantStore::open(address()).campaigns().size(), 20U);
}

TEST_P(PlantStoreTest, PublishesAllOrNothing) {
  PlantStore store = make();
  std::vector<PlantCampaign> campaigns{weeklyCampaign("mill", 1), weeklyCampaign("mill", 2)};
  campaigns[1].start_s = 4e9;
  EXPECT_THAT(refusal([&] { (void)store.publish(campaigns); }), HasSubstr("after the clock of the plant store"));
  EXPECT_THAT(store.campaigns(), IsEmpty());
}

TEST_P(PlantStoreTest, ListsMachinesEventsAndTrends) {
  PlantStore store = make();
  std::vector<PlantCampaign> campaigns;
  for (int week = 9; week >= 0; --week) campaigns.push_back(weeklyCampaign("mill", week, week));
  campaigns.push_back(weeklyCampaign("lathe", 3));
  (void)store.publish(campaigns);
  store.setInterval("mill", 7.0);
  store.addEvent({"mill", onDay(-340.0), "spindle_changed", "SN 12", "anna"});
  store.addEvent({"mill", onDay(-340.0), "spindle_changed", "SN 12", "ben"});
  EXPECT_EQ(store.events("mill").size(), 1U) << "the same event twice is one";
  EXPECT_THAT(refusal([&] {
                store.addEvent({"mill", 0.0, "exploded", "", ""});
              }),
              HasSubstr("allowed: spindle_changed"));
  const auto machines = store.machines();
  ASSERT_EQ(machines.size(), 2U);
  EXPECT_EQ(machines[0].name, "lathe");
  EXPECT_EQ(machines[1].campaigns, 10U);
  EXPECT_EQ(machines[1].every_days, 7.0);
  EXPECT_EQ(machines[1].last_s, onDay(7.0 * 9 - 365.0));
  EXPECT_EQ(machines[1].last_verdict, "converged");
  std::vector<double> values;
  for (const TrendPoint& p : store.trend("mill", "fit", "EZ_um")) values.push_back(p.value);
  EXPECT_THAT(values, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9)) << "in order of time, however published";
  EXPECT_THAT(store.trend("mill", "fit", "EZ_um", "M7"), IsEmpty());
  ASSERT_EQ(store.trendNames("mill").size(), 2U);
  EXPECT_EQ(store.trendNames("mill")[1].name, "EZ_um");
  EXPECT_EQ(store.trendNames("mill")[1].values, 10U);
}

TEST_P(PlantStoreTest, ReaderLooksWriterPublishesOwnerMakes) {
  (void)make();
  PlantStore writer = open(PlantRole::Writer);
  EXPECT_EQ(writer.role(), PlantRole::Writer);
  const PlantCampaign campaign = weeklyCampaign("mill", 1);
  (void)writer.publish(std::span(&campaign, 1));
  writer.addEvent({"mill", onDay(1.0), "repair", "", ""});
  PlantStore reader = open(PlantRole::Reader);
  EXPECT_EQ(reader.role(), PlantRole::Reader);
  EXPECT_EQ(reader.campaigns().size(), 1U);
  EXPECT_THAT(refusal([&] { (void)reader.publish(std::span(&campaign, 1)); }),
              HasSubstr("the role here is reader, and publishing needs a writer"));
  // The lock is behind the program as well.
  EXPECT_THAT(refusal([&] {
                reader.connection().writing([&] { (void)0; });
                PlantConnection& c = reader.connection();
                c.guarded([&] { c.execute("insert into machine (name, description) values ('x', '{}')"); });
              }),
              ::testing::AnyOf(HasSubstr("can only be read"), HasSubstr("may not do that")));
}

TEST_P(PlantStoreTest, SaysInOneSentenceWhatIsWrongWithTheSchema) {
  EXPECT_THAT(refusal([&] { (void)PlantStore::open(address()); }),
              ::testing::AnyOf(HasSubstr("is not there"), HasSubstr("holds no plant store")));
  (void)make();
  sql("update plant_schema set version = 99");
  EXPECT_THAT(refusal([&] { (void)PlantStore::open(address()); }),
              HasSubstr("has schema version 99; allowed: 1 to 3. A newer program has changed it"));
  EXPECT_THAT(refusal([&] { (void)make(); }), HasSubstr("schema version 99"));
}

TEST_P(PlantStoreTest, BringsAnOlderStoreToThisVersionAndKeepsWhatIsInIt) {
  PlantStore store = make();
  PlantCampaign campaign = weeklyCampaign("mill", 1);
  campaign.results[0].model = {{"effects", 1}};
  (void)store.publish(std::span(&campaign, 1));
  // As version 1 left it.
  sql("drop table standing; create index result_verdicts on result (campaign_id, id, verdict); "
      "drop table item_result; drop table attempt; drop table chunk; drop table batch; update plant_schema set version "
      "= 1");
  EXPECT_THAT(refusal([&] { (void)PlantStore::open(address()); }), HasSubstr("older than this program's 3"));
  PlantStore newer = make();
  EXPECT_EQ(newer.campaigns().size(), 1U);
  EXPECT_EQ(newer.trend("mill", "fit", "EZ_um").size(), 1U);
  EXPECT_TRUE(newer.newestModel("mill"));
  EXPECT_EQ(newer.publish(std::span(&campaign, 1)).results_again, 0U);
  sql("select count(*) from item_result");
}

TEST_P(PlantStoreTest, TwoOwnersMakeItAtOnce) {
  std::vector<std::thread> owners;
  std::atomic<int> made{0};
  for (int i = 0; i < 4; ++i)
    owners.emplace_back([&] {
      (void)make();
      ++made;
    });
  for (std::thread& t : owners) t.join();
  EXPECT_EQ(made, 4);
  EXPECT_THAT(open(PlantRole::Owner).machines(), IsEmpty());
}

TEST_P(PlantStoreTest, SaysThatTheClocksDiffer) {
  {
    PlantStore store = make();
    EXPECT_THAT(store.warnings(), IsEmpty());
    const PlantCampaign campaign = weeklyCampaign("mill", 1);
    (void)store.publish(std::span(&campaign, 1));
  }
  PlantStore store = PlantStore::open(address(), {.clock = [] { return systemNow() - 3600.0; }});
  ASSERT_EQ(store.warnings().size(), 1U);
  EXPECT_THAT(store.warnings()[0], HasSubstr("The clock of this computer is 36"));
  EXPECT_THAT(store.warnings()[0], HasSubstr("behind that of the plant store"));
  EXPECT_NEAR(store.clockOffset(), -3600.0, 30.0);
}

TEST(PlantStoreOnSqlite, SaysThatItCanOnlyBeRead) {
  const TempFolder folder;
  const PlantAddress address = PlantAddress::parse((folder / "plant.sqlite").string());
  (void)PlantStore::make(address);
  ::chmod(folder.path().c_str(), 0755);
  ::chmod(address.file.c_str(), 0444);
  const std::string said = inChildProcess([&]() -> std::string {
    if (::geteuid() == 0 && ::setuid(65534) != 0) return "cannot change the user";
    return refusal([&] {
      PlantStore store = PlantStore::open(address);
      const PlantCampaign campaign = weeklyCampaign("mill", 1);
      (void)store.publish(std::span(&campaign, 1));
    });
  });
  EXPECT_THAT(said, HasSubstr("the role here is reader"));
}

TEST(PlantStoreOnSqlite, SaysThatAFileIsNoPlantStore) {
  const TempFolder folder;
  const auto file = folder.write("plant.sqlite", std::string(5000, 'x'));
  EXPECT_THAT(refusal([&] { (void)PlantStore::open(PlantAddress::parse(file.string())); }),
              HasSubstr("is not a plant store"));
  const auto empty = folder.write("empty.sqlite", "");
  EXPECT_THAT(refusal([&] { (void)PlantStore::open(PlantAddress::parse(empty.string())); }),
              HasSubstr("holds no plant store"));
}

TEST(PlantAddressTest, RefusesPasswordsAndServersThatNobodyChecks) {
  EXPECT_THAT(refusal([] { (void)PlantAddress::parse("postgresql:host=db dbname=plant password=secret"); }),
              HasSubstr("holds a password"));
  EXPECT_THAT(refusal([] { (void)PlantAddress::parse("postgresql://me:secret@db/plant"); }), HasSubstr("is a URL"));
  EXPECT_THAT(refusal([] { (void)PlantAddress::parse("postgresql:host=db dbname=plant sslmode=require"); }),
              HasSubstr("does not check who the server is"));
  EXPECT_THAT(refusal([] { (void)PlantAddress::parse(""); }), HasSubstr("No plant store is named"));
  EXPECT_THAT(PlantAddress::parse("postgresql:host=db dbname=plant").connect, HasSubstr("sslmode=verify-full"));
  EXPECT_THAT(PlantAddress::parse("postgresql:host=/run/s dbname=plant").connect, Not(HasSubstr("sslmode")));
  EXPECT_EQ(PlantAddress::parse("/a/b.sqlite").file, "/a/b.sqlite");
}

class PlantServer : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = TemporaryPostgres::missing(); !why.empty()) GTEST_SKIP() << why;
  }
};

TEST_F(PlantServer, UnreachableIsOneSentence) {
  const std::string said =
      refusal([] { (void)PlantStore::open(PlantAddress::parse("postgresql:host=/nowhere dbname=plant user=me")); });
  EXPECT_THAT(said, HasSubstr("the plant store cannot be reached"));
  EXPECT_THAT(said, Not(HasSubstr("\n")));
}

TEST_F(PlantServer, RoleWithoutRightsIsOneSentence) {
  TemporaryPostgres& server = TemporaryPostgres::shared();
  const std::string database = server.freshDatabase();
  (void)PlantStore::make(PlantAddress::parse(server.address(database, "owner")));
  const std::string said =
      refusal([&] { (void)PlantStore::open(PlantAddress::parse(server.address(database, "nobody_one"))); });
  EXPECT_THAT(said, HasSubstr("holds no plant store, or none that this role may see"));
  EXPECT_THAT(said, Not(HasSubstr("\n")));
  EXPECT_THAT(refusal([&] {
                (void)PlantStore::make(PlantAddress::parse(server.address(server.freshDatabase(), "reader_one")));
              }),
              HasSubstr("may not do that in the plant store"));
}

TEST_F(PlantServer, ReadOnlyServerIsOneSentence) {
  TemporaryPostgres& server = TemporaryPostgres::shared();
  const std::string database = server.freshDatabase();
  const PlantAddress address = PlantAddress::parse(server.address(database, "owner"));
  (void)PlantStore::make(address);
  server.sql(database, "alter role owner in database " + database + " set default_transaction_read_only = on");
  PlantStore store = PlantStore::open(address);
  const PlantCampaign campaign = weeklyCampaign("mill", 1);
  EXPECT_THAT(refusal([&] { (void)store.publish(std::span(&campaign, 1)); }), HasSubstr("can only be read here"));
}

TEST_F(PlantServer, WriterCannotChangeWhatWasPublished) {
  TemporaryPostgres& server = TemporaryPostgres::shared();
  const std::string database = server.freshDatabase();
  (void)PlantStore::make(PlantAddress::parse(server.address(database, "owner")));
  PlantStore store = PlantStore::open(PlantAddress::parse(server.address(database, "writer_one")));
  const PlantCampaign campaign = weeklyCampaign("mill", 1);
  (void)store.publish(std::span(&campaign, 1));
  PlantConnection& c = store.connection();
  for (const char* statement : {"update parameter set value = 0", "delete from campaign", "drop table result",
                                "update plant_schema set version = 1", "create table plant.mine (i int)"})
    EXPECT_THAT(refusal([&] { c.guarded([&] { c.execute(statement); }); }), HasSubstr("may not do that")) << statement;
}

TEST_F(PlantServer, TlsChecksWhoTheServerIs) {
  TemporaryPostgres& server = TemporaryPostgres::shared();
  const std::string database = server.freshDatabase();
  (void)PlantStore::make(PlantAddress::parse(server.address(database, "owner")));
  const TempFolder folder;
  const auto passwords = folder.write("pass", "*:*:*:reader_one:of the reader\n");
  ::chmod(passwords.c_str(), 0600);
  ::setenv("PGPASSFILE", passwords.c_str(), 1);
  const auto at = [&](const std::string& rest) {
    return PlantAddress::parse(fmt::format("postgresql:hostaddr=127.0.0.1 port={} dbname={} user=reader_one {}",
                                           server.port(), database, rest));
  };
  const std::string trusted = "sslmode=verify-full sslrootcert=" + server.certificate();
  EXPECT_EQ(PlantStore::open(at("host=localhost " + trusted)).role(), PlantRole::Reader);
  EXPECT_THAT(refusal([&] { (void)PlantStore::open(at("host=other.plant " + trusted)); }),
              HasSubstr("does not match host name"));
  EXPECT_THAT(refusal([&] { (void)PlantStore::open(at("host=localhost sslmode=disable")); }),
              HasSubstr("cannot be reached"));
  ::unsetenv("PGPASSFILE");
}

}  // namespace
}  // namespace spindrift
