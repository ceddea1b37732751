// SPDX-License-Identifier: GPL-3.0-or-later
// Line icons (resources/icons, own drawings, 24 x 24, stroke "currentColor"), tinted when they are drawn.
#pragma once

#include <QColor>
#include <QIcon>
#include <QPixmap>
#include <QString>

namespace spindrift::gui {

/// Icon in the text colour of the theme in use at the time of drawing (disabled: text_disabled).
[[nodiscard]] QIcon icon(const char* name);
/// Icon in a fixed colour.
[[nodiscard]] QIcon icon(const char* name, const QColor& colour);
/// A pixmap of `size` device-independent pixels.
[[nodiscard]] QPixmap iconPixmap(const QString& name, const QColor& colour, int size, double device_pixel_ratio);
/// The program's own icon.
[[nodiscard]] QIcon applicationIcon();

}  // namespace spindrift::gui
