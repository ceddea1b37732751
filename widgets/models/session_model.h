// SPDX-License-Identifier: GPL-3.0-or-later
// What the pages see of the session on disk: the campaign at hand, its results with their freshness, what was excluded.
// Lives on the GUI thread; jobs get copies (`snapshot()`).
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/campaign.h"
#include "core/machine/instrument_evaluation.h"
#include "core/session/session.h"
#include "core/tasks/campaign_state.h"
#include "core/tasks/task_graph.h"
#include "core/tasks/task_options.h"
#include "core/workflows/clock_offsets.h"
#include "core/workflows/evaluate_campaign.h"
#include "core/workflows/incoming.h"

namespace spindrift {
struct TaskInputs;
}

namespace spindrift::gui {

/// The instruments a campaign may hold captures of.
enum class Instrument { Microscope, TouchProbe, Profiler };

/// Everything a job needs, copied.
struct CampaignSnapshot {
  std::shared_ptr<const Campaign> campaign;
  std::set<std::string> excluded;  ///< items as in Exclusion
};

/// A result that is being worked out: what it is made from, and the session that was open when the work started.
struct PendingResult {
  std::int64_t session = 0;  ///< SessionModel::sessionNumber
  ResultOrigin origin;
};

/// A result with what is known about its freshness.
struct ResultState {
  bool there = false;
  bool current = false;
  QString changed;  ///< what is other than it was when this was made: "2 exclusions more, the options"
  std::string created_utc;
  std::string program_version;
};

/// The observations to fit, and what they are made of.
struct ObservedCampaign {
  std::shared_ptr<const Campaign> campaign;
  std::shared_ptr<const StoredEvaluation> evaluation;
  ExcludedItems excluded;
  ClockOffsets clocks;
  ObservationsToFit set;
};

/// A campaign with everything its pages ask for at once, read from the disk: large ones take a while, so that a job
/// does it and the GUI thread only takes it over.
struct ReadCampaign {
  std::int64_t session = 0;  ///< SessionModel::sessionNumber of when it was asked for
  CampaignState state;
  CampaignEdits edits;  ///< that it was read with
  ObservedCampaign observed;
};

/// What a campaign of the session that is open is read from: SessionModel::source.
struct CampaignReading {
  std::int64_t session = 0;
  CampaignSource source;

  /// Any thread. Throws InputError, Cancelled.
  [[nodiscard]] ReadCampaign read(JobContext& job) const;
};

struct LoadedSession {
  std::unique_ptr<Session> session;
  ReadCampaign campaign;
};

/// Any thread. `campaign` 0: the one that was at hand last, else the newest. Throws InputError.
[[nodiscard]] LoadedSession loadSession(std::unique_ptr<Session> session, std::int64_t campaign = 0);
[[nodiscard]] LoadedSession loadSession(std::unique_ptr<Session> session, std::int64_t campaign, JobContext& job);

class SessionModel : public QObject {
  Q_OBJECT
 public:
  explicit SessionModel(QObject* parent = nullptr);
  ~SessionModel() override;

  // The session. All of these throw InputError and leave what was open as it is.
  void close();
  [[nodiscard]] bool isOpen() const { return session_ != nullptr; }
  [[nodiscard]] Session* session() { return session_.get(); }
  [[nodiscard]] const Session* session() const { return session_.get(); }
  [[nodiscard]] std::filesystem::path folder() const;
  [[nodiscard]] QString name() const;
  /// Another number for every session that is opened or closed.
  [[nodiscard]] std::int64_t sessionNumber() const { return opened_; }

