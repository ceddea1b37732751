// SPDX-License-Identifier: Apache-2.0
// Hexahedra for a body that is put together from rectangular bricks, as the examples of finite elements need it.
//
// The grid has planes through every side of every brick, and as many between as the largest cell asks for: parts,
// volumes and free faces are the same whatever the size of the cells. A later brick replaces what it overlaps of an
// earlier one; a brick without material is a cavity. All parts share their nodes where they touch (perfect joints).
//
// Lengths mm in the frame of the bricks. Elements are C3D8 of CalculiX and Abaqus; nodes and elements count from 0 here
// and from 1 in a file. Sides 1 ... 6 of an element look along -z, +z, -y, +x, +y, -x.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace spindrift {

struct Brick {
  std::string part;
  std::string material;  ///< empty: a cavity
  Eigen::Vector3d low_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_mm = Eigen::Vector3d::Zero();
};

struct BrickElement {
  std::array<std::size_t, 8> nodes{};  ///< in the order of C3D8
  std::size_t brick = 0;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
};

/// A side of an element that no other element covers.
struct BrickFace {
  std::size_t element = 0;
  int side = 1;
  bool in_cavity = false;  ///< looks into a brick without material
};

class BrickMesh {
 public:
  /// Planes beside those of the bricks, by axis.
  using Planes = std::array<std::vector<double>, 3>;

  /// Throws InputError: a brick of no volume, two planes nearer than 2 mm (they would make needles of elements), a
  /// largest cell that is not positive or gives more than a million cells.
  BrickMesh(std::vector<Brick> bricks, const Planes& further_planes_mm, double largest_cell_mm);

  [[nodiscard]] const std::vector<Brick>& bricks() const noexcept { return bricks_; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& nodes_mm() const noexcept { return nodes_mm_; }
  [[nodiscard]] const std::vector<BrickElement>& elements() const noexcept { return elements_; }
  [[nodiscard]] const std::vector<BrickFace>& freeFaces() const noexcept { return free_faces_; }
  [[nodiscard]] const std::string& partOf(std::size_t element) const { return bricks_[elements_[element].brick].part; }

  /// Nodes of the element at which its side has its four corners.
  [[nodiscard]] static const std::array<std::size_t, 4>& cornersOf(int side);
  /// Middle of a side.
  [[nodiscard]] Eigen::Vector3d centreOf(const BrickFace& face) const;

  /// Nodes and weights (sum 1) of the trilinear interpolation at a place in or on the material. Throws InputError for a
  /// place outside.
  [[nodiscard]] std::vector<std::pair<std::size_t, double>> weightsAt(const Eigen::Vector3d& place_mm) const;

 private:
  using Cell = std::array<int, 3>;

  void makePlanes(const Planes& further_planes_mm, double largest_cell_mm);
  void makeElements();
  void makeFreeFaces();
  [[nodiscard]] int cellCount(std::size_t axis) const { return static_cast<int>(planes_mm_[axis].size()) - 1; }
  [[nodiscard]] std::size_t cellIndex(const Cell& cell) const;
  /// The brick that a cell belongs to; -1: none, also outside the grid.
  [[nodiscard]] int brickOf(const Cell& cell) const;
  [[nodiscard]] bool solid(int brick) const {
    return brick >= 0 && !bricks_[static_cast<std::size_t>(brick)].material.empty();
  }

  std::vector<Brick> bricks_;
  Planes planes_mm_;
  std::vector<int> brick_of_cell_;
  std::vector<int> element_of_cell_;  ///< -1: none
  std::vector<Cell> cells_;           ///< of the elements
  std::vector<Eigen::Vector3d> nodes_mm_;
  std::vector<BrickElement> elements_;
  std::vector<BrickFace> free_faces_;
};

}  // namespace spindrift
