// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/virtual_microscope.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"
#include "core/base/random.h"

namespace spindrift {
namespace {

int nearest(double value) {
  return static_cast<int>(std::floor(value + 0.5));
}

double distanceToStroke(const PatternStroke& stroke, const Eigen::Vector2d& p) {
  double best = std::numeric_limits<double>::infinity();
  if (stroke.size() == 1) return (p - stroke[0]).norm();
  for (std::size_t k = 0; k + 1 < stroke.size(); ++k) {
    const Eigen::Vector2d along = stroke[k + 1] - stroke[k];
    const double length2 = along.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((p - stroke[k]).dot(along) / length2, 0.0, 1.0) : 0.0;
    best = std::min(best, (p - stroke[k] - t * along).squaredNorm());
  }
  return std::sqrt(best);
}

/// Distance of a point to the ellipse x = a cos t, y = b sin t (Newton on the foot point).
double distanceToEllipse(double a, double b, double x, double y) {
  x = std::abs(x);
  y = std::abs(y);
  double t = std::atan2(a * y, b * x);
  for (int i = 0; i < 12; ++i) {
    const double c = std::cos(t);
    const double s = std::sin(t);
    const double f = (a * a - b * b) * c * s - x * a * s + y * b * c;
    const double slope = (a * a - b * b) * (c * c - s * s) - x * a * c - y * b * s;
    if (slope == 0.0) break;
    const double step = std::clamp(f / slope, -0.3, 0.3);
    t = std::clamp(t - step, 0.0, 0.5 * std::numbers::pi);
    if (std::abs(step) < 1e-13) break;
  }
  return std::hypot(x - a * std::cos(t), y - b * std::sin(t));
}

/// A function of the plane sampled every um, bilinear between the samples. Signed distances: < 0 inside the mark.
class DistanceTable {
 public:
  DistanceTable() = default;
  DistanceTable(double half_x, double half_y, const std::function<double(double, double)>& function)
      : half_x_(std::ceil(half_x)), half_y_(std::ceil(half_y)) {
    columns_ = static_cast<int>(2 * half_x_) + 2;
    const int rows = static_cast<int>(2 * half_y_) + 2;
    values_.resize(static_cast<std::size_t>(columns_) * rows);
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns_; ++i) {
        values_[static_cast<std::size_t>(j) * columns_ + i] = static_cast<float>(function(i - half_x_, j - half_y_));
      }
    }
  }
  /// The smallest value along its edges.
  [[nodiscard]] double leastAtBorder() const {
    const std::size_t rows = values_.size() / static_cast<std::size_t>(columns_);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < rows; ++j) {
      const float* line = &values_[j * static_cast<std::size_t>(columns_)];
      if (j == 0 || j + 2 >= rows) {
        least = std::min<double>(least, *std::min_element(line, line + columns_));
      } else {
        least = std::min<double>({least, line[0], line[columns_ - 2], line[columns_ - 1]});
      }
    }
    return least;
  }
  [[nodiscard]] bool covers(double x, double y, double around = 0.0) const {
    return std::abs(x) + around < half_x_ && std::abs(y) + around < half_y_;
  }
  [[nodiscard]] double at(double x, double y) const {
    const double u = x + half_x_;
    const double v = y + half_y_;
    const int i = static_cast<int>(u);
    const int j = static_cast<int>(v);
    const double fu = u - i;
    const double fv = v - j;
    const float* p = &values_[static_cast<std::size_t>(j) * columns_ + i];
    return (1 - fv) * ((1 - fu) * p[0] + fu * p[1]) + fv * ((1 - fu) * p[columns_] + fu * p[columns_ + 1]);
  }

 private:
  double half_x_ = 0.0;
  double half_y_ = 0.0;
  int columns_ = 0;
  std::vector<float> values_;
};

/// Tables of the signed distance (um, < 0 inside) to the marks of a pattern.
class ArtworkDistance {
 public:
  static constexpr double reach_um = 8.0;  ///< around a ring, where its table still knows
  static constexpr double far_um = 1e3;

