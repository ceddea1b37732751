// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "core/discrepancy/bordered_gram.h"
#include "core/discrepancy/residual_problem.h"
#include "core/math/distributions.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Of the natural logarithm of actual / stated sigma: people are wrong by a factor of two, seldom by more.
constexpr double scale_prior_sd = 1.0;
/// Gain in 2 ln L that a common shift, a correlation in time, heavy tails must bring before they are believed.
constexpr double shift_price = 4.0;
constexpr double correlation_price = 8.0;
constexpr double tail_price = 6.0;
/// The same of shifts of states that follow each other in time, beside shifts that do not.
constexpr double drift_price = 6.0;
/// The same of a component that is normal although others are not.
constexpr double normal_price = 4.0;
/// Of noise that is correlated in time, actual / stated sigma.
constexpr double largest_slow_noise = 1.5;
/// The same where it is as slow as what is measured: its correlation time over the time of all observations.
constexpr double longest_slow_noise = 0.4;
constexpr double largest_drift = 1.2;
/// Gain in 2 ln L, beside 2 ln of the number of series, that a course of its own must bring a series.
constexpr double course_price = 8.0;
/// Common shift, in standard deviations of the own noise, while nothing is known of the signal.
constexpr double careful_shift = 0.7;

/// What shifts a state belongs to the instrument, so components of one unit are believed to be shifted about alike:
/// probability that there are shifts at all, that a component then has them, and the standard deviation of the natural
/// logarithm of its shift over that of the others.
constexpr double shifts_at_all = 0.5;
constexpr double shifted_too = 0.9;
constexpr double unlike_shifts_sd = 0.4;
/// Sizes that are compared: the smallest over the own noise of a unit, how many where units are single readings, and
/// their distance as logarithms.
constexpr double smallest_shift = 0.06;
constexpr int fewest_shift_sizes = 13;
constexpr double shift_step = 0.45;
/// 2 ln of the odds against shifts that noise does not make.
constexpr double impossible = 1e3;

/// Of the readings of one component, those that lie far from the others: from this part on they are no tail of the own
/// noise but errors of another kind.
constexpr double gross_from = 0.15;
constexpr double gross_to = 0.6;
/// Least weight of a reading: of a tail, and of what is probably a gross error.
constexpr double least_tail_weight = 1e-4;
constexpr double least_gross_weight = 1e-9;

/// One component: its units in order of series and time, and the columns whose sizes are estimated.
struct ComponentData {
  std::vector<Index> units;
  std::vector<std::pair<Index, Index>> series;  // ranges of `units`
  Eigen::VectorXd residual;
  Eigen::VectorXd sigma;
  Eigen::VectorXd weight;
  double counted = 0.0;    // readings that tell of the own noise: all, or those that are no gross errors
  Eigen::MatrixXd shifts;  // indicator of the state, times the factor by which shifts follow each other
  std::vector<double> state_time_s;
  double drift_part = 0.0;  // of `shifts`
  double drift_time_s = 0.0;
  double drift_gain = 0.0;  // 2 ln of the likelihood of a drift over that of independent shifts, without its price
  Eigen::MatrixXd smooth;   // patterns in space times hats in time, each of mean square 1 where it is not zero
  double mean_sigma = 1.0;
  double reading_sigma = 1.0;      // of single readings: units may be the means of many
  double least_scale = 1e-4;       // own noise over what is stated: no instrument resolves less of what moves
  Eigen::MatrixXd hats;            // of a course in time that one series has for itself
  std::vector<double> own_course;  // size of it over the own noise, of each series; 0: none

  bool grossErrors() const { return counted < static_cast<double>(units.size()); }
};

struct Parameters {
  double log_scale = 0.0;
  double shift = 0.0;   // um
  double smooth = 0.0;  // um
  double part = 0.0;
  double time_s = 0.0;
};

/// Products of the columns [shifts, smooth, residual] through the inverse of the own noise at scale 1, which here
/// includes the courses that series have for themselves, and free of the constants of the series: these have no prior,
/// so they take the same whatever the sizes of the rest.
struct Products {
  Eigen::MatrixXd gram;
  Eigen::MatrixXd constants;  // of every series (rows), what its constant takes of every column
  double log_det = 0.0;       // of the own noise, and of the constants
};

/// Inverse of the lower Cholesky factor of the own noise of one series at scale 1, times `columns` (its rows only);
/// 2 ln of the determinant of the factor is added to `log_det`.
void whitenOwn(const ResidualProblem& problem, const ComponentData& data, std::size_t series, double part,
               double time_s, Eigen::MatrixXd& columns, double& log_det) {
  const auto [from, to] = data.series[series];
  const Index n = to - from;
  if (!(part > 0.0)) {
    const Eigen::ArrayXd inverse = data.weight.segment(from, n).array().sqrt() / data.sigma.segment(from, n).array();
    columns = inverse.matrix().asDiagonal() * columns;
    log_det -= 2.0 * inverse.log().sum();
    return;
  }
  Eigen::MatrixXd c(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j <= i; ++j) {
      const double dt =
          std::abs(problem.time_s[static_cast<std::size_t>(data.units[static_cast<std::size_t>(from + i)])] -
                   problem.time_s[static_cast<std::size_t>(data.units[static_cast<std::size_t>(from + j)])]);
      c(i, j) = data.sigma[from + i] * data.sigma[from + j] * part * std::exp(-dt / time_s);
      c(j, i) = c(i, j);
    }
    c(i, i) = data.sigma[from + i] * data.sigma[from + i] * (part + (1.0 - part) / data.weight[from + i]);
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(c);
  llt.matrixL().solveInPlace(columns);
  log_det += 2.0 * llt.matrixLLT().diagonal().array().log().sum();
}

