// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/fiducial_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/imaging/image.h"
#include "core/imaging/pattern.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/support/child_process.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

FiducialCapture focusOf(const std::string& image, double time_s) {
  FiducialCapture capture;
  capture.time_s = time_s;
  capture.state = "M0";
  capture.fiducial = "F1";
  capture.role = CaptureRole::Focus;
  capture.image = image;
  return capture;
}

/// A grey image of which the header is there and all pixels are zero, without a byte of them on the disk.
void writeEmptyImage(const std::filesystem::path& file, int width, int height) {
  std::ofstream(file) << "P5\n" << width << " " << height << "\n255\n";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) + static_cast<std::size_t>(width) * height);
}

TEST(FiducialImagesTest, AnImageThatTheMemoryCannotHoldCostsItselfAndNotTheRun) {
  const testing::TempFolder folder;
  GrayImage speckled(320, 240);
  Random random(19);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) speckled.at(x, y) = static_cast<std::uint8_t>(random.index(256));
  folder.write("small.png", encodePng(speckled));
  writeEmptyImage(folder.path() / "large.pgm", 9000, 11000);
  FiducialCaptureList list;
  list.captures = {focusOf("large.pgm", 0.0), focusOf("small.png", 1.0)};
  const std::string answer = testing::inChildProcess([&] {
    if (!testing::limitMemory(240'000'000)) return std::string("no limit");
    const FiducialImages images = measureFiducialImages(folder.path(), list, standardPattern(), JobContext());
    std::string text = images.images[1].usable ? "small is there" : "small is lost";
    for (const RejectedCapture& rejected : images.rejected) text += "; " + rejected.capture + ": " + rejected.reason;
    return text;
  });
  if (answer == "no limit") GTEST_SKIP() << "the sanitizer takes more address space than any limit";
  EXPECT_THAT(answer, AllOf(HasSubstr("small is there"), HasSubstr("large.pgm: "), HasSubstr("memory")));
}

double processor_s(int whose) {
  rusage used{};
  ::getrusage(whose, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

TEST(FiducialImagesTest, AFolderOfImagesIsSharedAmongTheThreads) {
  const testing::TempFolder folder;
  MicroscopeScene scene;
  scene.width_px = 960;
  scene.height_px = 640;
  scene.map = poseAt(scene.width_px, scene.height_px, 1.6, 0.2, {1230, 1310}, {470, 330});
  GrayImage image = renderFiducial(standardPattern(), scene, 7);
  FiducialCaptureList list;
  for (int k = 0; k < 60; ++k) {
    image.at(0, 0) = static_cast<std::uint8_t>(k);  // no two files of the same content
    FiducialCapture capture = focusOf("image_" + std::to_string(k) + ".png", k);
    capture.role = CaptureRole::Rotation;
    folder.write(capture.image, encodePng(image));
    list.captures.push_back(capture);
  }
  // Of the processor's time, so that it does not matter what else the machine does: with four threads the first has its
  // own images and whatever only one can do.
  const std::string answer = testing::inChildProcess([&] {
    ::setenv("SPINDRIFT_THREADS", "4", 1);
    const double own = processor_s(RUSAGE_THREAD), all = processor_s(RUSAGE_SELF);
    const FiducialImages images = measureFiducialImages(folder.path(), list, standardPattern(), JobContext());
    if (!images.rejected.empty()) return images.rejected.front().reason;
    return std::to_string((processor_s(RUSAGE_THREAD) - own) / (processor_s(RUSAGE_SELF) - all));
  });
  double share = 1.0;
  ASSERT_TRUE(parseNumber(answer, share)) << answer;
  EXPECT_LT(share, 0.7);  // 0.25 of work that is shared evenly, 1 of work that is not
}

TEST(ReadImage, OnlyTheFormatsThatAreNamedAreRead) {
  // OpenCV would read these as well, each by a decoder that nobody looks after here.
  for (const std::string& bytes :
       {std::string("Pf\n2 2\n-1\n") + std::string(16, '\0'),
        std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n") + std::string(16, '\1'),
        std::string("\x59\xa6\x6a\x95\0\0\0\2\0\0\0\2\0\0\0\x08\0\0\0\4\0\0\0\1\0\0\0\0"
                    "\0\0\0\0",
                    32) +
            "abcd"}) {
    EXPECT_THAT(testing::refusal([&] { (void)decodeImageBytes(bytes, "a.img"); }),
                HasSubstr("JPEG, PNG, TIFF, BMP or PGM"));
  }
}

TEST(ReadImage, ACutShortPgmIsToldBeforeAnyDecoderSeesIt) {
  const std::string pixels(6, 'a');
  for (const std::string& head : {std::string("P5\n3 2\n255\n"), std::string("P5 3 2 # levels\n255 ")}) {
    EXPECT_EQ(decodeImageBytes(head + pixels, "a.pgm").width(), 3);
    ::testing::internal::CaptureStderr();
    EXPECT_THAT(testing::refusal([&] { (void)decodeImageBytes(head + pixels.substr(1), "a.pgm"); }),
                AllOf(HasSubstr("a.pgm"), HasSubstr("cut short"), HasSubstr("3 x 2")));
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  }
  EXPECT_EQ(decodeImageBytes("P5\n3 2\n65535\n" + pixels + pixels, "a.pgm").height(), 2);
  EXPECT_EQ(decodeImageBytes("P2\n3 2\n9\n1 2 3 4 5 6\n", "a.pgm").height(), 2);
}

TEST(ReadImage, AFileThatIsTooLargeForAnImageIsNotRead) {
  const testing::TempFolder folder;
  const std::filesystem::path file = folder.write("large.png", "\x89PNG\r\n\x1a\n");
  std::filesystem::resize_file(file, 900'000'000);
  const std::string answer = testing::inChildProcess([&] {
    (void)testing::limitMemory(100'000'000);
    return testing::refusal([&] { (void)readImage(file); });
  });
  EXPECT_THAT(answer, AllOf(HasSubstr("large.png"), HasSubstr("900000000"), HasSubstr("800000000")));
}

}  // namespace
}  // namespace spindrift
