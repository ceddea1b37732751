// SPDX-License-Identifier: Apache-2.0
// Random campaigns in which something is hidden: random machine, programme, room and points, a given simulation that
// is a little wrong, and causes that it lacks. For studies of the search, which knows none of this.
//
// Machine, sensors, programme, room, places, times and noise follow from the seed alone. What is hidden is drawn apart,
// among what the campaign of that seed can have: some campaigns measure rotations, some work at one place all day, some
// turn the table, and only these can hide what is not to be seen otherwise.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/simulation/scenario.h"
#include "core/simulation/study_conditions.h"
#include "core/simulation/virtual_campaign.h"

namespace spindrift {

/// What a campaign of the study hides.
enum class StudyKind {
  One,         ///< one effect of the catalogue
  Two,         ///< two
  Three,       ///< three of different families, each 0.8 ... 1.2 times the strength
  Nothing,     ///< the simulation lacks nothing
  Outside,     ///< a cause outside the catalogue
  Confounded,  ///< one effect, and the log lacks what would tell it from others
};

[[nodiscard]] std::string_view toString(StudyKind kind) noexcept;

struct StudyOptions {
  StudyKind kind = StudyKind::One;
  double strength = 4.0;  ///< rms of each hidden signal over the rows to be fitted, main component, in real sigma; > 0
  double ar1 = 0.0;       ///< correlation of the noise from one state to the next, [0, 1)
  double parameter_error = 0.01;
  StudyConditions conditions;
  /// Which of the effects that the campaign can have is hidden (modulo their number).
  std::size_t turn = 0;
  std::vector<std::string> hide;  ///< in place of a draw; must be among hideable(seed)
};

struct StudyCase {
  Scenario scenario;
  std::vector<std::string> hidden;
  StudyConditions conditions;
  double strength = 0.0;
  double ar1 = 0.0;
};

/// Deterministic. About 1,100 observations, 36 states over 12 h, 1,440 rows of log.
[[nodiscard]] StudyCase studyCase(const StudyOptions& options, std::uint64_t seed);

/// The campaign of a case, under its conditions.
struct StudyCampaign {
  VirtualCampaign campaign;
  AppliedConditions applied;
};
[[nodiscard]] StudyCampaign simulateStudy(const StudyCase& study_case, const JobContext& job);

/// The ids that a study draws from: all of EFFECTS.md that can be hidden alone (refinements of the dynamics cannot);
/// `fixture.slip` stands for any point.
[[nodiscard]] const std::vector<std::string>& studyEffects();
/// Those that the campaign of a seed can hide.
[[nodiscard]] std::vector<std::string> hideable(std::uint64_t seed);

}  // namespace spindrift
