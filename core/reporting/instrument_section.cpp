// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/reporting/parameter_meanings.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report_parts.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

constexpr double seconds_per_hour = 3600.0;
constexpr std::size_t most_columns = 5;  ///< of parameters: fit on A4
constexpr std::size_t most_rows = 48;    ///< of a table of cycles

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

/// `cycles:[{cycle, artefact, time_s, parameters:{NAME:{value,standard_uncertainty}}}]`.
struct Cycles {
  std::vector<CycleRow> rows;
  std::vector<std::string> names;
  std::vector<std::string> artefacts;
  bool timed = false;
};

Cycles cyclesOf(const nlohmann::json& json) {
  Cycles out;
  const auto add = [](std::vector<std::string>& list, const std::string& item) {
    if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
  };
  out.timed = std::all_of(json.begin(), json.end(),
                          [](const nlohmann::json& c) { return c.contains("time_s") && c["time_s"].is_number(); });
  for (const nlohmann::json& cycle : json) {
    if (!cycle.contains("parameters") || !cycle["parameters"].is_object()) continue;
    CycleRow row{cycle.value("cycle", ""), cycle.value("artefact", ""), static_cast<double>(out.rows.size()),
                 cycle["parameters"]};
    if (out.timed) row.at = cycle["time_s"].get<double>() / seconds_per_hour;
    for (const auto& [name, parameter] : row.parameters.items()) add(out.names, name);
    add(out.artefacts, row.artefact);
    out.rows.push_back(std::move(row));
  }
  return out;
}

/// All others are relative to it: exactly zero in every parameter.
bool isReference(const CycleRow& row) {
  return std::all_of(row.parameters.items().begin(), row.parameters.items().end(), [](const auto& item) {
    return item.value().is_object() && item.value().contains("value") && item.value()["value"].is_number() &&
           item.value()["value"].template get<double>() == 0.0;
  });
}

void addMeanings(Report& document, const std::vector<std::string>& names) {
  std::vector<ReportRow> rows;
  for (const std::string& name : names)
    if (const std::string meaning = parameterMeaning(name); !meaning.empty())
      rows.push_back({titleWithUnit(name), meaning});
  if (!rows.empty()) document.table({"Parameter", "Meaning"}, rows, "What the error parameters mean");
}

void addTables(Report& document, const Cycles& cycles) {
  const std::size_t step = (cycles.rows.size() + most_rows - 1) / most_rows;
  // Tables of about the same width: six parameters are three and three, not five and one.
  const std::size_t tables = (cycles.names.size() + most_columns - 1) / most_columns;
  const std::size_t columns = (cycles.names.size() + tables - 1) / tables;
  for (std::size_t first = 0; first < cycles.names.size(); first += columns) {
    const std::size_t last = std::min(cycles.names.size(), first + columns);
    ReportRow header{"Cycle"};
    if (cycles.artefacts.size() > 1) header.emplace_back("Artefact");
    if (cycles.timed) header.emplace_back("Time / h");
    for (std::size_t i = first; i < last; ++i) header.push_back(titleWithUnit(cycles.names[i]));
    std::vector<ReportRow> cells;
    for (std::size_t k = 0; k < cycles.rows.size(); k += step) {
      const CycleRow& r = cycles.rows[k];
      const bool reference = isReference(r);
      cells.push_back({r.cycle});
      if (cycles.artefacts.size() > 1) cells.back().push_back(r.artefact);
      if (cycles.timed) cells.back().push_back(fmt::format("{:.2f}", r.at));
      for (std::size_t i = first; i < last; ++i) {
        const double value = figureOf(r.parameters, cycles.names[i], "value");
        const double sigma = figureOf(r.parameters, cycles.names[i], "standard_uncertainty");
        cells.back().push_back(!std::isfinite(value) ? std::string("not determined")
                               : reference           ? std::string("0 (reference)")
                                                     : withUncertainty(value, sigma, ""));
      }
    }
    document.table(header, cells,
                   step == 1 ? std::string("Error parameters per cycle, value ± one standard uncertainty")
                             : fmt::format("Error parameters ± one standard uncertainty; {} of {} cycles, all in the "
                                           "figure",
                                           cells.size(), cycles.rows.size()));
  }
}