  explicit ArtworkDistance(FiducialPattern artwork) : pattern_(std::move(artwork)) {
    const FiducialPattern& pattern = pattern_;
    const double half = 0.5 * pattern.ellipse_line_width_um;
    ring_ = DistanceTable(pattern.semi_axis_x_um + half + reach_um, pattern.semi_axis_y_um + half + reach_um,
                          [&](double x, double y) {
                            return distanceToEllipse(pattern.semi_axis_x_um, pattern.semi_axis_y_um, x, y) - half;
                          });
    for (int digit = 0; digit < 10; ++digit) {
      digits_[digit] = DistanceTable(pattern.digit_offset_x_um, pattern.digit_offset_y_um, [&](double x, double y) {
        double best = std::numeric_limits<double>::infinity();
        for (const PatternStroke& s : pattern.digits[digit]) best = std::min(best, distanceToStroke(s, {x, y}));
        return best - 0.5 * pattern.digit_line_width_um;
      });
      // The table reaches to whole um, beyond what belongs to the digit, and is sampled every um.
      const double beyond_um = std::max(std::ceil(pattern.digit_offset_x_um) - pattern.digit_offset_x_um,
                                        std::ceil(pattern.digit_offset_y_um) - pattern.digit_offset_y_um);
      known_um_ = std::min(known_um_, digits_[digit].leastAtBorder() - beyond_um - 0.5);
    }
    for (const double semi_axis_um : {pattern.semi_axis_x_um, pattern.semi_axis_y_um})
      known_um_ = std::min(known_um_, 0.5 * pattern.pitch_um - semi_axis_um - half);
    known_um_ = std::min(known_um_, 0.5 * pattern.pitch_um - pattern.circle_radius_um);
    findFreeSpace();
  }

  [[nodiscard]] const FiducialPattern& pattern() const { return pattern_; }
  /// How far from every place no mark is missed: a place sees its own ellipse, digit and circle alone.
  [[nodiscard]] double knownUm() const { return std::max(0.0, known_um_); }
  [[nodiscard]] const DistanceTable& ring() const { return ring_; }
  [[nodiscard]] const DistanceTable& digit(int d) const { return digits_[d]; }
  /// No mark is nearer to a place than this, whatever the digits are; 0 among the marks.
  [[nodiscard]] double freeUm(double x, double y) const {
    const double u = x / pattern_.pitch_um;
    const double v = y / pattern_.pitch_um;
    const auto i = static_cast<int>((u - std::floor(u)) * free_.cols);
    const auto j = static_cast<int>((v - std::floor(v)) * free_.rows);
    return free_(std::min(j, free_.rows - 1), std::min(i, free_.cols - 1));
  }

 private:
  /// Every cell of a raster over one pitch in which there may be a mark, and how far the others are from those.
  void findFreeSpace() {
    const double pitch = pattern_.pitch_um;
    const int n = std::clamp(static_cast<int>(pitch / 2.0), 16, 512);
    const double cell = pitch / n;
    const double half_diagonal = 0.5 * std::numbers::sqrt2 * cell;
    cv::Mat1b empty(3 * n, 3 * n);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const bool marked = leastOfAll((i + 0.5) * cell, (j + 0.5) * cell) < half_diagonal + 0.5;
        for (int k = 0; k < 9; ++k) empty(j + (k / 3) * n, i + (k % 3) * n) = marked ? 0 : 1;
      }
    }
    cv::Mat1f far;
    cv::distanceTransform(empty, far, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    free_ = cv::Mat1f(far(cv::Rect(n, n, n, n)) * cell - 2.0 * half_diagonal).clone();
    free_ = cv::max(free_, 0.0F);
  }

  /// Distance to the nearest mark there may be at a place of the first pitch, above `reach_um` as far as it is known.
  [[nodiscard]] double leastOfAll(double x, double y) const {
    double least = far_um;
    const auto centred = [&](double value) { return value - pattern_.pitch_um * nearest(value / pattern_.pitch_um); };
    const double u = centred(x);
    const double v = centred(y);
    if (ring_.covers(u, v)) least = ring_.at(u, v);
    for (const double from_x : {-pattern_.digit_offset_x_um, pattern_.digit_offset_x_um}) {
      for (const double from_y : {-pattern_.digit_offset_y_um, pattern_.digit_offset_y_um}) {
        for (const DistanceTable& digit : digits_) {
          if (digit.covers(u - from_x, v - from_y)) least = std::min(least, digit.at(u - from_x, v - from_y));
        }
      }
    }
    return std::min(least,
                    std::hypot(centred(x - pattern_.circle_offset_x_um), centred(y - pattern_.circle_offset_y_um)) -
                        pattern_.circle_radius_um);
  }

  FiducialPattern pattern_;
  DistanceTable ring_;
  std::array<DistanceTable, 10> digits_;
  double known_um_ = reach_um - 1.0;
  cv::Mat1f free_;
};

