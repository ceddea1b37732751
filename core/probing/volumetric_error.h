// SPDX-License-Identifier: Apache-2.0
// Volumetric thermal error of one cycle over the working space, P4 (4a)-(4c), from the parameters of a ball cycle.
//
// deviation(tip) = d + a x tip + h x offset + g (tip - offset - fixed bearing), um: (4a)-(4c) with the screw errors
// linear in position; ez carries the spindle drift, ex and ey carry its lateral parts. The uncertainty follows from the
// covariance of the cycle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/field.h"
#include "core/probing/ball_cycle.h"

namespace spindrift {

/// The error model of one cycle. The tool offset of the query counts; rotations EA, EB, EC are those of head and
/// column.
class BallCycleModel : public ErrorModel {
 public:
  /// `cycle` is an index into result.cycles. Throws InternalError if it is none.
  BallCycleModel(const BallCycleResult& result, int cycle);
  /// Where balls were touched in any cycle, tip, mm.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& places_mm() const noexcept { return places_mm_; }
  [[nodiscard]] std::string description() const override;
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override;
  [[nodiscard]] PredictedComponent predictChange(const DeviationQuery& query, const DeviationQuery& reference,
                                                 Component component) const override;

 private:
  using Row = Eigen::Matrix<double, 1, 12>;
  /// Sensitivity to the twelve parameters, mm or rad.
  [[nodiscard]] Row rowOf(const DeviationQuery& query, Component component) const;
  [[nodiscard]] PredictedComponent combined(const Row& row, Component component) const;

  std::string cycle_;
  Eigen::Matrix<double, 12, 1> theta_;
  Eigen::Matrix<double, 12, 12> covariance_;
  Eigen::Vector3d bearing_mm_;
  std::vector<Eigen::Vector3d> places_mm_;
};

/// A plane of the working space normal to `normal_axis` (0 X, 1 Y, 2 Z) at `level_mm`, n x n nodes over the travel.
/// Values in um; the grid knows its plane (FieldGrid::normal_axis). Extrapolated: outside the hull of the balls
/// touched, seen along the normal.
[[nodiscard]] Field volumetricField(const BallCycleModel& model, const MachineDescription& machine, Component component,
                                    int normal_axis, double level_mm, const Eigen::Vector3d& tool_offset_mm,
                                    int n = 41);

/// Arrows over the volume for a 3D view.
struct VolumetricArrow {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d deviation_um = Eigen::Vector3d::Zero();
};
[[nodiscard]] std::vector<VolumetricArrow> volumetricArrows(const BallCycleModel& model,
                                                            const MachineDescription& machine,
                                                            const Eigen::Vector3d& tool_offset_mm, int per_axis = 5);

}  // namespace spindrift
