// SPDX-License-Identifier: Apache-2.0
// The bodies of the virtual machine as finite volumes, and their temperatures over a campaign.
//
// Spindle (two bearings, shaft, housing), head (upper and lower side), column (four walls in height), three ball screws
// (nut, fixed bearing, cells along the screw), scales, table (a grid), crossbeam (upper and lower flange), pedestal,
// bed, rotary drive, artefact. Heat enters where it is made (heat_sources.h); it leaves by convection that depends on
// motion and by conduction into the neighbour. Two runs share everything but the sources: `heated` and `passive` (the
// same machine standing still in the same room); their difference is what the machine's own heat does. Temperatures
// degC, lengths mm (heat flow in W, J/K, m inside).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/machine_description.h"
#include "core/simulation/environment.h"
#include "core/simulation/heat_sources.h"
#include "core/simulation/programme.h"

namespace spindrift {

/// The character of one machine. Multipliers are 1 for the standard machine; a given simulation whose parameters are a
/// little wrong is the same machine with slightly different numbers. All > 0.
struct PlantParameters {
  double friction = 1.0;          ///< of the spindle bearings and motor
  double screw_friction = 1.0;    ///< of nuts and screw bearings
  double convection = 1.0;        ///< of every surface
  double convection_speed = 1.0;  ///< how much motion adds to convection; 0 switches it off
  double spindle_mass = 1.0;      ///< heat capacity of spindle and head
  double structure_mass = 1.0;    ///< heat capacity of column, table, bed, beam
  double screw_mass = 1.0;
  double conduction = 1.0;
  double expansion = 1.0;  ///< coefficient of expansion of everything
};

/// A row of equal volumes along one direction.
struct RodIndex {
  int first = -1;
  int count = 0;
  double from_mm = 0.0;  ///< coordinate of the beginning of the first cell
  double to_mm = 0.0;
  [[nodiscard]] double cell_mm() const { return (to_mm - from_mm) / count; }
};

/// Which volume is which.
struct BodyIndex {
  int room = -1, ground = -1, coolant = -1;
  int front_bearing = -1, rear_bearing = -1;
  RodIndex shaft, housing;         ///< 0 = nose
  RodIndex head_top, head_bottom;  ///< 0 = at the column
  std::array<RodIndex, 4> column;  ///< front, rear, left, right; 0 = base
  std::array<RodIndex, 3> screw;   ///< along the axis coordinate
  std::array<int, 3> nut{-1, -1, -1};
  std::array<int, 3> screw_bearing{-1, -1, -1};
  std::array<int, 3> scale{-1, -1, -1};
  int table = -1;  ///< first of table_cells x table_cells, x fastest
  RodIndex beam_top, beam_bottom;
  RodIndex pedestal;
  int bed = -1;
  int rotary_drive = -1, rotary_hub = -1;
  RodIndex artefact;  ///< millimetres from the reference feature
  static constexpr int table_cells = 6;
  double table_from_x_mm = 0.0, table_to_x_mm = 0.0, table_from_y_mm = 0.0, table_to_y_mm = 0.0;
};

/// Temperatures of all volumes at regular times.
class TemperatureHistory {
 public:
  TemperatureHistory() = default;
  TemperatureHistory(std::size_t nodes, double step_s) : nodes_(nodes), step_s_(step_s) {}
  void append(const std::vector<double>& temperatures);
  /// Linear between the samples; the first and last value hold outside.
  [[nodiscard]] double at(int node, double time_s) const;
  [[nodiscard]] double initial(int node) const { return values_[static_cast<std::size_t>(node)]; }
  /// Change since the start.
  [[nodiscard]] double rise(int node, double time_s) const { return at(node, time_s) - initial(node); }
  /// Mean change of a row of cells.
  [[nodiscard]] double meanRise(const RodIndex& rod, double time_s) const;

 private:
  std::size_t nodes_ = 0;
  double step_s_ = 30.0;
  std::vector<double> values_;
};

struct ThermalRun {
  BodyIndex bodies;
  TemperatureHistory heated;
  TemperatureHistory passive;
};

/// Runs the machine through its programme from equilibrium with the room. Deterministic.
[[nodiscard]] ThermalRun runThermal(const MachineDescription& machine, const Programme& programme,
                                    const Environment& environment, const PlantParameters& parameters,
                                    double duration_s, const JobContext& job = {});

/// The same step by step, where the programme is not known beforehand: a machine that is driven by a control.
class ThermalStepper {
 public:
  ThermalStepper(const MachineDescription& machine, const Environment& environment, const PlantParameters& parameters);
  ~ThermalStepper();
  ThermalStepper(const ThermalStepper&) = delete;
  ThermalStepper& operator=(const ThermalStepper&) = delete;
  static constexpr double step_s = 30.0;
  /// One step of `step_s` with these speeds.
  void step(const ProgrammeSegment& now);
  /// What there is so far.
  [[nodiscard]] const ThermalRun& run() const noexcept;
  [[nodiscard]] ThermalRun take() &&;
  [[nodiscard]] double time_s() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Temperature that a sensor at `place` reads: a weighted set of volumes. Places: "front bearing", "rear bearing",
/// "shaft", "spindle housing", "head top", "head bottom", "column front", "column rear", "column left", "column right",
/// "table", "screw x", "nut x", "screw bearing x", "scale x" (y, z), "crossbeam top", "crossbeam bottom", "pedestal",
/// "bed", "rotary drive", "artefact", "coolant", "room"; a row takes a position along it: "column front@0.25" (0 ...
/// 1). Throws InputError naming the allowed places.
[[nodiscard]] std::vector<int> volumesAt(const BodyIndex& bodies, std::string_view place, const SourcePlace& where);

}  // namespace spindrift
