// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/review_sources.h"

#include "core/base/error.h"

namespace spindrift::gui {
namespace {

std::shared_ptr<ReviewSource> readOther(SessionModel& session, std::int64_t id) {
  const CampaignRecord record = session.session()->campaign(id);
  auto source = std::make_shared<ReviewSource>();
  source->campaign = std::make_shared<const Campaign>(Campaign::read(record.folder));
  std::optional<ObservationSet> observations = source->campaign->observations;
  if (!observations) {
    if (const auto stored = session.session()->latestResult(id, "evaluate"))
      observations = evaluationFrom(*stored).observations;
  }
  if (!observations) return source;
  std::set<std::string> excluded;
  for (const Exclusion& e : session.session()->exclusions(id)) excluded.insert(e.item);
  for (Observation& o : observations->rows)
    if (excluded.contains(o.state + "/" + o.point + "/" + std::string(toString(o.component))))
      o.use = ObservationUse::Exclude;
  source->observations = std::make_shared<const ObservationSet>(std::move(*observations));
  return source;
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
  for (const CampaignRecord& record : session_.campaigns())
    out.emplace_back(record.id, QString::fromStdString(record.name));
  return out;
}

std::shared_ptr<const ReviewSource> ReviewSources::source(std::int64_t id) {
  const auto found = read_.find(id);
  if (found != read_.end()) return found->second;
  std::shared_ptr<ReviewSource> source;
  try {
    if (id == session_.campaignId()) {
      source = std::make_shared<ReviewSource>();
      source->campaign = session_.snapshot().campaign;
      source->observations = session_.observations();
    } else {
      source = readOther(session_, id);
    }
    if (id == session_.campaignId()) {
      if (const StoredResult* story = session_.latest("discrepancy"))
        source->discrepancy = std::make_shared<const nlohmann::json>(story->payload);
    } else if (auto story = session_.session()->latestResult(id, "discrepancy")) {
      source->discrepancy = std::make_shared<const nlohmann::json>(std::move(story->payload));
    }
    source->id = id;
    source->name = QString::fromStdString(source->campaign->name);
    if (source->observations) source->states = source->observations->states();
    if (source->campaign->captureList("scans.csv")) source->scans = readScanList(*source->campaign);
  } catch (const InputError&) {
    source.reset();
  }
  read_[id] = source;
  return source;
}

}  // namespace spindrift::gui
