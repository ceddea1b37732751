// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers on screen as the language of the window writes them ("12,3" in German), and numbers that people type, with a
// point or a comma. Never for files: those are written by core, with a point.
#pragma once

#include <QString>
#include <optional>

namespace spindrift::gui {

/// A number in the format of printf ('f', 'g', 'e'), in the locale of the window and with a true minus sign.
[[nodiscard]] QString decimalText(double value, char format = 'f', int digits = 1);

/// A text of core with numbers in it ("12.4 ± 0.3 µm"): its decimal points as the window writes them, its minus
/// signs true ones. Names, versions
/// and paths stay as they are.
[[nodiscard]] QString shownNumbers(QString text);

/// What a person has typed: "12.3" and "12,3" are the same number. Nothing if it is no finite number.
[[nodiscard]] std::optional<double> typedNumber(const QString& text);

/// A cell of a table as a file holds it: where it is nothing but a number or "12,4 ± 0,3", with points.
[[nodiscard]] QString plainNumbers(const QString& text);

/// The largest of 1, 2 and 5 times a power of ten that is not above `value`, and the smallest that is not below it: for
/// scales and exaggerations. Both are of positive numbers.
[[nodiscard]] double roundedDown(double value);
[[nodiscard]] double roundStep(double at_least);

/// By how much to draw lengths in um so that the largest has the length `shown_mm` in the picture at most; 1000 where
/// there is nothing to be drawn.
[[nodiscard]] double exaggerationFor(double shown_mm, double largest_um);

}  // namespace spindrift::gui
