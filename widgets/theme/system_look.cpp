// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/theme/system_look.h"

#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusPendingCallWatcher>
#include <QDBusPendingReply>
#include <QDBusVariant>
#include <QGuiApplication>
#include <QPalette>

namespace spindrift::gui {
namespace {

constexpr auto portal = "org.freedesktop.portal.Desktop";
constexpr auto portal_path = "/org/freedesktop/portal/desktop";
constexpr auto portal_settings = "org.freedesktop.portal.Settings";
constexpr auto appearance = "org.freedesktop.appearance";
constexpr auto colour_scheme = "color-scheme";

}  // namespace

SystemLook& SystemLook::instance() {
  static SystemLook look;
  return look;
}

SystemLook::SystemLook()
    : of_platform_(QGuiApplication::palette().color(QPalette::Window).lightness() < 128 ? ThemeKind::Dark
                                                                                        : ThemeKind::Light),
      kind_(of_platform_) {
  // Without a bus the connection would try to start one.
  if (qEnvironmentVariableIsEmpty("DBUS_SESSION_BUS_ADDRESS")) return;
  QDBusConnection bus = QDBusConnection::sessionBus();
  bus.connect(QLatin1String(portal), QLatin1String(portal_path), QLatin1String(portal_settings),
              QStringLiteral("SettingChanged"), this, SLOT(settingChanged(QString, QString, QDBusVariant)));
  QDBusMessage ask = QDBusMessage::createMethodCall(QLatin1String(portal), QLatin1String(portal_path),
                                                    QLatin1String(portal_settings), QStringLiteral("Read"));
  ask << QString::fromLatin1(appearance) << QString::fromLatin1(colour_scheme);
  auto* watcher = new QDBusPendingCallWatcher(bus.asyncCall(ask), this);
  connect(watcher, &QDBusPendingCallWatcher::finished, this, &SystemLook::answered);
}

void SystemLook::answered(QDBusPendingCallWatcher* watcher) {
  const QDBusPendingReply<QDBusVariant> reply = *watcher;
  watcher->deleteLater();
  if (reply.isError()) return;
  // Read wraps the value once more than the signal does.
  QVariant value = reply.value().variant();
  if (value.canConvert<QDBusVariant>()) value = value.value<QDBusVariant>().variant();
  take(QLatin1String(appearance), QLatin1String(colour_scheme), value.toUInt());
}

void SystemLook::settingChanged(const QString& group, const QString& key, const QDBusVariant& value) {
  take(group, key, value.variant().toUInt());
}

void SystemLook::take(const QString& group, const QString& key, uint value) {
  if (group != QLatin1String(appearance) || key != QLatin1String(colour_scheme)) return;
  const ThemeKind now = value == 1 ? ThemeKind::Dark : value == 2 ? ThemeKind::Light : of_platform_;
  if (now == kind_) return;
  kind_ = now;
  Q_EMIT changed(kind_);
}

}  // namespace spindrift::gui