Products productsOf(const ResidualProblem& problem, const ComponentData& data, double part, double time_s) {
  const Index s = data.shifts.cols();
  const Index m = data.smooth.cols();
  const Index total = s + m + 1;
  Products out;
  out.gram = Eigen::MatrixXd::Zero(total, total);
  if (problem.free_constants) out.constants = Eigen::MatrixXd::Zero(static_cast<Index>(data.series.size()), total);
  for (std::size_t k = 0; k < data.series.size(); ++k) {
    const auto [from, to] = data.series[k];
    const Index n = to - from;
    const double own = data.own_course[k];
    const Index hats = own > 0.0 ? data.hats.cols() : 0;
    Eigen::MatrixXd columns(n, total + 1 + hats);
    columns.leftCols(s) = data.shifts.middleRows(from, n);
    columns.middleCols(s, m) = data.smooth.middleRows(from, n);
    columns.col(s + m) = data.residual.segment(from, n);
    columns.col(total).setOnes();
    if (hats > 0) columns.rightCols(hats) = own * data.hats.middleRows(from, n);
    whitenOwn(problem, data, k, part, time_s, columns, out.log_det);
    auto x = columns.leftCols(total);
    const auto one = columns.col(total);
    Eigen::RowVectorXd taken_by_one = Eigen::RowVectorXd::Zero(total);
    // Constants are large beside all else: without them first, little is lost to rounding.
    if (problem.free_constants && one.squaredNorm() > 0.0) {
      taken_by_one = one.transpose() * x / one.squaredNorm();
      x.noalias() -= one * taken_by_one;
    }
    Eigen::MatrixXd taken;  // by the course of its own, of [shifts, smooth, residual, constant]
    if (hats > 0) {
      const auto b = columns.rightCols(hats);
      const Eigen::LLT<Eigen::MatrixXd> llt(Eigen::MatrixXd::Identity(hats, hats) + b.transpose() * b);
      taken = llt.matrixL().solve(b.transpose() * columns.leftCols(total + 1));
      out.log_det += 2.0 * llt.matrixLLT().diagonal().array().log().sum();
      out.gram.noalias() -= taken.leftCols(total).transpose() * taken.leftCols(total);
    }
    out.gram.noalias() += x.transpose() * x;
    if (!problem.free_constants) continue;
    // A prior so wide that it is none; it keeps a series without weight from stopping all.
    constexpr double hardly_any = 1e-12;
    double weight = one.squaredNorm() + hardly_any;
    if (hats > 0) {
      weight -= taken.col(total).squaredNorm();
      const Eigen::RowVectorXd rest = -taken.col(total).transpose() * taken.leftCols(total) / weight;
      out.gram.selfadjointView<Eigen::Lower>().rankUpdate(rest.transpose(), -weight);
      taken_by_one += rest;
    }
    out.constants.row(static_cast<Index>(k)) = taken_by_one;
    out.log_det += std::log(weight);
  }
  out.gram.triangularView<Eigen::StrictlyUpper>() = out.gram.transpose();
  return out;
}

/// The same where shifts that were independent follow each other as by `factor`.
Products drifting(Products products, const Eigen::MatrixXd& factor) {
  const Index s = factor.rows();
  products.gram.topRows(s) = factor.transpose() * products.gram.topRows(s).eval();
  products.gram.leftCols(s) = products.gram.leftCols(s).eval() * factor;
  if (products.constants.rows() > 0) products.constants.leftCols(s) = products.constants.leftCols(s).eval() * factor;
  return products;
}

/// The Cholesky factor of the bordered matrix of BorderedGram; without rows beyond what numbers can tell apart.
Eigen::MatrixXd borderedFactor(const ComponentData& data, const Products& products, const Parameters& p) {
  const Eigen::LLT<Eigen::MatrixXd> llt(
      borderedMatrix(products.gram, data.shifts.cols(), std::exp(p.log_scale), p.shift, p.smooth));
  if (llt.info() != Eigen::Success) return {};
  return llt.matrixL();
}

/// Pattern search over the logarithms of scale, shift and smooth part.
double optimise(const ComponentData& data, const Products& products, bool with_shift, Parameters& p, int rounds) {
  const BorderedGram gram(products.gram, data.shifts.cols());
  const double n = std::max(1.0, data.counted - static_cast<double>(products.constants.rows()));
  // -2 ln of the restricted likelihood, up to a constant.
  const auto deviance = [&](const Parameters& at) {
    return n * 2.0 * at.log_scale + products.log_det + gram.deviance(std::exp(at.log_scale), at.shift, at.smooth) +
           std::pow(at.log_scale / scale_prior_sd, 2);
  };
  double best = deviance(p);
  double step = rounds > 4 ? 0.8 : 0.3;
  for (int round = 0; round < rounds; ++round, step *= 0.5) {
    for (int which = 0; which < 3; ++which) {
      if (which == 1 && !with_shift) continue;
      if (which == 2 && data.smooth.cols() == 0) continue;
      for (const double direction : {1.0, -1.0}) {
        for (int guard = 0; guard < 5; ++guard) {
          Parameters trial = p;
          const double factor = std::exp(direction * step);
          if (which == 0) trial.log_scale += direction * step;
          if (trial.log_scale < std::log(data.least_scale)) break;
          if (which == 1) trial.shift *= factor;
          if (which == 2) trial.smooth *= factor;
          const double value = deviance(trial);
          if (!(value < best - 1e-3)) break;
          best = value;
          p = trial;
        }
      }
    }
  }
  return best;
}

/// The residual without constants, shifts and common smooth part, um or urad.
Eigen::VectorXd withoutCommon(const ResidualProblem& problem, const ComponentData& data, const Products& products,
                              const Parameters& p) {
  const Eigen::MatrixXd l = borderedFactor(data, products, p);
  if (l.rows() == 0) return data.residual;  // beyond what numbers can tell apart: nothing is taken out
  const Index s = data.shifts.cols();
  const Index m = data.smooth.cols();
  const Index total = products.gram.cols();
  // The last row of the factor holds L^-1 [F X]' r; solving with the rest gives the coefficients.
  const Eigen::VectorXd z = l.row(total - 1).head(total - 1).transpose();
  Eigen::VectorXd b = l.topLeftCorner(total - 1, total - 1).transpose().triangularView<Eigen::Upper>().solve(z);
  b.head(s) *= p.shift;
  b.tail(m) *= p.smooth;
  Eigen::VectorXd left = data.residual;
  if (s > 0) left -= data.shifts * b.head(s);
  if (m > 0) left -= data.smooth * b.tail(m);
  if (problem.free_constants) {
    const Eigen::VectorXd constants = products.constants.col(total - 1) - products.constants.leftCols(total - 1) * b;
    for (std::size_t k = 0; k < data.series.size(); ++k) {
      const auto [from, to] = data.series[k];
      left.segment(from, to - from).array() -= constants[static_cast<Index>(k)];
    }
  }
  return left;
}

/// The own noise of every reading as found: residual without constants, shifts and smooth parts, over scale and sigma.
Eigen::VectorXd ownResidual(const ResidualProblem& problem, const ComponentData& data, const Products& products,
                            const Parameters& p) {
  Eigen::VectorXd left = withoutCommon(problem, data, products, p);
  for (std::size_t k = 0; k < data.series.size(); ++k) {
    if (!(data.own_course[k] > 0.0)) continue;
    const auto [from, to] = data.series[k];
    const Index n = to - from;
    const Eigen::MatrixXd raw = data.own_course[k] * data.hats.middleRows(from, n);
    Eigen::MatrixXd columns(n, raw.cols() + 1);
    columns << raw, left.segment(from, n);
    double log_det = 0.0;
    whitenOwn(problem, data, k, p.part, p.time_s, columns, log_det);
    const Eigen::MatrixXd b = columns.leftCols(raw.cols());
    const Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(b.cols(), b.cols()) + b.transpose() * b;
    left.segment(from, n) -= raw * normal.llt().solve(b.transpose() * columns.col(raw.cols()));
  }
  return left.cwiseQuotient(data.sigma) * std::exp(-p.log_scale);
}

