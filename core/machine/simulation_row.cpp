// SPDX-License-Identifier: Apache-2.0
#include "core/machine/simulation_row.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "core/base/csv.h"

namespace spindrift {

std::string simulationCsv(const std::vector<SimulationRow>& rows, bool by_place) {
  std::string text = by_place ? "time_s,x_mm,y_mm,z_mm,component,predicted\n" : "time_s,point,component,predicted\n";
  for (const SimulationRow& row : rows) {
    // What rounding leaves of a zero is none.
    const double predicted = std::abs(row.predicted) < 1e-7 ? 0.0 : row.predicted;
    if (by_place) {
      text += fmt::format("{},{},{},{},{},{:.6g}\n", row.time_s, row.position_mm.x(), row.position_mm.y(),
                          row.position_mm.z(), toString(row.component), predicted);
    } else {
      text += fmt::format("{},{},{},{:.6g}\n", row.time_s, csvField(row.point), toString(row.component), predicted);
    }
  }
  return text;
}

}  // namespace spindrift
