// SPDX-License-Identifier: Apache-2.0
// What an engineer does with models over time, one function per action, called by the command line and the pages.
//
// All accuracy is that of the FREE-RUN prediction: no measured output after the end of training is used, the state at
// the start of the test comes from the simulation. "No model" and "static regression on all temperatures" always stand
// beside.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/thermal/method_choice.h"
#include "core/thermal/response_fit.h"
#include "core/thermal/thermal_model.h"
#include "core/thermal/time_series.h"

namespace spindrift {

/// Rows with from_s <= t < to_s.
struct TimeRange {
  double from_s = 0.0;
  double to_s = 0.0;
  /// "FROM:TO" in seconds; an empty end is the end of the record. Throws InputError.
  [[nodiscard]] static TimeRange parse(const std::string& text, const std::string& option);
};

struct IdentifyRequest {
  std::filesystem::path log;
  std::string output;
  std::vector<std::string> inputs;  ///< empty: automatic
  /// Automatic, but chosen already for several outputs (core/workflows/thermal_outputs.h); empty: for this one alone.
  std::vector<std::string> shared_inputs;
  TimeRange train;
  TimeRange test;
  double period_s = 0.0;                    ///< 0: automatic
  std::optional<std::array<int, 3>> order;  ///< na, nb, nk
  std::string method;            ///< "" (chosen by blocked evidence; arx with an order), "response", "arx", "oe"
  std::string temperature_unit;  ///< "", "degC", "K", "degF"
  bool peers = false;            ///< also first-order ARX and ridge over lagged inputs (some 0.1 ... 1 s)
};

/// Free-run quality over one range. p2p in the output's unit (P2 (4)), fit in % (P2 (5)), rmse in the output's unit.
struct RunQuality {
  std::size_t samples = 0;
  double fit_percent = 0.0;
  double p2p = 0.0;
  double rmse = 0.0;
  [[nodiscard]] nlohmann::json json() const;
};

struct ModelComparison {
  std::string name;
  RunQuality train;
  RunQuality test;
  std::string note;
};

/// What is left over after training, for judging the structure.
struct ResidualDiagnosis {
  double period_s = 0.0;
  std::vector<double> autocorrelation;  ///< lags 0 ... 25 of the training residual
  double whiteness_p_value =
      0.0;  ///< Ljung-Box over 25 lags; small: the residual is not white (drift, missing dynamics)
  struct Cross {
    std::string input;
    double largest = 0.0;  ///< largest correlation of the residual with the past of this input, in absolute value
    double lag_s = 0.0;
    double limit = 0.0;  ///< 99 % limit for unrelated signals with these autocorrelations
  };
  std::vector<Cross> cross;
};

struct IdentifyResult {
  ThermalModel model;
  std::vector<std::string> inputs;  ///< names kept
  std::vector<InputVerdict> verdicts;
  std::vector<MethodEvidence> methods;  ///< empty if the method was asked for
  RunQuality train;
  RunQuality test;
  std::vector<ModelComparison> plain;
  std::vector<StepResponse> step_responses;
  ResidualDiagnosis residual;
  nlohmann::json structure = nlohmann::json::object();  ///< of arx and oe: orders, coefficients, poles, time constants
  std::vector<double> time_s;
  std::vector<double> measured;  ///< NaN where missing
  std::vector<double> predicted;
  std::vector<double> left;   ///< measured minus predicted
  std::vector<double> sigma;  ///< may be empty
  std::vector<char> outside;
  double left_out_rms = 0.0;
  double elapsed_ms = 0.0;
  bool good_enough = true;  ///< false: no better than the plain models in the test range
  std::vector<std::string> notes;

  /// Keys of FORMATS.md.
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  /// `time_s,measured,predicted` over all rows, then sigma and outside; missing values are empty.
  void writePrediction(const std::filesystem::path& file) const;
};

[[nodiscard]] IdentifyResult identifyThermalModel(const IdentifyRequest& request, const JobContext& job);
/// The same on a series already read (pages keep it in memory).
[[nodiscard]] IdentifyResult identifyThermalModel(TimeSeries series, const IdentifyRequest& request,
                                                  const JobContext& job);

/// Quality of a prediction over a range; rows without a measured value are skipped.
[[nodiscard]] RunQuality runQuality(std::span<const double> time_s, std::span<const double> measured,
                                    std::span<const double> predicted, const TimeRange& range);

}  // namespace spindrift
