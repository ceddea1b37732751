// SPDX-License-Identifier: GPL-3.0-or-later
// Small changes of a text for where it stands.
#pragma once

#include <QString>
#include <QStringList>
#include <string_view>

namespace spindrift::gui {

/// The first letter as a capital, unless it is a symbol: "α about X" stays.
[[nodiscard]] QString sentenceStart(QString text);
/// Blanks between a coordinate ("z 0 mm"), a number, its uncertainty and its unit, and before the unit of a title ("/
/// µm"), as blanks at which no line ends.
[[nodiscard]] QString keptTogether(QString text);
/// A unit as people write it: "um" -> "µm".
[[nodiscard]] QString unitText(std::string_view unit);
/// The same back, for files: "µm" -> "um".
[[nodiscard]] QString fileUnit(QString unit);
/// The unit behind the last " / " of a title as people write it: "EX / um" -> "EX / µm".
[[nodiscard]] QString printedTitle(const QString& title);
[[nodiscard]] QStringList printedTitles(QStringList titles);

}  // namespace spindrift::gui
