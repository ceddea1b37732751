// SPDX-License-Identifier: GPL-3.0-or-later
// Small questions answered in the background while somebody types: only the last one counts. What takes long, or what
// somebody should see and be able to cancel, is a job (job_runner.h).
#pragma once

#include <QObject>
#include <functional>
#include <thread>

namespace spindrift::gui {

class LatestWork : public QObject {
  Q_OBJECT
 public:
  /// Runs on a worker thread, must not touch anything of the GUI and must not throw; returns what is to be done with
  /// the answer, which runs on the GUI thread unless something else has been asked since.
  using Work = std::function<std::function<void()>()>;

  explicit LatestWork(QObject* parent = nullptr) : QObject(parent) {}
  /// Waits for what runs; its answer is dropped.
  ~LatestWork() override;
  void ask(Work work);
  /// The answer that is under way is not wanted any more.
  void forget();
  [[nodiscard]] bool busy() const { return running_; }
  /// Whether any of the program is busy: what it shows may still change. GUI thread.
  [[nodiscard]] static bool anyBusy() { return working > 0; }

 Q_SIGNALS:
  void idle();

 private:
  void start(Work work);
  void complete();

  void setRunning(bool running);

  static inline int working = 0;
  bool running_ = false;
  bool wanted_ = false;
  Work next_;
  std::function<void()> answer_;
  std::jthread thread_;
};

}  // namespace spindrift::gui
