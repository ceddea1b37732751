// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// An instrument that was just switched on warms itself and drifts towards its steady state, whatever the machine does.
namespace effect_family {

void instrument(const CatalogueContext& context, std::vector<Effect>& out) {
  const bool logged = context.drivers->has("instrument_on");
  for (int axis = 0; axis < 3; ++axis) {
    Effect effect;
    effect.id = std::string("instrument.warm_up.") + axis_letters[axis];
    effect.title = "warm-up of the instrument along %1";
    effect.subject = axis_names[axis];
    effect.formula = fmt::format("e{} = g (1 - exp(-t / tau))", axis_letters[axis]);
    effect.references = {references::iso_230_3};
    effect.physics =
        "The measuring instrument warms itself after it was switched on and drifts to its steady state; the machine "
        "has no "
        "part in it.";
    effect.of_machine = false;
    effect.two_lags = true;
    effect.shape = {constantShape(static_cast<Component>(axis))};
    // Not logged: taken as switched on when the log starts.
    if (logged) addLagVariants(effect, {"instrument_on"});
    if (context.drivers->has(assumed_instrument)) addLagVariants(effect, {std::string(assumed_instrument)});
    effect.driver_missing = effect.variants.empty();
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