void addTrends(Report& document, const Cycles& cycles) {
  const PanelGrid grid = PanelGrid::of(cycles.names.size());
  std::vector<Drawing> panels;
  for (const std::string& name : cycles.names) {
    std::vector<PlotSeries> trends;
    for (const std::string& artefact : cycles.artefacts) {
      PlotSeries trend{cycles.artefacts.size() > 1 ? artefact : std::string(), {}, {}, {}, SeriesStyle::Points};
      for (const CycleRow& r : cycles.rows) {
        const double value = figureOf(r.parameters, name, "value");
        if (r.artefact != artefact || !std::isfinite(value)) continue;
        const double sigma = figureOf(r.parameters, name, "standard_uncertainty");
        trend.x.push_back(r.at);
        trend.y.push_back(value);
        trend.sigma.push_back(std::isfinite(sigma) && !isReference(r) ? sigma : 0.0);
      }
      if (trend.x.size() >= 3) trends.push_back(std::move(trend));
    }
    if (trends.empty()) continue;
    PlotOptions options{.x_label = cycles.timed ? "time / h" : "cycle",
                        .y_label = titleWithUnit(name),
                        .width_px = grid.width_px,
                        .height_px = grid.height_px,
                        .compact = true};
    panels.push_back(plotPicture(trends, options));
  }
  if (!panels.empty())
    document.figure(drawingGrid(panels, grid.columns, PanelGrid::gap_px),
                    "Error parameters over the cycles; bars: one standard uncertainty");
}

std::string instrumentTitle(const std::string& instrument) {
  if (instrument == "microscope") return "Microscope and coded fiducials";
  if (instrument == "touch_probe") return "Touch probe";
  if (instrument == "profiler") return "Laser profiler";
  return words(instrument);
}

/// What the microscope itself was found to be: scale, direction, repeatability.
void addMicroscope(Report& document, const nlohmann::json& details) {
  const auto camera = details.find("camera");
  if (camera == details.end()) return;
  ReportFacts facts;
  const auto add = [&](const nlohmann::json& from, const char* key, const char* name, const char* unit, int decimals) {
    if (from.contains(key) && from[key].is_number())
      facts.emplace_back(name, fmt::format("{:.{}f} {}", from[key].get<double>(), decimals, unit));
  };
  if (camera->value("width_px", 0) > 0)
    facts.emplace_back("Image",
                       fmt::format("{} × {} pixels", camera->value("width_px", 0), camera->value("height_px", 0)));
  add(*camera, "pixel_length_um", "Length of a pixel on the fiducial", "µm", 3);
  if (camera->contains("direction_rad") && (*camera)["direction_rad"].is_object()) {
    const nlohmann::json& direction = (*camera)["direction_rad"];
    if (direction.contains("value") && direction["value"].is_number())
      facts.emplace_back("Direction of the camera in the machine",
                         withUncertainty(direction["value"].get<double>() * deg_per_rad,
                                         direction.value("standard_uncertainty", 0.0) * deg_per_rad, "°"));
  }
  add(*camera, "position_repeatability_um", "Repeatability of the axes seen in the images", "µm", 2);
  if (const auto centre = details.find("centre_of_rotation"); centre != details.end())
    add(*centre, "spindle_repeatability_um", "Repeatability of the spindle orientation", "µm", 2);
  if (!facts.empty()) document.facts(facts);
}

}  // namespace

void addInstrument(Report& document, const InstrumentEvaluation& instrument) {
  document.section(fmt::format("Measured with: {}", instrumentTitle(instrument.instrument)));
  for (const std::string& warning : instrument.warnings) document.callout(CalloutKind::Attention, warning);
  if (instrument.details.contains("cycles")) {
    const Cycles cycles = cyclesOf(instrument.details["cycles"]);
    if (!cycles.rows.empty()) {
      addMeanings(document, cycles.names);
      addTrends(document, cycles);
      addTables(document, cycles);
    }
  }
  addMicroscope(document, instrument.details);
  if (instrument.rejected.empty()) {
    document.paragraph("No capture was rejected.");
    return;
  }
  std::vector<ReportRow> rows;
  for (const RejectedCapture& r : instrument.rejected) rows.push_back({r.capture, r.reason});
  document.table({"Capture", "Why it was not used"}, rows, "Rejected captures");
}

}  // namespace spindrift
