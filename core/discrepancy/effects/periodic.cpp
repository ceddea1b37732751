// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A screw whose pitch error repeats every turn: amplitude and phase (sine and cosine), growing with the heat of the
// screw. A steady error is a constant of each point and shows only where positions change.
namespace effect_family {

void periodic(const CatalogueContext& context, std::vector<Effect>& out) {
  const auto& drivers = *context.drivers;
  for (int axis = 0; axis < 3; ++axis) {
    const LinearAxis* linear = nullptr;
    for (const LinearAxis& a : context.machine->axes) {
      if (!a.name.empty() && a.name[0] == static_cast<char>('X' + axis)) linear = &a;
    }
    if (linear == nullptr || !linear->pitch_mm) continue;
    const double k = 2.0 * 3.14159265358979323846 / *linear->pitch_mm;
    const auto component = static_cast<Component>(axis);
    Effect effect;
    effect.id = std::string("periodic.pitch.") + axis_letters[axis];
    effect.title = "periodic error of the %1 ball screw";
    effect.subject = axis_names[axis];
    effect.formula = fmt::format("e{0} = g q sin(2 pi {0} / pitch) + g' q cos(2 pi {0} / pitch)", axis_letters[axis]);
    effect.references = {references::iso_230_2, references::schwenke};
    effect.physics = "The pitch error of the screw repeats with every turn and changes as the screw warms.";
    effect.shape = {{"um_sin",
                     [component, axis, k](const DeviationQuery& q, Component c) {
                       return c == component ? std::sin(k * q.position_mm[axis]) : 0.0;
                     }},
                    {"um_cos", [component, axis, k](const DeviationQuery& q, Component c) {
                       return c == component ? std::cos(k * q.position_mm[axis]) : 0.0;
                     }}};
    const std::string feed = std::string("feed_") + axis_letters[axis];
    if (drivers.has(feed)) {
      addLagVariants(effect, {feed});
      for (const std::string& room : drivers.room()) {
        effect.variants.push_back({{{feed, Dynamics::Lag}, {room, Dynamics::Lag}}, true});
      }
    }
    addLagVariants(effect, drivers.temperatures({SensorRole::Room, screwRole(axis), SensorRole::Screw}));
    if (context.position_varies) effect.variants.push_back({{{"", Dynamics::None}}, false});
    effect.follows_room = true;
    effect.driver_missing = !drivers.has(feed);
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
