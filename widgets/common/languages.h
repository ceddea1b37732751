// SPDX-License-Identifier: GPL-3.0-or-later
// The language of the window: which there are, which is wanted, and its catalogues of texts.
//
// Texts of the window stand in tr(); sentences of core are looked up by their English format (core_sentence.h); numbers
// are written as the language writes them (numbers.h). Files and the command line stay English, with a point; reports are
// written in English and in the language of the window.
#pragma once

#include <QLocale>
#include <QString>
#include <vector>

namespace spindrift::gui {

struct Language {
  QString code;      ///< ISO 639-1: "en", "de"
  QString own_name;  ///< in the language itself: "Deutsch"
};

/// English first, then those with a catalogue.
[[nodiscard]] const std::vector<Language>& availableLanguages();
[[nodiscard]] bool isAvailableLanguage(const QString& code);

/// The first language of the system that is available; "en" if none is.
[[nodiscard]] QString systemLanguage();

/// Installs the catalogues of the program and of Qt and the way to write numbers; "" is the language of the system,
/// what is not available is English; offers it for reports (core/reporting/report_language.h). To be called before the
/// first window is made: texts that are shown already stay.
void applyLanguage(const QString& code);

/// The code that applyLanguage() has settled on; "en" before.
[[nodiscard]] QString currentLanguage();

/// How numbers are written in a language: never with separators of thousands. English as in files.
[[nodiscard]] QLocale numbersOf(const QString& code);

}  // namespace spindrift::gui
