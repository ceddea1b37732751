// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/help_panel.h"

#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/discrepancy/catalogue.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/help_text.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/icons.h"

namespace spindrift::gui {
namespace {

const char* helpName(StepId step) {
  switch (step) {
    case StepId::Machine:
      return "machine";
    case StepId::WarmUp:
      return "warm-up";
    case StepId::Capture:
      return "capture";
    case StepId::Calibrate:
      return "calibrate";
    case StepId::Model:
      return "model";
    case StepId::Discrepancy:
      return "discrepancy";
    case StepId::Compensate:
      return "compensate";
    case StepId::Verify:
      return "verify";
    case StepId::Review:
      return "review";
    default:
      return "report";
  }
}

/// The catalogue speaks for itself, so that the help cannot fall behind it.
QString effectsHtml() {
  QString html = QStringLiteral("<h4>%1</h4><ul>").arg(HelpPanel::tr("Effects of the catalogue"));
  for (const Effect& effect : everyEffect()) {
    html += QStringLiteral("<li><b>%1</b> (%2): %3 <i>%4</i></li>")
                .arg(sentenceStart(effectTitle(effect.id)).toHtmlEscaped(),
                     QString::fromStdString(effect.id).toHtmlEscaped(), coreSentence(effect.physics).toHtmlEscaped(),
                     formulaText(effect.formula).toHtmlEscaped());
  }
  return html + QStringLiteral("</ul>");
}

}  // namespace

HelpPanel::HelpPanel(QWidget* parent) : QFrame(parent) {
  setAccessibleName(tr("Help on this step"));
  setFixedWidth(320);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 8, 6, 8);
  auto* head = new QHBoxLayout;
  head->addWidget(makeLabel(tr("Help"), "sectionTitle"), 1);
  auto* close = new QToolButton;
  close->setIcon(icon("x"));
  close->setToolTip(tr("Close the help (F1)"));
  close->setAccessibleName(tr("Close the help"));
  connect(close, &QToolButton::clicked, this, &HelpPanel::closed);
  head->addWidget(close);
  column->addLayout(head);
  text_ = new HelpText(tr("Help text"));
  column->addWidget(text_, 1);
}

void HelpPanel::showStep(StepId step) {
  if (step == step_ && !text_->document()->isEmpty()) return;
  step_ = step;
  text_->showHelp(QLatin1String(helpName(step)), step == StepId::Discrepancy ? effectsHtml() : QString());
}

}  // namespace spindrift::gui
