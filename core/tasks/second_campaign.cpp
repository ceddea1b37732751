// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/second_campaign.h"

#include <algorithm>
#include <optional>
#include <system_error>
#include <vector>

#include "core/base/rationed_answers.h"
#include "core/session/fingerprint.h"
#include "core/workflows/evaluate_campaign.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

bool isSameFolder(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return a == b || fs::equivalent(a, b, error);
}

std::optional<CampaignRecord> recordOf(const Session& session, const fs::path& folder) {
  for (CampaignRecord& record : session.campaigns())
    if (isSameFolder(record.folder, folder)) return std::move(record);
  return {};
}

}  // namespace

SecondCampaign SecondCampaign::of(const TaskGraph& graph, const TaskInputs& inputs, const fs::path& folder) {
  const Session& session = graph.session();
  SecondCampaign second;
  second.folder_ = folder;
  if (isSameFolder(graph.data().folder, folder)) {
    second.campaign_ = inputs.campaign;
    second.excluded_ = inputs.excluded;
    second.clocks_ = clockOffsetsOf(session, graph.campaign());
    if (const StoredResult* result = graph.latest("evaluate"); result != nullptr && graph.holds(*result))
      second.evaluation_ = std::make_shared<const StoredEvaluation>(evaluationFrom(*result));
  } else if (const auto record = recordOf(session, folder)) {
    const CampaignState state = CampaignState::read(session, record->id);
    second.campaign_ = state.campaign;
    second.excluded_ = state.excluded;
    second.clocks_ = clockOffsetsOf(session, state.id);
    const TaskLedger nothing_runs;
    const TaskGraph tasks = state.tasks(session, nothing_runs);
    if (const StoredResult* result = tasks.latest("evaluate"); result != nullptr && tasks.holds(*result))
      second.evaluation_ = state.evaluation(tasks);
  }
  return second;
}

SecondCampaign::Measured SecondCampaign::measured(JobContext& job) const {
  if (campaign_ == nullptr) {
    auto campaign = std::make_shared<const Campaign>(Campaign::read(folder_));
    return {campaign, allObservationsOf(*campaign, {}, {}, job)};
  }
  const auto campaign = withoutExcluded(*campaign_, excluded_);
  if (auto set = observationsAtHand(*campaign, evaluation_.get(), excluded_, clocks_))
    return {campaign, std::move(*set)};
  ObservationSet set = evaluateCampaign(*campaign, {}, job).observations;
  applyChoices(set, excluded_, clocks_);
  return {campaign, std::move(set)};
}

namespace {

/// All files below a folder, by size and time of the last change.
std::string fingerprintOfTree(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    if (!it->is_regular_file(gone)) continue;
    files.push_back(it->path().lexically_relative(folder).generic_string() + "\n" +
                    std::to_string(it->file_size(gone)) + "\n" +
                    std::to_string(it->last_write_time(gone).time_since_epoch().count()));
  }
  std::sort(files.begin(), files.end());
  Fingerprint all;
  for (const std::string& file : files) all.add(file);
  return all.text();
}

}  // namespace

std::string fingerprintOfSecond(const Session& session, std::int64_t own, const fs::path& folder) {
  if (folder.empty()) return {};
  if (const auto record = recordOf(session, folder))
    return record->id == own ? std::string() : Fingerprint().add(session.inputs(record->id).dump()).text();
  static RationedAnswers trees;  // the list of steps asks at every change
  return trees.about(folder, fingerprintOfTree);
}

}  // namespace spindrift
