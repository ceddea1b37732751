// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/cloud_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scanning/lzf.h"

namespace spindrift {
namespace {

constexpr std::size_t most_points = 400'000'000;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& place, const std::string& sentence) {
  throw InputError({file, place}, sentence);
}

/// One number per point in a binary record.
struct Field {
  std::string name;
  char type = 'F';  ///< F float, I signed, U unsigned
  std::size_t size = 4;
  std::size_t count = 1;
  std::size_t offset = 0;
};

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

std::size_t count(const std::filesystem::path& file, std::size_t line, std::string_view word, std::size_t least,
                  std::size_t most) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || value < least || value > most)
    fail(file, fmt::format("line {}", line),
         fmt::format("found '{}'; allowed: a whole number from {} to {}.", word, least, most));
  return value;
}

/// A coordinate of a text file; "nan" stands for a missing sample.
double coordinate(const std::filesystem::path& file, std::size_t line, std::string_view word) {
  double value = 0.0;
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    fail(file, fmt::format("line {}", line), fmt::format("found '{}'; allowed: a number or nan.", word));
  return value;
}

/// Keeps finite points and, where the file states rows of equal width, its rows as profiles.
struct Collector {
  PointCloud cloud;
  std::size_t row_width = 0;  ///< 0: no rows stated
  std::size_t seen = 0;
  std::size_t missing = 0;

  void add(double x, double y, double z) {
    if (row_width > 0 && seen % row_width == 0 &&
        (cloud.profile_start.empty() || cloud.profile_start.back() != cloud.size()))
      cloud.profile_start.push_back(cloud.size());
    ++seen;
    if (std::isfinite(x) && std::isfinite(y) && std::isfinite(z))
      cloud.points_mm.emplace_back(x, y, z);
    else
      ++missing;
  }

  [[nodiscard]] PointCloud finish(const std::filesystem::path& file) {
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
};

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
    const std::string place = fmt::format("line {}", lines.number());
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
  if (header.data.empty()) fail(file, "", "is no PCD file or is cut off inside its header: there is no DATA line.");
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
        fail(file, fmt::format("line {}", number),
             fmt::format("has {} values; the header states {} per point.", w.size(), columns));
      if (out.seen == header.points)
        fail(file, fmt::format("line {}", number),
             fmt::format("is one point too many: the header states {}.", header.points));
      out.add(coordinate(file, number, w[column[0]]), coordinate(file, number, w[column[1]]),
              coordinate(file, number, w[column[2]]));
    }
    if (out.seen < header.points)
      fail(file, "",
           fmt::format("is truncated: the header promises {} points, the file holds {}.", header.points, out.seen));
  }
  return out.finish(file);
}

PointCloud readPly(const std::filesystem::path& file, const std::string& text) {
  Lines lines(text);
  std::string_view line;
  if (!lines.next(line) || words(line).empty() || words(line)[0] != "ply")
    fail(file, "line 1", "is no PLY file: it does not start with 'ply'.");
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
    const std::string place = fmt::format("line {}", lines.number());
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
      if (w[1] == "list") fail(file, place, "a list is no property of a point; allowed: numbers.");
      const auto type = std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.name == w[1]; });
      if (type == types.end())
        fail(file, place, fmt::format("found type '{}'; allowed: float, double and integers.", w[1]));
      fields.push_back({std::string(w[2]), type->type, type->size, 1, record});
      record += type->size;
    } else {
      fail(file, place, fmt::format("found '{}' in the header; allowed: format, element, property, comment.", w[0]));
    }
  }
  if (!ended) fail(file, "", "is cut off inside its header: there is no end_header.");
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
        fail(file, fmt::format("line {}", lines.number()),
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
    const std::string place = fmt::format("line {}", lines.number());
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
  const std::string text = readFile(file);
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
