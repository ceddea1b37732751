// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/catalogue.h"

namespace spindrift {

// A column that is warmer at the front than at the rear bends backwards like a beam clamped at its base z0: the head on
// it turns in proportion to the height and moves with the square of it. A column that warms as a whole grows.
void addBendingShape(const MachineDescription& machine, int axis, Effect& effect) {
  const double base = *machine.column_base_mm;
  const Component side = axis == 0 ? Component::EY : Component::EX;
  const Component turn = axis == 0 ? Component::EA : Component::EB;
  const double sign = axis == 0 ? -1.0 : 1.0;
  // a: ez = EA ry; b: ez = -EB rx
  std::optional<double> lever_m;
  if (machine.column_overhang_mm) {
    lever_m = (axis == 0 ? machine.column_overhang_mm->y() : -machine.column_overhang_mm->x()) * 1e-3;
  }
  // um for 1 K: gain in um/m^2.
  effect.shape = {
      {"um_per_m2", [side, turn, sign, base, lever = lever_m.value_or(0.0)](const DeviationQuery& q, Component c) {
         const double h = (q.position_mm.z() - base) * 1e-3;
         if (c == side) return sign * 0.5 * h * h;
         if (c == Component::EZ) return h * lever;
         return c == turn ? h : 0.0;
       }}};
  if (lever_m) return;
  constexpr double longest_overhang_m = 1.0;
  effect.shape.push_back({"um_per_m_lift", [base](const DeviationQuery& q, Component c) {
                            return c == Component::EZ ? (q.position_mm.z() - base) * 1e-3 : 0.0;
                          }});
  effect.largest_ratio = {0.0, longest_overhang_m};
}

namespace effect_family {

void column(const CatalogueContext& context, std::vector<Effect>& out) {
  const DriverTable& drivers = *context.drivers;
  // Where it is not stated its height is free: what a shifted one adds is the constant that belongs to the growth.
  const double base = context.machine->column_base_mm.value_or(0.0);
  const auto room = drivers.room();
  const auto column = drivers.temperatures({SensorRole::ColumnFront, SensorRole::ColumnRear, SensorRole::ColumnLeft,
                                            SensorRole::ColumnRight, SensorRole::Column});
  std::vector<std::string> growth_drivers = column;
  for (const std::string& name : drivers.spindleHeat()) growth_drivers.push_back(name);
  for (const std::string& name : room) growth_drivers.push_back(name);
  for (int axis = 0; axis < 2 && context.machine->column_base_mm; ++axis) {
    Effect bending;
    bending.id = axis == 0 ? "column.bending.a" : "column.bending.b";
    bending.title = axis == 0 ? "bending of the column towards Y" : "bending of the column towards X";
    bending.formula = axis == 0 ? "ey = -g q (z - z0)^2 / 2, EA = g q (z - z0), ez = EA ry"
                                : "ex = g q (z - z0)^2 / 2, EB = g q (z - z0), ez = -EB rx";
    bending.references = {references::timoshenko, references::mayr};
    bending.physics =
        "A temperature difference across the column bends it about its base: the deviation grows with the square of "
        "the "
        "height above the base, the rotation in proportion to it.";
    addBendingShape(*context.machine, axis, bending);
    // Front minus rear turns the column about X, left minus right about Y. Where the sensors of those sides are
    // missing, others of the column may stand for them.
    const char* across = axis == 0 ? "column_difference" : "column_side_difference";
    const char* other = axis == 0 ? "column_side_difference" : "column_difference";
    std::vector<std::string> bending_drivers;
    if (drivers.has(across)) {
      bending_drivers.emplace_back(across);
    } else if (drivers.has(other)) {
      bending_drivers.emplace_back(other);
    } else {
      bending_drivers = column;
    }
    for (const std::string& name : drivers.spindleHeat()) bending_drivers.push_back(name);
    for (const std::string& name : room) bending_drivers.push_back(name);
    addLagVariants(bending, bending_drivers);
    bending.follows_room = true;
    bending.driver_missing = !drivers.has(across);
    out.push_back(bending);
  }
  Effect growth;
  growth.id = "column.expansion.z";
  growth.title = "expansion of the column along Z";
  growth.formula = "ez = g q (z - z0) + g' q";
  growth.references = {references::bryan, references::mayr};
  growth.physics =
      "The column warms as a whole and grows from its base: the head rises, more so the higher it stands on the "
      "column.";
  growth.shape = {
      {"um_per_m", [base](const DeviationQuery& q,
                          Component c) { return c == Component::EZ ? (q.position_mm.z() - base) * 1e-3 : 0.0; }},
      constantShape(Component::EZ)};
  addLagVariants(growth, growth_drivers);
  growth.follows_room = true;
  growth.driver_missing = column.empty();
  out.push_back(growth);
}

}  // namespace effect_family
}  // namespace spindrift
