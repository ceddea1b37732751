// SPDX-License-Identifier: Apache-2.0
#include "core/probing/cycle_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/printed_number.h"
#include "core/probing/hole_cycle.h"

namespace spindrift {

void CyclePlanOptions::validate() const {
  const auto positive = [](double v, const char* name) {
    if (!(v > 0.0)) throw InputError(fmt::format("{} {} is not allowed; allowed: greater than zero.", name, v));
  };
  positive(clearance_mm, "clearance_mm");
  positive(retract_mm, "retract_mm");
  positive(overtravel_mm, "overtravel_mm");
  positive(depth_mm, "depth_mm");
  const auto feed = [](double v, const char* name, double most) {
    if (!(v >= least_feed_mm_min && v <= most))
      throw InputError(
          fmt::format("{} {} is not allowed; allowed: {:g} to {:g} mm/min.", name, v, least_feed_mm_min, most));
  };
  feed(touch_feed_mm_min, "touch_feed_mm_min", most_touch_feed_mm_min);
  feed(guarded_feed_mm_min, "guarded_feed_mm_min", most_guarded_feed_mm_min);
  if (!(surface_offset_mm > 0.0 && surface_offset_mm <= most_surface_offset_mm))
    throw InputError(fmt::format("surface_offset_mm {} is not allowed; allowed: greater than zero, at most {:g}.",
                                 surface_offset_mm, most_surface_offset_mm));
  if (!first_ball_mm.allFinite())
    throw InputError("first_ball_mm is not a place; allowed: three finite numbers in mm.");
  if (retract_mm < clearance_mm) throw InputError("retract_mm must not be smaller than clearance_mm.");
}

namespace {

class Planner {
 public:
  Planner(const MachineDescription& machine, CyclePlan& plan) : machine_(machine), plan_(plan) {}

  void stylus(const Stylus& stylus) { stylus_ = &stylus; }
  void angle(double c_deg) { c_deg_ = c_deg; }

  void move(MoveKind kind, const Eigen::Vector3d& tip) {
    PlannedMove m;
    m.kind = kind;
    m.tip_mm = tip;
    m.c_deg = c_deg_;
    m.stylus = stylus_->id;
    add(m);
    tip_ = tip;
  }

  /// To the target and back to where the tip stands.
  void touch(const std::string& feature, int number, const Eigen::Vector3d& approach, const Eigen::Vector3d& target) {
    PlannedMove m;
    m.kind = MoveKind::Touch;
    m.tip_mm = target;
    m.c_deg = c_deg_;
    m.stylus = stylus_->id;
    m.feature = feature;
    m.touch = number;
    m.approach = approach;
    add(m);
    ++plan_.touches;
    move(MoveKind::Retract, tip_);
  }

  [[nodiscard]] const Eigen::Vector3d& tip() const { return tip_; }

 private:
  void add(const PlannedMove& m) {
    const Eigen::Vector3d reference = m.tip_mm - stylus_->offset_mm;
    for (int k = 0; k < 3; ++k) {
      const LinearAxis* axis = machine_.findAxis(std::string(1, "XYZ"[k]));
      if (axis == nullptr) continue;
      const double low = std::min(axis->travel_mm[0], axis->travel_mm[1]);
      const double high = std::max(axis->travel_mm[0], axis->travel_mm[1]);
      if (!(reference(k) >= low && reference(k) <= high)) {
        throw InputError({machine_.file, ""},
                         fmt::format("the cycle would send {} to {:.3f} mm ({}stylus {} at {}°); allowed: {} to {} "
                                     "mm.",
                                     axis->name, printed(reference(k)), m.feature.empty() ? "" : m.feature + ", ",
                                     m.stylus, printed(m.c_deg), printed(low), printed(high)));
      }
    }
    plan_.moves.push_back(m);
  }

