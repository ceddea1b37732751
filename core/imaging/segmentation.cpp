// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/imaging/decoder_parts.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace spindrift::decoding {
namespace {

constexpr int tile = 32;  // pixels of the reduced image

/// Threshold at the middle of every tile: half way between the darkest and the brightest of the 3 x 3 tiles around.
struct ThresholdGrid {
  int columns = 0;
  int rows = 0;
  std::vector<float> level;
  [[nodiscard]] float at(int i, int j) const {
    return level[static_cast<std::size_t>(std::clamp(j, 0, rows - 1)) * columns + std::clamp(i, 0, columns - 1)];
  }
};

/// Means of 2 x 2 pixels of two rows, rounded; with `Levels` also the darkest and brightest of each column so far. The
/// reduced image is made row by row, twice, and never kept: the pages of the memory for it cost the first frame of a
/// process more than to make it again (decoder_study --speed).
template <bool Levels>
void halveRows(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* out,
               [[maybe_unused]] std::uint8_t* low = nullptr, [[maybe_unused]] std::uint8_t* high = nullptr) {
  int x = 0;
#if defined(__SSE2__)
  const __m128i even = _mm_set1_epi16(0x00FF);
  const __m128i two = _mm_set1_epi16(2);
  const auto eight = [&](int at) {
    const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(upper + at));
    const __m128i b = _mm_loadu_si128(reinterpret_cast<const __m128i*>(lower + at));
    const __m128i left = _mm_add_epi16(_mm_and_si128(a, even), _mm_and_si128(b, even));
    const __m128i right = _mm_add_epi16(_mm_srli_epi16(a, 8), _mm_srli_epi16(b, 8));
    return _mm_srli_epi16(_mm_add_epi16(_mm_add_epi16(left, right), two), 2);
  };
  for (; x + 16 <= width; x += 16) {
    const __m128i mean = _mm_packus_epi16(eight(2 * x), eight(2 * x + 16));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + x), mean);
    if constexpr (Levels) {
      auto* const lo = reinterpret_cast<__m128i*>(low + x);
      auto* const hi = reinterpret_cast<__m128i*>(high + x);
      _mm_storeu_si128(lo, _mm_min_epu8(_mm_loadu_si128(lo), mean));
      _mm_storeu_si128(hi, _mm_max_epu8(_mm_loadu_si128(hi), mean));
    }
  }
#endif
  for (; x < width; ++x) {
    const int sum = upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1];
    out[x] = static_cast<std::uint8_t>((sum + 2) >> 2);
    if constexpr (Levels) {
      low[x] = std::min(low[x], out[x]);
      high[x] = std::max(high[x], out[x]);
    }
  }
}

/// The levels of the tiles of the image reduced 2:1.
ThresholdGrid thresholdsOf(const GrayImage& image) {
  const int width = image.width() / 2;
  const int height = image.height() / 2;
  ThresholdGrid grid;
  grid.columns = (width + tile - 1) / tile;
  grid.rows = (height + tile - 1) / tile;
  const std::size_t count = static_cast<std::size_t>(grid.columns) * grid.rows;
  std::vector<std::uint8_t> low(count);
  std::vector<std::uint8_t> high(count);
  std::vector<std::uint8_t> row(width);
  std::vector<std::uint8_t> column_low(width);
  std::vector<std::uint8_t> column_high(width);
  for (int j = 0; j < grid.rows; ++j) {
    std::fill(column_low.begin(), column_low.end(), std::uint8_t{255});
    std::fill(column_high.begin(), column_high.end(), std::uint8_t{0});
    for (int y = j * tile; y < std::min(height, (j + 1) * tile); ++y) {
      halveRows<true>(image.row(2 * y), image.row(2 * y + 1), width, row.data(), column_low.data(), column_high.data());
    }
    for (int i = 0; i < grid.columns; ++i) {
      const int end = std::min(width, (i + 1) * tile);
      const std::size_t k = static_cast<std::size_t>(j) * grid.columns + i;
      low[k] = *std::min_element(column_low.begin() + i * tile, column_low.begin() + end);
      high[k] = *std::max_element(column_high.begin() + i * tile, column_high.begin() + end);
    }
  }
  std::vector<float> middle(count);
  std::vector<float> ground(count);
  std::vector<float> contrast(count);
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      int lo = 255;
      int hi = 0;
      for (int b = std::max(0, j - 1); b <= std::min(grid.rows - 1, j + 1); ++b) {
        for (int a = std::max(0, i - 1); a <= std::min(grid.columns - 1, i + 1); ++a) {
          lo = std::min<int>(lo, low[static_cast<std::size_t>(b) * grid.columns + a]);
          hi = std::max<int>(hi, high[static_cast<std::size_t>(b) * grid.columns + a]);
        }
      }
      const std::size_t k = static_cast<std::size_t>(j) * grid.columns + i;
      middle[k] = 0.5F * static_cast<float>(lo + hi);
      ground[k] = static_cast<float>(lo);
      contrast[k] = static_cast<float>(hi - lo);
    }
  }
  // Empty ground has no mark to tell the threshold: keep it clear of the noise there.
  std::vector<float> sorted = contrast;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const float least = 0.3F * sorted[sorted.size() / 2];
  for (std::size_t k = 0; k < count; ++k) middle[k] = std::max(middle[k], ground[k] + 0.5F * std::max(least, 12.0F));
  grid.level = middle;
  ThresholdGrid smooth = grid;
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      float sum = 0.0F;
      for (int b = -1; b <= 1; ++b) {
        for (int a = -1; a <= 1; ++a) sum += grid.at(i + a, j + b);
      }
      smooth.level[static_cast<std::size_t>(j) * grid.columns + i] = sum / 9.0F;
    }
  }
  return smooth;
}

