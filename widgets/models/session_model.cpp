// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/models/session_model.h"

#include <QDateTime>
#include <algorithm>

#include "core/base/error.h"
#include "core/tasks/steps.h"
#include "core/tasks/task_options.h"
#include "core/tasks/task_work.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/preferences.h"

namespace spindrift::gui {
namespace {

/// What takes less may come with every capture.
constexpr qint64 least_to_wait_for_ms = 100;

/// The observations to fit of a campaign as it is at hand.
ObservedCampaign observedFrom(std::shared_ptr<const Campaign> campaign,
                              std::shared_ptr<const StoredEvaluation> evaluation, const ExcludedItems& excluded,
                              const ClockOffsets& clocks) {
  ObservationsToFit set(campaign, evaluation, excluded, clocks);
  return {std::move(campaign), std::move(evaluation), excluded, clocks, std::move(set)};
}

}  // namespace

ReadCampaign CampaignReading::read(JobContext& job) const {
  ReadCampaign read{session, CampaignState::read(source, job), source.edits, {}};
  if (read.state.campaign == nullptr) return read;
  const auto evaluation = read.state.campaign->observations ? nullptr : read.state.readEvaluation();
  read.observed = observedFrom(read.state.campaign, evaluation, read.state.excluded, source.edits.clocks);
  (void)read.observed.set.get();  // so that nobody waits for it on the GUI thread
  return read;
}

SessionModel::SessionModel(QObject* parent) : QObject(parent) {
  since_told_.start();
  tell_later_.setSingleShot(true);
  connect(&tell_later_, &QTimer::timeout, this, &SessionModel::tellOfCaptures);
}
SessionModel::~SessionModel() = default;

LoadedSession loadSession(std::unique_ptr<Session> session, std::int64_t campaign, JobContext& job) {
  ReadCampaign read = CampaignReading{0, CampaignSource::of(*session, campaign)}.read(job);
  return {std::move(session), std::move(read)};
}

LoadedSession loadSession(std::unique_ptr<Session> session, std::int64_t campaign) {
  JobContext unseen;
  return loadSession(std::move(session), campaign, unseen);
}

void SessionModel::close() {
  Q_EMIT campaignLeaving();
  session_.reset();
  ++opened_;
  ledger_ = {};
  forget();
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
  Q_EMIT campaignLeaving();
  session_ = std::move(loaded.session);
  takeOver(std::move(loaded.campaign));
  ++opened_;
  ledger_ = {};
  ++visit_;
  if (state_.id != 0) setSetting("campaign", state_.id);
  Q_EMIT sessionChanged();
  Q_EMIT campaignChanged();
}

void SessionModel::takeOver(ReadCampaign read) {
  state_ = std::move(read.state);
  observed_ = std::move(read.observed);
  if (state_.id != 0) {
    // As they are now, if they were changed while it was read.
    if (const CampaignEdits now = CampaignEdits::of(*session_, state_.id); now != read.edits) state_.apply(now);
    state_.excluded = spindrift::excludedItems(*session_, state_.id);
  }
  showExcluded();
}

void SessionModel::forget() {
  state_ = {};
  observed_ = {};
  showExcluded();
  ++visit_;
}

void SessionModel::showExcluded() {
  shown_excluded_.clear();
  for (const auto& [item, reason] : state_.excluded)
    shown_excluded_[QString::fromStdString(item)] = QString::fromStdString(reason);
}

CampaignReading SessionModel::reading(std::int64_t id) const {
  return {opened_, session_ == nullptr ? CampaignSource() : CampaignSource::of(*session_, id)};
}

void SessionModel::take(ReadCampaign read) {
  const std::vector<CampaignRecord> all = campaigns();
  const bool there = read.session == opened_ && std::any_of(all.begin(), all.end(), [&](const CampaignRecord& record) {
                       return record.id == read.state.id;
                     });
  if (!there) return;
  const bool another = read.state.id != state_.id;
  if (another) Q_EMIT campaignLeaving();
  takeOver(std::move(read));
  if (another) {
    ++visit_;
    setSetting("campaign", state_.id);
  }
  Q_EMIT campaignChanged();
  if (!another) Q_EMIT inputsChanged();
}

void SessionModel::applyEdits() {
  state_.apply(CampaignEdits::of(*session_, state_.id));
  Q_EMIT campaignChanged();
  Q_EMIT inputsChanged();
}

std::vector<CampaignRecord> SessionModel::campaigns() const {
  return session_ ? session_->campaigns() : std::vector<CampaignRecord>();
}

bool SessionModel::has(Instrument instrument) const {
  if (state_.campaign == nullptr) return false;
  const CampaignFacts facts = CampaignFacts::of(*state_.campaign);
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
  return state_.campaign != nullptr && CampaignFacts::of(*state_.campaign).log_only;
}

bool SessionModel::modelOverTime() const {
  return state_.campaign != nullptr && tasks().overTime();
}

ClockOffsets SessionModel::clockOffsets() const {
  return session_ ? clockOffsetsOf(*session_, campaignId()) : ClockOffsets();
}

void SessionModel::setClockOffsets(const ClockOffsets& offsets) {
  if (session_ == nullptr || state_.campaign == nullptr) return;
  session_->setSetting(Session::clocksKey(state_.id), toJson(offsets));
  applyEdits();
}

CampaignSnapshot SessionModel::snapshot() const {
  CampaignSnapshot copy;
  if (campaign() == nullptr) return copy;
  for (const auto& [item, reason] : state_.excluded) copy.excluded.insert(item);
  copy.campaign = withoutExcluded(*campaign(), state_.excluded);
  return copy;
}

std::shared_ptr<const StoredEvaluation> SessionModel::evaluation() const {
  return session_ == nullptr || state_.campaign == nullptr ? nullptr : state_.evaluation(tasks());
}

ObservationsToFit SessionModel::observations() const {
  if (campaign() == nullptr) return {};
  const auto stored = campaign()->observations ? nullptr : evaluation();
  const ClockOffsets clocks = clockOffsets();
  const ObservedCampaign& o = observed_;
  if (o.campaign != campaign() || o.evaluation != stored || o.excluded != state_.excluded || o.clocks != clocks)
    observed_ = observedFrom(campaign(), stored, state_.excluded, clocks);
  return o.set;
}

void SessionModel::setMachine(const nlohmann::json& machine_json) {
  if (session_ == nullptr || state_.campaign == nullptr) return;
  if (!machine_json.empty()) {
    // Refuse what cannot be read before anything is stored.
    (void)MachineDescription::parse(JsonNode::parse(machine_json.dump(), "machine as edited"), "machine as edited");
  }
  session_->setSetting(Session::machineKey(state_.id),
                       machine_json.is_null() ? nlohmann::json::object() : machine_json);
  applyEdits();
}

std::string SessionModel::inputsKey() const {
  if (session_ == nullptr || state_.campaign == nullptr) return {};
  return std::to_string(opened_) + "/" + std::to_string(state_.id) + session_->inputs(state_.id).dump();
}

TaskGraph SessionModel::tasks() const {
  return state_.tasks(*session_, ledger_);
}

TaskInputs SessionModel::taskInputs() const {
  TaskInputs inputs;
  inputs.campaign = state_.campaign;
  inputs.excluded = state_.excluded;
  inputs.observations = observations();
  return inputs;
}

PendingResult SessionModel::begin(const std::string& kind, const nlohmann::json& options) const {
  if (session_ == nullptr || state_.campaign == nullptr) return {};
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
  if (!check.same() && campaign == state_.id) Q_EMIT inputsChanged();
  return check;
}

bool SessionModel::atHand(const PendingResult& pending) const {
  return session_ != nullptr && state_.campaign != nullptr && pending.session == opened_ &&
         pending.origin.campaign == state_.id;
}

bool SessionModel::has(const PendingResult& pending) const {
  if (session_ == nullptr || pending.session != opened_) return false;
  const std::vector<CampaignRecord> all = session_->campaigns();
  return std::any_of(all.begin(), all.end(),
                     [&](const CampaignRecord& record) { return record.id == pending.origin.campaign; });
}

bool SessionModel::finish(const PendingResult& pending, const nlohmann::json& payload) {
  if (session_ == nullptr || pending.session != opened_) return false;
  auto kept = session_->keepResult(pending.origin, payload);
  if (!kept || !atHand(pending)) return false;
  state_.keep(std::move(kept));
  Q_EMIT resultChanged(QString::fromStdString(pending.origin.kind));
  return true;
}

void SessionModel::storeResult(const std::string& kind, const nlohmann::json& options, const nlohmann::json& payload) {
  finish(begin(kind, options), payload);
}

const StoredResult* SessionModel::latest(const std::string& kind) const {
  if (session_ == nullptr || state_.campaign == nullptr) return nullptr;
  return tasks().latest(kind);
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
    for (const std::string& what : status.changed) changed << coreSentence(what);
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
  // Pages count and read the lists again, which takes the longer the more is in them: it gets a tenth of the time.
  const qint64 wait_ms = 10 * telling_took_ms_ - since_told_.elapsed();
  if (first || telling_took_ms_ < least_to_wait_for_ms || wait_ms <= 0) {
    tellOfCaptures();
  } else if (!tell_later_.isActive()) {
    tell_later_.start(static_cast<int>(wait_ms));
  }
}

void SessionModel::tellOfCaptures() {
  tell_later_.stop();
  since_told_.start();
  Q_EMIT inputsChanged();
  telling_took_ms_ = since_told_.restart();
}

void SessionModel::recordArrival(const ExaminedFile& examined) {
  if (session_ == nullptr || state_.campaign == nullptr) return;
  const bool first = !examined.row.empty() && !state_.campaign->captureList(examined.list);
  spindrift::recordArrival(*session_, state_.id, examined);
  if (!examined.row.empty()) capturesChanged(first);
}

void SessionModel::addCaptureRows(const std::string& list, const std::string& header,
                                  const std::vector<std::string>& rows) {
  if (session_ == nullptr || state_.campaign == nullptr || rows.empty()) return;
  const bool first = !state_.campaign->captureList(list);
  session_->addCaptureRows(state_.id, list, header, rows);
  capturesChanged(first);
}

void SessionModel::setExcluded(const std::vector<std::pair<QString, QString>>& items) {
  if (session_ == nullptr || state_.campaign == nullptr) return;
  std::vector<Exclusion> all;
  for (const auto& [item, reason] : items) all.push_back({item.toStdString(), reason.toStdString(), {}});
  try {
    session_->exclude(state_.id, all);
  } catch (const InputError& e) {
    Q_EMIT storingFailed(coreSentence(e.what()));
    return;
  }
  for (const Exclusion& e : all) {
    if (e.reason.empty()) {
      state_.excluded.erase(e.item);
    } else {
      state_.excluded[e.item] = e.reason;
    }
  }
  showExcluded();
  Q_EMIT inputsChanged();
}

std::vector<Note> SessionModel::notes() const {
  return session_ != nullptr ? session_->notes(state_.id) : std::vector<Note>();
}

std::int64_t SessionModel::addNote(const Note& note) {
  if (session_ == nullptr || state_.campaign == nullptr || note.text.empty()) return 0;
  std::int64_t id = 0;
  try {
    id = session_->addNote(state_.id, note);
  } catch (const InputError& e) {
    Q_EMIT storingFailed(coreSentence(e.what()));
    return 0;
  }
  Q_EMIT inputsChanged();
  return id;
}

void SessionModel::removeNote(std::int64_t note) {
  if (session_ == nullptr) return;
  try {
    session_->removeNote(note);
  } catch (const InputError& e) {
    Q_EMIT storingFailed(coreSentence(e.what()));
    return;
  }
  Q_EMIT inputsChanged();
}

void SessionModel::setSetting(const std::string& key, const nlohmann::json& value) {
  if (session_ == nullptr) return;
  try {
    session_->setSetting(key, value);
  } catch (const InputError& e) {
    Q_EMIT storingFailed(coreSentence(e.what()));
  }
}

void SessionModel::setOption(const std::string& key, const nlohmann::json& value) {
  setSetting(key, value);
  Q_EMIT inputsChanged();
}

void SessionModel::noteReviewed() {
  if (session_ == nullptr || state_.campaign == nullptr) return;
  const std::string key = campaignKey(option_keys::reviewed);
  nlohmann::json now = reviewedNow(tasks());
  if (session_->setting(key) == now) return;
  setOption(key, now);
}

std::string SessionModel::warmStatementKey() const {
  return campaignKey(option_keys::warm_statement);
}

std::optional<nlohmann::json> SessionModel::warmStatement() const {
  return state_.campaign == nullptr ? std::nullopt : spindrift::warmStatement(tasks());
}

nlohmann::json SessionModel::setting(const std::string& key, const nlohmann::json& otherwise) const {
  if (session_ == nullptr) return otherwise;
  return session_->setting(key).value_or(otherwise);
}

std::string SessionModel::campaignKey(const std::string& key) const {
  return spindrift::campaignKey(key, state_.id);
}

nlohmann::json SessionModel::campaignSetting(const std::string& key, const nlohmann::json& otherwise) const {
  return session_ == nullptr ? otherwise : spindrift::campaignSetting(*session_, state_.id, key, otherwise);
}

EffectOptions SessionModel::effects() const {
  return session_ == nullptr ? EffectOptions() : chosen<EffectOptions>(*session_, state_.id);
}

std::string SessionModel::draftKey(const std::string& name) const {
  return campaignKey("draft/" + name);
}

nlohmann::json SessionModel::draft(const std::string& name) const {
  nlohmann::json kept = setting(draftKey(name), nullptr);
  return kept.is_object() && kept.contains("base") && kept.contains("typed") ? kept : nlohmann::json();
}

std::filesystem::path sessionsFolder() {
  const QString asked = qEnvironmentVariable("SPINDRIFT_SESSIONS");
  if (!asked.isEmpty()) return asked.toStdString();
  const QString preferred = preferences().sessions_folder;
  return (preferred.isEmpty() ? usualSessionsFolder() : preferred).toStdString();
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
