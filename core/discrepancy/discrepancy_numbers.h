// SPDX-License-Identifier: Apache-2.0
// Checks of the input and the numbers of a result: gains with their covariance, rms over rows. Internal to
// core/discrepancy; `evaluateRows` serves reports as well.
#pragma once

#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_search.h"

namespace spindrift {

/// Throws InputError when observations and simulation move alike but a thousand times as far: mm in place of um.
void checkUnits(const DiscrepancyInput& input, const std::vector<std::size_t>& rows);

/// What the log lacks that the search would need.
/// Data that tell less than they seem to: one component, states read at one point only.
void warnAboutData(const DiscrepancyInput& input, const std::vector<std::size_t>& rows,
                   std::vector<std::string>& warnings);
/// What was read from the names of sensors, for the user to confirm, and where name and place contradict each other.
void warnAboutSensors(const std::vector<SensorReading>& sensors, std::vector<std::string>& warnings);
void warnAboutLog(const DiscrepancyInput& input, const DriverTable& drivers, double log_clock_s,
                  std::vector<std::string>& warnings);

/// What decides which effects this machine, its log and the points measured admit.
[[nodiscard]] CatalogueContext catalogueContext(const DiscrepancyInput& input, const DriverTable& drivers,
                                                const ResidualProblem& problem);

/// The effects that this machine can have and that this log cannot decide, because nothing that drives them is in it.
void warnAboutUndecidable(const DiscrepancyInput& input, const std::vector<Effect>& catalogue,
                          std::vector<std::string>& warnings);

/// Gains and lags of a joint fit with their covariance (linearised at the solution). `prior_sigma`: of every gain of
/// every term, 0 free; lags of inputs whose gains have one are fixed.
[[nodiscard]] std::vector<ModelEffect> modelEffects(const EffectSearch& search, const ResidualProblem& problem,
                                                    const JointFit& fit, const std::string& source, double chi2_scale,
                                                    const std::vector<Eigen::VectorXd>& prior_sigma = {});

/// "feed_y (lag 2400 s) + T_room_degC (lag 900 s)".
[[nodiscard]] std::string driversText(const ModelEffect& effect);

struct RowResult {
  std::vector<double> constant;  ///< per row, NaN where the series was not fitted
  double fit_rms = 0.0;
  double holdout_rms = 0.0;
  std::size_t holdout_rows = 0;
  bool rotations = false;    ///< no displacement was fitted: rms in urad
  std::vector<double> left;  ///< per row, of the components that count: measured less all that is explained, else NaN
};

/// Constants of the series from the fit rows (0 where values are absolute), and the rms of what is left in
/// displacements (um), or in rotations (urad) where nothing else was fitted.
[[nodiscard]] RowResult evaluateRows(const DiscrepancyInput& input, const std::vector<std::size_t>& fit_rows,
                                     const std::vector<std::size_t>& held_rows, const std::vector<double>& effect_part);

/// How sure it is that `a` leaves more than `b` on `rows`: paired differences of squares, summed by state (values of
/// one state share errors), one-sided Student t over the states; 0.5 where neither leaves more. Fewer than two states:
/// 0.5. The comparison of forecasts of Diebold and Mariano (1995) with states as blocks.
[[nodiscard]] double probabilityOfLeavingMore(const std::vector<Observation>& observations,
                                              const std::vector<std::size_t>& rows, const std::vector<double>& a,
                                              const std::vector<double>& b);

}  // namespace spindrift
