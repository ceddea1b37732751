// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/machine/driver_words.h"
#include "core/machine/parameter_meanings.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report_parts.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

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
    if (const ErrorParameter* p = errorParameter(name); p != nullptr)
      rows.push_back({titleWithUnit(name), p->iso_symbol, p->meaning});
  if (!rows.empty()) document.table({"Parameter", "ISO 230-1", "Meaning"}, rows, "What the error parameters mean");
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

/// A parameter of an artefact over the cycles; fewer than three of them are no course.
std::optional<PlotSeries> trendOf(const Cycles& cycles, const std::string& name, const std::string& artefact) {
  PlotSeries trend{{}, {}, {}, {}, SeriesStyle::Points};
  for (const CycleRow& r : cycles.rows) {
    const double value = figureOf(r.parameters, name, "value");
    if (r.artefact != artefact || !std::isfinite(value)) continue;
    const double sigma = figureOf(r.parameters, name, "standard_uncertainty");
    trend.x.push_back(r.at);
    trend.y.push_back(value);
    trend.sigma.push_back(std::isfinite(sigma) && !isReference(r) ? sigma : 0.0);
  }
  if (trend.x.size() < 3) return std::nullopt;
  return trend;
}

/// The limits of a row of panels, with the bars, so that the same height means the same.
void shareLimits(PlotOptions& options, const std::map<std::string, PlotSeries>& trends) {
  double x_low = 1e300, x_high = -1e300, y_low = 1e300, y_high = -1e300;
  for (const auto& [artefact, trend] : trends) {
    for (std::size_t i = 0; i < trend.x.size(); ++i) {
      x_low = std::min(x_low, trend.x[i]);
      x_high = std::max(x_high, trend.x[i]);
      y_low = std::min(y_low, trend.y[i] - trend.sigma[i]);
      y_high = std::max(y_high, trend.y[i] + trend.sigma[i]);
    }
  }
  const double x_margin = 0.03 * std::max(x_high - x_low, 1e-9), y_margin = 0.06 * std::max(y_high - y_low, 1e-9);
  options.x_from = x_low - x_margin;
  options.x_to = x_high + x_margin;
  options.y_from = y_low - y_margin;
  options.y_to = y_high + y_margin;
}

