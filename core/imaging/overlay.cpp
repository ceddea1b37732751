// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/imaging/decoder.h"

namespace spindrift {
namespace {

constexpr int shift_bits = 4;  // OpenCV draws with fractions of 1/16 px

cv::Point fine(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::lround(p.x() * (1 << shift_bits))),
          static_cast<int>(std::lround(p.y() * (1 << shift_bits)))};
}

void drawCurve(cv::Mat& picture, const std::vector<cv::Point>& curve, const cv::Scalar& colour) {
  cv::polylines(picture, std::vector<std::vector<cv::Point>>{curve}, true, colour, 1, cv::LINE_AA, shift_bits);
}

}  // namespace

ColourImage decodeOverlay(const GrayImage& image, const FiducialPattern& pattern, const DecodeResult& result) {
  ColourImage picture;
  picture.width = image.width();
  picture.height = image.height();
  picture.bgr.resize(static_cast<std::size_t>(image.width()) * image.height() * 3);
  const cv::Mat grey(image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.data()));
  cv::Mat canvas(image.height(), image.width(), CV_8UC3, picture.bgr.data());
  cv::cvtColor(grey, canvas, cv::COLOR_GRAY2BGR);
  if (result.subpatterns.empty()) return picture;

  const cv::Scalar green(80, 220, 80), yellow(0, 215, 255), blue(255, 170, 60), red(60, 60, 255), white(255, 255, 255);
  const auto outline = [&](const Eigen::Vector2d& centre_um, double a, double b, const Eigen::Vector2d& shift) {
    std::vector<cv::Point> curve;
    for (int k = 0; k < 90; ++k) {
      const double t = 2.0 * std::numbers::pi * k / 90;
      curve.push_back(fine(result.map.imageOf(centre_um + Eigen::Vector2d(a * std::cos(t), b * std::sin(t))) + shift));
    }
    return curve;
  };
  for (const CircleMark& c : result.circles) {
    const Eigen::Vector2d centre = pattern.circleCentre(c.i, c.j);
    const Eigen::Vector2d shift = Eigen::Vector2d(c.x_px, c.y_px) - result.map.imageOf(centre);
    drawCurve(canvas, outline(centre, pattern.circle_radius_um, pattern.circle_radius_um, shift), blue);
  }
  for (const Subpattern& s : result.subpatterns) {
    const cv::Scalar colour = s.from_neighbours ? yellow : green;
    const Eigen::Vector2d centre = pattern.ellipseCentre(s.row, s.column);
    const Eigen::Vector2d at(s.x_px, s.y_px);
    drawCurve(canvas, outline(centre, pattern.semi_axis_x_um, pattern.semi_axis_y_um, at - result.map.imageOf(centre)),
              colour);
    cv::line(canvas, fine(at - Eigen::Vector2d(6, 0)), fine(at + Eigen::Vector2d(6, 0)), colour, 1, cv::LINE_AA,
             shift_bits);
    cv::line(canvas, fine(at - Eigen::Vector2d(0, 6)), fine(at + Eigen::Vector2d(0, 6)), colour, 1, cv::LINE_AA,
             shift_bits);
    const std::string label = std::to_string(s.row) + "," + std::to_string(s.column);
    const cv::Point where(static_cast<int>(s.x_px) + 8, static_cast<int>(s.y_px) - 8);
    cv::putText(canvas, label, where, cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
    cv::putText(canvas, label, where, cv::FONT_HERSHEY_SIMPLEX, 0.5, white, 1, cv::LINE_AA);
  }
  // Axes of the pattern at the decoded ellipse nearest to the image's centre.
  const Subpattern* nearest = &result.subpatterns.front();
  const auto distance = [&](const Subpattern& s) {
    return std::hypot(s.x_px - result.map.centre_x_px, s.y_px - result.map.centre_y_px);
  };
  for (const Subpattern& s : result.subpatterns) {
    if (distance(s) < distance(*nearest)) nearest = &s;
  }
  const Eigen::Vector2d origin = pattern.ellipseCentre(nearest->row, nearest->column);
  const double length = 0.7 * pattern.pitch_um;
  const std::array<std::pair<Eigen::Vector2d, const char*>, 2> axes = {std::pair{Eigen::Vector2d(length, 0), "X"},
                                                                       std::pair{Eigen::Vector2d(0, length), "Y"}};
  for (const auto& [axis, name] : axes) {
    const Eigen::Vector2d from = result.map.imageOf(origin);
    const Eigen::Vector2d to = result.map.imageOf(origin + axis);
    cv::arrowedLine(canvas, {static_cast<int>(from.x()), static_cast<int>(from.y())},
                    {static_cast<int>(to.x()), static_cast<int>(to.y())}, red, 2, cv::LINE_AA, 0, 0.06);
    cv::putText(canvas, name, {static_cast<int>(to.x()) + 6, static_cast<int>(to.y()) + 6}, cv::FONT_HERSHEY_SIMPLEX,
                0.7, red, 2, cv::LINE_AA);
  }
  return picture;
}

}  // namespace spindrift
