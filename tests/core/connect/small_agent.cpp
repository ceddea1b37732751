// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/core/connect/small_agent.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "core/base/utc_time.h"

namespace spindrift::testing {
namespace {

struct Known {
  const char* id;
  const char* element;
  const char* group;
};

const std::vector<Known>& known() {
  static const std::vector<Known> all{{"T1", "Temperature", "Samples"},  {"S1", "SpindleSpeed", "Samples"},
                                      {"P1", "PathPosition", "Samples"}, {"V1", "DisplacementTimeSeries", "Samples"},
                                      {"EXEC", "Execution", "Events"},   {"C1", "Temperature", "Condition"}};
  return all;
}

bool sendAll(int to, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t sent = ::send(to, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (sent <= 0) return false;
    done += static_cast<std::size_t>(sent);
  }
  return true;
}

double argument(const std::string& line, const std::string& name, double otherwise) {
  const std::size_t at = line.find(name + "=");
  return at == std::string::npos ? otherwise : std::atof(line.c_str() + at + name.size() + 1);
}

void nap(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

}  // namespace

SmallAgent::SmallAgent() {
  start();
}

SmallAgent::~SmallAgent() {
  stop();
}

void SmallAgent::start() {
  stopping_ = false;
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port_));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(listener_, 16), 0);
  socklen_t length = sizeof address;
  ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
  port_ = ntohs(address.sin_port);
  server_ = std::thread([this, listener = listener_] { serve(listener); });
}

void SmallAgent::stop() {
  stopping_ = true;
  if (server_.joinable()) server_.join();
  for (std::thread& each : connections_) each.join();
  connections_.clear();
  if (listener_ >= 0) ::close(listener_);
  listener_ = -1;
}

void SmallAgent::forget() {
  const std::scoped_lock lock(mutex_);
  buffer_.clear();
  newest_.clear();
  next_ = 1;
  ++instance_;
}

void SmallAgent::set(const Manners& manners) {
  const std::scoped_lock lock(mutex_);
  manners_ = manners;
}

void SmallAgent::nextPart(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  in_place_.push_back(text);
}

std::uint64_t SmallAgent::sequence() const {
  const std::scoped_lock lock(mutex_);
  return next_;
}

int SmallAgent::requests(const std::string& of) const {
  const std::scoped_lock lock(mutex_);
  return static_cast<int>(std::count_if(asked_.begin(), asked_.end(),
                                        [&](const std::string& line) { return line.find(of) != std::string::npos; }));
}

void SmallAgent::observe(const std::string& id, const std::string& text, double stamp_s, const std::string& extra) {
  const std::scoped_lock lock(mutex_);
  const Observation made{next_++, id, text, utcText(stamp_s), extra};
  buffer_.push_back(made);
  while (buffer_.size() > manners_.buffer) buffer_.pop_front();
  std::erase_if(newest_, [&](const Observation& each) { return each.id == id; });
  newest_.push_back(made);
}

void SmallAgent::serve(int listener) {
  while (!stopping_) {
    pollfd wait{listener, POLLIN, 0};
    if (::poll(&wait, 1, 20) <= 0) continue;
    const int connection = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection >= 0) connections_.emplace_back([this, connection] { answer(connection); });
  }
}

std::string SmallAgent::header(std::uint64_t next) const {
  return fmt::format(
      "<{0}Header instanceId=\"{1}\" version=\"{2}\" bufferSize=\"{3}\" firstSequence=\"{4}\" lastSequence=\"{5}\" "
      "nextSequence=\"{6}\" creationTime=\"2026-01-31T08:00:00Z\"/>",
      manners_.prefix, instance_, manners_.version, manners_.buffer, buffer_.empty() ? next_ : buffer_.front().sequence,
      next_ - 1, next);
}

