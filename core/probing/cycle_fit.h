// SPDX-License-Identifier: Apache-2.0
// The one least squares behind all probing cycles: thermal parameters of every cycle, all relative to the first.
//
// Model, one row per touch i in cycle k (mm along the normal of the touched surface):
//   y_ik = b_i + J_ik theta_k + e_ik,   theta of the reference cycle = 0,   cov(e) = diag(sigma_group^2)
// b_i is the constant of the touch (where the surface is, radius, pre-travel of the probe in that direction); it is the
// same in all cycles and is solved together with all theta_k. The noise of the reference cycle therefore enters every
// other cycle alike: cov(theta_k, theta_l) = A_k^+ cov(b) A_l^+T is not zero and is given. Touch noise is not known
// beforehand: it is estimated per group of touches from the residuals of all cycles (restricted maximum likelihood:
// sum r^2 / sum (1 - leverage)). Single bad touches are found by their studentised residual and left out one by one.
// Solved by QR per cycle and one symmetric eigenvalue problem for b; parameters that the touches present do not
// determine are named, never invented.
// Source: PAPERS.md P1 (5), solved as least squares; Bjoerck (1996) "Numerical Methods for Least Squares Problems".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace spindrift {

struct CycleRow {
  int cycle = 0;
  int key = 0;    ///< which touch: the same key in every cycle
  int group = 0;  ///< touches of equal noise
  double value_mm = 0.0;
};

/// Something known beforehand about the parameters of every cycle: row . theta = value +- sigma (internal units).
struct CyclePrior {
  Eigen::RowVectorXd row;
  double value = 0.0;
  double sigma = 0.0;
  std::vector<double> value_of_cycle;  ///< instead of `value`, one per cycle, if not empty
};

struct CycleProblem {
  int cycles = 0;
  int keys = 0;
  int groups = 1;
  int reference_cycle = 0;
  std::vector<std::string> parameters;  ///< names, for messages
  std::vector<CycleRow> rows;
  Eigen::MatrixXd jacobian;  ///< rows x parameters: mm per mm, per rad or per strain
  std::vector<CyclePrior> priors;
};

struct CycleFitOptions {
  /// Touch noise where no touch checks another: what a touch-trigger probe of a machine tool repeats to, mm.
  static constexpr double assumed_sigma_mm = 1e-3;
  /// Touches with a larger studentised residual are left out. 0: none is.
  double outlier_threshold = 5.0;
  /// Touch noise if it is known, mm; else it is estimated.
  std::optional<double> sigma_mm;
  /// Combinations with a singular value below this part of the largest (whitened, unit columns) count as open: common
  /// growth of everything hides behind micrometres of clamping, not behind rounding.
  double rank_tolerance = 1e-3;

  void validate() const;
};

struct CycleSolution {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  Eigen::VectorXd theta;           ///< mm, rad, strain
  Eigen::MatrixXd covariance;      ///< of the difference to the reference cycle, with its noise
  Eigen::MatrixXd own_covariance;  ///< of the touches alone: the part that is not common with other cycles
  std::vector<bool> determined;    ///< per parameter
  double condition_number = 0.0;   ///< of the whitened, column-scaled matrix
  Eigen::VectorXd weakest;         ///< unit combination of the scaled parameters that is determined worst
  double chi2 = 0.0;               ///< of the touches used
  int touches_used = 0;
};

struct CycleFitResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  std::vector<CycleSolution> cycles;
  std::vector<double> group_sigma_mm;            ///< touch noise per group
  std::vector<double> group_degrees_of_freedom;  ///< that estimate it
  double degrees_of_freedom = 0.0;
  std::vector<double> residual_mm;             ///< per row
  std::vector<double> studentised;             ///< per row; of a rejected row: from the fit without it
  std::vector<bool> used;                      ///< per row
  Eigen::VectorXd constant_mm;                 ///< b
  Eigen::MatrixXd constant_covariance;         ///< cov(b)
  std::vector<Eigen::MatrixXd> from_constant;  ///< per cycle: d theta / d b, for covariances between cycles
  /// Per cycle, parameters x causes: what one standard uncertainty of a cause that the touches do not show (growth of
  /// the artefact, its certificate) does to theta; empty: none. Part of `covariance` of the cycle.
  std::vector<Eigen::MatrixXd> causes;
  /// Per cycle, parameters x values: what values known from elsewhere take off, cov(theta_k, theta_l) falls by known_k
  /// known_l^T; empty: none. Part of `covariance` of the cycle.
  std::vector<Eigen::MatrixXd> known;

  /// Covariance between the parameters of two different cycles: the common first cycle, common causes, and what is
  /// known from elsewhere.
  [[nodiscard]] Eigen::MatrixXd covarianceBetween(int cycle_a, int cycle_b) const;
};

/// Adds causes that move rows of all cycles: `shift_mm(row, cause)` is what one standard uncertainty of a cause does to
/// the value of a row. Covariances of the cycles grow by them.
void addCauses(const CycleProblem& problem, const Eigen::MatrixXd& shift_mm, CycleFitResult& fit);

/// A combination of parameters that is known from elsewhere too: row . theta_k = value_k with errors that the cycles
/// have in common (an expansion coefficient, the temperature of the first cycle).
struct KnownCombination {
  Eigen::RowVectorXd row;      ///< parameters
  std::vector<int> cycles;     ///< where it is known; not the reference cycle
  Eigen::VectorXd value;       ///< per entry of `cycles`, internal units
  Eigen::MatrixXd covariance;  ///< of the values
};

/// Best linear unbiased combination of the fit with it: theta of all cycles, constants, residuals and covariances are
/// those of one least squares over touches and known values together. Cycles that leave a parameter of the combination
/// open are passed by. The noise of the touches stays as it was estimated.
void combineWith(const CycleProblem& problem, const KnownCombination& known, CycleFitResult& fit);

[[nodiscard]] CycleFitResult fitCycles(const CycleProblem& problem, const CycleFitOptions& options = {});

/// "EXX 0.71, EME 0.70": the largest parts of a combination of parameters.
[[nodiscard]] std::string combinationText(const Eigen::VectorXd& combination, const std::vector<std::string>& names);

}  // namespace spindrift
