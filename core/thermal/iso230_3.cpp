// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/iso230_3.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// An encoder shows up to 1 rpm of a spindle that stands.
bool turns(double speed_rpm) {
  constexpr double creep_rpm = 1.0;
  return std::abs(speed_rpm) > creep_rpm;
}

/// Smallest difference of neighbours, but for what rounding of numbers makes of equal ones; 0 where all are equal.
double stepOf(const std::vector<double>& values) {
  double step = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  std::size_t equal = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double d = std::abs(values[i] - values[i - 1]);
    if (d > 1e-9 * largest) {
      step = std::min(step, d);
    } else {
      ++equal;
    }
  }
  // Readings in steps repeat; those that only happen to lie close do not.
  return std::isfinite(step) && 4 * equal > values.size() ? step : 0.0;
}

double readingSigma(const ComponentSeries& c) {
  if (c.reading_sigma > 0.0) return c.reading_sigma;
  // Second differences remove what is smooth; their variance is six times that of a reading.
  std::vector<double> v;
  for (const double x : c.values)
    if (std::isfinite(x)) v.push_back(x);
  std::vector<double> second;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) second.push_back(v[i - 1] - 2.0 * v[i] + v[i + 1]);
  if (second.empty()) return 0.0;
  return std::max(robustSigma(second) / std::sqrt(6.0), stepOf(v) / std::sqrt(12.0));
}

void checkSeries(std::span<const double> time_s, const std::vector<ComponentSeries>& components, std::size_t least) {
  if (components.empty())
    throw InputError("no displacement was given; allowed: at least one column whose name ends in _um or _urad.");
  for (const ComponentSeries& c : components) {
    SPINDRIFT_ASSERT(c.values.size() == time_s.size(), "component and time differ in length");
    const auto count = static_cast<std::size_t>(
        std::count_if(c.values.begin(), c.values.end(), [](double v) { return std::isfinite(v); }));
    if (count < least)
      throw InputError(fmt::format("{} has {} readings; allowed: at least {} over the test.", c.name, count, least));
  }
}

/// Value at a time from the readings around it.
struct Level {
  double value = std::nan("");
  double variance = 1.0;  ///< of it, per variance of one reading
};

/// A straight line through the readings of `from_s` ... `to_s`, taken at `when`: noise is averaged and a steady change
/// within the window does no harm. Fewer than three readings: the nearest one as it stands.
Level levelAt(std::span<const double> time_s, const std::vector<double>& values, double when, double from_s,
              double to_s) {
  const auto first = std::lower_bound(time_s.begin(), time_s.end(), from_s) - time_s.begin();
  const auto last = std::upper_bound(time_s.begin(), time_s.end(), to_s) - time_s.begin();
  double n = 0.0, st = 0.0, sy = 0.0, stt = 0.0, sty = 0.0;
  for (auto i = first; i < last; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!std::isfinite(values[k])) continue;
    const double t = time_s[k] - when;
    n += 1.0;
    st += t;
    sy += values[k];
    stt += t * t;
    sty += t * values[k];
  }
  const double spread = stt - (n > 0.0 ? st * st / n : 0.0);
  if (n >= 3.0 && spread > 0.0) {
    const double slope = (sty - st * sy / n) / spread;
    return {(sy - slope * st) / n, 1.0 / n + st * st / (n * n * spread)};
  }
  // Outwards from `when` to the first reading on each side; of two as near the earlier one.
  auto after = static_cast<std::size_t>(std::lower_bound(time_s.begin(), time_s.end(), when) - time_s.begin());
  std::size_t before = after;
  while (after < values.size() && !std::isfinite(values[after])) ++after;
  while (before > 0 && !std::isfinite(values[before - 1])) --before;
  Level nearest;
  if (before > 0 && (after == values.size() || when - time_s[before - 1] <= time_s[after] - when)) {
    nearest.value = values[before - 1];
  } else if (after < values.size()) {
    nearest.value = values[after];
  }
  return nearest;
}

