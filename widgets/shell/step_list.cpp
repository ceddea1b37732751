// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/step_list.h"

#include <QButtonGroup>
#include <QKeyEvent>
#include <QPainter>
#include <QVBoxLayout>

#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

StepButton::StepButton(StepId step, QWidget* parent) : QAbstractButton(parent), step_(step) {
  setCheckable(true);
  setText(stepTitle(step));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAttribute(Qt::WA_Hover);
}

void StepButton::setStatus(const StepStatus& status) {
  status_ = status;
  setAccessibleName(stepTitle(step_) + QStringLiteral(", ") + stateWord(status.state) +
                    (status.number.isEmpty() ? QString() : QStringLiteral(", ") + onScreen(status.number)));
  setAccessibleDescription(onScreen(status.sentence));
  setToolTip(onScreen(status.sentence));
  update();
}

QSize StepButton::sizeHint() const {
  return {208, 56};
}

void StepButton::paintEvent(QPaintEvent*) {
  const Theme& t = theme();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(rect()).adjusted(8, 2, -8, -2);
  if (isChecked() || underMouse()) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(isChecked() ? t.accent_soft : t.surface_alt);
    painter.drawRoundedRect(box, 6, 6);
  }
  if (isChecked()) {
    painter.setBrush(t.accent);
    painter.drawRoundedRect(QRectF(box.left(), box.top() + 10, 3, box.height() - 20), 1.5, 1.5);
  }
  if (hasFocus()) {
    painter.setPen(QPen(t.accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(box.adjusted(1, 1, -1, -1), 6, 6);
  }
  const double ratio = devicePixelRatioF();
  const bool blocked = status_.state == StepState::Blocked;
  const QColor ink = blocked ? t.text_secondary : t.text;
  painter.drawPixmap(
      QPointF(box.left() + 14, box.center().y() - 10),
      iconPixmap(QString::fromLatin1(stepIcon(step_)), isChecked() ? t.accent : ink, sizes::icon, ratio));
  painter.setPen(ink);
  painter.setFont(textFont(sizes::font_body, isChecked() ? QFont::DemiBold : QFont::Medium));
  painter.drawText(QRectF(box.left() + 46, box.top() + 6, box.width() - 50, 20), Qt::AlignVCenter, text());
  const QColor tone = t.tone(stateTone(status_.state));
  painter.drawPixmap(QPointF(box.left() + 46, box.bottom() - 22),
                     iconPixmap(QString::fromLatin1(stateIcon(status_.state)), tone, 14, ratio));
  painter.setPen(tone);
  painter.setFont(textFont(sizes::font_secondary));
  painter.drawText(QRectF(box.left() + 65, box.bottom() - 24, box.width() - 68, 18), Qt::AlignVCenter,
                   status_.number.isEmpty()
                       ? stateWord(status_.state)
                       : stateWord(status_.state) + QStringLiteral(" · ") + onScreen(status_.number));
}

StepList::StepList(Workflow& workflow, QWidget* parent) : QFrame(parent), workflow_(workflow) {
  setProperty("role", QStringLiteral("sidebar"));
  setFixedWidth(208);
  setAccessibleName(tr("Steps"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 8);
  column->setSpacing(0);
  auto* group = new QButtonGroup(this);
  group->setExclusive(true);
  for (const StepId step : all_steps) {
    auto* button = new StepButton(step);
    group->addButton(button, static_cast<int>(step));
    column->addWidget(button);
    buttons_.push_back(button);
  }
  column->addStretch();
  connect(group, &QButtonGroup::idClicked, this, [this](int id) { workflow_.goTo(static_cast<StepId>(id)); });
  connect(&workflow_, &Workflow::statusChanged, this, &StepList::update_);
  connect(&workflow_, &Workflow::currentChanged, this, &StepList::update_);
  update_();
}

void StepList::update_() {
  bool focused = false;
  for (const StepButton* button : buttons_) focused = focused || button->hasFocus();
  if (focused) button(workflow_.current())->setFocus(Qt::OtherFocusReason);
  for (StepButton* button : buttons_) {
    button->setStatus(workflow_.status(button->step()));
    button->setChecked(button->step() == workflow_.current());
  }
}

void StepList::keyPressEvent(QKeyEvent* event) {
  const int step = event->key() == Qt::Key_Down ? 1 : event->key() == Qt::Key_Up ? -1 : 0;
  if (step == 0) {
    QFrame::keyPressEvent(event);
    return;
  }
  if (step > 0) {
    workflow_.next();
  } else {
    workflow_.back();
  }
  button(workflow_.current())->setFocus(Qt::TabFocusReason);
}

}  // namespace spindrift::gui
