// SPDX-License-Identifier: Apache-2.0
// Which nodes of a finite-element result are tool and table, in which unit, at which times: fe.json,
//
//   {"format":"spindrift-finite-elements","version":1,
//    "result":"mech.frd", "mesh":"mesh.inp", "unit_of_displacement":"mm"|"m", "unit_of_length":"mm"|"m",
//    "first_state_s":0, "state_interval_s":900, "mcf_from_mesh":[[..],[..],[..],[..]], "displacement":"U",
//    "components":["EX","EY","EZ","EA"],
//    "points":[{"point":"P1","tool":{"set":"TOOL"},"table":{"nodes":[1,2,3]}}],
//    "each_table_node":{"tool":{"set":"TOOL"},"table":{"set":"TABLE"}},
//    "observe":"observe.csv"}
//
// with exactly one of `points`, `each_table_node` and `observe`. Nodes are {"set"}, {"nodes":[..]} or
// {"nearest_to_mm":[x,y,z] in MCF, "count":4}; {"at_mm":[x,y,z]} beside them carries the displacement to that place.
// `unit_of_length` is that of coordinates; where it is missing that of displacements. `mcf_from_mesh`: 4 x 4 in mm,
// places in MCF from places in the mesh (identity where it is missing). Without `state_interval_s` the times of the
// result are seconds; with it state number k (from 1) is at first_state_s + k state_interval_s. With `first_state_s`
// the state without any displacement stands before all others at that time. `displacement`: name of the array in a VTK
// file. Paths are relative to fe.json.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_reader.h"
#include "core/finite_elements/fe_result.h"
#include "core/geometry/rigid_transform.h"
#include "core/machine/component.h"

namespace spindrift {

inline constexpr std::string_view fe_map_format = "spindrift-finite-elements";

/// Some nodes. Exactly one of the three is given.
struct FeNodes {
  std::string set;
  std::vector<NodeId> nodes;
  std::optional<Eigen::Vector3d> nearest_to_mm;  ///< MCF
  int count = 1;                                 ///< of the nearest
  std::optional<Eigen::Vector3d> at_mm;          ///< MCF; nothing: mean of the nodes

  /// "TOP", "set:TOP", "nodes:1,2,3", "near:x,y,z" or "near:x,y,z,count". Throws InputError.
  [[nodiscard]] static FeNodes parse(std::string_view text);
};

struct FePoint {
  std::string point;
  FeNodes tool;
  FeNodes table;
};

struct FeMap {
  std::filesystem::path file;  ///< of the map itself; empty: from options
  std::filesystem::path result;
  std::filesystem::path mesh;     ///< empty: none
  std::filesystem::path observe;  ///< empty: none
  std::string unit_of_displacement;
  std::string unit_of_length;
  std::optional<double> first_state_s;
  std::optional<double> state_interval_s;
  RigidTransform mcf_from_mesh;
  std::string displacement_array;
  std::vector<Component> components{Component::EX, Component::EY, Component::EZ};
  std::vector<FePoint> points;
  std::optional<FePoint> each_table_node;

  [[nodiscard]] static FeMap read(const std::filesystem::path& file);
  /// Throws InputError: a unit that is not stated, no nodes or two kinds of them.
  void validate() const;
};

}  // namespace spindrift
