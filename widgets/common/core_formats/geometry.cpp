// SPDX-License-Identifier: GPL-3.0-or-later
// Written by resources/translations/update.py from the sources; do not edit.
#include "widgets/common/core_formats/groups.h"

#include <QtGlobal>

// clang-format off

std::span<const char* const> spindrift::gui::core_formats::geometry() noexcept {
  static const char* const formats[] = {
    QT_TRANSLATE_NOOP("core", "its centre along {} is open"),
    QT_TRANSLATE_NOOP("core", "its radius and its centre along {} are open together"),
    QT_TRANSLATE_NOOP("core", "its radius is open"),
    QT_TRANSLATE_NOOP("core", "of known radius"),
    QT_TRANSLATE_NOOP("core", "the iteration did not settle"),
    QT_TRANSLATE_NOOP("core", "the points contradict a {} by {:.4f} mm and no single one of them is to blame"),
    QT_TRANSLATE_NOOP("core", "the points do not determine the line: no direction has more spread than the others"),
    QT_TRANSLATE_NOOP("core", "the points do not determine the plane: they have no spread along {}"),
    QT_TRANSLATE_NOOP("core", "the points do not determine the {}: {}"),
    QT_TRANSLATE_NOOP("core", "{} too few for a line; allowed: at least 2"),
    QT_TRANSLATE_NOOP("core", "{} too few for a plane; allowed: at least 3"),
    QT_TRANSLATE_NOOP("core", "{} too few for a {}{}; allowed: at least {}"),
  };
  return formats;
}
