// SPDX-License-Identifier: Apache-2.0
#include "core/probing/cycle_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/singular_values.h"
#include "core/math/statistics.h"

namespace spindrift {

void CycleFitOptions::validate() const {
  SPINDRIFT_ASSERT(outlier_threshold >= 0.0, "outlier threshold must not be negative");
  SPINDRIFT_ASSERT(!sigma_mm || *sigma_mm > 0.0, "touch noise must be positive");
  SPINDRIFT_ASSERT(rank_tolerance > 0.0 && rank_tolerance < 1.0, "rank tolerance must lie between 0 and 1");
}

std::string combinationText(const Eigen::VectorXd& combination, const std::vector<std::string>& names) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(combination.size()));
  for (Eigen::Index i = 0; i < combination.size(); ++i) order[static_cast<std::size_t>(i)] = i;
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return std::abs(combination(a)) > std::abs(combination(b)); });
  const double sign = order.empty() || combination(order.front()) >= 0.0 ? 1.0 : -1.0;
  std::string text;
  for (const Eigen::Index i : order) {
    if (std::abs(combination(i)) < 0.15) break;
    text += fmt::format("{}{} {:+.2f}", text.empty() ? "" : ", ", names[static_cast<std::size_t>(i)],
                        sign * combination(i));
  }
  return text;
}

Eigen::MatrixXd CycleFitResult::covarianceBetween(int cycle_a, int cycle_b) const {
  const auto a = static_cast<std::size_t>(cycle_a);
  const auto b = static_cast<std::size_t>(cycle_b);
  Eigen::MatrixXd common = from_constant[a] * constant_covariance * from_constant[b].transpose();
  if (!causes.empty()) common += causes[a] * causes[b].transpose();
  if (!known.empty()) common -= known[a] * known[b].transpose();
  return common;
}

void addCauses(const CycleProblem& problem, const Eigen::MatrixXd& shift_mm, CycleFitResult& fit) {
  SPINDRIFT_ASSERT(shift_mm.rows() == static_cast<Eigen::Index>(problem.rows.size()), "causes and rows do not match");
  const auto n = static_cast<Eigen::Index>(problem.parameters.size());
  SPINDRIFT_ASSERT(fit.causes.empty() && fit.known.empty(), "causes come first, and once");
  fit.causes.assign(fit.cycles.size(), Eigen::MatrixXd::Zero(n, shift_mm.cols()));
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    const CycleRow& row = problem.rows[r];
    if (!fit.used[r] || row.cycle == problem.reference_cycle) continue;
    // A value counts against its constant: d theta / d y = -d theta / d b.
    const auto k = static_cast<std::size_t>(row.cycle);
    fit.causes[k] -= fit.from_constant[k].col(row.key) * shift_mm.row(static_cast<Eigen::Index>(r));
  }
  for (std::size_t k = 0; k < fit.cycles.size(); ++k) {
    CycleSolution& solution = fit.cycles[k];
    const Eigen::MatrixXd more = fit.causes[k] * fit.causes[k].transpose();
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const bool determined =
            solution.determined[static_cast<std::size_t>(i)] && solution.determined[static_cast<std::size_t>(j)];
        if (determined) solution.covariance(i, j) += more(i, j);
      }
    }
  }
}

