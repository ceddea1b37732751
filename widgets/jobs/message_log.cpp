// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/message_log.h"

namespace spindrift::gui {
namespace {

constexpr std::size_t most_messages = 1000;

}  // namespace

void MessageLog::add(Tone tone, const QString& text) {
  messages_.push_front({QDateTime::currentDateTime(), tone, text});
  if (messages_.size() > most_messages) messages_.pop_back();
  Q_EMIT added();
}

}  // namespace spindrift::gui
