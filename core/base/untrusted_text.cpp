// SPDX-License-Identifier: Apache-2.0
#include "core/base/untrusted_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace spindrift {

std::size_t firstInvalidUtf8(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  for (std::size_t i = 0; i < text.size();) {
    // ASCII, eight bytes at a time.
    std::uint64_t eight = 0;
    while (text.size() - i >= sizeof eight) {
      std::memcpy(&eight, text.data() + i, sizeof eight);
      if ((eight & 0x8080808080808080U) != 0) break;
      i += sizeof eight;
    }
    if (i == text.size()) break;
    const unsigned lead = byte(i);
    const std::size_t length = lead < 0x80                    ? 1
                               : lead >= 0xC2 && lead <= 0xDF ? 2
                               : lead >= 0xE0 && lead <= 0xEF ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    if (length == 0 || length > text.size() - i) return i;
    for (std::size_t k = 1; k < length; ++k)
      if ((byte(i + k) & 0xC0U) != 0x80U) return i;
    // No overlong forms, no surrogates, nothing above U+10FFFF.
    if ((lead == 0xE0 && byte(i + 1) < 0xA0) || (lead == 0xED && byte(i + 1) > 0x9F) ||
        (lead == 0xF0 && byte(i + 1) < 0x90) || (lead == 0xF4 && byte(i + 1) > 0x8F))
      return i;
    i += length;
  }
  return std::string_view::npos;
}

namespace {

/// U+202A to U+202E and U+2066 to U+2069: what stands behind one of them is read in another direction.
bool turnsText(std::string_view three) {
  if (three.size() < 3 || three[0] != '\xE2') return false;
  return (three[1] == '\x80' && three[2] >= '\xAA' && three[2] <= '\xAE') ||
         (three[1] == '\x81' && three[2] >= '\xA6' && three[2] <= '\xA9');
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t good = std::min(firstInvalidUtf8(text), text.size());
    for (std::size_t i = 0; i < good; ++i) {
      const auto byte = static_cast<unsigned char>(text[i]);
      if (turnsText(text.substr(i, 3))) {
        out += "\uFFFD";
        i += 2;
      } else {
        out += byte < 0x20 || byte == 0x7F ? ' ' : text[i];
      }
    }
    text.remove_prefix(good);
    if (text.empty()) break;
    out += "\uFFFD";
    text.remove_prefix(1);
  }
  return out;
}

std::string nameAsText(std::string_view name) {
  std::string out;
  const auto escape = [&](char c) { out += fmt::format("\\x{:02X}", static_cast<unsigned char>(c)); };
  for (;;) {
    const std::size_t good = std::min(firstInvalidUtf8(name), name.size());
    for (std::size_t i = 0; i < good; ++i) {
      if (name[i] == '\\' && i + 1 < name.size() && name[i + 1] == 'x') {
        escape(name[i]);
      } else {
        out += name[i];
      }
    }
    name.remove_prefix(good);
    if (name.empty()) return out;
    escape(name.front());
    name.remove_prefix(1);
  }
}

std::string_view beginning(std::string_view text, std::size_t bytes) noexcept {
  if (text.size() <= bytes) return text;
  for (std::size_t back = 0; back < 3 && bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U;
       ++back)
    --bytes;
  return text.substr(0, bytes);
}

std::size_t deepestJson(std::string_view json) noexcept {
  std::size_t depth = 0;
  std::size_t deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text) {
      if (c == '\\') ++i;
      if (c == '"') in_text = false;
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

}  // namespace spindrift
