// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_posterior.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace spindrift {
namespace {

using Eigen::Index;

/// Effects that are tried in earnest after a sweep, and sets that are followed.
constexpr std::size_t most_tried = 5;
constexpr std::size_t beam_width = 3;
/// Second effects that are tried where two take the place of one.
constexpr std::size_t most_second = 3;
/// In evidence: what refining its lags may bring a set beyond the grid.
constexpr double refining_gains = 15.0;
/// In evidence, behind the best of a sweep: what is further behind on the grid does not catch up when lags are refined.
constexpr double sweep_window = 40.0;
/// In evidence, behind the best set: less probable sets are not listed.
constexpr double occam_window = 30.0;
/// Sets that are weighed beside noise of their own as well: how far behind the best, and how many.
constexpr double close_window = 30.0;
constexpr std::size_t most_close = 8;
/// A set in which signs or bounds are broken is out.
constexpr double inadmissible_price = 1e6;
/// Errors of a driver that add less than this to chi-squared are not worth their columns, nor more columns than these.
constexpr double least_error_power = 1.0;
constexpr int most_error_hats = 24;
/// What an effect must bring beyond errors of the simulation, at most: larger ones are nuisances of their own.
constexpr double most_simulation_price = 30.0;

std::vector<std::string> idsOf(const std::vector<ModelTerm>& terms) {
  std::vector<std::string> ids;
  for (const ModelTerm& term : terms) ids.push_back(term.effect->id);
  return ids;
}

std::string keyOf(const std::vector<ModelTerm>& terms) {
  std::vector<std::string> ids = idsOf(terms);
  std::sort(ids.begin(), ids.end());
  std::string key;
  for (const std::string& id : ids) key += id + "|";
  return key;
}

/// Of the catalogue, and holds a simpler effect in a wider pattern, which follows part of much that it does not cause.
/// One that holds another in the same pattern, driven in more ways, pays for the choice among these. Effects of the
/// user's pay for their gains alone.
bool wide(const Effect& effect) {
  return !effect.own && !effect.contains.empty() && effect.shape.size() > 1;
}

bool driverless(const Effect& effect) {
  return !effect.variants.empty() &&
         std::all_of(effect.variants.begin(), effect.variants.end(), [](const EffectVariant& variant) {
           return variant.inputs[0].driver.empty() && variant.inputs[0].dynamics == Dynamics::Pulse;
         });
}

bool sameShape(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (a.cols() != 1 || b.cols() != 1) return false;
  const double dot = a.col(0).dot(b.col(0));
  return dot != 0.0 && std::abs(dot) > 0.999 * a.col(0).norm() * b.col(0).norm();
}

Eigen::MatrixXd joined(const std::vector<Eigen::VectorXd>& columns, Index rows) {
  Eigen::MatrixXd out(rows, static_cast<Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) out.col(static_cast<Index>(c)) = columns[c];
  return out;
}

/// Columns of errors of formulas, whitened: their products, and those with what is left.
struct ErrorProducts {
  Eigen::MatrixXd gram;
  Eigen::VectorXd moved;
};

/// Of columns (over the units) free of constants, of the nuisances, and of an orthonormal basis that is orthogonal to
/// both, as `left` is.
ErrorProducts errorProducts(const ResidualProblem& problem, const Eigen::MatrixXd& columns,
                            const Eigen::MatrixXd& named, const Eigen::VectorXd& left) {
  ErrorProducts out;
  const Index count = columns.cols();
  out.gram = Eigen::MatrixXd::Zero(count, count);
  out.moved = Eigen::VectorXd::Zero(count);
  if (count == 0) return out;
  Eigen::MatrixXd nuisances = Eigen::MatrixXd::Zero(problem.nuisanceBasis().cols(), count);
  Eigen::MatrixXd along = Eigen::MatrixXd::Zero(named.cols(), count);
  // Domain by domain: most columns, and most nuisances, are of one.
  for (std::size_t d = 0; d < problem.domains().size(); ++d) {
    const auto& domain = problem.domains()[d];
    std::vector<Index> here;
    for (Index c = 0; c < count; ++c) {
      if (!columns.col(c).segment(domain.from, domain.count).isZero(0.0)) here.push_back(c);
    }
    if (here.empty()) continue;
    const Eigen::MatrixXd m =
        problem.withoutConstants(d, columns.middleRows(domain.from, domain.count)(Eigen::all, here));
    // The whole product: half of it, by Eigen's own loops, takes longer.
    out.gram(here, here) += m.transpose() * m;
    out.moved(here) += m.transpose() * left.segment(domain.from, domain.count);
    const auto& part = problem.nuisanceParts()[d];
    nuisances(part.columns, here) += part.rows.transpose() * m;
    along(Eigen::all, here) += named.middleRows(domain.from, domain.count).transpose() * m;
  }
  out.gram.noalias() -= nuisances.transpose() * nuisances;
  out.gram.noalias() -= along.transpose() * along;
  out.gram.triangularView<Eigen::StrictlyUpper>() = out.gram.transpose();
  return out;
}

/// Twice the logarithm of the factor by which errors of formulas change the probability of what is left: coefficients ~
/// N(0, 1) of the columns, of the first `always` in any case, of every further one with probability p.
double formulaErrorGain(const ErrorProducts& products, Index always, double p) {
  // 1 + gram = L L' of the ways that are taken, a row for each: one more way is one more row.
  const Index count = products.gram.cols();
  Eigen::MatrixXd rows =
      Eigen::MatrixXd::Zero(count, count);  // L', a column for each way, so that it lies in one piece
  Eigen::VectorXd z(count);
  std::vector<Index> ways;
  double gain = 0.0;
  double mixed = 0.0;  // of the ways that are there with probability p, over what is taken in `gain`
  for (Index c = 0; c < count; ++c) {
    const auto taken = static_cast<Index>(ways.size());
    auto row = rows.col(taken).head(taken);
    for (Index i = 0; i < taken; ++i) row[i] = products.gram(ways[static_cast<std::size_t>(i)], c);
    rows.topLeftCorner(taken, taken).transpose().triangularView<Eigen::Lower>().solveInPlace(row);
    const double own = 1.0 + products.gram(c, c) - row.squaredNorm();  // 1 at least, but for rounding
    const double pivot = std::sqrt(std::max(own, 0.5));
    z[taken] = (products.moved[c] - row.dot(z.head(taken))) / pivot;
    const double more = z[taken] * z[taken] - 2.0 * std::log(pivot);
    if (c >= always && !(more > 0.0)) {
      mixed += 2.0 * std::log((1.0 - p) + p * std::exp(0.5 * more));
      continue;
    }
    if (c >= always) mixed += 2.0 * std::log(p + (1.0 - p) * std::exp(-0.5 * more));
    rows(taken, taken) = pivot;
    ways.push_back(c);
    gain += more;
  }
  return gain + mixed;
}

/// The components in which two residuals are not the same.
std::array<bool, 6> differing(const ResidualProblem& problem, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  std::array<bool, 6> out{};
  for (Index u = 0; u < problem.size(); ++u) {
    if (std::abs(a[u] - b[u]) > 1e-3 * problem.ownSigma(u))
      out[static_cast<std::size_t>(problem.component[static_cast<std::size_t>(u)])] = true;
  }
  return out;
}

/// 2 ln of the odds of something smooth in the components in `which`, the others as they are; infinite where too few
/// readings could tell.
double smoothIn(NoiseProfiles profiles, const std::array<bool, 6>& which) {
  bool told_apart = false;
  for (std::size_t c = 0; c < profiles.size(); ++c) {
    if (which[c]) {
      told_apart = told_apart || profiles[c].told_apart;
    } else {
      profiles[c].noise_alone = profiles[c].with_unknown;
    }
  }
  if (!told_apart) return std::numeric_limits<double>::infinity();
  return jointDeviance(profiles, &NoiseProfile::noise_alone) - jointDeviance(profiles, &NoiseProfile::with_unknown);
}

}  // namespace

