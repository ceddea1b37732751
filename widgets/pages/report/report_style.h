// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes, colours and fonts of a printed page, px of a page of A4 at 96 dpi. A page is not of the theme: always ink on
// white.
#pragma once

#include <QColor>
#include <QFont>

#include "widgets/theme/fonts.h"

namespace spindrift::gui::report_style {

inline constexpr int page_width = 794;
inline constexpr int page_height = 1123;
inline constexpr int side_margin = 68;  // 18 mm
inline constexpr int top_margin = 76;
inline constexpr int bottom_margin = 84;
inline constexpr int text_width = page_width - 2 * side_margin;
inline constexpr int text_height = page_height - top_margin - bottom_margin;
inline constexpr int text_px = 12;
inline constexpr int small_px = 10;

inline const QColor ink(0x1f, 0x29, 0x33);
inline const QColor soft(0x52, 0x60, 0x6d);
inline const QColor line_colour(0xd9, 0xde, 0xe4);
inline const QColor accent(0x0b, 0x72, 0x85);

[[nodiscard]] inline QFont pageFont(int px, QFont::Weight weight = QFont::Normal) {
  QFont font = printFont(px, weight);
  font.setHintingPreference(QFont::PreferNoHinting);
  return font;
}

}  // namespace spindrift::gui::report_style
