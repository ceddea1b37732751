// SPDX-License-Identifier: Apache-2.0
// A named physical cause of deviation: driver x dynamics x shape (EFFECTS.md). An error model is a sum of effects.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine/machine_description.h"
#include "core/machine/observation.h"
#include "core/machine/operating_log.h"

namespace spindrift {

/// A non-linear parameter of an effect (a lag, an onset, a free origin) with the range in which it is searched.
struct EffectParameter {
  std::string name;  ///< with its unit: "tau_s", "onset_s", "origin_mm"
  double low = 0.0;
  double high = 0.0;
  bool logarithmic = false;  ///< searched on a logarithmic scale (time constants)
};

/// What an effect may look at.
struct EffectContext {
  const MachineDescription* machine = nullptr;
  const OperatingLog* log = nullptr;  ///< may be null: nothing was logged
};

/// One effect of the catalogue, in one variant of its driver and dynamics. Linear in its gains, non-linear in its
/// parameters: deviation = basis(parameters) * gains.
class Effect {
 public:
  virtual ~Effect() = default;
  /// Stable id of EFFECTS.md: "ball_screw.expansion.x".
  [[nodiscard]] virtual std::string_view id() const noexcept = 0;
  /// One paragraph of physics for the user.
  [[nodiscard]] virtual std::string_view physics() const noexcept = 0;
  [[nodiscard]] virtual std::span<const EffectParameter> parameters() const noexcept = 0;
  /// Names of the gains with units: "gain_um_per_krpm".
  [[nodiscard]] virtual std::span<const std::string> gainNames() const noexcept = 0;
  /// Columns of the design matrix, one per gain, for the given observations: um or urad per unit of the gain.
  [[nodiscard]] virtual Eigen::MatrixXd basis(const EffectContext& context, std::span<const double> parameters,
                                              std::span<const Observation> observations) const = 0;
};

}  // namespace spindrift
