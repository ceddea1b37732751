// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/campaign_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/workflows/compensated_data.h"

namespace spindrift {

namespace {

/// The kind of results that hold what was evaluated from captures.
constexpr std::string_view of_captures = "evaluate";

/// Factors as lists of [row, load].
nlohmann::json sharedJson(const SharedNoise& shared) {
  nlohmann::json out = nlohmann::json::array();
  for (const SharedNoise::Factor& factor : shared.factors()) {
    nlohmann::json loads = nlohmann::json::array();
    for (const SharedNoise::Load& l : factor) loads.push_back({l.row, l.load});
    out.push_back(std::move(loads));
  }
  return out;
}

/// The entries of a list of lists in a stored result. Throws InputError: a session can be damaged or written by
/// another.
class StoredEntries {
 public:
  StoredEntries(std::string key, std::size_t rows) : key_(std::move(key)), rows_(rows) {}

  const nlohmann::json& list(const nlohmann::json& value, std::size_t least_length) const {
    if (!value.is_array() || value.size() < least_length)
      reject(value, least_length == 0 ? "a list" : fmt::format("a list of at least {} entries", least_length));
    return value;
  }
  std::size_t row(const nlohmann::json& value) const {
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0 || value.get<std::size_t>() >= rows_)
      reject(value, fmt::format("a row from 0 to {}", static_cast<std::int64_t>(rows_) - 1));
    return value.get<std::size_t>();
  }
  double number(const nlohmann::json& value) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) reject(value, "a finite number");
    return value.get<double>();
  }

 private:
  [[noreturn]] void reject(const nlohmann::json& value, const std::string& allowed) const {
    const std::string found = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    throw InputError({"stored observations", "$." + key_},
                     fmt::format("{} is not allowed; allowed: {}.", found.substr(0, 40), allowed));
  }

  std::string key_;
  std::size_t rows_;
};

void readShared(const nlohmann::json& payload, ObservationSet& set) {
  if (const auto shared = payload.find("shared_noise"); shared != payload.end()) {
    const StoredEntries entries("shared_noise", set.rows.size());
    for (const auto& loads : entries.list(*shared, 0)) {
      SharedNoise::Factor factor;
      for (const auto& l : entries.list(loads, 0)) {
        entries.list(l, 2);
        factor.push_back({entries.row(l[0]), entries.number(l[1])});
      }
      set.shared.addFactor(std::move(factor));
    }
    return;
  }
  // Sessions of versions that stored covariances of pairs of rows.
  const StoredEntries entries("covariance", set.rows.size());
  std::vector<CovarianceEntry> covariances;
  for (const auto& e : entries.list(payload.at("covariance"), 0)) {
    entries.list(e, 3);
    covariances.push_back({entries.row(e[0]), entries.row(e[1]), entries.number(e[2])});
  }
  set.setCovariances(covariances);
}

constexpr std::string_view calibration_limit = "calibration_limit";

/// Beside the sentences, which stand in a list of their own.
nlohmann::json kindsJson(const std::vector<EvaluationWarning>& warnings) {
  nlohmann::json kinds = nlohmann::json::array();
  for (const EvaluationWarning& w : warnings)
    kinds.push_back(w.kind == WarningKind::CalibrationLimit ? calibration_limit : "finding");
  return kinds;
}

std::vector<EvaluationWarning> warningsFrom(const nlohmann::json& sentences, const nlohmann::json& kinds) {
  std::vector<EvaluationWarning> warnings;
  for (const auto& sentence : sentences) {
    const bool limit =
        kinds.is_array() && warnings.size() < kinds.size() && kinds[warnings.size()] == calibration_limit;
    warnings.emplace_back(sentence.get<std::string>(), limit ? WarningKind::CalibrationLimit : WarningKind::Finding);
  }
  return warnings;
}

nlohmann::json sentencesJson(const std::vector<EvaluationWarning>& warnings) {
  nlohmann::json sentences = nlohmann::json::array();
  for (const EvaluationWarning& w : warnings) sentences.push_back(w.sentence);
  return sentences;
}

nlohmann::json instrumentsJson(const std::vector<InstrumentEvaluation>& instruments) {
  nlohmann::json out = nlohmann::json::array();
  for (const InstrumentEvaluation& one : instruments) {
    nlohmann::json rejected = nlohmann::json::array();
    for (const RejectedCapture& r : one.rejected) rejected.push_back({r.capture, r.reason});
    out.push_back({{"instrument", one.instrument},
                   {"rejected", std::move(rejected)},
                   {"warnings", sentencesJson(one.warnings)},
                   {"warning_kinds", kindsJson(one.warnings)},
                   {"details", one.details},
                   {"summary", one.summary},
                   {"good_enough", one.good_enough}});
  }
  return out;
}

