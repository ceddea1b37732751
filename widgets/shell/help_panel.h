// SPDX-License-Identifier: GPL-3.0-or-later
// Help beside the step: what it is for, its figure and its formula. Opened and closed with F1; whether it is open is
// remembered.
#pragma once

#include <QFrame>

#include "widgets/workflow/workflow.h"

namespace spindrift::gui {

class HelpText;

class HelpPanel : public QFrame {
  Q_OBJECT
 public:
  explicit HelpPanel(QWidget* parent = nullptr);
  void showStep(StepId step);
  [[nodiscard]] HelpText* text() const { return text_; }
  [[nodiscard]] QSize sizeHint() const override { return {320, 400}; }

 Q_SIGNALS:
  void closed();

 private:
  StepId step_ = StepId::Machine;
  HelpText* text_;
};

}  // namespace spindrift::gui