void combineWith(const CycleProblem& problem, const KnownCombination& known, CycleFitResult& fit) {
  std::vector<Eigen::Index> entries;
  for (std::size_t i = 0; i < known.cycles.size(); ++i) {
    SPINDRIFT_ASSERT(known.cycles[i] != problem.reference_cycle, "the reference cycle is zero by definition");
    const CycleSolution& solution = fit.cycles[static_cast<std::size_t>(known.cycles[i])];
    bool open = false;
    for (Eigen::Index p = 0; p < known.row.size(); ++p)
      open = open || (known.row(p) != 0.0 && !solution.determined[static_cast<std::size_t>(p)]);
    if (!open) entries.push_back(static_cast<Eigen::Index>(i));
  }
  const auto count = static_cast<Eigen::Index>(entries.size());
  if (count == 0) return;
  const auto n = static_cast<Eigen::Index>(problem.parameters.size());
  const auto cycleOf = [&](Eigen::Index e) {
    return known.cycles[static_cast<std::size_t>(entries[static_cast<std::size_t>(e)])];
  };
  // cov(theta_k, combination in every cycle); parameters that a cycle leaves open are told nothing.
  std::vector<Eigen::MatrixXd> cross(fit.cycles.size(), Eigen::MatrixXd::Zero(n, count));
  Eigen::MatrixXd of_constant(fit.constant_mm.size(), count);
  for (Eigen::Index e = 0; e < count; ++e) {
    const int there = cycleOf(e);
    of_constant.col(e) = fit.constant_covariance *
                         (fit.from_constant[static_cast<std::size_t>(there)].transpose() * known.row.transpose());
    for (std::size_t k = 0; k < fit.cycles.size(); ++k) {
      if (static_cast<int>(k) == problem.reference_cycle) continue;
      const CycleSolution& solution = fit.cycles[k];
      Eigen::MatrixXd covariance =
          static_cast<int>(k) == there ? solution.covariance : fit.covarianceBetween(static_cast<int>(k), there);
      for (Eigen::Index p = 0; p < n; ++p)
        if (!solution.determined[static_cast<std::size_t>(p)]) covariance.row(p).setZero();
      for (Eigen::Index p = 0; p < n; ++p)
        if (known.row(p) != 0.0) cross[k].col(e) += covariance.col(p) * known.row(p);
    }
  }
  Eigen::MatrixXd S(count, count);
  Eigen::VectorXd innovation(count);
  for (Eigen::Index e = 0; e < count; ++e) {
    const auto there = static_cast<std::size_t>(cycleOf(e));
    innovation(e) = known.value(entries[static_cast<std::size_t>(e)]) - known.row.dot(fit.cycles[there].theta);
    S.row(e) = known.row * cross[there];
    for (Eigen::Index f = 0; f < count; ++f)
      S(e, f) += known.covariance(entries[static_cast<std::size_t>(e)], entries[static_cast<std::size_t>(f)]);
  }
  const Eigen::LLT<Eigen::MatrixXd> root(0.5 * (S + S.transpose()));
  SPINDRIFT_ASSERT(root.info() == Eigen::Success, "touches have noise, so the sum of both covariances is definite");
  const Eigen::VectorXd weighed = root.solve(innovation);

  std::vector<Eigen::VectorXd> change(fit.cycles.size(), Eigen::VectorXd::Zero(n));
  const bool first = fit.known.empty();
  if (first) fit.known.assign(fit.cycles.size(), Eigen::MatrixXd::Zero(n, 0));
  for (std::size_t k = 0; k < fit.cycles.size(); ++k) {
    change[k] = cross[k] * weighed;
    fit.cycles[k].theta += change[k];
    const Eigen::MatrixXd less = root.matrixL().solve(cross[k].transpose()).transpose();
    fit.cycles[k].covariance -= less * less.transpose();
    Eigen::MatrixXd both(n, fit.known[k].cols() + count);
    both << fit.known[k], less;
    fit.known[k] = std::move(both);
  }
  const Eigen::VectorXd of_b = of_constant * weighed;
  fit.constant_mm += of_b;
  for (std::size_t r = 0; r < problem.rows.size(); ++r) {
    const CycleRow& row = problem.rows[r];
    fit.residual_mm[r] -=
        of_b(row.key) +
        problem.jacobian.row(static_cast<Eigen::Index>(r)).dot(change[static_cast<std::size_t>(row.cycle)].transpose());
  }
}

