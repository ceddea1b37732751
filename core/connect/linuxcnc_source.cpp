// SPDX-License-Identifier: Apache-2.0
#include "core/connect/linuxcnc_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <map>
#include <optional>
#include <stdexcept>
#include <thread>

#include "core/base/steady_seconds.h"
#include "core/base/text.h"
#include "core/connect/hal_commands.h"
#include "core/connect/linuxcnc_shell.h"

namespace spindrift {
namespace {

constexpr std::string_view axes = "xyzabc";
constexpr std::array<std::string_view, 8> words{"flood", "mist",           "machine",       "estop",
                                                "mode",  "program_status", "feed_override", "probe_tripped"};
constexpr int most_joints = 16;

/// What is asked for, and which number or word of the answer is meant.
struct Question {
  std::string pin;      ///< of HAL; else
  std::string request;  ///< of linuxcncrsh
  int index = 0;
};

Question questionOf(const std::string& address) {
  if (address.starts_with("hal:")) {
    Question out;
    out.pin = address.substr(4);
    if (!isHalName(out.pin)) throw std::invalid_argument("hal:NAME with the name of a pin or signal of HAL");
    return out;
  }
  if (address == "spindle") return {"", "spindle 0", 1};
  if (address == "probe") return {"", "probe_tripped", 0};
  if (std::find(words.begin(), words.end(), address) != words.end()) return {"", address, 0};
  const std::size_t dot = address.find('.');
  const std::string stem = address.substr(0, dot);
  const std::string rest = dot == std::string::npos ? "" : address.substr(dot + 1);
  if ((stem == "position" || stem == "command") && rest.size() == 1 && axes.find(rest[0]) != std::string_view::npos)
    return {"", stem == "position" ? "abs_act_pos" : "abs_cmd_pos", static_cast<int>(axes.find(rest[0]))};
  double number = 0.0;
  if (stem == "joint" && parseNumber(rest, number) && number >= 0.0 && number < most_joints &&
      number == static_cast<int>(number))
    return {"", fmt::format("joint_pos {}", static_cast<int>(number)), 1};
  throw std::invalid_argument(
      "position.x, command.x (y, z, a, b, c), joint.0, flood, mist, spindle, machine, estop, mode, program_status, "
      "feed_override, probe, or hal:NAME");
}

bool isThisComputer(const std::string& host) {
  return host == "localhost" || host == "127.0.0.1" || host == "::1";
}

void setValue(Record& record, const std::string& text) {
  if (parseNumber(text, record.value)) return;
  record.quality = Quality::Text;
  record.text = text;
}

class LinuxcncSource final : public Source {
 public:
  explicit LinuxcncSource(LinuxcncOptions options)
      : options_(std::move(options)),
        peer_(hostAndPort(options_.url, 5007)),
        shell_([this] {
          LinuxcncShell::Options shell;
          shell.peer = peer_;
          if (!options_.password.empty()) shell.password = options_.password;
          shell.answer_s = options_.answer_s;
          return shell;
        }()),
        hal_(options_.answer_s) {}

  /// The connections are made by list() and subscribe(), which know what is wanted.
  void connect(const std::stop_token& stop) override {
    close();
    stop_ = stop;
    next_s_ = 0.0;
  }

  std::vector<DataItem> list(double, const std::stop_token& stop) override {
    shell_.connect(stop);
    learnUnit();
    std::vector<DataItem> items;
    const auto add = [&](const std::string& address, const char* type, const std::string& unit) {
      const Question question = questionOf(address);
      const std::optional<std::string> said = shell_.get(question.request);
      if (!said) return;
      DataItem item{address, "", "control", unit.empty() ? "event" : "sample", type, unit, part(*said, question.index)};
      if (!item.example.empty()) items.push_back(std::move(item));
    };
    for (const char axis : {'x', 'y', 'z'}) {
      add(fmt::format("position.{}", axis), "POSITION", unit_);
      add(fmt::format("command.{}", axis), "POSITION", unit_);
    }
    for (const char* word : {"flood", "mist", "spindle", "machine", "estop", "mode", "program_status", "probe"})
      add(word, word, "");
    add("feed_override", "PATH_FEEDRATE_OVERRIDE", "PERCENT");
    if (!isThisComputer(peer_.host)) return items;
    try {
      hal_.start();
      for (const HalCommands::Pin& pin : hal_.list())
        items.push_back({"hal:" + pin.name, pin.name, "HAL", "sample", pin.type, "", pin.value});
    } catch (const ConnectionError&) {
      // A container or another user: what the shell tells is there all the same.
    }
    return items;
  }

