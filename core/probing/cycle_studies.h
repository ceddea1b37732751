// SPDX-License-Identifier: Apache-2.0
// What one learns from many cycles: repeatability (P1, 3.3), comparison with a reference instrument (P1 Fig. 3), and
// groups of temperature sensors (P4 Fig. 2).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/machine/operating_log.h"
#include "core/probing/cycle_evaluation.h"

namespace spindrift {

struct RepeatabilityOptions {
  /// Drifts slower than this many cycles are taken out: a centred running mean of this length (odd, >= 3) is
  /// subtracted.
  int high_pass_cycles = 9;
  double coverage_factor = 2.0;
  void validate() const;
};

/// Repeatability of one parameter: coverage factor times the standard deviation of the high-pass filtered cycles,
/// corrected for what the running mean takes from white noise (factor 1 - 1/length).
struct Repeatability {
  std::string name;
  double repeatability = 0.0;         ///< in the unit of the name, at the coverage factor
  double standard_uncertainty = 0.0;  ///< of that number
  double expected = 0.0;              ///< what the touch noise of the evaluation predicts, at the coverage factor
  int cycles = 0;
};
/// Empty message: done. Fewer than twice the filter length of cycles: status Degenerate.
struct RepeatabilityStudy {
  FitStatus status = FitStatus::NotRun;
  std::string message = "not run";
  std::vector<Repeatability> parameters;
};
[[nodiscard]] RepeatabilityStudy studyRepeatability(const CycleEvaluation& evaluation,
                                                    const RepeatabilityOptions& options = {});

/// A reference instrument's record: `time_s,value[,sigma]` in the unit of the compared parameter, up to a constant.
struct ReferenceComparison {
  FitStatus status = FitStatus::NotRun;
  std::string message = "not run";
  std::string name;
  struct Point {
    double time_s = 0.0;
    double probe = 0.0;
    double reference = 0.0;
    double difference = 0.0;
    double standard_uncertainty = 0.0;  ///< of the difference
  };
  std::vector<Point> points;  ///< one per cycle within the record
  double offset = 0.0;        ///< mean difference taken out (both are relative to an unknown zero)
  double offset_sigma = 0.0;
  /// Change of the probe per change of the reference (a line with errors in both), 1 if both have the same gain; NaN if
  /// the reference does not move.
  double slope = 0.0;
  double slope_sigma = 0.0;
  double line_rms = 0.0;  ///< of what the line leaves
  /// Both show the same: slope 1 within its uncertainty or 5 %, and no course beside the line. `verdict` says it.
  bool agrees = false;
  bool differs = false;  ///< neither: it cannot be told
  std::string verdict;
  double rms = 0.0;
  double largest = 0.0;
  double correlation = 0.0;
  double fit_percent = 0.0;
  /// Cycles with an uncertainty. That of the first cycle is none where the record has none either: its parameters are
  /// zero by definition, so that it neither agrees nor disagrees.
  std::size_t judged = 0;
  double within_two_sigma = 0.0;  ///< share of those; NaN without any
};
/// Reads the record and compares it with `parameter`. Throws InputError: unreadable, unknown parameter.
[[nodiscard]] ReferenceComparison compareWithReference(const CycleEvaluation& evaluation, const std::string& parameter,
                                                       const std::filesystem::path& reference_csv);

/// Temperature sensors grouped by the size of their change (largest minus smallest value): one-dimensional k-means by
/// exhaustive search over the sorted sizes; without `count` the number of groups up to five with the best silhouette.
struct SensorGroup {
  std::string label;  ///< "large", "medium", "little" for three groups, else "group 1" ...
  double smallest_change_K = 0.0;
  double largest_change_K = 0.0;
  std::vector<std::string> sensors;  ///< largest change first
};
[[nodiscard]] std::vector<SensorGroup> groupSensors(const OperatingLog& log, int count = 0);

}  // namespace spindrift
