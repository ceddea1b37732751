// SPDX-License-Identifier: Apache-2.0
// The offset between the clock of the log and that of the observations, from where the effects found fit best.
// Internal to core/discrepancy. Clock of the log minus clock of the observations, s.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/discrepancy/drivers.h"
#include "core/discrepancy/effect_search.h"

namespace spindrift {

struct ClockOffset {
  double offset_s = 0.0;
  double standard_uncertainty_s = 0.0;
};

/// A parabola through -2 ln of the posterior on a grid of minutes, prior N(0, prior_s^2); nothing if no signal drives
/// the effects, or the best offset is not worth its price. `drivers` are shifted by `present_s` already.
[[nodiscard]] std::optional<ClockOffset> estimateClockOffset(const ResidualProblem& problem,
                                                             const std::vector<Effect>& catalogue,
                                                             const DriverTable& drivers, const JointFit& fit,
                                                             double present_s, double prior_s);

/// Offsets far beyond that are looked at: four hours either way.
constexpr double far_clock_step_s = 1800.0;
constexpr double far_clock_resolution_s = 450.0;
constexpr int far_clock_steps = 8;
constexpr double far_clocks = 2.0 * far_clock_steps;

/// The effects named would fit much better at one of these offsets.
[[nodiscard]] bool fitsFarBetterElsewhere(const ResidualProblem& problem, const std::vector<Effect>& catalogue,
                                          const DriverTable& drivers, const JointFit& named);

/// The offset, beyond the present one, at which most is explained, to within some minutes: what follows the estimate
/// above can find. `evidence_at`: of all effects, with the clock moved by so many seconds. None: the present one is
/// best. Uncertainty: the step, and the spread of the offsets that explain as much.
[[nodiscard]] std::optional<ClockOffset> farLogClock(const std::function<double(double)>& evidence_at);

}  // namespace spindrift
