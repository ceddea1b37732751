// SPDX-License-Identifier: GPL-3.0-or-later
// The guided way from a machine to a report: which steps there are, how far each is, where to go next.
#pragma once

#include <QObject>
#include <QString>
#include <array>
#include <string>

#include "core/tasks/steps.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {

class SessionModel;

struct StepStatus {
  StepState state = StepState::NotStarted;
  QString sentence;  ///< how far it is, what is wrong, what has changed, or why it is blocked
  QString number;    ///< "12 of 40", empty where nothing is counted
  [[nodiscard]] bool operator==(const StepStatus&) const = default;
};

[[nodiscard]] QString stepTitle(StepId step);
[[nodiscard]] QString stepInstruction(StepId step);  ///< what to do, one sentence
[[nodiscard]] const char* stepIcon(StepId step);
[[nodiscard]] QString stateWord(StepState state);
[[nodiscard]] const char* stateIcon(StepState state);
[[nodiscard]] Tone stateTone(StepState state);

class Workflow : public QObject {
  Q_OBJECT
 public:
  explicit Workflow(SessionModel& session, QObject* parent = nullptr);

  [[nodiscard]] StepId current() const { return current_; }
  [[nodiscard]] const StepStatus& status(StepId step) const { return status_[static_cast<std::size_t>(step)]; }
  void goTo(StepId step);
  void next();
  void back();
  [[nodiscard]] bool canGoNext() const { return current_ != StepId::Report; }
  [[nodiscard]] bool canGoBack() const { return current_ != StepId::Machine; }
  /// Works all states out again.
  void refresh();

 Q_SIGNALS:
  void currentChanged(spindrift::StepId step);
  void statusChanged();

 private:
  /// Lists are read again when there is something new in them.
  [[nodiscard]] const CaptureCounts& counts(const TaskGraph& tasks);

  SessionModel& session_;
  StepId current_ = StepId::Machine;
  std::array<StepStatus, all_steps.size()> status_{};
  std::string counted_;
  CaptureCounts counts_;
};

}  // namespace spindrift::gui
