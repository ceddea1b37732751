// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the desktop is light or dark, and when that changes: the setting "color-scheme" of the desktop portal
// (org.freedesktop.appearance) where there is one, else the colours the platform gave the program at its start.
#pragma once

#include <QObject>

#include "widgets/theme/theme.h"

class QDBusPendingCallWatcher;
class QDBusVariant;

namespace spindrift::gui {

class SystemLook : public QObject {
  Q_OBJECT
 public:
  /// To be asked for the first time before a theme is applied.
  static SystemLook& instance();
  [[nodiscard]] ThemeKind kind() const { return kind_; }

  /// A setting of the portal. Of "color-scheme" 1 prefers dark, 2 light, 0 nothing; others are passed over.
  void take(const QString& group, const QString& key, uint value);

 Q_SIGNALS:
  void changed(spindrift::gui::ThemeKind kind);

 private Q_SLOTS:
  void settingChanged(const QString& group, const QString& key, const QDBusVariant& value);

 private:
  SystemLook();
  void answered(QDBusPendingCallWatcher* watcher);

  ThemeKind of_platform_;
  ThemeKind kind_;
};

}  // namespace spindrift::gui
