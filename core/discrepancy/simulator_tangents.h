// SPDX-License-Identifier: Apache-2.0
// What the parameters of a simulator do to its prediction, and how they enter
// the search beside the catalogue.
//
//   tangent(parameter) = [prediction(value + step) - prediction(value)] / step
//   um or urad per unit, by observation
//
// A mechanism that is off, and every uncertain parameter and sensor, is a
// hypothesis: an effect `simulation.<parameter>` or `sensor.<name>.<what>`
// whose gain is how much the parameter has to change. What an ordinary
// parameter may move within its standard uncertainty is a nuisance with this
// prior, so that it is named only where it must leave it.
//
// Films and conductivities are not linear: where the observations ask for a
// large change of one parameter, its hypothesis is the secant over that change,
// from runs there.
//
// A load that acts between two unknown times ("window"): from its answer S(t)
// to a load that begins with the first state and stays, the answer to one from
// a to b is S(t - a) - S(t - b), exact where the machine is linear with
// constant coefficients in this load, and a first guess otherwise. The window
// is the one that explains most; the choice is paid for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/discrepancy/observed_field.h"
#include "core/machine/effect.h"
#include "core/simulator/simulator.h"

namespace spindrift {

/// A load whose begin and end are to be found.
struct WindowedLoad {
  std::string begin_s;  ///< names of the parameters
  std::string end_s;
  double first_s = 0.0;  ///< the times that it may begin and end at
  double last_s = 0.0;
  /// Answer per unit of the mechanism, over the time since the load began: by
  /// point and component, in order of time.
  std::map<std::pair<std::string, Component>, std::vector<std::pair<double, double>>> step_response;
  [[nodiscard]] double at(double since_s, const std::string& point, Component component) const;
};

struct SimulatorTangent {
  SimulatorParameter parameter;
  double step = 0.0;             ///< of the finite difference, in units of the parameter
  std::vector<double> per_unit;  ///< by observation; NaN where the simulation has no value
  /// The same over the change that the observations ask of this parameter
  /// alone, where that is far from the step and the simulation is not linear;
  /// empty: as per_unit.
  std::vector<double> per_unit_far;
  std::shared_ptr<const WindowedLoad> window;
};

/// All of it for one simulator and one set of observations. Immutable.
struct SimulatorTangents {
  std::vector<double> base;  ///< prediction with the simulator's own values
  std::vector<SimulatorTangent> tangents;
  std::vector<std::string> mute;   ///< parameters that change nothing as the simulator stands
  std::vector<std::string> notes;  ///< sentences for the user
  std::size_t runs = 0;
};

/// Runs the simulator once for every parameter that has a standard uncertainty
/// or is a mechanism that is off (not for times of loads that are off), in
/// parallel. A parameter whose run fails has no tangent, which is told in a
/// note. Throws SimulatorFailed if the simulator fails with its own values.
[[nodiscard]] SimulatorTangents simulatorTangents(const Simulator& simulator, const ObservationSet& observations,
                                                  const JobContext& job);

/// The step that is taken to see what a parameter does: one standard
/// uncertainty, inside its bounds.
[[nodiscard]] double tangentStep(const SimulatorParameter& parameter);

/// The hypothesis as an effect of the search: one gain, in units of the
/// parameter. `far`: over the change that the observations ask for. `from_s`,
/// `to_s`: the window of a load that has one.
[[nodiscard]] Effect tangentEffect(const SimulatorTangent& tangent, const ObservationSet& observations, bool far);
[[nodiscard]] Effect windowedEffect(const SimulatorTangent& tangent, double from_s, double to_s);

}  // namespace spindrift
