// SPDX-License-Identifier: Apache-2.0
// What a model would make a control command, and the tables controls read.
//
// Compensation = -deviation (FORMATS.md): where the tool is +5 um too far in X, the control adds -5 um to X. Four
// forms:
//   grid            corrections of X, Y, Z at nodes of the working space (CSV)
//   ISO 230-1       the six component errors of one axis along its travel, through a reference position (CSV); these
//   are
//                   DEVIATIONS, as ISO 230-1 defines them, not corrections
//   LinuxCNC        screw compensation of one axis: "nominal forward reverse" per line, COMP_FILE_TYPE = 0. Forward and
//                   reverse are the positions where the axis really is at `nominal`; LinuxCNC itself subtracts.
//   Siemens         measuring system error compensation (MSEC, $AA_ENC_COMP) of one axis, mm. The value is added to the
//                   position that the control reads, so that a positive one moves the axis in the negative direction
//                   (SINUMERIK 840D sl, Extended Functions, K3): it is the deviation itself, zero at the reference.
// Tables of further controls: control_tables.h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/machine_description.h"

namespace spindrift {

struct CompensationGridOptions {
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();
  std::array<int, 3> nodes{5, 5, 2};  ///< per axis, >= 1; 1 means only `from_mm`

  /// The whole travel of the machine's X, Y and Z.
  [[nodiscard]] static CompensationGridOptions travelOf(const MachineDescription& machine);
  /// Throws InputError.
  void validate() const;
};

/// The box of the places where something was measured, and which displacements were. A table says what lies outside the
/// box, and states nothing of an axis along which it has no extent or of a displacement that was not measured.
struct MeasuredBox {
  /// What a probe or a table scatters about one place is no extent.
  static constexpr double least_extent_mm = 1.0;

  Eigen::Vector3d low_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_mm = Eigen::Vector3d::Zero();
  std::array<bool, 3> displacement{true, true, true};  ///< EX, EY, EZ
  std::vector<Eigen::Vector3d> places_mm = {};         ///< none: the whole box

  [[nodiscard]] bool contains(const Eigen::Vector3d& position_mm) const noexcept {
    constexpr double slack_mm = 1e-6;
    return ((position_mm - low_mm).array() >= -slack_mm).all() && ((high_mm - position_mm).array() >= -slack_mm).all();
  }
  /// Between the places: in their hull, or within least_extent_mm of it.
  [[nodiscard]] bool surrounds(const Eigen::Vector3d& position_mm) const;
  [[nodiscard]] bool extendsAlong(int axis) const noexcept { return high_mm[axis] - low_mm[axis] >= least_extent_mm; }
  /// "measured from 0 to 400 mm; beyond that extrapolated", for the head of a file: what a control does with it does
  /// not know the page that it came from.
  [[nodiscard]] std::string extentAlong(int axis) const;
};

struct CompensationNode {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d correction_um = Eigen::Vector3d::Zero();  ///< to add to the command: minus the predicted deviation
  Eigen::Vector3d sigma_um = Eigen::Vector3d::Zero();       ///< expected error that remains, one standard uncertainty
};

[[nodiscard]] std::vector<CompensationNode> compensationGrid(const ErrorModel& model,
                                                             const CompensationGridOptions& options,
                                                             const DeviationQuery& conditions);
/// x_mm,y_mm,z_mm,correction_x_um,correction_y_um,correction_z_um,sigma_x_um,sigma_y_um,sigma_z_um; with `measured`
/// also extrapolated: 1 for a node that it does not surround; and empty fields for a displacement that was not
/// measured.
[[nodiscard]] std::string compensationGridCsv(const std::vector<CompensationNode>& nodes,
                                              const std::optional<MeasuredBox>& measured = {});

/// Component errors of one linear axis along its travel, the others at `reference_mm`, relative to the reference
/// position: the uncertainty is that of this difference, zero at the reference itself.
struct AxisComponentTable {
  std::string axis;
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();  ///< through which its line passes
  std::vector<double> position_mm;
  /// E<X|Y|Z|A|B|C><axis>: um and urad, one row per position.
  std::vector<std::array<double, 6>> deviation;
  std::vector<std::array<double, 6>> sigma;
};

/// `axis` must be X, Y or Z of the machine; `count` >= 2 positions over its travel. Throws InputError.
[[nodiscard]] AxisComponentTable axisComponents(const ErrorModel& model, const MachineDescription& machine,
                                                const std::string& axis, const Eigen::Vector3d& reference_mm, int count,
                                                const DeviationQuery& conditions);
/// The same at positions along the axis, which may lie beyond its travel: the first and the last have there
/// what makes a straight line to their neighbour right at the end of the travel.
[[nodiscard]] AxisComponentTable axisComponentsAt(const ErrorModel& model, const MachineDescription& machine,
                                                  const std::string& axis, const Eigen::Vector3d& reference_mm,
                                                  const std::vector<double>& position_mm,
                                                  const DeviationQuery& conditions);
/// Which of the six errors of the table are known: measured along the axis, of a displacement that was measured, and
/// held by the model (neither it nor its uncertainty is zero all along the axis).
[[nodiscard]] std::array<bool, 6> knownErrors(const AxisComponentTable& table,
                                              const std::optional<MeasuredBox>& measured);
/// position_mm,EXX_um,EYX_um,EZX_um,EAX_urad,EBX_urad,ECX_urad and sigma_ of each; with `measured` also extrapolated,
/// and empty fields (said in a comment) where nothing was measured along the axis, for a displacement that was not
/// measured, and for an error that the model knows nothing of (it and its uncertainty are zero all along the axis).
[[nodiscard]] std::string axisComponentsCsv(const AxisComponentTable& table,
                                            const std::optional<MeasuredBox>& measured = {});

/// What COMP_FILE_TYPE of LinuxCNC says of the numbers behind the nominal position.
enum class LinuxcncTable {
  ActualPositions = 0,  ///< nominal + deviation: the control subtracts
  Trim = 1,             ///< minus the deviation: added to the motor's command
};

/// LinuxCNC screw compensation file for the positioning error of the table's axis (mm, at most 256 lines). Forward and
/// reverse are the same unless the model tells the directions of approach apart (backlash).
[[nodiscard]] std::string linuxcncCompensation(const ErrorModel& model, const MachineDescription& machine,
                                               const std::string& axis, const Eigen::Vector3d& reference_mm, int count,
                                               const DeviationQuery& conditions,
                                               LinuxcncTable table = LinuxcncTable::ActualPositions);

/// Siemens MSEC table of the positioning error of the table's axis as `%_N_<axis>_EEC_INI`, the machine axis named as
/// X1, Y1 or Z1; the mean of both directions of approach, relative to the deviation at `reference_mm`. It stands in
/// place of a table that the control already has: its values have to be added.
[[nodiscard]] std::string siemensCompensation(const ErrorModel& model, const MachineDescription& machine,
                                              const std::string& axis, const Eigen::Vector3d& reference_mm, int count,
                                              const DeviationQuery& conditions,
                                              const std::optional<MeasuredBox>& measured = {});

}  // namespace spindrift
