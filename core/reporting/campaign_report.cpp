// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/campaign_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

/// A number of a parameter's JSON; NaN where it is not determined.
double figureOf(const nlohmann::json& parameters, const std::string& name, const char* key) {
  const auto found = parameters.find(name);
  if (found == parameters.end() || !found->is_object()) return std::nan("");
  const auto value = found->find(key);
  return value != found->end() && value->is_number() ? value->get<double>() : std::nan("");
}

/// One cycle of one artefact.
struct CycleRow {
  std::string cycle;
  std::string artefact;
  double at = 0.0;  ///< hours, or its number where the cycles state no time
  nlohmann::json parameters;
};

void cycleTables(HtmlDocument& document, const std::vector<CycleRow>& rows, const std::vector<std::string>& names,
                 bool several) {
  constexpr std::size_t columns = 5;  // fit on A4
  for (std::size_t first = 0; first < names.size(); first += columns) {
    const std::size_t last = std::min(names.size(), first + columns);
    std::vector<std::string> header{"Cycle"};
    for (std::size_t i = first; i < last; ++i) {
      header.push_back(titleWithUnit(names[i]));
    }
    std::vector<std::vector<std::string>> cells;
    for (const CycleRow& r : rows) {
      cells.push_back({several ? r.cycle + " " + r.artefact : r.cycle});
      for (std::size_t i = first; i < last; ++i) {
        const double value = figureOf(r.parameters, names[i], "value");
        cells.back().push_back(
            std::isfinite(value) ? withUncertainty(value, figureOf(r.parameters, names[i], "standard_uncertainty"), "")
                                 : std::string("not determined"));
      }
    }
    document.table(header, cells, "Error parameters per cycle, value ± one standard uncertainty");
  }
}

/// `cycles:[{cycle, artefact, time_s, parameters:{NAME:{value,standard_uncertainty}}}]` as tables and a trend for each
/// parameter.
void cyclesSection(HtmlDocument& document, const nlohmann::json& cycles) {
  std::vector<CycleRow> rows;
  std::vector<std::string> names;
  std::vector<std::string> artefacts;
  const auto add = [](std::vector<std::string>& list, const std::string& item) {
    if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
  };
  const bool timed = std::all_of(cycles.begin(), cycles.end(), [](const nlohmann::json& c) {
    return c.contains("time_s") && c["time_s"].is_number();
  });
  for (const nlohmann::json& cycle : cycles) {
    if (!cycle.contains("parameters") || !cycle["parameters"].is_object()) continue;
    CycleRow row{cycle.value("cycle", ""), cycle.value("artefact", ""), static_cast<double>(rows.size()),
                 cycle["parameters"]};
    if (timed) row.at = cycle["time_s"].get<double>() / seconds_per_hour;
    for (const auto& [name, parameter] : row.parameters.items()) add(names, name);
    add(artefacts, row.artefact);
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return;
  cycleTables(document, rows, names, artefacts.size() > 1);
  for (const std::string& name : names) {
    std::vector<PlotSeries> trends;
    for (const std::string& artefact : artefacts) {
      PlotSeries trend{artefact, {}, {}, {}, SeriesStyle::Points};
      for (const CycleRow& r : rows) {
        const double value = figureOf(r.parameters, name, "value");
        if (r.artefact != artefact || !std::isfinite(value)) continue;
        const double sigma = figureOf(r.parameters, name, "standard_uncertainty");
        trend.x.push_back(r.at);
        trend.y.push_back(value);
        trend.sigma.push_back(std::isfinite(sigma) ? sigma : 0.0);
      }
      if (trend.x.size() >= 3) trends.push_back(std::move(trend));
    }
    if (trends.empty()) continue;
    PlotOptions options;
    options.x_label = timed ? "time / h" : "cycle";
    options.y_label = titleWithUnit(name);
    options.width_px = 860;
    options.height_px = 180;
    document.figure(svgPlot(trends, options), fmt::format("{} over the cycles", titleWithUnit(name)));
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

std::string titleWithUnit(const std::string& name) {
  for (const auto& [ending, unit] : {std::pair{"_um_per_m", "um/m"}, {"_urad", "urad"}, {"_um", "um"}, {"_mm", "mm"}}) {
    if (name.ends_with(ending)) return fmt::format("{} / {}", name.substr(0, name.rfind(ending)), unit);
  }
  return name;
}

HtmlDocument campaignReport(const CampaignReportInput& input) {
  SPINDRIFT_ASSERT(input.campaign != nullptr, "a report needs a campaign");
  const Campaign& campaign = *input.campaign;
  HtmlDocument document(fmt::format("Thermal errors: {}", campaign.name),
                        fmt::format("{} · measured from {} · report of {}", campaign.machine.name, campaign.start_utc,
                                    input.created_utc));
  machineSection(document, campaign.machine);
  if (campaign.log) logSection(document, *campaign.log);
  for (const auto& fill : input.preparation) fill(document);
  instrumentSections(document, input.instruments);
  observationSection(document, input.observations);
  for (const ReportSection& section : input.sections) {
    document.section(section.heading);
    section.fill(document);
  }
  for (const auto& fill : input.conclusions) fill(document);
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
