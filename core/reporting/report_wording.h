// SPDX-License-Identifier: Apache-2.0
// How a report writes what files and messages of the program write in ASCII: units with their signs, effects by their
// titles, signals and parameters as words with a unit, moments and probabilities as people read them.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// "-3.2 um, 5 urad at 20 degC" -> "−3.2 µm, 5 µrad at 20 °C"; whole words only, so that names of columns stay, and the
/// signs of numbers only, so that dates and ranges stay.
[[nodiscard]] std::string printedUnits(std::string_view text);

/// The same for the texts of a drawing; its elements, attributes and embedded pictures stay.
[[nodiscard]] std::string printedUnitsOfDrawing(std::string_view svg);

/// Marks a text to be set small and soft by HtmlDocument. Without marks it is read as plain text.
[[nodiscard]] std::string smallPrint(std::string_view text);
/// Takes the marks of smallPrint away.
[[nodiscard]] std::string withoutSmallPrint(std::string_view text);

/// Every id of the catalogue of effects by its title, with the id small beside it.
[[nodiscard]] std::string withEffectTitles(std::string_view text);
/// The title of one effect with a capital, its id small beside it.
[[nodiscard]] std::string effectHeading(std::string_view id, std::string_view own_title = {});

/// "gain_um_per_m2_per_K" -> "gain / um/(m² K)", "tau_on_s" -> "time constant on / s": parameters of effects.
[[nodiscard]] std::string parameterTitle(std::string_view name);

/// "alpha_X_um_per_m" -> "alpha_X / um/m"; a name without a known unit stays. For tables and axes.
[[nodiscard]] std::string titleWithUnit(const std::string& name);

/// A column of a log in words: "feed_x_mm_min" -> {"feed X", "mm/min"}, "T_column_front_degC" -> {"column front",
/// "degC"}.
struct SignalTitle {
  std::string name;
  std::string unit;
};
[[nodiscard]] SignalTitle signalTitle(std::string_view column);

/// What drives an effect, in words: "feed_x (lag 2400 s)" -> "feed X (lag 40 min)".
[[nodiscard]] std::string driversInWords(std::string_view drivers);

/// "45 s", "40 min", "2.5 h".
[[nodiscard]] std::string spanOfTime(double seconds);

/// "2026-03-02T07:00:00Z" -> "2026-03-02 07:00 UTC"; another text stays.
[[nodiscard]] std::string utcInWords(std::string_view utc);

/// "0.004", "3 × 10⁻⁵", "< 10⁻¹²".
[[nodiscard]] std::string probabilityInWords(double p);

/// "ball_screw" -> "ball screw".
[[nodiscard]] std::string words(std::string_view key);

}  // namespace spindrift
