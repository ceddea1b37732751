// SPDX-License-Identifier: Apache-2.0
// Has the microscope (or any instrument) settled? One point is measured again and again; the answer comes from the
// drift and its uncertainty, not from a fixed time (P0 section 3.5: 10, 25, 20 um over about 80 min).
//
// Per axis: v(t) = c + a exp(-t / tau), tau searched, c and a by least squares; and a straight line through the last
// part of the series for the drift that is left; the exponential's drift at the end in its place where both agree and
// it is known better. Settled: |drift| + 2 u(drift) is below the limit in every axis; drifts: |drift| - 2 u(drift) is
// above it; between them it cannot be decided. A time constant beyond the record, or shorter than the shortest that was
// tried, is no result. Time in s, values in um, drift in um/h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/machine/observation.h"
#include "core/machine/operating_log.h"

namespace spindrift {

struct WarmUpOptions {
  double drift_limit_um_per_h = 1.0;
  double window_part = 0.34;  ///< the last part of the duration that the drift is taken from ...
  int window_points = 4;      ///< ... with at least so many measurements
  /// Throws InputError.
  void validate() const;
};

enum class WarmUpVerdict {
  Settled,
  Drifts,
  NotDecidable,  ///< the limit lies within drift +- 2 u(drift): measure longer
};

/// Of one axis; `drift` and `sigma` in um/h, not a number: not decidable.
[[nodiscard]] WarmUpVerdict warmUpVerdict(double drift_um_per_h, double sigma_um_per_h, double limit_um_per_h);
[[nodiscard]] std::string toString(WarmUpVerdict verdict);  ///< "settled", "drifts", "not decidable"

enum class TimeConstant {
  NotSeen,       ///< no exponential beats a constant
  Determined,    ///< WarmUpAxis::tau_s
  BeyondRecord,  ///< longer than the series: the end of the approach was not seen
  TooShort,      ///< as short as the shortest that was tried, a 30th of the series
};
[[nodiscard]] std::string toString(TimeConstant found);

struct WarmUpAxis {
  bool measured = false;
  Component component = Component::EX;
  std::vector<double> time_s;
  std::vector<double> value_um;
  double drift_um_per_h = 0.0;
  double drift_sigma_um_per_h = 0.0;
  WarmUpVerdict verdict = WarmUpVerdict::NotDecidable;
  double total_um = 0.0;  ///< last minus first
  TimeConstant time_constant = TimeConstant::NotSeen;
  std::optional<double> tau_s;  ///< if it is determined
  std::optional<double> amplitude_um;
  /// When the fitted exponential's drift fell below the limit: of an axis that has settled, within the series.
  std::optional<double> settled_after_s;
};

/// What a drift may be of.
enum class WarmUpCause {
  Instrument,  ///< the machine stood and its temperatures held: nothing else drifts
  Unknown,     ///< the machine was at work or grew warm, or nobody logged whether it was: its own course looks the same
};

struct WarmUpResult {
  FitStatus status = FitStatus::NotRun;  ///< Degenerate: too few measurements
  double drift_limit_um_per_h = 0.0;     ///< that it was judged by
  std::string point;
  std::array<WarmUpAxis, 3> axes;  ///< EX, EY, EZ
  bool settled = false;
  std::string reason;  ///< one sentence
  WarmUpCause cause = WarmUpCause::Unknown;
  std::string cause_reason;  ///< one sentence; of a series that has settled there is nothing to tell apart: empty
};

/// `point` empty: the one with most rows. Throws InputError for a point that is not there.
[[nodiscard]] WarmUpResult judgeWarmUp(const ObservationSet& observations, const std::string& point,
                                       const WarmUpOptions& options = {});

/// The same, and whether a drift is the instrument's: `log` (may be null) says if the machine stood (no spindle, table
/// or feed) and if every temperature held within `steady_K` while the point was measured.
[[nodiscard]] WarmUpResult judgeWarmUp(const ObservationSet& observations, const std::string& point,
                                       const WarmUpOptions& options, const OperatingLog* log, double steady_K = 0.5);

}  // namespace spindrift