double smoothBesideNoise(const ResidualProblem& problem, const JointFit& fit, const JointFit& named) {
  Eigen::VectorXd by_all = problem.without(fit.contribution);
  Eigen::VectorXd by_named = problem.without(named.contribution);
  const ResidualProblem::NuisancePart of_all = problem.nuisancePart(by_all);
  const ResidualProblem::NuisancePart of_named = problem.nuisancePart(by_named);
  by_all -= of_all.values;
  by_named -= of_named.values;
  const NoiseProfiles profiles = noiseProfiles(problem, by_named, {true, true, true, true, true, true});
  // What is smooth also spares the nuisances that would be stretched without it.
  return smoothIn(profiles, differing(problem, by_named, by_all)) + std::max(0.0, of_named.price - of_all.price);
}

double answerDeviance(const ResidualProblem& problem, const JointFit& fit, double price) {
  Eigen::VectorXd left = problem.without(fit.contribution);
  const ResidualProblem::NuisancePart taken = problem.nuisancePart(left);
  left -= taken.values;
  const NoiseProfiles profiles = noiseProfiles(problem, left, {true, true, true, true, true, true});
  return jointDeviance(profiles, &NoiseProfile::with_unknown) + taken.price + price;
}

bool holdsEffect(const Effect& container, const std::string& simple) {
  return std::find(container.contains.begin(), container.contains.end(), simple) != container.contains.end();
}

PosteriorSearch::PosteriorSearch(const EffectSearch& search, const ResidualProblem& problem,
                                 const CandidateLibrary& library, const DiscrepancyOptions& options,
                                 const DiscrepancyPriors& priors, double simulation_error)
    : search_(&search), problem_(&problem), library_(&library), options_(&options), priors_(priors) {
  for (std::size_t d = 0; d < problem.domains().size(); ++d) {
    const auto& domain = problem.domains()[d];
    const Eigen::VectorXd white =
        problem.withoutConstants(d, problem.simulated.segment(domain.from, domain.count)).col(0);
    for (Index i = 0; i < domain.count; ++i) {
      simulation_power_[static_cast<std::size_t>(problem.component[static_cast<std::size_t>(domain.from + i)])] +=
          std::pow(simulation_error * white[i], 2);
    }
  }
  // The same everywhere, and along X, Y and Z: mean square 1 each.
  place_patterns_ = Eigen::MatrixXd::Ones(problem.size(), 4);
  for (Index u = 0; u < problem.size(); ++u)
    place_patterns_.row(u).tail<3>() = problem.place[static_cast<std::size_t>(u)].position_mm.transpose();
  Index kept = 1;
  for (Index k = 1; k < 4; ++k) {
    Eigen::VectorXd along = place_patterns_.col(k);
    along.array() -= along.mean();
    const double rms = along.norm() / std::sqrt(static_cast<double>(along.size()));
    if (rms > 1.0) place_patterns_.col(kept++) = along / rms;  // mm: places that do not move have no slope
  }
  place_patterns_.conservativeResize(Eigen::NoChange, kept);
}

