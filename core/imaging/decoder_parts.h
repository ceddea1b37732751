// SPDX-License-Identifier: Apache-2.0
// The steps of the decoder, one file each; used by decoder.cpp and its tests only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/imaging/decoder.h"
#include "core/imaging/image.h"
#include "core/imaging/pattern.h"

namespace spindrift::decoding {

// ---- segmentation.cpp -------------------------------------------------------------------------------------------

/// A connected bright mark, filled from its leftmost to its rightmost pixel in every row. Full-resolution pixels.
struct Mark {
  double x_px = 0.0;
  double y_px = 0.0;
  double semi_major_px = 0.0;  ///< of the ellipse with the same second moments as the filled mark
  double semi_minor_px = 0.0;
  double tilt_rad = 0.0;         ///< of the major axis, from image x towards image y, [-pi/2, pi/2)
  double ellipse_ratio = 0.0;    ///< filled area over the area of that ellipse; 1 for an ellipse
  double filled_fraction = 0.0;  ///< bright pixels over filled area
};

/// Size limits of the marks that are kept, semi-major axis in px.
struct MarkLimits {
  double min_semi_major_px = 0.0;
  double max_semi_major_px = 0.0;
};

/// Threshold half way between the darkest and the brightest of the surroundings on the image reduced 2:1, connected
/// marks (8 neighbours), those that do not touch the border.
[[nodiscard]] std::vector<Mark> findMarks(const GrayImage& image, const MarkLimits& limits);

// ---- grid.cpp -----------------------------------------------------------------------------------------------------

/// A mark with its place in the lattice: u along the direction `tilt_rad`, v along what is up (+Y) in a pattern of that
/// tilt that is not mirrored.
struct LatticeNode {
  int mark = 0;
  int u = 0;
  int v = 0;
};

/// Ellipses of equal size and direction on a square lattice.
struct Lattice {
  double tilt_rad = 0.0;  ///< of the ellipses' X axes, known up to pi
  double pixel_length_um = 0.0;
  std::vector<LatticeNode> nodes;
  std::vector<int> others;  ///< marks that look like ellipses of the pattern but stand off the lattice
};

/// The largest lattice among the marks; empty if there is no ellipse of the pattern's proportions.
[[nodiscard]] Lattice findLattice(const std::vector<Mark>& marks, const FiducialPattern& pattern,
                                  const DecodeOptions& options);

// ---- digits.cpp ---------------------------------------------------------------------------------------------------

/// Digits as distances to their strokes on a fixed raster of a digit's cell.
class NumberLibrary {
 public:
  explicit NumberLibrary(const FiducialPattern& pattern);

  static constexpr int columns = 16;  ///< samples across a cell
  static constexpr int rows = 22;     ///< samples along a cell
  static constexpr int samples = columns * rows;
  using Cell = std::array<float, samples>;

  /// The ten digits blurred by `sigma_um`, each with mean 0 and length 1.
  struct Templates {
    std::array<Cell, 10> digit;
  };
  [[nodiscard]] Templates templates(double sigma_um) const;

  [[nodiscard]] double stepX_um() const noexcept { return step_x_um_; }
  [[nodiscard]] double stepY_um() const noexcept { return step_y_um_; }

