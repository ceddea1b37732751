// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/campaign.h"

#include <gmock/gmock.h>

#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* machine_text =
    R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-b-X-t]","axes":[{"name":"X","travel_mm":[0,1]}]})";

TEST(Campaign, ReadsWhatIsThereAndNoMore) {
  const testing::TempFolder folder;
  folder.write("campaign.json",
               R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z",
                                    "simulation":"simulation.csv","simulation_gain_uncertainty":0.02})");
  folder.write("machine.json", machine_text);
  Campaign campaign = Campaign::read(folder.path());
  EXPECT_EQ(campaign.simulation_gain_uncertainty, 0.02);
  EXPECT_FALSE(campaign.log);
  EXPECT_FALSE(campaign.observations);
  EXPECT_FALSE(campaign.captureList("touches.csv"));
  folder.write("log.csv", "time_s,spindle_rpm\n0,0\n");
  folder.write("captures/touches.csv", "x\n");
  campaign = Campaign::read(folder.path());
  EXPECT_TRUE(campaign.log);
  EXPECT_TRUE(campaign.captureList("touches.csv"));
}

TEST(Campaign, ALogWhoseRecordingHasJustBegunIsNoneYet) {
  const testing::TempFolder folder;
  folder.write("campaign.json",
               R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})");
  folder.write("machine.json", machine_text);
  const std::string begun = "# time_s counts from 2026-01-31T08:00:00.000Z\n# spindle_rpm: mill S1\n";
  folder.write("log.csv", begun);
  EXPECT_FALSE(Campaign::read(folder.path()).log);
  folder.write("log.csv", begun + "time_s,spindle_rpm\n# mill lost at 3.000 s: no answer\n");
  EXPECT_FALSE(Campaign::read(folder.path()).log);
  folder.write("log.csv", begun + "time_s,spindle_rpm\n# mill lost at 3.000 s: no answer\n4.000,600\n");
  EXPECT_EQ(Campaign::read(folder.path()).log->at("spindle_rpm", 4.0), 600.0);
  // One that nobody records has lost its rows.
  folder.write("log.csv", "time_s,spindle_rpm\n");
  EXPECT_THROW((void)Campaign::read(folder.path()), InputError);
}

TEST(Campaign, ALinkToAFileElsewhereIsNotFollowed) {
  const testing::TempFolder folder;
  folder.write("mine/secret.csv", "time_s,spindle_rpm\n0,0\n");
  for (const std::string name : {"log.csv", "machine.json", "campaign.json", "observations.csv", "observations.cov.csv",
                                 "pattern.json", "warm_up.csv"}) {
    const std::filesystem::path campaign = folder / ("c_" + name);
    folder.write("c_" + name + "/campaign.json",
                 R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})");
    folder.write("c_" + name + "/machine.json", machine_text);
    EXPECT_NO_THROW((void)Campaign::read(campaign)) << name;
    std::filesystem::remove(campaign / name);
    std::filesystem::create_symlink(folder / "mine/secret.csv", campaign / name);
    try {
      (void)Campaign::read(campaign);
      ADD_FAILURE() << name << " was followed";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(name), HasSubstr("by a link")));
    }
  }
  folder.write("c/campaign.json",
               R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})");
  folder.write("c/machine.json", machine_text);
  folder.write("mine/touches.csv", "x\n");
  std::filesystem::create_directory_symlink(folder / "mine", folder / "c/captures");
  EXPECT_THROW((void)Campaign::read(folder / "c").captureList("touches.csv"), InputError);
}

TEST(Campaign, BadFilesAreNamed) {
  const testing::TempFolder folder;
  const auto complaint = [&](const char* text) -> std::string {
    folder.write("campaign.json", text);
    try {
      (void)Campaign::read(folder.path());
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(complaint(R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"31.1.2026"})"),
              HasSubstr("$.start_utc"));
  EXPECT_THAT(complaint(R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-02-30T08:00:00Z"})"),
              HasSubstr("$.start_utc"));
  EXPECT_THAT(complaint(R"({"format":"spindrift-campaign","version":1,"name":"c","start_utc":"2026-01-31T08:00:00Z"})"),
              HasSubstr("machine.json"));
  EXPECT_THROW((void)Campaign::read(folder / "missing"), InputError);
}

}  // namespace
}  // namespace spindrift
