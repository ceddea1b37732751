// SPDX-License-Identifier: GPL-3.0-or-later
// What a source delivers, kept for looking at.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/connect/source.h"

namespace spindrift::testing {

struct Collected final : RecordSink {
  void record(Record record) override { records.push_back(std::move(record)); }
  void missed(const std::string& why) override { missings.push_back(why); }
  void missedOf(const std::vector<std::uint32_t>&, const std::string& why) override { missings.push_back(why); }
  void note(const std::string& sentence) override { notes.push_back(sentence); }
  void units(ItemUnits learnt) override { item_units = std::move(learnt.units); }

  /// Values of an item in the order of delivery.
  [[nodiscard]] std::vector<double> values(std::uint32_t item = 0) const {
    std::vector<double> out;
    for (const Record& each : records) {
      if (each.item == item) out.push_back(each.value);
    }
    return out;
  }

  std::vector<Record> records;
  std::vector<std::string> missings;
  std::vector<std::string> notes;
  std::vector<std::string> item_units;
};

/// Waits until `done()`; false after `patience_s`.
inline bool waitUntil(const std::function<bool()>& done, double patience_s = 10.0) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (!done()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

/// Polls until `done()`; false after `patience_s`.
inline bool pollUntil(Source& source, RecordSink& sink, const std::function<bool()>& done, double patience_s = 10.0) {
  return waitUntil(
      [&] {
        source.poll(0.02, sink);
        return done();
      },
      patience_s);
}

}  // namespace spindrift::testing
