// SPDX-License-Identifier: Apache-2.0
#include "core/plant/publish.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/utc_time.h"
#include "core/machine/campaign.h"
#include "core/plant/plant_connection.h"
#include "core/session/fingerprint.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/fit_campaign.h"

namespace spindrift {
namespace {

std::string hostName() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// {"NAME":{"value":..,"standard_uncertainty":..}}; what has no value is left out.
void addParameters(const nlohmann::json& parameters, const std::string& state, std::vector<PlantParameter>& out) {
  if (!parameters.is_object()) return;
  for (const auto& [name, entry] : parameters.items()) {
    if (!entry.is_object() || !entry.contains("value") || !entry["value"].is_number()) continue;
    const auto sigma = entry.find("standard_uncertainty");
    out.push_back({state, name, entry["value"].get<double>(),
                   sigma != entry.end() && sigma->is_number() ? std::max(0.0, sigma->get<double>()) : 0.0});
  }
}

std::string textOf(const nlohmann::json& payload, const char* key) {
  const auto found = payload.find(key);
  return found != payload.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// `effects` of a search, each with its parameters: names as "id.parameter".
void addEffects(const nlohmann::json& payload, std::vector<PlantParameter>& out) {
  const auto effects = payload.find("effects");
  if (effects == payload.end() || !effects->is_array()) return;
  for (const nlohmann::json& effect : *effects) {
    if (!effect.is_object() || !effect.contains("parameters") || !effect["parameters"].is_object()) continue;
    const nlohmann::json sigma = effect.value("standard_uncertainty", nlohmann::json::object());
    for (const auto& [name, value] : effect["parameters"].items()) {
      if (value.is_object()) addParameters({{textOf(effect, "id") + "." + name, value}}, "", out);
      if (!value.is_number()) continue;
      const auto u = sigma.find(name);
      out.push_back({"", textOf(effect, "id") + "." + name, value.get<double>(),
                     u != sigma.end() && u->is_number() ? std::max(0.0, u->get<double>()) : 0.0});
    }
  }
}

std::optional<PlantResult> fromPayload(const std::string& kind, const nlohmann::json& payload) {
  static constexpr std::array kinds{"fit", "evaluate", "thermal", "discrepancy", "verify"};
  if (!payload.is_object() || std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) return std::nullopt;
  // Evaluations are kept with their observations beside what the command says, searches with their story.
  for (const char* inside : {"json", "result"}) {
    if (const auto inner = payload.find(inside); inner != payload.end() && inner->is_object())
      return fromPayload(kind, *inner);
  }
  PlantResult r;
  r.kind = kind;
  r.verdict = textOf(payload, "verdict");
  if (r.verdict.empty()) r.verdict = textOf(payload, "status");
  // A fit that was rejected has no parameters, whatever a program of old has written of them.
  if (textOf(payload, "status") == toString(FitStatus::Rejected)) return r;
  addParameters(payload.value("parameters", nlohmann::json()), textOf(payload, "state"), r.parameters);
  if (const auto cycles = payload.find("cycles"); cycles != payload.end() && cycles->is_array()) {
    for (const nlohmann::json& cycle : *cycles) {
      if (cycle.is_object())
        addParameters(cycle.value("parameters", nlohmann::json()), textOf(cycle, "cycle"), r.parameters);
    }
  }
  addEffects(payload, r.parameters);
  if (payload.contains("covariance") && payload.contains("parameter_order"))
    r.covariance = {{"order", payload["parameter_order"]}, {"matrix", payload["covariance"]}};
  if (payload.contains("model") && payload["model"].is_object()) r.model = payload["model"];
  if (kind == "fit" && r.model.is_null() && !r.parameters.empty())
    r.model = {{"model", payload.value("model", nlohmann::json("nine-parameter"))},
               {"state", textOf(payload, "state")}};
  if (r.verdict.empty() && r.parameters.empty() && r.model.is_null()) return std::nullopt;
  return r;
}

double startOf(const Campaign& campaign) {
  const std::optional<double> start_s = parseUtc(campaign.start_utc);
  if (!start_s)
    throw InputError(
        {campaign.path("campaign.json"), "$.start_utc"},
        fmt::format("\"{}\" is not a time; allowed: UTC such as 2026-01-31T08:00:00Z.", campaign.start_utc));
  return *start_s;
}

PlantCampaign headOf(const Campaign& campaign) {
  PlantCampaign c;
  c.machine = campaign.machine.name;
  c.description = campaign.machine.source;
  c.name = campaign.name;
  c.start_s = startOf(campaign);
  c.program_version = SPINDRIFT_VERSION;
  c.publisher = plantPublisher();
  return c;
}

void addCaptures(const std::filesystem::path& folder, const FileFingerprints& files, PlantCampaign& c) {
  const std::string where = hostName() + ":" + std::filesystem::absolute(folder).string() + "/";
  for (const auto& [name, sha256] : files) {
    if (name.starts_with("captures/") || name == "log.csv" || name == "observations.csv")
      c.captures.push_back({where + name, sha256});
  }
}

constexpr const char* queue_key = "plant/waiting";

/// {"STORE":[campaigns]}
nlohmann::json queueOf(const Session& session) {
  nlohmann::json queue = session.setting(queue_key).value_or(nlohmann::json::object());
  return queue.is_object() ? queue : nlohmann::json::object();
}

}  // namespace

std::string plantPublisher() {
  const passwd* user = ::getpwuid(::geteuid());
  return fmt::format("{}@{}", user != nullptr ? user->pw_name : std::to_string(::geteuid()), hostName());
}

std::optional<PlantResult> plantResult(const StoredResult& stored) {
  std::optional<PlantResult> r = fromPayload(stored.kind, stored.payload);
  if (!r) return std::nullopt;
  r->program_version = stored.provenance.program_version;
  r->created_utc = stored.provenance.created_utc;
  r->inputs_fingerprint = stored.provenance.inputs_fingerprint;
  r->options = stored.provenance.options;
  return r;
}

PlantCampaign plantCampaign(const std::filesystem::path& folder, JobContext& job) {
  const Campaign campaign = Campaign::read(folder);
  PlantCampaign c = headOf(campaign);
  const FileFingerprints files = fingerprintsOfFiles(folder, job.part(0.0, 0.2));
  c.fingerprint = fingerprintOf(files);
  addCaptures(folder, files, c);
  const auto add = [&](const std::string& kind, const nlohmann::json& payload) {
    std::optional<PlantResult> r = fromPayload(kind, payload);
    if (!r) return;
    r->program_version = SPINDRIFT_VERSION;
    r->created_utc = utcNow();
    r->inputs_fingerprint = c.fingerprint;
    c.results.push_back(std::move(*r));
  };
  std::optional<ObservationSet> observations = campaign.observations;
  JobContext evaluating = job.part(0.2, 0.8);
  if (!observations) {
    CampaignEvaluation evaluation = evaluateCampaign(campaign, {}, evaluating);
    add("evaluate", evaluation.json());
    observations = std::move(evaluation.observations);
  }
  if (lastStateToFit(*observations).empty()) return c;
  // Points are what the nine parameters are fitted to; cycles of an artefact have their own.
  const bool of_points = std::any_of(observations->rows.begin(), observations->rows.end(),
                                     [](const Observation& row) { return row.instrument != "touch_probe"; });
  if (of_points && c.results.empty()) {
    const NineParameterFit fit = fitNineParameters(*observations, {});
    add("fit", toJson(fit));
  }
  return c;
}

std::vector<PlantCampaign> waitingFor(const Session& session, const std::string& store) {
  std::vector<PlantCampaign> waiting;
  const nlohmann::json queue = queueOf(session);
  const auto found = queue.find(store);
  if (found == queue.end() || !found->is_array()) return waiting;
  for (const nlohmann::json& campaign : *found)
    waiting.push_back(PlantCampaign::parse(campaign, "waiting for the plant store"));
  return waiting;
}

Publication beginPublication(const Session& session, const std::vector<CampaignState>& campaigns,
                             const PlantAddress& address) {
  Publication p;
  p.store = address.text();
  p.campaigns = waitingFor(session, p.store);
  p.waited = !p.campaigns.empty();
  const TaskLedger nothing_runs;
  for (const CampaignState& state : campaigns) {
    Publication::Pending pending{session.campaign(state.id), state.files, {}};
    const TaskGraph graph = state.tasks(session, nothing_runs);
    for (const std::string& kind : session.resultKinds(state.id)) {
      const StoredResult* stored = graph.latest(kind);
      if (stored == nullptr) continue;
      std::optional<PlantResult> r = plantResult(*stored);
      if (!r) continue;
      pending.results.push_back(std::move(*r));
      if (graph.holds(*stored)) continue;
      const TaskKind* task = taskKind(kind);
      p.warnings.push_back(fmt::format(
          "Published although it is outdated: {} of {}. Changed since: {}. Run it again, and publish again.",
          task != nullptr ? task->result : std::string_view(kind), pending.record.name,
          joinedList(graph.changes(*stored))));
    }
    p.pending.push_back(std::move(pending));
  }
  return p;
}

PublishOutcome sendPublication(Publication& p, const PlantAddress& address, const PlantOpening& opening,
                               JobContext& job) {
  for (std::size_t i = 0; i < p.pending.size(); ++i) {
    const auto& [record, campaign, results] = p.pending[i];
    job.report(static_cast<double>(i) / static_cast<double>(p.pending.size()), "reading the campaign");
    PlantCampaign c = headOf(*campaign);
    c.fingerprint = record.fingerprint;
    c.results = results;
    addCaptures(record.folder, fingerprintsOfFiles(record.folder, job), c);
    // What waits of the same campaign with the same results is not kept twice.
    std::erase_if(p.campaigns, [&](const PlantCampaign& w) {
      return w.machine == c.machine && w.fingerprint == c.fingerprint &&
             std::all_of(w.results.begin(), w.results.end(), [&](const PlantResult& r) {
               return std::any_of(c.results.begin(), c.results.end(),
                                  [&](const PlantResult& other) { return other.key() == r.key(); });
             });
    });
    p.campaigns.push_back(std::move(c));
  }
  p.pending.clear();
  PublishOutcome outcome;
  outcome.warnings = p.warnings;
  try {
    PlantStore plant = PlantStore::openOrMake(address, opening);
    outcome.warnings.insert(outcome.warnings.end(), plant.warnings().begin(), plant.warnings().end());
    outcome.count = plant.publish(p.campaigns);
  } catch (const PlantUnreachable& failure) {
    outcome.waiting = p.campaigns.size();
    outcome.reason = failure.what();
  }
  return outcome;
}

void endPublication(Session& session, const Publication& p, const PublishOutcome& outcome) {
  // A crash before this publishes again what is there already: nothing is there twice.
  if (outcome.waiting == 0 && !p.waited) return;
  nlohmann::json queue = queueOf(session);
  queue.erase(p.store);
  if (outcome.waiting > 0) {
    for (const PlantCampaign& c : p.campaigns) queue[p.store].push_back(c.json());
  }
  session.setSetting(queue_key, queue);
}

PublishOutcome publishFromSession(Session& session, const std::vector<std::int64_t>& campaigns,
                                  const PlantAddress& address, const PlantOpening& opening) {
  std::vector<CampaignState> states;
  for (const std::int64_t id : campaigns) states.push_back(CampaignState::read(session, id));
  Publication publication = beginPublication(session, states, address);
  JobContext job;
  const PublishOutcome outcome = sendPublication(publication, address, opening, job);
  endPublication(session, publication, outcome);
  return outcome;
}

}  // namespace spindrift
