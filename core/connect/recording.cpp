// SPDX-License-Identifier: Apache-2.0
#include "core/connect/recording.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "core/base/json_reader.h"
#include "core/base/utc_time.h"

namespace spindrift {
namespace {

std::string_view toString(SourceStatus::State state) {
  switch (state) {
    case SourceStatus::State::Connecting:
      return "connecting";
    case SourceStatus::State::Live:
      return "live";
    case SourceStatus::State::Lost:
      return "lost";
    case SourceStatus::State::Stopped:
      break;
  }
  return "stopped";
}

}  // namespace

Recording::Recording(const Connections& connections, const std::filesystem::path& log, double start_utc_s,
                     const RunnerOptions& options)
    : connections_(connections), start_s_(start_utc_s), queue_(std::make_shared<RecordQueue>()) {
  unrecorded_.columns.resize(connections_.columns.size());
  if (!log.empty()) recorder_ = std::make_unique<LogRecorder>(connections_, log, start_utc_s, localUtc());
  for (std::uint32_t s = 0; s < connections_.sources.size(); ++s) {
    // A source of which nothing is wanted is left alone: a camera may be in use elsewhere.
    std::vector<std::string> items = connections_.itemsOf(s);
    runners_.push_back(items.empty() ? nullptr
                                     : std::make_unique<SourceRunner>(s, connections_.sources[s].make(),
                                                                      std::move(items), queue_, options));
  }
}

void Recording::takeAll(const Onlooker& onlooker) {
  for (const Arrival& arrival : taken_) {
    if (onlooker) onlooker(arrival);
    if (recorder_) recorder_->take(arrival);
  }
}

void Recording::turn(double wait_s, const Onlooker& onlooker) {
  if (!recorder_ || recorder_->accepts()) {
    queue_->take(taken_, wait_s);
    takeAll(onlooker);
  } else {
    std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
  }
  if (recorder_) recorder_->advance(localUtc());
}

void Recording::finish(const Onlooker& onlooker) {
  for (const auto& runner : runners_) {
    if (runner) runner->requestStop();
  }
  for (const auto& runner : runners_) {
    if (runner) runner->stop();
  }
  queue_->take(taken_, 0.0);
  takeAll(onlooker);
  if (recorder_) recorder_->finish(localUtc());
}

std::vector<SourceStatus> Recording::sources() const {
  std::vector<SourceStatus> out;
  for (const auto& runner : runners_) {
    out.push_back(runner ? runner->status() : SourceStatus{});
    if (!runner) out.back().state = SourceStatus::State::Stopped;
  }
  return out;
}

std::vector<std::string> Recording::shortcomings() const {
  std::vector<std::string> out;
  const std::vector<SourceStatus> states = sources();
  for (std::size_t s = 0; s < states.size(); ++s) {
    if (runners_[s] && states[s].connections == 0)
      out.push_back(fmt::format("{} was never reached: {}", connections_.sources[s].name, states[s].sentence));
  }
  for (std::size_t c = 0; c < connections_.columns.size(); ++c) {
    const ColumnMapping& column = connections_.columns[c];
    if (log().columns[c].records == 0 && states[column.source].connections > 0) {
      out.push_back(fmt::format("{} has no value: {} gave none of {}.", column.column,
                                connections_.sources[column.source].name, column.address));
    }
  }
  if (!log().problem.empty()) out.push_back(log().problem);
  return out;
}

nlohmann::json Recording::json() const {
  nlohmann::json out;
  const std::vector<SourceStatus> states = sources();
  out["sources"] = nlohmann::json::array();
  for (std::size_t s = 0; s < states.size(); ++s) {
    const SourceStatus& state = states[s];
    out["sources"].push_back({{"name", connections_.sources[s].name},
                              {"kind", connections_.sources[s].kind},
                              {"url", connections_.sources[s].url},
                              {"state", toString(state.state)},
                              {"reason", state.sentence},
                              {"records", state.records},
                              {"connections", state.connections},
                              {"missed", state.missed},
                              {"clock_offset_s", jsonNumber(state.clock_offset_s)},
                              {"clock_steps", state.clock_steps}});
  }
  const RecorderStatus& log_state = log();
  out["columns"] = nlohmann::json::array();
  for (std::size_t c = 0; c < connections_.columns.size(); ++c) {
    const ColumnMapping& column = connections_.columns[c];
    const RecorderStatus::Column& state = log_state.columns[c];
    out["columns"].push_back({{"column", column.column},
                              {"source", connections_.sources[column.source].name},
                              {"item", column.address},
                              {"conversion", state.conversion},
                              {"reduce", spindrift::toString(column.reduction)},
                              {"role", column.role},
                              {"records", state.records},
                              {"refused", state.refused},
                              {"last", jsonNumber(state.last_value)}});
  }
  out["rows"] = log_state.rows;
  out["late"] = log_state.late;
  out["rotations"] = log_state.rotations;
  out["start_utc"] = utcText(startUtc());
  out["gaps"] = log_state.gaps;
  out["messages"] = log_state.sentences;
  out["shortcomings"] = shortcomings();
  return out;
}

}  // namespace spindrift