InstrumentEvaluation instrumentFrom(const nlohmann::json& stored) {
  InstrumentEvaluation one;
  one.instrument = stored.at("instrument").get<std::string>();
  for (const auto& r : stored.at("rejected"))
    one.rejected.push_back({r.at(0).get<std::string>(), r.at(1).get<std::string>()});
  one.warnings = warningsFrom(stored.at("warnings"), stored.value("warning_kinds", nlohmann::json()));
  one.details = stored.at("details");
  one.summary = stored.at("summary").get<std::string>();
  one.good_enough = stored.at("good_enough").get<bool>();
  return one;
}

}  // namespace

std::vector<EvaluationWarning> warningsOfEvaluation(const nlohmann::json& payload) {
  return warningsFrom(payload.value("json", nlohmann::json::object()).value("warnings", nlohmann::json::array()),
                      payload.value("warning_kinds", nlohmann::json()));
}

nlohmann::json payloadOf(const CampaignEvaluation& evaluation) {
  std::vector<EvaluationWarning> warnings;
  for (const InstrumentEvaluation& one : evaluation.instruments)
    warnings.insert(warnings.end(), one.warnings.begin(), one.warnings.end());
  nlohmann::json payload = {{"json", evaluation.json()},
                            {"warning_kinds", kindsJson(warnings)},
                            {"summary", evaluation.summary()},
                            {"good_enough", evaluation.good_enough},
                            {"observations", evaluation.observations.csv()},
                            {"shared_noise", sharedJson(evaluation.observations.shared)}};
  // Of one instrument all of it says the same.
  if (evaluation.instruments.size() > 1) payload["instruments"] = instrumentsJson(evaluation.instruments);
  return payload;
}

StoredEvaluation evaluationFrom(const StoredResult& result) try {
  StoredEvaluation evaluation;
  evaluation.id = result.id;
  const nlohmann::json& p = result.payload;
  evaluation.details = p.at("json");
  evaluation.summary = p.at("summary").get<std::string>();
  evaluation.good_enough = p.at("good_enough").get<bool>();
  evaluation.observations = ObservationSet::parse(p.at("observations").get<std::string>(), "stored observations");
  readShared(p, evaluation.observations);
  for (const auto& r : evaluation.details.value("rejected", nlohmann::json::array())) {
    evaluation.rejected.push_back({r.at("capture").get<std::string>(), r.at("reason").get<std::string>()});
  }
  evaluation.warnings = warningsOfEvaluation(p);
  for (const auto& one : p.value("instruments", nlohmann::json::array()))
    evaluation.instruments.push_back(instrumentFrom(one));
  return evaluation;
} catch (const nlohmann::json::exception&) {
  throw InputError("the stored evaluation cannot be read; evaluate again.");
}

std::optional<CampaignEvaluation> asWorkedOut(const StoredEvaluation& stored) {
  CampaignEvaluation evaluation;
  evaluation.observations = stored.observations;
  evaluation.good_enough = stored.good_enough;
  evaluation.instruments = stored.instruments;
  if (!evaluation.instruments.empty()) return evaluation;
  const nlohmann::json names = stored.details.value("instruments", nlohmann::json::array());
  if (names.size() != 1) return {};
  InstrumentEvaluation instrument;
  instrument.instrument = names.front().get<std::string>();
  instrument.rejected = stored.rejected;
  instrument.warnings = stored.warnings;
  instrument.details = stored.details;
  instrument.summary = stored.summary;
  instrument.good_enough = stored.good_enough;
  evaluation.instruments.push_back(std::move(instrument));
  return evaluation;
}

CampaignEdits CampaignEdits::of(const Session& session, std::int64_t campaign) {
  CampaignEdits edits;
  if (auto machine = session.setting(Session::machineKey(campaign)); machine && machine->is_object())
    edits.machine = std::move(*machine);
  edits.clocks = clockOffsetsOf(session, campaign);
  return edits;
}

