// SPDX-License-Identifier: Apache-2.0
// Displacements of nodes over time, as a finite-element program left them. Coordinates and displacements are in the
// unit and the frame of the mesh; FeMap (fe_map.h) says which.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace spindrift {

using NodeId = long;
/// Numbers of nodes come as text and are whole up to here.
inline constexpr double largest_node = 1e15;

/// Nodes with their places, and sets of nodes by name. Either may be unknown to a result (a .dat has no places, a .frd
/// no sets) and come from the mesh.
struct FeMesh {
  std::unordered_map<NodeId, Eigen::Vector3d> nodes;
  std::map<std::string, std::vector<NodeId>> sets;  ///< names in capitals, as the solvers take them

  /// Adds what `other` knows and this does not.
  void complete(const FeMesh& other);
};

/// One state.
struct FeState {
  double time = 0.0;  ///< as the file says: seconds, or the number of a step
  std::unordered_map<NodeId, Eigen::Vector3d> displacement;
};

/// A result file. Reads what is asked for, so that a large file does not stand in memory as a whole.
class FeResultReader {
 public:
  virtual ~FeResultReader() = default;
  /// Throws InputError.
  [[nodiscard]] virtual FeMesh mesh() const = 0;
  /// All states in the order of the file, with the displacements of `wanted` as far as the file has them. Throws
  /// InputError: no displacements, a block that is cut off, what is no number.
  [[nodiscard]] virtual std::vector<FeState> states(const std::set<NodeId>& wanted) const = 0;
};

/// Opens a result by its ending.
using FeReaderFactory = std::function<std::unique_ptr<FeResultReader>(const std::filesystem::path& file)>;

/// CalculiX: ".frd" (ASCII) and ".dat". Throws InputError for any other.
[[nodiscard]] std::unique_ptr<FeResultReader> openFeResult(const std::filesystem::path& file);

[[nodiscard]] std::unique_ptr<FeResultReader> openFrd(const std::filesystem::path& file);
[[nodiscard]] std::unique_ptr<FeResultReader> openDat(const std::filesystem::path& file);

/// Nodes and node sets of an input file of CalculiX or Abaqus (*NODE, *NSET with GENERATE and sets of sets, *INCLUDE).
/// Throws InputError.
[[nodiscard]] FeMesh readAbaqusMesh(const std::filesystem::path& file);

/// A name as it is looked up: capitals, no blanks around.
[[nodiscard]] std::string setName(std::string_view name);

}  // namespace spindrift