 private:
  std::array<std::array<float, samples>, 10> distance_um_;
  double half_line_um_ = 0.0;
  double step_x_um_ = 0.0;
  double step_y_um_ = 0.0;
};

/// Correlation (P0 (2)-(4)) of each of the four digit cells with each of the ten digits.
using DigitScores = std::array<std::array<float, 10>, 4>;

/// Affine view of an ellipse: pixel = centre + (ux, uy) X + (vx, vy) Y with X, Y in um of the pattern.
struct LocalFrame {
  double x_px = 0.0;
  double y_px = 0.0;
  Eigen::Vector2d x_axis;  ///< px per um along +X
  Eigen::Vector2d y_axis;  ///< px per um along +Y
  [[nodiscard]] LocalFrame turned() const { return {x_px, y_px, -x_axis, -y_axis}; }
  [[nodiscard]] LocalFrame flipped() const { return {x_px, y_px, x_axis, -y_axis}; }
};

[[nodiscard]] DigitScores readDigits(const GrayImage& image, const FiducialPattern& pattern,
                                     const NumberLibrary& library, const NumberLibrary::Templates& templates,
                                     const LocalFrame& frame);

/// What all ellipses together say about the numbers.
struct NumberVote {
  bool decided = false;
  bool turned = false;  ///< the pattern's X axis points against the lattice's
  bool mirrored = false;
  int row = 0;  ///< of lattice node (0, 0)
  int column = 0;
  double correlation = 0.0;  ///< mean over digits for the winner
  double margin = 0.0;       ///< of its sum over ellipses above the best rival's
};

/// Votes on (row, column, orientation) with the digits of at most `max_nodes` ellipses.
[[nodiscard]] NumberVote voteOnNumbers(const GrayImage& image, const FiducialPattern& pattern,
                                       const NumberLibrary& library, const NumberLibrary::Templates& templates,
                                       const Lattice& lattice, const std::vector<Mark>& marks, int max_nodes);

/// True if the mark carries four digits that read well in some orientation, whatever they are.
[[nodiscard]] bool carriesDigits(const GrayImage& image, const FiducialPattern& pattern, const NumberLibrary& library,
                                 const NumberLibrary::Templates& templates, const Mark& mark, double pixel_length_um,
                                 double tilt_rad);

// ---- map_fit.cpp --------------------------------------------------------------------------------------------------

struct MapPoint {
  Eigen::Vector2d pattern_um;
  Eigen::Vector2d pixel;
  double sigma_px = 1.0;
};

struct MapFit {
  FitStatus status = FitStatus::NotRun;
  PatternMap map;
  double pixel_length_sigma_um = 0.0;
  double tilt_sigma_rad = 0.0;
  double k1_sigma_per_px2 = 0.0;
  double chi2_per_dof = 0.0;
  double rms_px = 0.0;
};

/// Similarity and, where the points determine it, k1; least squares with Huber's weights from `start`.
[[nodiscard]] MapFit fitMap(const std::vector<MapPoint>& points, const PatternMap& start, bool fit_distortion);

// ---- pose_check.cpp -----------------------------------------------------------------------------------------------

/// Empty where the ellipses lie as a straight look from above (`map`) shows them, within what a lens does to them and
/// within their uncertainties (one image in 10,000 is refused by chance at most); else the reason, one sentence.
[[nodiscard]] std::string whyThePoseDoesNotHold(const std::vector<Subpattern>& ellipses, const FiducialPattern& pattern,
                                                const PatternMap& map);

// ---- line_sums.cpp ------------------------------------------------------------------------------------------------

/// A bright line of unit contrast blurred by a Gaussian, at `distance_px` from its middle:
/// Phi((d + h) / sigma) - Phi((d - h) / sigma).
[[nodiscard]] double lineProfile(double distance_px, double half_line_px, double blur_px);

/// Sums over pixels for the regression I - line_ground = b + c T(d) + q T'(d).
struct LineSums {
  float n = 0, t1 = 0, q1 = 0, tt = 0, tq = 0, qq = 0, i1 = 0, it = 0, iq = 0, ii = 0;
};
/// Grey level that is taken off before the sums are made, so that single precision does.
inline constexpr float line_ground = 100.0F;

/// T and T' of a blurred line over |d|, in steps so fine that the nearest is as good as what lies between: half a step
/// moves the edge by 2 nm of a pixel of 1 um.
class LineProfile {
 public:
  static constexpr int cells_per_px = 256;
  struct Cell {
    float level;
    float slope;  ///< 1/px, for d > 0
  };
  LineProfile() = default;
  LineProfile(double half_line_px, double blur_px, double band_px);

  /// Sums over `count` pixels whose distances from the line are `distance_px` - `shift_px`; those beyond the band are
  /// left out. `offset` says where the pixels lie from `origin`.
  [[nodiscard]] LineSums sum(const float* distance_px, const int* offset, int count, float shift_px,
                             const std::uint8_t* origin) const;

  [[nodiscard]] const std::vector<Cell>& cells() const noexcept { return cells_; }

