// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/base/error.h"
#include "core/imaging/artwork.h"
#include "core/imaging/image.h"

namespace spindrift {
namespace {

std::string sentenceOf(const std::string& json) {
  try {
    (void)parsePattern(json, "own.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(Pattern, StandardIsTheOneOfTheContract) {
  const FiducialPattern& p = standardPattern();
  EXPECT_EQ(p.rowCount(), 9);
  EXPECT_EQ(p.columnCount(), 9);
  EXPECT_EQ(p.ellipseCentre(11, 11), Eigen::Vector2d(0, 0));
  EXPECT_EQ(p.ellipseCentre(12, 14), Eigen::Vector2d(1050, 350));
  EXPECT_EQ(p.circleCentre(-1, 8), Eigen::Vector2d(-175, 2975));
  EXPECT_EQ(p.last_circle_column, 8);
}

TEST(Pattern, WritesWhatItReads) {
  const FiducialPattern again = parsePattern(patternJson(standardPattern()), "copy.json");
  EXPECT_EQ(patternJson(again), patternJson(standardPattern()));
}

TEST(Pattern, RefusesWithFileAndPlace) {
  const std::string good = patternJson(standardPattern());
  EXPECT_NE(sentenceOf(replaced(good, "\"version\": 1", "\"version\": 2")).find("version"), std::string::npos);
  EXPECT_NE(sentenceOf(replaced(good, "\"pitch\": 350.0", "\"pitch\": -3")).find("$.pitch"), std::string::npos);
  EXPECT_NE(sentenceOf(replaced(good, "\"pitch\": 350.0", "\"pitch\": 300.0")).find("touch"), std::string::npos);
  EXPECT_NE(sentenceOf(replaced(good, "\"offset_y\": 45.0", "\"offset_y\": 90.0")).find("leaves its ellipse"),
            std::string::npos);
  EXPECT_NE(sentenceOf("{}").find("own.json"), std::string::npos);
}

TEST(Artwork, DrawsEveryMark) {
  ArtworkOptions options;
  options.rows = 3;
  options.columns = 4;
  const FiducialPattern p = makePattern(options);
  const std::string svg = artworkSvg(p);
  const auto count = [](const std::string& text, const std::string& what) {
    int n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(svg, "<ellipse "), 12);
  EXPECT_EQ(count(svg, "<circle "), 20);
  const std::string dxf = artworkDxf(p);
  EXPECT_EQ(count(dxf, "8\nELLIPSES\n66\n"), 12);
  EXPECT_EQ(count(dxf, "8\nCIRCLES\n66\n"), 20);
  EXPECT_EQ(count(dxf, "0\nPOLYLINE\n"), count(dxf, "0\nSEQEND\n"));
  EXPECT_TRUE(dxf.ends_with("0\nEOF\n"));
}

TEST(Artwork, RefusesWhatCannotBe) {
  ArtworkOptions options;
  options.first_row = 95;
  EXPECT_THROW((void)makePattern(options), InputError);
  options = {};
  options.pitch_um = 0.0;
  EXPECT_THROW((void)makePattern(options), InputError);
  options = {};
  options.columns = 0;
  EXPECT_THROW((void)makePattern(options), InputError);
}

TEST(Image, RefusesWhatIsNoWholeImage) {
  GrayImage image(64, 48, 100);
  image.at(3, 5) = 200;
  const std::string png = encodePng(image);
  const GrayImage again = decodeImageBytes(png, "a.png");
  EXPECT_EQ(again.width(), 64);
  EXPECT_EQ(again.at(3, 5), 200);
  const std::string jpeg = encodeJpeg(image, 90);
  EXPECT_EQ(decodeImageBytes(jpeg, "a.jpg").height(), 48);
  // Whatever byte comes before the end marker.
  for (int level = 0; level < 256; ++level) {
    EXPECT_NO_THROW(
        (void)decodeImageBytes(encodeJpeg(GrayImage(16 + level, 16, static_cast<std::uint8_t>(level)), 80), ""));
  }
  const auto sentence = [](const std::string& bytes) -> std::string {
    try {
      (void)decodeImageBytes(bytes, "a");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(sentence(jpeg.substr(0, jpeg.size() - 40)).find("cut short"), std::string::npos);
  EXPECT_NE(sentence(png.substr(0, png.size() - 14)).find("cut short"), std::string::npos);
  EXPECT_NE(sentence("hello, this is text").find("not an image"), std::string::npos);
  EXPECT_NE(sentence("").find("empty"), std::string::npos);
}

TEST(Image, SizesAreCheckedBeforeAnythingIsAllocated) {
  const auto complaint = [](const std::string& bytes) -> std::string {
    try {
      (void)decodeImageBytes(bytes, "a");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  std::string png = encodePng(GrayImage(16, 16, 7));
  png.replace(16, 8, std::string("\x00\x00\xff\xff\x00\x00\xff\xff", 8));
  EXPECT_NE(complaint(png).find("65535 x 65535 pixels"), std::string::npos) << complaint(png);
  std::string jpeg = encodeJpeg(GrayImage(16, 16, 7), 90);
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, "\xff\xfe\xff\xfd");
  EXPECT_NE(complaint(jpeg).find("65533 x 65534 pixels"), std::string::npos) << complaint(jpeg);
  EXPECT_NE(complaint("P5\n# x\n30000 30001\n255\nabc").find("30000 x 30001 pixels"), std::string::npos);
  std::string bmp = "BM" + std::string(16, '\0') + std::string("\x00\x00\x01\x00\x00\x00\xff\xff", 8) + "\x01";
  EXPECT_NE(complaint(bmp).find("65536 x 65536 pixels"), std::string::npos) << complaint(bmp);
  const std::string tiff = std::string("II*\0\x08\0\0\0\x02\0", 10) +
                           std::string("\x00\x01\x04\0\x01\0\0\0\x00\x00\x01\x00", 12) +
                           std::string("\x01\x01\x03\0\x01\0\0\0\xff\xff\0\0", 12);
  EXPECT_NE(complaint(tiff).find("65536 x 65535 pixels"), std::string::npos) << complaint(tiff);
  for (std::size_t cut = 0; cut <= tiff.size(); ++cut) EXPECT_NE(complaint(tiff.substr(0, cut)), "");
}

}  // namespace
}  // namespace spindrift
