// SPDX-License-Identifier: Apache-2.0
// The order in which people list names with numbers in them: F2 before F10.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace spindrift {

/// Compares names part by part, runs of digits by their value, everything else byte by byte. Names of equal parts
/// ("F1", "F01") stand in the order of their bytes, so that names that differ are never equal. For maps whose keys are
/// listed.
struct NaturalOrder {
  [[nodiscard]] static int compare(std::string_view a, std::string_view b) noexcept {
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
      if (digit(a[i]) && digit(b[j])) {
        // Without leading zeros the longer number is the larger one, whatever its size.
        while (i + 1 < a.size() && a[i] == '0' && digit(a[i + 1])) ++i;
        while (j + 1 < b.size() && b[j] == '0' && digit(b[j + 1])) ++j;
        std::size_t i_end = i, j_end = j;
        while (i_end < a.size() && digit(a[i_end])) ++i_end;
        while (j_end < b.size() && digit(b[j_end])) ++j_end;
        if (i_end - i != j_end - j) return i_end - i < j_end - j ? -1 : 1;
        if (const int order = a.substr(i, i_end - i).compare(b.substr(j, j_end - j)); order != 0) return order;
        i = i_end;
        j = j_end;
      } else if (a[i] != b[j]) {
        return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]) ? -1 : 1;
      } else {
        ++i;
        ++j;
      }
    }
    if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j ? -1 : 1;
    return a.compare(b);
  }
  [[nodiscard]] bool operator()(std::string_view a, std::string_view b) const noexcept { return compare(a, b) < 0; }
  /// A name and what belongs to it, such as its component.
  template <class T>
  [[nodiscard]] bool operator()(const std::pair<std::string, T>& a, const std::pair<std::string, T>& b) const {
    const int order = compare(a.first, b.first);
    return order != 0 ? order < 0 : a.second < b.second;
  }
};

}  // namespace spindrift
