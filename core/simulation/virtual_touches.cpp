// SPDX-License-Identifier: Apache-2.0
// Touches of a probe on a hole bar or on balls. The tip is where it was told to be plus the deviation; it triggers
// where its surface meets the artefact, and the control notes the commanded position.
#include <cmath>
#include <optional>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/simulation/virtual_campaign.h"

namespace spindrift {
namespace {

/// A surface that a touch can meet.
struct TouchTarget {
  enum class Kind { Hole, Ball, Plane } kind = Kind::Ball;
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0.0;
};

class Prober {
 public:
  Prober(const VirtualMachine& plant, const TouchOptions& options, const PlantEffectSettings& settings,
         std::uint64_t seed)
      : plant_(plant), options_(options), random_(seed), clock_s_(0.0) {
    for (const auto& [id, setting] : settings) functions_.push_back({setting.size, plant.effect(id, setting)});
  }

  void start(double time_s) { clock_s_ = std::max(clock_s_, time_s); }
  /// Where the table carries the artefact that is touched next.
  void heldAt(const Eigen::Vector3d& place_mm) { held_mm_ = place_mm; }
  std::vector<TouchRow>& rows() { return rows_; }

  void touch(TouchRow row, const Stylus& stylus, const TouchTarget& target, const Eigen::Vector3d& start_mm,
             const Eigen::Vector3d& approach) {
    row.time_s = clock_s_;
    clock_s_ += options_.touch_s;
    PlantQuery query{row.time_s, start_mm, row.c_deg * rad_per_deg, approach, stylus.offset_mm, row.feature, held_mm_};
    Eigen::Vector3d commanded = start_mm;
    // The deviation hardly changes over the approach: twice is enough.
    Eigen::Vector3d last_deviation = Eigen::Vector3d::Zero();
    for (int pass = 0; pass < 2; ++pass) {
      query.position_mm = commanded;
      Eigen::Vector3d deviation = Eigen::Vector3d::Zero();
      for (const auto& [size, function] : functions_) deviation += size * function(query).translation_mm;
      last_deviation = deviation;
      const Eigen::Vector3d side = start_mm + deviation - target.centre_mm;
      const Eigen::Vector3d across = side - approach * approach.dot(side);
      double depth = 0.0;  // of the tip's centre along the approach, from the centre of the target
      if (target.kind == TouchTarget::Kind::Plane) {
        depth = -stylus.radius_mm;
      } else if (target.kind == TouchTarget::Kind::Ball) {
        const double reach = target.radius_mm + stylus.radius_mm;
        depth = -std::sqrt(std::max(0.0, reach * reach - across.squaredNorm()));
      } else {
        const double reach = target.radius_mm - stylus.radius_mm;
        const Eigen::Vector2d flat = across.head<2>();
        depth = std::sqrt(std::max(0.0, reach * reach - flat.squaredNorm()));
      }
      const double along = approach.dot(target.centre_mm) + depth - approach.dot(deviation);
      commanded = start_mm + approach * (along - approach.dot(start_mm));
    }
    const double late_mm = (options_.pretravel_um + options_.sigma_um * random_.normal()) * mm_per_um;
    row.position_mm = commanded + approach * late_mm;
    row.deviation_mm = last_deviation;
    for (double& value : row.position_mm) value = std::round(value * 1e6) / 1e6;
    row.stylus = stylus.id;
    row.approach = approach;
    rows_.push_back(row);
  }

