// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

namespace spindrift {

// Sun through a window, an open door, a radiator: heat that no log shows, from an unknown time on and for an unknown
// time. It bends the column as a temperature difference does, or lifts the head.
namespace effect_family {

void external_heat(const CatalogueContext& context, std::vector<Effect>& out) {
  for (int kind = 0; kind < 3; ++kind) {
    if (kind < 2 && !context.machine->column_base_mm) continue;
    Effect effect;
    effect.id = std::string("external_heat.") + (kind == 0 ? "a" : kind == 1 ? "b" : "z");
    effect.title = kind == 0   ? "column bending towards Y by an external heat source"
                   : kind == 1 ? "column bending towards X by an external heat source"
                               : "displacement along Z by an external heat source";
    effect.formula = kind == 0   ? "ey = -g q (z - z0)^2 / 2, EA = g q (z - z0), ez = EA ry"
                     : kind == 1 ? "ex = g q (z - z0)^2 / 2, EB = g q (z - z0), ez = -EB rx"
                                 : "ez = g q";
    effect.references = {references::iso_230_3, references::bryan};
    effect.physics =
        "Heat from outside (sun, door, radiator) warms one side of the machine for a while; nothing in the log shows "
        "it.";
    if (kind == 2) {
      effect.shape = {constantShape(Component::EZ)};
    } else {
      addBendingShape(*context.machine, kind, effect);
    }
    effect.variants.push_back({{{"", Dynamics::Pulse}}, false});
    // Castings take minutes to take up heat through their surface: what jumps is no heat.
    effect.least_lag_s = 180.0;
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
