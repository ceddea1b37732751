// SPDX-License-Identifier: Apache-2.0
// OpenCV's readers and writers of image files and readers of videos, loaded when the first of them is used.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace cv {
class Mat;
class VideoCapture;
}  // namespace cv

namespace spindrift {

/// What the module exports. Flags and parameters are those of OpenCV, and so are the exceptions.
struct ImageFiles {
  bool (*encode)(const std::string& extension, const cv::Mat& image, std::vector<unsigned char>& bytes,
                 const std::vector<int>& parameters);
  /// Empty where the bytes (one row of CV_8UC1) are no image.
  cv::Mat (*decode)(const cv::Mat& bytes, int flags);
  cv::Mat (*read)(const std::string& file, int flags);
  std::unique_ptr<cv::VideoCapture> (*capture)();
};

/// InputError where the installation lacks it.
[[nodiscard]] const ImageFiles& imageFiles();

}  // namespace spindrift
