// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/simulation/virtual_campaign.h"

namespace spindrift {
namespace {

std::string logCsv(const OperatingLog& log, const std::map<std::string, std::vector<std::size_t>>& dropouts) {
  std::string text = "time_s";
  std::vector<std::vector<double>> columns;
  for (const std::string& name : log.names()) {
    text += "," + csvField(name);
    columns.push_back(*log.signal(name));
    const auto dropped = dropouts.find(name);
    if (dropped == dropouts.end()) continue;
    for (const std::size_t row : dropped->second) columns.back()[row] = std::numeric_limits<double>::quiet_NaN();
  }
  text += '\n';
  for (std::size_t row = 0; row < log.time_s().size(); ++row) {
    text += exactNumber(log.time_s()[row]);
    for (const std::vector<double>& column : columns) {
      text += ',';
      if (!std::isnan(column[row])) text += exactNumber(column[row]);
    }
    text += '\n';
  }
  return text;
}

std::string touchesCsv(const VirtualCampaign& campaign) {
  std::string text = "time_s,cycle,artefact,feature,stylus,c_deg,touch,x_mm,y_mm,z_mm,nx,ny,nz\n";
  for (const TouchRow& t : campaign.touches) {
    text += fmt::format("{},{},{},{},{},{},{},{:.6f},{:.6f},{:.6f},{},{},{}\n", exactNumber(t.time_s), t.cycle,
                        csvField(campaign.touched_artefact), csvField(t.feature), csvField(t.stylus),
                        exactNumber(t.c_deg), t.touch, t.position_mm.x(), t.position_mm.y(), t.position_mm.z(),
                        exactNumber(t.approach.x()), exactNumber(t.approach.y()), exactNumber(t.approach.z()));
  }
  return text;
}

std::string simulationCsv(const std::vector<SimulatedRow>& rows) {
  std::string text = "time_s,point,component,predicted\n";
  for (const SimulatedRow& row : rows) {
    text += fmt::format("{},{},{},{}\n", exactNumber(row.time_s), csvField(row.point), toString(row.component),
                        exactNumber(row.predicted));
  }
  return text;
}

void writeFiles(const VirtualCampaign& virtual_campaign, const std::filesystem::path& folder, JobContext& job) {
  const Campaign& campaign = virtual_campaign.campaign;
  nlohmann::json json{
      {"format", "spindrift-campaign"}, {"version", 1}, {"name", campaign.name}, {"start_utc", campaign.start_utc}};
  if (!campaign.simulation.empty()) {
    json["simulation"] = campaign.simulation;
    json["simulation_gain_uncertainty"] = campaign.simulation_gain_uncertainty;
  }
  nlohmann::json machine = campaign.machine.source;
  if (virtual_campaign.captures) virtual_campaign.captures->write(folder, machine, job);
  writeFileAtomically(folder / "machine.json", machine.dump(1) + "\n");
  if (campaign.log) writeFileAtomically(folder / "log.csv", logCsv(*campaign.log, virtual_campaign.dropouts));
  if (campaign.observations) campaign.observations->write(folder / "observations.csv");
  if (!virtual_campaign.simulation.empty()) {
    writeFileAtomically(folder / "simulation.csv", simulationCsv(virtual_campaign.simulation));
  }
  if (!virtual_campaign.touches.empty()) {
    writeFileAtomically(folder / "captures" / "touches.csv", touchesCsv(virtual_campaign));
  }
  // Last, so that a folder without it is known to be unfinished.
  writeFileAtomically(folder / "campaign.json", json.dump(1) + "\n");
}

}  // namespace

void writeCampaign(const VirtualCampaign& virtual_campaign, const std::filesystem::path& folder) {
  JobContext job;
  writeCampaign(virtual_campaign, folder, job);
}

void writeCampaign(const VirtualCampaign& virtual_campaign, const std::filesystem::path& folder, JobContext& job) {
  if (std::filesystem::exists(folder) &&
      (!std::filesystem::is_directory(folder) || !std::filesystem::is_empty(folder))) {
    throw InputError({folder, ""}, "is there already and not empty; allowed: a new or an empty folder.");
  }
  try {
    writeFiles(virtual_campaign, folder, job);
  } catch (...) {
    // Half a campaign is of no use and would be in the way of the next attempt. The folder was empty before.
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
      std::filesystem::remove_all(entry.path(), ignored);
    }
    throw;
  }
}

}  // namespace spindrift
