// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/registration_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/least_squares.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

Eigen::Matrix3d rotationOf(const Eigen::Vector3d& w) {
  return RigidTransform::fromRotationVector(w, Eigen::Vector3d::Zero()).rotation();
}

double medianOf(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

VectorP CellResidual::row(int parameters) const {
  VectorP out(parameters);
  out.head<6>() = jacobian;
  double power = drift_t;
  for (int i = 6; i + 2 < parameters; i += 3, power *= drift_t) out.segment<3>(i) = power * jacobian.head<3>();
  return out;
}

RegistrationSolver::RegistrationSolver(const CellGrid& source, const RegistrationTarget& target,
                                       const RegistrationOptions& options)
    : source_(source), target_(target), options_(options) {
  for (std::size_t k = 0; k < source.cells.size(); ++k)
    if (source.cells[k].count >= 1.0) filled_.push_back(static_cast<std::uint32_t>(k));
  const CellGrid& g = target.grid();
  double sum = 0.0, count = 0.0;
  for (const SurfaceCell& cell : g.cells)
    if (cell.count > 0.0) {
      sum += cell.count * (cell.mean - g.centroid_mm).squaredNorm();
      count += cell.count;
    }
  half_scan_ = std::max(0.5 * g.rows * g.size.y(), 1e-3);
  length_ = std::max(std::sqrt(sum / std::max(count, 1.0)), 1e-3);
}

VectorP RegistrationSolver::scales(const MatrixP& normal, const VectorP& prior) const {
  VectorP out = (VectorP::Ones(prior.size()) + prior / std::max(normal(2, 2), 1e-300)).cwiseSqrt();
  out.segment<3>(3).setConstant(length_);
  return out;
}

ScanMotion RegistrationSolver::start() const {
  ScanMotion motion;
  const Eigen::Matrix3d& turn = options_.machine_from_profiler;
  Eigen::Matrix3d m = turn;
  motion.lever = turn;
  if (options_.scan_model == ScanModel::PushBroom) {
    m.col(1) = Eigen::Vector3d::UnitY();
    motion.lever.col(1).setZero();
    motion.drift_order = std::clamp(options_.drift_order, 0, 1);  // the second order comes last: bend()
    motion.drift_length = half_scan_;
  }
  motion.to_cloud = m.inverse();
  motion.centre = target_.grid().centroid_mm;
  if (options_.at_y_mm) motion.centre.y() = *options_.at_y_mm;
  motion.shift = options_.start_translation_mm;
  motion.rotation = rotationOf(options_.start_rotation_rad);
  return motion;
}

void RegistrationSolver::residuals(const ScanMotion& motion, const std::vector<std::uint32_t>& cells,
                                   std::vector<CellResidual>& out, const FreeForm* change) const {
  out.clear();
  out.reserve(cells.size());
  const Eigen::Matrix3d turned = motion.to_cloud * (motion.rotation - Eigen::Matrix3d::Identity()) * motion.lever;
  const Eigen::Matrix3d point = Eigen::Matrix3d::Identity() + turned;
  const Eigen::Vector3d shift = motion.to_cloud * motion.shift - turned * motion.centre;
  const Eigen::Matrix3d arm = motion.rotation * motion.lever;
  const Eigen::Matrix3d normal_to_machine = motion.to_cloud.transpose();
  const Eigen::Matrix<double, 3, 2> drift = motion.to_cloud * motion.drift;
  const HeightSpline& surface = target_.surface();
  HeightSpline::Value h;
  for (const std::uint32_t k : cells) {
    const SurfaceCell& cell = source_.cells[k];
    Eigen::Vector3d p = point * cell.mean + shift;
    double t = 0.0;
    if (motion.drift_order > 0) {
      t = (cell.mean.y() - motion.centre.y()) / motion.drift_length;
      p += drift.col(0) * t + drift.col(1) * (t * t);
    }
    if (!surface.evaluate(p.x(), p.y(), h)) continue;
    // Second moments after the motion: the points of the cell lie in its plane.
    const double ax = point(0, 0) + point(0, 2) * cell.slope.x(), ay = point(0, 1) + point(0, 2) * cell.slope.y();
    const double bx = point(1, 0) + point(1, 2) * cell.slope.x(), by = point(1, 1) + point(1, 2) * cell.slope.y();
    const double sxx = ax * ax * cell.sxx + 2.0 * ax * ay * cell.sxy + ay * ay * cell.syy;
    const double sxy = ax * bx * cell.sxx + (ax * by + ay * bx) * cell.sxy + ay * by * cell.syy;
    const double syy = bx * bx * cell.sxx + 2.0 * bx * by * cell.sxy + by * by * cell.syy;
    CellResidual r;
    r.cell = k;
    r.tx = h.tx;
    r.ty = h.ty;
    r.place = {p.x(), p.y(), h.z, h.zx, h.zy};
    r.drift_t = static_cast<float>(t);
    r.residual = p.z() - (h.z + 0.5 * (h.zxx * sxx + 2.0 * h.zxy * sxy + h.zyy * syy));
    if (change != nullptr) r.residual -= change->height_mm(r.place);
    r.weight = cell.count * h.count / (cell.count + h.count);
    const Eigen::Vector3d n = normal_to_machine * Eigen::Vector3d(-h.zx, -h.zy, 1.0);
    const Eigen::Vector3d q = arm * (cell.mean - motion.centre);
    r.jacobian.head<3>() = n;
    r.jacobian.tail<3>() = q.cross(n);
    out.push_back(r);
  }
}

RegistrationSolver::Outcome RegistrationSolver::solve(ScanMotion motion, const std::vector<std::uint32_t>& cells,
                                                      int iterations, const FreeForm* change) const {
  Outcome out;
  const int n = motion.parameters();
  out.normal = MatrixP::Zero(n, n);
  out.free = MatrixP::Zero(n, n);
  std::vector<double> values;
  bool last = false;
  // Steps that move nothing any more, and what rounding may leave of them: far less than any scan resolves.
  constexpr double settled_mm = 4e-8;
  constexpr double settled_rad = 4e-9;
  constexpr double by_rounding_at_most = 250.0;
  double moved_before = std::numeric_limits<double>::infinity();
  for (out.iterations = 0;; ++out.iterations) {
    residuals(motion, cells, out.cells, change);
    out.overlap = static_cast<double>(out.cells.size()) / static_cast<double>(std::max<std::size_t>(cells.size(), 1));
    if (out.cells.size() < 12) break;
    // Far from the answer the residuals have a common part; it belongs to the height, not to the scale.
    values.clear();
    for (const CellResidual& c : out.cells) values.push_back(c.residual * std::sqrt(c.weight));
    const double middle = last || out.iterations > 3 ? 0.0 : medianOf(values);
    for (double& v : values) v = std::abs(v - middle);
    out.scale = std::max(1.4826 * medianOf(values), 1e-9);
    out.normal.setZero();
    VectorP right = VectorP::Zero(n);
    double inliers = 0.0;
    for (CellResidual& c : out.cells) {
      c.robust = tukeyWeight((c.residual * std::sqrt(c.weight) - middle) / out.scale, options_.tukey_threshold);
      if (c.robust > 0.0) inliers += 1.0;
      const double w = c.weight * c.robust;
      if (w <= 0.0) continue;
      const VectorP row = c.row(n);
      for (int j = 0; j < n; ++j) {
        const double wj = w * row[j];
        right[j] -= wj * c.residual;
        for (int i = j; i < n; ++i) out.normal(i, j) += wj * row[i];
      }
    }
    for (int j = 0; j < n; ++j)
      for (int i = j + 1; i < n; ++i) out.normal(j, i) = out.normal(i, j);
    out.inliers = inliers / static_cast<double>(out.cells.size());
    out.prior = VectorP::Zero(n);
    if (motion.drift_order > 1)
      for (int k = 0; k < 3; ++k) {
        out.prior[9 + k] = std::pow(out.scale / motion.bend_sigma[k], 2);
        out.normal(9 + k, 9 + k) += out.prior[9 + k];
        right[9 + k] -= out.prior[9 + k] * motion.drift(k, 1);
      }
    if (last) break;
    // Solve in scaled parameters; directions that the surface does not determine are left where they are.
    const VectorP scale_of = scales(out.normal, out.prior);
    const MatrixP scaled = scale_of.cwiseInverse().asDiagonal() * out.normal * scale_of.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
    VectorP step = VectorP::Zero(n);
    out.free.setZero();
    out.free_count = 0;
    const double largest = eigen.eigenvalues()[n - 1];
    const VectorP scaled_right = right.cwiseQuotient(scale_of);
    for (int i = 0; i < n; ++i) {
      const VectorP v = eigen.eigenvectors().col(i);
      if (eigen.eigenvalues()[i] <= options_.degenerate_ratio * largest) {
        out.free += v * v.transpose();
        ++out.free_count;
      } else {
        step += v.dot(scaled_right) / eigen.eigenvalues()[i] * v;
      }
    }
    step = step.cwiseQuotient(scale_of).eval();
    // No step may leave the region in which the linear model means anything.
    const double size = std::max(step.head<3>().norm() / 2.0, step.segment<3>(3).norm() / 0.05);
    if (size > 1.0) step /= size;
    motion.shift += step.head<3>();
    motion.rotation = rotationOf(step.segment<3>(3)) * motion.rotation;
    for (int k = 0; k < motion.drift_order; ++k) motion.drift.col(k) += step.segment<3>(6 + 3 * k);
    const double moved = step.head<3>().norm() / settled_mm + step.segment<3>(3).norm() / settled_rad;
    // Where two scans agree to the last digit, cells at the edge come and go with rounding and steps become no smaller.
    const bool by_rounding = moved < by_rounding_at_most && moved > 0.5 * moved_before;
    const bool settled = moved < 1.0 || by_rounding;
    moved_before = moved;
    if (settled) out.converged = true;
    if (settled || out.iterations + 1 >= iterations) last = true;
  }
  out.motion = motion;
  out.tukey_threshold = options_.tukey_threshold;
  values.clear();
  for (const CellResidual& c : out.cells) values.push_back(std::abs(c.residual));
  out.median_residual = medianOf(values);
  return out;
}

MatrixP RegistrationSolver::inverseNormal(const Outcome& outcome) const {
  // In scaled parameters.
  const VectorP scale = scales(outcome.normal, outcome.prior);
  const MatrixP scaled = scale.cwiseInverse().asDiagonal() * outcome.normal * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const int n = outcome.motion.parameters();
  MatrixP inverse = MatrixP::Zero(n, n);
  for (int i = 0; i < n; ++i)
    if (eigen.eigenvalues()[i] > options_.degenerate_ratio * eigen.eigenvalues()[n - 1])
      inverse += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() / eigen.eigenvalues()[i];
  return scale.cwiseInverse().asDiagonal() * inverse * scale.cwiseInverse().asDiagonal();
}

RegistrationSolver::Outcome RegistrationSolver::bend(const Outcome& outcome) const {
  ScanMotion motion = outcome.motion;
  motion.drift_order = 2;
  const double part = motion.drift_length / options_.smooth_length_mm;
  for (int k = 0; k < 3; ++k) {
    const double size = std::hypot(motion.shift[k], motion.drift(k, 0) / part);
    motion.bend_sigma[k] = std::max(0.5 * part * part * size, 1e-7);
  }
  return solve(motion, filled_, options_.most_iterations);
}

double RegistrationSolver::cost(const Outcome& outcome) const noexcept {
  // A typical residual, made worse by what does not overlap or does not agree.
  const double seen = std::max(outcome.overlap, 1e-3);
  return (outcome.median_residual + 1e-4) / (seen * seen);
}

RegistrationSolver::Outcome RegistrationSolver::search() const {
  const std::size_t stride = std::max<std::size_t>(1, filled_.size() / 350);
  std::vector<std::uint32_t> sample;
  for (std::size_t k = stride / 2; k < filled_.size(); k += stride) sample.push_back(filled_[k]);
  struct Candidate {
    double cost;
    ScanMotion motion;
  };
  std::vector<Candidate> candidates;
  const ScanMotion base = start();
  const Eigen::Vector3d apart = base.to_cloud.inverse() * (target_.grid().centroid_mm - source_.centroid_mm);
  std::vector<Eigen::Vector3d> bases{base.shift};
  if ((apart.head<2>() - base.shift.head<2>()).norm() > 0.5 * options_.search_mm) bases.push_back(apart);
  constexpr int half = 2;
  for (const Eigen::Vector3d& from : bases)
    for (int ix = -half; ix <= half; ++ix)
      for (int iy = -half; iy <= half; ++iy)
        for (int ic = -1; ic <= 1; ++ic) {
          ScanMotion motion = base;
          motion.shift = from + options_.search_mm / half * Eigen::Vector3d(ix, iy, 0.0);
          motion.shift.z() = apart.z();
          motion.rotation = rotationOf(Eigen::Vector3d(0.0, 0.0, ic * options_.search_rad * 0.75)) * base.rotation;
          Outcome outcome = solve(motion, sample, 8);
          candidates.push_back({cost(outcome), outcome.motion});
        }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  Outcome best;
  double best_cost = 1e300;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, candidates.size()); ++i) {
    Outcome outcome = solve(candidates[i].motion, sample, options_.most_iterations);
    if (cost(outcome) < best_cost) {
      best_cost = cost(outcome);
      best = std::move(outcome);
    }
  }
  return best;
}

