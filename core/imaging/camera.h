// SPDX-License-Identifier: Apache-2.0
// A camera as a source of grey images: a device of the computer, a video file, or a network stream.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/imaging/image.h"

namespace spindrift {

class CameraSource {
 public:
  /// "0", "1", ...: device number; anything else: file or address (rtsp://, http://). Throws InputError: cannot be
  /// opened, gives no image.
  [[nodiscard]] static CameraSource open(const std::string& source);
  CameraSource(CameraSource&&) noexcept;
  CameraSource& operator=(CameraSource&&) noexcept;
  ~CameraSource();

  /// The next image; empty at the end of a file or when the camera has gone. Blocks until there is one.
  [[nodiscard]] std::optional<GrayImage> read();
  /// Images a second as the source says; 0 if it does not.
  [[nodiscard]] double framesPerSecond() const;
  /// True for a file: it must be read at its own pace.
  [[nodiscard]] bool isFile() const { return file_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  struct Device;
  CameraSource();
  std::unique_ptr<Device> device_;
  std::string name_;
  bool file_ = false;
};

}  // namespace spindrift
