// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A rotary table that its drive heats shifts, tilts and grows about the C centre. The deviation of the tool relative to
// the table is minus the movement of the point of the table.
namespace effect_family {

void rotary(const CatalogueContext& context, std::vector<Effect>& out) {
  if (context.machine->rotary.empty() && !context.c_varies) return;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  if (!context.machine->rotary.empty()) {
    centre = context.machine->rotary.front().centre_mm;
    for (const RotaryAxis& axis : context.machine->rotary) {
      if (!axis.name.empty() && axis.name[0] == 'C') centre = axis.centre_mm;
    }
  } else if (context.machine->table_centre_mm) {
    centre.head<2>() = *context.machine->table_centre_mm;
  }
  const DriverTable& drivers = *context.drivers;
  std::vector<std::string> names;
  if (drivers.has("speed_c")) names.emplace_back("speed_c");
  for (const std::string& name : drivers.temperatures({SensorRole::Table})) names.push_back(name);
  const bool missing = names.empty();
  const auto add = [&](const std::string& id, const std::string& title, const std::string& formula,
                       const std::string& physics, const std::string& unit, ShapeFunction shape, int sign) {
    Effect effect;
    effect.id = id;
    effect.title = title;
    effect.formula = formula;
    effect.references = {references::iso_230_1, references::ibaraki_knapp};
    effect.physics = physics;
    effect.shape = {{unit, std::move(shape)}};
    addLagVariants(effect, names);
    effect.sign = sign;
    effect.driver_missing = missing;
    out.push_back(std::move(effect));
  };
  const char* drift_ids[3] = {"rotary.drift.x0c", "rotary.drift.y0c", "rotary.drift.z0t"};
  const char* tilt_ids[3] = {"rotary.tilt.a0c", "rotary.tilt.b0c", "rotary.tilt.c0c"};
  for (int axis = 0; axis < 3; ++axis) {
    const auto component = static_cast<Component>(axis);
    add(
        drift_ids[axis], fmt::format("drift of the rotary table along {}", axis_names[axis]),
        fmt::format("e{} = -g q", axis_letters[axis]),
        "The drive of the rotary table heats its bearing and shifts the table.", "um",
        [component](const DeviationQuery&, Component c) { return c == component ? -1.0 : 0.0; }, 0);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto turn = static_cast<Component>(3 + axis);
    add(
        tilt_ids[axis],
        fmt::format("{} of the rotary table about {}", axis == 2 ? "rotation" : "tilt", axis_names[axis]),
        "(ex, ey, ez) = -g q n x (p - C centre), n along the axis of the turn",
        "The rotary table warms unevenly and rotates about its centre.", "urad",
        [u, v, turn, centre](const DeviationQuery& q, Component c) {
          if (c == turn) return -1.0;
          if (static_cast<int>(c) == u) return (q.position_mm[v] - centre[v]) * 1e-3;
          if (static_cast<int>(c) == v) return -(q.position_mm[u] - centre[u]) * 1e-3;
          return 0.0;
        },
        0);
  }
  add(
      "rotary.expansion.r0t", "radial growth of the rotary table", "ex = -g q (x - xc), ey = -g q (y - yc)",
      "The rotary table warms and grows away from its centre.", "um_per_m",
      [centre](const DeviationQuery& q, Component c) {
        if (c == Component::EX) return -(q.position_mm.x() - centre.x()) * 1e-3;
        if (c == Component::EY) return -(q.position_mm.y() - centre.y()) * 1e-3;
        return 0.0;
      },
      1);
}

}  // namespace effect_family
}  // namespace spindrift
