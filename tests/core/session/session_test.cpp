// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/session/session.h"

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/session/fingerprint.h"
#include "tests/support/session_steps.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::spindrift::testing::addCapture;
using ::spindrift::testing::addResult;
using ::spindrift::testing::TempFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* machine_json =
    R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
        "axes":[{"name":"X","travel_mm":[0,300]}]})";

std::filesystem::path writeCampaign(const TempFolder& folder, const std::string& name) {
  folder.write(name + "/campaign.json",
               R"({"format":"spindrift-campaign","version":1,"name":"warm-up 1","start_utc":"2026-01-31T08:00:00Z"})");
  folder.write(name + "/machine.json", machine_json);
  folder.write(name + "/captures/images/a.jpg", "not really an image");
  return folder / name;
}

TEST(Session, ReopensWithEverythingThatWasPutIn) {
  const TempFolder folder;
  const auto source = writeCampaign(folder, "source");
  const std::string before = fingerprintOfFolder(source);
  JobContext job;
  std::int64_t campaign = 0;
  {
    Session session = Session::create(folder / "a session with blanks");
    campaign = session.importCampaign(source, job);
    session.exclude(campaign, "captures/images/a.jpg", "blurred");
    session.addNote(campaign, "Capture", "door was open", "captures/images/a.jpg");
    session.setSetting("theme", "dark");
    addResult(session, campaign, "fit", {{"points", {"F1", "F2"}}}, {{"rms_um", 1.25}});
  }
  Session session = Session::open(folder / "a session with blanks");
  ASSERT_EQ(session.campaigns().size(), 1U);
  EXPECT_EQ(session.campaigns()[0].name, "warm-up 1");
  EXPECT_EQ(Campaign::read(session.campaigns()[0].folder).machine.name, "mill");
  ASSERT_EQ(session.exclusions(campaign).size(), 1U);
  EXPECT_EQ(session.exclusions(campaign)[0].reason, "blurred");
  ASSERT_EQ(session.notes(campaign).size(), 1U);
  EXPECT_EQ(session.notes(campaign)[0].text, "door was open");
  EXPECT_EQ(session.notes(campaign)[0].item, "captures/images/a.jpg");
  EXPECT_EQ(session.setting("theme"), nlohmann::json("dark"));
  const auto result = session.latestResult(campaign, "fit");
  ASSERT_TRUE(result);
  EXPECT_EQ(result->payload.at("rms_um"), 1.25);
  EXPECT_EQ(result->provenance.program_version, SPINDRIFT_VERSION);
  EXPECT_TRUE(session.isCurrent(*result));
  EXPECT_EQ(fingerprintOfFolder(source), before) << "an import must not touch its source";
}

TEST(Session, ResultTurnsOutdatedWhenAnExclusionChangesAndCurrentAgainWhenItIsTakenBack) {
  const TempFolder folder;
  JobContext job;
  Session session = Session::create(folder / "s");
  const auto campaign = session.importCampaign(writeCampaign(folder, "source"), job);
  addResult(session, campaign, "fit", nlohmann::json::object(), {{"x", 1}});
  const auto result = session.latestResult(campaign, "fit").value();
  EXPECT_TRUE(session.isCurrent(result));
  session.exclude(campaign, "captures/images/a.jpg", "blurred");
  EXPECT_FALSE(session.isCurrent(result));
  session.restore(campaign, "captures/images/a.jpg");
  EXPECT_TRUE(session.isCurrent(result));
}

TEST(Session, SameContentIsImportedOnce) {
  const TempFolder folder;
  JobContext job;
  Session session = Session::create(folder / "s");
  const auto first = session.importCampaign(writeCampaign(folder, "one"), job);
  EXPECT_EQ(session.importCampaign(writeCampaign(folder, "two"), job), first);
  EXPECT_EQ(session.campaigns().size(), 1U);
}