/// One panel a parameter; of several artefacts one row a parameter and one panel an artefact, on the same axes.
void addTrends(Report& document, const Cycles& cycles) {
  constexpr int page_px = 860;
  constexpr std::size_t most_beside = 4;
  const bool several = cycles.artefacts.size() > 1;
  PanelGrid grid = PanelGrid::of(cycles.names.size());
  if (several) {
    grid.columns = static_cast<int>(std::min(cycles.artefacts.size(), most_beside));
    grid.width_px = page_px / grid.columns - PanelGrid::gap_px;
    grid.height_px = 160;
  }
  std::vector<Drawing> panels;
  for (const std::string& name : cycles.names) {
    std::map<std::string, PlotSeries> trends;
    for (const std::string& artefact : cycles.artefacts)
      if (auto trend = trendOf(cycles, name, artefact)) trends.emplace(artefact, std::move(*trend));
    if (trends.empty()) continue;
    PlotOptions options{.x_label = cycles.timed ? "time / h" : "cycle",
                        .y_label = titleWithUnit(name),
                        .width_px = grid.width_px,
                        .height_px = grid.height_px,
                        .compact = true};
    if (several) shareLimits(options, trends);
    for (const std::string& artefact : cycles.artefacts) {
      const auto trend = trends.find(artefact);
      if (trend == trends.end()) continue;
      if (several) options.title = artefact;
      panels.push_back(plotPicture({trend->second}, options));
    }
    // Every parameter begins a row.
    while (several && panels.size() % static_cast<std::size_t>(grid.columns) != 0)
      panels.emplace_back(grid.width_px, grid.height_px);
  }
  if (!panels.empty())
    document.figure(drawingGrid(panels, grid.columns, PanelGrid::gap_px),
                    several
                        ? "Error parameters over the cycles, each artefact by itself, one row on the same axes; bars: "
                          "one standard uncertainty"
                        : "Error parameters over the cycles; bars: one standard uncertainty");
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

/// The circles of P0 (6)-(9) through the measured tracks beside the joint evaluation of all marks and images.
void addAlgebraicCircles(Report& document, const nlohmann::json& details) {
  std::vector<ReportRow> rows;
  const double pixel_um = details.value("camera", nlohmann::json::object()).value("pixel_length_um", std::nan(""));
  for (const nlohmann::json& fiducial : details.value("fiducials", nlohmann::json::array())) {
    for (const nlohmann::json& state : fiducial.value("states", nlohmann::json::array())) {
      const nlohmann::json centre = state.value("centre_of_rotation", nlohmann::json());
      if (!centre.is_object() || !centre.value("algebraic_px", nlohmann::json()).is_array()) continue;
      ReportRow row{fiducial.value("fiducial", ""), state.value("state", "")};
      for (const auto& [key, place] : {std::pair{"x_px", 0U}, std::pair{"y_px", 1U}}) {
        const double joint = figureOf(centre, key, "value");
        row.push_back(fmt::format("{:.2f} ± {:.2f}", joint, figureOf(centre, key, "standard_uncertainty")));
        row.push_back(fmt::format("{:+.1f}", (centre["algebraic_px"][place].get<double>() - joint) * pixel_um));
      }
      row.push_back(fmt::format("{}", centre.value("algebraic_tracks", 0)));
      rows.push_back(std::move(row));
    }
  }
  if (rows.empty() || !std::isfinite(pixel_um)) return;
  document.table({"Fiducial", "State", "Joint x / px", "Circles − joint x / µm", "Joint y / px",
                  "Circles − joint y / µm", "Tracks"},
                 rows,
                 "Centre of rotation: algebraic circles through the track of each mark against the joint "
                 "evaluation; short arcs pull the circles, they are shown for comparison and not used");
}

std::string three(const nlohmann::json& values, const nlohmann::json& sigmas) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) text += ", ";
    if (!values.is_array() || values.size() != 3 || !values[i].is_number()) {
      text += "–";
    } else if (sigmas.is_array() && sigmas.size() == 3 && sigmas[i].is_number()) {
      text += withUncertainty(values[i].get<double>(), sigmas[i].get<double>(), "");
    } else {
      std::string number = fmt::format("{:.1f}", values[i].get<double>());
      if (number.front() == '-') number.replace(0, 1, "−");
      text += number;
    }
  }
  return text;
}

/// P4 (7)-(10) as printed beside the joint evaluation, last cycle that has them.
void addClosedForms(Report& document, const nlohmann::json& artefact) {
  const nlohmann::json forms = artefact.value("closed_forms", nlohmann::json::array());
  if (forms.empty()) return;
  const std::string last = forms.back().value("cycle", "");
  std::vector<ReportRow> rows;
  for (const nlohmann::json& f : forms) {
    if (f.value("cycle", "") != last) continue;
    rows.push_back({f.value("ball", ""), three(f.value("head_rotation_urad", nlohmann::json()), nullptr),
                    three(f.value("joint_head_rotation_urad", nlohmann::json()),
                          f.value("joint_standard_uncertainty_urad", nlohmann::json())),
                    fmt::format("{:.2f}", f.value("spindle_drift_um", std::nan("")))});
  }
  document.table(
      {"Ball", "Closed forms X, Y, Z / µrad", "Joint evaluation X, Y, Z / µrad", "Movement of stylus 0 / µm"}, rows,
      fmt::format("Head rotation in {}: closed forms against the joint evaluation; the closed forms take every "
                  "translation for a rotation and are shown for comparison only",
                  last));
}

