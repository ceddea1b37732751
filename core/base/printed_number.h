// SPDX-License-Identifier: Apache-2.0
// Numbers in what is printed for people: true minus sign, no sign before a zero, powers of ten in place of 1e-06.
// For files and JSON there is exactNumber (text.h).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace spindrift {

/// A number to be printed; formats as double does: `fmt::format("{:>10.2f} µm", printed(x))`.
struct PrintedNumber {
  double value = 0.0;
};

[[nodiscard]] constexpr PrintedNumber printed(double value) noexcept {
  return {value};
}

/// `digits` is what {fmt} calls precision and type (".2f", "g", ".3g"): "−0.25", "0.00", "3 × 10⁻⁷", "10⁶"; with
/// `plus` "+0.25", but "0.00". A dash where the value is not finite.
[[nodiscard]] std::string printedNumber(double value, std::string_view digits, bool plus = false);

}  // namespace spindrift

namespace fmt {

/// [<|>][+][width][.precision][f|g]; the width counts characters, and numbers stand at its right unless it begins with
/// "<".
template <>
struct formatter<spindrift::PrintedNumber> {
  constexpr auto parse(fmt::format_parse_context& context) {
    auto at = context.begin();
    const auto end = context.end();
    if (at != end && (*at == '<' || *at == '>')) left_ = *at++ == '<';
    if (at != end && *at == '+') {
      plus_ = true;
      ++at;
    }
    for (; at != end && *at >= '0' && *at <= '9'; ++at) width_ = 10 * width_ + static_cast<std::size_t>(*at - '0');
    const auto digits = at;
    while (at != end && *at != '}') {
      if (*at == '{' || *at == '<' || *at == '>' || *at == '^') throw fmt::format_error("not a format of a number");
      ++at;
    }
    digits_ = std::string_view(digits, static_cast<std::size_t>(at - digits));
    return at;
  }

  template <typename Context>
  auto format(const spindrift::PrintedNumber& number, Context& context) const {
    const std::string text = spindrift::printedNumber(number.value, digits_, plus_);
    const auto starts = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
    const auto length = static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts));
    const std::string blanks(length < width_ ? width_ - length : 0, ' ');
    // Not fmt::format_to: every user would compile the formatter of every type once more.
    auto out = std::copy_n((left_ ? text : blanks).begin(), (left_ ? text : blanks).size(), context.out());
    return std::copy_n((left_ ? blanks : text).begin(), (left_ ? blanks : text).size(), out);
  }

 private:
  std::string_view digits_;  ///< of the format, which outlives its use
  std::size_t width_ = 0;
  bool left_ = false;
  bool plus_ = false;
};

}  // namespace fmt
