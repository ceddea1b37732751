// SPDX-License-Identifier: GPL-3.0-or-later
// What files and folders that were dropped onto the window are, and where they belong; or why they cannot be taken.
#pragma once

#include <QString>
#include <QStringList>

class QMimeData;

namespace spindrift::gui {

struct Dropped {
  enum class Kind {
    Nothing,   ///< `why_not` says why
    Open,      ///< one session, campaign or log, opened as `spindrift FILE` does
    Captures,  ///< images and clouds for the campaign at hand
  };
  Kind kind = Kind::Nothing;
  QStringList files;
  QString why_not;  ///< one sentence
};

/// Looks at names and folders, and into no file. `campaign_open`: there is a campaign that captures can go to.
[[nodiscard]] Dropped droppedFiles(const QStringList& files, bool campaign_open);
/// Files and folders of this computer; empty if something else is dragged.
[[nodiscard]] QStringList localFiles(const QMimeData* data);

}  // namespace spindrift::gui
