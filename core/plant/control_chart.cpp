// SPDX-License-Identifier: Apache-2.0
#include "core/plant/control_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/utc_time.h"
#include "core/math/distributions.h"
#include "core/workflows/campaign_series.h"

namespace spindrift {
namespace {

constexpr std::size_t least_points = 8;     // of a stretch that is searched
constexpr std::size_t least_on_a_side = 3;  // of a step: fewer are single values
constexpr int permutations = 999;

/// A stretch of the record: values, weights 1 / (tau^2 + u^2), times.
struct Stretch {
  std::vector<double> y;
  std::vector<double> w;
  std::vector<double> t;
};

struct Best {
  double statistic = 0.0;
  bool drift = false;
  std::size_t place = 0;  ///< first point after the step
};

/// Twice the log of the likelihood ratio of a step at its best place and of a straight drift. A place costs what BIC
/// asks for it, so that the two can be compared.
Best search(const Stretch& s) {
  const std::size_t n = s.y.size();
  double sw = 0.0;
  double sy = 0.0;
  double st = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    sw += s.w[i];
    sy += s.w[i] * s.y[i];
    st += s.w[i] * s.t[i];
  }
  const double mean_t = st / sw;
  double stt = 0.0;
  double sty = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    stt += s.w[i] * (s.t[i] - mean_t) * (s.t[i] - mean_t);
    sty += s.w[i] * (s.t[i] - mean_t) * (s.y[i] - sy / sw);
  }
  Best best;
  best.drift = true;
  best.statistic = stt > 0.0 ? sty * sty / stt : 0.0;
  double left_w = 0.0;
  double left_y = 0.0;
  const double cost = std::log(static_cast<double>(n));
  for (std::size_t k = 1; k < n; ++k) {
    left_w += s.w[k - 1];
    left_y += s.w[k - 1] * s.y[k - 1];
    if (k < least_on_a_side || n - k < least_on_a_side) continue;
    const double difference = (sy - left_y) / (sw - left_w) - left_y / left_w;
    const double ratio = difference * difference * left_w * (sw - left_w) / sw - cost;
    if (ratio > best.statistic) best = {ratio, false, k};
  }
  return best;
}

/// Share of permutations with a statistic at least as large, the record itself among them. Ends early once it cannot
/// become significant.
double permutationPValue(const Stretch& s, double statistic, double alpha, Random random) {
  Stretch shuffled = s;
  int as_large = 1;
  const int hopeless = static_cast<int>(alpha * (permutations + 1)) + 1;
  for (int b = 0; b < permutations; ++b) {
    for (std::size_t i = s.y.size() - 1; i > 0; --i) {
      const auto j = static_cast<std::size_t>(random.index(i + 1));
      std::swap(shuffled.y[i], shuffled.y[j]);
      std::swap(shuffled.w[i], shuffled.w[j]);
    }
    if (search(shuffled).statistic >= statistic && ++as_large > hopeless)
      return static_cast<double>(as_large) / static_cast<double>(b + 2);
  }
  return static_cast<double>(as_large) / static_cast<double>(permutations + 1);
}

/// The event that lies nearest, from one campaign before to one after.
std::string eventBetween(const std::vector<MachineEvent>& events, double from_s, double to_s) {
  for (const MachineEvent& e : events) {
    if (e.time_s < from_s - 1.0 || e.time_s > to_s + 1.0) continue;
    const std::string words = eventWords(e.kind);
    return e.note.empty() ? words : words + " (" + e.note + ")";
  }
  return {};
}

class ChangeSearch {
 public:
  ChangeSearch(const std::vector<TrendPoint>& points, const std::vector<MachineEvent>& events, double tau2,
               const ChartOptions& options)
      : points_(points), events_(events), tau2_(tau2), options_(options) {
    for (const TrendPoint& p : points) values_.push_back(p.value);
  }

  std::vector<NamedChange> run() {
    takeSingleValues();
    look(0, points_.size(), 0);
    std::sort(found_.begin(), found_.end(),
              [](const NamedChange& a, const NamedChange& b) { return a.from_s < b.from_s; });
    return found_;
  }

 private:
  [[nodiscard]] double variance(std::size_t i) const {
    return tau2_ + points_[i].standard_uncertainty * points_[i].standard_uncertainty;
  }

