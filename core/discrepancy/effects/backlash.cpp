// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// Play between nut and screw: the axis stops short by the side from which it was approached.
namespace effect_family {

void backlash(const CatalogueContext& context, std::vector<Effect>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!context.varying_approach.contains(axis_letters[axis])) continue;
    const auto component = static_cast<Component>(axis);
    Effect effect;
    effect.id = std::string("backlash.") + axis_letters[axis];
    effect.title = "backlash of %1";
    effect.subject = axis_names[axis];
    effect.formula = fmt::format("e{} = g d, d = +1 or -1 by the side of the approach", axis_letters[axis]);
    effect.references = {references::iso_230_2, references::schwenke};
    effect.physics = "Play between nut and screw: the axis stops on the side from which it came.";
    effect.shape = {{"um", [component, axis](const DeviationQuery& q, Component c) {
                       return c == component ? q.approach[axis] : 0.0;
                     }}};
    effect.variants.push_back({{{"", Dynamics::None}}, false});
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
