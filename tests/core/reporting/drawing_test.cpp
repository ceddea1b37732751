// SPDX-License-Identifier: GPL-3.0-or-later
// One drawing, three formats: every character, the same shapes.
#include "core/reporting/drawing.h"

#include <gmock/gmock.h>

#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "core/base/error.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

cv::Mat pixelsOf(const Drawing& drawing, double scale = 1.0) {
  const std::string png = pngOf(drawing, scale);
  return cv::imdecode(std::vector<unsigned char>(png.begin(), png.end()), cv::IMREAD_COLOR);
}

int inkOf(const cv::Mat& image) {
  int ink = 0;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) ink += image.at<cv::Vec3b>(y, x) != cv::Vec3b(255, 255, 255) ? 1 : 0;
  return ink;
}

Drawing writing(std::string_view text, const TextLook& look = {.size = 24.0}) {
  Drawing drawing(120.0, 60.0);
  drawing.text(look.anchor == TextAnchor::Middle ? 60.0 : 10.0, 40.0, text, look);
  return drawing;
}

TEST(Drawing, PngHasEveryCharacterAndNoTwoLookAlike) {
  std::vector<std::string> seen;
  for (const char* letter : {"?", "µ", "Ω", "Ψ", "°", "±", "−", "Ä", "²", "→"}) {
    seen.push_back(pngOf(writing(letter)));
    EXPECT_GT(inkOf(pixelsOf(writing(letter))), 5) << letter;
    for (std::size_t i = 0; i + 1 < seen.size(); ++i) EXPECT_NE(seen[i], seen.back()) << letter;
  }
}

TEST(Drawing, TextsStandWhereTheyAreAnchoredAndTurnUpwards) {
  const auto columns = [](const cv::Mat& image) {
    std::pair<int, int> range{image.cols, -1};
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x)
        if (image.at<cv::Vec3b>(y, x) != cv::Vec3b(255, 255, 255))
          range = {std::min(range.first, x), std::max(range.second, x)};
    return range;
  };
  const auto start = columns(pixelsOf(writing("HHH")));
  EXPECT_NEAR(start.first, 12, 3);
  const auto middle = columns(pixelsOf(writing("HHH", {.size = 24.0, .anchor = TextAnchor::Middle})));
  EXPECT_NEAR(middle.first + middle.second, 120, 3);
  const auto up = columns(pixelsOf(writing("HHH", {.size = 10.0, .upwards = true})));
  EXPECT_LE(up.second, 11) << "the base line is at the right of a text that goes up";
  EXPECT_LT(up.second - up.first, 10);
}

TEST(Drawing, ShapesAreTheSameInEveryFormat) {
  Drawing drawing(40.0, 30.0);
  drawing.rectangle(0.0, 0.0, 10.0, 10.0, PictureColour{255, 0, 0});
  drawing.beginWindow(20.0, 0.0, 10.0, 10.0);
  drawing.rectangle(15.0, 0.0, 25.0, 30.0, PictureColour{0, 0, 255});
  drawing.endWindow();
  drawing.disc(10.0, 20.0, 5.0, PictureColour{0, 255, 0});
  const cv::Mat image = pixelsOf(drawing, 2.0);
  ASSERT_EQ(image.size(), cv::Size(80, 60));
  EXPECT_EQ(image.at<cv::Vec3b>(10, 10), cv::Vec3b(0, 0, 255)) << "red, as OpenCV orders";
  EXPECT_EQ(image.at<cv::Vec3b>(10, 50), cv::Vec3b(255, 0, 0));
  EXPECT_EQ(image.at<cv::Vec3b>(10, 34), cv::Vec3b(255, 255, 255)) << "outside the window";
  EXPECT_EQ(image.at<cv::Vec3b>(40, 50), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(image.at<cv::Vec3b>(40, 20), cv::Vec3b(0, 255, 0));
  const std::string svg = svgOf(drawing);
  EXPECT_THAT(svg, HasSubstr(R"(<rect x="0" y="0" width="10" height="10" fill="#ff0000")"));
  EXPECT_THAT(svg, HasSubstr(R"(<svg x="20" y="0" width="10" height="10" viewBox="20 0 10 10">)"));
  EXPECT_THAT(svg, HasSubstr(R"(<circle cx="10" cy="20" r="5" fill="#00ff00")"));
  EXPECT_THAT(svg, Not(HasSubstr(" id="))) << "an id would be there twice in a report of two figures";
  const std::string pdf = pdfOf(drawing);
  EXPECT_THAT(pdf, ::testing::StartsWith("%PDF-"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [ 0 0 30 22.5 ]")) << "points of 1/72 inch";
}

TEST(Drawing, AGridMovesItsPartsAsAWhole) {
  Drawing part(20.0, 10.0);
  part.disc(5.0, 5.0, 2.0, PictureColour{1, 2, 3});
  part.path({{{0.0, 0.0}, {1.0, 1.0}}}, {.stroke = PictureColour{1, 2, 3}});
  const Drawing grid = drawingGrid({part, part, part}, 2, 4.0);
  EXPECT_DOUBLE_EQ(grid.width(), 44.0);
  EXPECT_DOUBLE_EQ(grid.height(), 24.0);
  const std::string svg = svgOf(grid);
  for (const char* text : {R"(cx="5" cy="5")", R"(cx="29" cy="5")", R"(cx="5" cy="19")", "M24 0L25 1", "M0 14L1 15"})
    EXPECT_THAT(svg, HasSubstr(text));
}

TEST(Drawing, PicturesAreEmbedded) {
  std::vector<unsigned char> bytes;
  ASSERT_TRUE(cv::imencode(".jpg", cv::Mat(8, 8, CV_8UC3, cv::Scalar(0, 0, 255)), bytes));
  Drawing drawing(20.0, 20.0);
  drawing.picture(4.0, 4.0, 12.0, 12.0, std::string(bytes.begin(), bytes.end()));
  const cv::Vec3b middle = pixelsOf(drawing).at<cv::Vec3b>(10, 10);
  EXPECT_GT(middle[2], 200);
  EXPECT_LT(middle[0], 60);
  EXPECT_THAT(svgOf(drawing), HasSubstr("data:image/jpeg;base64,"));
  drawing.picture(0.0, 0.0, 2.0, 2.0, "no picture");
  EXPECT_EQ(pixelsOf(drawing).at<cv::Vec3b>(10, 10), middle) << "what cannot be read is left out";
}

TEST(Drawing, WhatIsNowhereIsNotDrawn) {
  const double nowhere = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  Drawing with(100.0, 50.0), without(100.0, 50.0);
  with.path({{{1.0, 1.0}, {nowhere, 2.0}, {3.0, 3.0}}}, {.stroke = PictureColour{0, 0, 0}});
  without.path({{{1.0, 1.0}, {3.0, 3.0}}}, {.stroke = PictureColour{0, 0, 0}});
  with.disc(nowhere, 1.0, 2.0, {0, 0, 0});
  with.rectangle(1.0, far, 1.0, 1.0, PictureColour{0, 0, 0});
  with.text(far, 1.0, "t", {.size = 10.0});
  EXPECT_EQ(svgOf(with), svgOf(without));
  EXPECT_EQ(pngOf(with, 1.0), pngOf(without, 1.0));
}

TEST(Drawing, RefusesScalesThatCannotBe) {
  EXPECT_THROW((void)pngOf(Drawing(10.0, 10.0), 0.0), InputError);
  EXPECT_THROW((void)pngOf(Drawing(10.0, 10.0), 9.0), InputError);
}

TEST(Drawing, Base64KnownValues) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace spindrift
