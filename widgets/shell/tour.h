// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through the steps on demo data and saves pictures of pages, light and dark.
#pragma once

#include <QSize>
#include <QString>
#include <QStringList>

namespace spindrift::gui {

class MainWindow;

struct TourResult {
  QStringList pictures;
  QStringList reports;  ///< PDF and HTML
  QString failure;      ///< empty: everything went well
};

struct TourOptions {
  QSize size{1440, 900};  ///< of the window
  /// Every step of every demo with each of its tabs, and the windows beside; else what shows the program best.
  bool every_page = false;
};

[[nodiscard]] TourResult runTour(MainWindow& window, const QString& folder, const TourOptions& options = {});
/// Runs the event loop until it would wait: nothing is left that was put off until the program is idle, such as the
/// layout of a page (at most 2 s).
void finishWhatWasPutOff();
/// No job is left, the page stands there complete, and nothing is drawn anew in the background.
[[nodiscard]] bool settled(MainWindow& window);
/// Runs the event loop until no job is left (and 3D views are finished), at most `seconds`. False: time is over.
bool waitForJobs(MainWindow& window, int seconds);

}  // namespace spindrift::gui
