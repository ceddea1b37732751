// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/job_runner.h"

#include <QCoreApplication>
#include <QMetaObject>
#include <algorithm>

#include "core/base/error.h"
#include "core/base/log.h"
#include "widgets/common/core_sentence.h"

namespace spindrift::gui {

namespace {

constexpr std::array every_queue{JobQueue::Campaign, JobQueue::Work,  JobQueue::Display,
                                 JobQueue::Reading,  JobQueue::Files, JobQueue::Batch};

}  // namespace

/// Called from any thread; read by the GUI thread a few times a second.
class JobRunner::Sink : public ProgressSink {
 public:
  void report(double fraction, std::string_view stage) override {
    const std::lock_guard lock(mutex_);
    fraction_ = fraction;
    stage_.assign(stage);
  }
  [[nodiscard]] std::pair<double, QString> read() const {
    const std::lock_guard lock(mutex_);
    return {fraction_, coreSentence(stage_)};
  }

 private:
  mutable std::mutex mutex_;
  double fraction_ = 0.0;
  std::string stage_;
};

struct JobRunner::Running {
  int id = 0;
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
    if (const Running* running = shown()) {
      const auto [fraction, stage] = running->sink.read();
      Q_EMIT progressed(fraction, stage);
    }
    Q_EMIT changed();
  });
}

JobRunner::~JobRunner() {
  for (Lane& lane : lanes_) {
    lane.queue.clear();
    if (lane.current != nullptr) lane.current->thread.request_stop();
  }
}

void JobRunner::stop(Lane& own) {
  own.current->thread.request_stop();
  if (!own.current->job.abandonable) return;
  const Running& gone = *abandoned_.emplace_back(std::move(own.current));
  if (shown() == nullptr) poll_.stop();
  if (gone.job.cancelled) gone.job.cancelled();
  if (!gone.job.quiet) Q_EMIT finished(gone.job.title, JobOutcome::Cancelled, {}, gone.job.queue);
  if (const Running* other = shown()) Q_EMIT started(other->job.title);
}

bool JobRunner::busy() const {
  return std::any_of(lanes_.begin(), lanes_.end(),
                     [](const Lane& lane) { return lane.current != nullptr || !lane.queue.empty(); });
}

bool JobRunner::working() const {
  const Lane& work = lanes_[static_cast<std::size_t>(JobQueue::Work)];
  return work.current != nullptr || !work.queue.empty();
}

QString JobRunner::firstOf(JobQueue queue) const {
  const Lane& of = lanes_[static_cast<std::size_t>(queue)];
  if (of.current != nullptr && !of.current->job.quiet) return of.current->job.title;
  const auto found =
      std::find_if(of.queue.begin(), of.queue.end(), [](const Waiting& waiting) { return !waiting.job.quiet; });
  return found == of.queue.end() ? QString() : found->job.title;
}

/// What the job bar tells of: long work before what is only to be shown, and both before batches.
const JobRunner::Running* JobRunner::shown() const {
  for (const Lane& lane : lanes_)
    if (lane.current != nullptr && !lane.current->job.quiet) return lane.current.get();
  return nullptr;
}

QString JobRunner::title() const {
  const Running* running = shown();
  return running != nullptr ? running->job.title : QString();
}

int JobRunner::waiting() const {
  int count = 0;
  for (const Lane& lane : lanes_)
    for (const Waiting& waiting : lane.queue) count += waiting.job.quiet ? 0 : 1;
  return count;
}

std::vector<JobEntry> JobRunner::entries() const {
  std::vector<JobEntry> all;
  for (const Lane& lane : lanes_) {
    if (lane.current == nullptr || lane.current->job.quiet) continue;
    const auto [fraction, stage] = lane.current->sink.read();
    all.push_back({lane.current->id, lane.current->job.title, true, fraction, stage});
  }
  for (const Lane& lane : lanes_)
    for (const Waiting& waiting : lane.queue)
      if (!waiting.job.quiet) all.push_back({waiting.id, waiting.job.title, false, 0.0, {}});
  return all;
}

int JobRunner::run(Job job) {
  const JobQueue queue = job.queue;
  Lane& own = lane(queue);
  if (!job.key.empty()) {
    // What is asked for now makes what was asked for before pointless.
    for (auto it = own.queue.begin(); it != own.queue.end();) {
      if (it->job.key != job.key) {
        ++it;
        continue;
      }
      const std::function<void()> cancelled = std::move(it->job.cancelled);
      it = own.queue.erase(it);
      if (cancelled) cancelled();
    }
    if (own.current != nullptr && own.current->job.key == job.key) stop(own);
  }
  const int id = ++last_id_;
  own.queue.push_back({id, std::move(job)});
  if (own.current == nullptr) startNext(queue);
  Q_EMIT changed();
  return id;
}

