// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/imaging/decoder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/imaging/artwork.h"
#include "core/simulation/virtual_microscope.h"
#include "tests/support/scene_truth.h"

namespace spindrift {
namespace {

MicroscopeScene smallScene(double pixel_um, double tilt_rad, double k1 = 0.0) {
  MicroscopeScene scene;
  scene.width_px = 960;
  scene.height_px = 640;
  scene.map = poseAt(scene.width_px, scene.height_px, pixel_um, tilt_rad, {1230, 1310}, {470, 330}, k1);
  return scene;
}

struct Score {
  int in_view = 0;
  int decoded = 0;
  int wrong = 0;
  double error2 = 0.0;
  double z2 = 0.0;
  int coordinates = 0;
  void add(const DecodeResult& result, const MicroscopeScene& scene, const FiducialPattern& pattern) {
    for (const SceneTruth::Mark& mark : sceneTruth(pattern, scene, 2.0).ellipses) {
      ++in_view;
      decoded += result.find(mark.a, mark.b) != nullptr ? 1 : 0;
    }
    for (const Subpattern& s : result.subpatterns) {
      const Eigen::Vector2d truth = scene.map.imageOf(pattern.ellipseCentre(s.row, s.column));
      const double dx = s.x_px - truth.x();
      const double dy = s.y_px - truth.y();
      if (std::hypot(dx, dy) > 1.0) ++wrong;
      error2 += dx * dx + dy * dy;
      z2 += (dx * dx + dy * dy) / (s.sigma_px * s.sigma_px);
      coordinates += 2;
    }
  }
  [[nodiscard]] double rms() const { return std::sqrt(error2 / coordinates); }
  [[nodiscard]] double errorOverSigma() const { return std::sqrt(z2 / coordinates); }
};

TEST(Decoder, FindsEveryEllipseAtAnyTurnAndPixelLength) {
  Score score;
  int k = 0;
  for (const double tilt_deg : {0.0, 47.0, 91.0, 135.0, 180.0, 226.0, 271.0, 333.0}) {
    const double pixel = 1.2 + 0.18 * k;
    MicroscopeScene scene = smallScene(pixel, tilt_deg * std::numbers::pi / 180.0, 2e-9);
    const DecodeResult result = decodeImage(renderFiducial(standardPattern(), scene, 100 + k++), standardPattern());
    ASSERT_TRUE(result.usable()) << tilt_deg << ": " << result.message;
    score.add(result, scene, standardPattern());
    EXPECT_NEAR(std::remainder(result.map.tilt_rad - scene.map.tilt_rad, 2 * std::numbers::pi), 0.0, 5e-5);
    EXPECT_NEAR(result.map.pixel_length_um, pixel, 4.0 * result.pixel_length_sigma_um + 1e-5);
    for (const Subpattern& s : result.subpatterns) EXPECT_FALSE(s.from_neighbours) << s.row << ',' << s.column;
  }
  EXPECT_EQ(score.decoded, score.in_view);
  EXPECT_EQ(score.wrong, 0);
  EXPECT_LT(score.rms(), 0.01);
}

TEST(Decoder, HardImagesKeepTheirNumbersAndTheirUncertainty) {
  Score score;
  Random random(11);
  for (int k = 0; k < 8; ++k) {
    MicroscopeScene scene = smallScene(random.uniform(1.2, 2.4), random.uniform(-3.1, 3.1));
    scene.blur_sigma_px = random.uniform(1.0, 3.0);
    scene.noise_level = random.uniform(3.0, 8.0);
    scene.gradient_x = 0.66;
    scene.jpeg_quality = 85;
    scene.dust = 8;
    scene.scratches = 2;
    scene.screws = 1;
    scene.foreign_texts = 1;
    for (const SceneTruth::Mark& mark : sceneTruth(standardPattern(), scene).ellipses) {
      if (random.uniform() < 0.2) scene.damaged_digits.emplace_back(mark.a, mark.b);
    }
    const DecodeResult result = decodeImage(renderFiducial(standardPattern(), scene, 500 + k), standardPattern());
    ASSERT_TRUE(result.usable()) << k << ": " << result.message;
    score.add(result, scene, standardPattern());
  }
  EXPECT_GE(score.decoded, 0.99 * score.in_view);
  EXPECT_EQ(score.wrong, 0);
  EXPECT_LT(score.rms(), 0.06);
  EXPECT_GT(score.errorOverSigma(), 0.7);
  EXPECT_LT(score.errorOverSigma(), 1.4);
}

TEST(Decoder, DamagedDigitsAreNumberedByTheirNeighbours) {
  MicroscopeScene scene = smallScene(1.5, 0.4);
  scene.damaged_digits = {{14, 14}, {15, 14}};
  const DecodeResult result = decodeImage(renderFiducial(standardPattern(), scene, 3), standardPattern());
  ASSERT_TRUE(result.usable()) << result.message;
  Score score;
  score.add(result, scene, standardPattern());
  EXPECT_EQ(score.decoded, score.in_view);
  EXPECT_EQ(score.wrong, 0);
}

TEST(Decoder, MirroredImageIsReadAndSaid) {
  MicroscopeScene scene = smallScene(1.5, 0.4);
  scene.map = poseAt(scene.width_px, scene.height_px, 1.5, 0.4, {1230, 1310}, {470, 330}, 0.0, true);
  const DecodeResult result = decodeImage(renderFiducial(standardPattern(), scene, 3), standardPattern());
  ASSERT_TRUE(result.usable()) << result.message;
  EXPECT_TRUE(result.map.mirrored);
  Score score;
  score.add(result, scene, standardPattern());
  EXPECT_EQ(score.decoded, score.in_view);
  EXPECT_EQ(score.wrong, 0);
}

TEST(Decoder, OwnPatternIsDecoded) {
  ArtworkOptions options;
  options.rows = 5;
  options.columns = 6;
  options.first_row = 42;
  options.first_column = 73;
  options.pitch_um = 500.0;
  const FiducialPattern pattern = makePattern(options);
  MicroscopeScene scene = smallScene(2.0, -1.1);
  scene.map = poseAt(scene.width_px, scene.height_px, 2.0, -1.1, {900, 800}, {470, 330});
  const DecodeResult result = decodeImage(renderFiducial(pattern, scene, 3), pattern);
  ASSERT_TRUE(result.usable()) << result.message;
  Score score;
  score.add(result, scene, pattern);
  EXPECT_EQ(score.decoded, score.in_view);
  EXPECT_EQ(score.wrong, 0);
}

void expectRejected(const GrayImage& image, const std::string& word) {
  const DecodeResult result = decodeImage(image, standardPattern());
  EXPECT_EQ(result.status, FitStatus::Rejected);
  EXPECT_NE(result.message.find(word), std::string::npos) << result.message;
}

TEST(Decoder, RefusesWithAReason) {
  expectRejected(GrayImage(640, 480, 3), "black");
  expectRejected(GrayImage(640, 480, 252), "white");
  expectRejected(GrayImage(640, 480, 120), "no contrast");
  expectRejected(GrayImage(1, 1, 7), "black");
  MicroscopeScene blurred = smallScene(1.5, 0.4);
  blurred.blur_sigma_px = 25.0;
  expectRejected(renderFiducial(standardPattern(), blurred, 1), "blurred");
  MicroscopeScene scene = smallScene(1.5, 0.4);
  MicroscopeScene two = smallScene(1.3, 0.4);
  two.map = poseAt(two.width_px, two.height_px, 1.3, 0.4, {2800, 1400}, {400, 330});
  two.further_patterns = {poseAt(two.width_px, two.height_px, 1.3, 0.55, {0, 1400}, {700, 330})};
  expectRejected(renderFiducial(standardPattern(), two, 1), "two patterns");
  ArtworkOptions other;
  other.first_row = 51;
  other.first_column = 61;
  expectRejected(renderFiducial(makePattern(other), scene, 1), "another pattern");
}

TEST(Decoder, NoiseAloneIsNoPattern) {
  GrayImage image(800, 600);
  Random random(4);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.at(x, y) = static_cast<std::uint8_t>(random.index(256));
  }
  const DecodeResult result = decodeImage(image, standardPattern());
  EXPECT_EQ(result.status, FitStatus::Rejected);
  EXPECT_TRUE(result.subpatterns.empty());
}

TEST(PatternMap, GoesThereAndBack) {
  const PatternMap map = poseAt(1920, 1080, 1.23, 2.1, {700, 900}, {800, 500}, 5e-9, true);
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), Eigen::Vector2d(1500, -300), Eigen::Vector2d(700, 900)}) {
    EXPECT_LT((map.patternOf(map.imageOf(p)) - p).norm(), 1e-6);
  }
  EXPECT_LT((map.imageOf({700, 900}) - Eigen::Vector2d(800, 500)).norm(), 1e-9);
}

}  // namespace
}  // namespace spindrift
