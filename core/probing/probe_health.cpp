// SPDX-License-Identifier: Apache-2.0
#include "core/probing/probe_health.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// Centre of a sphere over the passes.
struct Track {
  std::vector<std::string> passes;
  std::vector<double> time_s;
  std::vector<Eigen::Vector3d> centre_um;
  bool scatters = false;
};

/// Distance of a touch from the centre of its pass, beyond the radius.
struct StandOff {
  std::size_t direction = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double value_um = 0.0;
};

/// What is left of stand-offs beside a mean of every direction and a centre of every pass.
struct Scatter {
  struct OfDirection {
    double squares_um2 = 0.0;
    double degrees_of_freedom = 0.0;  ///< expected squares, per variance of a touch
  };
  std::vector<OfDirection> directions;
  double squares_um2 = 0.0;
  int degrees_of_freedom = 0;
};

/// One least-squares fit of means and centres, the centres of each pass eliminated first: linear in the passes.
Scatter scatterOf(const std::vector<std::vector<StandOff>>& passes, std::size_t directions) {
  const auto count = static_cast<Eigen::Index>(directions);
  struct Pass {
    Eigen::MatrixXd free;   ///< takes out what a centre can follow
    Eigen::MatrixXd means;  ///< of which direction each touch is, the centre taken out
    Eigen::VectorXd left;
  };
  std::vector<Pass> eliminated;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  Eigen::Index free = 0;
  for (const std::vector<StandOff>& touches : passes) {
    const auto n = static_cast<Eigen::Index>(touches.size());
    Eigen::MatrixXd normals(n, 3);
    Eigen::MatrixXd means = Eigen::MatrixXd::Zero(n, count);
    Eigen::VectorXd value(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const StandOff& s = touches[static_cast<std::size_t>(i)];
      normals.row(i) = s.normal;
      means(i, static_cast<Eigen::Index>(s.direction)) = 1.0;
      value[i] = s.value_um;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(normals);
    const Eigen::MatrixXd centre = Eigen::MatrixXd(qr.householderQ()).leftCols(qr.rank());
    Pass pass;
    pass.free = Eigen::MatrixXd::Identity(n, n) - centre * centre.transpose();
    pass.means = pass.free * means;
    pass.left = pass.free * value;
    normal += pass.means.transpose() * pass.means;
    right += pass.means.transpose() * pass.left;
    free += n - qr.rank();
    eliminated.push_back(std::move(pass));
  }
  // Means of all directions can follow a centre that all passes share: what the eigenvalues leave is known.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normal);
  const double largest = std::max(1.0, eigen.eigenvalues().maxCoeff());
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (eigen.eigenvalues()[k] < 1e-6 * largest) continue;
    inverse[k] = 1.0 / eigen.eigenvalues()[k];
    --free;
  }
  const Eigen::MatrixXd covariance = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  const Eigen::VectorXd mean = covariance * right;
  Scatter out;
  out.directions.resize(directions);
  out.degrees_of_freedom = static_cast<int>(std::max<Eigen::Index>(0, free));
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const Pass& pass = eliminated[k];
    const Eigen::VectorXd left = pass.left - pass.means * mean;
    const Eigen::MatrixXd of_means = pass.means * covariance;
    for (Eigen::Index i = 0; i < left.size(); ++i) {
      Scatter::OfDirection& own = out.directions[passes[k][static_cast<std::size_t>(i)].direction];
      own.squares_um2 += left[i] * left[i];
      own.degrees_of_freedom += std::max(0.0, pass.free(i, i) - of_means.row(i).dot(pass.means.row(i)));
    }
    out.squares_um2 += left.squaredNorm();
  }
  return out;
}