namespace {

struct CyclePart {
  std::vector<int> rows;    // indices of used rows
  Eigen::MatrixXd A;        // whitened jacobian with priors below
  Eigen::VectorXd y;        // whitened values
  Eigen::MatrixXd range;    // orthonormal basis of the range of A (rows x rank)
  Eigen::MatrixXd inverse;  // pseudo-inverse, parameters x rows
  Eigen::VectorXd unscale;  // from scaled parameters to internal units
  Eigen::MatrixXd null;     // null space of A (scaled parameters)
  double condition = 0.0;
  Eigen::VectorXd weakest;
};

class Solver {
 public:
  Solver(const CycleProblem& problem, const CycleFitOptions& options) : problem_(problem), options_(options) {
    used_.assign(problem.rows.size(), true);
    sigma_.assign(static_cast<std::size_t>(problem.groups),
                  options.sigma_mm.value_or(CycleFitOptions::assumed_sigma_mm));
    // Columns are scaled alike in all cycles, so that "weak" means the same everywhere.
    scale_ = problem.jacobian.colwise().norm();
    for (const CyclePrior& prior : problem.priors) {
      scale_ = scale_.cwiseMax(prior.row.cwiseAbs().transpose());
    }
    for (Eigen::Index j = 0; j < scale_.size(); ++j) {
      if (!(scale_(j) > 0.0)) scale_(j) = 1.0;
    }
    of_cycle_.resize(static_cast<std::size_t>(problem.cycles));
    for (std::size_t r = 0; r < problem.rows.size(); ++r) {
      of_cycle_[static_cast<std::size_t>(problem.rows[r].cycle)].push_back(static_cast<int>(r));
    }
  }

  CycleFitResult run() {
    solve();
    estimateNoise(true);
    solve();
    if (options_.outlier_threshold > 0.0) {
      // One touch per cycle and pass; a bad touch spoils the others of its cycle, so the worst goes first.
      for (int pass = 0; pass < 200; ++pass) {
        if (!rejectWorst()) break;
        solve();
        estimateNoise(true);
      }
    }
    for (int iteration = 0; iteration < 4; ++iteration) {
      const std::vector<double> before = sigma_;
      estimateNoise(false);
      solve();
      double change = 0.0;
      for (std::size_t g = 0; g < sigma_.size(); ++g) change = std::max(change, std::abs(sigma_[g] / before[g] - 1.0));
      if (change < 1e-3) break;
    }
    return finish();
  }

 private:
  [[nodiscard]] double sigmaOf(int row) const {
    return sigma_[static_cast<std::size_t>(problem_.rows[static_cast<std::size_t>(row)].group)];
  }

  void preparePart(int k, CyclePart& part) {
    const auto n = static_cast<Eigen::Index>(problem_.parameters.size());
    part.rows.clear();
    for (const int r : of_cycle_[static_cast<std::size_t>(k)]) {
      if (used_[static_cast<std::size_t>(r)]) part.rows.push_back(r);
    }
    const auto m = static_cast<Eigen::Index>(part.rows.size());
    const bool reference = k == problem_.reference_cycle;
    const auto extra = reference ? 0 : static_cast<Eigen::Index>(problem_.priors.size());
    part.y.resize(m + extra);
    part.A.resize(m + extra, n);
    for (Eigen::Index i = 0; i < m; ++i) {
      const int r = part.rows[static_cast<std::size_t>(i)];
      part.y(i) = problem_.rows[static_cast<std::size_t>(r)].value_mm / sigmaOf(r);
      part.A.row(i) = problem_.jacobian.row(r).cwiseQuotient(scale_.transpose()) / sigmaOf(r);
    }
    for (Eigen::Index i = 0; i < extra; ++i) {
      const CyclePrior& prior = problem_.priors[static_cast<std::size_t>(i)];
      const double value =
          prior.value_of_cycle.empty() ? prior.value : prior.value_of_cycle[static_cast<std::size_t>(k)];
      part.y(m + i) = value / prior.sigma;
      part.A.row(m + i) = prior.row.cwiseQuotient(scale_.transpose()) / prior.sigma;
    }
    if (reference) {
      part.range.resize(m, 0);
      return;
    }
    // Unit columns after whitening: "weak" then means how well a parameter is seen beside the others.
    part.unscale = part.A.colwise().norm().transpose();
    for (Eigen::Index p = 0; p < n; ++p) {
      if (!(part.unscale(p) > 0.0)) part.unscale(p) = 1.0;
      part.A.col(p) /= part.unscale(p);
    }
    part.unscale = part.unscale.cwiseProduct(scale_).cwiseInverse();
    if (part.A.rows() == 0) {
      // No touch of the cycle is left: nothing of it is seen.
      part.range.resize(0, 0);
      part.inverse.resize(n, 0);
      part.null = Eigen::MatrixXd::Identity(n, n);
      part.condition = std::numeric_limits<double>::infinity();
      part.weakest = part.null.col(n - 1);
      return;
    }
    const SingularValues svd = singularValues(part.A, RightVectors::Full);
    const Eigen::VectorXd& s = svd.values;
    const Eigen::Index rank = svd.rank(options_.rank_tolerance);
    part.range = svd.left.leftCols(rank);
    part.inverse = svd.right.leftCols(rank) * s.head(rank).cwiseInverse().asDiagonal() * part.range.transpose();
    part.null = svd.right.rightCols(n - rank);
    part.condition = rank == n ? s(0) / s(n - 1) : std::numeric_limits<double>::infinity();
    part.weakest = svd.right.col(n - 1);
  }

