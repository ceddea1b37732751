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

void readReview(const TaskGraph& tasks, const TaskInputs& inputs, ReviewSource& source) {
  source.campaign = withoutExcluded(*inputs.campaign, inputs.excluded);
  source.observations = inputs.observations;
  source.changed = changesOf(tasks);
  if (const StoredResult* story = tasks.latest("discrepancy"))
    source.discrepancy = std::make_shared<const nlohmann::json>(story->payload);
}

}  // namespace

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
      readReview(session_.tasks(), session_.taskInputs(), *source);
    } else {
      // As it would be if it were at hand.
      const CampaignState state = CampaignState::read(*session_.session(), id);
      const TaskLedger nothing_runs;
      const TaskGraph tasks = state.tasks(*session_.session(), nothing_runs);
      readReview(tasks, TaskInputs::of(tasks, state), *source);
    }
    source->id = id;
    source->fit = chosen<NineParameterChoice>(*session_.session(), id).options();
    source->name = shownName(source->campaign->name);
    if (source->observations) {
      source->states = source->observations->states();
      source->angles_deg = tableAngles(*source->observations);
    }
    if (source->campaign->captureList("scans.csv")) source->scans = readScanList(*source->campaign);
  } catch (const InputError&) {
    source.reset();
  }
  read_[id] = source;
  return source;
}

}  // namespace spindrift::gui
