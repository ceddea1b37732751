// SPDX-License-Identifier: Apache-2.0
// Smoothing of slow signals that were read with noise.
#pragma once

#include <span>
#include <vector>

namespace spindrift {

/// A signal freed of the noise of its readings.
struct SmoothedSignal {
  std::vector<double> values;
  double noise = 0.0;        ///< standard deviation of the readings about the signal, in their unit
  double bandwidth_s = 0.0;  ///< what is much shorter is taken for noise; 0: the readings as they are
};

/// Standard deviation of white noise on a signal that is smooth over four readings, from the median of its third
/// differences; at least that of the rounding to the readings' resolution. 0 for fewer than eight readings.
[[nodiscard]] double noiseOfReadings(std::span<const double> readings);

/// Cubic smoothing spline through readings of a slow signal, as smooth as the noise of the readings allows: the largest
/// bandwidth, up to `most_bandwidth_s`, at which what is taken away is no larger than that noise, in all and over every
/// stretch of time; where the signal jumps, less is taken away. Times increase, s; a gap in them is bridged by the
/// spline. Errors stay near noise / sqrt(2.8 bandwidth / step) where the signal is smooth.
/// Sources: Reinsch 1967 (spline within the noise); Whittaker 1923.
[[nodiscard]] SmoothedSignal smoothWithinNoise(std::span<const double> time_s, std::span<const double> readings,
                                               double most_bandwidth_s);

}  // namespace spindrift
