// SPDX-License-Identifier: Apache-2.0
// An error model as a sum of effects of the catalogue: predict, save, load (model.json of FORMATS.md).
//
//   deviation = base(query) + sum over effects of gain * q(t) * shape(place)       um / urad
//
// The model keeps the drivers of the log it was made for; it predicts at any time of that log. Without a base it holds
// the effects alone.
#pragma once

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/discrepancy/drivers.h"
#include "core/discrepancy/effect_search.h"
#include "core/machine/error_model.h"

namespace spindrift {

/// One effect of a model with all its numbers.
struct ModelEffect {
  Effect effect;
  EffectVariant variant;
  std::vector<double> parameters;  ///< non-linear, see parameterNames(variant)
  std::vector<double> parameter_uncertainty;
  Eigen::VectorXd gains;  ///< input-major
  Eigen::VectorXd gain_uncertainty;
  Eigen::MatrixXd covariance;  ///< of gains, then non-linear parameters
  std::string source;          ///< "fit of campaign X"

  /// Names of the gains with units: "gain_um_per_krpm".
  [[nodiscard]] std::vector<std::string> gainNames(const DriverTable& drivers) const;
};

class EffectModel : public ErrorModel {
 public:
  EffectModel(std::shared_ptr<const DriverTable> drivers, std::vector<ModelEffect> effects,
              std::shared_ptr<const ErrorModel> base = nullptr, std::string table = {});

  [[nodiscard]] std::string description() const override;
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override;
  [[nodiscard]] PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const override;
  [[nodiscard]] const std::vector<ModelEffect>& effects() const noexcept { return effects_; }
  [[nodiscard]] const DriverTable& drivers() const noexcept { return *drivers_; }
  /// Standard uncertainty of the sum of the effects (without the base) for many rows at once, from the covariances of
  /// the effects.
  [[nodiscard]] std::vector<double> effectSigma(std::span<const Observation> rows) const;
  /// What one effect adds to each row, um or urad.
  [[nodiscard]] static std::vector<double> contribution(const DriverTable& drivers, const ModelEffect& effect,
                                                        std::span<const Observation> rows);
  /// model.json.
  [[nodiscard]] nlohmann::json json() const;
  /// Reads model.json for a machine and its log; `table` is read beside it when it is given. `own`: effects of the
  /// user's that it may hold, of a campaign that is `absolute` or not. Throws InputError: unknown
  /// effect, a driver that the log does not have, a missing parameter.
  [[nodiscard]] static std::shared_ptr<const EffectModel> read(const std::filesystem::path& file,
                                                               const MachineDescription& machine,
                                                               const OperatingLog* log,
                                                               const std::vector<std::string>& points,
                                                               const OwnEffects* own = nullptr, bool absolute = false);

 private:
  std::shared_ptr<const DriverTable> drivers_;
  std::vector<ModelEffect> effects_;
  std::shared_ptr<const ErrorModel> base_;
  std::string table_;

  /// Responses of the inputs of one effect at one time, and with each parameter moved by its step.
  struct Responses {
    Eigen::VectorXd inputs;
    std::vector<Eigen::VectorXd> moved;
  };
  /// Of all effects. A grid is asked for at one time, and a response runs over the whole log: the last time is kept.
  [[nodiscard]] std::shared_ptr<const std::vector<Responses>> responsesAt(double time_s) const;
  mutable std::mutex mutex_;
  mutable double kept_time_s_ = 0.0;
  mutable std::shared_ptr<const std::vector<Responses>> kept_;
};

}  // namespace spindrift
