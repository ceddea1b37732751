// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/imaging/decoder_parts.h"

namespace spindrift::decoding {
namespace {

/// Lowers squared distances of the samples at (x, y) to those to one piece of a stroke, from `from` to `to`.
void lowerToPiece(const NumberLibrary::Cell& x, const NumberLibrary::Cell& y, const Eigen::Vector2f& from,
                  const Eigen::Vector2f& to, NumberLibrary::Cell& squared) {
  const Eigen::Vector2f along = to - from;
  const float length2 = along.squaredNorm();
  const float per_length2 = length2 > 0.0F ? 1.0F / length2 : 0.0F;
  const float ux = along.x();
  const float uy = along.y();
  for (int k = 0; k < NumberLibrary::samples; ++k) {
    const float dx = x[k] - from.x();
    const float dy = y[k] - from.y();
    const float t = std::min(std::max((dx * ux + dy * uy) * per_length2, 0.0F), 1.0F);
    const float ex = dx - t * ux;
    const float ey = dy - t * uy;
    squared[k] = std::min(squared[k], ex * ex + ey * ey);
  }
}

/// Mean 0, length 1; false if the cell is flat.
bool normalise(NumberLibrary::Cell& cell) {
  // Four partial sums each, so that the compiler may use vector registers.
  std::array<float, 4> sum{};
  for (int k = 0; k < NumberLibrary::samples; k += 4) {
    for (int l = 0; l < 4; ++l) sum[l] += cell[k + l];
  }
  const float mean = (sum[0] + sum[1] + sum[2] + sum[3]) / NumberLibrary::samples;
  std::array<float, 4> squares{};
  for (int k = 0; k < NumberLibrary::samples; k += 4) {
    for (int l = 0; l < 4; ++l) {
      cell[k + l] -= mean;
      squares[l] += cell[k + l] * cell[k + l];
    }
  }
  const float square = squares[0] + squares[1] + squares[2] + squares[3];
  if (square < 1e-6F) return false;
  const float factor = 1.0F / std::sqrt(square);
  for (float& v : cell) v *= factor;
  return true;
}

float correlation(const NumberLibrary::Cell& a, const NumberLibrary::Cell& b) {
  std::array<float, 4> sum{};
  for (int k = 0; k < NumberLibrary::samples; k += 4) {
    for (int l = 0; l < 4; ++l) sum[l] += a[k + l] * b[k + l];
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

LocalFrame frameOf(const Mark& mark, double pixel_length_um, double tilt_rad) {
  const double c = std::cos(tilt_rad) / pixel_length_um;
  const double s = std::sin(tilt_rad) / pixel_length_um;
  return {mark.x_px, mark.y_px, {c, s}, {s, -c}};
}

}  // namespace

NumberLibrary::NumberLibrary(const FiducialPattern& pattern)
    : half_line_um_(0.5 * pattern.digit_line_width_um),
      step_x_um_(2.0 * pattern.digit_offset_x_um / columns),
      step_y_um_(2.0 * pattern.digit_offset_y_um / rows) {
  Cell x{};
  Cell y{};
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      x[j * columns + i] = static_cast<float>((i + 0.5 - 0.5 * columns) * step_x_um_);
      y[j * columns + i] = static_cast<float>((j + 0.5 - 0.5 * rows) * step_y_um_);
    }
  }
  for (int digit = 0; digit < 10; ++digit) {
    Cell& distance = distance_um_[digit];
    distance.fill(std::numeric_limits<float>::max());
    for (const PatternStroke& stroke : pattern.digits[digit]) {
      for (std::size_t k = 0; k + 1 < std::max<std::size_t>(stroke.size(), 2); ++k)
        lowerToPiece(x, y, stroke[k].cast<float>(), stroke[std::min(k + 1, stroke.size() - 1)].cast<float>(), distance);
    }
    for (float& d : distance) d = std::sqrt(d);
  }
}

NumberLibrary::Templates NumberLibrary::templates(double sigma_um) const {
  // Profile of a blurred stroke over the distance from its middle.
  constexpr int steps = 256;
  const double reach = half_line_um_ + 4.0 * sigma_um;
  std::array<float, steps + 2> profile{};
  const double scale = 1.0 / (std::sqrt(2.0) * std::max(sigma_um, 0.1));
  for (int k = 0; k < steps; ++k) {
    const double d = reach * k / steps;
    profile[k] =
        static_cast<float>(0.5 * (std::erf((d + half_line_um_) * scale) - std::erf((d - half_line_um_) * scale)));
  }
  Templates result;
  const float per_um = static_cast<float>(steps / reach);
  for (int digit = 0; digit < 10; ++digit) {
    for (int k = 0; k < samples; ++k) {
      const float t = std::min(distance_um_[digit][k] * per_um, static_cast<float>(steps));
      const int i = static_cast<int>(t);
      result.digit[digit][k] = profile[i] + (t - static_cast<float>(i)) * (profile[i + 1] - profile[i]);
    }
    normalise(result.digit[digit]);
  }
  return result;
}

DigitScores readDigits(const GrayImage& image, const FiducialPattern& pattern, const NumberLibrary& library,
                       const NumberLibrary::Templates& templates, const LocalFrame& frame) {
  DigitScores scores{};
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector2d centre = pattern.digitCentre(k);
    NumberLibrary::Cell cell{};
    const Eigen::Vector2d column_step = frame.x_axis * library.stepX_um();
    const Eigen::Vector2d row_step = frame.y_axis * library.stepY_um();
    const Eigen::Vector2d first = Eigen::Vector2d(frame.x_px, frame.y_px) + frame.x_axis * centre.x() +
                                  frame.y_axis * centre.y() - column_step * (0.5 * (NumberLibrary::columns - 1)) -
                                  row_step * (0.5 * (NumberLibrary::rows - 1));
    const Eigen::Vector2d last =
        first + column_step * (NumberLibrary::columns - 1) + row_step * (NumberLibrary::rows - 1);
    const Eigen::Vector2d side = first + column_step * (NumberLibrary::columns - 1);
    const Eigen::Vector2d other = first + row_step * (NumberLibrary::rows - 1);
    const auto inside = [&](const Eigen::Vector2d& p) {
      return p.x() >= 1.0 && p.y() >= 1.0 && p.x() < image.width() - 2.0 && p.y() < image.height() - 2.0;
    };
    if (!inside(first) || !inside(last) || !inside(side) || !inside(other)) continue;
    // Steps of 1/65536 px: over a cell they add up to less than a thousandth of a pixel.
    constexpr double unit = 65536.0;
    const int column_x = static_cast<int>(std::lrint(column_step.x() * unit));
    const int column_y = static_cast<int>(std::lrint(column_step.y() * unit));
    for (int j = 0; j < NumberLibrary::rows; ++j) {
      const Eigen::Vector2d p = first + j * row_step;
      auto px = static_cast<std::int64_t>(p.x() * unit);
      auto py = static_cast<std::int64_t>(p.y() * unit);
      for (int i = 0; i < NumberLibrary::columns; ++i, px += column_x, py += column_y) {
        const int fx = static_cast<int>(px >> 8) & 255;
        const int fy = static_cast<int>(py >> 8) & 255;
        const std::uint8_t* q = image.row(static_cast<int>(py >> 16)) + (px >> 16);
        const std::uint8_t* r = q + image.width();
        const int top = 256 * q[0] + fx * (q[1] - q[0]);
        const int bottom = 256 * r[0] + fx * (r[1] - r[0]);
        cell[j * NumberLibrary::columns + i] = static_cast<float>(256 * top + fy * (bottom - top));
      }
    }
    if (!normalise(cell)) continue;
    for (int digit = 0; digit < 10; ++digit) scores[k][digit] = correlation(cell, templates.digit[digit]);
  }
  return scores;
}

