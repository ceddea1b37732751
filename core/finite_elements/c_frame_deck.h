// SPDX-License-Identifier: Apache-2.0
// The CalculiX deck of the C-frame example machine (c_frame_machine.h): a simulation that Spindrift can run, as
// simulator.json of kind "calculix" describes it.
//
//   heat.inp: rho c dT/dt = div(k grad T) + q, implicit with a fixed increment, one step per state
//             films on all free faces (air at room_gain x change of the room; the coolant on the middle of the table
//             while it runs), friction in both bearings ~ speed^1.5, loss of the motor ~ speed, sun on the column's
//             front
//   mech.inp: linear statics with the temperatures of each state, free of stress at the start, three feet
//
// Units of the deck: mm, t, s, N, MPa, mW, K. Temperatures count from the start of the campaign, so that the first
// state is zero and the answer is linear in every load but those that change a film. CalculiX takes a load at the end
// of an increment for all of it: what switches is given as its mean over the increment.
//
// Left out: screws, scales and guideways with play or friction of their own; joints conduct perfectly; a film that runs
// part of the time (coolant) leaves its faces without air while it does not.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/finite_elements/c_frame_machine.h"

namespace spindrift {

/// Values of the deck's parameters by name, in the units of simulator.json.
using CFrameValues = std::map<std::string, double>;

/// Those of the example: sun, coolant and loss of the motor are off (0).
[[nodiscard]] const CFrameValues& cFrameValues();

struct CFrameDeckOptions {
  CFrameDimensions dimensions;
  double largest_cell_mm = 110.0;  ///< about 2,800 nodes
  CFrameValues values;             ///< in place of those of the example
  int states = 32;
  double state_interval_s = 900.0;
  double increment_s = 300.0;  ///< divides the interval

  [[nodiscard]] double duration_s() const { return states * state_interval_s; }
  /// Throws InputError: no state, an interval that is no multiple of the increment, an unknown parameter or a value
  /// beyond its bounds.
  void validate() const;
};

/// The files of a deck.
struct CFrameDeck {
  CFrameDeckOptions options;
  std::string mesh;           ///< mesh.inp
  std::string heat_template;  ///< heat.inp.in
  std::string mech_template;  ///< mech.inp.in
  std::string observe;        ///< observe.csv
  nlohmann::json simulator;   ///< simulator.json
  std::size_t nodes = 0;
  std::size_t elements = 0;

  /// Throws InputError: see CFrameDeckOptions and CFrameMachine.
  [[nodiscard]] static CFrameDeck make(const CFrameDeckOptions& options);
  [[nodiscard]] static CFrameDeck make(const CFrameDeckOptions& options, const CFrameMachine& machine);
  /// Values of all parameters.
  [[nodiscard]] CFrameValues values() const;
  /// All five files. Throws InputError if the folder cannot be written.
  void write(const std::filesystem::path& folder) const;
};

/// machine.json of the example.
[[nodiscard]] nlohmann::json cFrameMachineJson(const CFrameDimensions& dimensions);

}  // namespace spindrift
