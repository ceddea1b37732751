// SPDX-License-Identifier: Apache-2.0
// What sources deliver: values with their time, and what has to be said about them.
//
// Times are UTC seconds since 1970. Two clocks meet: that of the source (or of the adapter behind it) and ours, which
// is read once from the computer and then counts on, so that setting the computer's clock moves nothing (localUtc).
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace spindrift {

/// One of the things that a source can tell.
struct DataItem {
  std::string address;    ///< what a subscription names: id of the data item, topic, register, place of a line
  std::string name;       ///< as people call it; may be empty
  std::string component;  ///< where it belongs: "mill / axes / spindle"
  std::string category;   ///< "sample", "event", "condition", or empty
  std::string type;       ///< "TEMPERATURE", "float32", ...; as the source says
  std::string unit;       ///< as the source says: "CELSIUS", "MILLIMETER"; empty if it says none
  std::string example;    ///< a present value, where listing shows one
};

enum class Quality : std::uint8_t {
  Good,         ///< a number
  Text,         ///< a word: it becomes a number by the table of its column
  Unavailable,  ///< the source says that it does not know
};

struct Record {
  std::uint32_t item = 0;   ///< index in the subscription
  std::uint16_t clock = 0;  ///< which clock of the source: one a device or adapter
  /// The state found when connecting: it holds now, its time says since when.
  bool snapshot = false;
  Quality quality = Quality::Good;
  double source_s = std::numeric_limits<double>::quiet_NaN();    ///< on the source's clock; NaN: it sends no time
  double received_s = std::numeric_limits<double>::quiet_NaN();  ///< on ours
  double time_s = std::numeric_limits<double>::quiet_NaN();      ///< when it held, on ours: set by the runner
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string text;  ///< the word of Quality::Text
};

/// A sentence about the connection, in its place among the records.
struct Notice {
  enum class Kind {
    Connected,  ///< for the first time
    Lost,       ///< nothing comes at present; `text`: why
    Resumed,    ///< it comes again; what happened meanwhile is said by Missed, or nothing was missed
    Missed,     ///< between from_s and time_s values may be missing; `text`: why
    Note,       ///< anything else worth saying
  };
  Kind kind = Kind::Note;
  double from_s = 0.0;
  double time_s = 0.0;
  std::string text;
  std::vector<std::uint32_t> items = {};  ///< of Missed: which; empty: all of the subscription
};

/// The units of a subscription as the source says them, empty where it says none: before the first record.
struct ItemUnits {
  std::vector<std::string> units;
};

using Delivery = std::variant<Record, Notice, ItemUnits>;

struct Arrival {
  std::uint32_t source = 0;  ///< index of the source
  Delivery what;
};

/// Our clock: UTC s, read from the computer once and then counted on.
[[nodiscard]] double localUtc();

}  // namespace spindrift
