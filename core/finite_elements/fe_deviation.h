// SPDX-License-Identifier: Apache-2.0
// Deviation of the tool relative to the table from displacements of finite elements: tool minus table, in MCF.
//
//   displacement of nodes i = 1 ... n of a set (x_i places, u_i displacements, both turned into MCF):
//   u_i = a + w x (x_i - c) + e_i, least squares, c = mean of x_i: a = mean of u_i, w small rotation
//   at a place p (`at_mm`): a + w x (p - c), else a
//   deviation = (a, w) of the tool - (a, w) of the table; EX, EY, EZ um, EA, EB, EC urad
//
// A rotation needs three nodes that are not on one line. A set that only grows has w = 0, whatever its shape. With
// `observe` the deviation is 1000 x the sum of weight x displacement in mm (dof 1, 2, 3 in the frame of the mesh): um,
// and urad where the weights are of per um.
#pragma once

#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/finite_elements/fe_map.h"
#include "core/machine/simulation_row.h"

namespace spindrift {

struct FeDeviation {
  std::vector<SimulationRow> rows;  ///< of a point (or place) in order of time
  bool by_place = false;
  std::size_t states = 0;
  std::size_t nodes = 0;  ///< used
  double first_s = 0.0;
  double last_s = 0.0;
  double largest_displacement_um = 0.0;  ///< of any node used
  double largest_deviation = 0.0;        ///< um or urad
  bool plausible = true;                 ///< false: a unit is probably wrong; `notes` says which
  std::vector<std::string> notes;        ///< sentences for the user
};

/// Throws InputError: see FeMap::validate and FeResultReader; a set or node that does not exist (with the sets that
/// do), a node without displacement, a rotation of nodes that do not determine it, times that run backwards.
[[nodiscard]] FeDeviation feDeviation(const FeMap& map, const FeReaderFactory& open, JobContext& job);

}  // namespace spindrift
