// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/cell_grid.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/math/statistics.h"
#include "core/scanning/robust_box.h"

namespace spindrift {
namespace {

/// Sums over the points of a cell about its centre.
struct Sums {
  double n = 0, u = 0, v = 0, z = 0, uu = 0, uv = 0, vv = 0, uz = 0, vz = 0, zz = 0;
  void add(double du, double dv, double dz) noexcept {
    n += 1.0;
    u += du;
    v += dv;
    z += dz;
    uu += du * du;
    uv += du * dv;
    vv += dv * dv;
    uz += du * dz;
    vz += dv * dz;
    zz += dz * dz;
  }
};

SurfaceCell cellFrom(const Sums& s, const Eigen::Vector2d& centre, const Eigen::Vector2d& size) {
  SurfaceCell cell;
  if (s.n < 1.0) return cell;
  const double u = s.u / s.n, v = s.v / s.n, z = s.z / s.n;
  cell.count = s.n;
  cell.mean << centre.x() + u, centre.y() + v, z;
  cell.sxx = std::max(0.0, s.uu / s.n - u * u);
  cell.sxy = s.uv / s.n - u * v;
  cell.syy = std::max(0.0, s.vv / s.n - v * v);
  const double sxz = s.uz / s.n - u * z, syz = s.vz / s.n - v * z;
  const double szz = std::max(0.0, s.zz / s.n - z * z);
  // A touch of regularisation: a cell crossed by a single profile has no slope across it.
  const double small = 1e-6 * size.squaredNorm();
  const double a = cell.sxx + small, c = cell.syy + small;
  const double det = a * c - cell.sxy * cell.sxy;
  cell.slope = det > 0.0 ? Eigen::Vector2d((c * sxz - cell.sxy * syz) / det, (a * syz - cell.sxy * sxz) / det)
                         : Eigen::Vector2d::Zero();
  const double rest = szz - cell.slope.x() * sxz - cell.slope.y() * syz;
  const double freedom = s.n - 3.0;
  cell.variance = freedom > 0.5 ? std::max(0.0, rest) * s.n / freedom : -1.0;
  return cell;
}

double varianceLimit(double count) {
  const double freedom = std::max(1.0, count - 3.0);
  return 1.0 + 6.0 * std::sqrt(2.0 / freedom);
}

/// Cells with too much spread get their points looked at one by one.
class CellRepair {
 public:
  CellRepair(const PointCloud& cloud, CellGrid& grid, double variance, double threshold)
      : cloud_(cloud), grid_(grid), variance_(variance), threshold_(threshold) {}

  void run(const std::vector<std::int32_t>& slot, std::vector<std::vector<Eigen::Vector3d>>& points,
           const std::vector<std::uint32_t>& cells) {
    for (const std::uint32_t c : cells) repair(c, points[static_cast<std::size_t>(slot[c])], slot);
  }

 private:
  void repair(std::uint32_t index, const std::vector<Eigen::Vector3d>& points, const std::vector<std::int32_t>& slot) {
    const int column = static_cast<int>(index) % grid_.columns;
    const int row = static_cast<int>(index) / grid_.columns;
    const Eigen::Vector2d centre =
        grid_.low + Eigen::Vector2d((column + 0.5) * grid_.size.x(), (row + 0.5) * grid_.size.y());
    // Slope from sound neighbours, level from the median: outliers in this cell have no say.
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    double sum = 0.0;
    for (int reach = 1; reach <= 2 && sum < 3.0; ++reach) {
      slope.setZero();
      sum = 0.0;
      for (int r = std::max(0, row - reach); r <= std::min(grid_.rows - 1, row + reach); ++r)
        for (int c = std::max(0, column - reach); c <= std::min(grid_.columns - 1, column + reach); ++c) {
          const auto k =
              static_cast<std::size_t>(r) * static_cast<std::size_t>(grid_.columns) + static_cast<std::size_t>(c);
          if (slot[k] >= 0 || grid_.cells[k].count < 4.0) continue;
          slope += grid_.cells[k].slope;
          sum += 1.0;
        }
    }
    if (sum > 0.0) slope /= sum;
    std::vector<double> level;
    level.reserve(points.size());
    for (const Eigen::Vector3d& p : points) level.push_back(p.z() - slope.dot(p.head<2>() - centre));
    const double middle = median(level);
    std::vector<double> distance;
    for (const double l : level) distance.push_back(std::abs(l - middle));
    const double own = 1.4826 * median(distance);
    const double sigma = std::sqrt(variance_);
    const double scale = std::clamp(own, sigma, 4.0 * sigma);
    Sums sums;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (distance[i] <= threshold_ * scale)
        sums.add(points[i].x() - centre.x(), points[i].y() - centre.y(), points[i].z());
    SurfaceCell& cell = grid_.cells[index];
    if (sums.n < 3.0 || sums.n < 0.5 * static_cast<double>(points.size())) {
      cell = SurfaceCell{};
      return;
    }
    cell = cellFrom(sums, centre, grid_.size);
    if (cell.variance > 25.0 * variance_) cell = SurfaceCell{};
  }

