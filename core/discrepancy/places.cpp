// SPDX-License-Identifier: Apache-2.0
// Where and when a residual is larger than noise allows. Every place looked at (a span of time over all points of a
// component, one point, a part of the volume, an operating condition) is scored by the likelihood ratio of "power v
// inside, noise outside",
//
//   L = n / 2 (v - 1 - ln v), v > 1 = mean square of the whitened residual, n = its degrees of freedom,
//
// and judged by the distribution of the largest L over all places: the same scan on drawn noise, with a Gumbel tail
// fitted to the maxima. The residual is whitened, so that noise that is correlated in time counts as what it is.
// Sources: Kulldorff 1997 (scan statistics); Gumbel 1958.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/printed_number.h"
#include "core/base/random.h"
#include "core/discrepancy/drivers.h"
#include "core/discrepancy/places.h"

namespace spindrift {
namespace {

using Eigen::Index;

constexpr int replicates = 80;
constexpr double level = 0.01;
constexpr std::size_t most_spans = 3;

double likelihoodRatio(double power, double degrees) {
  if (!(degrees >= 2.0)) return 0.0;
  const double v = power / degrees;
  return v > 1.0 ? 0.5 * degrees * (v - 1.0 - std::log(v)) : 0.0;
}

/// Units of one component that have something in common.
struct Group {
  Component component = Component::EX;
  std::string point;      // one point
  std::string condition;  // or a condition, with its opposite beside it
  std::vector<Index> units;
  std::vector<Index> others;
};

struct Span {
  int first = 0;  // bins of time
  int last = 0;
  double ratio = 0.0;
};

/// All that is looked at, and how a residual scores there.
class Scan {
 public:
  Scan(const ResidualProblem& problem, const DriverTable& drivers) : problem_(&problem) {
    const auto n = static_cast<double>(problem.size());
    dof_part_ = std::clamp(static_cast<double>(problem.degreesOfFreedom()) / std::max(1.0, n), 0.3, 1.0);
    ones_ = problem.whitened(Eigen::VectorXd::Ones(problem.size())).col(0);
    bins_ = std::clamp(problem.epoch_count, 1, 36);
    for (Index u = 0; u < problem.size(); ++u) {
      bin_.push_back(problem.epoch[static_cast<std::size_t>(u)] * bins_ / std::max(1, problem.epoch_count));
    }
    addPoints();
    addRegions();
    addConditions(drivers);
  }

  /// The free constant of every series moved so that most of its readings, not their mean, are where they should be:
  /// what deviates for a while must not make the rest deviate the other way.
  [[nodiscard]] Eigen::VectorXd onBaseline(Eigen::VectorXd z) const {
    if (!problem_->free_constants) return z;
    std::vector<std::pair<double, double>> slope;  // constant that brings a reading to zero, and its weight
    for (int s = 0; s < problem_->seriesCount(); ++s) {
      const Index from = problem_->series_begin[static_cast<std::size_t>(s)];
      const Index to = problem_->series_begin[static_cast<std::size_t>(s) + 1];
      slope.clear();
      double total = 0.0;
      for (Index u = from; u < to; ++u) {
        if (std::abs(ones_[u]) < 1e-9) continue;
        slope.emplace_back(z[u] / ones_[u], std::abs(ones_[u]));
        total += std::abs(ones_[u]);
      }
      std::sort(slope.begin(), slope.end());
      double sum = 0.0;
      for (const auto& [constant, weight] : slope) {
        sum += weight;
        if (sum < 0.5 * total) continue;
        z.segment(from, to - from) -= constant * ones_.segment(from, to - from);
        break;
      }
    }
    return z;
  }

  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  [[nodiscard]] const std::vector<int>& bin() const { return bin_; }

  [[nodiscard]] double power(const Eigen::VectorXd& z, const std::vector<Index>& units) const {
    double sum = 0.0;
    for (const Index u : units) sum += z[u] * z[u];
    return sum;
  }
  [[nodiscard]] double ratio(const Eigen::VectorXd& z, const std::vector<Index>& units) const {
    return likelihoodRatio(power(z, units), dof_part_ * static_cast<double>(units.size()));
  }

