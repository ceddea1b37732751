// SPDX-License-Identifier: Apache-2.0
// The text protocol of linuxcncrsh, the network shell of the control LinuxCNC (2.9; parsed with tolerance for others).
//
//   hello PASSWORD NAME VERSION  ->  HELLO ACK ...         set machine on  ->  SET MACHINE ACK
//   get abs_act_pos  ->  ABS_ACT_POS 1.000000 2.000000 ...  get nonsense  ->  GET NONSENSE NAK
//
// One question, one answer, each checked: an answer to something else (a second client mixes them, linuxcncrsh has one
// state for all) ends the connection. Lines end in any run of CR and LF. What the control refuses (NAK) is no fault of
// the connection. `get spindle`, `get brake` and `get spindle_override` without a number, and some requests of no
// version at all, make linuxcncrsh crash or repeat its last answer: they are refused here.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/connect/tcp_connection.h"

namespace spindrift {

class LinuxcncShell {
 public:
  struct Options {
    HostAndPort peer{"127.0.0.1", 5007};
    std::string password = "EMC";  ///< of `hello`, that of a fresh installation; never shown in any sentence
    double answer_s = 5.0;         ///< patience for one answer
  };
  explicit LinuxcncShell(Options options) : options_(std::move(options)) {}
  ~LinuxcncShell() { close(); }
  LinuxcncShell(const LinuxcncShell&) = delete;
  LinuxcncShell& operator=(const LinuxcncShell&) = delete;

  /// Throws ConnectionError: nobody there, or somebody who does not say HELLO ACK.
  void connect(const std::stop_token& stop);
  [[nodiscard]] bool connected() const noexcept { return handle_ >= 0; }
  void close() noexcept;

  /// What stands after the name in the answer, "1.000000 2.000000"; nothing if the control refuses (NAK). Throws
  /// ConnectionError: no answer, an answer to something else. The connection is then closed.
  [[nodiscard]] std::optional<std::string> get(const std::string& request);
  /// True: accepted, which is not yet done. Waits for at most `patience_s` (0: that of the options).
  [[nodiscard]] bool set(const std::string& command, double patience_s = 0.0);
  /// Messages of the operator that nobody has taken yet: why something was refused or ended.
  [[nodiscard]] std::vector<std::string> errors();
  [[nodiscard]] std::string name() const;

 private:
  void send(const std::string& line);
  std::string line(double patience_s);
  /// The next line that is no echo of `sent`.
  std::string answer(const std::string& sent, double patience_s);
  [[noreturn]] void fail(const std::string& what);

  Options options_;
  int handle_ = -1;
  std::string pending_;
};

}  // namespace spindrift
