// SPDX-License-Identifier: Apache-2.0
#include "core/probing/cycle_drift.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/singular_values.h"

namespace spindrift {
namespace {

/// By how much a drift must lower the cost (-2 log restricted likelihood): less happens to a steady machine by chance.
constexpr double least_gain = 3.0;
/// A drift that moves the touches of a cycle by less than this part of the touch noise altogether is none.
constexpr double negligible = 0.2;
constexpr double first_factor = 2.0;
constexpr double factors[] = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0};

using Rows = std::vector<Eigen::Index>;

/// Position of the touches of a cycle in time.
struct CycleTime {
  double mean_s = 0.0;
  double duration_s = 0.0;
};

class DriftFinder {
 public:
  DriftFinder(const CycleProblem& problem, const std::vector<double>& time_s, const CycleFitOptions& options)
      : problem_(problem), time_s_(time_s), options_(options), rows_(static_cast<std::size_t>(problem.cycles)) {
    for (std::size_t r = 0; r < problem.rows.size(); ++r) {
      rows_[static_cast<std::size_t>(problem.rows[r].cycle)].push_back(static_cast<Eigen::Index>(r));
    }
    for (const Rows& rows : rows_) {
      CycleTime t;
      double first = std::numeric_limits<double>::infinity();
      double last = -first;
      for (const Eigen::Index r : rows) {
        const double s = time_s[static_cast<std::size_t>(r)];
        t.mean_s += s / static_cast<double>(rows.size());
        first = std::min(first, s);
        last = std::max(last, s);
      }
      if (!rows.empty()) t.duration_s = last - first;
      times_.push_back(t);
    }
  }

  /// The effects of the drift that each cycle may have on its touches, as columns of size 1 +- 1, whitened.
  [[nodiscard]] std::vector<Eigen::MatrixXd> drifts(const CycleFitResult& fit) const {
    std::vector<Eigen::MatrixXd> found;
    for (int k = 0; k < problem_.cycles; ++k) {
      if (rows_[static_cast<std::size_t>(k)].empty()) {
        found.push_back(Eigen::MatrixXd(0, 0));  // no touch of the cycle is left
        continue;
      }
      const Eigen::MatrixXd effects = effectsOf(fit, k, changeInside(fit, k));
      const SingularValues svd = singularValues(effects);
      Eigen::Index rank = 0;
      while (rank < svd.values.size() && svd.values(rank) * std::end(factors)[-1] > negligible) ++rank;
      found.emplace_back(svd.left.leftCols(rank) * svd.values.head(rank).asDiagonal());
    }
    return found;
  }

  /// The factors on the drifts that the cycles ask for; 0: none. Judged with the noise of `fit`, that of `model`.
  [[nodiscard]] std::vector<double> factorsOf(const CycleProblem& model, const CycleFitResult& fit,
                                              const std::vector<Eigen::MatrixXd>& drifts) const {
    const Information all = informationOf(fit);
    std::vector<double> found(drifts.size(), 0.0);
    for (int k = 0; k < problem_.cycles; ++k) {
      const Eigen::MatrixXd& drift = drifts[static_cast<std::size_t>(k)];
      if (drift.cols() == 0) continue;
      const Against against = againstOthers(model, fit, all, k);
      double best = cost(against, drift, 0.0) - least_gain;
      for (const double f : factors) {
        const double value = cost(against, drift, f);
        if (!(value < best)) continue;
        best = value;
        found[static_cast<std::size_t>(k)] = f;
      }
    }
    return found;
  }

  /// The clearest step of a cycle; see findStepInside.
  [[nodiscard]] std::optional<StepInside> step(const CycleFitResult& fit,
                                               const std::vector<Eigen::MatrixX3d>& frames) const {
    const Information all = informationOf(fit);
    std::optional<StepInside> best;
    double most = 0.0;
    for (int k = 0; k < problem_.cycles; ++k) {
      const Rows& rows = rows_[static_cast<std::size_t>(k)];
      if (std::ssize(rows) < 2 * least_touches) continue;
      const Against against = againstOthers(problem_, fit, all, k);
      for (const Eigen::MatrixX3d& frame : frames) {
        double gain = 0.0;
        const auto found = stepOf(fit, against, k, frame, gain);
        // Of two cycles either may be the moved one: the later is named.
        if (!found || gain < most) continue;
        most = gain;
        best = found;
      }
    }
    return best;
  }

