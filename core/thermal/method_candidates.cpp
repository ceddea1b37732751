// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/method_candidates.h"

#include <Eigen/Dense>
#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace spindrift::choice {

using Eigen::Index;
using namespace response;

namespace {

constexpr std::size_t all_sets_up_to = 4;  ///< inputs: every set of them is tried

}  // namespace

PlainCandidates::PlainCandidates(const Dictionary& d, const Evidence& evidence, const std::vector<std::string>& names,
                                 const MethodChoiceOptions& options)
    : d_(d), evidence_(evidence), names_(names), options_(options) {
  std::set<double> powers;
  for (const ThermalInput& input : d.inputs)
    if (isDriven(input.kind)) powers.insert(input.power);
  powers_.assign(powers.begin(), powers.end());
  if (powers_.empty()) powers_.push_back(1.0);
}

void PlainCandidates::search(const JobContext& job) {
  const auto runs = std::ssize(evidence_.runs());
  for (std::ptrdiff_t of = -1; of < runs; ++of) {
    searchFor(of, job);
    job.report(static_cast<double>(of + 2) / static_cast<double>(runs + 1), "choosing inputs");
  }
}

void PlainCandidates::searchFor(std::ptrdiff_t of, const JobContext& job) {
  const std::size_t count = names_.size();
  if (count <= all_sets_up_to) {
    for (std::size_t mask = 1; mask < (std::size_t{1} << count); ++mask) {
      Set set;
      for (std::size_t i = 0; i < count; ++i)
        if ((mask >> i) & 1U) set.push_back(i);
      visit(set, of);
    }
    return;
  }
  if (options_.whole_sets) takeWhole(of);
  Set chosen;
  double score = std::numeric_limits<double>::infinity();
  for (int step = 0; step < options_.maximum_inputs && chosen.size() < count; ++step) {
    job.throwIfCancelled();
    Set best_set;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
      if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
      Set trial = chosen;
      trial.push_back(i);
      std::sort(trial.begin(), trial.end());
      const double here = visit(trial, of);
      if (here < best) {
        best = here;
        best_set = std::move(trial);
      }
    }
    if (best_set.empty() || best > score + options_.input_penalty) break;
    score = std::min(score, best);
    chosen = std::move(best_set);
  }
}

void PlainCandidates::takeWhole(std::ptrdiff_t of) {
  const auto place = static_cast<std::size_t>(of + 1);
  if (whole_.empty()) {
    Set every;
    Set still_ones;  // no speed or feed
    for (std::size_t i = 0; i < names_.size(); ++i) {
      every.push_back(i);
      const bool driven = std::any_of(d_.inputs.begin(), d_.inputs.end(), [&](const ThermalInput& in) {
        return in.name == names_[i] && isDriven(in.kind);
      });
      if (!driven) still_ones.push_back(i);
    }
    if (!still_ones.empty()) addWhole(still_ones, powers_.front());
    if (every != still_ones)
      for (const double power : powers_) addWhole(every, power);
  }
  for (const std::size_t k : whole_) all[k].found[place] = 1;
}

void PlainCandidates::addWhole(const Set& set, double power) {
  Columns still;
  Columns dense;
  for (const std::size_t i : set) {
    for (const Index k : columnsOf(i, power, options_.taus_s)) {
      dense.push_back(k);
      if (d_.features[static_cast<std::size_t>(k)].tau_s == 0.0) still.push_back(k);
    }
  }
  const auto take = [&](Method method, const Columns& columns, double shrinkage) {
    if (columns.empty()) return;
    Candidate c = make(method, columns, set, shrinkage);
    c.picked = 1;
    whole_.push_back(all.size());
    keep(std::move(c));
  };
  take(Method::Line, still, 1e-6);
  for (const double shrinkage : options_.shrinkages) {
    take(Method::Line, still, shrinkage);
    take(Method::Ridge, dense, shrinkage);
  }
}

double PlainCandidates::visit(const Set& set, std::ptrdiff_t of) {
  const auto place = static_cast<std::size_t>(of + 1);
  const bool fresh = !visited_.contains(set);
  std::vector<std::size_t>& known = visited_[set];
  const bool driven = std::any_of(set.begin(), set.end(), [&](std::size_t i) {
    return std::any_of(d_.inputs.begin(), d_.inputs.end(),
                       [&](const ThermalInput& in) { return in.name == names_[i] && isDriven(in.kind); });
  });
  const auto take = [&](Candidate c) {
    known.push_back(all.size());
    keep(std::move(c));
  };
  double best = std::numeric_limits<double>::infinity();
  for (const double power : powers_) {
    if (!driven && power != powers_.front()) continue;
    std::vector<Columns> per_input;
    Columns still;
    Columns dense;
    for (const std::size_t i : set) {
      per_input.push_back(columnsOf(i, power, options_.few_lag_taus_s));
      for (const Index k : columnsOf(i, power, options_.taus_s)) {
        dense.push_back(k);
        if (d_.features[static_cast<std::size_t>(k)].tau_s == 0.0) still.push_back(k);
      }
    }
    if (std::any_of(per_input.begin(), per_input.end(), [](const Columns& c) { return c.empty(); })) continue;
    if (fresh) {
      if (still.size() == set.size()) take(make(Method::Line, still, set, 1e-6));
      for (const double shrinkage : options_.shrinkages) take(make(Method::Ridge, dense, set, shrinkage));
    }
    if (set.size() > all_sets_up_to) continue;
    std::vector<const Candidate*> fitted = {&fewLags(per_input, set, of)};
    if (names_.size() <= all_sets_up_to) fitted.push_back(&sharedLags(set, power, of));
    for (const Candidate* c : fitted) {
      auto same = std::find_if(known.begin(), known.end(), [&](std::size_t k) {
        return all[k].method == c->method && all[k].columns == c->columns;
      });
      if (same == known.end()) {
        take(*c);
        same = std::prev(known.end());
      }
      Candidate& kept = all[*same];
      kept.found[place] = 1;
      best = std::min(best, scoreOf(kept, evidence_.runs(), of));
    }
  }
  for (const std::size_t k : known) {
    if (all[k].time_constants > 0) continue;  // chosen by other judges unless marked above
    all[k].found[place] = 1;
    best = std::min(best, scoreOf(all[k], evidence_.runs(), of));
  }
  return best;
}

