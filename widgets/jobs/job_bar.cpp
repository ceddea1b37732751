// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/job_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <utility>

#include "widgets/common/parts.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

JobBar::JobBar(JobRunner& runner, QWidget* parent) : QFrame(parent), runner_(runner) {
  setProperty("role", QStringLiteral("bar"));
  setFixedHeight(52);
  auto* line = new QHBoxLayout(this);
  line->setContentsMargins(16, 6, 8, 6);
  line->setSpacing(10);
  said_ = {QStringLiteral("check-circle"), Tone::Neutral, tr("Ready")};
  icon_ = new IconLabel(said_.icon, said_.tone);
  text_ = new OneLine(said_.text);
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedWidth(240);
  progress_->setAccessibleName(tr("Progress"));
  progress_->hide();
  cancel_ = makeButton(tr("Cancel"), "x");
  cancel_->setToolTip(tr("Stop what is running; nothing of it is applied"));
  cancel_->hide();
  hint_ = makeLabel({}, "secondaryText");
  line->addWidget(icon_);
  line->addWidget(text_, 1);
  line->addWidget(hint_);
  line->addWidget(progress_);
  line->addWidget(cancel_);
  connections_ = makeButton({}, "check-circle", "quiet");
  connections_->hide();
  line->addWidget(connections_);
  connect(connections_, &QPushButton::clicked, this, &JobBar::connectionsWanted);
  activity_ = makeButton(tr("Messages"), "note");
  activity_->setToolTip(tr("Jobs that run and wait, and all messages so far"));
  line->addWidget(activity_);

  connect(activity_, &QPushButton::clicked, this, &JobBar::activityWanted);
  connect(&runner_, &JobRunner::changed, this, [this] {
    const int waiting = runner_.waiting();
    activity_->setText(QChar(0x2009) + (waiting == 0 ? tr("Messages") : tr("%n waiting", nullptr, waiting)));
  });
  connect(cancel_, &QPushButton::clicked, this, [this, &runner] {
    runner.cancel();
    cancel_->setEnabled(false);
    text_->setText(tr("Stopping …"));
  });
  connect(&runner, &JobRunner::started, this, [this](const QString& title) {
    icon_->set(QStringLiteral("in-progress"), Tone::Accent);
    text_->setText(title);
    progress_->setValue(0);
    progress_->show();
    cancel_->setEnabled(true);
    cancel_->show();
  });
  connect(&runner, &JobRunner::progressed, this, [this, &runner](double fraction, const QString& stage) {
    progress_->setValue(static_cast<int>(1000 * fraction));
    if (cancel_->isEnabled()) {
      text_->setText(stage.isEmpty() ? runner.title() : runner.title() + QStringLiteral(": ") + stage);
    }
  });
  connect(&runner, &JobRunner::finished, this,
          [this](const QString& title, JobOutcome outcome, const QString& sentence, JobQueue queue) {
            QString icon = QStringLiteral("check-circle");
            Tone tone = Tone::Good;
            QString text = tr("%1: done").arg(title);
            if (outcome == JobOutcome::Failed) {
              icon = QStringLiteral("error");
              tone = Tone::Bad;
              text = sentence;
            } else if (outcome == JobOutcome::Cancelled) {
              icon = QStringLiteral("info");
              tone = Tone::Neutral;
              text = tr("%1: cancelled, nothing was changed").arg(title);
            }
            // What was only read to be shown does not hide what failed.
            const bool read = queue == JobQueue::Display || queue == JobQueue::Reading;
            const bool only_shown = read && outcome != JobOutcome::Failed;
            if (!only_shown || !failure_stands_) say({icon, tone, text});
            if (!runner_.title().isEmpty()) return;
            showSaid();
            // The next one, if it is to be seen, shows them again.
            progress_->hide();
            cancel_->hide();
          });
}

void JobBar::setHint(const QString& text) {
  hint_->setText(text);
}

void JobBar::say(Said said) {
  said_ = std::move(said);
  failure_stands_ = said_.tone == Tone::Bad;
  log_.add(said_.tone, said_.text);
}

void JobBar::showSaid() {
  icon_->set(said_.icon, said_.tone);
  text_->setText(onScreen(said_.text));
}

void JobBar::setMessage(const QString& text) {
  setMessage(Tone::Neutral, text);
}

void JobBar::setMessage(Tone tone, const QString& text) {
  say({QString::fromLatin1(toneIcon(tone)), tone, text});
  showSaid();
}

void JobBar::setConnections(Tone tone, const QString& text, const QString& tip) {
  connections_->setVisible(!text.isEmpty());
  if (text.isEmpty()) {
    connections_->setText({});
    return;
  }
  connections_->setText(QChar(0x2009) + onScreen(text));
  connections_->setAccessibleName(text);
  connections_->setIcon(icon(toneIcon(tone), theme().tone(tone)));
  connections_->setToolTip(tip);
}

QString JobBar::connections() const {
  return connections_->text().trimmed();
}

QString JobBar::message() const {
  return text_->text();
}

}  // namespace spindrift::gui
