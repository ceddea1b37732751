// SPDX-License-Identifier: Apache-2.0
// The module behind core/imaging/image_files.h.
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "core/imaging/image_files.h"

namespace {

bool encode(const std::string& extension, const cv::Mat& image, std::vector<unsigned char>& bytes,
            const std::vector<int>& parameters) {
  return cv::imencode(extension, image, bytes, parameters);
}

cv::Mat decode(const cv::Mat& bytes, int flags) {
  return cv::imdecode(bytes, flags);
}

cv::Mat read(const std::string& file, int flags) {
  return cv::imread(file, flags);
}

std::unique_ptr<cv::VideoCapture> capture() {
  return std::make_unique<cv::VideoCapture>();
}

}  // namespace

extern "C" {
extern __attribute__((visibility("default"))) const spindrift::ImageFiles spindrift_image_files;
const spindrift::ImageFiles spindrift_image_files{encode, decode, read, capture};
}
