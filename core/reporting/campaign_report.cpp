// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/campaign_report.h"

#include <fmt/format.h>

#include <set>

#include "core/base/text.h"
#include "core/machine/driver_words.h"
#include "core/reporting/report_parts.h"
#include "core/reporting/report_wording.h"
#include "core/session/fingerprint.h"

namespace spindrift {
namespace {

std::string optionalText(const std::optional<double>& value, std::string_view unit) {
  return value ? fmt::format("{:g} {}", *value, unit) : std::string("not stated");
}

/// Serial numbers, calibration dates and whatever else a user wrote beside the keys the program knows.
ReportFacts extraFacts(const nlohmann::json& source, const std::set<std::string>& known) {
  ReportFacts facts;
  for (const auto& [key, value] : source.items()) {
    if (known.contains(key) || value.is_structured()) continue;
    facts.emplace_back(words(key), value.is_string() ? value.get<std::string>() : value.dump());
  }
  return facts;
}

std::string joinedFacts(const ReportFacts& facts) {
  std::string text;
  for (const auto& [key, value] : facts) text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", key, value.plain());
  return text;
}

/// Artefacts, styli and profiler with what their owner wrote of them: what a calibration can be traced by.
void equipmentTable(Report& document, const MachineDescription& machine) {
  static const std::set<std::string> known{"id",
                                           "kind",
                                           "reference_hole",
                                           "expansion_um_per_m_K",
                                           "temperature_degC",
                                           "radius_mm",
                                           "scan_model",
                                           "axis",
                                           "lift_mm",
                                           "profile_points",
                                           "profile_interval_mm",
                                           "calibration_cloud",
                                           "hole_diameter_mm",
                                           "certificate_uncertainty_um",
                                           "name",
                                           "type",
                                           "place",
                                           "format",
                                           "version"};
  std::vector<ReportRow> rows;
  const auto add = [&](const nlohmann::json& item, const std::string& kind) {
    if (!item.is_object()) return;
    std::string properties;
    const auto number = [&](const char* key, const char* name, const char* unit) {
      if (item.contains(key) && item[key].is_number())
        properties += fmt::format("{}{} {:g} {}", properties.empty() ? "" : ", ", name, item[key].get<double>(), unit);
    };
    number("hole_diameter_mm", "holes of", "mm");
    number("radius_mm", "radius", "mm");
    number("expansion_um_per_m_K", "expansion", "µm/(m K)");
    number("temperature_degC", "calibrated at", "°C");
    number("certificate_uncertainty_um", "uncertainty of the certificate", "µm");
    const std::string extra = joinedFacts(extraFacts(item, known));
    rows.push_back({item.value("id", item.value("name", kind)), kind, properties.empty() ? "not stated" : properties,
                    extra.empty() ? "not stated" : extra});
  };
  for (const auto& [key, name] : {std::pair{"artefacts", "artefact"}, {"styli", "stylus"}}) {
    if (!machine.source.contains(key) || !machine.source[key].is_array()) continue;
    for (const nlohmann::json& item : machine.source[key])
      add(item, item.is_object() && item.contains("kind") && item["kind"].is_string()
                    ? words(item["kind"].get<std::string>())
                    : std::string(name));
  }
  if (machine.source.contains("profiler")) add(machine.source["profiler"], "laser profiler");
  if (!rows.empty())
    document.table({"Item", "Kind", "Properties", "Serial number, calibration"}, rows, "Measuring equipment");
}

void machineSection(Report& document, const MachineDescription& machine) {
  document.section("Machine");
  if (!isDescribed(machine)) {
    document.paragraph("The machine is not described; this report is of a log alone.");
    return;
  }
  static const std::set<std::string> known{
      "format", "version",   "name",  "chain",    "axes",  "spindle", "rotary",    "temperature_sensors",
      "points", "artefacts", "styli", "profiler", "table", "column",  "crossbeam", "reference_temperature_degC"};
  ReportFacts facts{{"Name", machine.name}, {"Kinematic chain", machine.chain.text()}};
  if (machine.spindle) {
    facts.emplace_back("Spindle", fmt::format("axis {}, up to {}", machine.spindle->axis,
                                              optionalText(machine.spindle->max_rpm, "rpm")));
  }
  facts.emplace_back("Reference temperature", fmt::format("{:g} °C", machine.reference_temperature_degC));
  for (auto& fact : extraFacts(machine.source, known)) facts.push_back(std::move(fact));
  document.facts(facts);
  std::vector<ReportRow> rows;
  for (const LinearAxis& axis : machine.axes) {
    rows.push_back({axis.name, fmt::format("{:g} to {:g}", axis.travel_mm[0], axis.travel_mm[1]),
                    optionalText(axis.resolution_um, "µm"),
                    axis.drive_type.empty() ? "not stated" : words(axis.drive_type),
                    axis.scale.empty() ? "not stated" : words(axis.scale)});
  }
  document.table({"Axis", "Travel / mm", "Resolution", "Drive", "Position from"}, rows, "Linear axes");
  equipmentTable(document, machine);
}

/// What somebody who reads one page wants to know.
void summarySection(Report& document, const CampaignReportInput& input) {
  ReportFacts facts;
  for (const LargestChange& c : largestChanges(input.observations)) {
    facts.emplace_back(
        fmt::format("Largest change of {}", toString(c.component)),
        fmt::format("{} at {} in state {}", withUncertainty(c.value, c.sigma, unitOf(c.component)), c.point, c.state));
  }
  std::size_t rejected = 0;
  for (const InstrumentEvaluation& instrument : input.instruments) rejected += instrument.rejected.size();
  if (rejected > 0) facts.emplace_back("Captures rejected", fmt::format("{}, listed with their reasons", rejected));
  if (!input.exclusions.empty())
    facts.emplace_back("Taken out by the user",
                       fmt::format("{} items, listed with their reasons", input.exclusions.size()));
  facts.insert(facts.end(), input.headlines.begin(), input.headlines.end());
  if (facts.empty()) return;
  document.section("Summary");
  document.facts(facts);
}

}  // namespace

bool isDescribed(const MachineDescription& machine) {
  return machine.name != "not described";
}

Report campaignReport(const CampaignReportInput& input) {
  SPINDRIFT_ASSERT(input.campaign != nullptr, "a report needs a campaign");
  const Campaign& campaign = *input.campaign;
  const bool described = isDescribed(campaign.machine);
  Report document(fmt::format("Thermal errors: {}", campaign.name),
                  described ? fmt::format("{} · measured from {} · report of {}", campaign.machine.name,
                                          utcInWords(campaign.start_utc), utcInWords(input.created_utc))
                            : fmt::format("log without a description of its machine · report of {}",
                                          utcInWords(input.created_utc)));
  summarySection(document, input);
  machineSection(document, campaign.machine);
  if (campaign.log) addOperatingConditions(document, *campaign.log);
  for (const auto& fill : input.preparation) fill(document);
  for (const InstrumentEvaluation& instrument : input.instruments) addInstrument(document, instrument);
  addObservations(document, input.observations);
  for (const ReportSection& section : input.sections) {
    document.section(section.heading);
    section.fill(document);
  }
  for (const auto& fill : input.conclusions) fill(document);
  if (!input.exclusions.empty()) {
    document.section("Taken out by the user");
    std::vector<ReportRow> rows;
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
                  {"Fingerprint of the campaign",
                   input.fingerprint.empty() ? fingerprintOfFolder(campaign.folder) : input.fingerprint},
                  {"Report made", utcInWords(input.created_utc)},
                  {"Uncertainties", "one standard uncertainty (k = 1) unless stated otherwise"},
                  {"Operator", input.operator_name.empty() ? "______________________" : input.operator_name}});
  return document;
}

}  // namespace spindrift