TEST(Session, SecondProcessIsRefusedPolitely) {
  const TempFolder folder;
  const auto place = folder / "s";
  Session session = Session::create(place);
  const pid_t child = fork();
  if (child == 0) {
    try {
      (void)Session::open(place);
      _exit(1);
    } catch (const InputError& error) {
      const std::string text = error.what();
      _exit(text.find("another window") != std::string::npos && text.find("process") != std::string::npos ? 0 : 2);
    } catch (...) {
      _exit(3);
    }
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Session, KilledProcessLeavesASessionThatOpens) {
  const TempFolder folder;
  const auto place = folder / "s";
  const auto source = writeCampaign(folder, "source");
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    JobContext job;
    Session session = Session::create(place);
    const auto id = session.importCampaign(source, job);
    addCapture(session, id, "fiducials.csv", "time_s,image", "0,captures/b.jpg", source / "captures/images/a.jpg",
               "captures/b.jpg");
    if (write(ready[1], "x", 1) != 1) _exit(1);
    for (int i = 0;; ++i) session.setSetting("counter", i);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  Session session = Session::open(place);
  ASSERT_EQ(session.campaigns().size(), 1U);
  EXPECT_EQ(readFile(session.campaigns()[0].folder / "captures/fiducials.csv"), "time_s,image\n0,captures/b.jpg\n");
  EXPECT_EQ(readFile(session.campaigns()[0].folder / "captures/b.jpg"), "not really an image");
}

TEST(Session, OrderlyEndIsToldFromACrash) {
  const TempFolder folder;
  {
    const Session session = Session::create(folder / "s");
    EXPECT_FALSE(Session::wasLeftOpen(folder / "s")) << "somebody works on it";
  }
  EXPECT_FALSE(Session::wasLeftOpen(folder / "s"));
  EXPECT_TRUE(Session::open(folder / "s").recoveryMessages().empty());
  folder.write("s/lock", "process 1 on a machine without power");
  EXPECT_TRUE(Session::wasLeftOpen(folder / "s"));
  EXPECT_EQ(Session::open(folder / "s").recoveryMessages().size(), 1U);
}

TEST(Session, WhatACrashCutShortIsPutInOrder) {
  const TempFolder folder;
  { (void)Session::create(folder / "s").newCampaign("c", "2026-01-31T08:00:00Z", machine_json); }
  folder.write("s/lock", "process 1 on a machine without power");
  folder.write("s/campaigns/.importing-d/machine.json", "{");
  folder.write("s/campaigns/c/captures/.a.jpg.1.2.part", "half");
  folder.write("s/campaigns/without_row/machine.json", "{}");
  const Session session = Session::open(folder / "s");
  EXPECT_THAT(session.recoveryMessages(), ElementsAre(HasSubstr("2 unfinished files were removed")));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/campaigns/.importing-d"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/campaigns/c/captures/.a.jpg.1.2.part"));
  EXPECT_TRUE(std::filesystem::exists(folder / "s/removed/without_row/machine.json"));
}

TEST(Session, ACaptureThatIsPutBackCounts) {
  const TempFolder folder;
  JobContext job;
  const auto source = writeCampaign(folder, "source");
  folder.write("source/captures/fiducials.csv", "time_s,image\n0,captures/images/a.jpg\n60,captures/images/b.jpg\n");
  Session session = Session::create(folder / "s");
  const std::int64_t id = session.importCampaign(source, job);
  const std::filesystem::path place = session.campaign(id).folder;
  const std::string before = session.inputs(id).value("files", std::string());
  writeFileAtomically(place / "captures/images/b.jpg", "the one that was missing");
  writeFileAtomically(place / "captures/images/unlisted.jpg", "of nobody");
  EXPECT_THAT(session.takeFiles(id, fingerprintsOfFiles(place, job)).added, ElementsAre("captures/images/b.jpg"));
  EXPECT_NE(session.inputs(id).value("files", std::string()), before);
}

TEST(Session, CaptureThatIsRepeatedStandsThereOnce) {
  const TempFolder folder;
  const auto image = folder.write("a.jpg", "one");
  Session session = Session::create(folder / "s");
  const auto id = session.newCampaign("c", "2026-01-31T08:00:00Z", machine_json);
  for (int i = 0; i < 2; ++i)
    addCapture(session, id, "fiducials.csv", "time_s,image", "0,captures/a.jpg", image, "captures/a.jpg");
  EXPECT_EQ(readFile(session.campaign(id).folder / "captures/fiducials.csv"), "time_s,image\n0,captures/a.jpg\n");
  EXPECT_EQ(readFile(session.campaign(id).folder / "captures/a.jpg"), "one");
}

