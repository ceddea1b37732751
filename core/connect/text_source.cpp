// SPDX-License-Identifier: Apache-2.0
#include "core/connect/text_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>

#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/connect/append_file.h"
#include "core/connect/tcp_connection.h"

namespace spindrift {
namespace {

constexpr std::size_t longest_line = 65536;

speed_t speedOf(int baud) {
  static const std::map<int, speed_t> speeds{{1200, B1200},   {2400, B2400},   {4800, B4800},   {9600, B9600},
                                             {19200, B19200}, {38400, B38400}, {57600, B57600}, {115200, B115200}};
  const auto found = speeds.find(baud);
  if (found == speeds.end()) throw ConnectionError(fmt::format("A serial line of {} baud is not supported.", baud));
  return found->second;
}

class TextSource final : public Source {
 public:
  explicit TextSource(TextSourceOptions options) : options_(std::move(options)) {}
  ~TextSource() override { close(); }

  void connect(const std::stop_token& stop) override {
    close();
    if (options_.url.starts_with("tcp://")) {
      handle_ = openTcp(hostAndPort(options_.url, 23), 5.0, stop);
    } else {
      openSerial(options_.url.substr(options_.url.find("://") + 3));
    }
    pending_.clear();
  }

  /// What comes while it is listened to, line by line.
  std::vector<DataItem> list(double listen_s, const std::stop_token& stop) override {
    std::vector<DataItem> items;
    for (double waited = 0.0; waited < listen_s && !stop.stop_requested(); waited += 0.05) {
      read(0.05, [&](const std::string& line) {
        if (items.size() < 100)
          items.push_back(
              {fmt::format("line {}", items.size() + 1), "", "", "", "text", "", printable(beginning(line, 120))});
      });
    }
    return items;
  }

  void subscribe(const std::vector<std::string>& items, RecordSink& sink, const std::stop_token&) override {
    if (subscribed_) sink.missed("lines that were printed meanwhile are not repeated.");
    subscribed_ = true;
    items_ = items;
    for (const std::string& item : items) {
      if (std::none_of(options_.lines.begin(), options_.lines.end(), [&](const LinePattern& p) { return p.has(item); }))
        sink.note(fmt::format("No pattern of {} has a place {{{}}}.", options_.url, item));
    }
    if (!options_.save.empty() && !saved_) saved_ = std::make_unique<AppendFile>(options_.save);
  }

  void poll(double wait_s, RecordSink& sink) override {
    read(wait_s, [&](const std::string& line) { deliver(line, sink); });
  }

  void close() noexcept override {
    if (handle_ >= 0) ::close(handle_);
    handle_ = -1;
  }

 private:
  void openSerial(const std::string& device) {
    handle_ = ::open(device.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    termios settings{};
    if (handle_ < 0 || ::tcgetattr(handle_, &settings) != 0) {
      const std::string reason = std::strerror(errno);
      close();
      throw ConnectionError(fmt::format("{} cannot be opened as a serial line: {}.", device, reason));
    }
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CSIZE | PARENB | PARODD);
    settings.c_cflag |= options_.data_bits == 7 ? CS7 : CS8;
    if (options_.parity != 'N') settings.c_cflag |= PARENB;
    if (options_.parity == 'O') settings.c_cflag |= PARODD;
    ::cfsetspeed(&settings, speedOf(options_.baud));
    if (::tcsetattr(handle_, TCSANOW, &settings) != 0) {
      const std::string reason = std::strerror(errno);
      close();
      throw ConnectionError(fmt::format("{} cannot be set up as a serial line: {}.", device, reason));
    }
  }

  template <typename Take>
  void read(double wait_s, const Take& take) {
    pollfd wait{handle_, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(wait_s * 1e3)) <= 0) return;
    char bytes[4096];
    const ssize_t count = ::read(handle_, bytes, sizeof bytes);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count <= 0) {
      const std::string reason = count < 0 ? std::strerror(errno) : "it was closed";
      close();
      throw ConnectionError(fmt::format("{} ended: {}.", options_.url, reason));
    }
    pending_.append(bytes, static_cast<std::size_t>(count));
    // DPRNT ends its lines with CR, LF or both, some controls with NUL.
    for (std::size_t end = 0; (end = pending_.find_first_of(std::string_view("\r\n\0", 3))) != std::string::npos;) {
      const std::string line(trimmed(std::string_view(pending_).substr(0, end)));
      pending_.erase(0, end + 1);
      if (!line.empty()) take(line);
    }
    if (pending_.size() > longest_line) {
      close();
      throw ConnectionError(fmt::format("{} sends a line without an end.", options_.url));
    }
  }

  void deliver(const std::string& line, RecordSink& sink) {
    if (saved_ && !saved_->append(line + "\n") && !save_told_) {
      sink.note(saved_->failure());
      save_told_ = true;
    }
    for (const LinePattern& pattern : options_.lines) {
      const auto values = pattern.match(line);
      if (!values) continue;
      for (std::uint32_t i = 0; i < items_.size(); ++i) {
        const auto found = values->find(items_[i]);
        if (found == values->end()) continue;
        std::string text = found->second;
        if (options_.decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
        if (text.starts_with('+')) text.erase(0, 1);
        if (text.ends_with('.')) text += '0';
        Record record;
        record.item = i;
        if (!parseNumber(text, record.value)) {
          record.quality = Quality::Text;
          record.text = found->second;
        }
        sink.record(std::move(record));
      }
      return;
    }
  }

  TextSourceOptions options_;
  std::vector<std::string> items_;
  std::unique_ptr<AppendFile> saved_;
  bool save_told_ = false;
  bool subscribed_ = false;
  int handle_ = -1;
  std::string pending_;
};

}  // namespace

std::unique_ptr<Source> makeTextSource(const TextSourceOptions& options) {
  return std::make_unique<TextSource>(options);
}

}  // namespace spindrift
