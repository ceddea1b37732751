// SPDX-License-Identifier: Apache-2.0
// What a fitted model would make a control command: at every measured point, what would remain, and the tables that
// controls read. Compensation = -deviation (FORMATS.md). Units um and urad, mm in MCF, s.
//
// Three models can be used: the nine parameters of one thermal state (change from the reference state), the model of
// higher order that the evidence asks for of the same state, and the completed model of a discrepancy, simulation plus
// the effects that were added, at the time of a state (change since the start of the log). A simulation that is a table
// knows only the points and times it lists: corrections at the measured points then stand, a grid over the volume can
// be made of the added effects alone and says so.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/compensation.h"
#include "core/machine/control_tables.h"
#include "core/machine/nine_parameter_model.h"
#include "core/workflows/discrepancy_workflow.h"

namespace spindrift {

enum class CompensationSource { NineParameters, CompletedModel, HigherOrder };
[[nodiscard]] std::string_view toString(CompensationSource source) noexcept;

struct CompensationRequest {
  CompensationSource source = CompensationSource::NineParameters;
  std::string state;               ///< thermal state; empty: the warmest, see warmestState
  NineParameterOptions fit;        ///< of the nine parameters; its state is set
  std::vector<std::string> added;  ///< effects of the completed model, at least one
  std::vector<std::string> reject;
  int positions = 11;                           ///< along each axis, 2 to 51
  std::optional<Eigen::Vector3d> reference_mm;  ///< where the component tables pass through; else usualReference
  /// Which way a positive value of Fanuc pitch error data moves the axis, as tried; without it none are written.
  std::optional<FanucStep> fanuc_step;
  double fanuc_unit_um = 1.0;  ///< detection unit of the Fanuc control
  /// Throws InputError.
  void validate() const;
};

/// One measured point. Components that were not measured have no value; a prediction has one wherever the component was
/// measured at this point (completed simulation) or anywhere (models of the table), else it is NaN.
struct CompensationPoint {
  std::string point;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  std::array<std::optional<double>, 3> measured_um;  ///< deviation before, since `CompensationPlan::reference`
  std::array<double, 3> measured_sigma_um{};
  Eigen::Vector3d correction_um = Eigen::Vector3d::Zero();  ///< to add to the command
  Eigen::Vector3d sigma_um = Eigen::Vector3d::Zero();       ///< of the correction: expected error that remains
  std::array<std::optional<double>, 3> remains_um;          ///< measured plus correction
  bool used = true;                                         ///< took part in the fit
};

/// A file for a control or for people.
struct CompensationFile {
  std::string name;        ///< "compensation_grid.csv"
  std::string title;       ///< "Corrections on a grid"
  std::string convention;  ///< sign and reference, one sentence
  std::string content;
};

struct CompensationPlan {
  std::string model;      ///< one sentence: what predicts
  std::string reference;  ///< "state M0" or "the start of the log": the corrections hold relative to it
  std::string state;
  double time_s = 0.0;
  std::vector<CompensationPoint> points;
  double rms_before_um = 0.0;  ///< of the measured deviations, all displacements
  double rms_after_um = 0.0;   ///< of what remains of them
  double rms_sigma_um = 0.0;   ///< of the expected error: of the parameters, and of what the model does not describe
  /// The same before and after on data not used for fitting: those held out, else each point predicted by a fit
  /// without it; empty where there are none. `unseen` says which.
  std::optional<double> rms_before_unseen_um;
  std::optional<double> rms_after_unseen_um;
  std::string unseen;
  Eigen::Vector3d lack_of_fit_um = Eigen::Vector3d::Zero();  ///< part of every sigma: what the model does not describe
  /// A model that describes the state better, with the reason; empty if there is none or it is in use.
  std::string richer_model;
  double largest_um = 0.0;  ///< largest correction at a measured point, as a vector
  std::string limitation;   ///< what the grid and the tables do not hold; empty: nothing
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();
  std::array<int, 3> nodes{};  ///< of the grid
  std::vector<CompensationFile> files;
  std::string not_written;  ///< which controls get no table, and why; empty if nothing was written at all
  std::vector<std::string> warnings;

  /// Why it must not be used: data that took no part in the fit are no better with it. Empty: they are, or there are
  /// none.
  [[nodiscard]] std::string harm() const;
  [[nodiscard]] nlohmann::json json() const;  ///< without the content of the files
  [[nodiscard]] std::string summary() const;
};

/// The state whose displacements differ most (rms) from those of the first state, among the states with rows to fit; of
/// one state alone, that. Empty without observations.
[[nodiscard]] std::string warmestState(const ObservationSet& observations);

/// The position (mm, MCF) through which the lines of component tables pass where none is asked for: the middle of the
/// travels, or the position of the travels next to it within the box of the points that were measured in `state` (all
/// but excluded): nothing is known of a height without a point. 0 along what is no axis of the machine.
[[nodiscard]] Eigen::Vector3d usualReference(const MachineDescription& machine, const ObservationSet& observations,
                                             const std::string& state);

/// Throws InputError: nothing to fit, a state that does not exist, no effect added, parameters that the points do not
/// determine.
[[nodiscard]] CompensationPlan planCompensation(const Campaign& campaign, const ObservationSet& observations,
                                                const CompensationRequest& request, JobContext& job);

}  // namespace spindrift
