// SPDX-License-Identifier: Apache-2.0
// The thermal model inside a machine controller: a fixed-size object whose step neither allocates, throws, locks nor
// calls the system.
//
//   value_o = -(offset_o + sum gain (x - reference)), bounded to +-limit_o, changing at most slew_o per second
//
// The output is the compensation (minus the predicted deviation), in the unit of the model's outputs. Inputs are
// checked in every step: not finite, outside the allowed range, or stale (no new value for longer than `stale_after_s`;
// also a clock that does not run forwards). While an input is bad its last good value is used for `stale_after_s`;
// after that the compensator is in fall-back: it fades its output to zero with the slew limit, until all inputs are
// good again for `recover_after_s` without a break (a last good value that is held does not count). Should the model's
// own value of an output ever not be finite, all outputs are held and faded in the same way and the lags start again at
// rest. Configuration (load) happens outside the control loop and reports problems as a sentence; everything else is
// noexcept.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace spindrift {

struct ThermalModel;

enum class CompensatorState : std::uint8_t {
  Empty,     ///< no model loaded: outputs are zero
  Running,   ///< all inputs good
  Holding,   ///< an input is bad for a short time: its last good value is used
  Fallback,  ///< an input has been bad too long: the output fades to zero
};

struct CompensatorLimits {
  double limit = 200.0;           ///< of the magnitude of every output, um or urad
  double slew_per_s = 2.0;        ///< of the change of every output, um/s or urad/s
  double stale_after_s = 60.0;    ///< an input without a new good value for longer is stale
  double recover_after_s = 10.0;  ///< good again for this long before the compensation returns
  double range_margin = 0.5;      ///< input beyond its training range by more than this part of the range is impossible
  double minimum_margin =
      20.0;  ///< but never less than this, in the input's unit (ignored for speeds, where the range decides)
  /// Of the sum of measured offsets that `update` takes, um or urad; never more than `limit`: an output that stands at
  /// its limit for a wild measurement compensates nothing.
  double update_limit = 100.0;
  double least_gain = 0.2;  ///< factors outside are no measurement of the same machine
  double most_gain = 5.0;
  bool forced = false;  ///< take a model that its identification called not good enough; the status says so
};

/// What a controller should show beside the outputs.
struct CompensatorStatus {
  CompensatorState state = CompensatorState::Empty;
  int refused_input = -1;         ///< first input that was refused in the last step, -1 if none
  int refused_update = -1;        ///< output whose last measured update was refused as impossible, -1 if none
  bool forced = false;            ///< the model was called not good enough and was loaded all the same
  bool value_not_finite = false;  ///< the model's own value was no number in the last step: its lags start again
  int outside_training = -1;      ///< first input used in the last step that lies outside its range of training, -1 if
                                  ///< none: the model extrapolates
  int limited_output = -1;        ///< first output that stands at its limit, -1 if none: more would be needed
  /// How long what the machine did before the first good step counts, s: three times the longest time constant, of
  /// which 5 % is left then. The lags began at rest at the inputs of that step, which is right for a machine that has
  /// stood or run evenly as long; a controller that was switched on beside a machine that was warming up or cooling
  /// down is off until then by at most what the machine still had to go. 0: settled.
  double settling_s = 0.0;
};

class Compensator {
 public:
  static constexpr int maximum_outputs = 8;
  static constexpr int maximum_inputs = 32;
  static constexpr int maximum_lags = 1024;  ///< over all outputs

  /// Takes a model for a fixed cycle time. Returns an empty text, or a sentence why not: too large, cycle not positive,
  /// a verdict "not good enough" (unless forced), an output without terms, of an unknown unit or with numbers that are
  /// not finite. Resets all states.
  [[nodiscard]] std::string load(const ThermalModel& model, double cycle_s, const CompensatorLimits& limits = {});

  [[nodiscard]] int inputCount() const noexcept { return inputs_; }
  [[nodiscard]] int outputCount() const noexcept { return outputs_; }
  /// Name of an input in the order that `step` wants ("" beyond the count).
  [[nodiscard]] const char* inputName(int index) const noexcept;
  [[nodiscard]] const char* outputName(int index) const noexcept;

  /// One cycle. `inputs`: inputCount() values, or null if none has come: all are refused; `age_s`: age of each value,
  /// or null if all are fresh; `outputs`: outputCount() compensation values. The first good step puts every lag at rest
  /// at its input.
  CompensatorState step(const double* inputs, const double* age_s, double* outputs) noexcept;

