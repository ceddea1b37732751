// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

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
  return out;
}

}  // namespace spindrift
