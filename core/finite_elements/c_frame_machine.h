// SPDX-License-Identifier: Apache-2.0
// The body of the finite-element example machine: a vertical machining centre with a C-frame, 600 x 400 x 450 mm of
// travel, of hollow grey iron castings. The table travels along X on a saddle, the saddle along Y on the bed, the head
// along Z on the front of the column: V [w-X'-Y'-b-Z-t].
//
// Frame of the mesh: axes as in MCF, origin where the axis of the spindle meets the top of the table in the meshed pose
// (table in the middle of its travels). A place in MCF is a place in the mesh plus half the travels along X and Y.
//
// Deviation at the commanded position (x, y, z), from the displacements u of ONE pose (small motions, all linear in u):
//
//   tool  = carriage where it stands for z, as a lever to the tip + the head's own change, tip minus carriage, as
//   meshed table = u at the place of the table's top that is under the tool + its turn there x the height z of the
//   target
//           + turn of the saddle's guideways x travel along X + turn of the bed's guideways x travel along Y
//
// EX, EY, EZ = tool - table; EA, EB = turn of carriage and spindle - turn of the table's top. Displacement and turn of
// a guideway are the rigid motion that fits its points best, so that a rigid motion of the whole machine is no
// deviation. Scales are taken not to expand and the 110 mm of tool not to warm up.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/finite_elements/brick_mesh.h"
#include "core/machine/component.h"

namespace spindrift {

/// Sizes of the castings, mm. Heights count from the top of the table; depths from the axis of the spindle, towards the
/// operator (front) or the column (rear).
struct CFrameDimensions {
  double bed_half_width_mm = 400.0;
  double bed_front_mm = 400.0;  ///< front of the bed before the spindle
  double bed_rear_mm = 90.0;    ///< rear of the bed behind the column
  double bed_height_mm = 480.0;
  double bed_wall_mm = 60.0;
  double saddle_height_mm = 160.0;
  double table_half_length_mm = 450.0;
  double table_half_width_mm = 230.0;
  double table_thickness_mm = 110.0;
  double table_rim_mm = 60.0;  ///< dry, at the front and the rear of the table
  double column_half_width_mm = 250.0;
  double column_front_mm = 330.0;  ///< guideways of the head behind the axis of the spindle
  double column_depth_mm = 380.0;
  double column_top_mm = 1180.0;
  double column_wall_mm = 50.0;
  double head_half_width_mm = 140.0;
  double head_front_mm = 150.0;
  double head_bottom_mm = 200.0;
  double head_top_mm = 620.0;
  double head_duct_front_mm = 115.0;  ///< the hollow of the head, behind the spindle
  double head_duct_rear_mm = 265.0;
  double spindle_half_width_mm = 60.0;  ///< spindle with its cartridge, a square of the same section
  double nose_mm = 160.0;
  double front_bearing_mm = 90.0;  ///< length of the bearing zones
  double rear_bearing_mm = 60.0;
  double motor_height_mm = 180.0;  ///< on top of the spindle
  double tool_length_mm = 110.0;
  double guide_half_width_mm = 200.0;  ///< of the column's guideways, from the middle
  double carriage_half_length_mm = 150.0;

  [[nodiscard]] double bedRear_mm() const { return column_front_mm + column_depth_mm + bed_rear_mm; }
  [[nodiscard]] double tip_mm() const { return nose_mm - tool_length_mm; }
  [[nodiscard]] double carriage_mm() const { return 0.5 * (head_bottom_mm + head_top_mm); }
};

/// Travels, mm: MCF runs from 0 to these.
inline constexpr std::array<double, 3> c_frame_travel_mm{600.0, 400.0, 450.0};

/// Free faces that one side of the elements of a set makes up; a load of the deck names set and side.
struct CFrameFaces {
  int side = 1;
  bool in_cavity = false;
  std::vector<std::size_t> elements;
};

struct CFramePoint {
  std::string id;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< MCF
  bool rotations = false;                                 ///< EA and EB are observed as well
};

/// One component at one point: deviation = 1000 x sum of weight x displacement in mm, um or urad.
struct CFrameObserved {
  std::string point;
  Component component = Component::EX;
  std::map<std::pair<std::size_t, int>, double> weights;  ///< by node (from 0) and direction 0, 1, 2
};

class CFrameMachine {
 public:
  /// Throws InputError: see BrickMesh; points or guideways beyond the material.
  CFrameMachine(const CFrameDimensions& dimensions, double largest_cell_mm);

  [[nodiscard]] const CFrameDimensions& dimensions() const noexcept { return dimensions_; }
  [[nodiscard]] const BrickMesh& mesh() const noexcept { return mesh_; }
  /// By name of the set: "BED_3", "COLUMN_IN_4" (in a cavity), "SUN_3" (front of the column above the table), "WET_2"
  /// (middle of the table). Every free face stands in exactly one.
  [[nodiscard]] const std::map<std::string, CFrameFaces>& faces() const noexcept { return faces_; }
  /// Elements of a part: BED, SADDLE, TABLE, COLUMN, HEAD, SPINDLE, BEARING, MOTOR.
  [[nodiscard]] std::vector<std::size_t> elementsOf(const std::string& part) const;
  [[nodiscard]] const std::vector<CFrameObserved>& observed() const noexcept { return observed_; }
  /// Nodes that `observed` needs, in rising order.
  [[nodiscard]] std::vector<std::size_t> observedNodes() const;
  /// Two feet at the front of the bed and one at its rear: with three, two and one of their directions held the bed
  /// stands without any stress from the floor.
  [[nodiscard]] std::array<std::size_t, 3> feet() const;
  /// mesh.inp: nodes and elements by material, sets of faces, BEARING and MOTOR, the node set OBSERVED.
  [[nodiscard]] std::string meshText() const;

 private:
  void groupFaces();
  void observe();

  CFrameDimensions dimensions_;
  BrickMesh mesh_;
  std::map<std::string, CFrameFaces> faces_;
  std::vector<CFrameObserved> observed_;
};

/// Five points near the table and five 300 mm above it.
[[nodiscard]] const std::vector<CFramePoint>& cFramePoints();

}  // namespace spindrift
