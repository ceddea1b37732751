// SPDX-License-Identifier: Apache-2.0
// A microscope that never was: renders a fiducial pattern as a camera would see it, with the truth exact to better than
// 0.002 px.
//
// Model: coverage of the artwork (exact distance to every stroke and ellipse line, averaged over the pixel) -> level =
// ground + (mark - ground) * coverage -> things lying about (screws, foreign text, scratches, occlusions) -> Gaussian
// blur of the optics, sigma^2 = blur^2 + (defocus_px_per_um * (z - z_focus))^2 -> dust on the sensor -> illumination ->
// noise -> 8 bit -> JPEG. Frames and pixels as in core/imaging (PatternMap). Everything random comes from one seed.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/imaging/decoder.h"
#include "core/imaging/image.h"
#include "core/imaging/pattern.h"

namespace spindrift {

struct MicroscopeScene {
  int width_px = 1920;
  int height_px = 1080;
  PatternMap map;                   ///< pose, pixel length, distortion, mirrored; its centre must be the image's centre
  double blur_sigma_px = 1.0;       ///< of the optics in focus, without the pixel's own area
  double defocus_um = 0.0;          ///< height from the best focus
  double defocus_px_per_um = 0.02;  ///< blur per height
  double ground_level = 35.0;       ///< grey level of the ground before illumination
  double mark_level = 200.0;        ///< grey level of the marks before illumination
  double illumination_gain = 1.0;   ///< flicker: brightness of this shot
  double gradient_x = 0.0;          ///< illumination changes from 1 - g/2 to 1 + g/2 from the left to the right border
  double gradient_y = 0.0;          ///< the same from top to bottom
  double vignetting = 0.0;          ///< loss of light in the corners, 0 ... 1
  double noise_level = 1.5;         ///< standard deviation of a pixel, grey levels
  int jpeg_quality = 0;             ///< 1 ... 100; 0: not compressed
  int dust = 0;                     ///< specks, 3 ... 20 px, darkening
  int scratches = 0;                ///< lines, 1 ... 3 px wide, bright or dark
  int screws = 0;                   ///< bright discs with a ring and a slot, 40 ... 120 px, beside or over the pattern
  int foreign_texts = 0;            ///< words of digits in other sizes
  int occlusions = 0;               ///< flat patches of 60 ... 200 px that hide the pattern
  std::vector<std::pair<int, int>> damaged_digits;  ///< (row, column) whose digits are overpainted
  std::vector<PatternMap> further_patterns;         ///< the same pattern seen again (for refusals)

  /// Throws InputError.
  void validate() const;
};

/// A map that shows FCF point `pattern_um` at pixel `pixel`, with the distortion about the image's centre.
[[nodiscard]] PatternMap poseAt(int width_px, int height_px, double pixel_length_um, double tilt_rad,
                                const Eigen::Vector2d& pattern_um, const Eigen::Vector2d& pixel, double k1_per_px2 = 0,
                                bool mirrored = false);

[[nodiscard]] GrayImage renderFiducial(const FiducialPattern& pattern, const MicroscopeScene& scene,
                                       std::uint64_t seed);

}  // namespace spindrift
