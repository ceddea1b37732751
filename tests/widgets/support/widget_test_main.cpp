// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QApplication>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <clocale>

#include "widgets/theme/theme.h"

int main(int argc, char** argv) {
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  QApplication application(argc, argv);
  QCoreApplication::setOrganizationName(QStringLiteral("spindrift-test"));
  QStandardPaths::setTestModeEnabled(true);
  // Test mode leaves the documents folder as it is: sessions would stay there.
  const QTemporaryDir sessions;
  qputenv("SPINDRIFT_SESSIONS", sessions.path().toUtf8());
  std::setlocale(LC_ALL, "C");
  spindrift::gui::applyTheme(application, spindrift::gui::ThemeKind::Light);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
