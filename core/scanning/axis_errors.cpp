// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/axis_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/machine/component.h"

namespace spindrift {

Eigen::Vector3d ProfilerMounting::arm_mm(const Eigen::Vector3d& centroid_mm, ScanModel model) const {
  Eigen::Vector3d c = centroid_mm;
  if (model == ScanModel::PushBroom) c.y() = 0.0;
  return lever_mm + calibration.tcsFromProfiler(lift_mm) * c;
}

namespace {

/// The shift that the scans show and that turns with the profiler. With push_broom the carriage's direction does not
/// turn, only the part of u inside the profile's plane.
Eigen::Vector3d turningShift_mm(const RegistrationResult& registration, const ProfilerCalibration& calibration) {
  const Eigen::Vector3d seen = registration.translation_mm - registration.commanded_mm;
  if (registration.scan_model != ScanModel::PushBroom) return seen;
  Eigen::Matrix3d m = calibration.rotation();
  m.col(1) = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d in_cloud = m.inverse() * seen;
  return m.col(0) * in_cloud.x() + m.col(2) * in_cloud.z();
}

}  // namespace

Eigen::Matrix<double, 6, 3> calibrationSensitivity(const RegistrationResult& registration,
                                                   const ProfilerCalibration& calibration) {
  // A small turn t of the profiler turns what it saw: u changes by t x u.
  Eigen::Matrix<double, 6, 3> out;
  out.topRows<3>() = -crossMatrix(turningShift_mm(registration, calibration));
  out.bottomRows<3>() = -crossMatrix(registration.rotation_rad);
  return out;
}

Eigen::Matrix<double, 6, 6> calibrationSpread(const RegistrationResult& registration,
                                              const ProfilerCalibration& calibration) {
  const Eigen::Matrix<double, 6, 3> turn = calibrationSensitivity(registration, calibration);
  const Eigen::Vector3d shift = turningShift_mm(registration, calibration);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> angles(calibration.covariance.topLeftCorner<3, 3>());
  Eigen::Matrix<double, 6, 6> out;
  for (int k = 0; k < 3; ++k) {
    const double variance = std::max(0.0, angles.eigenvalues()[k]);
    const Eigen::Vector3d axis = angles.eigenvectors().col(k);
    out.col(k) = std::sqrt(variance) * turn * axis;
    // t x (t x u) / 2 with t = s axis: the mean of s^4 is three times the square of that of s^2.
    const double second = 0.5 * std::sqrt(3.0) * variance;
    out.col(3 + k) << second * axis.cross(axis.cross(shift)),
        second * axis.cross(axis.cross(registration.rotation_rad));
  }
  return out;
}

AxisError axisError(const RegistrationResult& registration, const ProfilerMounting& mounting) {
  AxisError out;
  const Eigen::Vector3d q = mounting.arm_mm(registration.centroid_mm, registration.scan_model);
  out.error.translation_mm = registration.translation_mm - registration.rotation_rad.cross(q);
  out.error.rotation_rad = registration.rotation_rad;
  Eigen::Matrix<double, 6, 6> lever = Eigen::Matrix<double, 6, 6>::Identity();
  lever.topRightCorner<3, 3>() = crossMatrix(q);
  // Components that the scan does not determine make those undetermined that they reach through the lever.
  Eigen::Matrix<double, 6, 6> covariance = registration.covariance;
  std::array<bool, 6> lost{};
  for (int i = 0; i < 6; ++i)
    if (!std::isfinite(covariance(i, i))) {
      lost[static_cast<std::size_t>(i)] = true;
      covariance.row(i).setZero();
      covariance.col(i).setZero();
    }
  const Eigen::Matrix<double, 6, 6> spread = calibrationSpread(registration, mounting.calibration);
  const Eigen::Matrix3d lengths = mounting.calibration.covariance.bottomRightCorner<3, 3>();
  out.covariance = lever * (covariance + spread * spread.transpose()) * lever.transpose();
  const Eigen::Matrix3d w = crossMatrix(registration.rotation_rad);
  out.covariance.topLeftCorner<3, 3>() += w * lengths * w.transpose();
  for (int i = 0; i < 6; ++i) {
    bool reached = lost[static_cast<std::size_t>(i)];
    for (int j = 3; j < 6 && i < 3; ++j)
      reached = reached || (lost[static_cast<std::size_t>(j)] && std::abs(lever(i, j)) > 1e-6);
    if (!reached) continue;
    out.covariance.row(i).setZero();
    out.covariance.col(i).setZero();
    out.covariance(i, i) = std::numeric_limits<double>::infinity();
  }
  return out;
}

void CalibrationStudyOptions::validate() const {
  if (!(angle_sigma_rad >= 0.0) || !(length_sigma_mm >= 0.0) || trials < 1)
    throw InputError("The study needs non-negative uncertainties and at least one trial.");
}

CalibrationStudy studyCalibrationErrors(const RigidTransform& profiler_motion, const Eigen::Vector3d& centroid_mm,
                                        const ProfilerMounting& mounting, const CalibrationStudyOptions& options) {
  options.validate();
  CalibrationStudy study;
  Random random(options.seed);
  const ProfilerCalibration& c = mounting.calibration;
  const auto evaluate = [&](const RigidTransform& tcs, std::array<double, 6>& at_origin,
                            std::array<double, 6>& at_artefact) {
    const RigidTransform slide = RigidTransform(mounting.lever_mm) * tcs;
    const SmallError e = SmallError::fromTransform(slide * profiler_motion * slide.inverse());
    const SmallError near = e.at(slide * centroid_mm);
    for (const Component k : all_components) {
      at_origin[static_cast<std::size_t>(k)] = valueOf(e, k);
      at_artefact[static_cast<std::size_t>(k)] = valueOf(near, k);
    }
  };
  std::array<double, 6> origin{}, artefact{}, moved{}, moved_artefact{};
  evaluate(c.tcsFromProfiler(mounting.lift_mm), origin, artefact);
  for (int trial = 0; trial < options.trials; ++trial) {
    Eigen::Vector3d d = c.offset_mm - Eigen::Vector3d(0.0, 0.0, mounting.lift_mm);
    const double a = c.alpha_rad + random.normal(0.0, options.angle_sigma_rad);
    const double b = c.beta_rad + random.normal(0.0, options.angle_sigma_rad);
    const double g = c.gamma_rad + random.normal(0.0, options.angle_sigma_rad);
    for (int i = 0; i < 3; ++i) d[i] += random.normal(0.0, options.length_sigma_mm);
    evaluate(RigidTransform::fromAlphaBetaGamma(a, b, g, d), moved, moved_artefact);
    for (std::size_t i = 0; i < 6; ++i) {
      const double change = moved[i] - origin[i];
      study.rms[i] += change * change;
      study.largest[i] = std::max(study.largest[i], std::abs(change));
      const double near = moved_artefact[i] - artefact[i];
      study.rms_at_artefact[i] += near * near;
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    study.rms[i] = std::sqrt(study.rms[i] / options.trials);
    study.rms_at_artefact[i] = std::sqrt(study.rms_at_artefact[i] / options.trials);
  }
  return study;
}

std::array<AxisErrorSurface, 6> axisErrorSurfaces(const std::vector<AxisErrorSample>& samples, double cycle_s) {
  std::vector<double> times, positions;
  for (const AxisErrorSample& s : samples) {
    times.push_back(s.time_s);
    positions.push_back(s.position_mm);
  }
  const auto groups = [](std::vector<double> values, double apart) {
    std::sort(values.begin(), values.end());
    std::vector<std::vector<double>> out;
    for (const double v : values) {
      if (out.empty() || v - out.back().back() > apart) out.emplace_back();
      out.back().push_back(v);
    }
    std::vector<double> first;
    for (const auto& g : out) first.push_back(g.front());
    return first;
  };
  const std::vector<double> rows = groups(times, cycle_s);
  const std::vector<double> columns = groups(positions, 1e-6);
  const auto place = [](const std::vector<double>& list, double v) {
    return static_cast<std::size_t>(std::upper_bound(list.begin(), list.end(), v) - list.begin()) - 1;
  };
  std::array<AxisErrorSurface, 6> out;
  for (const Component k : all_components) {
    AxisErrorSurface& s = out[static_cast<std::size_t>(k)];
    s.unit = std::string(unitOf(k));
    s.positions_mm = columns;
    s.times_s = rows;
    s.values.assign(rows.size() * columns.size(), std::nan(""));
    s.sigmas = s.values;
    const int i = static_cast<int>(k);
    for (const AxisErrorSample& sample : samples) {
      if (!sample.value.determined(i)) continue;
      const std::size_t at = place(rows, sample.time_s) * columns.size() + place(columns, sample.position_mm);
      s.values[at] = valueOf(sample.value.error, k);
      s.sigmas[at] = std::sqrt(sample.value.covariance(i, i)) * (isRotation(k) ? urad_per_rad : um_per_mm);
    }
  }
  return out;
}

}  // namespace spindrift
