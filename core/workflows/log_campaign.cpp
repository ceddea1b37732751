// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/log_campaign.h"

#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/unit_text.h"
#include "core/workflows/campaign_series.h"

namespace spindrift {

void writeLogCampaign(const std::filesystem::path& csv, const std::filesystem::path& folder) {
  const std::string text = readFile(csv);
  const TimeSeries series = parseTimeSeries(text, csv);
  if (outputSignals(series).empty()) {
    throw InputError({csv, ""},
                     "has no signal to model; allowed: at least one column whose name ends in _um or _urad.");
  }
  std::error_code ignored;
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder, ignored)) {
    throw InputError({folder, ""}, "is there and not empty; allowed: a new folder.");
  }
  std::filesystem::create_directories(folder);
  const nlohmann::json campaign{{"format", "spindrift-campaign"},
                                {"version", 1},
                                {"name", csv.stem().string()},
                                {"start_utc", "1970-01-01T00:00:00Z"}};
  nlohmann::json axes = nlohmann::json::array();
  for (const char* name : {"X", "Y", "Z"}) axes.push_back({{"name", name}, {"travel_mm", {0, 1}}});
  const nlohmann::json machine{{"format", "spindrift-machine"},
                               {"version", 1},
                               {"name", "not described"},
                               {"chain", "V [w-X'-Y'-b-Z-t]"},
                               {"axes", axes}};
  writeFileAtomically(folder / "campaign.json", campaign.dump(1) + "\n");
  writeFileAtomically(folder / "machine.json", machine.dump(1) + "\n");
  writeFileAtomically(folder / "log.csv", text);
}

bool hasOutputSignals(const OperatingLog& log) {
  for (const std::string& name : log.names()) {
    if (!unitOfSignal(name).empty()) return true;
  }
  return false;
}

}  // namespace spindrift
