// SPDX-License-Identifier: Apache-2.0
#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/base/printed_number.h"
#include "core/base/unit_text.h"

namespace spindrift {
namespace {

std::string withMinusSign(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

}  // namespace

std::string withUncertainty(double value, double standard_uncertainty, std::string_view unit) {
  std::string text;
  if (!std::isfinite(value) || std::isinf(standard_uncertainty)) {
    text = "not determined";
    return text;
  }
  if (std::isfinite(standard_uncertainty) && standard_uncertainty > 0.0) {
    const double exponent = std::floor(std::log10(standard_uncertainty));
    const double leading = standard_uncertainty / std::pow(10.0, exponent);
    const int significant = leading < 2.95 ? 2 : 1;
    const int last_digit = static_cast<int>(-exponent) + significant - 1;
    const int decimals = std::clamp(last_digit, 0, 12);
    // From 30 on no digit stands behind the point, and those before it are rounded as far.
    const double step = last_digit < 0 ? std::pow(10.0, -last_digit) : 1.0;
    const auto digits = [&](double x) {
      return last_digit < 0 ? fmt::format("{:.0f}", std::round(x / step) * step) : fmt::format("{:.{}f}", x, decimals);
    };
    std::string rounded = digits(value);
    if (rounded.starts_with('-') && rounded.find_first_not_of("-0.") == std::string::npos) rounded.erase(0, 1);
    text = withMinusSign(rounded) + " \u00b1 " + digits(standard_uncertainty);
  } else {
    text = withMinusSign(fmt::format("{:.6g}", value));
  }
  if (!unit.empty()) text += " " + printedUnit(unit);
  return text;
}

std::string pValueText(double p_value) {
  if (!std::isfinite(p_value)) return "p not determined";
  const std::string text = probabilityText(p_value);
  return (text.starts_with('<') ? "p " : "p = ") + text;
}

std::string probabilityText(double p) {
  constexpr double smallest = 1e-12;  // what a model of the noise says beyond it is nothing
  if (!std::isfinite(p)) return "–";
  if (p < smallest) return "< " + printedNumber(smallest, "g");
  if (p >= 0.001) return fmt::format("{:.2g}", p);
  const std::string text = printedNumber(p, ".0e");
  return text.starts_with("10⁻") ? "1 × " + text : text;
}

std::string exactNumber(double value) {
  if (value == 0.0) return "0";  // never -0
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, result.ptr};
}

std::string joinedList(std::span<const std::string> items, std::string_view last_word) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? fmt::format(" {} ", last_word) : std::string(", ");
    text += items[i];
  }
  return text;
}

std::string shortenedList(std::span<const std::string> items, std::size_t all_up_to, std::size_t shown) {
  if (items.size() <= all_up_to) return joinedList(items);
  std::vector<std::string> some(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(shown));
  some.push_back(fmt::format("{} more", items.size() - shown));
  return joinedList(some);
}

std::vector<std::string> splitList(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    const std::string_view part = trimmed(text.substr(0, end));
    if (!part.empty()) parts.emplace_back(part);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return parts;
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string_view trimmed(std::string_view text) noexcept {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool parseNumber(std::string_view text, double& value) noexcept {
  text = trimmed(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  if (text.empty()) return false;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && result.ptr == text.data() + text.size() && std::isfinite(value);
}

std::string escapedXml(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace spindrift