/// Looks up an artwork along a path: the ellipse and the circle that a place belongs to are those of the place before,
/// mostly.
class ArtworkCursor {
 public:
  explicit ArtworkCursor(const ArtworkDistance& artwork) : artwork_(artwork), pattern_(artwork.pattern()) {}

  /// Signed distance to the nearest mark (um, < 0 inside).
  double at(double x, double y) {
    goTo(x, y);
    double ring = ArtworkDistance::far_um, digit = ArtworkDistance::far_um, circle = ArtworkDistance::far_um;
    digit_ = nullptr;
    if (ellipse_) {
      const double u = x - ellipse_x_;
      const double v = y - ellipse_y_;
      if (artwork_.ring().covers(u, v)) ring = artwork_.ring().at(u, v);
      if (std::abs(u) < 2 * pattern_.digit_offset_x_um && std::abs(v) < 2 * pattern_.digit_offset_y_um) {
        const double from_x = u >= 0.0 ? pattern_.digit_offset_x_um : -pattern_.digit_offset_x_um;
        const double from_y = v >= 0.0 ? pattern_.digit_offset_y_um : -pattern_.digit_offset_y_um;
        const DistanceTable& table = *digits_[(v >= 0.0 ? 0 : 2) + (u >= 0.0 ? 1 : 0)];
        if (table.covers(u - from_x, v - from_y)) {
          digit = table.at(u - from_x, v - from_y);
          digit_ = &table;
          digit_x_ = ellipse_x_ + from_x;
          digit_y_ = ellipse_y_ + from_y;
        }
      }
    }
    if (circle_) circle = toCircle(x, y);
    x_ = x;
    y_ = y;
    near_ = {ring, digit, circle};
    return std::min({ring, digit, circle});
  }

  /// The same of places no further than `reach_um` from the last one that was looked at, where the distance is below
  /// `reach_um`; elsewhere anything above it.
  template <std::size_t N>
  void besideIt(const std::array<double, N>& x, const std::array<double, N>& y, double reach_um,
                std::array<double, N>& distance) const {
    const double seen_um = 2.5 * reach_um;
    const bool ring = near_[0] < seen_um;
    const bool digit = near_[1] < seen_um;
    const bool circle = near_[2] < seen_um;
    // Mostly one mark is near, and its table holds all of the places.
    if (ring && !digit && !circle && artwork_.ring().covers(x_ - ellipse_x_, y_ - ellipse_y_, reach_um)) {
      for (std::size_t k = 0; k < N; ++k) distance[k] = artwork_.ring().at(x[k] - ellipse_x_, y[k] - ellipse_y_);
    } else if (digit && !ring && !circle && digit_->covers(x_ - digit_x_, y_ - digit_y_, reach_um)) {
      for (std::size_t k = 0; k < N; ++k) distance[k] = digit_->at(x[k] - digit_x_, y[k] - digit_y_);
    } else if (circle && !ring && !digit) {
      for (std::size_t k = 0; k < N; ++k) distance[k] = toCircle(x[k], y[k]);
    } else {
      for (std::size_t k = 0; k < N; ++k) distance[k] = besideIt(x[k], y[k], reach_um);
    }
  }

 private:
  [[nodiscard]] double toCircle(double x, double y) const {
    const double u = x - circle_x_;
    const double v = y - circle_y_;
    return std::sqrt(u * u + v * v) - pattern_.circle_radius_um;
  }

  [[nodiscard]] double besideIt(double x, double y, double reach_um) const {
    double best = ArtworkDistance::far_um;
    const double seen_um = 2.5 * reach_um;
    if (near_[0] < seen_um && artwork_.ring().covers(x - ellipse_x_, y - ellipse_y_))
      best = artwork_.ring().at(x - ellipse_x_, y - ellipse_y_);
    if (near_[1] < seen_um && digit_->covers(x - digit_x_, y - digit_y_))
      best = std::min(best, digit_->at(x - digit_x_, y - digit_y_));
    if (near_[2] < seen_um) best = std::min(best, toCircle(x, y));
    return best;
  }