/// Sums over the window around every reading, so that levels of many records with the same gaps cost little each.
class LevelFilter {
 public:
  /// Missing readings (NaN) have no level.
  LevelFilter(std::span<const double> time_s, const std::vector<double>& values, double window_s, double from_s,
              double to_s)
      : time_s_(time_s) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::isfinite(values[i]) && time_s[i] >= from_s && time_s[i] <= to_s) kept_.push_back(i);
    std::size_t first = 0;
    std::size_t last = 0;
    for (const std::size_t i : kept_) {
      const double low_s = std::max(from_s, time_s[i] - 0.5 * window_s);
      const double high_s = std::min(to_s, time_s[i] + 0.5 * window_s);
      while (first < kept_.size() && time_s[kept_[first]] < low_s) ++first;
      while (last < kept_.size() && time_s[kept_[last]] <= high_s) ++last;
      windows_.push_back({first, last});
    }
  }
  [[nodiscard]] std::size_t size() const noexcept { return kept_.size(); }
  [[nodiscard]] std::size_t row(std::size_t k) const noexcept { return kept_[k]; }
  /// Of values at all times those of the kept readings.
  [[nodiscard]] std::vector<double> kept(const std::vector<double>& values) const {
    std::vector<double> out;
    for (const std::size_t i : kept_) out.push_back(values[i]);
    return out;
  }
  /// The straight line through each window at its reading (levelAt); fewer than three readings: the reading itself.
  /// `values`: one for each kept reading.
  [[nodiscard]] std::vector<double> levels(const std::vector<double>& values) const {
    const double origin_s = kept_.empty() ? 0.0 : 0.5 * (time_s_[kept_.front()] + time_s_[kept_.back()]);
    const std::size_t n = kept_.size();
    std::vector<double> t1(n + 1, 0.0), t2(n + 1, 0.0), y1(n + 1, 0.0), ty(n + 1, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      const double t = time_s_[kept_[k]] - origin_s;
      t1[k + 1] = t1[k] + t;
      t2[k + 1] = t2[k] + t * t;
      y1[k + 1] = y1[k] + values[k];
      ty[k + 1] = ty[k] + t * values[k];
    }
    std::vector<double> out = values;
    for (std::size_t k = 0; k < n; ++k) {
      const auto [first, last] = windows_[k];
      const double count = static_cast<double>(last - first);
      const double when = time_s_[kept_[k]] - origin_s;
      const double st = t1[last] - t1[first] - count * when;
      const double stt = t2[last] - t2[first] - 2.0 * when * (t1[last] - t1[first]) + count * when * when;
      const double sy = y1[last] - y1[first];
      const double sty = ty[last] - ty[first] - when * sy;
      const double spread = stt - (count > 0.0 ? st * st / count : 0.0);
      if (!(count >= 3.0) || !(spread > 1e-9 * (1.0 + stt))) continue;
      const double slope = (sty - st * sy / count) / spread;
      out[k] = (sy - slope * st) / count;
    }
    return out;
  }

 private:
  std::span<const double> time_s_;
  std::vector<std::size_t> kept_;
  std::vector<std::pair<std::size_t, std::size_t>> windows_;  ///< of kept readings, the last excluded
};

struct Range {
  double size = 0.0;
  double sigma = 0.0;
};

