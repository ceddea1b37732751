// SPDX-License-Identifier: Apache-2.0
// Numbers and lists as people read them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// "12.4 ± 0.3 um": digits follow the uncertainty (two significant digits if its first digit is 1 or 2, else one), true
/// minus sign. Without a usable uncertainty (not finite or <= 0): six significant digits of the value alone.
[[nodiscard]] std::string withUncertainty(double value, double standard_uncertainty, std::string_view unit);

/// "p = 0.51", "p = 6 × 10⁻⁴", and "p < 10⁻¹²" where the model of the noise says no more than that.
[[nodiscard]] std::string pValueText(double p_value);

/// The same without its name: "0.004", "3 × 10⁻⁵", "< 10⁻¹²"; a dash where it is not finite.
[[nodiscard]] std::string probabilityText(double p);

/// A number for a file: shortest text that reads back to the same double, C locale.
[[nodiscard]] std::string exactNumber(double value);

/// "F1, F2 and F3".
[[nodiscard]] std::string joinedList(std::span<const std::string> items, std::string_view last_word = "and");

/// The same of many items: all up to `all_up_to`, else the first `shown` and how many more: "F1, F2 and 12 more".
[[nodiscard]] std::string shortenedList(std::span<const std::string> items, std::size_t all_up_to = 8,
                                        std::size_t shown = 5);

/// Splits at `separator`, trims blanks, drops empty parts: "F1, F2" -> {"F1", "F2"}.
[[nodiscard]] std::vector<std::string> splitList(std::string_view text, char separator = ',');

/// Letters A to Z in lower case, everything else as it is.
[[nodiscard]] std::string lowerCase(std::string text);

[[nodiscard]] std::string_view trimmed(std::string_view text) noexcept;

/// A finite number that fills the whole text (C locale), or nothing.
[[nodiscard]] bool parseNumber(std::string_view text, double& value) noexcept;

/// Escapes &, <, > and quotes for HTML and SVG.
[[nodiscard]] std::string escapedXml(std::string_view text);

}  // namespace spindrift
