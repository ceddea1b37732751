// SPDX-License-Identifier: Apache-2.0
// Decompositions of dynamic matrices, once for all: resources/precompiled/eigen.h says that they are here.
#define SPINDRIFT_EIGEN_ELSEWHERE
#include "resources/precompiled/eigen.h"

#include <blis.h>

namespace spindrift {

// By BLIS's own interface: that of BLAS may be any library's that was loaded before.
void addProduct(Eigen::Index rows, Eigen::Index cols, Eigen::Index depth, const double* lhs, Eigen::Index lhs_stride,
                bool lhs_by_rows, const double* rhs, Eigen::Index rhs_stride, bool rhs_by_rows, double* result,
                Eigen::Index result_stride, double factor) {
  if (rows == 0 || cols == 0 || depth == 0) return;
  double one = 1.0;
  bli_dgemm(BLIS_NO_TRANSPOSE, BLIS_NO_TRANSPOSE, rows, cols, depth, &factor, const_cast<double*>(lhs),
            lhs_by_rows ? lhs_stride : 1, lhs_by_rows ? 1 : lhs_stride, const_cast<double*>(rhs),
            rhs_by_rows ? rhs_stride : 1, rhs_by_rows ? 1 : rhs_stride, &one, result, 1, result_stride);
}

}  // namespace spindrift
