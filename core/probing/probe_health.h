// SPDX-License-Identifier: Apache-2.0
// Health of the probe itself: qualification of a stylus on a sphere, repeatability, a loose stylus.
//
// Qualification: many touches from different directions on a sphere of known diameter. Distance of the stylus centre
// from the sphere's centre when it triggered, minus the nominal stand-off, is minus the pre-travel in that direction:
//   pre-travel(n) = R + r - |p - c|, given per direction relative to its mean (the mean belongs to the effective
//   radius).
// Repeatability: spread of repeated touches from one direction. A loose stylus: touches scatter far more than the probe
// usually does, or the centre of the sphere jumps between passes. A warm machine moves the centre too, but smoothly and
// for all styli alike: stylus_movement.h tells them apart as far as the passes allow, and says when they do not.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "core/probing/feature.h"
#include "core/probing/stylus_movement.h"

namespace spindrift {

struct ProbeHealthOptions {
  /// Repeatability a healthy probe keeps, um (one standard deviation).
  double healthy_sigma_um = 1.0;
  /// A scatter or a step of this many times the healthy one is called loose.
  double loose_factor = 4.0;
  /// Touches whose directions differ by less are repeats of one another, deg.
  double same_direction_deg = 3.0;
  /// Throws InputError: not positive.
  void validate() const;
};

struct PreTravel {
  Eigen::Vector3d approach = Eigen::Vector3d::UnitX();
  double pre_travel_um = 0.0;  ///< relative to the mean over all directions
  /// With what centre and radius may have taken of it; NaN where the directions are too few to tell.
  double standard_uncertainty_um = 0.0;
  /// Standard deviation of a touch beside a mean of every direction and a centre of every pass; NaN where these follow
  /// every touch of the direction.
  double repeatability_um = std::numeric_limits<double>::quiet_NaN();
  int touches = 0;
};

struct StylusHealth {
  FitStatus status = FitStatus::NotRun;
  std::string message = "not run";
  std::string stylus, feature;
  double effective_radius_mm = 0.0;  ///< of the stylus with its mean pre-travel
  double effective_radius_sigma_mm = 0.0;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  std::vector<PreTravel> directions;
  double pre_travel_range_um = 0.0;
  /// The same of all touches; NaN: nothing repeats, and the stylus is called neither healthy nor loose.
  double repeatability_um = std::numeric_limits<double>::quiet_NaN();
  int repeatability_dof = 0;     ///< touches - directions - 3 for every pass but one
  double largest_step_um = 0.0;  ///< largest movement of the sphere's centre between passes (cycles)
  /// Movement of the centre over the passes, minus what the other styli see on the same sphere where they are there.
  StylusMovement movement;
  bool compared = false;                                      ///< with other styli
  Eigen::Vector3d loose_direction = Eigen::Vector3d::Zero();  ///< of the largest scatter or step
  bool loose = false;
  bool healthy = false;
};

/// One result per stylus and sphere. Passes are the cycles of the list. Spheres with fewer than 5 touches or touches
/// that leave the centre open have status Degenerate.
[[nodiscard]] std::vector<StylusHealth> checkProbeHealth(const TouchList& list, const MachineDescription& machine,
                                                         const ProbeHealthOptions& options = {});

}  // namespace spindrift
