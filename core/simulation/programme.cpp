// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/programme.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"

namespace spindrift {
namespace {

/// Times at which a signal takes a new value.
std::vector<double> switchTimes(Random& random, const RandomProgrammeOptions& options) {
  std::vector<double> times;
  double time = options.idle_s + random.uniform(0.0, 0.5) * options.mean_hold_s;
  while (time < options.duration_s) {
    times.push_back(std::round(time));
    const double hold = -std::log(1.0 - random.uniform()) * options.mean_hold_s;
    time += std::clamp(hold, 0.25 * options.mean_hold_s, 3.0 * options.mean_hold_s);
  }
  return times;
}

/// A value of the list other than the present one, if there is another.
double another(Random& random, const std::vector<double>& values, double present) {
  if (values.empty()) return present;
  for (int attempt = 0; attempt < 20; ++attempt) {
    const double value = values[random.index(values.size())];
    if (value != present || values.size() == 1) return value;
  }
  return present;
}

}  // namespace

Programme::Programme(std::vector<ProgrammeSegment> segments) : segments_(std::move(segments)) {
  SPINDRIFT_ASSERT(!segments_.empty(), "a program without segments");
  SPINDRIFT_ASSERT(std::is_sorted(segments_.begin(), segments_.end(),
                                  [](const auto& a, const auto& b) { return a.from_s < b.from_s; }),
                   "segments out of order");
}

void Programme::append(const ProgrammeSegment& segment) {
  SPINDRIFT_ASSERT(segments_.empty() || segment.from_s >= segments_.back().from_s, "segments in order of time");
  if (!segments_.empty() && segments_.back().from_s == segment.from_s) segments_.pop_back();
  segments_.push_back(segment);
}

const ProgrammeSegment& Programme::at(double time_s) const {
  const auto after = std::upper_bound(segments_.begin(), segments_.end(), time_s,
                                      [](double t, const ProgrammeSegment& s) { return t < s.from_s; });
  return after == segments_.begin() ? segments_.front() : *(after - 1);
}

Programme randomProgramme(const MachineDescription& machine, const RandomProgrammeOptions& options,
                          std::uint64_t seed) {
  Random root(seed);
  struct Change {
    double time_s = 0.0;
    int signal = 0;  // 0 speed, 1..3 feeds, 4..6 positions, 7 C, 8 coolant, 9 instrument
    double value = 0.0;
  };
  std::vector<Change> changes;
  ProgrammeSegment first;
  for (int axis = 0; axis < 3; ++axis) {
    const LinearAxis* a = machine.findAxis(std::string(1, "XYZ"[axis]));
    const double part = options.places.size() == 1 ? options.places[0] : 0.5;
    if (a != nullptr) {
      first.position_mm[static_cast<std::size_t>(axis)] = a->travel_mm[0] + part * (a->travel_mm[1] - a->travel_mm[0]);
    }
  }
  first.stroke_part.fill(options.stroke_part);
  first.instrument_on = options.instrument_on_s <= 0.0;
  const auto draw = [&](int signal, const std::vector<double>& values, double start) {
    Random random = root.split();
    double value = start;
    for (const double time : switchTimes(random, options)) {
      value = another(random, values, value);
      changes.push_back({time, signal, value});
    }
  };
  draw(0, options.speeds_rpm, 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const LinearAxis* a = machine.findAxis(std::string(1, "XYZ"[axis]));
    draw(1 + axis, a != nullptr ? options.feeds_mm_min : std::vector<double>{0.0}, 0.0);
    std::vector<double> places;
    if (a != nullptr && options.move) {
      for (const double part : options.places) {
        places.push_back(a->travel_mm[0] + part * (a->travel_mm[1] - a->travel_mm[0]));
      }
    }
    draw(4 + axis, places, first.position_mm[static_cast<std::size_t>(axis)]);
  }
  draw(7, machine.rotary.empty() ? std::vector<double>{0.0} : options.c_speeds_rpm, 0.0);
  draw(8, options.coolant ? std::vector<double>{0.0, 1.0} : std::vector<double>{0.0}, 0.0);
  if (options.instrument_on_s > 0.0) changes.push_back({options.instrument_on_s, 9, 1.0});
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.time_s < b.time_s; });

  std::vector<ProgrammeSegment> segments{first};
  for (const Change& change : changes) {
    if (change.time_s > segments.back().from_s) {
      segments.push_back(segments.back());
      segments.back().from_s = change.time_s;
    }
    ProgrammeSegment& s = segments.back();
    if (change.signal == 0) s.spindle_rpm = change.value;
    if (change.signal >= 1 && change.signal <= 3)
      s.feed_mm_min[static_cast<std::size_t>(change.signal - 1)] = change.value;
    if (change.signal >= 4 && change.signal <= 6)
      s.position_mm[static_cast<std::size_t>(change.signal - 4)] = change.value;
    if (change.signal == 7) s.c_rpm = change.value;
    if (change.signal == 8) s.coolant = change.value > 0.5;
    if (change.signal == 9) s.instrument_on = change.value > 0.5;
  }
  return Programme(std::move(segments));
}

}  // namespace spindrift
