// SPDX-License-Identifier: Apache-2.0
#include "core/probing/cycle_studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/math/statistics.h"

namespace spindrift {

void RepeatabilityOptions::validate() const {
  if (high_pass_cycles < 3 || high_pass_cycles % 2 == 0) {
    throw InputError(
        fmt::format("a high-pass over {} cycles is not allowed; allowed: an odd number from 3.", high_pass_cycles));
  }
  if (!(coverage_factor > 0.0)) throw InputError("the coverage factor must be positive.");
}

RepeatabilityStudy studyRepeatability(const CycleEvaluation& evaluation, const RepeatabilityOptions& options) {
  options.validate();
  RepeatabilityStudy study;
  const int half = options.high_pass_cycles / 2;
  const auto length = static_cast<double>(options.high_pass_cycles);
  study.status = FitStatus::Converged;
  study.message = "done";
  for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
    std::vector<double> values;
    double own = 0.0;
    for (std::size_t k = 0; k < evaluation.cycles.size(); ++k) {
      if (static_cast<int>(k) == evaluation.problem.reference_cycle || !evaluation.parameters[k][p].determined)
        continue;
      values.push_back(evaluation.parameters[k][p].value);
      const auto e = static_cast<Eigen::Index>(p);
      own += evaluation.fit.cycles[k].own_covariance(e, e) * evaluation.unit[p] * evaluation.unit[p];
    }
    const int n = static_cast<int>(values.size());
    if (n < 2 * options.high_pass_cycles) {
      study.status = FitStatus::Degenerate;
      study.message = fmt::format("{} cycles are too few for a high-pass over {} cycles; allowed: at least {}", n,
                                  options.high_pass_cycles, 2 * options.high_pass_cycles);
      study.parameters.clear();
      return study;
    }
    double squares = 0.0;
    int count = 0;
    for (int k = half; k < n - half; ++k) {
      double mean_here = 0.0;
      for (int j = k - half; j <= k + half; ++j) mean_here += values[static_cast<std::size_t>(j)] / length;
      const double r = values[static_cast<std::size_t>(k)] - mean_here;
      squares += r * r;
      ++count;
    }
    Repeatability r;
    r.name = evaluation.names[p];
    r.cycles = n;
    // Variance of x - running mean for white noise: sigma^2 (1 - 1/length).
    r.repeatability = options.coverage_factor * std::sqrt(squares / count / (1.0 - 1.0 / length));
    r.standard_uncertainty = r.repeatability / std::sqrt(2.0 * count * (1.0 - 1.0 / length));
    r.expected = options.coverage_factor * std::sqrt(own / n);
    study.parameters.push_back(r);
  }
  return study;
}

