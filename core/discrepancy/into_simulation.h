// SPDX-License-Identifier: Apache-2.0
// The missing effect goes into the simulation itself: its mechanism is switched
// on, its physical parameters and the uncertain others are fitted on the
// simulator, and the simulator's own new prediction is judged.
//
//   minimise  | W [observation - constant(series) - prediction(theta)] |^2 +
//   sum ((theta_k - value_k) / u_k)^2
//
// W: whitening under the noise that the search found, free of the constants and
// of the gain of the simulation within its stated uncertainty. Mechanisms that
// are put in and parameters that were named are free within their bounds; all
// others keep their value within the standard uncertainty u; those of which the
// data teach nothing keep it as it is. Gauss-Newton with bounds in a trust
// region, derivatives carried over from the search (simulation_fit.h).
// Covariance from the Jacobian at the solution, widened by chi-squared where
// the physics leave more than noise (Birge 1932). Source: Kennedy and O'Hagan
// 2001 (calibration); GUM 2008, 5.2 (correlated inputs).
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/simulator/simulator.h"

namespace spindrift {

struct IntoSimulationOptions {
  /// Names of the parameters to free; empty: the mechanisms behind the effects
  /// named.
  std::vector<std::string> mechanisms;
  int most_iterations = 12;  ///< of the trust region
};

struct FittedSimulatorParameter {
  SimulatorParameter parameter;
  double value = 0.0;
  double standard_uncertainty = 0.0;
  bool put_in = false;        ///< a mechanism or a parameter that was named, with what
                              ///< belongs to it
  bool at_bound = false;      ///< the data ask for more than is allowed
  bool no_influence = false;  ///< changes no prediction: kept at its value
};

struct SimulationUpdate {
  FitStatus status = FitStatus::NotRun;
  std::string message;                  ///< one sentence or two for the user
  std::vector<std::string> mechanisms;  ///< names of what was put in
  std::vector<FittedSimulatorParameter> parameters;
  Eigen::MatrixXd correlation;  ///< of these parameters; 0 for those that were not fitted
  std::vector<std::string> warnings;
  ParameterValues values;      ///< the new version of the simulator
  std::vector<double> before;  ///< its prediction for every observation, um or urad
  std::vector<double> after;
  std::vector<SimulationRow> rows;  ///< of the last run, where it gives a whole table
  double rms_before_um = 0.0;       ///< what remains beside the constants, over the fitted displacements
  double rms_after_um = 0.0;
  double rms_fitted_term_um = 0.0;  ///< with the effects fitted on top of the simulation instead
  double p2p_before_um = 0.0;
  double p2p_after_um = 0.0;
  double heldout_rms_before_um = 0.0;  ///< NaN without held-out rows
  double heldout_rms_after_um = 0.0;
  double heldout_rms_fitted_term_um = 0.0;
  double noise_um = 0.0;
  bool improves = false;  ///< on what was held out (on the fitted rows where nothing was)
  bool as_well_as_fitted_term = false;
  std::vector<DisagreementPlace> where;  ///< what the new simulation still does not explain
  std::size_t runs = 0;                  ///< of the simulator, for the fit
  std::size_t runs_to_search = 0;        ///< and before it, to see what its parameters do
  double elapsed_s = 0.0;

  /// The object "into_simulation" of the JSON of `discrepancy`.
  [[nodiscard]] nlohmann::json json() const;
  /// Reads what `json` wrote: without predictions, rows and places. Throws
  /// nlohmann::json::exception.
  [[nodiscard]] static SimulationUpdate parse(const nlohmann::json& json);
  [[nodiscard]] std::string summary() const;
};

/// `result` is that of findDiscrepancy on `input`, whose predictions are the
/// simulator's own. Status Converged: `values` may be used. Degenerate: nothing
/// that was named has a mechanism. Rejected: what was held out is predicted no
/// better. NoConvergence: the fit did not settle, or runs failed. Throws
/// InputError for an unknown name among the mechanisms, Cancelled.
[[nodiscard]] SimulationUpdate putIntoSimulation(const DiscrepancyInput& input, const DiscrepancyResult& result,
                                                 const Simulator& simulator, const IntoSimulationOptions& options,
                                                 JobContext& job);

}  // namespace spindrift
