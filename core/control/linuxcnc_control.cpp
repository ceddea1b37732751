// SPDX-License-Identifier: Apache-2.0
#include "core/control/linuxcnc_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/steady_seconds.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

constexpr std::string_view letters = "xyz";

void nap(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

std::optional<double> numberOf(const std::optional<std::string>& text) {
  if (!text) return std::nullopt;
  if (*text == "TRUE") return 1.0;
  if (*text == "FALSE") return 0.0;
  double value = 0.0;
  if (!parseNumber(*text, value)) return std::nullopt;
  return value;
}

}  // namespace

LinuxcncControl::LinuxcncControl(LinuxcncControlOptions options)
    : options_(std::move(options)), shell_(options_.shell), hal_(options_.answer_s) {}

void LinuxcncControl::connect(const std::stop_token& stop) {
  close();
  shell_.connect(stop);
  hal_.start();
  if (!shell_.set("enable " + options_.enable_password)) {
    close();
    throw ConnectionError(
        fmt::format("{} refuses remote control: wrong password of linuxcncrsh (--enablepw).", name()));
  }
  (void)shell_.errors();  // of the time before us
  // Text of the time before us is not ours; after a loss it goes on where it was.
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(options_.folder / print_file, none);
  if (!known_) read_ = none ? 0 : size;
  known_ = true;
}

void LinuxcncControl::close() noexcept {
  shell_.close();
  hal_.close();
}

std::string LinuxcncControl::ask(const std::string& request) {
  const std::optional<std::string> said = shell_.get(request);
  if (!said) throw ConnectionError(fmt::format("{} refuses \"get {}\".", name(), request));
  return *said;
}

void LinuxcncControl::demand(const std::string& command, double patience_s) {
  if (shell_.set(command, patience_s)) return;
  const std::vector<std::string> why = shell_.errors();
  throw InputError(fmt::format("{} refuses \"{}\"{}", name(), command, why.empty() ? "." : ": " + why.front()));
}

void LinuxcncControl::waitFor(const std::string& request, const std::string& answer, double patience_s) {
  const double until = steadySeconds() + patience_s;
  while (ask(request).find(answer) == std::string::npos) {
    if (steadySeconds() > until) {
      const std::vector<std::string> why = shell_.errors();
      throw InputError(fmt::format("{} does not become \"{} {}\" within {:g} s{}", name(), request, answer, patience_s,
                                   why.empty() ? "." : ": " + why.front()));
    }
    nap(20);
  }
}

std::vector<ControlFinding> LinuxcncControl::check() {
  std::vector<ControlFinding> out;
  const auto add = [&](const char* what, bool good, std::string sentence) {
    out.push_back({what, good, std::move(sentence)});
  };
  const std::string units = ask("user_linear_units");
  add("units", units == "MM", fmt::format("machine units {}; allowed: MM", units));
  for (const char axis : letters) {
    const std::vector<std::string> names{fmt::format("limit-{}.min", axis),  fmt::format("limit-{}.max", axis),
                                         fmt::format("limit-{}.maxv", axis), fmt::format("limit-{}.maxa", axis),
                                         fmt::format("comp-{}", axis),       fmt::format("offset-{}.offset", axis)};
    const std::vector<std::optional<double>> v = signals(names);
    const bool there = std::all_of(v.begin(), v.end(), [](const auto& each) { return each.has_value(); });
    if (!there) {
      add("channel", false,
          fmt::format("axis {} has no compensation channel (limit-{}, offset-{}, comp-{})",
                      static_cast<char>(axis - 32), axis, axis, axis));
      continue;
    }
    const double limit = std::max(std::abs(*v[0]), std::abs(*v[1]));
    add("range in the control", limit <= options_.largest_limit_mm,
        fmt::format("axis {}: {:g} to {:g} mm; allowed: within +-{:g} mm", static_cast<char>(axis - 32), *v[0], *v[1],
                    options_.largest_limit_mm));
    add("speed in the control", *v[2] > 0.0 && *v[2] <= options_.largest_speed_mm_s,
        fmt::format("axis {}: {:g} mm/s; allowed: up to {:g} mm/s", static_cast<char>(axis - 32), *v[2],
                    options_.largest_speed_mm_s));
    add("applied now", std::abs(*v[5]) <= limit,
        fmt::format("axis {}: {:+.1f} µm", static_cast<char>(axis - 32), 1e3 * *v[5]));
  }
  const std::vector<std::optional<double>> dog = signals({"watchdog.timeout-0", "watchdog.ok-out"});
  add("watchdog", dog[0] && *dog[0] > 0.0 && *dog[0] <= options_.largest_watchdog_s,
      dog[0] ? fmt::format("{:g} s of silence; allowed: up to {:g} s", *dog[0], options_.largest_watchdog_s)
             : std::string("there is none"));
  const std::vector<std::string> links = hal_.run({"show sig comp-enabled"});
  int enables = 0;
  for (const std::string& line : links) {
    for (const char axis : letters)
      enables += line.find(fmt::format("limit-{}.enable", axis)) != std::string::npos ? 1 : 0;
  }
  add("watchdog reaches the channel", enables == 3, fmt::format("{} of 3 axes are switched by it", enables));
  const std::optional<double> probe = signals({"motion.probe-input"})[0];
  add("probe", probe && *probe == 0.0, probe ? (*probe == 0.0 ? "open" : "closed: move it free") : "there is none");
  return out;
}

