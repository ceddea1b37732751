// SPDX-License-Identifier: Apache-2.0
#include "core/base/line_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/base/text.h"

namespace spindrift {
namespace {

bool isBlank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

LinePattern::LinePattern(const JsonNode& node, const Names& allowed) {
  const std::string pattern = node.name();
  std::size_t i = 0;
  while (i < pattern.size()) {
    if (pattern[i] == '{') {
      const std::size_t close = pattern.find('}', i);
      if (close == std::string::npos) node.reject("a pattern in which every { has its }");
      Piece piece{true, pattern.substr(i + 1, close - i - 1)};
      if (!allowed.empty() && !allowed.contains(piece.text)) {
        const std::vector<std::string> names(allowed.begin(), allowed.end());
        throw InputError(node.place(),
                         fmt::format("place {{{}}} is not known; allowed: {}.", piece.text, joinedList(names, "or")));
      }
      pieces_.push_back(piece);
      i = close + 1;
    } else {
      const std::size_t open = std::min(pattern.find('{', i), pattern.size());
      pieces_.push_back({false, pattern.substr(i, open - i)});
      i = open;
    }
  }
}

std::optional<std::map<std::string, std::string>> LinePattern::match(std::string_view line) const {
  std::map<std::string, std::string> values;
  std::size_t at = 0;
  const auto skipBlanks = [&] {
    while (at < line.size() && isBlank(line[at])) ++at;
  };
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    if (!pieces_[p].place) {
      for (const char c : pieces_[p].text) {
        if (isBlank(c)) {
          skipBlanks();
          continue;
        }
        if (at >= line.size() || line[at] != c) {
          skipBlanks();  // controls pad fields with blanks
          if (at >= line.size() || line[at] != c) return std::nullopt;
        }
        ++at;
      }
      continue;
    }
    skipBlanks();
    // Up to a blank or to the first visible character of the next literal.
    char stop = '\0';
    if (p + 1 < pieces_.size()) {
      for (const char c : pieces_[p + 1].text) {
        if (!isBlank(c)) {
          stop = c;
          break;
        }
        break;
      }
    }
    std::size_t end = at;
    while (end < line.size() && !isBlank(line[end]) && !(stop != '\0' && line[end] == stop)) ++end;
    if (end == at) return std::nullopt;
    values[pieces_[p].text] = std::string(line.substr(at, end - at));
    at = end;
  }
  skipBlanks();
  return at == line.size() ? std::optional(values) : std::nullopt;
}

bool LinePattern::has(std::string_view name) const {
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return p.place && p.text == name; });
}

}  // namespace spindrift
