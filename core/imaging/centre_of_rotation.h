// SPDX-License-Identifier: Apache-2.0
// The spindle's axis in the image and the place in the fiducial it points at (P0 section 3.1 and (12)-(13)).
//
// Every image of a rotation set is one rigid motion of all its marks (ImagePose). The axis is the pixel q (undistorted,
// about the image's centre) under which all images of a set show the same place s of the fiducial:
//
//   P_j(q) - R(-psi) (c_j - c) = s + e_j,    e_j: repeatability of the spindle, sigma in um per coordinate
//
// with P_j the map from pixel to FCF, c_j the commanded position and psi the direction of FCF in MCF. Linear in q and
// s. With three images turned by 8 degrees q is uncertain by sigma / angle, that is by micrometres. It moves only if
// the camera moves in the spindle, so it is one for all sets (or one per state) as long as an F test does not speak
// against it. Differences of s between states at the same orientations hardly depend on q then.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/imaging/image_pose.h"

namespace spindrift {

struct RotationImage {
  ImagePose pose;
  Eigen::Vector2d offset_um = Eigen::Vector2d::Zero();  ///< R(-psi)(c_j - c): commanded, in FCF; zero if all are at one
  double spindle_deg = 0.0;
  std::vector<MarkPosition> marks;  ///< as measured, for the comparison with the paper's circles; may be empty
};

/// The images of one fiducial in one state; at least three different orientations.
struct RotationSet {
  std::string fiducial;
  std::string state;
  std::vector<RotationImage> images;
};

enum class CentrePooling { All, PerState, PerSet };
[[nodiscard]] std::string_view toString(CentrePooling pooling) noexcept;

struct CentreOptions {
  double expected_repeatability_um = 0.25;  ///< of the spindle per coordinate, from experience ...
  double expected_weight = 2.0;             ///< ... worth that many degrees of freedom
  double test_level = 0.01;                 ///< a centre is pooled unless the F test's p-value is below this
  /// Throws InputError.
  void validate() const;
};

/// Result for one set. px: with distortion, as in the image. um: FCF.
struct SetCentre {
  std::string fiducial;
  std::string state;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();  ///< the one that was used (pooled)
  Eigen::Vector2d centre_sigma_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d own_centre_px = Eigen::Vector2d::Zero();  ///< from this set alone
  double own_centre_sigma_px = 0.0;                         ///< per coordinate
  /// P0 (6)-(9) through the measured tracks of the marks that all images show, for comparison: noise pulls the centre
  /// of such short arcs towards them. Empty without three images or without marks.
  std::optional<Eigen::Vector2d> algebraic_centre_px;
  int algebraic_tracks = 0;
  Eigen::Vector2d place_um = Eigen::Vector2d::Zero();  ///< s: where the axis meets the fiducial
  double place_sigma_um = 0.0;                         ///< per coordinate, with that of the centre
  /// Part of it that is this set's own: repeatability / root of the images. The rest of `CentreResult::covariance`
  /// comes through the centres and has at most two columns for each of them.
  double own_place_sigma_um = 0.0;
  double rms_um = 0.0;  ///< of the images about s, per coordinate
};

struct CentreResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  CentrePooling pooling = CentrePooling::All;
  double p_value_all = 1.0;        ///< of one centre for all against one per state (or per set, with one state)
  double p_value_per_state = 1.0;  ///< of one centre per state against one per set
  double repeatability_um = 0.0;   ///< of the spindle, estimated
  double degrees_of_freedom = 0.0;
  std::vector<SetCentre> sets;
  Eigen::MatrixXd covariance;  ///< of s of all sets (x, y of the first set, ...), um^2
};

/// Throws InternalError if a set has fewer than two images; Degenerate if no set turns.
[[nodiscard]] CentreResult fitCentreOfRotation(const std::vector<RotationSet>& sets, const CentreOptions& options = {});

/// P0 (6)-(9): algebraic circles through the track of every mark that all images show; pixels relative to c,
/// undistorted. `tracks[i][j]`: mark i in image j.
[[nodiscard]] Eigen::Vector2d algebraicCentre(const std::vector<std::vector<Eigen::Vector2d>>& tracks);

}  // namespace spindrift
