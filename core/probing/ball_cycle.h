// SPDX-License-Identifier: Apache-2.0
// The measurement cycle with a ball artefact and a star stylus (P4): rotation of the head, rotation of the column,
// drift of the spindle and expansion of the screws, relative to the first cycle.
//
// One least squares over all styli, balls and cycles (FORMATS.md):
//   deviation of the tip = d + a x tip + h x offset + g (reference - fixed bearing),  offset = tip - spindle reference
// 12 parameters per cycle: hX hY hZ, aX aY aZ (urad), dX dY dZ (um), gX gY gZ (um/m). A touch reads minus the deviation
// along its normal, at the place of the tip when it touched.
// Why (7)-(9) are not enough: three styli on one ball touch the same place, so they see a x tip as a translation, and
// the closed forms ignore translations. See star_stylus.h.
// Temperature of the artefact: a column T_<artefact>_degC of the log (or T_artefact_degC) with the expansion
// coefficient of the machine file moves the balls away from the first one, along the artefact as it lies in the
// machine; certified distances hold at the reference temperature. The uncertainties of coefficient and temperature
// enter the covariances (artefact_certificate.h). Source: P4 (1)-(13) as PAPERS.md corrects them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/operating_log.h"
#include "core/probing/cycle_evaluation.h"

namespace spindrift {

struct BallCycleOptions {
  CycleFitOptions fit;
  /// A touch further than this from where it lies in the other cycles is on another ball, mm.
  double misplaced_mm = 1.0;
};

/// (13): distance between two balls in one cycle compared with the certificate.
struct BallDistance {
  std::string cycle, stylus, from, to;
  double measured_mm = 0.0;
  double certified_mm = 0.0;                                ///< at the temperature of the artefact
  double error_um = 0.0;                                    ///< measured minus certified
  double standard_uncertainty_um = 0.0;                     ///< touches, certificate, coefficient and temperature
  Eigen::Vector3d components_um = Eigen::Vector3d::Zero();  ///< measured minus certified vector, MCF
};

/// The closed forms beside the joint evaluation: core/probing/closed_forms.h.
struct HeadComparison {
  std::string cycle;
  std::string ball;
  std::optional<Eigen::Vector3d> closed_form_urad;             ///< (7)-(9); nothing: degenerate, see `message`
  Eigen::Vector3d joint_urad = Eigen::Vector3d::Zero();        ///< hX, hY, hZ
  Eigen::Vector3d joint_sigma_urad = Eigen::Vector3d::Zero();  ///< standard uncertainty
  double spindle_drift_um = 0.0;                               ///< (10)
  double joint_drift_um = 0.0;                                 ///< length of (dX, dY, dZ)
  std::string message;
};

struct BallCycleResult : CycleEvaluation {
  std::vector<BallDistance> distances;
  Eigen::Vector3d fixed_bearing_mm = Eigen::Vector3d::Zero();
  std::vector<HeadComparison> closed_forms;
};

/// hX_urad ... gZ_um_per_m.
[[nodiscard]] const std::vector<std::string>& ballParameterNames();

/// d(deviation of the tip)/d(parameters), 3 x 12, internal units (rad, mm, strain).
[[nodiscard]] Eigen::Matrix<double, 3, 12> ballDeviationJacobian(const Eigen::Vector3d& tip_mm,
                                                                 const Eigen::Vector3d& offset_mm,
                                                                 const Eigen::Vector3d& fixed_bearing_mm);

/// Touches of one ball artefact over all cycles. `log` may be null.
[[nodiscard]] BallCycleResult evaluateBallCycles(const TouchList& list, const MachineDescription& machine,
                                                 const Artefact& artefact, const OperatingLog* log,
                                                 const BallCycleOptions& options = {});

}  // namespace spindrift
