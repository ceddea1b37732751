// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/cloud_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/base/error.h"

namespace spindrift::cloud_reading {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& place, const std::string& sentence) {
  throw InputError({file, place}, sentence);
}
[[noreturn]] void fail(const std::filesystem::path& file, std::size_t line, const std::string& sentence) {
  throw InputError(SourcePlace::atLine(file, line), sentence);
}
double valueAt(const char* data, char type, std::size_t size, bool swap) {
  unsigned char bytes[8] = {};
  std::memcpy(bytes, data, size);
  if (swap) std::reverse(bytes, bytes + size);
  const auto as = [&bytes](auto value) {
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  };
  if (type == 'F') return size == 8 ? as(double{}) : as(float{});
  if (type == 'I') {
    switch (size) {
      case 1:
        return as(std::int8_t{});
      case 2:
        return as(std::int16_t{});
      case 4:
        return as(std::int32_t{});
      default:
        return as(std::int64_t{});
    }
  }
  switch (size) {
    case 1:
      return as(std::uint8_t{});
    case 2:
      return as(std::uint16_t{});
    case 4:
      return as(std::uint32_t{});
    default:
      return as(std::uint64_t{});
  }
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> out;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && (line[i] == ' ' || line[i] == '\t' || line[i] == '\r')) ++i;
    const std::size_t from = i;
    while (i < line.size() && line[i] != ' ' && line[i] != '\t' && line[i] != '\r') ++i;
    if (i > from) out.push_back(line.substr(from, i - from));
  }
  return out;
}

std::size_t count(const std::filesystem::path& file, std::size_t line, std::string_view word, std::size_t least,
                  std::size_t most) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < least || value > most)
    fail(file, line, fmt::format("found '{}'; allowed: a whole number from {} to {}.", word, least, most));
  return value;
}

double coordinate(const std::filesystem::path& file, std::size_t line, std::string_view word) {
  double value = 0.0;
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    fail(file, line, fmt::format("found '{}'; allowed: a number or nan.", word));
  return value;
}

void Collector::add(double x, double y, double z) {
  if (row_width > 0 && seen % row_width == 0 &&
      (cloud.profile_start.empty() || cloud.profile_start.back() != cloud.size()))
    cloud.profile_start.push_back(cloud.size());
  ++seen;
  if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z))
    cloud.points_mm.emplace_back(x, y, z);
  else
    ++missing;
}

PointCloud Collector::finish(const std::filesystem::path& file) {
  if (seen == 0) fail(file, "", "holds no points.");
  if (cloud.empty()) fail(file, "", fmt::format("holds {} points, none of which is a number (all NaN).", seen));
  cloud.name = file.filename().string();
  if (row_width > 0) {
    if (cloud.profile_start.back() != cloud.size()) cloud.profile_start.push_back(cloud.size());
    if (cloud.profileCount() < 3) cloud.profile_start.clear();
  }
  if (cloud.profile_start.empty()) findProfiles(cloud);
  requireUsableCloud(cloud, 1);
  return std::move(cloud);
}

std::array<const Field*, 3> positionFields(const std::filesystem::path& file, const std::vector<Field>& fields) {
  std::array<const Field*, 3> out{};
  constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    for (const Field& f : fields)
      if (f.name == names[i]) {
        if (out[i] != nullptr) fail(file, "header", fmt::format("has the field {} twice.", names[i]));
        out[i] = &f;
      }
    if (out[i] == nullptr) fail(file, "header", fmt::format("lacks the field {}; needed are x, y and z.", names[i]));
  }
  return out;
}

void readRecords(Collector& out, const char* data, std::size_t points, std::size_t record,
                 const std::array<const Field*, 3>& xyz, bool swap) {
  out.cloud.points_mm.reserve(points);
  const bool floats =
      !swap && std::all_of(xyz.begin(), xyz.end(), [](const Field* f) { return f->type == 'F' && f->size == 4; });
  if (floats) {
    for (std::size_t i = 0; i < points; ++i, data += record) {
      float v[3];
      for (int a = 0; a < 3; ++a) std::memcpy(&v[a], data + xyz[static_cast<std::size_t>(a)]->offset, 4);
      out.add(v[0], v[1], v[2]);
    }
    return;
  }
  for (std::size_t i = 0; i < points; ++i, data += record)
    out.add(valueAt(data + xyz[0]->offset, xyz[0]->type, xyz[0]->size, swap),
            valueAt(data + xyz[1]->offset, xyz[1]->type, xyz[1]->size, swap),
            valueAt(data + xyz[2]->offset, xyz[2]->type, xyz[2]->size, swap));
}

}  // namespace spindrift::cloud_reading