double PosteriorSearch::imitationPrice(const JointFit& fit) const {
  // Power of every term and of all together, per component.
  std::vector<std::array<double, 6>> power(fit.terms.size());
  Eigen::MatrixXd parts(problem_->size(), static_cast<Index>(fit.terms.size()));
  for (std::size_t t = 0; t < fit.terms.size(); ++t) parts.col(static_cast<Index>(t)) = fit.contribution[t];
  const Eigen::MatrixXd white = problem_->projected(parts);
  const Eigen::MatrixXd whole = problem_->whitened(parts);
  std::array<double, 6> units{};
  for (const Component c : problem_->component) units[static_cast<std::size_t>(c)] += 1.0;
  double price = 0.0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    std::array<double, 6> own{};
    std::array<double, 6> before{};
    double total = 0.0;
    for (Index u = 0; u < problem_->size(); ++u) {
      const auto c = static_cast<std::size_t>(problem_->component[static_cast<std::size_t>(u)]);
      const double z = white(u, static_cast<Index>(t));
      own[c] += z * z;
      before[c] += std::pow(whole(u, static_cast<Index>(t)), 2);
      total += z * z;
    }
    const EffectInput& first = fit.terms[t].variant.inputs[0];
    const bool onset = first.dynamics == Dynamics::Step || first.dynamics == Dynamics::Pulse;
    const double part = onset ? priors_.further_onset_error : priors_.further_error;
    // Where and when it acts: a slip of one point imitates nothing of what moves the others.
    std::array<double, 6> others{};
    for (Index u = 0; u < problem_->size(); ++u) {
      const auto c = static_cast<std::size_t>(problem_->component[static_cast<std::size_t>(u)]);
      const double z = white(u, static_cast<Index>(t));
      const double rest = white.row(u).sum() - z;
      others[c] += std::min(1.0, z * z * units[c] / std::max(1e-9, own[c])) * rest * rest;
    }
    for (std::size_t c = 0; c < own.size(); ++c) {
      if (own[c] < 0.05 * total) continue;
      price += part * part * others[c];
      // What the nuisances of the simulation can follow has paid for its error already.
      if (fit.terms[t].effect->id == off_) continue;
      const double beyond = std::min(1.0, own[c] / std::max(1e-9, before[c]));
      price += beyond * std::min(most_simulation_price, simulation_power_[c]);
    }
    const double wider = fit.terms[t].effect->refinement ? priors_.refinement_error : priors_.wider_error;
    if (wide(*fit.terms[t].effect)) price += wider * wider * total;
  }
  return price;
}

Eigen::MatrixXd PosteriorSearch::crosstalkColumns(const JointFit& fit) const {
  std::vector<Eigen::VectorXd> columns;
  std::array<double, 6> count{};
  for (const Component c : problem_->component) count[static_cast<std::size_t>(c)] += 1.0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    // What a user states, or a part of the simulation that is off, moves what it says and nothing else.
    const Effect& effect = *fit.terms[t].effect;
    if (effect.own || effect.id == off_) continue;
    const Eigen::VectorXd course = search_->course(fit.terms[t], fit.gains[t]);
    if (course.size() == 0) continue;
    // The mean square of every component, rotations as the translations that they make at the lever, um^2.
    std::array<double, 6> power{};
    for (Index u = 0; u < problem_->size(); ++u) {
      const auto c = static_cast<std::size_t>(problem_->component[static_cast<std::size_t>(u)]);
      power[c] += std::pow(fit.contribution[t][u] * (c < 3 ? 1.0 : priors_.crosstalk_lever_m), 2) / count[c];
    }
    const double largest = *std::max_element(power.begin(), power.end());
    for (std::size_t c = 0; c < power.size(); ++c) {
      // Where it acts already, another size at every point says it all.
      if (count[c] == 0.0 || power[c] > 0.05 * largest) continue;
      const double size = priors_.crosstalk_error * std::sqrt(largest) / (c < 3 ? 1.0 : priors_.crosstalk_lever_m);
      for (Index pattern = 0; pattern < place_patterns_.cols(); ++pattern) {
        Eigen::VectorXd column = Eigen::VectorXd::Zero(problem_->size());
        for (Index u = 0; u < column.size(); ++u) {
          if (static_cast<std::size_t>(problem_->component[static_cast<std::size_t>(u)]) == c)
            column[u] = size * course[u] * place_patterns_(u, pattern);
        }
        columns.push_back(std::move(column));
      }
    }
  }
  return joined(columns, problem_->size());
}

void PosteriorSearch::appendSensorErrors(const JointFit& fit, std::size_t t,
                                         std::vector<Eigen::VectorXd>& columns) const {
  const ModelTerm& term = fit.terms[t];
  const Eigen::MatrixXd& shape = search_->shape(*term.effect);
  const double first = problem_->node_time_s.front();
  const double span = std::max(1.0, problem_->node_time_s.back() - first);
  for (std::size_t i = 0; i < term.variant.inputs.size(); ++i) {
    const ResponseError error = responseError(search_->drivers(), term.variant, term.parameters, i);
    if (!(error.standard_deviation > 0.0)) continue;
    const Eigen::VectorXd pattern = shape * fit.gains[t].segment(static_cast<Index>(i) * shape.cols(), shape.cols());
    double power = 0.0;
    for (Index u = 0; u < pattern.size(); ++u) power += std::pow(pattern[u] / problem_->ownSigma(u), 2);
    const auto append = [&](double sigma, const auto& course) {
      Eigen::VectorXd column(pattern.size());
      for (Index u = 0; u < pattern.size(); ++u)
        column[u] = sigma * pattern[u] * course(problem_->time_s[static_cast<std::size_t>(u)] - first);
      columns.push_back(std::move(column));
    };
    if (power * error.start * error.start >= least_error_power)
      append(error.start, [&](double t_s) { return std::exp(-std::max(0.0, t_s) / error.tau_s); });
    if (power * std::pow(error.standard_deviation, 2) < least_error_power) continue;
    const int most = std::clamp(problem_->epoch_count, 2, most_error_hats);
    const int count = std::clamp(static_cast<int>(span / std::max(1.0, error.time_s)) + 1, 2, most);
    for (int h = 0; h < count; ++h)
      append(error.standard_deviation,
             [&](double t_s) { return std::max(0.0, 1.0 - std::abs(t_s / span * (count - 1) - h)); });
  }
}

