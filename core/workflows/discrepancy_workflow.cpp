// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/discrepancy_workflow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/effect_listing.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/mechanism_choice.h"
#include "core/discrepancy/simulator_tangents.h"
#include "core/reporting/discrepancy_report.h"
#include "core/reporting/simulation_update_report.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/fit_campaign.h"
#include "core/workflows/open_simulator.h"

namespace spindrift {
namespace {

/// Each id once; none both in and out.
DiscrepancyOptions withoutContradictions(DiscrepancyOptions options) {
  std::vector<std::string> once;
  for (const std::string& id : options.accept) {
    if (std::find(options.reject.begin(), options.reject.end(), id) != options.reject.end()) {
      throw InputError(fmt::format("effect \"{}\" is accepted and rejected; allowed: one of the two.", id));
    }
    if (std::find(once.begin(), once.end(), id) == once.end()) once.push_back(id);
  }
  options.accept = std::move(once);
  return options;
}

/// The simulator that the user allows to be run: a campaign from elsewhere runs no program by being looked at.
std::filesystem::path simulatorOf(const DiscrepancyRequest& request, const Campaign& campaign) {
  if (!request.simulator.empty()) return request.simulator;
  if (request.into_simulation.empty()) return {};
  if (campaign.simulator.empty()) {
    throw InputError({campaign.path("campaign.json"), ""},
                     "names no simulator that something could be put into; allowed: \"simulator\": \"simulator.json\", "
                     "or --simulator FILE.");
  }
  return campaign.path(campaign.simulator.string());
}

/// The prediction of a run as simulation.csv: the whole table where there is one, else at the observations.
std::string predictionCsv(const SimulationUpdate& update, const std::vector<Observation>& observations) {
  if (!update.rows.empty()) return simulationCsv(update.rows, false);
  std::vector<SimulationRow> rows;
  std::set<std::tuple<std::string, Component, double>> seen;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    if (!std::isfinite(update.after[i]) || !seen.insert({o.point, o.component, o.time_s}).second) continue;
    rows.push_back({o.time_s, o.point, o.position_mm, o.component, update.after[i]});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SimulationRow& a, const SimulationRow& b) { return a.time_s < b.time_s; });
  return simulationCsv(rows, false);
}

}  // namespace

nlohmann::json DiscrepancyRun::json() const {
  nlohmann::json out = result.json();
  nlohmann::json& gap = out["gap"];
  const std::vector<DiscrepancyReportRow> rows = discrepancyReportData(input, result).rows;
  for (const bool held_out : {false, true}) {
    const GapFigures figures = gapFigures(rows, held_out);
    const std::string prefix = held_out ? "heldout_" : "";
    const std::string unit = figures.rotations ? "_urad" : "_um";
    gap[prefix + "p2p_before" + unit] = jsonNumber(figures.p2p_before);
    gap[prefix + "p2p_after" + unit] = jsonNumber(figures.p2p_after);
    gap[prefix + "fit_before_percent"] = jsonNumber(figures.fit_before_percent);
    gap[prefix + "fit_after_percent"] = jsonNumber(figures.fit_after_percent);
  }
  if (update) out["into_simulation"] = update->json();
  return out;
}

DiscrepancyRun searchDiscrepancy(const Campaign& campaign, ObservationSet observations,
                                 const DiscrepancyOptions& options, JobContext& job) {
  options.validate();
  const DiscrepancyOptions asked = withoutContradictions(options);
  DiscrepancyRun run;
  run.input = discrepancyInput(campaign, std::move(observations));
  run.result = findDiscrepancy(run.input, asked, job);
  return run;
}

DiscrepancyRun searchDiscrepancy(const Campaign& campaign, ObservationSet observations,
                                 const DiscrepancyOptions& options, const Simulator& simulator, JobContext& job) {
  options.validate();
  const DiscrepancyOptions asked = withoutContradictions(options);
  JobContext running = job.part(0.0, 0.6);
  auto tangents = std::make_shared<const SimulatorTangents>(simulatorTangents(simulator, observations, running));
  DiscrepancyRun run;
  run.input = discrepancyInput(campaign, std::move(observations), std::move(tangents));
  JobContext searching = job.part(0.6, 1.0);
  run.result = findDiscrepancy(run.input, asked, searching);
  run.mechanisms = mechanismsBehind(run.input, run.result, simulator).names;
  return run;
}

SimulationUpdate updateSimulation(const Campaign& campaign, const DiscrepancyRun& run, const Simulator& simulator,
                                  const IntoSimulationOptions& options, const std::filesystem::path& folder,
                                  JobContext& job) {
  if (std::filesystem::exists(folder) && !std::filesystem::is_empty(folder))
    throw InputError({folder, ""}, "is not empty; allowed: a new folder for the simulation's new version.");
  SimulationUpdate update = putIntoSimulation(run.input, run.result, simulator, options, job);
  if (update.status != FitStatus::Converged) return update;
  nlohmann::json change = update.json();
  change["campaign"] = campaign.name;
  change.erase("where");
  simulator.writeVersion(update.values, folder, change);
  writeFileAtomically(folder / "simulation.csv", predictionCsv(update, run.input.observations.rows));
  return update;
}

nlohmann::json EffectsAnswer::json() const {
  nlohmann::json out = effectsJson(effects, own.get());
  out["warnings"] = warnings;
  return out;
}