/// Range of the levels with what noise adds to it taken off. The largest of many levels is one that noise has raised
/// and the smallest one that it has lowered: a record of pure noise has a range as well. So the shape of the record
/// (its levels over a wider window) is stretched until it shows, with noise of the readings added and the levels taken
/// as from the readings, the range that was found, in the mean of many such records; the standard uncertainty is what
/// the stretch changes where the range found is one standard deviation of theirs larger or smaller (parametric
/// bootstrap).
Range rangeOf(std::span<const double> time_s, const std::vector<double>& values, double window_s, double from_s,
              double to_s, double reading_sigma) {
  const LevelFilter filter(time_s, values, window_s, from_s, to_s);
  const std::size_t n = filter.size();
  if (n < 2) return {};
  const std::vector<double> kept = filter.kept(values);
  const std::vector<double> levels = filter.levels(kept);
  const auto size = [](const std::vector<double>& v) {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    return *high - *low;
  };
  const double found = size(levels);
  if (!(reading_sigma > 0.0) || !(found > 0.0)) return {found, 0.0};
  constexpr double wider = 12.0;
  constexpr double least_readings = 48.0;
  const double period_s = (time_s[filter.row(n - 1)] - time_s[filter.row(0)]) / static_cast<double>(n - 1);
  const double shape_s = std::max(wider * window_s, least_readings * period_s);
  const std::vector<double> shape = LevelFilter(time_s, values, shape_s, from_s, to_s).levels(kept);
  const double shape_size = size(shape);
  constexpr std::size_t readings_at_most = 4'000'000;
  const std::size_t records = std::clamp<std::size_t>(readings_at_most / n, 24, 200);
  std::vector<std::vector<double>> noise(records);
  Random random(230);
  for (std::vector<double>& record : noise) {
    record.resize(n);
    for (double& v : record) v = random.normal(0.0, reading_sigma);
    record = filter.levels(record);
  }
  const auto stretched = [&](double factor) {
    double sum = 0.0;
    double squares = 0.0;
    for (const std::vector<double>& record : noise) {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (std::size_t k = 0; k < n; ++k) {
        const double v = factor * shape[k] + record[k];
        low = std::min(low, v);
        high = std::max(high, v);
      }
      sum += high - low;
      squares += (high - low) * (high - low);
    }
    const double mean = sum / static_cast<double>(records);
    return std::pair{mean, std::sqrt(std::max(0.0, squares / static_cast<double>(records) - mean * mean))};
  };
  // The mean range grows with the factor: halving the interval finds it.
  const auto factorFor = [&](double range) {
    double low = 0.0;
    double high = 2.0;
    if (!(shape_size > 0.0) || stretched(low).first >= range) return 0.0;
    for (int step = 0; step < 20; ++step) {
      const double middle = 0.5 * (low + high);
      (stretched(middle).first < range ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  const double factor = factorFor(found);
  const double spread = stretched(factor).second;
  const double more = factorFor(std::max(found, stretched(0.0).first) + spread);
  const double less = factorFor(found - spread);
  // Near the noise a little more of it is much of a range: two standard deviations less may be nothing at all.
  const double far_less = factorFor(found - 2.0 * spread);
  const double half = std::max({0.5 * (more - less), 0.5 * (factor - far_less), factor > 0.0 ? 0.0 : more});
  const double sigma = half * shape_size;
  // Steps are no noise that many readings average: both ends are known to a part of a step.
  return {factor * shape_size, std::max(sigma, stepOf(kept) / std::sqrt(6.0))};
}

/// A level over more than half of the record tells nothing of what changed in it; the usual window is taken of any.
void checkWindow(double window_s, std::span<const double> time_s) {
  const double longest_s =
      std::max(level_window_s, time_s.empty() ? 0.0 : std::floor(0.5 * (time_s.back() - time_s.front())));
  if (window_s >= 0.0 && window_s <= longest_s) return;
  throw InputError(fmt::format("a level cannot be read over {:g} s of a record of {:g} s; allowed: 0 s to {:g} s.",
                               window_s, time_s.empty() ? 0.0 : time_s.back() - time_s.front(), longest_s));
}

int signOf(const AxisReading& r) {
  return r.direction >= 0 ? 1 : -1;
}

/// The positions at both ends of travel, mm. Readings within a millimetre (a hundredth of the travel, where that is
/// less) of an end are at one position, their mean: a measured position is not the same number twice.
std::pair<double, double> atBothEnds(std::vector<AxisReading>& readings) {
  const auto [low, high] = std::minmax_element(
      readings.begin(), readings.end(), [](const auto& a, const auto& b) { return a.position_mm < b.position_mm; });
  const double low_mm = low->position_mm;
  const double high_mm = high->position_mm;
  if (high_mm - low_mm < 1e-6)
    throw InputError("all readings were taken at one position; allowed: two positions near the ends of travel.");
  const double near_mm = std::min(1.0, 0.01 * (high_mm - low_mm));
  const auto gathered = [&](double end_mm) {
    const auto here = [&](const AxisReading& r) { return std::abs(r.position_mm - end_mm) <= near_mm; };
    double sum = 0.0;
    double count = 0.0;
    for (const AxisReading& r : readings) {
      if (!here(r)) continue;
      sum += r.position_mm - end_mm;
      count += 1.0;
    }
    const double mean_mm = end_mm + sum / count;
    for (AxisReading& r : readings)
      if (here(r)) r.position_mm = mean_mm;
    return mean_mm;
  };
  const double at_low_mm = gathered(low_mm);
  return {at_low_mm, gathered(high_mm)};
}

/// Readings of a position by point and direction, each in order of time.
using AxisSeries = std::map<std::pair<std::string, int>, std::vector<AxisReading>>;

AxisSeries seriesAt(const std::vector<AxisReading>& readings, double position) {
  AxisSeries series;
  for (const AxisReading& r : readings)
    if (std::abs(r.position_mm - position) < 1e-6) series[{r.point, signOf(r)}].push_back(r);
  return series;
}

/// Readings of a position about a time history common to all series, up to the third power, with a constant of each.
struct AxisScatter {
  double sigma_um = 0.0;  ///< standard deviation
  double degrees_of_freedom = 0.0;
  std::map<std::pair<std::string, int>, double> constant_um;
  std::map<std::pair<std::string, int>, Eigen::Index> column;  ///< of a constant in `unit_covariance`
  Eigen::MatrixXd unit_covariance;                             ///< of the constants for a variance of one
};

AxisScatter scatterOf(const AxisSeries& series) {
  Eigen::Index n = 0;
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const auto& [key, list] : series) {
    n += static_cast<Eigen::Index>(list.size());
    from = std::min(from, list.front().time_s);
    to = std::max(to, list.back().time_s);
  }
  const auto constants = static_cast<Eigen::Index>(series.size());
  const Eigen::Index powers = std::clamp<Eigen::Index>(n / 2 - 1, 0, 3);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, powers + constants);
  Eigen::VectorXd y(n);
  Eigen::Index row = 0;
  Eigen::Index column = powers;
  for (const auto& [key, list] : series) {
    for (const AxisReading& r : list) {
      const double u = (r.time_s - from) / std::max(to - from, 1e-9) * 2.0 - 1.0;
      double power = u;
      for (Eigen::Index k = 0; k < powers; ++k, power *= u) A(row, k) = power;
      A(row, column) = 1.0;
      y[row++] = r.deviation_um;
    }
    ++column;
  }
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(A);
  const Eigen::VectorXd solution = solver.solve(y);
  const Eigen::MatrixXd inverse = solver.pseudoInverse();
  AxisScatter out;
  out.degrees_of_freedom = static_cast<double>(std::max<Eigen::Index>(0, n - A.cols()));
  if (out.degrees_of_freedom > 0.0) out.sigma_um = std::sqrt((y - A * solution).squaredNorm() / out.degrees_of_freedom);
  out.unit_covariance = inverse.bottomRows(constants) * inverse.bottomRows(constants).transpose();
  Eigen::Index of = 0;
  for (const auto& [key, list] : series) {
    out.constant_um[key] = solution[powers + of];
    out.column[key] = of++;
  }
  return out;
}

/// From the beginning to the end of the test, but for a tenth of it.
bool spans(const std::vector<AxisReading>& series, const std::vector<AxisReading>& test) {
  const double end = 0.1 * (test.back().time_s - test.front().time_s);
  return series.size() >= 2 && series.front().time_s <= test.front().time_s + end &&
         series.back().time_s >= test.back().time_s - end;
}

AxisPositionResult evaluatePosition(const std::vector<AxisReading>& readings, double position) {
  AxisPositionResult out;
  out.position_mm = position;
  const AxisSeries series = seriesAt(readings, position);
  double stated = 0.0;
  for (const auto& [key, list] : series) {
    out.readings += list.size();
    for (const AxisReading& r : list) stated += r.sigma_um * r.sigma_um;
  }
  if (out.readings < 4)
    throw InputError(fmt::format("position {} mm was measured {} times; allowed: at least 4 times over the test.",
                                 position, out.readings));
  const AxisScatter scatter = scatterOf(series);
  const double s = scatter.sigma_um;
  const auto& constant = scatter.constant_um;
  Eigen::VectorXd contrast = Eigen::VectorXd::Zero(scatter.unit_covariance.rows());  // of the reversal
  std::map<std::string, std::pair<double, double>> range;
  double changes = 0.0;
  double reversals = 0.0;
  double spanning = 0.0;
  double both = 0.0;
  for (const auto& [key, list] : series) {
    const auto& [point, direction] = key;
    auto& [low, high] = range.try_emplace(point, list.front().deviation_um, list.front().deviation_um).first->second;
    for (const AxisReading& r : list) {
      low = std::min(low, r.deviation_um);
      high = std::max(high, r.deviation_um);
    }
    out.range_um = std::max(out.range_um, high - low);
    if (const auto other = constant.find({point, 1}); direction < 0 && other != constant.end()) {
      reversals += other->second - constant.at(key);
      contrast(scatter.column.at(other->first)) += 1.0;
      contrast(scatter.column.at(key)) -= 1.0;
      both += 1.0;
    }
    if (!spans(list, readings)) continue;
    changes += list.back().deviation_um - list.front().deviation_um;
    spanning += 1.0;
  }
  if (spanning == 0.0) {
    throw InputError(
        fmt::format("at {} mm no point was approached from one direction both at the beginning and at the "
                    "end of the test; allowed: the same approaches in the first and in the last cycle.",
                    position));
  }
  out.change_um = changes / spanning;
  // A few readings lie on a smooth course whatever their noise.
  stated = std::sqrt(stated / static_cast<double>(out.readings));
  out.change_sigma_um = std::max(s, stated) * std::sqrt(2.0 / spanning);
  out.repeatability_um = 2.0 * s;
  out.repeatability_sigma_um = scatter.degrees_of_freedom > 0.0
                                   ? out.repeatability_um / std::sqrt(2.0 * scatter.degrees_of_freedom)
                                   : std::nan("");
  out.reversal_um = both > 0.0 ? reversals / both : std::nan("");
  out.reversal_sigma_um = both > 0.0
                              ? std::max(s, stated) / both * std::sqrt(contrast.dot(scatter.unit_covariance * contrast))
                              : std::nan("");
  return out;
}

}  // namespace