ControlState LinuxcncControl::state() noexcept {
  using Condition = ControlState::Condition;
  ControlState out;
  try {
    if (!shell_.connected() || !hal_.started()) throw ConnectionError(name() + " is not connected.");
    // The shell of a control that was killed answers on; HAL does not.
    const std::vector<std::optional<double>> pins =
        signals({"motion.motion-enabled", "iocontrol.0.tool-number", "joint.0.motor-offset", "joint.1.motor-offset",
                 "joint.2.motor-offset"});
    if (!pins[0]) throw ConnectionError(name() + " is gone: its motion does not run any more.");
    out.tool = static_cast<int>(pins[1].value_or(0.0));
    for (int axis = 0; axis < 3; ++axis) out.home_mm[axis] = pins[static_cast<std::size_t>(2 + axis)].value_or(0.0);
    const std::string homed = ask("joint_homed");
    const std::vector<std::string> joints = splitList(homed, ' ');
    out.homed = joints.size() >= 3 && joints[0] == "YES" && joints[1] == "YES" && joints[2] == "YES";
    const std::vector<std::string> position = splitList(ask("abs_act_pos"), ' ');
    for (int axis = 0; axis < 3 && static_cast<std::size_t>(axis) < position.size(); ++axis)
      (void)parseNumber(position[static_cast<std::size_t>(axis)], out.position_mm[axis]);
    if (ask("estop") != "OFF") {
      out.condition = Condition::EmergencyStop;
      out.sentence = "The control is in emergency stop: release it, then switch the machine on.";
    } else if (ask("machine") != "ON") {
      out.condition = Condition::Off;
      out.sentence = "The machine is off: switch it on.";
    } else if (!out.homed) {
      out.condition = Condition::NotHomed;
      out.sentence = "The machine is not homed: home all axes.";
    } else if (ask("program_status") != "IDLE") {
      out.condition = Condition::Busy;
      out.sentence = "A program is running.";
    } else {
      out.condition = Condition::Ready;
      out.sentence = "Ready.";
    }
  } catch (const std::exception& error) {
    out.condition = Condition::Unreachable;
    out.sentence = error.what();
  }
  return out;
}

void LinuxcncControl::switchOn(bool confirmed) {
  if (!confirmed) throw InputError("The machine is not switched on: it was not confirmed.");
  if (ask("estop") != "OFF") {
    demand("estop off");
    waitFor("estop", "OFF", 5.0);
  }
  if (ask("machine") != "ON") {
    demand("machine on");
    waitFor("machine", "ON", 5.0);
  }
  if (state().homed) return;
  demand("mode manual");
  demand("home -1");
  waitFor("joint_homed", "YES YES YES", 60.0);
}

void LinuxcncControl::start(const ApprovedProgram& program) {
  const ControlState now = state();
  if (!now.ready()) throw InputError("The program is not started: " + now.sentence);
  const double away_mm =
      program.run().moves.empty() ? 0.0 : (now.position_mm - program.run().moves.front().from_mm).norm();
  if (away_mm > 0.01)
    throw InputError(fmt::format(
        "The program is not started: the machine stands {:.3f} mm from where it was foreseen to start.", away_mm));
  // A name of its own: a file that is open already would not be read again.
  const std::filesystem::path file = options_.folder / fmt::format("spindrift-{}.ngc", ++programs_ % 2);
  writeFileAtomically(file, program.text());
  // A programme that opens the file anew may leave one of the same length: what is unread is taken before.
  for (std::string& line : printed()) unread_.push_back(std::move(line));
  std::error_code none;
  std::filesystem::remove(options_.folder / print_file, none);
  read_ = 0;
  pending_.clear();
  (void)shell_.errors();
  demand("set_wait received");
  demand("mode auto");
  demand("open " + file.string());
  demand("run");
  // Accepted is not running; a short programme may be over before it is seen to run.
  const double until = steadySeconds() + 1.0;
  while (ask("program_status") == "IDLE" && steadySeconds() < until) {
    if (const std::vector<std::string> why = shell_.errors(); !why.empty())
      throw InputError(fmt::format("{} does not run the program: {}", name(), why.front()));
    nap(5);
  }
}

