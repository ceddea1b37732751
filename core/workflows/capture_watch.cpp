// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/capture_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace spindrift {
namespace {

std::filesystem::path allowedFolder(const std::filesystem::path& folder, const std::filesystem::path& session) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError({folder, ""}, "is no folder; allowed: the folder into which the instrument writes.");
  const std::filesystem::path watched = std::filesystem::canonical(folder);
  const std::filesystem::path own = std::filesystem::canonical(session);
  const auto [end, ignored] = std::mismatch(own.begin(), own.end(), watched.begin(), watched.end());
  if (end == own.end())
    throw InputError({folder, ""},
                     "belongs to the session itself; allowed: the folder into which the instrument writes.");
  return watched;
}

}  // namespace

CaptureWatch::CaptureWatch(Session& session, std::int64_t campaign, const std::filesystem::path& folder,
                           std::optional<JsonNode> pattern, const FolderWatchOptions& watch, double patience_s)
    : session_(session),
      campaign_(campaign),
      printed_(pattern.has_value()),
      plan_(storedPlan(session, campaign)),
      journal_(incomingJournal(session, campaign)),
      folder_(allowedFolder(folder, session.folder()), watch, patience_s) {
  const Campaign now = campaignNow();
  std::optional<TouchList> there;
  if (const auto list = now.captureList("touches.csv")) there = TouchList::read(*list);
  feed_ = std::make_unique<TouchFeed>(now.machine, there ? &*there : nullptr, std::move(pattern));
}

Campaign CaptureWatch::campaignNow() const {
  return Campaign::read(session_.campaign(campaign_).folder);
}

std::set<std::string> CaptureWatch::done() const {
  return capturedItems(plan_, campaignNow());
}

std::vector<IncomingItem> CaptureWatch::turn(double now_s) {
  std::vector<IncomingItem> decided;
  folder_.look(now_s);
  while (const auto task = folder_.next()) {
    IncomingContext context = incomingContext(campaignNow(), plan_, journal_, printed_);
    context.fullest = fullest_;
    ExaminedFile examined = examineArrival(task->file.file, task->name, task->file.written_ns, context);
    if (examined.item.kind == IncomingKind::Touches && !examined.text.empty()) {
      const auto [first, fresh] = first_seen_s_.try_emplace(examined.item.name, examined.item.time_s);
      feed_->update(examined.item.name, examined.text, first->second);
      storeTouches(false);
      examined.item.sentence = fmt::format("{} touches so far.", touches());
    }
    ExaminedFile answer = examined;
    answer.item = folder_.finish(*task, std::move(examined), now_s);
    if (answer.item.state == IncomingState::Waiting) continue;
    recordArrival(session_, campaign_, answer);
    journal_ = incomingJournal(session_, campaign_);
    if (answer.points > 0 && answer.item.state == IncomingState::Accepted)
      fullest_[answer.artefact] = std::max(fullest_[answer.artefact], answer.points);
    decided.push_back(answer.item);
  }
  return decided;
}

void CaptureWatch::finish() {
  storeTouches(true);
}

void CaptureWatch::storeTouches(bool all) {
  const std::vector<std::string> rows = feed_->takeRows(all);
  if (!rows.empty()) session_.addCaptureRows(campaign_, "touches.csv", TouchFeed::header(), rows);
}

std::vector<std::string> CaptureWatch::retakes() const {
  std::vector<std::string> sentences;
  const std::set<std::string> there = done();
  for (const IncomingItem& item : journal_) {
    if (item.state != IncomingState::Retake) continue;
    if (!item.plan_item.empty() && there.contains(item.plan_item)) continue;
    sentences.push_back(
        fmt::format("Take {} again: {}", item.plan_item.empty() ? item.name : item.plan_item, item.sentence));
  }
  for (const std::string& s : feed_->live().retakes()) sentences.push_back(s);
  return sentences;
}

}  // namespace spindrift
