// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/latest_work.h"

#include <utility>

namespace spindrift::gui {

LatestWork::~LatestWork() {
  setRunning(false);
}

void LatestWork::setRunning(bool running) {
  if (running == running_) return;
  running_ = running;
  working += running ? 1 : -1;
}

void LatestWork::ask(Work work) {
  if (running_) {
    next_ = std::move(work);
    return;
  }
  start(std::move(work));
}

void LatestWork::forget() {
  next_ = nullptr;
  wanted_ = false;
}

void LatestWork::start(Work work) {
  setRunning(true);
  wanted_ = true;
  thread_ = std::jthread([this, work = std::move(work)] {
    answer_ = work();
    QMetaObject::invokeMethod(
        this, [this] { complete(); }, Qt::QueuedConnection);
  });
}

void LatestWork::complete() {
  if (thread_.joinable()) thread_.join();
  const std::function<void()> answer = std::exchange(answer_, nullptr);
  setRunning(false);
  if (next_) {
    start(std::exchange(next_, nullptr));
    return;
  }
  if (wanted_ && answer) answer();
  if (!running_) Q_EMIT idle();
}

}  // namespace spindrift::gui
