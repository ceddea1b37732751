// SPDX-License-Identifier: Apache-2.0
// ISO 230-3 tests from a log and observations (`thermal iso230-3`): parameters, and the diagram as SVG.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/reporting/drawing.h"
#include "core/thermal/iso230_3.h"
#include "core/thermal/time_series.h"
#include "core/workflows/thermal_workflow.h"

namespace spindrift {

struct Iso230Request {
  std::string test;                    ///< "etve", "spindle" or "axis"
  std::filesystem::path log;           ///< etve, spindle: signals over time
  std::filesystem::path observations;  ///< axis: observations.csv with readings at two positions
  std::vector<std::string> columns;    ///< displacements and tilts; empty: every _um and _urad column
  std::string ambient;                 ///< column; empty: that of the room by its name
  bool without_ambient = false;        ///< none, whatever there is
  std::string speed;                   ///< spindle: column; empty: spindle_rpm, or the only one
  std::string axis = "X";              ///< of the moving axis test
  double fraction = 0.9;               ///< of the end value
  double window_s = level_window_s;    ///< etve, spindle: in which a level is read
  std::optional<TimeRange> range;      ///< etve, spindle: only these rows; times stay those of the log
};

struct Iso230Result {
  std::string test;
  std::optional<EtveResult> etve;
  std::optional<SpindleResult> spindle;
  std::optional<AxisResult> axis;
  std::vector<std::string> notes;
  std::optional<Drawing> diagram;  ///< over time
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
};
/// Which test of ISO 230-3 a log is a record of: "spindle" if the spindle runs once, for half an hour or longer; "etve"
/// if nothing moves; empty otherwise (a mixed programme is no standard test).
[[nodiscard]] std::string standardTestIn(const TimeSeries& series);
[[nodiscard]] Iso230Result evaluateIso230Test(const Iso230Request& request, const JobContext& job);
/// "etve" and "spindle" on a series in memory.
[[nodiscard]] Iso230Result evaluateIso230Test(const TimeSeries& series, const Iso230Request& request);
/// The readings of such a test over time, h; of its part of the series.
[[nodiscard]] Drawing diagramOfIso230Test(const TimeSeries& series, const Iso230Request& request);

/// The test of a campaign, as a session stores it and window and report tell it.
struct StandardTest {
  Iso230Result result;
  std::string why_not;  ///< why the series is no record of this test; empty: it is one

  /// Iso230Result::json, with status ("converged", or "degenerate" without parameters) and message.
  [[nodiscard]] nlohmann::json json() const;
};
/// What is asked of a series: asked without a test it is that of the environment, which says what speaks against it.
using AskedTest = std::function<Iso230Request(const TimeSeries&)>;
[[nodiscard]] StandardTest standardTestOf(const TimeSeries& series, const AskedTest& asked);

}  // namespace spindrift