  void goTo(double x, double y) {
    const double half = 0.4999 * pattern_.pitch_um;  // nearer to its centre than that it is the same for sure
    if (!(std::abs(x - ellipse_x_) < half && std::abs(y - ellipse_y_) < half)) {
      const int column = pattern_.first_column + nearest(x / pattern_.pitch_um);
      const int row = pattern_.first_row + nearest(y / pattern_.pitch_um);
      const Eigen::Vector2d centre = pattern_.ellipseCentre(row, column);
      ellipse_x_ = centre.x();
      ellipse_y_ = centre.y();
      ellipse_ = pattern_.contains(row, column);
      const std::array<int, 4> digits = FiducialPattern::digitsOf(row, column);
      for (std::size_t k = 0; ellipse_ && k < digits.size(); ++k) digits_[k] = &artwork_.digit(digits[k]);
    }
    if (!(std::abs(x - circle_x_) < half && std::abs(y - circle_y_) < half)) {
      const int i = nearest((x - pattern_.circle_offset_x_um) / pattern_.pitch_um);
      const int j = nearest((y - pattern_.circle_offset_y_um) / pattern_.pitch_um);
      const Eigen::Vector2d centre = pattern_.circleCentre(i, j);
      circle_x_ = centre.x();
      circle_y_ = centre.y();
      circle_ = i >= pattern_.first_circle_column && i <= pattern_.last_circle_column &&
                j >= pattern_.first_circle_row && j <= pattern_.last_circle_row;
    }
  }

  const ArtworkDistance& artwork_;
  const FiducialPattern& pattern_;
  bool ellipse_ = false, circle_ = false;  ///< whether there is one at that place of the grid
  double ellipse_x_ = std::numeric_limits<double>::infinity(), ellipse_y_ = 0.0;
  double circle_x_ = std::numeric_limits<double>::infinity(), circle_y_ = 0.0;
  std::array<const DistanceTable*, 4> digits_{};
  double x_ = 0.0, y_ = 0.0;      ///< the last place
  std::array<double, 3> near_{};  ///< its ring, digit and circle
  const DistanceTable* digit_ = nullptr;
  double digit_x_ = 0.0, digit_y_ = 0.0;
};

/// The tables of a pattern, kept from image to image: they take longer than an image.
std::shared_ptr<const ArtworkDistance> artworkOf(const FiducialPattern& pattern) {
  static std::mutex mutex;
  static std::string known;
  static std::shared_ptr<const ArtworkDistance> tables;
  const std::string key = patternJson(pattern);
  const std::lock_guard lock(mutex);
  if (tables == nullptr || key != known) {
    tables = std::make_shared<const ArtworkDistance>(pattern);
    known = key;
  }
  return tables;
}

/// A grid of values finer than the pixels by `fine`; value (i, j) is the mean over its cell.
struct Canvas {
  int width = 0;
  int height = 0;
  int fine = 1;
  std::vector<float> level;
};

/// Paints the coverage of the artwork averaged over every cell: whole squares of cells at a time where no edge is near.
class PatternPainter {
 public:
  PatternPainter(Canvas& canvas, const ArtworkDistance& artwork, const PatternMap& map, double ground, double mark)
      : canvas_(canvas),
        artwork_(artwork),
        map_(map),
        mark_(mark - ground),
        cell_px_(1.0 / canvas.fine),
        cell_um_(cell_px_ * map.pixel_length_um),
        known_um_(artwork.knownUm()),
        turn_c_(std::cos(map.tilt_rad)),
        turn_s_(std::sin(map.tilt_rad)),
        cursor_(artwork) {
    // The parts of a cell turned into the pattern (its own small turn by the distortion does not matter within a cell).
    for (std::size_t k = 0; k < part_x_.size(); ++k) {
      const double a = cell_um_ / parts * (static_cast<double>(k % parts) - 0.5 * (parts - 1));
      const double b = cell_um_ / parts * (static_cast<double>(k / parts) - 0.5 * (parts - 1));
      part_x_[k] = turn_c_ * a + turn_s_ * b;
      part_y_[k] = (map.mirrored ? 1.0 : -1.0) * (turn_c_ * b - turn_s_ * a);
    }
  }

  void paint() {
    constexpr int largest = 32;
    for (int j = 0; j < canvas_.height; j += largest) {
      for (int i = 0; i < canvas_.width; i += largest) paintSquare(i, j, largest);
    }
  }

 private:
  static constexpr std::size_t parts = 4;  ///< of a cell that an edge goes through, each way

  void paintSquare(int i, int j, int size) {
    if (i >= canvas_.width || j >= canvas_.height) return;
    const Eigen::Vector2d p = patternOf((i + 0.5 * size) * cell_px_ - 0.5, (j + 0.5 * size) * cell_px_ - 0.5);
    // An edge further than 0.75 cells from the centre of a cell does not meet it; the lens stretches a little.
    const double reach_um = (0.5 * std::numbers::sqrt2 * (size - 1) + 0.75) * cell_um_;
    if (0.9 * artwork_.freeUm(p.x(), p.y()) >= reach_um) return;
    if (size == 1 || 0.9 * known_um_ >= reach_um) {
      const double d = cursor_.at(p.x(), p.y());
      if ((size == 1 ? std::abs(d) : 0.9 * std::min(std::abs(d), known_um_)) >= reach_um) {
        if (d < 0.0) add(i, j, size, static_cast<float>(mark_));
        return;
      }
    }
    if (size == 1) {
      add(i, j, 1, static_cast<float>(mark_ * coverageAround(p)));
      return;
    }
    const int half = size / 2;
    paintSquare(i, j, half);
    paintSquare(i + half, j, half);
    paintSquare(i, j + half, half);
    paintSquare(i + half, j + half, half);
  }

