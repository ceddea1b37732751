// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A head that is warmer on one side turns about a pivot; the nose moves by the lever from the pivot to the tool point.
// The levers are not in the machine file, so they are free, as long as a head may be: gains of the turn (urad) and of
// the two displacements (um). Where the Z axis is a ram between pivot and tool, the vertical lever changes with z: a
// turn that carries its displacement in proportion to z along.
namespace effect_family {

void head(const CatalogueContext& context, std::vector<Effect>& out) {
  const std::vector<std::string> heat = context.drivers->spindleHeat();
  const bool ram = context.machine->chain.movesTool("Z");
  for (int axis = 0; axis < 2; ++axis) {
    Effect tilt;
    tilt.id = axis == 0 ? "head.tilt.a" : "head.tilt.b";
    tilt.title = "tilt of the head about %1";
    tilt.subject = axis_names[axis];
    tilt.formula = axis == 0 ? "EA = g q, ey = -g q rz, ez = g q ry" : "EB = g q, ex = g q rz, ez = -g q rx";
    tilt.references = {references::abele, references::mayr};
    tilt.physics =
        "Spindle heat warms one side of the head more than the other; the head tilts about a pivot and carries the "
        "tool point with it, sideways and in height.";
    const Component turn = axis == 0 ? Component::EA : Component::EB;
    const Component side = axis == 0 ? Component::EY : Component::EX;
    const double sign = axis == 0 ? -1.0 : 1.0;
    tilt.shape = {constantShape(side),
                  constantShape(Component::EZ),
                  {"urad", [turn](const DeviationQuery&, Component c) { return c == turn ? 1.0 : 0.0; }}};
    constexpr double longest_lever_m = 1.5;
    tilt.largest_ratio = {longest_lever_m, longest_lever_m, 0.0};
    tilt.ratio_to = {2};
    if (ram) {
      // Its lever is counted from z = 0.
      const LinearAxis* z = context.machine->findAxis("Z");
      if (z != nullptr)
        for (double& lever_m : tilt.largest_ratio) lever_m += lever_m > 0.0 ? 1e-3 * std::abs(z->travel_mm[1]) : 0.0;
      tilt.largest_ratio.push_back(0.0);
      tilt.ratio_to.push_back(3);
      tilt.shape.push_back({"urad_ram", [turn, side, sign](const DeviationQuery& q, Component c) {
                              if (c == side) return sign * q.position_mm.z() * 1e-3;
                              return c == turn ? 1.0 : 0.0;
                            }});
    }
    addLagVariants(tilt, heat);
    tilt.follows_room = true;
    tilt.driver_missing = heat.empty();
    out.push_back(tilt);
  }
}

}  // namespace effect_family
}  // namespace spindrift
