// SPDX-License-Identifier: Apache-2.0
#include "core/connect/record.h"

#include <chrono>

namespace spindrift {

double localUtc() {
  using Seconds = std::chrono::duration<double>;
  static const auto steady_start = std::chrono::steady_clock::now();
  static const double utc_start = Seconds(std::chrono::system_clock::now().time_since_epoch()).count();
  return utc_start + Seconds(std::chrono::steady_clock::now() - steady_start).count();
}

}  // namespace spindrift
