// SPDX-License-Identifier: Apache-2.0
// Fits parameters of a simulator to what was measured, with few runs. Internal
// to core/discrepancy; the problem is that of into_simulation.h.
//
// Between runs a model stands for the simulator:
//
//   change(theta) = change(theta_c) + sum_k J_k (theta_k - theta_c,k) + sum
//   over loads of their windows
//
// theta_c: the best values so far. J begins with the tangents of the search,
// follows every run (Broyden 1965, rank one) and is measured anew for what is
// put in. A load A between unknown times a and b acts by A (S(t - a) - S(t -
// b)), S its step response. The minimum of the model within the bounds and a
// trust region (Ceres) is the next run. With the first one run two more at the
// same time: what is put in moved a little, and everything else moved to and
// fro, which shows whether J still holds there.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "core/discrepancy/simulation_closure.h"
#include "core/discrepancy/simulator_tangents.h"

namespace spindrift {

/// A parameter that is fitted.
struct FreeParameter {
  SimulatorParameter parameter;
  double prior_sigma = 0.0;  ///< 0: anything within its bounds
  bool put_in = false;
  bool companion = false;  ///< changes nothing as the simulator stands, and may
                           ///< act with what is put in
  double start = 0.0;      ///< where the first model is minimised from, within the bounds
  Eigen::VectorXd slope;   ///< projected change per unit; empty: not known

  [[nodiscard]] double scale() const;
  /// Of a finite difference around `value`, within the bounds.
  [[nodiscard]] double step(double value) const;
};

/// A load that is put in with its begin and end: places in the list of free
/// parameters.
struct FreeWindow {
  std::size_t load = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
  std::shared_ptr<const WindowedLoad> response;
};

struct SimulationFit {
  bool usable = false;
  std::vector<double> values;           ///< of the free parameters
  std::vector<Eigen::VectorXd> slopes;  ///< projected change per unit at these
                                        ///< values; zero: without influence
  double cost = 0.0;                    ///< chi-squared with what the priors charge
  SimulatorRun run;                     ///< at these values
  std::string failure;                  ///< what the simulator said where it failed; empty: it did not
};

/// Throws Cancelled.
[[nodiscard]] SimulationFit fitSimulation(SimulationClosure& closure, std::vector<FreeParameter> free,
                                          const std::vector<FreeWindow>& windows, int most_iterations,
                                          const JobContext& job);

/// Below this a whitened change per scale of a parameter is none at all.
inline constexpr double no_influence_at_all = 1e-6;

}  // namespace spindrift
