// SPDX-License-Identifier: GPL-3.0-or-later
// From the drawing that a mask shop gets to numbers read in a picture of it: the SVG is drawn by a rasteriser of its
// own, seen straight or from the side, and decoded with the pattern file.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <regex>

#include "core/base/random.h"
#include "core/imaging/artwork.h"
#include "core/imaging/decoder.h"
#include "core/imaging/evaluate_fiducials.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

/// What is drawn: its distance (um, negative inside) and where it is.
struct Shape {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double reach_um = 0.0;
  std::function<double(const Eigen::Vector2d&)> distance_um;
};

double number(const std::string& element, const std::string& name) {
  std::smatch match;
  const std::regex pattern(" " + name + "=\"([-0-9.e+]+)\"");
  EXPECT_TRUE(std::regex_search(element, match, pattern)) << name << " of " << element;
  return std::stod(match[1]);
}

double toSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

/// The elements that artworkSvg writes, in user units (um), Y up.
std::vector<Shape> shapesOf(const std::string& svg) {
  std::vector<Shape> shapes;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::string element = svg.substr(at, svg.find('>', at) - at);
    Shape shape;
    if (element.starts_with("<circle ")) {
      const double r = number(element, "r");
      shape.centre = {number(element, "cx"), number(element, "cy")};
      shape.reach_um = r;
      shape.distance_um = [c = shape.centre, r](const Eigen::Vector2d& p) { return (p - c).norm() - r; };
    } else if (element.starts_with("<ellipse ")) {
      const double a = number(element, "rx"), b = number(element, "ry");
      const double half = 0.5 * number(element, "stroke-width");
      shape.centre = {number(element, "cx"), number(element, "cy")};
      shape.reach_um = std::max(a, b) + half;
      shape.distance_um = [c = shape.centre, a, b, half](const Eigen::Vector2d& p) {
        const Eigen::Vector2d d = p - c;
        const double f = std::hypot(d.x() / a, d.y() / b);
        if (f < 0.5) return 1e3;
        const double slope = std::hypot(d.x() / (a * a), d.y() / (b * b)) / f;
        return std::abs(f - 1.0) / slope - half;
      };
    } else if (element.starts_with("<polyline ")) {
      const double half = 0.5 * number(element, "stroke-width");
      std::vector<Eigen::Vector2d> points;
      const std::regex pair("([-0-9.]+),([-0-9.]+)");
      const std::size_t list = element.find("points=");
      const std::string text = element.substr(list);
      for (std::sregex_iterator it(text.begin(), text.end(), pair), end; it != end; ++it)
        points.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
      for (const Eigen::Vector2d& p : points) shape.centre += p / static_cast<double>(points.size());
      for (const Eigen::Vector2d& p : points)
        shape.reach_um = std::max(shape.reach_um, (p - shape.centre).norm() + half);
      shape.distance_um = [points, half](const Eigen::Vector2d& p) {
        double nearest = (p - points.front()).norm();
        for (std::size_t i = 1; i < points.size(); ++i)
          nearest = std::min(nearest, toSegment(p, points[i - 1], points[i]));
        return nearest - half;
      };
    } else {
      continue;
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

/// A camera: homography from pattern (um) to pixels; light from one side, blur, noise.
struct Photograph {
  int width_px = 1100;
  int height_px = 900;
  double pixel_um = 2.2;
  double turned_rad = 0.3;
  double tilt_rad = 0.0;  ///< of the camera against the fiducial's normal
  double uneven = 0.0;    ///< light falls from 1 + uneven to 1 - uneven across the picture
  double blur_px = 0.9;
  double noise = 2.0;

  [[nodiscard]] Eigen::Matrix3d homography(const FiducialPattern& pattern) const {
    const double centre_um = 0.5 * (pattern.rowCount() - 1) * pattern.pitch_um;
    const double distance_um = 5.0 * (pattern.rowCount() + 1) * pattern.pitch_um;  // as a phone is held
    Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
    shift(0, 2) = shift(1, 2) = -centre_um;
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() << std::cos(turned_rad), -std::sin(turned_rad), std::sin(turned_rad),
        std::cos(turned_rad);
    Eigen::Matrix3d camera = Eigen::Matrix3d::Identity();
    camera(0, 0) = std::cos(tilt_rad) / pixel_um;
    camera(1, 1) = -1.0 / pixel_um;
    camera(2, 0) = std::sin(tilt_rad) / distance_um;
    Eigen::Matrix3d place = Eigen::Matrix3d::Identity();
    place(0, 2) = 0.5 * (width_px - 1);
    place(1, 2) = 0.5 * (height_px - 1);
    return place * camera * turn * shift;
  }
  [[nodiscard]] GrayImage of(const FiducialPattern& pattern, std::uint64_t seed) const {
    const Eigen::Matrix3d to_px = homography(pattern);
    const Eigen::Matrix3d to_um = to_px.inverse();
    std::vector<double> light(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), 0.0);
    for (const Shape& shape : shapesOf(artworkSvg(pattern))) {
      const Eigen::Vector2d c = (to_px * shape.centre.homogeneous()).hnormalized();
      const double reach = 1.4 * shape.reach_um / pixel_um + 2.0;
      for (int y = std::max(0, static_cast<int>(c.y() - reach));
           y < std::min(height_px, static_cast<int>(c.y() + reach)); ++y) {
        for (int x = std::max(0, static_cast<int>(c.x() - reach));
             x < std::min(width_px, static_cast<int>(c.x() + reach)); ++x) {
          const Eigen::Vector2d p = (to_um * Eigen::Vector3d(x, y, 1.0)).hnormalized();
          double& pixel =
              light[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)];
          pixel = std::max(pixel, std::clamp(0.5 - shape.distance_um(p) / pixel_um, 0.0, 1.0));
        }
      }
    }
    blur(light);
    Random random(seed);
    GrayImage image(width_px, height_px, 0);
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        const double u = 2.0 * x / (width_px - 1.0) - 1.0, v = 2.0 * y / (height_px - 1.0) - 1.0;
        const double lit = 1.0 - uneven * (0.7 * u + 0.3 * v);
        const double mark =
            light[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)];
        const double level = lit * (35.0 + 125.0 * mark) + random.normal(0.0, noise);
        image.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
      }
    }
    return image;
  }

 private:
  void blur(std::vector<double>& light) const {
    std::vector<double> kernel;
    double sum = 0.0;
    for (int k = -3; k <= 3; ++k) kernel.push_back(std::exp(-0.5 * k * k / (blur_px * blur_px)));
    for (const double w : kernel) sum += w;
    const auto along = [&](int dx, int dy) {
      std::vector<double> out(light.size(), 0.0);
      for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
          double value = 0.0;
          for (int k = -3; k <= 3; ++k) {
            const int xx = std::clamp(x + k * dx, 0, width_px - 1), yy = std::clamp(y + k * dy, 0, height_px - 1);
            value +=
                kernel[static_cast<std::size_t>(k + 3)] / sum *
                light[static_cast<std::size_t>(yy) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(xx)];
          }
          out[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x)] = value;
        }
      }
      light = std::move(out);
    };
    along(1, 0);
    along(0, 1);
  }
};