  [[nodiscard]] CompensatorState state() const noexcept { return state_; }
  /// First input that was refused in the last step, -1 if none.
  [[nodiscard]] int refusedInput() const noexcept { return refused_; }
  [[nodiscard]] CompensatorStatus status() const noexcept;
  /// Shifts the model's offset of one output after an on-machine measurement: new offset = old + correction. Gain
  /// likewise as a factor. Not finite, or outside the limits: nothing changes, false, and the status says so until an
  /// update of that output is taken.
  bool update(int output, double gain_factor, double offset_correction) noexcept;
  /// Forgets what the inputs were and for how long they have been bad; the next good step puts every lag at rest at its
  /// input. The outputs stay where they are and go on from there with the slew limit, since an axis follows them; the
  /// gain and offset that `update` has taken stay too. `load` forgets all.
  void reset() noexcept;

 private:
  struct Transform {
    int source = 0;
    double power = 1.0;
    double inverse_scale = 1.0;
  };
  static double powered(double magnitude, double power) noexcept;
  void sweep() noexcept;
  void catchUp(int source, double gap_s) noexcept;

  int inputs_ = 0;
  int outputs_ = 0;
  int transforms_ = 0;
  int lags_ = 0;
  CompensatorState state_ = CompensatorState::Empty;
  int refused_ = -1;
  bool started_ = false;
  bool was_bad_ = false;  ///< an input was refused in the last step
  double cycle_s_ = 0.0;
  bool fallback_ = false;
  double good_for_s_ = 0.0;  ///< in fall-back: how long nothing has been refused
  CompensatorLimits limits_;
  double longest_lag_s_ = 0.0;  ///< of those that the outputs depend on
  double since_start_s_ = 0.0;  ///< since the lags began at rest
  double broken_for_s_ = 0.0;   ///< how long the model's own value has not been finite
  int refused_update_ = -1;
  bool forced_ = false;
  std::array<std::string, maximum_inputs> input_names_;  // written by `load` alone
  std::array<std::string, maximum_outputs> output_names_;
  std::array<bool, maximum_inputs> size_only_{};  ///< speeds and feeds: heat has no direction
  std::array<double, maximum_inputs> low_{};
  std::array<double, maximum_inputs> high_{};
  std::array<double, maximum_inputs> train_low_{};
  std::array<double, maximum_inputs> train_high_{};
  std::array<double, maximum_inputs> last_good_{};
  std::array<double, maximum_inputs> bad_for_s_{};
  std::array<Transform, 3 * maximum_inputs> transform_{};
  std::array<double, 3 * maximum_inputs> now_{};
  std::array<double, 3 * maximum_inputs> before_{};
  // Lags, structure of arrays. The state of a lag carries its gain: v = gain w, so that an output is a plain sum. The
  // lags of one output stand in rounds: round r holds the (r+1)-th lag of every input that has one, inputs in the order
  // `order_` (most lags first), so that a round runs over the start of one contiguous array of inputs: no index per
  // lag.
  alignas(64) std::array<double, maximum_lags> a_{};
  alignas(64) std::array<double, maximum_lags> c_{};
  alignas(64) std::array<double, maximum_lags> rest_{};  ///< v at rest per unit of input
  alignas(64) std::array<double, maximum_lags> v_{};
  int swept_ = 0;  ///< next lag that is looked at for having decayed to nothing
  std::array<int, maximum_lags> round_size_{};
  std::array<int, maximum_outputs + 1> first_{};        ///< first lag of each output
  std::array<int, maximum_outputs + 1> first_round_{};  ///< first round of each output
  std::array<std::array<int, 3 * maximum_inputs>, maximum_outputs> order_{};
  alignas(64) std::array<std::array<double, 3 * maximum_inputs>, maximum_outputs> direct_{};  ///< in that order
  std::array<int, maximum_outputs> used_{};         ///< inputs with lags in this output
  std::array<bool, maximum_outputs> same_order_{};  ///< as the output before
  std::array<double, maximum_outputs> offset_{};
  std::array<double, maximum_outputs> gain_factor_{};
  std::array<double, maximum_outputs> correction_{};
  std::array<double, maximum_outputs> output_{};
};

}  // namespace spindrift
