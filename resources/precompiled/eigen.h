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
