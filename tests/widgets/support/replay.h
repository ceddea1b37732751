// SPDX-License-Identifier: GPL-3.0-or-later
// Does again what is in a recording, with mouse and keys at the real windows: an event goes to whatever stands at the
// place, so a control that is covered or cut is not reached.
#pragma once

#include <QObject>
#include <QWidget>
#include <cstddef>
#include <functional>

#include "widgets/recording/recording.h"

namespace spindrift::gui {

class MainWindow;

class Replay : public QObject {
 public:
  /// `look` is called with the name of each look of the recording and the window in front.
  using Look = std::function<void(const QString& name, QWidget& shown)>;
  Replay(MainWindow& window, Recording recording, Look look);

  /// Everything, waiting for the work that each thing starts. Returns why it could not be done; empty: it was.
  [[nodiscard]] QString run(int seconds);

 private:
  void next();
  void doIt(const Interaction& one);
  void press(QWidget& control, const Interaction& one);
  void fail(const Interaction& one, const QString& reason);

  MainWindow& window_;
  Recording recording_;
  Look look_;
  std::size_t at_ = 0;
  int waited_ = 0;  ///< turns for the control at hand
  bool doing_ = false;
  QWidget* in_front_ = nullptr;  ///< dialog or menu when what is done began; compared only
  QString failure_;
  std::function<void()> done_;
};

}  // namespace spindrift::gui
