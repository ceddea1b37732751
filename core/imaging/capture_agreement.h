// SPDX-License-Identifier: Apache-2.0
// Does an image show what was commanded? Every image of one fiducial in one state against the others of it.
//
//   turn   The camera turns with the spindle, so orientation + spindle_deg is one angle for all images of a set
//          (axis_directions.h). Beyond `turn_deg` the spindle did not stand where the list says.
//   place  Under the pixel q where the spindle's axis lies, the fiducial moves as far as the tool: |P_i(q) - P_j(q)| =
//          |c_i - c_j|. Images of one orientation need no q; for others it follows from images that differ in
//          orientation, of all fiducials of the state (P_i(q) = P_j(q) at one commanded position), and the median over
//          the pairs is taken. Distances say nothing of a whole series that is turned or mirrored.
//   focus  Sharpness over height has one peak: an image far less sharp than one below it and one above it, or than
//          another one at the same height, was not taken there.
// All fiducials carry the same pattern, so an image of another one is told by its place and its direction only.
// The tolerances: a spindle set by hand against a mark stands within about 1 deg, and the least turn in use is 8 deg;
// axes come to a place within some 10 um, and the least step in use is 50 um; a place seen under another orientation
// has up to twice the error, because q has it too. Units: deg, mm, um. Nothing is thrown.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/fiducial_captures.h"
#include "core/imaging/image_pose.h"

namespace spindrift {

struct DecodeResult;

/// What was commanded, and what the image shows of it.
struct SeenCapture {
  std::string fiducial;
  std::string state;
  CaptureRole role = CaptureRole::Rotation;
  int index = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double spindle_deg = 0.0;
  std::optional<ImagePose> pose;  ///< none: the pattern could not be decoded
  double sharpness = 0.0;         ///< FocusMeasure::normalised; 0: not measured
};

/// Pose of a decoded image, or none.
[[nodiscard]] std::optional<ImagePose> poseOf(const DecodeResult& decoded, const FiducialPattern& pattern);

struct AgreementOptions {
  double turn_deg = 2.0;                    ///< beyond it the spindle stood elsewhere
  double place_um = 25.0;                   ///< the same for the axes, between images of one orientation
  double turned_place_um = 50.0;            ///< between images of different orientations, and of a focus series
  double same_turn_deg = 0.3;               ///< less is one orientation
  double least_sharpness = 0.6;             ///< part of the sharpness that is expected at least
  std::string commanded = "the plan says";  ///< whose word the image contradicts, for the sentence
};

/// Why an image contradicts what was commanded, one sentence; empty if it does not, or if nothing is there to compare
/// it with. The images of its fiducial and state in `others` decide by majority; one alone is believed.
[[nodiscard]] std::string contradictionOf(const SeenCapture& seen, const std::vector<SeenCapture>& others,
                                          const AgreementOptions& options = {});

/// The same for a whole list, one sentence per capture (most are empty). What contradicts most of the others is set
/// aside first; where two contradict each other and nothing else can tell, the later one.
[[nodiscard]] std::vector<std::string> contradictionsOf(const std::vector<SeenCapture>& captures,
                                                        const AgreementOptions& options = {});

}  // namespace spindrift
