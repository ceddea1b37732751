// SPDX-License-Identifier: GPL-3.0-or-later
// What happens to a session when its disk is full, its folder cannot be written to, or is gone in mid-work: one
// sentence, and nothing that was stored before is harmed.
#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/session/session.h"
#include "tests/support/child_process.h"
#include "tests/support/session_steps.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::spindrift::testing::addCapture;
using ::spindrift::testing::addResult;
using ::spindrift::testing::inChildProcess;
using ::spindrift::testing::TempFolder;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* small_machine_json =
    R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
        "axes":[{"name":"X","travel_mm":[0,300]}]})";
constexpr const char* header = "time_s,image";

/// The sentence an action ends in; "done" if it succeeds.
template <typename Action>
std::string outcomeOf(Action action) {
  try {
    action();
    return "done";
  } catch (const InputError& error) {
    return error.what();
  }
}

class StorageFailure : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(::chmod(folder_.path().c_str(), 0755), 0);
    small_ = folder_.write("small.jpg", std::string(1000, 's'));
    large_ = folder_.write("large.jpg", std::string(300'000, 'l'));
  }
  /// A session with one campaign and one capture.
  [[nodiscard]] Session begun(const std::filesystem::path& place) const {
    Session session = Session::create(place);
    const auto id = session.newCampaign("c", "2026-01-31T08:00:00Z", small_machine_json);
    addCapture(session, id, "fiducials.csv", header, "0,captures/first.jpg", small_, "captures/first.jpg");
    addResult(session, id, "fit", {}, 1);
    return session;
  }
  void capture(Session& session, const std::string& name, const std::filesystem::path& source) const {
    addCapture(session, session.campaigns().at(0).id, "fiducials.csv", header, "1,captures/" + name, source,
               "captures/" + name);
  }
  /// Everything of begun() is there and whole, and nothing half-made lies about.
  static std::string intact(const std::filesystem::path& place, const std::string& rows_after) {
    const Session session = Session::open(place);
    const CampaignRecord record = session.campaigns().at(0);
    if (readFile(record.folder / "captures/fiducials.csv") != "time_s,image\n0,captures/first.jpg\n" + rows_after) {
      return "the list changed";
    }
    if (readFile(record.folder / "captures/first.jpg") != std::string(1000, 's')) return "the first image changed";
    if (session.results(record.id).empty()) return "the result is lost";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place)) {
      if (entry.path().extension() == ".part") return "left over: " + entry.path().string();
    }
    return "intact";
  }

  TempFolder folder_;
  std::filesystem::path small_;
  std::filesystem::path large_;
};

