// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/simulation_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "core/base/error.h"

namespace spindrift {
namespace {

using SeriesKey = std::pair<std::string, Component>;

/// Squares of the deviations from the mean, in place.
void deviationsSquared(std::vector<double>& values) {
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (double& v : values) v = (v - mean) * (v - mean);
}

/// Series of observations with what the simulation predicts at no offset; as many as can be looked at quickly.
struct Compared {
  std::vector<std::vector<std::pair<const Observation*, double>>> series;
  double count = 0.0;
  double first_s = std::numeric_limits<double>::infinity();
  double last_s = -std::numeric_limits<double>::infinity();

  [[nodiscard]] int quarterOf(double time_s) const {
    return static_cast<int>(3.999 * (time_s - first_s) / std::max(1e-9, last_s - first_s));
  }
};

/// Of readings that are predicted at all times up to `reach_s` earlier and later, so that what is left at one offset is
/// left of the same readings at another.
Compared comparedSeries(const std::vector<Observation>& observations, const PredictedAt& predicted, double reach_s) {
  std::map<SeriesKey, std::vector<std::pair<const Observation*, double>>> series;
  for (const Observation& o : observations) {
    if (o.use == ObservationUse::Fit && o.sigma > 0.0) series[{o.point, o.component}].emplace_back(&o, 0.0);
  }
  constexpr std::size_t most_observations = 6000;
  constexpr std::size_t fewest_in_series = 6;
  Compared out;
  const std::size_t stride = std::max<std::size_t>(1, observations.size() / most_observations);
  std::size_t index = 0;
  for (auto& [key, members] : series) {
    if (members.size() < fewest_in_series || index++ % stride != 0) continue;
    if (reach_s > 0.0) {
      std::erase_if(members, [&](const auto& member) {
        const Observation& o = *member.first;
        return !std::isfinite(predicted(o, o.time_s - reach_s)) || !std::isfinite(predicted(o, o.time_s + reach_s));
      });
      if (members.size() < fewest_in_series) continue;
    }
    for (auto& [o, now] : members) {
      now = predicted(*o, o->time_s);
      out.first_s = std::min(out.first_s, o->time_s);
      out.last_s = std::max(out.last_s, o->time_s);
    }
    out.count += static_cast<double>(members.size());
    out.series.push_back(std::move(members));
  }
  return out;
}

/// What is left with the simulation of another time, and with that of the same time at the same readings.
struct Left {
  double moved = 0.0;
  double now = 0.0;
  /// Both by what may be wrong in common: a component in a quarter of the time.
  struct Part {
    double moved = 0.0;
    double now = 0.0;
  };
  std::map<std::pair<Component, int>, Part> parts;

  [[nodiscard]] double ratio() const { return now > 0.0 ? moved / now : 1.0; }
  [[nodiscard]] double shareOfPartsWithLess() const {
    double less = 0.0;
    double count = 0.0;
    for (const auto& [key, part] : parts) {
      if (std::abs(part.moved - part.now) <= 1e-9 * part.now) continue;  // nothing is predicted to move there
      count += 1.0;
      less += part.moved < part.now ? 1.0 : 0.0;
    }
    return count > 0.0 ? less / count : 0.0;
  }
};

Left leftAt(const Compared& compared, const PredictedAt& predicted, double offset_s) {
  Left out;
  std::vector<double> moved;
  std::vector<double> now;
  std::vector<const Observation*> which;
  double count = 0.0;
  for (const auto& series : compared.series) {
    moved.clear();
    now.clear();
    which.clear();
    for (const auto& [o, present] : series) {
      const double then = predicted(*o, o->time_s + offset_s);
      if (!std::isfinite(then) || !std::isfinite(present)) continue;
      moved.push_back((o->value - then) / o->sigma);
      now.push_back((o->value - present) / o->sigma);
      which.push_back(o);
    }
    constexpr std::size_t fewest = 4;
    if (moved.size() < fewest) continue;
    deviationsSquared(moved);
    deviationsSquared(now);
    for (std::size_t i = 0; i < which.size(); ++i) {
      out.moved += moved[i];
      out.now += now[i];
      Left::Part& part = out.parts[{which[i]->component, compared.quarterOf(which[i]->time_s)}];
      part.moved += moved[i];
      part.now += now[i];
    }
    count += static_cast<double>(moved.size());
  }
  // On a good part of the readings, or it says nothing.
  if (2.0 * count < compared.count) return {};
  return out;
}

/// Of the offsets that were looked at the one at which least is left; the present one to begin with.
struct LeastLeft {
  LeastLeft(const Compared& series, const PredictedAt& simulation) : compared(series), predicted(simulation) {}
  void look(double at_s) {
    const double left = leftAt(compared, predicted, at_s).ratio();
    if (!(left < ratio)) return;
    ratio = left;
    offset_s = at_s;
  }

