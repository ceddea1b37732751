// SPDX-License-Identifier: GPL-3.0-or-later
// What the search for the missing effect costs with the number of points: 32 states that were re-referenced, seen by
// 12, 1,125 and 10,600 points (a thousand, a hundred thousand and a million observations). Wall-clock and processor
// time of the search, the largest memory of the process so far, and what was answered. Ends with status 1 where the
// answer is not what is hidden, or the million takes more than 4 min or 4 GB.
#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>

#include "tests/core/discrepancy/small_plant.h"

namespace {

struct Usage {
  double processor_s = 0.0;
  double largest_gb = 0.0;
};

Usage usageSoFar() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024.0 / 1024.0};
}

}  // namespace

int main() {
  using namespace spindrift;
  bool good = true;
  for (const int points : {12, 1125, 10600}) {
    const DiscrepancyInput input = small_plant::atManyPoints(3, points, 0.3);
    const double before_s = usageSoFar().processor_s;
    const auto begin = std::chrono::steady_clock::now();
    const DiscrepancyResult result = small_plant::run(input);
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Usage after = usageSoFar();
    const bool right =
        result.effects.size() == 1 && result.effects.front().id == "spindle.drift.y" && result.leftover.empty();
    fmt::print("{:7} observations of {:5} points: {:6.1f} s, {:6.1f} s of processors, {:.2f} GB so far; {}{}\n",
               input.observations.rows.size(), points, wall_s, after.processor_s - before_s, after.largest_gb,
               result.effects.empty() ? "nothing named" : result.effects.front().id,
               right ? "" : ", NOT what is hidden");
    good = good && right && wall_s < 240.0 && after.largest_gb < 4.0;
  }
  return good ? 0 : 1;
}