  // The campaign at hand.
  /// Takes over a session that a job has made or added a campaign to.
  void adopt(LoadedSession loaded);
  void adopt(std::unique_ptr<Session> session, std::int64_t campaign);
  /// To read a campaign of the session, that at hand included, by a job; `take` is called when it is read.
  [[nodiscard]] CampaignReading reading(std::int64_t id) const;
  /// Makes it the campaign at hand, with exclusions, machine and clocks as they are now. Nothing happens if its session
  /// or the campaign is gone.
  void take(ReadCampaign read);
  [[nodiscard]] std::vector<CampaignRecord> campaigns() const;
  [[nodiscard]] std::int64_t campaignId() const { return state_.id; }
  /// Another number whenever a session is opened or a campaign chosen, never the same twice. Ids of campaigns and
  /// results begin again in every session, so that nothing may be recognised by them across sessions.
  [[nodiscard]] std::int64_t visit() const { return visit_; }
  [[nodiscard]] std::shared_ptr<const Campaign> campaign() const { return state_.campaign; }
  [[nodiscard]] bool has(Instrument instrument) const;
  /// True for a campaign that is a log with a measured output over time, without captures or observations.
  [[nodiscard]] bool isLogOnly() const;
  /// Whether the step Model shows a model over time in place of that of the instrument (always for a log alone).
  [[nodiscard]] bool modelOverTime() const;
  /// Offsets between the clocks of logger and instruments; log and observations are given out on the campaign's clock,
  /// and every result depends on them.
  [[nodiscard]] ClockOffsets clockOffsets() const;
  void setClockOffsets(const ClockOffsets& offsets);
  [[nodiscard]] CampaignSnapshot snapshot() const;
  /// The machine as edited by the user, in place of machine.json (which is never altered); empty JSON: back to the
  /// file.
  void setMachine(const nlohmann::json& machine_json);
  [[nodiscard]] bool machineEdited() const { return state_.machine_edited; }

  // Results. `kind` names what was computed ("evaluate", "fit", "check").
  //
  // begin() when the work starts, finish() when it is done: whatever the user does meanwhile, the result is filed under
  // the campaign it was started for, as made from what it was made from. The options of a task are those that the
  // session keeps for it (core/tasks); `options` adds to them.
  [[nodiscard]] PendingResult begin(const std::string& kind,
                                    const nlohmann::json& options = nlohmann::json::object()) const;
  /// True if the page at hand shows the campaign of this result. A result whose session or campaign is gone is dropped.
  bool finish(const PendingResult& pending, const nlohmann::json& payload);
  /// True while the session that a result was started in is open and holds its campaign.
  [[nodiscard]] bool has(const PendingResult& pending) const;
  /// True while the campaign that a result was started for is at hand.
  [[nodiscard]] bool atHand(const PendingResult& pending) const;
  /// Both at once, for what is ready the moment it is asked for.
  void storeResult(const std::string& kind, const nlohmann::json& options, const nlohmann::json& payload);
  [[nodiscard]] std::optional<StoredResult> result(const std::string& kind) const;
  /// The same without a copy, for large ones; null if there is none. Holds until the next change of results or
  /// campaign.
  [[nodiscard]] const StoredResult* latest(const std::string& kind) const;
  [[nodiscard]] ResultState state(const std::string& kind) const;
  /// All tasks of the campaign at hand, which there must be. For the moment: not to be kept.
  [[nodiscard]] TaskGraph tasks() const;
  /// What tasks of the campaign at hand, which there must be, work on.
  [[nodiscard]] TaskInputs taskInputs() const;
  /// Work that would give the same as this one runs or waits.
  [[nodiscard]] bool runsAlready(const PendingResult& pending) const {
    return pending.session == opened_ && ledger_.running(pending.origin);
  }
  /// Work on a task of the campaign at hand runs or waits.
  [[nodiscard]] bool isRunning(const std::string& task) const { return ledger_.running(state_.id, task); }
  /// Tells the tasks that work on a result has been asked for, and how it ended when nothing is stored; see taskJob().
  void workStarted(const PendingResult& pending);
  void workEnded(const PendingResult& pending);
  void workFailed(const PendingResult& pending, const QString& sentence);
  /// The last evaluation, whether it is current or not; null if there is none.
  [[nodiscard]] std::shared_ptr<const StoredEvaluation> evaluation() const;
  /// Observations to fit: the campaign's own, else those of the last evaluation; what the user excluded is marked so.
  /// Null if there are none. The same for as long as none of that changes; they are marked when they are looked at,
  /// which takes the longer the more there are, so that jobs should.
  [[nodiscard]] ObservationsToFit observations() const;
  /// What every result of the campaign at hand is made from now, as one text to recognise it by.
  [[nodiscard]] std::string inputsKey() const;

  // Captures that arrive. Both throw InputError (disk full, folder gone).
  /// Takes over what was examined: its row into the list, its answer into the journal.
  void recordArrival(const ExaminedFile& examined);
  /// What was found on the disk for a campaign (`fingerprintsOfFiles`, any thread): results made from files that are
  /// not what they were turn outdated. Returns what was other.
  FileCheck takeFiles(std::int64_t campaign, const FileFingerprints& found);
  /// Rows of a list without files (touches).
  void addCaptureRows(const std::string& list, const std::string& header, const std::vector<std::string>& rows);
  /// Counts up whenever a capture was added: lists read before are to be read again.
  [[nodiscard]] int captureGeneration() const { return capture_generation_; }