 private:
  std::vector<Cell> cells_;
  float band_px_ = 0.0F;
};

// ---- ring_template.cpp --------------------------------------------------------------------------------------------

/// Result of matching one mark.
struct RingMatch {
  bool found = false;
  double x_px = 0.0;
  double y_px = 0.0;
  Eigen::Matrix2d unit_covariance_px2 = Eigen::Matrix2d::Zero();  ///< for an effective noise of one grey level
  double effective_noise = 0.0;  ///< noise that explains the scatter along the outline, grey levels
  int degrees_of_freedom = 0;    ///< of effective_noise
  double pixel_noise = 0.0;      ///< residual standard deviation of single pixels, grey levels
  double shift_px = 0.0;         ///< from where the match started
  double contrast = 0.0;         ///< grey levels
  double correlation = 0.0;      ///< of the image with the blurred line, 0 ... 1
  double visible = 0.0;          ///< part of the outline that agrees, 0 ... 1
};

/// The pixels around an ellipse's line, in sectors, for one pose; made once per image.
class RingTemplate {
 public:
  static constexpr int sectors = 48;

  /// `frame` at the image's centre, blur including the pixel's own area; about `wanted_pixels` pixels are used.
  RingTemplate(const FiducialPattern& pattern, const GrayImage& image, const LocalFrame& frame, double blur_px,
               int wanted_pixels);

  /// Matches the ellipse at `centre_um` as `map` predicts it, shifted by `shift`. `trusted`: the prediction is better
  /// than any sector, so sectors that contradict it (dust, scratches) are left out from the start.
  [[nodiscard]] RingMatch match(const GrayImage& image, const PatternMap& map, const Eigen::Vector2d& centre_um,
                                const Eigen::Vector2d& shift, bool trusted = false) const;

  /// Blur (px, including the pixel's own area) that explains the mean profile across the lines of the given ellipses
  /// best; 0 if none is usable.
  [[nodiscard]] double estimateBlur(const GrayImage& image, const PatternMap& map,
                                    const std::vector<Eigen::Vector2d>& centres_um,
                                    const std::vector<Eigen::Vector2d>& shifts) const;

 private:
  struct Sector {
    int begin = 0;
    int end = 0;
    int min_x = 1 << 20, max_x = -(1 << 20), min_y = 1 << 20, max_y = -(1 << 20);
    Eigen::Vector2d point_um;  ///< on the middle of the line
    Eigen::Vector2d point_px;  ///< the same in pixels from the centre, as the template was made
    Eigen::Vector2d normal;    ///< outward, pixels
    /// Of the shift along x and y and of the shape (1, cos 2t, sin 2t) on how far out the line lies.
    Eigen::Matrix<double, 5, 1> row;
  };
  [[nodiscard]] bool place(const GrayImage& image, const PatternMap& map, const Eigen::Vector2d& centre_um,
                           const Eigen::Vector2d& shift, int& x0, int& y0, std::array<float, sectors>& offset,
                           std::array<bool, sectors>& inside) const;

  std::vector<int> offset_;
  std::vector<float> distance_px_;
  std::array<Sector, sectors> sector_;
  double half_line_px_ = 0.0;
  double band_px_ = 0.0;
  double blur_px_ = 0.0;
  LineProfile profile_;
  double gradient_bias_ground_ = 0.0;
  double gradient_bias_contrast_ = 0.0;
};

// ---- circle_match.cpp ---------------------------------------------------------------------------------------------

/// T = Phi(-e / sigma) of a blurred edge over the distance e from it, and its slope; the same for all circles.
struct EdgeProfile {
  explicit EdgeProfile(double blur_px);
  static constexpr int cells_per_px = 64;
  struct Cell {
    float level;
    float slope;
  };
  double blur_px;
  double band_px;  ///< table from -band to +band
  std::vector<Cell> cells;
};

/// Matches a filled circle as `map` predicts it, in light that changes by `light_gradient` (relative, per px).
[[nodiscard]] RingMatch matchCircle(const GrayImage& image, const FiducialPattern& pattern, const PatternMap& map,
                                    const Eigen::Vector2d& centre_um, const EdgeProfile& edge,
                                    const Eigen::Vector2d& light_gradient);

// ---- exposure.cpp -------------------------------------------------------------------------------------------------

[[nodiscard]] ExposureStatistics exposureOf(const GrayImage& image);
/// Width of the sharpest edges in the image as the sigma of a Gaussian blur, px. For images in which nothing was found.
[[nodiscard]] double edgeBlur(const GrayImage& image, const ExposureStatistics& exposure);

}  // namespace spindrift::decoding
