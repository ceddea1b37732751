// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign is captured and evaluated by a process that is killed again and again, at moments drawn from a seed.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <random>
#include <sstream>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/session/fingerprint.h"
#include "core/session/session.h"
#include "core/simulation/scenario.h"
#include "core/simulation/virtual_campaign.h"
#include "core/workflows/evaluate_campaign.h"
#include "tests/support/session_steps.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::spindrift::testing::addCapture;
using ::spindrift::testing::addResult;
using ::spindrift::testing::TempFolder;

constexpr int kills = 50;
constexpr const char* image_header = "time_s,image";

std::vector<std::string> linesOf(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  if (!std::filesystem::exists(file)) return lines;
  std::istringstream text(readFile(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// What is measured: the touches of a virtual machine, and pictures of 1 to 200 kB.
struct Material {
  std::string machine;
  std::string header;
  std::vector<std::string> touches;
  std::filesystem::path picture_folder;

  [[nodiscard]] std::filesystem::path picture(std::size_t i) const {
    return picture_folder / ("picture" + std::to_string(i % 10) + ".jpg");
  }
};

Material makeMaterial(const TempFolder& folder) {
  Scenario scenario = Scenario::read(spindrift::testing::sourceFolder() / "resources" / "scenarios" / "hole_bar.json");
  writeCampaign(simulateCampaign(scenario, std::nullopt, JobContext()), folder / "source");
  Material material;
  material.machine = readFile(folder / "source/machine.json");
  material.touches = linesOf(folder / "source/captures/touches.csv");
  material.header = material.touches.front();
  material.touches.erase(material.touches.begin());
  material.picture_folder = folder / "pictures";
  for (std::size_t i = 0; i < 10; ++i) {
    folder.write("pictures/picture" + std::to_string(i) + ".jpg",
                 std::string(1000 + 22000 * i, static_cast<char>('a' + i)));
  }
  return material;
}

/// One letter through the pipe: 'o' open, 'c' touch, 'p' picture, 'r' result. Sent after the call has returned.
void acknowledge(int pipe, char what) {
  if (::write(pipe, &what, 1) != 1) ::_exit(4);
}

nlohmann::json evaluated(const Session& session, std::int64_t campaign) {
  JobContext job;
  const CampaignEvaluation evaluation = evaluateCampaign(Campaign::read(session.campaign(campaign).folder), {}, job);
  return {{"observations", evaluation.observations.csv()},
          {"captures", linesOf(session.campaign(campaign).folder / "captures/touches.csv").size() - 1}};
}

/// The program at the machine: goes on where the last one was killed and never ends by itself.
void operate(const std::filesystem::path& place, const Material& material, int pipe) {
  Session session = Session::open(place);
  const std::int64_t touched = session.campaigns().at(0).id;
  const std::int64_t seen = session.campaigns().at(1).id;
  acknowledge(pipe, 'o');
  const std::size_t rows = linesOf(session.campaign(touched).folder / "captures/touches.csv").size();
  for (std::size_t i = rows > 0 ? rows - 1 : 0;; ++i) {
    if (i >= material.touches.size()) ::_exit(5);
    session.addCaptureRows(touched, "touches.csv", material.header, {material.touches[i]});
    acknowledge(pipe, 'c');
    if (i % 3 == 0) {
      const std::string name = "captures/images/" + std::to_string(i) + ".jpg";
      addCapture(session, seen, "pictures.csv", image_header, std::to_string(i) + "," + name, material.picture(i),
                 name);
      acknowledge(pipe, 'p');
    }
    if (i > 60 && i % 4 == 0) {
      addResult(session, touched, "evaluate", nlohmann::json::object(), evaluated(session, touched));
      acknowledge(pipe, 'r');
    }
  }
}

/// Index of the next touch where every second one comes before the one that was taken before it.
std::size_t nextOfLate(std::size_t rows) {
  return rows % 2 == 0 ? rows + 1 : rows - 1;
}

std::size_t rowsOf(const CampaignRecord& record) {
  const std::size_t lines = linesOf(record.folder / "captures/touches.csv").size();
  return lines > 0 ? lines - 1 : 0;
}

/// The program beside a control that prints late and several touches at once: 'l' a late or an early touch, 'b' three
/// together, 'a' an arrival.
void takeLateAndTogether(const std::filesystem::path& place, const Material& material, int pipe) {
  Session session = Session::open(place);
  const std::int64_t late = session.campaigns().at(0).id;
  const std::int64_t together = session.campaigns().at(1).id;
  acknowledge(pipe, 'o');
  for (;;) {
    const std::size_t next = nextOfLate(rowsOf(session.campaign(late)));
    session.addCaptureRows(late, "touches.csv", material.header, {material.touches.at(next)});
    acknowledge(pipe, 'l');
    const auto three = material.touches.begin() + static_cast<std::ptrdiff_t>(rowsOf(session.campaign(together)));
    session.addCaptureRows(together, "touches.csv", material.header, {three, three + 3});
    acknowledge(pipe, 'b');
    session.setArrival(late, "file " + std::to_string(session.arrivals(late).size()), {{"next", next}});
    acknowledge(pipe, 'a');
  }
}

struct Acknowledged {
  std::size_t touches = 0;
  std::size_t pictures = 0;
  std::size_t results = 0;
  std::size_t late = 0;
  std::size_t together = 0;
  std::size_t arrivals = 0;
};

using Operator = void (*)(const std::filesystem::path& place, const Material& material, int pipe);

class KilledCampaign : public ::testing::Test {
 protected:
  void SetUp() override {
    material_ = makeMaterial(folder_);
    Session session = Session::create(place());
    touched_ = session.newCampaign("touched", "2026-01-31T08:00:00Z", material_.machine);
    seen_ = session.newCampaign("seen", "2026-01-31T08:00:00Z", material_.machine);
  }
  [[nodiscard]] std::filesystem::path place() const { return folder_ / "session"; }

  /// Starts the program, kills it after `letters` acknowledgements and `delay`, and counts what it acknowledged.
  void runAndKill(int letters, std::chrono::microseconds delay, Operator work = operate) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      try {
        work(place(), material_, ends[1]);
      } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
      }
      ::_exit(3);
    }
    ::close(ends[1]);
    char letter = 0;
    for (int i = 0; i < letters && ::read(ends[0], &letter, 1) == 1; ++i) count(letter);
    std::this_thread::sleep_for(delay);
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the program ended by itself, exit " << WEXITSTATUS(status);
    while (::read(ends[0], &letter, 1) == 1) count(letter);
    ::close(ends[0]);
  }

  void count(char letter) {
    acknowledged_.touches += letter == 'c' ? 1 : 0;
    acknowledged_.pictures += letter == 'p' ? 1 : 0;
    acknowledged_.results += letter == 'r' ? 1 : 0;
    acknowledged_.late += letter == 'l' ? 1 : 0;
    acknowledged_.together += letter == 'b' ? 1 : 0;
    acknowledged_.arrivals += letter == 'a' ? 1 : 0;
  }

  /// Everything acknowledged is there and whole; beyond it at most the one item that was in work.
  void check() {
    const Session session = Session::open(place());
    ASSERT_EQ(session.recoveryMessages().size(), 1U) << "the user hears that the program did not end in order";
    const CampaignRecord touched = session.campaign(touched_);
    const CampaignRecord seen = session.campaign(seen_);
    const std::size_t touches = checkTouches(touched.folder);
    checkPictures(seen.folder);
    const std::vector<StoredResult> results = session.results(touched_);
    EXPECT_GE(results.size(), acknowledged_.results);
    EXPECT_LE(results.size(), acknowledged_.results + 1);
    acknowledged_.results = results.size();
    if (!results.empty()) {
      const nlohmann::json& payload = results.back().payload;
      EXPECT_FALSE(ObservationSet::parse(payload.at("observations").get<std::string>(), "stored").rows.empty());
      EXPECT_EQ(session.isCurrent(results.back()), payload.at("captures").get<std::size_t>() == touches)
          << "a result is current as long as no capture came after it";
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place())) {
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    }
  }

  std::size_t checkTouches(const std::filesystem::path& campaign) {
    (void)Campaign::read(campaign);
    const std::vector<std::string> lines = linesOf(campaign / "captures/touches.csv");
    const std::size_t rows = lines.empty() ? 0 : lines.size() - 1;
    EXPECT_GE(rows, acknowledged_.touches) << "an acknowledged touch was lost";
    EXPECT_LE(rows, acknowledged_.touches + 1);
    for (std::size_t i = 0; i < rows; ++i) EXPECT_EQ(lines[i + 1], material_.touches[i]);
    acknowledged_.touches = rows;
    return rows;
  }

  void checkPictures(const std::filesystem::path& campaign) {
    const std::vector<std::string> lines = linesOf(campaign / "captures/pictures.csv");
    const std::size_t rows = lines.empty() ? 0 : lines.size() - 1;
    EXPECT_GE(rows, acknowledged_.pictures) << "an acknowledged picture was lost";
    EXPECT_LE(rows, acknowledged_.pictures + 1);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::string name = lines[i + 1].substr(lines[i + 1].find(',') + 1);
      EXPECT_EQ(readFile(campaign / name), readFile(material_.picture(std::stoul(lines[i + 1]))));
    }
    acknowledged_.pictures = rows;
  }

  TempFolder folder_;
  Material material_;
  std::int64_t touched_ = 0;
  std::int64_t seen_ = 0;
  Acknowledged acknowledged_;
};

