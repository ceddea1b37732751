// SPDX-License-Identifier: Apache-2.0
// The offset between the clock of the log and that of the observations, from where the effects found fit best.
// Internal to core/discrepancy. Clock of the log minus clock of the observations, s.
#pragma once

#include <optional>
#include <string>
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

/// An offset of the clocks far beyond what is estimated, at which the effects named would fit much better: a sentence,
/// or none.
[[nodiscard]] std::string farClockOffset(const ResidualProblem& problem, const std::vector<Effect>& catalogue,
                                         const DriverTable& drivers, const JointFit& named);

}  // namespace spindrift