  const MachineDescription& machine_;
  CyclePlan& plan_;
  const Stylus* stylus_ = nullptr;
  double c_deg_ = 0.0;
  Eigen::Vector3d tip_ = Eigen::Vector3d::Zero();
};

void planHoles(const MachineDescription& machine, const Artefact& artefact, const CyclePlanOptions& options,
               CyclePlan& plan) {
  const HoleBarSetup setup = HoleBarSetup::of(machine, artefact);
  const auto reject = [&](const std::string& why) {
    throw InputError({machine.file, fmt::format("artefact {}", artefact.id)}, why);
  };
  if (setup.rotary_direction.z() < 0.9) reject("programs need a table that rotates about Z.");
  if (machine.styli.empty()) reject("needs a stylus; allowed: \"styli\" in the machine file.");
  if (!artefact.hole_diameter_mm) reject("needs \"hole_diameter_mm\" to plan touches.");
  const Stylus& stylus = machine.styli.front();
  const double room = 0.5 * *artefact.hole_diameter_mm - stylus.radius_mm;
  if (room < 0.5)
    reject(fmt::format("stylus {} leaves {:.3f} mm of room in the hole; allowed: 0.5 mm.", stylus.id, room));
  // The spindle is wider than any hole: it stays above the bar.
  const double deepest_mm = -stylus.offset_mm.z() - options.clearance_mm;
  if (options.depth_mm > deepest_mm + 1e-9) {
    reject(
        fmt::format("cannot be touched {:g} mm deep: the tip of stylus {} lies {:g} mm below the spindle reference, "
                    "which stays {:g} mm above the bar; allowed: depth_mm up to {:g} mm.",
                    printed(options.depth_mm), stylus.id, printed(-stylus.offset_mm.z()), printed(options.clearance_mm),
                    printed(std::max(0.0, deepest_mm))));
  }
  const double top = setup.nominal_mm(0, 0.0).z();
  plan.safe_height_mm = top + options.retract_mm + stylus.radius_mm;
  const double near_height = top + options.clearance_mm + stylus.radius_mm;
  const int holes = static_cast<int>(setup.along_mm.size());
  const int reference = HoleBarSetup::holeIndex(artefact.reference_hole);
  std::vector<std::pair<int, double>> stations;
  for (int h = 0; h < holes; ++h) stations.emplace_back(h, 0.0);
  stations.emplace_back(reference, 90.0);
  std::vector<int> reversed{reference};
  for (const int h : {(holes - 1) / 2, holes - 1, 0}) {
    if (reversed.size() < 3 && std::find(reversed.begin(), reversed.end(), h) == reversed.end()) reversed.push_back(h);
  }
  for (const int h : reversed) stations.emplace_back(h, 180.0);
  stations.emplace_back(reference, 270.0);
  Planner planner(machine, plan);
  planner.stylus(stylus);
  double angle = std::nan("");
  const auto at = [](const Eigen::Vector3d& p, double z) { return Eigen::Vector3d(p.x(), p.y(), z); };
  for (const auto& [hole, c_deg] : stations) {
    const Eigen::Vector3d centre = setup.nominal_mm(hole, c_deg);
    const std::string feature = fmt::format("H{}", hole + 1);
    if (c_deg != angle) {
      planner.angle(c_deg);
      const Eigen::Vector3d& from = plan.moves.empty() ? centre : planner.tip();
      planner.move(MoveKind::Turn, at(from, plan.safe_height_mm));
      angle = c_deg;
    }
    planner.move(MoveKind::Rapid, at(centre, plan.safe_height_mm));
    planner.move(MoveKind::Guarded, at(centre, near_height));
    planner.move(MoveKind::Guarded, at(centre, top - options.depth_mm));
    int number = 0;
    for (const Eigen::Vector3d& n :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)}) {
      planner.touch(feature, number++, n, at(centre, top - options.depth_mm) + (room + options.overtravel_mm) * n);
    }
    planner.move(MoveKind::Guarded, at(centre, near_height));
    const Eigen::Vector3d beside =
        centre + options.surface_offset_mm * (setup.tableRotation(c_deg) * setup.direction_at_c0);
    planner.move(MoveKind::Guarded, at(beside, near_height));
    planner.touch(feature, number++, -Eigen::Vector3d::UnitZ(),
                  at(beside, top + stylus.radius_mm - options.overtravel_mm));
    planner.move(MoveKind::Rapid, at(beside, plan.safe_height_mm));
  }
  planner.angle(0.0);
  planner.move(MoveKind::Turn, planner.tip());
}

