// SPDX-License-Identifier: Apache-2.0
#include "core/connect/log_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"
#include "core/base/utc_time.h"
#include "core/machine/operating_log.h"

namespace spindrift {
namespace {

constexpr std::size_t most_sentences = 100;
constexpr double never = std::numeric_limits<double>::infinity();
constexpr const char* start_words = "# time_s counts from ";

std::filesystem::path latePath(const std::filesystem::path& log) {
  std::filesystem::path late = log;
  return late.replace_extension(".late.csv");
}

std::string shortNumber(double value) {
  return fmt::format("{:.10g}", value);
}

/// The time of a line of data; nothing for comments, the header and empty lines.
std::optional<double> timeOf(std::string_view line) {
  double time = 0.0;
  if (line.empty() || line.front() == '#' || !parseNumber(trimmed(line.substr(0, line.find(','))), time)) return {};
  return time;
}

void keep(std::vector<std::string>& list, const std::string& sentence) {
  if (list.size() >= most_sentences) list.erase(list.begin());
  list.push_back(sentence);
}

}  // namespace

LogRecorder::LogRecorder(const Connections& connections, const std::filesystem::path& log, double start_utc_s,
                         double now_utc_s)
    : connections_(connections),
      log_(log),
      start_s_(start_utc_s),
      reader_(connections, [this](const std::string& sentence) { tell(sentence); }) {
  states_.resize(connections_.columns.size());
  status_.columns.resize(connections_.columns.size());
  for (std::size_t c = 0; c < status_.columns.size(); ++c) status_.columns[c].conversion = reader_.conversion(c);
  live_from_s_.assign(connections_.sources.size(), never);
  open(now_utc_s);
}

std::string LogRecorder::header() const {
  std::string text = fmt::format("{}{}\n", start_words, utcText(start_s_));
  for (const ColumnMapping& column : connections_.columns) {
    text += fmt::format("# {}: {} {}{}\n", column.column, connections_.sources[column.source].name, column.address,
                        column.role.empty() ? "" : ", role " + column.role);
  }
  text += "time_s";
  for (const ColumnMapping& column : connections_.columns) text += "," + column.column;
  return text + "\n";
}

void LogRecorder::requirePast(double last_s, double now_utc_s) const {
  const double now_s = now_utc_s - start_s_;
  if (now_s >= 0.0 && last_s <= now_s + connections_.interval_s) return;
  throw InputError({log_, ""},
                   fmt::format("{} {}, and now it is {}; allowed: a log of the past, and a clock that is right.",
                               now_s < 0.0 ? "begins at" : "ends at",
                               utcText(now_s < 0.0 ? start_s_ : start_s_ + last_s), utcText(now_utc_s)));
}

void LogRecorder::open(double now_utc_s) {
  // Before anything is written; what is there says itself when it begins.
  std::error_code ignored;
  const std::uintmax_t there = std::filesystem::file_size(log_, ignored);
  if (ignored || there == 0) requirePast(-never, now_utc_s);
  file_ = std::make_unique<AppendFile>(log_);
  if (file_->repaired() > 0) tell(fmt::format("The last line of {} was incomplete and was removed.", log_.string()));
  double last_s = -std::numeric_limits<double>::infinity();
  if (file_->size() == 0) {
    if (!file_->append(header())) throw InputError(file_->failure());
  } else {
    // Only the head and the end of what may be long.
    std::ifstream in(log_);
    std::string line, expected = header();
    expected = expected.substr(expected.rfind('\n', expected.size() - 2) + 1);
    expected.pop_back();
    std::size_t number = 0;
    bool found = false;
    while (!found && std::getline(in, line)) {
      ++number;
      if (line.ends_with('\r')) line.pop_back();
      if (line.starts_with(start_words)) {
        const auto start = parseUtc(std::string_view(line).substr(std::string_view(start_words).size()));
        if (start) start_s_ = *start;
      }
      found = !line.empty() && line.front() != '#';
    }
    if (!found) {
      if (!file_->append(header())) throw InputError(file_->failure());
    } else if (line != expected) {
      throw InputError(
          SourcePlace::atLine(log_, number),
          fmt::format("has the columns \"{}\"; allowed for going on with it: \"{}\", or a new file.", line, expected));
    }
    const std::string tail = file_->tail(1 << 16);
    for (std::size_t begin = 0; begin < tail.size();) {
      const std::size_t end = tail.find('\n', begin);
      if (const auto time = timeOf(std::string_view(tail).substr(begin, end - begin))) last_s = *time;
      begin = end + 1;
    }
  }
  requirePast(last_s, now_utc_s);
  now_s_ = now_utc_s - start_s_;
  first_bin_ = static_cast<std::int64_t>(std::floor(now_s_ / connections_.interval_s));
  // The row of a bin stands at its end.
  if (std::isfinite(last_s))
    first_bin_ = std::max(first_bin_, static_cast<std::int64_t>(std::ceil(last_s / connections_.interval_s)));
  synced_s_ = now_s_;
  if (std::isfinite(last_s)) comment(fmt::format("recording goes on after {:.3f} s", last_s));
}

void LogRecorder::tell(const std::string& sentence) {
  keep(status_.sentences, sentence);
}

void LogRecorder::comment(const std::string& text) {
  write("# " + printable(text) + "\n");
}

void LogRecorder::notice(std::uint32_t source, const Notice& notice) {
  const std::string& name = connections_.sources[source].name;
  const double time_s = notice.time_s - start_s_;
  switch (notice.kind) {
    case Notice::Kind::Connected:
      live_from_s_[source] = time_s;
      break;
    case Notice::Kind::Lost:
      if (live_from_s_[source] < never) comment(fmt::format("{} lost at {:.3f} s: {}", name, time_s, notice.text));
      tell(fmt::format("{} is lost: {}", name, notice.text));
      live_from_s_[source] = never;
      break;
    case Notice::Kind::Resumed:
      live_from_s_[source] = time_s;
      comment(fmt::format("{} is back at {:.3f} s", name, time_s));
      break;
    case Notice::Kind::Missed: {
      const double from_s = std::max(notice.from_s - start_s_, 0.0);
      for (std::uint32_t i = 0; i < reader_.columnsOf(source).size(); ++i) {
        if (notice.items.empty() || std::find(notice.items.begin(), notice.items.end(), i) != notice.items.end())
          sample(reader_.columnsOf(source)[i], time_s, std::numeric_limits<double>::quiet_NaN());
      }
      comment(fmt::format("{}: values between {:.3f} s and {:.3f} s may be missing: {}", name, from_s, time_s,
                          notice.text));
      keep(status_.gaps, fmt::format("{}: {:.3f} s to {:.3f} s: {}", name, from_s, time_s, notice.text));
      break;
    }
    case Notice::Kind::Note:
      tell(fmt::format("{}: {}", name, notice.text));
      break;
  }
}

void LogRecorder::take(const Arrival& arrival) {
  if (const Notice* said = std::get_if<Notice>(&arrival.what)) {
    notice(arrival.source, *said);
    return;
  }
  if (const ItemUnits* units = std::get_if<ItemUnits>(&arrival.what)) {
    reader_.setUnits(arrival.source, units->units);
    for (const std::uint32_t c : reader_.columnsOf(arrival.source))
      status_.columns[c].conversion = reader_.conversion(c);
    return;
  }
  const Record& record = std::get<Record>(arrival.what);
  const auto reading = reader_.read(arrival.source, record);
  if (!reading) return;
  RecorderStatus::Column& told = status_.columns[reading->column];
  told.refused += reading->refused;
  told.known = std::isfinite(reading->value);
  if (told.known) {
    ++told.records;
    told.last_value = reading->value;
    told.last_s = record.time_s;
  }
  sample(reading->column, record.time_s - start_s_, reading->value);
}

void LogRecorder::sample(std::size_t column, double time_s, double value) {
  const double interval = connections_.interval_s;
  const auto bin = static_cast<std::int64_t>(std::floor(time_s / interval));
  ColumnState& state = states_[column];
  if (bin < first_bin_) {
    // Its row is written already.
    if (std::isfinite(value)) {
      ++status_.late;
      if (!late_) late_ = std::make_unique<AppendFile>(latePath(log_));
      if (time_s >= 0.0 && !late_->append(fmt::format("{:.3f},{},{}\n", time_s, column, shortNumber(value))))
        tell(late_->failure());
    }
    if (time_s >= state.newest_s) {
      state.newest_s = time_s;
      state.held = value;
    }
    return;
  }
  const auto index = static_cast<std::size_t>(bin - first_bin_);
  while (bins_.size() <= index) bins_.push_back({std::vector<std::vector<Sample>>(states_.size())});
  state.newest_s = std::max(state.newest_s, time_s);
  std::vector<Sample>& samples = bins_[index].samples[column];
  // More than that in one interval is averaged as it comes: memory stays flat at any rate.
  constexpr std::size_t most_samples = 4096;
  if (samples.size() >= most_samples) {
    std::vector<Sample> thinned;
    for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {
      thinned.push_back({samples[i].time_s, 0.5 * (samples[i].value + samples[i + 1].value)});
    }
    samples = std::move(thinned);
  }
  samples.push_back({time_s, value});
}

double LogRecorder::reduce(std::size_t column, std::vector<Sample>& samples, double from_s, double to_s) {
  ColumnState& state = states_[column];
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.time_s < b.time_s; });
  const Reduction how = connections_.columns[column].reduction;
  double value = state.held, time = from_s, sum = 0.0, weight = 0.0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  const auto hold = [&](double until) {
    if (std::isfinite(value)) {
      sum += (until - time) * (how == Reduction::MeanAbsolute ? std::abs(value) : value);
      weight += until - time;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    time = until;
  };
  for (const Sample& each : samples) {
    hold(std::clamp(each.time_s, time, to_s));
    value = each.value;
  }
  hold(to_s);
  state.held = value;
  // From here on it is not known: no value for the rest, and none for the interval.
  if (!std::isfinite(value)) return value;
  switch (how) {
    case Reduction::Mean:
    case Reduction::MeanAbsolute:
      if (weight > 0.0) return sum / weight;
      return how == Reduction::MeanAbsolute ? std::abs(value) : value;
    case Reduction::Max:
      return most;
    case Reduction::Min:
      return least;
    case Reduction::Last:
      break;
  }
  return value;
}

