// SPDX-License-Identifier: Apache-2.0
// For the precompiled headers only. A decomposition of a dynamic matrix is thousands of lines of template: up to half a
// minute for each file that asks for one. Those that several files use stand in core/base/eigen_instance.cpp.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

// Empty where they are made.
#ifndef SPINDRIFT_EIGEN_ELSEWHERE
#define SPINDRIFT_EIGEN_ELSEWHERE extern
#endif

SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::LDLT<Eigen::MatrixXd>;
SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::LLT<Eigen::MatrixXd>;
SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;
SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::JacobiSVD<Eigen::MatrixXd>;
SPINDRIFT_EIGEN_ELSEWHERE template class Eigen::BDCSVD<Eigen::MatrixXd>;

// The inner loops of products. The linker keeps one of the copies that all files make of them: that of a test, which is
// optimised less than the libraries, would slow down all that the libraries compute there.
namespace Eigen::internal {
using SpindriftTraits = gebp_traits<double, double>;
using SpindriftResult = blas_data_mapper<double, Index, ColMajor, Unaligned, 1>;
template <int order>
using SpindriftFactor = const_blas_data_mapper<double, Index, order>;
SPINDRIFT_EIGEN_ELSEWHERE template struct gebp_kernel<double, double, Index, SpindriftResult, SpindriftTraits::mr,
                                                      SpindriftTraits::nr, false, false>;
SPINDRIFT_EIGEN_ELSEWHERE template struct gemm_pack_lhs<double, Index, SpindriftFactor<ColMajor>, SpindriftTraits::mr,
                                                        SpindriftTraits::LhsProgress,
                                                        SpindriftTraits::LhsPacket4Packing, ColMajor, false, false>;
SPINDRIFT_EIGEN_ELSEWHERE template struct gemm_pack_lhs<double, Index, SpindriftFactor<RowMajor>, SpindriftTraits::mr,
                                                        SpindriftTraits::LhsProgress,
                                                        SpindriftTraits::LhsPacket4Packing, RowMajor, false, false>;
SPINDRIFT_EIGEN_ELSEWHERE template struct gemm_pack_rhs<double, Index, SpindriftFactor<ColMajor>, SpindriftTraits::nr,
                                                        ColMajor, false, false>;
SPINDRIFT_EIGEN_ELSEWHERE template struct gemm_pack_rhs<double, Index, SpindriftFactor<RowMajor>, SpindriftTraits::nr,
                                                        RowMajor, false, false>;
SPINDRIFT_EIGEN_ELSEWHERE template struct general_matrix_vector_product<
    Index, double, SpindriftFactor<ColMajor>, ColMajor, false, double, SpindriftFactor<RowMajor>, false>;
SPINDRIFT_EIGEN_ELSEWHERE template struct general_matrix_vector_product<
    Index, double, SpindriftFactor<RowMajor>, RowMajor, false, double, SpindriftFactor<ColMajor>, false>;
}  // namespace Eigen::internal

namespace spindrift {
/// result += factor * lhs * rhs, of rows x depth and depth x cols; each stored by columns, or by rows where it says so,
/// with the stride between them. By BLIS, which takes the widest unit that the processor has: Eigen takes that of the
/// oldest processor the distribution runs on, and needs three to four times as long.
void addProduct(Eigen::Index rows, Eigen::Index cols, Eigen::Index depth, const double* lhs, Eigen::Index lhs_stride,
                bool lhs_by_rows, const double* rhs, Eigen::Index rhs_stride, bool rhs_by_rows, double* result,
                Eigen::Index result_stride, double factor);
}  // namespace spindrift

// Every product of two dynamic matrices that is large enough for blocks.
namespace Eigen::internal {
template <int lhs_order, bool lhs_conjugated, int rhs_order, bool rhs_conjugated>
struct general_matrix_matrix_product<Index, double, lhs_order, lhs_conjugated, double, rhs_order, rhs_conjugated,
                                     ColMajor, 1> {
  using Traits = gebp_traits<double, double>;
  static void run(Index rows, Index cols, Index depth, const double* lhs, Index lhs_stride, const double* rhs,
                  Index rhs_stride, double* result, Index, Index result_stride, double factor,
                  level3_blocking<double, double>&, GemmParallelInfo<Index>* = nullptr) {
    spindrift::addProduct(rows, cols, depth, lhs, lhs_stride, lhs_order == RowMajor, rhs, rhs_stride,
                          rhs_order == RowMajor, result, result_stride, factor);
  }
};
}  // namespace Eigen::internal
