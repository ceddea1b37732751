// SPDX-License-Identifier: GPL-3.0-or-later
// Everything that takes time runs here: a snapshot goes in, a result comes out and is applied on the GUI thread.
//
//   GUI thread    run(job) ------------------------------------------> apply()  (or failed(sentence), cancelled())
//   worker                  work(context) = compute on copies, return apply
//
// Jobs run one after another. Cancelling a job that waits takes it out; one that runs is asked to stop, and nothing of
// it is applied.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "core/base/job_context.h"

namespace spindrift::gui {

struct Job {
  QString title;  ///< "Evaluating 104 images"
  /// Runs on a worker thread; must not touch anything of the GUI. Returns what is to be done with the result, which
  /// runs on the GUI thread.
  std::function<std::function<void()>(JobContext&)> work;
  /// Runs on the GUI thread with one sentence for the user (bad input, or an internal error). May be empty.
  std::function<void(const QString&)> failed;
  std::function<void()> cancelled;  ///< may be empty
  bool quiet = false;               ///< a short helper: not shown in the job bar
};

enum class JobOutcome { Done, Failed, Cancelled };

class JobRunner : public QObject {
  Q_OBJECT
 public:
  explicit JobRunner(QObject* parent = nullptr);
  /// Cancels what runs and waits for it.
  ~JobRunner() override;

  void run(Job job);
  void cancel();  ///< the running job
  void cancelAll();
  [[nodiscard]] bool busy() const { return current_ != nullptr || !queue_.empty(); }
  [[nodiscard]] QString title() const;
  [[nodiscard]] int waiting() const { return static_cast<int>(queue_.size()); }

 Q_SIGNALS:
  void started(const QString& title);
  void progressed(double fraction, const QString& stage);
  void finished(const QString& title, spindrift::gui::JobOutcome outcome, const QString& sentence);

 private:
  class Sink;
  struct Running;
  void startNext();
  void complete();

  std::deque<Job> queue_;
  std::unique_ptr<Running> current_;
  QTimer poll_;
};

}  // namespace spindrift::gui
