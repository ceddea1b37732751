// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A linear scale that follows the room or its own sensor grows away from its datum.
namespace effect_family {

void scale(const CatalogueContext& context, std::vector<Effect>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    const LinearAxis* linear = nullptr;
    for (const LinearAxis& a : context.machine->axes) {
      if (!a.name.empty() && a.name[0] == static_cast<char>('X' + axis)) linear = &a;
    }
    if (linear == nullptr || linear->scale != "linear_scale") continue;
    const double origin = linear->datum_mm.value_or(0.0);
    const auto component = static_cast<Component>(axis);
    Effect effect;
    effect.id = std::string("scale.expansion.") + axis_letters[axis];
    effect.title = "expansion of the %1 scale";
    effect.subject = axis_names[axis];
    effect.formula = fmt::format("e{0} = g q ({0} - {0}0)", axis_letters[axis]);
    effect.references = {references::iso_230_3, references::bryan};
    effect.physics = "The linear scale warms with the room and grows away from its datum; the axis follows the scale.";
    effect.shape = {{"um_per_m", [component, axis, origin](const DeviationQuery& q, Component c) {
                       return c == component ? (q.position_mm[axis] - origin) * 1e-3 : 0.0;
                     }}};
    if (!linear->datum_mm) {
      effect.shape.push_back(constantShape(component));
      effect.free_origin = true;
      effect.origin_low_mm = linear->travel_mm[0] - 500.0;
      effect.origin_high_mm = linear->travel_mm[1] + 500.0;
    }
    const auto sensors = context.drivers->temperatures({scaleRole(axis), SensorRole::Scale, SensorRole::Room});
    addLagVariants(effect, sensors);
    effect.driver_missing = sensors.empty();
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
