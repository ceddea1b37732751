// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/scan_noise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/base/units.h"

namespace spindrift {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

const Vector6& unitFactors() {
  static const Vector6 factors = [] {
    Vector6 f;
    f << Eigen::Vector3d::Constant(um_per_mm), Eigen::Vector3d::Constant(urad_per_rad);
    return f;
  }();
  return factors;
}

/// In um and urad; zero where a component is not observed.
Matrix6 ofObserved(const ScanResult& s, Matrix6 covariance) {
  for (int i = 0; i < 6; ++i) {
    if (std::isfinite(s.registration.covariance(i, i))) continue;
    covariance.row(i).setZero();
    covariance.col(i).setZero();
  }
  return unitFactors().asDiagonal() * covariance * unitFactors().asDiagonal();
}

/// Of a change of shape.
Matrix6 formCovariance(const ScanResult& s) {
  return s.registration.free_form ? ofObserved(s, s.registration.free_form->motion_covariance)
                                  : Matrix6(Matrix6::Zero());
}

/// Of a registration, without that of a change of shape.
Matrix6 statedCovariance(const ScanResult& s) {
  return ofObserved(s, s.registration.covariance) - formCovariance(s);
}

/// Largest c with c * part <= whole in all directions of the components that `whole` has.
double largestPart(const Matrix6& part, const Matrix6& whole) {
  std::vector<int> seen;
  for (int i = 0; i < 6; ++i)
    if (whole(i, i) > 0.0) seen.push_back(i);
  const auto n = static_cast<Eigen::Index>(seen.size());
  if (n == 0) return 1.0;
  Eigen::MatrixXd correlation(n, n), p(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const int a = seen[static_cast<std::size_t>(i)];
      const int b = seen[static_cast<std::size_t>(j)];
      const double scale = std::sqrt(whole(a, a) * whole(b, b));
      correlation(i, j) = whole(a, b) / scale;
      p(i, j) = part(a, b) / scale;
    }
  constexpr double rounding = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(correlation);
  const Eigen::MatrixXd whiten =
      modes.eigenvalues().cwiseMax(rounding).cwiseSqrt().cwiseInverse().asDiagonal() * modes.eigenvectors().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ratio(whiten * p * whiten.transpose());
  const double largest = ratio.eigenvalues()(n - 1);
  return largest > 0.0 ? 1.0 / largest : 1.0;
}

/// Of the reference scan of every artefact: see the header.
std::map<std::string, Matrix6> referenceNoise(const std::vector<ScanResult>& scans) {
  std::map<std::string, Matrix6> out;
  for (const ScanResult& s : scans) {
    const Matrix6 half = 0.5 * statedCovariance(s);
    auto [at, fresh] = out.try_emplace(s.capture.artefact, half);
    if (!fresh && half.trace() > 0.0 &&
        (half.topLeftCorner<3, 3>().trace() < at->second.topLeftCorner<3, 3>().trace() || at->second.trace() == 0.0))
      at->second = half;
  }
  std::map<std::string, double> part;
  for (const ScanResult& s : scans) {
    if (s.reference) continue;
    double& c = part.try_emplace(s.capture.artefact, 1.0).first->second;
    c = std::min(c, largestPart(out.at(s.capture.artefact), statedCovariance(s)));
  }
  for (const auto& [artefact, c] : part) out.at(artefact) *= c;
  return out;
}

/// Root of a covariance of lengths and angles: with the correlations' symmetric root, so that alike covariances have
/// alike columns.
Matrix6 symmetricRoot(const Matrix6& covariance) {
  const Vector6 size = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Vector6 inverse = size.unaryExpr([](double v) { return v > 0.0 ? 1.0 / v : 0.0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(inverse.asDiagonal() * covariance * inverse.asDiagonal());
  return size.asDiagonal() * modes.eigenvectors() * modes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         modes.eigenvectors().transpose();
}

/// Changes of shape of the scans of one artefact.
void addForms(const std::vector<ScanResult>& scans, const std::vector<ScanRow>& rows,
              const std::vector<std::size_t>& members, SharedNoise& shared) {
  std::map<std::size_t, std::vector<std::size_t>> rows_of;
  for (const std::size_t r : members)
    if (scans[rows[r].scan].registration.free_form) rows_of[rows[r].scan].push_back(r);
  if (rows_of.empty()) return;
  std::map<std::size_t, Eigen::VectorXd> shape;  // of length 1
  Eigen::Index terms = 0;
  for (const auto& [scan, unused] : rows_of) {
    shape[scan] = scans[scan].registration.free_form->shapeVector_mm().normalized();
    terms = std::max(terms, shape[scan].size());
  }
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(terms, terms);
  for (auto& [scan, of_scan] : shape) {
    of_scan.conservativeResizeLike(Eigen::VectorXd::Zero(terms));
    sum += of_scan * of_scan.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(sum);
  std::map<std::size_t, Matrix6> root;
  for (const auto& [scan, unused] : rows_of) root[scan] = symmetricRoot(formCovariance(scans[scan]));
  for (Eigen::Index d = 0; d < terms; ++d)
    for (Eigen::Index q = 0; q < 6; ++q) {
      SharedNoise::Factor factor;
      for (const auto& [scan, of_scan] : rows_of) {
        const double part = directions.eigenvectors().col(d).dot(shape[scan]);
        if (part * part < 1e-6) continue;
        for (const std::size_t r : of_scan) factor.push_back({r, part * root[scan](rows[r].component, q)});
      }
      shared.addFactor(std::move(factor));
    }
}

}  // namespace

ScanNoise noiseOfScans(const std::vector<ScanResult>& scans, const std::vector<ScanRow>& rows) {
  ScanNoise out;
  const std::map<std::string, Matrix6> reference = referenceNoise(scans);
  std::map<std::size_t, std::vector<std::size_t>> rows_of;  // of each scan
  for (std::size_t r = 0; r < rows.size(); ++r) rows_of[rows[r].scan].push_back(r);
  std::map<std::string, std::vector<std::size_t>> rows_of_artefact;
  for (std::size_t r = 0; r < rows.size(); ++r) rows_of_artefact[scans[rows[r].scan].capture.artefact].push_back(r);
  std::vector<double> own(rows.size(), 0.0);
  for (const auto& [artefact, members] : rows_of_artefact) {
    const Matrix6& common = reference.at(artefact);
    constexpr double rounding = 1e-14;
    // Lengths and angles side by side: roots of the correlations.
    const Vector6 size = common.diagonal().cwiseMax(0.0).cwiseSqrt();
    const Vector6 inverse = size.unaryExpr([](double v) { return v > 0.0 ? 1.0 / v : 0.0; });
    const Eigen::MatrixXd root =
        size.asDiagonal() * covarianceRoot(inverse.asDiagonal() * common * inverse.asDiagonal(), rounding);
    for (Eigen::Index q = 0; q < root.cols(); ++q) {
      SharedNoise::Factor factor;
      for (const std::size_t r : members) factor.push_back({r, root(rows[r].component, q)});
      out.shared.addFactor(std::move(factor));
    }
    addForms(scans, rows, members, out.shared);
  }
  for (const auto& [scan, members] : rows_of) {
    const ScanResult& s = scans[scan];
    const Matrix6& common = reference.at(s.capture.artefact);
    // Without the reference; that of the reference scan itself is as large.
    const Matrix6 all = s.reference ? common : Matrix6(statedCovariance(s) - common);
    const auto n = static_cast<Eigen::Index>(members.size());
    Eigen::MatrixXd part(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        part(i, j) = all(rows[members[static_cast<std::size_t>(i)]].component,
                         rows[members[static_cast<std::size_t>(j)]].component);
    const Eigen::MatrixXd loads = sharedLoads(part);
    for (Eigen::Index q = 0; q < loads.cols(); ++q) {
      SharedNoise::Factor factor;
      for (Eigen::Index i = 0; i < n; ++i) factor.push_back({members[static_cast<std::size_t>(i)], loads(i, q)});
      out.shared.addFactor(std::move(factor));
    }
    for (Eigen::Index i = 0; i < n; ++i)
      own[members[static_cast<std::size_t>(i)]] = std::max(0.0, part(i, i) - loads.row(i).squaredNorm());
  }
  for (int q = 0; q < 6; ++q) {
    SharedNoise::Factor factor;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const int i = rows[r].component;
      factor.push_back({r, unitFactors()(i) * scans[rows[r].scan].calibration_spread(i, q)});
    }
    out.shared.addFactor(std::move(factor));
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double sigma = std::sqrt(own[r] + out.shared.variance(r));
    out.sigma.push_back(sigma > 0.0 ? sigma : rows[r].component < 3 ? 1e-4 : 0.01);
  }
  return out;
}

}  // namespace spindrift