Eigen::MatrixXd PosteriorSearch::modelErrorColumns(const JointFit& fit) const {
  std::vector<Eigen::VectorXd> columns;
  const double start = problem_->node_time_s.front();
  const double span = std::max(1.0, problem_->node_time_s.back() - start);
  const int hats = std::clamp(problem_->epoch_count / 3, 2, 12);
  const auto hat = [&](int h, Index u) {
    const double position = (problem_->time_s[static_cast<std::size_t>(u)] - start) / span * (hats - 1);
    return std::max(0.0, 1.0 - std::abs(position - h));
  };
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const Eigen::VectorXd& f = fit.contribution[t];
    // Another size at every point.
    std::vector<Eigen::VectorXd> sizes(static_cast<std::size_t>(problem_->neighbourhood_count));
    for (Index u = 0; u < f.size(); ++u) {
      if (f[u] == 0.0) continue;
      auto& column = sizes[static_cast<std::size_t>(problem_->neighbourhood[static_cast<std::size_t>(u)])];
      if (column.size() == 0) column = Eigen::VectorXd::Zero(f.size());
      column[u] = priors_.model_error * f[u];
    }
    for (Eigen::VectorXd& column : sizes) {
      if (column.size() > 0) columns.push_back(std::move(column));
    }
    appendSensorErrors(fit, t, columns);
    // Another size in every span of time.
    const EffectInput& first = fit.terms[t].variant.inputs[0];
    if (first.driver.empty() && first.dynamics != Dynamics::Pulse && !fit.terms[t].effect->over_time) continue;
    for (int h = 0; h < hats; ++h) {
      Eigen::VectorXd column(f.size());
      for (Index u = 0; u < f.size(); ++u) column[u] = priors_.model_error * f[u] * hat(h, u);
      if (!column.isZero(0.0)) columns.push_back(std::move(column));
    }
    // Driven by something else than what drives it: the course is off, in the pattern that the effect has.
    if (!drivenByStandIn(fit.terms[t])) continue;
    const Eigen::MatrixXd& shape = search_->shape(*fit.terms[t].effect);
    const Eigen::VectorXd pattern = shape * fit.gains[t].head(shape.cols());
    const Eigen::VectorXd moved = problem_->centred(f);
    if (!(pattern.squaredNorm() > 0.0)) continue;
    const double size = priors_.stand_in_error * moved.norm() / pattern.norm();
    for (int h = 0; h < hats; ++h) {
      Eigen::VectorXd column(f.size());
      for (Index u = 0; u < f.size(); ++u) column[u] = size * pattern[u] * hat(h, u);
      columns.push_back(std::move(column));
    }
  }
  return joined(columns, problem_->size());
}

double PosteriorSearch::priceOf(const JointFit& fit) const {
  const double effects = std::max<double>(2.0, static_cast<double>(search_->catalogue().size()));
  double price = 0.0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    if (fit.terms[t].effect->id == off_) continue;
    if (wide(*fit.terms[t].effect)) {
      price += 2.0 * std::log(1.0 / priors_.wider);
    } else if (fit.terms[t].effect->refinement) {
      price += 2.0 * std::log(1.0 / priors_.refined);
    }
    if (warmStart(fit.terms[t].variant)) price += warm_price;
    if (fit.terms[t].effect->driver_missing) price += 2.0 * std::log(1.0 / priors_.without_driver);
    const double missing = t == 0 ? priors_.one_missing : priors_.one_more;
    price += library_->choicePrice(*fit.terms[t].effect) + 2.0 * std::log(effects) +
             2.0 * std::log((1.0 - missing) / missing);
  }
  return price;
}

double PosteriorSearch::evidenceOf(const JointFit& fit) const {
  const Eigen::VectorXd& y = problem_->projectedResidual();
  if (fit.terms.empty()) return -y.squaredNorm();
  Index total = 0;
  std::vector<Eigen::MatrixXd> parts;
  for (const ModelTerm& term : fit.terms) {
    parts.push_back(search_->columns(term));
    total += parts.back().cols();
  }
  Eigen::MatrixXd raw(problem_->size(), total);
  Index at = 0;
  for (const Eigen::MatrixXd& part : parts) {
    raw.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  Eigen::MatrixXd x = problem_->projected(raw);
  for (Index c = 0; c < total; ++c) {
    const double norm = x.col(c).norm();
    if (norm > 0.0) x.col(c) /= norm;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
  qr.setThreshold(EffectSearch::dependent);
  const auto rank = qr.rank();
  const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(x.rows(), rank);
  const Eigen::VectorXd left = y - basis * (basis.transpose() * y);
  // How each effect may differ from its formula: always where it acts, and, with a probability for each way, elsewhere.
  const Eigen::MatrixXd here = modelErrorColumns(fit);
  const Eigen::MatrixXd elsewhere = crosstalkColumns(fit);
  Eigen::MatrixXd m(problem_->size(), here.cols() + elsewhere.cols());
  m << here, elsewhere;
  const ErrorProducts errors = errorProducts(*problem_, m, basis, left);
  return -left.squaredNorm() + formulaErrorGain(errors, here.cols(), priors_.crosstalk) -
         static_cast<double>(rank) * search_->logN() - priceOf(fit) - imitationPrice(fit);
}

CandidateLibrary::Given PosteriorSearch::given(const JointFit& fit) const {
  CandidateLibrary::Given out;
  const Eigen::VectorXd& y = problem_->projectedResidual();
  std::vector<Eigen::MatrixXd> parts;
  Index free = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const Eigen::MatrixXd x = search_->columns(fit.terms[t]);
    const auto parameters = static_cast<Index>(fit.terms[t].parameters.size());
    Eigen::MatrixXd part(x.rows(), x.cols() + parameters);
    part.leftCols(x.cols()) = x;
    for (Index p = 0; p < parameters; ++p) {
      part.col(x.cols() + p) = search_->derivative(fit.terms[t], fit.gains[t], static_cast<std::size_t>(p));
    }
    free += part.cols();
    parts.push_back(std::move(part));
  }
  const Eigen::MatrixXd m = modelErrorColumns(fit);
  Eigen::MatrixXd raw(problem_->size(), free + m.cols());
  Index at = 0;
  for (const Eigen::MatrixXd& part : parts) {
    raw.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  raw.rightCols(m.cols()) = m;
  const Eigen::MatrixXd projected = problem_->projected(raw);
  const Index rows = projected.rows();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows + m.cols(), raw.cols());
  all.topRows(rows) = projected;
  all.bottomRightCorner(m.cols(), m.cols()).setIdentity();
  out.basis.resize(all.rows(), all.cols());
  Index used = 0;
  for (Index c = 0; c < all.cols(); ++c) {
    Eigen::VectorXd v = all.col(c);
    const double before = v.norm();
    for (int pass = 0; pass < 2; ++pass) {
      v.noalias() -= out.basis.leftCols(used) * (out.basis.leftCols(used).transpose() * v);
    }
    const double norm = v.norm();
    if (!(norm > 1e-6 * before) || !(norm > 0.0)) continue;
    out.basis.col(used++) = v / norm;
  }
  out.basis.conservativeResize(Eigen::NoChange, used);
  out.residual = Eigen::VectorXd::Zero(all.rows());
  out.residual.head(rows) = y;
  if (used > 0) out.residual -= out.basis * (out.basis.transpose() * out.residual);
  return out;
}

PosteriorSearch::State PosteriorSearch::stateOf(const std::vector<ModelTerm>& terms, int rounds) const {
  State out;
  out.fit = rounds > 0 ? search_->refine(terms, rounds) : search_->solve(terms);
  out.evidence = evidenceOf(out.fit);
  bool cold = false;  // something would have been warmer at the start than it can be: then it was not
  std::vector<ModelTerm> without_start = out.fit.terms;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (search_->admissible(out.fit.terms[t], out.fit.gains[t], EffectSearch::believed_in_one_state)) continue;
    out.evidence -= inadmissible_price;
    if (!warmStart(without_start[t].variant)) continue;
    without_start[t].variant.inputs.pop_back();
    without_start[t].variant.shared_lag = without_start[t].variant.inputs.size() > 1;
    cold = true;
  }
  if (cold) {
    State again = stateOf(without_start, rounds);
    if (again.evidence > out.evidence) return again;
  }
  return rounds > 1 ? withFewerLags(std::move(out), rounds) : out;
}

