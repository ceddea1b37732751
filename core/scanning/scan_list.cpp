// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/inside_folder.h"
#include "core/scanning/scan_evaluation.h"

namespace spindrift {
namespace {

/// Lengths of the profiler and carriage positions that can only be metres.
void refuseMetres(const MachineDescription& machine, const SourcePlace& first,
                  const std::vector<ScanCapture>& captures) {
  constexpr double mm_per_metre = 1e3;
  const double lever_mm = machine.profiler->lever_mm.norm();
  // No tool sits within a millimetre of the slide's origin; zero means that it is not known.
  if (lever_mm > 0.0 && lever_mm < 1.0) {
    throw InputError({machine.file, "$.profiler.lever_mm"},
                     fmt::format("a lever of {:.3g} mm looks like metres; allowed: millimetres from the slide's origin "
                                 "to the tool frame, or zeros.",
                                 lever_mm));
  }
  const LinearAxis* axis = machine.findAxis(machine.profiler->axis);
  if (axis == nullptr) return;
  const double travel_mm = std::max(std::abs(axis->travel_mm[0]), std::abs(axis->travel_mm[1]));
  double reach_mm = 0.0;
  bool apart = false;
  for (const ScanCapture& c : captures) {
    reach_mm = std::max(reach_mm, std::abs(c.y_mm));
    apart = apart || c.y_mm != captures.front().y_mm;
  }
  constexpr double beyond_travel = 1.1;
  if (!apart || reach_mm * mm_per_metre > beyond_travel * travel_mm) return;
  throw InputError(
      first, fmt::format("all carriage positions lie within {:.3g} mm although {} travels {:g} mm: they look like "
                         "metres; allowed: millimetres.",
                         reach_mm, machine.profiler->axis, travel_mm));
}

}  // namespace

std::vector<ScanCapture> readScanList(const Campaign& campaign) {
  const auto file = campaign.captureList("scans.csv");
  if (!file) throw InputError({campaign.path("captures/scans.csv"), ""}, "is missing.");
  const CsvTable table = CsvTable::read(*file);
  const std::size_t time = table.column("time_s"), cycle = table.column("cycle"), artefact = table.column("artefact"),
                    y = table.column("y_mm"), cloud = table.column("cloud");
  InsideFolder folder(campaign.folder);
  std::vector<ScanCapture> out;
  std::map<std::string, double> last;
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    ScanCapture c{table.number(row, time), table.requiredText(row, cycle), table.requiredText(row, artefact),
                  table.number(row, y), table.requiredText(row, cloud)};
    (void)folder.path(c.cloud, table.place(row, cloud));
    const auto before = last.find(c.artefact);
    if (before != last.end() && c.time_s < before->second)
      throw InputError(table.place(row, time),
                       fmt::format("found {} after {} for artefact {}; allowed: a time that does not run backwards.",
                                   c.time_s, before->second, c.artefact));
    last[c.artefact] = c.time_s;
    if (!seen.emplace(c.artefact, c.cycle).second)
      throw InputError(table.place(row, cycle),
                       fmt::format("found cycle {} of artefact {} twice; allowed: once.", c.cycle, c.artefact));
    out.push_back(std::move(c));
  }
  if (out.empty()) throw InputError({*file, ""}, "lists no scans.");
  if (const auto& profiler = campaign.machine.profiler) {
    if (!profiler->calibration_cloud.empty())
      (void)folder.path(profiler->calibration_cloud, {campaign.machine.file, "$.profiler.calibration_cloud"});
    refuseMetres(campaign.machine, table.place(0, y), out);
  }
  return out;
}

}  // namespace spindrift
