// SPDX-License-Identifier: Apache-2.0
#include "core/probing/ball_cycle.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/geometry/rigid_transform.h"
#include "core/math/statistics.h"
#include "core/probing/artefact_certificate.h"

namespace spindrift {
namespace {

const ArtefactBall& ballOf(const Artefact& artefact, const std::string& id) {
  const auto found =
      std::find_if(artefact.balls.begin(), artefact.balls.end(), [&](const ArtefactBall& b) { return b.id == id; });
  SPINDRIFT_ASSERT(found != artefact.balls.end(), "touches were checked against the machine");
  return *found;
}

/// Rotation of the artefact in MCF: certified vectors to measured ones (Kabsch), by the first ball.
Eigen::Matrix3d artefactRotation(const std::vector<Eigen::Vector3d>& certified,
                                 const std::vector<Eigen::Vector3d>& measured) {
  Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(certified.size()));
  Eigen::Matrix3Xd to(3, from.cols());
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    from.col(i) = certified[static_cast<std::size_t>(i)];
    to.col(i) = measured[static_cast<std::size_t>(i)];
  }
  if (from.cols() < 3) return Eigen::Matrix3d::Identity();
  return Eigen::umeyama(from, to, false).topLeftCorner<3, 3>();
}

/// Where each ball stands from the first one in MCF, as the touches of all cycles imply it (median, some 0.01 mm): the
/// artefact may be turned in any way. Balls that were not touched: turned as the others are.
std::map<std::string, Eigen::Vector3d> ballArms(const TouchList& list, const MachineDescription& machine,
                                                const Artefact& artefact) {
  std::map<std::string, Eigen::Vector3d> centre;
  for (const ArtefactBall& ball : artefact.balls) {
    std::array<std::vector<double>, 3> implied;
    for (const Touch& t : list.touches) {
      if (t.artefact != artefact.id || t.feature != ball.id) continue;
      const double stand_off = 0.5 * ball.diameter_mm + machine.findStylus(t.stylus)->radius_mm;
      const Eigen::Vector3d at = t.position_mm + stand_off * t.approach;
      for (std::size_t i = 0; i < 3; ++i) implied[i].push_back(at(static_cast<Eigen::Index>(i)));
    }
    if (implied[0].empty()) continue;
    centre[ball.id] = {median(implied[0]), median(implied[1]), median(implied[2])};
  }
  std::vector<Eigen::Vector3d> certified;
  std::vector<Eigen::Vector3d> measured;
  for (const auto& [id, at] : centre) {
    certified.push_back(ballOf(artefact, id).certified_mm);
    measured.push_back(at);
  }
  const Eigen::Matrix3d turn = artefactRotation(certified, measured);
  const auto origin = centre.find(artefact.balls.front().id);
  std::map<std::string, Eigen::Vector3d> arms;
  for (const ArtefactBall& ball : artefact.balls) {
    const auto at = centre.find(ball.id);
    const bool seen = origin != centre.end() && at != centre.end();
    arms[ball.id] = seen ? Eigen::Vector3d(at->second - origin->second) : Eigen::Vector3d(turn * ball.certified_mm);
  }
  return arms;
}

/// What a growth of the artefact that is not known does: an artefact that grows as a whole looks like screws that grow
/// less, all three alike. Empty: it is known, or nothing speaks for any.
std::string unknownGrowth(const Artefact& artefact, const ArtefactCertificate& certificate, const OperatingLog* log,
                          const std::vector<double>& cycle_time_s) {
  const bool logged = temperatureIsLogged(artefact, log);
  if (!certificate.expansion_per_K) {
    if (!logged || cycle_time_s.empty()) return {};
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double time : cycle_time_s) {
      const double temperature = artefactTemperature(artefact, log, time).value_or(low);
      low = std::min(low, temperature);
      high = std::max(high, temperature);
    }
    constexpr double telling_K = 0.5;
    if (!(high - low > telling_K)) return {};
    return fmt::format(
        "{} was up to {:.1f} K warmer in one cycle than in another, but the machine file gives no expansion_um_per_m_K "
        "of it: its own expansion is missing in the expansion of all three screws.",
        artefact.id, high - low);
  }
  const double per_K = *certificate.expansion_per_K * um_per_m_per_unit;
  constexpr double negligible_um_per_m_K = 0.5;
  if (logged || !(std::abs(per_K) > negligible_um_per_m_K)) return {};
  return fmt::format(
      "No temperature of {} was logged (T_{}_degC): with every kelvin it warms, the expansion of all three screws "
      "comes "
      "out {:.1f} µm/m too small, beyond the stated uncertainty.",
      artefact.id, artefact.id, per_K);
}

