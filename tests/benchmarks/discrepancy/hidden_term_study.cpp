// SPDX-License-Identifier: GPL-3.0-or-later
// How often a term of a catalogue of the user's is found that the simulation lacks, on measurements of real devices.
//
//   hidden_term_study CAMPAIGN... [--term ID] [--outside] [--part P]
//
// Of every campaign (absolute values, effects.json) the terms that forward stepwise BIC finds in the raw values,
// outliers clipped, are the model of the device. Each of them in turn is left out of the simulation, everything else in
// the measurements stays as it is; the search and forward stepwise BIC (plain least squares, without clipping) then
// look for it with the same catalogue. Right: named, or one of a set of at most three. Wrong: another name without it.
// --outside takes the hidden term out of the catalogue as well: then every name is wrong. --part P: a random part of
// the points, 0 < P <= 1, so that terms become weak.
#include <Eigen/QR>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <set>

#include "core/base/job_context.h"
#include "core/base/random.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/own_effects.h"

namespace spindrift::study {
namespace {

using Eigen::Index;

/// One effect at fixed non-linear parameters.
struct Term {
  const Effect* effect = nullptr;
  EffectVariant variant;
  std::vector<double> parameters;
};

/// A device: its observations with a catalogue.
class Device {
 public:
  Device(const std::filesystem::path& folder, double part, std::uint64_t seed) : campaign_(Campaign::read(folder)) {
    campaign_.observations.edit().absolute = true;
    Random random(seed);
    std::set<std::string> left_out;
    for (const std::string& point : campaign_.observations->points()) {
      if (random.uniform() >= part) left_out.insert(point);
    }
    std::erase_if(campaign_.observations.edit().rows, [&](const Observation& o) { return left_out.contains(o.point); });
    own_ = OwnEffects::read(campaign_.path(campaign_.effects.empty() ? "effects.json" : campaign_.effects.string()));
    const OperatingLog* log = campaign_.log ? &*campaign_.log : nullptr;
    drivers_ = DriverTable(campaign_.machine, log);
    catalogue_ = own_->bind(drivers_, log, campaign_.machine.reference_temperature_degC, true);
    std::vector<std::string> warnings;
    own_->check(catalogue_, rows(), warnings);
    std::set<double> times;
    for (const Observation& o : rows()) times.insert(o.time_s);
    times_.assign(times.begin(), times.end());
  }

  [[nodiscard]] const std::vector<Observation>& rows() const { return campaign_.observations->rows; }
  [[nodiscard]] const std::vector<Effect>& catalogue() const { return catalogue_; }

  /// Columns of a term over all rows.
  [[nodiscard]] Eigen::MatrixXd columns(const Term& term) const {
    const Eigen::MatrixXd q = inputResponses(drivers_, term.variant, term.parameters, times_);
    const auto k = static_cast<Index>(term.effect->shape.size());
    Eigen::MatrixXd out(static_cast<Index>(rows().size()), k * q.cols());
    for (std::size_t r = 0; r < rows().size(); ++r) {
      const auto at = std::lower_bound(times_.begin(), times_.end(), rows()[r].time_s) - times_.begin();
      const DeviationQuery query = DeviationQuery::of(rows()[r]);
      for (Index c = 0; c < k; ++c) {
        const double s = term.effect->shape[static_cast<std::size_t>(c)].value(query, rows()[r].component);
        for (Index i = 0; i < q.cols(); ++i) out(static_cast<Index>(r), i * k + c) = s * q(at, i);
      }
    }
    return out;
  }

  /// Every way of an effect that plain least squares tries: without lag, and steps at 24 times.
  [[nodiscard]] std::vector<Term> waysOf(const Effect& effect) const {
    std::vector<Term> out;
    for (const EffectVariant& variant : effect.variants) {
      if (variant.inputs[0].dynamics == Dynamics::Step) {
        for (int k = 1; k < 24; ++k) {
          const std::size_t at = times_.size() * static_cast<std::size_t>(k) / 24;
          out.push_back({&effect, variant, {0.5 * (times_[at] + times_[at + 1])}});
        }
      } else if (variant.inputs[0].dynamics == Dynamics::None) {
        out.push_back({&effect, variant, {}});
      }
    }
    return out;
  }