  void add(int i, int j, int size, float level) {
    const int last = std::min(canvas_.width, i + size);
    for (int y = j; y < std::min(canvas_.height, j + size); ++y) {
      float* line = &canvas_.level[static_cast<std::size_t>(y) * canvas_.width];
      for (int x = i; x < last; ++x) line[x] += level;
    }
  }

  /// Of the cell whose centre was looked at last.
  double coverageAround(const Eigen::Vector2d& p) {
    for (std::size_t k = 0; k < x_.size(); ++k) {
      x_[k] = p.x() + part_x_[k];
      y_[k] = p.y() + part_y_[k];
    }
    cursor_.besideIt(x_, y_, cell_um_, distance_);
    const double parts_per_um = parts / cell_um_;
    double coverage = 0.0;
    for (const double part : distance_) coverage += std::clamp(0.5 - part * parts_per_um, 0.0, 1.0);
    return coverage / (parts * parts);
  }

  /// PatternMap::patternOf with what is constant taken out.
  [[nodiscard]] Eigen::Vector2d patternOf(double x, double y) const {
    x -= map_.centre_x_px;
    y -= map_.centre_y_px;
    if (map_.k1_per_px2 != 0.0) {
      const double q = map_.k1_per_px2 * (x * x + y * y);
      double factor = 1.0 - q * (1.0 - q * (3.0 - 12.0 * q));
      const int steps = std::abs(q) < 0.005 ? 1 : 3;
      for (int k = 0; k < steps; ++k) {
        factor -= (factor * (1.0 + q * factor * factor) - 1.0) / (1.0 + 3.0 * q * factor * factor);
      }
      x *= factor;
      y *= factor;
    }
    x -= map_.origin_x_px;
    y -= map_.origin_y_px;
    const double across = map_.pixel_length_um * (-turn_s_ * x + turn_c_ * y);
    return {map_.pixel_length_um * (turn_c_ * x + turn_s_ * y), map_.mirrored ? across : -across};
  }

  Canvas& canvas_;
  const ArtworkDistance& artwork_;
  const PatternMap& map_;
  double mark_, cell_px_, cell_um_, known_um_, turn_c_, turn_s_;
  ArtworkCursor cursor_;
  std::array<double, parts * parts> part_x_{}, part_y_{}, x_{}, y_{}, distance_{};
};

/// Draws a shape given by its signed distance (px) with soft edges, `alpha` opaque.
void paintShape(Canvas& canvas, double x0, double y0, double x1, double y1, double level, double alpha, double softness,
                const std::function<double(double, double)>& distance_px) {
  const int f = canvas.fine;
  const int i0 = std::max(0, static_cast<int>((x0 - 2) * f));
  const int j0 = std::max(0, static_cast<int>((y0 - 2) * f));
  const int i1 = std::min(canvas.width - 1, static_cast<int>((x1 + 3) * f));
  const int j1 = std::min(canvas.height - 1, static_cast<int>((y1 + 3) * f));
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const double d = distance_px((i + 0.5) / f - 0.5, (j + 0.5) / f - 0.5);
      const double opaque = alpha * std::clamp(0.5 - d / softness, 0.0, 1.0);
      float& value = canvas.level[static_cast<std::size_t>(j) * canvas.width + i];
      value += static_cast<float>(opaque * (level - value));
    }
  }
}

double distanceToSegment(double x, double y, double ax, double ay, double bx, double by) {
  return distanceToStroke({{ax, ay}, {bx, by}}, {x, y});
}

