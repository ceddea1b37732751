// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/method_average.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/unit_text.h"
#include "core/thermal/interval_calibration.h"

namespace spindrift {
namespace choice {

using Eigen::Index;
using namespace response;

std::vector<InputVerdict> explained(const ProjectionResult& few, const ProjectedModel& model,
                                    const std::vector<std::string>& usable) {
  std::vector<InputVerdict> verdicts;
  for (std::size_t i = 0; i < few.kept.size(); ++i) {
    InputVerdict v;
    v.name = few.kept[i];
    v.kept = true;
    v.contribution_rms = model.contribution_rms[i];
    v.error_without_percent = std::nan("");
    verdicts.push_back(std::move(v));
  }
  for (const std::string& name : usable) {
    if (std::find(few.kept.begin(), few.kept.end(), name) != few.kept.end()) continue;
    InputVerdict v;
    v.name = name;
    v.reason = "below 0.1 % of the prediction";
    v.error_without_percent = std::nan("");
    verdicts.push_back(std::move(v));
  }
  for (InputVerdict& v : verdicts) {
    const auto found =
        std::find_if(few.inputs.begin(), few.inputs.end(), [&](const ProjectedInput& p) { return p.name == v.name; });
    if (found == few.inputs.end()) continue;
    const std::string often = fmt::format("chosen in {:.0f} % of the resamples", 100.0 * found->frequency);
    if (v.kept) {
      v.reason = fmt::format(
          "its part of the prediction is {:.2g} rms; without it the kept inputs leave {:.2g} % of the time history of "
          "the model with all inputs unexplained, with it {:.2g} %; {}{}",
          v.contribution_rms, 100.0 * found->left, 100.0 * few.left, often,
          found->frequency < 0.5 ? " (another sensor may do as well)" : "");
    } else {
      v.reason = fmt::format(
          "redundant: the kept inputs carry the same information; they leave {:.2g} % of the time history of the model "
          "with all inputs unexplained, with it {:.2g} %; {}",
          100.0 * few.left, 100.0 * found->left, often);
    }
  }
  return verdicts;
}

Averaged averaged(const Dictionary& d, const Evidence& evidence, const std::vector<Candidate>& candidates,
                  const std::vector<std::string>& names, const std::string& output,
                  const MethodChoiceOptions& options) {
  Averaged out;
  std::vector<Weighted> members = weightsOf(evidence, candidates, -1, options, anything);
  // Inputs that next to nobody wants leave with those who do.
  std::vector<double> inclusion(names.size(), 0.0);
  for (const Weighted& w : members)
    for (const std::size_t i : w.candidate->inputs) inclusion[i] += w.weight;
  const auto wanted = [&](const Candidate& c) {
    return std::all_of(c.inputs.begin(), c.inputs.end(), [&](std::size_t i) { return inclusion[i] >= 0.05; });
  };
  members = weightsOf(evidence, candidates, -1, options, wanted);

  const Index p = d.X.cols();
  Eigen::VectorXd average = Eigen::VectorXd::Zero(p + 1);
  std::vector<Solution> solutions;
  for (const Weighted& w : members) {
    solutions.push_back(evidence.solve(*w.candidate, nullptr, true));
    average += w.weight * evidence.spread(*w.candidate, solutions.back().w);
    out.shares[w.candidate->method] += w.weight;
  }
  const Eigen::MatrixXd& rows = evidence.rows();
  const Eigen::VectorXd residual = rows.col(p + 1) - rows.leftCols(p + 1) * average;
  const double correlation = neighbourCorrelation(residual);
  const double fewer = (1.0 + correlation) / (1.0 - correlation);
  const double noise = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(p + 1, p + 1);
  std::vector<double> variances;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Candidate& c = *members[m].candidate;
    const Eigen::VectorXd full = evidence.spread(c, solutions[m].w);
    const double variance =
        fewer * (rows.col(p + 1) - rows.leftCols(p + 1) * full).squaredNorm() / static_cast<double>(residual.size());
    const auto at = [&](Index k) { return k == 0 ? Index{0} : c.columns[static_cast<std::size_t>(k - 1)] + 1; };
    for (Index r = 0; r < solutions[m].inverse.rows(); ++r)
      for (Index k = 0; k < solutions[m].inverse.cols(); ++k)
        covariance(at(r), at(k)) += members[m].weight * variance * solutions[m].inverse(r, k);
    covariance.noalias() += members[m].weight * (full - average) * (full - average).transpose();
    variances.push_back(variance);
  }

  covariance *= calibration(evidence, candidates, options, wanted, fewer * noise * noise, noise * noise);

  // Original units; every lag has its own reference, which goes into the offset.
  ThermalOutput o;
  o.name = output;
  o.unit = unitOfSignal(output);
  o.offset = d.y_mean + average[0];
  std::vector<int> place(d.inputs.size(), -1);
  std::vector<Index> used;
  for (Index k = 0; k < p; ++k) {
    if (average[k + 1] == 0.0) continue;
    const Feature& f = d.features[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(f.input);
    if (place[i] < 0) {
      place[i] = static_cast<int>(out.model.inputs.size());
      out.model.inputs.push_back(d.inputs[i]);
      out.model.inputs.back().reference = f.reference;
    }
    used.push_back(k);
    o.terms.push_back({place[i], f.tau_s, average[k + 1]});
  }
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(static_cast<Index>(used.size()) + 1, p + 1);
  T(0, 0) = 1.0;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const double shift = out.model.inputs[static_cast<std::size_t>(o.terms[k].input)].reference -
                         d.features[static_cast<std::size_t>(used[k])].reference;
    o.offset += average[used[k] + 1] * shift;
    T(0, used[k] + 1) = shift;
    T(static_cast<Index>(k) + 1, used[k] + 1) = 1.0;
  }
  o.covariance = T * covariance * T.transpose();
  o.noise_sigma = noise;
  o.noise_tau_s = correlation > 0.0 ? -d.period_s / std::log(correlation) : 0.0;
  out.model.kind = "lags";
  out.model.period_s = d.period_s;
  out.model.outputs.push_back(std::move(o));

