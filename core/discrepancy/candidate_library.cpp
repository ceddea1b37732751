// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/candidate_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

namespace spindrift {
namespace {

using Eigen::Index;

constexpr std::size_t most_columns = 16;
/// The same of effects of the catalogue.
constexpr std::size_t most_built_in_columns = 8;
/// Directions of which nuisances leave less than this part of the power are not seen.
constexpr double least_seen = 1e-5;
/// Of ln(number of ways): 2 if all of them were independent, as onsets are. Neighbours on the grid of lags are nearly
/// the same.
constexpr double way_price = 1.0;
constexpr double onset_way_price = 2.0;

/// Gain in chi-squared of columns from their Gram matrix and products with the residual, by Cholesky; columns that
/// depend on those before them are left out.
struct GramGain {
  double delta = 0.0;
  int rank = 0;
  std::array<double, most_columns> gain{};
};

GramGain gramGain(const Eigen::MatrixXd& gram, const std::array<double, most_columns>& b,
                  const std::array<double, most_columns>& whole) {
  GramGain out;
  std::array<std::array<double, most_columns>, most_columns> l{};
  std::array<double, most_columns> z{};
  std::array<std::size_t, most_columns> kept{};
  const auto count = static_cast<std::size_t>(gram.rows());
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, most_columns> row{};
    double pivot = gram(static_cast<Index>(i), static_cast<Index>(i));
    const auto rank = static_cast<std::size_t>(out.rank);
    for (std::size_t j = 0; j < rank; ++j) {
      double value = gram(static_cast<Index>(i), static_cast<Index>(kept[j]));
      for (std::size_t k = 0; k < j; ++k) value -= row[k] * l[j][k];
      value /= l[j][j];
      row[j] = value;
      pivot -= value * value;
    }
    if (!(pivot > least_seen * whole[i]) || !(pivot > 1e-18)) continue;
    l[rank] = row;
    l[rank][rank] = std::sqrt(pivot);
    double value = b[i];
    for (std::size_t k = 0; k < rank; ++k) value -= l[rank][k] * z[k];
    z[rank] = value / l[rank][rank];
    out.delta += z[rank] * z[rank];
    kept[rank] = i;
    ++out.rank;
  }
  for (int r = out.rank - 1; r >= 0; --r) {
    const auto at = static_cast<std::size_t>(r);
    double value = z[at];
    for (auto k = at + 1; k < static_cast<std::size_t>(out.rank); ++k) value -= l[k][at] * out.gain[kept[k]];
    out.gain[kept[at]] = value / l[at][at];
  }
  return out;
}

}  // namespace

CandidateLibrary::CandidateLibrary(const EffectSearch& search, const ResidualProblem& problem, const JobContext& job)
    : search_(&search), problem_(&problem) {
  const std::vector<Effect>& catalogue = search.catalogue();
  for (const Effect& effect : catalogue) search.prepare(effect);
  entries_.resize(catalogue.size());
  parallelFor(catalogue.size(), job, [&](std::size_t e) { entries_[e] = entryOf(catalogue[e]); });
}

