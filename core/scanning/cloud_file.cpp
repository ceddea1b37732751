// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/cloud_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/scanning/cloud_reader.h"
#include "core/scanning/lzf.h"

namespace spindrift {
namespace {

using namespace cloud_reading;

PointCloud readCsv(const std::filesystem::path& file, const std::string& text) {
  // Not through CsvTable: millions of rows of three numbers.
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
  Lines lines(rest);
  std::string_view line;
  std::array<int, 3> column{-1, -1, -1};
  std::size_t columns = 0;
  bool header = false;
  Collector out;
  std::vector<std::string_view> parts;
  while (lines.next(line)) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    parts.clear();
    for (std::size_t from = 0;;) {
      const std::size_t comma = line.find(',', from);
      parts.push_back(trimmed(line.substr(from, comma == std::string_view::npos ? comma : comma - from)));
      if (comma == std::string_view::npos) break;
      from = comma + 1;
    }
    const std::size_t place = lines.number();
    if (!header) {
      header = true;
      columns = parts.size();
      constexpr std::array<std::string_view, 3> names{"x_mm", "y_mm", "z_mm"};
      for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t a = 0; a < 3; ++a)
          if (parts[i] == names[a]) {
            if (column[a] >= 0) fail(file, place, fmt::format("has the column {} twice.", names[a]));
            column[a] = static_cast<int>(i);
          }
      for (std::size_t a = 0; a < 3; ++a)
        if (column[a] < 0)
          fail(file, place, fmt::format("lacks the column {}; needed are x_mm, y_mm and z_mm.", names[a]));
      continue;
    }
    if (parts.size() != columns)
      fail(file, place, fmt::format("has {} fields; the header has {}.", parts.size(), columns));
    const auto at = [&](std::size_t a) {
      const std::string_view word = parts[static_cast<std::size_t>(column[a])];
      return word.empty() ? std::nan("") : coordinate(file, lines.number(), word);
    };
    out.add(at(0), at(1), at(2));
  }
  if (!header) fail(file, "", "is empty; the first row must name x_mm, y_mm and z_mm.");
  return out.finish(file);
}

std::string extensionOf(const std::filesystem::path& file) {
  std::string e = file.extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

template <typename T>
void append(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

void appendNumber(std::string& out, double value, bool single) {
  char buffer[40];
  const auto end = single ? std::to_chars(buffer, buffer + sizeof buffer, static_cast<float>(value)).ptr
                          : std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  out.append(buffer, end);
}

void appendText(std::string& out, const PointCloud& cloud, char separator, bool single) {
  for (const Eigen::Vector3d& p : cloud.points_mm)
    for (int a = 0; a < 3; ++a) {
      appendNumber(out, p[a], single);
      out += a < 2 ? separator : '\n';
    }
}

void appendBinary(std::string& out, const PointCloud& cloud, bool single) {
  for (const Eigen::Vector3d& p : cloud.points_mm)
    for (int a = 0; a < 3; ++a) {
      if (single)
        append(out, static_cast<float>(p[a]));
      else
        append(out, p[a]);
    }
}

}  // namespace

PointCloud readCloud(const std::filesystem::path& file) {
  const std::string extension = extensionOf(file);
  if (extension != ".pcd" && extension != ".ply" && extension != ".csv")
    fail(file, "", fmt::format("found extension '{}'; allowed: .pcd, .ply, .csv.", extension));
  const std::string text = readFile(file, largest_cloud_file);
  if (text.empty()) fail(file, "", "is empty.");
  if (extension == ".pcd") return readPcd(file, text);
  if (extension == ".ply") return readPly(file, text);
  return readCsv(file, text);
}

void writeCloud(const PointCloud& cloud, const std::filesystem::path& file, CloudEncoding encoding,
                bool single_precision) {
  const std::string extension = extensionOf(file);
  const std::size_t size = single_precision ? 4 : 8;
  std::string out;
  out.reserve(400 + cloud.size() * (encoding == CloudEncoding::Ascii ? 36 : 3 * size));
  if (extension == ".csv") {
    if (encoding == CloudEncoding::BinaryCompressed) fail(file, "", "a CSV cloud is text; allowed: ascii.");
    out = "x_mm,y_mm,z_mm\n";
    appendText(out, cloud, ',', single_precision);
  } else if (extension == ".ply") {
    if (encoding == CloudEncoding::BinaryCompressed)
      fail(file, "", "PLY has no compressed form; allowed: ascii, binary.");
    out = fmt::format("ply\nformat {} 1.0\ncomment unit mm\nelement vertex {}\n",
                      encoding == CloudEncoding::Ascii ? "ascii" : "binary_little_endian", cloud.size());
    for (const char axis : {'x', 'y', 'z'})
      out += fmt::format("property {} {}\n", single_precision ? "float" : "double", axis);
    out += "end_header\n";
    if (encoding == CloudEncoding::Ascii)
      appendText(out, cloud, ' ', single_precision);
    else
      appendBinary(out, cloud, single_precision);
  } else if (extension == ".pcd") {
    constexpr std::array<std::string_view, 3> data{"ascii", "binary", "binary_compressed"};
    out = fmt::format(
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE {0} {0} {0}\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {1}\nHEIGHT "
        "1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {1}\nDATA {2}\n",
        size, cloud.size(), data[static_cast<std::size_t>(encoding)]);
    if (encoding == CloudEncoding::Ascii) {
      appendText(out, cloud, ' ', single_precision);
    } else if (encoding == CloudEncoding::Binary) {
      appendBinary(out, cloud, single_precision);
    } else {
      std::string raw;
      raw.reserve(cloud.size() * 3 * size);
      for (int a = 0; a < 3; ++a)
        for (const Eigen::Vector3d& p : cloud.points_mm) {
          if (single_precision)
            append(raw, static_cast<float>(p[a]));
          else
            append(raw, p[a]);
        }
      if (raw.size() > 0xffffffffU) fail(file, "", "is too large for a compressed PCD (4 GB); allowed: binary.");
      const std::string packed = lzfPack(raw);
      append(out, static_cast<std::uint32_t>(packed.size()));
      append(out, static_cast<std::uint32_t>(raw.size()));
      out += packed;
    }
  } else {
    fail(file, "", fmt::format("found extension '{}'; allowed: .pcd, .ply, .csv.", extension));
  }
  writeFileAtomically(file, out);
}

}  // namespace spindrift
