// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/axis_directions.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/units.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

struct Line {
  bool measured = false;
  Eigen::Vector2d slope_um_per_mm = Eigen::Vector2d::Zero();
  double spread_mm2 = 0.0;  ///< sum of squared distances from the mean position
  double chi2 = 0.0;
  int degrees_of_freedom = 0;
};

/// `axis`: 0 for X, 1 for Y. Movement along the other axis between images is not part of the line.
Line fitLine(const std::vector<AxisImage>& images, int axis) {
  Line line;
  if (images.size() < 2) return line;
  const auto n = static_cast<double>(images.size());
  double mean_c = 0.0;
  Eigen::Vector2d mean_p = Eigen::Vector2d::Zero();
  for (const AxisImage& image : images) {
    mean_c += image.commanded_mm[axis] / n;
    mean_p += image.pose.patternAt(Eigen::Vector2d::Zero()) / n;
  }
  Eigen::Vector2d product = Eigen::Vector2d::Zero();
  for (const AxisImage& image : images) {
    const double c = image.commanded_mm[axis] - mean_c;
    line.spread_mm2 += c * c;
    product += c * (image.pose.patternAt(Eigen::Vector2d::Zero()) - mean_p);
  }
  if (!(line.spread_mm2 > 1e-8)) return line;
  line.slope_um_per_mm = product / line.spread_mm2;
  if (!(line.slope_um_per_mm.norm() > 1.0)) return line;  // the axis did not move
  for (const AxisImage& image : images) {
    const double c = image.commanded_mm[axis] - mean_c;
    line.chi2 += (image.pose.patternAt(Eigen::Vector2d::Zero()) - mean_p - line.slope_um_per_mm * c).squaredNorm();
  }
  line.degrees_of_freedom = 2 * (static_cast<int>(images.size()) - 2);
  line.measured = true;
  return line;
}

AxisDirection axisDirectionOf(const Line& line, double variance_um2, const std::vector<AxisImage>& images) {
  AxisDirection direction;
  direction.measured = line.measured;
  if (!line.measured) return direction;
  const double length = line.slope_um_per_mm.norm();
  const double slope_sigma = std::sqrt(variance_um2 / line.spread_mm2);
  direction.angle_rad = std::atan2(line.slope_um_per_mm.y(), line.slope_um_per_mm.x());
  direction.sigma_rad = slope_sigma / length;
  direction.scale_error = length / um_per_mm - 1.0;
  direction.scale_error_sigma = slope_sigma / um_per_mm;
  const Eigen::Vector2d in_image = images.front().pose.patternPerPixel().inverse() * line.slope_um_per_mm;
  direction.image_angle_rad = std::atan2(in_image.y(), in_image.x());
  return direction;
}

double meanOrientation(const AxisSet& set, double reference) {
  double sum = 0.0;
  double count = 0.0;
  for (const std::vector<AxisImage>* images : {&set.x, &set.y}) {
    for (const AxisImage& image : *images) {
      sum += angleDifference(image.pose.orientation_rad() + image.spindle_deg * rad_per_deg, reference);
      count += 1.0;
    }
  }
  return reference + sum / count;
}

}  // namespace

double angleDifference(double a_rad, double b_rad) {
  return std::remainder(a_rad - b_rad, 2.0 * std::numbers::pi);
}

