// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/widgets/support/event_loop_watch.h"

#include <execinfo.h>
#include <pthread.h>
#include <unistd.h>

#include <QAbstractEventDispatcher>
#include <QEventLoop>
#include <QImage>
#include <QPainter>
#include <QTimer>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <ctime>
#include <map>

namespace spindrift::gui {
namespace {

double milliseconds(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void printStack(int) {
  void* frames[64];
  ::backtrace_symbols_fd(frames, ::backtrace(frames, 64), STDERR_FILENO);
  [[maybe_unused]] const ssize_t count = ::write(STDERR_FILENO, "----\n", 5);
}

/// What the reference takes on a core that works for nobody else.
constexpr double undisturbed_ms = 1.0;

/// Processor time of a fixed piece of work of the kind that a window does: strings made, kept in order, laid out and
/// painted. Whatever makes a window slower (a slower processor, another program on the same core or in its caches)
/// makes this slower too.
double referenceWork() {
  static QImage canvas(640, 200, QImage::Format_ARGB32_Premultiplied);
  const double before = milliseconds(CLOCK_THREAD_CPUTIME_ID);
  std::map<QString, int> names;
  for (int i = 0; i < 700; ++i) names[QStringLiteral("reading %1").arg((i * 7919) % 700)] = i;
  QPainter painter(&canvas);
  painter.fillRect(canvas.rect(), Qt::white);
  int row = 0;
  for (const auto& [name, value] : names) {
    if (value % 20 != 0) continue;
    painter.drawText(QPointF(8.0, 5.0 * ++row), name + QString::number(value));
  }
  painter.end();
  return milliseconds(CLOCK_THREAD_CPUTIME_ID) - before;
}

}  // namespace

EventLoopWatch::EventLoopWatch() {
  const QAbstractEventDispatcher* loop = QAbstractEventDispatcher::instance();
  connect(loop, &QAbstractEventDispatcher::awake, this, &EventLoopWatch::mark);
  connect(loop, &QAbstractEventDispatcher::aboutToBlock, this, &EventLoopWatch::mark);
  const double limit = qEnvironmentVariable("SPINDRIFT_WATCH_TRACE").toDouble();
  if (limit <= 0.0) return;
  void* warm_up[1];
  ::backtrace(warm_up, 1);
  std::signal(SIGUSR2, printStack);
  tracer_ = std::jthread([this, limit, gui = ::pthread_self()](const std::stop_token& stop) {
    for (; !stop.stop_requested(); std::this_thread::sleep_for(std::chrono::milliseconds(30))) {
      const double since = clock_ms_;
      if (since > 0.0 && milliseconds(CLOCK_MONOTONIC) - since > limit) ::pthread_kill(gui, SIGUSR2);
    }
  });
}

EventLoopWatch::~EventLoopWatch() = default;

double EventLoopWatch::slowdown() const {
  if (references_.empty()) return 1.0;
  std::vector<double> sorted = references_;
  std::sort(sorted.begin(), sorted.end());
  return std::clamp(sorted[sorted.size() / 2] / undisturbed_ms, 1.0, 3.0);
}

void EventLoopWatch::mark() {
  const double processor = milliseconds(CLOCK_THREAD_CPUTIME_ID);
  const double clock = milliseconds(CLOCK_MONOTONIC);
  if (running_) {
    Turn& turn = longest_.back();
    turn.processor_ms = std::max(turn.processor_ms, processor - processor_ms_);
    turn.clock_ms = std::max(turn.clock_ms, clock - clock_ms_);
  }
  processor_ms_ = processor;
  clock_ms_ = clock;
}

void EventLoopWatch::during(const QString& name, const std::function<void()>& action,
                            const std::function<void()>& settle) {
  for (int i = 0; i < 5; ++i) references_.push_back(referenceWork());
  QEventLoop loop;
  QTimer::singleShot(0, &loop, [&] {
    longest_.push_back({name, 0.0, 0.0});
    running_ = true;
    action();
    QTimer::singleShot(0, &loop, &QEventLoop::quit);
  });
  loop.exec();
  settle();
  running_ = false;
  clock_ms_ = 0.0;
}

}  // namespace spindrift::gui
