// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "core/discrepancy/catalogue.h"

namespace spindrift {
namespace {

/// How far from the datum an axis about which the frame turns can lie along X, Y or Z, m: the machine itself and its
/// foundation. What turns about a point further off is a displacement that all points share.
std::array<double, 3> farthestTurningPoint(const MachineDescription& machine) {
  constexpr double least_beside_m = 2.0;
  constexpr double travels_beside = 2.0;
  double longest_mm = 0.0;
  for (const LinearAxis& axis : machine.axes) longest_mm = std::max(longest_mm, axis.travel_mm[1] - axis.travel_mm[0]);
  const double beside_m = std::max(least_beside_m, travels_beside * longest_mm * 1e-3);
  std::array<double, 3> out{};
  for (std::size_t k = 0; k < out.size(); ++k) {
    const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[k]));
    const double end_mm = axis == nullptr ? 0.0 : std::max(std::abs(axis->travel_mm[0]), std::abs(axis->travel_mm[1]));
    out[k] = end_mm * 1e-3 + beside_m;
  }
  return out;
}

}  // namespace

// The frame turns as one body about an axis whose place is not known (one constant per component, as large as an axis
// within the machine makes it), and the angle between two axes changes when their guideways bend or shift.
namespace effect_family {

void frame(const CatalogueContext& context, std::vector<Effect>& out) {
  const auto temperatures = context.drivers->temperatures();
  const std::array<double, 3> farthest_m = farthestTurningPoint(*context.machine);
  for (int axis = 0; axis < 3; ++axis) {
    Effect effect;
    effect.id = std::string("frame.rotation.") + std::string(1, static_cast<char>('a' + axis));
    effect.title = "rotation of the frame about %1";
    effect.subject = axis_names[axis];
    effect.formula = "(ex, ey, ez) = g q n x (p - p0), n along the axis of the turn";
    effect.references = {references::iso_230_1, references::schwenke};
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
    // Without the rotation the displacements alone say little of where the axis is.
    if (context.rotations)
      effect.largest_ratio = {0.0, farthest_m[static_cast<std::size_t>(v)], farthest_m[static_cast<std::size_t>(u)]};
    addLagVariants(effect, temperatures);
    effect.driver_missing = temperatures.empty();
    out.push_back(std::move(effect));
  }
  Effect square;
  square.id = "squareness.drift.c0y";
  square.title = "drift of the squareness of Y to X";
  square.formula = "ex = -g q (y - y0)";
  square.references = {references::iso_230_1, references::schwenke};
  square.physics =
      "The angle between X and Y changes with the temperature of the guideways: X drifts in proportion to Y.";
  square.shape = {{"urad", [](const DeviationQuery& q,
                              Component c) { return c == Component::EX ? -q.position_mm.y() * 1e-3 : 0.0; }},
                  constantShape(Component::EX)};
  addLagVariants(square, temperatures);
  square.driver_missing = temperatures.empty();
  out.push_back(std::move(square));
}

}  // namespace effect_family
}  // namespace spindrift
