// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "core/base/count_text.h"
#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report.h"
#include "core/workflows/closed_loop.h"

namespace spindrift {
namespace {

/// Of the cycles of a stage (None: all with a compensation), per axis.
Eigen::Vector3d rmsOf(const LoopResult& result, LoopStage stage, Eigen::Vector3d LoopCycle::*which) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), count = Eigen::Vector3d::Zero();
  for (const LoopCycle& cycle : result.cycles) {
    if (cycle.stage == LoopStage::None || (stage != LoopStage::None && cycle.stage != stage)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double value = (cycle.*which)[axis];
      if (!std::isfinite(value)) continue;
      sum[axis] += value * value;
      count[axis] += 1.0;
    }
  }
  Eigen::Vector3d out;
  for (int axis = 0; axis < 3; ++axis)
    out[axis] = count[axis] > 0.0 ? std::sqrt(sum[axis] / count[axis]) : std::numeric_limits<double>::quiet_NaN();
  return out;
}

nlohmann::json components(const Eigen::Vector3d& values) {
  nlohmann::json out = nlohmann::json::object();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(values[axis])) out[std::string(toString(static_cast<Component>(axis)))] = values[axis];
  }
  return out;
}

}  // namespace

std::string_view toString(LoopStage stage) noexcept {
  switch (stage) {
    case LoopStage::None:
      return "none";
    case LoopStage::Simulation:
      return "simulation";
    case LoopStage::WithEffect:
      return "simulation with the added effect";
    case LoopStage::Identified:
      break;
  }
  return "identified models";
}

Eigen::Vector3d LoopResult::rmsWithout(LoopStage stage) const {
  return rmsOf(*this, stage, &LoopCycle::without_um);
}

Eigen::Vector3d LoopResult::rmsWith(LoopStage stage) const {
  return rmsOf(*this, stage, &LoopCycle::with_um);
}

nlohmann::json LoopResult::json() const {
  nlohmann::json out;
  out["rms_without_um"] = components(rmsWithout(LoopStage::None));
  out["rms_with_um"] = components(rmsWith(LoopStage::None));
  out["measurements"] = cycles.size();
  out["effects"] = effects;
  out["verdict"] = verdict;
  out["completed"] = completed;
  out["losses"] = losses;
  out["resumed"] = resumed;
  out["ended_s"] = jsonNumber(ended_s);
  out["largest_step_um"] = largest_step_um;
  out["largest_rate_um_s"] = largest_rate_um_s;
  out["stages"] = nlohmann::json::array();
  for (const auto& [from_s, stage] : stages)
    out["stages"].push_back({{"from_s", from_s},
                             {"stage", toString(stage)},
                             {"rms_without_um", components(rmsWithout(stage))},
                             {"rms_with_um", components(rmsWith(stage))}});
  out["cycles"] = nlohmann::json::array();
  for (const LoopCycle& cycle : cycles)
    out["cycles"].push_back({{"time_s", cycle.time_s},
                             {"stage", toString(cycle.stage)},
                             {"why", cycle.why},
                             {"without_um", components(cycle.without_um)},
                             {"with_um", components(cycle.with_um)},
                             {"predicted_um", components(cycle.predicted_um)},
                             {"sigma_um", components(cycle.sigma_um)}});
  out["events"] = nlohmann::json::array();
  for (const LoopEvent& event : events) out["events"].push_back({{"time_s", event.time_s}, {"text", event.text}});
  return out;
}

std::string LoopResult::summary() const {
  std::string out = fmt::format("{}, {} of the control\n", countOf(cycles.size(), "measuring cycle"),
                                countOf(losses, "interruption"));
  if (!effects.empty()) out += fmt::format("Added to the simulation: {}\n", joinedList(effects));
  for (const auto& [from_s, stage] : stages) {
    out += fmt::format("From {:.2f} h, {}, measured:", from_s / 3600.0, toString(stage));
    const Eigen::Vector3d before = rmsWithout(stage), after = rmsWith(stage);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::isfinite(before[axis]))
        out += fmt::format(" {} {:.1f} → {:.1f} µm", toString(static_cast<Component>(axis)), before[axis], after[axis]);
    }
    out += "\n";
  }
  return out;
}

Report LoopResult::report(const std::string& title) const {
  Report document(title, "measured, modelled and compensated at the control");
  document.section("Result");
  std::vector<ReportRow> rows;
  for (const auto& [from_s, stage] : stages) {
    const Eigen::Vector3d before = rmsWithout(stage), after = rmsWith(stage);
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(before[axis])) continue;
      rows.push_back({std::string(toString(stage)), fmt::format("{:.2f}", from_s / 3600.0),
                      std::string(toString(static_cast<Component>(axis))), fmt::format("{:.2f}", before[axis]),
                      fmt::format("{:.2f}", after[axis]), fmt::format("{:.0f} %", 100.0 * after[axis] / before[axis])});
    }
  }
  document.table({"Compensation", "from / h", "Component", "rms without / µm", "rms with / µm", "remains"}, rows,
                 "As the measuring cycles saw it, relative to the first cycle");
  document.facts({{"Measuring cycles", std::to_string(cycles.size())},
                  {"Added to the simulation", effects.empty() ? "nothing" : joinedList(effects)},
                  {"Largest correction step", fmt::format("{:.2f} µm", largest_step_um)},
                  {"Largest correction rate", fmt::format("{:.3f} µm/s", largest_rate_um_s)},
                  {"Losses of the control", std::to_string(losses)},
                  {"Times resumed", std::to_string(resumed)}});
  for (int axis = 0; axis < 3; ++axis) {
    PlotSeries without{"without compensation", {}, {}, {}, SeriesStyle::Both};
    PlotSeries with{"with compensation", {}, {}, {}, SeriesStyle::Both};
    for (const LoopCycle& cycle : cycles) {
      if (!std::isfinite(cycle.with_um[axis])) continue;
      without.x.push_back(cycle.time_s / 3600.0);
      without.y.push_back(cycle.without_um[axis]);
      with.x.push_back(cycle.time_s / 3600.0);
      with.y.push_back(cycle.with_um[axis]);
    }
    if (with.x.empty()) continue;
    PlotOptions options;
    options.x_label = "time / h";
    options.y_label = fmt::format("{} / µm", toString(static_cast<Component>(axis)));
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const double to_s = i + 1 < stages.size() ? stages[i + 1].first : cycles.back().time_s;
      options.ranges.push_back({stages[i].first / 3600.0, to_s / 3600.0, std::string(toString(stages[i].second))});
    }
    document.figure(plotPicture({without, with}, options),
                    fmt::format("Deviation {} at the tool point as measured", toString(static_cast<Component>(axis))));
  }
  document.section("What happened");
  std::vector<ReportRow> told;
  for (const LoopEvent& event : events) told.push_back({fmt::format("{:.2f}", event.time_s / 3600.0), event.text});
  document.table({"Time / h", "Event"}, told);
  return document;
}

}  // namespace spindrift
