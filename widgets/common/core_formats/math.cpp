// SPDX-License-Identifier: GPL-3.0-or-later
// Written by resources/translations/update.py from the sources; do not edit.
#include "widgets/common/core_formats/groups.h"

#include <QtGlobal>

// clang-format off

std::span<const char* const> spindrift::gui::core_formats::math() noexcept {
  static const char* const formats[] = {
    QT_TRANSLATE_NOOP("core", "all parameters are determined"),
    QT_TRANSLATE_NOOP("core", "expression \"{}\" assigns a value or holds text; allowed: an expression in {} that has one value."),
    QT_TRANSLATE_NOOP("core", "expression \"{}\" cannot be read ({}); allowed: an expression in {}."),
    QT_TRANSLATE_NOOP("core", "expression \"{}\" has {} values; allowed: one (a comma separates values, it is not a decimal point)."),
    QT_TRANSLATE_NOOP("core", "expression \"{}\" holds \"{}\" at character {}, which is not a variable or function; allowed: {}."),
    QT_TRANSLATE_NOOP("core", "is an empty expression; allowed: an expression in {}."),
    QT_TRANSLATE_NOOP("core", "the covariance of the observations is not positive definite"),
    QT_TRANSLATE_NOOP("core", "{} parameters cannot be determined"),
    QT_TRANSLATE_NOOP("core", "{}, _pi, _e and the functions of muParser"),
  };
  return formats;
}