  /// A value that both neighbours disagree with while these agree with each other. Bonferroni over all values.
  void takeSingleValues() {
    for (std::size_t i = 1; i + 1 < values_.size(); ++i) {
      const double between = 0.5 * (values_[i - 1] + values_[i + 1]);
      const double v = variance(i) + 0.25 * (variance(i - 1) + variance(i + 1));
      const double apart = values_[i + 1] - values_[i - 1];
      if (!(v > 0.0) || apart * apart > 9.0 * (variance(i - 1) + variance(i + 1))) continue;
      const double z = (values_[i] - between) / std::sqrt(v);
      const double p = std::min(1.0, 2.0 * normalCdf(-std::abs(z)) * static_cast<double>(values_.size()));
      // A tenth of what is allowed: the scatter is estimated from the same values.
      if (p > 0.1 * options_.alpha) continue;
      found_.push_back({ChangeKind::SingleValue, points_[i].time_s, points_[i].time_s, values_[i] - between,
                        std::sqrt(v), p, eventBetween(events_, points_[i].time_s, points_[i].time_s)});
      values_[i] = between;
    }
  }

  void look(std::size_t from, std::size_t to, int depth) {
    if (to - from < least_points || depth > 12) return;
    Stretch s;
    for (std::size_t i = from; i < to; ++i) {
      s.y.push_back(values_[i]);
      s.w.push_back(1.0 / std::max(variance(i), 1e-300));
      s.t.push_back(points_[i].time_s - points_[from].time_s);
    }
    const Best best = search(s);
    // What the pieces of a stretch are searched for again costs significance: half at each level.
    const double alpha = options_.alpha * std::pow(0.5, std::min(depth, 3));
    const Random random(options_.seed + 7919 * from + 104729 * to);
    const double p = permutationPValue(s, best.statistic, std::max(alpha, 1.0 / (permutations + 1)), random);
    if (p > std::max(alpha, 1.0 / (permutations + 1))) return;
    if (best.drift) {
      takeDrift(s, from, to, p);
      look(from, to, depth + 1);
      return;
    }
    const std::size_t place = from + best.place;
    const auto [left, left_v] = meanOf(from, place);
    const auto [right, right_v] = meanOf(place, to);
    found_.push_back({ChangeKind::Step, points_[place - 1].time_s, points_[place].time_s, right - left,
                      std::sqrt(left_v + right_v), p,
                      eventBetween(events_, points_[place - 1].time_s, points_[place].time_s)});
    look(from, place, depth + 1);
    look(place, to, depth + 1);
  }

  void takeDrift(const Stretch& s, std::size_t from, std::size_t to, double p) {
    double sw = 0.0;
    double st = 0.0;
    double sy = 0.0;
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      sw += s.w[i];
      st += s.w[i] * s.t[i];
      sy += s.w[i] * s.y[i];
    }
    double stt = 0.0;
    double sty = 0.0;
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      stt += s.w[i] * (s.t[i] - st / sw) * (s.t[i] - st / sw);
      sty += s.w[i] * (s.t[i] - st / sw) * (s.y[i] - sy / sw);
    }
    const double slope = sty / stt;
    const double length = s.t.back();
    found_.push_back({ChangeKind::Drift, points_[from].time_s, points_[to - 1].time_s, slope * length,
                      length / std::sqrt(stt), p, ""});
    for (std::size_t i = from; i < to; ++i) values_[i] -= slope * (s.t[i - from] - st / sw);
  }

  [[nodiscard]] std::pair<double, double> meanOf(std::size_t from, std::size_t to) const {
    double sw = 0.0;
    double sy = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      const double w = 1.0 / std::max(variance(i), 1e-300);
      sw += w;
      sy += w * values_[i];
    }
    return {sy / sw, 1.0 / sw};
  }

  const std::vector<TrendPoint>& points_;
  const std::vector<MachineEvent>& events_;
  double tau2_;
  const ChartOptions& options_;
  std::vector<double> values_;
  std::vector<NamedChange> found_;
};

void requireBetween(double value, double low, double high, std::string_view name) {
  if (value >= low && value <= high) return;
  throw InputError(fmt::format("{} {} is not allowed; allowed: {} to {}.", name, value, low, high));
}

}  // namespace

