// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/warm_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/machine/driver_words.h"
#include "core/math/distributions.h"
#include "core/math/least_squares.h"

namespace spindrift {
namespace {

struct Series {
  Eigen::VectorXd time_s;
  Eigen::VectorXd value_um;
  Eigen::VectorXd sigma_um;
};

/// Straight line through the last `count` of `values`, um/h.
LinearFitResult lineThroughEnd(const Series& s, const Eigen::VectorXd& values, Eigen::Index count) {
  const Eigen::Index from = s.time_s.size() - count;
  Eigen::MatrixXd A(count, 2);
  A.col(0).setOnes();
  A.col(1) = (s.time_s.tail(count).array() - s.time_s(from)) / seconds_per_hour;
  return solveLinear(A, values.tail(count), s.sigma_um.tail(count));
}

/// Slope of the last `count` values and its uncertainty in um/h. The uncertainty is the larger of what the sigmas and
/// what the residuals say.
void fitDrift(const Series& s, Eigen::Index count, WarmUpAxis& axis) {
  const LinearFitResult fit = lineThroughEnd(s, s.value_um, count);
  if (!fit.usable()) return;
  axis.drift_um_per_h = fit.x(1);
  const double excess = fit.degrees_of_freedom > 0 ? std::max(1.0, fit.chi2 / fit.degrees_of_freedom) : 1.0;
  axis.drift_sigma_um_per_h = fit.standardUncertainty(1) * std::sqrt(excess);
}

/// One time constant that was tried, with c and a by least squares.
struct Approach {
  double tau_s = 0.0;
  double amplitude_um = 0.0;
  double amplitude_sigma_um = 0.0;
  double chi2 = 0.0;
};

std::vector<Approach> approachesOf(const Series& s) {
  const Eigen::Index n = s.time_s.size();
  const double duration = s.time_s(n - 1) - s.time_s(0);
  std::vector<Approach> out;
  constexpr int steps = 160;
  for (int i = 0; i <= steps; ++i) {
    const double tau = duration / 30.0 * std::pow(90.0, i / static_cast<double>(steps));
    Eigen::MatrixXd A(n, 2);
    A.col(0).setOnes();
    A.col(1) = (-(s.time_s.array() - s.time_s(0)) / tau).exp();
    const LinearFitResult fit = solveLinear(A, s.value_um, s.sigma_um);
    if (fit.usable()) out.push_back({tau, fit.x(1), fit.standardUncertainty(1), fit.chi2});
  }
  return out;
}

/// The drift of the approach at the end of the series in place of the line's through the last `count` values, if that
/// line is as the approach would have it: it uses all of the series, so that its uncertainty is smaller, and it tells
/// the drift now, not the mean over a while. Mean and standard deviation over all time constants, each weighted by its
/// likelihood (even in ln tau) with noise `excess` times the stated variance.
void driftAtEnd(const Series& s, const std::vector<Approach>& tried, const Approach& best, double excess,
                Eigen::Index count, WarmUpAxis& axis) {
  // As likely with the longest time constant that was tried: a line as far as anybody can tell.
  if (tried.back().chi2 - best.chi2 < 9.0 * excess) return;
  const double end = s.time_s(s.time_s.size() - 1) - s.time_s(0);
  double weights = 0.0, mean = 0.0, square = 0.0;
  for (const Approach& a : tried) {
    const double weight = std::exp(-0.5 * (a.chi2 - best.chi2) / excess);
    const double factor = -std::exp(-end / a.tau_s) / a.tau_s * seconds_per_hour;
    const double drift = factor * a.amplitude_um;
    weights += weight;
    mean += weight * drift;
    square += weight * (drift * drift + excess * factor * factor * a.amplitude_sigma_um * a.amplitude_sigma_um);
  }
  mean /= weights;
  // Beside the approach a machine may drift steadily: no drift is known better than the slope of a straight line
  // through all of the series.
  const double steady = lineThroughEnd(s, s.value_um, s.time_s.size()).standardUncertainty(1) * std::sqrt(excess);
  const double sigma = std::hypot(std::sqrt(std::max(0.0, square / weights - mean * mean)), steady);
  if (!(sigma > 0.0) || sigma >= axis.drift_sigma_um_per_h) return;
  const Eigen::VectorXd course = best.amplitude_um * (-(s.time_s.array() - s.time_s(0)) / best.tau_s).exp();
  const LinearFitResult line = lineThroughEnd(s, course, count);
  if (std::abs(line.x(1) - axis.drift_um_per_h) > 3.0 * axis.drift_sigma_um_per_h) return;
  axis.drift_um_per_h = mean;
  axis.drift_sigma_um_per_h = sigma;
}

/// Exponential approach, accepted if an F test says that it beats a constant.
void fitExponential(const Series& s, double limit_um_per_h, Eigen::Index end_count, WarmUpAxis& axis) {
  const Eigen::Index n = s.time_s.size();
  if (n < 6) return;
  const std::vector<Approach> tried = approachesOf(s);
  const auto best = std::min_element(tried.begin(), tried.end(),
                                     [](const Approach& a, const Approach& b) { return a.chi2 < b.chi2; });
  if (best == tried.end() || !(best->chi2 > 0.0)) return;
  const double chi2_constant = solveLinear(Eigen::MatrixXd::Ones(n, 1), s.value_um, s.sigma_um).chi2;
  const double dof = static_cast<double>(n - 3);
  const double misfit = best->chi2 / dof;
  if (best->chi2 >= chi2_constant) return;
  if (fisherTail((chi2_constant - best->chi2) / 2.0 / misfit, 2.0, dof) > 0.01) return;
  if (best->tau_s > s.time_s(n - 1) - s.time_s(0)) {
    axis.time_constant = TimeConstant::BeyondRecord;
  } else if (best == tried.begin()) {
    axis.time_constant = TimeConstant::TooShort;
  } else {
    axis.time_constant = TimeConstant::Determined;
    axis.tau_s = best->tau_s;
    axis.amplitude_um = best->amplitude_um;
    const double first_drift = std::abs(best->amplitude_um) / best->tau_s * seconds_per_hour;
    axis.settled_after_s = first_drift > limit_um_per_h ? best->tau_s * std::log(first_drift / limit_um_per_h) : 0.0;
  }
  // Where the exponential does not describe the series, what it says of the end is no knowledge.
  if (misfit < 2.0) driftAtEnd(s, tried, *best, std::max(1.0, misfit), end_count, axis);
}

}  // namespace

WarmUpVerdict warmUpVerdict(double drift_um_per_h, double sigma_um_per_h, double limit_um_per_h) {
  const double magnitude = std::abs(drift_um_per_h);
  if (magnitude + 2.0 * sigma_um_per_h < limit_um_per_h) return WarmUpVerdict::Settled;
  if (magnitude - 2.0 * sigma_um_per_h > limit_um_per_h) return WarmUpVerdict::Drifts;
  return WarmUpVerdict::NotDecidable;
}

std::string toString(WarmUpVerdict verdict) {
  switch (verdict) {
    case WarmUpVerdict::Settled:
      return "settled";
    case WarmUpVerdict::Drifts:
      return "drifts";
    case WarmUpVerdict::NotDecidable:
      return "not decidable";
  }
  return "not decidable";
}

std::string toString(TimeConstant found) {
  switch (found) {
    case TimeConstant::NotSeen:
      return "not seen";
    case TimeConstant::Determined:
      return "determined";
    case TimeConstant::BeyondRecord:
      return "beyond the record";
    case TimeConstant::TooShort:
      return "too short";
  }
  return "not seen";
}

void WarmUpOptions::validate() const {
  if (!(drift_limit_um_per_h > 0.0)) {
    throw InputError(
        fmt::format("a drift limit of {} µm/h is not allowed; allowed: greater than zero.", drift_limit_um_per_h));
  }
  if (!(window_part > 0.0 && window_part <= 1.0) || window_points < 3) {
    throw InputError("the window of the drift needs a part in (0, 1] and at least 3 measurements.");
  }
}

WarmUpResult judgeWarmUp(const ObservationSet& observations, const std::string& point, const WarmUpOptions& options) {
  options.validate();
  WarmUpResult result;
  result.drift_limit_um_per_h = options.drift_limit_um_per_h;
  const std::vector<std::string> points = observations.points();
  result.point = point;
  if (point.empty()) {
    std::size_t most = 0;
    for (const std::string& p : points) {
      const auto rows = static_cast<std::size_t>(std::count_if(observations.rows.begin(), observations.rows.end(),
                                                               [&](const Observation& o) { return o.point == p; }));
      if (rows > most) {
        most = rows;
        result.point = p;
      }
    }
  } else if (std::find(points.begin(), points.end(), point) == points.end()) {
    throw InputError({observations.file, ""},
                     fmt::format("point \"{}\" is not there; allowed: {}.", point, joinedList(points, "or")));
  }
  bool any = false;
  bool settled = true;
  std::vector<std::string> drifting;
  std::vector<std::string> unsure;
  for (std::size_t k = 0; k < 3; ++k) {
    WarmUpAxis& axis = result.axes[k];
    axis.component = all_components[k];
    std::vector<const Observation*> rows;
    for (const Observation& o : observations.rows) {
      if (o.point == result.point && o.component == axis.component && o.use != ObservationUse::Exclude) {
        rows.push_back(&o);
      }
    }
    std::stable_sort(rows.begin(), rows.end(),
                     [](const Observation* a, const Observation* b) { return a->time_s < b->time_s; });
    const auto n = static_cast<Eigen::Index>(rows.size());
    if (n < options.window_points) continue;
    Series s{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
    // All but the reference carry the noise of the reference too, which is common and no drift: what varies from row to
    // row is about sigma / sqrt(2).
    for (Eigen::Index i = 0; i < n; ++i) {
      s.time_s(i) = rows[static_cast<std::size_t>(i)]->time_s;
      s.value_um(i) = rows[static_cast<std::size_t>(i)]->value;
      s.sigma_um(i) = rows[static_cast<std::size_t>(i)]->sigma / (i == 0 ? 1.0 : std::sqrt(2.0));
      axis.time_s.push_back(s.time_s(i));
      axis.value_um.push_back(s.value_um(i));
    }
    if (!(s.time_s(n - 1) > s.time_s(0))) continue;
    axis.measured = true;
    any = true;
    axis.total_um = s.value_um(n - 1) - s.value_um(0);
    const double from = s.time_s(n - 1) - options.window_part * (s.time_s(n - 1) - s.time_s(0));
    Eigen::Index count = 0;
    while (count < n && s.time_s(n - 1 - count) >= from) ++count;
    const auto end_count = std::max<Eigen::Index>(count, options.window_points);
    fitDrift(s, end_count, axis);
    fitExponential(s, options.drift_limit_um_per_h, end_count, axis);
    axis.verdict = warmUpVerdict(axis.drift_um_per_h, axis.drift_sigma_um_per_h, options.drift_limit_um_per_h);
    if (axis.verdict != WarmUpVerdict::Settled || axis.settled_after_s > s.time_s(n - 1) - s.time_s(0))
      axis.settled_after_s.reset();
    settled = settled && axis.verdict == WarmUpVerdict::Settled;
    const std::string text = fmt::format("{} {}", toString(axis.component),
                                         withUncertainty(axis.drift_um_per_h, axis.drift_sigma_um_per_h, "um/h"));
    if (axis.verdict == WarmUpVerdict::Drifts) drifting.push_back(text);
    if (axis.verdict == WarmUpVerdict::NotDecidable) unsure.push_back(text);
  }
  if (!any) {
    result.status = FitStatus::Degenerate;
    result.reason = fmt::format("Point {} was measured fewer than {} times: too few to see a drift.", result.point,
                                options.window_points);
    return result;
  }
  result.status = FitStatus::Converged;
  result.settled = settled;
  if (settled) {
    result.reason = fmt::format("Settled: the drift of every axis is below {} µm/h with its uncertainty.",
                                options.drift_limit_um_per_h);
  } else if (!drifting.empty()) {
    result.reason =
        fmt::format("Not settled: drift of more than {} µm/h: {}.", options.drift_limit_um_per_h, joinedList(drifting));
    if (!unsure.empty()) result.reason += fmt::format(" Not decidable yet: {}.", joinedList(unsure));
  } else {
    result.reason = fmt::format("Not known yet: drift of more than {} µm/h is possible: {}; measure longer.",
                                options.drift_limit_um_per_h, joinedList(unsure));
  }
  return result;
}

WarmUpResult judgeWarmUp(const ObservationSet& observations, const std::string& point, const WarmUpOptions& options,
                         const OperatingLog* log, double steady_K) {
  WarmUpResult result = judgeWarmUp(observations, point, options);
  if (result.status != FitStatus::Converged || result.settled) return result;
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const WarmUpAxis& axis : result.axes) {
    if (axis.time_s.empty()) continue;
    from = std::min(from, axis.time_s.front());
    to = std::max(to, axis.time_s.back());
  }
  constexpr const char* advice =
      "measure one point of the machine at rest again and again, or state that the instrument was warm";
  // States hold: the last row of a log says what was until the next one would have come.
  const auto holdsUntil = [](const std::vector<double>& time_s) {
    return time_s.size() < 2 ? time_s.back() : 2.0 * time_s.back() - time_s[time_s.size() - 2];
  };
  if (log == nullptr || log->empty() || log->time_s().front() > from || holdsUntil(log->time_s()) < to) {
    result.cause_reason = fmt::format(
        "Without a log of what the machine did meanwhile, its own thermal drift and a drift of the instrument cannot "
        "be separated; {}.",
        advice);
    return result;
  }
  // Rows within the series, and the state that held when it began.
  std::vector<std::string> at_work;
  std::vector<std::pair<double, std::string>> warming;  // by how much, K
  bool motion_logged = false;
  for (const std::string& name : log->names()) {
    const bool temperature = OperatingLog::isTemperature(name);
    const bool motion = name.ends_with("_rpm") || name.starts_with("feed_");
    if (!temperature && !motion) continue;
    motion_logged = motion_logged || motion;
    double low = log->at(name, from);
    double high = low;
    const auto take = [&](double value) {
      low = std::min(low, value);
      high = std::max(high, value);
    };
    take(log->at(name, to));
    const std::vector<double>& values = *log->signal(name);
    for (std::size_t r = 0; r < values.size(); ++r) {
      if (log->time_s()[r] >= from && log->time_s()[r] <= to) take(values[r]);
    }
    constexpr double creep = 1.0;  // rpm or mm/min
    if (motion && std::max(std::abs(low), std::abs(high)) > creep) at_work.push_back(driversInWords(name));
    if (temperature && high - low > steady_K) warming.emplace_back(high - low, driversInWords(name));
  }
  if (at_work.empty() && warming.empty() && motion_logged) {
    result.cause = WarmUpCause::Instrument;
    result.cause_reason = "The machine was at rest at constant temperatures: the drift is that of the instrument.";
    return result;
  }
  std::sort(warming.begin(), warming.end(), std::greater<>());
  constexpr std::size_t most_named = 3;
  if (warming.size() > most_named) warming.resize(most_named);
  std::vector<std::string> temperatures;
  for (const auto& [change_K, name] : warming) temperatures.push_back(fmt::format("{} by {:.1f} K", name, change_K));
  std::string why = "the log does not show whether it was at rest";
  if (!at_work.empty() && !warming.empty()) {
    why =
        fmt::format("it was at work ({}) and temperatures changed ({})", joinedList(at_work), joinedList(temperatures));
  } else if (!at_work.empty()) {
    why = fmt::format("it was at work ({})", joinedList(at_work));
  } else if (!warming.empty()) {
    why = fmt::format("temperatures changed ({})", joinedList(temperatures));
  }
  result.cause_reason = fmt::format(
      "The thermal drift of the machine and a drift of the instrument cannot be separated here, because {}; {}.", why,
      advice);
  return result;
}

}  // namespace spindrift
