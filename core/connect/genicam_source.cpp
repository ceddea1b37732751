// SPDX-License-Identifier: Apache-2.0
#include "core/connect/genicam_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/steady_seconds.h"

namespace spindrift {
namespace {

struct Item {
  std::string_view address;
  std::string_view unit;
};
constexpr std::array items{Item{"exposure_us", ""}, Item{"gain", ""},   Item{"width", ""},
                           Item{"height", ""},      Item{"frames", ""}, Item{"incomplete", ""}};

class GenicamSource final : public Source {
 public:
  GenicamSource(std::string camera, GenicamSettings settings)
      : name_(std::move(camera)), settings_(std::move(settings)) {}

  void connect(const std::stop_token&) override {
    camera_ = std::make_unique<GenicamCamera>(name_, settings_);
    next_s_ = 0.0;
  }

  std::vector<DataItem> list(double listen_s, const std::stop_token& stop) override {
    const double until = steadySeconds() + std::min(listen_s, 1.0);
    while (steadySeconds() < until && !stop.stop_requested()) {
      if (settings_.trigger == "Software") camera_->trigger();
      (void)camera_->read(0.1);
    }
    std::vector<DataItem> out;
    for (const Item& item : items)
      out.push_back({std::string(item.address), "", "camera", "sample", "float", std::string(item.unit),
                     fmt::format("{:g}", value(item.address))});
    return out;
  }

  void subscribe(const std::vector<std::string>& wanted, RecordSink& sink, const std::stop_token&) override {
    if (subscribed_) sink.missed("frames that came meanwhile were not counted.");
    subscribed_ = true;
    wanted_ = wanted;
    for (const std::string& each : wanted) {
      if (std::none_of(items.begin(), items.end(), [&](const Item& item) { return item.address == each; }))
        sink.note(
            fmt::format("Camera {} has no item \"{}\"; allowed: exposure_us, gain, width, height, frames and "
                        "incomplete.",
                        name_, each));
    }
  }

  void poll(double wait_s, RecordSink& sink) override {
    (void)camera_->read(wait_s);
    if (steadySeconds() < next_s_) return;
    next_s_ = steadySeconds() + 1.0;
    for (std::uint32_t i = 0; i < wanted_.size(); ++i) {
      Record record;
      record.item = i;
      record.value = value(wanted_[i]);
      if (!std::isfinite(record.value)) record.quality = Quality::Unavailable;
      sink.record(std::move(record));
    }
  }

  void close() noexcept override { camera_.reset(); }

 private:
  [[nodiscard]] double value(std::string_view item) const {
    if (item == "exposure_us") return camera_->exposure_us();
    if (item == "gain") return camera_->gain();
    if (item == "width") return camera_->region().width;
    if (item == "height") return camera_->region().height;
    if (item == "frames") return static_cast<double>(camera_->counts().complete);
    if (item == "incomplete") return static_cast<double>(camera_->counts().incomplete);
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::string name_;
  GenicamSettings settings_;
  std::unique_ptr<GenicamCamera> camera_;
  std::vector<std::string> wanted_;
  bool subscribed_ = false;
  double next_s_ = 0.0;
};

}  // namespace

GenicamSettings readGenicamSettings(const JsonNode& entry) {
  GenicamSettings out;
  if (const auto exposure = entry.find("exposure_us")) out.exposure_us = exposure->positiveNumber();
  if (const auto gain = entry.find("gain")) out.gain = gain->number();
  out.trigger = entry.stringOr("trigger", "");
  if (const auto region = entry.find("region")) {
    std::vector<int> numbers;
    for (const JsonNode& each : region->items()) numbers.push_back(each.integer());
    if (numbers.size() != 4 || numbers[0] < 0 || numbers[1] < 0 || numbers[2] <= 0 || numbers[3] <= 0)
      region->reject("[x, y, width, height] in pixels, width and height greater than zero");
    out.region = PixelRegion{numbers[0], numbers[1], numbers[2], numbers[3]};
  }
  return out;
}

std::unique_ptr<Source> makeGenicamSource(const std::string& camera, const GenicamSettings& settings) {
  return std::make_unique<GenicamSource>(camera, settings);
}

}  // namespace spindrift