TEST(Session, CopiedFolderOpensElsewhere) {
  const TempFolder folder;
  JobContext job;
  {
    Session session = Session::create(folder / "s");
    session.importCampaign(writeCampaign(folder, "source"), job);
  }
  std::filesystem::copy(folder / "s", folder / "elsewhere", std::filesystem::copy_options::recursive);
  std::filesystem::remove_all(folder / "s");
  const Session copy = Session::open(folder / "elsewhere");
  EXPECT_EQ(Campaign::read(copy.campaigns().at(0).folder).name, "warm-up 1");
}

TEST(Session, RefusesNewerVersionAndForeignFolder) {
  const TempFolder folder;
  { (void)Session::create(folder / "s"); }
  folder.write("s/spindrift-session.json", R"({"format":"spindrift-session","version":99})");
  try {
    (void)Session::open(folder / "s");
    FAIL() << "a newer session must be refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("$.version: 99 is not allowed"));
  }
  EXPECT_THROW((void)Session::open(folder.path()), InputError);
  EXPECT_THROW((void)Session::create(folder.path()), InputError);
}

TEST(Session, RefusesDatabaseOfNewerVersionAndLeavesItAlone) {
  const TempFolder folder;
  { (void)Session::create(folder / "s"); }
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "s/session.sqlite").c_str(), &handle), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(handle, "pragma user_version = 7", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(handle);
  const std::string before = readFile(folder / "s/session.sqlite");
  EXPECT_THROW((void)Session::open(folder / "s"), InputError);
  EXPECT_EQ(readFile(folder / "s/session.sqlite"), before);
}

TEST(Session, AnEmptyDatabaseIsNotMadeANewOneAndNothingIsMoved) {
  const TempFolder folder;
  JobContext job;
  { (void)Session::create(folder / "s").importCampaign(writeCampaign(folder, "source"), job); }
  const std::string whole = readFile(folder / "s/session.sqlite");
  folder.write("s/session.sqlite", "");
  try {
    (void)Session::open(folder / "s");
    FAIL() << "an empty database must be refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("put it back from a copy"));
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "s/campaigns/warm-up_1/machine.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/removed"));
  folder.write("s/session.sqlite", whole);
  EXPECT_EQ(Session::open(folder / "s").campaigns().size(), 1U);
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "s/session.sqlite").c_str(), &handle), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(handle, "pragma user_version = -3", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(handle);
  EXPECT_THROW((void)Session::open(folder / "s"), InputError);
}

TEST(Session, ACampaignThatAnOlderDatabaseDoesNotKnowIsTakenBack) {
  const TempFolder folder;
  JobContext job;
  { (void)Session::create(folder / "s").newCampaign("c", "2026-01-31T08:00:00Z", machine_json); }
  const std::string older = readFile(folder / "s/session.sqlite");
  {
    Session session = Session::open(folder / "s");
    session.importCampaign(writeCampaign(folder, "source"), job);
  }
  folder.write("s/session.sqlite", older);
  folder.write("s/campaigns/of_nobody/a.txt", "a");
  const Session session = Session::open(folder / "s");
  ASSERT_EQ(session.campaigns().size(), 2U);
  EXPECT_EQ(session.campaigns()[1].name, "warm-up 1");
  EXPECT_EQ(Campaign::read(session.campaigns()[1].folder).machine.name, "mill");
  EXPECT_THAT(session.recoveryMessages(), ElementsAre(HasSubstr("warm-up 1"), HasSubstr("of_nobody")));
  EXPECT_TRUE(std::filesystem::exists(folder / "s/campaigns/of_nobody/a.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s/removed"));
}

/// A session folder with the database of version 1.
void writeVersion1(const TempFolder& folder, const std::string& name) {
  folder.write(name + "/spindrift-session.json", R"({"format":"spindrift-session","version":1})");
  std::filesystem::create_directories(folder / (name + "/campaigns"));
  const auto source = writeCampaign(folder, "source");
  std::filesystem::rename(source, folder / (name + "/campaigns/warm-up_1"));
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open((folder / (name + "/session.sqlite")).c_str(), &handle), SQLITE_OK);
  const std::string sql = readFile(spindrift::testing::testData() / "sessions/version-1.sql");
  ASSERT_EQ(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(handle);
  sqlite3_close(handle);
}

