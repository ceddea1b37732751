// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"

namespace spindrift {
namespace {

unsigned byteAt(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

/// True if the JPEG's picture ends with its end marker. Thumbnails inside segments are stepped over.
bool jpegIsComplete(std::string_view bytes) {
  std::size_t i = 2;
  while (i + 2 <= bytes.size()) {
    if (byteAt(bytes, i) != 0xFF) {  // inside entropy-coded data: on to the next 0xFF
      i = bytes.find('\xFF', i);
      if (i == std::string_view::npos) return false;
      continue;
    }
    const unsigned marker = byteAt(bytes, i + 1);
    if (marker == 0xD9) return true;
    if (marker == 0xFF) {
      ++i;
    } else if (marker == 0x00 || marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8)) {
      i += 2;
    } else if (i + 4 > bytes.size()) {
      return false;
    } else {
      i += 2 + byteAt(bytes, i + 2) * 256 + byteAt(bytes, i + 3);
    }
  }
  return false;
}

/// True if the PNG has its last chunk.
bool pngIsComplete(std::string_view bytes) {
  std::size_t i = 8;
  while (i + 12 <= bytes.size()) {
    const std::size_t length = (std::size_t{byteAt(bytes, i)} << 24) | (byteAt(bytes, i + 1) << 16) |
                               (byteAt(bytes, i + 2) << 8) | byteAt(bytes, i + 3);
    if (bytes.substr(i + 4, 4) == "IEND") return true;
    i += 12 + length;
  }
  return false;
}

std::string encode(const cv::Mat& mat, const char* extension, const std::vector<int>& parameters) {
  std::vector<unsigned char> buffer;
  const bool done = cv::imencode(extension, mat, buffer, parameters);
  SPINDRIFT_ASSERT(done, "the picture can be encoded");
  return {buffer.begin(), buffer.end()};
}

cv::Mat viewOf(const GrayImage& image) {
  SPINDRIFT_ASSERT(!image.empty(), "an empty image cannot be encoded");
  return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.data())};
}

}  // namespace

GrayImage::GrayImage(int width, int height, std::uint8_t level) : width_(width), height_(height) {
  SPINDRIFT_ASSERT(width > 0 && height > 0, "an image has at least one pixel");
  pixels_.assign(static_cast<std::size_t>(width) * height, level);
}

GrayImage readImage(const std::filesystem::path& file) {
  return decodeImageBytes(readFile(file), file);
}

GrayImage decodeImageBytes(std::string_view bytes, const std::filesystem::path& name) {
  if (bytes.empty())
    throw InputError({name, ""}, "the file is empty; an image is needed (JPEG, PNG, TIFF, BMP or PGM).");
  const bool jpeg = bytes.starts_with("\xFF\xD8");
  const bool png = bytes.starts_with("\x89PNG\r\n\x1a\n");
  if ((jpeg && !jpegIsComplete(bytes)) || (png && !pngIsComplete(bytes))) {
    throw InputError({name, ""},
                     fmt::format("the {} is cut short: it ends after {} bytes without its end marker; copy it again.",
                                 jpeg ? "JPEG" : "PNG", bytes.size()));
  }
  cv::Mat mat;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    mat = cv::imdecode(buffer, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    mat.release();
  }
  if (mat.empty()) {
    throw InputError({name, ""}, jpeg || png
                                     ? "the image is damaged and cannot be read."
                                     : "this is not an image that can be read (JPEG, PNG, TIFF, BMP or PGM are).");
  }
  if (static_cast<double>(mat.rows) * mat.cols > 1e8) {
    throw InputError({name, ""}, fmt::format("the image has {} x {} pixels; at most 100 million pixels are allowed.",
                                             mat.cols, mat.rows));
  }
  GrayImage image(mat.cols, mat.rows);
  for (int y = 0; y < mat.rows; ++y) std::copy_n(mat.ptr<std::uint8_t>(y), mat.cols, image.row(y));
  return image;
}

std::string encodeJpeg(const GrayImage& image, int quality) {
  return encode(viewOf(image), ".jpg", {cv::IMWRITE_JPEG_QUALITY, quality});
}

std::string encodePng(const GrayImage& image) {
  return encode(viewOf(image), ".png", {});
}

std::string encodePng(const ColourImage& image) {
  SPINDRIFT_ASSERT(image.width > 0 && image.height > 0 &&
                       image.bgr.size() == static_cast<std::size_t>(image.width) * image.height * 3,
                   "a colour image has three bytes a pixel");
  return encode(cv::Mat(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.bgr.data())), ".png", {});
}

}  // namespace spindrift
