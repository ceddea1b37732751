// SPDX-License-Identifier: Apache-2.0
// Decompositions of dynamic matrices, once for all: resources/precompiled/eigen.h says that they are here.
#define SPINDRIFT_EIGEN_ELSEWHERE
#include "resources/precompiled/eigen.h"

#include <blis.h>

namespace spindrift {
namespace {

/// Up to so many multiplications Eigen is as quick: BLIS needs 0.4 us to begin, measured against products of 4 to 69
/// rows.
constexpr Eigen::Index begin_costs = 1500;

template <int lhs_order, int rhs_order>
void addSmall(Eigen::Index rows, Eigen::Index cols, Eigen::Index depth, const double* lhs, Eigen::Index lhs_stride,
              const double* rhs, Eigen::Index rhs_stride, double* result, Eigen::Index result_stride, double factor) {
  using Stride = Eigen::OuterStride<>;
  using Lhs = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, lhs_order>;
  using Rhs = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, rhs_order>;
  const Eigen::Map<const Lhs, 0, Stride> a(lhs, rows, depth, Stride(lhs_stride));
  const Eigen::Map<const Rhs, 0, Stride> b(rhs, depth, cols, Stride(rhs_stride));
  Eigen::Map<Eigen::MatrixXd, 0, Stride> c(result, rows, cols, Stride(result_stride));
  c.noalias() += factor * a.lazyProduct(b);
}

}  // namespace

// By BLIS's own interface: that of BLAS may be any library's that was loaded before.
void addProduct(Eigen::Index rows, Eigen::Index cols, Eigen::Index depth, const double* lhs, Eigen::Index lhs_stride,
                bool lhs_by_rows, const double* rhs, Eigen::Index rhs_stride, bool rhs_by_rows, double* result,
                Eigen::Index result_stride, double factor) {
  if (rows == 0 || cols == 0 || depth == 0) return;
  if (rows * cols * depth <= begin_costs) {
    using Eigen::ColMajor, Eigen::RowMajor;
    const auto add = lhs_by_rows ? (rhs_by_rows ? addSmall<RowMajor, RowMajor> : addSmall<RowMajor, ColMajor>)
                                 : (rhs_by_rows ? addSmall<ColMajor, RowMajor> : addSmall<ColMajor, ColMajor>);
    return add(rows, cols, depth, lhs, lhs_stride, rhs, rhs_stride, result, result_stride, factor);
  }
  double one = 1.0;
  bli_dgemm(BLIS_NO_TRANSPOSE, BLIS_NO_TRANSPOSE, rows, cols, depth, &factor, const_cast<double*>(lhs),
            lhs_by_rows ? lhs_stride : 1, lhs_by_rows ? 1 : lhs_stride, const_cast<double*>(rhs),
            rhs_by_rows ? rhs_stride : 1, rhs_by_rows ? 1 : rhs_stride, &one, result, 1, result_stride);
}

}  // namespace spindrift