  [[nodiscard]] DiscrepancyInput input(std::vector<double> predicted) const {
    DiscrepancyInput out;
    out.machine = campaign_.machine;
    out.log = campaign_.log;
    out.observations = *campaign_.observations;
    out.predicted = std::move(predicted);
    out.simulation_gain_uncertainty = 0.0;
    out.absolute = true;
    out.own = own_;
    return out;
  }

 private:
  Campaign campaign_;
  std::shared_ptr<const OwnEffects> own_;
  DriverTable drivers_;
  std::vector<Effect> catalogue_;
  std::vector<double> times_;
};

struct Fit {
  std::vector<Term> terms;
  std::vector<Eigen::VectorXd> gains;
  std::vector<bool> used;  ///< rows
};

/// Forward stepwise least squares on `y` over the rows `used`, as long as BIC falls.
Fit forwardBic(const Device& device, const Eigen::VectorXd& y, std::vector<bool> used) {
  Fit fit;
  const auto& rows = device.rows();
  std::vector<Index> index;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (used[r]) index.push_back(static_cast<Index>(r));
  }
  const auto n = static_cast<Index>(index.size());
  Eigen::VectorXd weight(n);
  Eigen::VectorXd left(n);
  for (Index i = 0; i < n; ++i) {
    const Index r = index[static_cast<std::size_t>(i)];
    weight[i] = 1.0 / rows[static_cast<std::size_t>(r)].sigma;
    left[i] = y[r] * weight[i];
  }
  const Eigen::VectorXd target = left;
  const auto columnsOf = [&](const Term& term) {
    const Eigen::MatrixXd all = device.columns(term);
    Eigen::MatrixXd out(n, all.cols());
    for (Index i = 0; i < n; ++i) out.row(i) = all.row(index[static_cast<std::size_t>(i)]) * weight[i];
    return out;
  };
  struct Way {
    Term term;
    Eigen::MatrixXd x;
  };
  std::vector<Way> ways;
  for (const Effect& effect : device.catalogue()) {
    for (Term& term : device.waysOf(effect)) {
      Eigen::MatrixXd x = columnsOf(term);
      ways.push_back({std::move(term), std::move(x)});
    }
  }
  const double log_n = std::log(static_cast<double>(n));
  Eigen::MatrixXd basis(n, 0);
  double rss = left.squaredNorm();
  for (;;) {
    const Way* best = nullptr;
    double best_gain = 0.0;
    double best_rss = rss;
    for (const Way& way : ways) {
      if (std::any_of(fit.terms.begin(), fit.terms.end(), [&](const Term& t) { return t.effect == way.term.effect; }))
        continue;
      Eigen::MatrixXd x = way.x - basis * (basis.transpose() * way.x);
      for (Index c = 0; c < x.cols(); ++c) {
        const double whole = way.x.col(c).norm();
        x.col(c) *= whole > 0.0 ? 1.0 / whole : 0.0;
      }
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
      qr.setThreshold(1e-3);
      if (x.norm() < 1e-3) continue;
      const Eigen::VectorXd rest = left - x * qr.solve(left);
      const double now = rest.squaredNorm();
      const double gain = static_cast<double>(n) * std::log(rss / now) -
                          log_n * static_cast<double>(qr.rank() + static_cast<Index>(way.term.parameters.size()));
      if (gain > best_gain) {
        best_gain = gain;
        best = &way;
        best_rss = now;
      }
    }
    if (best == nullptr) break;
    fit.terms.push_back(best->term);
    for (Index c = 0; c < best->x.cols(); ++c) {
      Eigen::VectorXd v = best->x.col(c);
      const double whole = v.norm();
      for (int pass = 0; pass < 2; ++pass) v -= basis * (basis.transpose() * v);
      if (!(v.norm() > 1e-3 * whole)) continue;
      basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
      basis.col(basis.cols() - 1) = v / v.norm();
    }
    left = target - basis * (basis.transpose() * target);
    rss = best_rss;
  }
  Eigen::MatrixXd all(n, 0);
  std::vector<Index> counts;
  for (const Term& term : fit.terms) {
    const Eigen::MatrixXd x = columnsOf(term);
    all.conservativeResize(Eigen::NoChange, all.cols() + x.cols());
    all.rightCols(x.cols()) = x;
    counts.push_back(x.cols());
  }
  const Eigen::VectorXd beta =
      all.cols() > 0 ? Eigen::VectorXd(all.completeOrthogonalDecomposition().solve(target)) : Eigen::VectorXd();
  Index at = 0;
  for (const Index count : counts) {
    fit.gains.emplace_back(beta.segment(at, count));
    at += count;
  }
  fit.used = std::move(used);
  return fit;
}

std::string joined(const std::vector<std::string>& ids) {
  std::string out;
  for (const std::string& id : ids) out += (out.empty() ? "" : ", ") + id;
  return out.empty() ? "-" : out;
}

struct Score {
  int terms = 0;
  int right = 0;
  int wrong = 0;
  int bic_right = 0;
  int bic_first = 0;
  int wrong_where_bic_wrong = 0;
  int extra = 0;
  int bic_extra = 0;
};

struct Choice {
  std::string only;
  bool outside = false;
  double part = 1.0;
  std::uint64_t seed = 1;
};

void studyDevice(const std::filesystem::path& folder, const Choice& choice, Score& total) {
  const std::string& only = choice.only;
  const Device device(folder, choice.part, choice.seed);
  const auto& rows = device.rows();
  const auto n = static_cast<Index>(rows.size());
  Eigen::VectorXd y(n);
  std::vector<bool> used;
  for (Index r = 0; r < n; ++r) {
    y[r] = rows[static_cast<std::size_t>(r)].value;
    used.push_back(rows[static_cast<std::size_t>(r)].use == ObservationUse::Fit);
  }
  // The model of the device, outliers clipped.
  Fit model = forwardBic(device, y, used);
  for (int pass = 0; pass < 3; ++pass) {
    Eigen::VectorXd left = y;
    for (std::size_t t = 0; t < model.terms.size(); ++t) left -= device.columns(model.terms[t]) * model.gains[t];
    std::vector<bool> kept = used;
    for (const Component c : all_components) {
      std::vector<double> magnitude;
      for (Index r = 0; r < n; ++r) {
        const auto at = static_cast<std::size_t>(r);
        if (used[at] && rows[at].component == c) magnitude.push_back(std::abs(left[r]) / rows[at].sigma);
      }
      if (magnitude.empty()) continue;
      std::nth_element(magnitude.begin(), magnitude.begin() + static_cast<std::ptrdiff_t>(magnitude.size() / 2),
                       magnitude.end());
      const double scale = 1.4826 * magnitude[magnitude.size() / 2];
      for (Index r = 0; r < n; ++r) {
        const auto at = static_cast<std::size_t>(r);
        if (rows[at].component == c && std::abs(left[r]) / rows[at].sigma > 4.5 * scale) kept[at] = false;
      }
    }
    model = forwardBic(device, y, kept);
  }
  std::printf("%s: %zu observations, %zu effects, %zu terms in its model\n", folder.filename().c_str(), rows.size(),
              device.catalogue().size(), model.terms.size());
  Score score;
  for (std::size_t hidden = 0; hidden < model.terms.size(); ++hidden) {
    const std::string& id = model.terms[hidden].effect->id;
    if (!only.empty() && id != only) continue;
    Eigen::VectorXd predicted = Eigen::VectorXd::Zero(n);
    for (std::size_t t = 0; t < model.terms.size(); ++t) {
      if (t != hidden) predicted += device.columns(model.terms[t]) * model.gains[t];
    }
    const Eigen::VectorXd part = device.columns(model.terms[hidden]) * model.gains[hidden];
    double chi2 = 0.0;
    for (Index r = 0; r < n; ++r) {
      const auto at = static_cast<std::size_t>(r);
      if (model.used[at]) chi2 += std::pow(part[r] / rows[at].sigma, 2);
    }
    const Fit plain = forwardBic(device, y - predicted, used);
    std::vector<std::string> plain_ids;
    for (const Term& t : plain.terms) plain_ids.push_back(t.effect->id);
    const bool plain_right = std::find(plain_ids.begin(), plain_ids.end(), id) != plain_ids.end();
    const auto begin = std::chrono::steady_clock::now();
    JobContext job;
    const DiscrepancyInput input = device.input({predicted.data(), predicted.data() + n});
    DiscrepancyOptions options;
    if (choice.outside) options.reject = {id};
    const DiscrepancyResult found = findDiscrepancy(input, options, job);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    bool right = false;
    std::vector<std::string> names;
    int others = 0;
    for (const FoundEffect& e : found.effects) {
      const bool holds = e.id == id || std::find(e.rivals.begin(), e.rivals.end(), id) != e.rivals.end();
      right = right || holds;
      others += holds ? 0 : 1;
      names.push_back(e.id + (e.rivals.empty() ? "" : " (or " + joined(e.rivals) + ")"));
    }
    const bool wrong = !right && !names.empty();
    ++score.terms;
    score.right += right ? 1 : 0;
    score.wrong += wrong ? 1 : 0;
    score.bic_right += plain_right ? 1 : 0;
    score.bic_first += !plain_ids.empty() && plain_ids.front() == id ? 1 : 0;
    score.wrong_where_bic_wrong += wrong && !plain_right ? 1 : 0;
    score.extra += others;
    score.bic_extra += static_cast<int>(plain_ids.size()) - (plain_right ? 1 : 0);
    std::printf("  %-36s chi2 %9.0f  %-7s %-5s [%s] %.1f s\n      plain %-5s [%s]\n", id.c_str(), chi2,
                std::string(toString(found.verdict)).c_str(),
                right   ? "right"
                : wrong ? "WRONG"
                        : "-",
                joined(names).c_str(), seconds, plain_right ? "right" : "WRONG", joined(plain_ids).c_str());
    if (!found.leftover.empty()) std::printf("      left over: %s\n", found.leftover.c_str());
    for (const DiscrepancyStep& step : found.steps) {
      if (!step.accepted)
        std::printf("      %s: %s (evidence %.0f)\n", step.id.c_str(), step.reason.c_str(), step.delta_bic);
    }
    std::fflush(stdout);
  }
  std::printf("  %d of %d right, %d wrong, %d further names; stepwise BIC %d right (%d first), %d further names\n",
              score.right, score.terms, score.wrong, score.extra, score.bic_right, score.bic_first, score.bic_extra);
  total.terms += score.terms;
  total.right += score.right;
  total.wrong += score.wrong;
  total.bic_right += score.bic_right;
  total.bic_first += score.bic_first;
  total.wrong_where_bic_wrong += score.wrong_where_bic_wrong;
  total.extra += score.extra;
  total.bic_extra += score.bic_extra;
}

}  // namespace
}  // namespace spindrift::study

int main(int count, char** words) {
  using namespace spindrift::study;
  std::vector<std::string> folders;
  Choice choice;
  int repeats = 1;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--term" && i + 1 < count) {
      choice.only = words[++i];
    } else if (word == "--outside") {
      choice.outside = true;
    } else if (word == "--part" && i + 1 < count) {
      choice.part = std::atof(words[++i]);
      repeats = 4;
    } else {
      folders.push_back(word);
    }
  }
  if (folders.empty()) {
    std::fprintf(stderr, "usage: hidden_term_study CAMPAIGN... [--term ID] [--outside] [--part P]\n");
    return 2;
  }
  Score total;
  try {
    for (int repeat = 0; repeat < repeats; ++repeat, ++choice.seed) {
      for (const std::string& folder : folders) studyDevice(folder, choice, total);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  std::printf(
      "all: %d of %d right, %d wrong (%d where stepwise BIC is wrong too), %d further names; stepwise BIC %d "
      "right (%d first), %d further names\n",
      total.right, total.terms, total.wrong, total.wrong_where_bic_wrong, total.extra, total.bic_right, total.bic_first,
      total.bic_extra);
  return total.right >= total.bic_right && total.wrong_where_bic_wrong == 0 ? 0 : 1;
}
