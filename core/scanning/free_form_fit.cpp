// SPDX-License-Identifier: Apache-2.0
// The change of the surface that a registration leaves: model in free_form.h.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/least_squares.h"
#include "core/math/statistics.h"
#include "core/scanning/registration_solver.h"

namespace spindrift {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double smallest_size_mm = 2e-5;
/// Heat bends artefacts by micrometres to some tens of them; more is another surface.
constexpr double largest_size_mm = 0.1;
constexpr double size_step = 1.5;
constexpr std::array<double, 5> decays{0.03, 0.08, 0.2, 0.45, 0.9};
constexpr double cells_per_term = 8.0;

/// Normal equations of heights = [-J, terms] (step of the motion, coefficients) + noise over the cells of a scan.
class HeightSystem {
 public:
  HeightSystem(const RegistrationSolver::Outcome& outcome, const CellGrid& source, FreeForm form)
      : outcome_(outcome), source_(source), form_(std::move(form)), motion_(outcome.motion.parameters()) {
    const int all = motion_ + FreeForm::termCount(form_.order);
    rows_of_x_.resize(all, static_cast<Index>(outcome.cells.size()));
    for (std::size_t k = 0; k < outcome.cells.size(); ++k) {
      const CellResidual& c = outcome.cells[k];
      auto column = rows_of_x_.col(static_cast<Index>(k));
      column.head(motion_) = -c.row(motion_);
      form_.evaluateTerms(c.place, column.data() + motion_);
    }
  }

  [[nodiscard]] int motion() const noexcept { return motion_; }
  /// sum w x x^T and sum w x r.
  void accumulate(const std::vector<CellResidual>& cells, MatrixXd& normal, VectorXd& right) const {
    const Index all = rows_of_x_.rows();
    normal = MatrixXd::Zero(all, all);
    right = VectorXd::Zero(all);
    constexpr Index block = 256;
    MatrixXd scaled(all, block);
    VectorXd heights(block);
    const auto count = static_cast<Index>(cells.size());
    for (Index from = 0; from < count; from += block) {
      const Index n = std::min(block, count - from);
      for (Index k = 0; k < n; ++k) {
        const CellResidual& c = cells[static_cast<std::size_t>(from + k)];
        const double root = std::sqrt(c.weight * c.robust);
        scaled.col(k) = root * rows_of_x_.col(from + k);
        heights[k] = root * c.residual;
      }
      normal.selfadjointView<Eigen::Lower>().rankUpdate(scaled.leftCols(n));
      right.noalias() += scaled.leftCols(n) * heights.head(n);
    }
    normal.triangularView<Eigen::StrictlyUpper>() = normal.transpose();
  }

