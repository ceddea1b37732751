// SPDX-License-Identifier: Apache-2.0
// Measured minus model over the table at one moment: the values at the points and the field between them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/machine_description.h"
#include "core/workflows/discrepancy_story.h"

namespace spindrift {

struct ResidualMap {
  std::vector<Field::Marker> points;   ///< um or urad, with the noise as sigma
  std::shared_ptr<const Field> field;  ///< null with fewer than three points
};

/// The moments at which a component was measured, s, increasing; readings of one thermal state are one moment.
[[nodiscard]] std::vector<double> momentsOf(const DiscrepancyStory& story, Component component);
/// The moment at which measured and simulated are furthest apart; an index of `momentsOf`.
[[nodiscard]] std::size_t worstMoment(const DiscrepancyStory& story, Component component);
/// Measured minus model at the points alone. `after`: with what was added.
[[nodiscard]] std::vector<Field::Marker> residualsAt(const DiscrepancyStory& story, Component component, double time_s,
                                                     bool after);
/// The same with the field between the points. Plane: the mean height of the points, over the travel of X and Y.
[[nodiscard]] ResidualMap residualMap(const DiscrepancyStory& story, const MachineDescription& machine,
                                      Component component, double time_s, bool after);

}  // namespace spindrift
