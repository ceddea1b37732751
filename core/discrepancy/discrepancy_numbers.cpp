// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy_numbers.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/discrepancy/own_effects.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

using Eigen::Index;

}  // namespace

CatalogueContext catalogueContext(const DiscrepancyInput& input, const DriverTable& drivers,
                                  const ResidualProblem& problem) {
  CatalogueContext context;
  context.machine = &input.machine;
  context.drivers = &drivers;
  std::set<std::string> points(problem.own_points.begin(), problem.own_points.end());
  // A point that was read once or twice shows no slip of its own: any level of it would be one.
  std::map<std::string, std::size_t> readings;
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const auto at = static_cast<std::size_t>(s);
    auto& most = readings[problem.series_point[at]];
    most = std::max(most, static_cast<std::size_t>(problem.series_begin[at + 1] - problem.series_begin[at]));
  }
  std::erase_if(points, [&](const std::string& point) {
    const auto found = readings.find(point);
    return found != readings.end() && found->second < 3;
  });
  context.points.assign(points.begin(), points.end());
  context.point_count = std::set<std::string>(problem.series_point.begin(), problem.series_point.end()).size();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(2.0);
  Eigen::Vector3d high = -low;
  double c_low = 1e300;
  double c_high = -1e300;
  for (const DeviationQuery& q : problem.place) {
    low = low.cwiseMin(q.approach);
    high = high.cwiseMax(q.approach);
    c_low = std::min(c_low, q.c_deg);
    c_high = std::max(c_high, q.c_deg);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] > low[axis]) context.varying_approach.insert(axis_letters[axis]);
  }
  context.rotations = std::any_of(problem.component.begin(), problem.component.end(), isRotation);
  context.c_varies = c_high > c_low;
  for (int s = 0; s < problem.seriesCount() && !context.position_varies; ++s) {
    const auto from = static_cast<std::size_t>(problem.series_begin[static_cast<std::size_t>(s)]);
    const auto to = static_cast<std::size_t>(problem.series_begin[static_cast<std::size_t>(s) + 1]);
    for (std::size_t u = from + 1; u < to; ++u) {
      if ((problem.place[u].position_mm - problem.place[from].position_mm).norm() > 0.05)
        context.position_varies = true;
    }
  }
  return context;
}

namespace {

/// What was found as one form of an effect, in the columns of that effect: as many as the form has.
ModelEffect withFormsJoined(ModelEffect e) {
  if (e.effect.of_forms == nullptr) return e;
  const std::shared_ptr<const Effect> whole = e.effect.of_forms;
  const std::vector<double>& form = whole->forms[e.effect.form];
  std::size_t used = form.size();
  while (used > 1 && form[used - 1] == 0.0) --used;
  const auto k = static_cast<Index>(used);
  const Index inputs = e.gains.size();
  const Index others = e.covariance.rows() - inputs;
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(inputs * k + others, inputs + others);
  for (Index i = 0; i < inputs; ++i)
    for (Index c = 0; c < k; ++c) apart(i * k + c, i) = form[static_cast<std::size_t>(c)];
  apart.bottomRightCorner(others, others).setIdentity();
  const Eigen::MatrixXd of_gains = apart.topLeftCorner(inputs * k, inputs);
  Eigen::VectorXd sigma(inputs * k);
  for (Index i = 0; i < inputs; ++i) {
    for (Index c = 0; c < k; ++c) {
      const double part = std::abs(of_gains(i * k + c, i));
      sigma[i * k + c] = part > 0.0 ? part * e.gain_uncertainty[i] : 0.0;
    }
  }
  e.gains = of_gains * e.gains;
  e.gain_uncertainty = sigma;
  e.covariance = apart * e.covariance * apart.transpose();
  e.effect = *whole;
  e.effect.shape.resize(used);
  e.effect.forms.clear();
  return e;
}

}  // namespace