/// `values` of one series, each at most three standard deviations from the median of its neighbourhood: a reading far
/// out is no course.
Eigen::VectorXd withoutOutliers(const Eigen::VectorXd& values, const Eigen::VectorXd& sigma) {
  constexpr Index reach = 2;
  constexpr double most = 3.0;
  Eigen::VectorXd out = values;
  for (Index i = 0; i < values.size(); ++i) {
    std::vector<double> near;
    for (Index j = std::max<Index>(0, i - reach); j <= std::min(values.size() - 1, i + reach); ++j)
      near.push_back(values[j]);
    const double middle = median(near);
    out[i] = std::clamp(values[i], middle - most * sigma[i], middle + most * sigma[i]);
  }
  return out;
}

/// Courses that series have for themselves, each of the size that makes it most probable. True if they changed.
bool findOwnCourses(const ResidualProblem& problem, ComponentData& data, const Parameters& p) {
  if (data.series.size() < 2 || data.hats.cols() == 0) return false;
  const Products products = productsOf(problem, data, p.part, p.time_s);
  const Eigen::VectorXd left = withoutCommon(problem, data, products, p);
  const double price = course_price + 2.0 * std::log(static_cast<double>(data.series.size()));
  const double scale2 = std::exp(2.0 * p.log_scale);
  bool changed = false;
  for (std::size_t k = 0; k < data.series.size(); ++k) {
    const auto [from, to] = data.series[k];
    const Index n = to - from;
    if (n < 6) continue;
    const Index hats = data.hats.cols();
    Eigen::MatrixXd columns(n, hats + 2);
    Eigen::VectorXd followed = left.segment(from, n);
    // Gross errors have no weight, and so many of them spoil the median of a neighbourhood.
    if (!data.grossErrors()) followed = withoutOutliers(followed, std::exp(p.log_scale) * data.sigma.segment(from, n));
    columns << data.hats.middleRows(from, n), Eigen::VectorXd::Ones(n), followed;
    double log_det = 0.0;
    whitenOwn(problem, data, k, p.part, p.time_s, columns, log_det);
    if (problem.free_constants) {
      const Eigen::VectorXd one = columns.col(hats).normalized();
      columns -= one * (one.transpose() * columns);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(columns.leftCols(hats).transpose() *
                                                               columns.leftCols(hats));
    const Eigen::ArrayXd lambda = eigen.eigenvalues().array().max(0.0);
    const Eigen::ArrayXd beta =
        (eigen.eigenvectors().transpose() * (columns.leftCols(hats).transpose() * columns.col(hats + 1))).array();
    double best = 0.0;
    double size = 0.0;
    for (int step = 0; step < 24; ++step) {
      const double c = 0.1 * data.mean_sigma * std::pow(1.35, step);
      const double gain =
          (beta.square() * c * c / (1.0 + lambda * c * c)).sum() / scale2 - (1.0 + lambda * c * c).log().sum();
      if (gain > best) {
        best = gain;
        size = c;
      }
    }
    if (best < price) size = 0.0;
    changed = changed || std::abs(size - data.own_course[k]) > 0.3 * std::max(size, data.own_course[k]);
    data.own_course[k] = size;
  }
  return changed;
}

/// 2 ln L of standardised residuals under a Student distribution of `dof`, scale at its maximum; 0: normal.
double tailLikelihood(const std::vector<double>& e, double dof) {
  const double n = static_cast<double>(e.size());
  double s2 = 0.0;
  for (const double x : e) s2 += x * x / n;
  if (!(dof > 0.0)) return -n * std::log(std::max(1e-12, s2)) - n - n * std::log(2.0 * std::numbers::pi);
  for (int i = 0; i < 30; ++i) {
    double sum = 0.0;
    for (const double x : e) sum += (dof + 1.0) / (dof + x * x / s2) * x * x / n;
    s2 = std::max(1e-12, sum);
  }
  const double log_c = std::lgamma(0.5 * (dof + 1.0)) - std::lgamma(0.5 * dof) - 0.5 * std::log(dof * std::numbers::pi);
  double out = 2.0 * n * log_c - n * std::log(s2);
  for (const double x : e) out -= (dof + 1.0) * std::log1p(x * x / (s2 * dof));
  return out;
}

ComponentData componentData(const ResidualProblem& problem, const Eigen::VectorXd& residual, Component c, bool fitted) {
  ComponentData out;
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const Index from = problem.series_begin[static_cast<std::size_t>(s)];
    const Index to = problem.series_begin[static_cast<std::size_t>(s) + 1];
    if (problem.component[static_cast<std::size_t>(from)] != c) continue;
    const auto first = static_cast<Index>(out.units.size());
    for (Index u = from; u < to; ++u) out.units.push_back(u);
    out.series.emplace_back(first, first + to - from);
  }
  const auto n = static_cast<Index>(out.units.size());
  if (n == 0) return out;
  out.residual.resize(n);
  out.sigma.resize(n);
  out.weight = Eigen::VectorXd::Ones(n);
  out.counted = static_cast<double>(n);
  std::map<int, Index> states;
  for (Index i = 0; i < n; ++i) {
    const Index u = out.units[static_cast<std::size_t>(i)];
    out.residual[i] = residual[u];
    out.sigma[i] = problem.sigma[u];
    states.try_emplace(problem.epoch[static_cast<std::size_t>(u)], static_cast<Index>(states.size()));
  }
  out.mean_sigma = std::sqrt(out.sigma.squaredNorm() / static_cast<double>(n));
  double of_readings = 0.0;
  for (const Index u : out.units) of_readings += problem.reading_sigma[u] * problem.reading_sigma[u];
  out.reading_sigma = std::sqrt(of_readings / static_cast<double>(n));
  constexpr double least_part_of_motion = 5e-4;
  double motion = 0.0;
  for (const auto& [from, to] : out.series) {
    const Index first = out.units[static_cast<std::size_t>(from)];
    const Eigen::VectorXd values = problem.simulated.segment(first, to - from) + problem.y.segment(first, to - from);
    motion += (values.array() - (problem.free_constants ? values.mean() : 0.0)).square().sum();
  }
  out.least_scale =
      std::max(out.least_scale, least_part_of_motion * std::sqrt(motion / static_cast<double>(n)) / out.mean_sigma);
  out.own_course.assign(out.series.size(), 0.0);
  const double per_state = static_cast<double>(n) / static_cast<double>(states.size());
  if (problem.epochs_are_states && per_state >= 2.5 && out.series.size() >= 3) {
    out.shifts = Eigen::MatrixXd::Zero(n, static_cast<Index>(states.size()));
    out.state_time_s.resize(states.size());
    for (const auto& [epoch, column] : states)
      out.state_time_s[static_cast<std::size_t>(column)] = problem.epoch_time_s[static_cast<std::size_t>(epoch)];
    for (Index i = 0; i < n; ++i) {
      out.shifts(i, states[problem.epoch[static_cast<std::size_t>(out.units[static_cast<std::size_t>(i)])]]) = 1.0;
    }
  } else {
    out.shifts.resize(n, 0);
  }
  // Patterns in space that a few causes can have.
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (const Index u : out.units) {
    low = low.cwiseMin(problem.place[static_cast<std::size_t>(u)].position_mm);
    high = high.cwiseMax(problem.place[static_cast<std::size_t>(u)].position_mm);
  }
  const Eigen::Vector3d half = (0.5 * (high - low)).cwiseMax(1e-6);
  std::vector<Eigen::VectorXd> patterns{Eigen::VectorXd::Ones(n)};
  const auto add = [&](const auto& value) {
    Eigen::VectorXd column(n);
    for (Index i = 0; i < n; ++i)
      column[i] = value(problem.place[static_cast<std::size_t>(out.units[static_cast<std::size_t>(i)])]);
    const double mean = column.mean();
    if ((column.array() - mean).matrix().norm() > 1e-6 * std::sqrt(static_cast<double>(n))) patterns.push_back(column);
  };
  if (out.series.size() >= 6) {
    for (int axis = 0; axis < 3; ++axis) {
      add([&](const DeviationQuery& q) { return (q.position_mm[axis] - low[axis]) / half[axis] - 1.0; });
    }
    if (!fitted && out.series.size() >= 8) {
      for (int axis = 0; axis < 3; ++axis) {
        add([&](const DeviationQuery& q) {
          const double x = (q.position_mm[axis] - low[axis]) / half[axis] - 1.0;
          return x * x;
        });
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    add([&](const DeviationQuery& q) { return q.approach[axis]; });
  }
  const double start = problem.node_time_s.front();
  const double span = std::max(1.0, problem.node_time_s.back() - start);
  const int hats = std::clamp(static_cast<int>(states.size()) / 4, 2, fitted ? 8 : 11);
  out.smooth.resize(n, static_cast<Index>(patterns.size()) * hats);
  Index at = 0;
  for (const Eigen::VectorXd& pattern : patterns) {
    for (int h = 0; h < hats; ++h, ++at) {
      for (Index i = 0; i < n; ++i) {
        const Index u = out.units[static_cast<std::size_t>(i)];
        const double position = (problem.time_s[static_cast<std::size_t>(u)] - start) / span * (hats - 1);
        out.smooth(i, at) = pattern[i] * std::max(0.0, 1.0 - std::abs(position - h));
      }
    }
  }
  if (n < 2 * static_cast<Index>(out.series.size()) + 8) out.smooth.resize(n, 0);
  const int own_hats = std::clamp(static_cast<int>(states.size()) / 3, 2, 12);
  out.hats = Eigen::MatrixXd::Zero(n, states.size() >= 6 ? own_hats : 0);
  for (Index h = 0; h < out.hats.cols(); ++h) {
    for (Index i = 0; i < n; ++i) {
      const Index u = out.units[static_cast<std::size_t>(i)];
      const double position = (problem.time_s[static_cast<std::size_t>(u)] - start) / span * (own_hats - 1);
      out.hats(i, h) = std::max(0.0, 1.0 - std::abs(position - static_cast<double>(h)));
    }
  }
  return out;
}

struct ComponentEstimate {
  bool present = false;
  Parameters p;
  double uncertainty = 1.0;
  double deviance = 0.0;  // -2 ln of the restricted likelihood
  Eigen::VectorXd own;    // standardised own noise
  ComponentData data;
};

/// Shifts of `data` independent again, or as they follow each other.
void setDrift(const ResidualProblem& problem, ComponentData& data, double part, double time_s) {
  if (data.shifts.cols() == 0) return;
  std::map<int, Index> states;
  data.shifts.setZero();
  for (Index i = 0; i < data.shifts.rows(); ++i) {
    const int epoch = problem.epoch[static_cast<std::size_t>(data.units[static_cast<std::size_t>(i)])];
    data.shifts(i, states.try_emplace(epoch, static_cast<Index>(states.size())).first->second) = 1.0;
  }
  data.drift_part = part;
  data.drift_time_s = time_s;
  if (part > 0.0) data.shifts *= shiftFactor(data.state_time_s, part, time_s);
}

/// Whether the shifts of states follow each other in time: an instrument that drifts. Starts from the independent ones
/// in `p`, whose deviance is `best`; returns the deviance of what is more probable. `step_s`: from state to state.
double findDrift(const ResidualProblem& problem, ComponentData& data, const Products& independent, double step_s,
                 Parameters& p, double best) {
  constexpr Index fewest_states = 8;
  data.drift_gain = 0.0;
  if (!(p.shift > 0.0) || data.shifts.cols() < fewest_states || !(step_s > 0.0)) return best;
  struct Found {
    double deviance = 1e300;
    Parameters p;
    double part = 0.0;
    double time_s = 0.0;
  } found;
  const auto consider = [&](double part, double time_s, Parameters trial, int rounds) {
    const Products products = drifting(independent, shiftFactor(data.state_time_s, part, time_s));
    const double deviance = optimise(data, products, true, trial, rounds);
    if (deviance < found.deviance) found = {deviance, trial, part, time_s};
  };
  for (const double steps : {2.0, 8.0}) {
    consider(0.9, steps * step_s, p, 3);
    // Without the smooth part, which may have taken the drift.
    Parameters alone = p;
    alone.smooth *= 0.01;
    alone.shift *= 2.0;
    if (data.smooth.cols() > 0) consider(0.9, steps * step_s, alone, 3);
  }
  data.drift_gain = best - found.deviance;
  if (data.drift_gain < -drift_price) return best;
  for (int round = 0; round < 2; ++round) {
    const Found at = found;
    for (const double part : {0.6 * at.part, 1.0 - 0.3 * (1.0 - at.part)}) consider(part, at.time_s, at.p, 2);
    const Found then = found;
    for (const double factor : {0.55, 1.8}) consider(then.part, factor * then.time_s, then.p, 2);
  }
  data.drift_gain = best - found.deviance;
  if (data.drift_gain < drift_price) return best;
  setDrift(problem, data, found.part, found.time_s);
  p = found.p;
  return found.deviance;
}

/// Scale, shift, smooth part and correlation at the weights of `data`. `careful`: nothing is known of the signal yet,
/// so shifts are small and nothing is correlated, or the noise would take the signal.
void estimateAt(const ResidualProblem& problem, ComponentEstimate& e, bool again, bool careful) {
  const bool constants = problem.free_constants;
  const bool shifts = e.data.shifts.cols() > 0;
  setDrift(problem, e.data, 0.0, 0.0);
  Products products = productsOf(problem, e.data, 0.0, 0.0);
  Parameters white = e.p;
  white.part = 0.0;
  if (!again) {
    white.shift = shifts ? 0.5 * e.data.mean_sigma : 0.0;
    white.smooth = e.data.mean_sigma;
  }
  if (shifts && !(white.shift > 0.0)) white.shift = 0.3 * e.data.mean_sigma;
  double best = optimise(e.data, products, shifts, white, again ? 3 : 6);
  if (shifts) {
    Parameters without = white;
    without.shift = 0.0;
    const double value = optimise(e.data, products, false, without, 3);
    if (value < best + shift_price) {
      white = without;
      best = value;
    }
  }
  if (careful) white.shift = std::min(white.shift, careful_shift * std::exp(white.log_scale) * e.data.reading_sigma);
  std::vector<double> steps;
  for (std::size_t i = 1; i < problem.epoch_time_s.size(); ++i) {
    steps.push_back(problem.epoch_time_s[i] - problem.epoch_time_s[i - 1]);
  }
  const double step = steps.empty() ? 0.0 : median(steps);
  if (!careful) {
    best = findDrift(problem, e.data, products, step, white, best);
    if (e.data.drift_part > 0.0) products = productsOf(problem, e.data, 0.0, 0.0);
  }
  Parameters chosen = white;
  Products chosen_products = products;
  // Own noise that is correlated in time: tried from what is common among slow instruments to slow rooms.
  // Series of one reading each have no course in time that could be correlated.
  const bool courses = 2 * e.data.series.size() <= static_cast<std::size_t>(e.data.residual.size());
  // Readings without weight say nothing of what neighbours have in common, and would gain from any of it.
  const bool enough =
      !careful && courses && !e.data.grossErrors() && e.data.residual.size() >= 24 && steps.size() >= 7 && step > 0.0;
  if (enough) {
    double best_correlated = 1e300;
    Parameters correlated;
    Products correlated_products;
    const auto consider = [&](double part, double time_s, int rounds) {
      Products trial_products = productsOf(problem, e.data, part, time_s);
      Parameters trial = best_correlated < 1e299 ? correlated : white;
      trial.part = part;
      trial.time_s = time_s;
      const double value = optimise(e.data, trial_products, trial.shift > 0.0, trial, rounds);
      if (value < best_correlated) {
        best_correlated = value;
        correlated = trial;
        correlated_products = std::move(trial_products);
      }
    };
    if (again && e.p.part > 0.0) {
      consider(e.p.part, e.p.time_s, 2);
    } else {
      for (const double k : {2.0, 9.0}) consider(0.6, k * step, 2);
    }
    if (best_correlated < best + 2.0 * correlation_price) {
      for (int round = 0; round < 2; ++round) {
        const Parameters at = correlated;
        for (const double part : {0.6 * at.part, std::min(0.98, at.part + 0.5 * (1.0 - at.part))})
          consider(part, at.time_s, 2);
        const Parameters then = correlated;
        for (const double factor : {0.55, 1.8}) consider(then.part, factor * then.time_s, 2);
      }
    }
    // Slow noise much larger than stated, or as slow as what is measured, is no noise but something that nobody
    // explains yet.
    const bool slow =
        correlated.time_s > longest_slow_noise * (problem.epoch_time_s.back() - problem.epoch_time_s.front());
    const bool noise = correlated.log_scale < std::log(slow ? largest_drift : largest_slow_noise);
    if (best_correlated < best - correlation_price && !noise) {
      // Its quick part is the noise, the slow one remains to be explained.
      const double kept = correlated.part * std::exp(-step / correlated.time_s);
      chosen.log_scale = std::min(chosen.log_scale, correlated.log_scale + 0.5 * std::log(std::max(1e-3, 1.0 - kept)));
      chosen.shift = std::min(chosen.shift, correlated.shift);
    } else if (best_correlated < best - correlation_price) {
      chosen = correlated;
      chosen_products = std::move(correlated_products);
      best = best_correlated;
    }
  }
  e.p = chosen;
  e.deviance = best;
  e.own = ownResidual(problem, e.data, chosen_products, e.p);
  const double dof = std::max(1.0, e.data.counted - (constants ? static_cast<double>(e.data.series.size()) : 0.0));
  e.uncertainty = std::exp(e.p.log_scale) / std::sqrt(2.0 * dof);
}

/// Scale of what changes from one reading of a series to the next: actual / stated sigma.
double quickScale(const ResidualProblem& problem, const ComponentData& data, const Parameters& p) {
  const Eigen::VectorXd left = withoutCommon(problem, data, productsOf(problem, data, p.part, p.time_s), p);
  std::vector<double> all;
  for (const auto& [from, to] : data.series) {
    for (Index i = from + 1; i + 1 < to; ++i) {
      const double spread = std::sqrt(std::pow(data.sigma[i], 2) + 0.25 * std::pow(data.sigma[i - 1], 2) +
                                      0.25 * std::pow(data.sigma[i + 1], 2));
      all.push_back(std::abs(left[i] - 0.5 * (left[i - 1] + left[i + 1])) / spread);
    }
  }
  constexpr std::size_t enough = 20;
  return all.size() < enough ? std::exp(p.log_scale) : 1.4826 * median(all);
}

/// The same with courses that single series have for themselves: what they follow is no noise of the others.
void estimateWithCourses(const ResidualProblem& problem, ComponentEstimate& e, bool again, bool careful) {
  estimateAt(problem, e, again, careful);
  if (careful) return;
  if (!again && !(e.p.part > 0.0)) {
    // Many courses hide each other: begin with what is noise without doubt.
    Parameters quick = e.p;
    quick.log_scale = std::min(e.p.log_scale, std::log(std::max(e.data.least_scale, quickScale(problem, e.data, e.p))));
    if (findOwnCourses(problem, e.data, quick)) estimateAt(problem, e, true, careful);
  }
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds && findOwnCourses(problem, e.data, e.p); ++round) {
    estimateAt(problem, e, true, careful);
  }
}

/// Sizes of shifts that are compared, um or urad: the same for all components of one unit, by the noise that the
/// problem has. Where units are means of many readings the smallest that can be seen is smaller, and the largest as
/// large as ever, so there are more of them.
std::vector<double> shiftSizes(const ResidualProblem& problem, bool translations) {
  double sum = 0.0;
  double merged = 0.0;
  double count = 0.0;
  for (Index u = 0; u < problem.size(); ++u) {
    const bool translation = static_cast<std::size_t>(problem.component[static_cast<std::size_t>(u)]) < 3;
    if (translation != translations) continue;
    sum += std::log(problem.ownSigma(u));
    merged += std::log(problem.reading_sigma[u] / problem.sigma[u]);
    count += 1.0;
  }
  constexpr double rounding = 1e-9;
  const int beyond = static_cast<int>(std::ceil(merged / std::max(1.0, count) / shift_step - rounding));
  std::vector<double> out;
  for (int i = 0; i < fewest_shift_sizes + std::max(0, beyond); ++i)
    out.push_back(smallest_shift * std::exp(sum / std::max(1.0, count) + shift_step * i));
  return out;
}

/// Deviances over the `sizes` of the shift, the last of them without any, the rest made as large as each needs.
std::vector<double> shiftDeviances(const ResidualProblem& problem, const ComponentEstimate& e,
                                   const std::vector<double>& sizes) {
  const Products products = productsOf(problem, e.data, e.p.part, e.p.time_s);
  std::vector<double> out;
  for (std::size_t i = 0; i <= sizes.size(); ++i) {
    Parameters p = e.p;
    p.shift = i < sizes.size() ? sizes[i] : 0.0;
    out.push_back(optimise(e.data, products, false, p, 2));
  }
  return out;
}

/// What the own noise of a component is beside a normal one.
struct Tails {
  double dof = 0.0;            // of the Student distribution; 0: normal
  double gross_part = 0.0;     // of readings that are gross errors, anywhere in the range of all; 0: none
  double gross_density = 0.0;  // of these, at any deviation over the stated sigma

  bool operator==(const Tails&) const = default;
};
using TailsOfAll = std::array<Tails, 6>;

/// Variance of the counts of `picked` readings over groups of readings, over that of readings picked by chance.
double dispersionOver(const std::vector<int>& group, const std::vector<char>& picked, double part) {
  std::map<int, std::array<double, 2>> counts;
  for (std::size_t i = 0; i < group.size(); ++i) {
    auto& [all, of_them] = counts[group[i]];
    all += 1.0;
    of_them += picked[i] != 0 ? 1.0 : 0.0;
  }
  double sum = 0.0;
  double groups = 0.0;
  for (const auto& [key, count] : counts) {
    if (count[0] < 2.0) continue;
    sum += std::pow(count[1] - part * count[0], 2) / (part * (1.0 - part) * count[0]);
    groups += 1.0;
  }
  // Four standard deviations of what chance brings are taken off.
  constexpr double sure = 4.0;
  return groups < 3.0 ? 1.0 : sum / groups - sure * std::sqrt(2.0 / groups);
}

/// Whether readings that lie far off do so each for itself. What is missing in a simulation does not: its readings are
/// like their neighbours in time, or it is there in all points of some states, or in all states of some points.
bool eachForItself(const ResidualProblem& problem, const ComponentData& data, const Eigen::VectorXd& own,
                   const Eigen::VectorXd& inside) {
  std::vector<char> gross;
  double part = 0.0;
  for (const double w : inside) {
    gross.push_back(w < 0.5 ? 1 : 0);
    part += w < 0.5 ? 1.0 / static_cast<double>(inside.size()) : 0.0;
  }
  if (!(part > 0.0) || !(part < 1.0)) return false;
  constexpr double alike = 0.25;
  constexpr double most_alike = 0.3;
  double like_neighbours = 0.0;
  double with_neighbours = 0.0;
  std::vector<int> states;
  std::vector<int> points;
  for (std::size_t k = 0; k < data.series.size(); ++k) {
    const auto [from, to] = data.series[k];
    for (Index i = from; i < to; ++i) {
      states.push_back(problem.epoch[static_cast<std::size_t>(data.units[static_cast<std::size_t>(i)])]);
      points.push_back(static_cast<int>(k));
      if (gross[static_cast<std::size_t>(i)] == 0 || to - from < 2) continue;
      with_neighbours += 1.0;
      const auto like = [&](Index j) {
        return j >= from && j < to && std::abs(own[j] - own[i]) < alike * std::abs(own[i]);
      };
      like_neighbours += like(i - 1) || like(i + 1) ? 1.0 : 0.0;
    }
  }
  constexpr double by_chance = 1.0;
  return like_neighbours <= most_alike * with_neighbours && dispersionOver(states, gross, part) < by_chance &&
         dispersionOver(points, gross, part) < by_chance;
}

/// Normal noise and gross errors that may be anywhere, by expectation and maximisation. `own`: over the stated sigma.
/// None where too few lie far off.
Tails grossErrorsOf(const ResidualProblem& problem, const ComponentData& data, const Eigen::VectorXd& own) {
  Tails out;
  const double part = partFarOff(std::vector<double>(own.begin(), own.end()));
  if (own.size() < 20 || part < gross_from || part > gross_to) return out;
  const double range = own.maxCoeff() - own.minCoeff();
  std::vector<double> sizes(own.begin(), own.end());
  for (double& x : sizes) x = std::abs(x);
  double s = std::max(1e-9, quantile(sizes, 0.25) / normalQuantile(0.75));
  out.gross_part = part;
  for (int round = 0; round < 50; ++round) {
    double inside = 0.0;
    double squares = 0.0;
    for (const double x : own) {
      const double w = 1.0 / (1.0 + out.gross_part / range * s / ((1.0 - out.gross_part) * normalDensity(x / s)));
      inside += w;
      squares += w * x * x;
    }
    if (!(inside > 1.0)) break;
    s = std::max(1e-9, std::sqrt(squares / inside));
    out.gross_part = std::clamp(1.0 - inside / static_cast<double>(own.size()), 0.01, 0.9);
  }
  out.gross_density = out.gross_part / range;
  Eigen::VectorXd inside(own.size());
  for (Index i = 0; i < own.size(); ++i) {
    const double normal = (1.0 - out.gross_part) * normalDensity(own[i] / s) / s;
    inside[i] = normal / (normal + out.gross_density);
  }
  return eachForItself(problem, data, own, inside) ? out : Tails{};
}

/// Tails of every component's own noise. Few readings of one component do not tell how heavy tails are: one Student
/// distribution for all, each by its own scale, but for components that say themselves that they are normal, so that
/// what disturbs one is not taken for noise of the others; and for those where too many lie too far off for any.
TailsOfAll tailsOf(const ResidualProblem& problem, const std::array<ComponentEstimate, 6>& estimates) {
  TailsOfAll out;
  std::array<std::vector<double>, 6> own;  // over the scale of their core
  std::size_t readings = 0;
  for (std::size_t c = 0; c < estimates.size(); ++c) {
    if (!estimates[c].present) continue;
    const Eigen::VectorXd& all = estimates[c].own;
    out[c] = grossErrorsOf(problem, estimates[c].data, std::exp(estimates[c].p.log_scale) * all);
    if (out[c].gross_part > 0.0) continue;
    std::vector<double> magnitude;
    for (const double value : all) magnitude.push_back(std::abs(value));
    const double scale = std::max(1e-9, 1.4826 * median(magnitude));
    for (const double value : all) own[c].push_back(value / scale);
    readings += own[c].size();
  }
  if (readings < 30) return out;
  double best = tail_price;
  const TailsOfAll normal = out;
  for (const double trial : {3.0, 4.0, 6.0, 10.0}) {
    TailsOfAll tails = normal;
    double gain = 0.0;
    for (std::size_t c = 0; c < estimates.size(); ++c) {
      if (own[c].empty()) continue;
      const double of_tails = tailLikelihood(own[c], trial) - tailLikelihood(own[c], 0.0);
      if (of_tails > -normal_price) tails[c].dof = trial;
      gain += std::max(of_tails, -normal_price);
    }
    if (gain > best) {
      best = gain;
      out = tails;
    }
  }
  return out;
}

/// Weights of the readings under `tails`.
void setWeights(ComponentEstimate& e, const Tails& tails) {
  e.data.counted = static_cast<double>(e.own.size());
  if (!(tails.gross_part > 0.0)) {
    for (Index i = 0; i < e.own.size(); ++i) {
      e.data.weight[i] =
          tails.dof > 0.0 ? std::max(least_tail_weight, (tails.dof + 1.0) / (tails.dof + e.own[i] * e.own[i])) : 1.0;
    }
    return;
  }
  // How probable it is that a reading is none of the gross errors.
  e.data.counted = 0.0;
  const double density = tails.gross_density * std::exp(e.p.log_scale);
  for (Index i = 0; i < e.own.size(); ++i) {
    const double inside = (1.0 - tails.gross_part) * normalDensity(e.own[i]);
    e.data.weight[i] = std::clamp(inside / (inside + density), least_gross_weight, 1.0 - least_gross_weight);
    e.data.counted += e.data.weight[i];
  }
}

/// What gross errors add to the deviance of the readings that are none, weighted as they are: the two together are
/// -2 ln of the likelihood of the mixture (Neal and Hinton 1998), up to a constant.
double devianceOfGrossErrors(const ComponentEstimate& e, const Tails& tails) {
  if (!(tails.gross_part > 0.0)) return 0.0;
  double out = 0.0;
  for (const double w : e.data.weight) {
    out += w * (std::log(2.0 * std::numbers::pi) - 2.0 * std::log(1.0 - tails.gross_part)) -
           2.0 * (1.0 - w) * std::log(tails.gross_density) + 2.0 * w * std::log(w) + 2.0 * (1.0 - w) * std::log1p(-w);
    // The weights are no variances here.
    out += std::log(w);
  }
  return out;
}

}  // namespace

