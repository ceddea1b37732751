// SPDX-License-Identifier: GPL-3.0-or-later
// What people call the effects of the catalogue, and the numbers of a discrepancy as they are written on the pages.
#pragma once

#include <QPixmap>
#include <QString>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/machine/component.h"

class QTableView;

namespace spindrift::gui {

/// "ball_screw.expansion.y" -> "thermal expansion of the Y ball screw". An id that is not known stays as it is.
[[nodiscard]] QString effectTitle(const std::string& id);
/// From now on effects of the user's go by the titles that they have in `document` (effects.json); null: there are
/// none. GUI thread.
void knowOwnTitles(const nlohmann::json& document);
/// "ball_screw" -> "Ball screws": what an id begins with.
[[nodiscard]] QString familyTitle(const std::string& family);
/// "head.tilt.a or frame.rotation.a" by their titles.
[[nodiscard]] QString effectTitles(const std::vector<std::string>& ids, const QString& last_word);
/// A sentence of the search with every id of the catalogue by its title.
[[nodiscard]] QString titledSentence(const std::string& sentence);

/// What drives an effect, in words: "feed_x^2 (time constant 2400 s)" -> "feed X² (time constant 40 min)".
[[nodiscard]] QString driverWords(const std::string& drivers);
/// The alternatives that may drive it: "spindle speed or temperature of bearing".
[[nodiscard]] QString driverWords(const std::vector<std::vector<std::string>>& alternatives);
/// A formula in symbols: "ez = g q (z - z0)" -> "EZ = g q (z − z₀)".
[[nodiscard]] QString formulaText(const std::string& formula);

/// A size with two or three digits and its unit as people write it (um as µm); "–" if it is not finite.
[[nodiscard]] QString sizeText(double value, const QString& unit);
/// "3×10⁻⁵", "< 10⁻¹²", "0.004".
[[nodiscard]] QString probabilityText(double p);
/// "97 %", "< 1 %".
[[nodiscard]] QString percentOf(double probability);
/// A lying bar, 40 x 8 px, filled up to a probability: for a cell of a table.
[[nodiscard]] QPixmap probabilityBar(double probability, double device_pixel_ratio);
/// "1.24 ± 0.05 µm"; without a usable uncertainty the value alone.
[[nodiscard]] QString withError(double value, double standard_uncertainty, const QString& unit);
/// "0.80 µm rms in EX and 0.31 µm rms in EZ": where something clearly remains; empty if nowhere.
[[nodiscard]] QString remainderText(const std::vector<ComponentRemainder>& remainder);
/// "0.0–6.0 h", in the unit that suits the whole of it.
[[nodiscard]] QString spanText(double from_s, double to_s, double whole_s);
/// "1:37", hours and minutes.
[[nodiscard]] QString clockText(double time_s);
/// "all 10", "F1, F2", "7 of 10".
[[nodiscard]] QString pointsText(const std::vector<std::string>& points, std::size_t all);
/// Unit of a gain as people write it: "um_per_m" -> "µm/m", "um_x" -> "µm".
[[nodiscard]] QString gainUnitText(const std::string& unit);
[[nodiscard]] QString componentName(Component component);
[[nodiscard]] QString componentUnit(Component component);

/// Names of series with a dot in the colour of each (index into Theme::series), as rich text for a label.
[[nodiscard]] QString legendText(const std::vector<std::pair<int, QString>>& names);

/// Columns as wide as their content, one takes what is left (its texts are shortened): no horizontal scrolling.
void stretchColumn(QTableView* table, int column);

}  // namespace spindrift::gui