void paintClutter(Canvas& canvas, const FiducialPattern& pattern, const ArtworkDistance& artwork,
                  const MicroscopeScene& scene, Random& random) {
  const double w = scene.width_px;
  const double h = scene.height_px;
  for (const auto& [row, column] : scene.damaged_digits) {
    // A blob over two digits and a stroke across all four.
    const double level = random.uniform() < 0.5 ? scene.mark_level : scene.ground_level;
    const Eigen::Vector2d e = pattern.ellipseCentre(row, column);
    const Eigen::Vector2d at = scene.map.imageOf(e + pattern.digitCentre(static_cast<int>(random.index(4))));
    const double radius = 38.0 / scene.map.pixel_length_um;
    paintShape(canvas, at.x() - radius, at.y() - radius, at.x() + radius, at.y() + radius, level, 1.0, 1.0,
               [&](double x, double y) { return std::hypot(x - at.x(), y - at.y()) - radius; });
    const Eigen::Vector2d a = scene.map.imageOf(e + Eigen::Vector2d(-55, random.uniform(-70, 70)));
    const Eigen::Vector2d b = scene.map.imageOf(e + Eigen::Vector2d(55, random.uniform(-70, 70)));
    paintShape(canvas, std::min(a.x(), b.x()) - 6, std::min(a.y(), b.y()) - 6, std::max(a.x(), b.x()) + 6,
               std::max(a.y(), b.y()) + 6, scene.mark_level, 1.0, 1.0,
               [&](double x, double y) { return distanceToSegment(x, y, a.x(), a.y(), b.x(), b.y()) - 4.0; });
  }
  for (int k = 0; k < scene.occlusions; ++k) {
    const double cx = random.uniform(0, w);
    const double cy = random.uniform(0, h);
    const double rx = random.uniform(30, 100);
    const double ry = random.uniform(30, 100);
    paintShape(canvas, cx - rx, cy - ry, cx + rx, cy + ry, random.uniform(scene.ground_level, scene.mark_level), 1.0,
               1.0, [&](double x, double y) { return std::max(std::abs(x - cx) - rx, std::abs(y - cy) - ry); });
  }
  for (int k = 0; k < scene.screws; ++k) {
    const double cx = random.uniform(0, w);
    const double cy = random.uniform(0, h);
    const double r = random.uniform(20, 60);
    const double turn = random.uniform(0, std::numbers::pi);
    const double level = random.uniform(0.6, 1.1) * scene.mark_level;
    paintShape(canvas, cx - r, cy - r, cx + r, cy + r, level, 1.0, 1.0,
               [&](double x, double y) { return std::hypot(x - cx, y - cy) - r; });
    paintShape(canvas, cx - r, cy - r, cx + r, cy + r, scene.ground_level, 1.0, 1.0, [&](double x, double y) {
      const double across = -(x - cx) * std::sin(turn) + (y - cy) * std::cos(turn);
      const double along = (x - cx) * std::cos(turn) + (y - cy) * std::sin(turn);
      return std::max(std::abs(across) - 0.15 * r, std::abs(along) - 0.8 * r);
    });
    const double ring = 1.3 * r;
    paintShape(canvas, cx - ring - 4, cy - ring - 4, cx + ring + 4, cy + ring + 4, level, 1.0, 1.0,
               [&](double x, double y) { return std::abs(std::hypot(x - cx, y - cy) - ring) - 3.0; });
  }
  for (int k = 0; k < scene.foreign_texts; ++k) {
    const double scale = random.uniform(0.3, 2.0);  // px per um of the digits
    const double turn = random.uniform(0, 2.0 * std::numbers::pi);
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    double cx = random.uniform(0, w);
    double cy = random.uniform(0, h);
    for (int letter = 0; letter < 5; ++letter) {
      const DistanceTable& table = artwork.digit(static_cast<int>(random.index(10)));
      const double reach = 60.0 * scale;
      paintShape(canvas, cx - reach, cy - reach, cx + reach, cy + reach, 0.9 * scene.mark_level, 1.0, 1.0,
                 [&](double x, double y) {
                   const double u = ((x - cx) * c + (y - cy) * s) / scale;
                   const double v = ((x - cx) * s - (y - cy) * c) / scale;
                   return table.covers(u, v) ? table.at(u, v) * scale : 10.0;
                 });
      cx += 66.0 * scale * c;
      cy += 66.0 * scale * s;
    }
  }
  for (int k = 0; k < scene.scratches; ++k) {
    const double ax = random.uniform(0, w);
    const double ay = random.uniform(0, h);
    const double turn = random.uniform(0, 2.0 * std::numbers::pi);
    const double length = random.uniform(100, 700);
    const double bx = ax + length * std::cos(turn);
    const double by = ay + length * std::sin(turn);
    const double half = random.uniform(0.5, 1.5);
    const bool bright = random.uniform() < 0.5;
    paintShape(canvas, std::min(ax, bx), std::min(ay, by), std::max(ax, bx), std::max(ay, by),
               bright ? 0.8 * scene.mark_level : scene.ground_level, 0.8, 1.0,
               [&](double x, double y) { return distanceToSegment(x, y, ax, ay, bx, by) - half; });
  }
}