std::string SmallAgent::probe() const {
  const std::string& p = manners_.prefix;
  std::string begin, end;
  for (std::size_t i = 0; i < manners_.levels; ++i) {
    begin += fmt::format("<{0}Components><{0}Part>", p);
    end += fmt::format("</{0}Part></{0}Components>", p);
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<{0}MTConnectDevices xmlns{2}=\"urn:mtconnect.org:MTConnectDevices:"
      "{1}\">{3}<{0}Devices><{0}Device id=\"d\" uuid=\"u1\" name=\"mill\"><{0}DataItems><{0}DataItem id=\"C1\" "
      "category=\"CONDITION\" type=\"TEMPERATURE\"/></{0}DataItems><{0}Components><{0}Axes id=\"a\"><{0}Components>"
      "<{0}Rotary id=\"s\" name=\"spindle\"><{0}DataItems><{0}DataItem id=\"T1\" name=\"Tspindle\" category=\"SAMPLE\" "
      "type=\"TEMPERATURE\" units=\"CELSIUS\" nativeUnits=\"FAHRENHEIT\"/><{0}DataItem id=\"S1\" category=\"SAMPLE\" "
      "type=\"SPINDLE_SPEED\" subType=\"ACTUAL\" units=\"REVOLUTION/MINUTE\"/><{0}DataItem id=\"P1\" "
      "category=\"SAMPLE\" "
      "type=\"PATH_POSITION\" units=\"MILLIMETER_3D\"/><{0}DataItem id=\"V1\" category=\"SAMPLE\" "
      "type=\"DISPLACEMENT\" "
      "representation=\"TIME_SERIES\" units=\"MILLIMETER\"/><{0}DataItem id=\"EXEC\" category=\"EVENT\" "
      "type=\"EXECUTION\"/></{0}DataItems></{0}Rotary></{0}Components></{0}Axes></{0}Components>{4}{5}</{0}Device>"
      "</{0}Devices></{0}MTConnectDevices>",
      p, manners_.version, p.empty() ? "" : ":m", header(next_), begin, end);
}

std::string SmallAgent::document(bool current, std::uint64_t from, std::uint64_t& next) const {
  const std::string& p = manners_.prefix;
  std::map<std::string, std::string> groups;
  std::uint64_t last = from;
  const auto add = [&](const Observation& each) {
    for (const Known& k : known()) {
      if (each.id != k.id) continue;
      const bool condition = std::string(k.group) == "Condition";
      groups[k.group] += fmt::format("<{}{} dataItemId=\"{}\" sequence=\"{}\" timestamp=\"{}\"{}>{}</{}{}>", p,
                                     condition ? each.text : k.element, each.id, each.sequence, each.stamp, each.extra,
                                     condition ? "" : each.text, p, condition ? each.text : k.element);
    }
  };
  if (current) {
    for (const Observation& each : newest_) add(each);
    last = next_;
  } else {
    for (const Observation& each : buffer_) {
      if (each.sequence < from) continue;
      add(each);
      last = each.sequence + 1;
    }
  }
  next = last;
  std::string inside;
  for (const auto& [group, text] : groups) inside += fmt::format("<{0}{1}>{2}</{0}{1}>", p, group, text);
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\r\n<{0}MTConnectStreams "
      "xmlns{1}=\"urn:mtconnect.org:MTConnectStreams:{2}\">"
      "{3}<{0}Streams><{0}DeviceStream name=\"mill\" uuid=\"u1\"><{0}ComponentStream component=\"Rotary\" "
      "componentId=\"s\">{4}</{0}ComponentStream></{0}DeviceStream></{0}Streams>",
      p, p.empty() ? "" : ":m", manners_.version, header(last), inside);
  const std::string end = fmt::format("</{}MTConnectStreams>", p);
  if (manners_.pad > 0) text.append((manners_.pad - (text.size() + end.size()) % manners_.pad) % manners_.pad, ' ');
  return text + end;
}

std::string SmallAgent::outOfRange() const {
  const std::string& p = manners_.prefix;
  return fmt::format(
      "<?xml version=\"1.0\"?><{0}MTConnectError "
      "xmlns{1}=\"urn:mtconnect.org:MTConnectError:{2}\">{3}<{0}Errors><{0}Error "
      "errorCode=\"OUT_OF_RANGE\">'from' must be greater than {4}</{0}Error></{0}Errors></{0}MTConnectError>",
      p, p.empty() ? "" : ":m", manners_.version, header(next_), buffer_.empty() ? 0 : buffer_.front().sequence);
}