PosteriorSearch::State PosteriorSearch::stateWith(const std::vector<ModelTerm>& terms, const CandidateFit& candidate,
                                                  int rounds) const {
  std::vector<ModelTerm> with = terms;
  with.push_back(candidate.term);
  State best = stateOf(with, rounds);
  if (!throughTwoLags(best.fit.terms.back().variant) &&
      search_->admissible(best.fit.terms.back(), best.fit.gains.back(), EffectSearch::believed_in_one_state))
    return best;
  for (const ModelTerm& other : candidate.other_ways) {
    with.back() = other;
    State again = stateOf(with, rounds);
    if (again.evidence > best.evidence) best = std::move(again);
  }
  return best;
}

ModelTerm PosteriorSearch::throughOneLag(const JointFit& fit, std::size_t t) const {
  ModelTerm out = fit.terms[t];
  out.variant.inputs.pop_back();
  const Eigen::VectorXd& gains = fit.gains[t];
  const Index k = gains.size() / 2;
  const double a = gains.head(k).sum();
  const double b = gains.tail(k).sum();
  const auto [low, high] = search_->parameterBounds(fit.terms[t], 0);
  // The mean delay of the two.
  const double mean = (a * out.parameters[0] + b * out.parameters[1]) / (a + b);
  const double tau = std::isfinite(mean) ? mean : out.parameters[1];
  out.parameters = {std::clamp(tau, low, high)};
  return out;
}

PosteriorSearch::State PosteriorSearch::withFewerLags(State state, int rounds) const {
  for (std::size_t t = 0; t < state.fit.terms.size(); ++t) {
    if (!throughTwoLags(state.fit.terms[t].variant)) continue;
    std::vector<ModelTerm> terms = state.fit.terms;
    terms[t] = throughOneLag(state.fit, t);
    State simple = stateOf(terms, rounds);
    if (simple.evidence >= state.evidence) state = std::move(simple);
  }
  return state;
}

void PosteriorSearch::appendOtherNames(const std::vector<ModelTerm>& terms, std::vector<std::string>& ids) const {
  for (const ModelTerm& term : terms) {
    if (!driverless(*term.effect)) continue;
    for (const Effect& effect : search_->catalogue()) {
      if (driverless(effect) && sameShape(search_->shape(effect), search_->shape(*term.effect)))
        ids.push_back(effect.id);
    }
  }
}

std::vector<PosteriorSearch::State> PosteriorSearch::extend(const State& state, std::size_t most, const JobContext& job,
                                                            double least) const {
  std::vector<std::string> skip = idsOf(state.fit.terms);
  skip.insert(skip.end(), options_->reject.begin(), options_->reject.end());
  appendOtherNames(state.fit.terms, skip);
  const std::vector<CandidateFit> found = library_->sweep(given(state.fit), skip, job);
  std::vector<const CandidateFit*> tried;
  for (const CandidateFit& c : found) {
    if (tried.size() >= most || c.evidence < found.front().evidence - sweep_window || !(c.delta_chi2 > 4.0)) break;
    if (state.evidence + c.evidence < least) break;
    tried.push_back(&c);
  }
  std::vector<State> out(tried.size());
  parallelFor(tried.size(), job, [&](std::size_t i) { out[i] = stateWith(state.fit.terms, *tried[i], 1); });
  return out;
}

