// SPDX-License-Identifier: GPL-3.0-or-later
// loop PLAN.json as an operator runs it: the built program against a real LinuxCNC (skipped where it is absent) with
// the virtual machine beside it, all in processes of their own, and killed at random times. SPINDRIFT_KILLS=20 for more
// than the three kills of every day.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <list>
#include <sstream>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/connect/hal_commands.h"
#include "core/connect/linuxcnc_shell.h"
#include "core/connect/source.h"
#include "core/control/private_control.h"
#include "tests/core/control/on_private_control.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

constexpr double factor = 120.0;
const std::filesystem::path base = "/tmp/loop";

int kills() {
  const char* wanted = std::getenv("SPINDRIFT_KILLS");
  return wanted == nullptr ? 3 : std::max(1, std::atoi(wanted));
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A process that ends with this one; what it says goes to a file.
struct Process {
  pid_t id = -1;
  ~Process() { end(SIGKILL); }
  Process() = default;
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  void start(const std::vector<std::string>& words, const std::filesystem::path& out,
             const std::filesystem::path& where = "/tmp") {
    end(SIGKILL);
    id = ::fork();
    if (id != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int file = ::open(out.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, 0);
    ::dup2(file, 1);
    ::dup2(file, 2);
    if (::chdir(where.c_str()) != 0) ::_exit(126);
    std::vector<char*> pointers;
    for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    ::execvp(pointers[0], pointers.data());
    ::_exit(127);
  }
  /// Exit status, or -1 while it runs.
  int status() {
    int status = 0;
    if (id <= 0 || ::waitpid(id, &status, WNOHANG) == 0) return -1;
    id = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  void end(int signal) {
    if (id <= 0) return;
    ::kill(id, signal);
    int status = 0;
    ::waitpid(id, &status, 0);
    id = -1;
  }
};

/// Processes of this name, in these namespaces.
std::vector<pid_t> processesNamed(const std::string& name) {
  std::vector<pid_t> out;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream in(entry.path() / "comm");
    std::string comm;
    if (std::getline(in, comm) && comm == name) out.push_back(std::atoi(entry.path().filename().c_str()));
  }
  return out;
}

template <typename Condition>
bool waitFor(const Condition& condition, double patience_s) {
  for (const double until = now() + patience_s; now() < until;) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

std::string contents(const std::filesystem::path& file) {
  return std::filesystem::exists(file) ? readFile(file) : std::string();
}

/// The example of the program, with a control and a machine that run; the loop is started by its plan.
struct Story {
  explicit Story(double hours, const nlohmann::json& changes) {
    Process example;
    example.start({SPINDRIFT_CLI, "loop", "--example", base.string(), "--factor", fmt::format("{}", factor), "--hours",
                   fmt::format("{}", hours)},
                  "/tmp/example.txt");
    int status = -1;
    (void)waitFor([&] { return (status = example.status()) >= 0; }, 20.0);
    if (status != 0) throw InputError("The example is not written: " + contents("/tmp/example.txt"));
    nlohmann::json plan = JsonNode::read(base / "plan.json").value();
    plan.merge_patch(changes);
    writeFileAtomically(base / "plan.json", plan.dump());
    startControl();
    machine.start(
        {SPINDRIFT_CLI, "virtual-machine", (base / "truth.json").string(), "--truth", (base / "truth.csv").string(),
         "--factor", fmt::format("{}", factor), "--hours", fmt::format("{}", 3.0 * hours)},
        "/tmp/machine.txt");
  }
  void startControl() {
    control = std::make_unique<LinuxcncProcess>(base / "control");
    if (!waitFor(
            [&] {
              try {
                LinuxcncShell shell({});
                shell.connect({});
                return true;
              } catch (const ConnectionError&) {
                return false;
              }
            },
            20.0))
      throw InputError("The control does not start.");
  }
  void startLoop() {
    loop.start({SPINDRIFT_CLI, "loop", (base / "plan.json").string(), "--out", campaign.string(), "--yes"},
               "/tmp/loop.txt");
  }
  [[nodiscard]] nlohmann::json state() const { return JsonNode::read(campaign / "loop-state.json").value(); }
  [[nodiscard]] double time_s() const {
    return std::filesystem::exists(campaign / "loop-state.json") ? state()["time_s"].get<double>() : 0.0;
  }
  [[nodiscard]] std::size_t cycles() const {
    return std::filesystem::exists(campaign / "loop-state.json") ? state()["result"]["cycles"].size() : 0;
  }
  const std::filesystem::path campaign = base / "campaign";
  std::unique_ptr<LinuxcncProcess> control;
  Process machine;
  Process loop;
};

/// What the drives add now, um; nothing where HAL is not there.
std::optional<double> applied_um(HalCommands& watch) {
  try {
    if (!watch.started()) watch.start();
    double value = 0.0;
    const auto text = watch.read({"offset-z.offset"}).at(0);
    if (!text || !parseNumber(*text, value)) return std::nullopt;
    return 1e3 * value;
  } catch (const ConnectionError&) {
    return std::nullopt;
  }
}

class LoopCommandOnAControl : public OnPrivateControl {};

TEST(LoopCommand, TheExampleOfTheResourcesIsThatOfTheProgram) {
  const TempFolder folder;
  Process example;
  example.start({SPINDRIFT_CLI, "loop", "--example", folder.path().string()}, folder / "out.txt");
  int status = -1;
  ASSERT_TRUE(waitFor([&] { return (status = example.status()) >= 0; }, 20.0));
  ASSERT_EQ(status, 0) << contents(folder / "out.txt");
  for (const char* name :
       {"plan.json", "machine.json", "simulation.json", "truth.json", "control/spindrift.hal", "control/spindrift.ini"})
    EXPECT_EQ(contents(folder / name), contents(sourceFolder() / "resources/loop" / name)) << name;
  Process dry;
  dry.start({SPINDRIFT_CLI, "loop", (folder / "plan.json").string(), "--dry-run"}, folder / "dry.txt");
  ASSERT_TRUE(waitFor([&] { return (status = dry.status()) >= 0; }, 20.0));
  EXPECT_EQ(status, 0);
  EXPECT_THAT(contents(folder / "dry.txt"), ::testing::HasSubstr("6 touches"));
}

TEST_F(LoopCommandOnAControl, ClosesTheLoopByItsPlanAloneOnARealControl) {
  EXPECT_EQ(isolated(
                [] {
                  Story story(1.0, {{"identify_s", 0}, {"discrepancy_s", 0}});
                  story.startLoop();
                  int status = -1;
                  if (!waitFor([&] { return (status = story.loop.status()) >= 0; }, 100.0))
                    return std::string("does not end");
                  if (status != 0) return fmt::format("status {}: {}", status, contents("/tmp/loop.txt"));
                  const nlohmann::json out = JsonNode::read(story.campaign / "loop.json").value();
                  std::string wrong;
                  if (!out["completed"].get<bool>()) wrong += "not completed; ";
                  const double without = out["rms_without_um"]["EZ"].get<double>(),
                               with = out["rms_with_um"]["EZ"].get<double>();
                  if (!(without > 5.0 && with < 0.3 * without)) wrong += fmt::format("EZ {} -> {} um; ", without, with);
                  if (contents("/tmp/loop.txt").find("active: X") == std::string::npos) wrong += "no status said; ";
                  if (!std::filesystem::exists(story.campaign / "report.html")) wrong += "no report; ";
                  return wrong;
                },
                {}, 180.0),
            "");
}

/// Loop, its client of the control (shell and pins in turn), or the control itself is killed; everything comes back.
std::string killedInTheLoop() {
  Random random(20261123);
  Story story(6.0, {{"identify_s", 3000}, {"discrepancy_s", 0}, {"measure_every_s", 600}, {"patience_s", 60}});
  HalCommands watch;
  std::list<Process> shells;
  story.startLoop();
  if (!waitFor([&] { return story.cycles() >= 2 && std::abs(applied_um(watch).value_or(0.0)) > 1.0; }, 60.0))
    return "the loop does not begin: " + contents("/tmp/loop.txt");
  std::string wrong, log, observations;
  double largest_um = 0.0;
  for (int k = 0; k < kills() && wrong.empty(); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(static_cast<int>(random.uniform(200.0, 4000.0))));
    const auto mishap = [&](const std::string& what) { wrong += fmt::format("kill {}: {}; ", k, what); };
    const double time_before_s = story.time_s();
    if (k % 3 == 0) {
      story.loop.end(SIGKILL);
      // Nobody writes any more: without a visible step to zero.
      double last = applied_um(watch).value_or(0.0);
      largest_um = std::max(largest_um, std::abs(last));
      const bool faded = waitFor(
          [&] {
            const double value = applied_um(watch).value_or(std::nan(""));
            if (std::abs(value - last) > 15.0) mishap(fmt::format("a step of {} um", value - last));
            last = value;
            return std::abs(value) < 0.01;
          },
          10.0);
      if (!faded) mishap(fmt::format("{} um left", last));
      story.startLoop();
    } else if (k % 3 == 1) {
      const bool shell = (k / 3) % 2 == 0;
      for (const pid_t id : processesNamed(shell ? "linuxcncrsh" : "halcmd")) ::kill(id, SIGKILL);
      watch.close();
      // As an operator would: the shell alone, beside a control that goes on.
      if (shell)
        shells.emplace_back().start({"linuxcncrsh", "--", "-ini", "spindrift.ini"}, "/tmp/shell.txt", base / "control");
    } else {
      story.control->kill();
      watch.close();
      story.startControl();
    }
    // Everything that was written still stands, and the loop goes on and compensates.
    const auto resumed = [&] {
      return story.time_s() > time_before_s + 240.0 && std::abs(applied_um(watch).value_or(0.0)) > 0.5;
    };
    if (!waitFor(resumed, 60.0)) mishap("the loop does not go on: " + contents("/tmp/loop.txt"));
    const std::string log_now = contents(story.campaign / "log.csv");
    const std::string observations_now = contents(story.campaign / "observations.csv");
    if (!log_now.starts_with(log) || log_now.size() <= log.size()) mishap("the log lost rows");
    if (!observations_now.starts_with(observations)) mishap("observations were lost");
    log = log_now;
    observations = observations_now;
  }
  if (story.loop.status() >= 0) wrong += "the loop has ended: " + contents("/tmp/loop.txt");
  return wrong;
}

TEST_F(LoopCommandOnAControl, KilledAtRandomTimesItLosesNothingAndGoesOn) {
  EXPECT_EQ(isolated(killedInTheLoop, {}, 120.0 + 60.0 * kills()), "");
}

}  // namespace
}  // namespace spindrift::testing
