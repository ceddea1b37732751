// SPDX-License-Identifier: GPL-3.0-or-later
// 10^7 records of 60 signals through the queue into a log: is memory flat, how many a second? The time of the records
// is made (10,000 a second), so that a run of 17 minutes takes as long as the work in it. Usage: connect_benchmark
// [records]. Ends with status 1 if memory grows by more than 16 MB after the first tenth.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "core/base/random.h"
#include "core/connect/log_recorder.h"
#include "core/connect/record_queue.h"

namespace {

double residentMb() {
  std::ifstream in("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  in >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace spindrift;
  const auto records = static_cast<std::uint64_t>(argc > 1 ? std::atoll(argv[1]) : 10000000);
  constexpr std::uint32_t signals = 60;
  constexpr double rate_hz = 10000.0, start_s = 1769846400.0;
  const std::filesystem::path log =
      std::filesystem::temp_directory_path() / fmt::format("spindrift-benchmark-{}.csv", ::getpid());
  Connections connections;
  connections.sources.push_back({"a", "mtconnect", "http://127.0.0.1:1", nullptr});
  for (std::uint32_t i = 0; i < signals; ++i) {
    ColumnMapping column;
    column.column = i < 30 ? fmt::format("T_{}_degC", i) : fmt::format("signal_{}", i);
    column.item = i;
    column.reduction = i < 30 ? Reduction::Mean : Reduction::Last;
    column.dead_band = 0.05;
    connections.columns.push_back(column);
  }
  RecordQueue queue;
  std::stop_source stop;
  std::atomic<bool> done{false};
  std::thread source([&] {
    Random random(1);
    for (std::uint64_t i = 0; i < records; ++i) {
      Record record;
      record.item = static_cast<std::uint32_t>(i % signals);
      record.time_s = start_s + static_cast<double>(i) / rate_hz;
      record.value = 20.0 + 5.0 * std::sin(1e-6 * static_cast<double>(i)) + random.normal(0.0, 0.02);
      if (!queue.push({0, record}, stop.get_token())) break;
    }
    done = true;
  });
  const auto begin = std::chrono::steady_clock::now();
  double early = 0.0, most = 0.0, now_s = start_s;
  std::uint64_t taken_count = 0, told = 0;
  {
    LogRecorder recorder(connections, log, start_s, start_s);
    recorder.take({0, Notice{Notice::Kind::Connected, start_s, start_s, ""}});
    std::vector<Arrival> taken;
    while (!done || queue.size() > 0) {
      queue.take(taken, 0.01);
      for (const Arrival& arrival : taken) {
        recorder.take(arrival);
        now_s = std::get<Record>(arrival.what).time_s;
      }
      taken_count += taken.size();
      recorder.advance(now_s);
      if (taken_count * 10 >= (told + 1) * records) {
        ++told;
        const double resident = residentMb();
        if (told == 1) early = resident;
        most = std::max(most, resident);
        fmt::print("{:>9} records, {:>6} rows, {:.1f} MB\n", taken_count, recorder.status().rows, resident);
      }
    }
    recorder.finish(now_s);
    std::uint64_t used = 0;
    for (const auto& column : recorder.status().columns) used += column.records;
    fmt::print("{} of {} records used, {} late\n", used, records, recorder.status().late);
  }
  source.join();
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  fmt::print("{:.2f} million records a second, {:.1f} MB of log, memory grew by {:.1f} MB\n",
             1e-6 * static_cast<double>(records) / elapsed, static_cast<double>(std::filesystem::file_size(log)) / 1e6,
             most - early);
  std::filesystem::remove(log);
  return most - early > 16.0 ? 1 : 0;
}
