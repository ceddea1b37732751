// SPDX-License-Identifier: GPL-3.0-or-later
// How the tip of a machine deviates from an artefact whose cycles have known parameters: the truth of the virtual probe
// (core/simulation/virtual_probe.h) in tests.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/probing/hole_cycle.h"
#include "core/simulation/virtual_probe.h"

namespace spindrift::probing_test {

/// Parameters of FORMATS.md in the order of the names (um, urad, um/m): EXX, EX0C, EY0C, EZ0T, ER0T, EA0C, EB0C, EC0C,
/// EME, and optionally the slope of the second axis.
inline TipDeviation holeBarDeviation(const MachineDescription& machine, const Artefact& artefact,
                                     std::vector<double> parameters) {
  SPINDRIFT_ASSERT(parameters.size() == 9 || parameters.size() == 10, "a hole bar has 9 or 10 parameters");
  const HoleBarSetup setup = HoleBarSetup::of(machine, artefact);
  Eigen::Index along = 0;
  setup.direction_at_c0.cwiseAbs().maxCoeff(&along);
  Eigen::Index turn = 2;
  setup.rotary_direction.cwiseAbs().maxCoeff(&turn);
  const Eigen::Index across = 3 - along - turn;
  const auto& p = parameters;
  Eigen::Vector3d shift;
  int next = 1;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (k != turn) shift(k) = p[static_cast<std::size_t>(next++)] * mm_per_um;
  }
  shift(turn) = p[3] * mm_per_um;
  const Eigen::Vector3d rotation = Eigen::Vector3d(p[5], p[6], p[7]) * rad_per_urad;
  return [=](const ProbeTouchQuery& q) -> Eigen::Vector3d {
    const Eigen::Vector3d lever = q.tip_mm - setup.centre_mm;
    Eigen::Vector3d axes = Eigen::Vector3d::Zero();
    axes(along) = p[0] * 1e-6 * lever(along);
    if (p.size() > 9) axes(across) = p[9] * 1e-6 * lever(across);
    const Eigen::Matrix3d table = setup.tableRotation(q.c_deg);
    Eigen::Vector3d radial = setup.reference_in_table_mm;
    radial(turn) = 0.0;
    if (radial.norm() > 0.0) radial.normalize();
    const double s = setup.along_mm[static_cast<std::size_t>(HoleBarSetup::holeIndex(q.feature))];
    const Eigen::Vector3d moved =
        shift + rotation.cross(lever) + table * (p[4] * mm_per_um * radial + p[8] * 1e-6 * s * setup.direction_at_c0);
    return axes - moved;
  };
}

/// Parameters hX..hZ, aX..aZ, dX..dZ, gX..gZ.
inline TipDeviation ballDeviation(const MachineDescription& machine, std::vector<double> parameters) {
  SPINDRIFT_ASSERT(parameters.size() == 12, "a ball artefact has 12 parameters");
  Eigen::Vector3d bearing = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[k]));
    if (axis != nullptr) bearing(k) = axis->fixed_bearing_mm.value_or(0.0);
  }
  const Eigen::Map<const Eigen::Matrix<double, 12, 1>> map(parameters.data());
  const Eigen::Matrix<double, 12, 1> p = map;
  return [=](const ProbeTouchQuery& q) -> Eigen::Vector3d {
    const Eigen::Vector3d head = p.segment<3>(0) * rad_per_urad;
    const Eigen::Vector3d column = p.segment<3>(3) * rad_per_urad;
    const Eigen::Vector3d screw = p.segment<3>(9) * 1e-6;
    return p.segment<3>(6) * mm_per_um + column.cross(q.tip_mm) + head.cross(q.tool_offset_mm) +
           screw.cwiseProduct(q.tip_mm - q.tool_offset_mm - bearing);
  };
}

}  // namespace spindrift::probing_test
