// SPDX-License-Identifier: Apache-2.0
// Random campaigns in which something is hidden: random machine, programme, room and sensors, a given simulation that
// is a little wrong, and one or two causes that it lacks. For studies of the search, which knows none of this.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/simulation/scenario.h"

namespace spindrift {

/// What a campaign of the study hides.
enum class StudyKind {
  One,         ///< one effect of the catalogue
  Two,         ///< two
  Nothing,     ///< the simulation lacks nothing
  Outside,     ///< a cause outside the catalogue
  Confounded,  ///< one effect, and the log lacks what would tell it from others
};

[[nodiscard]] std::string_view toString(StudyKind kind) noexcept;

struct StudyOptions {
  StudyKind kind = StudyKind::One;
  double strength = 4.0;  ///< rms of each hidden signal over the rows to be fitted, main component, in sigma; > 0
  double ar1 = 0.0;       ///< correlation of the noise from one state to the next, [0, 1)
  double parameter_error = 0.01;
  /// Which effect is hidden: the study walks through the catalogue with it, whatever the seed.
  std::size_t turn = 0;
};

struct StudyCase {
  Scenario scenario;
  std::vector<std::string> hidden;
};

/// Deterministic. About 1,100 observations, 36 states over 12 h, 1,440 rows of log.
[[nodiscard]] StudyCase studyCase(const StudyOptions& options, std::uint64_t seed);

/// The ids that a study walks through: all of EFFECTS.md that can be hidden alone (refinements of the dynamics cannot).
[[nodiscard]] const std::vector<std::string>& studyEffects();

}  // namespace spindrift