std::string EffectsAnswer::summary() const {
  std::string text = effectsText(effects) + fmt::format("{} effects\n", effects.size());
  for (const std::string& warning : warnings) text += fmt::format("note: {}\n", warning);
  return text;
}

EffectsAnswer listEffects(const EffectsRequest& request) {
  EffectsAnswer out;
  if (request.campaign.empty()) {
    if (!request.effects.empty()) out.own = OwnEffects::read(request.effects);
    if (!out.own || out.own->builtIn()) out.effects = everyEffect();
    if (!out.own) return out;
    // Without a log: the drivers as they are written.
    for (const OwnEffect& own : out.own->effects()) {
      Effect effect = own.effect;
      if (own.drivers.empty()) effect.variants.push_back({{{"", own.dynamics}}, false});
      for (const std::vector<OwnDriver>& alternative : own.drivers) {
        EffectVariant variant;
        for (const OwnDriver& driver : alternative)
          variant.inputs.push_back({ownDriverName(driver.text), own.dynamics});
        effect.variants.push_back(std::move(variant));
      }
      out.effects.push_back(std::move(effect));
    }
    return out;
  }
  Campaign campaign = Campaign::read(request.campaign);
  if (!request.effects.empty()) campaign.effects = std::filesystem::absolute(request.effects);
  if (!campaign.effects.empty()) out.own = OwnEffects::read(campaign.path(campaign.effects.string()));
  return listEffects(campaign, campaign.observations ? &*campaign.observations : nullptr, std::move(out.own));
}

EffectsAnswer listEffects(const Campaign& campaign, const ObservationSet* observations,
                          std::shared_ptr<const OwnEffects> own_effects) {
  EffectsAnswer out;
  out.own = std::move(own_effects);
  const OperatingLog* log = campaign.log ? &*campaign.log : nullptr;
  DriverTable drivers(campaign.machine, log);
  if (!out.own || out.own->builtIn()) {
    CatalogueContext context;
    context.machine = &campaign.machine;
    context.drivers = &drivers;
    if (observations != nullptr) context.points = observations->points();
    context.point_count = context.points.size();
    context.varying_approach = {"x", "y", "z"};
    context.c_varies = !campaign.machine.rotary.empty();
    context.position_varies = true;
    out.effects = effectCatalogue(context);
  }
  if (!out.own) return out;
  std::vector<Effect> own = out.own->bind(drivers, log, campaign.machine.reference_temperature_degC, campaign.absolute);
  if (observations != nullptr) out.own->check(own, observations->rows, out.warnings);
  for (Effect& effect : own) out.effects.push_back(std::move(effect));
  return out;
}

DiscrepancyRun runDiscrepancy(const DiscrepancyRequest& request, JobContext& job) {
  request.options.validate();
  Campaign campaign = Campaign::read(request.campaign);
  if (!request.effects.empty()) campaign.effects = std::filesystem::absolute(request.effects);
  const auto root = std::filesystem::weakly_canonical(campaign.folder).string() + "/";
  for (const auto& file : {request.model_out, request.prediction, request.html, request.into_simulation}) {
    if (!file.empty() && std::filesystem::weakly_canonical(file).string().starts_with(root)) {
      throw InputError({file, ""}, "lies in the campaign folder, which is never written to; allowed: any other place.");
    }
  }
  JobContext first = job.part(0.0, 0.2);
  std::vector<std::string> notes;
  ObservationSet observations = observationsOf(campaign, request.observations, {}, first, &notes);
  JobContext second = job.part(0.2, 1.0);
  DiscrepancyRun run;
  if (const std::filesystem::path file = simulatorOf(request, campaign); !file.empty()) {
    const std::unique_ptr<Simulator> simulator = openSimulator(file, campaign, observations);
    JobContext search = second.part(0.0, request.into_simulation.empty() ? 1.0 : 0.4);
    run = searchDiscrepancy(campaign, std::move(observations), request.options, *simulator, search);
    if (!request.into_simulation.empty()) {
      JobContext fit = second.part(0.4, 1.0);
      run.update = updateSimulation(campaign, run, *simulator, {request.mechanisms}, request.into_simulation, fit);
    }
  } else {
    if (!campaign.simulator.empty()) {
      notes.push_back(
          fmt::format("campaign.json names the simulator {}, which was not run; --simulator {} runs it and "
                      "looks among its parameters as well.",
                      campaign.simulator.string(), campaign.path(campaign.simulator.string()).string()));
    }
    run = searchDiscrepancy(campaign, std::move(observations), request.options, second);
  }
  run.notes = std::move(notes);
  if (!request.model_out.empty()) writeFileAtomically(request.model_out, run.result.model->json().dump(2) + "\n");
  if (!request.prediction.empty()) {
    std::string text = "time_s,point,component,predicted\n";
    const auto& rows = run.input.observations.rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!std::isfinite(run.result.completed[i])) continue;
      text += fmt::format("{},{},{},{}\n", rows[i].time_s, csvField(rows[i].point), toString(rows[i].component),
                          run.result.completed[i]);
    }
    writeFileAtomically(request.prediction, text);
  }
  if (!request.html.empty()) {
    const std::optional<FieldGrid> table = mapTable(campaign.machine, 0.0, report_map_nodes);
    Report document = discrepancyDocument(campaign.name, discrepancyReportData(run.input, run.result), table);
    if (run.update) addSimulationUpdate(document, *run.update, simulationUpdateRows(run.input, *run.update), table);
    writeFileAtomically(request.html, htmlOf(document));
  }
  return run;
}

}  // namespace spindrift