  void solve() {
    const auto keys = static_cast<Eigen::Index>(problem_.keys);
    parts_.resize(static_cast<std::size_t>(problem_.cycles));
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(keys, keys);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(keys);
    for (int k = 0; k < problem_.cycles; ++k) {
      CyclePart& part = parts_[static_cast<std::size_t>(k)];
      preparePart(k, part);
      const auto m = static_cast<Eigen::Index>(part.rows.size());
      // What the cycle says about b: rows projected on the complement of the range of A.
      const Eigen::VectorXd y = part.y - part.range * (part.range.transpose() * part.y);
      const Eigen::MatrixXd top = part.range.topRows(m);
      const Eigen::MatrixXd product = top * top.transpose();
      for (Eigen::Index i = 0; i < m; ++i) {
        const int ri = part.rows[static_cast<std::size_t>(i)];
        const int key_i = problem_.rows[static_cast<std::size_t>(ri)].key;
        right(key_i) += y(i) / sigmaOf(ri);
        for (Eigen::Index j = 0; j < m; ++j) {
          const int rj = part.rows[static_cast<std::size_t>(j)];
          const int key_j = problem_.rows[static_cast<std::size_t>(rj)].key;
          normal(key_i, key_j) += ((i == j ? 1.0 : 0.0) - product(i, j)) / (sigmaOf(ri) * sigmaOf(rj));
        }
      }
    }
    // The eigenvalues lie between 1 (seen by the reference cycle only) and the number of cycles, in units of 1/sigma^2:
    // the normal matrix is harmless here.
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(normal);
    const double largest = keys > 0 ? modes.eigenvalues()(keys - 1) : 0.0;
    Eigen::Index open = 0;
    while (open < keys && !(modes.eigenvalues()(open) > 1e-9 * largest)) ++open;
    constant_null_ = modes.eigenvectors().leftCols(open);
    const auto kept = keys - open;
    constant_covariance_ = modes.eigenvectors().rightCols(kept) *
                           modes.eigenvalues().tail(kept).cwiseInverse().asDiagonal() *
                           modes.eigenvectors().rightCols(kept).transpose();
    constant_ = constant_covariance_ * right;
    residuals();
  }

  /// Whitened b of the rows of a part (priors: 0).
  [[nodiscard]] Eigen::VectorXd whitenedConstant(const CyclePart& part) const {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(part.y.size());
    for (std::size_t i = 0; i < part.rows.size(); ++i) {
      b(static_cast<Eigen::Index>(i)) =
          constant_(problem_.rows[static_cast<std::size_t>(part.rows[i])].key) / sigmaOf(part.rows[i]);
    }
    return b;
  }

