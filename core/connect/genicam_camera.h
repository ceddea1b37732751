// SPDX-License-Identifier: Apache-2.0
// Cameras by GenICam (GigE Vision, USB3 Vision) through Aravis, beside the sources of core/imaging/camera.h.
//
// Frames of which packets are missing are counted and never given out: a fiducial in half a frame would be measured
// wrong. The packet socket of Aravis is off unless asked for: it needs rights and delivers nothing on loopback.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/image.h"

namespace spindrift {

struct GenicamDescription {
  std::string id;  ///< as GenicamCamera is made with
  std::string vendor;
  std::string model;
  std::string serial;
  std::string address;
  std::string protocol;  ///< "GigEVision", "USB3Vision", "Fake"
};

/// Cameras that answer on the networks of this computer: asks all of them, so only when the user wishes it.
[[nodiscard]] std::vector<GenicamDescription> listGenicamCameras();
/// Makes the camera "Fake_1" of Aravis known, for trials and tests.
void enableFakeCamera();

struct PixelRegion {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

struct GenicamSettings {
  std::optional<double> exposure_us;
  std::optional<double> gain;  ///< in the unit of the camera, mostly dB
  std::optional<PixelRegion> region;
  std::string trigger;  ///< empty: frames as they come; "Software", "Line1", ...
  bool packet_socket = false;
};

struct FrameCounts {
  std::uint64_t complete = 0;
  std::uint64_t incomplete = 0;  ///< packets were missing: not given out
};

class GenicamCamera {
 public:
  /// `name`: id, address or empty for the first there is. Starts at once. Throws ConnectionError: no such camera, a
  /// setting that it refuses (with the range it allows), a pixel format that is not grey.
  explicit GenicamCamera(const std::string& name, const GenicamSettings& settings = {});
  ~GenicamCamera();
  GenicamCamera(const GenicamCamera&) = delete;
  GenicamCamera& operator=(const GenicamCamera&) = delete;

  /// The next complete frame; nothing if none comes within `patience_s`.
  [[nodiscard]] std::optional<GrayImage> read(double patience_s);
  /// Takes one frame now; trigger "Software" only. Throws ConnectionError.
  void trigger();
  [[nodiscard]] FrameCounts counts() const;
  [[nodiscard]] double exposure_us() const;
  [[nodiscard]] double gain() const;
  [[nodiscard]] PixelRegion region() const;

 private:
  struct Device;
  std::unique_ptr<Device> device_;
};

}  // namespace spindrift
