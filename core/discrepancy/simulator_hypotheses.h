// SPDX-License-Identifier: Apache-2.0
// Parameters of a simulator as hypotheses beside the catalogue, and as nuisances where they are uncertain. Internal to
// core/discrepancy; the model is that of simulator_tangents.h.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/discrepancy/candidate_library.h"
#include "core/discrepancy/residual_problem.h"
#include "core/discrepancy/simulator_tangents.h"

namespace spindrift {

/// The window of a load, and among how many it was chosen.
struct LoadWindow {
  double from_s = 0.0;
  double to_s = 0.0;
  int choices = 1;
};

/// The window whose load explains most of what is left beside the columns given.
[[nodiscard]] LoadWindow bestWindow(const SimulatorTangent& tangent, const ResidualProblem& problem,
                                    const CandidateLibrary::Given& given);

class SimulatorHypotheses {
 public:
  /// `tangents` may be null: then there are none. Both outlive this object.
  SimulatorHypotheses(const SimulatorTangents* tangents, const ObservationSet& observations);

  /// Puts them behind the catalogue; ids that the user's own effects have already are theirs.
  void append(std::vector<Effect>& catalogue) const;
  /// What uncertain parameters may move, with their standard uncertainties as priors.
  [[nodiscard]] std::vector<NuisanceColumn> nuisances(const ResidualProblem& problem) const;
  /// Chooses the windows anew beside what is given for each (its id), and puts the effects in their place. True if one
  /// has moved by more than a grid step.
  bool chooseWindows(std::vector<Effect>& catalogue, const ResidualProblem& problem,
                     const std::function<CandidateLibrary::Given(const std::string& id)>& given);

  [[nodiscard]] const SimulatorTangent* find(const std::string& id) const;
  [[nodiscard]] const LoadWindow* windowOf(const std::string& id) const;

  /// What an effect found says of its parameter: its value with uncertainty, and the window. `gain` and its
  /// uncertainty in units of the parameter.
  void describe(FoundEffect& found, double gain, double gain_uncertainty) const;
  /// Names of parameters that do the same to these readings, in pairs.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> twins(const ResidualProblem& problem) const;

 private:
  const SimulatorTangents* tangents_;
  const ObservationSet* observations_;
  std::map<std::string, LoadWindow> windows_;
};

}  // namespace spindrift
