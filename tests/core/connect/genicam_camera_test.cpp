// SPDX-License-Identifier: GPL-3.0-or-later
// Against the cameras of Aravis: the fake one in the process, and the one that speaks GigE Vision and loses packets.
#include "core/connect/genicam_camera.h"

#include <arv.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/connect/source.h"
#include "core/imaging/artwork.h"
#include "core/imaging/decoder.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/core/connect/collected.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

std::string refusalOf(const GenicamSettings& settings, const std::string& name = "Fake_1") {
  try {
    GenicamCamera camera(name, settings);
  } catch (const ConnectionError& error) {
    return error.what();
  }
  return "";
}

TEST(Genicam, SettingsAreAppliedAndFramesComplete) {
  enableFakeCamera();
  bool found = false;
  for (const GenicamDescription& each : listGenicamCameras()) found = found || each.id == "Fake_1";
  EXPECT_TRUE(found);
  GenicamSettings settings;
  settings.exposure_us = 500.0;
  settings.gain = 1.0;
  settings.region = PixelRegion{0, 0, 256, 128};
  GenicamCamera camera("Fake_1", settings);
  EXPECT_NEAR(camera.exposure_us(), 500.0, 1.0);
  EXPECT_NEAR(camera.gain(), 1.0, 0.1);
  for (int i = 0; i < 5; ++i) {
    const auto image = camera.read(3.0);
    ASSERT_TRUE(image.has_value());
    EXPECT_EQ(image->width(), 256);
    EXPECT_EQ(image->height(), 128);
    EXPECT_NE(image->at(0, 0), image->at(100, 0));  // a ramp
  }
  EXPECT_EQ(camera.counts().complete, 5U);
  EXPECT_EQ(camera.counts().incomplete, 0U);
}

TEST(Genicam, WhatIsNotPossibleIsSaid) {
  enableFakeCamera();
  GenicamSettings settings;
  settings.exposure_us = 1e12;
  EXPECT_THAT(refusalOf(settings), ::testing::AllOf(HasSubstr("Fake_1"), HasSubstr("1e+12"), HasSubstr("allowed")));
  EXPECT_THAT(refusalOf({}, "no-such-camera"), HasSubstr("no-such-camera"));
}

/// Aravis' GigE Vision camera on loopback (its port is that of the standard), which loses a part of the packets.
class FakeGigeCamera {
 public:
  FakeGigeCamera(const char* serial, double lost) : camera_(arv_gv_fake_camera_new("127.0.0.1", serial)) {
    g_object_set(camera_, "gvsp-lost-ratio", lost, nullptr);
  }
  ~FakeGigeCamera() { g_object_unref(camera_); }
  FakeGigeCamera(const FakeGigeCamera&) = delete;
  FakeGigeCamera& operator=(const FakeGigeCamera&) = delete;
  [[nodiscard]] bool running() const { return arv_gv_fake_camera_is_running(camera_) != 0; }
  /// Every frame shows this picture, which has the size of the camera's frames, from now on.
  void show(GrayImage picture) {
    picture_ = std::move(picture);
    arv_fake_camera_set_fill_pattern(
        arv_gv_fake_camera_get_fake_camera(camera_),
        [](ArvBuffer* buffer, void* self, guint32, guint32, ArvPixelFormat) {
          const GrayImage& shown = static_cast<FakeGigeCamera*>(self)->picture_;
          // What is told as the size is what the last frame sent; the memory is that of the payload.
          std::size_t told = 0;
          const void* data = arv_buffer_get_data(buffer, &told);
          const std::size_t payload = arv_fake_camera_get_payload(
              arv_gv_fake_camera_get_fake_camera(static_cast<FakeGigeCamera*>(self)->camera_));
          const auto pixels = static_cast<std::size_t>(shown.width()) * static_cast<std::size_t>(shown.height());
          std::memcpy(const_cast<void*>(data), shown.data(), std::min(payload, pixels));
        },
        this);
  }

 private:
  ArvGvFakeCamera* camera_;
  GrayImage picture_;
};

std::unique_ptr<GenicamCamera> connectedTo(const std::string& name) {
  std::unique_ptr<GenicamCamera> camera;
  (void)waitUntil([&] {
    try {
      camera = std::make_unique<GenicamCamera>(name);
      return true;
    } catch (const ConnectionError&) {
      return false;
    }
  });
  return camera;
}

TEST(Genicam, IncompleteFramesAreCountedAndNeverGivenOut) {
  const FakeGigeCamera peer("GVS01", 0.005);
  ASSERT_TRUE(peer.running());
  const std::unique_ptr<GenicamCamera> camera = connectedTo("127.0.0.1");
  ASSERT_NE(camera, nullptr);
  std::uint64_t given = 0;
  ASSERT_TRUE(waitUntil(
      [&] {
        const auto image = camera->read(0.5);
        if (image) {
          ++given;
          EXPECT_EQ(image->width(), camera->region().width);
          // A lost packet would leave a stretch of zeros in the ramp.
          int longest = 0, zeros = 0;
          for (int i = 0; i < image->width() * image->height(); ++i) {
            zeros = image->data()[i] == 0 ? zeros + 1 : 0;
            longest = std::max(longest, zeros);
          }
          EXPECT_LT(longest, 100);
        }
        return camera->counts().incomplete >= 3;
      },
      30.0));
  EXPECT_EQ(given, camera->counts().complete);
}

TEST(Genicam, FiducialsAreDecodedFromWholeFramesWhilePacketsAreLost) {
  constexpr int width = 512, height = 512;
  MicroscopeScene scene;
  scene.width_px = width;
  scene.height_px = height;
  scene.map = poseAt(width, height, 2.2, 0.4, {1230, 1310}, {256, 256});
  const GrayImage picture = renderFiducial(standardPattern(), scene, 7);
  const DecodeResult expected = decodeImage(picture, standardPattern());
  ASSERT_TRUE(expected.usable()) << expected.message;
  FakeGigeCamera peer("GVS02", 0.005);
  ASSERT_TRUE(peer.running());
  peer.show(picture);
  const std::unique_ptr<GenicamCamera> camera = connectedTo("127.0.0.1");
  ASSERT_NE(camera, nullptr);
  ASSERT_EQ(camera->region().width, width);
  ASSERT_EQ(camera->region().height, height);
  int decoded = 0;
  ASSERT_TRUE(waitUntil(
      [&] {
        if (const auto image = camera->read(0.5)) {
          const DecodeResult seen = decodeImage(*image, standardPattern());
          EXPECT_TRUE(seen.usable()) << seen.message;
          EXPECT_EQ(seen.subpatterns.size(), expected.subpatterns.size());
          EXPECT_NEAR(seen.map.tilt_rad, scene.map.tilt_rad, 1e-3);
          ++decoded;
        }
        return camera->counts().incomplete >= 3 && decoded >= 5;
      },
      40.0))
      << decoded << " decoded, " << camera->counts().incomplete << " incomplete";
  EXPECT_EQ(static_cast<std::uint64_t>(decoded), camera->counts().complete);
}

}  // namespace
}  // namespace spindrift::testing
