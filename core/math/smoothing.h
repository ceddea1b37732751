// SPDX-License-Identifier: Apache-2.0
// Smoothing of slow signals that were read with noise.
#pragma once

#include <span>
#include <vector>

namespace spindrift {

/// A signal freed of the noise of its readings.
struct SmoothedSignal {
  std::vector<double> values;
  double noise = 0.0;         ///< standard deviation of the readings about the signal, in their unit
  double bandwidth_s = 0.0;   ///< what is much shorter is taken for noise; 0: the readings as they are
  double error = 0.0;         ///< standard deviation of what noise and rounding leave in `values`, in their unit
  double error_time_s = 0.0;  ///< over which that error follows itself: its correlation falls to 1/e
};

/// Standard deviation of white noise and rounding on a signal that is smooth over four readings, in their unit: from
/// the median of its third differences; from their mean where they are a few multiples of the readings' resolution;
/// where most of them are zero, from how far neighbours differ beyond where the signal leads, together with that of
/// rounding. Of rounded readings within 30 %. 0 for fewer than eight readings, and for readings that never change.
[[nodiscard]] double noiseOfReadings(std::span<const double> readings);

/// Whittaker's smoother (the discrete smoothing spline: sum of squared distances plus bandwidth^4 times that of second
/// derivatives), as smooth as the noise of the readings allows: the largest bandwidth, up to `most_bandwidth_s`, at
/// which what is taken away is no larger than that noise (of coarsely rounded readings, three standard deviations of
/// its sum of squares more), in all and over every two dozen readings; where the signal jumps, less is taken away.
/// Times increase, s; a gap in them is bridged smoothly. Times that do not increase, or readings without noise, come
/// back as they are. Where the signal is smooth the error is noise / sqrt(3.8 bandwidth / step), the variance of the
/// equivalent kernel (Silverman 1984). That error, and how long it follows itself, is found by a parametric bootstrap:
/// noise on the smooth signal, rounded to the readings' resolution, and smoothed again. Of slow signals rounded
/// coarsely it is no white noise. Where the signal bends the error is larger than told, by a quarter or so; it is 0
/// where readings come back for their times. Sources: Whittaker 1923; Reinsch 1967 (as smooth as the noise allows);
/// Efron 1979 (bootstrap).
[[nodiscard]] SmoothedSignal smoothWithinNoise(std::span<const double> time_s, std::span<const double> readings,
                                               double most_bandwidth_s);

}  // namespace spindrift
