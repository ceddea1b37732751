// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/imaging/image_files.h"

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

struct StatedSize {
  double width = 0.0;
  double height = 0.0;
  double least_bytes = 0.0;  ///< of a file of raw pixels; 0: not known beforehand
};

/// Size that the JPEG's frame header states; zero if there is none.
StatedSize jpegSize(std::string_view bytes) {
  std::size_t i = 2;
  while (i + 9 <= bytes.size() && byteAt(bytes, i) == 0xFF) {
    const unsigned marker = byteAt(bytes, i + 1);
    if (marker == 0xFF) {
      ++i;
      continue;
    }
    if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC)
      return {byteAt(bytes, i + 7) * 256.0 + byteAt(bytes, i + 8), byteAt(bytes, i + 5) * 256.0 + byteAt(bytes, i + 6)};
    i += 2 + byteAt(bytes, i + 2) * 256 + byteAt(bytes, i + 3);
  }
  return {};
}

/// Size that the header states, before anything is allocated for it; zero if there is none, or if the format is not one
/// of those that are read here. (OpenCV would try many more, each with a decoder of its own.)
StatedSize statedSize(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xD8")) return jpegSize(bytes);
  const auto number = [&](std::size_t i, std::size_t count, bool big) {
    double value = 0.0;
    for (std::size_t k = 0; k < count && i + count <= bytes.size(); ++k)
      value = 256.0 * value + byteAt(bytes, big ? i + k : i + count - 1 - k);
    return value;
  };
  if (bytes.starts_with("\x89PNG")) return {number(16, 4, true), number(20, 4, true)};
  if (bytes.starts_with("BM")) {
    // A negative height: rows from top to bottom.
    const double height = number(22, 4, false);
    return {number(18, 4, false), std::min(height, 4294967296.0 - height)};
  }
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') {
    StatedSize size;
    double levels = 255.0;
    const bool has_levels = bytes[1] != '1' && bytes[1] != '4';
    std::size_t i = 2;
    for (double* value : {&size.width, &size.height, &levels}) {
      if (value == &levels && !has_levels) break;
      if (value == &levels) levels = 0.0;
      while (i < bytes.size() && (std::isspace(static_cast<unsigned char>(bytes[i])) != 0 || bytes[i] == '#')) {
        if (bytes[i] == '#') i = std::min(bytes.find('\n', i), bytes.size() - 1);
        ++i;
      }
      for (; i < bytes.size() && bytes[i] >= '0' && bytes[i] <= '9'; ++i) *value = 10.0 * *value + (bytes[i] - '0');
    }
    // One white space, then the pixels; as text each of them takes a digit at least.
    const double row = bytes[1] == '4' ? std::ceil(size.width / 8.0) : size.width * (levels > 255.0 ? 2.0 : 1.0);
    const double colours = bytes[1] == '3' || bytes[1] == '6' ? 3.0 : 1.0;
    size.least_bytes = static_cast<double>(i) + 1.0 + row * size.height * colours;
    return size;
  }
  if (bytes.starts_with(std::string_view("II*\0", 4)) || bytes.starts_with(std::string_view("MM\0*", 4))) {
    const bool big = bytes[0] == 'M';
    StatedSize size;
    const auto directory = static_cast<std::size_t>(number(4, 4, big));
    const auto entries = static_cast<std::size_t>(number(directory, 2, big));
    for (std::size_t k = 0; k < entries && directory + 14 + 12 * k <= bytes.size(); ++k) {
      const std::size_t at = directory + 2 + 12 * k;
      const double tag = number(at, 2, big);
      const double value = number(at + 8, number(at + 2, 2, big) == 3.0 ? 2 : 4, big);
      if (tag == 256.0) size.width = std::max(size.width, value);
      if (tag == 257.0) size.height = std::max(size.height, value);
    }
    return size;
  }
  return {};
}

void requireSize(const std::filesystem::path& name, double width, double height) {
  if (width * height <= 1e8) return;
  throw InputError({name, ""}, fmt::format("the image has {:.0f} x {:.0f} pixels; at most 100 million pixels are "
                                           "allowed.",
                                           width, height));
}

std::string encode(const cv::Mat& mat, const char* extension, const std::vector<int>& parameters) {
  std::vector<unsigned char> buffer;
  const bool done = imageFiles().encode(extension, mat, buffer, parameters);
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
  return decodeImageBytes(readFile(file, largest_image_file), file);
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
  if (bytes.size() > largest_image_file)
    throw InputError({name, ""},
                     fmt::format("the file has {} bytes; at most {} are allowed.", bytes.size(), largest_image_file));
  const StatedSize stated = statedSize(bytes);
  requireSize(name, stated.width, stated.height);
  if (static_cast<double>(bytes.size()) < stated.least_bytes) {
    throw InputError({name, ""},
                     fmt::format("the image is cut short: it has {} bytes, {:.0f} x {:.0f} pixels need {:.0f}; copy it "
                                 "again.",
                                 bytes.size(), stated.width, stated.height, stated.least_bytes));
  }
  cv::Mat mat;
  if (stated.width > 0.0 && stated.height > 0.0) {
    try {
      const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
      mat = imageFiles().decode(buffer, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
    } catch (const cv::Exception& failure) {
      if (failure.code == cv::Error::StsNoMem) throw std::bad_alloc();
      mat.release();
    }
  }
  if (mat.empty()) {
    throw InputError({name, ""}, jpeg || png
                                     ? "the image is damaged and cannot be read."
                                     : "this is not an image that can be read (JPEG, PNG, TIFF, BMP or PGM are).");
  }
  requireSize(name, mat.cols, mat.rows);
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
