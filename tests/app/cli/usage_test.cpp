// SPDX-License-Identifier: GPL-3.0-or-later
// Help, usage errors and what holds for every command.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <regex>

#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

const std::vector<std::vector<std::string>> every_command = {{"plan"},
                                                             {"watch"},
                                                             {"decode"},
                                                             {"evaluate"},
                                                             {"fit"},
                                                             {"heatmap"},
                                                             {"register"},
                                                             {"calibrate-profiler"},
                                                             {"thermal", "identify"},
                                                             {"thermal", "track"},
                                                             {"simulate"},
                                                             {"simulation", "import"},
                                                             {"discrepancy"},
                                                             {"compensate"},
                                                             {"report"},
                                                             {"session"},
                                                             {"import-touches"},
                                                             {"cycle"},
                                                             {"what-if"},
                                                             {"exercise"}};

TEST(Usage, HelpOnEveryLevel) {
  const Outcome top = runCli({"--help"});
  EXPECT_EQ(top.status, 0);
  EXPECT_EQ(top.error, "");
  EXPECT_NE(top.output.find("Exit status"), std::string::npos);
  const Outcome thermal = runCli({"thermal", "--help"});
  EXPECT_EQ(thermal.status, 0);
  EXPECT_NE(thermal.output.find("identify"), std::string::npos);
  for (std::vector<std::string> words : every_command) {
    EXPECT_NE(top.output.find(words.front()), std::string::npos);
    const std::string name = words.back();
    words.emplace_back("--help");
    const Outcome help = runCli(words);
    EXPECT_EQ(help.status, 0) << name;
    EXPECT_NE(help.output.find("--json"), std::string::npos) << name;
  }
  EXPECT_EQ(runCli({"--version"}).status, 0);
}

// GDAL behind OpenCV's image files and PCL bring four fifths of the names that the loader would look up at each start.
TEST(Usage, AStartLoadsNoLibraryThatFewCommandsNeed) {
  const std::unique_ptr<FILE, int (*)(FILE*)> lister(popen("LD_TRACE_LOADED_OBJECTS=1 " SPINDRIFT_CLI, "r"), pclose);
  ASSERT_NE(lister, nullptr);
  std::string listed;
  for (char part[4096]; std::fgets(part, sizeof part, lister.get()) != nullptr;) listed += part;
  ASSERT_NE(listed.find("libopencv_core"), std::string::npos) << listed;
  for (const char* late : {"libgdal", "libpcl_", "libopencv_imgcodecs", "libopencv_videoio", "libavcodec", "libvtk"})
    EXPECT_EQ(listed.find(late), std::string::npos) << late;
}

TEST(Usage, UnitsAreWrittenAsPeopleWriteThem) {
  std::string help = runCli({"--reference", "markdown"}).output + runCli({"--help"}).output;
  ASSERT_GT(help.size(), 50'000U);
  const std::string of_files = "files write um and urad";
  ASSERT_NE(help.find(of_files), std::string::npos);
  for (auto at = help.find(of_files); at != std::string::npos; at = help.find(of_files))
    help.erase(at, of_files.size());
  // "--goal-urad" and "EX_um" are names.
  const std::regex file_unit("(^|[^A-Za-z0-9_\"-])(um|urad)(?![A-Za-z0-9_\"])");
  for (std::sregex_iterator i(help.begin(), help.end(), file_unit), none; i != none; ++i) {
    const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, i->position() - 60));
    ADD_FAILURE() << help.substr(from, 120);
  }
}

TEST(Usage, WrongUseEndsWithTwo) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"nonsense"},
      {"thermal"},
      {"fit"},
      {"fit", ".", "--model", "eleven-parameter"},
      {"fit", ".", "--unknown"},
      {"heatmap", ".", "--component", "EA"},
      {"register", "a.pcd"},
      {"register", "a.pcd", "b.pcd", "--scan-model", "bent"},
      {"calibrate-profiler", "a.pcd"},
      {"calibrate-profiler", "a.pcd", "--circle", "1,2,3"},
      {"thermal", "track", "log.csv", "--model", "m.json", "--interval", "0"},
      {"simulate", "s.json"},
      {"simulate", "--out", "nothing"},
      {"simulate", "s.json", "--c-frame", "sun", "--out", "nothing"},
      {"report", "."}};
  for (const auto& words : wrong) {
    const Outcome outcome = runCli(words);
    EXPECT_EQ(outcome.status, 2) << (words.empty() ? "" : words.front());
    EXPECT_EQ(outcome.output, "");
    EXPECT_NE(outcome.error, "");
  }
}

