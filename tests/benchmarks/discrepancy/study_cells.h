// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of the study and what is demanded of the search in each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/simulation/study_campaigns.h"

namespace spindrift::study {

/// Cases that are judged together: the rows of the table of targets.
enum class Row {
  OneCondition,  ///< one effect, each condition alone
  OneTogether,   ///< one effect, all of it
  Three,
  Nothing,
  Outside,
  CleanStrong,  ///< one effect, 4-8 times the noise
  Clean15,
  Clean08,
  SlowNoise,
  Two,
  Confounded,
};

/// Rates (0 ... 1) that the search is to reach. Nothing hidden: `right` is the verdict `none`. Outside the catalogue:
/// `right` is that nothing is named.
struct Target {
  Row row = Row::OneCondition;
  std::string name;
  double right = 0.0;
  double at_least_two = 0.0;  ///< of three
  double wrong = 1.0;         ///< at most
};
[[nodiscard]] const std::vector<Target>& targets();

struct Cell {
  std::string name;
  Row row = Row::OneCondition;
  StudyKind kind = StudyKind::One;
  double strength = 6.0;  ///< times the real sigma
  double ar1 = 0.0;
  StudyConditions conditions;
  int share = 4;        ///< of the campaigns of a run
  int short_count = 0;  ///< campaigns in the short study
};
[[nodiscard]] const std::vector<Cell>& cells();

}  // namespace spindrift::study
