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

std::unique_ptr<cv::VideoWriter> writer(const std::string& file, double frames_per_second, int width_px,
                                        int height_px) {
  auto out = std::make_unique<cv::VideoWriter>(file, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                                               frames_per_second, cv::Size(width_px, height_px), true);
  return out->isOpened() ? std::move(out) : nullptr;
}

}  // namespace

extern "C" {
extern __attribute__((visibility("default"))) const spindrift::ImageFiles spindrift_image_files;
const spindrift::ImageFiles spindrift_image_files{encode, decode, read, capture, writer};
}