TEST_F(StorageFailure, FileThatFindsNoRoomIsOneSentenceAndWorkGoesOnAfterwards) {
  const auto place = folder_ / "s";
  EXPECT_EQ(inChildProcess([&] {
              Session session = begun(place);
              const auto id = session.campaigns().at(0).id;
              std::signal(SIGXFSZ, SIG_IGN);
              rlimit limit{};
              getrlimit(RLIMIT_FSIZE, &limit);
              const rlimit full{100'000, limit.rlim_max};
              setrlimit(RLIMIT_FSIZE, &full);
              const std::string image = outcomeOf([&] { capture(session, "b.jpg", large_); });
              const std::string result =
                  outcomeOf([&] { addResult(session, id, "fit", {}, std::string(300'000, 'r')); });
              setrlimit(RLIMIT_FSIZE, &limit);
              if (image.find("cannot be written") == std::string::npos) return "image: " + image;
              if (result.find("cannot be used") == std::string::npos) return "result: " + result;
              const std::string again = outcomeOf([&] {
                capture(session, "b.jpg", large_);
                addResult(session, id, "fit", {}, std::string(300'000, 'r'));
              });
              return again;
            }),
            "done");
  EXPECT_EQ(intact(place, "1,captures/b.jpg\n"), "intact");
}

TEST_F(StorageFailure, FullDiskKeepsWhatWasStoredAndTakesMoreWhenThereIsRoomAgain) {
  const std::string answer = inChildProcess([&]() -> std::string {
    const std::filesystem::path disk = folder_ / "disk";
    std::filesystem::create_directory(disk);
    if (::unshare(::geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0 ||
        ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=1m") != 0) {
      return "not permitted";
    }
    Session session = begun(disk / "s");
    const auto id = session.campaigns().at(0).id;
    const std::string filler = outcomeOf([&] {
      for (int i = 0;; ++i) writeFileAtomically(disk / ("filler" + std::to_string(i)), std::string(8192, 'f'));
    });
    const std::string image = outcomeOf([&] { capture(session, "b.jpg", large_); });
    const std::string result = outcomeOf([&] { addResult(session, id, "fit", {}, std::string(100'000, 'r')); });
    if (image.find("No space left") == std::string::npos) return "image: " + image;
    if (result.find("full") == std::string::npos) return "result: " + result;
    for (int i = 0; i < 60; ++i) std::filesystem::remove(disk / ("filler" + std::to_string(i)));
    capture(session, "b.jpg", large_);
    { const Session closed = std::move(session); }
    return intact(disk / "s", "1,captures/b.jpg\n");
  });
  if (answer == "not permitted") GTEST_SKIP() << "a file system of its own cannot be mounted here";
  EXPECT_EQ(answer, "intact");
}

TEST_F(StorageFailure, FolderThatCannotBeWrittenToIsSaidWhenItIsOpened) {
  const auto place = folder_ / "s";
  { (void)begun(place); }
  std::filesystem::permissions(place, std::filesystem::perms{0555});
  std::filesystem::permissions(place / "lock", std::filesystem::perms{0444});
  const std::string answer = inChildProcess([&] {
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return std::string("no other user");
    return outcomeOf([&] { (void)Session::open(place); });
  });
  std::filesystem::permissions(place, std::filesystem::perms{0755});
  std::filesystem::permissions(place / "lock", std::filesystem::perms{0644});
  EXPECT_THAT(answer, AllOf(HasSubstr("cannot be opened for work"), HasSubstr("allowed: a folder you may write to")));
  EXPECT_EQ(intact(place, ""), "intact");
}

TEST_F(StorageFailure, FolderThatTurnsReadOnlyInMidWorkLosesNothing) {
  const auto place = folder_ / "s";
  const std::string answer = inChildProcess([&]() -> std::string {
    Session session = begun(place);
    const auto id = session.campaigns().at(0).id;
    for (const auto& part : {place, session.campaigns().at(0).folder, session.campaigns().at(0).folder / "captures"}) {
      std::filesystem::permissions(part, std::filesystem::perms{0555});
    }
    if (::geteuid() == 0 && ::seteuid(65534) != 0) return "no other user";
    const std::string image = outcomeOf([&] { capture(session, "b.jpg", small_); });
    const std::string result = outcomeOf([&] { addResult(session, id, "fit", {}, 2); });
    const std::string note = outcomeOf([&] { session.addNote(id, "Capture", "x"); });
    return image + "|" + result + "|" + note;
  });
  for (const char* part : {"s", "s/campaigns/c", "s/campaigns/c/captures"}) {
    std::filesystem::permissions(folder_ / part, std::filesystem::perms{0755});
  }
  EXPECT_THAT(answer, AllOf(HasSubstr("Permission denied"), HasSubstr("database cannot be used")));
  EXPECT_THAT(answer, ::testing::Not(HasSubstr("done")));
  EXPECT_EQ(intact(place, ""), "intact");
}

TEST_F(StorageFailure, VanishedFolderIsSaidAndNothingIsMadeInItsPlace) {
  const auto place = folder_ / "s";
  Session session = begun(place);
  const auto id = session.campaigns().at(0).id;
  JobContext job;
  std::filesystem::rename(place, folder_ / "away");
  for (const std::string& sentence :
       {outcomeOf([&] { session.addCaptureRows(id, "fiducials.csv", header, {"1,captures/b.jpg"}); }),
        outcomeOf([&] { addResult(session, id, "fit", {}, 2); }),
        outcomeOf([&] { session.addNote(id, "Capture", "x"); }), outcomeOf([&] { session.exclude(id, "a", "b"); }),
        outcomeOf([&] { session.setSetting("a", 1); }),
        outcomeOf([&] { session.newCampaign("d", "2026-01-31T08:00:00Z", small_machine_json); })}) {
    EXPECT_THAT(sentence, AllOf(StartsWith(place.string()), HasSubstr("is not there any more")));
  }
  EXPECT_FALSE(std::filesystem::exists(place));
  std::filesystem::rename(folder_ / "away", place);
  capture(session, "b.jpg", small_);
  { const Session closed = std::move(session); }
  EXPECT_EQ(intact(place, "1,captures/b.jpg\n"), "intact");
}

TEST_F(StorageFailure, SourceOfAnImportThatVanishesLeavesNoTrace) {
  class Remover : public ProgressSink {
   public:
    explicit Remover(std::filesystem::path folder) : folder_(std::move(folder)) {}
    void report(double, std::string_view) override { std::filesystem::remove_all(folder_); }

   private:
    std::filesystem::path folder_;
  };
  folder_.write("source/campaign.json",
                R"({"format":"spindrift-campaign","version":1,"name":"n","start_utc":"2026-01-31T08:00:00Z"})");
  folder_.write("source/machine.json", small_machine_json);
  Session session = Session::create(folder_ / "s");
  Remover remover(folder_ / "source");
  JobContext job({}, &remover);
  EXPECT_THAT(outcomeOf([&] { session.importCampaign(folder_ / "source", job); }),
              AnyOf(HasSubstr("cannot be copied into the session"), HasSubstr("cannot be read")));
  EXPECT_TRUE(session.campaigns().empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "s/campaigns"));
}

}  // namespace
}  // namespace spindrift
