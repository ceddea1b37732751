// SPDX-License-Identifier: Apache-2.0
#include "core/connect/linuxcnc_shell.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "core/base/steady_seconds.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/connect/source.h"

namespace spindrift {
namespace {

constexpr std::size_t longest_command = 240;  // 2.9 keeps 255 characters of a line
constexpr std::size_t longest_answer = 65536;

std::string upper(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::toupper(c); });
  return out;
}

std::string firstWord(std::string_view text) {
  return std::string(text.substr(0, text.find_first_of(" \t")));
}

/// Requests without a number for which linuxcncrsh reads through a null pointer.
bool crashes(const std::string& request) {
  constexpr std::array<std::string_view, 3> numbered{"spindle", "brake", "spindle_override"};
  return std::find(numbered.begin(), numbered.end(), trimmed(request)) != numbered.end();
}

}  // namespace

std::string LinuxcncShell::name() const {
  return fmt::format("LinuxCNC at {}:{}", options_.peer.host, options_.peer.port);
}

void LinuxcncShell::fail(const std::string& what) {
  close();
  throw ConnectionError(fmt::format("{} {}.", name(), what));
}

void LinuxcncShell::close() noexcept {
  if (handle_ >= 0) ::close(handle_);
  handle_ = -1;
  pending_.clear();
}

void LinuxcncShell::connect(const std::stop_token& stop) {
  close();
  handle_ = openTcp(options_.peer, options_.answer_s, stop);
  if (handle_ < 0) throw ConnectionError(fmt::format("{} was not connected: stopped.", name()));
  send(fmt::format("hello {} spindrift 1.0", options_.password));
  const std::string said = line(options_.answer_s);
  // Not what was said: it may repeat the password.
  if (!upper(said).starts_with("HELLO ACK"))
    fail("refuses the connection; allowed: linuxcncrsh with the password of its option --connectpw");
  send("set echo off");
  // Silent about a good "set" unless told otherwise; that one may be silent as well.
  send("set verbose on");
  while (!upper(line(options_.answer_s)).starts_with("SET VERBOSE ACK")) {
  }
}

std::optional<std::string> LinuxcncShell::get(const std::string& request) {
  if (crashes(request)) throw std::invalid_argument("linuxcncrsh needs a number after \"" + request + "\"");
  const std::string sent = "get " + request;
  send(sent);
  const std::string said = answer(sent, options_.answer_s);
  const std::string wanted = upper(firstWord(request));
  const std::string first = upper(firstWord(said));
  if (first == "GET" && upper(said).find("NAK") != std::string::npos) return std::nullopt;
  if (first != wanted)
    fail(fmt::format(
        "answers \"{}\" to \"{}\": another client of linuxcncrsh may be connected, and it can serve one only",
        printable(beginning(said, 60)), sent));
  return std::string(trimmed(std::string_view(said).substr(first.size())));
}

bool LinuxcncShell::set(const std::string& command, double patience_s) {
  const std::string sent = "set " + command;
  send(sent);
  const std::string said = upper(answer(sent, patience_s > 0.0 ? patience_s : options_.answer_s));
  const std::string wanted = "SET " + upper(firstWord(command));
  if (!said.starts_with(wanted))
    fail(fmt::format(
        "answers \"{}\" to \"{}\": another client of linuxcncrsh may be connected, and it can serve one only",
        printable(beginning(said, 60)), "set " + firstWord(command)));
  if (said.ends_with("NAK")) return false;
  if (!said.ends_with("ACK")) fail(fmt::format("neither accepts nor refuses \"set {}\"", firstWord(command)));
  return true;
}

std::vector<std::string> LinuxcncShell::errors() {
  constexpr std::size_t most = 100;
  std::vector<std::string> out;
  while (out.size() < most) {
    const std::optional<std::string> said = get("error");
    if (!said || *said == "OK") break;
    out.push_back(printable(beginning(*said, 200)));
  }
  return out;
}

void LinuxcncShell::send(const std::string& line) {
  if (!connected()) throw ConnectionError(fmt::format("{} is not connected.", name()));
  if (line.size() > longest_command || line.find_first_of("\r\n") != std::string::npos)
    throw std::invalid_argument(fmt::format("a command of one line with at most {} characters", longest_command));
  const std::string bytes = line + "\r\n";
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::send(handle_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (count >= 0) {
      done += static_cast<std::size_t>(count);
      continue;
    }
    pollfd wait{handle_, POLLOUT, 0};
    if ((errno != EAGAIN && errno != EINTR) || ::poll(&wait, 1, static_cast<int>(options_.answer_s * 1e3)) == 0)
      fail(fmt::format("ended: {}", std::strerror(errno)));
  }
}

std::string LinuxcncShell::line(double patience_s) {
  const double until = steadySeconds() + patience_s;
  while (true) {
    const std::size_t begin = pending_.find_first_not_of("\r\n");
    const std::size_t end = begin == std::string::npos ? begin : pending_.find_first_of("\r\n", begin);
    if (end != std::string::npos) {
      std::string out(trimmed(std::string_view(pending_).substr(begin, end - begin)));
      pending_.erase(0, end + 1);
      if (!out.empty()) return out;
      continue;
    }
    if (pending_.size() > longest_answer) fail("sends a line without an end");
    pollfd wait{handle_, POLLIN, 0};
    const double left_s = until - steadySeconds();
    if (left_s <= 0.0) fail(fmt::format("does not answer within {:g} s", patience_s));
    if (::poll(&wait, 1, static_cast<int>(left_s * 1e3) + 1) <= 0) continue;
    char bytes[4096];
    const ssize_t count = ::read(handle_, bytes, sizeof bytes);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) fail(fmt::format("ended: {}", count < 0 ? std::strerror(errno) : "it was closed"));
    pending_.append(bytes, static_cast<std::size_t>(count));
  }
}

std::string LinuxcncShell::answer(const std::string& sent, double patience_s) {
  std::string said = line(patience_s);
  while (said == sent) said = line(patience_s);
  return said;
}

}  // namespace spindrift
