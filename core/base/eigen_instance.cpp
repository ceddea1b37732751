// SPDX-License-Identifier: Apache-2.0
// Decompositions of dynamic matrices, once for all: resources/precompiled/eigen.h says that they are here.
#define SPINDRIFT_EIGEN_ELSEWHERE
#include "resources/precompiled/eigen.h"

#include <cassert>
#include <limits>

/// BLAS, as Fortran calls it: result = alpha op(a) op(b) + beta result.
extern "C" void dgemm_(const char* op_a, const char* op_b, const int* m, const int* n, const int* k,
                       const double* alpha, const double* a, const int* a_stride, const double* b, const int* b_stride,
                       const double* beta, double* result, const int* result_stride);

namespace spindrift {

void addProduct(Eigen::Index rows, Eigen::Index cols, Eigen::Index depth, const double* lhs, Eigen::Index lhs_stride,
                bool lhs_by_rows, const double* rhs, Eigen::Index rhs_stride, bool rhs_by_rows, double* result,
                Eigen::Index result_stride, double factor) {
  // What has no entries has nothing to add, and may have a stride that BLAS refuses.
  if (rows == 0 || cols == 0 || depth == 0) return;
  const auto counted = [](Eigen::Index n) {
    assert(n > 0 && n <= std::numeric_limits<int>::max());
    return static_cast<int>(n);
  };
  const int m = counted(rows), n = counted(cols), k = counted(depth);
  const int a_stride = counted(lhs_stride), b_stride = counted(rhs_stride), stride = counted(result_stride);
  const double one = 1.0;
  dgemm_(lhs_by_rows ? "T" : "N", rhs_by_rows ? "T" : "N", &m, &n, &k, &factor, lhs, &a_stride, rhs, &b_stride, &one,
         result, &stride);
}

}  // namespace spindrift