/// out[x] = sum of weights[k] terms[k][x], a few x at a time: their sums stay in registers.
void weightedSum(const std::vector<float>& weights, const std::vector<const float*>& terms, int count, float* out) {
  constexpr int batch = 16;
  int x = 0;
  for (; x + batch <= count; x += batch) {
    Eigen::Array<float, batch, 1> sum = Eigen::Array<float, batch, 1>::Zero();
    for (std::size_t k = 0; k < weights.size(); ++k)
      sum += weights[k] * Eigen::Map<const Eigen::Array<float, batch, 1>>(terms[k] + x);
    Eigen::Map<Eigen::Array<float, batch, 1>>(out + x) = sum;
  }
  for (; x < count; ++x) {
    out[x] = 0.0F;
    for (std::size_t k = 0; k < weights.size(); ++k) out[x] += weights[k] * terms[k][x];
  }
}

/// Mean over the pixel of the canvas convolved with a Gaussian: one pass along rows, one along columns.
std::vector<float> expose(const Canvas& canvas, int width, int height, double sigma_px) {
  const int fine = canvas.fine;
  const double sigma = sigma_px * fine;
  const int reach = std::max(0, static_cast<int>(std::ceil(4.5 * sigma)));
  // Kernel over cells relative to the first cell of the pixel: Gaussian convolved with the box of `fine` cells.
  std::vector<float> kernel(2 * reach + fine, 0.0F);
  double sum = 0.0;
  std::vector<double> gauss(2 * reach + 1);
  for (int k = -reach; k <= reach; ++k) {
    gauss[k + reach] = sigma > 1e-9 ? std::exp(-0.5 * k * k / (sigma * sigma)) : 1.0;
    sum += gauss[k + reach];
  }
  for (int b = 0; b < fine; ++b) {
    for (int k = 0; k <= 2 * reach; ++k) kernel[b + k] += static_cast<float>(gauss[k] / (sum * fine));
  }
  std::vector<float> rows(static_cast<std::size_t>(width) * canvas.height, 0.0F);
  // The cells of a line by their place within the pixel: what a weight is multiplied with stands in a row then.
  const int stride = width + (2 * reach + fine) / fine + 1;
  std::vector<float> parted(static_cast<std::size_t>(stride) * fine);
  std::vector<const float*> terms(kernel.size());
  for (int j = 0; j < canvas.height; ++j) {
    const float* line = &canvas.level[static_cast<std::size_t>(j) * canvas.width];
    for (int f = 0; f < fine; ++f) {
      for (int m = 0; m < stride; ++m)
        parted[static_cast<std::size_t>(f) * stride + m] = line[std::clamp(m * fine + f - reach, 0, canvas.width - 1)];
    }
    for (std::size_t k = 0; k < kernel.size(); ++k) terms[k] = &parted[(k % fine) * stride + k / fine];
    weightedSum(kernel, terms, width, &rows[static_cast<std::size_t>(j) * width]);
  }
  std::vector<float> image(static_cast<std::size_t>(width) * height, 0.0F);
  for (int y = 0; y < height; ++y) {
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const int j = std::clamp(y * fine + static_cast<int>(k) - reach, 0, canvas.height - 1);
      terms[k] = &rows[static_cast<std::size_t>(j) * width];
    }
    weightedSum(kernel, terms, width, &image[static_cast<std::size_t>(y) * width]);
  }
  return image;
}

}  // namespace

void MicroscopeScene::validate() const {
  const auto require = [](bool holds, const char* sentence) {
    if (!holds) throw InputError(sentence);
  };
  require(width_px >= 16 && height_px >= 16 && width_px <= 20000 && height_px <= 20000,
          "the virtual camera needs between 16 and 20000 pixels in width and height.");
  require(map.pixel_length_um > 0.0, "the pixel length of the virtual microscope must be greater than zero (µm).");
  require(blur_sigma_px >= 0.0 && noise_level >= 0.0, "blur and noise must not be negative.");
  require(jpeg_quality >= 0 && jpeg_quality <= 100, "the JPEG quality must lie between 0 (none) and 100.");
}