NoiseModel estimateNoise(const ResidualProblem& problem, const Eigen::VectorXd& residual, bool fitted) {
  NoiseModel out;
  std::array<ComponentEstimate, 6> estimates;
  JobContext job;
  parallelFor(estimates.size(), job, [&](std::size_t c) {
    ComponentEstimate& e = estimates[c];
    e.data = componentData(problem, residual, static_cast<Component>(c), fitted);
    e.present = e.data.units.size() >= 6;
    if (!e.present) return;
    // A first look that outliers cannot spoil: those far from the median of their series' neighbours weigh little.
    std::vector<double> all;
    Eigen::VectorXd rough(e.data.residual.size());
    for (const auto& [from, to] : e.data.series) {
      for (Index i = from; i < to; ++i) {
        std::vector<double> near;
        for (Index j = std::max(from, i - 3); j <= std::min(to - 1, i + 3); ++j) {
          if (j != i) near.push_back(e.data.residual[j]);
        }
        rough[i] = (e.data.residual[i] - (near.empty() ? 0.0 : median(near))) / e.data.sigma[i];
        all.push_back(std::abs(rough[i]));
      }
    }
    const double spread = std::max(e.data.least_scale, 1.4826 * median(all));
    e.p.log_scale = std::log(spread);
    const ComponentNoise& known = problem.noise.component[c];
    if (known.gross_part > 0.0) {
      // Which readings are gross errors is known but for those that something explains by now.
      e.p.log_scale = std::log(known.scale);
      for (Index i = 0; i < rough.size(); ++i)
        e.data.weight[i] = problem.noise.weight[e.data.units[static_cast<std::size_t>(i)]];
      e.data.counted = e.data.weight.sum();
    } else if (const Tails gross = grossErrorsOf(problem, e.data, rough); gross.gross_part > 0.0) {
      // Of the better half, half lies within 0.67 standard deviations.
      e.p.log_scale = std::log(std::max(e.data.least_scale, quantile(all, 0.25) / normalQuantile(0.75)));
      e.own = rough * std::exp(-e.p.log_scale);
      setWeights(e, gross);
    } else {
      for (Index i = 0; i < rough.size(); ++i) {
        const double z = std::abs(rough[i]) / spread;
        if (z > 6.0) e.data.weight[i] = 25.0 / (z * z);
      }
    }
    estimateWithCourses(problem, e, false, !fitted);
  });
  TailsOfAll tails{};
  const auto anyGross = [&] {
    return std::any_of(tails.begin(), tails.end(), [](const Tails& t) { return t.gross_part > 0.0; });
  };
  // Gross errors are told from the others step by step, as what they spoilt recovers.
  constexpr int most_looks = 3;
  constexpr int most_looks_with_gross_errors = 12;
  for (int iteration = 0; iteration < (anyGross() ? most_looks_with_gross_errors : most_looks); ++iteration) {
    const TailsOfAll now = tailsOf(problem, estimates);
    if (iteration > 0 && now == TailsOfAll{} && tails == TailsOfAll{}) break;
    tails = now;
    parallelFor(estimates.size(), job, [&](std::size_t c) {
      ComponentEstimate& e = estimates[c];
      if (!e.present) return;
      setWeights(e, tails[c]);
      estimateWithCourses(problem, e, true, !fitted);
    });
  }
  out.weight = Eigen::VectorXd::Ones(problem.size());
  bool any_weight = false;
  for (std::size_t c = 0; c < estimates.size(); ++c) {
    const ComponentEstimate& e = estimates[c];
    if (!e.present) continue;
    ComponentNoise& n = out.component[c];
    n.scale = std::max(e.data.least_scale, std::exp(e.p.log_scale));
    n.scale_uncertainty = e.uncertainty;
    n.common = e.p.shift;
    n.drift_part = e.p.shift > 0.0 ? e.data.drift_part : 0.0;
    n.drift_time_s = n.drift_part > 0.0 ? e.data.drift_time_s : 0.0;
    n.correlated_part = e.p.part;
    n.correlation_time_s = e.p.part > 0.0 ? e.p.time_s : 0.0;
    n.tail_dof = tails[c].dof;
    n.gross_part = tails[c].gross_part;
    n.gross_density = tails[c].gross_density;
    for (std::size_t i = 0; i < e.data.units.size(); ++i) {
      out.weight[e.data.units[i]] = e.data.weight[static_cast<Index>(i)];
      any_weight = any_weight || e.data.weight[static_cast<Index>(i)] != 1.0;
    }
  }
  if (!any_weight) out.weight.resize(0);
  // Three components whose states are all shifted and rather drift, each of them, than not: together that is clear.
  constexpr double clear = 0.35;
  for (const std::size_t from : {0, 3}) {
    int drifting = 0;
    double gain = 0.0;
    for (std::size_t c = from; c < from + 3; ++c) {
      const ComponentNoise& n = out.component[c];
      const bool shifted = n.common > clear * n.scale * estimates[c].data.reading_sigma;
      if (!estimates[c].present || !shifted || !(estimates[c].data.drift_gain > 0.0)) continue;
      ++drifting;
      gain += estimates[c].data.drift_gain;
    }
    if (drifting < 3 || gain < 2.0 * drift_price) continue;
    for (std::size_t c = from; c < from + 3; ++c) out.component[c].largest_drift = largest_drift_of_all;
  }
  return out;
}