namespace {

/// Straight line with errors in both coordinates (York), then what it says of probe and reference.
void judgeReference(ReferenceComparison& comparison, const std::vector<double>& probe_sigma,
                    const std::vector<double>& reference_sigma) {
  const auto& points = comparison.points;
  const std::size_t n = points.size();
  constexpr double gain_tolerance = 0.05;
  double low = points.front().reference, high = low, weights = 0.0;
  std::vector<double> sy2(n), sx2(n);
  for (std::size_t i = 0; i < n; ++i) {
    low = std::min(low, points[i].reference);
    high = std::max(high, points[i].reference);
    sx2[i] = reference_sigma[i] * reference_sigma[i];
    sy2[i] = probe_sigma[i] * probe_sigma[i];
  }
  // Without uncertainties all points count alike, and their scatter tells the uncertainty.
  const bool stated =
      std::all_of(points.begin(), points.end(), [](const auto& p) { return p.standard_uncertainty > 0.0; });
  if (!stated) {
    std::fill(sy2.begin(), sy2.end(), 1.0);
    std::fill(sx2.begin(), sx2.end(), 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) weights += 1.0 / (sy2[i] + sx2[i]);
  comparison.offset_sigma = std::sqrt(1.0 / weights);
  comparison.slope = comparison.slope_sigma = std::nan("");
  if (!(high > low)) {
    comparison.verdict = "the reference does not move: the gain cannot be compared";
    return;
  }
  double slope = 1.0, squares = 0.0, left = 0.0, sigma2 = 0.0;
  for (int pass = 0; pass < 50; ++pass) {
    double sum = 0.0, mean_x = 0.0, mean_y = 0.0;
    std::vector<double> w(n), beta(n);
    for (std::size_t i = 0; i < n; ++i) {
      w[i] = 1.0 / (sy2[i] + slope * slope * sx2[i]);
      sum += w[i];
      mean_x += w[i] * points[i].reference;
      mean_y += w[i] * points[i].probe;
    }
    mean_x /= sum;
    mean_y /= sum;
    double above = 0.0, below = 0.0, mean_beta = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double u = points[i].reference - mean_x, v = points[i].probe - mean_y;
      beta[i] = w[i] * (u * sy2[i] + slope * v * sx2[i]);
      above += w[i] * beta[i] * v;
      below += w[i] * beta[i] * u;
      mean_beta += w[i] * beta[i] / sum;
    }
    if (!(std::abs(below) > 0.0)) break;
    const double last = std::exchange(slope, above / below);
    squares = left = 0.0;
    double spread = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double r = points[i].probe - mean_y - slope * (points[i].reference - mean_x);
      squares += w[i] * r * r;
      left += r * r / static_cast<double>(n);
      spread += w[i] * (beta[i] - mean_beta) * (beta[i] - mean_beta);
    }
    sigma2 = 1.0 / spread;
    if (std::abs(slope - last) < 1e-12 * (1.0 + std::abs(slope))) break;
  }
  const auto freedom = static_cast<double>(n) - 2.0;
  const double factor = stated ? std::max(1.0, squares / freedom) : squares / freedom;
  comparison.slope = slope;
  comparison.slope_sigma = std::sqrt(sigma2 * factor);
  if (!stated) comparison.offset_sigma *= std::sqrt(factor);
  comparison.line_rms = std::sqrt(left);
  const double deviation = std::abs(slope - 1.0);
  const bool course = comparison.line_rms > gain_tolerance * (high - low) &&
                      (!stated || squares > freedom + 4.0 * std::sqrt(2.0 * freedom));
  constexpr double telling_cycles = 4.0;
  if (slope + 2.6 * comparison.slope_sigma < 0.0) {
    comparison.differs = true;
    comparison.verdict = "the sign differs: the probe shows less where the reference shows more";
  } else if (deviation > gain_tolerance && deviation > 2.6 * comparison.slope_sigma) {
    comparison.differs = true;
    comparison.verdict =
        fmt::format("the gain differs: the probe shows {:.0f} % of what the reference shows", 100.0 * slope);
  } else if (course) {
    comparison.differs = true;
    comparison.verdict =
        fmt::format("the time histories differ: {:.3g} rms about a straight line", comparison.line_rms);
  } else if (stated && static_cast<double>(comparison.judged) >= telling_cycles && comparison.within_two_sigma < 0.5) {
    comparison.differs = true;
    comparison.verdict = fmt::format("they differ beyond their uncertainty in {:.0f} % of the cycles",
                                     100.0 * (1.0 - comparison.within_two_sigma));
  } else if (!(2.0 * comparison.slope_sigma <= 0.2)) {
    comparison.verdict = "the reference moves too little to compare the gain";
  } else {
    comparison.agrees = true;
    comparison.verdict = "probe and reference agree";
  }
}

}  // namespace

