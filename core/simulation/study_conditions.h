// SPDX-License-Identifier: Apache-2.0
// What happens to a campaign in a workshop: sigmas that are stated wrongly, heavy tails, states that are re-referenced,
// an instrument that drifts, a machine that is warm when the log begins, clocks that differ, poor sensors, gaps, shapes
// that are uneven. Each alone or together, on campaigns of the study (study_campaigns.h). Deterministic by seed, each
// condition with a stream of random numbers of its own, so that switching one on leaves the others as they are.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/simulation/virtual_campaign.h"

namespace spindrift {

struct StudyConditions {
  bool sigma = false;       ///< stated sigma = real sigma x a factor per component, log-uniform 0.6 ... 1.6
  bool tails = false;       ///< noise of Student's t, nu = 4, of the same variance; 1 % of the rows off by 6-15 sigma
  bool common = false;      ///< a shift per state and component, common to all points, 0.6 sigma
  bool drift = false;       ///< a drift per component, common to all points, 0.5-1 sigma, 0.5-1 h (Ornstein-Uhlenbeck)
  bool warm_start = false;  ///< the machine has been running for 2-3 h when log and observations begin
  bool clock = false;       ///< the clock of the observations is off against the log by up to +-240 s
  bool coarse_sensors = false;  ///< temperatures in steps of 0.5 K
  bool slow_sensors = false;    ///< first-order lag of 300-900 s per sensor
  bool gaps = false;            ///< 20-30 % of the rows missing, and two to four whole states
  bool uneven = false;          ///< the shape of what is hidden varies smoothly by 15 % (rms) over the machine
  double base_error = 0.0;      ///< standard deviation of the gain error of each effect of the simulation
  double one_base_error = 0.0;  ///< gain error (either sign) of one effect of the simulation: this is what is hidden

  /// sigma, tails, common, coarse sensors, gaps and a simulation that is off by 8 %.
  [[nodiscard]] static StudyConditions together();
  [[nodiscard]] nlohmann::json json() const;
};

/// What a scenario needs before it is run: time to warm up, clocks, sensors.
void prepare(Scenario& scenario, const StudyConditions& conditions, std::uint64_t seed);

/// Time (s) that the scenario runs before the log begins, 0 without a warm start.
[[nodiscard]] double warmUp_s(const StudyConditions& conditions, std::uint64_t seed);

/// What was done to a campaign, for its truth.
struct AppliedConditions {
  std::map<Component, double> stated_over_real_sigma;
  std::vector<std::size_t> outliers;                           ///< rows of the observations, from 0
  std::map<std::pair<std::string, Component>, double> shifts;  ///< of each state (um, urad): common and drift
  double drift_time_s = 0.0;                                   ///< correlation time; 0 without a drift
  double warm_start_s = 0.0;
  double clock_offset_s = 0.0;
  [[nodiscard]] nlohmann::json json() const;
};

/// Measures again under the conditions: values = truth + noise of the real sigma (of the rows as they come), correlated
/// `ar1` from one state to the next; then the sigmas as stated, rows left out, the beginning cut off. Signals of what
/// is hidden are scaled to `strength` (0: left as they are) where the warm start changes it, and made uneven; the truth
/// follows.
AppliedConditions applyConditions(VirtualCampaign& campaign, const StudyConditions& conditions, double strength,
                                  double ar1, std::uint64_t seed);

}  // namespace spindrift
