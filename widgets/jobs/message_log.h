// SPDX-License-Identifier: GPL-3.0-or-later
// Everything the window has said, to be read again: a sentence in the job bar is soon replaced by the next one.
#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <deque>

#include "widgets/theme/theme.h"

namespace spindrift::gui {

struct Message {
  QDateTime time;
  Tone tone = Tone::Neutral;
  QString text;
};

class MessageLog : public QObject {
  Q_OBJECT
 public:
  explicit MessageLog(QObject* parent = nullptr) : QObject(parent) {}
  void add(Tone tone, const QString& text);
  /// The newest first; at most a thousand.
  [[nodiscard]] const std::deque<Message>& messages() const { return messages_; }

 Q_SIGNALS:
  void added();

 private:
  std::deque<Message> messages_;
};

}  // namespace spindrift::gui
