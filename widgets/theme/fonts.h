// SPDX-License-Identifier: GPL-3.0-or-later
// One sans family with tabular figures.
#pragma once

#include <QByteArray>
#include <QFont>

namespace spindrift::gui {

/// Inter with tabular figures where the Debian package fonts-inter is installed, else the system's sans serif.
[[nodiscard]] QFont bodyFont();
/// The body font at another size (pixels) and weight.
[[nodiscard]] QFont textFont(int pixel_size, QFont::Weight weight = QFont::Normal);

/// For printed pages: a font whose figures can be found and copied in a PDF. Those of the body font are replaced
/// glyphs, which no longer say which characters they are.
[[nodiscard]] QFont printFont(int pixel_size, QFont::Weight weight = QFont::Normal);

/// Qt 6.4 cannot switch font features on. This turns the OpenType feature "tnum" (figures of equal width) into one that
/// is always on, and renames the family so that it does not meet the installed one. Empty if `font` is no such font.
[[nodiscard]] QByteArray withTabularFigures(QByteArray font, const QByteArray& family_of_five_letters);

}  // namespace spindrift::gui
