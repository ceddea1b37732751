// SPDX-License-Identifier: Apache-2.0
// The path of one measuring cycle: which stylus goes where, with safe retracts, from the machine and artefact files.
//
// Positions are those of the stylus centre in MCF, mm; the spindle reference is at tip - offset, and travel limits hold
// for it. "Up" is +Z (away from the table along the spindle).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/machine/machine_description.h"

namespace spindrift {

enum class MoveKind {
  Rapid,    ///< in free space at or above the safe height
  Guarded,  ///< stops if the probe triggers: nothing should be there
  Touch,    ///< towards the material until the probe triggers, at most to the target
  Retract,  ///< back from a touch
  Turn,     ///< the table turns to c_deg; the tip is at the safe height
};

struct PlannedMove {
  MoveKind kind = MoveKind::Rapid;
  Eigen::Vector3d tip_mm = Eigen::Vector3d::Zero();
  double c_deg = 0.0;
  std::string stylus;
  std::string feature;  ///< of a touch
  int touch = 0;
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();  ///< of a touch
};

struct CyclePlanOptions {
  /// A feed is written as a whole number; a probe that is faster breaks before the control stops.
  static constexpr double least_feed_mm_min = 1.0;
  static constexpr double most_touch_feed_mm_min = 3000.0;
  static constexpr double most_guarded_feed_mm_min = 20000.0;
  static constexpr double most_surface_offset_mm = 1000.0;

  double clearance_mm = 5.0;       ///< free distance kept around material by all moves that are no touches
  double retract_mm = 30.0;        ///< safe height above the highest material
  double overtravel_mm = 2.0;      ///< a touch may search so far behind the nominal surface
  double depth_mm = 3.0;           ///< of the touches in a hole below the surface
  double surface_offset_mm = 9.0;  ///< of the touch beside a hole, along the bar
  double touch_feed_mm_min = 60.0;
  double guarded_feed_mm_min = 1500.0;
  Eigen::Vector3d first_ball_mm = Eigen::Vector3d::Zero();  ///< where the first ball stands in MCF
  bool touch_from_below = false;                            ///< balls without a pole under them

  /// Throws InputError.
  void validate() const;
};

struct CyclePlan {
  std::string artefact;
  std::vector<PlannedMove> moves;
  double safe_height_mm = 0.0;  ///< of the tip, for the stylus that hangs lowest
  int touches = 0;
  int left_out_below = 0;  ///< touches of balls from below: a stem may be there (touch_from_below)
};

/// Plan for a hole bar (P1: all holes at 0 deg, the reference hole at 90 and 270, three holes at 180) or a ball
/// artefact (P4: every ball with every stylus). Throws InputError if a position lies outside the travel of an axis, or
/// a stylus does not fit.
[[nodiscard]] CyclePlan planCycle(const MachineDescription& machine, const Artefact& artefact,
                                  const CyclePlanOptions& options = {});

}  // namespace spindrift