void ChartOptions::validate() const {
  requireBetween(static_cast<double>(baseline), 5.0, 1000.0, "A baseline of");
  requireBetween(shewhart, 1.0, 10.0, "A Shewhart limit of");
  requireBetween(ewma_weight, 0.01, 1.0, "An EWMA weight of");
  requireBetween(ewma_limit, 1.0, 10.0, "An EWMA limit of");
  requireBetween(alpha, 0.001, 0.2, "A significance of");
}

std::string_view toString(ChangeKind kind) noexcept {
  switch (kind) {
    case ChangeKind::Step:
      return "step";
    case ChangeKind::Drift:
      return "drift";
    case ChangeKind::SingleValue:
      return "single_value";
  }
  return "";
}

std::string NamedChange::sentence(std::string_view unit) const {
  const std::string amount = (size > 0.0 ? "+" : "") + withUncertainty(size, standard_uncertainty, unit);
  const std::string chance = p_value <= 1.0 / (permutations + 1) ? "p ≤ 0.001" : fmt::format("p = {:.3f}", p_value);
  const std::string entered = event.empty() ? "" : ", where " + event + " was entered";
  switch (kind) {
    case ChangeKind::Step:
      return fmt::format("step of {} between {} and {} ({}){}", amount, utcDay(from_s), utcDay(to_s), chance, entered);
    case ChangeKind::Drift:
      return fmt::format("drift of {} from {} to {} ({})", amount, utcDay(from_s), utcDay(to_s), chance);
    case ChangeKind::SingleValue:
      return fmt::format("single value off by {} on {} ({}){}", amount, utcDay(from_s), chance, entered);
  }
  return {};
}

double scatterVariance(const std::vector<double>& values, const std::vector<double>& sigma) {
  if (values.size() < 4) return 0.0;
  constexpr double clip = 6.25;
  // E(min(X, 6.25)) for X ~ chi2 with one degree of freedom: P(chi2_3 <= c) + c P(chi2_1 > c).
  static const double expected = chiSquaredCdf(clip, 3.0) + clip * chiSquaredTail(clip, 1.0);
  std::vector<double> d2;
  std::vector<double> u2;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double d = values[i + 1] - values[i];
    d2.push_back(d * d);
    u2.push_back(sigma[i] * sigma[i] + sigma[i + 1] * sigma[i + 1]);
  }
  const auto excess = [&](double tau2) {
    double sum = 0.0;
    for (std::size_t i = 0; i < d2.size(); ++i) {
      const double v = 2.0 * tau2 + u2[i];
      sum += v > 0.0 ? std::min(d2[i] / v, clip) : d2[i] > 0.0 ? clip : 0.0;
    }
    return sum / static_cast<double>(d2.size()) - expected;
  };
  double high = *std::max_element(d2.begin(), d2.end());
  if (excess(0.0) <= 0.0 || high == 0.0) return 0.0;
  double low = 0.0;
  for (int i = 0; i < 200 && high - low > 1e-12 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

ControlChart controlChart(const std::vector<TrendPoint>& points, const std::vector<MachineEvent>& events,
                          const std::string& name, const ChartOptions& options) {
  options.validate();
  ControlChart chart;
  chart.unit = unitOfSignal(name);
  std::vector<double> values;
  std::vector<double> sigma;
  for (const TrendPoint& p : points) {
    values.push_back(p.value);
    sigma.push_back(p.standard_uncertainty);
    chart.points.push_back({p, p.value, p.value, p.value, p.value, p.value, p.value});
  }
  const double tau2 = scatterVariance(values, sigma);
  chart.scatter = std::sqrt(tau2);
  if (points.size() >= least_points && tau2 + *std::max_element(sigma.begin(), sigma.end()) > 0.0) {
    chart.changes = ChangeSearch(points, events, tau2, options).run();
  } else if (points.size() < least_points) {
    chart.notes.push_back(fmt::format("{} values: changes are looked for from {} on.", points.size(), least_points));
  }
  // Stretches of one machine: each begins after an event that makes it another one.
  std::vector<std::size_t> begins{0};
  for (const MachineEvent& e : events) {
    if (!changesMachine(e.kind)) continue;
    const auto at =
        static_cast<std::size_t>(std::lower_bound(points.begin(), points.end(), e.time_s,
                                                  [](const TrendPoint& p, double t) { return p.time_s < t; }) -
                                 points.begin());
    if (at > begins.back() && at < points.size()) begins.push_back(at);
  }
  begins.push_back(points.size());
  for (std::size_t b = 0; b + 1 < begins.size(); ++b) {
    const std::size_t from = begins[b];
    const std::size_t to = begins[b + 1];
    const std::size_t end = std::min(to, from + options.baseline);
    if (end - from < 5) {
      if (b + 2 == begins.size() && to > from)
        chart.notes.push_back(to - from == 1 ? fmt::format("One value since {}: control limits begin with the fifth.",
                                                           utcDay(points[from].time_s))
                                             : fmt::format("{} values since {}: control limits begin with the fifth.",
                                                           to - from, utcDay(points[from].time_s)));
      continue;
    }
    chart.limits = chart.limits || b + 2 == begins.size();
    double sw = 0.0;
    double sy = 0.0;
    for (std::size_t i = from; i < end; ++i) {
      const double w = 1.0 / std::max(tau2 + sigma[i] * sigma[i], 1e-300);
      sw += w;
      sy += w * values[i];
    }
    const double centre = sy / sw;
    double ewma = 0.0;
    double ewma_variance = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      ChartPoint& p = chart.points[i];
      // The level is taken from the points of the baseline themselves: less certain for the others.
      const double sd = std::sqrt(tau2 + sigma[i] * sigma[i] + (i < end ? 0.0 : 1.0 / sw));
      const double z = sd > 0.0 ? (values[i] - centre) / sd : 0.0;
      ewma = options.ewma_weight * z + (1.0 - options.ewma_weight) * ewma;
      ewma_variance = options.ewma_weight * options.ewma_weight +
                      (1.0 - options.ewma_weight) * (1.0 - options.ewma_weight) * ewma_variance;
      p.baseline = i < end;
      p.centre = centre;
      p.lower = centre - options.shewhart * sd;
      p.upper = centre + options.shewhart * sd;
      p.ewma = centre + ewma * sd;
      p.ewma_lower = centre - options.ewma_limit * std::sqrt(ewma_variance) * sd;
      p.ewma_upper = centre + options.ewma_limit * std::sqrt(ewma_variance) * sd;
      p.outside = std::abs(z) > options.shewhart;
      p.ewma_outside = std::abs(ewma) > options.ewma_limit * std::sqrt(ewma_variance);
    }
  }
  return chart;
}

