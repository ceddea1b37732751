// SPDX-License-Identifier: Apache-2.0
// What a closed loop knows of the machine: log, readings, simulation, effects that were added, identified models; what
// they predict at the tool point and how sure that is.
//
//   deviation   without compensation, relative to the first cycle: -(reading - first) - (compensation then - at first)
//   sigma^2     simulation: mean square of what it was off at the last cycles, before it was told; of a completed one
//               of what it would have been off at the cycles before
//               identified: of the filter's gain and offset, plus gain^2 f^2 d' C d with C the covariance of the
//               model's coefficients, d the change of its features since the last cycle told the filter where it
//               stands, and f its factor of uncertainty
// Units um, mm, s of the machine. Nothing here talks to a control. Sources: P1, P2; measurement_update.h.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/discrepancy/effect_model.h"
#include "core/machine/operating_log.h"
#include "core/thermal/measurement_update.h"
#include "core/thermal/thermal_model.h"
#include "core/thermal/time_series.h"
#include "core/workflows/closed_loop.h"
#include "core/workflows/loop_twin.h"

namespace spindrift {

/// A touch as the control printed it, and what the models said at that moment.
struct LoopReading {
  std::string name;  ///< point and component: "F1 EZ"
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d applied_mm = Eigen::Vector3d::Zero();
  double time_s = 0.0;
  double simulated_um = 0.0;       ///< at the touched place, by the simulation alone
  double by_simulation_um = 0.0;   ///< at the tool point, with what was added to it
  double by_model_um = 0.0;        ///< at the tool point by the identified model, before its filter
  double predicted_um = 0.0;       ///< at the tool point by what compensated
  double sigma_um = std::nan("");  ///< of that
};

class LoopModels {
 public:
  static constexpr double row_s = 30.0;            ///< of the log
  static constexpr std::size_t least_cycles = 10;  ///< for a model to be identified
  using Say = std::function<void(const std::string&)>;

  LoopModels(const LoopPlan& plan, Say say);

  // --- what comes
  /// The control said this just now: spindle speed, then the temperatures of the plan.
  void drive(double spindle_rpm, double now_s);
  void addRow(double time_s, const std::vector<double>& values);
  /// As addRow had it last; one row at least.
  [[nodiscard]] std::vector<double> lastRow() const;
  /// Nothing, if the line is no touch.
  [[nodiscard]] std::optional<LoopReading> reading(const std::string& line, double now_s, LoopStage stage) const;
  /// Takes a whole cycle (a reading for each touch of the plan): deviations, what was predicted, judgement of the
  /// models, and their correction. Axes that have to be identified again are in `again`; none, and no limit is looked
  /// at, where the compensation was `off`.
  void take(std::vector<LoopReading> readings, const std::string& state, bool off, LoopCycle& cycle,
            std::set<int>& again);
  /// After homing anew: what the cycle of these readings is off of the prediction by more than its uncertainty is a
  /// shift of the zero, and is taken out of the reference. um per axis, zero where there is none.
  [[nodiscard]] Eigen::Vector3d takeShift(const std::vector<LoopReading>& readings);

  // --- models
  /// The operator added these effects.
  void add(const std::filesystem::path& model_file);
  /// Identifies a model of an axis on all that was measured; says why not.
  void identify(int axis, const JobContext& job);
  [[nodiscard]] bool anyIdentified() const noexcept { return !identified_.empty(); }
  /// The tool point's axis is touched.
  [[nodiscard]] bool touches(int axis) const { return first_touch_[static_cast<std::size_t>(axis)].has_value(); }

  /// Deviation at the tool point by what compensates in this stage, relative to the first cycle.
  [[nodiscard]] Eigen::Vector3d predicted(LoopStage stage) const;
  /// Its standard uncertainty; NaN where no cycle has judged it yet.
  [[nodiscard]] Eigen::Vector3d sigma(LoopStage stage) const;
  /// The first cycle is there.
  [[nodiscard]] bool begun() const noexcept { return !zero_.empty(); }
  [[nodiscard]] bool simulates() const noexcept { return twin_.has_value(); }
  [[nodiscard]] const std::vector<double>& times() const noexcept { return times_; }
  [[nodiscard]] const ObservationSet& observations() const noexcept { return observations_; }
  [[nodiscard]] DiscrepancyInput discrepancyInput() const;
  /// simulation.csv: the simulation at every observation.
  [[nodiscard]] std::string simulationTable() const;

  // --- over the end of the program
  [[nodiscard]] nlohmann::json state() const;
  /// A fresh one becomes what `state` was; the log's rows are those of `log`, model.json lies in `folder`. Throws
  /// InputError.
  void restore(const JsonNode& state, const std::filesystem::path& log, const std::filesystem::path& folder,
               double now_s);

 private:
  /// The model of one component over time, and its filter.
  struct Identified {
    ThermalModel model;
    GainOffsetFilter filter;
    double run = 0.0;          ///< free run at the last row
    Eigen::VectorXd features;  ///< at the last row
    Eigen::VectorXd told;      ///< features when a cycle told it last
    void refresh(const TimeSeries& series);
  };
  /// How well each has predicted the cycles so far, before it was told.
  struct Trust {
    bool identified = false;
    int cycles = 0;  ///< that both predicted
    int judged = 0;  ///< that the simulation predicted
    double simulation_um2 = 0.0;
    double model_um2 = 0.0;
  };

  [[nodiscard]] OperatingLog log() const;
  [[nodiscard]] TimeSeries series() const;
  [[nodiscard]] Eigen::Vector3d simulatedNow() const;
  [[nodiscard]] double effectAt(double time_s, int axis) const;
  [[nodiscard]] double identifiedSigma(const Identified& model) const;
  /// How far the model's own error may have moved since a cycle told it last.
  [[nodiscard]] static double modelSigma(const Identified& model);
  [[nodiscard]] Identified identifiedFrom(ThermalModel model, double left_um) const;
  void judge(int axis, const LoopReading& told, double measured_um);
  void refresh();

  const LoopPlan& plan_;
  Say say_;
  std::optional<LoopTwin> twin_;
  std::array<std::optional<std::string>, 3> first_touch_;
  std::map<std::string, LoopReading> zero_;
  Eigen::Vector3d zero_reference_um_ = Eigen::Vector3d::Zero();
  std::vector<double> times_;
  std::vector<std::vector<double>> columns_;
  ObservationSet observations_;
  std::vector<double> simulated_;  ///< per observation
  std::array<Trust, 3> trusted_;
  std::optional<std::filesystem::path> effect_file_;
  std::shared_ptr<const EffectModel> effects_;
  Eigen::Vector3d effect_um_ = Eigen::Vector3d::Zero();
  std::map<int, Identified> identified_;
};

}  // namespace spindrift