PatternMap poseAt(int width_px, int height_px, double pixel_length_um, double tilt_rad,
                  const Eigen::Vector2d& pattern_um, const Eigen::Vector2d& pixel, double k1_per_px2, bool mirrored) {
  PatternMap map;
  map.pixel_length_um = pixel_length_um;
  map.tilt_rad = std::remainder(tilt_rad, 2.0 * std::numbers::pi);
  map.k1_per_px2 = k1_per_px2;
  map.mirrored = mirrored;
  map.centre_x_px = 0.5 * (width_px - 1);
  map.centre_y_px = 0.5 * (height_px - 1);
  const Eigen::Vector2d wanted = map.undistorted(pixel);
  PatternMap plain = map;
  plain.k1_per_px2 = 0.0;
  const Eigen::Vector2d got = plain.imageOf(pattern_um);
  map.origin_x_px = wanted.x() - got.x();
  map.origin_y_px = wanted.y() - got.y();
  return map;
}

GrayImage renderFiducial(const FiducialPattern& pattern, const MicroscopeScene& scene, std::uint64_t seed) {
  scene.validate();
  Random random(seed);
  const double sigma = std::hypot(scene.blur_sigma_px, scene.defocus_px_per_um * scene.defocus_um);
  Canvas canvas;
  canvas.fine = sigma < 1.0 ? 3 : (sigma < 2.0 ? 2 : 1);
  canvas.width = scene.width_px * canvas.fine;
  canvas.height = scene.height_px * canvas.fine;
  canvas.level.assign(static_cast<std::size_t>(canvas.width) * canvas.height, static_cast<float>(scene.ground_level));
  const std::shared_ptr<const ArtworkDistance> tables = artworkOf(pattern);
  const ArtworkDistance& artwork = *tables;
  PatternPainter(canvas, artwork, scene.map, scene.ground_level, scene.mark_level).paint();
  for (const PatternMap& further : scene.further_patterns) {
    PatternPainter(canvas, artwork, further, scene.ground_level, scene.mark_level).paint();
  }
  paintClutter(canvas, pattern, artwork, scene, random);
  std::vector<float> exposed = expose(canvas, scene.width_px, scene.height_px, sigma);

  struct Speck {
    double x, y, radius, depth;
  };
  std::vector<Speck> specks;
  for (int k = 0; k < scene.dust; ++k) {
    specks.push_back({random.uniform(0, scene.width_px), random.uniform(0, scene.height_px), random.uniform(1.5, 10.0),
                      random.uniform(0.2, 0.8)});
  }
  for (const Speck& speck : specks) {
    const int reach = static_cast<int>(2.5 * speck.radius) + 1;
    for (int y = std::max(0, static_cast<int>(speck.y) - reach);
         y <= std::min(scene.height_px - 1, static_cast<int>(speck.y) + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(speck.x) - reach);
           x <= std::min(scene.width_px - 1, static_cast<int>(speck.x) + reach); ++x) {
        const double r2 = (x - speck.x) * (x - speck.x) + (y - speck.y) * (y - speck.y);
        exposed[static_cast<std::size_t>(y) * scene.width_px + x] *=
            static_cast<float>(1.0 - speck.depth * std::exp(-r2 / (speck.radius * speck.radius)));
      }
    }
  }

  GrayImage image(scene.width_px, scene.height_px);
  const double corner2 = 0.25 * (static_cast<double>(scene.width_px) * scene.width_px +
                                 static_cast<double>(scene.height_px) * scene.height_px);
  std::vector<double> along_x(static_cast<std::size_t>(scene.width_px)), x2(along_x.size());
  for (int x = 0; x < scene.width_px; ++x) {
    const double u = x - 0.5 * (scene.width_px - 1);
    along_x[x] = 1.0 + scene.gradient_x * u / scene.width_px;
    x2[x] = u * u;
  }
  for (int y = 0; y < scene.height_px; ++y) {
    const double v = y - 0.5 * (scene.height_px - 1);
    const double along_y = scene.gradient_y * v / scene.height_px;
    const float* line = &exposed[static_cast<std::size_t>(y) * scene.width_px];
    for (int x = 0; x < scene.width_px; ++x) {
      double light = scene.illumination_gain * (along_x[x] + along_y);
      if (scene.vignetting != 0.0) light *= 1.0 - scene.vignetting * (x2[x] + v * v) / corner2;
      double level = light * line[x];
      if (scene.noise_level > 0.0) level += scene.noise_level * random.normal();
      image.at(x, y) = static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0) + 0.5);
    }
  }
  if (scene.jpeg_quality > 0) return decodeImageBytes(encodeJpeg(image, scene.jpeg_quality), "virtual.jpg");
  return image;
}

}  // namespace spindrift
