// SPDX-License-Identifier: Apache-2.0
// A scan compressed into small cells, and a smooth surface through them.
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
  double noise_mm = 0.0;  ///< typical standard deviation of a point about the plane of its cell
  Eigen::Vector3d centroid_mm = Eigen::Vector3d::Zero();  ///< of the points used

  [[nodiscard]] const SurfaceCell& at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
  [[nodiscard]] std::size_t filledCells() const noexcept;
};

struct CellGridOptions {
  Eigen::Vector2d cell_mm = Eigen::Vector2d::Zero();  ///< 0: from the spacing of the points
  double outlier_threshold = 6.0;                     ///< robust standard deviations
};

/// Size of cell that suits a cloud: at least two profiles and four points along the profile, some 6 (small clouds) to
/// 32 points in all.
[[nodiscard]] Eigen::Vector2d suitableCell_mm(const PointCloud& cloud);

/// Throws InputError if the cloud is so sparse or so large that it cannot be a height map.
[[nodiscard]] CellGrid compressCloud(const PointCloud& cloud, const CellGridOptions& options = {});

/// Bicubic B-spline that interpolates the heights of a CellGrid at the centres of its cells (after undoing the mean
/// over the cell). Source: Unser, "Splines", IEEE Signal Processing Magazine 16 (1999).
class HeightSpline {
 public:
  explicit HeightSpline(const CellGrid& grid);

  /// Height and derivatives at one place.
  struct Value {
    double z = 0.0;
    double zx = 0.0, zy = 0.0;
    double zxx = 0.0, zxy = 0.0, zyy = 0.0;
    double count = 0.0;          ///< points of the cell at this place
    float tx = 0.0F, ty = 0.0F;  ///< phase between the nodes, 0 .. 1
  };
  /// False outside the measured region (a quarter of a cell is tolerated).
  [[nodiscard]] bool evaluate(double x, double y, Value& value) const noexcept;

 private:
  void fillHoles(std::vector<double>& heights) const;
  void prefilter(std::vector<double>& values) const;
  [[nodiscard]] std::size_t index(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  static constexpr int margin_ = 8;
  Eigen::Vector2d origin_;  ///< place of node (0, 0)
  Eigen::Vector2d step_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<double> coefficients_;
  std::vector<float> count_;          ///< points at each node, 0: not measured
  std::vector<std::uint8_t> inside_;  ///< the four nodes around are measured
};

/// Sum of the squared weights with which the values of equal, independent nodes enter a cubic spline at phase t.
[[nodiscard]] double splineNoiseFactor(double t) noexcept;

}  // namespace spindrift
