// SPDX-License-Identifier: GPL-3.0-or-later
// Before and after as curves and as a table of points.
#pragma once

#include <QString>
#include <vector>

#include "core/workflows/verify_compensation.h"
#include "widgets/models/rows_model.h"
#include "widgets/plots/plot.h"

namespace spindrift::gui {

struct VerifyCurves {
  std::vector<Series> series;
  QString x_title;
  QString y_title;
};

/// Changes of one component before and after, measured with the table at one angle (deg), with the goal as lines. Up to
/// `most_single_values` each value stands with two standard uncertainties; more are drawn as the range over the points
/// in each thermal state (the smallest and the largest value, each moved out by two of its standard uncertainties).
[[nodiscard]] VerifyCurves verifyCurves(const VerifyResult& result, Component component, double c_deg);
inline constexpr std::size_t most_single_values = 60;

/// A row for each point: rms and largest change of one component, before and after, and where after is the largest.
/// `goal` in the unit of the component; 0: none.
[[nodiscard]] std::vector<Row> verifyPointRows(const std::vector<VerifyPointFigures>& points, Component component,
                                               double goal);

}  // namespace spindrift::gui
