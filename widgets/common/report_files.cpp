// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/report_files.h"

#include <QSettings>
#include <nlohmann/json.hpp>
#include <string>

#include "widgets/common/languages.h"

namespace spindrift::gui {
namespace {

constexpr auto english = "en";
constexpr auto language_setting = "report/language";
constexpr auto translations = "translations";

}  // namespace

QString reportLanguage() {
  const QString kept = QSettings().value(QLatin1String(language_setting), currentLanguage()).toString();
  return kept == QLatin1String(english) ? kept : currentLanguage();
}

void chooseReportLanguage(const QString& code) {
  QSettings().setValue(QLatin1String(language_setting), code);
}

bool isWrittenIn(const nlohmann::json& payload, const QString& language) {
  return language == QLatin1String(english) ||
         (payload.contains(translations) && payload.at(translations).contains(language.toStdString()));
}

std::filesystem::path storedReport(const std::filesystem::path& session, const nlohmann::json& payload,
                                   const char* key) {
  const QString language = reportLanguage();
  const bool translated = language != QLatin1String(english) && isWrittenIn(payload, language);
  const nlohmann::json& files = translated ? payload.at(translations).at(language.toStdString()) : payload;
  return files.contains(key) ? session / files.value(key, std::string()) : std::filesystem::path();
}

}  // namespace spindrift::gui