/// Threshold of every pixel of a row, linear between the middles of the tiles.
void thresholdRow(const ThresholdGrid& grid, int y, int width, std::uint8_t* out) {
  const float v = (static_cast<float>(y) + 0.5F) / tile - 0.5F;
  const int j = static_cast<int>(std::floor(v));
  const float fv = v - static_cast<float>(j);
  const auto node = [&](int i) { return (1.0F - fv) * grid.at(i, j) + fv * grid.at(i, j + 1); };
  for (int i = -1; i < grid.columns; ++i) {
    const float a = node(i);
    const float b = node(i + 1);
    const int begin = std::max(0, i * tile + tile / 2);
    const int end = std::min(width, (i + 1) * tile + tile / 2);
    const float step = (b - a) / tile;
    const float first = a + step * (0.5F + static_cast<float>(begin - i * tile - tile / 2));
    for (int x = begin; x < end; ++x) {
      out[x] = static_cast<std::uint8_t>(static_cast<int>(first + step * static_cast<float>(x - begin)));
    }
  }
}

struct Run {
  int y;
  int begin;
  int end;  // one past the last
  int label;
};

/// Runs of pixels above the threshold.
void findRuns(const std::uint8_t* p, const std::uint8_t* threshold, int width, int y, std::vector<Run>& runs) {
  int x = 0;
  bool inside = false;
  int begin = 0;
#if defined(__SSE2__)
  for (; x + 16 <= width; x += 16) {
    const __m128i a = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + x));
    const __m128i t = _mm_loadu_si128(reinterpret_cast<const __m128i*>(threshold + x));
    // a > t  <=>  saturated a - t is not zero
    unsigned mask = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(_mm_subs_epu8(a, t), _mm_setzero_si128())));
    mask = ~mask & 0xFFFFU;
    if (mask == (inside ? 0xFFFFU : 0U)) continue;
    unsigned changes = (mask ^ ((mask << 1) | (inside ? 1U : 0U))) & 0xFFFFU;
    while (changes != 0) {
      const int at = x + std::countr_zero(changes);
      changes &= changes - 1;
      if (inside) {
        runs.push_back({y, begin, at, -1});
      } else {
        begin = at;
      }
      inside = !inside;
    }
  }
#endif
  for (; x < width; ++x) {
    const bool bright = p[x] > threshold[x];
    if (bright == inside) continue;
    if (inside) {
      runs.push_back({y, begin, x, -1});
    } else {
      begin = x;
    }
    inside = bright;
  }
  if (inside) runs.push_back({y, begin, width, -1});
}

