// SPDX-License-Identifier: GPL-3.0-or-later
// A day of a log at ten rows a second with 20 inputs, from its file to the identified model: at most 60 s and 1 GB,
// else the benchmark ends with status 1. Processor time of all threads, and the largest memory of the process.
#include <sys/resource.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "core/base/random.h"
#include "core/workflows/thermal_workflow.h"
#include "tests/support/temp_folder.h"

namespace {

constexpr int sensors = 19;
constexpr int rows = 864000;

/// Written in parts, so that the making of the file is not what fills the memory.
std::filesystem::path writeDay(const spindrift::testing::TempFolder& folder) {
  spindrift::Random random(3);
  const std::filesystem::path file = folder / "day.csv";
  std::FILE* out = std::fopen(file.c_str(), "w");
  if (out == nullptr) return {};
  std::fputs("time_s,spindle_rpm", out);
  for (int i = 0; i < sensors; ++i) std::fprintf(out, ",T_%d_degC", i);
  std::fputs(",z_um\n", out);
  std::array<double, sensors> body;
  body.fill(20.0);
  double rpm = 0.0;
  for (int k = 0; k < rows; ++k) {
    if (k % 36000 == 0) rpm = 1000.0 * random.uniform(0.0, 6.0);
    std::fprintf(out, "%.1f,%.0f", 0.1 * k, rpm);
    for (int i = 0; i < sensors; ++i) {
      double& b = body[static_cast<std::size_t>(i)];
      b += 0.1 / (600.0 + 400.0 * i) * (20.0 + 2e-3 * rpm - b);
      std::fprintf(out, ",%.3f", b + random.normal(0.0, 0.02));
    }
    std::fprintf(out, ",%.3f\n", 2.0 * (body[3] - 20.0) - 1.5 * (body[10] - 20.0) + random.normal(0.0, 0.1));
  }
  std::fclose(out);
  return file;
}

double processorSeconds(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

int main() {
  const spindrift::testing::TempFolder folder;
  spindrift::IdentifyRequest request;
  request.log = writeDay(folder);
  request.output = "z_um";
  request.train = {0.0, 57600.0};
  request.test = {57600.0, 86400.0};
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  const spindrift::IdentifyResult result = spindrift::identifyThermalModel(request, {});
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  const double seconds = processorSeconds(after) - processorSeconds(before);
  const double gigabytes = static_cast<double>(after.ru_maxrss) * 1024.0 * 1e-9;
  std::printf(
      "%d rows, %d inputs: %.1f s of processor (at most 60), %.2f GB (at most 1), test rms %.3f um, %zu inputs\n", rows,
      sensors + 1, seconds, gigabytes, result.test.rmse, result.inputs.size());
  return seconds <= 60.0 && gigabytes <= 1.0 ? 0 : 1;
}