NoiseProfiles noiseProfiles(const ResidualProblem& problem, const Eigen::VectorXd& residual,
                            const std::array<bool, 6>& which) {
  NoiseProfiles out;
  JobContext job;
  parallelFor(out.size(), job, [&](std::size_t c) {
    if (!which[c]) return;
    ComponentEstimate e;
    e.data = componentData(problem, residual, static_cast<Component>(c), true);
    if (e.data.units.size() < 6) return;
    const ComponentNoise& n = problem.noise.component[c];
    for (std::size_t i = 0; i < e.data.units.size() && problem.noise.weight.size() > 0; ++i) {
      e.data.weight[static_cast<Index>(i)] = problem.noise.weight[e.data.units[i]];
    }
    const Tails tails{n.tail_dof, n.gross_part, n.gross_density};
    if (n.gross_part > 0.0) e.data.counted = e.data.weight.sum();
    e.p.log_scale = std::log(n.scale);
    e.p.part = n.correlated_part;
    e.p.time_s = n.correlation_time_s;
    const std::vector<double> sizes = shiftSizes(problem, c < 3);
    const auto profile = [&](ComponentEstimate estimate, ComponentNoise* shifts = nullptr) {
      estimateWithCourses(problem, estimate, false, false);
      // Which readings are gross errors depends on what explains the others.
      constexpr int most_looks = 6;
      for (int look = 0; n.gross_part > 0.0 && look < most_looks; ++look) {
        setWeights(estimate, tails);
        estimateWithCourses(problem, estimate, true, false);
      }
      if (shifts != nullptr) shifts->drift_part = estimate.data.drift_part;
      std::vector<double> deviances = estimate.data.shifts.cols() > 0 ? shiftDeviances(problem, estimate, sizes)
                                                                      : std::vector<double>{estimate.deviance};
      for (double& deviance : deviances) deviance += devianceOfGrossErrors(estimate, tails);
      return deviances;
    };
    out[c].with_unknown = profile(e);
    const Index readings = e.data.residual.size();
    out[c].told_apart = e.data.smooth.cols() > 0 || e.data.hats.cols() > 0;
    if (!out[c].told_apart) {
      out[c].noise_alone = out[c].with_unknown;
      return;
    }
    e.data.smooth.resize(readings, 0);
    e.data.hats.resize(readings, 0);
    const double own_um = std::exp(e.p.log_scale) * e.data.reading_sigma;
    ComponentNoise shifted;
    shifted.largest_drift = n.largest_drift;
    out[c].noise_alone = profile(e, &shifted);
    for (std::size_t i = 0; i + 1 < out[c].noise_alone.size(); ++i) {
      shifted.common = sizes[i];
      if (shifted.shiftsBeyond(own_um) > 0.0) out[c].noise_alone[i] = out[c].noise_alone.back() + impossible;
    }
  });
  return out;
}

