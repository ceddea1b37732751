// SPDX-License-Identifier: Apache-2.0
// Grey images in memory, and reading and writing them. Pixels: the centre of the top-left pixel is (0, 0), x to the
// right, y down; levels 0 ... 255.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// An 8-bit grey image, rows top-down without padding. Owns its pixels; copies are deep.
class GrayImage {
 public:
  GrayImage() = default;
  /// width, height > 0.
  GrayImage(int width, int height, std::uint8_t level = 0);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] bool empty() const noexcept { return pixels_.empty(); }
  [[nodiscard]] std::uint8_t* row(int y) noexcept { return pixels_.data() + static_cast<std::size_t>(y) * width_; }
  [[nodiscard]] const std::uint8_t* row(int y) const noexcept {
    return pixels_.data() + static_cast<std::size_t>(y) * width_;
  }
  [[nodiscard]] std::uint8_t& at(int x, int y) noexcept { return row(y)[x]; }
  [[nodiscard]] std::uint8_t at(int x, int y) const noexcept { return row(y)[x]; }
  [[nodiscard]] std::uint8_t* data() noexcept { return pixels_.data(); }
  [[nodiscard]] const std::uint8_t* data() const noexcept { return pixels_.data(); }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> pixels_;
};

/// A colour picture for people (overlays): 3 bytes a pixel in the order blue, green, red.
struct ColourImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bgr;
};

/// Bytes of an image file: 16 bits and four channels for each of the 100 million pixels that are allowed.
inline constexpr std::size_t largest_image_file = 800'000'000;

/// Reads any picture OpenCV can read (JPEG, PNG, TIFF, BMP, PGM ...) as grey levels; colour is averaged as luma, an
/// orientation tag is ignored (pixels stay as the sensor had them). Throws InputError with one sentence: missing file,
/// not an image, cut short (JPEG without its end marker, PNG without its last chunk), larger than 100 megapixels or
/// than largest_image_file.
[[nodiscard]] GrayImage readImage(const std::filesystem::path& file);

/// The same from bytes in memory; `name` stands for the file in errors.
[[nodiscard]] GrayImage decodeImageBytes(std::string_view bytes, const std::filesystem::path& name);

/// Encodes as JPEG (quality 1 ... 100) or PNG.
[[nodiscard]] std::string encodeJpeg(const GrayImage& image, int quality);
[[nodiscard]] std::string encodePng(const GrayImage& image);
[[nodiscard]] std::string encodePng(const ColourImage& image);

}  // namespace spindrift
