// SPDX-License-Identifier: GPL-3.0-or-later
// Made records of a spindle in one kind of operation for as long as they last, with their truth: what intervals of a
// `response` model are counted on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/random.h"
#include "core/thermal/response_fit.h"
#include "core/thermal/thermal_model.h"
#include "core/thermal/time_series.h"

namespace spindrift::testing {

struct ResponseRun {
  bool sensors = true;    ///< three noisy temperatures beside the speed
  double noise_um = 0.3;  ///< white, of every row
  double drift_um = 0.0;  ///< standard deviation of a zero that wanders with a time constant of half an hour
};

struct ResponseRecord {
  TimeSeries series;          ///< output `ez_um`, rows of 60 s over 30 h
  std::vector<double> truth;  ///< of the output, without noise and drift
  double gain_um[2] = {};     ///< at full speed
  double tau_s[2] = {};       ///< on no grid
  double exponent = 1.0;      ///< of the speed
  double full_rpm = 4000.0;
};

inline ResponseRecord responseRun(std::uint64_t seed, const ResponseRun& kind) {
  Random random(seed);
  ResponseRecord out;
  TimeSeries& s = out.series;
  s.file = "response_run.csv";
  constexpr double dt = 60.0;
  constexpr std::size_t rows = 1800;
  out.exponent = random.uniform(1.0, 1.8);
  out.gain_um[0] = random.uniform(5.0, 20.0);
  out.gain_um[1] = random.uniform(10.0, 30.0);
  out.tau_s[0] = random.uniform(700.0, 1600.0);
  out.tau_s[1] = random.uniform(4000.0, 9000.0);
  std::vector<double> rpm;
  std::vector<double> heat;
  std::vector<double> room;
  double speed = 0.0;
  double until_s = 1800.0;
  const double phase = random.uniform(0.0, 6.28);
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) * dt;
    s.time_s.push_back(t);
    if (t >= until_s) {
      speed = speed > 0.0 && random.uniform() < 0.5 ? 0.0 : 500.0 * std::floor(random.uniform(1.0, 9.0));
      until_s = t + random.uniform(1200.0, 7200.0);
    }
    rpm.push_back(speed);
    heat.push_back(std::pow(speed / out.full_rpm, out.exponent));
    room.push_back(22.0 + 1.5 * std::sin(2.0 * M_PI * t / 43200.0 + phase));
  }
  const std::vector<double> housing = lagFiltered(s.time_s, heat, out.tau_s[0], true);
  const std::vector<double> head = lagFiltered(s.time_s, heat, out.tau_s[1], true);
  const std::vector<double> frame = lagFiltered(s.time_s, room, 9000.0, false);
  std::vector<double> y;
  std::vector<double> of_housing;
  std::vector<double> of_head;
  std::vector<double> of_room;
  double drift = random.normal(0.0, kind.drift_um);
  const double keep = std::exp(-dt / 1800.0);
  for (std::size_t k = 0; k < rows; ++k) {
    drift = keep * drift + random.normal(0.0, kind.drift_um * std::sqrt(1.0 - keep * keep));
    out.truth.push_back(out.gain_um[0] * housing[k] + out.gain_um[1] * head[k] -
                        (kind.sensors ? 3.0 * (frame[k] - 22.0) : 0.0));
    y.push_back(out.truth[k] + drift + random.normal(0.0, kind.noise_um));
    of_housing.push_back(room[k] + 9.0 * housing[k] + random.normal(0.0, 0.02));
    of_head.push_back(frame[k] + 4.0 * head[k] + random.normal(0.0, 0.02));
    of_room.push_back(room[k] + random.normal(0.0, 0.02));
  }
  s.signals.push_back({"spindle_rpm", SignalKind::Speed, rpm});
  if (kind.sensors) {
    s.signals.push_back({"T_housing_degC", SignalKind::Temperature, of_housing});
    s.signals.push_back({"T_head_degC", SignalKind::Temperature, of_head});
    s.signals.push_back({"T_room_degC", SignalKind::Temperature, of_room});
  }
  s.signals.push_back({"ez_um", SignalKind::Displacement, y});
  return out;
}

/// What the 95 % intervals of the model of the first 60 % of a record hold.
struct ResponseCoverage {
  std::vector<char> measured;  ///< at rows of the rest, an hour apart, in patterns that training holds: elsewhere they
                               ///< are wider on purpose
  std::vector<char> truth;     ///< at the same rows, by the model's own uncertainty without noise
  std::vector<char> step;      ///< at full speed, after 5 min ... 4 h; empty with sensors, which share the response
  double calibration = 1.0;
};

inline ResponseCoverage responseCoverage(const ResponseRecord& record) {
  ResponseCoverage out;
  const TimeSeries& s = record.series;
  const double cut = 0.6 * s.time_s.back();
  const ResponseFitResult fit = fitResponse(s, "ez_um", automaticInputs(s, "ez_um"), 0.0, cut, {}, {});
  out.calibration = fit.calibration;
  const ThermalOutput& output = fit.model.outputs.front();
  const double factor = output.coverageFactor();
  const ThermalPrediction prediction = fit.model.predict(s, 0);
  const Eigen::MatrixXd x = fit.model.features(s, 0);
  const auto& y = s.at("ez_um").values;
  for (std::size_t r = 0; r < y.size(); r += 60) {
    if (s.time_s[r] < cut || prediction.outside[r] != 0) continue;
    const auto row = static_cast<Eigen::Index>(r);
    const double own = std::sqrt(std::max(0.0, x.row(row).dot(output.covariance * x.row(row).transpose())));
    out.measured.push_back(std::abs(y[r] - prediction.value[r]) <= factor * prediction.sigma[r] ? 1 : 0);
    out.truth.push_back(std::abs(record.truth[r] - prediction.value[r]) <= factor * own ? 1 : 0);
  }
  if (s.signals.size() > 2) return out;
  const StepResponse step = fit.model.stepResponse(0, "spindle_rpm", 200);
  for (const double after_s : {300.0, 1200.0, 3600.0, 14400.0}) {
    std::size_t k = 0;
    while (k + 1 < step.time_s.size() && step.time_s[k] < after_s) ++k;
    double truth = 0.0;
    for (int i = 0; i < 2; ++i)
      truth += record.gain_um[i] * std::pow(step.step / record.full_rpm, record.exponent) *
               -std::expm1(-step.time_s[k] / record.tau_s[i]);
    out.step.push_back(std::abs(step.value[k] - truth) <= factor * step.sigma[k] ? 1 : 0);
  }
  return out;
}

}  // namespace spindrift::testing
