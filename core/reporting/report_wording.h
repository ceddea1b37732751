// SPDX-License-Identifier: Apache-2.0
// How a report writes what files and messages of the program write in ASCII: units with their signs, effects by their
// titles, moments as people read them. Drivers, signals and parameters: core/machine/driver_words.h.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/machine/component.h"
#include "core/reporting/report.h"

namespace spindrift {

/// "µm" or "µrad".
[[nodiscard]] std::string printedUnitOf(Component component);

/// Every id of the catalogue of effects by its title, with the id small beside it; the titles in other words where
/// there are such.
[[nodiscard]] ReportText withEffectTitles(std::string_view text,
                                          const std::function<std::string(const std::string&)>& words = {});
/// The title of one effect with a capital, its id small beside it.
[[nodiscard]] ReportText effectHeading(std::string_view id, std::string_view own_title = {});

/// "alpha_X_um_per_m" -> "alpha_X / µm/m"; a name without a known unit stays. For tables and axes.
[[nodiscard]] std::string titleWithUnit(const std::string& name);

/// "2026-03-02T07:00:00Z" -> "2026-03-02 07:00 UTC"; another text stays.
[[nodiscard]] std::string utcInWords(std::string_view utc);

}  // namespace spindrift
