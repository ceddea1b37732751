// SPDX-License-Identifier: Apache-2.0
#include "core/connect/live_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <mutex>
#include <thread>

#include "core/connect/recording.h"

namespace spindrift {

const LiveColumn* LiveSnapshot::find(std::string_view column) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const LiveColumn& c) { return c.column == column; });
  return found == columns.end() ? nullptr : &*found;
}

bool LiveSnapshot::isLost(const LiveColumn& column) const {
  return column.source >= sources.size() || sources[column.source].status.state != SourceStatus::State::Live;
}

struct LiveRecording::Shared {
  Shared(const Connections& connections, const std::filesystem::path& log, double start_utc_s,
         const RunnerOptions& options)
      : values(connections), recording(connections, log, start_utc_s, options) {
    newest.recording = !log.empty();
    newest.start_s = recording.startUtc();
    publish();
  }

  void publish() {
    const std::vector<SourceStatus> states = recording.sources();
    const RecorderStatus& log = recording.log();
    const std::scoped_lock lock(mutex);
    newest.sources.resize(states.size());
    for (std::size_t s = 0; s < states.size(); ++s) {
      const SourceDescription& source = recording.connections().sources[s];
      newest.sources[s] = {source.name, source.url, states[s]};
    }
    newest.rows = log.rows;
    newest.problem = failure.empty() ? log.problem : failure;
    newest.gaps = log.gaps;
  }

  void run(const std::stop_token& stop) {
    const auto look = [this](const Arrival& arrival) {
      const std::scoped_lock lock(mutex);
      values.take(arrival);
    };
    try {
      while (!stop.stop_requested()) {
        recording.turn(0.1, look);
        publish();
      }
      recording.finish(look);
    } catch (const std::exception& error) {
      failure = fmt::format("The recording broke off: {}", error.what());
    }
    publish();
    ended = true;
  }

  mutable std::mutex mutex;
  LiveValues values;    ///< under the mutex
  LiveSnapshot newest;  ///< under the mutex, without columns and sentences
  Recording recording;  ///< of the thread alone
  std::string failure;  ///< of the thread alone
  std::atomic<bool> ended{false};
  std::jthread thread;
};

LiveRecording::LiveRecording(const Connections& connections, const std::filesystem::path& log, double start_utc_s,
                             const RunnerOptions& options)
    : shared_(std::make_unique<Shared>(connections, log, start_utc_s, options)) {
  shared_->thread = std::jthread([shared = shared_.get()](const std::stop_token& stop) { shared->run(stop); });
}

LiveRecording::~LiveRecording() = default;

void LiveRecording::requestStop() {
  shared_->thread.request_stop();
}

bool LiveRecording::ended() const {
  return shared_->ended;
}

LiveSnapshot LiveRecording::snapshot() const {
  const std::scoped_lock lock(shared_->mutex);
  LiveSnapshot out = shared_->newest;
  out.now_s = localUtc();
  out.columns = shared_->values.columns();
  out.sentences = shared_->values.sentences();
  return out;
}

const Connections& LiveRecording::connections() const {
  return shared_->recording.connections();
}

std::vector<LivePoint> LiveRecording::history(std::size_t column) const {
  const std::scoped_lock lock(shared_->mutex);
  return column < shared_->values.columns().size() ? shared_->values.history(column) : std::vector<LivePoint>();
}

std::optional<LivePoint> LiveRecording::at(std::string_view column, double utc_s) const {
  const std::scoped_lock lock(shared_->mutex);
  const std::vector<LiveColumn>& columns = shared_->values.columns();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].column == column) return shared_->values.at(c, utc_s);
  }
  return std::nullopt;
}

MachineRest machineRest(const LiveSnapshot& snapshot) {
  constexpr double turning_rpm = 1.0;
  constexpr double moving_mm_min = 1.0;
  MachineRest out;
  std::string unknown;
  for (const char* name : {"spindle_rpm", "feed_x_mm_min", "feed_y_mm_min", "feed_z_mm_min"}) {
    const LiveColumn* column = snapshot.find(name);
    if (column == nullptr) continue;
    if (snapshot.isLost(*column) || !column->known) {
      if (unknown.empty()) unknown = name;
      continue;
    }
    out.tells = true;
    const bool spindle = column->column == "spindle_rpm";
    const double value = std::abs(column->newest.value);
    if (!out.sentence.empty() || value < (spindle ? turning_rpm : moving_mm_min)) continue;
    out.sentence = spindle
                       ? fmt::format("The spindle is still turning ({:.0f} rpm): wait until it stands still.", value)
                       : fmt::format("Axis {} is still moving ({:.0f} mm/min): wait until it stands still.",
                                     static_cast<char>(std::toupper(name[5])), value);
  }
  if (out.sentence.empty() && !unknown.empty()) {
    out.sentence = fmt::format("{} is not known at present: look whether the machine stands still.", unknown);
    out.tells = true;
  }
  out.at_rest = out.tells && out.sentence.empty();
  return out;
}

}  // namespace spindrift
