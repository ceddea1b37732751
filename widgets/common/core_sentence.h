// SPDX-License-Identifier: GPL-3.0-or-later
// Sentences of core in the language of the window.
//
// Core, the command line and all files speak English: a sentence is a format with its values filled in. The window
// knows the formats (core_formats.h). It finds the one that a sentence was made from, takes the values out again and
// fills them into the translation, values that are sentences themselves included. So a result that was stored by an
// earlier version or by the command line is read in the language of today as well, and no type of core carries anything
// for it.
#pragma once

#include <QString>
#include <string_view>

namespace spindrift::gui {

/// The sentence in the language of the window, its numbers as that language writes them. What is not known stays as it
/// is. English is returned unchanged.
[[nodiscard]] QString coreSentence(const QString& english);
[[nodiscard]] QString coreSentence(std::string_view english);
[[nodiscard]] QString coreSentence(const char* english);

}  // namespace spindrift::gui