  /// The problem with the drifts as further parameters of size 1 +- 1.
  [[nodiscard]] CycleProblem extended(const CycleFitResult& fit, const std::vector<Eigen::MatrixXd>& drifts,
                                      const std::vector<double>& factor) const {
    Eigen::Index columns = 0;
    for (std::size_t k = 0; k < drifts.size(); ++k) {
      if (factor[k] > 0.0) columns = std::max(columns, drifts[k].cols());
    }
    CycleProblem out = problem_;
    const Eigen::Index n = problem_.jacobian.cols();
    out.jacobian = Eigen::MatrixXd::Zero(problem_.jacobian.rows(), n + columns);
    out.jacobian.leftCols(n) = problem_.jacobian;
    // The parameters of the reference cycle are zero, its drift is not: the fit gets an empty cycle as reference.
    for (const Eigen::Index r : rows_[static_cast<std::size_t>(problem_.reference_cycle)]) {
      out.jacobian.row(r).head(n).setZero();
    }
    out.reference_cycle = out.cycles++;
    for (std::size_t k = 0; k < drifts.size(); ++k) {
      if (!(factor[k] > 0.0)) continue;
      for (std::size_t i = 0; i < rows_[k].size(); ++i) {
        out.jacobian.row(rows_[k][i]).segment(n, drifts[k].cols()) =
            factor[k] * sigmaOf(fit, rows_[k][i]) * drifts[k].row(static_cast<Eigen::Index>(i));
      }
    }
    for (CyclePrior& prior : out.priors) {
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n + columns);
      row.head(n) = prior.row;
      prior.row = row;
      if (!prior.value_of_cycle.empty()) prior.value_of_cycle.push_back(0.0);
    }
    for (Eigen::Index c = 0; c < columns; ++c) {
      out.parameters.push_back(fmt::format("drift {}", c + 1));
      CyclePrior prior;
      prior.row = Eigen::RowVectorXd::Unit(n + columns, n + c);
      prior.sigma = 1.0;
      out.priors.push_back(prior);
    }
    return out;
  }

