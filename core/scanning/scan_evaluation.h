// SPDX-License-Identifier: Apache-2.0
// A whole campaign of scans evaluated: calibration, registration of every scan onto the first of its artefact, six
// errors. For pages and reports; evaluate_scans.h turns it into observations.
//
// Clouds are streamed: at any time every thread holds one cloud and one prepared reference. Artefacts are evaluated at
// the same time; of fewer artefacts than threads the scans are.
//
// The scan frame has y along the axis that carries the profiler ("profiler.axis": X, Y or Z) and z along the heights
// ("profiler.height_axis" of machine.json, such as "Z" or "-Y": an axis across; Z where it is missing, -Y for an axis
// Z), x = y x z. For an axis Y it is the machine's frame. Everything is worked out in it; lever and calibration circle
// are taken from machine axes into it, and results are given in machine axes. Angles of the mounting are about its
// axes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"
#include "core/scanning/axis_errors.h"

namespace spindrift {

/// One row of captures/scans.csv.
struct ScanCapture {
  double time_s = 0.0;
  std::string cycle;
  std::string artefact;
  double y_mm = 0.0;
  std::string cloud;  ///< relative to the campaign folder
};

/// One scan that could be used.
struct ScanResult {
  ScanCapture capture;
  bool reference = false;  ///< the scan that the others of its artefact are compared with
  RegistrationResult registration;
  AxisError axis;
  std::vector<std::pair<Component, std::string>> not_observed;  ///< and why
  /// calibrationSpread of (u, w): machine axes, as everything here but what is said to be in the profiler's frame.
  Eigen::Matrix<double, 6, 6> calibration_spread = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<std::string> warnings;

  /// Of the displacement (0 to 2, mm) and rotation (3 to 5, rad) at the artefact: of the registration and of the
  /// calibration of the mounting together; infinite where the surface does not show it.
  [[nodiscard]] double standardUncertaintyAtArtefact(int i) const;
};

struct ScanEvaluation {
  ScanModel scan_model = ScanModel::Rigid;
  std::string axis = "Y";                                           ///< that carries the profiler
  Eigen::Matrix3d machine_from_scan = Eigen::Matrix3d::Identity();  ///< axes of the scan frame in machine axes
  ProfilerMounting mounting;                                        ///< in the scan frame
  std::vector<ScanResult> scans;                                    ///< in order of time
  std::vector<RejectedCapture> rejected;
  std::vector<EvaluationWarning> warnings;
};

/// Reads captures/scans.csv. Throws InputError: missing column, time that runs backwards for an artefact, a cycle
/// twice.
[[nodiscard]] std::vector<ScanCapture> readScanList(const Campaign& campaign);

/// Scans the user excluded (Campaign::excluded_captures names their clouds) are left out. scan_model "" takes that of
/// machine.json. Throws InputError if the list or the machine's profiler cannot be used.
[[nodiscard]] ScanEvaluation evaluateScanCampaign(const Campaign& campaign, const std::string& scan_model,
                                                  JobContext& job);

}  // namespace spindrift
