// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/profiler_calibration.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/math/least_squares.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Parameters = Eigen::Matrix<double, 7, 1>;  // alpha, beta, gamma, dx, dy, dz, offset of the radius

/// z = height + slope_x x + slope_y y with covariance.
struct Plane {
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double rms = 0.0;
  [[nodiscard]] double at(double x, double y) const { return coefficients.dot(Eigen::Vector3d(1.0, x, y)); }
};

/// Slopes of the flat parts from differences over short distances: most of them see no edge.
Eigen::Vector2d typicalSlope(const PointCloud& scan) {
  std::vector<double> along, across;
  const CloudSpacing spacing = cloudSpacing(scan);
  const auto reach = static_cast<std::size_t>(std::max(20.0, 1.0 / std::max(spacing.along_profile_mm, 1e-6)));
  for (std::size_t k = 0; k < scan.profileCount(); ++k) {
    const std::size_t first = scan.profile_start[k], end = scan.profile_start[k + 1];
    for (std::size_t i = first; i + reach < end; i += reach / 2) {
      const Eigen::Vector3d d = scan.points_mm[i + reach] - scan.points_mm[i];
      if (std::abs(d.x()) > 1e-6) along.push_back(d.z() / d.x());
    }
  }
  const std::size_t step = std::max<std::size_t>(1, scan.profileCount() / 10);
  for (std::size_t k = 0; k + step < scan.profileCount(); ++k) {
    std::size_t j = scan.profile_start[k + step];
    const std::size_t j_end = scan.profile_start[k + step + 1];
    for (std::size_t i = scan.profile_start[k]; i < scan.profile_start[k + 1]; i += 40) {
      while (j < j_end && scan.points_mm[j].x() < scan.points_mm[i].x() - 1e-9) ++j;
      if (j >= j_end) break;
      const Eigen::Vector3d d = scan.points_mm[j] - scan.points_mm[i];
      if (std::abs(d.x()) < 2.0 * spacing.along_profile_mm && std::abs(d.y()) > 1e-6) across.push_back(d.z() / d.y());
    }
  }
  return {along.empty() ? 0.0 : median(along), across.empty() ? 0.0 : median(across)};
}

/// Heights of plate and floor after the slope is taken away: the highest level with many points and the next below.
struct Levels {
  double plate = 0.0;
  double floor = 0.0;
};
std::optional<Levels> findLevels(const PointCloud& scan, const Eigen::Vector2d& slope) {
  std::vector<double> heights;
  const std::size_t step = std::max<std::size_t>(1, scan.size() / 40000);
  for (std::size_t i = 0; i < scan.size(); i += step)
    heights.push_back(scan.points_mm[i].z() - slope.dot(scan.points_mm[i].head<2>()));
  std::sort(heights.begin(), heights.end());
  // Clusters: runs of heights without a gap of 0.05 mm that hold at least 5 % of the points.
  struct Cluster {
    double middle;
    std::size_t count;
  };
  std::vector<Cluster> clusters;
  for (std::size_t from = 0; from < heights.size();) {
    std::size_t to = from + 1;
    while (to < heights.size() && heights[to] - heights[to - 1] < 0.02) ++to;
    if (20 * (to - from) > heights.size()) clusters.push_back({heights[(from + to) / 2], to - from});
    from = to;
  }
  if (clusters.size() < 2) return std::nullopt;
  return Levels{clusters.back().middle, clusters[clusters.size() - 2].middle};
}

