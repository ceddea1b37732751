// SPDX-License-Identifier: Apache-2.0
// The catalogue of effects (EFFECTS.md) for one machine, one log and the points measured. One file per family in
// core/discrepancy/effects says everything about its effects: id, title, physics, drivers, shape, references.
#pragma once

#include <set>
#include <span>
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
  bool rotations = true;                   ///< rotations are measured, not displacements alone
};

/// All effects that this machine can have. An effect without variants has no driver in the log: it cannot be fitted,
/// but it can still be what is missing.
[[nodiscard]] std::vector<Effect> effectCatalogue(const CatalogueContext& context);

/// A family of effects: appends those that the machine can have. Each file of core/discrepancy/effects holds one,
/// effect_family::<name of the file>, and is found by being there; nothing else names it. Which effect holds which is
/// computed (effect_relations.h).
using EffectFamily = void (*)(const CatalogueContext& context, std::vector<Effect>& out);
[[nodiscard]] std::span<const EffectFamily> effectFamilies();

/// Every effect that a machine can have, whatever its log holds: as if it logged everything and every sensor were
/// there. `points` may slip. What each holds is of observations that measure rotations as well.
[[nodiscard]] std::vector<Effect> effectsOfMachine(const MachineDescription& machine,
                                                   const std::vector<std::string>& points);

/// Every effect of the catalogue, as a machine has it that can have them all and logs everything; the point of
/// fixture.slip is "<point>". What each holds is of observations that measure rotations as well.
[[nodiscard]] const std::vector<Effect>& everyEffect();

/// For an effect that has forms one for each of them in its place, under its id, with one
/// shape column. The data choose among them.
[[nodiscard]] std::vector<Effect> formsApart(std::vector<Effect> effects);

// Helpers for the families.
inline constexpr const char* axis_letters[3] = {"x", "y", "z"};
inline constexpr const char* axis_names[3] = {"X", "Y", "Z"};
/// 1 in one component, 0 elsewhere.
[[nodiscard]] ShapeColumn constantShape(Component component, double sign = 1.0);
/// Bending of a column about its base by a turn about X (`axis` 0) or Y (1), um for 1 um/m^2: sideways with the square
/// of the height, the turn in proportion to it, and where the head overhangs its lift (EFFECTS.md, column.bending). An
/// overhang that is not known is a column of its own, at most 1 m.
void addBendingShape(const MachineDescription& machine, int axis, Effect& effect);
/// One single-input variant per driver through a lag.
void addLagVariants(Effect& effect, const std::vector<std::string>& drivers);

namespace references {

inline constexpr const char* iso_230_1 =
    "ISO 230-1:2012, Geometric accuracy of machines operating under no-load or "
    "quasi-static conditions";
inline constexpr const char* iso_230_2 = "ISO 230-2:2014, Determination of accuracy and repeatability of positioning";
inline constexpr const char* iso_230_3 = "ISO 230-3:2020, Determination of thermal effects";
inline constexpr const char* bryan = "J. Bryan 1990, International status of thermal error research, CIRP Annals 39/2";
inline constexpr const char* mayr = "J. Mayr et al. 2012, Thermal issues in machine tools, CIRP Annals 61/2";
inline constexpr const char* schwenke =
    "H. Schwenke et al. 2008, Geometric error measurement and compensation of "
    "machines, CIRP Annals 57/2";
inline constexpr const char* ibaraki_knapp =
    "S. Ibaraki, W. Knapp 2012, Indirect measurement of volumetric accuracy "
    "for three-axis and five-axis machine tools, Int. J. Automation Technology 6/2";
inline constexpr const char* abele =
    "E. Abele, Y. Altintas, C. Brecher 2010, Machine tool spindle units, CIRP Annals 59/2";
inline constexpr const char* harris = "T. A. Harris, M. N. Kotzalas 2006, Rolling bearing analysis, 5th edition";
inline constexpr const char* heisel =
    "U. Heisel et al. 2006, Thermography-based investigation into thermally induced "
    "positioning errors of feed drives, CIRP Annals 55/1";
inline constexpr const char* timoshenko = "S. Timoshenko 1925, Analysis of bi-metal thermostats, J. Opt. Soc. Am. 11/3";

}  // namespace references
}  // namespace spindrift
