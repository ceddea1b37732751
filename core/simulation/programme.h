// SPDX-License-Identifier: Apache-2.0
// What the virtual machine is told to do: speeds, feeds, positions and switches, piecewise constant in time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/machine/machine_description.h"

namespace spindrift {

/// Holds from `from_s` until the next segment. Feeds are mean absolute feeds (mm/min); the nut of an axis travels
/// +-stroke/2 about its position.
struct ProgrammeSegment {
  double from_s = 0.0;
  double spindle_rpm = 0.0;
  std::array<double, 3> feed_mm_min{};               ///< X, Y, Z
  std::array<double, 3> position_mm{};               ///< X, Y, Z: centre of the work, as the log's pos_x_mm ...
  std::array<double, 3> stroke_part{0.8, 0.8, 0.8};  ///< travel of the nut as a part of the axis' travel
  double c_rpm = 0.0;
  bool coolant = false;
  bool instrument_on = true;
};

class Programme {
 public:
  Programme() = default;
  /// Segments in order of time; the first starts at 0.
  explicit Programme(std::vector<ProgrammeSegment> segments);

  [[nodiscard]] const std::vector<ProgrammeSegment>& segments() const noexcept { return segments_; }
  /// At the end; it begins where or after the last begins.
  void append(const ProgrammeSegment& segment);
  [[nodiscard]] const ProgrammeSegment& at(double time_s) const;

 private:
  std::vector<ProgrammeSegment> segments_;
};

/// A random day's work. The machine idles first so that a reference state exists; then speed, feeds, position and
/// coolant change at times of their own.
struct RandomProgrammeOptions {
  double duration_s = 43200.0;
  double idle_s = 1800.0;
  double mean_hold_s = 2700.0;  ///< of each signal, exponential, at least a quarter of it
  std::vector<double> speeds_rpm{0.0, 1500.0, 3000.0, 4500.0, 6000.0};
  std::vector<double> feeds_mm_min{0.0, 4000.0, 9000.0, 15000.0};
  std::vector<double> c_speeds_rpm{0.0, 10.0, 30.0, 60.0};  ///< used only if the machine has a rotary axis
  bool coolant = true;                                      ///< switched on and off during the day
  bool move = true;                                         ///< the place of the work changes
  std::vector<double> places{0.1, 0.5, 0.9};                ///< of the work, parts of the travel of each axis
  double stroke_part = 0.8;                                 ///< travel of the nuts as a part of the axis' travel
  double instrument_on_s = 0.0;                             ///< the instrument is off before
};

[[nodiscard]] Programme randomProgramme(const MachineDescription& machine, const RandomProgrammeOptions& options,
                                        std::uint64_t seed);

}  // namespace spindrift
