// SPDX-License-Identifier: GPL-3.0-or-later
// The closed loop at the control while the user looks at something else: runs core/workflows/closed_loop on a thread of
// its own, the same loop as `spindrift-cli loop`. Belongs to the session model, not to a page; pages look at its
// snapshot. When the program ends the loop leaves at once, and the control's watchdog fades the compensation or holds
// it; the loop goes on later from its folder.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/workflows/closed_loop.h"

namespace spindrift::gui {

class SessionModel;

class ClosedLoopService : public QObject {
  Q_OBJECT
 public:
  /// The one that belongs to the session model.
  [[nodiscard]] static ClosedLoopService& of(SessionModel& session);
  ~ClosedLoopService() override;

  /// How a control is made of a plan; LinuxCNC unless a test has another.
  using MakeControl = std::function<std::unique_ptr<MachineControl>(const LoopPlan&)>;
  void setControl(MakeControl make) { make_ = std::move(make); }

  /// Takes over a plan; one sentence if that is not possible.
  QString load(const QString& file);
  [[nodiscard]] const LoopPlan* plan() const { return plan_ ? &*plan_ : nullptr; }
  [[nodiscard]] QString planFile() const { return file_; }
  /// Where the loop of this plan leaves its campaign; beside the plan unless it was chosen.
  [[nodiscard]] QString folder() const { return folder_; }
  void setFolder(const QString& folder);
  /// A loop of this folder was ended and can go on.
  [[nodiscard]] bool resumable() const;
  /// What a measuring cycle would move; nothing moves.
  [[nodiscard]] DryRun dryRun() const;

  /// The operator has confirmed what will move. One sentence if it does not begin.
  QString start();
  /// The compensation fades to zero, and the loop ends.
  void stop();
  [[nodiscard]] bool running() const { return running_; }
  /// When Spindrift falls silent: hold the compensation, or fade.
  void setHold(bool hold);
  [[nodiscard]] bool hold() const { return wishes_->hold; }
  /// The operator's answer to what was named.
  void accept(const std::vector<std::string>& ids);
  /// Shows the page of the live compensation.
  void ask() { Q_EMIT asked(); }

  struct Snapshot {
    LoopStatus status;
    LoopResult result;
    bool any = false;                         ///< the loop has turned at least once
    std::optional<DiscrepancyResult> choice;  ///< effects that wait for the operator's answer
    QString failure;                          ///< why it ended before its time
  };
  [[nodiscard]] const Snapshot& snapshot() const { return snapshot_; }

 Q_SIGNALS:
  void changed();
  void asked();

 private:
  explicit ClosedLoopService(SessionModel& session);
  void run(MachineControl& control);
  void poll();

  MakeControl make_;
  QTimer timer_;
  std::optional<LoopPlan> plan_;
  QString file_;
  QString folder_;
  std::shared_ptr<LoopWishes> wishes_ = std::make_shared<LoopWishes>();
  std::unique_ptr<MachineControl> control_;
  std::thread thread_;
  bool running_ = false;
  Snapshot snapshot_;

  std::mutex mutex_;  ///< of what follows, which the thread writes
  std::condition_variable answered_;
  Snapshot latest_;
  std::optional<std::vector<std::string>> answer_;
  bool ended_ = false;
};

}  // namespace spindrift::gui
