// SPDX-License-Identifier: GPL-3.0-or-later
// Written by resources/translations/update.py from the sources; do not edit.
#include "widgets/common/core_formats/groups.h"

#include <QtGlobal>

// clang-format off

std::span<const char* const> spindrift::gui::core_formats::reporting() noexcept {
  static const char* const formats[] = {
    QT_TRANSLATE_NOOP("core", "angular error of the {} axis about {}"),
    QT_TRANSLATE_NOOP("core", "column tilt about {}"),
    QT_TRANSLATE_NOOP("core", "displacement along {} at the origin of the table"),
    QT_TRANSLATE_NOOP("core", "displacement of the table along X"),
    QT_TRANSLATE_NOOP("core", "displacement of the table along Y"),
    QT_TRANSLATE_NOOP("core", "displacement of the table along Z"),
    QT_TRANSLATE_NOOP("core", "head tilt about {}"),
    QT_TRANSLATE_NOOP("core", "positioning error of the X axis per metre, from the centre of the rotary axis"),
    QT_TRANSLATE_NOOP("core", "positioning error of the {} axis"),
    QT_TRANSLATE_NOOP("core", "positioning error of the {} axis per metre"),
    QT_TRANSLATE_NOOP("core", "radial expansion of the table at the reference hole"),
    QT_TRANSLATE_NOOP("core", "roll error of the {} axis"),
    QT_TRANSLATE_NOOP("core", "rotation about {} at the origin of the table"),
    QT_TRANSLATE_NOOP("core", "rotation of the table about X"),
    QT_TRANSLATE_NOOP("core", "rotation of the table about Y"),
    QT_TRANSLATE_NOOP("core", "rotation of the table about Z"),
    QT_TRANSLATE_NOOP("core", "squareness of Y to X"),
    QT_TRANSLATE_NOOP("core", "squareness of Z to X"),
    QT_TRANSLATE_NOOP("core", "squareness of Z to Y"),
    QT_TRANSLATE_NOOP("core", "straightness error of the {} axis in the direction of {}"),
    QT_TRANSLATE_NOOP("core", "thermal displacement of the spindle along {}"),
    QT_TRANSLATE_NOOP("core", "thermal expansion along {} over the table"),
    QT_TRANSLATE_NOOP("core", "thermal expansion of the artefact per metre, from its reference hole"),
    QT_TRANSLATE_NOOP("core", "thermal expansion of the {} ball screw from its fixed bearing"),
  };
  return formats;
}