std::vector<std::string> requireMachineAtRest(const TimeSeries& series) {
  std::vector<std::string> notes;
  bool speed_known = false;
  for (const Signal& signal : series.signals) {
    if (signal.kind == SignalKind::Feed) {
      const auto moves = std::find_if(signal.values.begin(), signal.values.end(), [](double v) { return v > 0.0; });
      if (moves == signal.values.end()) continue;
      notes.push_back(fmt::format(
          "{} is {:g} at {:g} s: an ETVE test is of a machine at rest, and what its axes heat counts as environment.",
          signal.name, *moves, series.time_s[static_cast<std::size_t>(moves - signal.values.begin())]));
    }
    if (signal.kind != SignalKind::Speed) continue;
    speed_known = true;
    for (std::size_t row = 0; row < signal.values.size(); ++row) {
      if (!turns(signal.values[row])) continue;
      throw InputError({series.file, fmt::format("column {}", signal.name)},
                       fmt::format("the spindle turns ({:g} rpm at {:g} s), but an ETVE test is of a machine at rest; "
                                   "allowed: a log without a running spindle, or the test \"spindle\".",
                                   signal.values[row], series.time_s[row]));
    }
  }
  if (!speed_known)
    notes.emplace_back("The log has no spindle speed: that the machine was at rest could not be checked.");
  return notes;
}

