// SPDX-License-Identifier: Apache-2.0
// Evaluation of thermal tests as ISO 230-3 asks for them: environmental variation (ETVE), rotating spindle, moving
// linear axis.
//
// Displacements um, tilts urad, time s, temperature degC, positions mm. Values are relative to the start of the test;
// the first valid sample is zero. A level is not one reading: it is the value of a straight line through the readings
// of a window (on one side of a start or stop, around any other time), so that noise is averaged and does not widen a
// range; its standard uncertainty is that of one reading times the root of the line's variance factor, and a range or a
// difference carries that of both its levels. Fewer than three readings in a window: the nearest reading. Failure:
// InputError for too few readings or a test that does not hold what is evaluated. Source: ISO 230-3 (ETVE test, thermal
// distortion caused by rotating spindle, thermal distortion caused by moving linear axes).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/thermal/time_series.h"

namespace spindrift {

/// A component (EX ... EC) or a single probe over time. NaN where missing.
struct ComponentSeries {
  std::string name;
  std::string unit;
  std::vector<double> values;
  double reading_sigma = 0.0;  ///< of one reading; 0: estimated from the differences of neighbours
};

struct EtveComponent {
  std::string name;
  std::string unit;
  double range = 0.0;  ///< largest minus smallest over the test
  double range_sigma = 0.0;
  double range_per_K = 0.0;  ///< range over the range of the ambient temperature; NaN without a change of it
  double range_per_K_sigma = 0.0;
  /// Regression on the ambient temperature, the noise of its readings taken off; NaN where they are little else.
  double slope_per_K = 0.0;
  double slope_sigma = 0.0;
};
struct EtveResult {
  double duration_s = 0.0;
  double window_s = 0.0;             ///< in which levels were read
  double temperature_range_K = 0.0;  ///< of levels, as that of a component
  double temperature_range_sigma_K = 0.0;
  std::vector<EtveComponent> components;
  std::string note;
};
constexpr double level_window_s = 120.0;  ///< short beside an hour, in which the standard counts
/// The test is of a machine at rest. Throws InputError if a spindle (a signal of kind Speed) turns anywhere in the log.
/// Returns what else speaks against a machine at rest or could not be checked: axes that moved, a log without a speed.
[[nodiscard]] std::vector<std::string> requireMachineAtRest(const TimeSeries& series);
/// `ambient_degC` may be empty: then nothing is per K. Throws InputError where `window_s` is negative or longer than
/// half of the record (level_window_s is taken of any), where a component has too few readings, or without a component.
[[nodiscard]] EtveResult evaluateEtve(std::span<const double> time_s, const std::vector<ComponentSeries>& components,
                                      std::span<const double> ambient_degC, double window_s = level_window_s);

struct SpindleComponent {
  std::string name;
  std::string unit;
  double first_hour = 0.0;        ///< change after 60 min of running; NaN if the run was shorter
  double at_end = 0.0;            ///< change at the end of the running period
  double first_hour_sigma = 0.0;  ///< standard uncertainty of `first_hour`; NaN as that is
  double change_sigma = 0.0;      ///< of `at_end`
  double range = 0.0;             ///< over the running period
  double range_sigma = 0.0;
  double first_hour_range = 0.0;  ///< over its first 60 min; NaN if the run was shorter
  double first_hour_range_sigma = 0.0;
  double time_to_fraction_s =
      0.0;  ///< first time from which the change stays beyond `fraction` of its end value; NaN if it ends below 3 sigma
  double after_cooling = 0.0;  ///< change left at the end of the record; NaN where it ends with the run
  double after_cooling_sigma = 0.0;
};
struct SpindleResult {
  double start_s = 0.0;
  double stop_s = 0.0;
  double fraction = 0.0;
  double window_s = 0.0;  ///< in which levels were read
  std::vector<SpindleComponent> components;
};
/// The test is one step of speed: off, one level, off. Throws InputError where the spindle stands in between or runs at
/// another speed for longer than two minutes (a spectrum of speeds is another test). `speed` without gaps, of the
/// column named; returns a sentence where the record begins with a running spindle, so that no cold state is in it.
[[nodiscard]] std::string requireOneSpeedStep(const TimeSeries& series, const std::string& column,
                                              std::span<const double> speed);
/// The running period is from the first row whose speed is above what an encoder shows of a spindle
/// that stands (1 rpm) to the last one. Throws InputError where there is none, where `fraction` is not between 0 and 1,
/// and as evaluateEtve does.
[[nodiscard]] SpindleResult evaluateRotatingSpindle(std::span<const double> time_s, std::span<const double> speed_rpm,
                                                    const std::vector<ComponentSeries>& components,
                                                    double fraction = 0.9, double window_s = level_window_s);

/// Approaches of two target positions near both ends of travel while the axis is exercised. Readings of one point in
/// one direction make a series: it has an unknown constant of its own, so that only what changes within it counts.
struct AxisReading {
  double time_s = 0.0;
  double position_mm = 0.0;
  double deviation_um = 0.0;
  int direction = 1;       ///< of approach, +1 or -1
  std::string point = {};  ///< beside others at the same position
  double sigma_um = 0.0;   ///< standard uncertainty as stated; 0: not stated
};
struct AxisPositionResult {
  double position_mm = 0.0;
  double change_um = 0.0;         ///< last minus first reading, mean over the series that span the test
  double change_sigma_um = 0.0;   ///< from the scatter, or from what is stated where that is more
  double range_um = 0.0;          ///< largest of a point, both directions
  double repeatability_um = 0.0;  ///< 2 s of the deviations from a time history (up to the third power) of all series
  /// Standard uncertainty of it from the degrees of freedom of s (ISO/TR 230-9): 2 s / sqrt(2 nu); NaN without any.
  double repeatability_sigma_um = 0.0;
  double reversal_um = 0.0;        ///< + minus - at one moment, mean over points; NaN if none has both
  double reversal_sigma_um = 0.0;  ///< standard uncertainty of it, from s or from what is stated where that is more
  std::size_t readings = 0;
};
struct AxisResult {
  AxisPositionResult low;
  AxisPositionResult high;
  double expansion_um = 0.0;  ///< change at the high position minus change at the low one
  double expansion_sigma_um = 0.0;
  double expansion_um_per_m = 0.0;
  std::vector<double> time_s;  ///< course of the expansion: at the readings of the high position
  std::vector<double> expansion_over_time_um;
};
/// Only the lowest and the highest position are used. Throws InputError: fewer than four readings at one of them, or no
/// series there that spans the test (its first and last reading within a tenth of the ends).
[[nodiscard]] AxisResult evaluateMovingAxis(std::vector<AxisReading> readings);

}  // namespace spindrift
