// SPDX-License-Identifier: Apache-2.0
// The one interface of everything that delivers data: a machine, a broker, a module, a line of text.
//
//   connect -> list (what is there) -> subscribe (which of it) -> poll, poll, poll -> close
//
// A source is used by one thread at a time and makes none. Any call may throw ConnectionError: the source is then
// closed and may be connected again; subscribing once more goes on where it was, if the protocol can, and says through
// the sink what was missed. Only the address that the user entered is contacted, and nothing is ever written to it
// beyond what its protocol needs for reading.
#pragma once

#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "core/connect/record.h"

namespace spindrift {

/// The peer cannot be reached, has gone or speaks nonsense. One sentence with the address, without any secret.
class ConnectionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where a source puts what it has read.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  /// May wait while the receiver is busy.
  virtual void record(Record record) = 0;
  /// Values between the last record and now may be missing.
  virtual void missed(const std::string& why) = 0;
  /// The same of these items only.
  virtual void missedOf(const std::vector<std::uint32_t>& items, const std::string& why) = 0;
  virtual void note(const std::string& sentence) = 0;
  /// Of the subscription, where a source learns them only from what it is sent.
  virtual void units(ItemUnits /*learnt*/) {}
};

class Source {
 public:
  virtual ~Source() = default;
  /// Throws ConnectionError within a few seconds. `stop` ends waiting early.
  virtual void connect(const std::stop_token& stop) = 0;
  /// What is there; some protocols must listen for `listen_s` to know. Connected only.
  [[nodiscard]] virtual std::vector<DataItem> list(double listen_s, const std::stop_token& stop) = 0;
  /// From now on `items` (addresses) are delivered; Record::item counts them. An item that is not there is noted.
  virtual void subscribe(const std::vector<std::string>& items, RecordSink& sink, const std::stop_token& stop) = 0;
  /// The unit of an item as the source says it; empty if it says none. Connected only.
  [[nodiscard]] virtual std::string unit(const std::string& /*address*/) const { return {}; }
  /// Waits for at most `wait_s` and delivers what has come.
  virtual void poll(double wait_s, RecordSink& sink) = 0;
  virtual void close() noexcept = 0;
};

}  // namespace spindrift