ReferenceComparison compareWithReference(const CycleEvaluation& evaluation, const std::string& parameter,
                                         const std::filesystem::path& reference_csv) {
  const auto found = std::find(evaluation.names.begin(), evaluation.names.end(), parameter);
  if (found == evaluation.names.end()) {
    throw InputError(
        fmt::format("parameter \"{}\" is not known; allowed: {}.", parameter, joinedList(evaluation.names, "or")));
  }
  const auto p = static_cast<std::size_t>(found - evaluation.names.begin());
  const CsvTable table = CsvTable::read(reference_csv);
  const std::vector<double> time = table.numbers("time_s");
  const std::vector<double> value = table.numbers("value");
  const std::vector<double> sigma =
      table.hasColumn("sigma") ? table.numbers("sigma") : std::vector<double>(time.size(), 0.0);
  if (time.size() < 2) throw InputError({reference_csv, ""}, "holds fewer than two rows; allowed: a record over time.");
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (!(time[i] > time[i - 1])) {
      throw InputError(
          table.place(i, table.column("time_s")),
          fmt::format("time runs backwards from {} s to {} s; allowed: rows in order of time.", time[i - 1], time[i]));
    }
  }
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    if (!(sigma[i] >= 0.0)) {
      throw InputError(table.place(i, table.column("sigma")),
                       fmt::format("a standard uncertainty of {:g}; allowed: 0 or more.", sigma[i]));
    }
  }
  ReferenceComparison comparison;
  comparison.name = parameter;
  std::vector<double> probe_sigma;
  std::vector<double> reference_sigmas;
  for (std::size_t k = 0; k < evaluation.cycles.size(); ++k) {
    const double t = evaluation.cycle_time_s[k];
    const CycleParameter& q = evaluation.parameters[k][p];
    if (!q.determined || t < time.front() || t > time.back()) continue;
    auto next = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin());
    next = std::max<std::size_t>(next, 1);
    const double f = (t - time[next - 1]) / (time[next] - time[next - 1]);
    ReferenceComparison::Point point;
    point.time_s = t;
    point.probe = q.value;
    point.reference = value[next - 1] + f * (value[next] - value[next - 1]);
    const double reference_sigma = std::max(sigma[next - 1], sigma[next]);
    point.standard_uncertainty = std::hypot(q.standard_uncertainty, reference_sigma);
    comparison.points.push_back(point);
    probe_sigma.push_back(q.standard_uncertainty);
    reference_sigmas.push_back(reference_sigma);
  }
  if (comparison.points.size() < 3) {
    comparison.status = FitStatus::Degenerate;
    comparison.message = fmt::format(
        "{} cycles fall into the record of the reference instrument; at least 3 are needed", comparison.points.size());
    return comparison;
  }
  const auto n = static_cast<double>(comparison.points.size());
  for (const auto& point : comparison.points) comparison.offset += (point.probe - point.reference) / n;
  std::vector<double> probe;
  std::vector<double> reference;
  std::vector<double> difference;
  std::size_t inside = 0;
  for (auto& point : comparison.points) {
    point.reference += comparison.offset;
    point.difference = point.probe - point.reference;
    if (point.standard_uncertainty > 0.0) {
      ++comparison.judged;
      if (std::abs(point.difference) <= 2.0 * point.standard_uncertainty) ++inside;
    }
    comparison.largest = std::max(comparison.largest, std::abs(point.difference));
    probe.push_back(point.probe);
    reference.push_back(point.reference);
    difference.push_back(point.difference);
  }
  comparison.rms = rootMeanSquare(difference);
  comparison.within_two_sigma =
      comparison.judged > 0 ? static_cast<double>(inside) / static_cast<double>(comparison.judged) : std::nan("");
  comparison.fit_percent = fitPercent(reference, probe);
  const double mean_probe = mean(probe);
  const double mean_reference = mean(reference);
  double cross = 0.0;
  for (std::size_t i = 0; i < probe.size(); ++i) cross += (probe[i] - mean_probe) * (reference[i] - mean_reference);
  const double spread = standardDeviation(probe) * standardDeviation(reference) * (n - 1.0);
  comparison.correlation = spread > 0.0 ? cross / spread : 0.0;
  comparison.status = FitStatus::Converged;
  comparison.message = "done";
  judgeReference(comparison, probe_sigma, reference_sigmas);
  return comparison;
}

