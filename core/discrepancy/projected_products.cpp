// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/discrepancy/residual_problem.h"

namespace spindrift {

using Eigen::Index;

Eigen::MatrixXd ProjectedColumns::gram(Index from, Index count) const {
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(count, count);
  if (rows.rows() == 0 || count == 0) return lower;
  lower.selfadjointView<Eigen::Lower>().rankUpdate(rows.middleCols(from, count).transpose());
  if (dots.rows() > 0) lower.selfadjointView<Eigen::Lower>().rankUpdate(dots.middleCols(from, count).transpose(), -1.0);
  return lower.selfadjointView<Eigen::Lower>();
}

ProjectedColumns ResidualProblem::projectedProducts(const Eigen::MatrixXd& courses, const Eigen::MatrixXd& shapes,
                                                    const std::vector<int>& active,
                                                    const Eigen::MatrixXd& further) const {
  const Index k = shapes.cols();
  const Index columns = courses.cols() * k;
  ProjectedColumns out;
  Eigen::VectorXd residual = projected_y_;
  if (further.cols() > 0) residual -= further * (further.transpose() * residual);
  const auto fill = [&](Index from, Index count, Eigen::Ref<Eigen::MatrixXd> part) {
    for (Index o = 0; o < courses.cols(); ++o) {
      part.middleCols(o * k, k).noalias() =
          courses.col(o).segment(from, count).asDiagonal() * shapes.middleRows(from, count);
    }
  };
  // Stated covariances couple the series: all rows together.
  std::vector<std::pair<Index, Index>> ranges;
  if (coupled_) {
    ranges.emplace_back(0, size());
  } else {
    for (const int s : active) {
      const Index from = series_begin[static_cast<std::size_t>(s)];
      ranges.emplace_back(from, series_begin[static_cast<std::size_t>(s) + 1] - from);
    }
  }
  Index total = 0;
  for (const auto& [from, count] : ranges) total += count;
  out.rows.resize(total, columns);
  out.whole = Eigen::VectorXd::Zero(columns);
  // A shape that is zero at every point measured.
  if (total == 0 || columns == 0) {
    out.dots = Eigen::MatrixXd::Zero(q_.cols() + further.cols(), columns);
    out.with_residual = Eigen::VectorXd::Zero(columns);
    return out;
  }
  const Index basis_columns = q_.cols() + further.cols();
  Eigen::MatrixXd basis(total, basis_columns);
  Eigen::VectorXd left(total);
  Index at = 0;
  for (const auto& [from, count] : ranges) {
    Eigen::MatrixXd part(count, columns);
    fill(from, count, part);
    if (blocks_.empty()) {
      part = diagonal_whitener_.segment(from, count).asDiagonal() * part;
    } else {
      // Without coupling the blocks are the series; with it, all of them lie in this one range.
      for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const auto [first, end] = blocks_[b];
        if (first < from || end > from + count) continue;
        const Eigen::MatrixXd raw = part.middleRows(first - from, end - first);
        part.middleRows(first - from, end - first).noalias() = block_whitener_[b].triangularView<Eigen::Lower>() * raw;
      }
    }
    out.whole += part.colwise().squaredNorm().transpose();
    if (!coupled_) {
      const auto unit = constants_.block(from, 0, count, 1);
      const Eigen::RowVectorXd dot = unit.transpose() * part;
      part.noalias() -= unit * dot;
    }
    out.rows.middleRows(at, count) = part;
    basis.block(at, 0, count, q_.cols()) = q_.middleRows(from, count);
    if (further.cols() > 0) basis.block(at, q_.cols(), count, further.cols()) = further.middleRows(from, count);
    left.segment(at, count) = residual.segment(from, count);
    at += count;
  }
  out.dots.noalias() = basis.transpose() * out.rows;
  out.with_residual.noalias() = out.rows.transpose() * left;
  return out;
}

}  // namespace spindrift