bool ControlChart::inControl() const {
  return points.empty() || (!points.back().outside && !points.back().ewma_outside);
}

nlohmann::json ControlChart::json() const {
  nlohmann::json out = {{"unit", unit},
                        {"scatter", jsonNumber(scatter)},
                        {"limits", limits},
                        {"in_control", inControl()},
                        {"points", nlohmann::json::array()},
                        {"changes", nlohmann::json::array()},
                        {"notes", notes}};
  for (const ChartPoint& p : points) {
    out["points"].push_back({{"campaign", p.point.campaign},
                             {"name", p.point.campaign_name},
                             {"time_utc", utcText(p.point.time_s)},
                             {"value", jsonNumber(p.point.value)},
                             {"standard_uncertainty", jsonNumber(p.point.standard_uncertainty)},
                             {"centre", jsonNumber(p.centre)},
                             {"lower", jsonNumber(p.lower)},
                             {"upper", jsonNumber(p.upper)},
                             {"ewma", jsonNumber(p.ewma)},
                             {"ewma_lower", jsonNumber(p.ewma_lower)},
                             {"ewma_upper", jsonNumber(p.ewma_upper)},
                             {"baseline", p.baseline},
                             {"outside", p.outside},
                             {"ewma_outside", p.ewma_outside}});
  }
  for (const NamedChange& c : changes) {
    out["changes"].push_back({{"kind", toString(c.kind)},
                              {"from_utc", utcText(c.from_s)},
                              {"to_utc", utcText(c.to_s)},
                              {"size", jsonNumber(c.size)},
                              {"standard_uncertainty", jsonNumber(c.standard_uncertainty)},
                              {"p_value", c.p_value},
                              {"event", c.event.empty() ? nlohmann::json() : nlohmann::json(c.event)},
                              {"sentence", c.sentence(unit)}});
  }
  return out;
}

}  // namespace spindrift
