// SPDX-License-Identifier: Apache-2.0
#include "core/probing/hole_cycle.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/units.h"
#include "core/math/least_squares.h"
#include "core/math/statistics.h"
#include "core/probing/artefact_certificate.h"
#include "core/probing/stylus_movement.h"

namespace spindrift {
namespace {

/// Index of the machine direction (0, 1, 2) that a vector lies along best.
int mainAxis(const Eigen::Vector3d& v) {
  Eigen::Index k = 0;
  v.cwiseAbs().maxCoeff(&k);
  return static_cast<int>(k);
}

}  // namespace

HoleBarSetup HoleBarSetup::of(const MachineDescription& machine, const Artefact& artefact) {
  const auto reject = [&](const std::string& why) {
    throw InputError({machine.file, fmt::format("artefact {}", artefact.id)}, why);
  };
  if (artefact.kind != "hole_bar") reject("is not a bar of holes; allowed here: kind \"hole_bar\".");
  HoleBarSetup setup;
  setup.artefact = artefact.id;
  setup.reference_in_table_mm = artefact.reference_in_table_mm;
  setup.direction_at_c0 = artefact.direction_at_c0;
  setup.hole_diameter_mm = artefact.hole_diameter_mm;
  const int reference = holeIndex(artefact.reference_hole);
  for (const double s : artefact.nominal_positions_mm) {
    setup.along_mm.push_back(s - artefact.nominal_positions_mm[static_cast<std::size_t>(reference)]);
  }
  // The rotary axis that carries the bar: the one nearest to the workpiece that can turn a bar lying as this one does.
  const ChainAxis* rotary = nullptr;
  for (const ChainAxis& axis : machine.chain.axes()) {
    if (!axis.rotary || axis.spindle || !axis.carries_workpiece) continue;
    if (std::abs(axis.direction.dot(artefact.direction_at_c0)) > 0.5) continue;
    rotary = &axis;
    break;
  }
  if (rotary == nullptr) {
    reject(
        fmt::format("needs a rotary axis that turns the workpiece across the bar, but the chain \"{}\" has none; "
                    "allowed: for example \"V [w-C'-X'-b-Y-Z-(C1)-t]\".",
                    machine.chain.text()));
  }
  setup.rotary = rotary->name;
  setup.rotary_direction = rotary->direction;
  const RotaryAxis* described = machine.findRotary(rotary->name);
  if (described == nullptr) {
    reject(
        fmt::format("needs the centre of the rotary axis {}; allowed: \"rotary\":[{{\"name\":\"{}\",\"centre_mm\":"
                    "[x,y,z]}}] in the machine file.",
                    rotary->name, rotary->name));
  }
  setup.centre_mm = described->centre_mm;
  const int along = mainAxis(artefact.direction_at_c0);
  const int turn = mainAxis(setup.rotary_direction);
  const int across = 3 - along - turn;
  const auto linearAlong = [&](int k) -> const ChainAxis* {
    for (const ChainAxis& axis : machine.chain.axes()) {
      if (!axis.rotary && mainAxis(axis.direction) == k) return &axis;
    }
    return nullptr;
  };
  const ChainAxis* linear = linearAlong(along);
  if (linear == nullptr) {
    reject(fmt::format("lies along {}, but the chain \"{}\" has no such axis.", "XYZ"[along], machine.chain.text()));
  }
  setup.linear = linear->name;
  const ChainAxis* second = linearAlong(across);
  setup.second = second != nullptr ? second->name : std::string(1, "XYZ"[across]);

  const std::map<std::string, Eigen::Vector3d, std::less<>> centres{{setup.rotary, setup.centre_mm}};
  const auto columns = [&](const Eigen::Vector3d& tip) {
    Eigen::Matrix<double, 3, 8> J;
    AxisPositions positions;
    Eigen::Vector3d rest = tip;
    bool taken[3] = {false, false, false};
    for (const ChainAxis& axis : machine.chain.axes()) {
      const int k = mainAxis(axis.direction);
      if (axis.rotary || taken[k]) continue;
      taken[k] = true;
      positions[axis.name] = tip(k);
      rest(k) = 0.0;
    }
    const auto deviation = [&](const std::string& axis, const SmallError& error) -> Eigen::Vector3d {
      return machine.chain.toolDeviation(positions, {{axis, error}}, rest, centres).translation_mm;
    };
    const auto slope = [&](const ChainAxis* axis, int k) -> Eigen::Vector3d {
      SmallError error;
      // The slope is the deviation of the tool relative to the table, whichever of the two the axis moves.
      error.translation_mm(k) = (tip(k) - setup.centre_mm(k)) * (axis->carries_workpiece ? -1.0 : 1.0);
      return deviation(axis->name, error);
    };
    J.col(0) = slope(linear, along);
    for (int k = 0; k < 3; ++k) {
      SmallError shift;
      shift.translation_mm(k) = 1.0;
      SmallError turned;
      turned.rotation_rad(k) = 1.0;
      J.col(1 + k) = deviation(setup.rotary, shift);
      J.col(4 + k) = deviation(setup.rotary, turned);
    }
    J.col(7) = second != nullptr ? slope(second, across) : Eigen::Vector3d::Zero();
    return J;
  };
  setup.chain[0] = columns(Eigen::Vector3d::Zero());
  for (int k = 0; k < 3; ++k) {
    constexpr double step_mm = 100.0;
    setup.chain[static_cast<std::size_t>(k + 1)] =
        (columns(step_mm * Eigen::Vector3d::Unit(k)) - setup.chain[0]) / step_mm;
  }
  return setup;
}

int HoleBarSetup::holeIndex(const std::string& feature) {
  return std::stoi(feature.substr(1)) - 1;
}

std::vector<std::string> HoleBarSetup::parameterNames(bool second_axis) const {
  const char letter = rotary.front();
  const int turn = mainAxis(rotary_direction);
  std::vector<std::string> names{fmt::format("E{}{}_um_per_m", linear, linear)};
  for (int k = 0; k < 3; ++k) {
    if (k != turn) names.push_back(fmt::format("E{}0{}_um", "XYZ"[k], letter));
  }
  names.push_back(fmt::format("E{}0T_um", "XYZ"[turn]));
  names.emplace_back("ER0T_um");
  for (int k = 0; k < 3; ++k) names.push_back(fmt::format("E{}0{}_urad", "ABC"[k], letter));
  names.emplace_back("EME_um_per_m");
  if (second_axis) names.push_back(fmt::format("E{}{}_um_per_m", second, second));
  return names;
}

Eigen::Matrix3d HoleBarSetup::tableRotation(double c_deg) const {
  return Eigen::AngleAxisd(c_deg * rad_per_deg, rotary_direction).toRotationMatrix();
}

Eigen::Vector3d HoleBarSetup::nominal_mm(int hole, double c_deg) const {
  return centre_mm +
         tableRotation(c_deg) * (reference_in_table_mm + along_mm[static_cast<std::size_t>(hole)] * direction_at_c0);
}

Eigen::MatrixXd HoleBarSetup::deviationJacobian(const std::string& feature, double c_deg, const Eigen::Vector3d& tip_mm,
                                                bool second_axis) const {
  const Eigen::Matrix<double, 3, 8> columns =
      chain[0] + tip_mm.x() * chain[1] + tip_mm.y() * chain[2] + tip_mm.z() * chain[3];
  const Eigen::Matrix3d turn = tableRotation(c_deg);
  const Eigen::Vector3d in_plane =
      reference_in_table_mm - rotary_direction * rotary_direction.dot(reference_in_table_mm);
  const double radius = in_plane.norm();
  Eigen::MatrixXd J(3, second_axis ? 10 : 9);
  J.col(0) = columns.col(0);
  int next = 1;
  const int axial = mainAxis(rotary_direction);
  for (int k = 0; k < 3; ++k) {
    if (k != axial) J.col(next++) = columns.col(1 + k);
  }
  J.col(3) = columns.col(1 + axial);
  // A reference hole on the axis itself has no radius to grow along.
  J.col(4) = radius > 1e-9 ? Eigen::Vector3d(-(turn * in_plane) / radius) : Eigen::Vector3d::Zero();
  J.block<3, 3>(0, 5) = columns.block<3, 3>(0, 4);
  J.col(8) = -along_mm[static_cast<std::size_t>(holeIndex(feature))] * (turn * direction_at_c0);
  if (second_axis) J.col(9) = columns.col(7);
  return J;
}

namespace {

std::vector<CertifiedLengths> compareWithCertificate(const HoleCycleResult& result, const Artefact& artefact,
                                                     const ArtefactCertificate& certificate, const OperatingLog* log) {
  std::vector<CertifiedLengths> out;
  if (!artefact.certificate_uncertainty_um) return out;
  const double alpha = certificate.expansion_per_K.value_or(0.0);
  const std::string& reference_hole = artefact.reference_hole;
  for (std::size_t k = 0; k < result.cycles.size(); ++k) {
    std::vector<const ProbedFeature*> holes;
    const ProbedFeature* reference = nullptr;
    for (const ProbedFeature& f : result.features) {
      if (f.cycle != result.cycles[k] || f.c_deg != 0.0 || f.status != FitStatus::Converged) continue;
      if (f.feature == reference_hole) {
        reference = &f;
      } else {
        holes.push_back(&f);
      }
    }
    if (reference == nullptr || holes.size() < 2) continue;
    CertifiedLengths lengths;
    lengths.cycle = result.cycles[k];
    lengths.temperature_degC = artefactTemperature(artefact, log, result.cycle_time_s[k]);
    const double warmer = lengths.temperature_degC.value_or(certificate.reference_degC) - certificate.reference_degC;
    const auto n = static_cast<Eigen::Index>(holes.size());
    Eigen::MatrixXd A(n, 1);
    Eigen::VectorXd y(n);
    Eigen::MatrixXd covariance(n, n);
    const Eigen::Vector3d& along = result.setup.direction_at_c0;
    const double reference_variance =
        along.dot(reference->covariance * along) + certificate.place_sigma_mm * certificate.place_sigma_mm;
    const double strain_variance =
        std::pow(warmer * certificate.expansion_sigma_per_K, 2) + std::pow(alpha * certificate.temperature_sigma_K, 2);
    Eigen::VectorXd s(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      s(i) =
          result.setup
              .along_mm[static_cast<std::size_t>(HoleBarSetup::holeIndex(holes[static_cast<std::size_t>(i)]->feature))];
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      const ProbedFeature& hole = *holes[static_cast<std::size_t>(i)];
      const Eigen::Vector3d measured = hole.centre_mm - reference->centre_mm;
      // In the plane of the table: a bar that lies a little skew is not longer for it.
      const Eigen::Vector3d& axis = result.setup.rotary_direction;
      const double length = (measured - axis * axis.dot(measured)).norm() * (s(i) < 0.0 ? -1.0 : 1.0);
      const double certified = s(i) * (1.0 + alpha * warmer);
      y(i) = length - certified;
      A(i, 0) = -s(i);
      for (Eigen::Index j = 0; j < n; ++j) covariance(i, j) = reference_variance + strain_variance * s(i) * s(j);
      covariance(i, i) += along.dot(hole.covariance * along) + certificate.place_sigma_mm * certificate.place_sigma_mm;
      lengths.holes.push_back({hole.feature, certified, y(i) * um_per_mm, std::sqrt(covariance(i, i)) * um_per_mm});
    }
    const LinearFitResult fit = solveLinearCorrelated(A, y, covariance);
    if (!fit.usable()) continue;
    lengths.slope_um_per_m = fit.x(0) * um_per_m_per_unit;
    lengths.standard_uncertainty_um_per_m = fit.standardUncertainty(0) * um_per_m_per_unit;
    lengths.chi2 = fit.chi2;
    lengths.degrees_of_freedom = fit.degrees_of_freedom;
    out.push_back(std::move(lengths));
  }
  return out;
}

/// What the lengths against the certificate rest on without an uncertainty, or were not corrected for.
void warnOfCertificate(const Artefact& artefact, const ArtefactCertificate& certificate, HoleCycleResult& result) {
  double warmest_K = 0.0;
  std::vector<std::optional<double>> temperature_degC;
  for (const CertifiedLengths& lengths : result.against_certificate) {
    temperature_degC.push_back(lengths.temperature_degC);
    warmest_K = std::max(warmest_K, std::abs(lengths.temperature_degC.value_or(certificate.reference_degC) -
                                             certificate.reference_degC));
  }
  for (std::string& warning : certificate.notCorrected(artefact.id, temperature_degC))
    result.warnings.push_back(std::move(warning));
  if (std::string warning =
          certificate.takenAsExact(artefact.id, warmest_K * std::abs(certificate.expansion_per_K.value_or(0.0)));
      !warning.empty())
    result.warnings.push_back(std::move(warning));
}

/// A stylus that is knocked or a bar that slips moves everything that follows at once, and the displacements of the
/// table take it; what heat does takes its time.
void warnOfASuddenMovement(const Artefact& artefact, HoleCycleResult& result) {
  constexpr std::size_t first = 1;  // of the displacements among the parameters
  std::vector<double> time;
  std::vector<Eigen::Vector3d> displaced_um;
  std::vector<std::size_t> cycles;
  double noise_um = 0.0;
  for (std::size_t k = 0; k < result.cycles.size(); ++k) {
    const bool reference = static_cast<int>(k) == result.problem.reference_cycle;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    bool known = true;
    for (std::size_t i = 0; i < 3 && !reference; ++i) {
      const CycleParameter& p = result.parameters[k][first + i];
      known = known && p.determined;
      at(static_cast<Eigen::Index>(i)) = p.value;
      noise_um = std::max(noise_um, p.determined ? p.standard_uncertainty : 0.0);
    }
    if (!known) continue;
    time.push_back(result.cycle_time_s[k]);
    displaced_um.push_back(at);
    cycles.push_back(k);
  }
  constexpr double telling_um = 5.0;
  constexpr double many_sigma = 8.0;
  const StylusMovement movement =
      judgeMovement(time, displaced_um, noise_um, std::max(telling_um, many_sigma * noise_um));
  if (movement.kind != MovementKind::Jump) return;
  const auto before = static_cast<std::size_t>(movement.jump_after);
  result.warnings.push_back(
      fmt::format("From {} to {} all holes of {} moved by {:.0f} µm at once, which heat does not do: was the stylus "
                  "knocked, or did "
                  "the bar slip? The displacements of the table hold that step.",
                  result.cycles[cycles[before]], result.cycles[cycles[before + 1]], artefact.id, movement.jump_um));
}

constexpr Eigen::Index eme = 8;  ///< growth of the bar among the parameters

/// The growth that coefficient and temperature expect, beside that of the touches; a warning where they contradict.
/// One temperature for all cycles says nothing of a growth between them.
[[nodiscard]] bool compareGrowth(const Artefact& artefact, const ArtefactGrowth& growth, HoleCycleResult& result) {
  if (growth.strain.empty() || !growth.measured) return false;
  double worst = 0.0;
  const ExpectedGrowth* worst_cycle = nullptr;
  result.growth.reserve(result.cycles.size());
  for (std::size_t k = 0; k < result.cycles.size(); ++k) {
    if (static_cast<int>(k) == result.problem.reference_cycle) continue;
    const CycleParameter& measured = result.parameters[k][static_cast<std::size_t>(eme)];
    if (!measured.determined) continue;
    ExpectedGrowth g;
    g.cycle = result.cycles[k];
    g.expected_um_per_m = growth.strain[k] * um_per_m_per_unit;
    g.expected_sigma_um_per_m = growth.factors.row(static_cast<Eigen::Index>(k)).norm() * um_per_m_per_unit;
    g.measured_um_per_m = measured.value;
    g.measured_sigma_um_per_m = measured.standard_uncertainty;
    result.growth.push_back(g);
    const double z = std::abs(g.measured_um_per_m - g.expected_um_per_m) /
                     std::hypot(g.measured_sigma_um_per_m, g.expected_sigma_um_per_m);
    if (z <= worst) continue;
    worst = z;
    worst_cycle = &result.growth.back();
  }
  constexpr double many_sigma = 4.0;
  if (worst <= many_sigma) return true;
  const double expected_sigma = worst_cycle->expected_sigma_um_per_m;
  result.warnings.push_back(fmt::format(
      "{} seems to have grown by {} in {}, but its expansion coefficient and temperature say {}: the axis that "
      "measures it grows as well, the expansion coefficient is wrong, or the sensor is not on the artefact.",
      artefact.id, withUncertainty(worst_cycle->measured_um_per_m, worst_cycle->measured_sigma_um_per_m, "um/m"),
      worst_cycle->cycle,
      expected_sigma > 0.0 ? withUncertainty(worst_cycle->expected_um_per_m, expected_sigma, "um/m")
                           : fmt::format("{:.1f} {}", worst_cycle->expected_um_per_m, printedUnit("um/m"))));
  return false;
}

void takeParameters(HoleCycleResult& result) {
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    for (std::size_t p = 0; p < result.names.size(); ++p) {
      const auto e = static_cast<Eigen::Index>(p);
      CycleParameter& parameter = result.parameters[k][p];
      parameter.value = result.fit.cycles[k].theta(e) * result.unit[p];
      parameter.standard_uncertainty = std::sqrt(std::max(0.0, result.fit.cycles[k].covariance(e, e))) * result.unit[p];
    }
  }
}

/// Growth counts per metre of the certified distances: a hole that lies elsewhere by one standard uncertainty shifts
/// its touches by EME times that, which the fit shares out between the growth of the bar and the slope of the axis.
void addCertificate(const TouchList& list, const Artefact& artefact, const ArtefactCertificate& certificate,
                    HoleCycleResult& result) {
  if (!(certificate.place_sigma_mm > 0.0)) return;
  const HoleBarSetup& setup = result.setup;
  const auto reference = static_cast<Eigen::Index>(HoleBarSetup::holeIndex(artefact.reference_hole));
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(result.problem.rows.size()),
                                                static_cast<Eigen::Index>(setup.along_mm.size()));
  for (std::size_t r = 0; r < result.problem.rows.size(); ++r) {
    const Touch& t = list.touches[result.row_touch[r]];
    const auto hole = static_cast<Eigen::Index>(HoleBarSetup::holeIndex(t.feature));
    if (hole == reference) continue;
    const double growth = result.fit.cycles[static_cast<std::size_t>(result.problem.rows[r].cycle)].theta(eme);
    const double along = result.row_normal[r].dot(setup.tableRotation(t.c_deg) * setup.direction_at_c0);
    const double moved_mm = along * growth * certificate.place_sigma_mm;
    shift(static_cast<Eigen::Index>(r), hole) += moved_mm;
    shift(static_cast<Eigen::Index>(r), reference) -= moved_mm;
  }
  addCauses(result.problem, shift, result.fit);
  takeParameters(result);
}