/// Centre and radius take from the pre-travels what looks like a shift or another size, as if they were of one scatter
/// (empirical Bayes): what is seen of them are the residuals of D directions about four parameters.
void setUncertainties(std::vector<PreTravel>& directions, double noise_um) {
  const auto count = static_cast<Eigen::Index>(directions.size());
  Eigen::MatrixXd A(count, 4);
  double seen = 0.0;
  double of_noise = 0.0;
  for (Eigen::Index d = 0; d < count; ++d) {
    const PreTravel& p = directions[static_cast<std::size_t>(d)];
    A.row(d) << p.approach.transpose(), 1.0;
    seen += p.pre_travel_um * p.pre_travel_um;
    of_noise += noise_um * noise_um / p.touches / static_cast<double>(count);
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  const Eigen::MatrixXd basis = Eigen::MatrixXd(qr.householderQ()).leftCols(qr.rank());
  const auto free = static_cast<double>(count - qr.rank());
  for (Eigen::Index d = 0; d < count; ++d) {
    PreTravel& p = directions[static_cast<std::size_t>(d)];
    if (free < 2.0) {
      p.standard_uncertainty_um = std::nan("");
      continue;
    }
    const double lobes = std::max(0.0, seen / free - of_noise);
    const double taken = basis.row(d).squaredNorm();
    p.standard_uncertainty_um = std::sqrt(noise_um * noise_um / p.touches + lobes * taken);
  }
}

StylusHealth check(const TouchList& list, const std::vector<std::size_t>& indices, double ball_diameter_mm,
                   double stylus_radius_mm, const ProbeHealthOptions& options, Track& track) {
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
    health.message = points.size() < 5 ? fmt::format("{} too few to qualify a stylus; allowed: at least 5",
                                                     countOf(points.size(), "touch is", "touches are"))
                                       : first.message;
    return health;
  }
  std::map<std::string, Eigen::Vector3d> centre;
  double radius = 0.0;
  double radius_variance = 0.0;  // of a touch with a variance of 1
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
    // Beside the centre: touches of one side tell its distance and the radius together.
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector4d row = ((point - fit.centre_mm).normalized()).homogeneous();
      normal += row * row.transpose();
    }
    radius_variance += normal.ldlt().solve(Eigen::Vector4d::UnitW())[3] / std::pow(double(passes.size()), 2);
  }
  health.centre_mm = centre[passes.front()];
  // Directions: greedy groups of touches from the same side.
  struct Direction {
    Eigen::Vector3d approach;
    std::vector<double> stand_off;
  };
  std::vector<Direction> directions;
  std::map<std::size_t, std::size_t> direction_of;  // of every touch
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
    direction_of[i] = static_cast<std::size_t>(group - directions.data());
    group->stand_off.push_back((t.position_mm - centre[t.cycle]).norm());
  }
  double worst = 0.0;
  double low = 0.0;
  double high = 0.0;
  std::vector<std::vector<StandOff>> stand_offs;
  for (const std::string& pass : passes) {
    stand_offs.emplace_back();
    for (const std::size_t i : of_pass[pass]) {
      const Eigen::Vector3d from_centre = list.touches[i].position_mm - centre[pass];
      // Beside the radius: a centre that is off by a micrometre turns a normal, and with it what is taken of the
      // radius.
      stand_offs.back().push_back(
          {direction_of[i], from_centre.normalized(), (from_centre.norm() - radius) * um_per_mm});
    }
  }
  const Scatter scatter = scatterOf(stand_offs, directions.size());
  for (const Direction& d : directions) {
    PreTravel p;
    p.approach = d.approach;
    p.touches = static_cast<int>(d.stand_off.size());
    double mean = 0.0;
    for (const double s : d.stand_off) mean += s / p.touches;
    p.pre_travel_um = (radius - mean) * um_per_mm;
    const Scatter::OfDirection& own = scatter.directions[health.directions.size()];
    constexpr double least_free = 0.5;  // below, the centres have taken it all
    if (own.degrees_of_freedom > least_free) {
      p.repeatability_um = std::sqrt(own.squares_um2 / own.degrees_of_freedom);
      if (p.repeatability_um > worst) {
        worst = p.repeatability_um;
        health.loose_direction = d.approach;
      }
    }
    low = std::min(low, p.pre_travel_um);
    high = std::max(high, p.pre_travel_um);
    health.directions.push_back(p);
  }
  health.repeatability_dof = scatter.degrees_of_freedom;
  if (health.repeatability_dof > 0) health.repeatability_um = std::sqrt(scatter.squares_um2 / health.repeatability_dof);
  const double noise = health.repeatability_dof > 0 ? health.repeatability_um : options.healthy_sigma_um;
  setUncertainties(health.directions, noise);
  health.pre_travel_range_um = high - low;
  health.effective_radius_mm = radius - 0.5 * ball_diameter_mm;
  health.effective_radius_sigma_mm = noise * mm_per_um * std::sqrt(radius_variance);
  for (std::size_t k = 0; k < passes.size(); ++k) {
    double time = 0.0;
    for (const std::size_t i : of_pass[passes[k]]) time += list.touches[i].time_s;
    track.passes.push_back(passes[k]);
    track.time_s.push_back(time / static_cast<double>(of_pass[passes[k]].size()));
    track.centre_um.emplace_back(centre[passes[k]] * um_per_mm);
    if (k == 0) continue;
    health.largest_step_um =
        std::max(health.largest_step_um, (centre[passes[k]] - centre[passes[k - 1]]).norm() * um_per_mm);
  }
  track.scatters = worst > options.loose_factor * options.healthy_sigma_um;
  health.status = FitStatus::Converged;
  if (std::abs(health.effective_radius_mm - stylus_radius_mm) > 0.1) {
    health.message = fmt::format("; its effective radius {:.4f} mm is far from {:.4f} mm of the machine file",
                                 health.effective_radius_mm, stylus_radius_mm);
  } else {
    health.message.clear();
  }
  return health;
}