/// Distance of a decoded ellipse from where the photograph shows it, px.
double errorOf(const Subpattern& s, const Photograph& photo, const FiducialPattern& pattern) {
  const Eigen::Vector2d at =
      (photo.homography(pattern) * pattern.ellipseCentre(s.row, s.column).homogeneous()).hnormalized();
  return std::hypot(s.x_px - at.x(), s.y_px - at.y());
}

TEST(ArtworkToDecoded, ThreePitches) {
  for (const double pitch_um : {200.0, 350.0, 1000.0}) {
    const FiducialPattern drawn =
        makePattern({.rows = 4, .columns = 5, .first_row = 21, .first_column = 34, .pitch_um = pitch_um});
    const testing::TempFolder folder;
    const auto file = folder.write("pattern.json", patternJson(drawn));
    Photograph photo;
    photo.pixel_um = 2.2 * pitch_um / 350.0;
    photo.noise = 3.0;
    const std::string png = encodePng(photo.of(drawn, 5));
    const DecodeResult result = decodeImage(decodeImageBytes(png, "photo.png"), *campaignPattern(folder.path()));
    ASSERT_TRUE(result.usable()) << pitch_um << " um: " << result.message;
    EXPECT_EQ(readPattern(file).pitch_um, pitch_um);
    EXPECT_NEAR(result.map.pixel_length_um / photo.pixel_um, 1.0, 1e-3) << pitch_um;
    EXPECT_EQ(result.subpatterns.size(), 20U) << pitch_um;
    for (const Subpattern& s : result.subpatterns) EXPECT_LT(errorOf(s, photo, drawn), 0.1) << s.row << s.column;
    // Another pattern of the same shape is not read as this one: its numbers are others.
    const DecodeResult other = decodeImage(decodeImageBytes(png, "photo.png"), makePattern({.pitch_um = pitch_um}));
    for (const Subpattern& s : other.subpatterns) EXPECT_FALSE(other.usable()) << s.row << s.column;
  }
}

TEST(ArtworkToDecoded, APhotographFromAPhoneIsReadRightOrRefusedWithAReason) {
  const FiducialPattern pattern = makePattern({.rows = 4, .columns = 4, .pitch_um = 2000.0});
  int read = 0, refused = 0;
  for (const double tilt_deg : {0.0, 3.0, 8.0, 15.0, 25.0, 40.0, 60.0}) {
    for (const double uneven : {0.0, 0.6}) {
      Photograph photo;
      photo.pixel_um = 2.2 * 2000.0 / 350.0;
      photo.tilt_rad = tilt_deg * std::numbers::pi / 180.0;
      photo.uneven = uneven;
      photo.turned_rad = 0.2 + tilt_deg / 10.0;
      const DecodeResult result = decodeImage(photo.of(pattern, 9), pattern);
      const std::string what = "tilt " + std::to_string(tilt_deg) + ", light " + std::to_string(uneven);
      if (!result.usable()) {
        ++refused;
        EXPECT_EQ(result.status, FitStatus::Rejected) << what;
        EXPECT_GT(result.message.size(), 20U) << what;
        if (tilt_deg <= 15.0) {
          EXPECT_NE(result.message.find("seen from the side"), std::string::npos) << what << result.message;
        }
        continue;
      }
      ++read;
      EXPECT_LT(tilt_deg, 3.0) << what << ": lengths would be wrong";
      EXPECT_EQ(result.subpatterns.size(), 16U) << what;
      for (const Subpattern& s : result.subpatterns)
        EXPECT_LT(errorOf(s, photo, pattern), 0.1) << what << ": " << s.row << ' ' << s.column;
    }
  }
  EXPECT_EQ(read, 2) << "straight ones, also in uneven light";
  EXPECT_EQ(refused, 12);
}

}  // namespace
}  // namespace spindrift