Plane fitPlate(const PointCloud& scan, const Eigen::Vector2d& slope, const Levels& levels) {
  Plane plane;
  plane.coefficients << levels.plate, slope.x(), slope.y();
  double scale = 0.1 * (levels.plate - levels.floor);
  for (int iteration = 0; iteration < 5; ++iteration) {
    Eigen::Matrix3d n = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    std::vector<double> sizes;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Eigen::Vector3d& p = scan.points_mm[i];
      const double r = p.z() - plane.at(p.x(), p.y());
      if (std::abs(r) > 5.0 * scale) continue;
      const double w = iteration == 0 ? 1.0 : tukeyWeight(r / scale, 5.0);
      const Eigen::Vector3d row(1.0, p.x(), p.y());
      n.noalias() += w * row * row.transpose();
      right += w * r * row;
      if (i % 7 == 0) sizes.push_back(std::abs(r));
    }
    const Eigen::LDLT<Eigen::Matrix3d> ldlt(n);
    if (ldlt.info() != Eigen::Success || sizes.size() < 10) return plane;
    plane.coefficients += ldlt.solve(right);
    scale = std::max(1.4826 * median(sizes), 1e-7);
    plane.rms = scale;
    // Neighbouring samples of a profile share speckle: count every fourth as independent.
    plane.covariance = 4.0 * scale * scale * ldlt.solve(Eigen::Matrix3d::Identity());
  }
  return plane;
}

/// Crossings of the rim in one profile: where the plate ends on the left and begins again on the right of the pocket.
void findRim(const PointCloud& scan, std::size_t k, const Plane& plane, double depth, double spacing,
             std::vector<RimPoint>& rim) {
  const std::size_t first = scan.profile_start[k], end = scan.profile_start[k + 1];
  const auto& p = scan.points_mm;
  const auto isPlate = [&](std::size_t i) {
    const double r = p[i].z() - plane.at(p[i].x(), p[i].y());
    return std::abs(r) < 0.25 * depth;
  };
  const auto isLow = [&](std::size_t i) { return p[i].z() - plane.at(p[i].x(), p[i].y()) < -0.5 * depth; };
  constexpr std::size_t run = 6;  // lasting, not single outliers
  for (const int side : {-1, 1}) {
    // Seen from the outside: the last plate sample before a lasting low (or missing) stretch.
    const auto at = [&](std::size_t n) { return side < 0 ? first + n : end - 1 - n; };
    const std::size_t count = end - first;
    std::size_t last_plate = count;
    for (std::size_t n = 0; n < count; ++n) {
      if (isPlate(at(n))) {
        last_plate = n;
        continue;
      }
      if (last_plate == count || last_plate < run) continue;
      std::size_t low = 0, seen = 0;
      for (std::size_t m = n; m < count && seen < 2 * run; ++m, ++seen) low += isLow(at(m)) ? 1U : 0U;
      if (low < run + run / 2) continue;
      // Outliers just before the rim must not hide plate samples between.
      const Eigen::Vector3d& a = p[at(last_plate)];
      std::size_t m = last_plate + 1;
      while (m < count && !isLow(at(m))) ++m;
      const Eigen::Vector3d& b = p[at(m)];
      const double gap = std::abs(b.x() - a.x());
      RimPoint point;
      // The rim lies within one spacing of the last plate sample. What is missing beyond it is the shadow of the wall
      // or, rarely, a lost sample of the plate: then it may lie further in.
      const double x = a.x() + (side < 0 ? 0.5 : -0.5) * spacing;
      point.point_mm << x, a.y(), plane.at(x, a.y());
      point.sigma_x_mm = std::clamp(gap, spacing, 4.0 * spacing) / std::sqrt(12.0);
      rim.push_back(point);
      break;
    }
  }
}

Eigen::Vector3d toTool(const Parameters& q, ScanModel model, const Eigen::Vector3d& p) {
  const Eigen::Matrix3d r = RigidTransform::fromAlphaBetaGamma(q[0], q[1], q[2], Eigen::Vector3d::Zero()).rotation();
  const Eigen::Vector3d d = q.segment<3>(3);
  if (model == ScanModel::Rigid) return r * p + d;
  return r * Eigen::Vector3d(p.x(), 0.0, p.z()) + Eigen::Vector3d(0.0, p.y(), 0.0) + d;
}