void LogRecorder::closeBin() {
  const double interval = connections_.interval_s;
  const double from_s = static_cast<double>(first_bin_) * interval;
  const double to_s = from_s + interval;
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> row(states_.size(), none), before(states_.size(), none);
  bool any = false, any_before = false;
  std::vector<Sample> nothing;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    ColumnState& state = states_[c];
    const double previous = state.reduced;
    state.reduced = reduce(c, bins_.empty() ? nothing : bins_.front().samples[c], from_s, to_s);
    if (!std::isfinite(state.reduced)) continue;
    const bool first = !std::isfinite(state.written) || !std::isfinite(previous);
    // A mean of what does not change differs by what rounding makes of it.
    const double still = std::max(connections_.columns[c].dead_band, 1e-12 * std::abs(state.written));
    const bool changed = !first && std::abs(state.reduced - state.written) > still;
    const bool due =
        to_s - state.written_s >= connections_.longest_s && from_s >= live_from_s_[connections_.columns[c].source];
    if (!first && !changed && !due) continue;
    row[c] = state.reduced;
    any = true;
    if (changed && state.written_s < from_s - 1e-9 && OperatingLog::isTemperature(connections_.columns[c].column)) {
      before[c] = previous;
      any_before = true;
    }
  }
  if (!bins_.empty()) bins_.pop_front();
  ++first_bin_;
  if (any_before) writeRow(from_s, before);
  if (any) writeRow(to_s, row);
}

