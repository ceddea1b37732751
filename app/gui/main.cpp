// SPDX-License-Identifier: GPL-3.0-or-later
// The desktop program: parse the command line, build the window, run.
#include <QApplication>
#include <QCommandLineParser>
#include <QDir>
#include <QElapsedTimer>
#include <QSettings>
#include <QStandardPaths>
#include <QTimer>
#include <clocale>
#include <cstdio>

#include "core/base/log.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/tour.h"
#include "widgets/theme/theme.h"

namespace {

constexpr int exit_done = 0;
constexpr int exit_not_good_enough = 1;
constexpr int exit_bad_input = 2;
constexpr int exit_internal = 3;

/// --scale has to be known before the application object is made.
void applyScale(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (qstrcmp(argv[i], "--scale") == 0) qputenv("QT_SCALE_FACTOR", argv[i + 1]);
  }
}

int run(int argc, char** argv) {
  using namespace spindrift::gui;
  applyScale(argc, argv);
  const bool tour_asked = [&] {
    for (int i = 1; i < argc; ++i) {
      if (qstrcmp(argv[i], "--tour") == 0) return true;
    }
    return false;
  }();
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM") &&
      (tour_asked || (qEnvironmentVariableIsEmpty("DISPLAY") && qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY")))) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
  }
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QLocale::setDefault(QLocale::c());
  QCoreApplication::setApplicationName(QStringLiteral("spindrift"));
  QCoreApplication::setOrganizationName(QStringLiteral("spindrift"));
  QCoreApplication::setApplicationVersion(QStringLiteral(SPINDRIFT_VERSION));

  QCommandLineParser parser;
  parser.setApplicationDescription(QCoreApplication::translate(
      "main", "Spindrift: measure, understand and compensate the thermal errors of machine tools."));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(QStringLiteral("folder"),
                               QCoreApplication::translate("main", "A session or a campaign to open."),
                               QStringLiteral("[SESSION_OR_CAMPAIGN]"));
  const QCommandLineOption demo(QStringLiteral("demo"),
                                QCoreApplication::translate("main",
                                                            "Open a demo session of the virtual machine; its name may "
                                                            "follow: fiducials, holes, balls, scans, discrepancy."));
  const QCommandLineOption tour(
      QStringLiteral("tour"),
      QCoreApplication::translate("main", "Walk through every step on demo data and save pictures in DIR."),
      QStringLiteral("DIR"));
  const QCommandLineOption theme_option(QStringLiteral("theme"), QCoreApplication::translate("main", "light or dark."),
                                        QStringLiteral("light|dark"));
  const QCommandLineOption scale(QStringLiteral("scale"),
                                 QCoreApplication::translate("main", "Scale of everything, 0.5 to 4."),
                                 QStringLiteral("N"));
  parser.addOptions({demo, tour, theme_option, scale});
  if (!parser.parse(application.arguments())) {
    std::fprintf(stderr, "%s\n", qPrintable(parser.errorText()));
    return exit_bad_input;
  }
  if (parser.isSet(QStringLiteral("help"))) {
    std::printf("%s", qPrintable(parser.helpText()));
    return exit_done;
  }
  if (parser.isSet(QStringLiteral("version"))) {
    std::printf("spindrift %s\n", SPINDRIFT_VERSION);
    return exit_done;
  }
  if (parser.isSet(tour)) QStandardPaths::setTestModeEnabled(true);
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  if (!data.isEmpty()) spindrift::startLogFile((data + QStringLiteral("/spindrift.log")).toStdString());

  QString kind = parser.value(theme_option);
  if (kind.isEmpty() && !parser.isSet(tour)) kind = QSettings().value(QStringLiteral("theme")).toString();
  if (!kind.isEmpty() && kind != QLatin1String("light") && kind != QLatin1String("dark")) {
    std::fprintf(stderr, "--theme %s is not allowed; allowed: light or dark.\n", qPrintable(kind));
    return exit_bad_input;
  }
  applyTheme(application, kind == QLatin1String("dark") ? ThemeKind::Dark : ThemeKind::Light);

  MainWindow window;
  if (parser.isSet(tour)) {
    QElapsedTimer timer;
    timer.start();
    const TourResult result = runTour(window, parser.value(tour));
    std::printf("%d pictures in %s, %.1f s\n", static_cast<int>(result.pictures.size()), qPrintable(parser.value(tour)),
                static_cast<double>(timer.elapsed()) / 1000.0);
    if (!result.failure.isEmpty()) {
      std::fprintf(stderr, "%s\n", qPrintable(result.failure));
      return exit_not_good_enough;
    }
    return exit_done;
  }
  window.show();
  const QStringList folders = parser.positionalArguments();
  if (parser.isSet(demo)) {
    window.startDemo(folders.isEmpty() ? QStringLiteral("fiducials") : folders.front());
  } else if (!folders.isEmpty()) {
    window.open(QDir(folders.front()).absolutePath());
  }
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "internal error: %s\n", e.what());
    return exit_internal;
  }
}
