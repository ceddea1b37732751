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
