// SPDX-License-Identifier: GPL-3.0-or-later
// What the user prefers, on this computer and for all sessions; kept by QSettings, effective at once: whoever shows
// what depends on it listens to PreferencesNotifier. What belongs to a campaign is an option of the session and not
// here.
#pragma once

#include <QObject>
#include <QString>
#include <optional>

#include "widgets/theme/shown_units.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {

struct Preferences {
  enum class Look { System, Light, Dark };
  Look look = Look::System;
  QString language;  ///< as in QLocale::name(): "de"; empty: the language of the system
  /// Digits after the point of measured lengths in mm, 0 ... 6; nothing: as many as each page finds fitting.
  std::optional<int> length_decimals;
  UnitChoice units;                   ///< on screen; files, exports and reports have their own
  QString sessions_folder;            ///< where new sessions go; empty: "Spindrift" in the user's documents
  double goal_um = 5.0;               ///< of a new campaign: what may remain of displacements, > 0
  double goal_urad = 0.0;             ///< of a new campaign: what may remain of rotations; 0: not judged
  bool ask_before_quitting = true;    ///< while something is being worked out, or a machine is compensated
  bool ask_before_discarding = true;  ///< an effect that is edited and not taken over

  [[nodiscard]] bool operator==(const Preferences&) const = default;
};

inline constexpr int most_length_decimals = 6;

/// As kept, read from the settings at each call. What cannot be read, or is outside its range, has its default.
[[nodiscard]] Preferences preferences();
/// Keeps them and tells everybody, if anything is another.
void setPreferences(const Preferences& wanted);

class PreferencesNotifier : public QObject {
  Q_OBJECT
 public:
  static PreferencesNotifier& instance();
  /// Held in memory, for what is asked for every cell of a table.
  [[nodiscard]] const Preferences& now() const { return now_; }
  /// Of a new window: another process may have changed what is kept.
  void readAgain();

 Q_SIGNALS:
  void changed(const spindrift::gui::Preferences& before, const spindrift::gui::Preferences& now);

 private:
  PreferencesNotifier();
  friend void setPreferences(const Preferences& wanted);
  Preferences now_;
};

/// What the user wants now; light or dark as the desktop is, if so wished.
[[nodiscard]] ThemeKind wantedTheme();

/// Where sessions go if the user prefers no folder: "Spindrift" in the documents.
[[nodiscard]] QString usualSessionsFolder();

/// Decimals of measured lengths in mm where a page finds `usual` fitting.
[[nodiscard]] int lengthDecimals(int usual);

/// The folder in which something of this kind ("campaign", "log", "export") was chosen the last time and which is still
/// there; else `otherwise`.
[[nodiscard]] QString lastFolder(const QString& kind, const QString& otherwise = {});
/// `chosen`: a folder, or a file in it.
void rememberFolder(const QString& kind, const QString& chosen);

}  // namespace spindrift::gui
