// SPDX-License-Identifier: Apache-2.0
// Which effect holds which as a special case, computed from shapes and drivers. Internal to core/discrepancy.
//
// A holds B when every shape column of B is a combination of those of A at the places looked at, and A can be driven as
// B is: by the same drivers through the same dynamics or ones that include them (a lag includes none at all, a lag with
// two time constants includes one with one, a pulse that does not end is a step), others beside them or not. Where each
// holds the other they are one effect under two names: no data can tell them apart.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/machine/effect.h"

namespace spindrift {

struct EffectRelations {
  /// Indices of the effects that each holds, without those that are the same.
  std::vector<std::vector<std::size_t>> holds;
  std::vector<std::pair<std::size_t, std::size_t>> same;
};

/// `shapes` of the effects at any places: one row for every place and component. `any_way`: A also holds B if only one
/// of the ways in which B is driven is one of A's, unless B holds A in the same sense.
[[nodiscard]] EffectRelations effectRelations(const std::vector<Effect>& effects,
                                              const std::vector<Eigen::MatrixXd>& shapes, bool any_way);

}  // namespace spindrift
