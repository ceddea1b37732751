// SPDX-License-Identifier: Apache-2.0
// Lines that controls and instruments print, read by a pattern that a user adapts without programming.
//
// "T A{feature} X{x} Y{y}": a placeholder {name} takes a word or number, up to a blank or to the first visible
// character of what follows; blanks match any number of blanks, or none before a placeholder.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json_reader.h"

namespace spindrift {

class LinePattern {
 public:
  using Names = std::set<std::string, std::less<>>;

  /// `allowed`: names that placeholders may have; empty: any. Throws InputError at the node: a { without its }, a name
  /// that is not allowed.
  explicit LinePattern(const JsonNode& node, const Names& allowed = {});

  /// Values of the placeholders, or nothing if the line does not match.
  [[nodiscard]] std::optional<std::map<std::string, std::string>> match(std::string_view line) const;
  [[nodiscard]] bool has(std::string_view name) const;

 private:
  struct Piece {
    bool place = false;
    std::string text;  ///< literal, or name of the placeholder
  };
  std::vector<Piece> pieces_;
};

}  // namespace spindrift
