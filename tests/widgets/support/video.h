// SPDX-License-Identifier: GPL-3.0-or-later
// A camera for tests: a file of the pictures it sees.
#pragma once

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/imaging/image.h"

namespace spindrift {

/// Images of one size as a video (Motion-JPEG in AVI). Throws InputError.
inline void writeVideo(const std::string& file, const std::vector<GrayImage>& images, double frames_per_second) {
  if (images.empty()) throw InputError({file, ""}, "cannot be written: no images.");
  const cv::Size size(images.front().width(), images.front().height());
  cv::VideoWriter writer;
  try {
    (void)writer.open(file, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), frames_per_second, size);
  } catch (const cv::Exception&) {
    throw InputError({file, ""}, "cannot be written as a video.");
  }
  if (!writer.isOpened()) throw InputError({file, ""}, "cannot be written as a video; allowed: a name ending in .avi.");
  for (const GrayImage& image : images) {
    if (image.width() != size.width || image.height() != size.height) {
      throw InputError({file, ""}, "cannot be written: the images differ in size.");
    }
    const cv::Mat grey(size, CV_8UC1, const_cast<std::uint8_t*>(image.data()));
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
    writer.write(colour);
  }
}

}  // namespace spindrift
