// SPDX-License-Identifier: GPL-3.0-or-later
// How long the GUI thread works without looking at the mouse.
//
// Every turn of the event loop is timed from waking to the next waking or waiting. The processor time of the thread is
// what is judged: it does not grow when other programs take the machine, so that the figure is the same on a busy
// build server. The time on the clock is kept beside it.
#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace spindrift::gui {

class EventLoopWatch : public QObject {
  Q_OBJECT
 public:
  struct Turn {
    QString during;
    double processor_ms = 0.0;
    double clock_ms = 0.0;
  };

  /// Watches the event loop of the thread that makes it. If the variable SPINDRIFT_WATCH_TRACE of the environment is
  /// set, the stack of the thread is printed whenever a turn takes longer than that many milliseconds on the clock.
  EventLoopWatch();
  ~EventLoopWatch() override;

  /// Runs `action` inside the event loop, as a click would, then `settle`; all turns until the end are counted for it.
  void during(const QString& name, const std::function<void()>& action, const std::function<void()>& settle);
  /// The longest turn of each action.
  [[nodiscard]] const std::vector<Turn>& longest() const { return longest_; }
  /// How much slower the processor was than an undisturbed one while it was watched, 1 to 3: by the usual time of a
  /// fixed piece of work.
  [[nodiscard]] double slowdown() const;

 private:
  void mark();

  std::vector<Turn> longest_;
  std::vector<double> references_;
  bool running_ = false;
  double processor_ms_ = 0.0;
  std::atomic<double> clock_ms_ = 0.0;
  std::jthread tracer_;
};

}  // namespace spindrift::gui
