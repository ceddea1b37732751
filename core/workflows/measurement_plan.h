// SPDX-License-Identifier: Apache-2.0
// What to measure when, in what order: the plan that drives capturing. It is kept in the session as JSON:
//   {"format":"spindrift-plan","version":1,"states":[{"name":"M0","due_s":0,"what":"cold"}],
//    "items":[{"id":"M0_F1_focus_2","kind":"image"|"cycle"|"scan","state":"M0","due_s":0,
//              image: "fiducial","role","index","x_mm","y_mm","z_mm","spindle_deg"; cycle, scan: "artefact"; scan:
//              "y_mm", cycle: "touches" (how many make it complete; may be absent)}]}
// Times in s since the campaign start, positions mm, spindle_deg as in captures/fiducials.csv.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/json_reader.h"
#include "core/machine/campaign.h"
#include "core/probing/touch.h"

namespace spindrift {

enum class PlannedKind { Image, Cycle, Scan };
[[nodiscard]] std::string toString(PlannedKind kind);

struct PlannedItem {
  std::string id;  ///< also what a file may carry in its name: "M1_F3_focus_2"
  PlannedKind kind = PlannedKind::Image;
  std::string state;
  double due_s = 0.0;
  std::string fiducial, role;  ///< of images
  int index = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double spindle_deg = 0.0;
  std::string artefact;  ///< of cycles and scans
  double y_mm = 0.0;     ///< of scans
  int touches = 0;       ///< of cycles: how many make it complete; 0: not known
  /// "F3, focus 2: x 20, y 40, z 0.127 mm, spindle 0 deg".
  [[nodiscard]] std::string instruction() const;
};

struct PlannedState {
  std::string name;
  double due_s = 0.0;
  std::string what;  ///< "cold", "after 30 min of spindle"
};

struct MeasurementPlan {
  std::vector<PlannedState> states;
  std::vector<PlannedItem> items;  ///< in the order in which they are to be measured

  [[nodiscard]] bool empty() const { return items.empty(); }
  [[nodiscard]] nlohmann::json json() const;
  /// Throws InputError: unknown kind or role, an id or a state twice, a state that is not listed, a time that is none.
  [[nodiscard]] static MeasurementPlan parse(const JsonNode& root);
};

struct PlanOptions {
  PlannedKind kind = PlannedKind::Image;
  int states = 3;
  double interval_s = 1800.0;  ///< between thermal states
  std::vector<double> rotations_deg{0.0, 90.0, 180.0, 270.0};
  std::vector<double> steps_mm{-0.254, -0.127, 0.0, 0.127, 0.254};    ///< along X and along Y
  std::vector<double> heights_mm{-0.254, -0.127, 0.0, 0.127, 0.254};  ///< of the focus series
  /// Throws InputError.
  void validate() const;
};

/// A plan over all fiducials (images), artefacts with features (cycles) or surfaces (scans) of the machine. Throws
/// InputError if the machine has none.
[[nodiscard]] MeasurementPlan makePlan(const MachineDescription& machine, const PlanOptions& options);

/// A plan whose items are found without looking through all of them.
class PlanIndex {
 public:
  explicit PlanIndex(MeasurementPlan plan);

  [[nodiscard]] const MeasurementPlan& plan() const { return plan_; }
  /// Index of an item.
  [[nodiscard]] std::optional<std::size_t> find(const std::string& id) const;
  /// The item whose id stands in a file's name (letters in any case, longest id first), nothing beside it that would
  /// belong to it; null if none does.
  [[nodiscard]] const PlannedItem* ofName(const std::string& file_name) const;

 private:
  MeasurementPlan plan_;
  std::unordered_map<std::string, std::size_t> ids_;
  std::unordered_map<std::string, std::size_t> lower_;  ///< ids in lower case
  std::set<std::size_t, std::greater<>> lengths_;       ///< of the ids
};

/// What the capture lists of a campaign folder hold of a plan.
struct PlanCaptures {
  std::set<std::string> done;
  std::map<std::string, std::size_t> begun;  ///< cycles that are not complete -> their touches so far
};

/// An image or a scan is captured when it is listed. A cycle is captured when it has as many touches as the first cycle
/// of its artefact; the first one itself when it has as many as planned, or as another cycle (a programme of its own
/// may have fewer); where no number is planned, when another cycle has begun. Lists that cannot be read count as empty.
[[nodiscard]] PlanCaptures planCaptures(const MeasurementPlan& plan, const Campaign& campaign);

/// The same, kept up to date as captures arrive; what one more costs does not depend on how many there are.
class PlanTally {
 public:
  /// `plan` must outlive it.
  PlanTally(const PlanIndex& plan, const Campaign& campaign);

  [[nodiscard]] const PlanCaptures& captures() const { return captures_; }
  /// First item of a kind (image, scan) that is not captured; null if all are.
  [[nodiscard]] const PlannedItem* firstOpen(PlannedKind kind) const;
  /// An image or scan was listed.
  void add(const PlannedItem& item);
  /// A touch was listed.
  void add(const Touch& touch);

 private:
  /// Touches of the cycles of an artefact, cycles in order of appearance.
  struct Cycles {
    std::vector<std::pair<std::string, std::size_t>> counts;
    std::unordered_map<std::string, std::size_t> index;
    std::unordered_map<std::size_t, std::size_t> with_count;  ///< number of touches -> cycles that have as many
  };
  void markKey(const std::string& key);
  void judgeCycle(const std::string& artefact, const Cycles& cycles, std::size_t cycle);

  const PlanIndex& plan_;
  PlanCaptures captures_;
  std::unordered_map<std::string, std::vector<std::size_t>> by_key_;  ///< what the lists say of an item -> items
  std::map<PlannedKind, std::set<std::size_t>> open_;
  std::unordered_map<std::string, Cycles> cycles_;  ///< by artefact
};
/// Only what is captured.
[[nodiscard]] std::set<std::string> capturedItems(const MeasurementPlan& plan, const Campaign& campaign);

struct PlanProgress {
  std::size_t done = 0;
  std::optional<std::size_t> next;  ///< first open item, in order; not a cycle that a later one has overtaken
  double countdown_s = 0.0;         ///< until it is due; negative: late
  std::string sentence;             ///< what to do now, or how long to wait
};
/// A state of which something is there has begun, whatever its time. `begun` as in PlanCaptures.
[[nodiscard]] PlanProgress progressOf(const MeasurementPlan& plan, const std::set<std::string>& done, double now_s,
                                      const std::map<std::string, std::size_t>& begun = {});

}  // namespace spindrift
