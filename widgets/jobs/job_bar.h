// SPDX-License-Identifier: GPL-3.0-or-later
// The bar at the bottom of the window: what runs, how far it is, cancel; and the last thing that was said. What is only
// read to be shown does not hide what failed. All of it can be read again in the list of jobs and messages
// (activity_dialog.h).
#pragma once

#include <QFrame>

#include "widgets/jobs/job_runner.h"
#include "widgets/jobs/message_log.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace spindrift::gui {

class IconLabel;

class JobBar : public QFrame {
  Q_OBJECT
 public:
  explicit JobBar(JobRunner& runner, QWidget* parent = nullptr);
  /// A short text at the right end (the value under the cursor).
  void setHint(const QString& text);
  void setMessage(const QString& text);
  /// The same with a meaning of its own.
  void setMessage(Tone tone, const QString& text);
  /// The page on which something failed is left: what the next one reads to be shown may be said in its place.
  void leaveFailure() { failure_stands_ = false; }
  /// What is connected, as long as it is: stands beside whatever else is said. `text` empty: nothing is.
  void setConnections(Tone tone, const QString& text, const QString& tip);
  [[nodiscard]] QString connections() const;
  [[nodiscard]] QPushButton* cancelButton() const { return cancel_; }
  [[nodiscard]] QString message() const;
  /// Everything it has said.
  [[nodiscard]] MessageLog& log() { return log_; }
  [[nodiscard]] QPushButton* activityButton() const { return activity_; }

 Q_SIGNALS:
  /// The user wants to see jobs and messages.
  void activityWanted();
  /// The user wants to see the connections.
  void connectionsWanted();

 private:
  struct Said {
    QString icon;
    Tone tone = Tone::Neutral;
    QString text;
  };
  /// It is the last thing said; a job that is shown stays shown.
  void say(Said said);
  void showSaid();

  JobRunner& runner_;
  MessageLog log_;
  Said said_;
  bool failure_stands_ = false;
  IconLabel* icon_;
  QLabel* text_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QPushButton* activity_;
  QLabel* hint_;
  QPushButton* connections_;
};

}  // namespace spindrift::gui
