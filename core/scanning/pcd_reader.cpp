// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/scanning/cloud_reader.h"
#include "core/scanning/lzf.h"

namespace spindrift::cloud_reading {
namespace {

struct PcdHeader {
  std::vector<Field> fields;
  std::size_t width = 0, height = 1, points = 0, record = 0;
  std::string data;
  std::size_t body = 0;
  std::size_t lines = 0;
};

PcdHeader readPcdHeader(const std::filesystem::path& file, const std::string& text) {
  PcdHeader header;
  Lines lines(std::string_view(text).substr(0, std::min<std::size_t>(text.size(), 65536)));
  std::string_view line;
  bool has_width = false, has_points = false, sizes = false, types = false;
  while (header.data.empty() && lines.next(line)) {
    const auto w = words(line);
    if (w.empty() || w[0].front() == '#') continue;
    const std::size_t place = lines.number();
    const auto needFields = [&] {
      if (header.fields.empty() || w.size() - 1 != header.fields.size())
        fail(file, place, fmt::format("{} gives {} entries for {} FIELDS.", w[0], w.size() - 1, header.fields.size()));
    };
    if (w[0] == "VERSION") {
      if (w.size() != 2 ||
          !(w[1] == "0.7" || w[1] == ".7" || w[1] == "0.6" || w[1] == ".6" || w[1] == "0.5" || w[1] == ".5"))
        fail(file, place, fmt::format("found version '{}'; allowed: 0.7.", w.size() > 1 ? w[1] : ""));
    } else if (w[0] == "FIELDS") {
      for (std::size_t i = 1; i < w.size(); ++i) header.fields.push_back({std::string(w[i]), 'F', 4, 1, 0});
    } else if (w[0] == "SIZE") {
      needFields();
      sizes = true;
      for (std::size_t i = 1; i < w.size(); ++i) {
        const std::size_t s = count(file, lines.number(), w[i], 1, 8);
        if (s != 1 && s != 2 && s != 4 && s != 8)
          fail(file, place, fmt::format("found SIZE {}; allowed: 1, 2, 4, 8.", s));
        header.fields[i - 1].size = s;
      }
    } else if (w[0] == "TYPE") {
      needFields();
      types = true;
      for (std::size_t i = 1; i < w.size(); ++i) {
        if (w[i] != "F" && w[i] != "I" && w[i] != "U")
          fail(file, place, fmt::format("found TYPE '{}'; allowed: F, I, U.", w[i]));
        header.fields[i - 1].type = w[i][0];
      }
    } else if (w[0] == "COUNT") {
      needFields();
      for (std::size_t i = 1; i < w.size(); ++i)
        header.fields[i - 1].count = count(file, lines.number(), w[i], 1, 65536);
    } else if (w[0] == "WIDTH" || w[0] == "HEIGHT" || w[0] == "POINTS") {
      const std::size_t v = count(file, lines.number(), w.size() > 1 ? w[1] : "", 0, most_points);
      if (w[0] == "WIDTH") {
        header.width = v;
        has_width = true;
      } else if (w[0] == "HEIGHT") {
        header.height = v;
      } else {
        header.points = v;
        has_points = true;
      }
    } else if (w[0] == "DATA") {
      header.data = w.size() > 1 ? std::string(w[1]) : "";
      if (header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed")
        fail(file, place, fmt::format("found DATA '{}'; allowed: ascii, binary, binary_compressed.", header.data));
    } else if (w[0] != "VIEWPOINT") {
      fail(file, place, fmt::format("found '{}' in the header; allowed: the entries of PCD 0.7.", w[0]));
    }
  }
  if (header.data.empty())
    fail(file, "", "is not a PCD file, or is truncated inside its header: the DATA line is missing.");
  if (header.fields.empty() || !sizes || !types) fail(file, "header", "lacks FIELDS, SIZE or TYPE.");
  if (!has_width && !has_points) fail(file, "header", "lacks WIDTH and POINTS.");
  if (!has_points) header.points = header.width * header.height;
  if (!has_width) header.width = header.points;
  if (header.width * header.height != header.points)
    fail(file, "header",
         fmt::format("states WIDTH {} times HEIGHT {} but POINTS {}.", header.width, header.height, header.points));
  for (Field& f : header.fields) {
    if (f.type == 'F' && f.size != 4 && f.size != 8)
      fail(file, "header",
           fmt::format("field {} is a floating-point number of {} bytes; allowed: 4 or 8.", f.name, f.size));
    f.offset = header.record;
    header.record += f.size * f.count;
  }
  header.body = lines.position();
  header.lines = lines.number();
  return header;
}
}  // namespace

PointCloud readPcd(const std::filesystem::path& file, const std::string& text) {
  const PcdHeader header = readPcdHeader(file, text);
  const auto xyz = positionFields(file, header.fields);
  Collector out;
  if (header.height > 1 && header.width > 1) out.row_width = header.width;
  if (header.points == 0) fail(file, "header", "states zero points.");
  const std::size_t available = text.size() - header.body;
  if (header.data == "binary") {
    if (available < header.points * header.record)
      fail(file, "",
           fmt::format("is truncated: the header promises {} points of {} bytes, the file holds {:.0f}.", header.points,
                       header.record, std::floor(static_cast<double>(available) / static_cast<double>(header.record))));
    readRecords(out, text.data() + header.body, header.points, header.record, xyz, false);
  } else if (header.data == "binary_compressed") {
    if (available < 8) fail(file, "", "is truncated: the sizes of the compressed block are missing.");
    std::uint32_t packed = 0, full = 0;
    std::memcpy(&packed, text.data() + header.body, 4);
    std::memcpy(&full, text.data() + header.body + 4, 4);
    if (available - 8 < packed)
      fail(file, "",
           fmt::format("is truncated: the compressed block has {} bytes, the file holds {}.", packed, available - 8));
    if (full != header.points * header.record)
      fail(file, "header",
           fmt::format("states {} points of {} bytes, but the compressed block unpacks to {} bytes.", header.points,
                       header.record, full));
    // No byte of LZF stands for more than 88 (a match of 264 bytes takes three): what claims more is not unpacked.
    if (full > 88U * static_cast<std::size_t>(packed))
      fail(file, "",
           fmt::format("is damaged: {} compressed bytes cannot unpack to the {} bytes it states.", packed, full));
    std::string raw(full, '\0');
    if (!lzfUnpack(std::string_view(text).substr(header.body + 8, packed), raw))
      fail(file, "", "is damaged: its compressed block does not unpack to the size it states.");
    // Field by field, not point by point.
    std::array<std::size_t, 3> base{};
    std::size_t offset = 0;
    for (const Field& f : header.fields) {
      for (std::size_t a = 0; a < 3; ++a)
        if (xyz[a] == &f) base[a] = offset;
      offset += f.size * f.count * header.points;
    }
    out.cloud.points_mm.reserve(header.points);
    const auto at = [&](std::size_t a, std::size_t i) {
      return valueAt(raw.data() + base[a] + i * xyz[a]->size * xyz[a]->count, xyz[a]->type, xyz[a]->size, false);
    };
    for (std::size_t i = 0; i < header.points; ++i) out.add(at(0, i), at(1, i), at(2, i));
  } else {
    std::array<std::size_t, 3> column{};
    std::size_t columns = 0;
    for (const Field& f : header.fields) {
      for (std::size_t a = 0; a < 3; ++a)
        if (xyz[a] == &f) column[a] = columns;
      columns += f.count;
    }
    Lines lines(std::string_view(text).substr(header.body));
    std::string_view line;
    while (lines.next(line)) {
      const auto w = words(line);
      if (w.empty()) continue;
      const std::size_t number = header.lines + lines.number();
      if (w.size() != columns)
        fail(file, number, fmt::format("has {} values; the header states {} per point.", w.size(), columns));
      if (out.seen == header.points)
        fail(file, number, fmt::format("is one point too many: the header states {}.", header.points));
      out.add(coordinate(file, number, w[column[0]]), coordinate(file, number, w[column[1]]),
              coordinate(file, number, w[column[2]]));
    }
    if (out.seen < header.points)
      fail(file, "",
           fmt::format("is truncated: the header promises {} points, the file holds {}.", header.points, out.seen));
  }
  return out.finish(file);
}

}  // namespace spindrift::cloud_reading
