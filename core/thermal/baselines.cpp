// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/baselines.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/thermal/thermal_model.h"

namespace spindrift {
namespace {

using Eigen::Index;

std::vector<Index> trainingRows(const TimeSeries& series, const Signal& y, double from_s, double to_s) {
  std::vector<Index> rows;
  for (std::size_t r = 0; r < series.time_s.size(); ++r)
    if (series.time_s[r] >= from_s && series.time_s[r] < to_s && std::isfinite(y.values[r]))
      rows.push_back(static_cast<Index>(r));
  return rows;
}

bool changes(const std::vector<double>& u, const std::vector<Index>& rows) {
  for (const Index r : rows)
    if (u[r] != u[rows.front()]) return true;
  return false;
}

}  // namespace

PlainModel noModel(const TimeSeries& series, const std::string& output, double from_s, double to_s) {
  const Signal& y = series.at(output);
  double sum = 0.0;
  const std::vector<Index> rows = trainingRows(series, y, from_s, to_s);
  for (const Index r : rows) sum += y.values[r];
  const double mean = rows.empty() ? 0.0 : sum / static_cast<double>(rows.size());
  return {"no model", std::vector<double>(series.time_s.size(), mean), "mean of the training range"};
}

PlainModel staticRegression(const TimeSeries& series, const std::string& output, double from_s, double to_s) {
  const Signal& y = series.at(output);
  const std::vector<Index> rows = trainingRows(series, y, from_s, to_s);
  PlainModel model = noModel(series, output, from_s, to_s);
  model.name = "static regression on all temperatures";
  std::vector<std::vector<double>> columns;
  for (const Signal& s : series.signals) {
    if (s.kind != SignalKind::Temperature || s.name == output) continue;
    columns.push_back(bridged(series.time_s, s.values, false));
    if (rows.empty() || !changes(columns.back(), rows)) columns.pop_back();
  }
  if (columns.empty() || rows.size() < 2 * (columns.size() + 1)) {
    model.note = columns.empty() ? "no temperature changes in the training range" : "too few samples for a regression";
    return model;
  }
  Eigen::MatrixXd A(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()) + 1);
  Eigen::VectorXd b(static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto i = static_cast<Index>(k);
    A(i, 0) = 1.0;
    for (std::size_t c = 0; c < columns.size(); ++c)
      A(i, static_cast<Index>(c) + 1) = columns[c][rows[k]] - columns[c][rows[0]];
    b[i] = y.values[rows[k]];
  }
  const Eigen::VectorXd w = A.colPivHouseholderQr().solve(b);
  for (std::size_t r = 0; r < series.time_s.size(); ++r) {
    model.prediction[r] = w[0];
    for (std::size_t c = 0; c < columns.size(); ++c)
      model.prediction[r] += w[static_cast<Index>(c) + 1] * (columns[c][r] - columns[c][rows[0]]);
  }
  model.note = std::to_string(columns.size()) + " temperatures";
  return model;
}

PlainModel firstOrderArx(const TimeSeries& series, const std::string& output, double from_s, double to_s) {
  PlainModel model = noModel(series, output, from_s, to_s);
  model.name = "first-order ARX on two inputs";
  const double period = std::max(60.0, series.medianPeriod_s());
  const BinnedSeries bins = binSeries(series.time_s, period);
  const std::vector<double> y = bins.mean(series.at(output).values);
  const Signal* hottest = nullptr;
  const Signal* speed = nullptr;
  double widest = 0.0;
  for (const Signal& s : series.signals) {
    if (s.name == output) continue;
    if (speed == nullptr && isDriven(s.kind)) speed = &s;
    if (s.kind != SignalKind::Temperature) continue;
    const SignalQuality q = signalQuality(series, s);
    if (q.maximum - q.minimum > widest) {
      widest = q.maximum - q.minimum;
      hottest = &s;
    }
  }
  std::vector<std::vector<double>> inputs;
  for (const Signal* s : {hottest, speed})
    if (s != nullptr) inputs.push_back(bins.mean(bridged(series.time_s, s->values, holdsUntilNextRow(s->kind))));
  const Index p = static_cast<Index>(inputs.size()) + 2;
  Eigen::MatrixXd A(static_cast<Index>(y.size()), p);
  Eigen::VectorXd b(static_cast<Index>(y.size()));
  Index n = 0;
  for (std::size_t k = 1; k < y.size(); ++k) {
    if (bins.time_s[k - 1] < from_s || bins.time_s[k] >= to_s || !std::isfinite(y[k]) || !std::isfinite(y[k - 1]))
      continue;
    A(n, 0) = y[k - 1];
    A(n, 1) = 1.0;
    for (std::size_t c = 0; c < inputs.size(); ++c) A(n, static_cast<Index>(c) + 2) = inputs[c][k];
    b[n++] = y[k];
  }
  if (n < 3 * p) {
    model.note = "too few samples";
    return model;
  }
  const Eigen::VectorXd w = A.topRows(n).colPivHouseholderQr().solve(b.head(n));
  std::vector<double> simulated(y.size(), model.prediction[0]);
  double state = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < y.size(); ++k) {
    if (bins.time_s[k] < from_s) continue;
    if (!std::isfinite(state)) {
      state = std::isfinite(y[k]) ? y[k] : model.prediction[0];
    } else {
      state = w[0] * state + w[1];
      for (std::size_t c = 0; c < inputs.size(); ++c) state += w[static_cast<Index>(c) + 2] * inputs[c][k];
      state = std::clamp(state, -1e9, 1e9);
    }
    simulated[k] = state;
  }
  for (std::size_t k = 0; k < y.size(); ++k)
    for (int r = bins.rows[k].first; r < bins.rows[k].second; ++r) model.prediction[r] = simulated[k];
  return model;
}