std::string requireOneSpeedStep(const TimeSeries& series, const std::string& column, std::span<const double> speed) {
  SPINDRIFT_ASSERT(speed.size() == series.time_s.size(), "speed and time differ in length");
  constexpr double tolerance = 0.05;      // of the level: control and encoder
  constexpr double transition_s = 120.0;  // to come up to speed, and single rows that are off
  const auto runs = [&](std::size_t row) { return turns(speed[row]); };
  std::size_t first = 0;
  while (first < speed.size() && !runs(first)) ++first;
  if (first == speed.size()) return {};  // the evaluation says so
  std::size_t last = speed.size() - 1;
  while (!runs(last)) --last;
  // A state holds until the next row.
  const auto lasts_s = [&](std::size_t row) {
    return row + 1 < speed.size() ? series.time_s[row + 1] - series.time_s[row] : 0.0;
  };
  std::vector<std::pair<double, double>> level_for;
  double running_s = 0.0;
  for (std::size_t row = first; row <= last; ++row) {
    if (!runs(row)) continue;
    level_for.emplace_back(std::abs(speed[row]), lasts_s(row));
    running_s += lasts_s(row);
  }
  std::sort(level_for.begin(), level_for.end());
  double level_rpm = level_for.back().first;
  double sum_s = 0.0;
  for (const auto& [rpm, for_s] : level_for) {
    sum_s += for_s;
    if (sum_s < 0.5 * running_s) continue;
    level_rpm = rpm;
    break;
  }
  double off_s = 0.0;
  std::size_t off_from = 0;
  for (std::size_t row = first; row <= last; ++row) {
    if (std::abs(std::abs(speed[row]) - level_rpm) <= tolerance * level_rpm) {
      off_s = 0.0;
      continue;
    }
    if (off_s == 0.0) off_from = row;
    off_s += lasts_s(row);
    if (off_s <= transition_s) continue;
    const std::string what = runs(off_from) ? fmt::format("turns at {:g} rpm", speed[off_from]) : std::string("stands");
    throw InputError(
        {series.file, fmt::format("column {}", column)},
        fmt::format("the spindle {} at {:g} s, but at {:g} rpm for most of its run: these are several steps "
                    "of speed, not one test; allowed: a record of one step, or --range FROM:TO around it.",
                    what, series.time_s[off_from], level_rpm));
  }
  if (first > 0) return {};
  return "the record begins with a running spindle: changes count from its first row, not from the cold machine.";
}

