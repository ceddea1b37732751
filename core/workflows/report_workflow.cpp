// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/report_workflow.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/base/text.h"
#include "core/machine/parameter_meanings.h"
#include "core/reporting/campaign_report.h"
#include "core/reporting/discrepancy_report.h"
#include "core/reporting/heatmap_picture.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/report_wording.h"
#include "core/session/fingerprint.h"
#include "core/session/session.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/compensated_data.h"
#include "core/workflows/discrepancy_story.h"
#include "core/workflows/fit_campaign.h"
#include "core/workflows/log_campaign.h"
#include "core/workflows/simulation_story.h"

namespace spindrift {
namespace {

/// True if one thermal state can be spread over the table: at least three points with displacements in two states.
bool spreadsOverTheTable(const ObservationSet& observations) {
  return observations.points().size() >= 3 && observations.states().size() >= 2;
}

/// The table of the nine parameters: value, uncertainty, meaning.
void addFittedParameters(Report& document, const NineParameterFit& fit, const std::string& state) {
  std::vector<ReportRow> rows;
  const nlohmann::json parameters = toJson(fit).at("parameters");
  // In the order of the table of all parameters, which is that of the window.
  for (const ErrorParameter& known_parameter : errorParameters()) {
    const std::string& name = known_parameter.name;
    if (!parameters.contains(name)) continue;
    const nlohmann::json& parameter = parameters.at(name);
    const bool known = parameter.is_object() && parameter.at("value").is_number();
    rows.push_back({fmt::format("{} / {}", known_parameter.symbol, printedUnit(known_parameter.unit)),
                    known_parameter.iso_symbol,
                    known ? withUncertainty(parameter.at("value").get<double>(),
                                            parameter.at("standard_uncertainty").get<double>(), "")
                          : std::string("not determined"),
                    known_parameter.meaning});
  }
  document.table({"Parameter", "ISO 230-1", "Value ± standard uncertainty", "Meaning"}, rows,
                 fmt::format("Nine-parameter model of {}", state));
  if (fit.rms_fit_um && fit.rms_validation_um) {
    document.paragraph(fmt::format("rms of the fitted points {:.2f} µm, of the validation points {:.2f} µm.",
                                   *fit.rms_fit_um, *fit.rms_validation_um));
  } else if (fit.rms_fit_um) {
    document.paragraph(fmt::format("rms of the fitted points {:.2f} µm.", *fit.rms_fit_um));
  }
  for (const std::string& warning : fit.warnings) document.callout(CalloutKind::Attention, warning);
}

/// The nine-parameter model of one state with its heat maps, or the reason why there is none.
void addState(Report& document, const Campaign& campaign, const ObservationSet& observations,
              const NineParameterOptions& fit_options, const std::string& state) {
  HeatmapOptions options;
  options.fit = fit_options;
  options.fit.state = state;
  document.subsection(fmt::format("State {}", state));
  try {
    addFittedParameters(document, fitNineParameters(observations, options.fit), state);
    std::vector<Drawing> maps;
    std::string subtitle;
    for (const Component component : {Component::EX, Component::EY, Component::EZ}) {
      options.component = component;
      const HeatmapResult map = heatmapOf(campaign, observations, options);
      if (!map.determined) {
        document.paragraph(map.message);
        continue;
      }
      subtitle = map.subtitle();
      maps.push_back(heatmapPicture(map.field, {.title = map.title(), .legend = false, .width_px = 480}));
    }
    if (!maps.empty())
      document.figure(drawingGrid(maps, 2), fmt::format("Model of the displacement over the table in state {}: {}; {}",
                                                        state, subtitle, heatmap_legend));
  } catch (const InputError& error) {
    document.paragraph(fmt::format("No model of this state: {}", error.what()));
  }
}

/// The model that was fitted in a session in the place of the one under the usual options: what the step Model shows is
/// what is reported.
void tellStoredFit(std::vector<InstrumentEvaluation>& instruments, const StoredResults& stored) {
  if (!stored.fit.is_object() || !stored.fit.contains("cycles")) return;
  const bool of_touches = stored.fit.contains("artefact");
  for (InstrumentEvaluation& one : instruments) {
    if (one.instrument != (of_touches ? "touch_probe" : "profiler") || !one.details.is_object()) continue;
    nlohmann::json fit = stored.fit;
    if (of_touches) {
      // Those of other artefacts stay.
      const nlohmann::json artefact = fit.at("artefact");
      nlohmann::json cycles = fit.at("cycles");
      for (const nlohmann::json& cycle : one.details.value("cycles", nlohmann::json::array()))
        if (cycle.value("artefact", nlohmann::json()) != artefact) cycles.push_back(cycle);
      fit.erase("cycles");
      nlohmann::json artefacts = one.details.value("artefacts", nlohmann::json::array());
      for (nlohmann::json& other : artefacts)
        if (other.value("artefact", nlohmann::json()) == artefact) other.update(fit);
      one.details["cycles"] = std::move(cycles);
      one.details["artefacts"] = std::move(artefacts);
    } else {
      one.details.update(fit);
    }
  }
}

/// Lines for the first page from what a session keeps.
void addHeadlines(CampaignReportInput& input, const StoredResults& stored) {
  const auto add = [&](const char* title, const char* kind, const std::string& text) {
    input.headlines.emplace_back(title, stored.changed.contains(kind) ? fmt::format("outdated: {}", text) : text);
  };
  if (stored.thermal.is_object() && stored.thermal.contains("good_enough"))
    add("Model over time", "thermal",
        stored.thermal.value("good_enough", true) ? "better than plain models on rows it had not seen"
                                                  : "no better than a plain model: do not use for compensation");
  if (stored.verification.is_object() && stored.verification.contains("reason"))
    add("Compensation verified", "verify", stored.verification.value("reason", ""));
}

/// As it is stored; else as it was chosen; else the one that the displacements of the log are a record of. Nothing of a
/// mixed programme.
void tellStandardTest(Report& document, const Campaign& campaign, const ObservationSet& observations,
                      const ReportOptions& options, JobContext& job) {
  if (!campaign.log || (!options.iso230 && !hasOutputSignals(*campaign.log))) return;
  try {
    const TimeSeries series = campaignSeries(campaign, observations.rows.empty() ? nullptr : &observations, job).series;
    Iso230Request request;
    if (options.iso230) request = options.iso230(series);
    if (request.test.empty()) request.test = standardTestIn(series);
    if (request.test.empty()) return;
    const nlohmann::json test = options.stored.standard_test.is_object() ? options.stored.standard_test
                                                                         : evaluateIso230Test(series, request).json();
    addStandardTest(document, test, diagramOfIso230Test(series, request), options.stored);
  } catch (const InputError&) {
    return;  // the log holds none of the tests
  }
}

}  // namespace

bool canReport(const Campaign& campaign, bool has_observations) {
  return has_observations || (campaign.log && !campaign.log->empty());
}

Report reportOfCampaign(const Campaign& campaign, const ReportOptions& options, JobContext& job) {
  CampaignReportInput input;
  input.campaign = &campaign;
  input.created_utc = utcNow();
  input.fingerprint = options.fingerprint.empty() ? fingerprintOfFolder(campaign.folder) : options.fingerprint;
  input.operator_name = options.operator_name;
  input.exclusions = options.exclusions;
  input.notes = options.notes;
  const bool has_captures =
      campaign.captureList("fiducials.csv") || campaign.captureList("touches.csv") || campaign.captureList("scans.csv");
  JobContext evaluating = job.part(0.0, 0.6);
  if (has_captures) {
    CampaignEvaluation evaluation =
        options.evaluated ? *options.evaluated : evaluateCampaign(campaign, options.evaluate, evaluating);
    if (!options.evaluated && options.choices) options.choices(evaluation.observations);
    input.instruments = std::move(evaluation.instruments);
    input.observations = std::move(evaluation.observations);
    tellStoredFit(input.instruments, options.stored);
  }
  if (!options.observations_file.empty() || campaign.observations)
    input.observations = allObservationsOf(campaign, options.observations_file, options.evaluate, evaluating);
  const std::string left_out = leaveOutCompensated(input.observations, campaign.log.get());
  if (!left_out.empty()) input.notes.push_back(left_out);
  if (campaign.log && !campaign.log->file().empty()) {
    for (std::string& note : OperatingLog::remarks(campaign.log->file())) input.notes.push_back(std::move(note));
    if (std::string doubt = campaign.log->doubtOfTemperatureUnit(); !doubt.empty())
      input.notes.push_back(std::move(doubt));
  }
  const StoredResults& stored = options.stored;
  addHeadlines(input, stored);
  input.preparation = {
      [&](Report& document) { addPlan(document, stored.plan, campaign); },
      [&](Report& document) { addCaptures(document, campaign, job); },
      [&](Report& document) { addInstrumentState(document, stored, !input.observations.rows.empty()); }};
  // Of captures of fiducials, or of a table that was measured by other means.
  const bool other_captures = campaign.captureList("touches.csv") || campaign.captureList("scans.csv");
  const bool of_table = campaign.captureList("fiducials.csv") || (!other_captures && campaign.simulation.empty());
  if (of_table && spreadsOverTheTable(input.observations)) {
    input.sections.push_back({"Thermal error of the table", [&](Report& document) {
                                const std::vector<std::string> states = input.observations.states();
                                for (std::size_t i = 1; i < states.size(); ++i) {
                                  addState(document, campaign, input.observations, options.fit, states[i]);
                                }
                              }});
  }
  if (options.discrepancy && !campaign.simulation.empty()) {
    auto data = std::make_shared<DiscrepancyReportData>();
    if (options.story != nullptr) {
      *data = DiscrepancyStory::parse(*options.story).reportData();
    } else {
      JobContext searching = job.part(0.6, 0.95);
      const DiscrepancyInput found = discrepancyInput(campaign, input.observations);
      *data = discrepancyReportData(found, findDiscrepancy(found, options.search, searching));
    }
    input.headlines.emplace_back("Simulation and measurement", discrepancyHeadline(*data));
    input.sections.push_back(
        {"Where simulation and measurement disagree", [data, &campaign, &stored](Report& document) {
           addDiscrepancyStory(document, *data, mapTable(campaign.machine, 0.0, report_map_nodes));
           addStoredUpdate(document, stored.simulation, campaign);
           if (!stored.simulation.is_null()) addOutdated(document, stored, "simulation");
         }});
  }
  input.conclusions = {
      [&](Report& document) { addThermalModel(document, stored); },
      [&](Report& document) { tellStandardTest(document, campaign, input.observations, options, job); },
      [&](Report& document) { addCompensation(document, stored); },
      [&](Report& document) { addLogCompensation(document, stored); },
      [&](Report& document) { addVerification(document, stored); }};
  job.report(1.0, "writing the report");
  return campaignReport(input);
}

}  // namespace spindrift