std::vector<ModelEffect> modelEffects(const EffectSearch& search, const ResidualProblem& problem, const JointFit& fit,
                                      const std::string& source, double chi2_scale,
                                      const std::vector<Eigen::VectorXd>& prior_sigma) {
  if (fit.terms.empty()) return {};
  std::vector<double> prior;  // of every column of the Jacobian; 0: free
  std::vector<Eigen::MatrixXd> parts;
  Index total = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const Eigen::MatrixXd x = search.columns(fit.terms[t]);
    Eigen::MatrixXd part(x.rows(), x.cols() + static_cast<Index>(fit.terms[t].parameters.size()));
    part.leftCols(x.cols()) = x;
    for (Index g = 0; g < x.cols(); ++g) prior.push_back(prior_sigma.empty() ? 0.0 : prior_sigma[t][g]);
    prior.insert(prior.end(), fit.terms[t].parameters.size(), 0.0);
    // The lags of inputs with a prior are fixed.
    std::vector<bool> fixed(fit.terms[t].parameters.size(), false);
    if (!prior_sigma.empty() && !fit.terms[t].variant.shared_lag) {
      const auto inputs = fit.terms[t].variant.inputs.size();
      const auto k = x.cols() / static_cast<Index>(inputs);
      std::size_t next = 0;
      for (std::size_t i = 0; i < inputs; ++i) {
        const auto count = static_cast<std::size_t>(parameterCount({{fit.terms[t].variant.inputs[i]}, false}));
        const bool held = prior_sigma[t].segment(static_cast<Index>(i) * k, k).maxCoeff() > 0.0;
        for (std::size_t p = 0; p < count; ++p) fixed[next++] = held;
      }
    }
    for (std::size_t p = 0; p < fit.terms[t].parameters.size(); ++p) {
      if (fixed[p]) {
        part.col(x.cols() + static_cast<Index>(p)).setZero();
        continue;
      }
      const bool lag = search.parameterIsLag(fit.terms[t], p);
      const double value = fit.terms[t].parameters[p];
      const double step = lag ? std::max(1.0, 0.02 * value) : 30.0;
      ModelTerm up = fit.terms[t];
      up.parameters[p] = value + step;
      part.col(x.cols() + static_cast<Index>(p)) = (search.columns(up) * fit.gains[t] - x * fit.gains[t]) / step;
    }
    total += part.cols();
    parts.push_back(std::move(part));
  }
  Eigen::MatrixXd jacobian(problem.size(), total);
  Index at = 0;
  for (const Eigen::MatrixXd& part : parts) {
    jacobian.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  Eigen::MatrixXd x = problem.projected(jacobian);
  const Index data_rows = x.rows();
  x.conservativeResize(data_rows + total, Eigen::NoChange);
  x.bottomRows(total).setZero();
  for (Index c = 0; c < total; ++c) {
    const double sigma = prior[static_cast<std::size_t>(c)];
    if (sigma > 0.0) x(data_rows + c, c) = 1.0 / sigma;
  }
  const Eigen::VectorXd norm = x.colwise().norm();
  Eigen::MatrixXd scaled = x;
  for (Index c = 0; c < total; ++c) scaled.col(c) /= norm[c] > 0.0 ? norm[c] : 1.0;
  // Gains that these readings cannot tell from others were left at zero by the fit: nothing is known of them.
  std::vector<bool> dependent(static_cast<std::size_t>(total), false);
  Index first = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    for (Index g = 0; g < fit.gains[t].size(); ++g) {
      const auto c = static_cast<std::size_t>(first + g);
      dependent[c] = fit.gains[t][g] == 0.0 && !(prior[c] > 0.0);
      if (dependent[c]) scaled.col(first + g).setZero();
    }
    first += parts[t].cols();
  }
  Eigen::MatrixXd covariance;
  if (prior_sigma.empty()) {
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> cod(scaled);
    const Eigen::MatrixXd inverse = cod.pseudoInverse();
    covariance = inverse * inverse.transpose() * chi2_scale;
  } else {
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> cod(scaled.transpose() * scaled);
    covariance = cod.pseudoInverse() * chi2_scale;
  }
  for (Index r = 0; r < total; ++r) {
    for (Index c = 0; c < total; ++c) {
      covariance(r, c) /= (norm[r] > 0.0 ? norm[r] : 1.0) * (norm[c] > 0.0 ? norm[c] : 1.0);
    }
  }
  std::vector<ModelEffect> out;
  at = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    ModelEffect e;
    e.effect = *fit.terms[t].effect;
    e.variant = fit.terms[t].variant;
    e.parameters = fit.terms[t].parameters;
    e.gains = fit.gains[t];
    e.covariance = covariance.block(at, at, parts[t].cols(), parts[t].cols());
    const Eigen::VectorXd sd = e.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    e.gain_uncertainty = sd.head(e.gains.size());
    for (Index g = 0; g < e.gains.size(); ++g) {
      if (dependent[static_cast<std::size_t>(at + g)]) e.gain_uncertainty[g] = std::numeric_limits<double>::infinity();
    }
    for (std::size_t p = 0; p < e.parameters.size(); ++p) {
      e.parameter_uncertainty.push_back(sd[e.gains.size() + static_cast<Index>(p)]);
    }
    e.source = source;
    at += parts[t].cols();
    out.push_back(withFormsJoined(std::move(e)));
  }
  return out;
}

