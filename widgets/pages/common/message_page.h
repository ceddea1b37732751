// SPDX-License-Identifier: GPL-3.0-or-later
// What a step shows while it has nothing to work on: why, and what would change that.
#pragma once

#include "widgets/pages/page.h"

namespace spindrift::gui {

class EmptyState;

class MessagePage : public Page {
  Q_OBJECT
 public:
  MessagePage(PageContext context, StepId step, QWidget* parent = nullptr);
  void refresh() override;

 private:
  EmptyState* state_;
};

}  // namespace spindrift::gui
