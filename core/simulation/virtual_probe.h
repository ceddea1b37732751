// SPDX-License-Identifier: Apache-2.0
// A touch probe on a virtual machine: writes the touches of a hole bar or a ball artefact as a real cycle would.
//
// The machine deviates by D(query) (mm, tip relative to the artefact: table motions and growth of the artefact enter
// with a minus sign). The probe triggers where |p + D(p) - c| is the stand-off of the stylus from the true surface; the
// trigger position p is found to 1e-12 mm by iteration, so nothing is linearised here. Noise is added along the
// approach.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/machine/machine_description.h"
#include "core/probing/touch.h"

namespace spindrift {

struct ProbeTouchQuery {
  double time_s = 0.0;
  Eigen::Vector3d tip_mm = Eigen::Vector3d::Zero();          ///< commanded position of the stylus centre
  Eigen::Vector3d tool_offset_mm = Eigen::Vector3d::Zero();  ///< tip minus spindle reference
  double c_deg = 0.0;
  std::string feature;
  Eigen::Vector3d approach = Eigen::Vector3d::UnitX();
};

/// Deviation of the tip relative to the feature, mm.
using TipDeviation = std::function<Eigen::Vector3d(const ProbeTouchQuery&)>;

struct VirtualProbeOptions {
  double noise_um = 0.2;          ///< of a touch across the feature, along the approach
  double surface_noise_um = 0.2;  ///< of surface touches of a hole
  double touch_interval_s = 2.5;
  double pre_travel_um = 0.0;         ///< constant: trigger later by this much
  double pre_travel_lobing_um = 0.0;  ///< amplitude of a three-lobed part over the direction in the plane
  double depth_mm = 3.0;              ///< of the wall touches below the surface of a hole bar
  double surface_offset_mm = 9.0;     ///< of the surface touch beside the hole, along the bar
  double form_error_um = 0.0;         ///< of each feature and direction, drawn once per seed, the same in all cycles
  std::uint64_t form_seed = 1;
  Eigen::Vector3d first_ball_mm{120.0, 80.0, 60.0};  ///< where the first ball stands in MCF
};

/// One cycle with a hole bar: all holes at c = 0, the reference hole at 90, three holes at 180, the reference hole at
/// 270. Starts at `start_s`.
[[nodiscard]] std::vector<Touch> probeHoleBar(const MachineDescription& machine, const Artefact& artefact,
                                              const std::string& cycle, double start_s, const TipDeviation& deviation,
                                              const VirtualProbeOptions& options, Random& random);

/// One cycle with a ball artefact: every ball with every stylus, five touches each, all from where the shaft of the
/// stylus leaves room.
[[nodiscard]] std::vector<Touch> probeBalls(const MachineDescription& machine, const Artefact& artefact,
                                            const std::string& cycle, double start_s, const TipDeviation& deviation,
                                            const VirtualProbeOptions& options, Random& random);

}  // namespace spindrift