  /// Residuals less [-J, terms] parameters, with Tukey's factors of what is left.
  [[nodiscard]] std::vector<CellResidual> cleaned(const VectorXd& parameters, double& scale) const {
    std::vector<CellResidual> out = outcome_.cells;
    const VectorXd fitted = rows_of_x_.transpose() * parameters;
    std::vector<double> size;
    size.reserve(out.size());
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k].residual -= fitted[static_cast<Index>(k)];
      size.push_back(std::abs(out[k].residual) * std::sqrt(out[k].weight));
    }
    scale = std::max(1.4826 * median(std::move(size)), 1e-9);
    for (CellResidual& c : out)
      c.robust = tukeyWeight(c.residual * std::sqrt(c.weight) / scale, outcome_.tukey_threshold);
    return out;
  }

  /// The errors that cells of a row share taken out of normal equations: their part that says nothing.
  void takeRowsOut(const std::vector<CellResidual>& cells, const RegistrationNoise& noise, MatrixXd& normal,
                   VectorXd& right) const {
    std::vector<Index> shared;  // of height, tilt, place along x
    for (std::size_t i = 0; i < 3; ++i)
      if (noise.row_variance[i] > 0.0) shared.push_back(static_cast<Index>(i));
    if (shared.empty()) return;
    double steepness = 0.0, count = 0.0;
    for (const CellResidual& c : cells) {
      if (c.robust <= 0.0) continue;
      steepness += c.jacobian[1] * c.jacobian[1];
      count += 1.0;
    }
    steepness = std::max(steepness / std::max(count, 1.0), 1e-12);
    const auto n = static_cast<Index>(shared.size());
    for (std::size_t from = 0; from < cells.size();) {
      const std::uint32_t row = cells[from].cell / static_cast<std::uint32_t>(source_.columns);
      MatrixXd xb = MatrixXd::Zero(normal.rows(), n), bb = MatrixXd::Zero(n, n);
      VectorXd br = VectorXd::Zero(n), b(n);
      std::size_t k = from;
      for (; k < cells.size() && cells[k].cell / static_cast<std::uint32_t>(source_.columns) == row; ++k) {
        const CellResidual& c = cells[k];
        const double w = c.weight * c.robust;
        if (w <= 0.0) continue;
        const double steep = 1.0 - noise.steep_share + noise.steep_share * c.jacobian[1] * c.jacobian[1] / steepness;
        const std::array<double, 3> basis{std::sqrt(steep), source_.cells[c.cell].mean.x() - source_.centroid_mm.x(),
                                          -c.jacobian[0]};
        for (Index i = 0; i < n; ++i) b[i] = basis[static_cast<std::size_t>(shared[static_cast<std::size_t>(i)])];
        xb.noalias() += w * rows_of_x_.col(static_cast<Index>(k)) * b.transpose();
        bb.noalias() += w * b * b.transpose();
        br += w * c.residual * b;
      }
      for (Index i = 0; i < n; ++i)
        bb(i, i) +=
            noise.unit_variance / noise.row_variance[static_cast<std::size_t>(shared[static_cast<std::size_t>(i)])];
      const Eigen::LDLT<MatrixXd> solver(bb);
      normal.noalias() -= xb * solver.solve(xb.transpose());
      right.noalias() -= xb * solver.solve(br);
      from = k;
    }
  }

 private:
  const RegistrationSolver::Outcome& outcome_;
  const CellGrid& source_;
  FreeForm form_;
  int motion_;
  MatrixXd rows_of_x_;  ///< a column for each cell
};

/// Information on the coefficients with any motion allowed: sum of the likelihood's second derivatives and slope.
struct FormInformation {
  MatrixXd matrix;
  VectorXd slope;
};

FormInformation formInformation(MatrixXd normal, VectorXd right, const RegistrationSolver::Outcome& outcome,
                                double unit_variance, double length_mm, double degenerate_ratio) {
  normal /= unit_variance;
  right /= unit_variance;
  const ScanMotion& motion = outcome.motion;
  const int m = motion.parameters();
  VectorXd scale = VectorXd::Ones(m);  // makes the parameters comparable, as RegistrationSolver::scales()
  scale.segment<3>(3).setConstant(length_mm);
  if (motion.drift_order > 1)
    for (int k = 0; k < 3; ++k) {
      const double weight = 1.0 / (motion.bend_sigma[k] * motion.bend_sigma[k]);
      scale[9 + k] = std::sqrt(1.0 + weight / normal(2, 2));
      normal(9 + k, 9 + k) += weight;
      right[9 + k] -= weight * motion.drift(k, 1);
    }
  const VectorXd inverse = scale.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(inverse.asDiagonal() * normal.topLeftCorner(m, m) *
                                                      inverse.asDiagonal());
  MatrixXd motions = MatrixXd::Zero(m, m);
  for (int i = 0; i < m; ++i)
    if (eigen.eigenvalues()[i] > degenerate_ratio * eigen.eigenvalues()[m - 1])
      motions += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() / eigen.eigenvalues()[i];
  motions = (inverse.asDiagonal() * motions * inverse.asDiagonal()).eval();
  const Index n = normal.rows() - m - FreeForm::plane_terms;
  const MatrixXd map = motions * normal.topRightCorner(m, n);
  FormInformation out;
  out.matrix = normal.bottomRightCorner(n, n) - normal.bottomLeftCorner(n, m) * map;
  out.slope = right.tail(n) - map.transpose() * right.head(m);
  return out;
}

