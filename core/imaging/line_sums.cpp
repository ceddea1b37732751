// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "core/imaging/decoder_parts.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace spindrift::decoding {
namespace {

double phi(double x) {
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

}  // namespace

double lineProfile(double distance_px, double half_line_px, double blur_px) {
  return phi((distance_px + half_line_px) / blur_px) - phi((distance_px - half_line_px) / blur_px);
}

LineProfile::LineProfile(double half_line_px, double blur_px, double band_px) : band_px_(static_cast<float>(band_px)) {
  const auto density = [&](double x) {
    return std::exp(-0.5 * x * x / (blur_px * blur_px)) / (blur_px * std::sqrt(2.0 * std::numbers::pi));
  };
  constexpr int cells_a_node = 8;  // linear between nodes 1/32 px apart
  const auto nodes = static_cast<std::size_t>(band_px * cells_per_px) / cells_a_node + 2;
  cells_.resize(nodes * cells_a_node);
  Cell last{static_cast<float>(lineProfile(0.0, half_line_px, blur_px)), 0.0F};
  for (std::size_t node = 1; node <= nodes; ++node) {
    const double d = static_cast<double>(node * cells_a_node) / cells_per_px;
    const Cell next{static_cast<float>(lineProfile(d, half_line_px, blur_px)),
                    static_cast<float>(density(d + half_line_px) - density(d - half_line_px))};
    for (std::size_t k = 0; k < cells_a_node; ++k) {
      const float part = static_cast<float>(k) / cells_a_node;
      cells_[(node - 1) * cells_a_node + k] = {last.level + part * (next.level - last.level),
                                               last.slope + part * (next.slope - last.slope)};
    }
    last = next;
  }
}

LineSums LineProfile::sum(const float* distance_px, const int* offset, int count, float shift_px,
                          const std::uint8_t* origin) const {
  LineSums s;
  int m = 0;
#if defined(__SSE2__)
  const __m128 sign = _mm_set1_ps(-0.0F);
  const __m128 shift = _mm_set1_ps(shift_px);
  const __m128 band = _mm_set1_ps(band_px_);
  const __m128 per_px = _mm_set1_ps(static_cast<float>(cells_per_px));
  const __m128 ground = _mm_set1_ps(line_ground);
  const __m128 one = _mm_set1_ps(1.0F);
  __m128 n = _mm_setzero_ps(), t1 = n, q1 = n, tt = n, tq = n, qq = n, i1 = n, it = n, iq = n, ii = n;
  const auto two = [this](int a, int b) {
    const __m128i low = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&cells_[static_cast<std::size_t>(a)]));
    const __m128i high = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&cells_[static_cast<std::size_t>(b)]));
    return _mm_castsi128_ps(_mm_unpacklo_epi64(low, high));
  };
  for (; m + 4 <= count; m += 4) {
    const __m128 d = _mm_sub_ps(_mm_loadu_ps(distance_px + m), shift);
    const __m128 size = _mm_andnot_ps(sign, d);
    const __m128 within = _mm_cmple_ps(size, band);
    alignas(16) int cell[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(cell), _mm_cvtps_epi32(_mm_mul_ps(_mm_min_ps(size, band), per_px)));
    const __m128 first = two(cell[0], cell[1]);
    const __m128 second = two(cell[2], cell[3]);
    const __m128 t = _mm_and_ps(within, _mm_shuffle_ps(first, second, _MM_SHUFFLE(2, 0, 2, 0)));
    const __m128 q =
        _mm_and_ps(within, _mm_xor_ps(_mm_and_ps(sign, d), _mm_shuffle_ps(first, second, _MM_SHUFFLE(3, 1, 3, 1))));
    const __m128 level =
        _mm_and_ps(within, _mm_sub_ps(_mm_cvtepi32_ps(_mm_setr_epi32(origin[offset[m]], origin[offset[m + 1]],
                                                                     origin[offset[m + 2]], origin[offset[m + 3]])),
                                      ground));
    n = _mm_add_ps(n, _mm_and_ps(within, one));
    t1 = _mm_add_ps(t1, t);
    q1 = _mm_add_ps(q1, q);
    tt = _mm_add_ps(tt, _mm_mul_ps(t, t));
    tq = _mm_add_ps(tq, _mm_mul_ps(t, q));
    qq = _mm_add_ps(qq, _mm_mul_ps(q, q));
    i1 = _mm_add_ps(i1, level);
    it = _mm_add_ps(it, _mm_mul_ps(level, t));
    iq = _mm_add_ps(iq, _mm_mul_ps(level, q));
    ii = _mm_add_ps(ii, _mm_mul_ps(level, level));
  }
  const auto total = [](__m128 v) {
    const __m128 pair = _mm_add_ps(v, _mm_movehl_ps(v, v));
    return _mm_cvtss_f32(_mm_add_ss(pair, _mm_shuffle_ps(pair, pair, _MM_SHUFFLE(1, 1, 1, 1))));
  };
  s = {total(n), total(t1), total(q1), total(tt), total(tq), total(qq), total(i1), total(it), total(iq), total(ii)};
#endif
  for (; m < count; ++m) {
    const float d = distance_px[m] - shift_px;
    const float size = std::abs(d);
    if (size > band_px_) continue;
    const Cell& cell = cells_[static_cast<std::size_t>(std::lrint(size * static_cast<float>(cells_per_px)))];
    const float t = cell.level;
    const float q = d < 0.0F ? -cell.slope : cell.slope;
    const float level = static_cast<float>(origin[offset[m]]) - line_ground;
    s.n += 1.0F;
    s.t1 += t;
    s.q1 += q;
    s.tt += t * t;
    s.tq += t * q;
    s.qq += q * q;
    s.i1 += level;
    s.it += level * t;
    s.iq += level * q;
    s.ii += level * level;
  }
  return s;
}

}  // namespace spindrift::decoding
