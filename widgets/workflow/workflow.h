// SPDX-License-Identifier: GPL-3.0-or-later
// The guided way from a machine to a report: which steps there are, how far each is, where to go next.
#pragma once

#include <QObject>
#include <QString>
#include <array>

#include "widgets/theme/theme.h"

namespace spindrift::gui {

class SessionModel;

enum class StepId { Machine, WarmUp, Capture, Calibrate, Model, Discrepancy, Compensate, Verify, Review, Report };
inline constexpr std::array all_steps{StepId::Machine, StepId::WarmUp,      StepId::Capture,    StepId::Calibrate,
                                      StepId::Model,   StepId::Discrepancy, StepId::Compensate, StepId::Verify,
                                      StepId::Review,  StepId::Report};

enum class StepState {
  NotStarted,
  InProgress,
  Current,   ///< done, and nothing it depends on has changed since
  Outdated,  ///< done, but something it depends on has changed
  Blocked,   ///< cannot be done yet; the sentence says why
};

struct StepStatus {
  StepState state = StepState::NotStarted;
  QString sentence;  ///< how far it is, or why it is blocked
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
  void currentChanged(spindrift::gui::StepId step);
  void statusChanged();

 private:
  [[nodiscard]] StepStatus evaluate(StepId step) const;
  [[nodiscard]] StepStatus compensatorStatus() const;

  SessionModel& session_;
  StepId current_ = StepId::Machine;
  std::array<StepStatus, all_steps.size()> status_{};
};

}  // namespace spindrift::gui
