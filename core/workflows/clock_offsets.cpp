// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/clock_offsets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// Linear between samples; outside the ends hold.
double valueAt(std::span<const double> time, std::span<const double> value, double t) {
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  if (next == time.begin()) return value.front();
  if (next == time.end()) return value.back();
  const auto i = static_cast<std::size_t>(next - time.begin());
  const double part = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return value[i - 1] + part * (value[i] - value[i - 1]);
}

double medianStep(std::span<const double> time) {
  std::vector<double> d;
  for (std::size_t i = 1; i < time.size(); ++i) d.push_back(time[i] - time[i - 1]);
  return median(d);
}

void check(std::span<const double> time, std::span<const double> value, const char* name) {
  SPINDRIFT_ASSERT(time.size() == value.size(), "time and values differ in length");
  const bool moves = value.size() >= 4 &&
                     *std::max_element(value.begin(), value.end()) > *std::min_element(value.begin(), value.end());
  if (!moves)
    throw InputError(fmt::format(
        "the {} shows no event, so no offset can be estimated; allowed: a record in which something moves.", name));
}

/// Correlation of the two records where they overlap after the shift; -1 with too little overlap.
double correlation(std::span<const double> rt, std::span<const double> r, std::span<const double> st,
                   std::span<const double> s, double offset, double grid) {
  const double from = std::max(rt.front(), st.front() + offset);
  const double to = std::min(rt.back(), st.back() + offset);
  const auto n = static_cast<std::size_t>(std::max(0.0, (to - from) / grid)) + 1;
  if (n < 8 || to - from < 0.3 * std::min(rt.back() - rt.front(), st.back() - st.front())) return -1.0;
  double sx = 0.0, sy = 0.0, sxx = 0.0, syy = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double t = from + grid * static_cast<double>(k);
    const double x = valueAt(rt, r, t);
    const double y = valueAt(st, s, t - offset);
    sx += x;
    sy += y;
    sxx += x * x;
    syy += y * y;
    sxy += x * y;
  }
  const auto m = static_cast<double>(n);
  const double a = sxx - sx * sx / m;
  const double b = syy - sy * sy / m;
  return a > 0.0 && b > 0.0 ? (sxy - sx * sy / m) / std::sqrt(a * b) : -1.0;
}

}  // namespace

nlohmann::json toJson(const ClockOffsets& offsets) {
  nlohmann::json out = nlohmann::json::object();
  for (const auto& [source, o] : offsets)
    out[source] = {{"offset_s", o.offset_s}, {"standard_uncertainty_s", o.sigma_s}, {"how", o.how}};
  return out;
}

ClockOffsets clockOffsetsFrom(const nlohmann::json& json) {
  ClockOffsets out;
  if (!json.is_object()) return out;
  for (const auto& [source, value] : json.items()) {
    const bool good = value.is_object() && value.contains("offset_s") && value["offset_s"].is_number();
    if (!good) throw InputError(fmt::format("the time offset of {} has no number offset_s.", source));
    const double offset = value["offset_s"].get<double>();
    if (!std::isfinite(offset) || std::abs(offset) > 1e6)
      throw InputError(
          fmt::format("a time offset of {:g} s for {} cannot be; allowed: -1e6 to 1e6 s.", offset, source));
    try {
      out[source] = {offset, value.value("standard_uncertainty_s", 0.0), value.value("how", std::string("entered"))};
    } catch (const nlohmann::json::exception& e) {
      throw InputError(fmt::format("the time offset of {} cannot be read ({}).", source, e.what()));
    }
  }
  return out;
}