CandidateLibrary::Entry CandidateLibrary::entryOf(const Effect& effect) const {
  Entry entry;
  entry.effect = &effect;
  const Eigen::MatrixXd& s = search_->shape(effect);
  const Index k = s.cols();
  Index rows = 0;
  for (std::size_t d = 0; d < problem_->domains().size(); ++d) {
    const auto& domain = problem_->domains()[d];
    if (s.middleRows(domain.from, domain.count).isZero(0.0)) continue;
    entry.domains.push_back(d);
    rows += domain.count;
  }
  if (rows == 0 || effect.variants.empty()) return entry;

  // Distinct responses, and the ways that combine them.
  std::map<std::tuple<std::string, int, double, double>, Index> response_index;
  std::vector<Eigen::VectorXd> responses;
  const auto responseOf = [&](const EffectInput& input, double a, double b) {
    const auto key = std::make_tuple(input.driver, static_cast<int>(input.dynamics), a, b);
    const auto found = response_index.find(key);
    if (found != response_index.end()) return found->second;
    const auto index = static_cast<Index>(responses.size());
    responses.push_back(search_->gridResponse(input, a, b));
    response_index.emplace(key, index);
    return index;
  };
  std::map<std::string, std::size_t> kinds;
  const auto addWay = [&](const EffectVariant& variant, std::vector<double> parameters,
                          const std::vector<Index>& which) {
    if (which.size() * static_cast<std::size_t>(k) > (effect.own ? most_columns : most_built_in_columns)) return;
    std::string kind;  // one power of a speed stands for all
    for (const EffectInput& input : variant.inputs)
      kind += fmt::format("{}/{} ", input.driver.substr(0, input.driver.find('^')), static_cast<int>(input.dynamics));
    Way way;
    way.kind = kinds.try_emplace(kind, kinds.size()).first->second;
    way.variant = variant;
    way.parameters = std::move(parameters);
    for (const Index r : which) {
      for (Index c = 0; c < k; ++c) way.columns.push_back(r * k + c);
    }
    entry.ways.push_back(std::move(way));
  };
  const std::vector<double> lags = search_->lagsOf(effect);
  const auto linear = [&](const std::string& name) {
    const Driver* driver = search_->drivers().find(name);
    return driver != nullptr && driver->linear;
  };
  bool pulses = false;
  for (const EffectVariant& variant : effect.variants) {
    const EffectInput& first = variant.inputs[0];
    switch (first.dynamics) {
      case Dynamics::None:
        addWay(variant, {}, {responseOf(first, 0.0, 0.0)});
        break;
      case Dynamics::Step:
        for (const double onset : search_->onsets()) addWay(variant, {onset}, {responseOf(first, onset, 0.0)});
        break;
      case Dynamics::Pulse:
        pulses = true;
        for (const double tau : search_->pulseLagsOf(effect)) {
          const std::vector<double>& onsets = search_->onsets();
          for (std::size_t i = 0; i < onsets.size(); ++i) {
            const Index from = responseOf(first, onsets[i], tau);
            for (std::size_t j = i + 1; j <= onsets.size(); ++j) {
              const bool ends = j < onsets.size();
              addWay(variant, {onsets[i], ends ? onsets[j] - onsets[i] : search_->endlessLength(), tau}, {from});
              if (ends) entry.ways.back().minus = static_cast<int>(responseOf(first, onsets[j], tau));
            }
          }
        }
        break;
      case Dynamics::AsymmetricLag:
        for (std::size_t a = 0; a < lags.size(); a += 2) {
          for (std::size_t b = 0; b < lags.size(); b += 2) {
            if (a == b || !EffectSearch::possibleLags(lags[a], lags[b])) continue;
            std::vector<Index> which;
            for (const EffectInput& input : variant.inputs) which.push_back(responseOf(input, lags[a], lags[b]));
            addWay(variant, {lags[a], lags[b]}, which);
          }
        }
        break;
      case Dynamics::Start:
        break;
      case Dynamics::Lag: {
        if (variant.inputs.size() == 1 || variant.shared_lag) {
          const bool at_once = std::all_of(variant.inputs.begin(), variant.inputs.end(),
                                           [&](const EffectInput& i) { return linear(i.driver); });
          for (std::size_t l = at_once ? 0 : 1; l <= lags.size(); ++l) {
            const double tau = l == 0 ? 0.0 : lags[l - 1];
            std::vector<Index> which;
            for (const EffectInput& input : variant.inputs) which.push_back(responseOf(input, tau, tau));
            addWay(variant, {tau}, which);
            // The same on a machine that was warm when the log began.
            if (l == 0 || !effect.of_machine) continue;
            EffectVariant warm = variant;
            warm.inputs.push_back({"", Dynamics::Start});
            warm.shared_lag = true;
            which.push_back(responseOf(warm.inputs.back(), tau, tau));
            addWay(warm, {tau}, which);
          }
          // The same through two lags: bearings and housing, screw and nut.
          if (variant.inputs.size() == 1 && effect.two_lags && k == 1) {
            const EffectVariant twice{{first, first}, false};
            for (std::size_t a = at_once ? 0 : 1; a + 2 <= lags.size(); ++a) {
              for (std::size_t b = a + 2; b <= lags.size(); ++b) {
                const double tau_a = a == 0 ? 0.0 : lags[a - 1];
                addWay(twice, {tau_a, lags[b - 1]},
                       {responseOf(first, tau_a, tau_a), responseOf(first, lags[b - 1], lags[b - 1])});
              }
            }
          }
        } else if (variant.inputs.size() == 2) {
          for (std::size_t a = linear(variant.inputs[0].driver) ? 0 : 1; a <= lags.size(); ++a) {
            for (std::size_t b = linear(variant.inputs[1].driver) ? 0 : 1; b <= lags.size(); ++b) {
              const double tau_a = a == 0 ? 0.0 : lags[a - 1];
              const double tau_b = b == 0 ? 0.0 : lags[b - 1];
              addWay(variant, {tau_a, tau_b},
                     {responseOf(variant.inputs[0], tau_a, tau_a), responseOf(variant.inputs[1], tau_b, tau_b)});
            }
          }
        }
        break;
      }
    }
  }

  const auto columns = static_cast<Index>(responses.size()) * k;
  entry.columns.resize(rows, columns);
  Eigen::MatrixXd dots = Eigen::MatrixXd::Zero(problem_->nuisanceBasis().cols(), columns);
  entry.whole = Eigen::VectorXd::Zero(columns);
  Index at = 0;
  for (const std::size_t d : entry.domains) {
    const auto& domain = problem_->domains()[d];
    Eigen::MatrixXd raw(domain.count, columns);
    for (std::size_t r = 0; r < responses.size(); ++r) {
      raw.middleCols(static_cast<Index>(r) * k, k).noalias() =
          responses[r].segment(domain.from, domain.count).asDiagonal() * s.middleRows(domain.from, domain.count);
    }
    entry.columns.middleRows(at, domain.count) = problem_->withoutConstants(d, raw);
    // The power before constants were removed is what a direction is measured against.
    for (Index c = 0; c < columns; ++c) {
      double power = 0.0;
      for (Index i = 0; i < domain.count; ++i) {
        const double z = raw(i, c) / problem_->ownSigma(domain.from + i);
        power += z * z;
      }
      entry.whole[c] += power;
    }
    const auto& nuisances = problem_->nuisanceParts()[d];
    dots(nuisances.columns, Eigen::all) += nuisances.rows.transpose() * entry.columns.middleRows(at, domain.count);
    at += domain.count;
  }
  if (pulses) {
    entry.steps_gram = entry.columns.transpose() * entry.columns - dots.transpose() * dots;
  }
  for (Way& way : entry.ways) {
    const auto m = static_cast<Index>(way.columns.size());
    if (way.minus >= 0 || pulses) continue;
    way.gram.resize(m, m);
    for (Index i = 0; i < m; ++i) {
      const Index a = way.columns[static_cast<std::size_t>(i)];
      for (Index j = 0; j <= i; ++j) {
        const Index b = way.columns[static_cast<std::size_t>(j)];
        way.gram(i, j) = way.gram(j, i) = entry.columns.col(a).dot(entry.columns.col(b)) - dots.col(a).dot(dots.col(b));
      }
    }
  }
  return entry;
}

