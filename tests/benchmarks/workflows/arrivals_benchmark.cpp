// SPDX-License-Identifier: GPL-3.0-or-later
// Captures and touches that arrive in a watched folder: does the next one cost more when many have come before? Usage:
// arrivals_benchmark [captures] [touches]. Ends with status 1 if the last tenth costs more than 1.5 times the CPU time
// of the second one, for an arrival.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "tests/support/arrival_costs.h"

int main(int argc, char** argv) {
  using namespace spindrift;
  constexpr double most_growth = 1.5;
  const auto captures = static_cast<std::size_t>(argc > 1 ? std::atoll(argv[1]) : 100'000);
  const auto touches = static_cast<std::size_t>(argc > 2 ? std::atoll(argv[2]) : 1'000'000);
  bool grows = false;
  const auto judge = [&](const char* what, auto& arriving, std::size_t count) {
    const auto tell = [what](std::size_t arrived, const testing::BatchCost& each) {
      fmt::print("{:>9} {}: {:9.1f} us of CPU time each, {:9.1f} us until it is stored\n", arrived, what, each.cpu_us,
                 each.wall_us);
      std::fflush(stdout);
    };
    const double growth = testing::growthOver(arriving, count, std::max<std::size_t>(count / 1000, 10), tell);
    fmt::print("{}: the last tenth costs {:.2f} times the second\n", what, growth);
    grows = grows || growth > most_growth;
  };
  if (captures > 0) {
    const testing::FolderWithoutDisk folder;
    testing::ArrivingCaptures arriving(folder.path(), captures);
    judge("captures", arriving, captures);
  }
  if (touches > 0) {
    const testing::FolderWithoutDisk folder;
    testing::ArrivingTouches arriving(folder.path());
    judge("touches", arriving, touches);
  }
  return grows ? 1 : 0;
}