PosteriorSearch::State PosteriorSearch::exchanged(State best, const JobContext& job,
                                                  std::vector<State>& visited) const {
  const auto most = static_cast<std::size_t>(options_->max_effects) + options_->accept.size();
  for (int round = 0; round < 2; ++round) {
    bool better = false;
    for (std::size_t t = 0; t < best.fit.terms.size(); ++t) {
      const std::string& id = best.fit.terms[t].effect->id;
      if (std::find(options_->accept.begin(), options_->accept.end(), id) != options_->accept.end()) continue;
      std::vector<ModelTerm> others = best.fit.terms;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
      State without = stateOf(others, 1);
      std::vector<State> tried = extend(without, most_tried, job);
      // Two in its place, which it may have stood for; in place of one alone the beam has looked for two.
      if (best.fit.terms.size() > 1 && best.fit.terms.size() < most) {
        const std::size_t singles = std::min(tried.size(), beam_width);
        for (std::size_t k = 0; k < singles; ++k) {
          std::vector<State> two = extend(tried[k], most_second, job, best.evidence - refining_gains);
          tried.insert(tried.end(), std::make_move_iterator(two.begin()), std::make_move_iterator(two.end()));
        }
      }
      tried.push_back(without);
      for (State& s : tried) {
        const bool improves = s.evidence > best.evidence + 1e-3;
        visited.push_back(s);
        if (improves) {
          best = std::move(s);
          better = true;
        }
      }
      if (better) break;
    }
    if (!better) break;
  }
  return best;
}

SlotEvidence PosteriorSearch::slotOf(const State& best, std::size_t t, const JobContext& job,
                                     std::vector<State>& visited) const {
  SlotEvidence out;
  const Effect& own = *best.fit.terms[t].effect;
  std::vector<ModelTerm> others = best.fit.terms;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
  State without = stateOf(others, 1);
  // What stands only beside this one falls with it.
  while (without.evidence < -0.5 * inadmissible_price) {
    std::vector<ModelTerm> standing;
    for (std::size_t k = 0; k < without.fit.terms.size(); ++k) {
      if (search_->admissible(without.fit.terms[k], without.fit.gains[k])) standing.push_back(without.fit.terms[k]);
    }
    if (standing.size() == without.fit.terms.size()) break;
    without = stateOf(standing, 1);
  }
  visited.push_back(without);
  out.delta_chi2 = without.fit.chi2 - best.fit.chi2;
  out.delta_evidence = best.evidence - without.evidence;
  // Everything that could stand in its place, what the user rejected as well: it is told, not named.
  std::vector<std::string> skip = idsOf(best.fit.terms);
  appendOtherNames(others, skip);
  const std::vector<CandidateFit> found = library_->sweep(given(without.fit), skip, job);
  std::vector<const CandidateFit*> tried;
  for (const CandidateFit& c : found) {
    if (tried.size() >= 2 * most_tried || c.evidence < out.delta_evidence - sweep_window - occam_window) break;
    tried.push_back(&c);
  }
  std::vector<State> states(tried.size());
  parallelFor(tried.size(), job, [&](std::size_t i) { states[i] = stateWith(others, *tried[i], 2); });
  const auto rejected = [&](const std::string& id) {
    return std::find(options_->reject.begin(), options_->reject.end(), id) != options_->reject.end();
  };
  double sum = 1.0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    Alternative a;
    a.id = tried[i]->term.effect->id;
    a.evidence = states[i].evidence;
    a.container = holdsEffect(*tried[i]->term.effect, own.id);
    a.contained = holdsEffect(own, a.id);
    a.rejected = rejected(a.id);
    a.probability = std::exp(std::min(50.0, 0.5 * (a.evidence - best.evidence)));
    a.joint = states[i].fit;
    visited.push_back(states[i]);
    sum += a.probability;
    out.others.push_back(std::move(a));
  }
  for (Alternative& a : out.others) a.probability /= sum;
  out.probability = 1.0 / sum;
  std::stable_sort(out.others.begin(), out.others.end(),
                   [](const Alternative& a, const Alternative& b) { return a.evidence > b.evidence; });
  return out;
}

double PosteriorSearch::wholePriceOf(const JointFit& fit) const {
  double gains = fit.parameter_count;
  for (const ModelTerm& term : fit.terms) gains -= static_cast<double>(term.parameters.size());
  return gains * search_->logN() + priceOf(fit);
}

const JointFit& PosteriorSearch::likeliestBesideItsOwnNoise(const EffectPosterior& posterior) const {
  const JointFit* likeliest = &posterior.fit;
  if (posterior.close.empty()) return *likeliest;
  double least = answerDeviance(*problem_, posterior.fit, wholePriceOf(posterior.fit)) - priors_.beside_own_noise;
  for (const JointFit& fit : posterior.close) {
    const double deviance = answerDeviance(*problem_, fit, wholePriceOf(fit));
    if (!(deviance < least)) continue;
    least = deviance;
    likeliest = &fit;
  }
  return *likeliest;
}

