// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// The spindle heats the part of the structure where the head stands. The same heat then lifts the tool more or less,
// depending on where that axis stood meanwhile: heat x (position - s0), with s0 free (a second column of plain heat).
namespace effect_family {

void heat_source(const CatalogueContext& context, std::vector<Effect>& out) {
  for (const char* letter : axis_letters) {
    Effect effect;
    effect.id = std::string("heat_source.position.") + letter;
    effect.title = "spindle heat that depends on the position of %1";
    effect.subject = std::string(1, static_cast<char>(letter[0] - 'a' + 'A'));
    effect.formula = fmt::format("ez = g q, q driven by heat x ({} - s0)", letter);
    effect.references = {references::mayr};
    effect.physics =
        "Spindle heat enters the structure where the head stands; the same heat moves the tool along Z more or less, "
        "depending on where this axis stood while it was heated.";
    effect.shape = {constantShape(Component::EZ)};
    for (const char* power : {"1", "1.5", "2"}) {
      const std::string heat = std::string("spindle_rpm^") + power;
      const std::string product = heat + "*pos_" + letter;
      if (context.drivers->has(product)) {
        effect.variants.push_back({{{product, Dynamics::Lag}, {heat, Dynamics::Lag}}, true});
      }
    }
    effect.driver_missing = effect.variants.empty();
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