void SmallAgent::answer(int connection) {
  std::string request;
  while (!stopping_ && request.find("\r\n\r\n") == std::string::npos) {
    pollfd wait{connection, POLLIN, 0};
    if (::poll(&wait, 1, 20) <= 0) continue;
    char bytes[2048];
    const ssize_t count = ::recv(connection, bytes, sizeof bytes, 0);
    if (count <= 0) break;
    request.append(bytes, static_cast<std::size_t>(count));
  }
  while (frozen_ && !stopping_) nap(10);
  const std::string line = request.substr(0, request.find("\r\n"));
  std::string body;
  int status = 200;
  bool streamed = false;
  const auto from = static_cast<std::uint64_t>(argument(line, "from", 1));
  {
    const std::scoped_lock lock(mutex_);
    asked_.push_back(line);
    std::uint64_t next = 0;
    if (line.find("/probe") != std::string::npos) {
      body = probe();
    } else if (line.find("/current") != std::string::npos) {
      body = document(true, 0, next);
    } else if (line.find("/sample") != std::string::npos) {
      if (from > next_ || (!buffer_.empty() && from < buffer_.front().sequence)) {
        body = outOfRange();
        status = manners_.version >= "1.3" ? 404 : 200;
      } else if (!manners_.multipart) {
        body = document(false, from, next);
      } else {
        streamed = true;
      }
    } else {
      body = "<html>not here</html>";
      status = 404;
    }
  }
  if (streamed) {
    stream(connection, from, argument(line, "interval", 100) / 1e3, argument(line, "heartbeat", 1000) / 1e3);
  } else {
    sendAll(connection, fmt::format("HTTP/1.1 {} X\r\nContent-Type: text/xml\r\nContent-Length: {}\r\nConnection: close"
                                    "\r\n\r\n{}",
                                    status, body.size(), body));
  }
  ::shutdown(connection, SHUT_RDWR);
  ::close(connection);
}

void SmallAgent::stream(int connection, std::uint64_t from, double interval_s, double heartbeat_s) {
  Manners manners;
  {
    const std::scoped_lock lock(mutex_);
    manners = manners_;
  }
  const std::string boundary = "a8e12eced4fb871ac096a99bf9728425";
  if (!sendAll(connection,
               fmt::format("HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace;boundary={}\r\n{}\r\n", boundary,
                           manners.chunked ? "Transfer-Encoding: chunked\r\n" : ""))) {
    return;
  }
  double silent_s = heartbeat_s;
  for (std::size_t parts = 0; !stopping_;) {
    std::string part;
    {
      const std::scoped_lock lock(mutex_);
      if (from < next_ || silent_s >= heartbeat_s) {
        if (!buffer_.empty() && from < buffer_.front().sequence) {
          part = outOfRange();
        } else {
          part = document(false, from, from);
        }
        if (!in_place_.empty()) {
          part = in_place_.front();
          in_place_.erase(in_place_.begin());
        }
      }
    }
    while (frozen_ && !stopping_) nap(10);
    if (!part.empty()) {
      const bool cut = ++parts > manners.most_parts;
      std::string text = fmt::format("--{}\r\n{}: text/xml\r\n{}: {}\r\n\r\n{}\r\n", boundary,
                                     manners.lower_case ? "content-type" : "Content-type",
                                     manners.lower_case ? "content-length" : "Content-length",
                                     part.size() + (manners.true_lengths ? 0 : 17), part);
      if (cut) text.resize(text.size() / 2);
      if (manners.chunked) text = fmt::format("{:x}\r\n{}\r\n", text.size(), text);
      if (!sendAll(connection, text) || cut) return;
      silent_s = 0.0;
    }
    const int ms = std::max(1, static_cast<int>(interval_s * 1e3));
    nap(ms);
    silent_s += ms / 1e3;
  }
}

}  // namespace spindrift::testing
