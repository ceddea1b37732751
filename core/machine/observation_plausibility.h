// SPDX-License-Identifier: Apache-2.0
// Can these observations have been measured on this machine? One place for every set, read from a file, evaluated from
// captures or made in memory.
//
// A thermal deviation is micrometres: 20 m of steel that warms by 20 K grow by 4.6 mm. For a reading of a point, d =
// its deviations (mm) less the usual ones of the point (median over its readings; of two readings the first):
//   |d| >= 1 mm and d = +- (place of another point - own place) within 2 mm or 2 %: the other point was measured
//   |d| >= 10 mm:                                                                   no deviation of a machine
// Positions that all lie within a thousandth of the travel are metres. Rows of use `exclude` are believed.
#pragma once

#include <string>
#include <vector>

#include "core/machine/instrument_evaluation.h"
#include "core/machine/machine_description.h"
#include "core/machine/observation.h"

namespace spindrift {

/// What no machine does, and the rows of the set that say so.
struct ImplausibleReading {
  std::vector<std::size_t> rows;    ///< ascending
  std::vector<std::string> points;  ///< one, or two whose labels were swapped
  std::string state;
  std::string sentence;
};

/// All of a set, in order of their first rows; a row is in one of them at most.
[[nodiscard]] std::vector<ImplausibleReading> implausibleReadings(const ObservationSet& observations);

/// Lists it among the rejected captures of an evaluation and its warnings, which then is not good enough.
void rejectReading(const ImplausibleReading& reading, InstrumentEvaluation& evaluation);

/// The set without some of its rows (ascending), with what the others share.
[[nodiscard]] ObservationSet withoutRows(const ObservationSet& observations, const std::vector<std::size_t>& rows);

/// Throws InputError if the positions of the points are metres (all of them, of at least two points, lie within a
/// thousandth of the travel of the machine) or micrometres (half lie beyond fifty times its longest travel).
void refusePositionsInAnotherUnit(const ObservationSet& observations, const MachineDescription& machine);

/// One sentence if points lie outside the travel of the machine by more than a tenth of it: a file of another machine,
/// another unit, or columns that were swapped. Empty otherwise.
[[nodiscard]] std::string outsideTravel(const ObservationSet& observations, const MachineDescription& machine);

/// One sentence for every point of the description that an axis cannot reach (mm).
[[nodiscard]] std::vector<std::string> pointsOutsideTravel(const MachineDescription& machine);

}  // namespace spindrift
