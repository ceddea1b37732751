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

/// A clock shows in it: what drives it changes within the log. Of what is on from the first row the log says no begin.
[[nodiscard]] bool showsClock(const ModelTerm& term, const DriverTable& drivers);

/// A parabola through -2 ln of the posterior on a grid of minutes, prior N(0, prior_s^2); nothing if the effects
/// show no clock, or the best offset is not worth its price. `drivers` are shifted by `present_s` already.
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

/// In 2 ln: how much less all offsets within a step of that search explain on average than the present one, which is
/// the best of them: no hypothesis states the offset to the second (Laplace's approximation). Not negative; 0 where the
/// present one is no best. `drivers` are shifted by the offset already.
[[nodiscard]] double priceOfFarClock(const ResidualProblem& problem, const std::vector<Effect>& catalogue,
                                     const DriverTable& drivers, const JointFit& named);

}  // namespace spindrift
