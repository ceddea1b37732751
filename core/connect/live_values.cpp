// SPDX-License-Identifier: Apache-2.0
#include "core/connect/live_values.h"

#include <algorithm>
#include <cmath>

#include "core/base/untrusted_text.h"

namespace spindrift {

LiveValues::LiveValues(const Connections& connections)
    : reader_(connections,
              [this](const std::string& sentence) {
                if (sentences_.size() >= 20) sentences_.erase(sentences_.begin());
                sentences_.push_back(sentence);
              }),
      history_(connections.columns.size()) {
  for (std::size_t c = 0; c < connections.columns.size(); ++c) {
    reductions_.push_back(connections.columns[c].reduction);
    LiveColumn column;
    column.column = connections.columns[c].column;
    column.source = connections.columns[c].source;
    column.conversion = reader_.conversion(c);
    columns_.push_back(std::move(column));
  }
}

void LiveValues::take(const Arrival& arrival) {
  if (const ItemUnits* units = std::get_if<ItemUnits>(&arrival.what)) {
    reader_.setUnits(arrival.source, units->units);
    for (const std::uint32_t c : reader_.columnsOf(arrival.source)) columns_[c].conversion = reader_.conversion(c);
    return;
  }
  if (const Notice* notice = std::get_if<Notice>(&arrival.what)) {
    if (notice->kind != Notice::Kind::Missed) return;
    const std::vector<std::uint32_t>& of = reader_.columnsOf(arrival.source);
    for (std::uint32_t i = 0; i < of.size(); ++i) {
      if (!notice->items.empty() && std::find(notice->items.begin(), notice->items.end(), i) == notice->items.end())
        continue;
      LiveColumn& column = columns_[of[i]];
      column.known = false;
      column.text.clear();
      keep(of[i], {notice->time_s, std::numeric_limits<double>::quiet_NaN()});
    }
    return;
  }
  const Record& record = std::get<Record>(arrival.what);
  const auto reading = reader_.read(arrival.source, record);
  if (!reading) return;
  LiveColumn& column = columns_[reading->column];
  column.known = std::isfinite(reading->value);
  column.refused += reading->refused;
  column.came_s = record.received_s;
  column.text = record.quality == Quality::Text          ? printable(beginning(record.text, 80))
                : record.quality == Quality::Unavailable ? "UNAVAILABLE"
                                                         : std::string();
  if (column.known) {
    ++column.records;
    column.newest = {record.time_s, reading->value};
  }
  keep(reading->column, {record.time_s, reading->value});
}

void LiveValues::keep(std::size_t column, const LivePoint& point) {
  std::deque<Step>& steps = history_[column];
  // Values that come late are in the log; here only what is newest is looked at.
  if (!std::isfinite(point.time_s) || (!steps.empty() && point.time_s < steps.back().point.time_s)) return;
  const bool same = !steps.empty() && std::isfinite(point.value) && std::isfinite(steps.back().point.value) &&
                    std::floor(point.time_s / step_s) == std::floor(steps.back().point.time_s / step_s);
  if (!same) {
    // A value that comes and goes many times within a step leaves two points, too.
    const auto ofThisStep = [&](const Step& step) {
      return std::floor(point.time_s / step_s) == std::floor(step.point.time_s / step_s);
    };
    if (steps.size() > 1 && ofThisStep(steps.back()) && ofThisStep(steps[steps.size() - 2])) steps.pop_back();
    const Reduction how = reductions_[column];
    const double first = how == Reduction::MeanAbsolute ? std::abs(point.value) : point.value;
    steps.push_back({{point.time_s, first}, first, 1});
    // The point before the hour tells what held at its beginning.
    while (steps.size() > 2 && steps[1].point.time_s < point.time_s - history_s) steps.pop_front();
    return;
  }
  Step& step = steps.back();
  step.point.time_s = point.time_s;
  const double value = point.value;
  switch (reductions_[column]) {
    case Reduction::Last:
      step.point.value = value;
      break;
    case Reduction::Mean:
    case Reduction::MeanAbsolute:
      step.sum += reductions_[column] == Reduction::Mean ? value : std::abs(value);
      ++step.count;
      step.point.value = step.sum / static_cast<double>(step.count);
      break;
    case Reduction::Max:
      step.point.value = std::max(step.point.value, value);
      break;
    case Reduction::Min:
      step.point.value = std::min(step.point.value, value);
      break;
  }
}

std::vector<LivePoint> LiveValues::history(std::size_t column) const {
  std::vector<LivePoint> out;
  out.reserve(history_[column].size());
  for (const Step& step : history_[column]) out.push_back(step.point);
  return out;
}

std::optional<LivePoint> LiveValues::at(std::size_t column, double utc_s) const {
  const std::deque<Step>& steps = history_[column];
  const auto after = std::upper_bound(steps.begin(), steps.end(), utc_s,
                                      [](double time, const Step& step) { return time < step.point.time_s; });
  if (after == steps.begin() || !std::isfinite(std::prev(after)->point.value)) return std::nullopt;
  return std::prev(after)->point;
}

}  // namespace spindrift