PlainCandidates::Columns PlainCandidates::columnsOf(std::size_t input, double power,
                                                    const std::vector<double>& taus_s) const {
  Columns columns;
  for (std::size_t k = 0; k < d_.features.size(); ++k) {
    const Feature& f = d_.features[k];
    const ThermalInput& in = d_.inputs[static_cast<std::size_t>(f.input)];
    if (in.name != names_[input] || (isDriven(in.kind) && in.power != power)) continue;
    if (std::find(taus_s.begin(), taus_s.end(), f.tau_s) == taus_s.end()) continue;
    columns.push_back(static_cast<Index>(k));
  }
  return columns;
}

Candidate PlainCandidates::make(Method method, Columns columns, const Set& set, double shrinkage,
                                std::size_t time_constants) const {
  Candidate c;
  c.method = method;
  c.time_constants = time_constants;
  c.precision.resize(static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    c.precision[static_cast<Index>(k)] = shrinkage * evidence_.sumOfSquares(columns[k]);
  c.columns = std::move(columns);
  c.inputs = set;
  c.picked = set.size();
  evidence_.judge(c);
  return c;
}

void PlainCandidates::keep(Candidate c) {
  c.found.assign(evidence_.runs().size() + 1, 0);
  all.push_back(std::move(c));
}

const Candidate& PlainCandidates::lagsOf(Method method, const Columns& columns, const Set& set,
                                         std::size_t time_constants) {
  const std::pair key(method, columns);
  auto known = tried_.find(key);
  if (known == tried_.end()) known = tried_.emplace(key, make(method, columns, set, 1e-6, time_constants)).first;
  return known->second;
}

const Candidate& PlainCandidates::fewLags(const std::vector<Columns>& per_input, const Set& set, std::ptrdiff_t of) {
  const auto tried = [&](const Columns& columns) -> const Candidate& {
    return lagsOf(Method::FewLags, columns, set, columns.size() + 1);  // the offset has the price of a second one too
  };
  Columns best;
  for (const Columns& columns : per_input)
    best.push_back(columns[std::min<std::size_t>(3, columns.size() - 1)]);  // some minutes
  double score = scoreOf(tried(best), evidence_.runs(), of);
  for (int round = 0; round < 4; ++round) {
    bool changed = false;
    for (std::size_t i = 0; i < per_input.size(); ++i) {
      for (const Index column : per_input[i]) {
        if (best[i] == column) continue;
        Columns trial = best;
        trial[i] = column;
        const double here = scoreOf(tried(trial), evidence_.runs(), of);
        if (here >= score) continue;
        score = here;
        best = std::move(trial);
        changed = true;
      }
    }
    if (!changed) break;
  }
  return tried(best);
}

const Candidate& PlainCandidates::sharedLags(const Set& set, double power, std::ptrdiff_t of) {
  const auto tried = [&](const std::vector<double>& taus_s) -> const Candidate& {
    Columns columns;
    for (const std::size_t i : set) {
      const Columns own = columnsOf(i, power, taus_s);
      columns.insert(columns.end(), own.begin(), own.end());
    }
    return lagsOf(Method::SharedLags, columns, set, taus_s.size());
  };
  double score = std::numeric_limits<double>::infinity();
  std::vector<double> best;
  const auto consider = [&](std::vector<double> taus_s) {
    const double here = scoreOf(tried(taus_s), evidence_.runs(), of);
    if (here >= score) return false;
    score = here;
    best = std::move(taus_s);
    return true;
  };
  for (const double tau_s : options_.few_lag_taus_s) consider({tau_s});
  const std::vector<double> first = best;
  // The second one: any beside the best single one, then each in turn until none changes.
  for (const double tau_s : options_.few_lag_taus_s)
    if (tau_s != first.front()) consider({first.front(), tau_s});
  for (bool changed = best.size() > 1; changed;) {
    changed = false;
    for (std::size_t k = 0; k < best.size(); ++k) {
      for (const double tau_s : options_.few_lag_taus_s) {
        if (std::find(best.begin(), best.end(), tau_s) != best.end()) continue;
        std::vector<double> trial = best;
        trial[k] = tau_s;
        changed = consider(std::move(trial)) || changed;
      }
    }
  }
  return tried(best);
}

std::vector<Candidate> responseMembers(const Dictionary& d, const Evidence& evidence,
                                       const MethodChoiceOptions& options) {
  const bool driven =
      std::any_of(d.inputs.begin(), d.inputs.end(), [](const ThermalInput& i) { return isDriven(i.kind); });
  std::vector<Candidate> members;
  for (const double power : driven ? options.response.speed_powers : std::vector<double>{1.0}) {
    Candidate c;
    c.method = Method::Response;
    c.columns = responseColumns(d, power, options.response.taus_s);
    for (const double strength : options.response.strengths) {
      for (const double slow : options.response.slow_preferences) {
        c.precision = priorPrecision(d, c.columns, strength, slow, options.response);
        evidence.judge(c);
        c.found.assign(evidence.runs().size() + 1, 1);
        members.push_back(c);
      }
    }
  }
  return members;
}

}  // namespace spindrift::choice