TEST_F(KilledCampaign, LosesNothingThatWasAcknowledged) {
  std::mt19937 random(20260131);
  std::uniform_int_distribution<int> letters(1, 16);
  std::uniform_int_distribution<int> delay_us(0, 6000);
  for (int kill = 0; kill < kills; ++kill) {
    SCOPED_TRACE("kill " + std::to_string(kill));
    ASSERT_NO_FATAL_FAILURE(runAndKill(letters(random), std::chrono::microseconds(delay_us(random))));
    ASSERT_NO_FATAL_FAILURE(check());
    if (HasFailure()) return;
  }
  EXPECT_GT(acknowledged_.touches, 130U);
  EXPECT_GT(acknowledged_.pictures, 40U);
  EXPECT_GT(acknowledged_.results, 15U);

  // What survived 50 crashes evaluates as the same touches taken in one go.
  Session session = Session::open(place());
  std::string whole = material_.header + "\n";
  for (std::size_t i = 0; i < acknowledged_.touches; ++i) whole += material_.touches[i] + "\n";
  folder_.write("source/captures/touches.csv", whole);
  JobContext job;
  EXPECT_EQ(evaluated(session, touched_).at("observations"),
            evaluateCampaign(Campaign::read(folder_ / "source"), {}, job).observations.csv());
}

