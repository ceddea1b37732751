// SPDX-License-Identifier: Apache-2.0
#include "core/probing/probe_health.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"

namespace spindrift {
namespace {

StylusHealth check(const TouchList& list, const std::vector<std::size_t>& indices, double ball_diameter_mm,
                   double stylus_radius_mm, const ProbeHealthOptions& options) {
  StylusHealth health;
  health.stylus = list.touches[indices.front()].stylus;
  health.feature = list.touches[indices.front()].feature;
  // Passes: the sphere may have moved between cycles (thermal drift), so every pass has its own centre and all share
  // one stand-off.
  std::vector<std::string> passes;
  std::map<std::string, std::vector<std::size_t>> of_pass;
  for (const std::size_t i : indices) {
    const std::string& pass = list.touches[i].cycle;
    if (of_pass[pass].empty()) passes.push_back(pass);
    of_pass[pass].push_back(i);
  }
  std::vector<Eigen::Vector3d> points;
  for (const std::size_t i : of_pass[passes.front()]) points.push_back(list.touches[i].position_mm);
  const SphereFit first = fitSphere(points, {});
  if (!first.usable() || points.size() < 5) {
    health.status = FitStatus::Degenerate;
    health.message = points.size() < 5
                         ? fmt::format("{} touches are too few to qualify a stylus; allowed: at least 5", points.size())
                         : first.message;
    return health;
  }
  std::map<std::string, Eigen::Vector3d> centre;
  double radius = 0.0;
  for (const std::string& pass : passes) {
    points.clear();
    for (const std::size_t i : of_pass[pass]) points.push_back(list.touches[i].position_mm);
    const SphereFit fit = fitSphere(points, {});
    if (!fit.usable()) {
      health.status = FitStatus::Degenerate;
      health.message = fmt::format("pass {}: {}", pass, fit.message);
      return health;
    }
    centre[pass] = fit.centre_mm;
    radius += fit.radius_mm / static_cast<double>(passes.size());
  }
  health.centre_mm = centre[passes.front()];
  // Directions: greedy groups of touches from the same side.
  struct Direction {
    Eigen::Vector3d approach;
    std::vector<double> stand_off;
  };
  std::vector<Direction> directions;
  const double near_enough = std::cos(options.same_direction_deg * rad_per_deg);
  for (const std::size_t i : indices) {
    const Touch& t = list.touches[i];
    Direction* group = nullptr;
    for (Direction& d : directions) {
      if (d.approach.dot(t.approach) > near_enough) group = &d;
    }
    if (group == nullptr) {
      directions.push_back({t.approach, {}});
      group = &directions.back();
    }
    group->stand_off.push_back((t.position_mm - centre[t.cycle]).norm());
  }
  double squares = 0.0;
  double worst = 0.0;
  double low = 0.0;
  double high = 0.0;
  for (const Direction& d : directions) {
    PreTravel p;
    p.approach = d.approach;
    p.touches = static_cast<int>(d.stand_off.size());
    double mean = 0.0;
    for (const double s : d.stand_off) mean += s / p.touches;
    p.pre_travel_um = (radius - mean) * um_per_mm;
    double own = 0.0;
    for (const double s : d.stand_off) own += (s - mean) * (s - mean) * um_per_mm * um_per_mm;
    if (p.touches > 1) {
      p.repeatability_um = std::sqrt(own / (p.touches - 1));
      squares += own;
      health.repeatability_dof += p.touches - 1;
      if (p.repeatability_um > worst) {
        worst = p.repeatability_um;
        health.loose_direction = d.approach;
      }
    }
    low = std::min(low, p.pre_travel_um);
    high = std::max(high, p.pre_travel_um);
    health.directions.push_back(p);
  }
  if (health.repeatability_dof > 0) health.repeatability_um = std::sqrt(squares / health.repeatability_dof);
  const double noise = health.repeatability_dof > 0 ? health.repeatability_um : options.healthy_sigma_um;
  for (PreTravel& p : health.directions) p.standard_uncertainty_um = noise / std::sqrt(double(p.touches));
  health.pre_travel_range_um = high - low;
  health.effective_radius_mm = radius - 0.5 * ball_diameter_mm;
  health.effective_radius_sigma_mm = noise * mm_per_um / std::sqrt(static_cast<double>(indices.size()));
  Eigen::Vector3d step_direction = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k < passes.size(); ++k) {
    const Eigen::Vector3d step = (centre[passes[k]] - centre[passes[k - 1]]) * um_per_mm;
    if (step.norm() > health.largest_step_um) {
      health.largest_step_um = step.norm();
      step_direction = step.normalized();
    }
  }
  const double limit = options.loose_factor * options.healthy_sigma_um;
  const bool scatters = worst > limit;
  const bool steps = health.largest_step_um > 2.0 * limit;
  if (steps && !scatters) health.loose_direction = step_direction;
  health.loose = scatters || steps;
  health.healthy =
      !health.loose && (health.repeatability_dof == 0 || health.repeatability_um <= options.healthy_sigma_um);
  health.status = FitStatus::Converged;
  if (health.loose) {
    health.message =
        fmt::format("stylus {} is loose or bent: {} along ({:.2f}, {:.2f}, {:.2f})", health.stylus,
                    scatters ? fmt::format("touches scatter by {:.1f} um", worst)
                             : fmt::format("the sphere moved by {:.1f} um between passes", health.largest_step_um),
                    health.loose_direction.x(), health.loose_direction.y(), health.loose_direction.z());
  } else if (!health.healthy) {
    health.message = fmt::format("stylus {} repeats to {:.2f} um only; a healthy probe keeps {:.2f} um", health.stylus,
                                 health.repeatability_um, options.healthy_sigma_um);
  } else {
    health.message = fmt::format("stylus {} is in order", health.stylus);
  }
  if (std::abs(health.effective_radius_mm - stylus_radius_mm) > 0.1) {
    health.healthy = false;
    health.message += fmt::format("; its effective radius {:.4f} mm is far from {:.4f} mm of the machine file",
                                  health.effective_radius_mm, stylus_radius_mm);
  }
  return health;
}

}  // namespace

std::vector<StylusHealth> checkProbeHealth(const TouchList& list, const MachineDescription& machine,
                                           const ProbeHealthOptions& options) {
  list.checkAgainst(machine);
  std::vector<std::pair<std::string, std::string>> order;
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> groups;
  std::map<std::pair<std::string, std::string>, double> diameter;
  for (std::size_t i = 0; i < list.touches.size(); ++i) {
    const Touch& t = list.touches[i];
    const Artefact& artefact = *machine.findArtefact(t.artefact);
    if (artefact.kind != "balls") continue;
    const std::pair<std::string, std::string> key{t.stylus, t.feature};
    if (groups[key].empty()) order.push_back(key);
    groups[key].push_back(i);
    for (const ArtefactBall& ball : artefact.balls) {
      if (ball.id == t.feature) diameter[key] = ball.diameter_mm;
    }
  }
  if (order.empty()) {
    throw InputError({list.file, ""}, "holds no touches on a sphere; allowed: touches of an artefact of kind balls.");
  }
  std::vector<StylusHealth> result;
  for (const auto& key : order) {
    result.push_back(check(list, groups[key], diameter[key], machine.findStylus(key.first)->radius_mm, options));
  }
  return result;
}

}  // namespace spindrift