namespace {

struct Split {
  std::vector<std::size_t> first;  // start of each group
  double squares = std::numeric_limits<double>::infinity();
};

/// Best split of sorted values into groups of least squares about their means (dynamic programming).
Split bestSplit(const std::vector<double>& x, std::size_t groups) {
  const std::size_t n = x.size();
  std::vector<double> sum(n + 1, 0.0);
  std::vector<double> sum2(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    sum[i + 1] = sum[i] + x[i];
    sum2[i + 1] = sum2[i] + x[i] * x[i];
  }
  const auto cost = [&](std::size_t a, std::size_t b) {  // [a, b)
    const double s = sum[b] - sum[a];
    return sum2[b] - sum2[a] - s * s / static_cast<double>(b - a);
  };
  std::vector<std::vector<double>> best(groups + 1,
                                        std::vector<double>(n + 1, std::numeric_limits<double>::infinity()));
  std::vector<std::vector<std::size_t>> from(groups + 1, std::vector<std::size_t>(n + 1, 0));
  best[0][0] = 0.0;
  for (std::size_t g = 1; g <= groups; ++g) {
    for (std::size_t b = g; b <= n; ++b) {
      for (std::size_t a = g - 1; a < b; ++a) {
        const double c = best[g - 1][a] + cost(a, b);
        if (c < best[g][b]) {
          best[g][b] = c;
          from[g][b] = a;
        }
      }
    }
  }
  Split split;
  split.squares = best[groups][n];
  split.first.resize(groups);
  std::size_t end = n;
  for (std::size_t g = groups; g > 0; --g) {
    split.first[g - 1] = from[g][end];
    end = from[g][end];
  }
  return split;
}

/// Mean silhouette of a split of sorted values.
double silhouette(const std::vector<double>& x, const Split& split) {
  const std::size_t n = x.size();
  std::vector<std::size_t> group(n, 0);
  for (std::size_t g = 0; g < split.first.size(); ++g) {
    for (std::size_t i = split.first[g]; i < n; ++i) group[i] = g;
  }
  double total = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> sum(split.first.size(), 0.0);
    std::vector<int> count(split.first.size(), 0);
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      sum[group[j]] += std::abs(x[i] - x[j]);
      ++count[group[j]];
    }
    if (count[group[i]] == 0) continue;  // a group of one counts zero
    const double own = sum[group[i]] / count[group[i]];
    double other = std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < sum.size(); ++g) {
      if (g != group[i] && count[g] > 0) other = std::min(other, sum[g] / count[g]);
    }
    if (std::max(own, other) > 0.0) total += (other - own) / std::max(own, other);
  }
  return total / static_cast<double>(n);
}

}  // namespace

std::vector<SensorGroup> groupSensors(const OperatingLog& log, int count) {
  struct Sensor {
    double change;
    std::string name;
  };
  std::vector<Sensor> sensors;
  for (const std::string& name : log.temperatureNames()) {
    const std::vector<double>& values = *log.signal(name);
    if (values.empty()) continue;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    sensors.push_back({*high - *low, name});
  }
  std::vector<SensorGroup> groups;
  if (sensors.empty()) throw InputError("the log holds no temperature; allowed: columns named T_<name>_degC.");
  std::sort(sensors.begin(), sensors.end(), [](const Sensor& a, const Sensor& b) { return a.change > b.change; });
  std::vector<double> x;
  for (const Sensor& s : sensors) x.push_back(s.change);
  if (count < 0 || count > static_cast<int>(sensors.size())) {
    throw InputError(fmt::format("{} groups of {} temperatures are not possible; allowed: 1 to {}.", count,
                                 sensors.size(), sensors.size()));
  }
  Split split;
  if (count > 0) {
    split = bestSplit(x, static_cast<std::size_t>(count));
  } else {
    double best = -1.0;
    split = bestSplit(x, 1);
    for (std::size_t g = 2; g <= std::min<std::size_t>(5, sensors.size() - 1); ++g) {
      const Split candidate = bestSplit(x, g);
      const double s = silhouette(x, candidate);
      if (s > best + 1e-9) {
        best = s;
        split = candidate;
      }
    }
  }
  const std::size_t n = split.first.size();
  for (std::size_t g = 0; g < n; ++g) {
    SensorGroup group;
    const std::size_t end = g + 1 < n ? split.first[g + 1] : sensors.size();
    for (std::size_t i = split.first[g]; i < end; ++i) group.sensors.push_back(sensors[i].name);
    group.largest_change_K = sensors[split.first[g]].change;
    group.smallest_change_K = sensors[end - 1].change;
    constexpr const char* three[] = {"large", "medium", "little"};
    group.label = n == 3 ? three[g] : fmt::format("group {}", g + 1);
    groups.push_back(group);
  }
  return groups;
}

}  // namespace spindrift