CampaignSource CampaignSource::of(const Session& session, std::int64_t wanted) {
  CampaignSource source;
  const std::vector<CampaignRecord> all = session.campaigns();
  if (all.empty()) return source;
  if (const auto last = session.setting("campaign"); wanted == 0 && last && last->is_number_integer())
    wanted = last->get<std::int64_t>();
  const auto found = std::find_if(all.begin(), all.end(), [&](const CampaignRecord& r) { return r.id == wanted; });
  const CampaignRecord& record = found != all.end() ? *found : all.back();
  source.id = record.id;
  source.folder = record.folder;
  source.edits = CampaignEdits::of(session, record.id);
  source.excluded = excludedItems(session, record.id);
  for (const std::string& kind : session.resultKinds(record.id))
    if (auto newest = session.latestUnread(record.id, kind)) source.newest.push_back(std::move(*newest));
  return source;
}

namespace {

/// Whether a payload can be one of its kind at all: a session may be damaged, or somebody else's.
bool isReadable(const StoredResult& result) {
  const nlohmann::json& p = result.payload;
  if (!p.is_object()) return false;
  if (result.kind != of_captures || p.empty()) return true;
  const auto is = [&](const char* key, auto right) {
    const auto found = p.find(key);
    return found == p.end() || right(*found);
  };
  return is("json", [](const nlohmann::json& j) { return j.is_object(); }) &&
         is("summary", [](const nlohmann::json& j) { return j.is_string(); }) &&
         is("observations", [](const nlohmann::json& j) { return j.is_string(); }) &&
         is("good_enough", [](const nlohmann::json& j) { return j.is_boolean(); });
}

}  // namespace

const StoredResult* CampaignResults::latest(const TaskGraph& graph, const std::string& kind) {
  auto heads = heads_.find(kind);
  if (heads == heads_.end()) heads = heads_.emplace(kind, graph.session().resultHeads(graph.campaign(), kind)).first;
  const StoredResult* head = graph.newestThatHolds(heads->second);
  if (head == nullptr) return nullptr;
  auto read = read_.find(head->id);
  if (read == read_.end()) {
    StoredResult whole = *head;
    whole.payload = graph.session().payload(head->id);
    if (!isReadable(whole)) {
      if (!head->provenance.inputs.empty()) {
        giveUp(head->id);
        return latest(graph, kind);  // an earlier one that holds, else this one as outdated
      }
      whole.payload = nlohmann::json::object();
    }
    read = read_.emplace(head->id, std::move(whole)).first;
  }
  return &read->second;
}

void CampaignResults::giveUp(std::int64_t id) {
  read_.erase(id);
  for (auto& [kind, heads] : heads_)
    for (StoredResult& head : heads)
      if (head.id == id) head.provenance.inputs = nlohmann::json::object();
}

void CampaignResults::keep(StoredResult result) {
  std::erase_if(read_, [&](const auto& read) { return read.second.kind == result.kind; });
  // Where none of this kind was asked for, all of them are read when one is.
  if (const auto heads = heads_.find(result.kind); heads != heads_.end()) {
    heads->second.push_back(result);
    heads->second.back().payload = nullptr;
  }
  takeRead(std::move(result));
}

CampaignState CampaignState::read(const CampaignSource& source, JobContext& job) {
  CampaignState state;
  if (source.id == 0) return state;
  state.id = source.id;
  job.report(0.0, "reading the campaign");
  state.files = std::make_shared<const Campaign>(Campaign::read(source.folder));
  job.throwIfCancelled();
  job.report(0.7, "reading the results");
  state.apply(source.edits);
  state.excluded = source.excluded;
  for (const UnreadResult& result : source.newest) {
    job.throwIfCancelled();
    StoredResult read = result.read();
    // What cannot be read is found when it is asked for.
    if (!isReadable(read) || read.payload.empty()) continue;
    if (read.kind == of_captures) state.evaluation_ = std::make_shared<const StoredEvaluation>(evaluationFrom(read));
    state.results_.takeRead(std::move(read));
  }
  return state;
}

CampaignState CampaignState::read(const Session& session, std::int64_t wanted) {
  JobContext unseen;
  return read(CampaignSource::of(session, wanted), unseen);
}

void CampaignState::apply(const CampaignEdits& edits) {
  machine_edited = !edits.machine.empty();
  if (!machine_edited && edits.clocks.empty()) {
    campaign = files;
    return;
  }
  auto edited = std::make_shared<Campaign>(*files);
  if (machine_edited)
    edited->machine = MachineDescription::parse(JsonNode::parse(edits.machine.dump(), "machine as edited"),
                                                edited->path("machine.json"));
  applyClockOffsets(*edited, edits.clocks);
  campaign = std::move(edited);
}

void CampaignState::keep(std::optional<StoredResult> result) {
  if (result) results_.keep(std::move(*result));
}

