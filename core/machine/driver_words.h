// SPDX-License-Identifier: Apache-2.0
// What people call the columns of a log, the drivers made from them and how effects follow them, and the symbols of a
// formula: one table for window, reports, manual and command line. Files and JSON keep the names (drivers.h).
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// A fixed English text, "%1" in it for an axis or a place, in another language. None: English.
using TextTranslation = std::function<std::string(std::string_view english)>;

/// A column of a log in words: "feed_x_mm_min" -> {"feed X", "mm/min"}, "T_column_front_degC" -> {"column front",
/// "°C"}.
struct SignalTitle {
  std::string name;
  std::string unit;
};
[[nodiscard]] SignalTitle signalTitle(std::string_view column);

/// What drives an effect, in words: "feed_x^2 (time constant 2400 s)" -> "feed X² (time constant 40 min)". Words that
/// are no driver stay.
[[nodiscard]] std::string driversInWords(std::string_view drivers, const TextTranslation& translation = {});
/// Alternatives in words, each of one or more inputs that act together: "spindle speed or feed X + feed Y".
[[nodiscard]] std::string driversInWords(const std::vector<std::vector<std::string>>& alternatives,
                                         const TextTranslation& translation = {});

/// How q(t) follows its driver: "lag" -> "first-order time constant". The word of a file (toString(Dynamics)).
[[nodiscard]] std::string_view dynamicsInWords(std::string_view dynamics);

/// A formula of a shape in symbols: "ez = -g q (z - z0)^2" -> "EZ = −g q (z − z₀)²".
[[nodiscard]] std::string formulaInSymbols(std::string_view formula);

/// Unit of a gain: "um_per_m2" -> "µm/m²", "um_per_m_lift" -> "µm/m"; one that is written with signs ("um/mm") too.
[[nodiscard]] std::string gainUnit(std::string_view unit);

/// "gain_um_per_m2_per_K" -> "gain / (µm/(m² K))", "tau_on_s" -> "time constant on / s": parameters of effects.
[[nodiscard]] std::string parameterTitle(std::string_view name);

/// "45 s", "40 min", "2.5 h".
[[nodiscard]] std::string spanOfTime(double seconds);

/// "ball_screw" -> "ball screw".
[[nodiscard]] std::string words(std::string_view key);

}  // namespace spindrift