/// A stylus touches a ball on all sides but the one it comes from, so that its touches on the whole approach away from
/// the spindle: along its offset. One that does not has another offset.
void judgeOffsets(const TouchList& list, const MachineDescription& machine, BallCycleResult& result) {
  constexpr double telling = 0.1;  // of the mean approach: it is zero for a ring of touches without a pole
  constexpr double least_cosine = 0.2;
  for (const Stylus& stylus : machine.styli) {
    Eigen::Vector3d approach = Eigen::Vector3d::Zero();
    double count = 0.0;
    for (const Touch& t : list.touches) {
      if (t.artefact != result.artefact || t.stylus != stylus.id) continue;
      approach += t.approach;
      count += 1.0;
    }
    const double length = stylus.offset_mm.norm();
    if (count == 0.0 || !(length > 0.0)) continue;
    if (length < stylus.radius_mm) {
      result.contradict(fmt::format(
          "The offset of stylus {} is {:.3g} mm long, less than the radius of its ball ({:g} mm): is it in metres?",
          stylus.id, length, stylus.radius_mm));
      continue;
    }
    approach /= count;
    if (approach.norm() < telling || approach.normalized().dot(stylus.offset_mm) > least_cosine * length) continue;
    const Eigen::Vector3d way = approach.normalized();
    result.contradict(fmt::format(
        "Stylus {} touched on the whole along ({:.1f}, {:.1f}, {:.1f}), but its offset ({:g}, {:g}, {:g}) mm does not "
        "point there: is a sign wrong, or are two styli swapped? Head tilt and drift of the spindle depend on it.",
        stylus.id, way.x(), way.y(), way.z(), stylus.offset_mm.x(), stylus.offset_mm.y(), stylus.offset_mm.z()));
  }
}

}  // namespace

const std::vector<std::string>& ballParameterNames() {
  static const std::vector<std::string> names{"hX_urad", "hY_urad",     "hZ_urad",     "aX_urad",
                                              "aY_urad", "aZ_urad",     "dX_um",       "dY_um",
                                              "dZ_um",   "gX_um_per_m", "gY_um_per_m", "gZ_um_per_m"};
  return names;
}

Eigen::Matrix<double, 3, 12> ballDeviationJacobian(const Eigen::Vector3d& tip_mm, const Eigen::Vector3d& offset_mm,
                                                   const Eigen::Vector3d& fixed_bearing_mm) {
  Eigen::Matrix<double, 3, 12> J;
  J.block<3, 3>(0, 0) = -crossMatrix(offset_mm);  // h x offset
  J.block<3, 3>(0, 3) = -crossMatrix(tip_mm);     // a x tip
  J.block<3, 3>(0, 6).setIdentity();
  J.block<3, 3>(0, 9) = (tip_mm - offset_mm - fixed_bearing_mm).asDiagonal();
  return J;
}

