// SPDX-License-Identifier: Apache-2.0
// Keeping a model true with sparse on-machine measurements.
//
//   gain    P2 (7)-(8): gain = measured / simulated at each measurement, both relative to the first measurement.
//   Explodes when the
//           simulation is near zero: `gain_bound` limits the ratio (infinite: as printed), measurements with
//           |simulated| below `smallest_simulated` can be skipped.
//   arx     state update (TALC): the simulated state is set to the measurement; what was corrected fades with the
//   model's slowest
//           time constant, as it does in an ARX model that goes on in free run.
//   kalman  deviation = gain * simulated + offset; both drift as random walks (gain towards nothing, offset with the
//   memory of the
//           model's remainder); Kalman filter with the measurement's uncertainty. Gives a standard uncertainty at every
//           time.
// Units: those of the output; time s. A prediction between two measurements only uses measurements before it.
// Source: P2 section 4, P1 section 4 (state update), Kalman 1960.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace spindrift {

enum class UpdateKind { None, Gain, Arx, Kalman };

struct UpdateOptions {
  UpdateKind kind = UpdateKind::Kalman;
  double interval_s = 3600.0;      ///< > 0: measurements at start + k * interval
  double start_s = 0.0;            ///< first measurement of the cycle; it also defines zero for `gain`
  double measurement_sigma = 0.5;  ///< of one on-machine measurement
  double gain_bound = std::numeric_limits<double>::infinity();
  double smallest_simulated = 0.0;
  double slowest_tau_s = 7200.0;        ///< arx: memory of the state
  double gain_drift_per_sqrt_h = 0.10;  ///< kalman
  double offset_sigma = 5.0;            ///< kalman: size of the model's remainder
  double offset_tau_s = 14400.0;        ///< kalman: its memory
  double gain_sigma = 0.2;              ///< kalman: of the model's gain before the first measurement

  /// Throws InputError.
  void validate() const;
};

struct UpdateEvent {
  double time_s = 0.0;
  double measured = 0.0;
  double predicted_before = 0.0;  ///< by the model as it was before this measurement
  double gain = 1.0;
  double offset = 0.0;
  double gain_sigma = 0.0;  ///< kalman only
  double offset_sigma = 0.0;
  bool used = true;  ///< false: ratio refused
};

struct UpdateRun {
  std::vector<double> predicted;  ///< per row
  std::vector<double> sigma;      ///< kalman: standard uncertainty per row, else empty
  std::vector<UpdateEvent> events;
};

/// `measured` may be NaN where nothing was measured; a measurement is the first row at or after its time with a value.
[[nodiscard]] UpdateRun runWithUpdates(std::span<const double> time_s, std::span<const double> measured,
                                       std::span<const double> simulated, const UpdateOptions& options);

/// One point of P2 Fig. 9.
struct IntervalPoint {
  double interval_s = 0.0;  ///< infinite: without update
  double fit_percent = 0.0;
  double p2p = 0.0;
  double rms = 0.0;
  std::size_t measurements = 0;
};
[[nodiscard]] std::vector<IntervalPoint> sweepIntervals(std::span<const double> time_s,
                                                        std::span<const double> measured,
                                                        std::span<const double> simulated, const UpdateOptions& options,
                                                        const std::vector<double>& intervals_s);

/// The recursion behind `kalman`, for use outside a replay.
class GainOffsetFilter {
 public:
  explicit GainOffsetFilter(const UpdateOptions& options);
  void advance(double dt_s);
  void measure(double measured, double simulated);
  [[nodiscard]] double value(double simulated) const { return gain_ * simulated + offset_; }
  [[nodiscard]] double sigma(double simulated) const;
  [[nodiscard]] double gain() const { return gain_; }
  [[nodiscard]] double offset() const { return offset_; }
  [[nodiscard]] double gainSigma() const;
  [[nodiscard]] double offsetSigma() const;

 private:
  UpdateOptions options_;
  double gain_ = 1.0;
  double offset_ = 0.0;
  double pgg_ = 0.0;
  double pgo_ = 0.0;
  double poo_ = 0.0;
};

}  // namespace spindrift
