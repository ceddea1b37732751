// SPDX-License-Identifier: Apache-2.0
// The manual: chapters that people wrote (resources/manual, in the order of their names), then what the program says of
// itself, so that it cannot fall behind: files, error parameters, every effect of the catalogue with its figure, and
// the commands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/reporting/report.h"
#include "core/reporting/report_language.h"

namespace spindrift {

/// Markdown of each chapter; none if nobody wrote it in this language (ISO 639-1).
[[nodiscard]] const std::vector<std::string>& manualChapters(std::string_view language = "en");

/// `commands`: reference of a program as Markdown (markdownReference), the last chapter; may be empty.
[[nodiscard]] Report manual(std::string_view commands);
/// In a language that its chapters were written in. The reference of the commands is left to the English one.
[[nodiscard]] Report manualIn(const ReportLanguage& language);

}  // namespace spindrift