  void subscribe(const std::vector<std::string>& items, RecordSink& sink, const std::stop_token& stop) override {
    if (subscribed_) sink.missed("what the control held meanwhile is not repeated.");
    subscribed_ = true;
    wanted_.clear();
    requests_.clear();
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      try {
        Wanted wanted{i, questionOf(items[i])};
        if (!wanted.question.pin.empty() && !isThisComputer(peer_.host)) {
          sink.note(fmt::format("{} is not read: HAL can be read on the control's computer only.", items[i]));
          continue;
        }
        if (wanted.question.pin.empty()) requests_[wanted.question.request].clear();
        wanted_.push_back(std::move(wanted));
      } catch (const std::invalid_argument& allowed) {
        sink.note(fmt::format("\"{}\" is not a data item of LinuxCNC; allowed: {}.", items[i], allowed.what()));
      }
    }
    const bool pins =
        std::any_of(wanted_.begin(), wanted_.end(), [](const Wanted& w) { return !w.question.pin.empty(); });
    if (!requests_.empty() && !shell_.connected()) shell_.connect(stop);
    if (!requests_.empty()) learnUnit();
    if (pins && !hal_.started()) hal_.start();
  }

  std::string unit(const std::string& address) const override {
    const bool length = address.starts_with("position.") || address.starts_with("command.");
    return length && address.find_first_of("xyz", address.find('.')) != std::string::npos ? unit_ : "";
  }

  void poll(double wait_s, RecordSink& sink) override {
    const double now = steadySeconds();
    if (now < next_s_) {
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(wait_s, next_s_ - now)));
      return;
    }
    next_s_ = std::max(next_s_ + options_.interval_s, now);
    std::map<std::string, std::optional<std::string>> said;
    for (auto& [request, told] : requests_) {
      said[request] = shell_.get(request);
      if (!said[request] && told.empty()) {
        told = fmt::format("{} refuses \"get {}\".", shell_.name(), request);
        sink.note(told);
      }
    }
    std::vector<std::string> names;
    for (const Wanted& wanted : wanted_) {
      if (!wanted.question.pin.empty()) names.push_back(wanted.question.pin);
    }
    const std::vector<std::optional<std::string>> pins =
        names.empty() ? std::vector<std::optional<std::string>>{} : hal_.read(names);
    std::size_t pin = 0;
    for (Wanted& wanted : wanted_) {
      Record record;
      record.item = wanted.item;
      std::string text;
      if (wanted.question.pin.empty()) {
        if (const auto& answer = said[wanted.question.request]) text = part(*answer, wanted.question.index);
      } else if (const auto& value = pins[pin++]) {
        text = *value == "TRUE" ? "1" : *value == "FALSE" ? "0" : *value;
      } else if (!wanted.told) {
        sink.note(fmt::format("HAL of LinuxCNC has no pin or signal \"{}\".", wanted.question.pin));
        wanted.told = true;
      }
      if (text.empty()) {
        record.quality = Quality::Unavailable;
      } else {
        setValue(record, text);
      }
      sink.record(std::move(record));
    }
  }

  void close() noexcept override {
    shell_.close();
    hal_.close();
  }

 private:
  struct Wanted {
    std::uint32_t item;
    Question question;
    bool told = false;
  };

  /// The index-th word of an answer; empty if there is none.
  static std::string part(const std::string& answer, int index) {
    const std::vector<std::string> parts = splitList(answer, ' ');
    return index < static_cast<int>(parts.size()) ? parts[static_cast<std::size_t>(index)] : std::string();
  }

  /// Positions come in the unit of the machine's configuration.
  void learnUnit() {
    const std::optional<std::string> said = shell_.get("user_linear_units");
    unit_ = said && *said == "INCH" ? "INCH" : said && *said == "MM" ? "MILLIMETER" : "";
  }

  LinuxcncOptions options_;
  HostAndPort peer_;
  LinuxcncShell shell_;
  HalCommands hal_;
  std::stop_token stop_;
  std::vector<Wanted> wanted_;
  std::map<std::string, std::string> requests_;  ///< each asked once a turn; what was said about its refusal
  std::string unit_;
  bool subscribed_ = false;
  double next_s_ = 0.0;
};

}  // namespace

void checkLinuxcncAddress(const std::string& address) {
  (void)questionOf(address);
}

std::unique_ptr<Source> makeLinuxcncSource(const LinuxcncOptions& options) {
  return std::make_unique<LinuxcncSource>(options);
}

}  // namespace spindrift