/// The plane that the parameters predict: height, slope x, slope y.
Eigen::Vector3d predictedPlane(const Parameters& q, ScanModel model, double plate_z) {
  const Eigen::Matrix3d r = RigidTransform::fromAlphaBetaGamma(q[0], q[1], q[2], Eigen::Vector3d::Zero()).rotation();
  return {(plate_z - q[5]) / r(2, 2), -r(2, 0) / r(2, 2), model == ScanModel::Rigid ? -r(2, 1) / r(2, 2) : 0.0};
}

}  // namespace

void CalibrationOptions::validate() const {
  if (!(mounting_angle_rad > 0.0)) throw InputError("The uncertainty of the mounting must be positive (rad).");
  for (const auto& known : known_angles_rad)
    if (known && (!std::isfinite((*known)[0]) || std::abs((*known)[0]) > 0.5 || !((*known)[1] > 0.0)))
      throw InputError(fmt::format(
          "Known angle of the mounting: found {} ± {} rad; allowed: within 0.5 rad, with an uncertainty above 0.",
          (*known)[0], (*known)[1]));
  if (!(radius_uncertainty_mm > 0.0) || !(rim_roughness_mm > 0.0))
    throw InputError("The uncertainties of the pocket must be positive (mm).");
}

std::string mountingInWords(std::string_view key) {
  if (key == "alpha_rad") return "α about X";
  if (key == "beta_rad") return "β about Y";
  if (key == "gamma_rad") return "γ about Z";
  return std::string(key.substr(0, key.find('_')));
}

Eigen::Matrix3d ProfilerCalibration::rotation() const {
  return RigidTransform::fromAlphaBetaGamma(alpha_rad, beta_rad, gamma_rad, Eigen::Vector3d::Zero()).rotation();
}

RigidTransform ProfilerCalibration::tcsFromProfiler(double lift_mm) const {
  return RigidTransform::fromAlphaBetaGamma(alpha_rad, beta_rad, gamma_rad,
                                            offset_mm - Eigen::Vector3d(0.0, 0.0, lift_mm));
}

