// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/base/error.h"
#include "core/imaging/image_files.h"

namespace spindrift {
namespace {

constexpr double sheet_width_px = 860.0;
constexpr double gap_px = 10.0;
constexpr double label_px = 34.0;
/// Height of a thumbnail over its width; pictures of other shapes are centred in it.
constexpr double shape = 0.75;
constexpr int jpeg_quality = 82;

std::string encoded(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!imageFiles().encode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, jpeg_quality})) return {};
  return {bytes.begin(), bytes.end()};
}

/// Width and height of a picture made as large as fits into a box.
std::pair<double, double> fittedSize(const std::string& jpeg, double width, double height) {
  const cv::Mat bytes(1, static_cast<int>(jpeg.size()), CV_8UC1, const_cast<char*>(jpeg.data()));
  const cv::Mat image = imageFiles().decode(bytes, cv::IMREAD_GRAYSCALE);
  if (image.empty()) return {width, height};
  const double scale = std::min(width / image.cols, height / image.rows);
  return {scale * image.cols, scale * image.rows};
}

/// As much of a text as fits into `width` at `size` px (a letter is taken as 0.56 of it).
std::string fitted(const std::string& text, double width, double size) {
  const auto most = static_cast<std::size_t>(std::max(4.0, width / (0.56 * size)));
  if (text.size() <= most) return text;
  std::size_t keep = most - 1;
  while (keep > 0 && (static_cast<unsigned char>(text[keep]) & 0xC0U) == 0x80U) --keep;  // not within a letter
  return text.substr(0, keep) + "…";
}

}  // namespace

std::string imageThumbnail(const std::filesystem::path& file, int width_px) {
  cv::Mat image;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return {};
  try {
    image = imageFiles().read(file.string(), cv::IMREAD_REDUCED_GRAYSCALE_2);
  } catch (const cv::Exception&) {
    return {};  // larger than OpenCV reads
  }
  if (image.empty()) return {};
  cv::Mat small;
  const double scale = static_cast<double>(width_px) / image.cols;
  cv::resize(image, small, {width_px, std::max(1, static_cast<int>(std::lround(image.rows * scale)))}, 0, 0,
             cv::INTER_AREA);
  return encoded(small);
}

std::string cloudThumbnail(const std::vector<float>& xyz_mm, const std::vector<float>& scalar, double low, double high,
                           int width_px) {
  SPINDRIFT_ASSERT(xyz_mm.size() == 3 * scalar.size(), "one scalar a point");
  float from[2] = {1e30F, 1e30F}, to[2] = {-1e30F, -1e30F};
  for (std::size_t i = 0; i < scalar.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      from[axis] = std::min(from[axis], xyz_mm[3 * i + static_cast<std::size_t>(axis)]);
      to[axis] = std::max(to[axis], xyz_mm[3 * i + static_cast<std::size_t>(axis)]);
    }
  }
  if (scalar.empty() || !(to[0] > from[0]) || !(to[1] > from[1])) return {};
  const double scale = (width_px - 1) / static_cast<double>(to[0] - from[0]);
  const int rows = std::clamp(static_cast<int>(std::lround((to[1] - from[1]) * scale)) + 1, 2, 4 * width_px);
  const double scale_y = (rows - 1) / static_cast<double>(to[1] - from[1]);
  cv::Mat sum = cv::Mat::zeros(rows, width_px, CV_32F), count = cv::Mat::zeros(rows, width_px, CV_32F);
  for (std::size_t i = 0; i < scalar.size(); ++i) {
    if (!std::isfinite(scalar[i])) continue;
    const int column = static_cast<int>(std::lround((xyz_mm[3 * i] - from[0]) * scale));
    const int row = rows - 1 - static_cast<int>(std::lround((xyz_mm[3 * i + 1] - from[1]) * scale_y));
    sum.at<float>(row, column) += scalar[i];
    count.at<float>(row, column) += 1.0F;
  }
  // Empty cells between profiles take their neighbours' mean, larger gaps stay white.
  cv::Mat wide_sum, wide_count;
  cv::boxFilter(sum, wide_sum, CV_32F, {3, 3}, {-1, -1}, false);
  cv::boxFilter(count, wide_count, CV_32F, {3, 3}, {-1, -1}, false);
  cv::Mat grey(rows, width_px, CV_8U);
  const double range = std::max(1e-12, high - low);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < width_px; ++c) {
      const bool own = count.at<float>(r, c) > 0.0F;
      const float n = own ? count.at<float>(r, c) : wide_count.at<float>(r, c);
      const float s = own ? sum.at<float>(r, c) : wide_sum.at<float>(r, c);
      grey.at<unsigned char>(r, c) =
          n > 0.0F ? cv::saturate_cast<unsigned char>(255.0 * (static_cast<double>(s) / n - low) / range) : 0;
    }
  }
  cv::Mat colours;
  cv::applyColorMap(grey, colours, cv::COLORMAP_VIRIDIS);
  colours.setTo(cv::Scalar::all(255), wide_count == 0.0F);
  return encoded(colours);
}

Drawing contactSheet(const std::vector<Thumbnail>& thumbnails, int columns) {
  SPINDRIFT_ASSERT(columns >= 1, "a sheet has a column");
  constexpr PictureColour soft{82, 96, 109};
  const double width = (sheet_width_px - gap_px * (columns - 1)) / columns;
  const double height = shape * width;
  const auto wide = static_cast<std::size_t>(columns);
  const auto rows = static_cast<double>((thumbnails.size() + wide - 1) / wide);
  Drawing sheet(sheet_width_px, rows * (height + label_px + gap_px));
  for (std::size_t i = 0; i < thumbnails.size(); ++i) {
    const double x = static_cast<double>(i % wide) * (width + gap_px);
    const double y = static_cast<double>(i / wide) * (height + label_px + gap_px);
    const Thumbnail& t = thumbnails[i];
    sheet.rectangle(x, y, width, height,
                    Paint{.fill = PictureColour{244, 246, 248}, .stroke = PictureColour{217, 222, 228}});
    if (t.jpeg.empty()) {
      sheet.text(x + width / 2, y + height / 2, "cannot be read",
                 {.size = 11.0, .anchor = TextAnchor::Middle, .colour = soft});
    } else {
      const auto [part, tall] = fittedSize(t.jpeg, width - 2.0, height - 2.0);
      sheet.picture(x + 0.5 * (width - part), y + 0.5 * (height - tall), part, tall, t.jpeg);
    }
    sheet.text(x, y + height + 14.0, fitted(t.label, width, 11.0), {.size = 11.0});
    sheet.text(x, y + height + 28.0, fitted(t.comment, width, 10.0), {.size = 10.0, .colour = soft});
  }
  return sheet;
}

}  // namespace spindrift
