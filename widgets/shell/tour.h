// SPDX-License-Identifier: GPL-3.0-or-later
// Walks through every step on demo data and saves a picture of each page, light and dark.
#pragma once

#include <QString>
#include <QStringList>

namespace spindrift::gui {

class MainWindow;

struct TourResult {
  QStringList pictures;
  QStringList reports;  ///< PDF and HTML
  QString failure;      ///< empty: everything went well
};

[[nodiscard]] TourResult runTour(MainWindow& window, const QString& folder);
/// Runs the event loop until no job is left (and 3D views are finished), at most `seconds`. False: time is over.
bool waitForJobs(MainWindow& window, int seconds);

}  // namespace spindrift::gui
