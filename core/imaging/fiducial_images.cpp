// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/fiducial_images.h"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <new>

#include "core/base/atomic_file.h"
#include "core/base/sha256.h"

namespace spindrift {
namespace {

FiducialImage measureOne(const std::filesystem::path& folder, const FiducialCapture& capture,
                         const FiducialPattern& pattern) {
  FiducialImage result;
  const std::filesystem::path file = folder / capture.image;
  GrayImage image;
  try {
    if (!std::filesystem::exists(file)) {
      result.reason = "the file is not there.";
      return result;
    }
    const std::string bytes = readFile(file, largest_image_file);
    result.content = sha256(bytes);
    image = decodeImageBytes(bytes, capture.image);
  } catch (const InputError& error) {
    result.reason = error.what();
    return result;
  }
  result.width = image.width();
  result.height = image.height();
  if (capture.role == CaptureRole::Focus) {
    result.focus = measureFocus(image);
    result.usable = result.focus.normalised > 0.0;
    if (!result.usable) {
      result.reason =
          fmt::format("nothing is to be seen in the image (mean level {:.0f} of 255).", result.focus.mean_level);
    }
    return result;
  }
  const DecodeResult decoded = decodeImage(image, pattern);
  if (!decoded.usable()) {
    result.reason = decoded.message;
    return result;
  }
  result.marks = markPositions(decoded, pattern);
  result.k1_per_px2 = decoded.map.k1_per_px2;
  result.k1_sigma_per_px2 = decoded.k1_sigma_per_px2;
  result.mirrored = decoded.map.mirrored;
  result.usable = result.marks.size() >= 3;
  if (!result.usable) result.reason = "fewer than three marks of the pattern could be located.";
  return result;
}

/// One file listed twice is allowed if it stands for the same moment in two roles.
bool sameMoment(const FiducialCapture& a, const FiducialCapture& b) {
  return a.image == b.image && a.state == b.state && a.fiducial == b.fiducial && a.role != b.role &&
         a.position_mm == b.position_mm && a.spindle_deg == b.spindle_deg;
}

void rejectOddSizes(FiducialImages& result) {
  std::map<std::pair<int, int>, int> sizes;
  for (const FiducialImage& image : result.images) {
    if (image.width > 0) ++sizes[{image.width, image.height}];
  }
  int most = 0;
  for (const auto& [size, count] : sizes) {
    if (count > most) {
      most = count;
      result.width = size.first;
      result.height = size.second;
    }
  }
  for (FiducialImage& image : result.images) {
    if (image.width == 0 || (image.width == result.width && image.height == result.height)) continue;
    image.usable = false;
    image.reason = fmt::format("the image has {} x {} pixels, the others {} x {}.", image.width, image.height,
                               result.width, result.height);
  }
}

void rejectRepeated(FiducialImages& result, const FiducialCaptureList& list) {
  std::map<std::string, std::size_t> seen;
  for (std::size_t i = 0; i < result.images.size(); ++i) {
    FiducialImage& image = result.images[i];
    if (image.width == 0) continue;
    const auto [first, unique] = seen.try_emplace(image.content, i);
    if (unique || sameMoment(list.captures[first->second], list.captures[i])) continue;
    image.usable = false;
    image.reason = fmt::format("the image is the same as {}.", list.captures[first->second].image);
  }
}

/// Weighted mean of the lens distortion of all images, widened if they scatter more than they should.
void poolDistortion(FiducialImages& result) {
  double weights = 0.0;
  double sum = 0.0;
  int count = 0;
  for (const FiducialImage& image : result.images) {
    if (!image.usable || image.marks.empty() || !(image.k1_sigma_per_px2 > 0.0) ||
        !std::isfinite(image.k1_sigma_per_px2)) {
      continue;
    }
    const double w = 1.0 / (image.k1_sigma_per_px2 * image.k1_sigma_per_px2);
    weights += w;
    sum += w * image.k1_per_px2;
    ++count;
  }
  if (count == 0) return;
  result.k1_per_px2 = sum / weights;
  double chi2 = 0.0;
  for (const FiducialImage& image : result.images) {
    if (!image.usable || image.marks.empty() || !(image.k1_sigma_per_px2 > 0.0) ||
        !std::isfinite(image.k1_sigma_per_px2)) {
      continue;
    }
    chi2 += std::pow((image.k1_per_px2 - result.k1_per_px2) / image.k1_sigma_per_px2, 2);
  }
  const double excess = count > 1 ? std::max(1.0, chi2 / (count - 1)) : 1.0;
  result.k1_sigma_per_px2 = std::sqrt(excess / weights);
}

}  // namespace

FiducialImages measureFiducialImages(const std::filesystem::path& folder, const FiducialCaptureList& list,
                                     const FiducialPattern& pattern, const JobContext& job) {
  FiducialImages result;
  result.images.resize(list.captures.size());
  std::atomic<std::size_t> done{0};
  parallelFor(list.captures.size(), job, [&](std::size_t i) {
    try {
      result.images[i] = measureOne(folder, list.captures[i], pattern);
    } catch (const std::bad_alloc&) {
      // One image too many or too large is no reason to lose the others.
      result.images[i] = FiducialImage();
      result.images[i].reason = "there is not enough memory for the image.";
    }
    const std::size_t finished = done.fetch_add(1) + 1;
    job.report(static_cast<double>(finished) / static_cast<double>(list.captures.size()), "measuring images");
  });
  rejectOddSizes(result);
  rejectRepeated(result, list);
  poolDistortion(result);
  const Eigen::Vector2d centre(0.5 * (result.width - 1), 0.5 * (result.height - 1));
  parallelFor(result.images.size(), job, [&](std::size_t i) {
    FiducialImage& image = result.images[i];
    if (image.usable && list.captures[i].role != CaptureRole::Focus) {
      image.pose = fitImagePose(image.marks, centre, result.k1_per_px2, image.mirrored);
      if (image.pose.status != FitStatus::Converged) {
        image.usable = false;
        image.reason = fmt::format("the marks do not fix the place of the image: {}.", image.pose.message);
      }
    }
    image.marks.clear();
    image.marks.shrink_to_fit();
  });
  for (std::size_t i = 0; i < result.images.size(); ++i) {
    if (!result.images[i].usable) result.rejected.push_back({list.captures[i].image, result.images[i].reason});
  }
  return result;
}

}  // namespace spindrift