  const PointCloud& cloud_;
  CellGrid& grid_;
  double variance_;
  double threshold_;
};

}  // namespace

std::size_t CellGrid::filledCells() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [](const SurfaceCell& c) { return c.count > 0.0; }));
}

namespace {

/// Noise and curvature along the profiles.
struct ProfileCharacter {
  double noise = 0.0;       ///< mm, fourth differences of neighbouring points: blind to curvature
  double noise_wide = 0.0;  ///< mm, of points three apart: holds short correlated noise in full
  double curvature = 0.0;   ///< 1/mm, from second differences over half a millimetre
};
ProfileCharacter characterOf(const PointCloud& cloud, double spacing) {
  ProfileCharacter out;
  const auto& p = cloud.points_mm;
  const std::size_t step = std::max<std::size_t>(1, cloud.profileCount() / 60);
  const std::size_t stride = std::max<std::size_t>(1, cloud.size() / cloud.profileCount() / 200);
  // Robust spread of the second (reach 1) or fourth (reach 2) difference of points `apart` samples from each other.
  const auto spread = [&](std::size_t apart, std::size_t reach) {
    std::vector<double> values;
    const std::size_t wide = reach * apart;
    const double length = 2.0 * static_cast<double>(wide) * spacing;
    for (std::size_t k = 0; k < cloud.profileCount(); k += step)
      for (std::size_t i = cloud.profile_start[k] + wide; i + wide < cloud.profile_start[k + 1]; i += stride) {
        if (std::abs(std::abs(p[i + wide].x() - p[i - wide].x()) - length) > 0.5 * spacing) continue;  // a lost sample
        const double second = p[i - apart].z() - 2.0 * p[i].z() + p[i + apart].z();
        const double fourth = p[i - wide].z() + p[i + wide].z() - 4.0 * second - 2.0 * p[i].z();
        values.push_back(std::abs(reach == 1 ? second : fourth));
      }
    return values.size() < 20 ? 0.0 : 1.4826 * median(std::move(values));
  };
  out.noise = spread(1, 2) / std::sqrt(70.0);
  out.noise_wide = spread(3, 2) / std::sqrt(70.0);
  const auto far = static_cast<std::size_t>(std::max(2.0, 0.4 / std::max(spacing, 1e-9)));
  const double distance = static_cast<double>(far) * spacing;
  const double wide = spread(far, 1);
  out.curvature = std::sqrt(std::max(0.0, wide * wide - 6.0 * out.noise * out.noise)) / (distance * distance);
  return out;
}

}  // namespace

