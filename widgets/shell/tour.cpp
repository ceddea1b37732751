// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/tour.h"

#include <QAbstractEventDispatcher>
#include <QDir>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QThread>
#include <QTimer>
#include <algorithm>
#include <vector>

#include "widgets/common/parts.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/jobs/latest_work.h"
#include "widgets/pages/report/report_page.h"
#include "widgets/panels/scanning/artefact_designer.h"
#include "widgets/report/page_view.h"
#include "widgets/services/incoming_service.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/tour_details.h"
#include "widgets/theme/theme.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

/// A demo and the steps whose pages are shown; the steps between are run too.
struct TourStop {
  const char* demo;
  std::vector<StepId> steps;
};

const std::vector<TourStop>& tourStops() {
  static const std::vector<TourStop> stops{
      {"fiducials",
       {StepId::Machine, StepId::WarmUp, StepId::Capture, StepId::Calibrate, StepId::Model, StepId::Compensate,
        StepId::Review, StepId::Report}},
      {"holes", {StepId::Machine, StepId::Capture, StepId::Calibrate, StepId::Model}},
      {"balls", {StepId::Capture, StepId::Model}},
      {"scans", {StepId::Capture, StepId::Calibrate, StepId::Model, StepId::Review}},
      {"discrepancy", {StepId::Model, StepId::Discrepancy, StepId::Compensate, StepId::Report}},
      {"own_pattern", {StepId::Capture, StepId::Calibrate, StepId::Model}},
  };
  return stops;
}

bool shows(const TourStop& stop, StepId step) {
  return std::find(stop.steps.begin(), stop.steps.end(), step) != stop.steps.end();
}

/// Time passes, and then nothing that was put off until the program is idle (layouts, plots) is left: on a loaded
/// computer the time alone is over before any of it is done.
void settle(int ms) {
  QEventLoop loop;
  QTimer::singleShot(ms, &loop, &QEventLoop::quit);
  loop.exec();
  finishWhatWasPutOff();
}

/// The report of the page that is shown, in each of its formats.
void writeReports(MainWindow& window, const QString& file, TourResult& result) {
  for (const Exportable& item : window.currentPage()->exportables()) {
    for (const QString& format : item.formats) {
      const QString target = file + QLatin1Char('.') + format;
      try {
        item.write(target);
        result.reports << target;
      } catch (const std::exception& e) {
        result.failure = QString::fromUtf8(e.what());
      }
    }
  }
}

bool viewsBusy(const QWidget& window) {
  for (const View3D* view : window.findChildren<View3D*>()) {
    if (view->isVisible() && view->refining()) return true;
  }
  for (const ReportPage* page : window.findChildren<ReportPage*>()) {
    if (page->opening() || (page->isVisible() && page->pages()->drawing())) return true;
  }
  return false;
}

/// The artefact designer with a surface that is too steep in places, coloured by its slope.
void shootDesigner(const QString& file, TourResult& result) {
  ArtefactDesigner designer;
  designer.show();
  designer.colouring()->button(1)->click();
  designer.number("amplitude x")->setValue(2.2);  // a little too steep along X
  designer.recompute();
  for (int turn = 0; turn < 100; ++turn) {
    settle(20);
    if (turn > 2 && !viewsBusy(designer)) break;
  }
  if (!designer.grab().save(file)) result.failure = QStringLiteral("%1 could not be written").arg(file);
  result.pictures << file;
}

}  // namespace

void finishWhatWasPutOff() {
  constexpr int most_ms = 2000;
  QElapsedTimer timer;
  timer.start();
  while (QThread::currentThread()->eventDispatcher()->processEvents(QEventLoop::AllEvents) &&
         timer.elapsed() < most_ms) {
  }
}

bool settled(MainWindow& window) {
  return !window.arriving() && !window.jobs().busy() && !LatestWork::anyBusy() && !viewsBusy(window);
}

bool waitForJobs(MainWindow& window, int seconds) {
  QElapsedTimer timer;
  timer.start();
  // Twice: what a job has just changed finds its place only then.
  for (int quiet = 0; quiet < 2; quiet = settled(window) ? quiet + 1 : 0) {
    if (timer.elapsed() > 1000LL * seconds) return false;
    settle(20);
  }
  return true;
}

