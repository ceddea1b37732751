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
//           time. With `context` signals c_i (the height of the spindle, say) the gain is gain + sum g_i c_i with
//           constant g_i learned from the measurements, so that what was learned at one height holds when it is left.
//           A measurement further from the prediction than `gate_sigma` standard uncertainties of their difference is
//           refused: a chip under the probe says nothing of the machine. A second one in a row on the same side is
//           believed: then it is the machine, and the offset has jumped by what it is off. The first of all is taken as
//           it is, it defines zero.
// Units: those of the output; time s. A prediction between two measurements only uses measurements before it.
// Source: P2 section 4, P1 section 4 (state update), Kalman 1960.
#pragma once

#include <Eigen/Core>
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
  /// kalman: signals that the gain may depend on, one value per row each, scaled to about -1 ... 1; may be empty.
  std::vector<std::vector<double>> context;
  double context_sigma = 0.5;  ///< kalman: of each g_i before the first measurement
  double gate_sigma = 5.0;     ///< kalman: beyond it a single measurement is refused

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
  bool used = true;  ///< false: a ratio of next to nothing, or a single measurement beyond the gate
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

/// The recursion behind `kalman`, for use outside a replay. `context`: as many values as the options have signals.
class GainOffsetFilter {
 public:
  explicit GainOffsetFilter(const UpdateOptions& options);
  void advance(double dt_s);
  /// False, and nothing changes, for a single measurement beyond the gate. `model_sigma`: how far the simulated value
  /// may be off beside gain and offset; it only widens the gate.
  [[nodiscard]] bool measure(double measured, double simulated, std::span<const double> context = {},
                             double model_sigma = 0.0);
  [[nodiscard]] double value(double simulated, std::span<const double> context = {}) const;
  [[nodiscard]] double sigma(double simulated, std::span<const double> context = {}) const;
  [[nodiscard]] double gain() const { return state_[0]; }  ///< where every context signal is 0
  [[nodiscard]] double offset() const { return state_[1]; }
  [[nodiscard]] double gainSigma() const;
  [[nodiscard]] double offsetSigma() const;

  /// (gain, offset, g_1, ...) and its covariance, to go on from after a restart.
  [[nodiscard]] const Eigen::VectorXd& state() const noexcept { return state_; }
  [[nodiscard]] const Eigen::MatrixXd& covariance() const noexcept { return covariance_; }
  /// Throws InputError: another size, not finite.
  void restore(const Eigen::VectorXd& state, const Eigen::MatrixXd& covariance);

 private:
  /// What the state (gain, offset, g_1, ...) is multiplied with.
  [[nodiscard]] Eigen::VectorXd row(double simulated, std::span<const double> context) const;

  UpdateOptions options_;
  Eigen::VectorXd state_;
  Eigen::MatrixXd covariance_;
  bool begun_ = false;       ///< something was measured
  double refused_by_ = 0.0;  ///< what the last measurement was off if it was beyond the gate, else 0
};

}  // namespace spindrift
