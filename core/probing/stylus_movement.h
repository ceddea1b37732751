// SPDX-License-Identifier: Apache-2.0
// Is it the stylus that moved, or does the machine warm up? Both show as a movement of a sphere's centre between
// passes.
//
// Model of the centre over passes k at times t_k (own movement: minus what the other styli see on the same sphere):
//   smooth  c(t) = a + b g(t),  g = t or 1 - exp(-t / tau) with tau from half an interval to ten times the record
//   step    c(t) = a + b [t > t_j]
//   both    c(t) = a + b g(t) + s [t > t_j]
// compared by BIC on the three coordinates, with the noise of a centre as the floor of the residuals. Warming is
// smooth; a loose stylus jumps (step) or scatters from pass to pass (no model leaves little). A jump in the first
// interval looks like warming with a short time constant, and three passes fit everything: then the answer is
// Undecided, on purpose.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace spindrift {

enum class MovementKind {
  Still,      ///< less than the limit
  Warming,    ///< smooth over the passes
  Jump,       ///< sudden between two passes
  Scatter,    ///< from pass to pass, without a course
  Undecided,  ///< the passes cannot tell
};

[[nodiscard]] std::string toString(MovementKind kind);

struct StylusMovement {
  MovementKind kind = MovementKind::Still;
  double largest_um = 0.0;                              ///< largest distance between two passes that follow one another
  double jump_um = 0.0;                                 ///< of a Jump
  int jump_after = -1;                                  ///< index of the pass before it
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of the movement, unit
  double scatter_um = 0.0;                              ///< rms per coordinate about the smooth course
  double bic_smooth = 0.0;
  double bic_step = 0.0;  ///< the better of step and both
};

/// `centre_um`: one per pass, `time_s` increasing. `noise_um`: standard uncertainty of one coordinate of a centre.
/// `limit_um`: movements below it are Still. Fewer than two passes are Still. Throws InternalError if the sizes differ.
[[nodiscard]] StylusMovement judgeMovement(const std::vector<double>& time_s,
                                           const std::vector<Eigen::Vector3d>& centre_um, double noise_um,
                                           double limit_um);

}  // namespace spindrift
