// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of tables as all pages write them: numbers at the right with a true minus sign, names in bold.
#pragma once

#include <QStringList>
#include <string>

#include "widgets/models/rows_model.h"

namespace spindrift::gui {

[[nodiscard]] Cell nameCell(const QString& text);
[[nodiscard]] Cell dashCell();
/// A number with `decimals` places, a dash if it is not finite.
[[nodiscard]] Cell numberCell(double value, int decimals);
/// "12.4 ± 0.3" without unit; a dash if the value is not finite.
[[nodiscard]] Cell quantityCell(double value, double standard_uncertainty);
/// A number as text, at the right.
[[nodiscard]] Cell rightCell(const QString& text);
[[nodiscard]] Cell toneCell(const QString& text, Tone tone);

/// Text of the core library.
[[nodiscard]] QString fromCore(const std::string& text);
/// "F1, F2 and 3 more": the first few of many names.
[[nodiscard]] QString firstOf(const QStringList& names, qsizetype most = 3);
/// "EXX_um_per_m" -> "EXX" and "µm/m".
[[nodiscard]] QString parameterTitle(const std::string& name);
/// With the symbol of ISO 230-1 where the parameter has another one: "hX (EA0S)".
[[nodiscard]] QString parameterLabel(const std::string& name);
[[nodiscard]] QString parameterUnit(const std::string& name);
/// "value ± uncertainty unit" with a dash for what is not finite.
[[nodiscard]] QString quantityText(double value, double standard_uncertainty, const QString& unit);

}  // namespace spindrift::gui