void JobRunner::startNext(JobQueue queue) {
  Lane& own = lane(queue);
  if (own.queue.empty()) return;
  own.current = std::make_unique<Running>();
  own.current->id = own.queue.front().id;
  own.current->job = std::move(own.queue.front().job);
  own.queue.pop_front();
  Running* running = own.current.get();
  if (!running->job.quiet) {
    log(LogLevel::Info, running->job.title.toStdString());
    if (shown() == running) Q_EMIT started(running->job.title);
    poll_.start();
  }
  running->thread = std::jthread([this, running, queue](std::stop_token token) {
    JobContext context(token, &running->sink);
    try {
      running->apply = running->job.work(context);
      if (token.stop_requested()) running->outcome = JobOutcome::Cancelled;
    } catch (const Cancelled&) {
      running->outcome = JobOutcome::Cancelled;
    } catch (const InputError& e) {
      running->outcome = JobOutcome::Failed;
      running->sentence = coreSentence(e.what());
    } catch (const std::exception& e) {
      running->outcome = JobOutcome::Failed;
      log(LogLevel::Error, std::string("internal error: ") + e.what());
      running->sentence =
          QCoreApplication::translate("JobRunner", "Internal error, please report it: %1").arg(coreSentence(e.what()));
    }
    QMetaObject::invokeMethod(
        this, [this, queue, id = running->id] { complete(queue, id); }, Qt::QueuedConnection);
  });
}

void JobRunner::complete(JobQueue queue, int id) {
  std::erase_if(abandoned_, [id](const std::unique_ptr<Running>& gone) { return gone->id == id; });
  Lane& own = lane(queue);
  if (own.current == nullptr || own.current->id != id) return;
  const bool was_shown = shown() == own.current.get();
  const std::unique_ptr<Running> done = std::move(own.current);
  if (shown() == nullptr) poll_.stop();
  // Stopped, or replaced by another, when it was all but done.
  if (done->outcome == JobOutcome::Done && done->thread.get_stop_token().stop_requested())
    done->outcome = JobOutcome::Cancelled;
  if (done->thread.joinable()) done->thread.join();
  switch (done->outcome) {
    case JobOutcome::Done:
      try {
        if (done->apply) done->apply();
      } catch (const std::exception& e) {
        done->outcome = JobOutcome::Failed;
        done->sentence = coreSentence(e.what());
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
  const bool told = was_shown || queue == JobQueue::Batch || done->outcome == JobOutcome::Failed;
  if (told && !done->job.quiet) Q_EMIT finished(done->job.title, done->outcome, done->sentence, queue);
  if (own.current == nullptr) startNext(queue);
  // Another queue may have something to show again.
  if (const Running* other = shown(); was_shown && other != nullptr && &own != &lane(other->job.queue))
    Q_EMIT started(other->job.title);
  Q_EMIT changed();
}

void JobRunner::cancel() {
  if (const Running* running = shown()) cancel(running->id);
}

void JobRunner::cancel(int id) {
  for (JobQueue queue : every_queue) {
    Lane& lane = this->lane(queue);
    if (lane.current != nullptr && lane.current->id == id) {
      stop(lane);
      if (lane.current == nullptr) startNext(queue);
      Q_EMIT changed();
      return;
    }
    const auto found =
        std::find_if(lane.queue.begin(), lane.queue.end(), [id](const Waiting& waiting) { return waiting.id == id; });
    if (found == lane.queue.end()) continue;
    const std::function<void()> cancelled = std::move(found->job.cancelled);
    lane.queue.erase(found);
    if (cancelled) cancelled();
    Q_EMIT changed();
    return;
  }
}

void JobRunner::empty(JobQueue queue) {
  Lane& own = lane(queue);
  // Whoever waits for one of them is told, and may look at what waits.
  for (Waiting& waiting : std::exchange(own.queue, {})) {
    if (waiting.job.cancelled) waiting.job.cancelled();
    if (!waiting.job.quiet) Q_EMIT finished(waiting.job.title, JobOutcome::Cancelled, {}, queue);
  }
  if (own.current != nullptr) stop(own);
}

void JobRunner::cancelAll() {
  empty(JobQueue::Batch);
  cancelOfSession();
}

void JobRunner::cancelOfSession() {
  for (const JobQueue queue : every_queue)
    if (queue != JobQueue::Batch) empty(queue);
  Q_EMIT changed();
}

}  // namespace spindrift::gui
