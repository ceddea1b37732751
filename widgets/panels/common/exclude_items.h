// SPDX-License-Identifier: GPL-3.0-or-later
// Captures that are left out of the evaluation with a reason, one or many at once, or brought back.
#pragma once

#include <QString>
#include <QStringList>

class QWidget;

namespace spindrift::gui {

struct PageContext;
class SessionModel;

/// What the button says that takes these captures out, or brings them back where all of them are out.
[[nodiscard]] QString excludeText(const SessionModel& session, const QStringList& captures);

/// Does it, as one step that can be undone; asks for the reason first. `proposed` is the reason that the user may
/// change.
void excludeOrBringBack(PageContext& context, QWidget* parent, const QStringList& captures, const QString& proposed);

}  // namespace spindrift::gui
