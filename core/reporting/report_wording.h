// SPDX-License-Identifier: Apache-2.0
// How a report writes what files and messages of the program write in ASCII: units with their signs, effects by their
// titles, signals and parameters as words with a unit, moments and probabilities as people read them.
#pragma once

#include <string>
#include <string_view>

#include "core/machine/component.h"
#include "core/reporting/report.h"

namespace spindrift {

/// "µm" or "µrad".
[[nodiscard]] std::string printedUnitOf(Component component);

/// Every id of the catalogue of effects by its title, with the id small beside it.
[[nodiscard]] ReportText withEffectTitles(std::string_view text);
/// The title of one effect with a capital, its id small beside it.
[[nodiscard]] ReportText effectHeading(std::string_view id, std::string_view own_title = {});

/// "gain_um_per_m2_per_K" -> "gain / µm/(m² K)", "tau_on_s" -> "time constant on / s": parameters of effects.
[[nodiscard]] std::string parameterTitle(std::string_view name);

/// "alpha_X_um_per_m" -> "alpha_X / µm/m"; a name without a known unit stays. For tables and axes.
[[nodiscard]] std::string titleWithUnit(const std::string& name);

/// A column of a log in words: "feed_x_mm_min" -> {"feed X", "mm/min"}, "T_column_front_degC" -> {"column front",
/// "°C"}.
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

/// "ball_screw" -> "ball screw".
[[nodiscard]] std::string words(std::string_view key);

}  // namespace spindrift
