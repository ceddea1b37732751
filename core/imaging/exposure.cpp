// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/imaging/decoder_parts.h"

namespace spindrift::decoding {

ExposureStatistics exposureOf(const GrayImage& image) {
  ExposureStatistics result;
  if (image.empty()) return result;
  std::array<unsigned, 256> histogram{};
  std::array<unsigned, 1024> curvature{};
  const int step = std::max(1, image.height() / 135);
  unsigned count = 0;
  for (int y = step / 2; y < image.height(); y += step) {
    const std::uint8_t* p = image.row(y);
    for (int x = 0; x + 2 < image.width(); x += 3) {
      ++histogram[p[x]];
      ++curvature[std::abs(p[x] - 2 * p[x + 1] + p[x + 2])];
      ++count;
    }
  }
  if (count == 0) return result;
  const auto level = [&](double fraction) {
    double sum = 0.0;
    for (int k = 0; k < 256; ++k) {
      sum += histogram[k];
      if (sum >= fraction * count) return static_cast<double>(k);
    }
    return 255.0;
  };
  result.dark_level = level(0.05);
  result.bright_level = level(0.995);
  double sum = 0.0;
  for (int k = 0; k < 256; ++k) sum += static_cast<double>(k) * histogram[k];
  result.mean_level = sum / count;
  result.saturated_fraction = static_cast<double>(histogram[255]) / count;
  // Second differences of white noise have 6 times its variance. The median tells flat ground from edges; the mean
  // square up to three medians is nearly that of the whole normal distribution.
  double below = 0.0;
  int median = 0;
  while (median < 1023 && below + curvature[median] < 0.4 * count) below += curvature[median++];
  const int cut = 3 * std::max(median, 1);
  double square = 0.0;
  double inside = 0.0;
  for (int k = 0; k <= std::min(cut, 1023); ++k) {
    square += static_cast<double>(k) * k * curvature[k];
    inside += curvature[k];
  }
  result.noise_level = inside > 0.0 ? std::sqrt(square / inside / 6.0) : 0.0;
  return result;
}

double edgeBlur(const GrayImage& image, const ExposureStatistics& exposure) {
  const double contrast = exposure.bright_level - exposure.dark_level;
  if (contrast <= 0.0 || image.width() < 12) return 0.0;
  // The steepest thousandth of the slopes over 4 px, smoothed across 4 rows.
  std::array<unsigned, 2048> histogram{};
  unsigned count = 0;
  for (int y = 2; y + 4 < image.height(); y += 3) {
    for (int x = 2; x + 6 < image.width(); x += 3) {
      int right = 0;
      int left = 0;
      int down = 0;
      int up = 0;
      for (int k = 0; k < 4; ++k) {
        left += image.at(x, y + k);
        right += image.at(x + 3, y + k);
        up += image.at(x + k, y);
        down += image.at(x + k, y + 3);
      }
      ++histogram[std::min(2047, std::max(std::abs(right - left), std::abs(down - up)))];
      ++count;
    }
  }
  if (count == 0) return 0.0;
  unsigned above = 0;
  int k = 2047;
  while (k > 0 && above + histogram[k] < 0.002 * count) above += histogram[k--];
  const double slope = std::max(1e-3, k / 4.0 / 3.0);
  // A step blurred by sigma has the slope contrast / (sigma sqrt(2 pi)).
  return contrast / (slope * 2.5066282746310002);
}

}  // namespace spindrift::decoding