  /// Whitened covariance root of b at the rows of a part: W B.
  [[nodiscard]] Eigen::MatrixXd constantCovarianceAt(const CyclePart& part) const {
    const auto m = static_cast<Eigen::Index>(part.rows.size());
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(part.y.size(), part.y.size());
    for (Eigen::Index i = 0; i < m; ++i) {
      const int ri = part.rows[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < m; ++j) {
        const int rj = part.rows[static_cast<std::size_t>(j)];
        c(i, j) = constant_covariance_(problem_.rows[static_cast<std::size_t>(ri)].key,
                                       problem_.rows[static_cast<std::size_t>(rj)].key) /
                  (sigmaOf(ri) * sigmaOf(rj));
      }
    }
    return c;
  }

  void residuals() {
    residual_.assign(problem_.rows.size(), 0.0);
    freedom_.assign(problem_.rows.size(), 0.0);
    theta_.assign(static_cast<std::size_t>(problem_.cycles),
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem_.parameters.size())));
    for (int k = 0; k < problem_.cycles; ++k) {
      const CyclePart& part = parts_[static_cast<std::size_t>(k)];
      const Eigen::VectorXd z = part.y - whitenedConstant(part);
      Eigen::VectorXd fitted = Eigen::VectorXd::Zero(z.size());
      if (k != problem_.reference_cycle) {
        theta_[static_cast<std::size_t>(k)] = part.inverse * z;
        fitted = part.range * (part.range.transpose() * z);
      }
      const Eigen::MatrixXd c = constantCovarianceAt(part);
      const Eigen::MatrixXd projected = c - part.range * (part.range.transpose() * c);  // P C
      for (std::size_t i = 0; i < part.rows.size(); ++i) {
        const auto e = static_cast<Eigen::Index>(i);
        const auto r = static_cast<std::size_t>(part.rows[i]);
        residual_[r] = (z(e) - fitted(e)) * sigmaOf(part.rows[i]);
        const double pcp = projected(e, e) - (projected.row(e) * part.range).dot(part.range.row(e));
        freedom_[r] = std::max(0.0, 1.0 - part.range.row(e).squaredNorm() - pcp);
      }
    }
  }

  void estimateNoise(bool robust) {
    if (options_.sigma_mm) return;
    const auto groups = static_cast<std::size_t>(problem_.groups);
    std::vector<std::vector<double>> scaled(groups);
    std::vector<double> squares(groups, 0.0);
    freedom_of_group_.assign(groups, 0.0);
    double all_squares = 0.0;
    double all_freedom = 0.0;
    std::vector<double> all_scaled;
    for (std::size_t r = 0; r < problem_.rows.size(); ++r) {
      if (!used_[r] || freedom_[r] < 1e-6) continue;
      const auto g = static_cast<std::size_t>(problem_.rows[r].group);
      const double s = std::abs(residual_[r]) / std::sqrt(freedom_[r]);
      scaled[g].push_back(s);
      all_scaled.push_back(s);
      squares[g] += residual_[r] * residual_[r];
      freedom_of_group_[g] += freedom_[r];
      all_squares += residual_[r] * residual_[r];
      all_freedom += freedom_[r];
    }
    // No probe repeats to less than ten nanometres; without noise what is left is of second order, and weights that
    // follow it would call one kind of touch infinitely better than another.
    constexpr double floor_mm = 1e-5;
    for (std::size_t g = 0; g < groups; ++g) {
      // A group that hardly estimates its own noise borrows from all touches.
      const bool own = freedom_of_group_[g] >= 8.0;
      // Where no touch checks another, nothing is known of the noise, and what was assumed stands.
      if (!(all_freedom > 0.5)) {
        sigma_[g] = CycleFitOptions::assumed_sigma_mm;
        continue;
      }
      const double sigma = robust ? 1.4826 * median(own ? scaled[g] : all_scaled)
                                  : std::sqrt(own ? squares[g] / freedom_of_group_[g] : all_squares / all_freedom);
      sigma_[g] = std::max(sigma, floor_mm);
    }
  }

  bool rejectWorst() {
    // Candidate of each cycle, all judged by what was used before this pass: a touch that goes now has still spoiled
    // the residuals of its key in the other cycles.
    const auto before = used_;
    bool any = false;
    for (int k = 0; k < problem_.cycles; ++k) {
      int worst = -1;
      double worst_value = options_.outlier_threshold;
      for (const int r : parts_[static_cast<std::size_t>(k)].rows) {
        const auto i = static_cast<std::size_t>(r);
        if (freedom_[i] < 0.05) continue;  // nothing contradicts this touch
        const double value = std::abs(residual_[i]) / (sigmaOf(r) * std::sqrt(freedom_[i]));
        if (value > worst_value && std::abs(residual_[i]) > 1e-6) {
          worst_value = value;
          worst = r;
        }
      }
      if (worst < 0) continue;
      // The constant of the touch is shared: its residual is largest where it is really bad. With equal residuals (two
      // cycles only) the later cycle gives way.
      const int key = problem_.rows[static_cast<std::size_t>(worst)].key;
      bool largest = true;
      for (std::size_t r = 0; r < problem_.rows.size() && largest; ++r) {
        if (!before[r] || problem_.rows[r].key != key || problem_.rows[r].cycle == k) continue;
        const double other = std::abs(residual_[r]) / std::sqrt(std::max(freedom_[r], 1e-3));
        const double own = std::abs(residual_[static_cast<std::size_t>(worst)]) /
                           std::sqrt(std::max(freedom_[static_cast<std::size_t>(worst)], 1e-3));
        if (other > own * (1.0 + 1e-6) || (other > own * (1.0 - 1e-6) && problem_.rows[r].cycle > k)) {
          largest = false;
        }
      }
      if (!largest) continue;
      used_[static_cast<std::size_t>(worst)] = false;
      any = true;
    }
    return any;
  }

  CycleFitResult finish() {
    CycleFitResult result;
    const auto n = static_cast<Eigen::Index>(problem_.parameters.size());
    result.cycles.resize(static_cast<std::size_t>(problem_.cycles));
    result.from_constant.resize(static_cast<std::size_t>(problem_.cycles));
    result.group_sigma_mm = sigma_;
    result.group_degrees_of_freedom = freedom_of_group_;
    result.used = used_;
    result.constant_mm = constant_;
    result.constant_covariance = constant_covariance_;
    result.residual_mm = residual_;
    result.studentised.assign(problem_.rows.size(), 0.0);
    bool all = true;
    for (int k = 0; k < problem_.cycles; ++k) {
      CycleSolution& solution = result.cycles[static_cast<std::size_t>(k)];
      const CyclePart& part = parts_[static_cast<std::size_t>(k)];
      Eigen::MatrixXd& gain = result.from_constant[static_cast<std::size_t>(k)];
      gain = Eigen::MatrixXd::Zero(n, problem_.keys);
      solution.theta = Eigen::VectorXd::Zero(n);
      solution.covariance = Eigen::MatrixXd::Zero(n, n);
      solution.own_covariance = Eigen::MatrixXd::Zero(n, n);
      solution.determined.assign(static_cast<std::size_t>(n), true);
      solution.touches_used = static_cast<int>(part.rows.size());
      for (const int r : part.rows) {
        const double s = residual_[static_cast<std::size_t>(r)] / sigmaOf(r);
        solution.chi2 += s * s;
        result.degrees_of_freedom += freedom_[static_cast<std::size_t>(r)];
        result.studentised[static_cast<std::size_t>(r)] =
            freedom_[static_cast<std::size_t>(r)] > 1e-6 ? s / std::sqrt(freedom_[static_cast<std::size_t>(r)]) : 0.0;
      }
      if (k == problem_.reference_cycle) {
        solution.status = FitStatus::Converged;
        solution.message = "reference cycle: zero by definition";
        continue;
      }
      const Eigen::VectorXd& unscale = part.unscale;
      solution.theta = unscale.asDiagonal() * theta_[static_cast<std::size_t>(k)];
      solution.own_covariance = unscale.asDiagonal() * (part.inverse * part.inverse.transpose()) * unscale.asDiagonal();
      for (std::size_t i = 0; i < part.rows.size(); ++i) {
        gain.col(problem_.rows[static_cast<std::size_t>(part.rows[i])].key) -=
            unscale.asDiagonal() * part.inverse.col(static_cast<Eigen::Index>(i)) / sigmaOf(part.rows[i]);
      }
      solution.covariance = solution.own_covariance + gain * constant_covariance_ * gain.transpose();
      solution.condition_number = part.condition;
      solution.weakest = part.weakest;
      std::vector<std::string> open;
      const Eigen::MatrixXd through_constant = gain * constant_null_;
      for (Eigen::Index j = 0; j < n; ++j) {
        // The open directions follow the touches, which lie some tens of micrometres from where they lay in the other
        // cycles: of a parameter that is seen, 1e-4 of such a direction may be in one cycle and not in the next.
        constexpr double seen = 1e-3;
        const bool own = part.null.cols() == 0 || part.null.row(j).norm() < seen;
        const bool constant =
            constant_null_.cols() == 0 || through_constant.row(j).norm() < 1e-4 * unscale(j) / sigma_.front();
        if (own && constant) continue;
        solution.determined[static_cast<std::size_t>(j)] = false;
        open.push_back(problem_.parameters[static_cast<std::size_t>(j)]);
        solution.covariance.row(j).setZero();
        solution.covariance.col(j).setZero();
        solution.covariance(j, j) = std::numeric_limits<double>::infinity();
      }
      if (open.empty()) {
        solution.status = FitStatus::Converged;
        solution.message = "all parameters are determined";
      } else {
        all = false;
        solution.status = FitStatus::Degenerate;
        solution.message = part.rows.empty() ? "none of its touches is left, so nothing is determined:"
                                             : "not determined by the touches that are there:";
        for (const std::string& name : open) solution.message += " " + name;
        if (part.null.cols() > 0 && !part.rows.empty()) {
          solution.message += fmt::format(" (open combination: {})",
                                          combinationText(part.null.col(part.null.cols() - 1), problem_.parameters));
        }
      }
    }
    // A rejected touch is judged by the fit that did not use it.
    for (std::size_t r = 0; r < problem_.rows.size(); ++r) {
      if (used_[r]) continue;
      const CycleRow& row = problem_.rows[r];
      const Eigen::VectorXd& theta = result.cycles[static_cast<std::size_t>(row.cycle)].theta;
      result.residual_mm[r] = row.value_mm - constant_(row.key) -
                              problem_.jacobian.row(static_cast<Eigen::Index>(r)).dot(theta.transpose());
      result.studentised[r] = result.residual_mm[r] / sigmaOf(static_cast<int>(r));
    }
    result.status = all ? FitStatus::Converged : FitStatus::Degenerate;
    result.message = all ? "all parameters of all cycles are determined" : "some cycles leave parameters open";
    return result;
  }

  const CycleProblem& problem_;
  const CycleFitOptions& options_;
  std::vector<bool> used_;
  std::vector<double> sigma_;
  std::vector<double> freedom_of_group_;
  Eigen::VectorXd scale_;
  std::vector<std::vector<int>> of_cycle_;
  std::vector<CyclePart> parts_;
  std::vector<Eigen::VectorXd> theta_;
  Eigen::VectorXd constant_;
  Eigen::MatrixXd constant_covariance_;
  Eigen::MatrixXd constant_null_;
  std::vector<double> residual_;
  std::vector<double> freedom_;  // 1 - leverage
};

}  // namespace

CycleFitResult fitCycles(const CycleProblem& problem, const CycleFitOptions& options) {
  options.validate();
  SPINDRIFT_ASSERT(problem.jacobian.rows() == static_cast<Eigen::Index>(problem.rows.size()) &&
                       problem.jacobian.cols() == static_cast<Eigen::Index>(problem.parameters.size()),
                   "jacobian of a cycle fit does not match rows and parameters");
  SPINDRIFT_ASSERT(problem.reference_cycle >= 0 && problem.reference_cycle < problem.cycles,
                   "reference cycle is not among the cycles");
  return Solver(problem, options).run();
}

}  // namespace spindrift
