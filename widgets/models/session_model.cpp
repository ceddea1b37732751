// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/models/session_model.h"

#include <QDateTime>
#include <QDir>
#include <QStandardPaths>
#include <algorithm>

#include "core/base/error.h"
#include "core/tasks/task_options.h"
#include "core/workflows/compensated_data.h"

namespace spindrift::gui {
namespace {

/// All of a LoadedSession but the session itself.
LoadedSession readForPages(const Session& session, std::int64_t wanted) {
  LoadedSession loaded;
  const std::vector<CampaignRecord> all = session.campaigns();
  if (all.empty()) return loaded;
  if (const auto last = session.setting("campaign"); wanted == 0 && last && last->is_number_integer()) {
    wanted = last->get<std::int64_t>();
  }
  const auto found = std::find_if(all.begin(), all.end(), [&](const CampaignRecord& r) { return r.id == wanted; });
  const CampaignRecord& record = found != all.end() ? *found : all.back();
  loaded.campaign_id = record.id;
  auto campaign = std::make_shared<Campaign>(Campaign::read(record.folder));
  const auto edited = session.setting(Session::machineKey(record.id));
  if (edited && edited->is_object() && !edited->empty()) {
    campaign->machine =
        MachineDescription::parse(JsonNode::parse(edited->dump(), "machine as edited"), campaign->path("machine.json"));
    loaded.machine_edited = true;
  }
  if (const auto offsets = session.setting(Session::clocksKey(record.id)))
    applyClockOffsets(*campaign, clockOffsetsFrom(*offsets));
  loaded.campaign = std::move(campaign);
  for (const Exclusion& e : session.exclusions(record.id)) {
    loaded.excluded[QString::fromStdString(e.item)] = QString::fromStdString(e.reason);
  }
  for (const std::string& kind : session.resultKinds(record.id)) {
    loaded.latest[kind] = session.latestResult(record.id, kind);
  }
  if (const auto evaluation = loaded.latest.find("evaluate"); evaluation != loaded.latest.end()) {
    loaded.evaluation = std::make_shared<StoredEvaluation>(evaluationFrom(*evaluation->second));
  }
  return loaded;
}

}  // namespace

SessionModel::SessionModel(QObject* parent) : QObject(parent) {}
SessionModel::~SessionModel() = default;

LoadedSession loadSession(std::unique_ptr<Session> session, std::int64_t campaign) {
  LoadedSession loaded = readForPages(*session, campaign);
  loaded.session = std::move(session);
  return loaded;
}

void SessionModel::openSession(const std::filesystem::path& folder) {
  adopt(loadSession(std::make_unique<Session>(Session::open(folder))));
}

void SessionModel::createSession(const std::filesystem::path& folder) {
  auto made = std::make_unique<Session>(Session::create(folder));
  session_ = std::move(made);
  ++opened_;
  ledger_ = {};
  latest_.clear();
  campaign_.reset();
  campaign_id_ = 0;
  ++visit_;
  excluded_.clear();
  Q_EMIT sessionChanged();
  Q_EMIT campaignChanged();
}

void SessionModel::close() {
  session_.reset();
  ++opened_;
  ledger_ = {};
  latest_.clear();
  campaign_.reset();
  campaign_id_ = 0;
  ++visit_;
  excluded_.clear();
  Q_EMIT sessionChanged();
  Q_EMIT campaignChanged();
}

std::filesystem::path SessionModel::folder() const {
  return session_ ? session_->folder() : std::filesystem::path();
}

QString SessionModel::name() const {
  return session_ ? QString::fromStdString(session_->folder().filename().string()) : QString();
}

void SessionModel::adopt(std::unique_ptr<Session> session, std::int64_t campaign) {
  adopt(loadSession(std::move(session), campaign));
}

void SessionModel::adopt(LoadedSession loaded) {
  take(std::move(loaded));
  ++opened_;
  ledger_ = {};
  ++visit_;
  if (campaign_id_ != 0) setSetting("campaign", campaign_id_);
  Q_EMIT sessionChanged();
  Q_EMIT campaignChanged();
}

void SessionModel::take(LoadedSession loaded) {
  session_ = std::move(loaded.session);
  campaign_id_ = loaded.campaign_id;
  campaign_ = std::move(loaded.campaign);
  machine_edited_ = loaded.machine_edited;
  excluded_ = std::move(loaded.excluded);
  latest_ = std::move(loaded.latest);
  evaluation_ = std::move(loaded.evaluation);
}

void SessionModel::selectCampaign(std::int64_t id) {
  load(id);
  ++visit_;
  setSetting("campaign", id);
  Q_EMIT campaignChanged();
}

void SessionModel::load(std::int64_t id) {
  LoadedSession loaded = readForPages(*session_, id);
  loaded.session = std::move(session_);
  take(std::move(loaded));
}

std::vector<CampaignRecord> SessionModel::campaigns() const {
  return session_ ? session_->campaigns() : std::vector<CampaignRecord>();
}

bool SessionModel::has(Instrument instrument) const {
  if (campaign_ == nullptr) return false;
  const CampaignFacts facts = CampaignFacts::of(*campaign_);
  switch (instrument) {
    case Instrument::Microscope:
      return facts.images;
    case Instrument::TouchProbe:
      return facts.touches;
    case Instrument::Profiler:
      return facts.scans;
  }
  return false;
}

bool SessionModel::isLogOnly() const {
  return campaign_ != nullptr && CampaignFacts::of(*campaign_).log_only;
}

bool SessionModel::modelOverTime() const {
  return campaign_ != nullptr && tasks().overTime();
}

void SessionModel::setModelOverTime(bool over_time) {
  if (modelOverTime() == over_time) return;
  setSetting(campaignKey(option_keys::over_time), over_time);
  Q_EMIT campaignChanged();
}

ClockOffsets SessionModel::clockOffsets() const {
  return clockOffsetsFrom(setting(Session::clocksKey(campaign_id_), nlohmann::json::object()));
}

void SessionModel::setClockOffsets(const ClockOffsets& offsets) {
  if (session_ == nullptr || campaign_ == nullptr) return;
  session_->setSetting(Session::clocksKey(campaign_id_), toJson(offsets));
  load(campaign_id_);
  Q_EMIT campaignChanged();
  Q_EMIT inputsChanged();
}

CampaignSnapshot SessionModel::snapshot() const {
  CampaignSnapshot copy;
  if (campaign_ == nullptr) return copy;
  auto campaign = std::make_shared<Campaign>(*campaign_);
  for (const auto& [item, reason] : excluded_) {
    copy.excluded.insert(item.toStdString());
    campaign->excluded_captures.insert(item.toStdString());
  }
  copy.campaign = std::move(campaign);
  return copy;
}

nlohmann::json payloadOf(const CampaignEvaluation& evaluation) {
  nlohmann::json covariance = nlohmann::json::array();
  for (const CovarianceEntry& e : evaluation.observations.covariance)
    covariance.push_back({e.row, e.column, e.covariance});
  return {{"json", evaluation.json()},
          {"summary", evaluation.summary()},
          {"good_enough", evaluation.good_enough},
          {"observations", evaluation.observations.csv()},
          {"covariance", covariance}};
}

StoredEvaluation evaluationFrom(const StoredResult& result) {
  StoredEvaluation evaluation;
  evaluation.id = result.id;
  const nlohmann::json& p = result.payload;
  evaluation.details = p.at("json");
  evaluation.summary = p.at("summary").get<std::string>();
  evaluation.good_enough = p.at("good_enough").get<bool>();
  evaluation.observations = ObservationSet::parse(p.at("observations").get<std::string>(), "stored observations");
  for (const auto& e : p.at("covariance")) {
    evaluation.observations.covariance.push_back(
        {e.at(0).get<std::size_t>(), e.at(1).get<std::size_t>(), e.at(2).get<double>()});
  }
  for (const auto& r : evaluation.details.value("rejected", nlohmann::json::array())) {
    evaluation.rejected.push_back({r.at("capture").get<std::string>(), r.at("reason").get<std::string>()});
  }
  for (const auto& w : evaluation.details.value("warnings", nlohmann::json::array())) {
    evaluation.warnings.push_back(w.get<std::string>());
  }
  return evaluation;
}

std::shared_ptr<const StoredEvaluation> SessionModel::evaluation() const {
  const StoredResult* found = latest("evaluate");
  if (found == nullptr) return nullptr;
  if (evaluation_ == nullptr || evaluation_->id != found->id) {
    evaluation_ = std::make_shared<StoredEvaluation>(evaluationFrom(*found));
  }
  return evaluation_;
}

std::optional<ObservationSet> SessionModel::observations() const {
  if (campaign_ == nullptr) return std::nullopt;
  std::optional<ObservationSet> set = campaign_->observations;
  if (!set) {
    if (const auto stored = evaluation()) set = stored->observations;
  }
  if (!set) return set;
  // 30,000 names are not made for nothing.
  for (std::size_t i = 0; !excluded_.empty() && i < set->rows.size(); ++i) {
    Observation& o = set->rows[i];
    const std::string item = o.state + "/" + o.point + "/" + std::string(toString(o.component));
    if (excluded_.contains(QString::fromStdString(item))) o.use = ObservationUse::Exclude;
  }
  if (!campaign_->observations) applyClockOffsets(*set, clockOffsets());  // its own were moved when it was read
  leaveOutCompensated(*set, campaign_->log);
  return set;
}

void SessionModel::setMachine(const nlohmann::json& machine_json) {
  if (session_ == nullptr || campaign_ == nullptr) return;
  if (!machine_json.empty()) {
    // Refuse what cannot be read before anything is stored.
    (void)MachineDescription::parse(JsonNode::parse(machine_json.dump(), "machine as edited"), "machine as edited");
  }
  session_->setSetting(Session::machineKey(campaign_id_),
                       machine_json.is_null() ? nlohmann::json::object() : machine_json);
  load(campaign_id_);
  Q_EMIT campaignChanged();
  Q_EMIT inputsChanged();
}

std::string SessionModel::inputsKey() const {
  if (session_ == nullptr || campaign_ == nullptr) return {};
  return std::to_string(opened_) + "/" + std::to_string(campaign_id_) + session_->inputs(campaign_id_).dump();
}

TaskGraph SessionModel::tasks() const {
  return {*session_, campaign_id_, campaign_, [this](const std::string& kind) { return latest(kind); }, ledger_};
}

PendingResult SessionModel::begin(const std::string& kind, const nlohmann::json& options) const {
  if (session_ == nullptr || campaign_ == nullptr) return {};
  return {opened_, tasks().origin(kind, options)};
}

void SessionModel::workStarted(const PendingResult& pending) {
  if (pending.session != opened_ || pending.origin.kind.empty()) return;
  ledger_.started(pending.origin);
  Q_EMIT workChanged();
}

void SessionModel::workEnded(const PendingResult& pending) {
  if (pending.session != opened_) return;
  ledger_.ended(pending.origin);
  Q_EMIT workChanged();
}

void SessionModel::workFailed(const PendingResult& pending, const QString& sentence) {
  if (pending.session != opened_ || pending.origin.kind.empty()) return;
  ledger_.failed(pending.origin, sentence.toStdString());
  Q_EMIT workChanged();
}

FileCheck SessionModel::takeFiles(std::int64_t campaign, const FileFingerprints& found) {
  if (session_ == nullptr) return {};
  FileCheck check = session_->takeFiles(campaign, found);
  if (!check.same() && campaign == campaign_id_) Q_EMIT inputsChanged();
  return check;
}

bool SessionModel::atHand(const PendingResult& pending) const {
  return session_ != nullptr && campaign_ != nullptr && pending.session == opened_ &&
         pending.origin.campaign == campaign_id_;
}

bool SessionModel::finish(const PendingResult& pending, const nlohmann::json& payload) {
  if (session_ == nullptr || pending.session != opened_) return false;
  auto kept = session_->keepResult(pending.origin, payload);
  if (!kept || !atHand(pending)) return false;
  latest_[pending.origin.kind] = std::move(kept);
  Q_EMIT resultChanged(QString::fromStdString(pending.origin.kind));
  return true;
}

void SessionModel::storeResult(const std::string& kind, const nlohmann::json& options, const nlohmann::json& payload) {
  finish(begin(kind, options), payload);
}

const StoredResult* SessionModel::latest(const std::string& kind) const {
  if (session_ == nullptr || campaign_ == nullptr) return nullptr;
  auto found = latest_.find(kind);
  if (found == latest_.end()) found = latest_.emplace(kind, session_->latestResult(campaign_id_, kind)).first;
  return found->second ? &*found->second : nullptr;
}

std::optional<StoredResult> SessionModel::result(const std::string& kind) const {
  const StoredResult* found = latest(kind);
  return found != nullptr ? std::optional<StoredResult>(*found) : std::nullopt;
}

ResultState SessionModel::state(const std::string& kind) const {
  ResultState state;
  if (const StoredResult* found = latest(kind)) {
    const TaskStatus status = tasks().status(kind);
    state.there = true;
    state.current = status.current;
    QStringList changed;
    for (const std::string& what : status.changed) changed << QString::fromStdString(what);
    state.changed = changed.join(QStringLiteral(", "));
    state.created_utc = found->provenance.created_utc;
    state.program_version = found->provenance.program_version;
  }
  return state;
}

void SessionModel::capturesChanged(bool first) {
  ++capture_generation_;
  // The first capture of an instrument changes which pages there are.
  if (first) Q_EMIT campaignChanged();
  Q_EMIT inputsChanged();
}

void SessionModel::recordArrival(const ExaminedFile& examined) {
  if (session_ == nullptr || campaign_ == nullptr) return;
  const bool first = !examined.row.empty() && !campaign_->captureList(examined.list);
  spindrift::recordArrival(*session_, campaign_id_, examined);
  if (!examined.row.empty()) capturesChanged(first);
}

void SessionModel::addCaptureRows(const std::string& list, const std::string& header,
                                  const std::vector<std::string>& rows) {
  if (session_ == nullptr || campaign_ == nullptr || rows.empty()) return;
  const bool first = !campaign_->captureList(list);
  session_->addCaptureRows(campaign_id_, list, header, rows);
  capturesChanged(first);
}

void SessionModel::setExcluded(const QString& item, const QString& reason) {
  if (session_ == nullptr || campaign_ == nullptr) return;
  try {
    if (reason.isEmpty()) {
      session_->restore(campaign_id_, item.toStdString());
      excluded_.erase(item);
    } else {
      session_->exclude(campaign_id_, item.toStdString(), reason.toStdString());
      excluded_[item] = reason;
    }
  } catch (const InputError& e) {
    Q_EMIT storingFailed(QString::fromUtf8(e.what()));
    return;
  }
  Q_EMIT inputsChanged();
}

std::vector<Note> SessionModel::notes() const {
  return session_ != nullptr ? session_->notes(campaign_id_) : std::vector<Note>();
}

bool SessionModel::addNote(const QString& about, const QString& text, const QString& item) {
  if (session_ == nullptr || campaign_ == nullptr || text.isEmpty()) return false;
  try {
    session_->addNote(campaign_id_, about.toStdString(), text.toStdString(), item.toStdString());
    return true;
  } catch (const InputError& e) {
    Q_EMIT storingFailed(QString::fromUtf8(e.what()));
    return false;
  }
}

void SessionModel::removeNote(std::int64_t note) {
  if (session_ == nullptr) return;
  try {
    session_->removeNote(note);
  } catch (const InputError& e) {
    Q_EMIT storingFailed(QString::fromUtf8(e.what()));
  }
}

void SessionModel::setSetting(const std::string& key, const nlohmann::json& value) {
  if (session_ == nullptr) return;
  try {
    session_->setSetting(key, value);
  } catch (const InputError& e) {
    Q_EMIT storingFailed(QString::fromUtf8(e.what()));
  }
}

std::string SessionModel::warmStatementKey() const {
  return campaignKey(option_keys::warm_statement);
}

std::optional<nlohmann::json> SessionModel::warmStatement() const {
  nlohmann::json given = setting(warmStatementKey(), nlohmann::json());
  if (given.is_object() && given.contains("by")) return given;
  // Sessions of earlier versions keep it as a result; an empty object takes that back.
  const StoredResult* result = given.is_null() ? latest("warm-up") : nullptr;
  return result == nullptr ? std::nullopt : std::optional(result->payload);
}

nlohmann::json SessionModel::setting(const std::string& key, const nlohmann::json& otherwise) const {
  if (session_ == nullptr) return otherwise;
  return session_->setting(key).value_or(otherwise);
}

std::string SessionModel::campaignKey(const std::string& key) const {
  return spindrift::campaignKey(key, campaign_id_);
}

nlohmann::json SessionModel::campaignSetting(const std::string& key, const nlohmann::json& otherwise) const {
  return session_ == nullptr ? otherwise : spindrift::campaignSetting(*session_, campaign_id_, key, otherwise);
}

nlohmann::json SessionModel::draft(const std::string& name, const nlohmann::json& base) const {
  const nlohmann::json kept = setting(campaignKey("draft/" + name), nullptr);
  if (!kept.is_object() || kept.value("base", nlohmann::json()) != base) return nullptr;
  return kept.value("typed", nlohmann::json());
}

void SessionModel::keepDraft(const std::string& name, const nlohmann::json& base, const nlohmann::json& typed) {
  setSetting(campaignKey("draft/" + name), {{"base", base}, {"typed", typed}});
}

void SessionModel::dropDraft(const std::string& name) {
  if (!setting(campaignKey("draft/" + name), nullptr).is_null()) setSetting(campaignKey("draft/" + name), nullptr);
}

std::filesystem::path sessionsFolder() {
  const QString asked = qEnvironmentVariable("SPINDRIFT_SESSIONS");
  if (!asked.isEmpty()) return asked.toStdString();
  QString place = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  if (place.isEmpty()) place = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  return QDir(place).filePath(QStringLiteral("Spindrift")).toStdString();
}

std::filesystem::path newSessionFolder(const QString& name) {
  QString clean;
  for (const QChar c : name) clean += c.isLetterOrNumber() || c == QLatin1Char('-') ? c : QLatin1Char('_');
  const QString stamp = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd_HH-mm-ss"));
  const std::filesystem::path base = sessionsFolder() / (clean + QLatin1Char('_') + stamp).toStdString();
  std::filesystem::path folder = base;
  for (int i = 2; std::filesystem::exists(folder); ++i) folder = base.string() + "_" + std::to_string(i);
  return folder;
}

}  // namespace spindrift::gui