  /// The disjoint spans of bins in which a component deviates: those that together have the largest ratio, each less
  /// `price`. Spans that touch are one.
  [[nodiscard]] std::vector<Span> spans(const Eigen::VectorXd& z, Component c, double price) const {
    const Cumulated of = cumulated(z, c);
    const auto n = static_cast<std::size_t>(bins_);
    std::vector<double> best(n + 1, 0.0);
    std::vector<int> start(n + 1, -1);  // of a span that ends before this bin
    for (std::size_t end = 1; end <= n; ++end) {
      best[end] = best[end - 1];
      for (std::size_t first = 0; first < end; ++first) {
        const double value = best[first] + of.ratio(first, end) - price;
        if (!(value > best[end])) continue;
        best[end] = value;
        start[end] = static_cast<int>(first);
      }
    }
    std::vector<Span> out;
    for (std::size_t end = n; end > 0;) {
      if (start[end] < 0) {
        --end;
        continue;
      }
      const auto first = static_cast<std::size_t>(start[end]);
      if (!out.empty() && out.back().first == static_cast<int>(end)) {
        out.back().first = start[end];
      } else {
        out.push_back({start[end], static_cast<int>(end) - 1, 0.0});
      }
      end = first;
    }
    for (Span& span : out) {
      span.ratio = of.ratio(static_cast<std::size_t>(span.first), static_cast<std::size_t>(span.last) + 1);
    }
    std::sort(out.begin(), out.end(), [](const Span& x, const Span& y) { return x.ratio > y.ratio; });
    return out;
  }

  /// The largest ratio of any span of a component.
  [[nodiscard]] double largestSpan(const Eigen::VectorXd& z, Component c) const {
    const Cumulated of = cumulated(z, c);
    double out = 0.0;
    for (std::size_t first = 0; first < static_cast<std::size_t>(bins_); ++first) {
      for (std::size_t end = first + 1; end <= static_cast<std::size_t>(bins_); ++end) {
        out = std::max(out, of.ratio(first, end));
      }
    }
    return out;
  }

  [[nodiscard]] double largest(const Eigen::VectorXd& z) const {
    double out = 0.0;
    for (const Component c : all_components) out = std::max(out, largestSpan(z, c));
    for (const Group& g : groups_) out = std::max(out, ratio(z, g.units));
    return out;
  }

  /// um or urad beyond the noise.
  [[nodiscard]] double excess(const Eigen::VectorXd& z, const std::vector<Index>& units) const {
    double sum = 0.0;
    for (const Index u : units) {
      const double s = problem_->sigma[u] * problem_->noise.of(problem_->component[static_cast<std::size_t>(u)]).scale;
      sum += (z[u] * z[u] - dof_part_) * s * s;
    }
    return units.empty() ? 0.0 : std::sqrt(std::max(0.0, sum / static_cast<double>(units.size())));
  }

  /// Distribution of the largest ratio when there is only noise.
  struct Null {
    double location = 0.0;
    double scale = 1.0;
    [[nodiscard]] double critical() const { return location - scale * std::log(-std::log1p(-level)); }
    [[nodiscard]] double p(double ratio) const { return -std::expm1(-std::exp(-(ratio - location) / scale)); }
  };
  [[nodiscard]] Null noiseAlone() const {
    Random random(20260211);
    const double size = std::sqrt(dof_part_);
    Eigen::VectorXd z(problem_->size());
    double mean = 0.0;
    double square = 0.0;
    for (int r = 0; r < replicates; ++r) {
      for (double& value : z) value = size * random.normal();
      const double value = largest(onBaseline(z));
      mean += value / replicates;
      square += value * value / replicates;
    }
    const double spread = std::sqrt(std::max(1e-12, (square - mean * mean) * replicates / (replicates - 1.0)));
    Null out;
    out.scale = std::sqrt(6.0) / std::numbers::pi * spread;
    out.location = mean - std::numbers::egamma * out.scale;
    return out;
  }

