// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// The whole machine follows the room and shifts the tool against the table, the same everywhere.
namespace effect_family {

void ambient(const CatalogueContext& context, std::vector<Effect>& out) {
  const auto room = context.drivers->room();
  for (int axis = 0; axis < 3; ++axis) {
    Effect effect;
    effect.id = std::string("ambient.drift.") + axis_letters[axis];
    effect.title = "environmental temperature variation error along %1";
    effect.subject = axis_names[axis];
    effect.formula = fmt::format("e{} = g q", axis_letters[axis]);
    effect.references = {references::iso_230_3, references::bryan};
    effect.physics =
        "The structure follows the temperature of the room and shifts the tool, the same at every position.";
    effect.shape = {constantShape(static_cast<Component>(axis))};
    addLagVariants(effect, room);
    effect.always_driven = true;
    effect.driver_missing = context.drivers->temperatures({SensorRole::Room}).empty();
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