  const Compared& compared;
  const PredictedAt& predicted;
  double offset_s = 0.0;
  double ratio = 1.0;
};

/// The offset between steps, `best_s` the one at which least is left. `least_s`: no clock is read better; `unread_s`:
/// uncertainty where what is left beside it says nothing.
SimulationClock between(const Compared& compared, const PredictedAt& predicted, double best_s, double step_s,
                        double least_s, double unread_s) {
  const Left at = leftAt(compared, predicted, best_s);
  const Left low = leftAt(compared, predicted, best_s - step_s);
  const Left high = leftAt(compared, predicted, best_s + step_s);
  SimulationClock out{best_s, least_s, std::sqrt(at.ratio())};
  const double curvature = low.moved + high.moved - 2.0 * at.moved;
  if (!(low.moved > 0.0 && high.moved > 0.0 && curvature > 0.0)) {
    out.standard_uncertainty_s = unread_s;
    return out;
  }
  out.offset_s += step_s * std::clamp(0.5 * (low.moved - high.moved) / curvature, -1.0, 1.0);
  // What is missing in the simulation goes on for long and is the same at many points: the slopes of the parts say how
  // far each of them would move the offset (the sandwich of Huber and White, parts as blocks).
  double slopes = 0.0;
  for (const auto& [part, value] : high.parts) {
    const auto before = low.parts.find(part);
    if (before != low.parts.end()) slopes += std::pow(0.5 * (value.moved - before->second.moved), 2);
  }
  const double scatter = at.moved / std::max(1.0, compared.count);
  const double of_noise_s = step_s * std::sqrt(2.0 * scatter / curvature);
  out.standard_uncertainty_s = std::hypot(least_s, std::max(step_s * std::sqrt(slopes) / curvature, of_noise_s));
  return out;
}

constexpr double near_s = 600.0;
/// A clock moves everything: share of the components, each in a quarter of the time, in which less is left.
constexpr double most_parts = 0.8;

}  // namespace

std::string SimulationClock::sentence(bool followed) const {
  const double minutes = std::abs(offset_s) / 60.0;
  const char* way = offset_s > 0.0 ? "later" : "earlier";
  const double less = 100.0 * (1.0 - scatter);
  if (std::abs(offset_s) <= near_s) {
    SPINDRIFT_ASSERT(followed, "minutes are looked for only where the simulation can be asked at another time");
    return fmt::format(
        "The observations agree better with the simulation of about {:.0f} s {} ({:.0f} % less scatter, in most "
        "components and most of the time), so they are compared with simulation and log at that time.",
        std::abs(offset_s), way, less);
  }
  if (followed) {
    return fmt::format(
        "The observations agree far better with the simulation of about {:.0f} min {} ({:.0f} % less scatter), so they "
        "are compared with simulation and log at that time: compare the clocks of observations.csv, log.csv and the "
        "simulation.",
        minutes, way, less);
  }
  return fmt::format(
      "The observations agree far better with the simulation of about {:.0f} min {} ({:.0f} % less scatter): compare "
      "the "
      "clocks of observations.csv, log.csv and the simulation.",
      minutes, way, less);
}

std::optional<SimulationClock> farSimulationClock(const std::vector<Observation>& observations,
                                                  const PredictedAt& predicted) {
  const Compared compared = comparedSeries(observations, predicted, 0.0);
  if (compared.series.empty()) return std::nullopt;
  constexpr double coarse_s = 600.0;
  constexpr double fine_s = 60.0;
  constexpr int most_steps = 24;
  LeastLeft least(compared, predicted);
  for (int k = -most_steps; k <= most_steps; ++k) least.look(k * coarse_s);
  constexpr double far_better = 0.5;
  if (least.ratio > far_better) return std::nullopt;
  const double about_s = least.offset_s;
  for (int k = 1; k * fine_s < coarse_s; ++k) {
    least.look(about_s - k * fine_s);
    least.look(about_s + k * fine_s);
  }
  constexpr double far_s = 1200.0;
  if (std::abs(least.offset_s) < far_s) return std::nullopt;
  if (leftAt(compared, predicted, least.offset_s).shareOfPartsWithLess() < most_parts) return std::nullopt;
  return between(compared, predicted, least.offset_s, fine_s, fine_s, coarse_s);
}

std::optional<SimulationClock> nearSimulationClock(const std::vector<Observation>& observations,
                                                   const PredictedAt& predicted) {
  const Compared compared = comparedSeries(observations, predicted, near_s);
  if (compared.series.empty()) return std::nullopt;
  constexpr double coarse_s = 60.0;
  constexpr double fine_s = 20.0;
  LeastLeft least(compared, predicted);
  for (double offset_s = coarse_s; offset_s <= near_s; offset_s += coarse_s) {
    least.look(offset_s);
    least.look(-offset_s);
  }
  const double about_s = least.offset_s;
  for (const double by_s : {-2.0 * fine_s, -fine_s, fine_s, 2.0 * fine_s}) least.look(about_s + by_s);
  if (least.offset_s == 0.0 || std::abs(least.offset_s) > near_s - coarse_s)
    return std::nullopt;  // nothing, or not within minutes
  constexpr double least_s = 2.0;
  constexpr double many = 6.0;  // standard uncertainties: they do not know what is missing in the simulation
  const SimulationClock clock = between(compared, predicted, least.offset_s, fine_s, least_s, near_s);
  if (std::abs(clock.offset_s) < many * clock.standard_uncertainty_s) return std::nullopt;
  if (leftAt(compared, predicted, least.offset_s).shareOfPartsWithLess() < most_parts) return std::nullopt;
  return clock;
}

PredictedAt predictedBetween(const std::vector<Observation>& observations, const std::vector<double>& predicted) {
  auto series = std::make_shared<std::map<SeriesKey, std::vector<std::pair<double, double>>>>();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    if (std::isfinite(predicted[i]))
      (*series)[{observations[i].point, observations[i].component}].emplace_back(observations[i].time_s, predicted[i]);
  }
  for (auto& [key, values] : *series) std::sort(values.begin(), values.end());
  return [series](const Observation& o, double time_s) {
    const auto found = series->find({o.point, o.component});
    if (found == series->end()) return std::numeric_limits<double>::quiet_NaN();
    const auto& values = found->second;
    if (time_s < values.front().first || time_s > values.back().first) return std::numeric_limits<double>::quiet_NaN();
    const auto after = std::lower_bound(values.begin(), values.end(), std::make_pair(time_s, -1e300));
    if (after->first == time_s || after == values.begin()) return after->second;
    const auto before = std::prev(after);
    const double part = (time_s - before->first) / std::max(1e-9, after->first - before->first);
    return before->second + part * (after->second - before->second);
  };
}

}  // namespace spindrift
