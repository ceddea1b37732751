// SPDX-License-Identifier: Apache-2.0
// A whole campaign of scans evaluated: calibration, registration of every scan onto the first of its artefact, six
// errors. For pages and reports; evaluate_scans.h turns it into observations.
//
// Clouds are streamed: at any time every thread holds one cloud and one prepared reference.
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
  std::vector<std::string> warnings;
};

struct ScanEvaluation {
  ScanModel scan_model = ScanModel::Rigid;
  ProfilerMounting mounting;
  std::vector<ScanResult> scans;  ///< in order of time
  std::vector<RejectedCapture> rejected;
  std::vector<std::string> warnings;
};

/// Reads captures/scans.csv. Throws InputError: missing column, time that runs backwards for an artefact, a cycle
/// twice.
[[nodiscard]] std::vector<ScanCapture> readScanList(const Campaign& campaign);

/// Scans the user excluded (Campaign::excluded_captures names their clouds) are left out. scan_model "" takes that of
/// machine.json. Throws InputError if the list or the machine's profiler cannot be used.
[[nodiscard]] ScanEvaluation evaluateScanCampaign(const Campaign& campaign, const std::string& scan_model,
                                                  JobContext& job);

}  // namespace spindrift