TEST(Usage, WhatIsWrongIsSaidInASentenceOfOurs) {
  const TempFolder folder;
  expectBadInput({"nonsense"}, {"\"nonsense\" is not a command"});
  expectBadInput({"verify", "a", "b", "--goal", "-5"}, {"--goal", "-5 is not allowed", "greater than zero"});
  expectBadInput({"report", ".", "--out", (folder / "r.txt").string()}, {"r.txt", ".html", ".pdf"});
  expectBadInput({"simulate", "--c-frame", "rain", "--out", "nothing"}, {"rain", "sun, friction, coolant or room"});
  expectBadInput({"sensor-groups", folder.write("log.csv", "time_s,spindle_rpm\n0,1\n60,1\n").string()},
                 {"no temperature", "T_"});
}

TEST(Usage, FilesThatAreNotThereAreNamed) {
  const TempFolder folder;
  const std::string none = (folder / "none").string();
  for (const char* command : {"evaluate", "fit", "heatmap", "discrepancy"}) expectBadInput({command, none}, {none});
  expectBadInput({"report", none, "--out", (folder / "r.html").string()}, {none});
  expectBadInput({"decode", none}, {none});
  expectBadInput({"register", none, none}, {none});
  expectBadInput({"calibrate-profiler", none, "--circle", "0,0,0,9"}, {none});
  expectBadInput({"thermal", "identify", none, "--output", "a", "--train", "0:1", "--test", "1:2"}, {none});
  expectBadInput({"thermal", "track", none, "--model", none, "--interval", "60"}, {none});
  expectBadInput({"simulate", none, "--out", (folder / "c").string()}, {none});
  EXPECT_TRUE(contentOf(folder.path()).empty());
}

TEST(Usage, CampaignFilesOfAnotherFormatAreRefused) {
  const TempFolder folder;
  const std::string campaign = folder.path().string();
  const std::string machine =
      R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",)"
      R"("axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,300]},{"name":"Z","travel_mm":[0,300]}]})";
  const auto write = [&](const std::string& campaign_json, const std::string& machine_json) {
    folder.write("campaign.json", campaign_json);
    folder.write("machine.json", machine_json);
  };
  write(R"({"format":"spindrift-other","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})", machine);
  expectBadInput({"fit", campaign}, {"campaign.json", "$.format", "spindrift-other", "spindrift-campaign"});
  write(R"({"format":"spindrift-campaign","version":2,"name":"c","start_utc":"2026-01-31T08:00:00Z"})", machine);
  expectBadInput({"fit", campaign}, {"campaign.json", "$.version", "2", "allowed"});
  const std::string good =
      R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})";
  write(R"({"format":"spindrift-campaign","version":1,"name":"c","name":"d","start_utc":"2026-01-31T08:00:00Z"})",
        machine);
  expectBadInput({"fit", campaign}, {"campaign.json", "name"});
  write(good, machine.substr(0, machine.size() / 2));
  expectBadInput({"fit", campaign}, {"machine.json"});
  write(good, R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]","axes":[]})");
  expectBadInput({"fit", campaign}, {"machine.json", "$.axes"});
  write(good, R"({"format":"spindrift-machine","version":1,"name":"m","axes":[]})");
  expectBadInput({"fit", campaign}, {"machine.json", "chain"});
  write(good, machine);
  expectBadInput({"fit", campaign}, {"allowed"});
  expectBadInput({"evaluate", campaign}, {"captures", "fiducials.csv, touches.csv or scans.csv"});
}

}  // namespace
}  // namespace spindrift::testing
