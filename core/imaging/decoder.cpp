// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/decoder.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>

#include "core/imaging/decoder_parts.h"

namespace spindrift {
namespace {

using namespace decoding;

/// Part of the uncertainty that noise does not explain (8-bit steps, sampling of sharp edges, pixel shape), px.
constexpr double model_sigma_px = 0.0004;

/// An ellipse that should be in view, and what was found there.
struct Expected {
  int row = 0;
  int column = 0;
  Eigen::Vector2d centre_um;
  RingMatch match;
};

/// Contrast of the ellipses over the image: a plane, or a paraboloid where there are enough of them.
class Light {
 public:
  Light(const std::vector<Expected>& ellipses, const Eigen::Vector2d& centre) : centre_(centre) {
    using Vector = Eigen::Matrix<double, 6, 1>;
    Eigen::Matrix<double, 6, 6> N = Eigen::Matrix<double, 6, 6>::Zero();
    Vector g = Vector::Zero();
    int count = 0;
    for (const Expected& e : ellipses) {
      if (!e.match.found) continue;
      const double x = (e.match.x_px - centre.x()) / unit_px;
      const double y = (e.match.y_px - centre.y()) / unit_px;
      Vector r;
      r << 1.0, x, y, x * x, x * y, y * y;
      N += r * r.transpose();
      g += r * e.match.contrast;
      ++count;
    }
    const int n = count >= 10 ? 6 : (count >= 4 ? 3 : 0);
    if (n == 0) return;
    // Ellipses on one line do not determine the slope across it: a trace of damping keeps that at zero.
    N.diagonal().array() += 1e-6 * count;
    const Eigen::VectorXd p = Eigen::MatrixXd(N.topLeftCorner(n, n)).ldlt().solve(g.head(n));
    if (p.allFinite()) p_.head(n) = p;
  }
  /// Relative change per px.
  [[nodiscard]] Eigen::Vector2d gradientAt(const Eigen::Vector2d& pixel) const {
    const double x = (pixel.x() - centre_.x()) / unit_px;
    const double y = (pixel.y() - centre_.y()) / unit_px;
    const double level = p_[0] + p_[1] * x + p_[2] * y + p_[3] * x * x + p_[4] * x * y + p_[5] * y * y;
    if (level <= 0.2 * p_[0]) return Eigen::Vector2d::Zero();
    return Eigen::Vector2d(p_[1] + 2.0 * p_[3] * x + p_[4] * y, p_[2] + p_[4] * x + 2.0 * p_[5] * y) /
           (unit_px * level);
  }

 private:
  static constexpr double unit_px = 1000.0;
  Eigen::Vector2d centre_;
  Eigen::Matrix<double, 6, 1> p_ = Eigen::Matrix<double, 6, 1>::Zero();
};

class Decoding {
 public:
  Decoding(const GrayImage& image, const FiducialPattern& pattern, const DecodeOptions& options,
           const NumberLibrary& library)
      : image_(image), pattern_(pattern), options_(options), library_(library) {}

  DecodeResult run();

 private:
  bool findPattern();
  void locateEllipses();
  void locateCircles();
  void fitFinalMap();
  [[nodiscard]] MapFit fitToMarks() const;
  /// Marks that the map contradicts: circles are dropped, ellipses matched again or given a larger uncertainty. True if
  /// there were any.
  bool settleOutliers(const MapFit& fit);
  void scaleUncertainties();
  void readAllDigits();
  void lookForOthers();
  void rejectWith(std::string message) {
    result_.status = FitStatus::Rejected;
    result_.message = std::move(message);
  }
  void explainNothing();
  [[nodiscard]] LocalFrame frameAt(const Eigen::Vector2d& centre_um, double x_px, double y_px) const;
  [[nodiscard]] bool whollyInView(const Eigen::Vector2d& centre_um) const;
  /// How far the middle of an outline moves per unit of k1 at the image's corner: 2 rho^2 r.
  [[nodiscard]] double bendPerK1() const {
    const double rho2 =
        pattern_.semi_axis_x_um * pattern_.semi_axis_y_um / (map_.pixel_length_um * map_.pixel_length_um);
    return 2.0 * rho2 * std::hypot(map_.centre_x_px, map_.centre_y_px);
  }

