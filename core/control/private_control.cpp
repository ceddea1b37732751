// SPDX-License-Identifier: Apache-2.0
#include "core/control/private_control.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <net/if.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>

#include "core/base/error.h"
#include "core/base/steady_seconds.h"

namespace spindrift {
namespace {

constexpr int namespaces = CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWNS | CLONE_NEWPID;
constexpr const char* nobody = "65534";

void need(bool good, const char* what) {
  if (!good) throw InputError(fmt::format("A private control cannot be made: {}: {}.", what, std::strerror(errno)));
}

void loopbackUp() {
  const int handle = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ - 1);
  request.ifr_flags = IFF_UP;
  const int failed = ::ioctl(handle, SIOCSIFFLAGS, &request);
  ::close(handle);
  need(failed == 0, "loopback");
}

/// In the namespaces, as their first process' child: mounts, then the body.
std::string inside(const std::function<std::string()>& body, const std::vector<std::filesystem::path>& kept) {
  // Handles of this mount namespace: what was opened in another cannot be bound here.
  std::vector<int> handles;
  for (const std::filesystem::path& folder : kept) handles.push_back(::open(folder.c_str(), O_PATH | O_CLOEXEC));
  need(::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0, "mounts");
  need(::mount("proc", "/proc", "proc", 0, nullptr) == 0, "/proc");
  need(::mount("tmpfs", "/tmp", "tmpfs", 0, "mode=1777") == 0, "/tmp");
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i].string().starts_with("/tmp/")) continue;
    std::filesystem::create_directories(kept[i]);
    const std::string from = fmt::format("/proc/self/fd/{}", handles[i]);
    need(::mount(from.c_str(), kept[i].c_str(), nullptr, MS_BIND, nullptr) == 0, "a folder");
  }
  loopbackUp();
  ::setenv("HOME", "/tmp", 1);
  ::setenv("RTAPI_UID", nobody, 1);  // the real-time part refuses root
  return body();
}

int childOf(const std::function<std::string()>& body, const std::vector<std::filesystem::path>& kept, int answer_to) {
  // The first process of the namespace: it reaps what others leave, and everything ends with it.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const pid_t worker = ::fork();
  if (worker == 0) {
    std::string answer;
    try {
      answer = inside(body, kept);
    } catch (const std::exception& error) {
      answer = std::string("exception: ") + error.what();
    }
    for (std::size_t done = 0; done < answer.size();) {
      const ssize_t count = ::write(answer_to, answer.data() + done, answer.size() - done);
      if (count <= 0) break;
      done += static_cast<std::size_t>(count);
    }
    ::_exit(0);
  }
  ::close(answer_to);
  int status = 0;
  for (pid_t gone = 0; gone != worker;) {
    gone = ::waitpid(-1, &status, 0);
    if (gone < 0 && errno != EINTR) break;
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : 0;
}

}  // namespace

std::string whyNoPrivateControl() {
  bool there = false;
  const char* path = std::getenv("PATH");
  std::string folders = path == nullptr ? "/usr/bin" : path;
  for (std::size_t begin = 0; begin <= folders.size() && !there;) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    there = ::access((folders.substr(begin, end - begin) + "/linuxcncrsh").c_str(), X_OK) == 0;
    begin = end + 1;
  }
  if (!there) return "LinuxCNC is not installed here (package linuxcnc-uspace)";
  const pid_t child = ::fork();
  if (child == 0) ::_exit(::unshare(namespaces) == 0 ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return "this user may not make namespaces of network, shared memory, mounts and processes (unshare)";
  return {};
}

std::string isolated(const std::function<std::string()>& body, const std::vector<std::filesystem::path>& kept,
                     double limit_s) {
  std::array<int, 2> ends{};
  need(::pipe2(ends.data(), O_CLOEXEC) == 0, "a pipe");
  const pid_t outer = ::fork();
  if (outer == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::close(ends[0]);
    if (::unshare(namespaces) != 0) ::_exit(1);
    const pid_t first = ::fork();
    if (first == 0) ::_exit(childOf(body, kept, ends[1]));
    ::close(ends[1]);
    int status = 0;
    ::waitpid(first, &status, 0);
    ::_exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + SIGKILL);
  }
  ::close(ends[1]);
  std::string answer;
  bool in_time = true;
  for (const double until = steadySeconds() + limit_s;;) {
    pollfd wait{ends[0], POLLIN, 0};
    const double left_s = until - steadySeconds();
    if (left_s <= 0.0) {
      in_time = false;
      break;
    }
    if (::poll(&wait, 1, static_cast<int>(std::min(left_s, 1.0) * 1e3) + 1) <= 0) continue;
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(ends[0], bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    answer.append(bytes.data(), static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  if (!in_time) ::kill(outer, SIGKILL);
  int status = 0;
  ::waitpid(outer, &status, 0);
  if (!in_time) return fmt::format("exception: not done within {:g} s", limit_s);
  if (WIFEXITED(status) && WEXITSTATUS(status) > 128)
    return fmt::format("ended by signal {}", WEXITSTATUS(status) - 128);
  return answer;
}

LinuxcncProcess::LinuxcncProcess(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::array<int, 2> ends{};
  need(::pipe2(ends.data(), O_CLOEXEC) == 0, "a pipe");
  const std::string log = (folder_ / "control.log").string();
  child_ = ::fork();
  need(child_ >= 0, "a process");
  if (child_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    ::setsid();
    const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    ::dup2(ends[0], 0);
    ::dup2(out, 1);
    ::dup2(out, 2);
    if (::chdir(folder_.c_str()) != 0) ::_exit(126);
    ::execlp("linuxcnc", "linuxcnc", "-r", "spindrift.ini", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(ends[0]);
  input_ = ends[1];
}

void LinuxcncProcess::stop() noexcept {
  if (input_ >= 0) ::close(input_);  // the end of its input is its wish to end
  input_ = -1;
  if (child_ <= 0) return;
  int status = 0;
  for (int i = 0; i < 2000; ++i) {
    if (::waitpid(child_, &status, WNOHANG) != 0) {
      child_ = -1;
      return;
    }
    ::usleep(10000);
  }
  ::kill(-child_, SIGKILL);
  ::waitpid(child_, &status, 0);
  child_ = -1;
}

void LinuxcncProcess::kill() noexcept {
  if (child_ <= 0) return;
  ::kill(-child_, SIGKILL);
  int status = 0;
  ::waitpid(child_, &status, 0);
  child_ = -1;
  if (input_ >= 0) ::close(input_);
  input_ = -1;
}

}  // namespace spindrift