namespace {

Eigen::Vector2d suitableCell_mm(const PointCloud& cloud, const CloudSpacing& s, const ProfileCharacter& c) {
  const double points = std::clamp(static_cast<double>(cloud.size()) / 2000.0, 6.0, 32.0);
  const double area = points * s.along_profile_mm * s.between_profiles_mm;
  if (cloud.profileCount() == 0) return Eigen::Vector2d::Constant(std::sqrt(std::min(area, 12.0 * area / points)));
  double y = std::sqrt(area);
  double x = area / y;
  // Within a cell the surface may bend by no more than the noise.
  if (c.curvature > 0.0) {
    const double flat = std::sqrt(20.0 * std::max(c.noise, 2e-5) / c.curvature);
    x = std::min(x, flat);
    y = std::min(y, flat);
  }
  // Whole profiles and whole samples, so that the mean of a cell lies at its centre: a lattice out of step with the
  // scan would put its beat into the surface and amplify the noise.
  const double profiles = std::max(1.0, std::round(y / s.between_profiles_mm));
  y = profiles * s.between_profiles_mm;
  x = std::max(2.0, std::round(x / s.along_profile_mm)) * s.along_profile_mm;
  return {x, y};
}

ProfileCharacter characterIfProfiles(const PointCloud& cloud, const CloudSpacing& spacing) {
  return cloud.profileCount() > 0 ? characterOf(cloud, spacing.along_profile_mm) : ProfileCharacter{};
}

/// Cells of few points cannot see an outlier among themselves: their height is compared with the line through their
/// neighbours, along and across; a cell that is off both ways is dropped.
void dropOutlyingCells(CellGrid& grid) {
  const double none = std::numeric_limits<double>::infinity();
  const auto index = [&](int c, int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(c);
  };
  const auto bend = [&](int c, int r, int dc, int dr) {
    if (c < dc || r < dr || c + dc >= grid.columns || r + dr >= grid.rows) return none;
    const SurfaceCell &a = grid.cells[index(c - dc, r - dr)], &b = grid.cells[index(c + dc, r + dr)];
    if (a.count <= 0.0 || b.count <= 0.0) return none;
    return std::abs(grid.cells[index(c, r)].mean.z() - 0.5 * (a.mean.z() + b.mean.z()));
  };
  std::vector<double> along(grid.cells.size(), none), across(grid.cells.size(), none), known_along, known_across;
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const std::size_t k = index(c, r);
      if (grid.cells[k].count <= 0.0) continue;
      along[k] = bend(c, r, 1, 0);
      across[k] = bend(c, r, 0, 1);
      if (along[k] < none) known_along.push_back(along[k]);
      if (across[k] < none) known_across.push_back(across[k]);
    }
  if (known_along.size() < 20 || known_across.size() < 20) return;
  const double limit_along = 10.0 * median(std::move(known_along));
  const double limit_across = 10.0 * median(std::move(known_across));
  for (std::size_t k = 0; k < grid.cells.size(); ++k)
    if (grid.cells[k].count > 0.0 && std::min(along[k], across[k]) < none && along[k] > limit_along &&
        across[k] > limit_across)
      grid.cells[k] = SurfaceCell{};
}

}  // namespace

Eigen::Vector2d suitableCell_mm(const PointCloud& cloud) {
  const CloudSpacing spacing = cloudSpacing(cloud);
  return suitableCell_mm(cloud, spacing, characterIfProfiles(cloud, spacing));
}