ProfilerCalibration calibrateProfiler(const PointCloud& scan, const std::array<double, 4>& circle_mm,
                                      const CalibrationOptions& options) {
  options.validate();
  for (const double v : circle_mm)
    if (!std::isfinite(v)) throw InputError("The circle of the pocket must be four numbers x,y,z,r (mm).");
  const double radius = circle_mm[3];
  if (!(radius > 0.0)) throw InputError(fmt::format("The radius of the pocket is {} mm; allowed: positive.", radius));
  requireUsableCloud(scan, 1000);
  if (scan.profileCount() < 10)
    throw InputError(
        fmt::format("{} is not ordered in profiles; a calibration needs the scan as it was measured.", scan.name));
  ProfilerCalibration result;
  result.scan_model = options.scan_model;
  const auto reject = [&](std::string message) {
    result.status = FitStatus::Rejected;
    result.message = std::move(message);
    return result;
  };
  const Eigen::Vector2d slope = typicalSlope(scan);
  const std::optional<Levels> levels = findLevels(scan, slope);
  if (!levels) return reject("The scan shows no pocket: there is only one level, not a plate and a floor.");
  const double depth = levels->plate - levels->floor;
  const Plane plane = fitPlate(scan, slope, *levels);
  const CloudSpacing spacing = cloudSpacing(scan);
  for (std::size_t k = 0; k < scan.profileCount(); ++k)
    findRim(scan, k, plane, depth, spacing.along_profile_mm, result.rim);
  if (result.rim.size() < 20)
    return reject(
        fmt::format("The rim of the pocket is seen in only {} places; at least 20 are needed.", result.rim.size()));

  // Start: the circle's centre by algebraic least squares with the known radius as a check.
  Eigen::Matrix3d n = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector2d> places;
  for (const RimPoint& r : result.rim) places.push_back(r.point_mm.head<2>());
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double found_radius = 0.0;
  for (int pass = 0; pass < 4; ++pass) {
    n.setZero();
    right.setZero();
    std::vector<double> distances;
    for (const Eigen::Vector2d& p : places) distances.push_back(std::abs((p - centre).norm() - found_radius));
    const double limit = pass == 0 ? 1e300 : std::max(5.0 * 1.4826 * median(distances), 0.05);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (distances[i] > limit) continue;
      const Eigen::Vector3d row(places[i].x(), places[i].y(), 1.0);
      n += row * row.transpose();
      right += places[i].squaredNorm() * row;
    }
    const Eigen::Vector3d s = n.ldlt().solve(right);
    centre = 0.5 * s.head<2>();
    found_radius = std::sqrt(std::max(0.0, s.z() + centre.squaredNorm()));
  }
  if (std::abs(found_radius - radius) > 0.05 * radius + 0.2)
    return reject(fmt::format("The pocket in the scan has a radius of {:.3f} mm, the circle given has {:.3f} mm.",
                              found_radius, radius));

  Parameters q = Parameters::Zero();
  q.segment<3>(3) << circle_mm[0] - centre.x(), circle_mm[1] - centre.y(), circle_mm[2] - plane.coefficients[0];
  // Observations: rim, plane (3), mounting (3), radius (1).
  const auto rims = static_cast<Eigen::Index>(result.rim.size());
  const Eigen::Index rows = rims + 7;
  const Eigen::Matrix3d plane_root = plane.covariance.llt().matrixL();
  const Eigen::Vector2d middle(circle_mm[0], circle_mm[1]);
  double rim_scale = 1.0;
  const auto whitened = [&](const Parameters& at, Eigen::VectorXd& raw_rim) {
    Eigen::VectorXd r(rows);
    raw_rim.resize(rims);
    // The samples of a profile are sharp across its own direction, wherever that points.
    const Eigen::Vector2d along =
        RigidTransform::fromAlphaBetaGamma(at[0], at[1], at[2], Eigen::Vector3d::Zero()).rotation().col(0).head<2>();
    for (Eigen::Index i = 0; i < rims; ++i) {
      const RimPoint& rim = result.rim[static_cast<std::size_t>(i)];
      const Eigen::Vector2d d = toTool(at, options.scan_model, rim.point_mm).head<2>() - middle;
      raw_rim[i] = d.norm() - radius - at[6];
      const double sigma = std::hypot(rim.sigma_x_mm * along.dot(d) / d.norm(), options.rim_roughness_mm);
      r[i] = raw_rim[i] / sigma;
    }
    Eigen::Vector3d plane_residual = plane.coefficients - predictedPlane(at, options.scan_model, circle_mm[2]);
    if (options.scan_model == ScanModel::PushBroom) plane_residual[2] = 0.0;  // a plate that is not level
    r.segment<3>(rims) = plane_root.triangularView<Eigen::Lower>().solve(plane_residual);
    for (int i = 0; i < 3; ++i) {
      const auto& known = options.known_angles_rad[static_cast<std::size_t>(i)];
      r[rims + 3 + i] = known ? (at[i] - (*known)[0]) / (*known)[1] : at[i] / options.mounting_angle_rad;
    }
    r[rims + 6] = at[6] / options.radius_uncertainty_mm;
    return r;
  };
  Eigen::VectorXd raw(rims), weights = Eigen::VectorXd::Ones(rows), unused(rims);
  Eigen::Matrix<double, 7, 7> normal;
  bool settled = false;
  for (int iteration = 0; iteration < 40 && !settled; ++iteration) {
    const Eigen::VectorXd r = whitened(q, raw);
    std::vector<double> sizes;
    for (Eigen::Index i = 0; i < rims; ++i) sizes.push_back(std::abs(r[i]));
    if (iteration < 10) rim_scale = std::max(1.4826 * median(sizes), 0.3);
    for (Eigen::Index i = 0; i < rims; ++i) weights[i] = tukeyWeight(r[i] / rim_scale, 6.0);
    Eigen::MatrixXd jacobian(rows, 7);
    for (int j = 0; j < 7; ++j) {
      Parameters moved = q;
      const double h = j < 3 ? 1e-6 : 1e-5;
      moved[j] += h;
      Parameters back = q;
      back[j] -= h;
      jacobian.col(j) = (whitened(moved, unused) - whitened(back, unused)) / (2.0 * h);
    }
    normal = jacobian.transpose() * weights.asDiagonal() * jacobian;
    const Parameters step = -normal.ldlt().solve(jacobian.transpose() * weights.asDiagonal() * r);
    q += step;
    // A step far below the uncertainty, also along the direction that is hardly determined.
    settled = step.dot(normal * step) < 1e-8;
  }
  if (!settled) {
    result.status = FitStatus::NoConvergence;
    result.message = "The fit of the pocket's rim did not settle.";
    return result;
  }
  const Eigen::VectorXd r = whitened(q, raw);
  double chi2 = 0.0, used = 0.0, squares = 0.0;
  for (Eigen::Index i = 0; i < rims; ++i) {
    RimPoint& rim = result.rim[static_cast<std::size_t>(i)];
    rim.residual_um = um_per_mm * raw[i];
    rim.used = weights[i] > 0.0;
    if (!rim.used) continue;
    chi2 += r[i] * r[i];
    squares += raw[i] * raw[i];
    used += 1.0;
  }
  const double factor = std::max(1.0, chi2 / std::max(1.0, used - 5.0));
  result.covariance = factor * normal.inverse().topLeftCorner<6, 6>();
  // Second order: an angle that is known only by its mounting changes the lengths by its square as well.
  const double alpha2 = result.covariance(0, 0) / std::sqrt(2.0), gamma2 = result.covariance(2, 2) / std::sqrt(2.0);
  const double height2 = std::pow(plane.coefficients[0] * alpha2, 2);
  const double place2 = centre.squaredNorm() * gamma2 * gamma2;
  result.covariance.diagonal().tail<3>() += Eigen::Vector3d(place2, place2 + height2, height2);
  result.alpha_rad = q[0];
  result.beta_rad = q[1];
  result.gamma_rad = q[2];
  result.offset_mm = q.segment<3>(3);
  result.radius_offset_um = um_per_mm * q[6];
  result.rim_rms_um = um_per_mm * std::sqrt(squares / std::max(used, 1.0));
  result.plane_rms_um = um_per_mm * plane.rms;
  if (options.scan_model == ScanModel::PushBroom) result.unexplained_slope_rad = plane.coefficients[2];
  if (used < 0.5 * static_cast<double>(rims))
    return reject(fmt::format("Only {:.0f} of {} points of the rim lie on one circle.", used, rims));
  result.status = FitStatus::Converged;
  constexpr std::array<const char*, 3> names{"alpha_rad", "beta_rad", "gamma_rad"};
  for (int i = 0; i < 3; ++i)
    if (!options.known_angles_rad[static_cast<std::size_t>(i)] &&
        result.standardUncertainty(i) > 0.3 * options.mounting_angle_rad) {
      result.undetermined.emplace_back(names[static_cast<std::size_t>(i)]);
      // Not measured: the mounting's own uncertainty, nothing less.
      result.message += fmt::format(
          "{} cannot be determined under the scan model {} ({}): {:.1f} mrad is what the mounting is assumed to "
          "have, with a standard uncertainty of {:.1f} mrad that dx, dy carry along. ",
          mountingInWords(names[static_cast<std::size_t>(i)]), printedName(options.scan_model),
          options.scan_model == ScanModel::Rigid ? "a circle is invariant under rotation about its axis"
                                                 : "the height of a point does not depend on where the carriage stands",
          std::abs(q[i]) < 5e-5 ? 0.0 : 1e3 * q[i], 1e3 * result.standardUncertainty(i));
    }
  if (std::abs(result.unexplained_slope_rad) > 1e-3)
    result.message += fmt::format(
        "The plate rises by {:.2f} mrad along the scan, which the scan model push broom cannot explain: the "
        "plate is not level, or the scan is rigid. ",
        1e3 * result.unexplained_slope_rad);
  while (!result.message.empty() && result.message.back() == ' ') result.message.pop_back();
  return result;
}

}  // namespace spindrift
