// SPDX-License-Identifier: GPL-3.0-or-later
// Written by resources/translations/update.py from the sources; do not edit.
#include "widgets/common/core_formats/groups.h"

#include <QtGlobal>

// clang-format off

std::span<const char* const> spindrift::gui::core_formats::base() noexcept {
  static const char* const formats[] = {
    QT_TRANSLATE_NOOP("core", "(numbers seem to be written with a decimal comma)"),
    QT_TRANSLATE_NOOP("core", "A part of this installation cannot be loaded ({}); install Spindrift again."),
    QT_TRANSLATE_NOOP("core", "\"{}\" is not a number; allowed: a finite number with a decimal point."),
    QT_TRANSLATE_NOOP("core", "\"{}\" {}; allowed: a file inside the folder, given relative to it."),
    QT_TRANSLATE_NOOP("core", "a column has no name; allowed: one name per column."),
    QT_TRANSLATE_NOOP("core", "a finite number"),
    QT_TRANSLATE_NOOP("core", "a list"),
    QT_TRANSLATE_NOOP("core", "a list of three numbers"),
    QT_TRANSLATE_NOOP("core", "a number"),
    QT_TRANSLATE_NOOP("core", "a number greater than zero"),
    QT_TRANSLATE_NOOP("core", "a number that is not negative"),
    QT_TRANSLATE_NOOP("core", "a pattern in which every { has its }"),
    QT_TRANSLATE_NOOP("core", "a quoted field is not closed; allowed: a second double quote."),
    QT_TRANSLATE_NOOP("core", "a text"),
    QT_TRANSLATE_NOOP("core", "a text that is not empty"),
    QT_TRANSLATE_NOOP("core", "a version from 1 to {} (a newer file needs a newer program)"),
    QT_TRANSLATE_NOOP("core", "a whole number"),
    QT_TRANSLATE_NOOP("core", "an object"),
    QT_TRANSLATE_NOOP("core", "cannot be read: {}."),
    QT_TRANSLATE_NOOP("core", "cannot be written: {}."),
    QT_TRANSLATE_NOOP("core", "column \"{}\" appears twice; allowed: each name once."),
    QT_TRANSLATE_NOOP("core", "column \"{}\" is missing; found: {}."),
    QT_TRANSLATE_NOOP("core", "column {}"),
    QT_TRANSLATE_NOOP("core", "gives more bytes than are allowed; allowed: at most {}."),
    QT_TRANSLATE_NOOP("core", "holds lists or objects more than {} deep in each other; allowed: at most that."),
    QT_TRANSLATE_NOOP("core", "is a number too large for any computer; allowed: finite numbers."),
    QT_TRANSLATE_NOOP("core", "is an absolute path"),
    QT_TRANSLATE_NOOP("core", "is empty; allowed: CSV with one header row."),
    QT_TRANSLATE_NOOP("core", "is not a file name"),
    QT_TRANSLATE_NOOP("core", "is not a text file (it contains zero bytes); allowed: CSV in UTF-8."),
    QT_TRANSLATE_NOOP("core", "is not valid JSON ({})."),
    QT_TRANSLATE_NOOP("core", "is not valid JSON here: the byte 0x{:02X} is not UTF-8 (Latin-1, perhaps); allowed: JSON in UTF-8."),
    QT_TRANSLATE_NOOP("core", "is not valid JSON here; allowed: JSON (RFC 8259), no NaN."),
    QT_TRANSLATE_NOOP("core", "key \"{}\" appears twice in one object; allowed: each key once."),
    QT_TRANSLATE_NOOP("core", "key \"{}\" is missing."),
    QT_TRANSLATE_NOOP("core", "leads out of its folder by a link"),
    QT_TRANSLATE_NOOP("core", "leaves its folder"),
    QT_TRANSLATE_NOOP("core", "line {}"),
    QT_TRANSLATE_NOOP("core", "line {}, {}"),
    QT_TRANSLATE_NOOP("core", "not determined"),
    QT_TRANSLATE_NOOP("core", "not run"),
    QT_TRANSLATE_NOOP("core", "p not determined"),
    QT_TRANSLATE_NOOP("core", "place {{{}}} is not known; allowed: {}."),
    QT_TRANSLATE_NOOP("core", "text \"{}\" follows a closing quote; allowed: a comma."),
    QT_TRANSLATE_NOOP("core", "the byte 0x{:02X} is not UTF-8 (Latin-1, perhaps); allowed: CSV in UTF-8."),
    QT_TRANSLATE_NOOP("core", "the columns are separated by semicolons; allowed: commas, and numbers with a decimal point."),
    QT_TRANSLATE_NOOP("core", "the columns are separated by tabs; allowed: commas."),
    QT_TRANSLATE_NOOP("core", "the field is empty; allowed: a name."),
    QT_TRANSLATE_NOOP("core", "the file has {} bytes; at most {} are allowed."),
    QT_TRANSLATE_NOOP("core", "true or false"),
    QT_TRANSLATE_NOOP("core", "{} fields instead of {}{}; allowed: {} fields separated by commas, numbers with a decimal point."),
    QT_TRANSLATE_NOOP("core", "{} is not allowed; allowed: {}."),
    QT_TRANSLATE_NOOP("core", "{} more"),
  };
  return formats;
}
