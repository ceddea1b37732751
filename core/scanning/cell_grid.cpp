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

Eigen::Vector2d suitableCell_mm(const PointCloud& cloud) {
  const CloudSpacing s = cloudSpacing(cloud);
  const double points = std::clamp(static_cast<double>(cloud.size()) / 2000.0, 6.0, 32.0);
  const double area = points * s.along_profile_mm * s.between_profiles_mm;
  if (cloud.profileCount() == 0) return Eigen::Vector2d::Constant(std::sqrt(std::min(area, 12.0 * area / points)));
  double y = std::sqrt(area);
  double x = area / y;
  // Within a cell the surface may bend by no more than the noise.
  const ProfileCharacter c = characterOf(cloud, s.along_profile_mm);
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

namespace {

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

CellGrid compressCloud(const PointCloud& cloud, const CellGridOptions& options) {
  requireUsableCloud(cloud, 50);
  CellGrid grid;
  grid.size = options.cell_mm.minCoeff() > 0.0 ? options.cell_mm : suitableCell_mm(cloud);
  if (!(grid.size.minCoeff() > 0.0)) throw InputError(fmt::format("{} has no extent in x or y.", cloud.name));
  Eigen::Vector2d low = cloud.points_mm.front().head<2>();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector3d& p : cloud.points_mm) {
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  }
  // The lattice begins half a spacing before the first sample, so that its lines run between samples.
  const CloudSpacing spacing = cloudSpacing(cloud);
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
  const ProfileCharacter character =
      cloud.profileCount() > 0 ? characterOf(cloud, spacing.along_profile_mm) : ProfileCharacter{};
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

// --- spline ----------------------------------------------------------------------------------------------------------

namespace {

const double pole = std::sqrt(3.0) - 2.0;

/// B-spline weights of the four nodes around phase t and their derivatives.
inline void weights(double t, double* w, double* d, double* dd) noexcept {
  const double s = 1.0 - t;
  w[0] = s * s * s / 6.0;
  w[1] = (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0;
  w[2] = (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0;
  w[3] = t * t * t / 6.0;
  d[0] = -0.5 * s * s;
  d[1] = 1.5 * t * t - 2.0 * t;
  d[2] = -1.5 * s * s + 2.0 * s;
  d[3] = 0.5 * t * t;
  dd[0] = s;
  dd[1] = 3.0 * t - 2.0;
  dd[2] = 3.0 * s - 2.0;
  dd[3] = t;
}

/// A cell on the rim with points on one side of its node only: its node's height would be an extrapolation.
bool halfFilledOnRim(const CellGrid& grid, int column, int row, const Eigen::Vector2d& node) {
  const Eigen::Vector2d off = (grid.at(column, row).mean.head<2>() - node).cwiseQuotient(grid.size);
  const auto empty = [&](int c, int r) {
    return c < 0 || r < 0 || c >= grid.columns || r >= grid.rows || grid.at(c, r).count <= 0.0;
  };
  constexpr double most = 0.2;
  return (std::abs(off.x()) > most && empty(column + (off.x() < 0.0 ? 1 : -1), row)) ||
         (std::abs(off.y()) > most && empty(column, row + (off.y() < 0.0 ? 1 : -1)));
}

}  // namespace

HeightSpline::HeightSpline(const CellGrid& grid)
    : origin_(grid.low + 0.5 * grid.size - margin_ * grid.size),
      step_(grid.size),
      columns_(grid.columns + 2 * margin_),
      rows_(grid.rows + 2 * margin_) {
  const std::size_t total = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  count_.assign(total, 0.0F);
  // Cells of few points (on a rim) would put noise into their neighbours.
  std::vector<double> counts;
  for (const SurfaceCell& c : grid.cells)
    if (c.count > 0.0) counts.push_back(c.count);
  const double least = 0.25 * median(std::move(counts));
  std::vector<double> heights(total, 0.0);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const SurfaceCell& cell = grid.at(c, r);
      if (cell.count < least || cell.count < 2.0) continue;
      const std::size_t k = index(c + margin_, r + margin_);
      const Eigen::Vector2d node = origin_ + Eigen::Vector2d((c + margin_) * step_.x(), (r + margin_) * step_.y());
      if (halfFilledOnRim(grid, c, r, node)) continue;
      count_[k] = static_cast<float>(cell.count);
      // A cell crossed by a single profile (or column) knows its slope across only from its neighbours.
      Eigen::Vector2d slope = cell.slope;
      const auto across = [&](const SurfaceCell& low, const SurfaceCell& high, int axis) {
        const double distance = high.mean[axis] - low.mean[axis];
        if (low.count > 0.0 && high.count > 0.0 && distance > 0.3 * step_[axis])
          slope[axis] = (high.mean.z() - low.mean.z()) / distance;
      };
      if (cell.syy < 0.02 * step_.y() * step_.y())
        across(r > 0 ? grid.at(c, r - 1) : cell, r + 1 < grid.rows ? grid.at(c, r + 1) : cell, 1);
      if (cell.sxx < 0.02 * step_.x() * step_.x())
        across(c > 0 ? grid.at(c - 1, r) : cell, c + 1 < grid.columns ? grid.at(c + 1, r) : cell, 0);
      heights[k] = cell.mean.z() + slope.dot(node - cell.mean.head<2>());
    }
  inside_.assign(total, 0);
  for (int r = 0; r + 1 < rows_; ++r)
    for (int c = 0; c + 1 < columns_; ++c)
      inside_[index(c, r)] = count_[index(c, r)] > 0 && count_[index(c + 1, r)] > 0 && count_[index(c, r + 1)] > 0 &&
                             count_[index(c + 1, r + 1)] > 0;
  // The mean over a cell is turned into the height at its node with the derivatives of the spline itself.
  double change = 1.0;
  for (int pass = 0; pass < 4; ++pass) {
    fillHoles(heights);
    coefficients_ = heights;
    prefilter(coefficients_);
    if (pass == 3 || (pass >= 2 && change < 1e-6)) break;
    change = 0.0;
    for (int r = 0; r < grid.rows; ++r)
      for (int c = 0; c < grid.columns; ++c) {
        const std::size_t k = index(c + margin_, r + margin_);
        if (count_[k] <= 0.0F) continue;
        const SurfaceCell& cell = grid.at(c, r);
        // At the node itself (phase 0) the spline's derivatives need only its neighbours.
        const auto at = [&](int dc, int dr) { return coefficients_[index(c + margin_ + dc, r + margin_ + dr)]; };
        const auto smoothX = [&](int dr) { return (at(-1, dr) + 4.0 * at(0, dr) + at(1, dr)) / 6.0; };
        const auto smoothY = [&](int dc) { return (at(dc, -1) + 4.0 * at(dc, 0) + at(dc, 1)) / 6.0; };
        const double zx = (smoothY(1) - smoothY(-1)) / (2.0 * step_.x());
        const double zy = (smoothX(1) - smoothX(-1)) / (2.0 * step_.y());
        const double zxx = (smoothY(1) - 2.0 * smoothY(0) + smoothY(-1)) / (step_.x() * step_.x());
        const double zyy = (smoothX(1) - 2.0 * smoothX(0) + smoothX(-1)) / (step_.y() * step_.y());
        const double zxy = (at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1)) / (4.0 * step_.x() * step_.y());
        const double dx = cell.mean.x() - (origin_.x() + (c + margin_) * step_.x());
        const double dy = cell.mean.y() - (origin_.y() + (r + margin_) * step_.y());
        const double height =
            cell.mean.z() - zx * dx - zy * dy -
            0.5 * (zxx * (cell.sxx + dx * dx) + 2.0 * zxy * (cell.sxy + dx * dy) + zyy * (cell.syy + dy * dy));
        change = std::max(change, std::abs(height - heights[k]));
        heights[k] = height;
      }
  }
}

void HeightSpline::fillHoles(std::vector<double>& heights) const {
  // Layer by layer: the next node on a straight line (first layer: a cubic) through measured or filled ones. With a
  // parabola the third derivative of the surface would bend the outermost cells and tilt a scan by some urad.
  std::vector<std::uint8_t> known(heights.size(), 0);
  for (std::size_t k = 0; k < heights.size(); ++k) known[k] = count_[k] > 0.0F ? 1 : 0;
  std::vector<std::pair<std::size_t, double>> fresh;
  std::vector<int> open;
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < columns_; ++c)
      if (known[index(c, r)] == 0) open.push_back(r * columns_ + c);
  for (int layer = 0; !open.empty(); ++layer) {
    fresh.clear();
    std::vector<int> still;
    for (const int k : open) {
      const int r = k / columns_, c = k % columns_;
      double sum = 0.0, weight = 0.0;
      constexpr std::array<std::array<int, 2>, 8> directions{
          {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
      for (const auto& [dc, dr] : directions) {
        const auto value = [&](int n, double& out) {
          const int cc = c + n * dc, rr = r + n * dr;
          if (cc < 0 || rr < 0 || cc >= columns_ || rr >= rows_ || known[index(cc, rr)] == 0) return false;
          out = heights[index(cc, rr)];
          return true;
        };
        double a = 0.0, b = 0.0, d = 0.0, e = 0.0;
        if (!value(1, a)) continue;
        if (!value(2, b)) {
          sum += 0.01 * a;
          weight += 0.01;
        } else if (layer < 3 && value(3, d) && value(4, e)) {
          sum += 4.0 * a - 6.0 * b + 4.0 * d - e;
          weight += 1.0;
        } else if (layer == 0 && value(3, d)) {
          sum += 3.0 * a - 3.0 * b + d;
          weight += 1.0;
        } else {
          const double w = layer == 0 ? 0.2 : 1.0;
          sum += w * (2.0 * a - b);
          weight += w;
        }
      }
      if (weight > 0.0)
        fresh.emplace_back(static_cast<std::size_t>(k), sum / weight);
      else
        still.push_back(k);
    }
    if (fresh.empty()) break;
    for (const auto& [k, value] : fresh) {
      heights[k] = value;
      known[k] = 1;
    }
    open.swap(still);
    if (layer >= 2 * margin_) {  // far from everything measured: any bounded value will do
      for (const int k : open) heights[static_cast<std::size_t>(k)] = fresh.front().second;
      break;
    }
  }
}

void HeightSpline::prefilter(std::vector<double>& values) const {
  const double gain = 6.0;
  const auto line = [&](double* first, std::ptrdiff_t stride, int n) {
    // Causal and anti-causal recursion with mirrored ends.
    const int horizon = std::min(n, 30);
    double sum = first[0], power = pole;
    for (int i = 1; i < horizon; ++i, power *= pole) sum += power * first[i * stride];
    first[0] = sum;
    for (int i = 1; i < n; ++i) first[i * stride] += pole * first[(i - 1) * stride];
    double* last = first + (n - 1) * stride;
    *last = pole / (pole * pole - 1.0) * (*last + pole * last[-stride]);
    for (int i = n - 2; i >= 0; --i) first[i * stride] = pole * (first[(i + 1) * stride] - first[i * stride]);
    for (int i = 0; i < n; ++i) first[i * stride] *= gain;
  };
  for (int r = 0; r < rows_; ++r) line(values.data() + index(0, r), 1, columns_);
  // Columns together, so that the memory is walked along its rows.
  const auto n = static_cast<std::size_t>(columns_);
  std::vector<double> sum(values.begin(), values.begin() + columns_);
  double power = pole;
  for (int r = 1; r < std::min(rows_, 30); ++r, power *= pole)
    for (std::size_t c = 0; c < n; ++c) sum[c] += power * values[index(0, r) + c];
  std::copy(sum.begin(), sum.end(), values.begin());
  for (int r = 1; r < rows_; ++r)
    for (std::size_t c = 0; c < n; ++c) values[index(0, r) + c] += pole * values[index(0, r - 1) + c];
  for (std::size_t c = 0; c < n; ++c) {
    double& last = values[index(0, rows_ - 1) + c];
    last = pole / (pole * pole - 1.0) * (last + pole * values[index(0, rows_ - 2) + c]);
  }
  for (int r = rows_ - 2; r >= 0; --r)
    for (std::size_t c = 0; c < n; ++c)
      values[index(0, r) + c] = pole * (values[index(0, r + 1) + c] - values[index(0, r) + c]);
  for (double& v : values) v *= gain;
}

bool HeightSpline::evaluate(double x, double y, Value& value) const noexcept {
  const double fx = (x - origin_.x()) / step_.x();
  const double fy = (y - origin_.y()) / step_.y();
  if (!(fx >= 1.0) || !(fy >= 1.0) || !(fx < columns_ - 2) || !(fy < rows_ - 2)) return false;
  const int c = static_cast<int>(fx);
  const int r = static_cast<int>(fy);
  const double tx = fx - c;
  const double ty = fy - r;
  if (inside_[index(c, r)] == 0) {
    // Up to a quarter of a cell beyond the last node the spline may be continued.
    const bool near = (tx > 0.75 && inside_[index(c + 1, r)] != 0) || (tx < 0.25 && inside_[index(c - 1, r)] != 0) ||
                      (ty > 0.75 && inside_[index(c, r + 1)] != 0) || (ty < 0.25 && inside_[index(c, r - 1)] != 0);
    if (!near) return false;
  }
  double wx[4], dx[4], ddx[4], wy[4], dy[4], ddy[4];
  weights(tx, wx, dx, ddx);
  weights(ty, wy, dy, ddy);
  double z = 0, zx = 0, zy = 0, zxx = 0, zxy = 0, zyy = 0;
  const double* row = coefficients_.data() + index(c - 1, r - 1);
  for (int j = 0; j < 4; ++j, row += columns_) {
    const double s = wx[0] * row[0] + wx[1] * row[1] + wx[2] * row[2] + wx[3] * row[3];
    const double sx = dx[0] * row[0] + dx[1] * row[1] + dx[2] * row[2] + dx[3] * row[3];
    const double sxx = ddx[0] * row[0] + ddx[1] * row[1] + ddx[2] * row[2] + ddx[3] * row[3];
    z += wy[j] * s;
    zx += wy[j] * sx;
    zxx += wy[j] * sxx;
    zy += dy[j] * s;
    zxy += dy[j] * sx;
    zyy += ddy[j] * s;
  }
  const double ix = 1.0 / step_.x(), iy = 1.0 / step_.y();
  value.z = z;
  value.zx = zx * ix;
  value.zy = zy * iy;
  value.zxx = zxx * ix * ix;
  value.zxy = zxy * ix * iy;
  value.zyy = zyy * iy * iy;
  value.count = 0.0;
  for (const std::size_t k : {index(c, r), index(c + 1, r), index(c, r + 1), index(c + 1, r + 1)})
    value.count = std::max(value.count, static_cast<double>(count_[k]));
  value.tx = static_cast<float>(tx);
  value.ty = static_cast<float>(ty);
  return true;
}

double splineNoiseFactor(double t) noexcept {
  static const std::array<double, 33> table = [] {
    std::array<double, 33> out{};
    for (int i = 0; i <= 32; ++i) {
      const double phase = i / 32.0;
      double w[4], d[4], dd[4];
      weights(phase, w, d, dd);
      for (int node = -14; node <= 14; ++node) {
        // Response of the prefilter to a unit at `node`, at the four coefficients -1 .. 2.
        double value = 0.0;
        for (int j = 0; j < 4; ++j)
          value += w[j] * -6.0 * pole / (1.0 - pole * pole) * std::pow(pole, std::abs(j - 1 - node));
        out[static_cast<std::size_t>(i)] += value * value;
      }
    }
    return out;
  }();
  const double f = std::clamp(t, 0.0, 1.0) * 32.0;
  const auto i = std::min(static_cast<std::size_t>(f), std::size_t{31});
  const double s = f - static_cast<double>(i);
  return (1.0 - s) * table[i] + s * table[i + 1];
}

}  // namespace spindrift
