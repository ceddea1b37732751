// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/distributed_dynamics.h"
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/math/basic_solution.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Widths that stand where the data do not decide: of a driver that the effect has, and of the room beside it.
constexpr double usual_width = 0.05;
constexpr double room_width = 0.02;
/// The same for what happens in one span of time alone.
constexpr double scatter_width = 0.02;
constexpr int most_lag_spans = 48;
/// Of the prior's variance, for the inputs of the simplest dynamics: as much as each of the lags beside them.
constexpr double bound_share = 0.2;

/// What coolant does depends on how much colder than the room it is.
constexpr double product_width = 0.3;
bool product(const std::string& driver) {
  return driver.starts_with("coolant*");
}

/// One input that a term has, or may have besides. Inputs of one group (a driver of a term) share the prior's width.
struct LagInput {
  EffectInput input;
  std::vector<double> parameters;
  double share = 1.0;  // of the prior's variance
  int group = -1;      // -1: its gains are free
};

/// The inputs of a term with the parameters of each.
std::vector<LagInput> inputsOf(const ModelTerm& term) {
  std::vector<LagInput> out;
  std::size_t next = 0;
  for (const EffectInput& input : term.variant.inputs) {
    const auto count = static_cast<std::size_t>(parameterCount({{input}, false}));
    const std::size_t at = term.variant.shared_lag ? 0 : next;
    const auto first = term.parameters.begin() + static_cast<std::ptrdiff_t>(at);
    out.push_back({input, {first, first + static_cast<std::ptrdiff_t>(count)}});
    next += count;
  }
  return out;
}

/// What else may drive the term; every driver is a group.
void addCorrections(const ModelTerm& term, const DriverTable& drivers, std::map<std::string, int>& groups,
                    std::vector<LagInput>& inputs, std::set<int>& beside) {
  const Dynamics dynamics = term.variant.inputs[0].dynamics;
  const auto groupOf = [&](const std::string& name) {
    return groups.try_emplace(name, static_cast<int>(groups.size())).first->second;
  };
  if (dynamics == Dynamics::Pulse) {
    for (const double tau : {0.0, 300.0, 900.0, 2700.0, 8100.0}) {
      inputs.push_back({term.variant.inputs[0], {term.parameters[0], term.parameters[1], tau}, 0.2, groupOf("")});
    }
    return;
  }
  if (dynamics != Dynamics::Lag && dynamics != Dynamics::AsymmetricLag) return;
  std::set<std::string> names;
  for (const EffectVariant& variant : term.effect->variants) {
    for (const EffectInput& input : variant.inputs) names.insert(input.driver);
  }
  // Whatever part of the machine is heated follows the room, too, a little.
  const std::set<std::string> own = names;
  if (term.effect->of_machine) {
    for (const std::string& room : drivers.room()) names.insert(room);
  }
  // Friction rises less, or more, than in proportion to speed.
  for (const std::string& name : own) {
    if (drivers.has(name + "^2")) names.insert(name + "^2");
  }
  for (const std::string& name : names) {
    const Driver* driver = drivers.find(name);
    if (driver == nullptr) continue;
    const std::size_t first = inputs.size();
    const int group = groupOf(name);
    if (!own.contains(name) && driver->linear) beside.insert(group);
    if (driver->linear) inputs.push_back({{name, Dynamics::Lag}, {0.0}, 1.0, group});
    if (product(name) && dynamics == Dynamics::AsymmetricLag) {
      inputs.push_back({{name, dynamics}, {term.parameters[0], term.parameters[1]}, 1.0, group});
    }
    for (const double tau : {300.0, 900.0, 2700.0, 8100.0}) {
      inputs.push_back({{name, Dynamics::Lag}, {tau}, 1.0, group});
    }
    // What is switched heats at one pace and cools at another.
    if (!driver->linear) {
      for (const double tau : {600.0, 1800.0}) {
        for (const double ratio : {0.4, 2.5}) {
          inputs.push_back({{name, Dynamics::AsymmetricLag}, {tau, ratio * tau}, 1.0, group});
        }
      }
    }
    for (std::size_t c = first; c < inputs.size(); ++c)
      inputs[c].share = 1.0 / static_cast<double>(inputs.size() - first);
  }
}