CellGrid compressCloud(const PointCloud& cloud, const CellGridOptions& options) {
  if (!options.checked) requireUsableCloud(cloud, 50);
  CellGrid grid;
  const CloudSpacing spacing = cloudSpacing(cloud);
  const ProfileCharacter character = characterIfProfiles(cloud, spacing);
  grid.size = options.cell_mm.minCoeff() > 0.0 ? options.cell_mm : suitableCell_mm(cloud, spacing, character);
  if (!(grid.size.minCoeff() > 0.0)) throw InputError(fmt::format("{} has no extent in x or y.", cloud.name));
  const RobustBox plausible = plausibleBox(cloud);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const Eigen::Vector3d& p : cloud.points_mm) {
    if (!isInside(plausible, p)) {
      ++grid.stray_points;
      continue;
    }
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  }
  // The lattice begins half a spacing before the first sample, so that its lines run between samples.
  grid.low =
      low - (cloud.profileCount() > 0 ? 0.5 * Eigen::Vector2d(spacing.along_profile_mm, spacing.between_profiles_mm)
                                      : Eigen::Vector2d(1e-9 * grid.size));
  const Eigen::Vector2d extent = (high - grid.low).cwiseQuotient(grid.size);
  if (extent.maxCoeff() > 30000.0 || extent.x() * extent.y() > 100.0 * static_cast<double>(cloud.size()) + 1e5)
    throw InputError(fmt::format("{} is too sparse for a height map: {} points over {:.3g} mm x {:.3g} mm.", cloud.name,
                                 cloud.size(), high.x() - low.x(), high.y() - low.y()));
  grid.columns = static_cast<int>(extent.x()) + 1;
  grid.rows = static_cast<int>(extent.y()) + 1;
  const auto total = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);

  std::vector<Sums> sums(total);
  const Eigen::Vector2d inverse = grid.size.cwiseInverse();
  const auto place = [&](const Eigen::Vector3d& p, int& column, int& row) {
    column = static_cast<int>((p.x() - grid.low.x()) * inverse.x());
    row = static_cast<int>((p.y() - grid.low.y()) * inverse.y());
  };
  for (const Eigen::Vector3d& p : cloud.points_mm) {
    if (!isInside(plausible, p)) continue;
    int column = 0, row = 0;
    place(p, column, row);
    const double u = p.x() - (grid.low.x() + (column + 0.5) * grid.size.x());
    const double v = p.y() - (grid.low.y() + (row + 0.5) * grid.size.y());
    sums[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column)].add(
        u, v, p.z());
  }
  grid.cells.resize(total);
  std::vector<double> variances;
  variances.reserve(total);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const auto k =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
      const Eigen::Vector2d centre =
          grid.low + Eigen::Vector2d((column + 0.5) * grid.size.x(), (row + 0.5) * grid.size.y());
      grid.cells[k] = cellFrom(sums[k], centre, grid.size);
      if (grid.cells[k].variance >= 0.0) variances.push_back(grid.cells[k].variance);
    }
  double typical = character.noise * character.noise;
  if (!variances.empty()) {
    // The median of a chi-squared variable lies below its mean.
    const double freedom =
        std::max(1.0, static_cast<double>(cloud.size()) / static_cast<double>(variances.size()) - 3.0);
    typical = std::max(typical, median(std::move(variances)) / std::pow(1.0 - 2.0 / (9.0 * freedom), 3.0));
  }
  typical = std::max(typical, 1e-18);

  std::vector<std::int32_t> slot(total, -1);
  std::vector<std::uint32_t> suspects;
  for (std::size_t k = 0; k < total; ++k) {
    const SurfaceCell& cell = grid.cells[k];
    if (cell.count > 0.0 && cell.variance > varianceLimit(cell.count) * typical) {
      slot[k] = static_cast<std::int32_t>(suspects.size());
      suspects.push_back(static_cast<std::uint32_t>(k));
    }
  }
  if (!suspects.empty()) {
    std::vector<std::vector<Eigen::Vector3d>> points(suspects.size());
    for (const Eigen::Vector3d& p : cloud.points_mm) {
      if (!isInside(plausible, p)) continue;
      int column = 0, row = 0;
      place(p, column, row);
      const std::int32_t s = slot[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                                  static_cast<std::size_t>(column)];
      if (s >= 0) points[static_cast<std::size_t>(s)].push_back(p);
    }
    CellRepair(cloud, grid, typical, options.outlier_threshold).run(slot, points, suspects);
  }
  grid.noise_mm = std::sqrt(typical);
  // Where cells are coarse their planes miss the curvature: neighbouring points tell the noise better.
  if (character.noise > 0.0) grid.noise_mm = std::max(character.noise, std::min(grid.noise_mm, character.noise_wide));
  if (cloud.profileCount() > 0) dropOutlyingCells(grid);
  double used = 0.0;
  for (const SurfaceCell& cell : grid.cells) {
    used += cell.count;
    grid.centroid_mm += cell.count * cell.mean;
  }
  if (used < 50.0)
    throw InputError(fmt::format("{} holds no smooth surface: only {:.0f} of {} points agree with their neighbours.",
                                 cloud.name, used, cloud.size()));
  grid.centroid_mm /= used;
  grid.point_count = static_cast<std::size_t>(used);
  grid.rejected_points = cloud.size() - grid.point_count;
  return grid;
}

}  // namespace spindrift