EtveResult evaluateEtve(std::span<const double> time_s, const std::vector<ComponentSeries>& components,
                        std::span<const double> ambient, double window_s) {
  checkSeries(time_s, components, 10);
  checkWindow(window_s, time_s);
  EtveResult result;
  result.window_s = window_s;
  result.duration_s = time_s.back() - time_s.front();
  double ambient_sigma_K = 0.0;  // of one reading
  if (!ambient.empty()) {
    SPINDRIFT_ASSERT(ambient.size() == time_s.size(), "ambient and time differ in length");
    const std::vector<double> values(ambient.begin(), ambient.end());
    ambient_sigma_K = readingSigma({"ambient", "K", values});
    const Range range = rangeOf(time_s, values, window_s, time_s.front(), time_s.back(), ambient_sigma_K);
    result.temperature_range_K = range.size;
    result.temperature_range_sigma_K = range.sigma;
  }
  if (result.duration_s < 4.0 * 3600.0)
    result.note = "the test is shorter than 4 h: slow influences of the environment are not in it.";
  for (const ComponentSeries& c : components) {
    EtveComponent out;
    out.name = c.name;
    out.unit = c.unit;
    const Range range = rangeOf(time_s, c.values, window_s, time_s.front(), time_s.back(), readingSigma(c));
    double st = 0.0, sy = 0.0, stt = 0.0, sty = 0.0, n = 0.0;
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (!std::isfinite(c.values[i])) continue;
      if (ambient.empty() || !std::isfinite(ambient[i])) continue;
      st += ambient[i];
      sy += c.values[i];
      n += 1.0;
    }
    out.range = range.size;
    out.range_sigma = range.sigma;
    out.range_per_K = std::nan("");
    out.range_per_K_sigma = std::nan("");
    out.slope_per_K = std::nan("");
    out.slope_sigma = std::nan("");
    if (result.temperature_range_K > 1e-6 && n > 2.0) {
      out.range_per_K = out.range / result.temperature_range_K;
      out.range_per_K_sigma =
          std::hypot(out.range_sigma, out.range_per_K * result.temperature_range_sigma_K) / result.temperature_range_K;
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        if (!std::isfinite(c.values[i]) || !std::isfinite(ambient[i])) continue;
        stt += (ambient[i] - st / n) * (ambient[i] - st / n);
        sty += (ambient[i] - st / n) * (c.values[i] - sy / n);
      }
      // What noise of the thermometer adds to the squares would flatten the slope (errors in variables, of known
      // variance: Fuller 1987, Measurement Error Models, 1.2). Where most of them are noise, nothing is known.
      constexpr double least_told = 0.5;
      const double told = stt - (n - 1.0) * ambient_sigma_K * ambient_sigma_K;
      if (!(told > least_told * stt)) {
        result.components.push_back(out);
        continue;
      }
      out.slope_per_K = sty / told;
      double rest = 0.0;
      for (std::size_t i = 0; i < c.values.size(); ++i) {
        if (!std::isfinite(c.values[i]) || !std::isfinite(ambient[i])) continue;
        const double e = c.values[i] - sy / n - out.slope_per_K * (ambient[i] - st / n);
        rest += e * e;
      }
      // Readings of a slow process are not independent: at most one in ten minutes counts.
      const double independent = std::min(n, result.duration_s / 600.0);
      out.slope_sigma = std::sqrt(rest / n / told * n / std::max(1.0, independent - 2.0));
    }
    result.components.push_back(out);
  }
  return result;
}