/// EME from the touches and from coefficient and temperature, each with its uncertainty, as one value; what EXX and the
/// others have in common with EME follows.
void combineGrowth(const ArtefactGrowth& growth, HoleCycleResult& result) {
  KnownCombination known;
  known.row = Eigen::RowVectorXd::Unit(static_cast<Eigen::Index>(result.names.size()), eme);
  for (std::size_t k = 0; k < result.cycles.size(); ++k)
    if (static_cast<int>(k) != result.problem.reference_cycle) known.cycles.push_back(static_cast<int>(k));
  if (known.cycles.empty()) return;
  known.value.resize(std::ssize(known.cycles));
  Eigen::MatrixXd factors(std::ssize(known.cycles), growth.factors.cols());
  for (Eigen::Index i = 0; i < factors.rows(); ++i) {
    const int k = known.cycles[static_cast<std::size_t>(i)];
    known.value(i) = growth.strain[static_cast<std::size_t>(k)];
    factors.row(i) = growth.factors.row(k);
  }
  known.covariance = factors * factors.transpose();
  combineWith(result.problem, known, result.fit);
  takeParameters(result);
  result.growth_combined = true;
}

}  // namespace

HoleCycleResult evaluateHoleCycles(const TouchList& list, const MachineDescription& machine, const Artefact& artefact,
                                   const HoleCycleOptions& options, const OperatingLog* log) {
  HoleCycleResult result;
  result.setup = HoleBarSetup::of(machine, artefact);
  const HoleBarSetup& setup = result.setup;
  CycleAssembly assembly;
  assembly.kind = FeatureKind::Hole;
  assembly.axis = setup.rotary_direction;
  assembly.centre_mm = setup.centre_mm;
  assembly.names = setup.parameterNames(options.second_axis);
  assembly.unit = {um_per_m_per_unit, um_per_mm,    um_per_mm,    um_per_mm,        um_per_mm,
                   urad_per_rad,      urad_per_rad, urad_per_rad, um_per_m_per_unit};
  if (options.second_axis) assembly.unit.push_back(um_per_m_per_unit);
  assembly.fit = options.fit;
  assembly.misplaced_mm = options.misplaced_mm;
  assembly.features = featureNames(artefact);
  // At the centre of the hole, at the height of the touch: the few millimetres to the wall cancel between opposite
  // touches, and must not pretend that the growth of the diameter tells the axis from the bar.
  assembly.jacobian = [&](const Touch& t, const Eigen::Vector3d& centre_mm) {
    const Eigen::Vector3d& axis = setup.rotary_direction;
    const Eigen::Vector3d place = isSurfaceTouch(t, axis)
                                      ? t.position_mm
                                      : Eigen::Vector3d(centre_mm + axis * axis.dot(t.position_mm - centre_mm));
    return setup.deviationJacobian(t.feature, t.c_deg, place, options.second_axis);
  };
  assembly.nominal = [&](const std::string& feature, double c_deg) -> std::optional<Eigen::Vector3d> {
    return setup.nominal_mm(HoleBarSetup::holeIndex(feature), c_deg);
  };
  assembly.radius = [&](const std::string&, const std::string& stylus) -> std::optional<double> {
    if (!setup.hole_diameter_mm) return std::nullopt;
    return 0.5 * *setup.hole_diameter_mm - machine.findStylus(stylus)->radius_mm;
  };
  if (options.stable_length) {
    const StableLength& length = *options.stable_length;
    CyclePrior prior;
    prior.row = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(assembly.names.size()));
    prior.row(8) = 1.0;
    prior.value = length.growth_um_per_m / um_per_m_per_unit;
    prior.sigma = length.uncertainty_um_per_m / um_per_m_per_unit;
    for (const double g : length.growth_of_cycle_um_per_m) {
      prior.value_of_cycle.push_back(g / um_per_m_per_unit);
    }
    if (!prior.value_of_cycle.empty()) {
      const auto cycles = list.cycles().size();
      if (prior.value_of_cycle.size() != cycles) {
        throw InputError(fmt::format("the stable length has {} values for {} cycles; allowed: one per cycle.",
                                     prior.value_of_cycle.size(), cycles));
      }
    }
    assembly.priors.push_back(prior);
  }
  evaluateCycles(list, machine, artefact, assembly, result);
  const ArtefactCertificate certificate = ArtefactCertificate::of(machine, artefact);
  result.against_certificate = compareWithCertificate(result, artefact, certificate, log);
  warnOfCertificate(artefact, certificate, result);
  if (!artefact.hole_diameter_mm)
    result.warnings.push_back(fmt::format(
        "machine.json states no hole_diameter_mm of {}: the diameter of each hole is taken from its touches.",
        artefact.id));
  warnOfASuddenMovement(artefact, result);
  addCertificate(list, artefact, certificate, result);
  const ArtefactGrowth growth = artefactGrowth(certificate, artefact, log, result.cycle_time_s);
  // A growth whose uncertainty nobody states is no measurement; one that contradicts the touches is told, not mixed in;
  // one that is given beforehand has been used.
  if (compareGrowth(artefact, growth, result) && !options.stable_length && certificate.expansion_sigma_per_K > 0.0 &&
      certificate.temperature_sigma_K > 0.0) {
    combineGrowth(growth, result);
  }

  // What a straight line leaves over along the bar at c = 0.
  for (const std::string& feature : assembly.features) {
    LinearityDeviation deviation;
    deviation.feature = feature;
    std::map<int, std::pair<double, double>> sums;  // per cycle: sum of u r, sum of u^2 along the bar
    for (std::size_t r = 0; r < result.problem.rows.size(); ++r) {
      const Touch& t = list.touches[result.row_touch[r]];
      if (t.feature != feature || t.c_deg != 0.0 || !result.fit.used[r]) continue;
      const double u = result.row_normal[r].dot(setup.direction_at_c0);
      auto& [ur, uu] = sums[result.problem.rows[r].cycle];
      ur += u * result.fit.residual_mm[r];
      uu += u * u;
    }
    std::vector<double> values;
    for (const auto& [cycle, sum] : sums) {
      if (cycle == result.problem.reference_cycle || !(sum.second > 0.5)) continue;
      const double value = sum.first / sum.second * um_per_mm;
      values.push_back(value);
      if (deviation.largest_cycle.empty() || std::abs(value) > std::abs(deviation.largest_um)) {
        deviation.largest_um = value;
        deviation.sigma_um = result.fit.group_sigma_mm[0] * um_per_mm / std::sqrt(sum.second);
        deviation.largest_cycle = result.cycles[static_cast<std::size_t>(cycle)];
      }
    }
    if (values.empty()) continue;
    deviation.rms_um = rootMeanSquare(values);
    result.largest_nonlinearity_um = std::max(result.largest_nonlinearity_um, std::abs(deviation.largest_um));
    result.linearity.push_back(deviation);
  }
  return result;
}

