// SPDX-License-Identifier: Apache-2.0
// Seeded random numbers that are the same on every platform (the standard library's distributions are not).
#pragma once

#include <cstdint>
#include <optional>

namespace spindrift {

/// xoshiro256** (Blackman and Vigna 2018), seeded through splitmix64. Not for cryptography. Copies continue alike.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  [[nodiscard]] std::uint64_t bits();
  /// Uniform in [0, 1).
  [[nodiscard]] double uniform();
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, count), count > 0.
  [[nodiscard]] std::uint64_t index(std::uint64_t count);
  /// Standard normal (polar method).
  [[nodiscard]] double normal();
  [[nodiscard]] double normal(double mean, double sigma) { return mean + sigma * normal(); }
  /// An independent stream for a part of the work.
  [[nodiscard]] Random split();

 private:
  std::uint64_t state_[4];
  std::optional<double> spare_;
};

}  // namespace spindrift