SpindleResult evaluateRotatingSpindle(std::span<const double> time_s, std::span<const double> speed,
                                      const std::vector<ComponentSeries>& components, double fraction,
                                      double window_s) {
  SPINDRIFT_ASSERT(speed.size() == time_s.size(), "speed and time differ in length");
  if (!(fraction > 0.0 && fraction < 1.0)) throw InputError("the fraction of the end value must lie between 0 and 1.");
  checkSeries(time_s, components, 4);
  checkWindow(window_s, time_s);
  SpindleResult result;
  result.fraction = fraction;
  result.window_s = window_s;
  std::size_t first = speed.size();
  std::size_t last = 0;
  for (std::size_t i = 0; i < speed.size(); ++i) {
    if (!turns(speed[i])) continue;
    if (first == speed.size()) first = i;
    last = i;
  }
  if (first == speed.size())
    throw InputError("the spindle never runs in this record; allowed: a test with a speed above zero.");
  result.start_s = time_s[first];
  // A state holds until the next row, so the spindle stops there.
  result.stop_s = last + 1 < time_s.size() ? time_s[last + 1] : time_s[last];
  for (const ComponentSeries& c : components) {
    SpindleComponent out;
    out.name = c.name;
    out.unit = c.unit;
    // A level is read on its side of a switch: before the start, before the stop.
    const double start = result.start_s;
    const double stop = result.stop_s;
    const bool still_before = start - time_s.front() >= window_s;
    const Level zero = levelAt(time_s, c.values, start, still_before ? start - window_s : time_s.front(),
                               still_before ? start : start + window_s);
    const Level end = levelAt(time_s, c.values, stop, std::max(start, stop - window_s), stop);
    const bool cools = time_s.back() > stop;  // else nothing was recorded after the stop
    const Level cooled = levelAt(time_s, c.values, time_s.back(),
                                 std::min(time_s.back(), std::max(stop, time_s.back() - window_s)), time_s.back());
    const double hour = start + 3600.0;
    const Level after_hour =
        levelAt(time_s, c.values, hour, std::max(start, hour - 0.5 * window_s), std::min(stop, hour + 0.5 * window_s));
    out.at_end = end.value - zero.value;
    out.first_hour = stop >= hour ? after_hour.value - zero.value : std::nan("");
    out.after_cooling = cools ? cooled.value - zero.value : std::nan("");
    const double reading_sigma = readingSigma(c);
    out.change_sigma = std::sqrt(zero.variance + end.variance) * reading_sigma;
    out.first_hour_sigma = stop >= hour ? std::sqrt(zero.variance + after_hour.variance) * reading_sigma : std::nan("");
    out.after_cooling_sigma = cools ? std::sqrt(zero.variance + cooled.variance) * reading_sigma : std::nan("");
    out.time_to_fraction_s = std::nan("");
    const LevelFilter filter(time_s, c.values, window_s, start, stop);
    const std::vector<double> levels = filter.levels(filter.kept(c.values));
    bool beyond = false;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const bool now = (levels[k] - zero.value) * (out.at_end > 0.0 ? 1.0 : -1.0) >= fraction * std::abs(out.at_end);
      if (now && !beyond) out.time_to_fraction_s = time_s[filter.row(k)] - start;
      beyond = now;
    }
    if (std::abs(out.at_end) < 3.0 * out.change_sigma) out.time_to_fraction_s = std::nan("");
    const auto range = rangeOf(time_s, c.values, window_s, start, stop, reading_sigma);
    out.range = range.size;
    out.range_sigma = range.sigma;
    const auto of_hour = stop >= hour ? rangeOf(time_s, c.values, window_s, start, hour, reading_sigma)
                                      : Range{std::nan(""), std::nan("")};
    out.first_hour_range = of_hour.size;
    out.first_hour_range_sigma = of_hour.sigma;
    result.components.push_back(out);
  }
  return result;
}

