// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

namespace spindrift {

// The spindle heats the part of the structure where the head stands. The same heat then moves the tool more or less,
// depending on where the head stood meanwhile: heat x (position - s0), with s0 free (a second column of plain heat).
void addHeatSourceEffects(const CatalogueContext& context, std::vector<Effect>& out) {
  for (int axis = 0; axis < 3; ++axis) {
    Effect effect;
    effect.id = std::string("heat_source.position.") + axis_letters[axis];
    effect.physics =
        "Spindle heat enters the structure where the head stands; the same heat moves the tool more or less, depending "
        "on "
        "where the head stood while it was heated.";
    effect.shape = {constantShape(static_cast<Component>(axis))};
    for (const char* logged : {"x", "y", "z"}) {
      for (const char* power : {"1", "1.5", "2"}) {
        const std::string heat = std::string("spindle_rpm^") + power;
        const std::string product = heat + "*pos_" + logged;
        if (context.drivers->has(product)) {
          effect.variants.push_back({{{product, Dynamics::Lag}, {heat, Dynamics::Lag}}, true});
        }
      }
    }
    effect.driver_missing = effect.variants.empty();
    effect.contains = {axis == 2 ? std::string("spindle.growth.z")
                                 : std::string("spindle.drift.") + axis_letters[axis]};
    out.push_back(std::move(effect));
  }
}

}  // namespace spindrift