/// Mean, covariance and evidence over sizes and decays of the coefficients.
void weighSizes(const FormInformation& information, FreeForm& form) {
  const Index n = information.slope.size();
  struct Choice {
    double log_evidence = 0.0;
    std::size_t directions = 0;
    VectorXd variance;  ///< in the directions
    VectorXd mean;
  };
  std::vector<Choice> choices;
  std::vector<MatrixXd> directions;
  for (const double along_x : decays)
    for (const double along_y : decays) {
      VectorXd size(n);
      Index k = 0;
      for (int both = 2; both <= form.order; ++both)
        for (int j = 0; j <= both; ++j) size[k++] = std::pow(along_x, both - j) * std::pow(along_y, j);
      const double largest = size.maxCoeff();
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(size.asDiagonal() * information.matrix * size.asDiagonal());
      directions.emplace_back(size.asDiagonal() * eigen.eigenvectors());
      const VectorXd known = eigen.eigenvalues().cwiseMax(0.0);
      const VectorXd slope = directions.back().transpose() * information.slope;
      for (double a = smallest_size_mm; a < largest_size_mm; a *= size_step) {
        Choice c;
        c.directions = directions.size() - 1;
        const double square = a * a / (largest * largest);
        c.variance = square * (1.0 + (square * known).array()).inverse();
        c.log_evidence =
            0.5 * (slope.array().square() * c.variance.array()).sum() - 0.5 * (square * known).array().log1p().sum();
        c.mean = directions.back() * c.variance.cwiseProduct(slope);
        choices.push_back(std::move(c));
      }
    }
  double best = choices.front().log_evidence;
  for (const Choice& c : choices) best = std::max(best, c.log_evidence);
  double sum = 0.0;
  for (const Choice& c : choices) sum += std::exp(c.log_evidence - best);
  form.log_evidence = best + std::log(sum / static_cast<double>(choices.size()));
  VectorXd mean = VectorXd::Zero(n);
  for (const Choice& c : choices) mean += std::exp(c.log_evidence - best) / sum * c.mean;
  std::vector<VectorXd> variance(directions.size(), VectorXd::Zero(n));
  MatrixXd covariance = MatrixXd::Zero(n, n);
  for (const Choice& c : choices) {
    const double weight = std::exp(c.log_evidence - best) / sum;
    if (weight < 1e-9) continue;
    variance[c.directions] += weight * c.variance;
    covariance += weight * (c.mean - mean) * (c.mean - mean).transpose();
  }
  for (std::size_t k = 0; k < directions.size(); ++k)
    covariance += directions[k] * variance[k].asDiagonal() * directions[k].transpose();
  form.coefficients_mm = VectorXd::Zero(n + FreeForm::plane_terms);
  form.coefficients_mm.tail(n) = mean;
  form.covariance_mm2 = MatrixXd::Zero(n + FreeForm::plane_terms, n + FreeForm::plane_terms);
  form.covariance_mm2.bottomRightCorner(n, n) = covariance;
}

/// Mean and tilt: what they are where the artefact is held at one place, any of the rectangle.
void addHolding(FreeForm& form) {
  constexpr int places = 9;
  const Index n = form.coefficients_mm.size() - FreeForm::plane_terms;
  const VectorXd shape = form.coefficients_mm.tail(n);
  const MatrixXd square = shape * shape.transpose() + form.covariance_mm2.bottomRightCorner(n, n);
  Eigen::Matrix3d plane = Eigen::Matrix3d::Zero();
  for (int i = 0; i < places; ++i)
    for (int j = 0; j < places; ++j) {
      // In s and t; slopes as differences.
      const double s = 2.0 * (i + 0.5) / places - 1.0, t = 2.0 * (j + 0.5) / places - 1.0;
      constexpr double step = 1e-4;
      const VectorXd here = form.terms(s, t).tail(n);
      const VectorXd slope_s = (form.terms(s + step, t) - form.terms(s - step, t)).tail(n) / (2.0 * step);
      const VectorXd slope_t = (form.terms(s, t + step) - form.terms(s, t - step)).tail(n) / (2.0 * step);
      MatrixXd map(3, n);
      map.row(0) = -(here - s * slope_s - t * slope_t).transpose();
      map.row(1) = -slope_s.transpose();
      map.row(2) = -slope_t.transpose();
      plane += map * square * map.transpose() / (places * places);
    }
  form.covariance_mm2.topLeftCorner<FreeForm::plane_terms, FreeForm::plane_terms>() = plane;
}