BallCycleResult evaluateBallCycles(const TouchList& list, const MachineDescription& machine, const Artefact& artefact,
                                   const OperatingLog* log, const BallCycleOptions& options) {
  if (artefact.kind != "balls") {
    throw InputError({machine.file, fmt::format("artefact {}", artefact.id)},
                     "is not a ball artefact; allowed here: kind \"balls\".");
  }
  BallCycleResult result;
  std::vector<std::string> without_bearing;
  for (int k = 0; k < 3; ++k) {
    const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[k]));
    if (axis != nullptr && axis->fixed_bearing_mm) {
      result.fixed_bearing_mm(k) = *axis->fixed_bearing_mm;
    } else {
      without_bearing.emplace_back(1, "XYZ"[k]);
    }
  }
  if (!without_bearing.empty()) {
    result.warnings.push_back(fmt::format(
        "The machine file gives no fixed bearing for {}; screw expansion is counted from 0 mm there, which shifts the "
        "spindle drift by the expansion times the distance to the real bearing.",
        joinedList(without_bearing)));
  }
  // Growth of the artefact itself moves the balls; taken off beforehand, from the first ball, along the artefact as it
  // lies in the machine.
  TouchList corrected = list;
  const ArtefactCertificate certificate = ArtefactCertificate::of(machine, artefact);
  const double alpha = certificate.expansion_per_K.value_or(0.0);
  double first_time = 0.0;
  for (const Touch& t : list.touches) {
    if (t.artefact == artefact.id) {
      first_time = t.time_s;
      break;
    }
  }
  const auto first_temperature = artefactTemperature(artefact, log, first_time);
  const bool grows = alpha != 0.0 && first_temperature.has_value();
  const std::map<std::string, Eigen::Vector3d> arm_mm =
      grows ? ballArms(list, machine, artefact) : std::map<std::string, Eigen::Vector3d>{};
  if (grows) {
    for (Touch& t : corrected.touches) {
      if (t.artefact != artefact.id) continue;
      const double warmer = *artefactTemperature(artefact, log, t.time_s) - *first_temperature;
      t.position_mm -= alpha * warmer * arm_mm.at(t.feature);
    }
  }

  CycleAssembly assembly;
  assembly.kind = FeatureKind::Sphere;
  assembly.names = ballParameterNames();
  assembly.unit = {urad_per_rad, urad_per_rad, urad_per_rad, urad_per_rad,      urad_per_rad,      urad_per_rad,
                   um_per_mm,    um_per_mm,    um_per_mm,    um_per_m_per_unit, um_per_m_per_unit, um_per_m_per_unit};
  assembly.fit = options.fit;
  assembly.misplaced_mm = options.misplaced_mm;
  assembly.features = featureNames(artefact);
  assembly.jacobian = [&](const Touch& t, const Eigen::Vector3d&) -> Eigen::MatrixXd {
    return ballDeviationJacobian(t.position_mm, machine.findStylus(t.stylus)->offset_mm, result.fixed_bearing_mm);
  };
  assembly.radius = [&](const std::string& feature, const std::string& stylus) -> std::optional<double> {
    return 0.5 * ballOf(artefact, feature).diameter_mm + machine.findStylus(stylus)->radius_mm;
  };
  evaluateCycles(corrected, machine, artefact, assembly, result);
  judgeOffsets(list, machine, result);

  ArtefactGrowth growth;
  if (grows) {
    growth = artefactGrowth(certificate, artefact, log, result.cycle_time_s);
    double largest = 0.0;
    for (const double temperature : growth.temperature_degC)
      largest = std::max(largest, std::abs(alpha * (temperature - certificate.reference_degC)));
    for (const double strain : growth.strain) largest = std::max(largest, std::abs(strain));
    if (std::string warning = certificate.takenAsExact(artefact.id, largest); !warning.empty())
      result.warnings.push_back(std::move(warning));
    addGrowthUncertainty(corrected, growth.factors, arm_mm, result);
  }
  if (std::string warning = unknownGrowth(artefact, certificate, log, result.cycle_time_s); !warning.empty())
    result.warnings.push_back(std::move(warning));

  std::vector<std::optional<double>> temperature_degC;
  for (const double time : result.cycle_time_s) temperature_degC.push_back(artefactTemperature(artefact, log, time));
  for (std::string& warning : certificate.notCorrected(artefact.id, temperature_degC))
    result.warnings.push_back(std::move(warning));

  // (13): distances against the certificate, with the artefact as warm as it is.
  const double certificate_um = artefact.certificate_uncertainty_um.value_or(0.0);
  std::map<std::pair<std::string, std::string>, std::vector<const ProbedFeature*>> of_cycle;
  for (const ProbedFeature& f : result.features) {
    if (f.status == FitStatus::Converged) of_cycle[{f.cycle, f.stylus}].push_back(&f);
  }
  double worst_mm = 0.0;
  std::string worst_pair;
  for (const std::string& cycle : result.cycles) {
    for (const Stylus& stylus : machine.styli) {
      const auto found = of_cycle.find({cycle, stylus.id});
      if (found == of_cycle.end()) continue;
      std::vector<Eigen::Vector3d> certified;
      std::vector<Eigen::Vector3d> measured;
      for (const ProbedFeature* f : found->second) {
        // Ball centres as measured: the growth of the artefact since the first cycle was taken off above.
        certified.push_back(ballOf(artefact, f->feature).certified_mm);
        measured.push_back(f->centre_mm);
      }
      const Eigen::Matrix3d turn = artefactRotation(certified, measured);
      for (std::size_t a = 0; a < found->second.size(); ++a) {
        for (std::size_t b = a + 1; b < found->second.size(); ++b) {
          const ProbedFeature& fa = *found->second[a];
          const ProbedFeature& fb = *found->second[b];
          BallDistance d;
          d.cycle = cycle;
          d.stylus = stylus.id;
          d.from = fa.feature;
          d.to = fb.feature;
          const Eigen::Vector3d v = fb.centre_mm - fa.centre_mm;
          double stretch = 1.0;
          if (grows) stretch += alpha * (*first_temperature - certificate.reference_degC);
          const Eigen::Vector3d w = stretch * (certified[b] - certified[a]);
          d.measured_mm = v.norm();
          d.certified_mm = w.norm();
          d.error_um = (d.measured_mm - d.certified_mm) * um_per_mm;
          d.components_um = (v - turn * w) * um_per_mm;
          const Eigen::Vector3d e = v.normalized();
          const double touches = e.dot((fa.covariance + fb.covariance) * e) * um_per_mm * um_per_mm;
          // The whole way from the reference temperature to that of this cycle is the artefact's.
          double expansion = 0.0;
          if (grows) {
            const auto k = static_cast<std::size_t>(std::find(result.cycles.begin(), result.cycles.end(), cycle) -
                                                    result.cycles.begin());
            const double warmer = growth.temperature_degC[k] - certificate.reference_degC;
            expansion = (std::pow(warmer * certificate.expansion_sigma_per_K, 2) +
                         std::pow(alpha * certificate.temperature_sigma_K, 2)) *
                        std::pow(d.certified_mm * um_per_mm, 2);
          }
          d.standard_uncertainty_um = std::sqrt(touches + 2.0 * certificate_um * certificate_um + expansion);
          if (std::abs(d.measured_mm - d.certified_mm) > worst_mm) {
            worst_mm = std::abs(d.measured_mm - d.certified_mm);
            worst_pair = fmt::format("{} to {} in {}", d.from, d.to, cycle);
          }
          result.distances.push_back(d);
        }
      }
    }
  }
  if (worst_mm > 2.0) {
    result.contradict(
        fmt::format("Distance {} differs from the certificate by {:.2f} mm: are balls swapped or is this another "
                    "artefact?",
                    worst_pair, worst_mm));
  }
  return result;
}

}  // namespace spindrift