  /// Condition and weakest combination of the parameters alone, as the touches lie.
  void describe(CycleFitResult& fit, int cycle) const {
    const Eigen::Index n = problem_.jacobian.cols();
    Rows used;
    for (const Eigen::Index r : rows_[static_cast<std::size_t>(cycle)]) {
      if (fit.used[static_cast<std::size_t>(r)]) used.push_back(r);
    }
    const auto m = static_cast<Eigen::Index>(used.size());
    Eigen::MatrixXd A(m + static_cast<Eigen::Index>(problem_.priors.size()), n);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index r = used[static_cast<std::size_t>(i)];
      A.row(i) = problem_.jacobian.row(r) / sigmaOf(fit, r);
    }
    for (std::size_t i = 0; i < problem_.priors.size(); ++i) {
      A.row(m + static_cast<Eigen::Index>(i)) = problem_.priors[i].row / problem_.priors[i].sigma;
    }
    if (A.rows() == 0) return;  // as the fit without drift has it
    normaliseColumns(A);
    const SingularValues svd = singularValues(A, RightVectors::Full);
    const Eigen::VectorXd& s = svd.values;
    const bool full = svd.rank(options_.rank_tolerance) == n;
    CycleSolution& solution = fit.cycles[static_cast<std::size_t>(cycle)];
    solution.condition_number = full ? s(0) / s(n - 1) : std::numeric_limits<double>::infinity();
    solution.weakest = svd.right.col(n - 1);
  }

 private:
  static void normaliseColumns(Eigen::MatrixXd& A) {
    for (Eigen::Index p = 0; p < A.cols(); ++p) {
      const double norm = A.col(p).norm();
      if (norm > 0.0) A.col(p) /= norm;
    }
  }

  [[nodiscard]] double sigmaOf(const CycleFitResult& fit, Eigen::Index row) const {
    return fit.group_sigma_mm[static_cast<std::size_t>(problem_.rows[static_cast<std::size_t>(row)].group)];
  }

  /// How far the parameters may go during a cycle, from the way to its neighbours.
  [[nodiscard]] Eigen::VectorXd changeInside(const CycleFitResult& fit, int cycle) const {
    Eigen::VectorXd size = Eigen::VectorXd::Zero(problem_.jacobian.cols());
    const CycleTime& own = times_[static_cast<std::size_t>(cycle)];
    if (!(own.duration_s > 0.0)) return size;
    for (const int other : {cycle - 1, cycle + 1}) {
      if (other < 0 || other >= problem_.cycles) continue;
      const CycleSolution& a = fit.cycles[static_cast<std::size_t>(cycle)];
      const CycleSolution& b = fit.cycles[static_cast<std::size_t>(other)];
      const double apart = std::abs(times_[static_cast<std::size_t>(other)].mean_s - own.mean_s);
      const double part = own.duration_s / std::max(apart, own.duration_s);
      for (Eigen::Index p = 0; p < size.size(); ++p) {
        if (!a.determined[static_cast<std::size_t>(p)] || !b.determined[static_cast<std::size_t>(p)]) continue;
        const double change = a.theta(p) - b.theta(p);
        const double variance = a.own_covariance(p, p) + b.own_covariance(p, p);
        size(p) = std::max(size(p), part * std::sqrt(std::max(0.0, change * change - variance)));
      }
    }
    return size;
  }

  /// Slope and curvature of every parameter, in units of the touch noise.
  [[nodiscard]] Eigen::MatrixXd effectsOf(const CycleFitResult& fit, int cycle, const Eigen::VectorXd& size) const {
    const Rows& rows = rows_[static_cast<std::size_t>(cycle)];
    const CycleTime& time = times_[static_cast<std::size_t>(cycle)];
    const Eigen::Index n = size.size();
    Eigen::MatrixXd effects = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), 2 * n);
    if (!(time.duration_s > 0.0)) return effects;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double tau = (time_s_[static_cast<std::size_t>(rows[i])] - time.mean_s) / time.duration_s;
      const Eigen::RowVectorXd unit =
          problem_.jacobian.row(rows[i]).cwiseProduct(size.transpose()) / sigmaOf(fit, rows[i]);
      effects.row(static_cast<Eigen::Index>(i)) << tau * unit, 0.5 * tau * tau * unit;
    }
    return effects;
  }

  /// What all cycles say about the constants.
  struct Information {
    Eigen::MatrixXd normal;
    Eigen::VectorXd right;
  };

  [[nodiscard]] static Information informationOf(const CycleFitResult& fit) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(fit.constant_covariance);
    const Eigen::VectorXd& values = modes.eigenvalues();
    Eigen::VectorXd inverse = Eigen::VectorXd::Zero(values.size());
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      if (values(i) > 1e-9 * values(values.size() - 1)) inverse(i) = 1.0 / values(i);
    }
    Information all;
    all.normal = modes.eigenvectors() * inverse.asDiagonal() * modes.eigenvectors().transpose();
    all.right = all.normal * fit.constant_mm;
    return all;
  }

  /// The touches of one cycle against what the other cycles say: z = A x + noise of covariance V, whitened.
  struct Against {
    Eigen::Index touches = 0;  ///< priors stand below
    Eigen::MatrixXd A;
    Eigen::MatrixXd V;
    Eigen::VectorXd z;
  };

  [[nodiscard]] Eigen::Index keyOf(Eigen::Index row) const { return problem_.rows[static_cast<std::size_t>(row)].key; }

  /// What is left without one cycle, whose touches were fitted with `model`.
  [[nodiscard]] Information withoutCycle(Information others, const CycleProblem& model, const CycleFitResult& fit,
                                         int cycle) const {
    Rows used;
    for (const Eigen::Index r : rows_[static_cast<std::size_t>(cycle)]) {
      if (fit.used[static_cast<std::size_t>(r)]) used.push_back(r);
    }
    const auto u = static_cast<Eigen::Index>(used.size());
    const auto priors = static_cast<Eigen::Index>(model.priors.size());
    Eigen::MatrixXd A(u + priors, model.jacobian.cols());
    Eigen::VectorXd y(u + priors);
    for (Eigen::Index i = 0; i < u; ++i) {
      const Eigen::Index r = used[static_cast<std::size_t>(i)];
      A.row(i) = model.jacobian.row(r) / sigmaOf(fit, r);
      y(i) = problem_.rows[static_cast<std::size_t>(r)].value_mm / sigmaOf(fit, r);
    }
    for (Eigen::Index i = 0; i < priors; ++i) {
      const CyclePrior& prior = model.priors[static_cast<std::size_t>(i)];
      A.row(u + i) = prior.row / prior.sigma;
      y(u + i) = valueOf(prior, cycle) / prior.sigma;
    }
    const Eigen::MatrixXd range = rangeOf(A).basis;
    const Eigen::VectorXd left = y - range * (range.transpose() * y);
    const Eigen::MatrixXd taken = range.topRows(u) * range.topRows(u).transpose();
    for (Eigen::Index i = 0; i < u; ++i) {
      const Eigen::Index ri = used[static_cast<std::size_t>(i)];
      others.right(keyOf(ri)) -= left(i) / sigmaOf(fit, ri);
      for (Eigen::Index j = 0; j < u; ++j) {
        const Eigen::Index rj = used[static_cast<std::size_t>(j)];
        others.normal(keyOf(ri), keyOf(rj)) -=
            ((i == j ? 1.0 : 0.0) - taken(i, j)) / (sigmaOf(fit, ri) * sigmaOf(fit, rj));
      }
    }
    return others;
  }

  [[nodiscard]] Against againstOthers(const CycleProblem& model, const CycleFitResult& fit, const Information& all,
                                      int cycle) const {
    const Rows& rows = rows_[static_cast<std::size_t>(cycle)];
    const Information others = withoutCycle(all, model, fit, cycle);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(others.normal);
    const Eigen::Index keys = others.normal.rows();
    Eigen::Index open = 0;
    while (open < keys && !(modes.eigenvalues()(open) > 1e-6 * modes.eigenvalues()(keys - 1))) ++open;
    const Eigen::MatrixXd seen = modes.eigenvectors().rightCols(keys - open) *
                                 modes.eigenvalues().tail(keys - open).cwiseSqrt().cwiseInverse().asDiagonal();
    const Eigen::VectorXd constant = seen * (seen.transpose() * others.right);

    Against against;
    const auto m = static_cast<Eigen::Index>(rows.size());
    const bool reference = cycle == problem_.reference_cycle;
    const auto priors = reference ? 0 : static_cast<Eigen::Index>(problem_.priors.size());
    const Eigen::Index n = reference ? 0 : problem_.jacobian.cols();
    against.touches = m;
    // What the others leave open of the constants is free.
    against.A = Eigen::MatrixXd::Zero(m + priors, n + open);
    against.z.resize(m + priors);
    Eigen::MatrixXd root = Eigen::MatrixXd::Zero(m + priors, keys - open);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index r = rows[static_cast<std::size_t>(i)];
      const double sigma = sigmaOf(fit, r);
      if (n > 0) against.A.row(i).head(n) = problem_.jacobian.row(r) / sigma;
      against.A.row(i).tail(open) = modes.eigenvectors().row(keyOf(r)).head(open) / sigma;
      against.z(i) = (problem_.rows[static_cast<std::size_t>(r)].value_mm - constant(keyOf(r))) / sigma;
      root.row(i) = seen.row(keyOf(r)) / sigma;
    }
    for (Eigen::Index i = 0; i < priors; ++i) {
      const CyclePrior& prior = problem_.priors[static_cast<std::size_t>(i)];
      against.A.row(m + i).head(n) = prior.row / prior.sigma;
      against.z(m + i) = valueOf(prior, cycle) / prior.sigma;
    }
    normaliseColumns(against.A);
    against.V = Eigen::MatrixXd::Identity(m + priors, m + priors) + root * root.transpose();
    return against;
  }

  [[nodiscard]] static double valueOf(const CyclePrior& prior, int cycle) {
    return prior.value_of_cycle.empty() ? prior.value : prior.value_of_cycle[static_cast<std::size_t>(cycle)];
  }

  struct Range {
    Eigen::MatrixXd basis;
    double information = 0.0;  ///< 2 log of the product of the singular values
  };

  /// Basis of the range of a matrix.
  [[nodiscard]] Range rangeOf(Eigen::MatrixXd A, bool normalise = true) const {
    Range range;
    range.basis.resize(A.rows(), 0);
    if (A.cols() == 0 || A.rows() == 0) return range;
    if (normalise) normaliseColumns(A);
    const SingularValues svd = singularValues(A);
    const Eigen::Index rank = svd.rank(options_.rank_tolerance);
    range.information = 2.0 * svd.values.head(rank).array().log().sum();
    range.basis = svd.left.leftCols(rank);
    return range;
  }

  /// -2 log of the restricted likelihood of a cycle with this drift, after bad touches were left out at their price.
  [[nodiscard]] double cost(const Against& against, const Eigen::MatrixXd& drift, double factor) const {
    const Eigen::Index m = against.touches;
    Eigen::MatrixXd V = against.V;
    V.topLeftCorner(m, m) += factor * factor * drift * drift.transpose();
    Rows kept;
    for (Eigen::Index i = 0; i < V.rows(); ++i) kept.push_back(i);
    const double price = options_.outlier_threshold * options_.outlier_threshold;
    double value = 0.0;
    while (true) {
      const Eigen::LLT<Eigen::MatrixXd> root(V(kept, kept));
      const Eigen::MatrixXd inverse = root.matrixL().solve(
          Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(kept.size()), static_cast<Eigen::Index>(kept.size())));
      const Range range = rangeOf(inverse * against.A(kept, Eigen::all), false);
      const Eigen::MatrixXd projected = inverse - range.basis * (range.basis.transpose() * inverse);
      const Eigen::VectorXd residual = projected * against.z(kept);
      const double spread = 2.0 * root.matrixLLT().diagonal().array().log().sum();
      const double own = residual.squaredNorm() + spread + range.information;
      if (!(price > 0.0)) return own;
      Eigen::Index worst = -1;
      double most = options_.outlier_threshold;
      const Eigen::VectorXd gradient = inverse.transpose() * residual;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        const double weight = projected.col(at).squaredNorm();
        if (kept[i] >= m || weight < 1e-3) continue;
        const double studentised = std::abs(gradient(at)) / std::sqrt(weight);
        if (!(studentised > most)) continue;
        most = studentised;
        worst = at;
      }
      if (worst < 0 || kept.size() < 3) return value + own;
      value += price;
      kept.erase(kept.begin() + worst);
    }
  }

  static constexpr Eigen::Index least_touches = 8;

  /// Rest of z after A and further columns, all whitened.
  [[nodiscard]] Eigen::VectorXd restOf(const Eigen::MatrixXd& A, const Eigen::MatrixXd& more,
                                       const Eigen::VectorXd& z) const {
    Eigen::MatrixXd both(A.rows(), A.cols() + more.cols());
    both << A, more;
    const Eigen::MatrixXd range = rangeOf(std::move(both)).basis;
    return z - range * (range.transpose() * z);
  }

  [[nodiscard]] std::optional<StepInside> stepOf(const CycleFitResult& fit, const Against& against, int cycle,
                                                 const Eigen::MatrixX3d& frame, double& gain) const {
    const Rows& order = rows_[static_cast<std::size_t>(cycle)];
    std::vector<Eigen::Index> at(order.size());  // place in `against`, in order of time
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = static_cast<Eigen::Index>(i);
    const auto timeOf = [&](Eigen::Index i) {
      return time_s_[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])];
    };
    std::sort(at.begin(), at.end(), [&](Eigen::Index a, Eigen::Index b) { return timeOf(a) < timeOf(b); });
    const Eigen::Index m = against.touches;
    const Eigen::Index n = against.z.size();
    const CycleTime& time = times_[static_cast<std::size_t>(cycle)];
    if (!(time.duration_s > 0.0)) return {};
    Eigen::MatrixXd normals = Eigen::MatrixXd::Zero(n, 3);
    Eigen::MatrixXd drift = Eigen::MatrixXd::Zero(n, 6 + problem_.jacobian.cols());
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index r = order[static_cast<std::size_t>(i)];
      const double sigma = sigmaOf(fit, r);
      const double tau = (timeOf(i) - time.mean_s) / time.duration_s;
      normals.row(i) = frame.row(r) / sigma;
      drift.row(i) << tau * normals.row(i), tau * tau * normals.row(i), tau * problem_.jacobian.row(r) / sigma;
    }
    // Whitened once; touches that fit nothing are no evidence of a step.
    const Eigen::MatrixXd& A = against.A;
    const Eigen::VectorXd& z = against.z;
    Eigen::MatrixXd whitener = whitenerOf(against.V);
    const auto after = [&](Eigen::Index first) {
      Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, 3);
      for (Eigen::Index i = first; i < m; ++i) {
        const Eigen::Index touch = at[static_cast<std::size_t>(i)];
        columns.row(touch) = normals.row(touch);
      }
      return columns;
    };
    const auto whitened = [&](Eigen::Index i) -> Eigen::MatrixXd { return whitener * after(i); };
    const Eigen::Index best = bestPlace(whitener * A, whitener * z, m, whitened);
    if (best < 0) return {};
    // Again without the two touches that the step explains worst.
    const Eigen::VectorXd rest = restOf(whitener * A, whitener * after(best), whitener * z);
    std::vector<Eigen::Index> kept;
    {
      std::vector<Eigen::Index> worst;
      for (Eigen::Index i = 0; i < m; ++i) worst.push_back(i);
      const Eigen::VectorXd size = (whitener.transpose() * rest).cwiseAbs();
      std::partial_sort(worst.begin(), worst.begin() + 2, worst.end(),
                        [&](Eigen::Index a, Eigen::Index b) { return size(a) > size(b); });
      for (Eigen::Index i = 0; i < n; ++i)
        if (i != worst[0] && i != worst[1]) kept.push_back(i);
    }
    whitener = whitenerOf(against.V(kept, kept));
    const Eigen::MatrixXd design = whitener * A(kept, Eigen::all);
    const Eigen::VectorXd values = whitener * z(kept);
    const Eigen::MatrixXd stepped = whitener * after(best)(kept, Eigen::all);
    const double none = restOf(design, Eigen::MatrixXd(design.rows(), 0), values).squaredNorm();
    const double smooth = restOf(design, whitener * drift(kept, Eigen::all), values).squaredNorm();
    const double step = restOf(design, stepped, values).squaredNorm();
    const double freedom = static_cast<double>(kept.size()) - static_cast<double>(design.cols()) - 3.0;
    if (!(freedom > 8.0) || !(step > 0.0)) return {};
    const double count = std::log(static_cast<double>(kept.size()));
    const double against_none = freedom * std::log(none / step) - 4.0 * count;  // three components and a place in time
    const double against_drift = freedom * std::log(smooth / step) + (static_cast<double>(drift.cols()) - 4.0) * count;
    constexpr double clear = 40.0;
    constexpr double clearer = 20.0;
    gain = against_none;
    if (against_none < clear || against_drift < clearer) return {};
    // The step itself, with the noise of the cycle.
    const Eigen::MatrixXd basis = rangeOf(design).basis;
    const Eigen::MatrixXd free = stepped - basis * (basis.transpose() * stepped);
    const Eigen::Matrix3d normal = free.transpose() * free;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(normal);
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    for (int q = 0; q < 3; ++q) {
      if (!(modes.eigenvalues()(q) > 1e-3 * modes.eigenvalues()(2))) continue;
      inverse += modes.eigenvectors().col(q) * modes.eigenvectors().col(q).transpose() / modes.eigenvalues()(q);
    }
    StepInside found;
    found.cycle = cycle;
    found.after_s = timeOf(at[static_cast<std::size_t>(best) - 1]);
    found.before_s = timeOf(at[static_cast<std::size_t>(best)]);
    found.step_mm = inverse * (free.transpose() * values);
    found.sigma_mm = std::sqrt(inverse.diagonal().maxCoeff() * step / freedom);
    constexpr double telling_mm = 3e-3;
    constexpr double many_sigma = 8.0;
    if (found.step_mm.norm() < std::max(telling_mm, many_sigma * found.sigma_mm)) return {};
    // A step that few touches of one side feel is as well some bad touches of that side.
    constexpr double least_feeling = 3.0;
    const Eigen::Vector3d direction = found.step_mm.normalized();
    std::array<double, 2> feeling{};
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index r = order[static_cast<std::size_t>(at[static_cast<std::size_t>(i)])];
      feeling[i < best ? 0 : 1] += std::pow(frame.row(r).dot(direction), 2);
    }
    if (std::min(feeling[0], feeling[1]) < least_feeling) return {};
    return found;
  }

  [[nodiscard]] static Eigen::MatrixXd whitenerOf(const Eigen::MatrixXd& V) {
    const Eigen::LLT<Eigen::MatrixXd> root(V);
    return root.matrixL().solve(Eigen::MatrixXd::Identity(V.rows(), V.cols()));
  }

  /// Index in time before which the step explains most; -1: nowhere much.
  template <typename Columns>
  [[nodiscard]] Eigen::Index bestPlace(const Eigen::MatrixXd& A, const Eigen::VectorXd& z, Eigen::Index touches,
                                       const Columns& columns) const {
    const Eigen::MatrixXd basis = rangeOf(A).basis;
    const Eigen::VectorXd rest = z - basis * (basis.transpose() * z);
    Eigen::Index best = -1;
    double most = 0.2 * rest.squaredNorm();  // less is no step by far
    for (Eigen::Index i = least_touches; i + least_touches <= touches; ++i) {
      const Eigen::MatrixXd step = columns(i);
      const Eigen::MatrixXd range = rangeOf(step - basis * (basis.transpose() * step), false).basis;
      const double explained = (range.transpose() * rest).squaredNorm();
      if (explained <= most) continue;
      most = explained;
      best = i;
    }
    return best;
  }

  const CycleProblem& problem_;
  const std::vector<double>& time_s_;
  const CycleFitOptions& options_;
  std::vector<Rows> rows_;
  std::vector<CycleTime> times_;
};

