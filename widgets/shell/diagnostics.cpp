// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/diagnostics.h"

#include <QDir>
#include <QFile>
#include <QGuiApplication>
#include <QRegularExpression>
#include <QScreen>
#include <QSysInfo>
#include <QThread>

#include "core/base/log.h"

namespace spindrift::gui {
namespace {

/// A field of /proc/self/status in MB.
double statusMegabytes(const char* field) {
  QFile file(QStringLiteral("/proc/self/status"));
  if (!file.open(QIODevice::ReadOnly)) return 0.0;
  for (const QByteArray& line : file.readAll().split('\n')) {
    if (line.startsWith(field))
      return line.mid(static_cast<qsizetype>(qstrlen(field)) + 1).simplified().split(' ').front().toDouble() / 1024.0;
  }
  return 0.0;
}

}  // namespace

double residentMegabytes() {
  return statusMegabytes("VmRSS");
}

double peakMegabytes() {
  return statusMegabytes("VmHWM");
}

QString withoutPrivateData(QString line) {
  static const QRegularExpression quoted(QStringLiteral("\"[^\"]*\""));
  static const QRegularExpression folders(
      QStringLiteral("(?<![\\w.])(?:~|[A-Za-z]:)?[/\\\\](?:[^\\s/\\\\:\"]+[/\\\\])*([^\\s/\\\\:\"]*)"));
  line.replace(quoted, QStringLiteral("\"…\""));
  line.replace(folders, QStringLiteral("…/\\1"));
  const QString user = QDir::home().dirName();
  if (user.size() > 2) line.replace(user, QStringLiteral("<user>"));
  const QString host = QSysInfo::machineHostName();
  if (host.size() > 2) line.replace(host, QStringLiteral("<computer>"));
  return line;
}

QString diagnosticsText() {
  QString text =
      QStringLiteral("Spindrift %1\n%2, %3, kernel %4\nQt %5, platform %6\n")
          .arg(QStringLiteral(SPINDRIFT_VERSION), QSysInfo::prettyProductName(), QSysInfo::currentCpuArchitecture(),
               QSysInfo::kernelVersion(), QString::fromLatin1(qVersion()), QGuiApplication::platformName());
  if (const QScreen* screen = QGuiApplication::primaryScreen()) {
    text += QStringLiteral("screen %1 x %2, scale %3\n")
                .arg(screen->size().width())
                .arg(screen->size().height())
                .arg(screen->devicePixelRatio());
  }
  text += QStringLiteral("%1 threads, memory %2 MB, at most %3 MB\n\nLast messages:\n")
              .arg(QThread::idealThreadCount())
              .arg(residentMegabytes(), 0, 'f', 0)
              .arg(peakMegabytes(), 0, 'f', 0);
  for (const std::string& line : recentMessages())
    text += withoutPrivateData(QString::fromStdString(line)) + QLatin1Char('\n');
  return text;
}

}  // namespace spindrift::gui
