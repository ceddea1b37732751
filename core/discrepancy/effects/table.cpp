// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A warm table grows away from its centre; the tool seems to fall short, so the deviation points to the centre.
namespace effect_family {

void table(const CatalogueContext& context, std::vector<Effect>& out) {
  const DriverTable& drivers = *context.drivers;
  const bool known = context.machine->table_centre_mm.has_value();
  const Eigen::Vector2d centre = context.machine->table_centre_mm.value_or(Eigen::Vector2d::Zero());
  Effect effect;
  effect.id = "table.expansion.xy";
  effect.title = "expansion of the table";
  effect.formula = "ex = -g q (x - xc), ey = -g q (y - yc)";
  effect.references = {references::iso_230_3, references::mayr};
  effect.physics =
      "Guideways, drives and the room heat the table, which grows away from its centre in both directions; measured "
      "points move outwards under the tool.";
  effect.shape = {{"um_per_m", [centre](const DeviationQuery& q, Component c) {
                     if (c == Component::EX) return -(q.position_mm.x() - centre.x()) * 1e-3;
                     if (c == Component::EY) return -(q.position_mm.y() - centre.y()) * 1e-3;
                     return 0.0;
                   }}};
  if (!known) {
    effect.shape.push_back(constantShape(Component::EX));
    effect.shape.push_back(constantShape(Component::EY));
  }
  const auto table = drivers.temperatures({SensorRole::Table});
  addLagVariants(effect, table);
  const auto room = drivers.room();
  addLagVariants(effect, room);
  std::vector<EffectInput> feeds;
  for (const char* name : {"feed_x", "feed_y", "speed_c"}) {
    if (!drivers.has(name)) continue;
    effect.variants.push_back({{{name, Dynamics::Lag}}, false});
    feeds.push_back({name, Dynamics::Lag});
  }
  // Any of them, with the room or without: each can only warm the table, and one that does not is none of its causes.
  for (std::uint32_t choice = 1; choice < (1U << feeds.size()); ++choice) {
    std::vector<EffectInput> inputs;
    for (std::size_t k = 0; k < feeds.size(); ++k)
      if ((choice >> k & 1U) != 0) inputs.push_back(feeds[k]);
    if (inputs.size() > 1) effect.variants.push_back({inputs, true});
    if (room.empty()) continue;
    inputs.push_back({room[0], Dynamics::Lag});
    effect.variants.push_back({std::move(inputs), true});
  }
  effect.sign = 1;
  effect.follows_room = true;
  effect.driver_missing = table.empty();
  out.push_back(std::move(effect));
}

}  // namespace effect_family
}  // namespace spindrift
