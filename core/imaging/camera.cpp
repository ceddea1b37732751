// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/base/error.h"
#include "core/imaging/image_files.h"

namespace spindrift {

struct CameraSource::Device {
  std::unique_ptr<cv::VideoCapture> capture = imageFiles().capture();
  std::optional<GrayImage> first;  ///< read when it was opened
};

namespace {

std::optional<GrayImage> grab(cv::VideoCapture& capture) {
  cv::Mat frame;
  try {
    if (!capture.read(frame) || frame.empty()) return std::nullopt;
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
  cv::Mat grey = frame;
  if (frame.channels() == 3) cv::cvtColor(frame, grey, cv::COLOR_BGR2GRAY);
  if (frame.channels() == 4) cv::cvtColor(frame, grey, cv::COLOR_BGRA2GRAY);
  if (grey.depth() == CV_16U) grey.convertTo(grey, CV_8U, 1.0 / 256.0);
  if (grey.type() != CV_8UC1) return std::nullopt;
  GrayImage image(grey.cols, grey.rows);
  for (int y = 0; y < grey.rows; ++y) std::copy_n(grey.ptr<std::uint8_t>(y), grey.cols, image.row(y));
  return image;
}

}  // namespace

CameraSource::CameraSource() : device_(std::make_unique<Device>()) {}
CameraSource::CameraSource(CameraSource&&) noexcept = default;
CameraSource& CameraSource::operator=(CameraSource&&) noexcept = default;
CameraSource::~CameraSource() = default;

CameraSource CameraSource::open(const std::string& source) {
  CameraSource camera;
  camera.name_ = source;
  const bool number = !source.empty() && source.size() < 4 &&
                      std::all_of(source.begin(), source.end(), [](char c) { return c >= '0' && c <= '9'; });
  camera.file_ = !number && source.find("://") == std::string::npos;
  if (source.empty() || (camera.file_ && !std::filesystem::is_regular_file(source))) {
    throw InputError(fmt::format(
        "camera \"{}\" is neither a device number nor a video file; allowed: 0, 1, ..., a file, or an address such as "
        "rtsp://host/stream.",
        source));
  }
  bool opened = false;
  try {
    opened = number ? camera.device_->capture->open(std::stoi(source)) : camera.device_->capture->open(source);
  } catch (const cv::Exception&) {
    opened = false;
  }
  if (opened) camera.device_->first = grab(*camera.device_->capture);
  if (!camera.device_->first) {
    throw InputError(
        fmt::format("camera \"{}\" gives no image; is it connected, and does no other program use it?", source));
  }
  return camera;
}

std::optional<GrayImage> CameraSource::read() {
  if (device_->first) {
    std::optional<GrayImage> first = std::move(device_->first);
    device_->first.reset();
    return first;
  }
  return grab(*device_->capture);
}

double CameraSource::framesPerSecond() const {
  const double rate = device_->capture->get(cv::CAP_PROP_FPS);
  return rate > 0.0 && rate < 1000.0 ? rate : 0.0;
}

}  // namespace spindrift
