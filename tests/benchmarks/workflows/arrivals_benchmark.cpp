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
  const auto tell = [](const char* what) {
    return [what](std::size_t arrived, double cpu_us, double wall_us) {
      fmt::print("{:>9} {}: {:9.1f} us of CPU time each, {:9.1f} us until it is stored\n", arrived, what, cpu_us,
                 wall_us);
      std::fflush(stdout);
    };
  };
  const auto judge = [&](const char* what, const testing::ArrivalCosts& costs) {
    fmt::print("{}: the last tenth costs {:.2f} times the second\n", what, costs.growth());
    grows = grows || costs.growth() > most_growth;
  };
  if (captures > 0) {
    const testing::FolderWithoutDisk folder;
    judge("captures", testing::costsOfCaptures(folder.path(), captures, std::max<std::size_t>(captures / 1000, 10),
                                               tell("captures")));
  }
  if (touches > 0) {
    const testing::FolderWithoutDisk folder;
    judge("touches",
          testing::costsOfTouches(folder.path(), touches, std::max<std::size_t>(touches / 1000, 10), tell("touches")));
  }
  return grows ? 1 : 0;
}
