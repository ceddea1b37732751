// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/imaging/decoder_parts.h"

namespace spindrift {
namespace {

using decoding::lineProfile;
using decoding::LineProfile;
using decoding::LineSums;

constexpr double half_line = 1.7;
constexpr double blur = 0.9;
constexpr double band = 3.4;

/// The same sums in double precision, without a table.
std::vector<double> directSums(const std::vector<float>& distance, const std::vector<std::uint8_t>& pixels,
                               float shift) {
  std::vector<double> s(10, 0.0);
  const auto density = [](double x) {
    return std::exp(-0.5 * x * x / (blur * blur)) / (blur * std::sqrt(2.0 * std::numbers::pi));
  };
  for (std::size_t k = 0; k < distance.size(); ++k) {
    const double d = distance[k] - shift;
    if (std::abs(d) > static_cast<float>(band)) continue;
    const double t = lineProfile(d, half_line, blur);
    const double q = density(d + half_line) - density(d - half_line);
    const double level = pixels[k] - static_cast<double>(decoding::line_ground);
    const double terms[] = {1.0, t, q, t * t, t * q, q * q, level, level * t, level * q, level * level};
    for (std::size_t i = 0; i < s.size(); ++i) s[i] += terms[i];
  }
  return s;
}

TEST(LineProfile, SumsAreThoseOfTheFormulaForEveryNumberOfPixels) {
  const LineProfile profile(half_line, blur, band);
  Random random(3);
  for (const int count : {0, 1, 3, 4, 5, 7, 8, 63, 90}) {
    for (const float shift : {-0.63F, 0.0F, 0.41F}) {
      std::vector<float> distance;
      std::vector<std::uint8_t> pixels;
      std::vector<int> offset;
      for (int k = 0; k < count; ++k) {
        distance.push_back(static_cast<float>(random.uniform(-band - 0.6, band + 0.6)));
        pixels.push_back(static_cast<std::uint8_t>(random.uniform(0.0, 255.9)));
        offset.push_back(k);
      }
      const LineSums s = profile.sum(distance.data(), offset.data(), count, shift, pixels.data());
      const std::vector<double> expected = directSums(distance, pixels, shift);
      const float sums[] = {s.n, s.t1, s.q1, s.tt, s.tq, s.qq, s.i1, s.it, s.iq, s.ii};
      for (std::size_t i = 0; i < expected.size(); ++i) {
        // Half a cell of 1/256 px in each distance, on a slope of at most 0.45 a pixel, for each grey level.
        const double grey = i == 9 ? 155.0 * 155.0 : (i >= 6 ? 155.0 : 1.0);
        EXPECT_NEAR(sums[i], expected[i], 1e-6 * grey * count + 0.001 * grey * std::sqrt(1.0 * count))
            << "sum " << i << " over " << count << " pixels shifted by " << shift;
      }
    }
  }
}

TEST(LineProfile, NothingBeyondTheBandCounts) {
  const LineProfile profile(half_line, blur, band);
  const std::vector<float> distance(9, 5.0F);
  const std::vector<int> offset(9, 0);
  const std::uint8_t pixel = 200;
  EXPECT_EQ(profile.sum(distance.data(), offset.data(), 9, 0.0F, &pixel).n, 0.0F);
  EXPECT_EQ(profile.sum(distance.data(), offset.data(), 9, 3.0F, &pixel).n, 9.0F);
}

}  // namespace
}  // namespace spindrift