AxisResult evaluateMovingAxis(std::vector<AxisReading> readings) {
  if (readings.size() < 8)
    throw InputError(
        fmt::format("readings of the axis: {}; allowed: at least 4 at each of two positions.", readings.size()));
  std::stable_sort(readings.begin(), readings.end(),
                   [](const AxisReading& a, const AxisReading& b) { return a.time_s < b.time_s; });
  const auto [low_mm, high_mm] = atBothEnds(readings);
  AxisResult result;
  result.low = evaluatePosition(readings, low_mm);
  result.high = evaluatePosition(readings, high_mm);
  result.expansion_um = result.high.change_um - result.low.change_um;
  result.expansion_sigma_um = std::hypot(result.high.change_sigma_um, result.low.change_sigma_um);
  result.expansion_um_per_m = result.expansion_um / ((high_mm - low_mm) * 1e-3);
  // Course: what each series of the high position has changed since its first reading, minus the mean change of the
  // series of the low one, interpolated in time.
  const AxisSeries below = seriesAt(readings, low_mm);
  const auto changeBelow = [&](double time_s, int direction) {
    double sum = 0.0;
    double count = 0.0;
    for (const auto& [key, list] : below) {
      if (key.second != direction || !spans(list, readings)) continue;
      const auto at = std::lower_bound(list.begin(), list.end(), time_s,
                                       [](const AxisReading& r, double t) { return r.time_s < t; });
      const auto next = std::clamp(at, list.begin() + 1, list.end() - 1);
      const AxisReading& a = *(next - 1);
      const double w =
          next->time_s > a.time_s ? std::clamp((time_s - a.time_s) / (next->time_s - a.time_s), 0.0, 1.0) : 0.0;
      sum += (1.0 - w) * a.deviation_um + w * next->deviation_um - list.front().deviation_um;
      count += 1.0;
    }
    return count > 0.0 ? sum / count : std::nan("");
  };
  for (const auto& [key, list] : seriesAt(readings, high_mm)) {
    if (!spans(list, readings)) continue;
    const double zero = changeBelow(list.front().time_s, key.second);
    for (const AxisReading& r : list) {
      const double change = r.deviation_um - list.front().deviation_um - (changeBelow(r.time_s, key.second) - zero);
      if (!std::isfinite(change)) continue;
      result.time_s.push_back(r.time_s);
      result.expansion_over_time_um.push_back(change);
    }
  }
  std::vector<std::size_t> order(result.time_s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return result.time_s[a] < result.time_s[b]; });
  AxisResult sorted = result;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.time_s[i] = result.time_s[order[i]];
    sorted.expansion_over_time_um[i] = result.expansion_over_time_um[order[i]];
  }
  return sorted;
}

}  // namespace spindrift