void PosteriorSearch::weighAgainstUnknown(EffectPosterior& posterior, Remainder& remainder) const {
  const JointFit& fit = posterior.fit;
  Eigen::VectorXd left = problem_->without(fit.contribution);
  const ResidualProblem::NuisancePart taken = problem_->nuisancePart(left);
  left -= taken.values;
  const NoiseProfiles with = noiseProfiles(*problem_, left, {true, true, true, true, true, true});
  const double with_unknown = jointDeviance(with, &NoiseProfile::with_unknown);
  const double noise_alone = jointDeviance(with, &NoiseProfile::noise_alone);
  for (Remainder::OfComponent& r : remainder.components) {
    std::array<bool, 6> one{};
    one[static_cast<std::size_t>(r.component)] = true;
    // What is smooth also spares the nuisances that would be stretched without it.
    Eigen::VectorXd beside = problem_->without(fit.contribution);
    for (Index u = 0; u < problem_->size(); ++u)
      if (problem_->component[static_cast<std::size_t>(u)] == r.component) beside[u] -= remainder.values[u];
    const double spared = taken.price - problem_->nuisancePart(beside).price;
    r.evidence = std::min(r.evidence, smoothIn(with, one) + std::max(0.0, spared));
  }
  if (fit.terms.empty()) return;
  posterior.price = wholePriceOf(fit);
  struct Weight {
    double over_unknown = 0.0;
    double over_noise = 0.0;
  };
  const auto over = [&](const std::vector<std::size_t>& taken_out) {
    std::vector<ModelTerm> others;
    for (std::size_t t = 0; t < fit.terms.size(); ++t) {
      if (std::find(taken_out.begin(), taken_out.end(), t) == taken_out.end()) others.push_back(fit.terms[t]);
    }
    const JointFit without = search_->solve(others);
    Eigen::VectorXd more = problem_->without(without.contribution);
    const ResidualProblem::NuisancePart taken_more = problem_->nuisancePart(more);
    more -= taken_more.values;
    const std::array<bool, 6> changed = differing(*problem_, more, left);
    NoiseProfiles profiles = noiseProfiles(*problem_, more, changed);
    for (std::size_t c = 0; c < changed.size(); ++c)
      if (!changed[c]) profiles[c] = with[c];
    const double price = posterior.price - wholePriceOf(without) - (taken_more.price - taken.price);
    return Weight{jointDeviance(profiles, &NoiseProfile::with_unknown) - with_unknown - price,
                  jointDeviance(profiles, &NoiseProfile::noise_alone) - noise_alone - price};
  };
  std::map<Component, std::vector<std::size_t>> sharing;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    std::array<double, 6> power{};
    for (Index u = 0; u < problem_->size(); ++u) {
      power[static_cast<std::size_t>(problem_->component[static_cast<std::size_t>(u)])] +=
          std::pow(fit.contribution[t][u] / problem_->ownSigma(u), 2);
    }
    posterior.slots[t].main = static_cast<Component>(std::max_element(power.begin(), power.end()) - power.begin());
    sharing[posterior.slots[t].main].push_back(t);
  }
  // A cause that nobody thought of is one more as well.
  const double one_more = fit.terms.size() > 1 ? 2.0 * std::log((1.0 - priors_.one_more) / priors_.one_more) : 0.0;
  // Those that share a component are weighed together as well, and every choice among them: one may not stand.
  for (const auto& [component, members] : sharing) {
    for (std::uint32_t choice = 1; choice < (1U << members.size()); ++choice) {
      std::vector<std::size_t> together;
      for (std::size_t k = 0; k < members.size(); ++k)
        if ((choice >> k & 1U) != 0) together.push_back(members[k]);
      const Weight weight = over(together);
      posterior.choice_over_unknown[together] = weight.over_unknown + one_more;
      if (together.size() > 1) continue;
      posterior.slots[together.front()].over_unknown = weight.over_unknown + one_more;
      posterior.slots[together.front()].over_noise = weight.over_noise;
    }
  }
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    if (!posterior.forced[t] && fit.terms[t].effect->id != off_) found.push_back(t);
  }
  if (found.size() == 1) posterior.over_unknown = posterior.slots[found.front()].over_unknown;
  if (found.size() > 1) posterior.over_unknown = over(found).over_unknown;
}