/// What the track does beyond all styli on the same sphere (median over three or more, which one bad stylus cannot
/// pull; the other one of two). Empty if there is nothing to compare with.
std::vector<Eigen::Vector3d> ownMovement(const Track& track, const std::vector<const Track*>& others) {
  if (others.empty()) return {};
  std::vector<Eigen::Vector3d> own = track.centre_um;
  for (std::size_t k = 0; k < own.size(); ++k) {
    std::vector<Eigen::Vector3d> moves;
    if (others.size() > 1) moves.emplace_back(track.centre_um[k] - track.centre_um.front());
    for (const Track* other : others) {
      const auto at = std::find(other->passes.begin(), other->passes.end(), track.passes[k]);
      if (at == other->passes.end()) return {};
      moves.emplace_back(other->centre_um[static_cast<std::size_t>(at - other->passes.begin())] -
                         other->centre_um.front());
    }
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const Eigen::Vector3d& m : moves) values.push_back(m(axis));
      own[k](axis) -= median(values);
    }
  }
  return own;
}

std::string alongText(const Eigen::Vector3d& d) {
  return fmt::format("along ({:.2f}, {:.2f}, {:.2f})", d.x(), d.y(), d.z());
}

void judgeStylus(StylusHealth& health, const Track& track, const std::vector<const Track*>& others,
                 const ProbeHealthOptions& options) {
  const std::string other_findings = health.message;
  const double limit = options.loose_factor * options.healthy_sigma_um;
  const double noise = health.repeatability_dof > 0 ? health.repeatability_um : options.healthy_sigma_um;
  // A centre from six touches is known to about half the noise of one; the difference of two styli is a little worse.
  health.movement = judgeMovement(track.time_s, track.centre_um, 0.7 * noise, 2.0 * limit);
  if (const std::vector<Eigen::Vector3d> own = ownMovement(track, others); !own.empty()) {
    const StylusMovement beside = judgeMovement(track.time_s, own, 0.7 * noise, 2.0 * limit);
    // Two styli that disagree accuse each other; which one it is only its own course says.
    if (others.size() > 1 || beside.kind == MovementKind::Still) {
      health.compared = true;
      health.movement = beside;
    }
  }
  const MovementKind kind = health.movement.kind;
  const bool moves = kind == MovementKind::Jump || kind == MovementKind::Scatter;
  if (moves && !track.scatters) health.loose_direction = health.movement.direction;
  health.loose = track.scatters || moves;
  health.healthy = !health.loose && kind != MovementKind::Undecided && other_findings.empty() &&
                   health.repeatability_dof > 0 && health.repeatability_um <= options.healthy_sigma_um;
  double worst = 0.0;
  for (const PreTravel& p : health.directions) worst = std::max(worst, p.repeatability_um);
  if (track.scatters) {
    health.message = fmt::format("stylus {} is loose or bent: touches scatter by {:.1f} µm {}", health.stylus, worst,
                                 alongText(health.loose_direction));
  } else if (kind == MovementKind::Jump) {
    health.message = fmt::format("stylus {} is loose or bent: it jumped by {:.1f} µm {} after {}, unlike thermal drift",
                                 health.stylus, health.movement.jump_um, alongText(health.loose_direction),
                                 track.passes[static_cast<std::size_t>(health.movement.jump_after)]);
  } else if (kind == MovementKind::Scatter) {
    health.message = fmt::format(
        "stylus {} is loose or bent: the sphere's centre scatters by {:.1f} µm from pass to pass, unlike thermal drift",
        health.stylus, health.movement.scatter_um);
  } else if (kind == MovementKind::Undecided) {
    health.message = fmt::format(
        "stylus {} sees the sphere move by {:.1f} µm; {} passes do not distinguish a loose stylus from thermal drift: "
        "touch the sphere in more passes (five or more), or several times in one",
        health.stylus, health.movement.largest_um, track.passes.size());
  } else if (health.repeatability_dof == 0) {
    health.message = fmt::format(
        "stylus {} cannot be judged: no touch repeats another; touch the sphere again, in one pass or in several",
        health.stylus);
  } else if (health.repeatability_um > options.healthy_sigma_um) {
    health.message = fmt::format("stylus {} repeats to {:.2f} µm only; a healthy probe keeps {:.2f} µm", health.stylus,
                                 health.repeatability_um, options.healthy_sigma_um);
  } else {
    health.message = fmt::format("stylus {} is within specification", health.stylus);
    if (kind == MovementKind::Warming) {
      health.message += "; the sphere moves smoothly from pass to pass, as thermal drift does";
    } else if (health.compared && health.largest_step_um > 2.0 * limit) {
      health.message += "; all styli see the sphere move alike, as thermal drift does";
    }
  }
  health.message += other_findings;
}

}  // namespace

void ProbeHealthOptions::validate() const {
  if (!(healthy_sigma_um > 0.0) || !std::isfinite(healthy_sigma_um))
    throw InputError(
        fmt::format("a sound probe cannot repeat to {:g} µm; allowed: a positive number.", healthy_sigma_um));
}

std::vector<StylusHealth> checkProbeHealth(const TouchList& list, const MachineDescription& machine,
                                           const ProbeHealthOptions& options) {
  options.validate();
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
  std::vector<Track> tracks(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double radius = machine.findStylus(order[i].first)->radius_mm;
    result.push_back(check(list, groups[order[i]], diameter[order[i]], radius, options, tracks[i]));
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (result[i].status != FitStatus::Converged) continue;
    // Styli that scatter themselves are no witnesses.
    std::vector<const Track*> others;
    for (std::size_t j = 0; j < order.size(); ++j) {
      const bool same_sphere = j != i && order[j].second == order[i].second;
      if (same_sphere && result[j].status == FitStatus::Converged && !tracks[j].scatters) others.push_back(&tracks[j]);
    }
    judgeStylus(result[i], tracks[i], others, options);
  }
  return result;
}

}  // namespace spindrift
