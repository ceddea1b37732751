// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/scanning/cloud_reader.h"

namespace spindrift::cloud_reading {

PointCloud readPly(const std::filesystem::path& file, const std::string& text) {
  Lines lines(text);
  std::string_view line;
  if (!lines.next(line) || words(line).empty() || words(line)[0] != "ply")
    fail(file, 1, "is no PLY file: it does not start with 'ply'.");
  struct Type {
    std::string_view name;
    char type;
    std::size_t size;
  };
  constexpr std::array<Type, 16> types{{{"float", 'F', 4},
                                        {"float32", 'F', 4},
                                        {"double", 'F', 8},
                                        {"float64", 'F', 8},
                                        {"char", 'I', 1},
                                        {"int8", 'I', 1},
                                        {"uchar", 'U', 1},
                                        {"uint8", 'U', 1},
                                        {"short", 'I', 2},
                                        {"int16", 'I', 2},
                                        {"ushort", 'U', 2},
                                        {"uint16", 'U', 2},
                                        {"int", 'I', 4},
                                        {"int32", 'I', 4},
                                        {"uint", 'U', 4},
                                        {"uint32", 'U', 4}}};
  std::string format;
  std::vector<Field> fields;
  std::size_t points = 0, record = 0;
  bool in_vertex = false, vertex_seen = false, ended = false;
  while (lines.next(line)) {
    const auto w = words(line);
    const std::size_t place = lines.number();
    if (w.empty() || w[0] == "comment" || w[0] == "obj_info") continue;
    if (w[0] == "end_header") {
      ended = true;
      break;
    }
    if (w[0] == "format" && w.size() >= 2) {
      format = std::string(w[1]);
      if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
        fail(file, place,
             fmt::format("found format '{}'; allowed: ascii, binary_little_endian, binary_big_endian.", format));
    } else if (w[0] == "element" && w.size() == 3) {
      in_vertex = w[1] == "vertex";
      const std::size_t n = count(file, lines.number(), w[2], 0, most_points);
      if (in_vertex) {
        points = n;
        vertex_seen = true;
      } else if (!vertex_seen && n > 0) {
        fail(file, place, fmt::format("element '{}' stands before the points; allowed: element vertex first.", w[1]));
      }
    } else if (w[0] == "property" && w.size() >= 3) {
      if (!in_vertex) continue;
      if (w[1] == "list") fail(file, place, "a list is not a property of a point; allowed: numbers.");
      const auto type = std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.name == w[1]; });
      if (type == types.end())
        fail(file, place, fmt::format("found type '{}'; allowed: float, double and integers.", w[1]));
      fields.push_back({std::string(w[2]), type->type, type->size, 1, record});
      record += type->size;
    } else {
      fail(file, place, fmt::format("found '{}' in the header; allowed: format, element, property, comment.", w[0]));
    }
  }
  if (!ended) fail(file, "", "is truncated inside its header: end_header is missing.");
  if (format.empty() || !vertex_seen) fail(file, "header", "lacks format or element vertex.");
  if (points == 0) fail(file, "header", "states zero points.");
  const auto xyz = positionFields(file, fields);
  Collector out;
  const std::size_t body = lines.position();
  if (format == "ascii") {
    while (out.seen < points && lines.next(line)) {
      const auto w = words(line);
      if (w.empty()) continue;
      if (w.size() != fields.size())
        fail(file, lines.number(),
             fmt::format("has {} values; the header states {} per point.", w.size(), fields.size()));
      const auto at = [&](std::size_t a) {
        return coordinate(file, lines.number(), w[static_cast<std::size_t>(xyz[a] - fields.data())]);
      };
      out.add(at(0), at(1), at(2));
    }
    if (out.seen < points)
      fail(file, "", fmt::format("is truncated: the header promises {} points, the file holds {}.", points, out.seen));
  } else {
    if (text.size() - body < points * record)
      fail(file, "",
           fmt::format("is truncated: the header promises {} points of {} bytes, the file holds {}.", points, record,
                       (text.size() - body) / record));
    readRecords(out, text.data() + body, points, record, xyz,
                (format == "binary_big_endian") == (std::endian::native == std::endian::little));
  }
  return out.finish(file);
}

}  // namespace spindrift::cloud_reading
