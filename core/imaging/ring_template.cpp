// SPDX-License-Identifier: Apache-2.0
// Least-squares match of an ellipse's line. In every sector of the outline
//     I = b + c T(d) - c s T'(d) + noise,   T(d) = Phi((d + h)/sigma) - Phi((d - h)/sigma),
// d = distance of the pixel from the predicted line, h half its width, s how far the line really is further out. Then
//     s(t) = n(t) . shift + e0 + e1 cos 2t + e2 sin 2t + noise
// over the sectors gives the shift; the scatter of the sectors gives its uncertainty, whatever the noise is made of.
#include "core/imaging/decoder_parts.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spindrift::decoding {
namespace {

/// Distance (um) to an ellipse's line to first order; exact on the line.
double lineDistance(double x, double y, double a, double b) {
  const double u = x / a;
  const double v = y / b;
  const double f = std::sqrt(u * u + v * v);
  const double gradient = std::sqrt(u * u / (a * a) + v * v / (b * b));
  return gradient > 0.0 ? (f - 1.0) * f / gradient : -std::min(a, b);
}

/// Free space (um) on both sides of the middle of the ellipse's line: to the digits and to the neighbour's middle.
double clearance(const FiducialPattern& pattern) {
  double free = 0.5 * pattern.pitch_um - std::max(pattern.semi_axis_x_um, pattern.semi_axis_y_um);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d centre = pattern.digitCentre(k);
    for (const auto& strokes : pattern.digits) {
      for (const PatternStroke& stroke : strokes) {
        for (const Eigen::Vector2d& p : stroke) {
          const double d =
              -lineDistance(centre.x() + p.x(), centre.y() + p.y(), pattern.semi_axis_x_um, pattern.semi_axis_y_um);
          free = std::min(free, d - 0.5 * pattern.digit_line_width_um);
        }
      }
    }
  }
  return free;
}

}  // namespace

RingTemplate::RingTemplate(const FiducialPattern& pattern, const GrayImage& image, const LocalFrame& frame,
                           double blur_px, int wanted_pixels)
    : blur_px_(blur_px) {
  const double a = pattern.semi_axis_x_um;
  const double b = pattern.semi_axis_y_um;
  const double px_per_um = 0.5 * (frame.x_axis.norm() + frame.y_axis.norm());
  half_line_px_ = 0.5 * pattern.ellipse_line_width_um * px_per_um;
  const double wanted_band = half_line_px_ + 2.3 * blur_px + 0.3;
  const double free_band = clearance(pattern) * px_per_um - 1.2 * blur_px;
  band_px_ = std::clamp(free_band, half_line_px_ + 0.9 * blur_px, wanted_band);

  profile_ = LineProfile(half_line_px_, blur_px, band_px_);
  double dT = 0.0, cT = 0.0, ss = 0.0;
  for (std::size_t k = 0; k < profile_.cells().size(); ++k) {
    const double d = static_cast<double>(k) / LineProfile::cells_per_px;
    if (d > band_px_) break;
    const LineProfile::Cell& cell = profile_.cells()[k];
    dT += d * cell.slope;
    cT += d * cell.level * cell.slope;
    ss += cell.slope * cell.slope;
  }
  gradient_bias_ground_ = dT / ss;
  gradient_bias_contrast_ = cT / ss;

  Eigen::Matrix2d to_px;
  to_px.col(0) = frame.x_axis;
  to_px.col(1) = frame.y_axis;
  const Eigen::Matrix2d to_um = to_px.inverse();
  const Eigen::Matrix2d normal_map = to_um.transpose();
  const double perimeter = 2.0 * std::numbers::pi * std::sqrt(0.5 * (a * a + b * b)) * px_per_um;
  const int thin = std::max(1, static_cast<int>(std::lround(2.0 * (band_px_ + 0.6) * perimeter / wanted_pixels)));

  struct Pixel {
    int x, y, sector;
    float d;
  };
  std::vector<Pixel> pixels;
  pixels.reserve(static_cast<std::size_t>(wanted_pixels) * 2);
  const double outer_x = a + (band_px_ + 1.0) / px_per_um;
  const double outer_y = b + (band_px_ + 1.0) / px_per_um;
  const double inner_x = a - (band_px_ + 1.0) / px_per_um;
  const double inner_y = b - (band_px_ + 1.0) / px_per_um;
  const int reach_x = static_cast<int>(std::hypot(outer_x * to_px(0, 0), outer_y * to_px(0, 1))) + 1;
  const int reach_y = static_cast<int>(std::hypot(outer_x * to_px(1, 0), outer_y * to_px(1, 1))) + 1;
  for (int y = -reach_y; y <= reach_y; ++y) {
    // Every `thin`-th pixel, shifted from row to row so that they lie evenly.
    const int shift = ((2 * y) % thin + thin) % thin;
    for (int x = -reach_x + shift; x <= reach_x; x += thin) {
      const double X = to_um(0, 0) * x + to_um(0, 1) * y;
      const double Y = to_um(1, 0) * x + to_um(1, 1) * y;
      const double outer = X * X / (outer_x * outer_x) + Y * Y / (outer_y * outer_y);
      if (outer > 1.0) continue;
      if (X * X / (inner_x * inner_x) + Y * Y / (inner_y * inner_y) < 1.0) continue;
      const double d = lineDistance(X, Y, a, b) * px_per_um;
      if (std::abs(d) > band_px_ + 0.6) continue;
      const double t = std::atan2(static_cast<float>(Y / b), static_cast<float>(X / a));
      int sector = static_cast<int>((t / (2.0 * std::numbers::pi) + 0.5) * sectors);
      sector = std::clamp(sector, 0, sectors - 1);
      pixels.push_back({x, y, sector, static_cast<float>(d)});
    }
  }
  std::array<int, sectors + 1> begin{};
  for (const Pixel& p : pixels) ++begin[p.sector + 1];
  for (int k = 0; k < sectors; ++k) begin[k + 1] += begin[k];
  offset_.resize(pixels.size());
  distance_px_.resize(pixels.size());
  std::array<int, sectors> next{};
  std::copy_n(begin.begin(), sectors, next.begin());
  for (int k = 0; k < sectors; ++k) {
    Sector& s = sector_[k];
    s.begin = begin[k];
    s.end = begin[k + 1];
    const double angle = ((k + 0.5) / sectors - 0.5) * 2.0 * std::numbers::pi;
    s.point_um = {a * std::cos(angle), b * std::sin(angle)};
    s.point_px = to_px * s.point_um;
    s.normal = (normal_map * Eigen::Vector2d(std::cos(angle) / a, std::sin(angle) / b)).normalized();
    s.row << s.normal.x(), s.normal.y(), 1.0, std::cos(2.0 * angle), std::sin(2.0 * angle);
  }
  for (const Pixel& p : pixels) {
    Sector& s = sector_[p.sector];
    const int at = next[p.sector]++;
    offset_[at] = p.y * image.width() + p.x;
    distance_px_[at] = p.d;
    s.min_x = std::min(s.min_x, p.x);
    s.max_x = std::max(s.max_x, p.x);
    s.min_y = std::min(s.min_y, p.y);
    s.max_y = std::max(s.max_y, p.y);
  }
}

