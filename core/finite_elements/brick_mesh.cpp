// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/brick_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace spindrift {
namespace {

constexpr double same_plane_mm = 1e-6;
constexpr double nearest_planes_mm = 2.0;

/// Where the eight nodes of an element stand in its cell: the lower plane (0) or the upper (1) of each axis.
constexpr std::array<std::array<int, 3>, 8> corner_offsets{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// Where the neighbour beyond a side stands.
constexpr std::array<std::array<int, 3>, 6> side_directions{
    {{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}};

}  // namespace

BrickMesh::BrickMesh(std::vector<Brick> bricks, const Planes& further_planes_mm, double largest_cell_mm)
    : bricks_(std::move(bricks)) {
  SPINDRIFT_ASSERT(!bricks_.empty(), "a mesh has at least one brick");
  for (const Brick& brick : bricks_) {
    if (!((brick.high_mm - brick.low_mm).minCoeff() > 0.0)) {
      throw InputError(
          fmt::format("The dimensions leave no volume for a brick of {}; allowed: a positive length along x, y and z.",
                      brick.part));
    }
  }
  if (!(largest_cell_mm > 0.0) || !std::isfinite(largest_cell_mm)) {
    throw InputError(fmt::format("A largest cell of {} mm is not allowed; allowed: above 0.", largest_cell_mm));
  }
  makePlanes(further_planes_mm, largest_cell_mm);
  makeElements();
  makeFreeFaces();
}

void BrickMesh::makePlanes(const Planes& further_planes_mm, double largest_cell_mm) {
  double cells = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    std::vector<double> cuts = further_planes_mm[axis];
    for (const Brick& brick : bricks_) {
      cuts.push_back(brick.low_mm[i]);
      cuts.push_back(brick.high_mm[i]);
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end(), [](double a, double b) { return b - a < same_plane_mm; }),
               cuts.end());
    std::vector<double>& planes = planes_mm_[axis];
    planes = {cuts.front()};
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      const double length = cuts[k] - cuts[k - 1];
      if (length < nearest_planes_mm) {
        throw InputError(fmt::format(
            "The dimensions put two faces {:.3g} mm from each other along {}; allowed: the same plane or {} mm and "
            "more.",
            length, "xyz"[axis], nearest_planes_mm));
      }
      const double parts = std::ceil(length / largest_cell_mm - 1e-9);
      if (parts > 1e6) throw InputError(fmt::format("A largest cell of {} mm is too small.", largest_cell_mm));
      const auto count = static_cast<int>(parts);
      for (int part = 1; part < count; ++part) planes.push_back(cuts[k - 1] + length * part / count);
      planes.push_back(cuts[k]);
    }
    cells *= cellCount(axis);
  }
  if (cells > 1e6) {
    throw InputError(
        fmt::format("A largest cell of {} mm gives {:.0f} cells; allowed: a larger one, with at most a million.",
                    largest_cell_mm, cells));
  }
}

std::size_t BrickMesh::cellIndex(const Cell& cell) const {
  return static_cast<std::size_t>(cell[0] + cellCount(0) * (cell[1] + cellCount(1) * cell[2]));
}

int BrickMesh::brickOf(const Cell& cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell[axis] < 0 || cell[axis] >= cellCount(axis)) return -1;
  }
  return brick_of_cell_[cellIndex(cell)];
}

