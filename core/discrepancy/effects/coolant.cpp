// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// Coolant cools or warms the structure while it runs; the response may be quicker while it flows than after it stopped.
namespace effect_family {

void coolant(const CatalogueContext& context, std::vector<Effect>& out) {
  const bool logged = context.drivers->has("coolant");
  for (int axis = 0; axis < 3; ++axis) {
    Effect effect;
    effect.id = std::string("coolant.shock.") + axis_letters[axis];
    effect.title = "thermal shock from coolant along %1";
    effect.subject = axis_names[axis];
    effect.formula = fmt::format("e{} = g q", axis_letters[axis]);
    effect.references = {references::mayr};
    effect.physics =
        "Coolant changes the temperature of table and structure while it flows; the tool shifts and comes back when it "
        "stops, not always at the same pace.";
    effect.shape = {constantShape(static_cast<Component>(axis))};
    if (logged) {
      addLagVariants(effect, {"coolant"});
      // Coolant of a temperature of its own cools the more, the warmer the room is.
      for (const std::string& room : context.drivers->room()) {
        const std::string product = "coolant*" + room;
        if (!context.drivers->has(product)) continue;
        effect.variants.push_back({{{"coolant", Dynamics::Lag}, {product, Dynamics::Lag}}, true});
        effect.variants.push_back({{{"coolant", Dynamics::AsymmetricLag}, {product, Dynamics::AsymmetricLag}}, true});
      }
      effect.variants.push_back({{{"coolant", Dynamics::AsymmetricLag}}, false});
    } else {
      // Not logged: on for one unknown span of time.
      effect.variants.push_back({{{"", Dynamics::Pulse}}, false});
    }
    effect.driver_missing = !logged;
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