void LogRecorder::writeRow(double time_s, const std::vector<double>& values) {
  std::string line = fmt::format("{:.3f}", time_s);
  for (std::size_t c = 0; c < values.size(); ++c) {
    line += ',';
    if (!std::isfinite(values[c])) continue;
    line += shortNumber(values[c]);
    states_[c].written = values[c];
    states_[c].written_s = time_s;
  }
  write(line + "\n");
  last_row_s_ = time_s;
  ++status_.rows;
}

void LogRecorder::write(std::string lines) {
  backlog_bytes_ += lines.size();
  backlog_.push_back(std::move(lines));
}

void LogRecorder::flush() {
  if (!backlog_.empty() && now_s_ >= next_trial_s_) {
    if (static_cast<double>(file_->size()) > connections_.rotate_mb * 1e6) rotate();
    std::string lines;
    std::size_t count = 0;
    const auto write_out = [&] {
      if (lines.empty()) return true;
      if (!file_->append(lines)) return false;
      backlog_.erase(backlog_.begin(), backlog_.begin() + static_cast<std::ptrdiff_t>(count));
      backlog_bytes_ -= lines.size();
      lines.clear();
      count = 0;
      return true;
    };
    bool good = true;
    for (std::size_t i = 0; good && count < backlog_.size(); ++i) {
      lines += backlog_[count++];
      if (lines.size() > (1 << 16)) good = write_out();
    }
    good = good && write_out();
    if (good) {
      if (!status_.problem.empty()) tell(fmt::format("{} is written again.", log_.string()));
      status_.problem.clear();
    } else {
      if (status_.problem.empty()) tell(file_->failure());
      status_.problem = file_->failure();
      next_trial_s_ = now_s_ + 1.0;
    }
  }
  status_.backlog = backlog_.size();
  if (now_s_ - synced_s_ >= 5.0) {
    file_->sync();
    if (late_) late_->sync();
    synced_s_ = now_s_;
  }
}

void LogRecorder::advance(double now_utc_s) {
  now_s_ = std::max(now_s_, now_utc_s - start_s_);
  const double interval = connections_.interval_s;
  while (accepts() && static_cast<double>(first_bin_ + 1) * interval + connections_.settle_s <= now_s_) closeBin();
  flush();
}

