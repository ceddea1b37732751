// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

namespace spindrift {

// The frame turns as one body about an axis whose place is not known (free origin: one constant per component), and the
// angle between two axes changes when their guideways bend or shift.
void addFrameEffects(const CatalogueContext& context, std::vector<Effect>& out) {
  const auto temperatures = context.drivers->temperatures();
  for (int axis = 0; axis < 3; ++axis) {
    Effect effect;
    effect.id = std::string("frame.rotation.") + std::string(1, static_cast<char>('a' + axis));
    effect.physics =
        "Uneven warming of bed and column turns the machine frame as one body; the deviation grows in proportion to "
        "the "
        "distance from the axis of the turn.";
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto turn = static_cast<Component>(3 + axis);
    effect.shape = {{"urad",
                     [u, v, turn](const DeviationQuery& q, Component c) {
                       if (c == turn) return 1.0;
                       if (static_cast<int>(c) == u) return -q.position_mm[v] * 1e-3;
                       if (static_cast<int>(c) == v) return q.position_mm[u] * 1e-3;
                       return 0.0;
                     }},
                    constantShape(static_cast<Component>(u)),
                    constantShape(static_cast<Component>(v))};
    addLagVariants(effect, temperatures);
    effect.driver_missing = temperatures.empty();
    for (const int w : {u, v}) {
      effect.contains.push_back(std::string("ambient.drift.") + axis_letters[w]);
      effect.contains.push_back(w == 2 ? std::string("spindle.growth.z")
                                       : std::string("spindle.drift.") + axis_letters[w]);
    }
    if (axis < 2) effect.contains.push_back(axis == 0 ? "head.tilt.a" : "head.tilt.b");
    out.push_back(std::move(effect));
  }
  Effect square;
  square.id = "squareness.drift.c0y";
  square.physics =
      "The angle between X and Y changes with the temperature of the guideways: X drifts in proportion to Y.";
  square.shape = {{"urad", [](const DeviationQuery& q,
                              Component c) { return c == Component::EX ? -q.position_mm.y() * 1e-3 : 0.0; }},
                  constantShape(Component::EX)};
  square.contains = {"ambient.drift.x", "spindle.drift.x"};
  addLagVariants(square, temperatures);
  square.driver_missing = temperatures.empty();
  out.push_back(std::move(square));
}

}  // namespace spindrift
