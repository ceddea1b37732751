// SPDX-License-Identifier: Apache-2.0
// A dynamic thermal model in continuous time: every output is an offset plus a sum of first-order lags of its inputs.
//
//   y_o(t) = offset_o + sum_k gain_ok (x_ok(t) - reference_i(k)),   tau_ok dx_ok/dt = f_i(u_i(t)) - x_ok,
//   f_i(u) = sign(u) |u / scale_i|^power_i
//
// This is the modal form of every stable transfer function with real, distinct poles (heat flow has no others). The
// lags are integrated exactly for inputs that hold or run linearly between rows, at any spacing of the rows, so a pole
// of hours survives a sampling of milliseconds. tau = 0 is the input itself. At the first row every lag is at rest at
// the input's value. Units: y in um or urad (the output's unit), u in the unit of the signal, tau s, gain in output
// unit per unit of f. A model carries the covariance of its coefficients and the pattern of operation it was trained in
// (core/thermal/training_pattern.h); a prediction in a new pattern is marked and its uncertainty grows with the
// distance.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/thermal/time_series.h"
#include "core/thermal/training_pattern.h"

namespace spindrift {

struct ThermalInput {
  std::string name;  ///< column of the log; the same column may appear with several powers
  SignalKind kind = SignalKind::Temperature;
  double power = 1.0;
  double scale = 1.0;
  double reference = 0.0;  ///< of f(u)
  double train_min = 0.0;  ///< range of u in the training data
  double train_max = 0.0;
  /// What acts of u: of speeds and feeds the size, for heat has no direction.
  [[nodiscard]] double acting(double u) const noexcept { return isDriven(kind) ? std::abs(u) : u; }
  [[nodiscard]] double transformed(double u) const noexcept;
};

struct LagTerm {
  int input = 0;
  double tau_s = 0.0;
  double gain = 0.0;
};

/// What the identification said of a model after running it free over rows it had not seen.
struct ThermalVerdict {
  bool good_enough = true;  ///< false: no better there than a plain model; not to be compensated with
  double test_from_s = 0.0;
  double test_to_s = 0.0;
  double test_rms = 0.0;  ///< of measured minus predicted, in the output's unit
  std::string reason;     ///< why it is not good enough; empty if it is
};

struct ThermalOutput {
  std::string name;
  std::string unit;  ///< "um", "urad"
  double offset = 0.0;
  std::vector<LagTerm> terms;
  /// Of (offset, gains), size 1 + terms, or of (offset, gains, ln tau), size 1 + 2 terms; empty if not known.
  Eigen::MatrixXd covariance;
  double degrees_of_freedom = 0.0;         ///< of that covariance; 0: many
  double noise_sigma = 0.0;                ///< stationary standard deviation of what the model leaves in training
  double noise_tau_s = 0.0;                ///< correlation time of that remainder
  double uncertainty_factor = 1.0;         ///< of the standard uncertainty; 1 where the covariance itself is calibrated
  std::optional<ThermalVerdict> verdict;   ///< none: nobody has judged it
  std::optional<TrainingPattern> pattern;  ///< of the inputs of this output; none: only the range of each is known
  /// Half width of an interval of this probability in standard uncertainties (Student's where the degrees are known).
  [[nodiscard]] double coverageFactor(double probability = 0.95) const;
};

/// Response of one output to a unit step of one input (from the train range's middle), with standard uncertainty.
struct StepResponse {
  std::string input;
  std::string unit;
  double step = 1.0;  ///< size of the step of the input in its own unit, from 0 for speeds
  std::vector<double> time_s;
  std::vector<double> value;
  std::vector<double> sigma;
  double coverage_factor = 1.96;  ///< half width of the 95 % interval in sigma
  double final_value = 0.0;
  double final_sigma = 0.0;
  double time_to_63_percent_s = 0.0;  ///< NaN if the response never stays beyond 63 % of its end
};

struct ThermalPrediction {
  std::vector<double> value;
  std::vector<double> sigma;       ///< one standard uncertainty; empty if the model has no covariance
  std::vector<char> outside;       ///< 1 where the inputs stand as they never stood together in training
  std::vector<std::string> notes;  ///< how many rows, and which inputs leave their own range by how much
};

struct ThermalModel {
  std::string kind = "lags";  ///< "response", "output_error", "arx", "lags": how it was found
  std::vector<ThermalInput> inputs;
  std::vector<ThermalOutput> outputs;
  double train_from_s = 0.0;
  double train_to_s = 0.0;
  double period_s = 0.0;
  std::string source;  ///< file it was identified from

  [[nodiscard]] const ThermalOutput* findOutput(std::string_view name) const noexcept;
  /// Free run over a series: no measured output is used. Throws InputError if an input is not in the series.
  [[nodiscard]] ThermalPrediction predict(const TimeSeries& series, std::size_t output) const;
  /// 1 where the inputs of an output stand in a pattern that training does not hold; without a pattern in the model,
  /// where an input leaves its range by more than 2 % of it. Throws as `predict`.
  [[nodiscard]] std::vector<char> outsideTraining(const TimeSeries& series, std::size_t output) const;
  /// The pattern of the inputs of an output over from_s <= t < to_s of the series it was trained on.
  void learnPattern(const TimeSeries& series, std::size_t output, double from_s, double to_s);
  /// What the prediction changes per change of the coefficients (offset, gains and, where the covariance holds them, ln
  /// tau) at every row: rows x coefficients. The first 1 + terms columns times (offset, gains) are the prediction; the
  /// covariance of the model's error at two rows is row' * covariance * row. Throws as `predict`.
  [[nodiscard]] Eigen::MatrixXd features(const TimeSeries& series, std::size_t output) const;
  [[nodiscard]] StepResponse stepResponse(std::size_t output, const std::string& input, std::size_t points = 60) const;

  [[nodiscard]] nlohmann::json json() const;
  /// A `spindrift-thermal-model` document. Throws InputError for anything that is not one: unknown kind, a negative
  /// time constant, ...
  [[nodiscard]] static ThermalModel read(const std::filesystem::path& file);
  [[nodiscard]] static ThermalModel parse(const class JsonNode& root);
  void write(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] std::vector<char> outsideTraining(const std::vector<double>& novelty, const TimeSeries& series,
                                                  std::size_t output, std::vector<std::string>* notes) const;
};

/// x(t) of one lag over rows of any spacing. `hold`: u keeps its value until the next row, else it runs linearly.
[[nodiscard]] std::vector<double> lagFiltered(std::span<const double> time_s, std::span<const double> u, double tau_s,
                                              bool hold);

/// dx / d ln tau of that lag, exact for the same rows (0 for tau = 0).
[[nodiscard]] std::vector<double> lagSensitivity(std::span<const double> time_s, std::span<const double> u,
                                                 double tau_s, bool hold);

/// Coefficients of one exact step of a lag: x1 = a x0 + b0 u0 + b1 u1.
struct LagStep {
  double a = 0.0;
  double b0 = 0.0;
  double b1 = 1.0;
};
[[nodiscard]] LagStep lagStep(double dt_s, double tau_s, bool hold) noexcept;

}  // namespace spindrift
