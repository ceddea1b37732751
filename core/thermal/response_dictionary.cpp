// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/response_dictionary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "core/math/statistics.h"

namespace spindrift::response {
namespace {

using Eigen::Index;

/// Blocks of operation: each begins where a speed or feed leaves zero. Too few or too many: five equal parts.
void assignBlocks(Dictionary& d, const TimeSeries& series, const std::vector<std::string>& names) {
  std::vector<double> starts;
  for (const std::string& name : names) {
    const Signal& signal = series.at(name);
    if (!isDriven(signal.kind)) continue;
    const std::vector<double> u = bridged(series.time_s, signal.values, true);
    for (std::size_t i = 1; i < u.size(); ++i)
      if (u[i - 1] == 0.0 && u[i] != 0.0) starts.push_back(series.time_s[i]);
  }
  std::sort(starts.begin(), starts.end());
  const double first = d.time_s.front();
  const double last = d.time_s.back();
  const double shortest = 0.06 * (last - first);
  std::vector<double> borders;
  for (const double s : starts) {
    if (s > last - shortest || s < first + shortest) continue;
    if (borders.empty() || s - borders.back() > shortest) borders.push_back(s);
  }
  d.block.assign(d.time_s.size(), 0);
  d.by_operation = borders.size() >= 2 && borders.size() <= 9;
  if (!d.by_operation) {
    borders.clear();
    for (int k = 1; k < 5; ++k) borders.push_back(first + (last - first) * k / 5.0);
  }
  for (std::size_t i = 0; i < d.time_s.size(); ++i)
    d.block[i] = static_cast<int>(std::upper_bound(borders.begin(), borders.end(), d.time_s[i]) - borders.begin());
  d.blocks = static_cast<int>(borders.size()) + 1;
}

double correlation(std::span<const double> a, std::span<const double> b) {
  double ma = 0.0;
  double mb = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    ma += a[i];
    mb += b[i];
    ++n;
  }
  if (n < 3) return 0.0;
  ma /= static_cast<double>(n);
  mb /= static_cast<double>(n);
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

std::vector<double> windowOf(const TimeSeries& series, const Signal& signal, double from_s, double to_s) {
  std::vector<double> out;
  for (std::size_t r = 0; r < series.time_s.size(); ++r)
    if (series.time_s[r] >= from_s && series.time_s[r] < to_s) out.push_back(signal.values[r]);
  return out;
}

}  // namespace

Dictionary buildDictionary(const TimeSeries& series, const std::vector<double>& y,
                           const std::vector<std::string>& names, double from_s, double to_s,
                           const ResponseFitOptions& options) {
  Dictionary d;
  const double native = series.medianPeriod_s();
  const double span = std::min(to_s, series.time_s.back()) - std::max(from_s, series.time_s.front());
  d.period_s = options.period_s > 0.0 ? options.period_s : std::max(native, span / 1000.0);
  const BinnedSeries bins = binSeries(series.time_s, d.period_s, from_s, to_s);
  const std::vector<double> y_all = bins.mean(y);
  std::vector<Index> used;
  for (std::size_t b = 0; b < y_all.size(); ++b)
    if (std::isfinite(y_all[b])) used.push_back(static_cast<Index>(b));
  d.y.resize(static_cast<Index>(used.size()));
  for (std::size_t k = 0; k < used.size(); ++k) {
    d.y[static_cast<Index>(k)] = y_all[used[k]];
    d.time_s.push_back(bins.time_s[used[k]]);
  }
  if (used.empty()) return d;
  d.y_mean = d.y.mean();
  std::vector<double> squares;
  for (const double v : y) squares.push_back((v - d.y_mean) * (v - d.y_mean));
  const std::vector<double> square_all = bins.mean(squares);
  d.scatter.resize(d.y.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    const double off = d.y[static_cast<Index>(k)] - d.y_mean;
    d.scatter[static_cast<Index>(k)] = std::max(0.0, square_all[static_cast<std::size_t>(used[k])] - off * off);
  }
  std::vector<Eigen::VectorXd> columns;
  std::vector<double> temperature_spreads;
  std::vector<double> spreads;
  std::vector<double> driven_spreads;
  for (const std::string& name : names) {
    const Signal& signal = series.at(name);
    const bool hold = holdsUntilNextRow(signal.kind);
    const std::vector<double> u = bridged(series.time_s, signal.values, hold);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double scale = 0.0;
    for (std::size_t r = 0; r < u.size(); ++r) {
      if (series.time_s[r] < from_s || series.time_s[r] >= to_s) continue;
      low = std::min(low, u[r]);
      high = std::max(high, u[r]);
      scale = std::max(scale, std::abs(u[r]));
    }
    const std::vector<double> powers = isDriven(signal.kind) ? options.speed_powers : std::vector<double>{1.0};
    for (const double power : powers) {
      ThermalInput input{name, signal.kind, power, isDriven(signal.kind) && scale > 0.0 ? scale : 1.0, 0.0, low, high};
      std::vector<double> f(u.size());
      for (std::size_t r = 0; r < u.size(); ++r) f[r] = input.transformed(u[r]);
      for (const double tau : options.taus_s) {
        const std::vector<double> x = bins.mean(lagFiltered(series.time_s, f, tau, hold));
        Eigen::VectorXd column(static_cast<Index>(used.size()));
        for (std::size_t k = 0; k < used.size(); ++k) column[static_cast<Index>(k)] = x[used[k]];
        Feature feature{static_cast<int>(d.inputs.size()), tau, 0.0, column.mean()};
        column.array() -= feature.reference;
        feature.spread = std::sqrt(column.squaredNorm() / static_cast<double>(column.size()));
        if (feature.spread <= 1e-9) continue;
        spreads.push_back(feature.spread);
        if (isDriven(signal.kind)) driven_spreads.push_back(feature.spread);
        if (signal.kind == SignalKind::Temperature) temperature_spreads.push_back(feature.spread);
        d.features.push_back(feature);
        columns.push_back(std::move(column));
      }
      d.inputs.push_back(input);
    }
  }
  d.X.resize(d.y.size(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) d.X.col(static_cast<Index>(k)) = columns[k];
  if (!temperature_spreads.empty()) {
    d.typical_spread = median(temperature_spreads);
  } else if (!spreads.empty()) {
    d.typical_spread = median(spreads);
  }
  if (!driven_spreads.empty()) d.typical_driven_spread = median(driven_spreads);
  assignBlocks(d, series, names);
  return d;
}

namespace {

/// Of very many columns those that tell most: each in turn the one whose standardised values the chosen ones explain
/// least (QR with pivoting). What is left out is told by the others almost whole; nodes of a finite-element model come
/// by the hundred.
void leaveOutWhatOthersTell(std::vector<std::string>& kept, const std::vector<std::vector<double>>& values,
                            std::vector<InputVerdict>& verdicts) {
  constexpr std::size_t most = 64;
  constexpr std::size_t most_rows = 1000;
  if (kept.size() <= most) return;
  const std::size_t stride = std::max<std::size_t>(1, values.front().size() / most_rows);
  const auto rows = static_cast<Eigen::Index>((values.front().size() + stride - 1) / stride);
  Eigen::MatrixXd rest(rows, static_cast<Eigen::Index>(kept.size()));
  for (Eigen::Index c = 0; c < rest.cols(); ++c) {
    const std::vector<double>& v = values[static_cast<std::size_t>(c)];
    for (Eigen::Index r = 0; r < rows; ++r) rest(r, c) = v[static_cast<std::size_t>(r) * stride];
    const auto finite = rest.col(c).array().isFinite();
    const double mean = finite.select(rest.col(c).array(), 0.0).sum() / std::max<double>(1.0, finite.count());
    rest.col(c) = finite.select(rest.col(c).array() - mean, 0.0);
    rest.col(c) /= std::max(rest.col(c).norm(), std::numeric_limits<double>::min());
  }
  std::set<std::size_t> chosen;
  while (chosen.size() < most) {
    Eigen::Index next = 0;
    rest.colwise().squaredNorm().maxCoeff(&next);
    chosen.insert(static_cast<std::size_t>(next));
    const Eigen::VectorXd direction = rest.col(next).normalized();
    rest -= direction * (direction.transpose() * rest);
    rest.col(next).setZero();
  }
  std::vector<std::string> telling;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (chosen.contains(i)) {
      telling.push_back(kept[i]);
      continue;
    }
    InputVerdict verdict;
    verdict.name = kept[i];
    verdict.reason = fmt::format("the {} columns that are looked at explain {:.1f} % of its variance", most,
                                 100.0 * (1.0 - rest.col(static_cast<Eigen::Index>(i)).squaredNorm()));
    verdicts.push_back(verdict);
  }
  kept = std::move(telling);
}

}  // namespace

std::vector<std::string> usableInputs(const TimeSeries& series, const std::string& output,
                                      const std::vector<std::string>& names, double from_s, double to_s,
                                      std::vector<InputVerdict>& verdicts) {
  const std::vector<double> y = windowOf(series, series.at(output), from_s, to_s);
  std::vector<std::string> kept;
  std::vector<std::vector<double>> values;
  for (const std::string& name : names) {
    std::vector<double> u = windowOf(series, series.at(name), from_s, to_s);
    std::vector<double> finite;
    for (const double v : u)
      if (std::isfinite(v)) finite.push_back(v);
    InputVerdict verdict;
    verdict.name = name;
    if (name == output || std::abs(correlation(u, y)) > 1.0 - 1e-9) {
      throw InputError(
          {series.file, fmt::format("column {}", name)},
          fmt::format(
              "it is a copy of the output {}, so a model with it would only repeat the measurement; allowed: inputs "
              "that are known without measuring the output (temperatures, speeds, feeds, switches).",
              output));
    }
    if (finite.size() < u.size() / 2) {
      verdict.reason =
          fmt::format("{} of {} values are missing in the training range", u.size() - finite.size(), u.size());
    } else if (const auto [low, high] = std::minmax_element(finite.begin(), finite.end());
               finite.empty() || *high - *low <= 1e-9 * std::max(1.0, std::abs(*high))) {
      verdict.reason =
          "constant in the training range: its effect cannot be learnt from these data; train on a range in which it "
          "changes";
    } else {
      for (std::size_t k = 0; k < kept.size() && verdict.reason.empty(); ++k)
        if (correlation(u, values[k]) > 1.0 - 1e-9)
          verdict.reason = fmt::format("identical to {}; one of the two is enough", kept[k]);
    }
    if (verdict.reason.empty()) {
      kept.push_back(name);
      values.push_back(std::move(u));
    } else {
      verdicts.push_back(verdict);
    }
  }
  leaveOutWhatOthersTell(kept, values, verdicts);
  return kept;
}

Whitened whiten(const Dictionary& d, double noise_tau_s) {
  Whitened w;
  const Index n = d.y.size();
  w.phi = std::exp(-d.period_s / noise_tau_s);
  w.X.resize(n, d.X.cols() + 1);
  w.y.resize(n);
  const double base = std::sqrt(1.0 - w.phi * w.phi);
  w.X(0, 0) = base;
  w.X.row(0).tail(d.X.cols()) = base * d.X.row(0);
  w.y[0] = base * (d.y[0] - d.y_mean);
  for (Index i = 1; i < n; ++i) {
    const double gap = d.time_s[i] - d.time_s[i - 1];
    const double phi = std::exp(-gap / noise_tau_s);
    const double scale = base / std::sqrt(1.0 - phi * phi);
    w.X(i, 0) = scale * (1.0 - phi);
    w.X.row(i).tail(d.X.cols()) = scale * (d.X.row(i) - phi * d.X.row(i - 1));
    w.y[i] = scale * ((d.y[i] - d.y_mean) - phi * (d.y[i - 1] - d.y_mean));
  }
  return w;
}

Eigen::VectorXd priorPrecision(const Dictionary& d, const std::vector<Index>& columns, double strength,
                               double slow_preference, const ResponseFitOptions& options) {
  // Gains are dealt with per `typical spread` of a temperature; the factor of the period keeps the balance between data
  // and prior when the same record is binned finer. 90 s and 3000 s are only the units of that balance.
  Eigen::VectorXd precision(static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const Feature& f = d.features[columns[k]];
    const ThermalInput& input = d.inputs[f.input];
    const double typical = isDriven(input.kind) ? d.typical_driven_spread : d.typical_spread;
    double spread = std::sqrt(typical / f.spread) / typical;
    if (isDriven(input.kind)) spread *= options.speed_freedom;
    spread *= std::pow(std::max(f.tau_s, 600.0) / 3000.0, slow_preference);
    precision[static_cast<Index>(k)] = strength * (d.period_s / 90.0) / (spread * spread);
  }
  return precision;
}

}  // namespace spindrift::response
