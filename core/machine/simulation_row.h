// SPDX-License-Identifier: Apache-2.0
// One prediction of another program, as simulation.csv holds it: um or urad, at a point or at a place, at a time.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/machine/component.h"

namespace spindrift {

struct SimulationRow {
  double time_s = 0.0;
  std::string point;                                      ///< empty in a table by place
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< MCF, of a table by place
  Component component = Component::EX;
  double predicted = 0.0;
};

/// The text of simulation.csv: with `x_mm,y_mm,z_mm` in place of `point` if `by_place`.
[[nodiscard]] std::string simulationCsv(const std::vector<SimulationRow>& rows, bool by_place);

}  // namespace spindrift
