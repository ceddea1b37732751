// SPDX-License-Identifier: Apache-2.0
// Pins and signals of LinuxCNC's hardware layer (HAL) through its own program `halcmd`, which runs as a child and is
// spoken to over pipes: `getp NAME`, `gets NAME`, `sets NAME VALUE`. On the control's computer only, as the user who
// runs the control. Nothing of LinuxCNC is linked.
//
// A good `sets` says nothing and a fault says one or two lines, so a request for a name that cannot exist follows every
// group of commands: its refusal is the end of the answers.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spindrift {

class HalCommands {
 public:
  explicit HalCommands(double answer_s = 5.0) : answer_s_(answer_s) {}
  ~HalCommands() { close(); }
  HalCommands(const HalCommands&) = delete;
  HalCommands& operator=(const HalCommands&) = delete;

  /// Starts `halcmd` (looked up in PATH). Throws ConnectionError: not installed, no control runs, another user's.
  void start();
  [[nodiscard]] bool started() const noexcept { return child_ > 0; }
  void close() noexcept;

  /// Texts of pins, parameters or signals, in one exchange; nothing where there is no such name. Throws
  /// ConnectionError: halcmd has ended or does not answer (it is then gone).
  [[nodiscard]] std::vector<std::optional<std::string>> read(const std::vector<std::string>& names);
  /// Sets signals that nothing writes, in one exchange, and reads them back. Throws ConnectionError as read(), and with
  /// the words of halcmd for what it refuses.
  void setSignals(const std::vector<std::pair<std::string, double>>& values);
  /// Sets a pin or parameter that is not connected.
  void setPin(const std::string& name, const std::string& value);
  /// Answers of any commands, line by line, without the lines that end them.
  [[nodiscard]] std::vector<std::string> run(const std::vector<std::string>& commands);

  struct Pin {
    std::string name;
    std::string type;   ///< "float", "bit", "s32", "u32"
    std::string value;  ///< "0.5", "TRUE"
  };
  /// All pins and signals.
  [[nodiscard]] std::vector<Pin> list();

 private:
  void write(const std::string& bytes);
  std::string line(double until_s);
  [[noreturn]] void fail(const std::string& what);

  double answer_s_;
  pid_t child_ = -1;
  int pipe_ = -1;
  unsigned long mark_ = 0;
  std::string pending_;
};

/// True for a name that halcmd takes as one word: letters, digits, '.', '-', '_', ':'.
[[nodiscard]] bool isHalName(const std::string& name);

}  // namespace spindrift