double largestShape_mm(const FreeForm& form) {
  constexpr int steps = 12;
  double largest = 0.0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d at = form.low_mm + (form.high_mm - form.low_mm).cwiseProduct(Eigen::Vector2d(i, j) / steps);
      largest = std::max(largest, std::abs(form.shape(at.x(), at.y()).mm));
    }
  return largest;
}

}  // namespace

std::optional<FreeFormOutcome> freeFormOutcome(const RegistrationSolver& solver,
                                               const RegistrationSolver::Outcome& outcome, const CellGrid& source,
                                               const CellGrid& target, const RegistrationOptions& options) {
  FreeForm form;
  const auto cells = static_cast<double>(outcome.cells.size());
  form.order = FreeForm::most_order;
  while (form.order > 1 && FreeForm::termCount(form.order) * cells_per_term > cells) --form.order;
  if (form.order < 2 || outcome.inliers < options.least_inliers || outcome.overlap < options.least_overlap) return {};
  form.middle_mm = target.centroid_mm.z();
  form.low_mm = Eigen::Vector2d::Constant(1e300);
  form.high_mm = -form.low_mm;
  for (const SurfaceCell& c : target.cells)
    if (c.count > 0.0) {
      form.low_mm = form.low_mm.cwiseMin(c.mean.head<2>());
      form.high_mm = form.high_mm.cwiseMax(c.mean.head<2>());
    }
  if (!((form.high_mm - form.low_mm).minCoeff() > 0.0)) return {};

  // The noise, from what the polynomials leave; twice, because outliers hide in a large change.
  const HeightSystem system(outcome, source, form);
  MatrixXd normal;
  VectorXd right;
  RegistrationSolver::Outcome rest = outcome;
  std::vector<CellResidual> heights = outcome.cells;
  for (int turn = 0;; ++turn) {
    system.accumulate(heights, normal, right);
    MatrixXd regular = normal;
    regular.diagonal() *= 1.0 + 1e-9;
    const double before = rest.scale;
    rest.cells = system.cleaned(regular.ldlt().solve(right), rest.scale);
    if (turn == 1 || rest.scale > 0.8 * before) break;
    for (std::size_t k = 0; k < heights.size(); ++k) heights[k].robust = rest.cells[k].robust;
  }
  const int m = system.motion();
  const RegistrationNoise noise = registrationNoise(rest, source, target, MatrixP::Zero(m, m));
  if (!(noise.unit_variance > 0.0)) return {};
  const MatrixXd of_cells = normal;
  system.takeRowsOut(heights, noise, normal, right);
  weighSizes(formInformation(normal, right, outcome, noise.unit_variance, solver.length(), options.degenerate_ratio),
             form);
  if (form.log_evidence < options.clear_evidence || largestShape_mm(form) > largest_size_mm) return {};
  addHolding(form);

  FreeFormOutcome found{solver.solve(outcome.motion, solver.allCells(), options.most_iterations, &form), form};
  const RegistrationSolver::Outcome& after = found.outcome;
  if (after.motion.parameters() != m || after.cells.size() < 12) return {};
  // Least squares of heights less the change: an error of a coefficient moves the motion by this.
  const MatrixP inverse = solver.inverseNormal(after);
  const MatrixXd moved = inverse * of_cells.topRightCorner(m, form.coefficients_mm.size());
  found.form.motion_covariance = (moved * form.covariance_mm2 * moved.transpose()).topLeftCorner<6, 6>();
  found.form.misfit_ratio_without = registrationNoise(outcome, source, target, inverse).misfit_ratio;
  const RegistrationNoise stated = registrationNoise(after, source, target, inverse);
  for (int i = 0; i < 6; ++i)
    if (found.form.motion_covariance(i, i) > stated.covariance(i, i)) return found;
  return {};
}

}  // namespace spindrift
