// SPDX-License-Identifier: Apache-2.0
// The newest values of all columns and their last hour, for looking at while data come. Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/connect/column_reader.h"
#include "core/connect/connections.h"
#include "core/connect/record.h"

namespace spindrift {

/// A value of a column, in its unit. It holds until the next one.
struct LivePoint {
  double time_s = 0.0;                                      ///< UTC s since 1970
  double value = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unknown from here on
};

struct LiveColumn {
  std::string column;
  std::uint32_t source = 0;  ///< index in Connections::sources
  std::string conversion;    ///< as ColumnReader says it
  std::uint64_t records = 0;
  std::uint64_t refused = 0;
  bool known = false;                                        ///< the newest record was a number
  std::string text;                                          ///< the word that it was, or why it is none: "UNAVAILABLE"
  LivePoint newest;                                          ///< the last number; NaN: none came yet
  double came_s = std::numeric_limits<double>::quiet_NaN();  ///< when the newest record came, our clock
};

class LiveValues {
 public:
  static constexpr double history_s = 3600.0;
  /// Of the values that come within such a time one point is kept, by the column's reduction: memory stays flat.
  static constexpr double step_s = 1.0;

  explicit LiveValues(const Connections& connections);
  LiveValues(const LiveValues&) = delete;
  LiveValues& operator=(const LiveValues&) = delete;
  void take(const Arrival& arrival);
  [[nodiscard]] const std::vector<LiveColumn>& columns() const noexcept { return columns_; }
  /// Sentences about words and units; the last 20.
  [[nodiscard]] const std::vector<std::string>& sentences() const noexcept { return sentences_; }
  /// Of the last hour before the newest value, oldest first.
  [[nodiscard]] std::vector<LivePoint> history(std::size_t column) const;
  /// What held at that time: the last point at or before it; nothing where nothing is known, or is kept no longer.
  [[nodiscard]] std::optional<LivePoint> at(std::size_t column, double utc_s) const;

 private:
  struct Step {
    LivePoint point;
    double sum = 0.0;
    std::uint64_t count = 0;
  };
  void keep(std::size_t column, const LivePoint& point);

  std::vector<Reduction> reductions_;
  std::vector<std::string> sentences_;  ///< before reader_, which tells into it
  ColumnReader reader_;
  std::vector<LiveColumn> columns_;
  std::vector<std::deque<Step>> history_;
};

}  // namespace spindrift
