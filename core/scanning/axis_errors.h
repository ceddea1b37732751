// SPDX-License-Identifier: Apache-2.0
// Six errors of the axis that carries the profiler, from registrations of scans (P3 equations 2, 3, 12-14).
//
// E = A [R T] A^-1, A = slide_from_tcs tcs_from_profiler, [R T] = cold_from_warm. To first order: the deviation (u, w)
// at the centroid c of the artefact's surface belongs to the error (e, w) at the slide's origin with e = u - w x q,
// where
//   rigid:       q = lever + tcs_from_profiler c              (slide frame where the scan starts)
//   push_broom:  q = lever + tcs_from_profiler (c_x, 0, c_z)  (when the profile passes the centroid)
// Lengths mm, angles rad; sign: deviation of the tool.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/geometry/small_error.h"
#include "core/scanning/profiler_calibration.h"
#include "core/scanning/registration.h"

namespace spindrift {

/// How the profiler hangs on the slide.
struct ProfilerMounting {
  ProfilerCalibration calibration;
  double lift_mm = 0.0;
  Eigen::Vector3d lever_mm = Eigen::Vector3d::Zero();  ///< slide origin to tool frame

  /// q above, for a centroid in the profiler's frame.
  [[nodiscard]] Eigen::Vector3d arm_mm(const Eigen::Vector3d& centroid_mm, ScanModel model) const;
};

struct AxisError {
  SmallError error;  ///< at the slide's origin
  /// Of (e, w), mm and rad; infinite where not determined.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  [[nodiscard]] bool determined(int i) const { return std::isfinite(covariance(i, i)); }
};

/// (3) with the covariance of the registration and of the calibration.
[[nodiscard]] AxisError axisError(const RegistrationResult& registration, const ProfilerMounting& mounting);

/// What the uncertainty of the calibration's angles does to (u, w): one column per independent contribution of unit
/// variance, so that S S^T is the covariance and S_a S_b^T that between two scans of one profiler. The first three
/// columns are of first order; the last three of second order, which counts where an angle is known only by its
/// mounting (its mean is not taken out: it is a mean square).
[[nodiscard]] Eigen::Matrix<double, 6, 6> calibrationSpread(const RegistrationResult& registration,
                                                            const ProfilerCalibration& calibration);

/// Change of (u, w) with the calibration (alpha, beta, gamma about X, Y, Z; first order): 6 x 3.
[[nodiscard]] Eigen::Matrix<double, 6, 3> calibrationSensitivity(const RegistrationResult& registration,
                                                                 const ProfilerCalibration& calibration);

/// P3 section 5 as a Monte Carlo: how much calibration errors change the six errors.
struct CalibrationStudyOptions {
  double angle_sigma_rad = 1e-2;  ///< of alpha, beta, gamma
  double length_sigma_mm = 1.0;   ///< of dx, dy, dz
  int trials = 10000;
  std::uint64_t seed = 1;
  void validate() const;
};
struct CalibrationStudy {
  /// Per component EX, EY, EZ (um), EA, EB, EC (urad): root mean square and largest change.
  std::array<double, 6> rms{};
  std::array<double, 6> largest{};
  /// The same at the artefact itself.
  std::array<double, 6> rms_at_artefact{};
};
/// `profiler_motion` is [R T] in the profiler's frame (cold_from_warm), exact algebra (no small angles).
[[nodiscard]] CalibrationStudy studyCalibrationErrors(const RigidTransform& profiler_motion,
                                                      const Eigen::Vector3d& centroid_mm,
                                                      const ProfilerMounting& mounting,
                                                      const CalibrationStudyOptions& options = {});

/// One scan's result, for tables and for surfaces over position and time (P3 Figs. 10 and 11).
struct AxisErrorSample {
  double time_s = 0.0;
  double position_mm = 0.0;
  AxisError value;
};
/// A component over position (columns) and time (rows), um or urad; NaN where there is no sample.
struct AxisErrorSurface {
  std::string unit;
  std::vector<double> positions_mm;
  std::vector<double> times_s;
  std::vector<double> values;  ///< row major: time, position
  std::vector<double> sigmas;
};
/// Of every component; scans of one cycle share a row: times closer than `cycle_s` belong together (time of the first).
[[nodiscard]] std::array<AxisErrorSurface, 6> axisErrorSurfaces(const std::vector<AxisErrorSample>& samples,
                                                                double cycle_s);

}  // namespace spindrift
