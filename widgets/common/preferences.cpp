// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/preferences.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>
#include <cmath>

#include "widgets/theme/system_look.h"

namespace spindrift::gui {
namespace {

// The theme had this key before there were preferences.
constexpr auto look_key = "theme";
constexpr auto language_key = "preferences/language";
constexpr auto decimals_key = "preferences/length_decimals";
constexpr auto inches_key = "preferences/inches";
constexpr auto arcseconds_key = "preferences/arcseconds";
constexpr auto fahrenheit_key = "preferences/fahrenheit";
constexpr auto folder_key = "preferences/sessions_folder";
constexpr auto goal_um_key = "preferences/goal_um";
constexpr auto goal_urad_key = "preferences/goal_urad";
constexpr auto quitting_key = "preferences/ask_before_quitting";
constexpr auto discarding_key = "preferences/ask_before_discarding";

QString lookName(Preferences::Look look) {
  switch (look) {
    case Preferences::Look::Light:
      return QStringLiteral("light");
    case Preferences::Look::Dark:
      return QStringLiteral("dark");
    default:
      return QStringLiteral("system");
  }
}

Preferences::Look lookOf(const QString& name) {
  if (name == QLatin1String("light")) return Preferences::Look::Light;
  return name == QLatin1String("dark") ? Preferences::Look::Dark : Preferences::Look::System;
}

QString folderKey(const QString& kind) {
  return QStringLiteral("folders/") + kind;
}

}  // namespace

Preferences preferences() {
  const QSettings settings;
  Preferences p;
  p.look = lookOf(settings.value(QLatin1String(look_key)).toString());
  p.language = settings.value(QLatin1String(language_key)).toString();
  bool good = false;
  const int decimals = settings.value(QLatin1String(decimals_key)).toInt(&good);
  if (good && decimals >= 0 && decimals <= most_length_decimals) p.length_decimals = decimals;
  p.units.inches = settings.value(QLatin1String(inches_key)).toBool();
  p.units.arcseconds = settings.value(QLatin1String(arcseconds_key)).toBool();
  p.units.fahrenheit = settings.value(QLatin1String(fahrenheit_key)).toBool();
  p.sessions_folder = settings.value(QLatin1String(folder_key)).toString();
  const auto number = [&](const char* key, double least, double& value) {
    const double kept = settings.value(QLatin1String(key)).toDouble(&good);
    if (good && std::isfinite(kept) && kept >= least) value = kept;
  };
  number(goal_um_key, 1e-3, p.goal_um);
  number(goal_urad_key, 0.0, p.goal_urad);
  p.ask_before_quitting = settings.value(QLatin1String(quitting_key), true).toBool();
  p.ask_before_discarding = settings.value(QLatin1String(discarding_key), true).toBool();
  return p;
}

void setPreferences(const Preferences& wanted) {
  const Preferences before = preferences();
  if (wanted == before) return;
  QSettings settings;
  // A default is not kept: one of a later version holds for whoever chose nothing.
  const Preferences usual;
  const auto keep = [&](const char* key, bool chosen, const QVariant& value) {
    if (chosen) {
      settings.setValue(QLatin1String(key), value);
    } else {
      settings.remove(QLatin1String(key));
    }
  };
  keep(look_key, wanted.look != usual.look, lookName(wanted.look));
  keep(language_key, wanted.language != usual.language, wanted.language);
  keep(decimals_key, wanted.length_decimals.has_value(), wanted.length_decimals.value_or(0));
  keep(inches_key, wanted.units.inches, true);
  keep(arcseconds_key, wanted.units.arcseconds, true);
  keep(fahrenheit_key, wanted.units.fahrenheit, true);
  keep(folder_key, wanted.sessions_folder != usual.sessions_folder, wanted.sessions_folder);
  keep(goal_um_key, wanted.goal_um != usual.goal_um, wanted.goal_um);
  keep(goal_urad_key, wanted.goal_urad != usual.goal_urad, wanted.goal_urad);
  keep(quitting_key, wanted.ask_before_quitting != usual.ask_before_quitting, wanted.ask_before_quitting);
  keep(discarding_key, wanted.ask_before_discarding != usual.ask_before_discarding, wanted.ask_before_discarding);
  PreferencesNotifier& notifier = PreferencesNotifier::instance();
  notifier.now_ = wanted;
  Q_EMIT notifier.changed(before, wanted);
}

PreferencesNotifier& PreferencesNotifier::instance() {
  static PreferencesNotifier notifier;
  return notifier;
}

PreferencesNotifier::PreferencesNotifier() : now_(preferences()) {}

void PreferencesNotifier::readAgain() {
  now_ = preferences();
}

ThemeKind wantedTheme() {
  switch (preferences().look) {
    case Preferences::Look::Light:
      return ThemeKind::Light;
    case Preferences::Look::Dark:
      return ThemeKind::Dark;
    default:
      return SystemLook::instance().kind();
  }
}

QString usualSessionsFolder() {
  QString place = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  if (place.isEmpty()) place = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  return QDir(place).filePath(QStringLiteral("Spindrift"));
}

int lengthDecimals(int usual) {
  return PreferencesNotifier::instance().now().length_decimals.value_or(usual);
}

QString lastFolder(const QString& kind, const QString& otherwise) {
  const QString kept = QSettings().value(folderKey(kind)).toString();
  return !kept.isEmpty() && QFileInfo(kept).isDir() ? kept : otherwise;
}

void rememberFolder(const QString& kind, const QString& chosen) {
  if (chosen.isEmpty()) return;
  const QFileInfo info(chosen);
  QSettings().setValue(folderKey(kind), info.isDir() ? info.absoluteFilePath() : info.absolutePath());
}

}  // namespace spindrift::gui