/// The input that moves most stays free, and so do those that share its lag; the others join the group of their driver.
std::size_t bindInputs(const EffectSearch& search, const ResidualProblem& problem, const ModelTerm& term,
                       const Eigen::VectorXd& gains, bool all_free, std::map<std::string, int>& groups,
                       std::vector<LagInput>& inputs) {
  const Index k = search.shape(*term.effect).cols();
  const Eigen::MatrixXd x = problem.projected(search.columns(term));
  std::size_t main = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto at = static_cast<Index>(i) * k;
    const double size = (x.middleCols(at, k) * gains.segment(at, k)).norm();
    if (!(size > largest)) continue;
    largest = size;
    main = i;
  }
  if (all_free || term.variant.shared_lag || inputs[0].input.driver.empty()) return main;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    // Heat times a position, and the heat by itself, are one thing.
    const bool paired = inputs[i].input.driver.find('*') != std::string::npos ||
                        inputs[main].input.driver.find('*') != std::string::npos;
    if (i == main || paired) continue;
    inputs[i].share = bound_share;
    inputs[i].group = groups.try_emplace(inputs[i].input.driver, static_cast<int>(groups.size())).first->second;
  }
  return main;
}

struct Widths {
  std::vector<double> of_group;
  double log_evidence = 0.0;  // beyond that of no columns
};

/// The widths of the prior, one for each group, at the maximum of the marginal likelihood, for y = C c + e with unit
/// noise, c_i ~ N(0, width(group of i)^2). What the data do not decide stays as usual.
Widths likeliestWidths(const Eigen::MatrixXd& gram, const Eigen::VectorXd& b, const std::vector<int>& group,
                       const std::vector<double>& usual) {
  std::vector<double> widths = usual;
  const auto value = [&] {
    Eigen::VectorXd s(b.size());
    double prior = 0.0;
    for (Index i = 0; i < s.size(); ++i) s[i] = widths[static_cast<std::size_t>(group[static_cast<std::size_t>(i)])];
    for (std::size_t g = 0; g < widths.size(); ++g) {
      prior += 0.5 * std::pow(std::log(widths[g] / usual[g]) / std::log(4.0), 2);
    }
    Eigen::MatrixXd a = s.asDiagonal() * gram * s.asDiagonal();
    a.diagonal().array() += 1.0;
    const Eigen::LLT<Eigen::MatrixXd> llt(a);
    const Eigen::VectorXd z = llt.matrixL().solve(s.cwiseProduct(b));
    const double log_det = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
    return 0.5 * z.squaredNorm() - 0.5 * log_det - prior;
  };
  double best = value();
  for (int round = 0; round < 2; ++round) {
    for (std::size_t g = 0; g < widths.size(); ++g) {
      for (const double trial : {0.005, 0.01, 0.02, 0.04, 0.1, 0.2, 0.4, 0.8, 1.6}) {
        const double before = widths[g];
        if (trial == before) continue;
        widths[g] = trial;
        const double now = value();
        if (now > best) {
          best = now;
        } else {
          widths[g] = before;
        }
      }
    }
  }
  return {widths, best};
}

/// Course of a term by which it is off in one span of time, over all spans: what its drivers were measured with, and
/// all that has no dynamics, moves every reading of the effect together.
void addScatter(const ResidualProblem& problem, const Eigen::VectorXd& spread, double scale,
                std::vector<Eigen::VectorXd>& values) {
  const int bins = std::min(most_lag_spans, problem.epoch_count);
  std::vector<Eigen::VectorXd> columns(static_cast<std::size_t>(bins), Eigen::VectorXd::Zero(problem.size()));
  for (Index u = 0; u < problem.size(); ++u) {
    const int bin = problem.epoch[static_cast<std::size_t>(u)] * bins / std::max(1, problem.epoch_count);
    columns[static_cast<std::size_t>(bin)][u] = spread[u] * scale;
  }
  for (Eigen::VectorXd& column : columns) values.push_back(std::move(column));
}