SecondAxisBias secondAxisBias(const HoleCycleResult& result, const TouchList& list) {
  SecondAxisBias bias;
  bias.second = result.setup.second;
  bias.names = result.names;
  const auto n = static_cast<Eigen::Index>(result.names.size());
  // The second axis is a parameter itself where there are more: then its expansion changes no other.
  const bool alone = n <= 9;
  bias.bias_per_um_per_m.assign(result.names.size(), alone ? std::nan("") : 0.0);
  // The fullest cycle after the reference stands for all.
  int best = -1;
  for (std::size_t k = 0; k < result.cycles.size(); ++k) {
    if (static_cast<int>(k) == result.problem.reference_cycle) continue;
    if (best < 0 ||
        result.fit.cycles[k].touches_used > result.fit.cycles[static_cast<std::size_t>(best)].touches_used) {
      best = static_cast<int>(k);
    }
  }
  if (best < 0 || !alone) return bias;
  std::vector<Eigen::Index> rows;
  for (std::size_t r = 0; r < result.problem.rows.size(); ++r) {
    if (result.problem.rows[r].cycle == best && result.fit.used[r]) rows.push_back(static_cast<Eigen::Index>(r));
  }
  const auto m = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A(m, n);
  Eigen::VectorXd y(m);
  Eigen::VectorXd sigma(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto r = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
    const Touch& t = list.touches[result.row_touch[r]];
    for (Eigen::Index p = 0; p < n; ++p) {
      A(i, p) = result.problem.jacobian(static_cast<Eigen::Index>(r), p) / result.unit[static_cast<std::size_t>(p)];
    }
    const Eigen::MatrixXd J = result.setup.deviationJacobian(t.feature, t.c_deg, t.position_mm, true);
    y(i) = -result.row_normal[r].dot(J.col(9)) / um_per_m_per_unit;
    sigma(i) = result.fit.group_sigma_mm[static_cast<std::size_t>(result.problem.rows[r].group)];
  }
  const LinearFitResult fit = solveLinear(A, y, sigma);
  if (!fit.usable()) return bias;
  for (Eigen::Index p = 0; p < n; ++p) bias.bias_per_um_per_m[static_cast<std::size_t>(p)] = fit.x(p);
  for (const int p : fit.undetermined) bias.bias_per_um_per_m[static_cast<std::size_t>(p)] = std::nan("");
  return bias;
}

}  // namespace spindrift