AxisDirections fitAxisDirections(const std::vector<AxisSet>& sets, const AxisOptions& options) {
  AxisDirections result;
  std::vector<std::pair<Line, Line>> lines;
  double chi2 = options.expected_weight * options.expected_repeatability_um * options.expected_repeatability_um;
  double dof = options.expected_weight;
  for (const AxisSet& set : sets) {
    const Line x = fitLine(set.x, 0);
    const Line y = fitLine(set.y, 1);
    if (x.measured) {
      chi2 += x.chi2;
      dof += x.degrees_of_freedom;
    }
    if (y.measured) {
      chi2 += y.chi2;
      dof += y.degrees_of_freedom;
    }
    lines.emplace_back(x, y);
  }
  const double variance =
      dof > 0.0 ? chi2 / dof : options.expected_repeatability_um * options.expected_repeatability_um;
  result.repeatability_um = std::sqrt(variance);
  result.repeatability_sigma_um = result.repeatability_um / std::sqrt(2.0 * std::max(dof, 1.0));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    SetDirections directions;
    directions.fiducial = sets[i].fiducial;
    directions.state = sets[i].state;
    directions.x = axisDirectionOf(lines[i].first, variance, sets[i].x);
    directions.y = axisDirectionOf(lines[i].second, variance, sets[i].y);
    if (!directions.x.measured && !directions.y.measured) continue;
    // R(-psi) turns MCF X into FCF: the axis X lies at -psi in FCF, Y at pi/2 - psi.
    const double from_x = -directions.x.angle_rad;
    const double from_y = std::numbers::pi / 2 - directions.y.angle_rad;
    directions.both = directions.x.measured && directions.y.measured;
    if (directions.both) {
      const double wx = 1.0 / (directions.x.sigma_rad * directions.x.sigma_rad);
      const double wy = 1.0 / (directions.y.sigma_rad * directions.y.sigma_rad);
      directions.psi_rad = from_x + angleDifference(from_y, from_x) * wy / (wx + wy);
      directions.psi_sigma_rad = 1.0 / std::sqrt(wx + wy);
      directions.orthogonality_rad =
          angleDifference(directions.y.angle_rad - directions.x.angle_rad, std::numbers::pi / 2);
      directions.orthogonality_sigma_rad = std::hypot(directions.x.sigma_rad, directions.y.sigma_rad);
    } else {
      directions.psi_rad = directions.x.measured ? from_x : from_y;
      directions.psi_sigma_rad = directions.x.measured ? directions.x.sigma_rad : directions.y.sigma_rad;
    }
    const AxisImage& any = sets[i].x.empty() ? sets[i].y.front() : sets[i].x.front();
    const double reference = any.pose.orientation_rad() + any.spindle_deg * rad_per_deg;
    directions.phi_rad = angleDifference(meanOrientation(sets[i], reference), directions.psi_rad);
    result.sets.push_back(directions);
  }
  if (result.sets.empty()) {
    result.status = FitStatus::Degenerate;
    result.message = "no images along the machine's X or Y axis could be used";
    return result;
  }
  // A column with the wrong sign: X and Y as in a mirror.
  const SetDirections* mirrored = nullptr;
  bool all_mirrored = true;
  for (const SetDirections& d : result.sets) {
    if (!d.both) continue;
    const bool clockwise = std::abs(d.orthogonality_rad) > std::numbers::pi / 2;
    all_mirrored = all_mirrored && clockwise;
    if (clockwise && mirrored == nullptr) mirrored = &d;
  }
  if (mirrored != nullptr && all_mirrored) {
    result.status = FitStatus::Rejected;
    result.message = fmt::format(
        "the images show the Y axis {:.1f}° clockwise from the X axis ({} in state {}); allowed: about 90° "
        "counter-clockwise, seen from above (has x_mm or y_mm the wrong sign?).",
        -angleDifference(mirrored->orthogonality_rad + std::numbers::pi / 2, 0.0) * deg_per_rad, mirrored->fiducial,
        mirrored->state);
    return result;
  }
  double weights = 0.0;
  double sum = 0.0;
  const double reference = result.sets.front().phi_rad;
  for (const SetDirections& d : result.sets) {
    const double w = 1.0 / (d.psi_sigma_rad * d.psi_sigma_rad);
    weights += w;
    sum += w * angleDifference(d.phi_rad, reference);
  }
  result.phi_rad = angleDifference(reference + sum / weights, 0.0);
  double scatter = 0.0;
  for (const SetDirections& d : result.sets) {
    scatter += std::pow(angleDifference(d.phi_rad, result.phi_rad) / d.psi_sigma_rad, 2);
  }
  const auto restrictions = static_cast<double>(result.sets.size()) - 1.0;
  result.p_value = restrictions > 0.0 ? chiSquaredTail(scatter, restrictions) : 1.0;
  result.pooled = result.p_value >= options.test_level;
  result.phi_sigma_rad = 1.0 / std::sqrt(weights);
  if (!result.pooled)
    result.phi_sigma_rad *= std::sqrt(static_cast<double>(result.sets.size()) * scatter / restrictions);
  result.status = FitStatus::Converged;
  result.message =
      result.pooled ? "one direction of the camera for all" : "the camera's direction differs between sets";
  return result;
}

}  // namespace spindrift