/// Only the cycles and parameters asked for.
void shorten(CycleFitResult& fit, const CycleProblem& problem) {
  const Eigen::Index n = problem.jacobian.cols();
  const auto reference = static_cast<std::size_t>(problem.reference_cycle);
  CycleSolution still = std::move(fit.cycles.back());  // of the empty cycle: zero
  fit.cycles.pop_back();
  fit.from_constant.pop_back();
  still.touches_used = fit.cycles[reference].touches_used;
  still.chi2 = fit.cycles[reference].chi2;
  fit.cycles[reference] = std::move(still);
  fit.from_constant[reference].setZero();
  bool all = true;
  for (CycleSolution& solution : fit.cycles) {
    solution.theta = Eigen::VectorXd(solution.theta.head(n));
    solution.covariance = Eigen::MatrixXd(solution.covariance.topLeftCorner(n, n));
    solution.own_covariance = Eigen::MatrixXd(solution.own_covariance.topLeftCorner(n, n));
    solution.determined.resize(static_cast<std::size_t>(n));
    all = all && solution.status == FitStatus::Converged;
  }
  for (Eigen::MatrixXd& gain : fit.from_constant) gain = Eigen::MatrixXd(gain.topRows(n));
  fit.status = all ? FitStatus::Converged : FitStatus::Degenerate;
  fit.message = all ? "all parameters of all cycles are determined" : "some cycles leave parameters open";
}

}  // namespace

