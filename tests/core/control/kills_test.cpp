// SPDX-License-Identifier: GPL-3.0-or-later
// Kills of what drives a compensation and of the control itself, on the real control. SPINDRIFT_KILLS=20 for more of
// them than the three of every day.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>

#include "core/base/text.h"
#include "core/control/compensation_channel.h"
#include "tests/core/control/private_configuration.h"

namespace spindrift::testing {
namespace {

int kills() {
  const char* wanted = std::getenv("SPINDRIFT_KILLS");
  return wanted == nullptr ? 3 : std::max(1, std::atoi(wanted));
}

ControlConfiguration quick() {
  ControlConfiguration c = cornerInTheMiddle();
  c.watchdog_s = 0.5;
  c.speed_mm_s = 0.04;
  c.acceleration_mm_s2 = 0.4;
  return c;
}

/// What the drives add now, um, seen from outside.
double applied(HalCommands& watch) {
  double value = std::nan("");
  (void)parseNumber(watch.read({"offset-z.offset"}).at(0).value_or(""), value);
  return 1e3 * value;
}

/// A process of its own that compensates until it is killed.
pid_t compensating(const std::filesystem::path& folder, bool hold) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  try {
    LinuxcncControlOptions options;
    options.folder = folder;
    LinuxcncControl control(options);
    control.connect({});
    control.switchOn(true);
    control.openChannel(hold);
    CompensationChannel channel({.limit_um = 50.0, .rate_um_s = 60.0, .step_um = 4.0, .oldest_s = 60.0});
    channel.begin(control.compensation().applied_um, 0.0);
    for (double t = 0.0;; t += 0.05) {
      CompensationChannel::Wish wish;
      wish.offset_um.z() = 20.0;
      (void)control.compensate(channel.next(wish, control.state(), t));
      ::usleep(50000);
    }
  } catch (const std::exception&) {
  }
  ::_exit(1);
}

std::string killedClients(bool hold) {
  std::string wrong;
  RunningControl running(quick());
  running.control->close();
  HalCommands watch;
  watch.start();
  for (int k = 0; k < kills() && wrong.empty(); ++k) {
    const pid_t client = compensating(running.folder, hold);
    if (!waitUntil([&] { return std::abs(applied(watch) - 20.0) < 0.05; }, 20.0))
      wrong += fmt::format("kill {}: {} um applied; ", k, applied(watch));
    ::kill(client, SIGKILL);
    int status = 0;
    ::waitpid(client, &status, 0);
    double last = applied(watch), largest = 0.0;
    const double expected = hold ? 20.0 : 0.0;
    for (int i = 0; i < 60; ++i) {
      ::usleep(50000);
      const double now = applied(watch);
      largest = std::max(largest, std::abs(now - last));
      last = now;
      if (!hold && std::abs(now) < 0.01) break;
    }
    if (std::abs(last - expected) > 0.05) wrong += fmt::format("kill {}: {} um afterwards; ", k, last);
    // 40 um/s in the control: 2 um in 50 ms, and a busy computer's delays.
    if (largest > 10.0) wrong += fmt::format("kill {}: a step of {} um; ", k, largest);
  }
  return wrong;
}

class Kills : public OnPrivateControl {};

TEST_F(Kills, OfTheDriverFadeTheCompensation) {
  EXPECT_EQ(isolated([] { return killedClients(false); }, {}, 60.0 + 12.0 * kills()), "");
}

TEST_F(Kills, OfTheDriverHoldItWhereThatWasChosen) {
  EXPECT_EQ(isolated([] { return killedClients(true); }, {}, 60.0 + 12.0 * kills()), "");
}

TEST_F(Kills, OfTheControlAreSaidAndBeginAtZeroAgain) {
  EXPECT_EQ(isolated(
                [] {
                  std::string wrong;
                  RunningControl running(quick());
                  for (int k = 0; k < kills() && wrong.empty(); ++k) {
                    running.control->switchOn(true);
                    running.control->openChannel(true);
                    CompensationStatus status;
                    for (int i = 0; i < 100 && std::abs(status.applied_um.z() - 10.0) > 0.01; ++i) {
                      status = running.control->compensate({0.0, 0.0, 10.0});
                      ::usleep(30000);
                    }
                    if (std::abs(status.applied_um.z() - 10.0) > 0.01)
                      wrong += fmt::format("kill {}: not applied; ", k);
                    running.process->kill();
                    const bool said = waitUntil(
                        [&] { return running.control->state().condition == ControlState::Condition::Unreachable; },
                        10.0);
                    if (!said) wrong += fmt::format("kill {}: not noticed; ", k);
                    running.start();
                    if (running.control->state().condition != ControlState::Condition::EmergencyStop)
                      wrong += fmt::format("kill {}: comes back as \"{}\"; ", k, running.control->state().sentence);
                    status = running.control->compensation();
                    if (status.applied_um.cwiseAbs().maxCoeff() > 0.01 || status.watched)
                      wrong += fmt::format("kill {}: comes back with {} um; ", k, status.applied_um.z());
                  }
                  return wrong;
                },
                {}, 60.0 + 20.0 * kills()),
            "");
}

}  // namespace
}  // namespace spindrift::testing
