// SPDX-License-Identifier: GPL-3.0-or-later
// A week at 1 Hz with 60 signals: CPU time and memory of reading it as time series for the thermal models and as an
// operating log, and of what the search for missing effects makes of it. Usage: week_log_benchmark [rows] [signals]
// [FILE to keep the log in]. Ends with status 1 if either reading needs more than 1.3 times the memory of the numbers,
// or more than 10 s of CPU time.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/base/random.h"
#include "core/discrepancy/drivers.h"
#include "core/machine/operating_log.h"
#include "core/thermal/time_series.h"

namespace {

constexpr double most_memory = 1.3;  ///< of the numbers
constexpr double most_cpu_s = 10.0;

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

struct Usage {
  double cpu_s;
  double peak_MB;
};

Usage usage() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return {seconds(used.ru_utime) + seconds(used.ru_stime), 1.024e-3 * static_cast<double>(used.ru_maxrss)};
}

/// Half of the signals are temperatures; the others a speed, feeds, positions, switches and what a control has besides.
void writeLog(const std::filesystem::path& file, std::size_t rows, std::size_t signals) {
  using spindrift::Random;
  std::ofstream out(file);
  std::string line = "time_s";
  for (std::size_t k = 0; k < signals; ++k) {
    const char* known[] = {"spindle_rpm", "feed_x_mm_min", "feed_y_mm_min", "pos_x_mm", "pos_y_mm", "coolant"};
    line += k % 2 == 0                 ? fmt::format(",T_{}_degC", k / 2)
            : k / 2 < std::size(known) ? fmt::format(",{}", known[k / 2])
                                       : fmt::format(",signal_{}", k);
  }
  out << line << '\n';
  Random random(1);
  for (std::size_t row = 0; row < rows; ++row) {
    const auto time_s = static_cast<double>(row);
    const bool on = std::fmod(time_s, 7200.0) < 3600.0;
    line.clear();
    fmt::format_to(std::back_inserter(line), "{}", row);
    for (std::size_t k = 0; k < signals; ++k) {
      const auto number = static_cast<double>(k);
      if (k % 2 == 0) {
        fmt::format_to(std::back_inserter(line), ",{:.3f}",
                       20.0 + 2.0 * std::sin(7.3e-5 * time_s + number) + random.normal(0.0, 0.02));
      } else if (k / 2 == 5) {
        line += on ? ",1" : ",0";
      } else {
        fmt::format_to(std::back_inserter(line), ",{:.2f}", on ? 300.0 + 5.0 * number + random.normal(0.0, 1.0) : 0.0);
      }
    }
    line += '\n';
    out << line;
  }
}

/// Reads the time series in a process of its own, so that its peak of memory is not the one of the operating log.
bool readsLightly(const std::filesystem::path& file, double numbers_MB) {
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
    const Usage before = usage();
    const spindrift::TimeSeries series = spindrift::readTimeSeries(file);
    const Usage after = usage();
    const double cpu_s = after.cpu_s - before.cpu_s;
    const double grown_MB = after.peak_MB - before.peak_MB;
    fmt::print("time series of {} signals: {:.2f} s of CPU time, {:.1f} MB more than before ({:.2f} of the numbers)\n",
               series.signals.size(), cpu_s, grown_MB, grown_MB / numbers_MB);
    std::fflush(stdout);
    ::_exit(grown_MB > most_memory * numbers_MB || cpu_s > most_cpu_s ? 1 : 0);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace spindrift;
  const auto rows = static_cast<std::size_t>(argc > 1 ? std::atoll(argv[1]) : 604800);
  const auto signals = static_cast<std::size_t>(argc > 2 ? std::atoll(argv[2]) : 60);
  const std::filesystem::path file =
      argc > 3 ? std::filesystem::path(argv[3])
               : std::filesystem::temp_directory_path() / fmt::format("spindrift-week-{}.csv", ::getpid());
  writeLog(file, rows, signals);
  const double numbers_MB = 8e-6 * static_cast<double>(rows * (signals + 1));
  fmt::print("{} rows of {} signals: {:.1f} MB of text, {:.1f} MB of numbers\n", rows, signals,
             1e-6 * static_cast<double>(std::filesystem::file_size(file)), numbers_MB);
  const bool series_is_light = readsLightly(file, numbers_MB);
  const Usage before = usage();
  const OperatingLog log = OperatingLog::read(file);
  const Usage read = usage();
  const double cpu_s = read.cpu_s - before.cpu_s;
  const double grown_MB = read.peak_MB - before.peak_MB;
  fmt::print("operating log: {:.2f} s of CPU time, {:.1f} MB more than before ({:.2f} of the numbers)\n", cpu_s,
             grown_MB, grown_MB / numbers_MB);
  const DriverTable drivers({}, &log);
  const Usage driven = usage();
  fmt::print("{} drivers: {:.2f} s of CPU time, peak {:.1f} MB\n", drivers.all().size(), driven.cpu_s - read.cpu_s,
             driven.peak_MB);
  if (argc <= 3) std::filesystem::remove(file);
  return !series_is_light || grown_MB > most_memory * numbers_MB || cpu_s > most_cpu_s ? 1 : 0;
}
