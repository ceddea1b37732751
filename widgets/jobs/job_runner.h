// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that takes time runs here: a snapshot goes in, a result comes out and is applied on the GUI thread.
//
//   GUI thread    run(job) ------------------------------------------> apply()  (or failed(sentence), cancelled())
//   worker                  work(context) = compute on copies, return apply
//
// Queues, each with a thread of its own: long work runs one after another. The campaign or session that was chosen does
// not wait for work on the one at hand. What is only to be shown and is quick (a picture that was chosen) waits neither
// for that nor for what takes a while to read, nor for files that are held against what the session knows of them. What
// runs for hours beside the work of the day (a batch) keeps none of these from running. A job with the `key` of an
// older one of its queue takes its place: the older is not wanted any more. Cancelling a job that waits takes it out;
// one that runs is asked to stop, and nothing of it is applied.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/job_context.h"

namespace spindrift::gui {

/// In the order in which the job bar tells of them.
enum class JobQueue {
  Campaign,  ///< the one that was chosen is read
  Work,
  Display,  ///< pictures
  Reading,  ///< details of what is stored, documents, a source that is listened to
  Files,    ///< hashes of all files
  Batch,
};

struct Job {
  QString title;  ///< "Evaluating 104 images"
  /// Runs on a worker thread; must not touch anything of the GUI. Returns what is to be done with the result, which
  /// runs on the GUI thread.
  std::function<std::function<void()>(JobContext&)> work;
  /// Runs on the GUI thread with one sentence for the user (bad input, or an internal error). May be empty.
  std::function<void(const QString&)> failed;
  std::function<void()> cancelled;  ///< may be empty
  bool quiet = false;               ///< a short helper: not shown in the job bar
  JobQueue queue = JobQueue::Work;
  std::string key;  ///< what it is for; empty: takes nobody's place
  /// It holds nothing that another needs, so that nobody waits for it to end when it is cancelled or replaced.
  bool abandonable = false;
};

enum class JobOutcome { Done, Failed, Cancelled };

/// A job that runs or waits.
struct JobEntry {
  int id = 0;
  QString title;
  bool running = false;
  double fraction = 0.0;
  QString stage;
};

class JobRunner : public QObject {
  Q_OBJECT
 public:
  explicit JobRunner(QObject* parent = nullptr);
  /// Cancels what runs and waits for it.
  ~JobRunner() override;

  /// The id by which it can be cancelled.
  int run(Job job);
  void cancel();  ///< the running job of the long ones, else the one that is shown
  void cancel(int id);
  void cancelAll();
  /// Another session is opened: what runs or waits was of the one before, batches are of none.
  void cancelOfSession();
  [[nodiscard]] bool busy() const;
  /// Long work runs or waits.
  [[nodiscard]] bool working() const;
  /// The first job of a queue that runs or waits and is not quiet, by its title; empty: there is none.
  [[nodiscard]] QString firstOf(JobQueue queue) const;
  [[nodiscard]] QString title() const;
  [[nodiscard]] int waiting() const;
  /// Running ones first, then in the order in which they will run; quiet ones are left out.
  [[nodiscard]] std::vector<JobEntry> entries() const;

 Q_SIGNALS:
  void started(const QString& title);
  void progressed(double fraction, const QString& stage);
  /// A job that was shown has ended, or a batch, or one that failed while another was shown.
  void finished(const QString& title, spindrift::gui::JobOutcome outcome, const QString& sentence,
                spindrift::gui::JobQueue queue);
  /// `entries` is another: something runs, waits, got on or ended.
  void changed();

 private:
  class Sink;
  struct Running;
  struct Waiting {
    int id = 0;
    Job job;
  };
  struct Lane {
    std::deque<Waiting> queue;
    std::unique_ptr<Running> current;
  };

  /// Nothing of it is begun any more, and what runs is stopped.
  void empty(JobQueue queue);
  /// The one that runs is stopped, and where it is abandonable the queue is free at once.
  void stop(Lane& own);
  [[nodiscard]] Lane& lane(JobQueue queue) { return lanes_[static_cast<std::size_t>(queue)]; }
  [[nodiscard]] const Running* shown() const;
  void startNext(JobQueue queue);
  void complete(JobQueue queue, int id);

  std::array<Lane, 6> lanes_;
  std::vector<std::unique_ptr<Running>> abandoned_;  ///< until their threads end
  int last_id_ = 0;
  QTimer poll_;
};

}  // namespace spindrift::gui
