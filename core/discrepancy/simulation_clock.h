// SPDX-License-Identifier: Apache-2.0
// Observations whose clock is not that of the simulation: far from it after an hour of summer time, or on a
// microscope's computer that was never set; minutes from it on any two computers. Internal to core/discrepancy.
//
// A simulation is computed from the log, so its clock is that of the log. Where the observations agree better with what
// it predicts for another time, they are compared at that time, and so is the log.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/observation.h"

namespace spindrift {

struct SimulationClock {
  double offset_s = 0.0;  ///< clock of the simulation minus clock of the observations
  double standard_uncertainty_s = 0.0;
  double scatter = 1.0;  ///< rms of what is left about the mean of each series, over that at no offset

  /// `followed`: they are compared at that time.
  [[nodiscard]] std::string sentence(bool followed) const;
};

/// What the simulation predicts for an observation at a time of its own clock, um or urad; NaN where it does not.
using PredictedAt = std::function<double(const Observation&, double time_s)>;

/// The offset within four hours at which least is left of the observations, each series about its mean, to within
/// minutes; none where that is less than twenty minutes or more than half of the squares remain, for then it may as
/// well be a missing effect. Large campaigns are judged by part of their series.
[[nodiscard]] std::optional<SimulationClock> farSimulationClock(const std::vector<Observation>& observations,
                                                                const PredictedAt& predicted);

/// The same within nine minutes, to seconds. A missing effect or a time constant that is off may look like a small
/// offset as well, in its component, while it acts; a clock moves everything. So it is believed where it is many times
/// its uncertainty and what is left is less in most components and quarters of the time.
[[nodiscard]] std::optional<SimulationClock> nearSimulationClock(const std::vector<Observation>& observations,
                                                                 const PredictedAt& predicted);

/// From predictions at the times of the observations alone: linear in time between those of one series.
[[nodiscard]] PredictedAt predictedBetween(const std::vector<Observation>& observations,
                                           const std::vector<double>& predicted);

/// A simulation as a model that is asked by the clock of the observations.
class SimulationOfOtherClock final : public ErrorModel {
 public:
  /// `offset_s`: clock of the simulation minus clock of the observations.
  SimulationOfOtherClock(std::shared_ptr<const ErrorModel> simulation, double offset_s)
      : simulation_(std::move(simulation)), offset_s_(offset_s) {}
  [[nodiscard]] std::string description() const override { return simulation_->description(); }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override {
    return simulation_->predict(byItsClock(query), component);
  }
  [[nodiscard]] PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const override {
    return simulation_->predictChange(byItsClock(query), byItsClock(reference), component);
  }

 private:
  [[nodiscard]] DeviationQuery byItsClock(DeviationQuery query) const {
    query.time_s += offset_s_;
    return query;
  }

  std::shared_ptr<const ErrorModel> simulation_;
  double offset_s_;
};

}  // namespace spindrift