void LogRecorder::rotate() {
  file_->sync();
  std::filesystem::path aside;
  for (int number = 1;; ++number) {
    aside = log_;
    aside.replace_filename(fmt::format("{}-{:04}{}", log_.stem().string(), number, log_.extension().string()));
    if (!std::filesystem::exists(aside)) break;
  }
  std::error_code failed;
  std::filesystem::rename(log_, aside, failed);
  if (failed) {
    tell(fmt::format("{} cannot be put aside: {}.", log_.string(), failed.message()));
    return;
  }
  auto fresh = std::make_unique<AppendFile>(log_);
  std::string begin = header() + fmt::format("# goes on after {}\n", aside.filename().string());
  // States that hold must stand in the new file too.
  std::string held;
  bool any = false;
  double last_s = 0.0;
  for (const ColumnState& state : states_) {
    held += ',';
    if (std::isfinite(state.written)) {
      held += shortNumber(state.written);
      last_s = std::max(last_s, state.written_s);
      any = true;
    }
  }
  // Rows that wait are newer than what is in the file, and may be older than the last row that was made.
  if (const auto waiting = timeOf(backlog_.front())) last_s = std::min(last_s, *waiting);
  if (any) begin += fmt::format("{:.3f}{}\n", last_s, held);
  if (!fresh->append(begin)) {
    std::filesystem::rename(aside, log_, failed);
    return;
  }
  file_ = std::move(fresh);
  ++status_.rotations;
}

void LogRecorder::finish(double now_utc_s) {
  now_s_ = std::max(now_s_, now_utc_s - start_s_);
  while (!bins_.empty() && accepts()) {
    // The last bin has not ended yet: its row stands where it would.
    closeBin();
  }
  // What holds at the end, so that the log reaches it.
  std::vector<double> last(states_.size(), std::numeric_limits<double>::quiet_NaN());
  bool any = false;
  for (std::size_t c = 0; c < states_.size(); ++c) {
    if (live_from_s_[connections_.columns[c].source] == never || !std::isfinite(states_[c].reduced)) continue;
    last[c] = states_[c].reduced;
    any = true;
  }
  const double end_s = std::max(now_s_, static_cast<double>(first_bin_) * connections_.interval_s);
  if (any && end_s > last_row_s_) writeRow(end_s, last);
  comment(fmt::format("recording ends at {:.3f} s", now_s_));
  next_trial_s_ = now_s_;
  flush();
  file_->sync();
  if (late_ || std::filesystem::exists(latePath(log_))) mergeLate();
}

void LogRecorder::mergeLate() {
  late_.reset();
  const std::filesystem::path late_file = latePath(log_);
  struct Late {
    double time_s;
    std::size_t column;
    std::string value;
  };
  std::vector<Late> late;
  std::ifstream in(late_file);
  std::string line;
  while (std::getline(in, line)) {
    const std::vector<std::string> parts = splitList(line);
    double time = 0.0, column = 0.0;
    if (parts.size() == 3 && parseNumber(parts[0], time) && parseNumber(parts[1], column) && column >= 0.0 &&
        column < static_cast<double>(states_.size()))
      late.push_back({time, static_cast<std::size_t>(column), parts[2]});
  }
  in.close();
  std::stable_sort(late.begin(), late.end(), [](const Late& a, const Late& b) { return a.time_s < b.time_s; });
  const std::filesystem::path merged = log_.string() + ".merged.part";
  std::error_code failed;
  {
    std::ifstream rows(log_);
    std::ofstream out(merged);
    std::size_t next = 0;
    const auto put = [&](double until) {
      for (; next < late.size() && late[next].time_s < until; ++next) {
        out << fmt::format("{:.3f}{}{}{}\n", late[next].time_s, std::string(late[next].column + 1, ','),
                           late[next].value, std::string(states_.size() - 1 - late[next].column, ','));
      }
    };
    bool past_header = false;
    while (std::getline(rows, line)) {
      if (const auto time = timeOf(line); time && past_header) put(*time);
      if (!line.empty() && line.front() != '#') past_header = true;
      out << line << '\n';
    }
    put(std::numeric_limits<double>::infinity());
    out.flush();
    if (!out || rows.bad()) {
      tell(fmt::format("Late values stay in {}: {} cannot be written.", late_file.string(), merged.string()));
      std::filesystem::remove(merged, failed);
      return;
    }
  }
  {
    AppendFile whole(merged);
    whole.sync();
  }
  std::filesystem::rename(merged, log_, failed);
  if (failed) {
    tell(fmt::format("Late values stay in {}: {}.", late_file.string(), failed.message()));
    return;
  }
  std::filesystem::remove(late_file, failed);
}

}  // namespace spindrift