/// A batch of exclusions is in the session as a whole or not at all, and what is typed survives to the last letter that
/// was acknowledged.
TEST_F(KilledCampaign, LeavesABatchWholeAndWhatWasTyped) {
  constexpr std::size_t batch = 400;
  const auto items = [](bool out) {
    std::vector<Exclusion> all;
    for (std::size_t i = 0; i < batch; ++i) all.push_back({"M" + std::to_string(i) + "/P1/EX", out ? "loose" : "", {}});
    return all;
  };
  std::mt19937 random(20260201);
  std::uniform_int_distribution<int> delay_us(0, 4000);
  std::size_t whole = 0;
  std::size_t none = 0;
  std::size_t typed = 0;
  for (int kill = 0; kill < kills; ++kill) {
    SCOPED_TRACE("kill " + std::to_string(kill));
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      Session session = Session::open(place());
      for (bool out = session.exclusions(touched_).empty();; out = !out) {
        session.setSetting("draft/machine/1", {{"base", 0}, {"typed", ++typed}});
        acknowledge(ends[1], 'd');
        session.exclude(touched_, items(out));
      }
    }
    ::close(ends[1]);
    char letter = 0;
    std::size_t acknowledged = typed;
    for (int i = 0; i < 2 + kill % 2 && ::read(ends[0], &letter, 1) == 1; ++i) ++acknowledged;
    std::this_thread::sleep_for(std::chrono::microseconds(delay_us(random)));
    ::kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    while (::read(ends[0], &letter, 1) == 1) ++acknowledged;
    ::close(ends[0]);
    const Session session = Session::open(place());
    const std::size_t out = session.exclusions(touched_).size();
    ASSERT_TRUE(out == 0 || out == batch) << out << " of " << batch << " are left out";
    ++(out == 0 ? none : whole);
    typed = session.setting("draft/machine/1")->at("typed");
    EXPECT_GE(typed, acknowledged);
    EXPECT_LE(typed, acknowledged + 1);
  }
  EXPECT_GT(whole, 5U);
  EXPECT_GT(none, 5U);
}

TEST_F(KilledCampaign, LosesNothingThatCameLateOrTogether) {
  std::mt19937 random(20260201);
  std::uniform_int_distribution<int> letters(1, 9);
  std::uniform_int_distribution<int> delay_us(0, 4000);
  for (int kill = 0; kill < kills; ++kill) {
    SCOPED_TRACE("kill " + std::to_string(kill));
    ASSERT_NO_FATAL_FAILURE(
        runAndKill(letters(random), std::chrono::microseconds(delay_us(random)), takeLateAndTogether));
    const Session session = Session::open(place());
    const CampaignRecord late = session.campaign(touched_);
    std::size_t rows = rowsOf(late);
    EXPECT_GE(rows, acknowledged_.late) << "an acknowledged touch was lost";
    EXPECT_LE(rows, acknowledged_.late + 1);
    acknowledged_.late = rows;
    std::vector<std::string> lines = linesOf(late.folder / "captures/touches.csv");
    for (std::size_t i = 0; i < rows; ++i) {
      // The last one of an odd number waits for the one before it.
      EXPECT_EQ(lines[i + 1], material_.touches[rows % 2 == 1 && i + 1 == rows ? rows : i]) << i << " of " << rows;
    }
    const CampaignRecord together = session.campaign(seen_);
    rows = rowsOf(together);
    EXPECT_EQ(rows % 3, 0U) << "a part of what came together";
    EXPECT_GE(rows, 3 * acknowledged_.together);
    EXPECT_LE(rows, 3 * (acknowledged_.together + 1));
    acknowledged_.together = rows / 3;
    lines = linesOf(together.folder / "captures/touches.csv");
    for (std::size_t i = 0; i < rows; ++i) EXPECT_EQ(lines[i + 1], material_.touches[i]);
    const std::size_t arrivals = session.arrivals(touched_).size();
    EXPECT_GE(arrivals, acknowledged_.arrivals);
    EXPECT_LE(arrivals, acknowledged_.arrivals + 1);
    acknowledged_.arrivals = arrivals;
    // What the session knows of the lists is what they are.
    EXPECT_EQ(session.campaign(touched_).fingerprint, fingerprintOfFolder(late.folder));
    EXPECT_EQ(session.campaign(seen_).fingerprint, fingerprintOfFolder(together.folder));
    if (HasFailure()) return;
  }
  EXPECT_GT(acknowledged_.late, 50U);
}

}  // namespace
}  // namespace spindrift