TEST(Session, OneOfAnOlderVersionIsMigratedAndLosesNothing) {
  const TempFolder folder;
  writeVersion1(folder, "old");
  const std::string before = readFile(folder / "old/session.sqlite");
  {
    Session session = Session::open(folder / "old");
    ASSERT_EQ(session.migrationMessages().size(), 1U);
    EXPECT_THAT(session.migrationMessages()[0], HasSubstr("version 1 to 4"));
    ASSERT_EQ(session.campaigns().size(), 1U);
    EXPECT_EQ(Campaign::read(session.campaigns()[0].folder).machine.name, "mill");
    EXPECT_EQ(session.latestResult(1, "fit")->payload.at("rms_um"), 1.5);
    EXPECT_EQ(session.results(1).size(), 2U);
    EXPECT_EQ(session.exclusions(1).at(0).reason, "blurred");
    EXPECT_EQ(session.notes(1).at(0).text, "door was open");
    EXPECT_EQ(session.notes(1).at(0).item, "");
    EXPECT_EQ(session.setting("theme"), nlohmann::json("dark"));
    session.addNote(1, "Capture", "blurred by the fan", "captures/images/a.jpg");
  }
  EXPECT_EQ(readFile(folder / "old/session.sqlite.version-1"), before) << "the way back to the older program";
  // One copy, taken after what a crash left half done was taken back; not another one from before that.
  EXPECT_FALSE(std::filesystem::exists(folder / "old/session.version1.sqlite"));
  const Session again = Session::open(folder / "old");
  EXPECT_TRUE(again.migrationMessages().empty());
  EXPECT_EQ(again.notes(1).at(1).item, "captures/images/a.jpg");
}

void execute(const std::filesystem::path& database, const std::string& sql) {
  sqlite3* handle = nullptr;
  ASSERT_EQ(sqlite3_open(database.c_str(), &handle), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(handle);
  sqlite3_close(handle);
}

TEST(Session, TheJournalOfAnOlderVersionGetsARowAnArrival) {
  const TempFolder folder;
  writeVersion1(folder, "old");
  execute(folder / "old/session.sqlite",
          R"(insert into setting values ('incoming/1', '[{"name":"b.png","hash":"1"},{"name":"a.png","hash":"2"},7,
             {"hash":"of no name"},{"name":"c.png","hash":"3"}]');
             insert into setting values ('incoming/9', '[{"name":"of no campaign"}]'))");
  const Session session = Session::open(folder / "old");
  const std::vector<nlohmann::json> arrivals = session.arrivals(1);
  ASSERT_EQ(arrivals.size(), 3U);
  EXPECT_EQ(arrivals[0], nlohmann::json::parse(R"({"name":"b.png","hash":"1"})"));
  EXPECT_EQ(arrivals[1].at("name"), "a.png");
  EXPECT_EQ(session.arrival(1, "c.png")->at("hash"), "3");
  EXPECT_FALSE(session.setting("incoming/1"));
}

TEST(Session, AJournalThatIsNoJsonHindersNoMigration) {
  const TempFolder folder;
  writeVersion1(folder, "old");
  execute(folder / "old/session.sqlite", "insert into setting values ('incoming/1', '[{')");
  EXPECT_TRUE(Session::open(folder / "old").arrivals(1).empty());
}

