// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/imaging/decoder_parts.h"

namespace spindrift::decoding {
namespace {

constexpr double pi = std::numbers::pi;

struct Candidate {
  int mark;
  double x, y;
  double tilt;  // of the pattern's X axis, modulo pi
  double pixel_length_um;
};

double angleBetween(double a, double b) {
  return std::abs(std::remainder(a - b, pi));
}

}  // namespace

Lattice findLattice(const std::vector<Mark>& marks, const FiducialPattern& pattern, const DecodeOptions& options) {
  const double half_line = 0.5 * pattern.ellipse_line_width_um;
  const double outer_x = pattern.semi_axis_x_um + half_line;
  const double outer_y = pattern.semi_axis_y_um + half_line;
  const double major = std::max(outer_x, outer_y);
  const double minor = std::min(outer_x, outer_y);
  const double scale = pattern.pitch_um / 350.0;

  std::vector<Candidate> candidates;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const Mark& m = marks[k];
    const double ratio = m.semi_major_px / m.semi_minor_px;
    if (std::abs(ratio / (major / minor) - 1.0) > 0.07 || std::abs(m.ellipse_ratio - 1.0) > 0.04) continue;
    if (m.filled_fraction > 0.75) continue;
    const double pixel_length = std::sqrt(major * minor / (m.semi_major_px * m.semi_minor_px));
    if (pixel_length < 0.95 * options.min_pixel_length_um * scale ||
        pixel_length > 1.05 * options.max_pixel_length_um * scale) {
      continue;
    }
    const double tilt = outer_x > outer_y ? m.tilt_rad : m.tilt_rad + 0.5 * pi;
    candidates.push_back({static_cast<int>(k), m.x_px, m.y_px, tilt, pixel_length});
  }

  Lattice best;
  std::vector<char> used(candidates.size(), 0);
  std::vector<char> best_member(candidates.size(), 0);
  for (std::size_t seed = 0; seed < candidates.size(); ++seed) {
    if (used[seed]) continue;
    // Those of the same size and direction, then the lattice from the seed on.
    Lattice lattice;
    std::vector<char> member(candidates.size(), 0);
    std::vector<int> queue = {static_cast<int>(seed)};
    std::vector<LatticeNode> nodes = {{candidates[seed].mark, 0, 0}};
    member[seed] = 1;
    double c2 = std::cos(2.0 * candidates[seed].tilt);
    double s2 = std::sin(2.0 * candidates[seed].tilt);
    double sum_length = candidates[seed].pixel_length_um;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Candidate& from = candidates[queue[head]];
      const LatticeNode at = nodes[head];
      const double tilt = 0.5 * std::atan2(s2, c2);
      const double length = sum_length / static_cast<double>(queue.size());
      // The direction is known up to pi: keep the seed's branch.
      const double turn = std::cos(tilt - candidates[seed].tilt) < 0.0 ? tilt + pi : tilt;
      const double step = pattern.pitch_um / length;
      const double cx = std::cos(turn) / step;
      const double sx = std::sin(turn) / step;
      for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (member[k]) continue;
        const Candidate& to = candidates[k];
        if (angleBetween(to.tilt, tilt) > 0.08 || std::abs(to.pixel_length_um / length - 1.0) > 0.05) continue;
        const double dx = to.x - from.x;
        const double dy = to.y - from.y;
        const double u = cx * dx + sx * dy;
        const double v = sx * dx - cx * dy;  // up in the pattern is against image y when it is not turned
        const double ru = std::round(u);
        const double rv = std::round(v);
        const double reach = std::max(std::abs(ru), std::abs(rv));
        if (reach < 0.5 || reach > 3.5) continue;
        if (std::hypot(u - ru, v - rv) > 0.06 + 0.04 * reach) continue;
        member[k] = 1;
        used[k] = 1;
        queue.push_back(static_cast<int>(k));
        nodes.push_back({to.mark, at.u + static_cast<int>(ru), at.v + static_cast<int>(rv)});
        c2 += std::cos(2.0 * to.tilt);
        s2 += std::sin(2.0 * to.tilt);
        sum_length += to.pixel_length_um;
      }
    }
    if (nodes.size() > best.nodes.size()) {
      const double tilt = 0.5 * std::atan2(s2, c2);
      lattice.tilt_rad = std::cos(tilt - candidates[seed].tilt) < 0.0 ? tilt + pi : tilt;
      lattice.pixel_length_um = sum_length / static_cast<double>(nodes.size());
      lattice.nodes = std::move(nodes);
      best = std::move(lattice);
      best_member = member;
    }
  }
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!best_member[k]) best.others.push_back(candidates[k].mark);
  }
  return best;
}

}  // namespace spindrift::decoding