 private:
  struct Cumulated {
    std::vector<double> power;
    std::vector<double> degrees;
    [[nodiscard]] double ratio(std::size_t first, std::size_t end) const {
      return likelihoodRatio(power[end] - power[first], degrees[end] - degrees[first]);
    }
  };
  [[nodiscard]] Cumulated cumulated(const Eigen::VectorXd& z, Component c) const {
    Cumulated out{std::vector<double>(static_cast<std::size_t>(bins_) + 1, 0.0), {}};
    out.degrees = out.power;
    for (Index u = 0; u < z.size(); ++u) {
      const auto i = static_cast<std::size_t>(u);
      if (problem_->component[i] != c) continue;
      out.power[static_cast<std::size_t>(bin_[i]) + 1] += z[u] * z[u];
      out.degrees[static_cast<std::size_t>(bin_[i]) + 1] += dof_part_;
    }
    for (std::size_t b = 1; b < out.power.size(); ++b) {
      out.power[b] += out.power[b - 1];
      out.degrees[b] += out.degrees[b - 1];
    }
    return out;
  }

  void add(Component c, const std::string& point, const std::string& condition, auto&& in) {
    Group g{c, point, condition, {}, {}};
    for (Index u = 0; u < problem_->size(); ++u) {
      if (problem_->component[static_cast<std::size_t>(u)] == c) (in(u) ? g.units : g.others).push_back(u);
    }
    if (g.units.size() >= 4) groups_.push_back(std::move(g));
  }

  void addPoints() {
    for (int s = 0; s < problem_->seriesCount(); ++s) {
      const auto from = static_cast<std::size_t>(problem_->series_begin[static_cast<std::size_t>(s)]);
      add(problem_->component[from], problem_->series_point[static_cast<std::size_t>(s)], "",
          [&](Index u) { return problem_->series[static_cast<std::size_t>(u)] == s; });
    }
  }

  /// Both sides of four planes across every axis.
  void addRegions() {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const DeviationQuery& q : problem_->place) values.push_back(q.position_mm[axis]);
      std::sort(values.begin(), values.end());
      if (values.empty() || !(values.back() - values.front() > 1.0)) continue;
      const double low = values.front();
      const double span = values.back() - low;
      for (const double part : {0.2, 0.4, 0.6, 0.8}) {
        const double plane = low + part * span;
        for (const bool above : {true, false}) {
          for (const Component c : all_components) {
            const std::string side = above ? fmt::format("{} above {:.0f} mm", "xyz"[axis], printed(plane))
                                           : fmt::format("{} below {:.0f} mm", "xyz"[axis], printed(plane));
            add(c, "", side, [&](Index u) {
              return (problem_->place[static_cast<std::size_t>(u)].position_mm[axis] > plane) == above;
            });
          }
        }
      }
    }
  }

  void addConditions(const DriverTable& drivers) {
    struct Switch {
      const char* driver;
      const char* on;
      const char* off;
    };
    for (const auto& [name, on_text, off_text] :
         {Switch{"spindle_rpm^1", "spindle turning", "spindle at rest"}, Switch{"coolant", "coolant on", "coolant off"},
          Switch{"feed_x", "X moving", "X at rest"}, Switch{"feed_y", "Y moving", "Y at rest"},
          Switch{"feed_z", "Z moving", "Z at rest"}, Switch{"speed_c", "C turning", "C at rest"}}) {
      const Driver* driver = drivers.find(name);
      if (driver == nullptr) continue;
      const Eigen::VectorXd on = problem_->toUnits(drivers.response(*driver, 0.0, -1.0, problem_->node_time_s));
      for (const Component c : all_components) {
        add(c, "", on_text, [&](Index u) { return on[u] > 0.0; });
        add(c, "", off_text, [&](Index u) { return !(on[u] > 0.0); });
      }
    }
  }

  const ResidualProblem* problem_;
  double dof_part_ = 1.0;
  int bins_ = 1;
  Eigen::VectorXd ones_;  // whitened
  std::vector<int> bin_;
  std::vector<Group> groups_;
};

DisagreementPlace placeOf(const ResidualProblem& problem, const Scan& scan, const Eigen::VectorXd& z,
                          const std::vector<Index>& units, double p) {
  DisagreementPlace d;
  d.component = problem.component[static_cast<std::size_t>(units.front())];
  d.p_value = p;
  d.excess_um = scan.excess(z, units);
  d.from_s = 1e300;
  d.to_s = -1e300;
  for (const Index u : units) {
    d.from_s = std::min(d.from_s, problem.time_s[static_cast<std::size_t>(u)]);
    d.to_s = std::max(d.to_s, problem.time_s[static_cast<std::size_t>(u)]);
    const std::string& point = problem.place[static_cast<std::size_t>(u)].point;
    if (std::find(d.points.begin(), d.points.end(), point) == d.points.end()) d.points.push_back(point);
  }
  return d;
}

