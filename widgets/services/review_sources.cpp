// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/review_sources.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/tasks/task_options.h"
#include "core/tasks/task_work.h"
#include "widgets/common/demo_names.h"

namespace spindrift::gui {
namespace {

/// What has changed since a result that is shown was made.
std::vector<std::string> changesOf(const TaskGraph& tasks) {
  std::vector<std::string> changed;
  for (const char* kind : {"evaluate", "discrepancy"}) {
    const StoredResult* result = tasks.latest(kind);
    if (result == nullptr) continue;
    for (std::string& what : tasks.changes(*result))
      if (std::find(changed.begin(), changed.end(), what) == changed.end()) changed.push_back(std::move(what));
  }
  return changed;
}

void readReview(const TaskGraph& tasks, const Campaign& campaign, const ExcludedItems& excluded, ReviewSource& source) {
  source.campaign = withoutExcluded(campaign, excluded);
  source.changed = changesOf(tasks);
  if (const StoredResult* story = tasks.latest("discrepancy"))
    source.discrepancy = std::make_shared<const nlohmann::json>(story->payload);
}

}  // namespace

ReviewChoices ReviewChoices::of(const ObservationSet& observations) {
  ReviewChoices choices{observations.states(), tableAngles(observations), {}};
  for (const Observation& o : observations.rows) choices.extent_mm.extend(o.position_mm.head<2>());
  return choices;
}

ReadForReview ReadForReview::read(const CampaignSource& source, JobContext& job) {
  ReadForReview read{CampaignState::read(source, job), {}, {}};
  if (read.state.campaign == nullptr) return read;
  read.observations = {read.state.campaign, read.state.campaign->observations ? nullptr : read.state.readEvaluation(),
                       read.state.excluded, source.edits.clocks};
  if (read.observations) read.choices = ReviewChoices::of(*read.observations);
  return read;
}

const ReviewPrediction& ReviewSource::simulation() const {
  std::call_once(simulated_, [this] { simulation_ = reviewSimulation(*campaign, *observations); });
  return simulation_;
}

const ReviewPrediction& ReviewSource::completed() const {
  std::call_once(finished_, [this] {
    if (discrepancy == nullptr) {
      completed_.why = "The search for what the simulation lacks has not been run.";
      return;
    }
    try {
      completed_ = reviewCompleted(DiscrepancyStory::parse(*discrepancy), *observations);
    } catch (const InputError& error) {
      completed_.why = error.what();
    }
  });
  return completed_;
}

void ReviewSources::refresh() {
  read_.clear();
  if (session_number_ == session_.sessionNumber()) return;
  session_number_ = session_.sessionNumber();
  others_.clear();
}

ReviewSources::Version ReviewSources::versionOf(std::int64_t id) const {
  const Session& session = *session_.session();
  Version now{session.campaign(id).fingerprint, CampaignEdits::of(session, id), excludedItems(session, id), {}};
  for (const std::string& kind : session.resultKinds(id))
    now.results.push_back(session.resultHeads(id, kind).back().id);
  return now;
}

std::shared_ptr<const ReadForReview> ReviewSources::readOf(std::int64_t id) {
  Version now = versionOf(id);
  if (const auto known = others_.find(id); known != others_.end() && known->second.version == now)
    return known->second.read;
  others_[id] = {std::move(now), true, nullptr};
  read_in_background_(id, shownName(session_.session()->campaign(id).name),
                      CampaignSource::of(*session_.session(), id));
  return nullptr;
}

bool ReviewSources::reading(std::int64_t id) const {
  if (id == session_.campaignId()) return choices_.busy();
  const auto known = others_.find(id);
  return known != others_.end() && known->second.reading;
}

void ReviewSources::take(std::int64_t id, std::shared_ptr<const ReadForReview> read) {
  read_.erase(id);
  const auto known = others_.find(id);
  if (known == others_.end()) return;
  known->second.reading = false;
  known->second.read = std::move(read);
}

std::vector<std::pair<std::int64_t, QString>> ReviewSources::campaigns() const {
  std::vector<std::pair<std::int64_t, QString>> out;
  for (const CampaignRecord& record : session_.campaigns()) out.emplace_back(record.id, shownName(record.name));
  return out;
}

std::shared_ptr<const ReviewSource> ReviewSources::source(std::int64_t id) {
  const auto found = read_.find(id);
  if (found != read_.end()) return found->second;
  auto source = std::make_shared<ReviewSource>();
  try {
    if (id == session_.campaignId()) {
      source->observations = session_.observations();
      if (source->observations) {
        const auto choices = choices_.ask(source->observations, {}, &ReviewChoices::of);
        if (choices == nullptr) return nullptr;
        source->choices = *choices;
      }
      readReview(session_.tasks(), *session_.campaign(), session_.excludedItems(), *source);
    } else {
      const std::shared_ptr<const ReadForReview> read = readOf(id);
      if (read == nullptr) return nullptr;
      source->observations = read->observations;
      source->choices = read->choices;
      const TaskLedger nothing_runs;
      readReview(read->state.tasks(*session_.session(), nothing_runs), *read->state.campaign, read->state.excluded,
                 *source);
    }
    source->id = id;
    source->fit = chosen<NineParameterChoice>(*session_.session(), id).options();
    source->name = shownName(source->campaign->name);
    if (source->campaign->captureList("scans.csv")) source->scans = readScanList(*source->campaign);
  } catch (const InputError&) {
    source.reset();
  }
  read_[id] = source;
  return source;
}

}  // namespace spindrift::gui
