// SPDX-License-Identifier: Apache-2.0
// A smooth surface through the cells of a compressed scan.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scanning/cell_grid.h"

namespace spindrift {

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