CycleFitResult fitDriftingCycles(const CycleProblem& problem, const std::vector<double>& time_s,
                                 const CycleFitOptions& options) {
  SPINDRIFT_ASSERT(time_s.size() == problem.rows.size(), "every touch needs a time");
  CycleFitResult still = fitCycles(problem, options);
  if (problem.cycles < 2 || problem.rows.empty()) return still;
  const DriftFinder finder(problem, time_s, options);
  // First all cycles may drift: a drift that is left out counts as touch noise and hides itself.
  std::vector<Eigen::MatrixXd> drifts = finder.drifts(still);
  if (std::ranges::all_of(drifts, [](const Eigen::MatrixXd& d) { return d.cols() == 0; })) return still;
  std::vector<double> factor(static_cast<std::size_t>(problem.cycles), first_factor);
  CycleFitResult fit = still;
  for (int pass = 0; pass < 4; ++pass) {
    const CycleProblem model = finder.extended(fit, drifts, factor);
    fit = fitCycles(model, options);
    shorten(fit, problem);
    drifts = finder.drifts(fit);
    const std::vector<double> asked = finder.factorsOf(model, fit, drifts);
    if (std::ranges::all_of(asked, [](double f) { return f == 0.0; })) return still;
    if (asked == factor) break;
    factor = asked;
  }
  for (int k = 0; k < problem.cycles; ++k) {
    if (k != problem.reference_cycle) finder.describe(fit, k);
  }
  return fit;
}

std::optional<StepInside> findStepInside(const CycleProblem& problem, const std::vector<double>& time_s,
                                         const std::vector<Eigen::MatrixX3d>& frames, const CycleFitOptions& options) {
  SPINDRIFT_ASSERT(time_s.size() == problem.rows.size(), "every touch needs a time");
  if (problem.cycles < 2 || problem.rows.empty()) return {};
  // All touches of a moved cycle belong to it: none is taken for bad beforehand.
  CycleFitOptions all = options;
  all.outlier_threshold = 0.0;
  return DriftFinder(problem, time_s, all).step(fitCycles(problem, all), frames);
}

}  // namespace spindrift