/// The spans of time of one component, the clearest first, with the points that deviate in them.
void addSpans(const ResidualProblem& problem, const Scan& scan, const Scan::Null& null, const Eigen::VectorXd& z,
              Component c, std::vector<DisagreementPlace>& out) {
  for (const Span& span : scan.spans(z, c, null.critical())) {
    if (out.size() >= most_spans) return;
    std::vector<Index> all;
    std::vector<Index> deviating;
    for (int s = 0; s < problem.seriesCount(); ++s) {
      std::vector<Index> units;
      for (Index u = problem.series_begin[static_cast<std::size_t>(s)];
           u < problem.series_begin[static_cast<std::size_t>(s) + 1]; ++u) {
        const auto i = static_cast<std::size_t>(u);
        if (problem.component[i] == c && scan.bin()[i] >= span.first && scan.bin()[i] <= span.last) units.push_back(u);
      }
      all.insert(all.end(), units.begin(), units.end());
      if (null.p(scan.ratio(z, units)) < level) deviating.insert(deviating.end(), units.begin(), units.end());
    }
    out.push_back(placeOf(problem, scan, z, deviating.empty() ? all : deviating, null.p(span.ratio)));
  }
}

/// The region, or the condition, in which a component deviates clearly more than elsewhere.
void addContrast(const ResidualProblem& problem, const Scan& scan, const Scan::Null& null, const Eigen::VectorXd& z,
                 Component c, bool region, std::vector<DisagreementPlace>& out) {
  const Group* best = nullptr;
  double best_ratio = 0.0;
  for (const Group& g : scan.groups()) {
    const bool is_region = g.condition.ends_with(" mm");
    if (g.component != c || g.condition.empty() || is_region != region || g.others.size() < 4) continue;
    if (!(scan.excess(z, g.units) > 1.5 * scan.excess(z, g.others))) continue;
    const double ratio = scan.ratio(z, g.units);
    if (!(ratio > best_ratio)) continue;
    best = &g;
    best_ratio = ratio;
  }
  if (best == nullptr || !(null.p(best_ratio) < level)) return;
  out.push_back(placeOf(problem, scan, z, best->units, null.p(best_ratio)));
  out.back().condition = best->condition;
}

}  // namespace

std::vector<DisagreementPlace> findPlaces(const ResidualProblem& problem, const DriverTable& drivers,
                                          const Eigen::VectorXd& residual) {
  std::vector<DisagreementPlace> out;
  if (problem.size() < 8) return out;
  const Scan scan(problem, drivers);
  const Eigen::VectorXd z = scan.onBaseline(residual);
  const Scan::Null null = scan.noiseAlone();
  for (const Component c : all_components) {
    std::vector<DisagreementPlace> found;
    addSpans(problem, scan, null, z, c, found);
    // A point may deviate all the time, too little for any span of all points.
    for (const Group& g : scan.groups()) {
      if (g.component != c || g.point.empty() || !(null.p(scan.ratio(z, g.units)) < level)) continue;
      const bool listed = std::any_of(found.begin(), found.end(), [&](const DisagreementPlace& d) {
        return std::find(d.points.begin(), d.points.end(), g.point) != d.points.end();
      });
      if (!listed) found.push_back(placeOf(problem, scan, z, g.units, null.p(scan.ratio(z, g.units))));
    }
    if (!found.empty()) {
      addContrast(problem, scan, null, z, c, true, found);
      addContrast(problem, scan, null, z, c, false, found);
    }
    out.insert(out.end(), found.begin(), found.end());
  }
  // Times first, then the parts of the volume and the conditions.
  std::stable_sort(out.begin(), out.end(), [](const DisagreementPlace& a, const DisagreementPlace& b) {
    if (a.condition.empty() != b.condition.empty()) return a.condition.empty();
    return a.p_value < b.p_value;
  });
  return out;
}

}  // namespace spindrift
