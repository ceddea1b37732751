// SPDX-License-Identifier: Apache-2.0
#include "core/connect/hal_commands.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>

#include "core/base/steady_seconds.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/connect/source.h"

namespace spindrift {
namespace {

/// "<stdin>:12: signal 'x' not found".
bool isRefusal(const std::string& line) {
  return line.starts_with("<stdin>");
}

}  // namespace

bool isHalName(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_' || c == ':';
  });
}

void HalCommands::fail(const std::string& what) {
  close();
  throw ConnectionError(fmt::format("HAL of LinuxCNC (halcmd) {}.", what));
}

void HalCommands::start() {
  close();
  // A pair of sockets in place of pipes: writing to a child that has gone is then an error and no signal.
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    fail(fmt::format("cannot be started: {}", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int target : {0, 1, 2}) posix_spawn_file_actions_adddup2(&actions, ends[1], target);
  std::array<std::string, 4> words{"halcmd", "-s", "-k", "-f"};
  std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  const int error = ::posix_spawnp(&child_, "halcmd", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    child_ = -1;
    fail(error == ENOENT ? "is not on this computer; HAL is read where the control runs (package linuxcnc-uspace)"
                         : fmt::format("cannot be started: {}", std::strerror(error)));
  }
  pipe_ = ends[0];
  ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
  (void)run({});
}

void HalCommands::close() noexcept {
  if (pipe_ >= 0) ::close(pipe_);
  pipe_ = -1;
  pending_.clear();
  if (child_ <= 0) return;
  // It ends by itself at the end of its input.
  int status = 0;
  pid_t gone = 0;
  for (int i = 0; i < 50 && gone == 0; ++i) {
    gone = ::waitpid(child_, &status, WNOHANG);
    if (gone == 0) ::usleep(2000);
  }
  if (gone == 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, &status, 0);
  }
  child_ = -1;
}

void HalCommands::write(const std::string& bytes) {
  if (pipe_ < 0) throw ConnectionError("HAL of LinuxCNC (halcmd) is not started.");
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::send(pipe_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
      continue;
    }
    pollfd wait{pipe_, POLLOUT, 0};
    if ((errno != EAGAIN && errno != EINTR) || ::poll(&wait, 1, static_cast<int>(answer_s_ * 1e3)) == 0)
      fail(fmt::format("ended: {}", std::strerror(errno)));
  }
}

std::string HalCommands::line(double until_s) {
  while (true) {
    const std::size_t end = pending_.find('\n');
    if (end != std::string::npos) {
      std::string out(trimmed(std::string_view(pending_).substr(0, end)));
      pending_.erase(0, end + 1);
      return out;
    }
    const double left_s = until_s - steadySeconds();
    if (left_s <= 0.0) fail(fmt::format("does not answer within {:g} s", answer_s_));
    pollfd wait{pipe_, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(left_s * 1e3) + 1) <= 0) continue;
    char bytes[8192];
    const ssize_t count = ::read(pipe_, bytes, sizeof bytes);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) {
      const std::string said = printable(beginning(std::string(trimmed(pending_)), 160));
      fail("ended: no control runs here, or another user runs it" + (said.empty() ? "" : " (" + said + ")"));
    }
    pending_.append(bytes, static_cast<std::size_t>(count));
  }
}

std::vector<std::string> HalCommands::run(const std::vector<std::string>& commands) {
  std::string bytes;
  for (const std::string& command : commands) bytes += command + "\n";
  const std::string mark = fmt::format("spindrift-end-{}", ++mark_);
  write(bytes + "getp " + mark + "\n");
  std::vector<std::string> out;
  const double until = steadySeconds() + answer_s_;
  for (std::string said = line(until); said.find(mark) == std::string::npos; said = line(until))
    out.push_back(std::move(said));
  return out;
}

std::vector<std::optional<std::string>> HalCommands::read(const std::vector<std::string>& names) {
  // A refusal names what it refuses, so that answers and names go together also when one is missing. A name may be that
  // of a pin or of a signal: the second is asked for where the first is not there.
  std::vector<std::optional<std::string>> out(names.size());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (isHalName(names[i])) open.push_back(i);
  }
  for (const char* command : {"getp ", "gets "}) {
    if (open.empty()) break;
    std::vector<std::string> commands;
    for (const std::size_t i : open) commands.push_back(command + names[i]);
    std::vector<std::string> said = run(commands);
    std::erase_if(said, [](const std::string& each) { return each.empty(); });
    if (said.size() != open.size()) fail(fmt::format("gave {} answers to {} questions", said.size(), open.size()));
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (isRefusal(said[k])) {
        missing.push_back(open[k]);
      } else {
        out[open[k]] = said[k];
      }
    }
    open = missing;
  }
  return out;
}

void HalCommands::setSignals(const std::vector<std::pair<std::string, double>>& values) {
  std::vector<std::string> commands;
  for (const auto& [name, value] : values) commands.push_back(fmt::format("sets {} {:.9g}", name, value));
  const std::vector<std::string> said = run(commands);
  if (!said.empty()) throw ConnectionError(fmt::format("HAL of LinuxCNC refuses: {}.", printable(said.front())));
}

void HalCommands::setPin(const std::string& name, const std::string& value) {
  const std::vector<std::string> said = run({fmt::format("setp {} {}", name, value)});
  if (!said.empty()) throw ConnectionError(fmt::format("HAL of LinuxCNC refuses: {}.", printable(said.front())));
}

std::vector<HalCommands::Pin> HalCommands::list() {
  std::vector<Pin> out;
  for (const bool pins : {true, false}) {
    for (const std::string& each : run({pins ? "show pin" : "show sig"})) {
      // "owner type direction value name ..." and "type value name ...".
      std::istringstream words(each);
      std::string owner, direction;
      Pin pin;
      if (pins) words >> owner;
      words >> pin.type;
      if (pins) words >> direction;
      words >> pin.value >> pin.name;
      const bool known = pin.type == "float" || pin.type == "bit" || pin.type == "s32" || pin.type == "u32";
      if (known && isHalName(pin.name)) out.push_back(std::move(pin));
    }
  }
  return out;
}

}  // namespace spindrift
