// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QApplication>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <clocale>

#include "widgets/theme/theme.h"

int main(int argc, char** argv) {
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  QApplication application(argc, argv);
  QCoreApplication::setOrganizationName(QStringLiteral("spindrift-test"));
  QStandardPaths::setTestModeEnabled(true);
  // Test mode leaves the documents folder as it is: sessions would stay there. It keeps settings by the name of the
  // program, and another run of the same one at the same time would write into them.
  const QTemporaryDir scratch;
  qputenv("SPINDRIFT_SESSIONS", scratch.filePath(QStringLiteral("sessions")).toUtf8());
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, scratch.filePath(QStringLiteral("settings")));
  std::setlocale(LC_ALL, "C");
  spindrift::gui::applyTheme(application, spindrift::gui::ThemeKind::Light);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