void planBalls(const MachineDescription& machine, const Artefact& artefact, const CyclePlanOptions& options,
               CyclePlan& plan) {
  if (machine.styli.empty()) {
    throw InputError({machine.file, "$.styli"}, "is missing or empty; allowed: at least one stylus.");
  }
  double top = -1e300;
  for (const ArtefactBall& ball : artefact.balls) {
    top = std::max(top, options.first_ball_mm.z() + ball.certified_mm.z() + 0.5 * ball.diameter_mm);
  }
  // All styli hang on one spindle: the lowest of them must clear the highest ball.
  double lowest = 0.0;
  double thickest = 0.0;
  for (const Stylus& s : machine.styli) {
    lowest = std::min(lowest, s.offset_mm.z());
    thickest = std::max(thickest, s.radius_mm);
  }
  plan.safe_height_mm = top + options.retract_mm + thickest;
  const double safe_reference = plan.safe_height_mm - lowest;
  Planner planner(machine, plan);
  for (const ArtefactBall& ball : artefact.balls) {
    const Eigen::Vector3d centre = options.first_ball_mm + ball.certified_mm;
    for (const Stylus& stylus : machine.styli) {
      planner.stylus(stylus);
      const double stand_off = 0.5 * ball.diameter_mm + stylus.radius_mm;
      const double safe = safe_reference + stylus.offset_mm.z();
      Eigen::Index blocked = 2;
      if (stylus.offset_mm.norm() > 0.0) stylus.offset_mm.cwiseAbs().maxCoeff(&blocked);
      const double blocked_sign = stylus.offset_mm(blocked) > 0.0 ? 1.0 : -1.0;
      int number = 0;
      for (int k = 0; k < 3; ++k) {
        for (const double sign : {-1.0, 1.0}) {
          if (k == blocked && sign == blocked_sign) continue;
          const bool below = k == 2 && sign < 0.0;
          if (below && !options.touch_from_below) {
            ++plan.left_out_below;
            continue;
          }
          const Eigen::Vector3d n = -sign * Eigen::Vector3d::Unit(k);
          const Eigen::Vector3d start = centre - (stand_off + options.clearance_mm) * n;
          Eigen::Vector3d down = start;  // where the stylus comes down: beside the ball on the side of its shaft
          if (below) {
            Eigen::Vector3d side = -stylus.offset_mm;
            side.z() = 0.0;
            if (side.norm() > 0.0) side.normalize();
            down = start + (stand_off + options.clearance_mm) * side;
          }
          planner.move(MoveKind::Rapid, Eigen::Vector3d(down.x(), down.y(), safe));
          planner.move(MoveKind::Guarded, down);
          if (below) planner.move(MoveKind::Guarded, start);
          planner.touch(ball.id, number++, n, centre - (stand_off - options.overtravel_mm) * n);
          if (below) planner.move(MoveKind::Guarded, down);
          planner.move(MoveKind::Rapid, Eigen::Vector3d(down.x(), down.y(), safe));
        }
      }
    }
  }
}

}  // namespace

CyclePlan planCycle(const MachineDescription& machine, const Artefact& artefact, const CyclePlanOptions& options) {
  options.validate();
  CyclePlan plan;
  plan.artefact = artefact.id;
  if (artefact.kind == "hole_bar") {
    planHoles(machine, artefact, options, plan);
  } else {
    planBalls(machine, artefact, options, plan);
  }
  return plan;
}

}  // namespace spindrift
