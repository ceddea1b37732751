// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// Friction in nut and bearings heats the screw in proportion to the mean absolute feed, and the screw follows the room.
// It grows away from the fixed bearing p0. Where the nut travels the screw is warmer, so the growth is not quite
// linear.
namespace effect_family {

void ball_screw(const CatalogueContext& context, std::vector<Effect>& out) {
  const DriverTable& drivers = *context.drivers;
  const auto room = drivers.room();
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter = axis_letters[axis];
    const auto screw = drivers.temperatures({screwRole(axis), SensorRole::Screw});
    const LinearAxis* linear = nullptr;
    for (const LinearAxis& a : context.machine->axes) {
      if (!a.name.empty() && a.name[0] == static_cast<char>('X' + axis)) linear = &a;
    }
    if (linear == nullptr || linear->drive_type == "linear_motor") continue;
    const bool known = linear->fixed_bearing_mm.has_value();
    const double origin = linear->fixed_bearing_mm.value_or(0.0);
    const std::string feed = "feed_" + letter;
    for (const bool uniform : {true, false}) {
      Effect effect;
      effect.id = (uniform ? "ball_screw.expansion." : "ball_screw.nonuniform.") + letter;
      effect.title = uniform ? "thermal expansion of the %1 ball screw" : "non-uniform expansion of the %1 ball screw";
      effect.subject = axis_names[axis];
      effect.formula =
          uniform ? fmt::format("e{0} = g q ({0} - {0}0)", letter) : fmt::format("e{0} = g q ({0} - {0}0)^2", letter);
      effect.references = {references::heisel, references::mayr};
      effect.physics =
          uniform
              ? "Feed motion and the room heat the ball screw; it grows away from its fixed bearing and takes the nut "
                "with it."
              : "The ball screw is warmer where the nut travels, so its growth rises faster than in proportion to the "
                "distance from the fixed bearing. Where the simulation has the mean temperature of the screw, what is "
                "left "
                "vanishes at both ends of the travel.";
      const auto component = static_cast<Component>(axis);
      effect.shape = {{uniform ? "um_per_m" : "um_per_m2",
                       [component, axis, origin, uniform](const DeviationQuery& q, Component c) {
                         if (c != component) return 0.0;
                         const double p = (q.position_mm[axis] - origin) * 1e-3;
                         return uniform ? p : p * p;
                       }}};
      // A simulation that has the screw at its mean temperature has its far end where it is: what is left vanishes at
      // both ends.
      if (!uniform && known) {
        const double far_mm = std::abs(linear->travel_mm[1] - origin) > std::abs(linear->travel_mm[0] - origin)
                                  ? linear->travel_mm[1]
                                  : linear->travel_mm[0];
        effect.shape.push_back({"um_per_m", [component, axis, origin](const DeviationQuery& q, Component c) {
                                  return c == component ? (q.position_mm[axis] - origin) * 1e-3 : 0.0;
                                }});
        effect.forms = {{1.0, 0.0}, {1.0, -(far_mm - origin) * 1e-3}};
      }
      // About another origin the square has a slope as well, and then holds the uniform screw.
      if (!uniform && !known) {
        effect.contains.push_back("ball_screw.expansion." + letter);
        effect.shape.push_back({"um_per_m", [component, axis, origin](const DeviationQuery& q, Component c) {
                                  return c == component ? (q.position_mm[axis] - origin) * 1e-3 : 0.0;
                                }});
      }
      if (!known) {
        effect.shape.push_back(constantShape(component));
        effect.free_origin = uniform;
        effect.origin_low_mm = linear->travel_mm[0] - 500.0;
        effect.origin_high_mm = linear->travel_mm[1] + 500.0;
      }
      if (drivers.has(feed)) {
        effect.variants.push_back({{{feed, Dynamics::Lag}}, false});
        // A linear scale follows the room by itself; a screw beside it has to show the heat of its own motion.
        if (linear->scale != "linear_scale") {
          // One body: what its motion heats follows the room at the same pace, more or less.
          for (const bool shared : {true, false}) {
            for (const std::string& r : room) {
              effect.variants.push_back({{{feed, Dynamics::Lag}, {r, Dynamics::Lag}}, shared});
            }
          }
        }
      }
      // The room alone moves no screw whose own motion is known to heat it.
      if (linear->scale != "linear_scale" && !drivers.has(feed)) addLagVariants(effect, room);
      effect.follows_room = linear->scale == "linear_scale";
      addLagVariants(effect, screw);
      effect.driver_missing = !drivers.has(feed);
      effect.refinement = !uniform;
      effect.two_lags = uniform;
      out.push_back(std::move(effect));
    }
  }
}

}  // namespace effect_family
}  // namespace spindrift
