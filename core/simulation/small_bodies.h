// SPDX-License-Identifier: Apache-2.0
// Small bodies that do not act back on the machine: what coolant splashes, a wall in the sun, an instrument that warms
// up, a guide that is heated where the head stands. Each is a little network of its own, driven by the programme.
// Results are temperatures (K above what the body would have without the cause) every 30 s from the start.
#pragma once

#include <vector>

#include "core/simulation/environment.h"
#include "core/simulation/machine_bodies.h"
#include "core/simulation/programme.h"

namespace spindrift {

/// A signal sampled regularly from time 0.
struct SampledSignal {
  double step_s = 30.0;
  std::vector<double> values;
  [[nodiscard]] double at(double time_s) const;
};

/// Temperature of the splashed body minus that of its twin which never sees coolant. Coolant cools fast, air warms
/// slowly.
[[nodiscard]] SampledSignal coolantSplash(const Programme& programme, const Environment& environment,
                                          const PlantParameters& parameters, double duration_s);

/// A wall of two layers under a flux (W) from `onset_s` for `length_s`; the inner layer.
[[nodiscard]] SampledSignal sunlitWall(const PlantParameters& parameters, double onset_s, double length_s,
                                       double flux_W, double duration_s);

/// Electronics and optics of an instrument since it was switched on, as a part of the final rise (0 ... 1).
[[nodiscard]] SampledSignal instrumentWarmUp(const Programme& programme, double duration_s);

/// A guide of twelve cells along `axis`, heated by the spindle where the axis stands: sum of the rises weighted by
/// (place - middle) / travel, in K.
[[nodiscard]] SampledSignal positionHeat(const MachineDescription& machine, const Programme& programme,
                                         const PlantParameters& parameters, int axis, double duration_s);

}  // namespace spindrift
