// SPDX-License-Identifier: Apache-2.0
// A scan compressed into small cells.
//
// The surface of an artefact is a smooth height map z = h(x, y) seen on a near-regular grid. Within a cell of some
// tenths of a millimetre nothing is lost when the points are replaced by their mean, because the mean of h over the
// points of a cell is h(mean) + 1/2 tr(H S) up to terms of fourth order (S: second central moments of the points, H:
// second derivatives). The points of one cell are thinned of outliers against a local plane. Costs one pass over the
// points.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scanning/cloud.h"

namespace spindrift {

/// The points of one cell. mm.
struct SurfaceCell {
  double count = 0.0;                               ///< points used; 0: the cell is empty or was rejected
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();   ///< of the points used
  double sxx = 0.0, sxy = 0.0, syy = 0.0;           ///< second central moments of x, y
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< of the plane through the points
  double variance = 0.0;                            ///< of single points about that plane (mm^2)
};

/// A rectangular lattice of cells; cell (column, row) has its centre at low + ((column, row) + 1/2) * size.
struct CellGrid {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Ones();
  int columns = 0;
  int rows = 0;
  std::vector<SurfaceCell> cells;  ///< row major
  std::size_t point_count = 0;     ///< points used
  std::size_t rejected_points = 0;
  std::size_t stray_points = 0;  ///< of those: far outside the scan in x or y
  double noise_mm = 0.0;         ///< typical standard deviation of a point about the plane of its cell
  Eigen::Vector3d centroid_mm = Eigen::Vector3d::Zero();  ///< of the points used

  [[nodiscard]] const SurfaceCell& at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  [[nodiscard]] std::size_t filledCells() const noexcept;
};

struct CellGridOptions {
  Eigen::Vector2d cell_mm = Eigen::Vector2d::Zero();  ///< 0: from the spacing of the points
  double outlier_threshold = 6.0;                     ///< robust standard deviations
  bool checked = false;                               ///< the cloud has passed requireUsableCloud()
};

/// Size of cell that suits a cloud: at least two profiles and four points along the profile, some 6 (small clouds) to
/// 32 points in all.
[[nodiscard]] Eigen::Vector2d suitableCell_mm(const PointCloud& cloud);

/// Throws InputError if the cloud is so sparse or so large that it cannot be a height map.
[[nodiscard]] CellGrid compressCloud(const PointCloud& cloud, const CellGridOptions& options = {});

}  // namespace spindrift