bool RingTemplate::place(const GrayImage& image, const PatternMap& map, const Eigen::Vector2d& centre_um,
                         const Eigen::Vector2d& shift, int& x0, int& y0, std::array<float, sectors>& offset,
                         std::array<bool, sectors>& inside) const {
  const Eigen::Vector2d centre = map.imageOf(centre_um) + shift;
  if (!centre.allFinite() || centre.cwiseAbs().maxCoeff() > 1e6) return false;
  x0 = static_cast<int>(std::lround(centre.x()));
  y0 = static_cast<int>(std::lround(centre.y()));
  int count = 0;
  for (int k = 0; k < sectors; ++k) {
    const Sector& s = sector_[k];
    inside[k] = s.end > s.begin && x0 + s.min_x >= 0 && x0 + s.max_x < image.width() && y0 + s.min_y >= 0 &&
                y0 + s.max_y < image.height();
    if (!inside[k]) continue;
    ++count;
    const Eigen::Vector2d at = map.imageOf(centre_um + s.point_um) + shift - Eigen::Vector2d(x0, y0);
    offset[k] = static_cast<float>(s.normal.dot(at - s.point_px));
  }
  return count >= sectors / 2;
}

RingMatch RingTemplate::match(const GrayImage& image, const PatternMap& map, const Eigen::Vector2d& centre_um,
                              const Eigen::Vector2d& shift, bool trusted) const {
  RingMatch result;
  int x0 = 0;
  int y0 = 0;
  std::array<float, sectors> offset{};
  std::array<bool, sectors> inside{};
  if (!place(image, map, centre_um, shift, x0, y0, offset, inside)) return result;
  const std::uint8_t* origin = image.data() + static_cast<std::ptrdiff_t>(y0) * image.width() + x0;

  std::array<double, sectors> s{}, variance{}, ground{}, contrast{};
  std::array<bool, sectors> good{};
  double explained = 0.0, total = 0.0, residual_sum = 0.0, residual_dof = 0.0;
  for (int k = 0; k < sectors; ++k) {
    if (!inside[k]) continue;
    const Sector& sector = sector_[k];
    const auto [n, t1, q1, tt, tq, qq, i1, it, iq, ii] =
        profile_.sum(distance_px_.data() + sector.begin, offset_.data() + sector.begin, sector.end - sector.begin,
                     offset[k], origin);
    if (n < 12.0F) continue;
    Eigen::Matrix2d M;
    M << tt - t1 * t1 / n, tq - t1 * q1 / n, 0.0, qq - q1 * q1 / n;
    M(1, 0) = M(0, 1);
    const Eigen::Vector2d rhs(it - t1 * i1 / n, iq - q1 * i1 / n);
    const double determinant = M.determinant();
    if (determinant <= 1e-6 * M(0, 0) * M(1, 1)) continue;
    const double c = (M(1, 1) * rhs[0] - M(0, 1) * rhs[1]) / determinant;
    const double q = (M(0, 0) * rhs[1] - M(0, 1) * rhs[0]) / determinant;
    const double all = std::max(0.0, static_cast<double>(ii) - static_cast<double>(i1) * i1 / n);
    const double part = std::clamp(c * rhs[0] + q * rhs[1], 0.0, all);
    total += all;
    explained += c > 0.0 ? part : 0.0;
    contrast[k] = c;
    ground[k] = (i1 - c * t1 - q * q1) / n + line_ground;
    if (c <= 1.0) continue;
    residual_sum += all - part;
    residual_dof += n - 3.0;
    s[k] = -q / c;
    variance[k] = M(0, 0) / (determinant * c * c);
    good[k] = true;
  }
  if (total <= 0.0 || residual_dof < 10.0) return result;
  result.correlation = std::sqrt(explained / total);

  // Sectors of much less contrast than the rest are covered or outside.
  std::vector<double> sorted;
  for (int k = 0; k < sectors; ++k) {
    if (good[k]) sorted.push_back(contrast[k]);
  }
  if (sorted.size() < sectors / 3) return result;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  result.contrast = sorted[sorted.size() / 2];
  result.pixel_noise = std::sqrt(std::max(residual_sum / residual_dof, 1e-4));
  for (int k = 0; k < sectors; ++k) {
    if (good[k]) good[k] = contrast[k] > 0.35 * result.contrast && contrast[k] < 2.5 * result.contrast;
  }

  // Shift and shape over the sectors; sectors beyond 3.5 robust sigma are left out.
  using Vector = Eigen::Matrix<double, 5, 1>;
  using Matrix = Eigen::Matrix<double, 5, 5>;
  std::array<bool, sectors> used = good;
  if (trusted) {
    sorted.clear();
    for (int k = 0; k < sectors; ++k) {
      if (good[k]) sorted.push_back(s[k]);
    }
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double middle = sorted[sorted.size() / 2];  // the line may be a little thicker than drawn
    for (double& value : sorted) value = std::abs(value - middle);
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double limit = 3.0 * 1.4826 * sorted[sorted.size() / 2];
    for (int k = 0; k < sectors; ++k) good[k] = good[k] && std::abs(s[k] - middle) <= limit;
    used = good;
  }
  Vector fit = Vector::Zero();
  Matrix covariance = Matrix::Zero();
  double scatter2 = 0.0;
  int count = 0;
  for (int iteration = 0; iteration < 4; ++iteration) {
    Matrix N = Matrix::Zero();
    Vector g = Vector::Zero();
    count = 0;
    for (int k = 0; k < sectors; ++k) {
      if (!used[k]) continue;
      const Vector& r = sector_[k].row;
      const double w = 1.0 / variance[k];
      N += w * r * r.transpose();
      g += w * r * s[k];
      ++count;
    }
    if (count < sectors / 3) return result;
    const Eigen::LDLT<Matrix> solver(N);
    fit = solver.solve(g);
    covariance = solver.solve(Matrix::Identity());
    if (!fit.allFinite()) return result;
    std::array<double, sectors> z{};
    sorted.clear();
    for (int k = 0; k < sectors; ++k) {
      if (!good[k]) continue;
      z[k] = (s[k] - sector_[k].row.dot(fit)) / std::sqrt(variance[k]);
      sorted.push_back(std::abs(z[k]));
    }
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double limit = std::max(3.5 * 1.4826 * sorted[sorted.size() / 2], 1e-6);
    bool changed = false;
    double chi2 = 0.0;
    for (int k = 0; k < sectors; ++k) {
      const bool keep = good[k] && std::abs(z[k]) <= limit;
      changed = changed || keep != used[k];
      if (used[k]) chi2 += z[k] * z[k];
      used[k] = keep;
    }
    scatter2 = chi2 / std::max(1, count - 5);
    if (!changed) break;
  }
  result.visible = static_cast<double>(count) / sectors;
  result.degrees_of_freedom = count - 5;
  result.effective_noise = std::sqrt(scatter2);
  result.unit_covariance_px2 = covariance.topLeftCorner<2, 2>();

  // Light that changes across the ellipse changes across its line too, and pulls the line towards the light.
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  Eigen::Vector3d pb = Eigen::Vector3d::Zero();
  Eigen::Vector3d pc = Eigen::Vector3d::Zero();
  for (int k = 0; k < sectors; ++k) {
    if (!used[k]) continue;
    const Eigen::Vector3d r(1.0, sector_[k].point_px.x(), sector_[k].point_px.y());
    P += r * r.transpose();
    pb += r * ground[k];
    pc += r * contrast[k];
  }
  const Eigen::LDLT<Eigen::Matrix3d> plane(P);
  const Eigen::Vector2d ground_slope = plane.solve(pb).tail<2>();
  const Eigen::Vector2d contrast_slope = plane.solve(pc).tail<2>();
  const Eigen::Vector2d pull =
      -(gradient_bias_ground_ * ground_slope + gradient_bias_contrast_ * contrast_slope) / result.contrast;

  const Eigen::Vector2d moved = fit.head<2>() - pull;
  const Eigen::Vector2d centre = map.imageOf(centre_um) + shift + moved;
  result.x_px = centre.x();
  result.y_px = centre.y();
  result.shift_px = moved.norm();
  result.found = moved.norm() < 2.0 * (half_line_px_ + blur_px_);
  return result;
}

