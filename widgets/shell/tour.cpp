// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/tour.h"

#include <QDir>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>

#include "widgets/jobs/job_bar.h"
#include "widgets/shell/main_window.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

void settle(int ms) {
  QEventLoop loop;
  QTimer::singleShot(ms, &loop, &QEventLoop::quit);
  loop.exec();
}

bool viewsBusy(const MainWindow& window) {
  for (const View3D* view : window.findChildren<View3D*>()) {
    if (view->isVisible() && view->refining()) return true;
  }
  return false;
}

}  // namespace

bool waitForJobs(MainWindow& window, int seconds) {
  QElapsedTimer timer;
  timer.start();
  settle(20);
  while (window.jobs().busy() || viewsBusy(window)) {
    if (timer.elapsed() > 1000LL * seconds) return false;
    settle(20);
  }
  return true;
}

TourResult runTour(MainWindow& window, const QString& folder) {
  TourResult result;
  QDir().mkpath(folder);
  const auto shoot = [&](const QString& name) {
    for (const ThemeKind kind : {ThemeKind::Light, ThemeKind::Dark}) {
      window.setTheme(kind);
      if (!waitForJobs(window, 30)) result.failure = QStringLiteral("%1 did not settle").arg(name);
      const QString file = QDir(folder).filePath(
          QStringLiteral("%1-%2.png")
              .arg(name, kind == ThemeKind::Light ? QStringLiteral("light") : QStringLiteral("dark")));
      if (!window.grab().save(file)) result.failure = QStringLiteral("%1 could not be written").arg(file);
      result.pictures << file;
    }
    window.setTheme(ThemeKind::Light);
  };
  window.resize(1440, 900);
  window.show();
  shoot(QStringLiteral("00-welcome"));
  window.startDemo(QStringLiteral("fiducials"), true);
  if (!waitForJobs(window, 120) || window.session().campaign() == nullptr) {
    result.failure = QStringLiteral("the demo campaign could not be made: ") + window.jobBar()->message();
    return result;
  }
  int number = 1;
  for (const StepId step : all_steps) {
    window.workflow().goTo(step);
    if (window.currentPage() != nullptr) window.currentPage()->runAll();
    waitForJobs(window, 120);
    shoot(QStringLiteral("%1-%2").arg(number++, 2, 10, QLatin1Char('0')).arg(stepTitle(step).toLower()));
  }
  return result;
}

}  // namespace spindrift::gui