void BrickMesh::makeElements() {
  const std::array<int, 3> nodes_along{cellCount(0) + 1, cellCount(1) + 1, cellCount(2) + 1};
  std::vector<long> node_at(static_cast<std::size_t>(nodes_along[0]) * static_cast<std::size_t>(nodes_along[1]) *
                                static_cast<std::size_t>(nodes_along[2]),
                            -1);
  const auto cell_total = static_cast<std::size_t>(cellCount(0)) * static_cast<std::size_t>(cellCount(1)) *
                          static_cast<std::size_t>(cellCount(2));
  brick_of_cell_.assign(cell_total, -1);
  element_of_cell_.assign(cell_total, -1);
  const auto plane = [&](std::size_t axis, int k) { return planes_mm_[axis][static_cast<std::size_t>(k)]; };
  Cell cell{};
  for (cell[2] = 0; cell[2] < cellCount(2); ++cell[2]) {
    for (cell[1] = 0; cell[1] < cellCount(1); ++cell[1]) {
      for (cell[0] = 0; cell[0] < cellCount(0); ++cell[0]) {
        Eigen::Vector3d centre;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          centre[static_cast<Eigen::Index>(axis)] = 0.5 * (plane(axis, cell[axis]) + plane(axis, cell[axis] + 1));
        }
        for (std::size_t b = bricks_.size(); b-- > 0;) {
          const bool inside =
              (centre.array() > bricks_[b].low_mm.array()).all() && (centre.array() < bricks_[b].high_mm.array()).all();
          if (!inside) continue;
          brick_of_cell_[cellIndex(cell)] = static_cast<int>(b);
          break;
        }
        const int owner = brick_of_cell_[cellIndex(cell)];
        if (!solid(owner)) continue;
        BrickElement element;
        element.brick = static_cast<std::size_t>(owner);
        element.centre_mm = centre;
        for (std::size_t corner = 0; corner < 8; ++corner) {
          std::array<int, 3> at{};
          for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = cell[axis] + corner_offsets[corner][axis];
          long& node = node_at[static_cast<std::size_t>(at[0] + nodes_along[0] * (at[1] + nodes_along[1] * at[2]))];
          if (node < 0) {
            node = static_cast<long>(nodes_mm_.size());
            nodes_mm_.emplace_back(plane(0, at[0]), plane(1, at[1]), plane(2, at[2]));
          }
          element.nodes[corner] = static_cast<std::size_t>(node);
        }
        element_of_cell_[cellIndex(cell)] = static_cast<int>(elements_.size());
        elements_.push_back(element);
        cells_.push_back(cell);
      }
    }
  }
}

void BrickMesh::makeFreeFaces() {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    for (int side = 1; side <= 6; ++side) {
      Cell beyond = cells_[e];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        beyond[axis] += side_directions[static_cast<std::size_t>(side - 1)][axis];
      }
      const int neighbour = brickOf(beyond);
      if (!solid(neighbour)) free_faces_.push_back({e, side, neighbour >= 0});
    }
  }
}

const std::array<std::size_t, 4>& BrickMesh::cornersOf(int side) {
  static constexpr std::array<std::array<std::size_t, 4>, 6> corners{
      {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};
  SPINDRIFT_ASSERT(side >= 1 && side <= 6, "an element has six sides");
  return corners[static_cast<std::size_t>(side - 1)];
}

Eigen::Vector3d BrickMesh::centreOf(const BrickFace& face) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t corner : cornersOf(face.side)) sum += nodes_mm_[elements_[face.element].nodes[corner]];
  return sum / 4.0;
}

std::vector<std::pair<std::size_t, double>> BrickMesh::weightsAt(const Eigen::Vector3d& place_mm) const {
  // On a plane of the grid a cell on either side will do; one of them has to be solid.
  std::array<std::vector<int>, 3> near;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = place_mm[static_cast<Eigen::Index>(axis)];
    const std::vector<double>& planes = planes_mm_[axis];
    for (std::size_t k = 0; k + 1 < planes.size(); ++k) {
      if (at > planes[k] - same_plane_mm && at < planes[k + 1] + same_plane_mm)
        near[axis].push_back(static_cast<int>(k));
    }
  }
  for (const int i : near[0]) {
    for (const int j : near[1]) {
      for (const int k : near[2]) {
        const Cell cell{i, j, k};
        const int e = element_of_cell_[cellIndex(cell)];
        if (e < 0) continue;
        std::array<double, 3> part{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::vector<double>& planes = planes_mm_[axis];
          const auto c = static_cast<std::size_t>(cell[axis]);
          part[axis] = std::clamp((place_mm[static_cast<Eigen::Index>(axis)] - planes[c]) / (planes[c + 1] - planes[c]),
                                  0.0, 1.0);
        }
        std::vector<std::pair<std::size_t, double>> out;
        const BrickElement& element = elements_[static_cast<std::size_t>(e)];
        for (std::size_t corner = 0; corner < 8; ++corner) {
          double weight = 1.0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            weight *= corner_offsets[corner][axis] == 1 ? part[axis] : 1.0 - part[axis];
          }
          if (weight > 1e-12) out.emplace_back(element.nodes[corner], weight);
        }
        return out;
      }
    }
  }
  throw InputError(
      fmt::format("There is no material at ({:.6g}, {:.6g}, {:.6g}) mm of the machine's mesh; allowed: a "
                  "place in or on it.",
                  place_mm.x(), place_mm.y(), place_mm.z()));
}

}  // namespace spindrift
