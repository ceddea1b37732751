// SPDX-License-Identifier: Apache-2.0
// What predicts a deviation. Fitting, fields, discrepancy, reports and compensation see models only through this.
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/machine/component.h"
#include "core/machine/observation.h"

namespace spindrift {

/// Where, when and under which conditions a deviation is asked for.
struct DeviationQuery {
  double time_s = 0.0;
  std::string state;  ///< thermal state, for models of one state; may be empty
  std::string point;  ///< id of the point if it is a known one (a fixture that slips, a table of predictions)
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double c_deg = 0.0;
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();
  Eigen::Vector3d tool_offset_mm = Eigen::Vector3d::Zero();

  [[nodiscard]] static DeviationQuery of(const Observation& o) {
    return {o.time_s, o.state, o.point, o.position_mm, o.c_deg, o.approach, o.tool_offset_mm};
  }
  [[nodiscard]] bool operator==(const DeviationQuery&) const = default;
};

/// A predicted component: um or urad; `sigma` is one standard uncertainty of the prediction (0 if it is taken as
/// exact).
struct PredictedComponent {
  double value = 0.0;
  double sigma = 0.0;
};

/// A model of the deviation of the tool relative to the table. Immutable after construction; safe to use from threads.
class ErrorModel {
 public:
  virtual ~ErrorModel() = default;
  /// One sentence: what the model is and from what it was made.
  [[nodiscard]] virtual std::string description() const = 0;
  [[nodiscard]] virtual PredictedComponent predict(const DeviationQuery& query, Component component) const = 0;
  /// The deviation at `query` relative to that at `reference`, and the standard uncertainty of this change: what both
  /// share cancels (GUM 5.2.2, u^2(a - b) = u^2(a) + u^2(b) - 2 u(a, b)), so that it is zero where both are the same.
  /// A model that does not know the covariance of two predictions takes them as independent.
  [[nodiscard]] virtual PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                         Component component) const;
};

}  // namespace spindrift
