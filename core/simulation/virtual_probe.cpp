// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/virtual_probe.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/base/units.h"
#include "core/probing/hole_cycle.h"

namespace spindrift {
namespace {

/// Form error of a feature in a direction: the same for the same place in every cycle.
double formError_mm(const VirtualProbeOptions& options, const std::string& feature, const Eigen::Vector3d& direction) {
  if (options.form_error_um == 0.0) return 0.0;
  std::uint64_t hash = options.form_seed * 1099511628211ULL + 14695981039346656037ULL;
  for (const char c : feature) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  for (int k = 0; k < 3; ++k) {
    hash = (hash ^ static_cast<std::uint64_t>(std::lround(direction(k) * 100.0) + 1000)) * 1099511628211ULL;
  }
  return Random(hash).normal(0.0, options.form_error_um) * mm_per_um;
}

double preTravel_mm(const VirtualProbeOptions& options, const Eigen::Vector3d& approach) {
  double travel = options.pre_travel_um;
  if (options.pre_travel_lobing_um != 0.0 && approach.head<2>().norm() > 0.1) {
    travel += options.pre_travel_lobing_um * std::cos(3.0 * std::atan2(approach.y(), approach.x()));
  }
  return travel * mm_per_um;
}

/// Position on the line start + s * approach where `gap` (distance still to go, mm) vanishes.
template <typename Gap>
Eigen::Vector3d trigger(Eigen::Vector3d start, const Eigen::Vector3d& approach, const Gap& gap) {
  // Deviations change by 1e-4 per mm at most, the distance to the surface by one per mm: plain iteration contracts
  // fast.
  for (int i = 0; i < 60; ++i) {
    const double step = gap(start);
    start += step * approach;
    if (std::abs(step) < 1e-13) break;
  }
  return start;
}

}  // namespace

std::vector<Touch> probeHoleBar(const MachineDescription& machine, const Artefact& artefact, const std::string& cycle,
                                double start_s, const TipDeviation& deviation, const VirtualProbeOptions& options,
                                Random& random) {
  const HoleBarSetup setup = HoleBarSetup::of(machine, artefact);
  SPINDRIFT_ASSERT(!machine.styli.empty(), "a probe needs a stylus");
  const Stylus& stylus = machine.styli.front();
  const double diameter = artefact.hole_diameter_mm.value_or(10.0);
  const double stand_off = 0.5 * diameter - stylus.radius_mm;
  SPINDRIFT_ASSERT(stand_off > 0.0, "the stylus must fit into the hole");
  const auto holes = static_cast<int>(setup.along_mm.size());
  const int reference = HoleBarSetup::holeIndex(artefact.reference_hole);
  struct Station {
    int hole;
    double c_deg;
  };
  std::vector<Station> stations;
  for (int h = 0; h < holes; ++h) stations.push_back({h, 0.0});
  stations.push_back({reference, 90.0});
  stations.push_back({reference, 180.0});
  if (holes > 2) stations.push_back({(holes - 1) / 2 == reference ? holes / 2 + 1 : (holes - 1) / 2, 180.0});
  if (holes > 1) stations.push_back({reference == holes - 1 ? 0 : holes - 1, 180.0});
  stations.push_back({reference, 270.0});

  const Eigen::Vector3d axis = setup.rotary_direction;
  Eigen::Vector3d across_a = Eigen::Vector3d::UnitX();
  for (int k = 0; k < 3; ++k) {
    if (std::abs(axis(k)) < 1e-9) {
      across_a = Eigen::Vector3d::Unit(k);
      break;
    }
  }
  const Eigen::Vector3d across_b = axis.cross(across_a);
  std::vector<Touch> touches;
  double time = start_s;
  for (const Station& station : stations) {
    const Eigen::Vector3d centre = setup.nominal_mm(station.hole, station.c_deg);
    const std::string feature = fmt::format("H{}", station.hole + 1);
    const Eigen::Vector3d along = setup.tableRotation(station.c_deg) * setup.direction_at_c0;
    const Eigen::Vector3d directions[] = {across_a, -across_a, across_b, -across_b, -axis};
    for (int k = 0; k < 5; ++k) {
      Touch t;
      t.time_s = time;
      t.cycle = cycle;
      t.artefact = artefact.id;
      t.feature = feature;
      t.stylus = stylus.id;
      t.c_deg = station.c_deg;
      t.touch = k;
      t.approach = directions[k];
      const bool surface = k == 4;
      const double extra = preTravel_mm(options, t.approach) + formError_mm(options, feature, t.approach);
      const auto tip = [&](const Eigen::Vector3d& p) -> Eigen::Vector3d {
        return p + deviation({time, p, stylus.offset_mm, station.c_deg, feature, t.approach});
      };
      if (surface) {
        const Eigen::Vector3d start = centre + options.surface_offset_mm * along + stylus.radius_mm * axis;
        t.position_mm = trigger(start, t.approach,
                                [&](const Eigen::Vector3d& p) { return axis.dot(tip(p) - centre) - stylus.radius_mm; });
      } else {
        t.position_mm = trigger(centre - options.depth_mm * axis, t.approach, [&](const Eigen::Vector3d& p) {
          Eigen::Vector3d d = tip(p) - centre;
          d -= axis * axis.dot(d);
          return stand_off - d.norm() * (d.dot(t.approach) < 0.0 ? -1.0 : 1.0);
        });
      }
      const double noise = surface ? options.surface_noise_um : options.noise_um;
      t.position_mm += (extra + random.normal(0.0, noise) * mm_per_um) * t.approach;
      touches.push_back(t);
      time += options.touch_interval_s;
    }
  }
  return touches;
}

std::vector<Touch> probeBalls(const MachineDescription& machine, const Artefact& artefact, const std::string& cycle,
                              double start_s, const TipDeviation& deviation, const VirtualProbeOptions& options,
                              Random& random) {
  std::vector<Touch> touches;
  double time = start_s;
  for (const ArtefactBall& ball : artefact.balls) {
    const Eigen::Vector3d centre = options.first_ball_mm + ball.certified_mm;
    for (const Stylus& stylus : machine.styli) {
      const double stand_off = 0.5 * ball.diameter_mm + stylus.radius_mm;
      // The shaft leaves the tip towards the spindle: the ball must not be in its way.
      Eigen::Index blocked = 2;
      if (stylus.offset_mm.norm() > 0.0) stylus.offset_mm.cwiseAbs().maxCoeff(&blocked);
      const double blocked_sign = stylus.offset_mm(blocked) < 0.0 ? -1.0 : 1.0;
      int number = 0;
      for (int k = 0; k < 3; ++k) {
        for (const double sign : {-1.0, 1.0}) {
          if (k == blocked && sign == blocked_sign) continue;
          Touch t;
          t.time_s = time;
          t.cycle = cycle;
          t.artefact = artefact.id;
          t.feature = ball.id;
          t.stylus = stylus.id;
          t.touch = number++;
          t.approach = -sign * Eigen::Vector3d::Unit(k);
          const double extra = preTravel_mm(options, t.approach) - formError_mm(options, ball.id, t.approach);
          t.position_mm = trigger(centre - stand_off * t.approach, t.approach, [&](const Eigen::Vector3d& p) {
            const Eigen::Vector3d tip = p + deviation({time, p, stylus.offset_mm, 0.0, ball.id, t.approach});
            return (tip - centre).norm() - stand_off;
          });
          t.position_mm += (extra + random.normal(0.0, options.noise_um) * mm_per_um) * t.approach;
          touches.push_back(t);
          time += options.touch_interval_s;
        }
      }
    }
  }
  return touches;
}

}  // namespace spindrift
