// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/loop_search.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace spindrift {
namespace {

template <typename T>
bool done(const std::future<T>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void LoopSearch::begin(DiscrepancyInput input) {
  input_ = std::move(input);
  search_ = std::async(std::launch::async, [this] {
    JobContext job(stop_.get_token(), nullptr);
    DiscrepancyOptions options;
    options.suggest = false;
    return findDiscrepancy(input_, options, job);
  });
}

bool LoopSearch::asking() const {
  return decision_.valid() && !done(decision_) && plan_.accept.rule == LoopAcceptance::Rule::Ask && who_.choose;
}

std::optional<DiscrepancyResult> LoopSearch::named() {
  if (!done(search_)) return std::nullopt;
  DiscrepancyResult found = search_.get();
  decision_ = std::async(std::launch::async, [this, found] { return decide(found); });
  return found;
}

std::optional<LoopSearch::Decision> LoopSearch::decided() {
  if (!done(decision_)) return std::nullopt;
  return decision_.get();
}

LoopSearch::Decision LoopSearch::decide(const DiscrepancyResult& found) const {
  std::vector<std::string> wanted = plan_.accept.ids;
  if (plan_.accept.rule == LoopAcceptance::Rule::Ask)
    wanted = who_.choose && !found.effects.empty() ? who_.choose(found, stop_.get_token()) : std::vector<std::string>();
  Decision out;
  for (const FoundEffect& effect : found.effects) {
    const bool named = plan_.accept.rule == LoopAcceptance::Rule::Named && effect.rivals.empty();
    const bool listed = std::find(wanted.begin(), wanted.end(), effect.id) != wanted.end();
    (named || listed ? out.accepted : out.rejected).push_back(effect.id);
  }
  if (out.rejected.empty()) {
    out.model = found.model;
  } else if (!out.accepted.empty()) {
    // Fitted alone: names that were rejected play no part.
    JobContext job(stop_.get_token(), nullptr);
    DiscrepancyOptions options;
    options.accept = out.accepted;
    options.max_effects = 0;
    options.suggest = false;
    out.model = findDiscrepancy(input_, options, job).model;
  }
  return out;
}

}  // namespace spindrift
