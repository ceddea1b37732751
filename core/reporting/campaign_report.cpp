// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/campaign_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/reporting/svg_plot.h"
#include "core/session/fingerprint.h"

namespace spindrift {
namespace {

constexpr double seconds_per_hour = 3600.0;

std::string optionalText(const std::optional<double>& value, std::string_view unit) {
  return value ? fmt::format("{:g} {}", *value, unit) : std::string("not stated");
}

/// Serial numbers, calibration dates and whatever else a user wrote beside the keys the program knows.
std::vector<std::pair<std::string, std::string>> extraFacts(const nlohmann::json& source) {
  static const std::set<std::string> known{
      "format", "version",   "name",  "chain",    "axes",  "spindle", "rotary",    "temperature_sensors",
      "points", "artefacts", "styli", "profiler", "table", "column",  "crossbeam", "reference_temperature_degC"};
  std::vector<std::pair<std::string, std::string>> facts;
  for (const auto& [key, value] : source.items()) {
    if (known.contains(key) || value.is_structured()) continue;
    facts.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return facts;
}

void machineSection(HtmlDocument& document, const MachineDescription& machine) {
  document.section("Machine");
  std::vector<std::pair<std::string, std::string>> facts{{"Name", machine.name},
                                                         {"Kinematic chain", machine.chain.text()}};
  if (machine.spindle) {
    facts.emplace_back("Spindle", fmt::format("axis {}, up to {}", machine.spindle->axis,
                                              optionalText(machine.spindle->max_rpm, "rpm")));
  }
  facts.emplace_back("Reference temperature", fmt::format("{:g} degC", machine.reference_temperature_degC));
  for (auto& fact : extraFacts(machine.source)) facts.push_back(std::move(fact));
  document.facts(facts);
  std::vector<std::vector<std::string>> rows;
  for (const LinearAxis& axis : machine.axes) {
    rows.push_back({axis.name, fmt::format("{:g} to {:g}", axis.travel_mm[0], axis.travel_mm[1]),
                    optionalText(axis.resolution_um, "um"), axis.drive_type.empty() ? "not stated" : axis.drive_type,
                    axis.scale.empty() ? "not stated" : axis.scale});
  }
  document.table({"Axis", "Travel / mm", "Resolution", "Drive", "Position from"}, rows, "Linear axes");
}

void logSection(HtmlDocument& document, const OperatingLog& log) {
  document.section("Operating conditions");
  PlotOptions options{.title = "Spindle speed and feeds", .x_label = "time / h", .y_label = "value / largest value"};
  std::vector<PlotSeries> states;
  std::vector<PlotSeries> temperatures;
  std::vector<double> hours(log.time_s().size());
  std::transform(log.time_s().begin(), log.time_s().end(), hours.begin(),
                 [](double t) { return t / seconds_per_hour; });
  for (const std::string& name : log.names()) {
    const std::vector<double>& values = *log.signal(name);
    if (OperatingLog::isTemperature(name)) {
      if (temperatures.size() < 8) {
        temperatures.push_back({name.substr(2, name.size() - 7), hours, values, {}, SeriesStyle::Line});
      }
      continue;
    }
    const double largest = *std::max_element(values.begin(), values.end());
    if (!(name == "spindle_rpm" || name.starts_with("feed_") || name.starts_with("speed_")) || !(largest > 0.0))
      continue;
    std::vector<double> scaled(values.size());
    std::transform(values.begin(), values.end(), scaled.begin(), [&](double v) { return v / largest; });
    states.push_back({fmt::format("{} (max {:g})", name, largest), hours, scaled, {}, SeriesStyle::Step});
  }
  if (!states.empty()) {
    options.width_px = 860;
    document.figure(svgPlot(states, options), "Programme of the machine, each signal relative to its largest value");
  }
  if (!temperatures.empty()) {
    PlotOptions t{.title = "Temperatures", .x_label = "time / h", .y_label = "temperature / degC", .width_px = 860};
    document.figure(svgPlot(temperatures, t), "Temperatures of the log");
  }
  if (const std::vector<double>* on = log.signal("compensation_on");
      on != nullptr && std::any_of(on->begin(), on->end(), [](double v) { return v != 0.0; })) {
    document.verdict("attention",
                     "The control was compensating during part of this campaign; observations from that time show what "
                     "was left over, not the error of the machine.");
  }
}

void observationSection(HtmlDocument& document, const ObservationSet& observations) {
  if (observations.rows.empty()) return;
  document.section("Observations");
  const std::vector<std::string> points = observations.points();
  document.paragraph(
      fmt::format("{} observations of {} points in {} states. Deviation = actual minus commanded position of "
                  "the tool relative to the table, up to a constant per point and component.",
                  observations.rows.size(), points.size(), observations.states().size()));
  for (const Component component : all_components) {
    std::vector<PlotSeries> series;
    for (const std::string& point : points) {
      PlotSeries one{point, {}, {}, {}, SeriesStyle::Points};
      for (const Observation& o : observations.rows) {
        if (o.point != point || o.component != component || o.use == ObservationUse::Exclude) continue;
        one.x.push_back(o.time_s / seconds_per_hour);
        one.y.push_back(o.value);
        one.sigma.push_back(o.sigma);
      }
      if (!one.x.empty() && series.size() < 12) series.push_back(std::move(one));
    }
    if (series.empty()) continue;
    PlotOptions options{.title = fmt::format("{} over time", toString(component)),
                        .x_label = "time / h",
                        .y_label = fmt::format("{} / {}", toString(component), unitOf(component)),
                        .width_px = 860};
    document.figure(svgPlot(series, options),
                    fmt::format("{} at the measured points, bars show one standard uncertainty", toString(component)));
  }
}

/// `cycles:[{cycle, parameters:{NAME:{value,standard_uncertainty}}}]` as a table and a trend for each parameter.
void cyclesSection(HtmlDocument& document, const nlohmann::json& cycles) {
  std::map<std::string, std::vector<std::vector<std::string>>> rows_by_name;
  std::map<std::string, PlotSeries> trends;
  std::vector<std::string> names;
  double index = 0.0;
  std::vector<std::vector<std::string>> rows;
  for (const nlohmann::json& cycle : cycles) {
    if (!cycle.contains("parameters") || !cycle["parameters"].is_object()) continue;
    std::vector<std::string> row{cycle.value("cycle", "") +
                                 (cycle.contains("artefact") ? " " + cycle.value("artefact", "") : std::string())};
    for (const auto& [name, parameter] : cycle["parameters"].items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
      if (!parameter.is_object() || !parameter.contains("value") || !parameter["value"].is_number()) continue;
      PlotSeries& trend = trends[name];
      trend.style = SeriesStyle::Points;
      trend.x.push_back(index);
      trend.y.push_back(parameter["value"].get<double>());
      trend.sigma.push_back(parameter.value("standard_uncertainty", nlohmann::json(0.0)).is_number()
                                ? parameter["standard_uncertainty"].get<double>()
                                : 0.0);
    }
    for (const std::string& name : names) {
      const auto found = cycle["parameters"].find(name);
      if (found == cycle["parameters"].end() || !(*found).contains("value") || !(*found)["value"].is_number()) {
        row.push_back("not determined");
      } else {
        const auto u = (*found).value("standard_uncertainty", nlohmann::json(nullptr));
        row.push_back(withUncertainty((*found)["value"].get<double>(), u.is_number() ? u.get<double>() : 0.0, ""));
      }
    }
    rows.push_back(std::move(row));
    index += 1.0;
  }
  if (rows.empty()) return;
  for (std::size_t first = 0; first < names.size(); first += 5) {  // five columns fit on A4
    const std::size_t last = std::min(names.size(), first + 5);
    std::vector<std::string> header{"Cycle"};
    header.insert(header.end(), names.begin() + static_cast<std::ptrdiff_t>(first),
                  names.begin() + static_cast<std::ptrdiff_t>(last));
    std::vector<std::vector<std::string>> part;
    for (const auto& row : rows) {
      std::vector<std::string> cells{row[0]};
      for (std::size_t i = first; i < last; ++i) cells.push_back(i + 1 < row.size() ? row[i + 1] : "not determined");
      part.push_back(std::move(cells));
    }
    document.table(header, part, "Error parameters per cycle, value ± one standard uncertainty");
  }
  for (const std::string& name : names) {
    const auto trend = trends.find(name);
    if (trend == trends.end() || trend->second.x.size() < 3) continue;
    document.figure(svgPlot({trend->second}, {.x_label = "cycle", .y_label = name, .width_px = 860, .height_px = 180}),
                    fmt::format("{} over the cycles", name));
  }
}

void instrumentSections(HtmlDocument& document, const std::vector<InstrumentEvaluation>& instruments) {
  for (const InstrumentEvaluation& instrument : instruments) {
    document.section(fmt::format("Measured with: {}", instrument.instrument));
    for (const std::string& warning : instrument.warnings) document.verdict("attention", warning);
    if (instrument.details.contains("cycles")) cyclesSection(document, instrument.details["cycles"]);
    if (!instrument.rejected.empty()) {
      std::vector<std::vector<std::string>> rows;
      for (const RejectedCapture& r : instrument.rejected) rows.push_back({r.capture, r.reason});
      document.table({"Capture", "Why it was not used"}, rows, "Rejected captures");
    }
  }
}

}  // namespace

HtmlDocument campaignReport(const CampaignReportInput& input) {
  SPINDRIFT_ASSERT(input.campaign != nullptr, "a report needs a campaign");
  const Campaign& campaign = *input.campaign;
  HtmlDocument document(fmt::format("Thermal errors: {}", campaign.name),
                        fmt::format("{} · measured from {} · report of {}", campaign.machine.name, campaign.start_utc,
                                    input.created_utc));
  machineSection(document, campaign.machine);
  if (campaign.log) logSection(document, *campaign.log);
  instrumentSections(document, input.instruments);
  observationSection(document, input.observations);
  for (const ReportSection& section : input.sections) {
    document.section(section.heading);
    section.fill(document);
  }
  if (!input.exclusions.empty()) {
    document.section("Taken out by the user");
    std::vector<std::vector<std::string>> rows;
    for (const auto& [item, reason] : input.exclusions) rows.push_back({item, reason});
    document.table({"Item", "Reason"}, rows);
  }
  if (!input.notes.empty()) {
    document.section("Notes");
    for (const std::string& note : input.notes) document.paragraph(note);
  }
  document.section("Provenance");
  document.facts({{"Program", fmt::format("Spindrift {}", SPINDRIFT_VERSION)},
                  {"Campaign", campaign.name},
                  {"Fingerprint of the campaign", fingerprintOfFolder(campaign.folder)},
                  {"Report made", input.created_utc},
                  {"Uncertainties", "one standard uncertainty (k = 1) unless stated otherwise"},
                  {"Operator", input.operator_name.empty() ? "______________________" : input.operator_name}});
  return document;
}

}  // namespace spindrift
