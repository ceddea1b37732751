// SPDX-License-Identifier: Apache-2.0
// From the files of a capture list to what is needed of each image: marks or contrast. Images are read, measured and
// dropped one by one on all threads; only a few numbers of each stay in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/imaging/fiducial_captures.h"
#include "core/imaging/focus.h"
#include "core/imaging/image_pose.h"
#include "core/machine/instrument_evaluation.h"

namespace spindrift {

/// What one image gave. Rotation and axis images are decoded, focus images measured for contrast.
struct FiducialImage {
  bool usable = false;
  std::string reason;  ///< why not, one sentence
  int width = 0;
  int height = 0;
  std::string content;  ///< SHA-256 of the file's bytes
  FocusMeasure focus;   ///< role focus only
  std::vector<MarkPosition> marks;
  double k1_per_px2 = 0.0;
  double k1_sigma_per_px2 = 0.0;  ///< infinite if not determined
  bool mirrored = false;
  ImagePose pose;  ///< with the lens distortion pooled over all images
};

struct FiducialImages {
  std::vector<FiducialImage> images;  ///< one per row of the list
  std::vector<RejectedCapture> rejected;
  double k1_per_px2 = 0.0;  ///< pooled lens distortion about the image's centre
  double k1_sigma_per_px2 = 0.0;
  int width = 0;  ///< of the images that were used
  int height = 0;
};

/// Rejects, each with its reason: a file that is missing, no image or cut short, an image of another size than most,
/// the same image twice, an image in which no pattern can be decoded or which is empty.
[[nodiscard]] FiducialImages measureFiducialImages(const std::filesystem::path& folder, const FiducialCaptureList& list,
                                                   const FiducialPattern& pattern, const JobContext& job);

}  // namespace spindrift