  const GrayImage& image_;
  const FiducialPattern& pattern_;
  const DecodeOptions& options_;
  const NumberLibrary& library_;
  std::vector<Mark> marks_;
  Lattice lattice_;
  PatternMap map_;
  double matched_k1_ = 0.0;  ///< distortion with which the ellipses were matched
  double blur_px_ = 1.0;     ///< with the pixel's own area
  double pooled_noise_ = 1.0;
  double noise_inflation_ = 1.0;
  std::optional<RingTemplate> ring_;
  std::vector<Expected> expected_;
  DecodeResult result_;
};

LocalFrame Decoding::frameAt(const Eigen::Vector2d& centre_um, double x_px, double y_px) const {
  constexpr double step_um = 50.0;
  const Eigen::Vector2d ex(step_um, 0);
  const Eigen::Vector2d ey(0, step_um);
  return {x_px, y_px, (map_.imageOf(centre_um + ex) - map_.imageOf(centre_um - ex)) / (2.0 * step_um),
          (map_.imageOf(centre_um + ey) - map_.imageOf(centre_um - ey)) / (2.0 * step_um)};
}

bool Decoding::whollyInView(const Eigen::Vector2d& centre_um) const {
  const Eigen::Vector2d c = map_.imageOf(centre_um);
  const LocalFrame frame = frameAt(centre_um, c.x(), c.y());
  const double half = 0.5 * pattern_.ellipse_line_width_um;
  const double a = pattern_.semi_axis_x_um + half;
  const double b = pattern_.semi_axis_y_um + half;
  const double reach_x = std::hypot(a * frame.x_axis.x(), b * frame.y_axis.x());
  const double reach_y = std::hypot(a * frame.x_axis.y(), b * frame.y_axis.y());
  return c.x() - reach_x >= -0.5 && c.y() - reach_y >= -0.5 && c.x() + reach_x <= image_.width() - 0.5 &&
         c.y() + reach_y <= image_.height() - 0.5;
}

void Decoding::explainNothing() {
  const ExposureStatistics& e = result_.exposure;
  if (e.bright_level < 30.0) {
    rejectWith(
        fmt::format("the image is black: 99.5 % of its pixels are at or below level {:.0f} of 255", e.bright_level));
  } else if (e.dark_level > 225.0) {
    rejectWith(fmt::format("the image is white: 95 % of its pixels are at or above level {:.0f} of 255", e.dark_level));
  } else if (e.bright_level - e.dark_level < std::max(15.0, 5.0 * e.noise_level)) {
    rejectWith(fmt::format("the image shows no contrast: levels {:.0f} to {:.0f} with noise of {:.1f}", e.dark_level,
                           e.bright_level, e.noise_level));
  } else if (const double blur = edgeBlur(image_, e); blur > 4.0) {
    rejectWith(
        fmt::format("the image is blurred: its sharpest edges have a blur of about {:.0f} px, at most about 3 px "
                    "can be decoded",
                    blur));
  } else {
    rejectWith(fmt::format("no ellipses of the pattern were found ({} x {} px, levels {:.0f} to {:.0f})",
                           image_.width(), image_.height(), e.dark_level, e.bright_level));
  }
}

bool Decoding::findPattern() {
  const double scale = pattern_.pitch_um / 350.0;
  const double major =
      std::max(pattern_.semi_axis_x_um, pattern_.semi_axis_y_um) + 0.5 * pattern_.ellipse_line_width_um;
  marks_ = findMarks(image_, {0.9 * major / (options_.max_pixel_length_um * scale),
                              1.1 * major / (options_.min_pixel_length_um * scale)});
  lattice_ = findLattice(marks_, pattern_, options_);
  if (lattice_.nodes.empty()) {
    explainNothing();
    return false;
  }
  // The ellipse looks the same turned by pi, so blur can be had before the numbers are known.
  map_.centre_x_px = 0.5 * (image_.width() - 1);
  map_.centre_y_px = 0.5 * (image_.height() - 1);
  map_.pixel_length_um = lattice_.pixel_length_um;
  map_.tilt_rad = lattice_.tilt_rad;
  map_.origin_x_px = map_.origin_y_px = 0.0;
  const Eigen::Vector2d zero = Eigen::Vector2d::Zero();
  const RingTemplate rough(pattern_, image_, frameAt(zero, 0, 0), 1.5, 1500);
  std::vector<Eigen::Vector2d> centres;
  std::vector<Eigen::Vector2d> shifts;
  for (const LatticeNode& node : lattice_.nodes) {
    if (centres.size() == 8) break;
    centres.push_back(zero);
    shifts.push_back(Eigen::Vector2d(marks_[node.mark].x_px, marks_[node.mark].y_px) - map_.imageOf(zero));
  }
  blur_px_ = rough.estimateBlur(image_, map_, centres, shifts);
  if (blur_px_ <= 0.0) blur_px_ = 1.5;
  const auto templates = library_.templates(std::max(blur_px_ * map_.pixel_length_um, 1.0));
  const NumberVote vote = voteOnNumbers(image_, pattern_, library_, templates, lattice_, marks_, 14);
  if (!vote.decided) {
    rejectWith(
        fmt::format("{} ellipses were found, but the numbers in them cannot be read for certain (correlation {:.2f})",
                    lattice_.nodes.size(), vote.correlation));
    return false;
  }
  const int sign_u = vote.turned ? -1 : 1;
  const int sign_v = vote.turned != vote.mirrored ? -1 : 1;
  std::vector<MapPoint> points;
  int outside = 0;
  int lowest_row = 99, highest_row = 0, lowest_column = 99, highest_column = 0;
  for (const LatticeNode& node : lattice_.nodes) {
    const int row = vote.row + sign_v * node.v;
    const int column = vote.column + sign_u * node.u;
    lowest_row = std::min(lowest_row, row);
    highest_row = std::max(highest_row, row);
    lowest_column = std::min(lowest_column, column);
    highest_column = std::max(highest_column, column);
    if (!pattern_.contains(row, column)) {
      ++outside;
      continue;
    }
    const Mark& mark = marks_[node.mark];
    points.push_back({pattern_.ellipseCentre(row, column), {mark.x_px, mark.y_px}, 0.3});
  }
  if (2 * outside > static_cast<int>(lattice_.nodes.size())) {
    rejectWith(
        fmt::format("this is another pattern: its ellipses carry rows {} to {} and columns {} to {}, the expected "
                    "one has rows {} to {} and columns {} to {}",
                    lowest_row, highest_row, lowest_column, highest_column, pattern_.first_row, pattern_.last_row,
                    pattern_.first_column, pattern_.last_column));
    return false;
  }
  map_.mirrored = vote.mirrored;
  map_.tilt_rad = lattice_.tilt_rad + (vote.turned ? std::numbers::pi : 0.0);
  // Bring one ellipse to its place, then fit.
  const Eigen::Vector2d off = points.front().pixel - map_.imageOf(points.front().pattern_um);
  map_.origin_x_px += off.x();
  map_.origin_y_px += off.y();
  const MapFit fit = fitMap(points, map_, points.size() >= 8);
  if (fit.status == FitStatus::Converged) map_ = fit.map;
  return true;
}

void Decoding::locateEllipses() {
  const Eigen::Vector2d middle_um = map_.patternOf({map_.centre_x_px, map_.centre_y_px});
  const Eigen::Vector2d seen_um(std::clamp(middle_um.x(), 0.0, (pattern_.columnCount() - 1) * pattern_.pitch_um),
                                std::clamp(middle_um.y(), 0.0, (pattern_.rowCount() - 1) * pattern_.pitch_um));
  // The marks' moments are right to a few tenths of a pixel: a third of the pixels brings map and blur to where the
  // match with all of them has to be made once only.
  constexpr int thinned = 1500;
  constexpr int all = 4500;
  constexpr int last_pass = 4;
  ring_.emplace(pattern_, image_, frameAt(seen_um, 0, 0), blur_px_, thinned);
  for (int pass = 0; pass <= last_pass; ++pass) {
    bool changed = false;
    matched_k1_ = map_.k1_per_px2;
    // Those in view by the present map; matches are kept where they are close to their own prediction.
    std::vector<Expected> next;
    for (int row = pattern_.first_row; row <= pattern_.last_row; ++row) {
      for (int column = pattern_.first_column; column <= pattern_.last_column; ++column) {
        const Eigen::Vector2d centre = pattern_.ellipseCentre(row, column);
        const Eigen::Vector2d at = map_.imageOf(centre);
        if (at.x() < 0 || at.y() < 0 || at.x() > image_.width() || at.y() > image_.height()) continue;
        if (!whollyInView(centre)) continue;
        const auto old = std::find_if(expected_.begin(), expected_.end(),
                                      [&](const Expected& e) { return e.row == row && e.column == column; });
        Expected e{row, column, centre, {}};
        Eigen::Vector2d shift = Eigen::Vector2d::Zero();
        if (old != expected_.end()) {
          e.match = old->match;
          if (e.match.found) shift = Eigen::Vector2d(e.match.x_px, e.match.y_px) - at;
        }
        const bool fresh = !e.match.found || e.match.shift_px > 0.15;
        if (fresh) {
          if (shift.norm() > 8.0) shift.setZero();
          RingMatch match = ring_->match(image_, map_, centre, shift);
          if (match.found && (match.visible < 0.4 || match.correlation < 0.45)) match.found = false;
          changed = changed || match.found;
          e.match = match;
        }
        next.push_back(e);
      }
    }
    expected_ = std::move(next);
    // Marks of much less contrast than the others are not lines of the pattern.
    std::vector<double> contrasts;
    for (const Expected& e : expected_) {
      if (e.match.found) contrasts.push_back(e.match.contrast);
    }
    if (contrasts.empty() && pass > 0) return;
    double typical = 0.0;
    if (!contrasts.empty()) {
      std::nth_element(contrasts.begin(), contrasts.begin() + contrasts.size() / 2, contrasts.end());
      typical = contrasts[contrasts.size() / 2];
    }
    std::vector<MapPoint> points;
    for (Expected& e : expected_) {
      if (e.match.found && e.match.contrast < 0.2 * typical) e.match.found = false;
      if (e.match.found) points.push_back({e.centre_um, {e.match.x_px, e.match.y_px}, 0.05});
    }
    const MapFit fit = fitMap(points, map_, points.size() >= 6);
    if (fit.status == FitStatus::Converged) map_ = fit.map;
    if (pass < last_pass && std::abs(map_.k1_per_px2 - matched_k1_) * bendPerK1() > 0.0005) {
      for (Expected& e : expected_) e.match.shift_px = 1.0;
    }
    if (pass <= 1 || !changed) {
      std::vector<Eigen::Vector2d> centres;
      std::vector<Eigen::Vector2d> shifts;
      for (const Expected& e : expected_) {
        if (!e.match.found || centres.size() == 8) continue;
        centres.push_back(e.centre_um);
        shifts.push_back(Eigen::Vector2d(e.match.x_px, e.match.y_px) - map_.imageOf(e.centre_um));
      }
      const double blur = ring_->estimateBlur(image_, map_, centres, shifts);
      const bool other = blur > 0.0 && std::abs(blur / blur_px_ - 1.0) > 0.1;
      if (blur > 0.0) blur_px_ = blur;
      if (pass == 0 || (other && pass < last_pass)) {
        ring_.emplace(pattern_, image_, frameAt(seen_um, 0, 0), blur_px_, all);
        for (Expected& e : expected_) e.match.shift_px = 1.0;
        continue;
      }
    }
    if (!changed) break;
    const bool settled = std::none_of(expected_.begin(), expected_.end(),
                                      [](const Expected& e) { return e.match.found && e.match.shift_px > 0.15; });
    if (settled) break;
  }
}

void Decoding::locateCircles() {
  std::vector<double> ratio;
  for (const Expected& e : expected_) {
    if (e.match.found) ratio.push_back(e.match.effective_noise / e.match.pixel_noise);
  }
  if (!ratio.empty()) {
    std::nth_element(ratio.begin(), ratio.begin() + ratio.size() / 2, ratio.end());
    noise_inflation_ = std::max(1.0, ratio[ratio.size() / 2]);
  }
  if (!options_.circles) return;
  const Light light(expected_, {map_.centre_x_px, map_.centre_y_px});
  const EdgeProfile edge(blur_px_);
  for (int j = pattern_.first_circle_row; j <= pattern_.last_circle_row; ++j) {
    for (int i = pattern_.first_circle_column; i <= pattern_.last_circle_column; ++i) {
      const Eigen::Vector2d centre = pattern_.circleCentre(i, j);
      const Eigen::Vector2d at = map_.imageOf(centre);
      if (!(at.x() > 0 && at.y() > 0 && at.x() < image_.width() && at.y() < image_.height())) continue;
      const RingMatch match = matchCircle(image_, pattern_, map_, centre, edge, light.gradientAt(at));
      if (!match.found || match.correlation < 0.7 || match.shift_px > 1.5) continue;
      CircleMark mark;
      mark.i = i;
      mark.j = j;
      mark.x_px = match.x_px;
      mark.y_px = match.y_px;
      mark.sigma_px =
          std::hypot(match.pixel_noise * noise_inflation_ * std::sqrt(0.5 * match.unit_covariance_px2.trace()),
                     3.0 * model_sigma_px);
      mark.score = match.correlation;
      result_.circles.push_back(mark);
    }
  }
}

void Decoding::fitFinalMap() {
  // The noise that explains the scatter along the outlines, pooled; each ellipse has its own in part (dust, scratches).
  std::vector<double> noise;
  for (const Expected& e : expected_) {
    if (e.match.found) noise.push_back(e.match.effective_noise);
  }
  if (noise.empty()) return;
  std::nth_element(noise.begin(), noise.begin() + noise.size() / 2, noise.end());
  pooled_noise_ = noise[noise.size() / 2];
  double contrast = 0.0;
  for (const Expected& e : expected_) {
    if (!e.match.found) continue;
    constexpr double prior = 30.0;
    const double dof = e.match.degrees_of_freedom;
    const double own = e.match.effective_noise;
    const double variance = (prior * pooled_noise_ * pooled_noise_ + dof * own * own) / (prior + dof);
    Subpattern s;
    s.row = e.row;
    s.column = e.column;
    s.x_px = e.match.x_px;
    s.y_px = e.match.y_px;
    s.covariance_px2 =
        variance * e.match.unit_covariance_px2 + model_sigma_px * model_sigma_px * Eigen::Matrix2d::Identity();
    s.sigma_px = std::sqrt(0.5 * s.covariance_px2.trace());
    s.score = e.match.correlation;
    contrast += e.match.contrast;
    result_.subpatterns.push_back(s);
  }
  result_.exposure.contrast = contrast / static_cast<double>(result_.subpatterns.size());
  result_.exposure.blur_sigma_px = std::sqrt(std::max(0.0, blur_px_ * blur_px_ - 1.0 / 12.0));
  MapFit fit = fitToMarks();
  if (fit.status == FitStatus::Converged) map_ = fit.map;
  if (result_.subpatterns.size() >= 5 && settleOutliers(fit)) {
    fit = fitToMarks();
    if (fit.status == FitStatus::Converged) map_ = fit.map;
  }
  scaleUncertainties();
  result_.map = map_;
  result_.pixel_length_sigma_um = fit.pixel_length_sigma_um;
  result_.tilt_sigma_rad = fit.tilt_sigma_rad;
  result_.k1_sigma_per_px2 = fit.k1_sigma_per_px2;
  result_.map_rms_px = fit.rms_px;
  result_.map_chi2_per_dof = fit.chi2_per_dof;
}

MapFit Decoding::fitToMarks() const {
  std::vector<MapPoint> points;
  for (const Subpattern& s : result_.subpatterns) {
    points.push_back({pattern_.ellipseCentre(s.row, s.column), {s.x_px, s.y_px}, s.sigma_px});
  }
  for (const CircleMark& c : result_.circles) {
    points.push_back({pattern_.circleCentre(c.i, c.j), {c.x_px, c.y_px}, c.sigma_px});
  }
  return fitMap(points, map_, true);
}

void Decoding::scaleUncertainties() {
  // What the outlines cannot tell of themselves (compression, shape of the pixels, uneven light) shows in how well the
  // ellipses fit together. Never below what the outlines say.
  double chi2 = 0.0;
  int count = 0;
  for (const Subpattern& s : result_.subpatterns) {
    const Eigen::Vector2d off = Eigen::Vector2d(s.x_px, s.y_px) - map_.imageOf(pattern_.ellipseCentre(s.row, s.column));
    const double z2 = off.squaredNorm() / (s.sigma_px * s.sigma_px);
    chi2 += std::min(z2, 25.0);
    count += 2;
  }
  constexpr double prior = 10.0;
  const double dof = std::max(0, count - 5);
  const double factor2 = (prior + dof * chi2 / std::max(1.0, dof)) / (prior + dof);
  if (factor2 <= 1.0) return;
  for (Subpattern& s : result_.subpatterns) {
    s.covariance_px2 *= factor2;
    s.sigma_px *= std::sqrt(factor2);
  }
}

bool Decoding::settleOutliers(const MapFit& fit) {
  const double scale = std::max(1.0, std::sqrt(fit.chi2_per_dof));
  constexpr double limit = 4.0;  // of the distance in the plane over the uncertainty of a coordinate
  bool changed = false;
  const auto covered = [&](const CircleMark& c) {
    const double off = (Eigen::Vector2d(c.x_px, c.y_px) - map_.imageOf(pattern_.circleCentre(c.i, c.j))).norm();
    return off > limit * scale * c.sigma_px;
  };
  const std::size_t before = result_.circles.size();
  std::erase_if(result_.circles, covered);
  changed = result_.circles.size() != before;
  for (Subpattern& s : result_.subpatterns) {
    const Eigen::Vector2d centre = pattern_.ellipseCentre(s.row, s.column);
    const Eigen::Vector2d predicted = map_.imageOf(centre);
    const double off = (Eigen::Vector2d(s.x_px, s.y_px) - predicted).norm();
    if (off <= limit * scale * s.sigma_px) continue;
    changed = true;
    // Something lies on the line that a look at this ellipse alone does not tell: its neighbours tell where it is.
    const RingMatch match = ring_->match(image_, map_, centre, Eigen::Vector2d::Zero(), true);
    if (match.found && match.visible > 0.3) {
      s.x_px = match.x_px;
      s.y_px = match.y_px;
      const double variance = std::max(match.effective_noise * match.effective_noise, pooled_noise_ * pooled_noise_);
      s.covariance_px2 =
          variance * match.unit_covariance_px2 + model_sigma_px * model_sigma_px * Eigen::Matrix2d::Identity();
      s.sigma_px = std::sqrt(0.5 * s.covariance_px2.trace());
    }
    const Eigen::Vector2d left = Eigen::Vector2d(s.x_px, s.y_px) - predicted;
    if (left.norm() > limit * scale * s.sigma_px) {
      s.covariance_px2 += 0.5 * left.squaredNorm() * Eigen::Matrix2d::Identity();
      s.sigma_px = std::sqrt(0.5 * s.covariance_px2.trace());
    }
  }
  return changed;
}

void Decoding::readAllDigits() {
  const auto templates = library_.templates(std::max(blur_px_ * map_.pixel_length_um, 1.0));
  for (Subpattern& s : result_.subpatterns) {
    const Eigen::Vector2d centre = pattern_.ellipseCentre(s.row, s.column);
    const LocalFrame frame = frameAt(centre, s.x_px, s.y_px);
    const DigitScores scores = readDigits(image_, pattern_, library_, templates, frame);
    const std::array<int, 4> digits = FiducialPattern::digitsOf(s.row, s.column);
    double sum = 0.0;
    s.digit_confidence = 1.0;
    for (int k = 0; k < 4; ++k) {
      const double own = scores[k][digits[k]];
      double rival = -1.0;
      for (int d = 0; d < 10; ++d) {
        if (d != digits[k]) rival = std::max<double>(rival, scores[k][d]);
      }
      s.digit_confidence = std::min(s.digit_confidence, own - rival);
      sum += std::max(0.0, own);
    }
    s.from_neighbours = s.digit_confidence < 0.02;
    s.score = 0.5 * s.score + 0.125 * sum;
    s.tilt_rad = std::atan2(frame.x_axis.y(), frame.x_axis.x());
    const Eigen::Vector2d predicted = map_.imageOf(centre);
    s.residual_x_px = s.x_px - predicted.x();
    s.residual_y_px = s.y_px - predicted.y();
  }
}

void Decoding::lookForOthers() {
  if (!options_.check_uniqueness) return;
  const auto templates = library_.templates(std::max(blur_px_ * map_.pixel_length_um, 1.0));
  const double outer = (pattern_.semi_axis_x_um + 0.5 * pattern_.ellipse_line_width_um) *
                       (pattern_.semi_axis_y_um + 0.5 * pattern_.ellipse_line_width_um);
  for (const int k : lattice_.others) {
    const Mark& mark = marks_[k];
    const Eigen::Vector2d p = map_.patternOf({mark.x_px, mark.y_px});
    const int column = pattern_.first_column + static_cast<int>(std::lround(p.x() / pattern_.pitch_um));
    const int row = pattern_.first_row + static_cast<int>(std::lround(p.y() / pattern_.pitch_um));
    if (pattern_.contains(row, column) && (p - pattern_.ellipseCentre(row, column)).norm() < 0.15 * pattern_.pitch_um) {
      continue;
    }
    const double length = std::sqrt(outer / (mark.semi_major_px * mark.semi_minor_px));
    const double tilt =
        pattern_.semi_axis_x_um > pattern_.semi_axis_y_um ? mark.tilt_rad : mark.tilt_rad + 0.5 * std::numbers::pi;
    if (carriesDigits(image_, pattern_, library_, templates, mark, length, tilt)) {
      result_.several_patterns = true;
      return;
    }
  }
}

DecodeResult Decoding::run() {
  result_.exposure = exposureOf(image_);
  if (!findPattern()) return std::move(result_);
  locateEllipses();
  locateCircles();
  fitFinalMap();
  // The distortion bends an outline, so that its middle is not the image of its centre. Where the map learnt more about
  // the distortion than the matches knew (few ellipses in view), match again.
  for (int pass = 0; pass < 5 && std::abs(map_.k1_per_px2 - matched_k1_) * bendPerK1() > 0.0003; ++pass) {
    matched_k1_ = map_.k1_per_px2;
    for (Expected& e : expected_) {
      if (!e.match.found) continue;
      const RingMatch match = ring_->match(image_, map_, e.centre_um, Eigen::Vector2d::Zero());
      if (match.found) e.match = match;
    }
    result_.subpatterns.clear();
    fitFinalMap();
  }
  if (static_cast<int>(result_.subpatterns.size()) < std::max(1, options_.min_subpatterns)) {
    rejectWith(fmt::format("only {} ellipses of the pattern were decoded; at least {} are needed",
                           result_.subpatterns.size(), std::max(1, options_.min_subpatterns)));
    return std::move(result_);
  }
  readAllDigits();
  if (std::all_of(result_.subpatterns.begin(), result_.subpatterns.end(),
                  [](const Subpattern& s) { return s.from_neighbours; })) {
    rejectWith(fmt::format("ellipses are seen ({}), but none of their numbers can be read for certain",
                           result_.subpatterns.size()));
    return std::move(result_);
  }
  if (std::string why = whyThePoseDoesNotHold(result_.subpatterns, pattern_, map_); !why.empty()) {
    rejectWith(std::move(why));
    return std::move(result_);
  }
  lookForOthers();
  if (result_.several_patterns) {
    rejectWith("two patterns are in view, so that it is not known which one is meant");
    return std::move(result_);
  }
  result_.status = FitStatus::Converged;
  result_.message = fmt::format("{} ellipses and {} circles", result_.subpatterns.size(), result_.circles.size());
  return std::move(result_);
}

/// The digits of this pattern. Captures come one after the other with the same pattern: the last one is kept.
std::shared_ptr<const NumberLibrary> libraryOf(const FiducialPattern& pattern) {
  struct Made {
    FiducialPattern of;
    std::shared_ptr<const NumberLibrary> library;
  };
  static std::mutex mutex;
  static Made last;
  const auto same = [&] {
    return last.library && last.of.digit_offset_x_um == pattern.digit_offset_x_um &&
           last.of.digit_offset_y_um == pattern.digit_offset_y_um &&
           last.of.digit_line_width_um == pattern.digit_line_width_um && last.of.digits == pattern.digits;
  };
  {
    const std::lock_guard lock(mutex);
    if (same()) return last.library;
  }
  auto library = std::make_shared<const NumberLibrary>(pattern);
  const std::lock_guard lock(mutex);
  last = {pattern, library};
  return library;
}

}  // namespace

void DecodeOptions::validate() const {
  if (!(min_pixel_length_um > 0.0) || !(max_pixel_length_um > min_pixel_length_um)) {
    throw InputError(fmt::format("pixel lengths from {} to {} µm are not allowed; 0 < smallest < largest is needed.",
                                 min_pixel_length_um, max_pixel_length_um));
  }
}

const Subpattern* DecodeResult::find(int row, int column) const noexcept {
  for (const Subpattern& s : subpatterns) {
    if (s.row == row && s.column == column) return &s;
  }
  return nullptr;
}

DecodeResult decodeImage(const GrayImage& image, const FiducialPattern& pattern, const DecodeOptions& options) {
  options.validate();
  const auto start = std::chrono::steady_clock::now();
  const std::shared_ptr<const NumberLibrary> library = libraryOf(pattern);
  DecodeResult result = Decoding(image, pattern, options, *library).run();
  result.elapsed_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace spindrift
