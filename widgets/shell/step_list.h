// SPDX-License-Identifier: GPL-3.0-or-later
// The steps at the left of the window, each with its state and one sentence.
#pragma once

#include <QAbstractButton>
#include <QFrame>
#include <vector>

#include "widgets/workflow/workflow.h"

namespace spindrift::gui {

/// One step: icon, name, state (icon and word).
class StepButton : public QAbstractButton {
  Q_OBJECT
 public:
  StepButton(StepId step, QWidget* parent = nullptr);
  void setStatus(const StepStatus& status);
  [[nodiscard]] StepId step() const { return step_; }
  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  StepId step_;
  StepStatus status_;
};

class StepList : public QFrame {
  Q_OBJECT
 public:
  StepList(Workflow& workflow, QWidget* parent = nullptr);
  [[nodiscard]] StepButton* button(StepId step) const { return buttons_[static_cast<std::size_t>(step)]; }

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void update_();
  Workflow& workflow_;
  std::vector<StepButton*> buttons_;
};

}  // namespace spindrift::gui