  // Exclusions; items each with its reason, those without one are taken back in: all at once, or none where they cannot
  // be stored. Undo commands call this.
  void setExcluded(const std::vector<std::pair<QString, QString>>& items);
  [[nodiscard]] const std::map<QString, QString>& excluded() const { return shown_excluded_; }
  /// The same for core.
  [[nodiscard]] const ExcludedItems& excludedItems() const { return state_.excluded; }

  // Notes on the campaign at hand. A note that cannot be stored is told by storingFailed().
  [[nodiscard]] std::vector<Note> notes() const;
  /// Its id, as Session::addNote; 0: it could not be stored.
  std::int64_t addNote(const Note& note);
  void removeNote(std::int64_t note);

  /// The operator's word that the instrument was warm ("settled", "by"), if it was given for the campaign at hand; the
  /// key under which it is kept as an option that can be undone.
  [[nodiscard]] std::optional<nlohmann::json> warmStatement() const;
  [[nodiscard]] std::string warmStatementKey() const;
  /// The comparison of what there is now is being looked at.
  void noteReviewed();

  // Settings that belong to the session.
  void setSetting(const std::string& key, const nlohmann::json& value);
  /// The same of something that results depend on: tells inputsChanged.
  void setOption(const std::string& key, const nlohmann::json& value);
  [[nodiscard]] nlohmann::json setting(const std::string& key, const nlohmann::json& otherwise) const;
  /// The key of what is kept for the campaign at hand alone; and its value. Sessions of earlier versions kept some of
  /// it for all campaigns together: that stands where a campaign has nothing of its own.
  [[nodiscard]] std::string campaignKey(const std::string& key) const;
  [[nodiscard]] nlohmann::json campaignSetting(const std::string& key, const nlohmann::json& otherwise) const;
  /// What the user decided about effects for the campaign at hand.
  [[nodiscard]] EffectOptions effects() const;
  /// What was typed and is not applied yet, for the campaign at hand: on the disk with every change, so that no other
  /// page, campaign or session and no crash loses it; see Draft (widgets/commands). {"base": what was being edited,
  /// "typed": …}; null: nothing.
  [[nodiscard]] nlohmann::json draft(const std::string& name) const;
  [[nodiscard]] std::string draftKey(const std::string& name) const;

 Q_SIGNALS:
  void sessionChanged();
  /// Another session or campaign is about to be at hand: what belongs to this one can still be stored in it.
  void campaignLeaving();
  void campaignChanged();
  void resultChanged(const QString& kind);
  /// Work on a result has begun, or ended without one.
  void workChanged();
  /// Something results depend on changed: exclusions, machine, options. Of captures it is told as often as those who
  /// hear it can follow.
  void inputsChanged();
  /// Something could not be stored (disk full, folder gone): the sentence for the user. What is shown stays as it was.
  void storingFailed(const QString& sentence);

 private:
  void takeOver(ReadCampaign read);
  /// Machine or clocks are stored as they are to be now.
  void applyEdits();
  /// No campaign at hand.
  void forget();
  void showExcluded();
  void capturesChanged(bool first);
  void tellOfCaptures();

  std::unique_ptr<Session> session_;
  TaskLedger ledger_;
  /// Of the campaign at hand; results and the evaluation are read when they are first asked for.
  CampaignState state_;
  mutable ObservedCampaign observed_;
  std::map<QString, QString> shown_excluded_;  ///< state_.excluded, as the window asks for it
  std::int64_t visit_ = 0;
  std::int64_t opened_ = 0;  ///< sessions so far
  int capture_generation_ = 0;
  QTimer tell_later_;  ///< runs while captures are there that the pages have not been told of
  QElapsedTimer since_told_;
  qint64 telling_took_ms_ = 0;
};

/// Folder in which new sessions are made: <documents>/Spindrift, or the application's data folder.
/// The variable SPINDRIFT_SESSIONS of the environment names another one (tour, self-test and tests leave nothing
/// behind).
[[nodiscard]] std::filesystem::path sessionsFolder();
/// A folder in it that does not exist yet, named after the campaign and the time.
[[nodiscard]] std::filesystem::path newSessionFolder(const QString& name);

}  // namespace spindrift::gui