EffectPosterior PosteriorSearch::run(const JobContext& job, const ModelTerm* off,
                                     const std::vector<std::vector<ModelTerm>>& known) {
  EffectPosterior out;
  std::vector<State> visited;
  State start = stateOf({}, 0);
  out.evidence_of_nothing = start.evidence;
  off_ = off == nullptr ? std::string() : off->effect->id;
  if (off != nullptr) {
    visited.push_back(start);
    start = stateOf({*off}, 1);
  }
  // What the user puts in, each at its best.
  for (const std::string& id : options_->accept) {
    std::vector<std::string> skip;
    for (const Effect& effect : search_->catalogue()) {
      if (effect.id != id) skip.push_back(effect.id);
    }
    const std::vector<CandidateFit> found = library_->sweep(given(start.fit), skip, job);
    if (found.empty()) {
      throw InputError(
          fmt::format("{} cannot be accepted: nothing in the log drives it, or these data do not show it.", id));
    }
    start = stateWith(start.fit.terms, found.front(), 1);
  }
  visited.push_back(start);
  State best = start;
  std::vector<State> beam{start};
  const auto most = static_cast<std::size_t>(options_->max_effects) + options_->accept.size();
  while (!beam.empty() && beam.front().fit.terms.size() < most) {
    std::map<std::string, State> next;
    for (const State& state : beam) {
      job.throwIfCancelled();
      for (State& s : extend(state, most_tried, job)) {
        const std::string key = keyOf(s.fit.terms);
        const auto found = next.find(key);
        if (found == next.end() || s.evidence > found->second.evidence) next[key] = std::move(s);
      }
    }
    beam.clear();
    for (auto& [key, state] : next) beam.push_back(std::move(state));
    std::stable_sort(beam.begin(), beam.end(), [](const State& a, const State& b) { return a.evidence > b.evidence; });
    if (beam.size() > 2 * beam_width) beam.resize(2 * beam_width);
    for (const State& s : beam) visited.push_back(s);
    if (beam.size() > beam_width) beam.resize(beam_width);
    if (beam.empty()) break;
    const bool better = beam.front().evidence > best.evidence;
    if (better) best = beam.front();
    // Two that only together explain something: one step more is looked at, no further.
    if (beam.front().evidence < best.evidence - 12.0) break;
  }
  for (const std::vector<ModelTerm>& terms : known) {
    visited.push_back(stateOf(terms, 1));
    if (visited.back().evidence > best.evidence) best = visited.back();
  }
  if (best.fit.terms.size() > options_->accept.size()) best = exchanged(best, job, visited);
  const auto refined = [&](State state) {
    State again = stateOf(state.fit.terms, 2);
    visited.push_back(again);
    return withFewerLags(again.evidence > state.evidence ? std::move(again) : std::move(state), 2);
  };
  best = refined(std::move(best));
  // In the order of what each brings, the user's first. One that brings nothing any more leaves, and one in whose place
  // another turns out to be better, both with all lags refitted, makes room for it; so does one that holds a simpler
  // effect which the data do not tell from it.
  constexpr int most_replaced = 4;  // at one number of effects
  int replaced = 0;
  std::vector<SlotEvidence> slots;
  for (;;) {
    slots.clear();
    std::size_t idle = best.fit.terms.size();
    const Alternative* better = nullptr;
    double most_lead = 0.0;
    slots.reserve(best.fit.terms.size());
    for (std::size_t t = 0; t < best.fit.terms.size(); ++t) {
      slots.push_back(slotOf(best, t, job, visited));
      const auto& ids = options_->accept;
      const bool forced = std::find(ids.begin(), ids.end(), best.fit.terms[t].effect->id) != ids.end();
      if (forced) continue;
      double unrelated = -1e300;
      for (const Alternative& a : slots[t].others) {
        if (!a.rejected && !a.contained && !a.container) unrelated = std::max(unrelated, a.evidence);
      }
      for (const Alternative& a : slots[t].others) {
        if (a.rejected) continue;
        double lead = a.evidence - best.evidence - 1e-3;
        if (a.contained && a.evidence > unrelated) {
          // An effect of the user's pays less for being chosen than one of the catalogue: that is no evidence for it.
          lead += priors_.wider_lead + std::max(0.0, priceOf(a.joint) - priceOf(best.fit));
        }
        if (a.container) lead -= priors_.wider_lead;
        if (lead < most_lead) continue;
        most_lead = lead;
        better = &a;
      }
      if (slots[t].delta_evidence > 0.0) continue;
      if (idle == best.fit.terms.size() || slots[t].delta_evidence < slots[idle].delta_evidence) idle = t;
    }
    if (better != nullptr && replaced < most_replaced) {
      ++replaced;
      best = State{better->joint, better->evidence};
      continue;
    }
    if (idle == best.fit.terms.size()) break;
    std::vector<ModelTerm> fewer = best.fit.terms;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(idle));
    best = refined(stateOf(fewer, 1));
    replaced = 0;
  }
  // What the user rejected is weighed beside the best without it, so that the answer says what it is given up for.
  for (const std::string& id : options_->reject) {
    if (job.cancelled()) break;
    std::vector<std::string> skip;
    for (const Effect& effect : search_->catalogue()) {
      if (effect.id != id) skip.push_back(effect.id);
    }
    const std::vector<CandidateFit> found = library_->sweep(given(best.fit), skip, job);
    if (found.empty()) continue;
    visited.push_back(stateWith(best.fit.terms, found.front(), 1));
  }
  std::vector<std::size_t> order(slots.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto accepted = [&](std::size_t i) {
    const auto& ids = options_->accept;
    return std::find(ids.begin(), ids.end(), best.fit.terms[i].effect->id) != ids.end();
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (accepted(a) != accepted(b)) return accepted(a);
    return slots[a].delta_chi2 > slots[b].delta_chi2;
  });
  std::vector<ModelTerm> terms;
  for (const std::size_t i : order) {
    terms.push_back(best.fit.terms[i]);
    out.slots.push_back(std::move(slots[i]));
    out.forced.push_back(accepted(i));
  }
  out.fit = search_->solve(terms);
  out.evidence = best.evidence;
  // Probability of every effect over all sets visited.
  std::map<std::string, std::pair<double, std::set<std::string>>> sets;
  for (const State& s : visited) {
    const std::vector<std::string> ids = idsOf(s.fit.terms);
    const auto [at, fresh] =
        sets.try_emplace(keyOf(s.fit.terms), s.evidence, std::set<std::string>(ids.begin(), ids.end()));
    if (!fresh) at->second.first = std::max(at->second.first, s.evidence);
  }
  // What the user put in or took out is so in all of them.
  const auto asTheUserWants = [&](const State& s) {
    const std::vector<std::string> ids = idsOf(s.fit.terms);
    const auto has = [&](const std::string& id) { return std::find(ids.begin(), ids.end(), id) != ids.end(); };
    return std::all_of(options_->accept.begin(), options_->accept.end(), has) &&
           std::none_of(options_->reject.begin(), options_->reject.end(), has) && (off_.empty() || has(off_));
  };
  std::map<std::string, const State*> near;
  for (const State& s : visited) {
    if (s.evidence < best.evidence - close_window || keyOf(s.fit.terms) == keyOf(best.fit.terms)) continue;
    if (!asTheUserWants(s)) continue;
    const State*& at = near[keyOf(s.fit.terms)];
    if (at == nullptr || s.evidence > at->evidence) at = &s;
  }
  std::vector<const State*> nearest;
  nearest.reserve(near.size());
  for (const auto& [key, state] : near) nearest.push_back(state);
  std::stable_sort(nearest.begin(), nearest.end(),
                   [](const State* a, const State* b) { return a->evidence > b->evidence; });
  if (nearest.size() > most_close) nearest.resize(most_close);
  for (const State* state : nearest) out.close.push_back(state->fit);
  // Effects that nobody had to follow are weighed by their fit on the grid, alone beside what the user put in.
  for (const CandidateFit& c : library_->sweep(given(start.fit), idsOf(start.fit.terms), job)) {
    std::vector<ModelTerm> together = start.fit.terms;
    together.push_back(c.term);
    const std::vector<std::string> ids = idsOf(together);
    sets.try_emplace(keyOf(together), start.evidence + c.evidence, std::set<std::string>(ids.begin(), ids.end()));
  }
  double highest = -1e300;
  for (const auto& [key, set] : sets) highest = std::max(highest, set.first);
  double total = 0.0;
  std::map<std::string, double> probability;
  for (const auto& [key, set] : sets) {
    const double weight = std::exp(0.5 * (set.first - highest));
    total += weight;
    for (const std::string& id : set.second) probability[id] += weight;
  }
  for (const auto& [id, weight] : probability) out.candidates.emplace_back(id, weight / total);
  std::stable_sort(out.candidates.begin(), out.candidates.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return out;
}

}  // namespace spindrift