NumberVote voteOnNumbers(const GrayImage& image, const FiducialPattern& pattern, const NumberLibrary& library,
                         const NumberLibrary::Templates& templates, const Lattice& lattice,
                         const std::vector<Mark>& marks, int max_nodes) {
  NumberVote best;
  double best_sum = -1.0;
  double rival_sum = -1.0;
  const std::size_t count = std::min<std::size_t>(lattice.nodes.size(), static_cast<std::size_t>(max_nodes));
  // Spread the chosen ellipses over the lattice.
  std::vector<LatticeNode> nodes;
  for (std::size_t k = 0; k < count; ++k) nodes.push_back(lattice.nodes[k * lattice.nodes.size() / count]);
  for (int mirrored = 0; mirrored < 2; ++mirrored) {
    // A mirrored view is tried only where the straight one cannot be read.
    if (mirrored == 1 && best.correlation > 0.6) break;
    for (int turned = 0; turned < 2; ++turned) {
      // Sums over the ellipses for every number of node (0, 0); what a number outside 10 ... 99 would get is nothing.
      std::array<double, 200> row_sum{};
      std::array<double, 200> column_sum{};
      const int sign_u = turned ? -1 : 1;
      const int sign_v = (turned != 0) != (mirrored != 0) ? -1 : 1;
      for (const LatticeNode& node : nodes) {
        LocalFrame frame = frameOf(marks[node.mark], lattice.pixel_length_um, lattice.tilt_rad);
        if (mirrored) frame = frame.flipped();
        if (turned) frame = frame.turned();
        const DigitScores s = readDigits(image, pattern, library, templates, frame);
        for (int start = 0; start < 200; ++start) {
          const int row = start - 50 + sign_v * node.v;
          const int column = start - 50 + sign_u * node.u;
          if (row >= 10 && row <= 99) {
            row_sum[start] += std::max(0.0F, s[0][row / 10]) + std::max(0.0F, s[1][row % 10]);
          }
          if (column >= 10 && column <= 99) {
            column_sum[start] += std::max(0.0F, s[2][column / 10]) + std::max(0.0F, s[3][column % 10]);
          }
        }
      }
      const auto topTwo = [](const std::array<double, 200>& sums) {
        int first = 0;
        double second = -1.0;
        for (int k = 1; k < 200; ++k) {
          if (sums[k] > sums[first]) {
            second = sums[first];
            first = k;
          } else {
            second = std::max(second, sums[k]);
          }
        }
        return std::pair<int, double>(first, second);
      };
      const auto [row, row_second] = topTwo(row_sum);
      const auto [column, column_second] = topTwo(column_sum);
      const double sum = row_sum[row] + column_sum[column];
      const double second = std::max(row_second + column_sum[column], row_sum[row] + column_second);
      if (sum > best_sum) {
        rival_sum = std::max(best_sum, second);
        best_sum = sum;
        best.row = row - 50;
        best.column = column - 50;
        best.turned = turned != 0;
        best.mirrored = mirrored != 0;
        best.correlation = sum / (4.0 * static_cast<double>(count));
      } else {
        rival_sum = std::max(rival_sum, sum);
      }
    }
  }
  best.margin = best_sum - rival_sum;
  // Noise of a sum of n correlations grows as its root; damaged digits make it coarser than pixels' noise.
  const double n = static_cast<double>(count);
  best.decided = count > 0 && best.correlation > 0.45 && best.margin > std::max(0.12, 0.08 * std::sqrt(n));
  return best;
}

bool carriesDigits(const GrayImage& image, const FiducialPattern& pattern, const NumberLibrary& library,
                   const NumberLibrary::Templates& templates, const Mark& mark, double pixel_length_um,
                   double tilt_rad) {
  const LocalFrame straight = frameOf(mark, pixel_length_um, tilt_rad);
  for (const LocalFrame& frame : {straight, straight.turned()}) {
    const DigitScores scores = readDigits(image, pattern, library, templates, frame);
    double worst = 1.0;
    for (const auto& cell : scores) worst = std::min<double>(worst, *std::max_element(cell.begin(), cell.end()));
    if (worst > 0.7) return true;
  }
  return false;
}

}  // namespace spindrift::decoding
