// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/common/exclude_items.h"

#include <QCoreApplication>
#include <QInputDialog>
#include <QLineEdit>
#include <algorithm>

#include "widgets/commands/commands.h"
#include "widgets/panels/page_context.h"

namespace spindrift::gui {
namespace {

struct ExcludeItems {
  Q_DECLARE_TR_FUNCTIONS(ExcludeItems)
};

bool allExcluded(const SessionModel& session, const QStringList& captures) {
  return !captures.isEmpty() && std::all_of(captures.begin(), captures.end(), [&](const QString& capture) {
    return session.excluded().contains(capture);
  });
}

}  // namespace

QString excludeText(const SessionModel& session, const QStringList& captures) {
  const int n = static_cast<int>(captures.size());
  if (allExcluded(session, captures))
    return n > 1 ? ExcludeItems::tr("Bring back %n captures", nullptr, n) : ExcludeItems::tr("Bring back");
  return n > 1 ? ExcludeItems::tr("Exclude %n captures …", nullptr, n) : ExcludeItems::tr("Exclude …");
}

void excludeOrBringBack(PageContext& context, QWidget* parent, const QStringList& captures, const QString& proposed) {
  if (captures.isEmpty()) return;
  QString reason;
  if (!allExcluded(context.session, captures)) {
    bool given = false;
    reason = QInputDialog::getText(parent, excludeText(context.session, captures).remove(QStringLiteral(" …")),
                                   ExcludeItems::tr("Why is this left out? The report will say so."), QLineEdit::Normal,
                                   proposed, &given)
                 .trimmed();
    if (!given || reason.isEmpty()) return;
  }
  context.undo.push(new ExcludeCommand(context.session, captures, reason));
}

}  // namespace spindrift::gui
