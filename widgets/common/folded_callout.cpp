// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/folded_callout.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <QVariant>

#include "widgets/common/parts.h"
#include "widgets/common/words.h"

namespace spindrift::gui {
namespace {

constexpr auto callout_opened_key = "opened";

/// Up to the first full stop that another sentence follows.
QString firstSentence(const QString& sentences) {
  static const QRegularExpression next(QStringLiteral("(?<=[.!?])\\s+(?=\\p{Lu})"));
  const QRegularExpressionMatch match = next.match(sentences);
  return match.hasMatch() ? sentences.left(match.capturedStart()) : sentences;
}

void arrangeFolded(Callout& callout, const QString& first) {
  const bool opened = callout.property(callout_opened_key).toString() == callout.sentence();
  if (auto* text = callout.findChild<WrappedLabel*>()) text->setText(keptTogether(opened ? callout.sentence() : first));
  callout.setAction(opened ? QCoreApplication::translate("FoldedCallout", "Less")
                           : QCoreApplication::translate("FoldedCallout", "Details"),
                    [&callout, first, opened] {
                      callout.setProperty(callout_opened_key, opened ? QString() : callout.sentence());
                      arrangeFolded(callout, first);
                    });
}

}  // namespace

void showFolded(Callout& callout, Tone tone, const QString& sentences) {
  callout.show(tone, sentences);
  const QString first = firstSentence(callout.sentence());
  if (first == callout.sentence()) {
    callout.setAction({}, {});
  } else {
    arrangeFolded(callout, first);
  }
}

}  // namespace spindrift::gui
