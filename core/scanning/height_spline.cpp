// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/height_spline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/statistics.h"

namespace spindrift {
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
      for (const std::array<int, 2>& step : directions) {
        const auto value = [&](int n, double& out) {
          const int cc = c + n * step[0], rr = r + n * step[1];
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
