// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/common/message_page.h"

#include <QVBoxLayout>

#include "widgets/common/parts.h"

namespace spindrift::gui {

MessagePage::MessagePage(PageContext page_context, StepId page_step, QWidget* parent)
    : Page(std::move(page_context), page_step, parent) {
  state_ = new EmptyState(stepIcon(page_step), {}, {});
  content()->addWidget(state_, 1);
}

void MessagePage::refresh() {
  const StepStatus& status = context().workflow.status(step());
  state_->setTexts(tr("Nothing to do here with this campaign"), status.sentence);
}

}  // namespace spindrift::gui
