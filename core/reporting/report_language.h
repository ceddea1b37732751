// SPDX-License-Identifier: Apache-2.0
// A report in another language. Reports are made in English; a program that has a catalogue of translations offers its
// language once, at its start, and the report of a campaign is filed in that language too, beside the English one: what
// is found is the same, so neither makes the other outdated.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/reporting/report.h"

namespace spindrift {

struct ReportLanguage {
  std::string code;  ///< ISO 639-1, such as "de"
  /// An English text of a report in the language: a sentence, a title, a number with its unit. Called from any thread.
  std::function<std::string(const std::string& english)> words;
  /// A text of the reference of files, which has a catalogue of its own: single words of it mean other things
  /// elsewhere.
  std::function<std::string(std::string_view english)> of_files;
  /// A name that `ReportNames` keeps, as the program shows it: those that its demos come with have one in every
  /// language. Empty: as it is. Called from any thread.
  std::function<std::string(const std::string& name)> of_names;
};

/// Nothing: English alone. Before any report is written, for the whole process.
void offerReportLanguage(std::optional<ReportLanguage> language);
[[nodiscard]] const std::optional<ReportLanguage>& offeredReportLanguage();

/// What people wrote, which stays as it is in every language (but see ReportLanguage::of_names).
struct ReportNames {
  std::vector<std::string> within;  ///< in the middle of texts too, as words of their own: a campaign, an operator
  std::vector<std::string> whole;   ///< whole texts, or what follows a colon: points, reasons, notes
};

/// Headings, texts, callouts, tables, captions and the texts in figures in the language. Ids of effects, code, pictures
/// and `names` stay.
[[nodiscard]] Report inLanguage(const Report& english, const ReportLanguage& language, const ReportNames& names = {});
/// In the language that is offered, as it is where none is: for reports of which a window writes one.
[[nodiscard]] Report inOfferedLanguage(Report english, const ReportNames& names = {});
/// A text by itself. An effect that stands by its title, with its id small beside it, keeps both.
[[nodiscard]] ReportText inLanguage(const ReportText& english, const ReportLanguage& language);
[[nodiscard]] Drawing inLanguage(const Drawing& english, const ReportLanguage& language);

}  // namespace spindrift
