// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/file_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/workflows/file_formats.h"

namespace spindrift {
namespace {

/// Ends of names and the units that they say; longer ones first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 40> unit_ends{{
    {"_um_per_m_K", "um/(m K)"},
    {"_px_per_um", "px/um"},
    {"_um_per_h", "um/h"},
    {"_K_per_h", "K/h"},
    {"_mm_min", "mm/min"},
    {"_um_s", "um/s"},
    {"_degC", "degC"},
    {"_hours", "h"},
    {"_urad", "urad"},
    {"_rad", "rad"},
    {"_rpm", "1/min"},
    {"_deg", "deg"},
    {"_px", "px"},
    {"_mm", "mm"},
    {"_um", "um"},
    {"_us", "us"},
    {"_mb", "MB"},
    {"_K", "K"},
    {"_h", "h"},
    {"_s", "s"},
}};

std::string unitOfName(std::string_view name) {
  if (name == "friction" || name.ends_with("_utc")) return {};
  for (const auto& [end, unit] : unit_ends) {
    if (!end.empty() && name.ends_with(end)) return std::string(unit);
  }
  return {};
}

/// One line of file_formats.cpp: path {unit} | without | allowed | meaning.
FileKey keyOf(std::string_view line) {
  std::array<std::string, 4> fields;
  for (std::string& field : fields) {
    const std::size_t end = std::min(line.find('|'), line.size());
    field = trimmed(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  FileKey key{fields[0], {}, fields[1], fields[2], fields[3]};
  if (const std::size_t brace = key.path.find(" {"); brace != std::string::npos) {
    key.unit = key.path.substr(brace + 2, key.path.size() - brace - 3);
    key.path.resize(brace);
  } else {
    key.unit = unitOfName(key.name());
  }
  SPINDRIFT_ASSERT(!key.path.empty() && !key.without.empty() && !key.meaning.empty(), "four fields of a key");
  return key;
}

std::vector<FileFormat> made() {
  std::vector<FileFormat> all;
  for (const FileFormatText& text : fileFormatTexts()) {
    FileFormat format{std::string(text.id),
                      std::string(text.file),
                      std::string(text.format),
                      std::string(text.what),
                      std::string(trimmed(text.example)),
                      {}};
    for (const std::string& line : splitList(std::string(text.keys), '\n')) format.keys.push_back(keyOf(line));
    all.push_back(std::move(format));
  }
  return all;
}

std::string markdownOf(const FileFormat& format, const TextTranslation& translation) {
  const auto in = [&](std::string_view english) {
    return translation && !english.empty() ? translation(english) : std::string(english);
  };
  std::string text =
      fmt::format("## {}{}\n\n", in(format.file), format.format.empty() ? std::string() : " (" + format.format + ")");
  text += in(format.what) + "\n\n";
  if (!format.example.empty()) text += "```json\n" + format.example + "\n```\n\n";
  if (format.keys.empty()) return text;
  text += fmt::format("| {} | {} | {} | {} | {} |\n|---|---|---|---|---|\n", in("Key or column"), in("Unit"),
                      in("Without it"), in("Allowed"), in("Meaning"));
  for (const FileKey& key : format.keys) {
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.path, printedUnit(in(key.unit)), in(key.without),
                        in(key.allowed), in(key.meaning));
  }
  return text + "\n";
}

}  // namespace

std::string FileKey::name() const {
  std::string last = path.substr(path.rfind('.') + 1);
  while (last.ends_with("[]")) last.resize(last.size() - 2);
  return last;
}

std::span<const FileFormat> fileFormats() {
  static const std::vector<FileFormat> all = made();
  return all;
}

std::string filesMarkdown(std::string_view id, const TextTranslation& translation) {
  std::vector<std::string> ids;
  const std::string introduction(filesIntroduction());
  std::string text = id.empty() ? (translation ? translation(introduction) : introduction) + "\n" : std::string();
  for (const FileFormat& format : fileFormats()) {
    ids.push_back(format.id);
    if (id.empty() || id == format.id) text += markdownOf(format, translation);
  }
  if (text.empty())
    throw InputError(fmt::format("\"{}\" is not a file that Spindrift knows; allowed: {}.", id, joinedList(ids, "or")));
  return text;
}

}  // namespace spindrift
