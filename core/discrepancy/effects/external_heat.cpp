// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

namespace spindrift {

// Sun through a window, an open door, a radiator: heat that no log shows, from an unknown time on and for an unknown
// time. It bends the column as a temperature difference does, or lifts the head.
void addExternalHeatEffects(const CatalogueContext& context, std::vector<Effect>& out) {
  for (int kind = 0; kind < 3; ++kind) {
    if (kind < 2 && !context.machine->column_base_mm) continue;
    const double base = context.machine->column_base_mm.value_or(0.0);
    Effect effect;
    effect.id = std::string("external_heat.") + (kind == 0 ? "a" : kind == 1 ? "b" : "z");
    effect.physics =
        "Heat from outside (sun, door, radiator) warms one side of the machine for a while; nothing in the log shows "
        "it.";
    if (kind == 2) {
      effect.shape = {constantShape(Component::EZ)};
    } else {
      const Component side = kind == 0 ? Component::EY : Component::EX;
      const Component turn = kind == 0 ? Component::EA : Component::EB;
      const double sign = kind == 0 ? -1.0 : 1.0;
      effect.shape = {{"um_per_m2", [side, turn, sign, base](const DeviationQuery& q, Component c) {
                         const double h = (q.position_mm.z() - base) * 1e-3;
                         if (c == side) return sign * 0.5 * h * h;
                         return c == turn ? h : 0.0;
                       }}};
    }
    effect.variants.push_back({{{"", Dynamics::Pulse}}, false});
    out.push_back(std::move(effect));
  }
}

}  // namespace spindrift