int rootOf(std::vector<int>& parent, int k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

/// Sums over a filled mark; rows arrive in order.
struct Sums {
  int y = -1, begin = 0, end = 0;
  int min_x = 1 << 30, max_x = -1, min_y = 1 << 30, max_y = -1;
  double bright = 0, n = 0, x = 0, y1 = 0, xx = 0, xy = 0, yy = 0;
  void flush() {
    if (y < 0) return;
    const double count = end - begin;
    const double middle = 0.5 * (begin + end - 1);
    n += count;
    x += count * middle;
    y1 += count * y;
    xx += count * (middle * middle + (count * count - 1.0) / 12.0);
    xy += count * middle * y;
    yy += count * y * static_cast<double>(y);
  }
  void add(const Run& run) {
    if (run.y != y) {
      flush();
      y = run.y;
      begin = run.begin;
      end = run.end;
    } else {
      begin = std::min(begin, run.begin);
      end = std::max(end, run.end);
    }
    bright += run.end - run.begin;
    min_x = std::min(min_x, run.begin);
    max_x = std::max(max_x, run.end - 1);
    min_y = std::min(min_y, run.y);
    max_y = std::max(max_y, run.y);
  }
};

}  // namespace

std::vector<Mark> findMarks(const GrayImage& image, const MarkLimits& limits) {
  std::vector<Mark> marks;
  if (image.width() < 16 || image.height() < 16) return marks;
  const int width = image.width() / 2;
  const int height = image.height() / 2;
  const ThresholdGrid grid = thresholdsOf(image);

  std::vector<Run> runs;
  runs.reserve(static_cast<std::size_t>(height) * 24);
  std::vector<int> parent;
  std::vector<std::uint8_t> row(width);
  std::vector<std::uint8_t> threshold(width + 16);
  std::size_t above_begin = 0;
  std::size_t above_end = 0;
  for (int y = 0; y < height; ++y) {
    if (y % 4 == 0) thresholdRow(grid, y + 2, width, threshold.data());
    const std::size_t first = runs.size();
    halveRows<false>(image.row(2 * y), image.row(2 * y + 1), width, row.data());
    findRuns(row.data(), threshold.data(), width, y, runs);
    std::size_t above = above_begin;
    for (std::size_t k = first; k < runs.size(); ++k) {
      Run& run = runs[k];
      while (above < above_end && runs[above].end < run.begin) ++above;
      for (std::size_t a = above; a < above_end && runs[a].begin <= run.end; ++a) {
        const int root = rootOf(parent, runs[a].label);
        if (run.label < 0) {
          run.label = root;
        } else {
          const int own = rootOf(parent, run.label);
          if (own != root) parent[std::max(own, root)] = std::min(own, root);
        }
      }
      if (run.label < 0) {
        run.label = static_cast<int>(parent.size());
        parent.push_back(run.label);
      }
    }
    above_begin = first;
    above_end = runs.size();
  }
  std::vector<int> index(parent.size(), -1);
  std::vector<Sums> sums;
  for (const Run& run : runs) {
    const int root = rootOf(parent, run.label);
    if (index[root] < 0) {
      index[root] = static_cast<int>(sums.size());
      sums.emplace_back();
    }
    sums[index[root]].add(run);
  }
  for (Sums& s : sums) {
    const int extent = std::max(s.max_x - s.min_x, s.max_y - s.min_y) + 1;
    if (extent < limits.min_semi_major_px * 0.7 || extent > limits.max_semi_major_px * 1.2) continue;
    if (s.min_x == 0 || s.min_y == 0 || s.max_x == width - 1 || s.max_y == height - 1) continue;
    s.flush();
    const double mx = s.x / s.n;
    const double my = s.y1 / s.n;
    const double xx = s.xx / s.n - mx * mx;
    const double xy = s.xy / s.n - mx * my;
    const double yy = s.yy / s.n - my * my + 1.0 / 12.0;
    const double mean = 0.5 * (xx + yy);
    const double root = std::hypot(0.5 * (xx - yy), xy);
    if (mean - root <= 0.0) continue;
    Mark mark;
    mark.semi_major_px = 2.0 * 2.0 * std::sqrt(mean + root);  // the reduced image has pixels of twice the size
    mark.semi_minor_px = 2.0 * 2.0 * std::sqrt(mean - root);
    if (mark.semi_major_px < limits.min_semi_major_px || mark.semi_major_px > limits.max_semi_major_px) continue;
    mark.x_px = 2.0 * mx + 0.5;
    mark.y_px = 2.0 * my + 0.5;
    mark.tilt_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
    mark.ellipse_ratio = 4.0 * s.n / (3.14159265358979323846 * mark.semi_major_px * mark.semi_minor_px);
    mark.filled_fraction = s.bright / s.n;
    marks.push_back(mark);
  }
  return marks;
}

}  // namespace spindrift::decoding
