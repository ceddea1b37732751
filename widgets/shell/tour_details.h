// SPDX-License-Identifier: GPL-3.0-or-later
// What the tour shows beside the pages themselves: tabs, panels and dialogs that have to be opened or fed first.
#pragma once

#include <QString>
#include <functional>
#include <utility>
#include <vector>

#include "widgets/workflow/workflow.h"

class QWidget;

namespace spindrift::gui {

class MainWindow;

struct TourDetail {
  StepId step = StepId::Machine;
  const char* name = "";
  /// Shows it; returns what is to be photographed (null: the window). May be called more than once.
  std::function<QWidget*(MainWindow&)> show;
  std::function<void(MainWindow&)> leave;  ///< may be empty
};

/// Windows and pages that need no session, each with its name; null: the window itself is to be photographed.
[[nodiscard]] std::vector<std::pair<const char*, std::function<QWidget*(MainWindow&)>>> tourWindows();
/// Of a demo; files are made in `scratch`.
[[nodiscard]] std::vector<TourDetail> tourDetails(const QString& demo, const QString& scratch);
/// Begins a new measurement on the machine at hand, for which a few of its images arrive in a watched folder: three
/// good ones and a blurred one. To be called when the evaluated captures of a demo are open; shows the arriving images.
/// Returns a sentence if that failed.
[[nodiscard]] QString startArriving(MainWindow& window, const QString& scratch);

}  // namespace spindrift::gui