std::string driversText(const ModelEffect& e) {
  std::string text;
  std::size_t next = 0;
  for (const EffectInput& input : e.variant.inputs) {
    if (!text.empty()) text += " + ";
    const std::string name(driverAsWritten(input.driver));
    switch (input.dynamics) {
      case Dynamics::None:
        text += input.driver.empty() ? "steady" : name + " without time constant";
        break;
      case Dynamics::Lag: {
        const double tau = e.parameters[e.variant.shared_lag ? 0 : next++];
        text += tau > 0.0 ? fmt::format("{} (time constant {:.0f} s)", name, tau) : name;
        break;
      }
      case Dynamics::Start:
        text += "warm at the start";
        if (!e.variant.shared_lag) ++next;
        break;
      case Dynamics::AsymmetricLag: {
        const std::size_t first = e.variant.shared_lag ? 0 : next;
        text += fmt::format("{} (time constant {:.0f} s on, {:.0f} s off)", name, e.parameters[first],
                            e.parameters[first + 1]);
        if (!e.variant.shared_lag) next += 2;
        break;
      }
      case Dynamics::Step:
        text += fmt::format("step at {:.0f} s", e.parameters[next++]);
        break;
      case Dynamics::Pulse:
        text += fmt::format("from {:.0f} s to {:.0f} s (time constant {:.0f} s)", e.parameters[next],
                            e.parameters[next] + e.parameters[next + 1], e.parameters[next + 2]);
        next += 3;
        break;
    }
  }
  return text;
}

RowResult evaluateRows(const DiscrepancyInput& input, const std::vector<std::size_t>& fit_rows,
                       const std::vector<std::size_t>& held_rows, const std::vector<double>& effect_part) {
  const auto& rows = input.observations.rows;
  RowResult out;
  out.constant.assign(rows.size(), std::numeric_limits<double>::quiet_NaN());
  out.left = out.constant;
  std::map<std::pair<std::string, int>, std::array<double, 2>> sums;
  for (const std::size_t row : fit_rows) {
    const Observation& o = rows[row];
    auto& s = sums[{o.point, static_cast<int>(o.component)}];
    const double w = 1.0 / (o.sigma * o.sigma);
    s[0] += w;
    s[1] += w * (o.value - input.predicted[row] - effect_part[row]);
  }
  out.rotations =
      std::all_of(fit_rows.begin(), fit_rows.end(), [&](std::size_t row) { return isRotation(rows[row].component); });
  double fit = 0.0;
  double fit_count = 0.0;
  double held = 0.0;
  const std::set<std::size_t> fitted(fit_rows.begin(), fit_rows.end());
  const std::set<std::size_t> held_out(held_rows.begin(), held_rows.end());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const Observation& o = rows[row];
    const auto found = sums.find({o.point, static_cast<int>(o.component)});
    if ((found == sums.end() && !input.absolute) || !std::isfinite(input.predicted[row])) continue;
    out.constant[row] = input.absolute ? 0.0 : found->second[1] / found->second[0];
    if (isRotation(o.component) != out.rotations) continue;
    const double r = o.value - input.predicted[row] - effect_part[row] - out.constant[row];
    out.left[row] = r;
    if (fitted.contains(row)) {
      fit += r * r;
      fit_count += 1.0;
    } else if (held_out.contains(row)) {
      held += r * r;
      ++out.holdout_rows;
    }
  }
  if (fit_count > 0.0) out.fit_rms = std::sqrt(fit / fit_count);
  if (out.holdout_rows > 0) out.holdout_rms = std::sqrt(held / static_cast<double>(out.holdout_rows));
  return out;
}

double probabilityOfLeavingMore(const std::vector<Observation>& observations, const std::vector<std::size_t>& rows,
                                const std::vector<double>& a, const std::vector<double>& b) {
  std::map<std::pair<std::string, double>, double> more_by_state;
  for (const std::size_t row : rows) {
    const double more = a[row] * a[row] - b[row] * b[row];
    const Observation& o = observations[row];
    if (std::isfinite(more)) more_by_state[{o.state, o.state.empty() ? o.time_s : 0.0}] += more;
  }
  const auto states = static_cast<double>(more_by_state.size());
  if (states < 2.0) return 0.5;
  double mean = 0.0;
  for (const auto& [state, more] : more_by_state) mean += more / states;
  double square = 0.0;
  for (const auto& [state, more] : more_by_state) square += (more - mean) * (more - mean);
  if (!(square > 0.0)) return mean > 0.0 ? 1.0 : mean < 0.0 ? 0.0 : 0.5;
  return studentCdf(mean / std::sqrt(square / (states - 1.0) / states), states - 1.0);
}

}  // namespace spindrift
