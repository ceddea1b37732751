// SPDX-License-Identifier: Apache-2.0
// What the evaluations of hole and ball cycles have in common: the touches of an artefact over all cycles as one linear
// problem, the parameters per cycle in the units of their names, the touches left out and why, and the observations.
//
// A wall or ball touch at p with the stylus centre at distance d from the feature's centre c0 reads
//   y = |p - c_k| + u . (c_k - c0),  u = (p - c_k) / |p - c_k|,  c_k = centre found in this cycle,
// so that y = const - u . deviation(p) up to second order in the noise only. A surface touch reads y = n . p.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/machine/observation.h"
#include "core/probing/cycle_fit.h"
#include "core/probing/feature.h"
#include "core/probing/touch.h"

namespace spindrift {

/// One parameter in the unit of its name.
struct CycleParameter {
  double value = 0.0;
  double standard_uncertainty = 0.0;
  bool determined = true;
};

struct RejectedTouch {
  std::size_t touch = 0;  ///< index into the list
  std::string reason;
  /// By how much it misses what all other touches say; NaN where it was left out for another reason.
  double residual_um = std::numeric_limits<double>::quiet_NaN();
};

/// What hole and ball cycles have in common.
struct CycleEvaluation {
  FitStatus status = FitStatus::NotRun;
  std::string message = "not run";
  std::string artefact;
  std::vector<std::string> names;    ///< of the parameters, with units
  std::vector<double> unit;          ///< value in the unit of the name per internal value (mm, rad, strain)
  std::vector<std::string> cycles;   ///< names
  std::vector<double> cycle_time_s;  ///< mean of the touches
  std::vector<std::vector<CycleParameter>> parameters;  ///< per cycle, per name
  CycleFitResult fit;
  CycleProblem problem;
  std::vector<std::size_t> row_touch;       ///< index of the touch of each row of the problem
  std::vector<Eigen::Vector3d> row_normal;  ///< u of each row
  std::vector<RejectedTouch> rejected;
  std::vector<std::string> warnings;
  /// False: a cycle leaves parameters open, or the touches contradict each other; why is among the warnings.
  bool good_enough = true;
  std::vector<ProbedFeature> features;
  /// Growth of the artefact that was taken off: cycles x causes (strain), and the arm of each feature along which it
  /// moves (MCF, mm). Empty: none was.
  Eigen::MatrixXd growth_factors;
  std::map<std::string, Eigen::Vector3d> growth_arm_mm;

  /// Covariance of two parameters of one cycle, in the units of their names.
  [[nodiscard]] double covariance(int cycle, int a, int b) const;
  /// A warning for which the result is not good enough.
  void contradict(std::string sentence);
  /// Index of a parameter by name; throws InternalError if unknown.
  [[nodiscard]] int indexOf(const std::string& name) const;
};

/// How the touches of an artefact become rows.
struct CycleAssembly {
  FeatureKind kind = FeatureKind::Sphere;
  Eigen::Vector3d axis{0, 0, 1};       ///< of holes
  Eigen::Vector3d centre_mm{0, 0, 0};  ///< of the rotary axis that turns them
  std::vector<std::string> names;
  std::vector<double> unit;
  std::vector<CyclePrior> priors;
  /// d(deviation of the tip)/d(parameters) for a touch on a feature with this centre: 3 x parameters.
  std::function<Eigen::MatrixXd(const Touch&, const Eigen::Vector3d& centre_mm)> jacobian;
  /// Where the feature should be (MCF, mm), if known, to tell a touch on the wrong feature.
  std::function<std::optional<Eigen::Vector3d>(const std::string& feature, double c_deg)> nominal;
  std::vector<std::string> features;
  std::function<std::optional<double>(const std::string& feature, const std::string& stylus)> radius;
  double misplaced_mm = 1.0;
  CycleFitOptions fit;
};

/// Finds misplaced touches, builds the problem, solves it, rejects bad touches and fills `result`.
void evaluateCycles(const TouchList& list, const MachineDescription& machine, const Artefact& artefact,
                    const CycleAssembly& assembly, CycleEvaluation& result);

/// Puts the uncertainty of the growth that was taken off into the covariances and the parameters of `result`.
void addGrowthUncertainty(const TouchList& list, Eigen::MatrixXd factors, std::map<std::string, Eigen::Vector3d> arm_mm,
                          CycleEvaluation& result);

/// Deviations as observations: per feature, stylus and table angle, EX, EY, EZ in every cycle = minus the change of the
/// measured position since the first cycle. `point` = feature ("H2"), "H1@90" at a turned table, "B1/p0" for styli. The
/// first cycle stands with value 0. Rotations of the table angle are in c_deg, the stylus offset in tool_offset_mm.
///
/// Noise, um: displacement of cycle k = W_k (y_k - y_0) with the touches y of the cycle and of the first, all of
/// independent noise. Shared are the touches of the first cycle (as many causes per point as its rows tell apart; the
/// row of the first cycle itself has them once more beside its own, so that its difference to any other row has the
/// sigma of that row), what the axes of one reading share of its own touches (W_k cov(y_k) W_k^T), and the growth that
/// was taken off the artefact.
[[nodiscard]] ObservationSet cycleObservations(const CycleEvaluation& evaluation, const TouchList& list,
                                               const MachineDescription& machine, const Artefact& artefact);

}  // namespace spindrift