TEST(Session, RowsThatComeLateGoWhereTheyBelong) {
  const TempFolder folder;
  Session session = Session::create(folder / "s");
  const auto id = session.newCampaign("c", "2026-01-31T08:00:00Z", machine_json);
  const std::filesystem::path list = session.campaign(id).folder / "captures/touches.csv";
  const auto row = [](int i) { return std::to_string(i) + "," + std::string(90, 'x'); };
  // Enough for several pieces of what is read of the end.
  std::vector<std::string> even;
  std::string expected = "time_s,what\n";
  for (int i = 0; i < 6000; ++i) {
    if (i % 2 == 0) even.push_back(row(i));
    expected += row(i) + "\n";
  }
  session.addCaptureRows(id, "touches.csv", "time_s,what", even);
  for (int i = 5999; i > 5990; i -= 2) session.addCaptureRows(id, "touches.csv", "time_s,what", {row(i)});
  session.addCaptureRows(id, "touches.csv", "time_s,what", {row(1), row(3), row(5), row(1)});
  std::vector<std::string> rest;
  for (int i = 7; i < 5990; i += 2) rest.push_back(row(i));
  session.addCaptureRows(id, "touches.csv", "time_s,what", rest);
  EXPECT_EQ(readFile(list), expected);
  session.addCaptureRows(id, "touches.csv", "time_s,what", rest);
  EXPECT_EQ(readFile(list), expected) << "twice";
  EXPECT_EQ(session.campaign(id).fingerprint, fingerprintOfFolder(session.campaign(id).folder));
  // Another program ends the list in its own way, and writes a remark that nothing goes before.
  writeFileAtomically(list, "time_s,what\r\n1,a\r\n# a pause\r\n5,b");
  session.addCaptureRows(id, "touches.csv", "time_s,what", {"0,c", "4,d", "6,e"});
  EXPECT_EQ(readFile(list), "time_s,what\n1,a\n# a pause\n0,c\n4,d\n5,b\n6,e\n");
  EXPECT_EQ(session.campaign(id).fingerprint, fingerprintOfFolder(session.campaign(id).folder));
  EXPECT_THROW(session.addCaptureRows(id, "touches.csv", "time_s", {"7"}), InputError);
}

TEST(Session, ARowThatACrashCutShortIsTakenBackAndOneThatSomebodyWroteIsNot) {
  const TempFolder folder;
  std::filesystem::path list;
  {
    Session session = Session::create(folder / "s");
    const auto id = session.newCampaign("c", "2026-01-31T08:00:00Z", machine_json);
    session.addCaptureRows(id, "touches.csv", "time_s,what", {"1,a"});
    list = session.campaign(id).folder / "captures/touches.csv";
  }
  folder.write("s/campaigns/c/captures/touches.csv", "time_s,what\n1,a\n2,b");
  { (void)Session::open(folder / "s"); }
  EXPECT_EQ(readFile(list), "time_s,what\n1,a\n2,b") << "nobody crashed";
  folder.write("s/campaigns/c/captures/touches.csv", "time_s,what\n1,a\n");
  { (void)Session::open(folder / "s"); }
  folder.write("s/campaigns/c/captures/touches.csv", "time_s,what\n1,a\n2,");
  folder.write("s/lock", "process 1 on a machine without power");
  { (void)Session::open(folder / "s"); }
  EXPECT_EQ(readFile(list), "time_s,what\n1,a\n");
  // The end of a list that was being written is written.
  execute(folder / "s/session.sqlite",
          "insert into pending_list values (1, 'captures/touches.csv', 12, '0,z\n1,a\n'),"
          "(1, '../../../outside.csv', 0, 'x')");
  folder.write("outside.csv", "mine");
  EXPECT_THROW((void)Session::open(folder / "s"), InputError);
  EXPECT_EQ(readFile(folder / "outside.csv"), "mine");
  execute(folder / "s/session.sqlite", "delete from pending_list where list like '..%'");
  folder.write("s/campaigns/c/captures/touches.csv", "time_s,what\n0,z\n");
  { (void)Session::open(folder / "s"); }
  EXPECT_EQ(readFile(list), "time_s,what\n0,z\n1,a\n");
}

