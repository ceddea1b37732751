// SPDX-License-Identifier: Apache-2.0
// Parts of a campaign report that show data of one kind each: the operating log, what an instrument found,
// observations. They draw and tabulate what they are given. Units: um, urad, h on the axes.
#pragma once

#include <string>
#include <vector>

#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"
#include "core/reporting/report.h"

namespace spindrift {

/// Small plots of one size that fill the width of a report: two in a row if they are few, else three.
struct PanelGrid {
  int columns = 3;
  int width_px = 284;
  int height_px = 170;
  static constexpr int gap_px = 4;
  [[nodiscard]] static PanelGrid of(std::size_t panels);
};

/// Programme of the machine, one lane a signal, and the temperatures. Outputs of a log (displacements, tilts) as
/// curves.
void addOperatingConditions(Report& document, const OperatingLog& log);

/// Heading, warnings, error parameters per cycle with what they mean, rejected captures.
void addInstrument(Report& document, const InstrumentEvaluation& instrument);

/// Observations: few moments as a table and as arrows over the table, many as one small plot a point with a line for
/// each component. Nothing without observations.
void addObservations(Report& document, const ObservationSet& observations);

/// The largest changes from the first state, one line a component: for the summary. Empty without two states.
struct LargestChange {
  Component component = Component::EX;
  std::string point, state;
  double value = 0.0;  ///< um or urad
  double sigma = 0.0;
};
[[nodiscard]] std::vector<LargestChange> largestChanges(const ObservationSet& observations);

}  // namespace spindrift
