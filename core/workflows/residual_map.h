// SPDX-License-Identifier: Apache-2.0
// Measured minus model over the table at one moment with the table at one angle: the values at the points and the field
// between them.
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

/// When a component was measured, s, and the angle of the table, deg: points at another angle are elsewhere on it.
struct ResidualMoment {
  double time_s = 0.0;
  double c_deg = 0.0;
  [[nodiscard]] bool operator==(const ResidualMoment&) const = default;
};

/// The moments at which a component was measured, in order of time, then of angle; readings of one thermal state at one
/// angle are one moment.
[[nodiscard]] std::vector<ResidualMoment> momentsOf(const DiscrepancyStory& story, Component component);
/// The moment at which measured and simulated are furthest apart; an index of `momentsOf`.
[[nodiscard]] std::size_t worstMoment(const DiscrepancyStory& story, Component component);
/// Measured minus model at the points alone. `after`: with what was added.
[[nodiscard]] std::vector<Field::Marker> residualsAt(const DiscrepancyStory& story, Component component,
                                                     const ResidualMoment& moment, bool after);
/// The same with the field between the points. Plane: the mean height of the points, over the travel of X and Y.
[[nodiscard]] ResidualMap residualMap(const DiscrepancyStory& story, const MachineDescription& machine,
                                      Component component, const ResidualMoment& moment, bool after);

}  // namespace spindrift