TEST(Session, WhatACrashLeftHalfDoneIsTakenBackBeforeTheOldDatabaseIsCopied) {
  const TempFolder folder;
  writeVersion1(folder, "old");
  const std::filesystem::path file = folder / "old/session.sqlite";
  const std::string before = readFile(file);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // Ends in the middle of a change of which the first pages are in the file.
    sqlite3* handle = nullptr;
    const bool begun = sqlite3_open(file.c_str(), &handle) == SQLITE_OK &&
                       sqlite3_exec(handle,
                                    "pragma cache_size = 1; begin immediate; update result set payload = '{}'; "
                                    "insert into setting select 'half done', hex(zeroblob(200000))",
                                    nullptr, nullptr, nullptr) == SQLITE_OK;
    ::_exit(begun ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  ASSERT_GT(std::filesystem::file_size(file.string() + "-journal"), 0U);
  ASSERT_NE(readFile(file), before);
  const Session session = Session::open(folder / "old");
  EXPECT_EQ(session.migrationMessages().size(), 1U);
  EXPECT_EQ(session.latestResult(1, "fit")->payload.at("rms_um"), 1.5);
  EXPECT_FALSE(session.setting("half done"));
  EXPECT_EQ(readFile(file.string() + ".version-1"), before);
}

TEST(Session, AMigrationThatCannotKeepACopyChangesNothing) {
  const TempFolder folder;
  writeVersion1(folder, "old");
  // A folder stands where the copy is to be.
  folder.write("old/session.sqlite.version-1/in the way", "x");
  const std::string before = readFile(folder / "old/session.sqlite");
  try {
    (void)Session::open(folder / "old");
    FAIL() << "without a copy nothing may be changed";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot be copied before it is changed"));
  }
  EXPECT_EQ(readFile(folder / "old/session.sqlite"), before);
  EXPECT_FALSE(std::filesystem::exists(folder / "old/session.sqlite.version-1.writing"));
}

TEST(Session, GivesBackTheRoomOfRemovedResults) {
  const TempFolder folder;
  const auto file = folder / "s/session.sqlite";
  Session session = Session::create(folder / "s");
  const std::int64_t campaign = session.newCampaign("a", "2026-01-31T08:00:00Z", machine_json);
  const auto before = std::filesystem::file_size(file);
  std::vector<std::int64_t> results;
  for (int i = 0; i < 5; ++i) {
    results.push_back(addResult(session, campaign, "fit", {{"i", i}}, std::string(300'000, 'x')));
  }
  EXPECT_GT(std::filesystem::file_size(file), before + 1'500'000);
  for (const std::int64_t result : results) session.removeResult(result);
  EXPECT_LT(std::filesystem::file_size(file), before + 50'000);
}

TEST(Session, ADamagedPageIsFoundWhenTheSessionIsOpened) {
  const TempFolder folder;
  const auto file = folder / "s/session.sqlite";
  {
    Session session = Session::create(folder / "s");
    const std::int64_t campaign = session.newCampaign("a", "2026-01-31T08:00:00Z", machine_json);
    for (int i = 0; i < 200; ++i) addResult(session, campaign, "fit", {{"i", i}}, std::string(1000, 'x'));
  }
  // Somewhere in the middle, where opening alone does not look.
  std::string bytes = readFile(file);
  const std::size_t page = bytes.size() / 2 / 4096 * 4096;
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(page), 4096, '\xA5');
  writeFileAtomically(file, bytes);
  try {
    (void)Session::open(folder / "s");
    FAIL() << "it was opened";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("damaged"));
  }
}

TEST(Session, DamagedDatabaseIsOneSentence) {
  const TempFolder folder;
  { (void)Session::create(folder / "s"); }
  folder.write("s/session.sqlite", std::string(4096, 'x'));
  try {
    (void)Session::open(folder / "s");
    FAIL() << "a damaged database must be refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("session.sqlite"));
  }
}

TEST(Session, CancelledImportLeavesNoTrace) {
  const TempFolder folder;
  Session session = Session::create(folder / "s");
  std::stop_source stop;
  stop.request_stop();
  JobContext job(stop.get_token(), nullptr);
  EXPECT_THROW(session.importCampaign(writeCampaign(folder, "source"), job), Cancelled);
  EXPECT_TRUE(session.campaigns().empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder / "s/campaigns"));
}

TEST(Session, NewCampaignChecksTheMachine) {
  const TempFolder folder;
  Session session = Session::create(folder / "s");
  EXPECT_THROW(session.newCampaign("c", "2026-01-31T08:00:00Z", "{}"), InputError);
  EXPECT_TRUE(session.campaigns().empty());
  const auto id = session.newCampaign("c", "2026-01-31T08:00:00Z", machine_json);
  EXPECT_EQ(Campaign::read(session.campaign(id).folder).machine.name, "mill");
}

TEST(Session, RemovedCampaignKeepsItsFilesAside) {
  const TempFolder folder;
  JobContext job;
  Session session = Session::create(folder / "s");
  const auto id = session.importCampaign(writeCampaign(folder, "source"), job);
  addResult(session, id, "fit", nlohmann::json::object(), 1);
  session.removeCampaign(id);
  EXPECT_TRUE(session.campaigns().empty());
  EXPECT_TRUE(std::filesystem::exists(folder / "s/removed/warm-up_1/machine.json"));
}

/// What is said on opening a session whose database was changed by hand.
std::string complaintAbout(const std::filesystem::path& session, const std::string& sql) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open((session / "session.sqlite").c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  try {
    Session opened = Session::open(session);
    for (const CampaignRecord& record : opened.campaigns()) opened.removeCampaign(record.id);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Session, ACraftedOneTouchesNothingOutsideItself) {
  const TempFolder folder;
  folder.write("mine/keep.txt", "x");
  JobContext job;
  {
    Session session = Session::create(folder / "s");
    session.importCampaign(writeCampaign(folder, "source"), job);
  }
  std::filesystem::create_directory_symlink(folder / "mine", folder / "s/campaigns/link");
  for (const std::string& named :
       {(folder / "mine").string(), std::string("../mine"), std::string("campaigns/../../mine"),
        std::string("campaigns/link"), std::string("."), std::string(""), std::string("campaigns"),
        std::string("campaigns/"), std::string("removed/x")}) {
    EXPECT_THAT(complaintAbout(folder / "s", "update campaign set folder = '" + named + "'"),
                ::testing::AllOf(HasSubstr("session.sqlite"), HasSubstr("allowed")))
        << named;
    EXPECT_EQ(readFile(folder / "mine/keep.txt"), "x") << named;
  }
  EXPECT_EQ(complaintAbout(folder / "s", "update campaign set folder = 'campaigns/warm-up_1'"), "no complaint");
}

TEST(Session, ALinkInPlaceOfItsCampaignsIsRefused) {
  const TempFolder folder;
  folder.write("mine/work/keep.txt", "x");
  { Session session = Session::create(folder / "s"); }
  std::filesystem::remove(folder / "s/campaigns");
  std::filesystem::create_directory_symlink(folder / "mine", folder / "s/campaigns");
  EXPECT_THAT(complaintAbout(folder / "s", "select 1"), HasSubstr("leads out of its folder by a link"));
  EXPECT_EQ(readFile(folder / "mine/work/keep.txt"), "x");
}

TEST(Session, ALinkInPlaceOfAFileOfItsOwnIsRefusedBeforeItIsOpened) {
  for (const char* name : {"lock", "session.sqlite", "session.sqlite-wal", "removed"}) {
    const TempFolder folder;
    folder.write("mine/keep.txt", "precious");
    { Session session = Session::create(folder / "s"); }
    std::filesystem::remove(folder / "s" / name);
    std::filesystem::create_symlink(folder / "mine/keep.txt", folder / "s" / name);
    try {
      (void)Session::open(folder / "s");
      ADD_FAILURE() << name << " was followed";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("leads out of its folder by a link"));
    }
    EXPECT_EQ(readFile(folder / "mine/keep.txt"), "precious") << name;
  }
}

TEST(Session, AFileThatIsChangedOnTheDiskMakesResultsOutdatedUntilItIsPutBack) {
  const TempFolder folder;
  JobContext job;
  Session session = Session::create(folder / "s");
  const auto id = session.importCampaign(writeCampaign(folder, "source"), job);
  addCapture(session, id, "fiducials.csv", "time_s,image", "0,captures/b.jpg", folder.write("b.jpg", "b"),
             "captures/b.jpg");
  addResult(session, id, "evaluate", nlohmann::json::object(), 1);
  const auto stored = session.latestResult(id, "evaluate").value();
  const std::filesystem::path place = session.campaign(id).folder;
  const auto look = [&] { return session.takeFiles(id, fingerprintsOfFiles(place, job)); };
  EXPECT_TRUE(look().same());
  EXPECT_TRUE(session.isCurrent(stored));

  folder.write("s/campaigns/warm-up_1/captures/b.jpg", "B");
  FileCheck check = look();
  EXPECT_THAT(check.changed, ElementsAre("captures/b.jpg"));
  EXPECT_THAT(check.sentence(), HasSubstr("captures/b.jpg has another content"));
  EXPECT_FALSE(session.isCurrent(stored));
  EXPECT_TRUE(look().same()) << "said once";

  std::filesystem::remove(place / "captures/b.jpg");
  EXPECT_THAT(look().missing, ElementsAre("captures/b.jpg"));
  EXPECT_FALSE(session.isCurrent(stored));
  folder.write("s/campaigns/warm-up_1/captures/b.jpg", "b");
  EXPECT_FALSE(look().same());
  EXPECT_TRUE(session.isCurrent(stored)) << "the same content again";
  EXPECT_THAT(session.latestResult(id, "evaluate")->provenance.inputs.at("files").get<std::string>(),
              ::testing::SizeIs(64))
      << "SHA-256";
}

TEST(Session, AFileThatNoListNamesChangesNothing) {
  const TempFolder folder;
  Session session = Session::create(folder / "s");
  const auto id = session.newCampaign("c", "2026-01-31T08:00:00Z", machine_json);
  folder.write("s/campaigns/c/captures/images/a.jpg", "a");
  folder.write("s/campaigns/c/captures/images/b.jpg", "b");
  session.addCaptureRows(id, "fiducials.csv", "time_s,image", {"0,captures/images/a.jpg"});
  addResult(session, id, "evaluate", nlohmann::json::object(), 1);
  const auto stored = session.latestResult(id, "evaluate").value();
  const std::filesystem::path place = session.campaign(id).folder;
  EXPECT_TRUE(session.takeFiles(id, fingerprintsOfFiles(place, {})).same());
  EXPECT_TRUE(session.isCurrent(stored));
  folder.write("s/campaigns/c/captures/images/a.jpg", "another");
  EXPECT_THAT(session.takeFiles(id, fingerprintsOfFiles(place, {})).changed, ElementsAre("captures/images/a.jpg"));
  EXPECT_FALSE(session.isCurrent(stored));
  folder.write("s/campaigns/c/log.csv", "time_s,t\n0,1\n");
  EXPECT_THAT(session.takeFiles(id, fingerprintsOfFiles(place, {})).added, ElementsAre("log.csv"));
}

TEST(Session, AResultKnowsWhatItWasMadeFrom) {
  const TempFolder folder;
  JobContext job;
  Session session = Session::create(folder / "s");
  const auto id = session.importCampaign(writeCampaign(folder, "source"), job);
  session.exclude(id, "captures/images/a.jpg", "blurred");
  session.keepResult(session.originOf(id, "fit", {{"robust", 1}}, {{"evaluate", "abc"}}), 1);
  {
    const auto head = session.resultHeads(id, "fit").back();
    EXPECT_TRUE(head.payload.is_null());
    const nlohmann::json& inputs = head.provenance.inputs;
    EXPECT_EQ(inputs.at("exclusions"), nlohmann::json({"captures/images/a.jpg"}));
    EXPECT_EQ(inputs.at("evaluate"), "abc");
    EXPECT_EQ(inputs.at("files"), session.campaign(id).fingerprint);
    EXPECT_TRUE(session.isCurrent(head));
  }
  const auto stored = session.latestResult(id, "fit").value();
  for (const std::string& key : {Session::machineKey(id), Session::clocksKey(id)}) {
    session.setSetting(key, {{"edited", 1}});
    EXPECT_FALSE(session.isCurrent(stored)) << key;
    session.setSetting(key, nlohmann::json::object());
    EXPECT_TRUE(session.isCurrent(stored)) << key;
  }
}

TEST(Fingerprint, IsSha256OfTheContent) {
  const TempFolder folder;
  folder.write("a", "abc");
  EXPECT_EQ(fingerprintsOfFiles(folder.path(), {}).at("a"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Fingerprint, TellsPartsApart) {
  EXPECT_NE(Fingerprint().add("ab").add("c").text(), Fingerprint().add("a").add("bc").text());
  EXPECT_EQ(Fingerprint().add("ab").text(), Fingerprint().add("ab").text());
}

}  // namespace
}  // namespace spindrift
