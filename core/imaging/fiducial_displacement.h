// SPDX-License-Identifier: Apache-2.0
// Displacement of the tool relative to the table between thermal states, from the poses and contrasts of a capture
// list.
//
// XY (P0 (12)-(15)): the spindle's axis meets the fiducial at s (FCF). If the tool moves by d relative to the table, s
// moves by R(-psi) d, so  d = R(psi) (s - s_ref) - (c - c_ref)  with c the commanded position.
// Z (P0 (20)): the focus peak over commanded height moves by -d, so d = -(peak - peak_ref).
// The reference is one state for all fiducials, the first of the list in which any of them has a place in the plane (or
// a focus peak). A fiducial without it there has no displacement in any other state: relative to another reference it
// would stand beside the rest as if it were relative to the same (a warning says so).
//
// Observations carry what they share as causes: the pooled centres and the shape of the focus curves, the direction of
// the camera, that of every fiducial, and the reference of every series (a fiducial, one component). Rows of the
// reference state are 0 by definition, so any cause may be added to all rows of a series. With
// r the own noise of the reference (standard uncertainty u_r, in every other row as -r) and z a cause of its own, of
// the same size,
//   r/2 + sqrt(3)/2 z    is added:    other rows  d + r/2 + sqrt(3)/2 z,    the reference  r/2 + sqrt(3)/2 z.
// The sigma of the reference row is u_r, its share in the noise; every other row keeps the sigma of its displacement,
// which is exactly that of its difference to the reference row. Source: PAPERS.md P0; FORMATS.md (deviation,
// observations.cov.csv).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/imaging/axis_directions.h"
#include "core/imaging/centre_of_rotation.h"
#include "core/imaging/fiducial_images.h"
#include "core/machine/machine_description.h"
#include "core/machine/observation.h"
#include "core/machine/observation_plausibility.h"

namespace spindrift {

/// One fiducial in one state. um, MCF, relative to the reference state.
struct FiducialState {
  std::string fiducial;
  std::string state;
  double time_s = 0.0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  bool reference = false;
  std::optional<std::size_t> centre;      ///< index in CentreResult::sets
  std::optional<std::size_t> focus_set;   ///< index in focus sets
  std::optional<std::size_t> directions;  ///< index in AxisDirections::sets
  Eigen::Vector2d commanded_mm = Eigen::Vector2d::Zero();
  std::optional<std::size_t> xy_reference;  ///< index in FiducialDisplacement::states of what xy_um is relative to
  std::optional<std::size_t> z_reference;
  std::optional<Eigen::Vector2d> xy_um;
  Eigen::Vector2d xy_sigma_um = Eigen::Vector2d::Zero();
  std::optional<double> z_um;
  double z_sigma_um = 0.0;
};

struct FiducialDirection {
  std::string fiducial;
  double psi_rad = 0.0;  ///< direction of FCF in MCF
  double sigma_rad = 0.0;
  bool pooled = false;  ///< through the common direction of the camera
};

struct FiducialDisplacement {
  std::vector<FiducialState> states;  ///< in order of the list
  AxisDirections axes;
  std::vector<FiducialDirection> directions;
  CentreResult centres;
  std::vector<FocusSet> focus_sets;
  FocusResult focus;
  ObservationSet observations;
  std::vector<RejectedCapture> rejected;  ///< sets that could not be used
  /// Displacements that no machine has; not among states and observations any more (rows count before that).
  std::vector<ImplausibleReading> implausible;
  std::vector<std::string> warnings;
};

/// Makes the observations of the displacements in `states` and their sigmas (there as well) from directions, centres
/// and focus, um. The last step of findFiducialDisplacement.
void makeFiducialObservations(FiducialDisplacement& displacement);

[[nodiscard]] FiducialDisplacement findFiducialDisplacement(const FiducialCaptureList& list,
                                                            const FiducialImages& images,
                                                            const MachineDescription& machine);

}  // namespace spindrift
