// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/measurement_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/printed_number.h"
#include "core/base/text.h"
#include "core/imaging/fiducial_captures.h"
#include "core/probing/cycle_plan.h"
#include "core/probing/touch.h"
#include "core/scanning/scan_evaluation.h"

namespace spindrift {
namespace {

std::string clock(double seconds) {
  const auto total = static_cast<long>(std::llround(std::abs(seconds)));
  if (total >= 3600) return fmt::format("{}:{:02} h", total / 3600, total / 60 % 60);
  return fmt::format("{}:{:02} min", total / 60, total % 60);
}

PlannedItem parseItem(const JsonNode& node) {
  PlannedItem item;
  item.id = node.at("id").name();
  const std::string kind = node.at("kind").oneOf({"image", "cycle", "scan"});
  item.kind = kind == "image" ? PlannedKind::Image : kind == "cycle" ? PlannedKind::Cycle : PlannedKind::Scan;
  item.state = node.at("state").name();
  item.due_s = node.at("due_s").number();
  if (item.kind == PlannedKind::Image) {
    item.fiducial = node.at("fiducial").name();
    item.role = node.at("role").oneOf({"rotation", "x_axis", "y_axis", "focus"});
    item.index = node.at("index").integer();
    item.position_mm = {node.at("x_mm").number(), node.at("y_mm").number(), node.at("z_mm").number()};
    item.spindle_deg = node.at("spindle_deg").number();
  } else {
    item.artefact = node.at("artefact").name();
    if (item.kind == PlannedKind::Scan) item.y_mm = node.at("y_mm").number();
    if (item.kind == PlannedKind::Cycle)
      item.touches = static_cast<int>(std::clamp(node.numberOr("touches", 0.0), 0.0, 1e6));
  }
  return item;
}

/// Touches of the measuring cycle as the program plans it; 0 if it cannot (no stylus, for example).
int touchesOf(const MachineDescription& machine, const Artefact& artefact) {
  CyclePlanOptions options;
  // Where the balls stand does not change their number: in the middle of the travel they are within reach.
  for (const LinearAxis& axis : machine.axes) {
    const auto k = axis.name.empty() ? std::string::npos : std::string("XYZ").find(axis.name.front());
    if (k != std::string::npos)
      options.first_ball_mm(static_cast<int>(k)) = 0.5 * (axis.travel_mm[0] + axis.travel_mm[1]);
  }
  if (!artefact.balls.empty()) {
    Eigen::Vector3d low = artefact.balls.front().certified_mm;
    Eigen::Vector3d high = low;
    for (const ArtefactBall& ball : artefact.balls) {
      low = low.cwiseMin(ball.certified_mm);
      high = high.cwiseMax(ball.certified_mm);
    }
    options.first_ball_mm -= 0.5 * (low + high);
  }
  try {
    return planCycle(machine, artefact, options).touches;
  } catch (const InputError&) {
    return 0;
  }
}

void addPlannedImages(MeasurementPlan& plan, const PlannedState& state, const MachinePoint& point,
                      const PlanOptions& options) {
  const auto add = [&](const char* role, int index, const Eigen::Vector3d& offset, double spindle) {
    PlannedItem item;
    item.id = fmt::format("{}_{}_{}_{}", state.name, point.id, role, index);
    item.state = state.name;
    item.due_s = state.due_s;
    item.fiducial = point.id;
    item.role = role;
    item.index = index;
    item.position_mm = point.position_mm + offset;
    item.spindle_deg = spindle;
    plan.items.push_back(std::move(item));
  };
  int k = 0;
  for (const double angle : options.rotations_deg) add("rotation", k++, Eigen::Vector3d::Zero(), angle);
  k = 0;
  for (const double step : options.steps_mm) add("x_axis", k++, {step, 0, 0}, 0.0);
  k = 0;
  for (const double step : options.steps_mm) add("y_axis", k++, {0, step, 0}, 0.0);
  k = 0;
  for (const double height : options.heights_mm) add("focus", k++, {0, 0, height}, 0.0);
}

}  // namespace

std::string toString(PlannedKind kind) {
  return kind == PlannedKind::Image ? "image" : kind == PlannedKind::Cycle ? "cycle" : "scan";
}

std::string PlannedItem::instruction() const {
  if (kind == PlannedKind::Cycle) return fmt::format("run the measuring cycle of {} as {}", artefact, state);
  if (kind == PlannedKind::Scan) return fmt::format("scan {} as {}, starting at {:g} mm", artefact, state, y_mm);
  static const std::map<std::string, std::string> names{
      {"rotation", "rotation"}, {"x_axis", "along X"}, {"y_axis", "along Y"}, {"focus", "focus"}};
  return fmt::format("{}, {} {}: x {:g}, y {:g}, z {:g} mm, spindle {:g}°", fiducial, names.at(role), index,
                     printed(position_mm.x()), printed(position_mm.y()), printed(position_mm.z()),
                     printed(spindle_deg));
}

nlohmann::json MeasurementPlan::json() const {
  nlohmann::json root = {{"format", "spindrift-plan"}, {"version", 1}};
  root["states"] = nlohmann::json::array();
  for (const PlannedState& s : states) {
    root["states"].push_back({{"name", s.name}, {"due_s", s.due_s}, {"what", s.what}});
  }
  root["items"] = nlohmann::json::array();
  for (const PlannedItem& i : items) {
    nlohmann::json item = {{"id", i.id}, {"kind", toString(i.kind)}, {"state", i.state}, {"due_s", i.due_s}};
    if (i.kind == PlannedKind::Image) {
      item.update({{"fiducial", i.fiducial},
                   {"role", i.role},
                   {"index", i.index},
                   {"x_mm", i.position_mm.x()},
                   {"y_mm", i.position_mm.y()},
                   {"z_mm", i.position_mm.z()},
                   {"spindle_deg", i.spindle_deg}});
    } else {
      item["artefact"] = i.artefact;
      if (i.kind == PlannedKind::Scan) item["y_mm"] = i.y_mm;
      if (i.touches > 0) item["touches"] = i.touches;
    }
    root["items"].push_back(std::move(item));
  }
  return root;
}

MeasurementPlan MeasurementPlan::parse(const JsonNode& root) {
  root.requireFormat("spindrift-plan", 1);
  MeasurementPlan plan;
  std::set<std::string> names;
  for (const JsonNode& node : root.at("states").items()) {
    PlannedState state{node.at("name").name(), node.at("due_s").number(), node.stringOr("what", "")};
    if (!names.insert(state.name).second) node.at("name").reject("every state once");
    plan.states.push_back(std::move(state));
  }
  std::set<std::string> ids;
  for (const JsonNode& node : root.at("items").items()) {
    PlannedItem item = parseItem(node);
    if (!ids.insert(item.id).second) node.at("id").reject("every id once");
    if (!names.contains(item.state)) node.at("state").reject("a state of \"states\"");
    plan.items.push_back(std::move(item));
  }
  return plan;
}

PlanIndex::PlanIndex(MeasurementPlan plan) : plan_(std::move(plan)) {
  for (std::size_t i = 0; i < plan_.items.size(); ++i) {
    const std::string& id = plan_.items[i].id;
    ids_.try_emplace(id, i);
    lower_.try_emplace(lowerCase(id), i);
    lengths_.insert(id.size());
  }
}

std::optional<std::size_t> PlanIndex::find(const std::string& id) const {
  const auto found = ids_.find(id);
  return found == ids_.end() ? std::nullopt : std::optional(found->second);
}

const PlannedItem* PlanIndex::ofName(const std::string& file_name) const {
  const std::string name = lowerCase(file_name);
  const auto letter = [&](std::size_t i) { return std::isalnum(static_cast<unsigned char>(name[i])) != 0; };
  for (const std::size_t length : lengths_) {
    std::optional<std::size_t> first;
    for (std::size_t at = 0; at + length <= name.size(); ++at) {
      // "M1_F1_focus_1" must not be found in "M1_F1_focus_12".
      if ((at > 0 && letter(at - 1)) || (at + length < name.size() && letter(at + length))) continue;
      const auto found = lower_.find(name.substr(at, length));
      if (found != lower_.end() && (!first || found->second < *first)) first = found->second;
    }
    if (first) return &plan_.items[*first];
  }
  return nullptr;
}

void PlanOptions::validate() const {
  if (states < 1 || states > 1000) throw InputError(fmt::format("{} thermal states; allowed: 1 to 1000.", states));
  if (!(interval_s > 0.0)) throw InputError("the interval between thermal states must be positive (s).");
  if (kind != PlannedKind::Image) return;
  if (rotations_deg.size() < 3 || steps_mm.size() < 3 || heights_mm.size() < 5) {
    throw InputError(fmt::format("{} rotations, {} steps and {} heights are too few; allowed: at least 3, 3 and 5.",
                                 rotations_deg.size(), steps_mm.size(), heights_mm.size()));
  }
}

MeasurementPlan makePlan(const MachineDescription& machine, const PlanOptions& options) {
  options.validate();
  MeasurementPlan plan;
  for (int k = 0; k < options.states; ++k) {
    PlannedState state{fmt::format("M{}", k), k * options.interval_s, k == 0 ? "reference" : ""};
    if (k > 0) state.what = clock(state.due_s) + " after the start";
    const auto addOf = [&](const std::string& artefact, double y_mm, int touches) {
      PlannedItem item;
      item.id = state.name + "_" + artefact;
      item.kind = options.kind;
      item.state = state.name;
      item.due_s = state.due_s;
      item.artefact = artefact;
      item.y_mm = y_mm;
      item.touches = touches;
      plan.items.push_back(std::move(item));
    };
    if (options.kind == PlannedKind::Cycle) {
      for (const Artefact& artefact : machine.artefacts) addOf(artefact.id, 0.0, touchesOf(machine, artefact));
    }
    for (const MachinePoint& point : machine.points) {
      if (options.kind == PlannedKind::Image && point.kind == "fiducial") addPlannedImages(plan, state, point, options);
      if (options.kind == PlannedKind::Scan && point.kind == "surface") addOf(point.id, point.position_mm.y(), 0);
    }
    plan.states.push_back(std::move(state));
  }
  if (plan.items.empty()) {
    const char* what = options.kind == PlannedKind::Image   ? "points of kind \"fiducial\""
                       : options.kind == PlannedKind::Cycle ? "artefacts"
                                                            : "points of kind \"surface\"";
    throw InputError({machine.file, options.kind == PlannedKind::Cycle ? "$.artefacts" : "$.points"},
                     fmt::format("holds no {}; a plan needs at least one.", what));
  }
  return plan;
}

namespace {

std::string imageKey(const std::string& state, const std::string& fiducial, std::string_view role, int index) {
  return fmt::format("image|{}|{}|{}|{}", state, fiducial, role, index);
}

/// Of a cycle or a scan.
std::string artefactKey(PlannedKind kind, const std::string& state, const std::string& artefact) {
  return fmt::format("{}|{}|{}", toString(kind), state, artefact);
}

std::string keyOf(const PlannedItem& i) {
  return i.kind == PlannedKind::Image ? imageKey(i.state, i.fiducial, i.role, i.index)
                                      : artefactKey(i.kind, i.state, i.artefact);
}

}  // namespace

PlanTally::PlanTally(const PlanIndex& plan, const Campaign& campaign) : plan_(plan) {
  const std::vector<PlannedItem>& items = plan_.plan().items;
  for (std::size_t i = 0; i < items.size(); ++i) {
    by_key_[keyOf(items[i])].push_back(i);
    open_[items[i].kind].insert(i);
  }
  try {
    if (const auto file = campaign.captureList("fiducials.csv")) {
      for (const FiducialCapture& c : readFiducialCaptures(*file).captures)
        markKey(imageKey(c.state, c.fiducial, toString(c.role), c.index));
    }
    if (const auto file = campaign.captureList("touches.csv")) {
      for (const Touch& t : TouchList::read(*file).touches) add(t);
    }
    if (campaign.captureList("scans.csv")) {
      for (const ScanCapture& c : readScanList(campaign)) markKey(artefactKey(PlannedKind::Scan, c.cycle, c.artefact));
    }
  } catch (const InputError&) {
    // The page of the captures says what is wrong with the list.
  }
}

void PlanTally::markKey(const std::string& key) {
  const auto items = by_key_.find(key);
  if (items == by_key_.end()) return;
  for (const std::size_t i : items->second) {
    const PlannedItem& item = plan_.plan().items[i];
    captures_.done.insert(item.id);
    open_[item.kind].erase(i);
  }
}

const PlannedItem* PlanTally::firstOpen(PlannedKind kind) const {
  const auto open = open_.find(kind);
  if (open == open_.end() || open->second.empty()) return nullptr;
  return &plan_.plan().items[*open->second.begin()];
}

void PlanTally::add(const PlannedItem& item) {
  markKey(keyOf(item));
}

void PlanTally::add(const Touch& touch) {
  Cycles& cycles = cycles_[touch.artefact];
  const auto [at, fresh] = cycles.index.try_emplace(touch.cycle, cycles.counts.size());
  if (fresh) cycles.counts.emplace_back(touch.cycle, 0);
  std::size_t& count = cycles.counts[at->second].second;
  if (const auto before = cycles.with_count.find(count); !fresh && --before->second == 0)
    cycles.with_count.erase(before);
  ++cycles.with_count[++count];
  judgeCycle(touch.artefact, cycles, at->second);
  if (at->second > 0) {
    judgeCycle(touch.artefact, cycles, 0);
  } else {
    for (std::size_t other = 1; other < cycles.counts.size(); ++other) judgeCycle(touch.artefact, cycles, other);
  }
}

void PlanTally::judgeCycle(const std::string& artefact, const Cycles& cycles, std::size_t cycle) {
  const auto& [name, own] = cycles.counts[cycle];
  const auto items = by_key_.find(artefactKey(PlannedKind::Cycle, name, artefact));
  if (items == by_key_.end()) return;
  // A programme of its own may have fewer touches than planned: then all cycles have.
  const bool usual = cycles.with_count.at(own) > 1;
  for (const std::size_t i : items->second) {
    const PlannedItem& item = plan_.plan().items[i];
    const auto planned = static_cast<std::size_t>(item.touches);
    const bool complete = cycle > 0     ? own >= cycles.counts.front().second
                          : planned > 0 ? own >= planned || usual
                                        : cycles.counts.size() > 1;
    if (complete) {
      captures_.done.insert(item.id);
      captures_.begun.erase(item.id);
      open_[item.kind].erase(i);
    } else {
      captures_.done.erase(item.id);
      captures_.begun[item.id] = own;
      open_[item.kind].insert(i);
    }
  }
}

PlanCaptures planCaptures(const MeasurementPlan& plan, const Campaign& campaign) {
  const PlanIndex index(plan);
  return PlanTally(index, campaign).captures();
}

std::set<std::string> capturedItems(const MeasurementPlan& plan, const Campaign& campaign) {
  return planCaptures(plan, campaign).done;
}

PlanProgress progressOf(const MeasurementPlan& plan, const std::set<std::string>& done, double now_s,
                        const std::map<std::string, std::size_t>& begun) {
  PlanProgress progress;
  std::set<std::string> running;
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    const PlannedItem& item = plan.items[i];
    const bool there = done.contains(item.id);
    if (there) ++progress.done;
    // A cycle that stayed short while a later one ran cannot be measured any more.
    const bool behind = progress.next && item.kind == PlannedKind::Cycle &&
                        item.artefact == plan.items[*progress.next].artefact && (there || begun.contains(item.id));
    if (behind) progress.next.reset();
    if (!there && !progress.next) progress.next = i;
    if (there || begun.contains(item.id)) running.insert(item.state);
  }
  if (plan.empty()) {
    progress.sentence = "There is no plan yet.";
    return progress;
  }
  if (!progress.next) {
    const std::size_t all = plan.items.size();
    progress.sentence = progress.done < all ? fmt::format("Plan completed: {} of {} complete.", progress.done,
                                                          countOf(all, "capture is", "captures are"))
                        : all == 1          ? std::string("The one capture of the plan is there.")
                                            : fmt::format("All {} captures of the plan are there.", all);
    return progress;
  }
  const PlannedItem& item = plan.items[*progress.next];
  progress.countdown_s = running.contains(item.state) ? std::min(0.0, item.due_s - now_s) : item.due_s - now_s;
  if (progress.countdown_s > 0.0) {
    progress.sentence =
        fmt::format("{} begins in {}: {}.", item.state, clock(progress.countdown_s), item.instruction());
    return progress;
  }
  progress.sentence = fmt::format("Now {}: {}", item.state, item.instruction());
  if (const auto part = begun.find(item.id); part != begun.end()) {
    progress.sentence +=
        item.touches > 0 ? fmt::format(" ({} of {} are there)", part->second, countOf(item.touches, "touch", "touches"))
                         : fmt::format(" ({} so far)", countOf(part->second, "touch", "touches"));
  }
  progress.sentence += ".";
  return progress;
}

}  // namespace spindrift
