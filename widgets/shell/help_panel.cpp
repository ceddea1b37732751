// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/help_panel.h"

#include <QFile>
#include <QHBoxLayout>
#include <QTextBrowser>
#include <QToolButton>
#include <QVBoxLayout>

#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/effect_listing.h"
#include "widgets/common/parts.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"

static void loadHelp() {
  Q_INIT_RESOURCE(help);
}

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

}  // namespace

HelpPanel::HelpPanel(QWidget* parent) : QFrame(parent) {
  loadHelp();
  setAccessibleName(tr("Help on this step"));
  setFixedWidth(320);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 8, 8, 8);
  auto* head = new QHBoxLayout;
  head->addWidget(makeLabel(tr("Help"), "sectionTitle"), 1);
  auto* close = new QToolButton;
  close->setIcon(icon("x"));
  close->setToolTip(tr("Close the help (F1)"));
  close->setAccessibleName(tr("Close the help"));
  connect(close, &QToolButton::clicked, this, &HelpPanel::closed);
  head->addWidget(close);
  column->addLayout(head);
  text_ = new QTextBrowser;
  text_->setFrameShape(QFrame::NoFrame);
  text_->setAccessibleName(tr("Help text"));
  text_->document()->setDefaultFont(textFont(sizes::font_body));
  column->addWidget(text_, 1);
}

void HelpPanel::showStep(StepId step) {
  if (step == step_ && !text_->document()->isEmpty()) return;
  step_ = step;
  QFile file(QStringLiteral(":/help/%1.html").arg(QLatin1String(helpName(step))));
  if (!file.open(QIODevice::ReadOnly)) return;
  QString html = QString::fromUtf8(file.readAll());
  // The catalogue speaks for itself, so that the help cannot fall behind it.
  if (step == StepId::Discrepancy) {
    html += QStringLiteral("<h4>%1</h4>").arg(tr("Effects of the catalogue"));
    html += QString::fromStdString(effectsHtml(everyEffect()));
  }
  text_->setHtml(html);
}

}  // namespace spindrift::gui