void LinuxcncControl::abort() {
  demand("abort");
}

std::vector<std::string> LinuxcncControl::printed() {
  std::vector<std::string> out = std::exchange(unread_, {});
  const std::filesystem::path file = options_.folder / print_file;
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file, none);
  if (none) return out;
  if (size < read_) {  // written anew by (LOGOPEN,...)
    read_ = 0;
    pending_.clear();
  }
  if (size == read_) return out;
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(read_));
  std::string bytes(static_cast<std::size_t>(size - read_), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  read_ += bytes.size();
  pending_ += bytes;
  for (std::size_t end = 0; (end = pending_.find('\n')) != std::string::npos;) {
    std::string line(trimmed(std::string_view(pending_).substr(0, end)));
    pending_.erase(0, end + 1);
    if (!line.empty()) out.push_back(std::move(line));
  }
  return out;
}

std::vector<std::optional<double>> LinuxcncControl::signals(const std::vector<std::string>& names) {
  std::vector<std::optional<double>> out;
  for (const std::optional<std::string>& text : hal_.read(names)) out.push_back(numberOf(text));
  return out;
}

void LinuxcncControl::openChannel(bool hold_when_silent) {
  // What is applied becomes what is wanted before the channel opens: nothing steps.
  const CompensationStatus now = compensation();
  std::vector<std::pair<std::string, double>> values{{"comp-hold", hold_when_silent ? 1.0 : 0.0}};
  for (int axis = 0; axis < 3; ++axis)
    values.emplace_back(fmt::format("comp-{}", letters[static_cast<std::size_t>(axis)]), 1e-3 * now.applied_um[axis]);
  hal_.setSignals(values);
  // The watchdog begins with an edge, and then wants to hear something.
  hal_.setPin("watchdog.enable-in", "0");
  nap(20);
  hal_.setPin("watchdog.enable-in", "1");
  const double until = steadySeconds() + 1.0;
  while (!compensate(now.applied_um).watched) {
    if (steadySeconds() > until)
      throw ConnectionError(fmt::format("The watchdog of {} does not receive the heartbeat.", name()));
    nap(20);
  }
}

void LinuxcncControl::holdWhenSilent(bool hold) {
  hal_.setSignals({{"comp-hold", hold ? 1.0 : 0.0}});
}

CompensationStatus LinuxcncControl::compensate(const Eigen::Vector3d& offset_um) {
  if (!offset_um.allFinite()) throw InputError("A compensation that is not a number is not written.");
  beat_ = !beat_;
  std::vector<std::pair<std::string, double>> values{{"comp-alive", beat_ ? 1.0 : 0.0}};
  for (int axis = 0; axis < 3; ++axis)
    values.emplace_back(fmt::format("comp-{}", letters[static_cast<std::size_t>(axis)]), 1e-3 * offset_um[axis]);
  hal_.setSignals(values);
  const CompensationStatus status = compensation();
  if ((status.wanted_um - offset_um).cwiseAbs().maxCoeff() > 0.01)
    throw ConnectionError(fmt::format("{} holds another compensation than was written.", name()));
  return status;
}

CompensationStatus LinuxcncControl::compensation() {
  std::vector<std::string> names{"watchdog.ok-out"};
  for (const char axis : letters) names.push_back(fmt::format("comp-{}", axis));
  for (const char axis : letters) names.push_back(fmt::format("offset-{}.offset", axis));
  const std::vector<std::optional<double>> values = signals(names);
  CompensationStatus out;
  for (const std::optional<double>& value : values) {
    if (!value)
      throw ConnectionError(fmt::format("{} has no compensation channel (comp-x, offset-x, watchdog).", name()));
  }
  out.watched = *values[0] != 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    out.wanted_um[axis] = 1e3 * *values[static_cast<std::size_t>(1 + axis)];
    out.applied_um[axis] = 1e3 * *values[static_cast<std::size_t>(4 + axis)];
  }
  return out;
}

}  // namespace spindrift
