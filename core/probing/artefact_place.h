// SPDX-License-Identifier: Apache-2.0
// Where an artefact on a rotary table stands beside its nominal place, from where its features were found.
//
//   found - nominal = R(c) s + t + phi axis x (nominal - centre)      (across the axis, mm and rad)
// s: shift on the table (how it was clamped), t: the centre of the rotary axis beside that of the machine file, phi:
// turn on the table. Least absolute deviations by reweighting: features under a wrong label do not pull. What the
// table angles do not separate is shared out (least norm). It rests on phi being small: beyond 0.1 rad nothing is
// registered. Source: Huber and Ronchetti (2009) "Robust Statistics", 7.8.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace spindrift {

/// A feature at one table angle.
struct FoundFeature {
  double c_deg = 0.0;
  Eigen::Vector3d nominal_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d found_mm = Eigen::Vector3d::Zero();
};

/// Everything across the axis, mm and rad. Zero: as the machine file has it.
struct ArtefactPlace {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_table_mm = Eigen::Vector3d::Zero();       ///< s, at c = 0
  Eigen::Vector3d centre_offset_mm = Eigen::Vector3d::Zero();  ///< t; shared with s where all have one table angle
  double turn_rad = 0.0;                                       ///< phi
  double largest_mm = 0.0;                                     ///< of the features found

  /// From the nominal place of a feature to where it is expected.
  [[nodiscard]] Eigen::Vector3d offset_mm(const Eigen::Vector3d& nominal_mm, double c_deg) const;
};

/// `axis` unit. Without features, or with a turn beyond 0.1 rad, as the machine file has it.
[[nodiscard]] ArtefactPlace registerArtefact(const std::vector<FoundFeature>& features, const Eigen::Vector3d& axis,
                                             const Eigen::Vector3d& centre_mm);

}  // namespace spindrift