 private:
  const VirtualMachine& plant_;
  const TouchOptions& options_;
  Random random_;
  double clock_s_;
  std::optional<Eigen::Vector3d> held_mm_;
  std::vector<std::pair<double, PlantEffectFunction>> functions_;
  std::vector<TouchRow> rows_;
};

void probeHoleBar(Prober& prober, const MachineDescription& machine, const Artefact& bar, const std::string& cycle) {
  if (machine.rotary.empty()) throw InputError("probing a hole bar needs a machine with a rotary axis (rotary).");
  const Stylus& stylus = machine.styli.front();
  const double radius = 0.5 * bar.hole_diameter_mm.value_or(10.0);
  const std::size_t count = bar.nominal_positions_mm.size();
  std::size_t reference = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (bar.reference_hole == "H" + std::to_string(i + 1)) reference = i;
  }
  const auto probe = [&](std::size_t hole, double c_deg) {
    const Eigen::AngleAxisd turn(c_deg * rad_per_deg, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d direction = turn * bar.direction_at_c0;
    const double along = bar.nominal_positions_mm[hole] - bar.nominal_positions_mm[reference];
    // The bar is held at its reference hole: where the table grows it takes that hole along, and stretches nothing.
    const Eigen::Vector3d held = machine.rotary.front().centre_mm + turn * bar.reference_in_table_mm;
    prober.heldAt(held);
    const Eigen::Vector3d surface = held + along * direction;
    TouchRow row;
    row.cycle = cycle;
    row.feature = "H" + std::to_string(hole + 1);
    row.c_deg = c_deg;
    const TouchTarget in_hole{TouchTarget::Kind::Hole, surface, radius};
    const Eigen::Vector3d start = surface - Eigen::Vector3d(0, 0, 3.0);
    for (const Eigen::Vector3d& n :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)}) {
      prober.touch(row, stylus, in_hole, start, n);
      ++row.touch;
    }
    const Eigen::Vector3d beside = surface + (radius + 2.0 * stylus.radius_mm) * direction;
    prober.touch(row, stylus, {TouchTarget::Kind::Plane, surface, 0.0}, beside, Eigen::Vector3d(0, 0, -1));
  };
  for (std::size_t hole = 0; hole < count; ++hole) probe(hole, 0.0);
  probe(reference, 90.0);
  for (const std::size_t hole : {reference, count / 2, count - 1}) probe(hole, 180.0);
  probe(reference, 270.0);
}

void probeBalls(Prober& prober, const MachineDescription& machine, const Artefact& artefact,
                const Eigen::Vector3d& origin_mm, const std::string& cycle) {
  for (const Stylus& stylus : machine.styli) {
    // The stylus points from the spindle to its tip: sideways for the arms of a star, else down the spindle.
    Eigen::Vector3d pointing = -Eigen::Vector3d::UnitZ();
    const Eigen::Vector2d sideways = stylus.offset_mm.head<2>();
    if (sideways.norm() > 1.0) {
      Eigen::Index axis = 0;
      sideways.cwiseAbs().maxCoeff(&axis);
      pointing = Eigen::Vector3d::Unit(axis) * (sideways[axis] > 0.0 ? 1.0 : -1.0);
    }
    for (const ArtefactBall& ball : artefact.balls) {
      const Eigen::Vector3d centre = origin_mm + ball.certified_mm;
      TouchRow row;
      row.cycle = cycle;
      row.feature = ball.id;
      const TouchTarget target{TouchTarget::Kind::Ball, centre, 0.5 * ball.diameter_mm};
      for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
          const Eigen::Vector3d n = sign * Eigen::Vector3d::Unit(axis);
          if (n.dot(pointing) < -0.5) continue;  // the stem is in the way
          prober.touch(row, stylus, target, centre, n);
          ++row.touch;
        }
      }
    }
  }
}

}  // namespace

std::vector<TouchRow> simulateTouches(const VirtualMachine& plant, const TouchOptions& options,
                                      const PlantEffectSettings& settings, std::uint64_t seed) {
  const MachineDescription& machine = plant.machine();
  const Artefact* artefact = machine.findArtefact(options.artefact);
  SPINDRIFT_ASSERT(artefact != nullptr && !machine.styli.empty(), "the scenario was checked for artefact and styli");
  Prober prober(plant, options, settings, seed);
  for (std::size_t i = 0; i < options.times_s.size(); ++i) {
    prober.start(options.times_s[i]);
    const std::string cycle = "M" + std::to_string(i);
    if (artefact->kind == "hole_bar") {
      probeHoleBar(prober, machine, *artefact, cycle);
    } else {
      probeBalls(prober, machine, *artefact, options.origin_mm, cycle);
    }
  }
  return std::move(prober.rows());
}

}  // namespace spindrift