// --- noise -----------------------------------------------------------------------------------------------------------

namespace {

/// Rows differ in height by errors of their own (the same everywhere) and by errors of their position along y (in
/// proportion to the slope there). Part of the second, 0 to 1, from a line through the squares over the squared slope.
double steepShare(const std::vector<std::pair<double, double>>& squares) {
  const auto n = static_cast<double>(squares.size());
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [x, y] : squares) {
    mx += x / n;
    my += y / n;
  }
  for (const auto& [x, y] : squares) {
    xx += (x - mx) * (x - mx);
    xy += (x - mx) * (y - my);
  }
  return xx > 0.0 && my > 0.0 ? std::clamp(xy / xx * mx / my, 0.0, 1.0) : 0.0;
}

}  // namespace

RegistrationNoise registrationNoise(const RegistrationSolver::Outcome& outcome, const CellGrid& source,
                                    const CellGrid& target, const MatrixP& inverse_normal) {
  RegistrationNoise noise;
  // Standardised residuals on the source's lattice.
  const std::size_t total = source.cells.size();
  std::vector<float> field(total, std::nanf(""));
  double sum = 0.0, count = 0.0, phase_x = 0.0, phase_y = 0.0;
  const double cut = 3.5 * outcome.scale;
  for (const CellResidual& c : outcome.cells) {
    const double s = c.residual * std::sqrt(c.weight);
    if (std::abs(s) > cut) continue;
    field[c.cell] = static_cast<float>(s);
    sum += s * s;
    count += 1.0;
    phase_x += splineNoiseFactor(c.tx);
    phase_y += splineNoiseFactor(c.ty);
  }
  if (count < 12.0) return noise;
  // Variance of one cell: what the cut took away and the six parameters are given back.
  double variance = sum / std::max(count - 6.0, 1.0) / 0.99387;
  const double kx = phase_x / count, ky = phase_y / count;
  // Share of the two scans: the target's noise is smoothed by its spline (factor kx ky), which spreads it without
  // removing it: in the long run every node counts once.
  const double a = source.noise_mm * source.noise_mm, b = target.noise_mm * target.noise_mm;
  const double interpolated = (a + b) / (a + kx * ky * b);

  // Rows of cells share the errors of their profiles: height, tilt, position along x. Together, for a row tells them
  // apart only as far as the surface lets it.
  const int n = outcome.motion.parameters();
  struct Row {
    Eigen::Matrix3d xx = Eigen::Matrix3d::Zero();
    Eigen::Vector3d xr = Eigen::Vector3d::Zero();
    std::array<VectorP, 3> xj;
    double count = 0.0;
    double steepness = 0.0;  ///< mean of (dz/dy)^2: what an error of the profile's position along y does to its height
    bool told = false;
    Eigen::Vector3d error = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  };
  const auto basisOf = [&](const CellResidual& c) {
    return Eigen::Vector3d(1.0, source.cells[c.cell].mean.x() - source.centroid_mm.x(), -c.jacobian[0]);
  };
  std::vector<Row> rows(static_cast<std::size_t>(source.rows));
  for (Row& row : rows) row.xj.fill(VectorP::Zero(n));
  for (const CellResidual& c : outcome.cells) {
    if (c.robust <= 0.0) continue;
    Row& row = rows[c.cell / static_cast<std::uint32_t>(source.columns)];
    const Eigen::Vector3d basis = basisOf(c);
    const double w = c.weight * c.robust;
    row.count += 1.0;
    row.steepness += c.jacobian[1] * c.jacobian[1];
    const VectorP jacobian = c.row(n);
    row.xx += w * basis * basis.transpose();
    row.xr += w * c.residual * basis;
    for (int i = 0; i < 3; ++i) row.xj[static_cast<std::size_t>(i)] += w * basis[i] * jacobian;
  }
  double told = 0.0;
  for (Row& row : rows) {
    constexpr double least_cells = 8.0;
    if (row.count < least_cells || !(row.xx.diagonal().minCoeff() > 0.0)) continue;
    const Eigen::Vector3d size = row.xx.diagonal().cwiseSqrt();
    const Eigen::Matrix3d scaled = size.cwiseInverse().asDiagonal() * row.xx * size.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scaled);
    constexpr double collinear = 1e-6;
    if (!(eigen.eigenvalues()[0] > collinear)) continue;
    row.inverse = size.cwiseInverse().asDiagonal() * scaled.inverse() * size.cwiseInverse().asDiagonal();
    row.error = row.inverse * row.xr;
    row.steepness /= row.count;
    row.told = true;
    told += 1.0;
  }
  // What of the residuals is no error of a whole profile.
  double within = 0.0;
  double counted = 0.0;
  for (const CellResidual& c : outcome.cells) {
    const std::size_t at = c.cell / static_cast<std::uint32_t>(source.columns);
    if (!(field[c.cell] == field[c.cell]) || !rows[at].told) continue;
    field[c.cell] -= static_cast<float>(rows[at].error.dot(basisOf(c)) * std::sqrt(c.weight));
    within += static_cast<double>(field[c.cell]) * static_cast<double>(field[c.cell]);
    counted += 1.0;
  }
  const double per_row = told > 0.0 ? counted / told : 0.0;
  if (told > 0.0) variance = within / std::max(counted - 3.0 * told - 6.0, 1.0) / 0.99387;

  // Autocovariance over neighbouring cells, less what the spline makes of white noise in the target.
  constexpr int reach = 2;
  double measured = 0.0, lags = 0.0, pairs_sum = 0.0;
  for (int dr = 0; dr <= reach; ++dr)
    for (int dc = dr == 0 ? 1 : -reach; dc <= reach; ++dc) {
      double product = 0.0, pairs = 0.0;
      for (int r = 0; r + dr < source.rows; ++r) {
        const float* row = field.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(source.columns);
        const float* other = row + static_cast<std::size_t>(dr) * static_cast<std::size_t>(source.columns);
        const int from = std::max(0, -dc), to = std::min(source.columns, source.columns - dc);
        for (int c = from; c < to; ++c) {
          const float v = row[c] * other[c + dc];
          if (v == v) {
            product += v;
            pairs += 1.0;
          }
        }
      }
      if (pairs < 8.0) continue;
      // In its own row a cell lost something of all others to the three errors of the row.
      const double lost = dr == 0 && per_row > 0.0 ? 3.0 / per_row * variance : 0.0;
      measured += 2.0 * (product / pairs + lost);
      lags += 1.0;
      pairs_sum += pairs;
    }
  double long_run = variance * interpolated;
  if (lags > 0.0) {
    const double excess = measured - variance * (interpolated - 1.0);
    const double error = 2.0 * variance * std::sqrt(lags / (pairs_sum / lags));
    if (excess > 0.0) long_run += excess * std::max(0.0, 1.0 - std::pow(1.5 * error / excess, 2));
  }
  // With weights n_s n_t / (n_s + n_t) white noise alone gives (a + b) / 2.
  const double white = std::max(0.5 * (a + b), 1e-18);
  // Points that scatter within their cells far more than the cells do among each other show relief that the cells do
  // not resolve. What it shifts is alike in all cells and not averaged away.
  constexpr double least_correlation = 0.5;
  long_run = std::max(long_run, least_correlation * white);
  noise.correlation = long_run / white;
  noise.misfit_ratio = std::sqrt(variance * interpolated / white);
  noise.unit_variance = long_run;

  // Sums of squared scores.
  MatrixP scores = MatrixP::Zero(n, n);
  for (const CellResidual& c : outcome.cells) {
    const double w = c.weight * c.robust * c.robust;
    if (w <= 0.0) continue;
    const VectorP row = c.row(n);
    for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i) scores(i, j) += w * row[j] * row[i];
  }
  for (int j = 0; j < n; ++j)
    for (int i = j + 1; i < n; ++i) scores(j, i) = scores(i, j);
  // Before anything is measured: weight^2 times variance, with the variance of a unit of `normal`.
  MatrixP prior = MatrixP::Zero(n, n);
  prior.diagonal() = outcome.scale * outcome.scale * outcome.prior;
  // Tukey's loss costs a little efficiency: variance of psi over the squared mean of its slope (Huber 1981).
  double psi2 = 0.0, slope = 0.0, robust = 0.0, robust2 = 0.0;
  const double threshold = outcome.tukey_threshold * outcome.scale;
  for (const CellResidual& c : outcome.cells) {
    if (c.robust <= 0.0) continue;
    const double s = c.residual * std::sqrt(c.weight);
    const double u = s * s / (threshold * threshold);
    psi2 += s * s * c.robust * c.robust;
    slope += (1.0 - u) * (1.0 - 5.0 * u);
    robust += c.robust;
    robust2 += c.robust * c.robust;
  }
  const double efficiency = (psi2 / (slope * slope)) / (variance * robust2 / (robust * robust));
  MatrixP middle = long_run * std::clamp(efficiency, 1.0, 1.5) * scores;
  for (std::size_t i = 0; i < 3; ++i) {
    double excess = 0.0, expected = 0.0, used = 0.0;
    std::vector<std::pair<double, double>> by_steepness;  // (dz/dy)^2 of the row, excess of its square
    for (const Row& row : rows) {
      if (!row.told) continue;
      const auto k = static_cast<Eigen::Index>(i);
      const double estimate = row.error[k];
      excess += estimate * estimate;
      // Across rows the spline smooths the target's part.
      const double white_part = long_run * (a + ky * b) / (a + b) * row.inverse(k, k);
      expected += white_part;
      used += 1.0;
      by_steepness.emplace_back(row.steepness, estimate * estimate - white_part);
    }
    if (used < 8.0) continue;
    const double error = expected / used * std::sqrt(2.0 / used);
    double row_variance = (excess - expected) / used;
    if (row_variance < 2.0 * error) continue;
    row_variance *= (a + b) / (a + ky * b);  // in the long run every profile of the target counts once
    const double share = i == 0 ? steepShare(by_steepness) : 0.0;
    noise.row_variance[i] = row_variance;
    if (i == 0) noise.steep_share = share;
    double mean_steepness = 0.0;
    for (const auto& [steepness, square] : by_steepness) mean_steepness += steepness / used;
    for (const Row& row : rows) {
      if (!row.told) continue;
      const double own = share > 0.0 ? 1.0 - share + share * row.steepness / mean_steepness : 1.0;
      middle.noalias() += own * row_variance * row.xj[i] * row.xj[i].transpose();
    }
  }
  noise.covariance = MatrixP(inverse_normal * (middle + prior) * inverse_normal).topLeftCorner<6, 6>();
  noise.white = MatrixP(inverse_normal * (white * scores + prior) * inverse_normal).topLeftCorner<6, 6>();
  return noise;
}

}  // namespace spindrift
