// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A clamped part or target slips once and stays where it went: one point, one time.
namespace effect_family {

void fixture(const CatalogueContext& context, std::vector<Effect>& out) {
  if (std::max(context.point_count, context.points.size()) < 2) return;
  for (const std::string& point : context.points) {
    Effect effect;
    effect.id = "fixture.slip." + point;
    effect.title = "slip of point %1 in its fixture";
    effect.subject = point;
    effect.formula = "(ex, ey, ez) = (gx, gy, gz) q, of one point";
    effect.physics = "The fixture of this point slipped once and stayed where it went.";
    for (int axis = 0; axis < 3; ++axis) {
      const auto component = static_cast<Component>(axis);
      effect.shape.push_back(
          {std::string("um_") + axis_letters[axis], [point, component](const DeviationQuery& q, Component c) {
             return c == component && q.point == point ? 1.0 : 0.0;
           }});
    }
    effect.variants.push_back({{{"", Dynamics::Step}}, false});
    out.push_back(std::move(effect));
  }
}

}  // namespace effect_family
}  // namespace spindrift
