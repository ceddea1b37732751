// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A cross beam that is warmer on top than below sags between its ends as a parabola; the head that travels on it sinks
// and turns with the slope.
namespace effect_family {

void crossbeam(const CatalogueContext& context, std::vector<Effect>& out) {
  if (!context.machine->crossbeam) return;
  const Crossbeam& beam = *context.machine->crossbeam;
  const int axis = beam.axis.empty() || beam.axis[0] != 'X' ? 1 : 0;
  const double from = beam.from_mm;
  const double span = beam.to_mm - beam.from_mm;
  const Component turn = axis == 1 ? Component::EA : Component::EB;
  const double sign = axis == 1 ? 1.0 : -1.0;
  Effect effect;
  effect.id = "crossbeam.sag.z";
  effect.title = "sag of the crossbeam";
  effect.formula = "ez = 4 g q s (1 - s), s = (y - y1) / (y2 - y1); EA = slope of ez along y";
  effect.references = {references::timoshenko, references::mayr};
  effect.physics =
      "The beam warms unevenly over its height and sags between its ends; the head that travels on it follows the "
      "parabola and turns with its slope.";
  effect.shape = {{"um", [axis, from, span, turn, sign](const DeviationQuery& q, Component c) {
                     const double s = (q.position_mm[axis] - from) / span;
                     if (c == Component::EZ) return 4.0 * s * (1.0 - s);
                     return c == turn ? sign * 4.0 * (1.0 - 2.0 * s) / span * 1e3 : 0.0;
                   }}};
  const auto& drivers = *context.drivers;
  std::vector<std::string> names;
  const std::string feed = axis == 1 ? "feed_y" : "feed_x";
  if (drivers.has(feed)) names.push_back(feed);
  for (const std::string& name : drivers.temperatures({SensorRole::Crossbeam, SensorRole::Room})) names.push_back(name);
  addLagVariants(effect, names);
  const auto room = drivers.room();
  if (drivers.has(feed) && !room.empty()) {
    effect.variants.push_back({{{feed, Dynamics::Lag}, {room[0], Dynamics::Lag}}, false});
  }
  effect.follows_room = true;
  effect.driver_missing = !drivers.has(feed) && drivers.temperatures({SensorRole::Crossbeam}).empty();
  out.push_back(std::move(effect));
}

}  // namespace effect_family
}  // namespace spindrift