double RingTemplate::estimateBlur(const GrayImage& image, const PatternMap& map,
                                  const std::vector<Eigen::Vector2d>& centres_um,
                                  const std::vector<Eigen::Vector2d>& shifts) const {
  // Mean profile across the line, every ellipse scaled by its own ground and contrast later through the fit.
  constexpr int cells_per_px = 4;
  const int cells = static_cast<int>(2.0 * band_px_ * cells_per_px) + 1;
  std::vector<double> sum(cells, 0.0);
  std::vector<double> weight(cells, 0.0);
  for (std::size_t e = 0; e < centres_um.size(); ++e) {
    int x0 = 0;
    int y0 = 0;
    std::array<float, sectors> offset{};
    std::array<bool, sectors> inside{};
    if (!place(image, map, centres_um[e], shifts[e], x0, y0, offset, inside)) continue;
    const std::uint8_t* origin = image.data() + static_cast<std::ptrdiff_t>(y0) * image.width() + x0;
    for (int k = 0; k < sectors; ++k) {
      if (!inside[k]) continue;
      for (int m = sector_[k].begin; m < sector_[k].end; ++m) {
        const int cell = static_cast<int>((distance_px_[m] - offset[k] + band_px_) * cells_per_px + 0.5);
        if (cell < 0 || cell >= cells) continue;
        sum[cell] += origin[offset_[m]];
        weight[cell] += 1.0;
      }
    }
  }
  const auto misfit = [&](double sigma) {
    double n = 0, t1 = 0, tt = 0, i1 = 0, it = 0, ii = 0;
    for (int k = 0; k < cells; ++k) {
      if (weight[k] < 1.0) continue;
      const double d = static_cast<double>(k) / cells_per_px - band_px_;
      const double t = lineProfile(d, half_line_px_, sigma);
      const double level = sum[k] / weight[k];
      n += weight[k];
      t1 += weight[k] * t;
      tt += weight[k] * t * t;
      i1 += weight[k] * level;
      it += weight[k] * t * level;
      ii += weight[k] * level * level;
    }
    const double mtt = tt - t1 * t1 / n;
    const double mit = it - t1 * i1 / n;
    if (n < 100.0 || mtt <= 0.0 || mit <= 0.0) return std::numeric_limits<double>::infinity();
    return (ii - i1 * i1 / n) - mit * mit / mtt;
  };
  double low = 0.3;
  double high = 12.0;
  // Coarse steps, then golden section.
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (double sigma = low; sigma < high; sigma *= 1.35) {
    const double m = misfit(sigma);
    if (m < least) {
      least = m;
      best = sigma;
    }
  }
  if (best == 0.0) return 0.0;
  low = best / 1.35;
  high = best * 1.35;
  constexpr double golden = 0.6180339887498949;
  double a = high - golden * (high - low);
  double b = low + golden * (high - low);
  double of_a = misfit(a);
  double of_b = misfit(b);
  for (int i = 0; i < 12; ++i) {  // each step keeps one of the two inner points
    if (of_a < of_b) {
      high = b;
      b = a;
      of_b = of_a;
      a = high - golden * (high - low);
      if (i < 11) of_a = misfit(a);
    } else {
      low = a;
      a = b;
      of_a = of_b;
      b = low + golden * (high - low);
      if (i < 11) of_b = misfit(b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace spindrift::decoding
