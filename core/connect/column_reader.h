// SPDX-License-Identifier: Apache-2.0
// What a record means for the column that it is mapped to: unit converted, word looked up, scale and offset applied.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/connect/connections.h"
#include "core/connect/record.h"

namespace spindrift {

class ColumnReader {
 public:
  /// `tell` gets a sentence, once a column, about a unit that does not fit and a word without a number.
  ColumnReader(const Connections& connections, std::function<void(const std::string&)> tell);

  struct Reading {
    std::uint32_t column = 0;
    double value = std::numeric_limits<double>::quiet_NaN();  ///< in the unit of the column; NaN: unknown from here on
    bool refused = false;  ///< a word without a number, a number that is not finite, a unit that does not fit
  };
  /// Nothing for an item that no column is mapped to.
  [[nodiscard]] std::optional<Reading> read(std::uint32_t source, const Record& record);
  /// The units of the subscription, as the source says them. A column that states a unit keeps that.
  void setUnits(std::uint32_t source, const std::vector<std::string>& units);
  /// "FAHRENHEIT: 0.5556 x + -17.78".
  [[nodiscard]] const std::string& conversion(std::size_t column) const { return states_[column].conversion; }
  /// The columns of a source, in the order of its subscription.
  [[nodiscard]] const std::vector<std::uint32_t>& columnsOf(std::uint32_t source) const { return column_of_[source]; }

 private:
  struct State {
    double scale = 1.0;
    double offset = 0.0;
    bool usable = true;  ///< false: the unit cannot become that of the column
    bool word_told = false;
    std::string conversion;
  };
  void complain(std::uint32_t source, const ColumnMapping& mapping, const Record& record);

  std::vector<std::string> sources_;
  std::vector<ColumnMapping> columns_;
  std::function<void(const std::string&)> tell_;
  std::vector<std::vector<std::uint32_t>> column_of_;  ///< source, item -> column
  std::vector<State> states_;
};

}  // namespace spindrift
