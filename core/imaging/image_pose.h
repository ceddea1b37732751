// SPDX-License-Identifier: Apache-2.0
// Where one image looks: the similarity between the fiducial (FCF, um) and the image, from all its decoded marks.
//
//   u - c = S diag(1, m) p + t,   S = [a -b; b a] (px/um),   m = -1 (image y down, not mirrored) or +1 (mirrored)
//
// u: pixel after the lens distortion is taken out about the image's centre c (PatternMap), p: FCF um. Scale (P0 (5)),
// angle and translation are free in every image: nothing is assumed of the height at which it was taken.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/error.h"
#include "core/imaging/decoder.h"

namespace spindrift {

/// An ideal position in the fiducial and its place in the image.
struct MarkPosition {
  Eigen::Vector2d pattern_um = Eigen::Vector2d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< as measured, with distortion
  double sigma_px = 0.0;                            ///< per coordinate, > 0
};

/// Ellipses and circles of a decoded image.
[[nodiscard]] std::vector<MarkPosition> markPositions(const DecodeResult& decoded, const FiducialPattern& pattern);

struct ImagePose {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  double a = 0.0, b = 0.0;                              ///< px/um
  Eigen::Vector2d origin_px = Eigen::Vector2d::Zero();  ///< t
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< c
  double k1_per_px2 = 0.0;
  bool mirrored = false;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< of a, b, t
  double rms_px = 0.0;                                   ///< of the residuals per coordinate
  int marks = 0;

  [[nodiscard]] double pixelLength_um() const;
  /// Direction of the pattern's X axis in the image, from image x towards image y.
  [[nodiscard]] double tilt_rad() const;
  /// Angle of FCF as seen from above in the camera: the camera's x to FCF X, counter-clockwise.
  [[nodiscard]] double orientation_rad() const;
  /// Takes the distortion out of a pixel and refers it to c.
  [[nodiscard]] Eigen::Vector2d undistorted(const Eigen::Vector2d& pixel) const;
  /// The reverse.
  [[nodiscard]] Eigen::Vector2d distorted(const Eigen::Vector2d& u_minus_c) const;
  /// FCF position under an undistorted pixel (relative to c), um.
  [[nodiscard]] Eigen::Vector2d patternAt(const Eigen::Vector2d& u_minus_c) const;
  /// Its derivative by the pixel, um/px.
  [[nodiscard]] Eigen::Matrix2d patternPerPixel() const;
  /// Standard uncertainty of patternAt from the marks alone, um per coordinate.
  [[nodiscard]] double patternSigma_um(const Eigen::Vector2d& u_minus_c) const;
};

/// Weighted least squares with the given distortion. Degenerate with fewer than three marks.
[[nodiscard]] ImagePose fitImagePose(const std::vector<MarkPosition>& marks, const Eigen::Vector2d& centre_px,
                                     double k1_per_px2, bool mirrored = false);

}  // namespace spindrift
