// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/capture_intake.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/count_text.h"
#include "core/base/error.h"

namespace spindrift {

namespace {

/// Without links where the system says so, else as it is written.
std::filesystem::path plainPath(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path found = std::filesystem::weakly_canonical(path, error);
  return error ? std::filesystem::absolute(path, error).lexically_normal() : found;
}

}  // namespace

CaptureIntake::CaptureIntake(std::vector<IncomingItem> journal) : items_(std::move(journal)) {
  for (const IncomingItem& item : items_) answered_[item.name] = item;
}

bool CaptureIntake::liesInside(const std::filesystem::path& folder, const std::filesystem::path& session) {
  const std::filesystem::path inner = plainPath(folder);
  const std::filesystem::path own = plainPath(session);
  const auto [end, ignored] = std::mismatch(own.begin(), own.end(), inner.begin(), inner.end());
  return end == own.end();
}

void CaptureIntake::expectTouches(const Campaign& campaign, std::optional<JsonNode> pattern) {
  std::optional<TouchList> there;
  if (const auto list = campaign.captureList("touches.csv")) there = TouchList::read(*list);
  const bool printed = pattern.has_value();
  feed_ = std::make_unique<TouchFeed>(campaign.machine, there ? &*there : nullptr, std::move(pattern));
  printed_ = printed;
}

std::string CaptureIntake::touchSentence() const {
  std::size_t waiting = 0;
  std::size_t again = 0;
  if (feed_ != nullptr) {
    for (const LiveTouch& live : feed_->live().touches()) {
      if (live.given_out || live.replaced) continue;
      ++(live.plausible ? waiting : again);
    }
  }
  std::string sentence = countOf(touchCount(), "touch", "touches") + " so far";
  if (waiting > 0) {
    sentence += waiting == 1 ? "; 1 is taken over when its feature is complete"
                             : fmt::format("; {} are taken over when their feature is complete", waiting);
  }
  if (again > 0) sentence += fmt::format("; {} to be taken again", again);
  return sentence + ".";
}

std::size_t CaptureIntake::takeTouches(const ExaminedFile& examined) {
  SPINDRIFT_ASSERT(feed_ != nullptr, "touches come after expectTouches");
  const auto [first, fresh] = first_seen_s_.try_emplace(examined.item.name, examined.item.time_s);
  return feed_->update(examined.item.name, examined.text, first->second);
}

std::vector<std::string> CaptureIntake::takeRows(bool all) {
  return feed_ == nullptr ? std::vector<std::string>() : feed_->takeRows(all);
}

IncomingContext CaptureIntake::context(const Campaign& campaign, const MeasurementPlan& plan) const {
  IncomingContext context = incomingContext(campaign, plan, items_, printed_);
  context.fullest = fullest_;
  return context;
}

const IncomingItem& CaptureIntake::show(const IncomingItem& item) {
  const auto answer = answered_.find(item.name);
  const bool again = item.state == IncomingState::Twice && answer != answered_.end() && !item.hash.empty() &&
                     answer->second.hash == item.hash;
  const IncomingItem now = again ? answer->second : item;
  if (now.state != IncomingState::Waiting) answered_[now.name] = now;
  const auto known =
      std::find_if(items_.begin(), items_.end(), [&](const IncomingItem& other) { return other.name == now.name; });
  if (known != items_.end()) return *known = now;
  return items_.emplace_back(now);
}

void CaptureIntake::remember(const ExaminedFile& answer) {
  if (answer.points == 0 || answer.item.state != IncomingState::Accepted) return;
  std::size_t& most = fullest_[answer.artefact];
  most = std::max(most, answer.points);
}

std::vector<CaptureIntake::Retake> CaptureIntake::retakes(const std::set<std::string>& done) const {
  std::vector<Retake> out;
  for (const IncomingItem& item : items_) {
    if (item.state != IncomingState::Retake) continue;
    if (!item.plan_item.empty() && done.contains(item.plan_item)) continue;
    out.push_back({item.plan_item.empty() ? item.name : item.plan_item, item.sentence});
  }
  if (feed_ != nullptr)
    for (const std::string& sentence : feed_->live().retakes()) out.push_back({{}, sentence});
  return out;
}

}  // namespace spindrift
