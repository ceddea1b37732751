// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/child_program.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>

#include "core/base/error.h"

namespace spindrift {
namespace {

/// A log beyond this size is of a program that prints without an end.
constexpr std::uintmax_t most_output_bytes = 256u << 20;
constexpr std::chrono::milliseconds longest_nap{40};

std::vector<std::string> environmentWith(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> out;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!changes.contains(text.substr(0, text.find('=')))) out.push_back(text);
  }
  for (const auto& [name, value] : changes) out.push_back(name + "=" + value);
  return out;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
  std::vector<char*> out;
  out.reserve(texts.size() + 1);
  for (std::string& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

/// What the program starts with: folder, no input, the log as output, no other open file, a process group of its own.
class SpawnSettings {
 public:
  explicit SpawnSettings(const ChildProgram& program) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, program.folder.c_str());
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, program.log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    posix_spawn_file_actions_addclosefrom_np(&actions, 3);
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigset_t all;
    sigemptyset(&none);
    sigfillset(&all);
    sigdelset(&all, SIGKILL);
    sigdelset(&all, SIGSTOP);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
};

/// Ends the whole group and takes the state of its leader. While the leader is not reaped its number is not given away.
int endGroup(pid_t leader) {
  ::kill(-leader, SIGKILL);
  int state = 0;
  while (::waitpid(leader, &state, 0) < 0 && errno == EINTR) {
  }
  return state;
}

}  // namespace

ChildEnd runProgram(const ChildProgram& program, const JobContext& job) {
  SPINDRIFT_ASSERT(!program.command.empty() && program.log.is_absolute(), "a program, and where its output goes");
  job.throwIfCancelled();
  const auto started = std::chrono::steady_clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  };
  std::vector<std::string> arguments = program.command;
  std::vector<std::string> environment = environmentWith(program.environment);
  const std::vector<char*> argument_pointers = pointersTo(arguments);
  const std::vector<char*> environment_pointers = pointersTo(environment);
  pid_t child = 0;
  {
    const SpawnSettings settings(program);
    const int error = ::posix_spawnp(&child, arguments.front().c_str(), &settings.actions, &settings.attributes,
                                     argument_pointers.data(), environment_pointers.data());
    if (error != 0) return {ChildEnd::How::NotStarted, error, elapsed_s()};
  }
  std::chrono::milliseconds nap{1};
  for (;;) {
    siginfo_t info{};
    const int asked = ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
    if (asked == 0 && info.si_pid == child) break;
    if (asked != 0 && errno != EINTR) return {ChildEnd::How::NotStarted, errno, elapsed_s()};
    if (job.cancelled()) {
      endGroup(child);
      throw Cancelled();
    }
    if (elapsed_s() > program.time_limit_s) {
      endGroup(child);
      return {ChildEnd::How::TimeOut, 0, elapsed_s()};
    }
    std::error_code ignored;
    const std::uintmax_t printed = std::filesystem::file_size(program.log, ignored);
    if (!ignored && printed > most_output_bytes) {
      endGroup(child);
      return {ChildEnd::How::TooMuchOutput, 0, elapsed_s()};
    }
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, longest_nap);
  }
  const int state = endGroup(child);
  if (WIFSIGNALED(state)) return {ChildEnd::How::Signalled, WTERMSIG(state), elapsed_s()};
  return {ChildEnd::How::Exited, WEXITSTATUS(state), elapsed_s()};
}

}  // namespace spindrift