std::shared_ptr<const StoredEvaluation> CampaignState::evaluation(const TaskGraph& graph) const {
  const StoredResult* latest = graph.latest(std::string(of_captures));
  if (latest == nullptr || !isReadable(*latest) || latest->payload.empty()) return nullptr;
  if (evaluation_ == nullptr || evaluation_->id != latest->id)
    evaluation_ = std::make_shared<const StoredEvaluation>(evaluationFrom(*latest));
  return evaluation_;
}

TaskGraph CampaignState::tasks(const Session& session, const TaskLedger& ledger) const {
  return {session, id, campaign,
          [this](const TaskGraph& graph, const std::string& kind) { return results_.latest(graph, kind); }, ledger};
}

ClockOffsets clockOffsetsOf(const Session& session, std::int64_t campaign) {
  return clockOffsetsFrom(session.setting(Session::clocksKey(campaign)).value_or(nlohmann::json::object()));
}

ExcludedItems excludedItems(const Session& session, std::int64_t campaign) {
  ExcludedItems items;
  for (const Exclusion& e : session.exclusions(campaign)) items[e.item] = e.reason;
  return items;
}

std::shared_ptr<const Campaign> withoutExcluded(const Campaign& campaign, const ExcludedItems& excluded) {
  auto copy = std::make_shared<Campaign>(campaign);
  for (const auto& [item, reason] : excluded) copy->excluded_captures.insert(item);
  return copy;
}

namespace {
void exclude(ObservationSet& set, const ExcludedItems& excluded) {
  // 30,000 names are not made for nothing.
  for (std::size_t i = 0; !excluded.empty() && i < set.rows.size(); ++i) {
    Observation& o = set.rows[i];
    if (excluded.contains(o.state + "/" + o.point + "/" + std::string(toString(o.component))))
      o.use = ObservationUse::Exclude;
  }
}
}  // namespace

void applyChoices(ObservationSet& set, const ExcludedItems& excluded, const ClockOffsets& offsets) {
  exclude(set, excluded);
  applyClockOffsets(set, offsets);
}

std::optional<ObservationSet> observationsAtHand(const Campaign& campaign, const StoredEvaluation* evaluation,
                                                 const ExcludedItems& excluded, const ClockOffsets& offsets) {
  std::optional<ObservationSet> set = campaign.observations;
  if (set) {
    exclude(*set, excluded);  // its own clocks were moved when it was read
  } else if (evaluation != nullptr) {
    set = evaluation->observations;
    applyChoices(*set, excluded, offsets);
  }
  return set;
}

std::optional<ObservationSet> observationsToFit(const Campaign& campaign, const StoredEvaluation* evaluation,
                                                const ExcludedItems& excluded, const ClockOffsets& offsets) {
  std::optional<ObservationSet> set = observationsAtHand(campaign, evaluation, excluded, offsets);
  if (set) leaveOutCompensated(*set, campaign.log.get());
  return set;
}

/// What they are made of, and they themselves once they have been looked at.
struct ObservationsToFit::Made {
  std::shared_ptr<const Campaign> campaign;
  std::shared_ptr<const StoredEvaluation> evaluation;
  ExcludedItems excluded;
  ClockOffsets offsets;
  mutable std::once_flag once;
  mutable std::shared_ptr<const ObservationSet> set;
};

ObservationsToFit::ObservationsToFit(std::shared_ptr<const Campaign> campaign,
                                     std::shared_ptr<const StoredEvaluation> evaluation, ExcludedItems excluded,
                                     ClockOffsets offsets) {
  if (!campaign->observations && evaluation == nullptr) return;
  auto made = std::make_shared<Made>();
  made->campaign = std::move(campaign);
  made->evaluation = std::move(evaluation);
  made->excluded = std::move(excluded);
  made->offsets = std::move(offsets);
  made_ = std::move(made);
}

const std::shared_ptr<const ObservationSet>& ObservationsToFit::shared() const {
  SPINDRIFT_ASSERT(made_ != nullptr, "there are no observations");
  const Made& m = *made_;
  std::call_once(m.once, [&m] {
    const Campaign& campaign = *m.campaign;
    const bool marked = !m.excluded.empty() || (campaign.log && campaign.log->has(compensation_signal));
    m.set = campaign.observations && !marked ? campaign.observations.shared()
                                             : std::make_shared<const ObservationSet>(*observationsToFit(
                                                   campaign, m.evaluation.get(), m.excluded, m.offsets));
  });
  return m.set;
}

}  // namespace spindrift
