// SPDX-License-Identifier: Apache-2.0
// The catalogue of effects (EFFECTS.md) for one machine, one log and the points measured. One file per family in
// core/discrepancy/effects.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/discrepancy/drivers.h"
#include "core/machine/effect.h"

namespace spindrift {

/// What decides which effects are admissible.
struct CatalogueContext {
  const MachineDescription* machine = nullptr;
  const DriverTable* drivers = nullptr;
  std::vector<std::string> points;         ///< points of the observations that may slip alone
  std::size_t point_count = 0;             ///< all points
  std::set<std::string> varying_approach;  ///< "x", "y", "z": axes approached from both sides
  bool c_varies = false;                   ///< the table turns
  bool position_varies = false;            ///< positions change within a series
};

/// All effects that this machine can have. An effect without variants has no driver in the log: it cannot be fitted,
/// but it can still be what is missing.
[[nodiscard]] std::vector<Effect> effectCatalogue(const CatalogueContext& context);

// The families, each appending its effects.
void addSpindleEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addHeadEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addColumnEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addBallScrewEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addScaleEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addTableEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addFrameEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addCrossbeamEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addAmbientEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addInstrumentEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addFixtureEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addPeriodicEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addBacklashEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addCoolantEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addExternalHeatEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addHeatSourceEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addRotaryEffects(const CatalogueContext& context, std::vector<Effect>& out);
void addArtefactEffects(const CatalogueContext& context, std::vector<Effect>& out);

// Helpers for the families.
inline constexpr const char* axis_letters[3] = {"x", "y", "z"};
/// 1 in one component, 0 elsewhere.
[[nodiscard]] ShapeColumn constantShape(Component component, double sign = 1.0);
/// Bending of a column about its base by a turn about X (`axis` 0) or Y (1), um for 1 um/m^2: sideways with the square
/// of the height, the turn in proportion to it, and where the head overhangs its lift (EFFECTS.md, column.bending). An
/// overhang that is not known is a column of its own, at most 1 m.
void addBendingShape(const MachineDescription& machine, int axis, Effect& effect);
/// One single-input variant per driver through a lag.
void addLagVariants(Effect& effect, const std::vector<std::string>& drivers);

}  // namespace spindrift
