// SPDX-License-Identifier: Apache-2.0
#include "core/connect/genicam_camera.h"

#include <arv.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>

#include "core/connect/source.h"

namespace spindrift {
namespace {

constexpr int buffers = 8;

std::string textOf(const char* text) {
  return text == nullptr ? std::string() : std::string(text);
}

/// Throws what Aravis says; `what`: "exposure 5 us".
class Fault {
 public:
  explicit Fault(std::string camera) : camera_(std::move(camera)) {}
  ~Fault() { g_clear_error(&error_); }
  Fault(const Fault&) = delete;
  Fault& operator=(const Fault&) = delete;
  GError** operator&() { return &error_; }
  void check(const std::string& what) {
    if (error_ == nullptr) return;
    const std::string reason = error_->message;
    g_clear_error(&error_);
    throw ConnectionError(fmt::format("Camera {}: {}: {}.", camera_, what, reason));
  }

 private:
  std::string camera_;
  GError* error_ = nullptr;
};

/// Grey levels of 8 bits; nothing for a format that is not grey.
std::optional<GrayImage> imageOf(ArvBuffer* buffer) {
  const int width = arv_buffer_get_image_width(buffer);
  const int height = arv_buffer_get_image_height(buffer);
  const ArvPixelFormat format = arv_buffer_get_image_pixel_format(buffer);
  const int bits = format == ARV_PIXEL_FORMAT_MONO_8    ? 8
                   : format == ARV_PIXEL_FORMAT_MONO_10 ? 10
                   : format == ARV_PIXEL_FORMAT_MONO_12 ? 12
                   : format == ARV_PIXEL_FORMAT_MONO_14 ? 14
                   : format == ARV_PIXEL_FORMAT_MONO_16 ? 16
                                                        : 0;
  std::size_t size = 0;
  const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_image_data(buffer, &size));
  const std::size_t pixels =
      static_cast<std::size_t>(std::max(0, width)) * static_cast<std::size_t>(std::max(0, height));
  if (bits == 0 || pixels == 0 || data == nullptr || size < pixels * (bits == 8 ? 1 : 2)) return std::nullopt;
  GrayImage image(width, height);
  if (bits == 8) {
    std::memcpy(image.data(), data, pixels);
    return image;
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    const int level = data[2 * i] | (data[2 * i + 1] << 8);
    image.data()[i] = static_cast<std::uint8_t>(std::min(255, level >> (bits - 8)));
  }
  return image;
}

}  // namespace

std::vector<GenicamDescription> listGenicamCameras() {
  arv_update_device_list();
  std::vector<GenicamDescription> out;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    out.push_back({textOf(arv_get_device_id(i)), textOf(arv_get_device_vendor(i)), textOf(arv_get_device_model(i)),
                   textOf(arv_get_device_serial_nbr(i)), textOf(arv_get_device_address(i)),
                   textOf(arv_get_device_protocol(i))});
  }
  return out;
}

void enableFakeCamera() {
  arv_enable_interface("Fake");
}

struct GenicamCamera::Device {
  std::string name;
  ArvCamera* camera = nullptr;
  ArvStream* stream = nullptr;
  FrameCounts counts;

  ~Device() {
    if (camera != nullptr && stream != nullptr) arv_camera_stop_acquisition(camera, nullptr);
    g_clear_object(&stream);
    g_clear_object(&camera);
  }

