// SPDX-License-Identifier: GPL-3.0-or-later
// The files of a written report, in the language that was chosen for reports: one choice for the page, for what is
// saved and for what is printed.
#pragma once

#include <QString>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace spindrift::gui {

/// The code of the language that reports are shown in: that of the window until another is chosen.
[[nodiscard]] QString reportLanguage();
void chooseReportLanguage(const QString& code);

/// Whether the report was written in that language.
[[nodiscard]] bool isWrittenIn(const nlohmann::json& payload, const QString& language);
/// `key`: "file" (HTML) or "pdf". In English where it was not written in the language; empty if there is no such file.
[[nodiscard]] std::filesystem::path storedReport(const std::filesystem::path& session, const nlohmann::json& payload,
                                                 const char* key);

}  // namespace spindrift::gui
