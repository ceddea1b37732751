// SPDX-License-Identifier: Apache-2.0
// Cycles in which the machine drifts while it is probed. A cycle takes minutes; just after the spindle was started the
// deviation changes by several times the touch noise meanwhile. Taken as constant, a drift along Z looks like a tilt,
// and the touches that speak against the tilt look bad.
//
//   theta_k(t) = theta_k + (tau + c tau^2 / 2) delta_k,  tau = (t - mean time of the cycle) / its duration
//   delta_kp ~ N(0, (f_k s_kp)^2),  s_kp = duration * change of parameter p to the neighbouring cycles / time to them
// (less what the touch noise explains), c of size 1: a time constant as long as the cycle. Slope and curvature are free
// of each other. The reference cycle may drift too.
// f_k is chosen for every cycle by its restricted likelihood against the other cycles, every touch that has to be left
// out counting against it as much as the square of the threshold for bad touches: good touches are not sacrificed to a
// constant deviation, and a bad touch is no drift. Cycles that do not ask for a drift (f_k = 0) are evaluated without;
// in the others theta stands for the mean time, and its uncertainty contains that of the drift.
// It rests on: enough touches that the parameters leave over. With two cycles, or in the last cycle of a ball artefact
// (12 parameters), a drift may hide behind the parameters, and the uncertainty then does not know of it.
// Source: Patterson and Thompson (1971), restricted likelihood.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/probing/cycle_fit.h"

namespace spindrift {

/// `time_s`: of each row of the problem. As `fitCycles`, with the drift inside the cycles; the results are those of the
/// parameters of `problem`.
[[nodiscard]] CycleFitResult fitDriftingCycles(const CycleProblem& problem, const std::vector<double>& time_s,
                                               const CycleFitOptions& options = {});

/// Artefact or probe moved at once, between two touches of one cycle, and stayed there.
struct StepInside {
  int cycle = 0;
  double after_s = 0.0;  ///< time of the last touch before it
  double before_s = 0.0;
  Eigen::Vector3d step_mm = Eigen::Vector3d::Zero();  ///< of what is touched, relative to the probe
  double sigma_mm = 0.0;                              ///< largest standard uncertainty of a component
};

/// The clearest such step, or none. Of a cycle against all others:
///   z = A theta + (n_i . s) [t_i > t_step] + e,     n_i normal of the touch in one of `frames` (MCF, turned table)
/// compared with no step, and with a drift of all parameters and of the place in time (as theta t, s1 t + s2 t^2), by
/// n log(rss) + k log(n): heat takes its time. The noise is that of the cycle itself. The worst two touches are left
/// out of all three, so that no bad touch is a step; eight touches at least lie on either side.
[[nodiscard]] std::optional<StepInside> findStepInside(const CycleProblem& problem, const std::vector<double>& time_s,
                                                       const std::vector<Eigen::MatrixX3d>& frames,
                                                       const CycleFitOptions& options = {});

}  // namespace spindrift
