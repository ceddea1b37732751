// SPDX-License-Identifier: Apache-2.0
#include "core/machine/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include "core/base/inside_folder.h"
#include "core/base/utc_time.h"
#include "core/machine/observation_plausibility.h"

namespace spindrift {
namespace {

/// "2026-01-31T08:00:00Z", with any number of decimals of the second.
bool isUtc(std::string_view text) {
  constexpr std::string_view form = "dddd-dd-ddTdd:dd:dd";
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.size() <= form.size() || text.back() != 'Z') return false;
  for (std::size_t i = 0; i < form.size(); ++i) {
    if (form[i] == 'd' ? !digit(text[i]) : text[i] != form[i]) return false;
  }
  const std::string_view decimals = text.substr(form.size(), text.size() - form.size() - 1);
  if (!decimals.empty() &&
      (decimals.size() < 2 || decimals.front() != '.' || !std::all_of(decimals.begin() + 1, decimals.end(), digit)))
    return false;
  return parseUtc(text).has_value();  // the 30th of February is no day
}

/// A log that a recording has begun (core/connect/log_recorder.h: its first line says where time_s is 0) and that has
/// its header and remarks, and no row yet: the campaign is as good as without.
bool hasJustBegun(const std::filesystem::path& log) {
  std::ifstream in(log);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with("# time_s counts from ")) return false;
  int rows = 0;
  while (rows < 2 && std::getline(in, line)) rows += !line.empty() && line.front() != '#' && line.front() != '\r';
  return rows < 2;  // the first is the header
}

}  // namespace

Campaign Campaign::read(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw InputError({folder, ""}, "is not a folder; allowed: a campaign folder with campaign.json and machine.json.");
  }
  if (!std::filesystem::exists(folder / "campaign.json")) {
    throw InputError(
        {folder, ""},
        "is not a campaign: it has no campaign.json; allowed: a campaign folder with campaign.json and machine.json. "
        "For images, touches or clouds alone begin a new measurement that watches their folder.");
  }
  Campaign campaign;
  campaign.folder = folder;
  InsideFolder inside(folder);
  // A link to a file elsewhere is not followed: what came with the campaign would be shown and copied.
  const auto own = [&](const char* name) { return inside.path(name, {folder, ""}); };
  const JsonNode root = JsonNode::read(own("campaign.json"));
  root.requireFormat("spindrift-campaign", 1);
  campaign.name = root.at("name").name();
  const JsonNode start = root.at("start_utc");
  campaign.start_utc = start.string();
  if (!isUtc(campaign.start_utc)) start.reject("a UTC time such as \"2026-01-31T08:00:00Z\"");
  // What the file names lies in the campaign, whoever wrote it.
  for (const char* key : {"simulation", "effects", "simulator"}) {
    if (const auto named = root.find(key); named && !named->string().empty())
      (void)inside.path(named->string(), named->place());
  }
  campaign.simulation = root.stringOr("simulation", "");
  if (const auto gain = root.find("simulation_gain_uncertainty")) {
    campaign.simulation_gain_uncertainty = gain->nonNegativeNumber();
  }
  if (const auto reference = root.find("reference")) {
    campaign.absolute = reference->oneOf({"first_state", "absolute"}) == "absolute";
  }
  if (const auto effects = root.find("effects")) campaign.effects = effects->name();
  if (const auto simulator = root.find("simulator")) campaign.simulator = simulator->name();
  campaign.machine = MachineDescription::read(own("machine.json"));
  if (const std::filesystem::path log = own("log.csv"); std::filesystem::exists(log) && !hasJustBegun(log))
    campaign.log = OperatingLog::read(log);
  for (const char* read_elsewhere : {"observations.cov.csv", "pattern.json", "warm_up.csv"}) (void)own(read_elsewhere);
  if (const std::filesystem::path observations = own("observations.csv"); std::filesystem::exists(observations)) {
    campaign.observations = ObservationSet::read(observations);
    refusePositionsInAnotherUnit(*campaign.observations, campaign.machine);
    campaign.observations.edit().absolute = campaign.absolute;
  }
  return campaign;
}

std::optional<std::filesystem::path> Campaign::captureList(std::string_view file_name) const {
  const std::filesystem::path file = InsideFolder(folder).path(fmt::format("captures/{}", file_name), {folder, ""});
  return std::filesystem::exists(file) ? std::optional(file) : std::nullopt;
}

}  // namespace spindrift
