// SPDX-License-Identifier: GPL-3.0-or-later
// A small linuxcncrsh on loopback with the manners of the real one (2.9), and misbehaviour on command.
#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace spindrift::testing {

class SmallShell {
 public:
  struct Manners {
    bool pieces = false;        ///< answers arrive byte by byte
    bool mute = false;          ///< connections stay, nothing is answered
    bool mixed = false;         ///< a second client is connected: now and then the answer of another request
    std::string other_hello;    ///< in place of HELLO ACK
    int crash_after = 1 << 30;  ///< requests
  };
  SmallShell() { start(); }
  ~SmallShell() { stop(); }
  SmallShell(const SmallShell&) = delete;
  SmallShell& operator=(const SmallShell&) = delete;

  /// On the same port as before.
  void start() {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(listener_, 4);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    stopping_ = false;
    thread_ = std::thread([this] { serve(); });
  }
  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    if (listener_ >= 0) ::close(listener_);
    listener_ = -1;
  }
  [[nodiscard]] std::string url() const { return fmt::format("linuxcnc://127.0.0.1:{}", port_); }
  [[nodiscard]] int port() const { return port_; }
  void set(const Manners& manners) {
    const std::lock_guard lock(mutex_);
    manners_ = manners;
  }
  /// The answer to `get name`, after the name.
  void hold(const std::string& name, const std::string& text) {
    const std::lock_guard lock(mutex_);
    held_[name] = text;
  }
  [[nodiscard]] std::vector<std::string> heard() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }
  [[nodiscard]] int connections() const { return connections_; }

 private:
  void serve() {
    while (!stopping_) {
      pollfd wait{listener_, POLLIN, 0};
      if (::poll(&wait, 1, 20) <= 0) continue;
      const int peer = ::accept(listener_, nullptr, nullptr);
      if (peer < 0) continue;
      ++connections_;
      answerAll(peer);
      ::close(peer);
    }
  }
  void answerAll(int peer) {
    std::string pending;
    bool echo = true, verbose = false;
    while (!stopping_) {
      pollfd wait{peer, POLLIN, 0};
      if (::poll(&wait, 1, 20) <= 0) continue;
      char bytes[512];
      const ssize_t count = ::read(peer, bytes, sizeof bytes);
      if (count <= 0) return;
      pending.append(bytes, static_cast<std::size_t>(count));
      for (std::size_t end = 0; (end = pending.find('\n')) != std::string::npos;) {
        std::string line = pending.substr(0, end);
        pending.erase(0, end + 1);
        while (line.ends_with('\r')) line.pop_back();
        if (!answer(peer, line, echo, verbose)) return;
      }
    }
  }
  bool answer(int peer, const std::string& line, bool& echo, bool& verbose) {
    Manners manners;
    std::map<std::string, std::string> held;
    {
      const std::lock_guard lock(mutex_);
      heard_.push_back(line);
      if (static_cast<int>(heard_.size()) > manners_.crash_after) {
        manners_.crash_after = 1 << 30;
        return false;
      }
      manners = manners_;
      held = held_;
    }
    if (manners.mute) return true;
    std::string out;
    if (echo && line.starts_with("set")) out += line + "\r\n";
    if (line.starts_with("hello")) {
      out += manners.other_hello.empty() ? "HELLO ACK EMCNETSVR 1.1\r\n" : manners.other_hello + "\r\n";
    } else if (line == "get spindle" || line == "get brake" || line == "get spindle_override") {
      return false;  // what the real one does
    } else if (line.starts_with("get ")) {
      const std::string request = line.substr(4);
      const std::string name = request.substr(0, request.find(' '));
      std::string capitals = name;
      for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      if (manners.mixed) capitals = "MACHINE";
      if (name == "error" && !held.contains("error")) {
        out += "ERROR OK\r\n";
      } else if (held.contains(request)) {
        out += capitals + " " + held[request] + "\r\n";
      } else {
        out += "GET " + capitals + " NAK\r\n\r\n";
      }
      if (name == "error") {
        const std::lock_guard lock(mutex_);
        held_.erase("error");
      }
    } else if (line == "set echo off") {
      echo = false;
    } else if (line == "set verbose on") {
      verbose = true;
      out += "SET VERBOSE ACK\n\r";
    } else if (line.starts_with("set ")) {
      const std::string name = line.substr(4, line.find(' ', 4) - 4);
      std::string capitals = name;
      for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      if (held.contains("refuse " + name)) {
        out += "SET " + capitals + " NAK\n\r";
      } else if (verbose) {
        out += "SET " + capitals + " ACK\n\r";
      }
    }
    const std::size_t step = manners.pieces ? 1 : out.size();
    for (std::size_t done = 0; done < out.size(); done += step) {
      if (::send(peer, out.data() + done, std::min(step, out.size() - done), MSG_NOSIGNAL) <= 0) return false;
      if (manners.pieces) std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    return true;
  }

  std::atomic<bool> stopping_ = false;
  std::atomic<int> connections_ = 0;
  mutable std::mutex mutex_;
  Manners manners_;
  std::map<std::string, std::string> held_;
  std::vector<std::string> heard_;
  std::thread thread_;
  int listener_ = -1;
  int port_ = 0;
};

}  // namespace spindrift::testing
