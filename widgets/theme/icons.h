// SPDX-License-Identifier: GPL-3.0-or-later
// Line icons (resources/icons, own drawings, 24 x 24, stroke "currentColor"), tinted when they are drawn.
#pragma once

#include <QColor>
#include <QIcon>
#include <QPixmap>
#include <QString>

class QAbstractButton;

namespace spindrift::gui {

/// Icon in the text colour of the theme in use at the time of drawing (disabled: text_disabled).
[[nodiscard]] QIcon icon(const char* name);
/// Icon in a fixed colour.
[[nodiscard]] QIcon icon(const char* name, const QColor& colour);
/// The icon of a button in the colour of texts on the accent, or in that of other texts again. Buttons without one of
/// these icons stay as they are.
void drawIconOnAccent(QAbstractButton& button, bool on_accent);
/// A pixmap of `size` device-independent pixels.
[[nodiscard]] QPixmap iconPixmap(const QString& name, const QColor& colour, int size, double device_pixel_ratio);
/// The program's own icon.
[[nodiscard]] QIcon applicationIcon();

}  // namespace spindrift::gui