OffsetEstimate estimateClockOffset(std::span<const double> reference_time_s, std::span<const double> reference,
                                   std::span<const double> source_time_s, std::span<const double> source,
                                   double longest_s) {
  check(reference_time_s, reference, "reference record");
  check(source_time_s, source, "record of the source");
  const double grid = std::max({1e-3, std::min(medianStep(reference_time_s), medianStep(source_time_s)),
                                (reference_time_s.back() - reference_time_s.front()) / 5000.0});
  const auto at = [&](double offset) {
    return correlation(reference_time_s, reference, source_time_s, source, offset, grid);
  };
  const double step = std::max(0.5 * grid, longest_s / 400.0);
  double best = -1.0;
  double where = 0.0;
  std::vector<std::pair<double, double>> curve;
  for (double offset = -longest_s; offset <= longest_s + 1e-9; offset += step) {
    const double c = at(offset);
    curve.emplace_back(offset, c);
    if (c > best) {
      best = c;
      where = offset;
    }
  }
  // A rival peak away from the best one makes the event ambiguous (a periodic motion).
  double width = step;
  while (width < longest_s && std::max(at(where - width), at(where + width)) > 0.5 * (best + 0.5)) width *= 1.5;
  for (const auto& [offset, c] : curve) {
    if (std::abs(offset - where) > 3.0 * width && c > 0.97 * best) {
      throw InputError(fmt::format(
          "the event fits at {:.6g} s and at {:.6g} s alike; allowed: an event that does not repeat, or a smaller "
          "search range.",
          where, offset));
    }
  }
  if (best < 0.6) {
    throw InputError(fmt::format(
        "no common event was found: the best correlation is {:.2f}; allowed: records of the same motion with a "
        "correlation of at least 0.6.",
        best));
  }
  double fine = step;
  for (int round = 0; round < 40 && fine > 1e-4 * grid; ++round) {
    const double up = at(where + fine);
    const double down = at(where - fine);
    if (up > best || down > best) {
      where += up > down ? fine : -fine;
      best = std::max(up, down);
    } else {
      fine *= 0.5;
    }
  }
  // c(offset) = best - k d^2: noise of relative variance (1 - best^2) / best^2 over the independent samples.
  const double h = std::max(grid, step);
  const double k = std::max(1e-12, (2.0 * best - at(where + h) - at(where - h)) / (2.0 * h * h));
  const double samples = std::max(8.0, (reference_time_s.back() - reference_time_s.front()) / grid);
  const double noise = (1.0 - best * best) / (best * best) / samples;
  // An event between two samples is known to a sample of either record only.
  const double sampling = std::hypot(medianStep(reference_time_s), medianStep(source_time_s)) / std::sqrt(12.0);
  return {where, std::hypot(std::sqrt(noise * best / (2.0 * k)), sampling), best};
}

CampaignClockOffset estimateFromMotion(const Campaign& campaign, const ObservationSet& observations,
                                       const std::string& instrument, double longest_s) {
  static constexpr std::array<const char*, 3> signals{"pos_x_mm", "pos_y_mm", "pos_z_mm"};
  if (!campaign.log)
    throw InputError({campaign.path("log.csv"), ""}, "is missing, so there is no clock to compare with.");
  std::map<double, Eigen::Vector3d> places;
  for (const Observation& o : observations.rows)
    if (o.instrument == instrument) places.emplace(o.time_s, o.position_mm);
  if (places.size() < 8)
    throw InputError(
        fmt::format("{} has {} measuring times; allowed: at least 8 to find an offset.", instrument, places.size()));
  std::vector<double> time;
  for (const auto& [t, p] : places) time.push_back(t);
  OffsetEstimate best;
  std::string from;
  std::string failure =
      "the log has no pos_x_mm, pos_y_mm or pos_z_mm, so no motion is seen in both; enter the offset.";
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>* log = campaign.log->signal(signals[static_cast<std::size_t>(axis)]);
    if (log == nullptr) continue;
    std::vector<double> position;
    for (const auto& [t, p] : places) position.push_back(p[axis]);
    try {
      const OffsetEstimate e = estimateClockOffset(campaign.log->time_s(), *log, time, position, longest_s);
      if (e.correlation <= best.correlation) continue;
      best = e;
      from = signals[static_cast<std::size_t>(axis)];
    } catch (const InputError& e) {
      failure = e.what();
    }
  }
  if (from.empty()) throw InputError(failure);
  return {best.offset_s, best.sigma_s, fmt::format("motion seen in {}, correlation {:.3f}", from, best.correlation)};
}

void applyClockOffsets(ObservationSet& observations, const ClockOffsets& offsets) {
  for (Observation& o : observations.rows) {
    const auto found = offsets.find(o.instrument);
    if (found != offsets.end()) o.time_s += found->second.offset_s;
  }
}

void applyClockOffsets(Campaign& campaign, const ClockOffsets& offsets) {
  const auto log = offsets.find("log");
  if (log != offsets.end() && campaign.log) campaign.log.edit().moveClock(log->second.offset_s);
  if (!campaign.observations) return;
  const auto& rows = campaign.observations->rows;
  // Where nothing is moved, nothing is copied.
  if (std::any_of(rows.begin(), rows.end(), [&](const Observation& o) { return offsets.contains(o.instrument); }))
    applyClockOffsets(campaign.observations.edit(), offsets);
}

}  // namespace spindrift
