// SPDX-License-Identifier: Apache-2.0
// What a plant looks at: which machine is in which state and what is due, whether a model still holds, one machine's
// trends, a report of a machine. The command line and the page Plant ask here.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/plant/control_chart.h"
#include "core/plant/plant_store.h"
#include "core/reporting/report_language.h"

namespace spindrift {

struct MachineState {
  PlantMachine machine;
  double every_days = 0.0;  ///< as said, else the median interval of its campaigns (at least three); 0: not known
  bool every_is_said = false;
  double due_s = 0.0;         ///< when the next campaign is due; 0: not known
  double overdue_days = 0.0;  ///< > 0: due since
  [[nodiscard]] std::string dueSentence() const;
};

/// All machines, what is due first at the front.
[[nodiscard]] std::vector<MachineState> plantOverview(PlantStore& store, double now_s);
[[nodiscard]] nlohmann::json toJson(const MachineState& state);

/// One parameter of a machine.
struct MachineTrend {
  std::string machine;
  std::string kind;
  std::string name;
  std::vector<MachineEvent> events;
  ControlChart chart;
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  /// time_utc,campaign,value,standard_uncertainty,centre,lower,upper,ewma,ewma_lower,ewma_upper,outside
  [[nodiscard]] std::string csv() const;
};
/// `parameter` is "EX_um" or, where several kinds of results have it, "fit/EX_um". Throws InputError with what there
/// is.
[[nodiscard]] MachineTrend machineTrend(PlantStore& store, const std::string& machine, const std::string& parameter,
                                        const std::string& state, const ChartOptions& options);

/// Whether the newest model of a machine still holds: not after an event that makes it another machine, nor after a
/// change of the parameters of its kind that was named since, nor where the newest verdict says so.
struct ModelState {
  std::optional<PlantModel> model;
  std::vector<std::string> reasons;  ///< why it does not hold any more; empty: it holds
};
[[nodiscard]] ModelState modelState(PlantStore& store, const std::string& machine, const ChartOptions& options);

/// Campaigns side by side, of whatever sessions and machines they are: a row for each parameter that at least one has.
struct CampaignComparison {
  struct Entry {
    double value = 0.0;
    double standard_uncertainty = 0.0;
  };
  struct ComparedRow {
    std::string kind;
    std::string state;
    std::string name;
    std::vector<std::optional<Entry>> entries;  ///< in the order of the campaigns
    /// Largest difference from the first campaign that has it, in standard uncertainties of the difference; 0: fewer
    /// than two have it, or no uncertainty is known.
    double largest = 0.0;
  };
  std::vector<PlantCampaign> campaigns;
  std::vector<ComparedRow> rows;
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
};
/// Throws InputError: fewer than two, or one that is not there.
[[nodiscard]] CampaignComparison compareCampaigns(PlantStore& store, const std::vector<std::int64_t>& campaigns);

/// One machine: state, events, every trend with its changes, model.
struct MachineReport {
  Report report;
  ReportNames names;  ///< what people wrote: the machine, its campaigns, notes
};
[[nodiscard]] MachineReport machineReport(PlantStore& store, const std::string& machine, double now_s);

}  // namespace spindrift
