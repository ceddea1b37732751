// SPDX-License-Identifier: Apache-2.0
// A LinuxCNC of its own: started with a configuration, ended with all that it started.
//
// LinuxCNC has names of the whole machine (shared memory, ports, a lock file, processes that it ends by name), so that
// a second one needs namespaces of its own. isolated() makes them (network, shared memory, mounts, processes), which
// only root may; whatever is started inside is gone when it returns, also when this program is killed.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace spindrift {

/// Empty if a private control can be had here, else why not: not installed, no right to namespaces.
[[nodiscard]] std::string whyNoPrivateControl();

/// Runs `body` in a child process in namespaces of its own, with a private /tmp in which only `kept` folders are those
/// of outside. Returns what `body` returned, "exception: ...", or "ended by signal N"; gone after `limit_s` at most.
[[nodiscard]] std::string isolated(const std::function<std::string()>& body,
                                   const std::vector<std::filesystem::path>& kept, double limit_s);

class LinuxcncProcess {
 public:
  /// Starts `linuxcnc` with spindrift.ini in `folder`; what it says goes to control.log there. Throws InputError.
  explicit LinuxcncProcess(std::filesystem::path folder);
  ~LinuxcncProcess() { stop(); }
  LinuxcncProcess(const LinuxcncProcess&) = delete;
  LinuxcncProcess& operator=(const LinuxcncProcess&) = delete;
  /// As it should be; within 20 s, after that by force.
  void stop() noexcept;
  /// As an accident would: the launcher, the shell and the tasks at once.
  void kill() noexcept;
  [[nodiscard]] pid_t pid() const noexcept { return child_; }

 private:
  std::filesystem::path folder_;
  pid_t child_ = -1;
  int input_ = -1;
};

}  // namespace spindrift
