// SPDX-License-Identifier: Apache-2.0
// What to measure when, in what order: the plan that drives capturing. It is kept in the session as JSON:
//   {"format":"spindrift-plan","version":1,"states":[{"name":"M0","due_s":0,"what":"cold"}],
//    "items":[{"id":"M0_F1_focus_2","kind":"image"|"cycle"|"scan","state":"M0","due_s":0,
//              image: "fiducial","role","index","x_mm","y_mm","z_mm","spindle_deg"; cycle, scan: "artefact"; scan:
//              "y_mm", cycle: "touches" (how many make it complete; may be absent)}]}
// Times in s since the campaign start, positions mm, spindle_deg as in captures/fiducials.csv.
#pragma once

#include <Eigen/Core>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/json_reader.h"
#include "core/machine/campaign.h"

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
  [[nodiscard]] const PlannedItem* find(const std::string& id) const;
  /// The item whose id stands in a file's name (letters in any case, longest id first); null if none does.
  [[nodiscard]] const PlannedItem* ofName(const std::string& file_name) const;
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

/// What the capture lists of a campaign folder hold of a plan.
struct PlanCaptures {
  std::set<std::string> done;
  std::map<std::string, std::size_t> begun;  ///< cycles that are not complete -> their touches so far
};

/// An image or a scan is captured when it is listed. A cycle is captured when it has as many touches as the first cycle
/// of its artefact; the first one itself when it has as many as planned, or as another cycle (a programme of its own
/// may have fewer); where no number is planned, when another cycle has begun. Lists that cannot be read count as empty.
[[nodiscard]] PlanCaptures planCaptures(const MeasurementPlan& plan, const Campaign& campaign);
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
