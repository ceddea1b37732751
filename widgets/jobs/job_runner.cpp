// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/job_runner.h"

#include <QCoreApplication>
#include <QMetaObject>
#include <atomic>

#include "core/base/error.h"
#include "core/base/log.h"

namespace spindrift::gui {

/// Called from any thread; read by the GUI thread a few times a second.
class JobRunner::Sink : public ProgressSink {
 public:
  void report(double fraction, std::string_view stage) override {
    const std::lock_guard lock(mutex_);
    fraction_ = fraction;
    stage_.assign(stage);
  }
  [[nodiscard]] std::pair<double, QString> read() {
    const std::lock_guard lock(mutex_);
    return {fraction_, QString::fromStdString(stage_)};
  }

 private:
  std::mutex mutex_;
  double fraction_ = 0.0;
  std::string stage_;
};

struct JobRunner::Running {
  Job job;
  Sink sink;
  std::function<void()> apply;
  JobOutcome outcome = JobOutcome::Done;
  QString sentence;
  std::jthread thread;  // last: joined before the rest goes
};

JobRunner::JobRunner(QObject* parent) : QObject(parent) {
  poll_.setInterval(60);
  connect(&poll_, &QTimer::timeout, this, [this] {
    if (current_ == nullptr) return;
    const auto [fraction, stage] = current_->sink.read();
    Q_EMIT progressed(fraction, stage);
  });
}

JobRunner::~JobRunner() {
  queue_.clear();
  if (current_ != nullptr) current_->thread.request_stop();
}

QString JobRunner::title() const {
  return current_ != nullptr ? current_->job.title : QString();
}

void JobRunner::run(Job job) {
  queue_.push_back(std::move(job));
  if (current_ == nullptr) startNext();
}

void JobRunner::startNext() {
  if (queue_.empty()) return;
  current_ = std::make_unique<Running>();
  current_->job = std::move(queue_.front());
  queue_.pop_front();
  Running* running = current_.get();
  if (!running->job.quiet) {
    log(LogLevel::Info, running->job.title.toStdString());
    Q_EMIT started(running->job.title);
    poll_.start();
  }
  running->thread = std::jthread([this, running](std::stop_token token) {
    JobContext context(token, &running->sink);
    try {
      running->apply = running->job.work(context);
      if (token.stop_requested()) running->outcome = JobOutcome::Cancelled;
    } catch (const Cancelled&) {
      running->outcome = JobOutcome::Cancelled;
    } catch (const InputError& e) {
      running->outcome = JobOutcome::Failed;
      running->sentence = QString::fromUtf8(e.what());
    } catch (const std::exception& e) {
      running->outcome = JobOutcome::Failed;
      log(LogLevel::Error, std::string("internal error: ") + e.what());
      running->sentence = QCoreApplication::translate("JobRunner", "Internal error, please report it: %1")
                              .arg(QString::fromUtf8(e.what()));
    }
    QMetaObject::invokeMethod(
        this, [this] { complete(); }, Qt::QueuedConnection);
  });
}

void JobRunner::complete() {
  if (current_ == nullptr) return;
  const std::unique_ptr<Running> done = std::move(current_);
  poll_.stop();
  if (done->thread.joinable()) done->thread.join();
  switch (done->outcome) {
    case JobOutcome::Done:
      try {
        if (done->apply) done->apply();
      } catch (const std::exception& e) {
        done->outcome = JobOutcome::Failed;
        done->sentence = QString::fromUtf8(e.what());
        if (done->job.failed) done->job.failed(done->sentence);
      }
      break;
    case JobOutcome::Failed:
      log(LogLevel::Warning, done->sentence.toStdString());
      if (done->job.failed) done->job.failed(done->sentence);
      break;
    case JobOutcome::Cancelled:
      if (done->job.cancelled) done->job.cancelled();
      break;
  }
  if (!done->job.quiet) Q_EMIT finished(done->job.title, done->outcome, done->sentence);
  if (current_ == nullptr) startNext();
}

void JobRunner::cancel() {
  if (current_ != nullptr) current_->thread.request_stop();
}

void JobRunner::cancelAll() {
  queue_.clear();
  cancel();
}

}  // namespace spindrift::gui
