// SPDX-License-Identifier: Apache-2.0
// Finds the numbered ellipses and circles of a fiducial in a microscope image, to a few hundredths of a pixel.
//
// Steps: local threshold and connected marks -> ellipses by size and shape -> square grid -> digits by correlation with
// the number library rendered from the artwork (P0 (2)-(4)) -> one vote of all ellipses on (row, column, orientation),
// so that a damaged digit neither lies nor costs its ellipse -> least-squares match of the artwork, blurred as the
// image is, with local brightness and contrast, at every ellipse and circle (Gauss-Newton; covariance from the noise of
// the image) -> map from the pattern to the image.
//
// Frames: FCF in um (pattern.h), pixels as in image.h. Seen from above rows increase upwards, so an image that is not
// mirrored has x_px = +cos, y_px turned downwards (see PatternMap).
//
// Works for any rotation, pixel lengths of 0.8 ... 2.5 um (the standard pattern; other patterns in proportion to their
// pitch), blur up to 3 px sigma, noise up to 8 grey levels, uneven light. Source: P0 (2)-(5) and matching by least
// squares (Gruen 1985; Foerstner 1982).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/imaging/image.h"
#include "core/imaging/pattern.h"

namespace spindrift {

struct DecodeOptions {
  double min_pixel_length_um = 0.7;  ///< for the standard pitch of 350 um; scaled with the pattern's pitch
  double max_pixel_length_um = 2.8;
  int min_subpatterns = 1;       ///< fewer decoded ellipses: rejected
  bool circles = true;           ///< also locate the filled circles
  bool check_uniqueness = true;  ///< look for a second pattern in view

  /// Throws InputError.
  void validate() const;
};

/// One decoded ellipse with its digits.
struct Subpattern {
  int row = 0;
  int column = 0;
  double x_px = 0.0;  ///< image of the ellipse's centre
  double y_px = 0.0;
  double sigma_px = 0.0;  ///< standard uncertainty per coordinate: sqrt(trace(covariance) / 2)
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  double tilt_rad = 0.0;          ///< direction of the pattern's X axis, from image x towards image y
  double score = 0.0;             ///< correlation of the image with the artwork of this ellipse, 0 ... 1
  double digit_confidence = 0.0;  ///< correlation of the worst digit minus that of its best rival, -1 ... 1
  bool from_neighbours = false;   ///< true: its own digits could not be read for certain, the grid numbered it
  double residual_x_px = 0.0;     ///< measured minus map
  double residual_y_px = 0.0;
};

/// One located circle (i along the pattern's X, j along Y).
struct CircleMark {
  int i = 0;
  int j = 0;
  double x_px = 0.0;
  double y_px = 0.0;
  double sigma_px = 0.0;
  double score = 0.0;
};

/// Pattern to image: u = c + similarity of the pattern point (um -> px), then x = c + (1 + k1 |u - c|^2) (u - c) with c
/// the image's centre ((width-1)/2, (height-1)/2).
///     u - c = (1/pixel_length) * R(tilt) * diag(1, m) * (X, Y) + origin,   m = -1 (not mirrored) or +1 (mirrored)
/// R(tilt) turns image x towards image y.
struct PatternMap {
  double pixel_length_um = 0.0;  ///< at the image's centre
  double tilt_rad = 0.0;         ///< direction of the pattern's X axis, (-pi, pi]
  double origin_x_px = 0.0;      ///< image of the FCF origin minus c, before distortion
  double origin_y_px = 0.0;
  double k1_per_px2 = 0.0;
  bool mirrored = false;
  double centre_x_px = 0.0;  ///< c
  double centre_y_px = 0.0;

  [[nodiscard]] Eigen::Vector2d imageOf(const Eigen::Vector2d& pattern_um) const;
  [[nodiscard]] Eigen::Vector2d patternOf(const Eigen::Vector2d& pixel) const;
  /// Takes the lens distortion out of a pixel position (u of the equation above).
  [[nodiscard]] Eigen::Vector2d undistorted(const Eigen::Vector2d& pixel) const;
};

/// What the exposure looks like, whatever was found.
struct ExposureStatistics {
  double dark_level = 0.0;    ///< 5 % quantile of the grey levels
  double bright_level = 0.0;  ///< 99.5 % quantile
  double mean_level = 0.0;
  double saturated_fraction = 0.0;  ///< pixels at 255
  double noise_level = 0.0;         ///< standard deviation of single pixels on flat ground, grey levels
  double blur_sigma_px = 0.0;       ///< of the edges of the pattern; 0 if no pattern was matched
  double contrast = 0.0;            ///< mean step from ground to mark, grey levels; 0 if no pattern was matched
};

/// Result of decoding one image. `status` Converged: subpatterns may be used. Rejected: `message` says in one sentence
/// why (black, white, blurred, no pattern, another pattern, two patterns, mirrored numbers); lists may then hold what
/// was seen.
struct DecodeResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  std::vector<Subpattern> subpatterns;  ///< by row, then column; only ellipses wholly in view
  std::vector<CircleMark> circles;      ///< by j, then i
  PatternMap map;
  double pixel_length_sigma_um = 0.0;
  double tilt_sigma_rad = 0.0;
  double k1_sigma_per_px2 = 0.0;  ///< infinite if the ellipses do not determine the distortion (k1 is then 0)
  double map_rms_px = 0.0;        ///< rms distance of measured centres from the map, per coordinate
  double map_chi2_per_dof = 0.0;  ///< of the same, over the stated uncertainties
  bool several_patterns = false;
  ExposureStatistics exposure;
  double elapsed_ms = 0.0;

  [[nodiscard]] bool usable() const noexcept { return status == FitStatus::Converged; }
  /// The decoded ellipse with this number, or null.
  [[nodiscard]] const Subpattern* find(int row, int column) const noexcept;
};

/// Decodes one image on the calling thread; thread-safe. Never throws for what is in the image.
[[nodiscard]] DecodeResult decodeImage(const GrayImage& image, const FiducialPattern& pattern,
                                       const DecodeOptions& options = {});

/// The image with what was decoded drawn over it: ellipses green (yellow: numbered by their neighbours), circles blue,
/// numbers, the pattern's axes.
[[nodiscard]] ColourImage decodeOverlay(const GrayImage& image, const FiducialPattern& pattern,
                                        const DecodeResult& result);

}  // namespace spindrift
