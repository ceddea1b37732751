// SPDX-License-Identifier: Apache-2.0
// Inside of cloud_file.h: what the readers of the formats share. Not for use elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/scanning/cloud.h"

namespace spindrift::cloud_reading {

inline constexpr std::size_t most_points = 400'000'000;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& place, const std::string& sentence);
[[noreturn]] void fail(const std::filesystem::path& file, std::size_t line, const std::string& sentence);

/// One number per point in a binary record.
struct Field {
  std::string name;
  char type = 'F';  ///< F float, I signed, U unsigned
  std::size_t size = 4;
  std::size_t count = 1;
  std::size_t offset = 0;
};

/// The words of a line, parted by blanks and tabs.
[[nodiscard]] std::vector<std::string_view> words(std::string_view line);

/// Text lines with their number.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}
  [[nodiscard]] bool next(std::string_view& line) {
    if (position_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    line = text_.substr(position_, end - position_);
    position_ = end + 1;
    ++number_;
    return true;
  }
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  [[nodiscard]] std::size_t position() const noexcept { return std::min(position_, text_.size()); }

 private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_ = 0;
};

/// A whole number from `least` to `most`.
[[nodiscard]] std::size_t count(const std::filesystem::path& file, std::size_t line, std::string_view word,
                                std::size_t least, std::size_t most);

/// A coordinate of a text file; "nan" stands for a missing sample.
[[nodiscard]] double coordinate(const std::filesystem::path& file, std::size_t line, std::string_view word);

/// Keeps finite points and, where the file states rows of equal width, its rows as profiles.
struct Collector {
  PointCloud cloud;
  std::size_t row_width = 0;  ///< 0: no rows stated
  std::size_t seen = 0;
  std::size_t missing = 0;

  void add(double x, double y, double z);
  [[nodiscard]] PointCloud finish(const std::filesystem::path& file);
};

/// One number of a binary record.
[[nodiscard]] double valueAt(const char* data, char type, std::size_t size, bool swap);
/// The fields x, y and z.
[[nodiscard]] std::array<const Field*, 3> positionFields(const std::filesystem::path& file,
                                                         const std::vector<Field>& fields);
/// Binary records one after the other; `swap`: of the other byte order.
void readRecords(Collector& out, const char* data, std::size_t points, std::size_t record,
                 const std::array<const Field*, 3>& xyz, bool swap);

[[nodiscard]] PointCloud readPcd(const std::filesystem::path& file, const std::string& text);
[[nodiscard]] PointCloud readPly(const std::filesystem::path& file, const std::string& text);

}  // namespace spindrift::cloud_reading