/// Lengths that are known: slope of the axis against the certificate, and the growth that coefficient and temperature
/// say.
void addCertificate(Report& document, const nlohmann::json& artefact) {
  const auto quantity = [](const nlohmann::json& from, const char* key) {
    const nlohmann::json q = from.value(key, nlohmann::json::object());
    if (!q.value("value", nlohmann::json()).is_number()) return std::string("not determined");
    const double u =
        q.value("standard_uncertainty", nlohmann::json()).is_number() ? q["standard_uncertainty"].get<double>() : 0.0;
    if (!(u > 0.0))
      return withUncertainty(std::round(10.0 * q["value"].get<double>()) / 10.0, 0.0, "") + " (uncertainty not stated)";
    return withUncertainty(q["value"].get<double>(), u, "");
  };
  std::vector<ReportRow> rows;
  for (const nlohmann::json& c : artefact.value("against_certificate", nlohmann::json::array())) {
    const nlohmann::json temperature = c.value("temperature_degC", nlohmann::json());
    rows.push_back({c.value("cycle", ""),
                    temperature.is_number() ? fmt::format("{:.2f}", temperature.get<double>()) : "not known",
                    quantity(c, "slope_um_per_m"),
                    fmt::format("{:.1f} of {}", c.value("chi2", std::nan("")), c.value("degrees_of_freedom", 0))});
  }
  if (rows.size() > most_rows) rows.erase(rows.begin() + most_rows, rows.end());
  if (!rows.empty())
    document.table({"Cycle", "Artefact / °C", "Slope of the axis / (µm/m)", "Chi-squared of"}, rows,
                   "Axis against the calibrated distances at the temperature of the artefact; uncertainty of touches, "
                   "certificate, coefficient and temperature");
  rows.clear();
  for (const nlohmann::json& g : artefact.value("growth_expected", nlohmann::json::array())) {
    rows.push_back({g.value("cycle", ""), quantity(g, "expected_um_per_m"), quantity(g, "measured_um_per_m")});
    if (rows.size() == most_rows) break;
  }
  if (!rows.empty())
    document.table({"Cycle", "Coefficient and temperature / (µm/m)", "Touches alone / (µm/m)"}, rows,
                   artefact.value("growth_combined", false)
                       ? "Expansion of the artefact; EME combines both by their uncertainties"
                       : "Expansion of the artefact; EME rests on the touches alone");
}

/// Scans whose surface has changed its shape: how much, and what that leaves open of the motion.
void addChangesOfShape(Report& document, const nlohmann::json& cycles) {
  std::vector<ReportRow> rows;
  for (const nlohmann::json& cycle : cycles) {
    const nlohmann::json form = cycle.value("free_form", nlohmann::json());
    if (!form.is_object()) continue;
    const nlohmann::json motion = form.value("motion_standard_uncertainty", nlohmann::json::object());
    ReportRow row{cycle.value("artefact", ""), cycle.value("cycle", ""),
                  fmt::format("{:.2f}", form.value("rms_um", std::nan("")))};
    for (const char* name : {"EX_um", "EY_um", "EZ_um", "EA_urad", "EB_urad", "EC_urad"}) {
      const nlohmann::json sigma = motion.value(name, nlohmann::json());
      const double value = sigma.is_number() ? sigma.get<double>() : std::nan("");
      row.push_back(!std::isfinite(value) ? std::string("–") : fmt::format("{:.{}f}", value, value < 10.0 ? 2 : 0));
    }
    rows.push_back(std::move(row));
    if (rows.size() == most_rows) break;
  }
  if (!rows.empty())
    document.table({"Artefact", "Cycle", "Change / µm rms", "EX / µm", "EY / µm", "EZ / µm", "EA / µrad", "EB / µrad",
                    "EC / µrad"},
                   rows,
                   "Changes of shape that no motion explains, and the standard uncertainty that each leaves in the "
                   "deviation of its scan");
}

}  // namespace

void addInstrument(Report& document, const InstrumentEvaluation& instrument) {
  document.section(fmt::format("Measured with: {}", instrumentTitle(instrument.instrument)));
  for (const EvaluationWarning& warning : instrument.warnings)
    document.callout(CalloutKind::Attention, warning.sentence);
  if (instrument.details.contains("cycles")) {
    const Cycles cycles = cyclesOf(instrument.details["cycles"]);
    if (!cycles.rows.empty()) {
      addMeanings(document, cycles.names);
      addTrends(document, cycles);
      addTables(document, cycles);
    }
    addChangesOfShape(document, instrument.details["cycles"]);
  }
  if (instrument.details.is_object()) {
    for (const nlohmann::json& artefact : instrument.details.value("artefacts", nlohmann::json::array())) {
      addCertificate(document, artefact);
      addClosedForms(document, artefact);
    }
    addMicroscope(document, instrument.details);
    addAlgebraicCircles(document, instrument.details);
  }
  if (instrument.rejected.empty()) {
    document.paragraph("No capture was rejected.");
    return;
  }
  std::vector<ReportRow> rows;
  for (const RejectedCapture& r : instrument.rejected) rows.push_back({r.capture, r.reason});
  document.table({"Capture", "Why it was not used"}, rows, "Rejected captures");
}

}  // namespace spindrift
