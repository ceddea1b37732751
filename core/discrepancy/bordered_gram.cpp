// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/bordered_gram.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/base/error.h"

namespace spindrift {

using Eigen::Index;

Eigen::MatrixXd borderedMatrix(const Eigen::MatrixXd& gram, Index shifts, double scale, double shift, double smooth) {
  const Index border = gram.cols() - 1;
  Eigen::VectorXd size = Eigen::VectorXd::Constant(gram.cols(), smooth);
  size.head(shifts).setConstant(shift);
  size[border] = 1.0;
  Eigen::MatrixXd out = size.asDiagonal() * gram * size.asDiagonal() / (scale * scale);
  out.diagonal().head(border).array() += 1.0;
  // Readings without any noise leave nothing behind but rounding, of either sign.
  out(border, border) = out(border, border) * (1.0 + 1e-12) + 1e-9;
  return out;
}

BorderedGram::BorderedGram(const Eigen::MatrixXd& gram, Index shifts)
    : smooth_gram_(gram.bottomRightCorner(gram.rows() - shifts, gram.cols() - shifts)) {
  SPINDRIFT_ASSERT(gram.rows() == gram.cols() && gram.cols() > shifts, "products without what they are to explain");
  if (shifts == 0) return;
  const Eigen::Tridiagonalization<Eigen::MatrixXd> turned(gram.topLeftCorner(shifts, shifts));
  diagonal_ = turned.diagonal();
  beside_ = turned.subDiagonal();
  const Eigen::MatrixXd along = turned.matrixQ().adjoint() * gram.topRightCorner(shifts, gram.cols() - shifts);
  along_ = along.transpose();
}

double BorderedGram::deviance(double scale, double shift, double smooth) const {
  constexpr double beyond = 1e300;
  const Index shifts = shift == 0.0 ? 0 : diagonal_.size();  // shifts of no size take nothing
  const Index rest = smooth_gram_.cols();
  const double scale2 = scale * scale;
  double log_det = 0.0;
  Eigen::MatrixXd left = borderedMatrix(smooth_gram_, 0, scale, 0.0, smooth);
  if (shifts > 0) {
    // 1 + shift^2 T / scale^2 = L P L' with a bidiagonal L: down the chain.
    const double square = shift * shift / scale2;
    Eigen::MatrixXd chain = (shift / scale2) * along_;
    chain.topRows(rest - 1) *= smooth;
    double pivot = 1.0;
    for (Index k = 0; k < shifts; ++k) {
      const double coupling = k > 0 ? square * beside_[k - 1] : 0.0;
      const double factor = k > 0 ? coupling / pivot : 0.0;
      const double before = std::sqrt(pivot);  // by which the link before was divided
      pivot = 1.0 + square * diagonal_[k] - factor * coupling;
      if (!(pivot > 0.0)) return beyond;
      log_det += std::log(pivot);
      if (k > 0) chain.col(k) -= factor * before * chain.col(k - 1);
      chain.col(k) /= std::sqrt(pivot);
    }
    left.noalias() -= chain * chain.transpose();
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(left);
  if (llt.info() != Eigen::Success) return beyond;
  const auto pivots = llt.matrixLLT().diagonal();
  return log_det + 2.0 * pivots.head(rest - 1).array().log().sum() + pivots[rest - 1] * pivots[rest - 1];
}

}  // namespace spindrift
