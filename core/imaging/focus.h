// SPDX-License-Identifier: Apache-2.0
// Height from contrast: how sharp each image is, and where the peak of sharpness over commanded height lies.
//
// Contrast is P0 (16)-(18): the mean over the image of the squared responses to the x and y derivatives of a Gaussian,
// Nw = 7 px, sigma = Nw / 2.5, window 2 Nw + 1. Light that flickers between shots scales it: each image is normalised
// by its own light, measured as the same contrast at four times the scale, where defocus hardly shows (a stray level
// that is added to the image cancels as well, which it does not when the mean level is used).
//
// Model of all curves of one microscope at once:  1 / n(z) = g_i H(z - p_i),  H(u) = 1 + a2 u^2 + a3 u^3 + a4 u^4,
// with gain g_i and peak height p_i of each set of images (gain and shift fitted together, P0 (19)-(20)) and one shape
// H for all sets. The reciprocal of the contrast is close to a parabola over the depth of focus, so five heights are
// enough. Least squares in ln n: errors of contrast are relative.
//
// Heights in mm, peak heights in um. When the tool goes up by d relative to the table the peak moves by -d.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/imaging/image.h"

namespace spindrift {

/// Sharpness of one image.
struct FocusMeasure {
  double contrast = 0.0;         ///< (18), grey levels squared per pixel squared
  double coarse_contrast = 0.0;  ///< the same at four times the scale
  double mean_level = 0.0;
  double normalised = 0.0;  ///< contrast / coarse_contrast; 0 if the image is empty
};

[[nodiscard]] FocusMeasure measureFocus(const GrayImage& image);

/// Images of one fiducial in one state at several heights.
struct FocusSet {
  std::string name;  ///< for messages: "F1 in state M0"
  std::vector<double> height_mm;
  std::vector<double> normalised;  ///< contrast, > 0
};

struct FocusOptions {
  double expected_noise = 0.003;  ///< relative standard deviation of a contrast, from experience ...
  double expected_weight = 2.0;   ///< ... worth that many degrees of freedom
  /// Throws InputError.
  void validate() const;
};

struct FocusPeak {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  double peak_um = 0.0;  ///< commanded height of the sharpest image; meaningful as a difference between sets
  double sigma_um = 0.0;
  /// Part of it that is this set's own: what would be left if the shape were known. The rest of
  /// `FocusResult::covariance` comes through the shape and has at most as many columns as it has terms.
  double own_sigma_um = 0.0;
  double gain = 0.0;
};

struct FocusResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  std::vector<FocusPeak> peaks;  ///< one per set; Rejected: the peak is not within the heights
  Eigen::MatrixXd covariance;    ///< of the peaks, um^2; zero rows where rejected
  Eigen::VectorXd shape;         ///< a2, a3, a4 per mm^2, mm^3, mm^4
  double relative_noise = 0.0;   ///< of a contrast, as estimated from the residuals
  int degrees_of_freedom = 0;

  /// Normalised contrast of the fitted curve of a set at a height, for pictures.
  [[nodiscard]] double curve(std::size_t set, double height_mm) const;
};

/// Sets need >= 5 different heights and the sharpest image between two others, else they are rejected with a reason.
[[nodiscard]] FocusResult fitFocus(const std::vector<FocusSet>& sets, const FocusOptions& options = {});

}  // namespace spindrift