TourResult runTour(MainWindow& window, const QString& folder, const TourOptions& options) {
  TourResult result;
  QDir().mkpath(folder);
  const QTemporaryDir scratch;
  // A picture of what is shown; the number keeps light and dark of one page together.
  const auto shoot = [&](int number, const QString& name, ThemeKind kind, QWidget* shown = nullptr) {
    if (!waitForJobs(window, 30)) result.failure = QStringLiteral("%1 did not settle").arg(name);
    const QString file = QDir(folder).filePath(
        QStringLiteral("%1-%2-%3.png")
            .arg(number, 2, 10, QLatin1Char('0'))
            .arg(name, kind == ThemeKind::Light ? QStringLiteral("light") : QStringLiteral("dark")));
    if (!(shown != nullptr ? shown : &window)->grab().save(file))
      result.failure = QStringLiteral("%1 could not be written").arg(file);
    result.pictures << file;
  };
  window.resize(options.size);
  window.show();
  for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
    window.setTheme(kind);
    shoot(0, QStringLiteral("welcome"), kind);
    shootDesigner(
        QDir(folder).filePath(QStringLiteral("00-artefact-designer-%1.png")
                                  .arg(kind == ThemeKind::Light ? QStringLiteral("light") : QStringLiteral("dark"))),
        result);
  }
  for (const ThemeKind kind : {ThemeKind::Dark, ThemeKind::Light}) {
    if (!options.every_page) break;
    window.setTheme(kind);
    for (const auto& [name, open] : tourWindows()) {
      QWidget* shown = open(window);
      shoot(0, QLatin1String(name), kind, shown);
      if (shown != nullptr) shown->close();
    }
  }
  int number = 1;
  for (const TourStop& stop : tourStops()) {
    const QString demo = QString::fromLatin1(stop.demo);
    window.startDemo(demo, true);
    if (!waitForJobs(window, 120) || window.session().campaign() == nullptr) {
      result.failure = QStringLiteral("the demo %1 could not be made: ").arg(demo) + window.jobBar()->message();
      return result;
    }
    const auto name = [&](StepId step) { return demo + QLatin1Char('-') + stepTitle(step).toLower(); };
    const std::vector<TourDetail> details = tourDetails(demo, scratch.path());
    const auto shootDetails = [&](StepId step, int first, ThemeKind kind) {
      int at = first;
      for (const TourDetail& detail : details) {
        if (detail.step != step) continue;
        QWidget* shown = detail.show(window);
        shoot(at++, name(step) + QLatin1Char('-') + QLatin1String(detail.name), kind, shown);
        if (detail.leave) detail.leave(window);
      }
      return at;
    };
    const auto shootTabs = [&](StepId step, int first, ThemeKind kind) {
      int at = first;
      auto* tabs = options.every_page && window.currentPage() != nullptr
                       ? window.currentPage()->findChild<QTabWidget*>()
                       : nullptr;
      for (int i = 1; tabs != nullptr && tabs->isVisible() && i < tabs->count(); ++i) {
        if (!tabs->isTabVisible(i) || !tabs->isTabEnabled(i)) continue;
        tabs->setCurrentIndex(i);
        shoot(at++, name(step) + QStringLiteral("-tab%1").arg(i + 1), kind);
      }
      if (tabs != nullptr) tabs->setCurrentIndex(0);
      return at;
    };
    int light = number;
    for (const StepId step : all_steps) {
      window.workflow().goTo(step);
      const bool can_run = window.workflow().status(step).state != StepState::Blocked;
      if (can_run && window.currentPage() != nullptr) window.currentPage()->runAll();
      if (!waitForJobs(window, 120)) result.failure = QStringLiteral("%1 did not finish").arg(stepTitle(step));
      if (options.every_page || shows(stop, step)) {
        shoot(light++, name(step), ThemeKind::Light);
        if (step == StepId::Report) writeReports(window, QDir(folder).filePath(name(step)), result);
      }
      light = shootTabs(step, light, ThemeKind::Light);
      light = shootDetails(step, light, ThemeKind::Light);
    }
    // All dark ones at once: a change of theme styles the whole window anew.
    window.setTheme(ThemeKind::Dark);
    for (const StepId step : all_steps) {
      window.workflow().goTo(step);
      if (options.every_page || shows(stop, step)) shoot(number++, name(step), ThemeKind::Dark);
      number = shootTabs(step, number, ThemeKind::Dark);
      number = shootDetails(step, number, ThemeKind::Dark);
    }
    window.setTheme(ThemeKind::Light);
    if (demo == QLatin1String("fiducials")) {
      const QString failure = startArriving(window, scratch.path());
      if (!failure.isEmpty()) result.failure = failure;
      for (const ThemeKind kind : {ThemeKind::Light, ThemeKind::Dark}) {
        window.setTheme(kind);
        shoot(number, QStringLiteral("new-capture-arriving"), kind);
      }
      ++number;
      IncomingService::of(window.session()).stop();
      window.setTheme(ThemeKind::Light);
    }
  }
  window.closeSession();  // before the files of the tour go
  return result;
}

}  // namespace spindrift::gui
