// SPDX-License-Identifier: GPL-3.0-or-later
// Against the cameras of Aravis: the fake one in the process, and the one that speaks GigE Vision and loses packets.
#include "core/connect/genicam_camera.h"

#include <arv.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>

#include "core/connect/source.h"
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

 private:
  ArvGvFakeCamera* camera_;
};

TEST(Genicam, IncompleteFramesAreCountedAndNeverGivenOut) {
  const FakeGigeCamera peer("GVS01", 0.005);
  ASSERT_TRUE(peer.running());
  std::unique_ptr<GenicamCamera> camera;
  ASSERT_TRUE(waitUntil([&] {
    try {
      camera = std::make_unique<GenicamCamera>("127.0.0.1");
      return true;
    } catch (const ConnectionError&) {
      return false;
    }
  }));
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

}  // namespace
}  // namespace spindrift::testing