PlainModel laggedRidge(const TimeSeries& series, const std::string& output, double from_s, double to_s) {
  PlainModel model = noModel(series, output, from_s, to_s);
  model.name = "ridge regression on delayed inputs, forward selection";
  const Signal& measured = series.at(output);
  const std::vector<Index> all = trainingRows(series, measured, from_s, to_s);
  std::vector<Index> rows;
  const std::size_t stride = std::max<std::size_t>(1, all.size() / 1000);
  for (std::size_t k = 0; k < all.size(); k += stride) rows.push_back(all[k]);
  if (rows.size() < 40) {
    model.note = "too few samples";
    return model;
  }
  struct Group {
    std::vector<std::vector<double>> lags;
  };
  std::vector<Group> groups;
  for (const Signal& s : series.signals) {
    const bool driven = isDriven(s.kind);
    if ((s.kind != SignalKind::Temperature && !driven) || s.name == output) continue;
    const std::vector<double> u = bridged(series.time_s, s.values, driven);
    if (!changes(u, rows)) continue;
    for (int power = 1; power <= (driven ? 2 : 1); ++power) {
      std::vector<double> f(u);
      for (double& v : f) v = power == 2 ? v * std::abs(v) : v;
      Group group;
      for (const double tau : {0.0, 600.0, 1800.0, 5400.0}) {
        std::vector<double> x = lagFiltered(series.time_s, f, tau, driven);
        double mean = 0.0;
        double square = 0.0;
        for (const Index r : rows) mean += x[r] / static_cast<double>(rows.size());
        for (const Index r : rows) square += (x[r] - mean) * (x[r] - mean) / static_cast<double>(rows.size());
        for (double& v : x) v = square > 1e-18 ? (v - mean) / std::sqrt(square) : 0.0;
        group.lags.push_back(std::move(x));
      }
      groups.push_back(std::move(group));
    }
  }
  const std::size_t cut = rows.size() * 3 / 4;
  const double centre = model.prediction[0];
  const auto fit = [&](const std::vector<std::size_t>& chosen, std::size_t count) {
    const Index p = static_cast<Index>(chosen.size()) * 4 + 1;
    Eigen::MatrixXd A(static_cast<Index>(count), p);
    Eigen::VectorXd b(static_cast<Index>(count));
    for (std::size_t k = 0; k < count; ++k) {
      const auto i = static_cast<Index>(k);
      A(i, 0) = 1.0;
      for (std::size_t g = 0; g < chosen.size(); ++g)
        for (int l = 0; l < 4; ++l) A(i, static_cast<Index>(g) * 4 + l + 1) = groups[chosen[g]].lags[l][rows[k]];
      b[i] = measured.values[rows[k]] - centre;
    }
    Eigen::MatrixXd normal = A.transpose() * A;
    normal.diagonal().tail(p - 1).array() += 1e-3 * static_cast<double>(count);
    return Eigen::VectorXd(normal.ldlt().solve(A.transpose() * b));
  };
  const auto predict = [&](const std::vector<std::size_t>& chosen, const Eigen::VectorXd& w, std::size_t row) {
    double v = centre + w[0];
    for (std::size_t g = 0; g < chosen.size(); ++g)
      for (int l = 0; l < 4; ++l) v += w[static_cast<Index>(g) * 4 + l + 1] * groups[chosen[g]].lags[l][row];
    return v;
  };
  std::vector<std::size_t> chosen;
  double best_error = std::numeric_limits<double>::infinity();
  while (chosen.size() < 8) {
    std::size_t best = groups.size();
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (std::find(chosen.begin(), chosen.end(), g) != chosen.end()) continue;
      std::vector<std::size_t> trial = chosen;
      trial.push_back(g);
      const Eigen::VectorXd w = fit(trial, cut);
      double error = 0.0;
      for (std::size_t k = cut; k < rows.size(); ++k) {
        const double e = predict(trial, w, static_cast<std::size_t>(rows[k])) - measured.values[rows[k]];
        error += e * e;
      }
      if (error < best_error * 0.999) {
        best_error = error;
        best = g;
      }
    }
    if (best == groups.size()) break;
    chosen.push_back(best);
  }
  if (chosen.empty()) return model;
  const Eigen::VectorXd w = fit(chosen, rows.size());
  for (std::size_t r = 0; r < series.time_s.size(); ++r) model.prediction[r] = predict(chosen, w, r);
  return model;
}

}  // namespace spindrift
