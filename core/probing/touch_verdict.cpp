// SPDX-License-Identifier: Apache-2.0
#include "core/probing/touch_verdict.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace spindrift {
std::vector<TouchVerdict> touchVerdicts(const TouchEvaluation& evaluation, const CycleEvaluation& cycles) {
  const std::vector<Touch>& touches = evaluation.touches.touches;
  std::map<std::size_t, const RejectedTouch*> left_out;
  for (const RejectedTouch& r : cycles.rejected) left_out.emplace(r.touch, &r);
  std::map<std::size_t, std::size_t> row_of;
  for (std::size_t r = 0; r < cycles.row_touch.size(); ++r) row_of[cycles.row_touch[r]] = r;

  std::map<std::string, std::vector<TouchVerdict>> by_cycle;
  std::vector<std::string> order = cycles.cycles;
  std::map<Touch::Key, std::pair<Touch, int>> expected;  // first of its kind, number of cycles
  std::map<std::string, std::set<Touch::Key>> present;
  const auto note = [&](const Touch& t) {
    if (std::find(order.begin(), order.end(), t.cycle) == order.end()) order.push_back(t.cycle);
    ++expected.try_emplace(t.key(), t, 0).first->second.second;
    present[t.cycle].insert(t.key());
  };
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const Touch& t = touches[i];
    if (t.artefact != cycles.artefact) continue;
    note(t);
    TouchVerdict v;
    v.touch = t;
    const auto row = row_of.find(i);
    if (row != row_of.end() && row->second < cycles.fit.residual_mm.size()) {
      v.residual_um = cycles.fit.residual_mm[row->second] * 1e3;
      v.studentised = cycles.fit.studentised[row->second];
    }
    if (const auto found = left_out.find(i); found != left_out.end()) {
      v.state = TouchState::LeftOut;
      v.reason = found->second->reason;
      v.residual_um = found->second->residual_um;
    } else if (row == row_of.end()) {
      v.state = TouchState::LeftOut;
      v.reason = "the centre of its feature cannot be determined";
    }
    by_cycle[t.cycle].push_back(std::move(v));
  }
  for (const Touch& t : evaluation.excluded) {
    if (t.artefact != cycles.artefact) continue;
    note(t);
    TouchVerdict v;
    v.touch = t;
    v.state = TouchState::Excluded;
    v.reason = "excluded by the user";
    by_cycle[t.cycle].push_back(std::move(v));
  }
  // Where few cycles are complete the fullest says what belongs to one; a touch beyond the usual number of a feature is
  // one taken again.
  std::string fullest;
  std::map<int, std::size_t> features_with;  // touch number -> features of the fullest cycle that have it
  std::set<std::tuple<std::string, std::string, double>> features;
  for (const std::string& cycle : order) {
    if (fullest.empty() || present[cycle].size() > present[fullest].size()) fullest = cycle;
  }
  for (const auto& [feature, stylus, c_deg, touch] : present[fullest]) {
    features.insert({feature, stylus, c_deg});
    ++features_with[touch];
  }
  const auto belongs = [&](const Touch::Key& key, int cycles_with) {
    if (2 * cycles_with > static_cast<int>(order.size())) return true;
    return present[fullest].contains(key) && 2 * features_with[std::get<3>(key)] > features.size();
  };
  std::vector<TouchVerdict> out;
  for (const std::string& cycle : order) {
    std::vector<TouchVerdict>& list = by_cycle[cycle];
    std::stable_sort(list.begin(), list.end(),
                     [](const TouchVerdict& a, const TouchVerdict& b) { return a.touch.time_s < b.touch.time_s; });
    for (const auto& [key, usual] : expected) {
      if (present[cycle].contains(key) || !belongs(key, usual.second)) continue;
      TouchVerdict v;
      v.touch = usual.first;
      v.touch.cycle = cycle;
      v.touch.line = 0;
      v.state = TouchState::Missing;
      v.reason = "other cycles have it; take it again";
      list.push_back(std::move(v));
    }
    std::move(list.begin(), list.end(), std::back_inserter(out));
  }
  return out;
}

}  // namespace spindrift