  const double with_all = averagedEvidence(evidence, candidates, options, wanted);
  for (std::size_t i = 0; i < names.size(); ++i) {
    InputVerdict v;
    v.name = names[i];
    Eigen::VectorXd part = Eigen::VectorXd::Zero(rows.rows());
    for (Index k = 0; k < p; ++k)
      if (d.inputs[static_cast<std::size_t>(d.features[static_cast<std::size_t>(k)].input)].name == names[i])
        part += average[k + 1] * rows.col(k + 1);
    v.contribution_rms = std::sqrt(part.squaredNorm() / static_cast<double>(part.size()));
    v.kept = inclusion[i] >= 0.05 && v.contribution_rms > 0.0;
    const auto without = [&](const Candidate& c) {
      return wanted(c) && std::find(c.inputs.begin(), c.inputs.end(), i) == c.inputs.end();
    };
    v.error_without_percent = std::nan("");
    if (v.kept && std::any_of(candidates.begin(), candidates.end(), without))
      v.error_without_percent =
          100.0 * (std::exp(0.5 * (averagedEvidence(evidence, candidates, options, without) - with_all)) - 1.0);
    if (!v.kept) {
      v.reason = fmt::format("models with it have {:.0f} % of the weight of blocked evidence; 5 % are needed",
                             100.0 * inclusion[i]);
    } else {
      v.reason = fmt::format("its part of the prediction is {:.2g} rms; models with it have {:.0f} % of the weight",
                             v.contribution_rms, 100.0 * inclusion[i]);
      if (std::isfinite(v.error_without_percent))
        v.reason +=
            fmt::format("; without it the error in runs left out changes by {:+.0f} %", v.error_without_percent);
    }
    out.verdicts.push_back(std::move(v));
  }
  return out;
}

}  // namespace choice

using Eigen::Index;

ThermalModel weightedAverage(const std::vector<ThermalModel>& models, const std::vector<double>& weights) {
  SPINDRIFT_ASSERT(!models.empty() && models.size() == weights.size(), "a weight per model is needed");
  ThermalModel out = models.front();
  out.inputs.clear();
  out.kind = "lags";
  ThermalOutput& o = out.outputs.front();
  o.terms.clear();
  o.offset = 0.0;
  o.noise_sigma = o.noise_tau_s = o.uncertainty_factor = o.degrees_of_freedom = 0.0;
  o.verdict.reset();
  // Terms of all models on common references; coefficients of model m stand in the rows `row[m]` of the whole.
  bool covariances = true;
  std::vector<Eigen::MatrixXd> maps;
  std::vector<Eigen::VectorXd> values;
  std::size_t total_terms = 0;
  for (const ThermalModel& m : models) total_terms += m.outputs.front().terms.size();
  for (std::size_t m = 0; m < models.size(); ++m) {
    const ThermalOutput& from = models[m].outputs.front();
    Eigen::MatrixXd map =
        Eigen::MatrixXd::Zero(static_cast<Index>(total_terms) + 1, static_cast<Index>(from.terms.size()) + 1);
    Eigen::VectorXd value(static_cast<Index>(from.terms.size()) + 1);
    map(0, 0) = 1.0;
    value[0] = from.offset;
    covariances = covariances && from.covariance.rows() == value.size();
    for (std::size_t k = 0; k < from.terms.size(); ++k) {
      const ThermalInput& input = models[m].inputs[static_cast<std::size_t>(from.terms[k].input)];
      auto known = std::find_if(out.inputs.begin(), out.inputs.end(), [&](const ThermalInput& i) {
        return i.name == input.name && i.kind == input.kind && i.power == input.power && i.scale == input.scale;
      });
      if (known == out.inputs.end()) known = out.inputs.insert(out.inputs.end(), input);
      const int place = static_cast<int>(known - out.inputs.begin());
      auto term = std::find_if(o.terms.begin(), o.terms.end(),
                               [&](const LagTerm& t) { return t.input == place && t.tau_s == from.terms[k].tau_s; });
      if (term == o.terms.end()) term = o.terms.insert(o.terms.end(), {place, from.terms[k].tau_s, 0.0});
      const auto column = static_cast<Index>(k) + 1;
      map(static_cast<Index>(term - o.terms.begin()) + 1, column) = 1.0;
      map(0, column) = known->reference - input.reference;
      value[column] = from.terms[k].gain;
    }
    o.noise_sigma += weights[m] * from.noise_sigma;
    o.noise_tau_s += weights[m] * from.noise_tau_s;
    o.uncertainty_factor += weights[m] * from.uncertainty_factor;
    maps.push_back(std::move(map));
    values.push_back(std::move(value));
  }
  const auto size = static_cast<Index>(o.terms.size()) + 1;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(size);
  for (std::size_t m = 0; m < models.size(); ++m) mean += weights[m] * (maps[m].topRows(size) * values[m]);
  o.offset = mean[0];
  for (std::size_t k = 0; k < o.terms.size(); ++k) o.terms[k].gain = mean[static_cast<Index>(k) + 1];
  o.covariance.resize(0, 0);
  if (!covariances) return out;
  o.covariance = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const Eigen::MatrixXd map = maps[m].topRows(size);
    const Eigen::VectorXd off = map * values[m] - mean;
    o.covariance += weights[m] * (map * models[m].outputs.front().covariance * map.transpose() + off * off.transpose());
  }
  return out;
}

}  // namespace spindrift
