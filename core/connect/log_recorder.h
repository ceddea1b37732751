// SPDX-License-Identifier: Apache-2.0
// From arrivals to rows of log.csv, at the pace of a caller's clock; no threads.
//
//   records -> bins of interval_s, per column -> one value (Reduction) -> rows
// A bin is closed settle_s after its end. A row is written where a column has changed by more than its dead band, and
// at least every longest_s while its source is connected; it stands at the end of its bin and holds the columns that
// made it necessary. A temperature that had held gets a row before the change, for temperatures are interpolated.
// Values that come after their bin was closed (a network that was paused) go to <log>.late.csv at once and are merged
// into the log in finish(). Lost and missed stretches are told in comment lines of the log. A column is unknown from
// the moment values were missed, or its source says UNAVAILABLE or a word without number: nothing is written for it.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/connect/append_file.h"
#include "core/connect/column_reader.h"
#include "core/connect/connections.h"
#include "core/connect/record.h"

namespace spindrift {

struct RecorderStatus {
  struct Column {
    std::uint64_t records = 0;                                     ///< usable values that came
    std::uint64_t refused = 0;                                     ///< words without a number, not finite numbers
    double last_value = std::numeric_limits<double>::quiet_NaN();  ///< in the unit of the column
    double last_s = std::numeric_limits<double>::quiet_NaN();      ///< when it held, UTC s
    bool known = false;
    std::string conversion;  ///< "FAHRENHEIT into degC: 0.5556 x - 17.78"
  };
  std::vector<Column> columns;
  std::uint64_t rows = 0;
  std::uint64_t late = 0;  ///< values that came after their row
  std::uint64_t rotations = 0;
  std::size_t backlog = 0;             ///< rows that wait for room on the disk
  std::string problem;                 ///< why rows wait; empty if none do
  std::vector<std::string> sentences;  ///< about sources and words, the last 100
  std::vector<std::string> gaps;       ///< the last 100
};

class LogRecorder {
 public:
  /// Begins `log` or goes on with it. `start_utc_s`: where time_s is 0; a log that is there already keeps its own.
  /// Throws InputError: not writable, other columns, a log that begins elsewhere or ends in the future.
  LogRecorder(const Connections& connections, const std::filesystem::path& log, double start_utc_s, double now_utc_s);

  LogRecorder(const LogRecorder&) = delete;
  LogRecorder& operator=(const LogRecorder&) = delete;

  void take(const Arrival& arrival);
  /// Closes what is due and writes it.
  void advance(double now_utc_s);
  /// False while a full disk has filled the memory that is set aside for it: take nothing more.
  [[nodiscard]] bool accepts() const noexcept { return backlog_bytes_ < most_backlog_bytes; }
  /// Closes everything and puts late values where they belong.
  void finish(double now_utc_s);

  [[nodiscard]] const RecorderStatus& status() const noexcept { return status_; }
  [[nodiscard]] double startUtc() const noexcept { return start_s_; }

 private:
  static constexpr std::size_t most_backlog_bytes = std::size_t{16} << 20;

  struct Sample {
    double time_s;  ///< since the start
    double value;   ///< NaN: unknown from here on
  };
  struct Bin {
    std::vector<std::vector<Sample>> samples;  ///< per column
  };
  struct ColumnState {
    double held = std::numeric_limits<double>::quiet_NaN();     ///< the newest value; NaN: unknown
    double reduced = std::numeric_limits<double>::quiet_NaN();  ///< of the last closed bin
    double written = std::numeric_limits<double>::quiet_NaN();  ///< the last value in the log
    double written_s = -std::numeric_limits<double>::infinity();
    double newest_s = -std::numeric_limits<double>::infinity();  ///< of the newest sample
  };

  void open(double now_s);
  /// Throws InputError: the log begins after now, or its last row lies after it.
  void requirePast(double last_s, double now_utc_s) const;
  [[nodiscard]] std::string header() const;
  void notice(std::uint32_t source, const Notice& notice);
  void sample(std::size_t column, double time_s, double value);
  void closeBin();
  [[nodiscard]] double reduce(std::size_t column, std::vector<Sample>& samples, double from_s, double to_s);
  void writeRow(double time_s, const std::vector<double>& values);
  void write(std::string lines);
  void flush();
  void comment(const std::string& text);
  void tell(const std::string& sentence);
  void rotate();
  void mergeLate();

  Connections connections_;
  std::filesystem::path log_;
  double start_s_;
  std::unique_ptr<AppendFile> file_;
  std::unique_ptr<AppendFile> late_;
  RecorderStatus status_;  ///< before reader_, which tells into it
  ColumnReader reader_;
  std::vector<ColumnState> states_;
  std::vector<double> live_from_s_;  ///< per source; infinite while it is lost
  std::deque<Bin> bins_;             ///< from bin first_bin_ on
  std::int64_t first_bin_ = 0;       ///< covers [first_bin_, first_bin_ + 1) * interval
  std::deque<std::string> backlog_;
  std::size_t backlog_bytes_ = 0;
  double last_row_s_ = -std::numeric_limits<double>::infinity();
  double synced_s_ = 0.0;
  double next_trial_s_ = 0.0;
  double now_s_ = 0.0;
};

}  // namespace spindrift
