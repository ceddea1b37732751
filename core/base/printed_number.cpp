// SPDX-License-Identifier: Apache-2.0
#include "core/base/printed_number.h"

#include <array>
#include <cmath>

namespace spindrift {
namespace {

std::string powerOfTen(std::string_view exponent) {
  constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  if (exponent.starts_with('-')) text += "⁻";
  exponent.remove_prefix(std::min(exponent.find_first_not_of("+-0"), exponent.size()));
  for (const char digit : exponent) text += raised[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace

std::string printedNumber(double value, std::string_view digits, bool plus) {
  if (!std::isfinite(value)) return "–";
  std::string text = fmt::format(fmt::runtime(fmt::format("{{:{}}}", digits)), std::abs(value));
  const std::size_t exponent = text.find('e');
  const bool zero = text.substr(0, exponent).find_first_of("123456789") == std::string::npos;
  if (exponent != std::string::npos) {
    const std::string mantissa = text.substr(0, exponent);
    text = (mantissa == "1" ? std::string() : mantissa + " × ") + powerOfTen(text.substr(exponent + 1));
  }
  if (zero) return text;
  if (value < 0.0) return "−" + text;
  return plus ? "+" + text : text;
}

}  // namespace spindrift