bool throughTwoLags(const EffectVariant& variant) {
  return variant.inputs.size() == 2 && !variant.shared_lag && variant.inputs[0].dynamics == Dynamics::Lag &&
         variant.inputs[1].dynamics == Dynamics::Lag && variant.inputs[0].driver == variant.inputs[1].driver;
}

double CandidateLibrary::choicePrice(const Effect& effect) const {
  for (const Entry& entry : entries_) {
    if (entry.effect != &effect || entry.ways.empty()) continue;
    const Dynamics dynamics = entry.ways.front().variant.inputs[0].dynamics;
    const bool onset = dynamics == Dynamics::Step || dynamics == Dynamics::Pulse;
    return (onset ? onset_way_price : way_price) * std::log(static_cast<double>(entry.ways.size())) +
           onset_way_price * std::log(static_cast<double>(effect.choices));
  }
  return 0.0;
}

std::optional<CandidateFit> CandidateLibrary::bestOf(const Entry& entry, const Given& given,
                                                     const std::vector<ResidualProblem::BasisPart>& parts) const {
  if (entry.ways.empty()) return std::nullopt;
  const Index columns = entry.columns.cols();
  // Of the basis only what is not zero where the effect acts.
  std::vector<Index> place(static_cast<std::size_t>(given.basis.cols()), -1);
  Index met = 0;
  for (const std::size_t d : entry.domains) {
    for (const Index q : parts[d].columns) {
      if (place[static_cast<std::size_t>(q)] < 0) place[static_cast<std::size_t>(q)] = met++;
    }
  }
  Eigen::MatrixXd dots = Eigen::MatrixXd::Zero(met, columns);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(columns);
  Index at = 0;
  for (const std::size_t d : entry.domains) {
    const auto& domain = problem_->domains()[d];
    const auto part = entry.columns.middleRows(at, domain.count);
    std::vector<Index> rows;
    for (const Index q : parts[d].columns) rows.push_back(place[static_cast<std::size_t>(q)]);
    dots(rows, Eigen::all) += parts[d].rows.transpose() * part;
    b.noalias() += part.transpose() * given.residual.segment(domain.from, domain.count);
    at += domain.count;
  }
  const double log_n = search_->logN();
  const double price = choicePrice(*entry.effect);
  struct Weighed {
    const Way* way;
    GramGain gain;
    double evidence;
  };
  std::vector<Weighed> weighed;
  weighed.reserve(entry.ways.size());
  Eigen::MatrixXd gram;
  std::array<double, most_columns> product{};
  std::array<double, most_columns> whole{};
  for (const Way& way : entry.ways) {
    const auto m = static_cast<Index>(way.columns.size());
    gram.resize(m, m);
    for (Index i = 0; i < m; ++i) {
      const Index a = way.columns[static_cast<std::size_t>(i)];
      product[static_cast<std::size_t>(i)] = b[a];
      whole[static_cast<std::size_t>(i)] = entry.whole[a];
      const Index minus_a = way.minus >= 0 ? static_cast<Index>(way.minus) * m + i : -1;
      if (minus_a >= 0) product[static_cast<std::size_t>(i)] -= b[minus_a];
      for (Index j = 0; j <= i; ++j) {
        const Index c = way.columns[static_cast<std::size_t>(j)];
        double value = 0.0;
        if (entry.steps_gram.size() > 0) {
          const auto product_of = [&](Index p, Index q) {
            return entry.steps_gram(p, q) - dots.col(p).dot(dots.col(q));
          };
          value = product_of(a, c);
          if (way.minus >= 0) {
            const Index minus_c = static_cast<Index>(way.minus) * m + j;
            value += product_of(minus_a, minus_c) - product_of(minus_a, c) - product_of(a, minus_c);
          }
        } else {
          value = way.gram(i, j) - dots.col(a).dot(dots.col(c));
        }
        gram(i, j) = gram(j, i) = value;
      }
    }
    const GramGain gain = gramGain(gram, product, whole);
    if (gain.rank == 0 || !std::isfinite(gain.delta)) continue;
    const double evidence = gain.delta - gain.rank * log_n - price - (warmStart(way.variant) ? warm_price : 0.0);
    weighed.push_back({&way, gain, evidence});
  }
  // The best that can be, and the best of each other kind but through two lags.
  constexpr std::size_t most_other_ways = 4;
  const auto worse = [](const Weighed& x, const Weighed& y) { return x.evidence < y.evidence; };
  std::make_heap(weighed.begin(), weighed.end(), worse);
  std::optional<CandidateFit> best;
  std::vector<std::size_t> kinds;
  while (!weighed.empty() && kinds.size() <= most_other_ways) {
    std::pop_heap(weighed.begin(), weighed.end(), worse);
    const Weighed w = weighed.back();
    weighed.pop_back();
    if (std::find(kinds.begin(), kinds.end(), w.way->kind) != kinds.end()) continue;
    if (best && throughTwoLags(w.way->variant)) continue;
    ModelTerm term{entry.effect, w.way->variant, w.way->parameters};
    const auto m = static_cast<Index>(w.way->columns.size());
    if (!search_->admissible(term, Eigen::Map<const Eigen::VectorXd>(w.gain.gain.data(), m))) continue;
    kinds.push_back(w.way->kind);
    if (best) {
      best->other_ways.push_back(std::move(term));
    } else {
      best = CandidateFit{std::move(term), w.gain.delta, w.gain.rank, w.evidence, {}};
    }
  }
  return best;
}

std::vector<CandidateFit> CandidateLibrary::sweep(const Given& given, const std::vector<std::string>& skip,
                                                  const JobContext& job) const {
  const std::vector<ResidualProblem::BasisPart> parts = problem_->partsOf(given.basis);
  std::vector<std::optional<CandidateFit>> found(entries_.size());
  parallelFor(entries_.size(), job, [&](std::size_t e) {
    const std::string& id = entries_[e].effect->id;
    if (std::find(skip.begin(), skip.end(), id) == skip.end()) found[e] = bestOf(entries_[e], given, parts);
  });
  std::vector<CandidateFit> out;
  for (std::optional<CandidateFit>& fit : found) {
    if (fit) out.push_back(std::move(*fit));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const CandidateFit& a, const CandidateFit& b) { return a.evidence > b.evidence; });
  return out;
}

}  // namespace spindrift