  void apply(const GenicamSettings& settings) {
    Fault fault(name);
    arv_camera_clear_triggers(camera, nullptr);
    arv_camera_set_acquisition_mode(camera, ARV_ACQUISITION_MODE_CONTINUOUS, nullptr);
    if (arv_camera_is_gv_device(camera) && !settings.packet_socket)
      arv_camera_gv_set_stream_options(camera, ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
    if (settings.region) {
      const PixelRegion& r = *settings.region;
      arv_camera_set_region(camera, r.x, r.y, r.width, r.height, &fault);
      fault.check(fmt::format("region {},{} {} x {}", r.x, r.y, r.width, r.height));
    }
    const auto within = [&](double value, double least, double most, const char* what) {
      if (value < least || value > most)
        throw ConnectionError(
            fmt::format("Camera {}: {} {:g} is not possible; allowed: {:g} to {:g}.", name, what, value, least, most));
    };
    double least = 0.0, most = 0.0;
    if (settings.exposure_us) {
      arv_camera_set_exposure_time_auto(camera, ARV_AUTO_OFF, nullptr);
      arv_camera_get_exposure_time_bounds(camera, &least, &most, &fault);
      fault.check("exposure");
      within(*settings.exposure_us, least, most, "an exposure in µs of");
      arv_camera_set_exposure_time(camera, *settings.exposure_us, &fault);
      fault.check(fmt::format("exposure {:g} µs", *settings.exposure_us));
    }
    if (settings.gain) {
      arv_camera_set_gain_auto(camera, ARV_AUTO_OFF, nullptr);
      arv_camera_get_gain_bounds(camera, &least, &most, &fault);
      fault.check("gain");
      within(*settings.gain, least, most, "a gain of");
      arv_camera_set_gain(camera, *settings.gain, &fault);
      fault.check(fmt::format("gain {:g}", *settings.gain));
    }
    if (!settings.trigger.empty()) {
      arv_camera_set_trigger(camera, settings.trigger.c_str(), &fault);
      fault.check(fmt::format("trigger {}", settings.trigger));
    }
  }

  /// A GigE camera sends a frame as one burst of packets: while the reader has no processor, the kernel must hold them.
  /// Linux counts a packet of 1.5 kB as 2.3 kB, and gives no more than net.core.rmem_max allows.
  void holdFrames(unsigned payload_bytes) {
    if (!ARV_IS_GV_STREAM(stream)) return;
    constexpr double held_frames = 4.0, largest_bytes = 256.0e6;
    g_object_set(stream, "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED, "socket-buffer-size",
                 static_cast<gint>(std::min(held_frames * payload_bytes, largest_bytes)), nullptr);
  }

  void start() {
    Fault fault(name);
    stream = arv_camera_create_stream(camera, nullptr, nullptr, &fault);
    fault.check("its stream");
    if (stream == nullptr) throw ConnectionError(fmt::format("Camera {} gives no stream.", name));
    const unsigned size = arv_camera_get_payload(camera, &fault);
    fault.check("the size of a frame");
    holdFrames(size);
    for (int i = 0; i < buffers; ++i) arv_stream_push_buffer(stream, arv_buffer_new(size, nullptr));
    arv_camera_start_acquisition(camera, &fault);
    fault.check("start");
  }
};

GenicamCamera::GenicamCamera(const std::string& name, const GenicamSettings& settings)
    : device_(std::make_unique<Device>()) {
  device_->name = name.empty() ? "(the first)" : name;
  Fault fault(device_->name);
  device_->camera = arv_camera_new(name.empty() ? nullptr : name.c_str(), &fault);
  fault.check("cannot be opened");
  if (device_->camera == nullptr) throw ConnectionError(fmt::format("Camera {} is not there.", device_->name));
  device_->apply(settings);
  device_->start();
}

GenicamCamera::~GenicamCamera() = default;

std::optional<GrayImage> GenicamCamera::read(double patience_s) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (true) {
    const double left = std::chrono::duration<double>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0.0) return std::nullopt;
    ArvBuffer* buffer = arv_stream_timeout_pop_buffer(device_->stream, static_cast<guint64>(left * 1e6));
    if (buffer == nullptr) return std::nullopt;
    const bool complete = arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS;
    std::optional<GrayImage> image;
    if (complete) image = imageOf(buffer);
    arv_stream_push_buffer(device_->stream, buffer);
    ++(complete ? device_->counts.complete : device_->counts.incomplete);
    if (complete && !image)
      throw ConnectionError(
          fmt::format("Camera {} sends no grey frames of 8 to 16 bits; set its pixel format to Mono8.", device_->name));
    if (image) return image;
  }
}

void GenicamCamera::trigger() {
  Fault fault(device_->name);
  arv_camera_software_trigger(device_->camera, &fault);
  fault.check("software trigger");
}

FrameCounts GenicamCamera::counts() const {
  return device_->counts;
}

double GenicamCamera::exposure_us() const {
  return arv_camera_get_exposure_time(device_->camera, nullptr);
}

double GenicamCamera::gain() const {
  return arv_camera_get_gain(device_->camera, nullptr);
}

PixelRegion GenicamCamera::region() const {
  PixelRegion r;
  arv_camera_get_region(device_->camera, &r.x, &r.y, &r.width, &r.height, nullptr);
  return r;
}

}  // namespace spindrift