double jointDeviance(const NoiseProfiles& profiles, std::vector<double> NoiseProfile::*profile) {
  double out = 0.0;
  for (const std::size_t from : {0, 3}) {
    // Likelihood of all components for each common size, over that without any shifts.
    std::vector<double> ln_level;
    for (std::size_t c = from; c < from + 3; ++c) {
      const std::vector<double>& deviance = profiles[c].*profile;
      if (deviance.empty()) continue;
      out += deviance.back();
      if (deviance.size() == 1) continue;
      const std::size_t sizes = deviance.size() - 1;
      assert(ln_level.empty() || ln_level.size() == sizes);  // compared are the same for all components of a unit
      ln_level.resize(sizes, 0.0);
      for (std::size_t level = 0; level < sizes; ++level) {
        double prior = 0.0;
        double likelihood = 0.0;
        const double least = *std::min_element(deviance.begin(), deviance.end());
        for (std::size_t i = 0; i < sizes; ++i) {
          const double apart = shift_step * (static_cast<double>(i) - static_cast<double>(level));
          const double w = std::exp(-0.5 * std::pow(apart / unlike_shifts_sd, 2));
          prior += w;
          likelihood += w * std::exp(-0.5 * (deviance[i] - least));
        }
        const double ln_none = -0.5 * (deviance.back() - least);  // of large shifts far below what exp can hold
        ln_level[level] +=
            std::log(shifted_too * likelihood / prior + (1.0 - shifted_too) * std::exp(ln_none)) - ln_none;
      }
    }
    if (ln_level.empty()) continue;
    const double most = std::max(0.0, *std::max_element(ln_level.begin(), ln_level.end()));
    double sum = (1.0 - shifts_at_all) * std::exp(-most);
    for (const double ln : ln_level) sum += shifts_at_all / static_cast<double>(ln_level.size()) * std::exp(ln - most);
    out -= 2.0 * (most + std::log(sum));
  }
  return out;
}

}  // namespace spindrift
