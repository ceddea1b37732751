// SPDX-License-Identifier: GPL-3.0-or-later
// Written by resources/translations/update.py from the sources; do not edit.
#include "widgets/common/core_formats/groups.h"

#include <QtGlobal>

// clang-format off

std::span<const char* const> spindrift::gui::core_formats::session() noexcept {
  static const char* const formats[] = {
    QT_TRANSLATE_NOOP("core", " {} now in the folder \"removed\"."),
    QT_TRANSLATE_NOOP("core", " {} removed."),
    QT_TRANSLATE_NOOP("core", "The campaign {} was in the folder of the session and not in its database (one from before it was imported?): it is there again, without results."),
    QT_TRANSLATE_NOOP("core", "The folder campaigns/{} is no campaign of the session and was left as it is."),
    QT_TRANSLATE_NOOP("core", "The session was not closed the last time; it is as it was left: {} and {} are there."),
    QT_TRANSLATE_NOOP("core", "a result"),
    QT_TRANSLATE_NOOP("core", "and {} more"),
    QT_TRANSLATE_NOOP("core", "are missing"),
    QT_TRANSLATE_NOOP("core", "cannot be copied into the session: {}."),
    QT_TRANSLATE_NOOP("core", "cannot be made: {}."),
    QT_TRANSLATE_NOOP("core", "cannot be moved away: {}."),
    QT_TRANSLATE_NOOP("core", "cannot be opened for work: {}; allowed: a folder you may write to."),
    QT_TRANSLATE_NOOP("core", "copying the campaign into the session"),
    QT_TRANSLATE_NOOP("core", "has another content"),
    QT_TRANSLATE_NOOP("core", "has lost its file {}; put it back from a copy of the session."),
    QT_TRANSLATE_NOOP("core", "has the columns \"{}\"; allowed for capturing into it: \"{}\"."),
    QT_TRANSLATE_NOOP("core", "have another content"),
    QT_TRANSLATE_NOOP("core", "is missing"),
    QT_TRANSLATE_NOOP("core", "is not a session; allowed: a folder with {}."),
    QT_TRANSLATE_NOOP("core", "is not empty; allowed: a new or an empty folder for a new session."),
    QT_TRANSLATE_NOOP("core", "is not there any more (removed, renamed, or the network folder is gone). Nothing was stored; bring the folder back and do the last step again."),
    QT_TRANSLATE_NOOP("core", "is of version {} and cannot be copied before it is changed: {}; make room beside it or open it with the older program."),
    QT_TRANSLATE_NOOP("core", "is open in another window ({}). Close it there first; nothing was changed here."),
    QT_TRANSLATE_NOOP("core", "keeps the campaign \"{}\" in \"{}\"; allowed: a folder in campaigns."),
    QT_TRANSLATE_NOOP("core", "reading the files"),
    QT_TRANSLATE_NOOP("core", "the session's database cannot be used: {}."),
    QT_TRANSLATE_NOOP("core", "the session's database holds a key that is not a number."),
    QT_TRANSLATE_NOOP("core", "the session's database holds a key that is too large."),
    QT_TRANSLATE_NOOP("core", "the session's database holds a value of another kind than its column."),
    QT_TRANSLATE_NOOP("core", "the session's database holds {} that is not JSON."),
    QT_TRANSLATE_NOOP("core", "the session's database is damaged ({}); take it from a copy of the session. The captures in the folder campaigns are not touched by that."),
    QT_TRANSLATE_NOOP("core", "unknown process"),
    QT_TRANSLATE_NOOP("core", "was added"),
    QT_TRANSLATE_NOOP("core", "were added"),
  };
  return formats;
}
