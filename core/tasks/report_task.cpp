// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/report_task.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/reporting/report_language.h"
#include "core/tasks/steps.h"
#include "core/tasks/task_options.h"

namespace spindrift {
namespace {

/// The result that made the simulator at hand, without its payload; nothing if there is none.
std::optional<StoredResult> simulationUpdateOf(const TaskGraph& graph) {
  const std::string simulator = SimulationOptions::of(graph.session(), graph.campaign(), graph.data()).simulator;
  if (simulator.empty()) return {};
  const std::vector<StoredResult> all = graph.session().resultHeads(graph.campaign(), "simulation");
  for (auto it = all.rbegin(); it != all.rend(); ++it)
    if (optionsFrom<SimulationOptions>(it->provenance.options).version == simulator) return *it;
  return {};
}

StoredResults storedOf(const TaskGraph& graph) {
  StoredResults out;
  const auto changed = [&](const StoredResult& result) {
    if (const std::vector<std::string> what = graph.changes(result); !what.empty())
      out.changed[result.kind] = joinedList(what);
  };
  const auto payload = [&](const char* kind) {
    const StoredResult* result = graph.latest(kind);
    if (result == nullptr) return nlohmann::json();
    changed(*result);
    return result->payload;
  };
  const auto kept = [&](const char* key) {
    return graph.session().setting(campaignKey(key, graph.campaign())).value_or(nlohmann::json());
  };
  out.plan = kept(option_keys::plan);
  out.warm_statement = warmStatement(graph).value_or(nlohmann::json());
  out.warm_up = payload("check-warm-up");
  out.jogs = payload("check-jogs");
  out.repeatability = payload("check-repeatability");
  // In place of what is evaluated now only while it holds.
  if (const StoredResult* fit = graph.latest("fit");
      fit != nullptr && taskKind("fit", graph.facts()).told && graph.holds(*fit))
    out.fit = fit->payload;
  out.thermal = payload("thermal");
  if (chosen<Iso230Choice>(graph.session(), graph.campaign()).told(graph.data()))
    out.standard_test = payload("iso-230-3");
  out.compensation = payload("compensation");
  out.log_compensation = payload("log-compensation");
  out.verification = payload("verify");
  if (const auto update = simulationUpdateOf(graph)) {
    changed(*update);
    out.simulation = graph.session().payload(update->id);
  }
  return out;
}

}  // namespace

ReportTask ReportTask::of(const TaskGraph& graph, const ExcludedItems& excluded) {
  const Session& session = graph.session();
  const std::int64_t id = graph.campaign();
  ReportTask task;
  task.folder = session.folder();
  task.name = fmt::format("reports/report-{}", id);

  const ReportTaskOptions asked = ReportTaskOptions::of(session, id);
  task.campaign = asked.effects.applied(withoutExcluded(graph.data(), excluded), EffectOptions::file(session, id));

  task.options.operator_name = asked.operator_name;
  task.options.discrepancy = asked.tells_discrepancy;
  task.options.stored = storedOf(graph);
  // Captures whose evaluation still holds are not evaluated again.
  if (const StoredResult* result = graph.latest("evaluate"); result != nullptr && graph.holds(*result)) {
    const StoredEvaluation stored = evaluationFrom(*result);
    task.options.evaluated = asWorkedOut(stored);
    if (task.options.evaluated)
      task.options.evaluated->observations =
          *observationsToFit(graph.data(), &stored, excluded, clockOffsetsOf(session, id));
  }
  // A search that still holds is told, not made again.
  const StoredResult* searched = graph.latest("discrepancy");
  if (searched != nullptr && graph.status("discrepancy").current)
    task.options.story = std::make_shared<const nlohmann::json>(searched->payload);
  task.options.choices = [excluded, clocks = clockOffsetsOf(session, id)](ObservationSet& set) {
    applyChoices(set, excluded, clocks);
  };
  task.options.fingerprint = session.inputs(id).value("files", std::string());
  task.options.search.accept = asked.effects.added;
  task.options.search.reject = asked.effects.rejected;
  task.options.fit = asked.fit.options();
  task.options.fit.state.clear();
  if (asked.iso230.told(graph.data()))
    task.options.iso230 = [choice = asked.iso230](const TimeSeries& series) { return choice.request(series); };
  task.options.exclusions.assign(excluded.begin(), excluded.end());
  task.options.notes = asked.notes;
  return task;
}

nlohmann::json WrittenReport::json() const {
  nlohmann::json out = {{"file", html}, {"pdf", pdf}, {"bytes", bytes}, {"figures", figures}, {"tables", tables}};
  if (translation)
    out["translations"] = {{translation->language, {{"file", translation->html}, {"pdf", translation->pdf}}}};
  return out;
}

ReportNames ReportTask::namesThatPeopleGave() const {
  const MachineDescription& machine = campaign->machine;
  ReportNames names;
  names.within = {campaign->name, machine.name, options.operator_name};
  for (const MachinePoint& point : machine.points) names.whole.push_back(point.id);
  for (const Artefact& artefact : machine.artefacts) names.whole.push_back(artefact.id);
  for (const Stylus& stylus : machine.styli) names.whole.push_back(stylus.id);
  for (const auto& [item, reason] : options.exclusions) {
    names.whole.push_back(item);
    names.whole.push_back(reason);
  }
  for (const std::string& note : options.notes) {  // "moment  step, item: text"
    const std::size_t text = note.find(": ");
    if (text != std::string::npos) names.whole.push_back(note.substr(text + 2));
  }
  return names;
}

WrittenReport ReportTask::run(JobContext& job) const {
  JobContext computing = job.part(0.0, 0.8);
  // What was excluded of its own observations is marked here: where the session lives nobody waits for it.
  Campaign marked = *campaign;
  if (marked.observations)
    marked.observations =
        observationsToFit(*campaign, nullptr, {options.exclusions.begin(), options.exclusions.end()}, {});
  const Report report = reportOfCampaign(marked, options, computing);
  const std::optional<ReportLanguage>& language = offeredReportLanguage();
  const auto ending = [&](bool translated) { return translated ? "." + language->code : std::string(); };
  std::vector<std::pair<std::string, std::string>> files;  // all are made before the first is written
  const auto make = [&](const Report& one, bool translated, const JobContext& part) {
    files.emplace_back(name + ending(translated) + ".html", htmlOf(one));
    files.emplace_back(name + ending(translated) + ".pdf", pdfOf(one, part).bytes);
  };
  make(report, false, job.part(0.8, 0.9));
  if (language) make(inLanguage(report, *language, namesThatPeopleGave()), true, job.part(0.9, 1.0));
  job.throwIfCancelled();
  std::filesystem::create_directories((folder / name).parent_path());
  for (const auto& [file, bytes] : files) writeFileAtomically(folder / file, bytes);
  WrittenReport out{files[0].first,       files[1].first,      files[0].second.size(),
                    report.figureCount(), report.tableCount(), {}};
  if (language) out.translation = {language->code, files[2].first, files[3].first};
  return out;
}

}  // namespace spindrift
