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
  for (std::size_t i = 0; i < items_.size(); ++i) {
    known_[items_[i].name] = {i, items_[i]};
    if (items_[i].state == IncomingState::Retake) retakes_.insert(i);
  }
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
  // Every file is read from its beginning, for the new feed.
  taken_.clear();
  if (context_ != nullptr) context_->forgetPositions();
  forgetContext();
}

std::string CaptureIntake::touchSentence() const {
  std::size_t waiting = 0;
  std::size_t again = 0;
  if (feed_ != nullptr) {
    for (const std::size_t i : feed_->live().open()) {
      const LiveTouch& live = feed_->live().touches()[i];
      if (!live.given_out) ++(live.plausible ? waiting : again);
    }
  }
  std::string sentence = countOf(touchCount(), "touch", "touches") + " so far";
  if (waiting > 0) {
    sentence += waiting == 1 ? "; 1 is taken over when its feature is complete"
                             : fmt::format("; {} are taken over when their feature is complete", waiting);
  }
  if (again > 0) sentence += fmt::format("; {} to be taken again", again);
  if (const std::size_t lines = touchProblems().size(); lines > 0)
    sentence += "; " + countOf(lines, "line cannot be read", "lines cannot be read");
  return sentence + ".";
}

std::size_t CaptureIntake::takeTouches(const ExaminedFile& examined) {
  SPINDRIFT_ASSERT(feed_ != nullptr, "touches come after expectTouches");
  const std::string& name = examined.item.name;
  std::uint64_t& taken = taken_[name];
  if (examined.from > 0 && examined.from != taken) return 0;
  const auto [first, fresh] = first_seen_s_.try_emplace(name, examined.item.time_s);
  const std::size_t count = feed_->update(name, examined.text, examined.from == 0, first->second);
  taken = examined.from + examined.text.size();
  if (context_ != nullptr && examined.position != nullptr) context_->recordPosition(examined);
  return count;
}

void CaptureIntake::finishTouches() {
  if (feed_ != nullptr) feed_->finish();
}

std::vector<std::string> CaptureIntake::touchProblems() const {
  return feed_ == nullptr ? std::vector<std::string>() : feed_->problems();
}

std::vector<Touch> CaptureIntake::takeFinished(bool all) {
  return feed_ == nullptr ? std::vector<Touch>() : feed_->takeFinished(all);
}

std::shared_ptr<const IncomingContext> CaptureIntake::context(const Campaign& campaign, const MeasurementPlan& plan) {
  if (context_ == nullptr || stale_ || context_->excluded() != campaign.excluded_captures) {
    auto made = std::make_shared<IncomingContext>(campaign, plan, items_, printed_);
    if (context_ != nullptr) made->goOnFrom(*context_);
    context_ = std::move(made);
    stale_ = false;
  }
  return context_;
}

const IncomingItem& CaptureIntake::show(const IncomingItem& item) {
  const auto [at, fresh] = known_.try_emplace(item.name);
  KnownItem& known = at->second;
  const bool again =
      item.state == IncomingState::Twice && known.answered && !item.hash.empty() && known.answered->hash == item.hash;
  const IncomingItem now = again ? *known.answered : item;
  if (now.state != IncomingState::Waiting) known.answered = now;
  if (fresh) {
    known.index = items_.size();
    items_.push_back(now);
  } else {
    items_[known.index] = now;
  }
  if (now.state == IncomingState::Retake) {
    retakes_.insert(known.index);
  } else {
    retakes_.erase(known.index);
  }
  return items_[known.index];
}

void CaptureIntake::remember(const ExaminedFile& answer) {
  if (context_ != nullptr) context_->record(answer);
}

void CaptureIntake::remember(const std::vector<Touch>& touches) {
  if (context_ != nullptr) context_->record(touches);
}

std::vector<CaptureIntake::Retake> CaptureIntake::retakes(const std::set<std::string>& done) const {
  std::vector<Retake> out;
  for (const std::size_t i : retakes_) {
    const IncomingItem& item = items_[i];
    if (!item.plan_item.empty() && done.contains(item.plan_item)) continue;
    out.push_back({item.plan_item.empty() ? item.name : item.plan_item, item.sentence});
  }
  if (feed_ != nullptr)
    for (const std::string& sentence : feed_->live().retakes()) out.push_back({{}, sentence});
  return out;
}

}  // namespace spindrift