/// A load without a driver that was still there when the last state was fitted: nobody knows when it ends. No more heat
/// is predicted than was seen; what it has warmed cools from then on.
void endWhatWasNotSeen(const ResidualProblem& problem, JointFit& fit) {
  const double last_s = *std::max_element(problem.time_s.begin(), problem.time_s.end());
  for (ModelTerm& term : fit.terms) {
    std::size_t next = 0;
    for (const EffectInput& input : term.variant.inputs) {
      const auto begin = term.parameters.begin() + static_cast<std::ptrdiff_t>(term.variant.shared_lag ? 0 : next);
      next += static_cast<std::size_t>(parameterCount({{input}, false}));
      if (input.dynamics != Dynamics::Pulse || !input.driver.empty()) continue;
      begin[1] = std::min(begin[1], std::max(0.0, last_s - begin[0]));
    }
  }
}

}  // namespace

DistributedFit distributedDynamics(const EffectSearch& search, const ResidualProblem& problem,
                                   const DriverTable& drivers, const JointFit& fit, double fixed_width) {
  DistributedFit out;
  out.fit = fit;
  struct Column {
    std::size_t term = 0;
    std::size_t input = 0;  // of the term; `scatter`: of none
    double scale = 1.0;
  };
  constexpr std::size_t scatter = static_cast<std::size_t>(-1);
  std::vector<Column> columns;
  std::vector<Eigen::VectorXd> values;
  std::vector<int> group_of;
  std::vector<Eigen::MatrixXd> free_parts;
  std::vector<std::vector<LagInput>> all(fit.terms.size());
  std::vector<Eigen::VectorXd> patterns(fit.terms.size());
  std::vector<double> usual;  // widths of the groups
  Index free_count = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const ModelTerm& term = fit.terms[t];
    const Index k = search.shape(*term.effect).cols();
    std::vector<LagInput>& inputs = all[t];
    inputs = inputsOf(term);
    std::map<std::string, int> groups;
    const std::size_t main = bindInputs(search, problem, term, fit.gains[t], fixed_width > 0.0, groups, inputs);
    std::set<int> beside;
    addCorrections(term, drivers, groups, inputs, beside);
    patterns[t] = fit.gains[t].segment(static_cast<Index>(main) * k, k);
    const Eigen::VectorXd spread = search.shape(*term.effect) * patterns[t];
    const double size = problem.projected(fit.contribution[t]).norm();
    std::vector<LagInput> kept;
    for (LagInput& input : inputs) {
      const EffectVariant alone{{input.input}, false};
      const Eigen::VectorXd q =
          problem.toUnits(inputResponses(drivers, alone, input.parameters, problem.node_time_s).col(0));
      if (input.group < 0) {
        // Of a free gain, and of its lag, the prior is as wide as what one observation tells.
        out.log_evidence -= 0.5 * search.logN() * static_cast<double>(k + parameterCount(alone));
        free_parts.emplace_back(q.asDiagonal() * search.shape(*term.effect));
        free_count += k;
        kept.push_back(std::move(input));
        continue;
      }
      Eigen::VectorXd column = q.cwiseProduct(spread);
      const double norm = problem.projected(column).norm();
      if (!(norm > 1e-6 * size) || !(size > 0.0)) continue;
      columns.push_back({t, kept.size(), std::sqrt(input.share) * size / norm});
      values.push_back(column * columns.back().scale);
      group_of.push_back(static_cast<int>(usual.size()) + input.group);
      kept.push_back(std::move(input));
    }
    inputs = std::move(kept);
    for (int g = 0; g < static_cast<int>(groups.size()); ++g) {
      usual.push_back(beside.contains(g) ? room_width : usual_width);
    }
    for (const auto& [name, g] : groups) {
      if (product(name)) usual[usual.size() - groups.size() + static_cast<std::size_t>(g)] = product_width;
    }
    if (fixed_width > 0.0 || groups.empty() || !(size > 0.0)) continue;
    const double whole = problem.whitened(spread).norm();
    if (!(whole > 0.0)) continue;
    addScatter(problem, spread, size / whole, values);
    columns.resize(values.size(), {t, scatter, 1.0});
    group_of.resize(values.size(), static_cast<int>(usual.size()));
    usual.push_back(scatter_width);
  }
  const auto count = static_cast<Index>(columns.size());
  if (count == 0) {
    out.log_evidence -= 0.5 * fit.chi2;
    for (const Eigen::VectorXd& gains : fit.gains) out.prior_sigma.emplace_back(Eigen::VectorXd::Zero(gains.size()));
    endWhatWasNotSeen(problem, out.fit);
    return out;
  }
  Eigen::MatrixXd raw(problem.size(), free_count + count);
  Index at = 0;
  for (const Eigen::MatrixXd& part : free_parts) {
    raw.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  for (Index c = 0; c < count; ++c) raw.col(free_count + c) = values[static_cast<std::size_t>(c)];
  const Eigen::MatrixXd x = problem.projected(raw);
  Eigen::MatrixXd free = x.leftCols(free_count);
  Eigen::VectorXd length = free.colwise().norm();
  length = (length.array() > 0.0).select(length, 1.0);
  free = free * length.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(free);
  qr.setThreshold(EffectSearch::dependent);
  const Eigen::VectorXd& y = problem.projectedResidual();
  const auto apart = [&](const Eigen::MatrixXd& m) { return Eigen::MatrixXd(m - free * qr.solve(m)); };
  const Eigen::MatrixXd c = apart(x.rightCols(count));
  Eigen::MatrixXd gram = c.transpose() * c;
  const Eigen::VectorXd rest = apart(y);
  const Eigen::VectorXd b = c.transpose() * rest;
  const Widths found = fixed_width > 0.0 ? Widths{std::vector<double>(usual.size(), fixed_width), 0.0}
                                         : likeliestWidths(gram, b, group_of, usual);
  const std::vector<double>& widths = found.of_group;
  Eigen::VectorXd width(count);
  for (Index i = 0; i < count; ++i) {
    width[i] = widths[static_cast<std::size_t>(group_of[static_cast<std::size_t>(i)])];
  }
  out.log_evidence += found.log_evidence - 0.5 * rest.squaredNorm();
  gram.diagonal() += width.array().square().inverse().matrix();
  const Eigen::VectorXd weight = gram.ldlt().solve(b);
  const Eigen::VectorXd free_gains = basicSolution(qr, y - x.rightCols(count) * weight).cwiseQuotient(length);

  at = 0;
  Index column = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    ModelTerm& term = out.fit.terms[t];
    const Index k = search.shape(*term.effect).cols();
    const auto n = static_cast<Index>(all[t].size()) * k;
    term.variant = {};
    term.parameters.clear();
    Eigen::VectorXd gains(n);
    Eigen::VectorXd prior = Eigen::VectorXd::Zero(n);
    for (std::size_t i = 0; i < all[t].size(); ++i) {
      const LagInput& input = all[t][i];
      term.variant.inputs.push_back(input.input);
      term.parameters.insert(term.parameters.end(), input.parameters.begin(), input.parameters.end());
      const auto place = static_cast<Index>(i) * k;
      if (input.group < 0) {
        gains.segment(place, k) = free_gains.segment(at, k);
        at += k;
        continue;
      }
      while (columns[static_cast<std::size_t>(column)].input == scatter) ++column;
      const double scale = columns[static_cast<std::size_t>(column)].scale;
      gains.segment(place, k) = patterns[t] * (scale * weight[column]);
      prior.segment(place, k) = patterns[t].cwiseAbs() * (scale * width[column]);
      ++column;
    }
    out.fit.gains[t] = gains;
    out.fit.contribution[t] = search.columns(term) * gains;
    out.prior_sigma.push_back(prior);
  }
  endWhatWasNotSeen(problem, out.fit);
  return out;
}

}  // namespace spindrift
