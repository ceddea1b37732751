// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/dropped.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QMimeData>
#include <QUrl>

#include "core/session/session.h"

namespace spindrift::gui {
namespace {

QString droppedText(const char* text) {
  return QCoreApplication::translate("Dropped", text);
}

bool endsIn(const QFileInfo& file, const QStringList& endings) {
  return endings.contains(file.suffix().toLower());
}

bool isCapture(const QFileInfo& file) {
  static const QStringList endings{QStringLiteral("jpg"), QStringLiteral("jpeg"), QStringLiteral("png"),
                                   QStringLiteral("tif"), QStringLiteral("tiff"), QStringLiteral("bmp"),
                                   QStringLiteral("pgm"), QStringLiteral("pcd"),  QStringLiteral("ply")};
  return file.isFile() && endsIn(file, endings);
}

/// A file manager may give the folder, or the file that makes it one.
bool isOpenable(const QFileInfo& file) {
  const QDir folder = file.isDir() ? QDir(file.absoluteFilePath()) : file.absoluteDir();
  const bool known =
      folder.exists(QStringLiteral("campaign.json")) || Session::isSession(folder.absolutePath().toStdString());
  if (file.isDir()) return known;
  return (known && endsIn(file, {QStringLiteral("json")})) || endsIn(file, {QStringLiteral("csv")});
}

QString whyNot(const QFileInfo& file) {
  if (!file.exists()) return droppedText("%1 is not there any more.").arg(file.fileName());
  if (file.isDir()) {
    return droppedText(
               "The folder %1 is neither a session nor a campaign: it has no campaign.json. Captures in it are "
               "taken when it is chosen on the page Capture.")
        .arg(file.fileName());
  }
  return droppedText(
             "%1 cannot be opened; allowed: the folder of a session or a campaign, a log (.csv), point clouds "
             "(.pcd, .ply) and images (.jpg, .png, .tif, .bmp, .pgm).")
      .arg(file.fileName());
}

}  // namespace

Dropped droppedFiles(const QStringList& files, bool campaign_open) {
  Dropped dropped;
  dropped.files = files;
  qsizetype captures = 0;
  for (const QString& name : files) {
    const QFileInfo file(name);
    if (isCapture(file)) {
      ++captures;
    } else if (!isOpenable(file)) {
      dropped.why_not = whyNot(file);
      return dropped;
    }
  }
  if (captures == files.size() && captures > 0) {
    if (campaign_open) {
      dropped.kind = Dropped::Kind::Captures;
    } else {
      dropped.why_not = droppedText(
          "Images and point clouds are captures of a campaign; open a session or begin a new "
          "measurement first.");
    }
  } else if (files.size() == 1) {
    dropped.kind = Dropped::Kind::Open;
  } else {
    dropped.why_not =
        droppedText("Sessions, campaigns and logs are opened one at a time; drop one of them, or captures alone.");
  }
  return dropped;
}

QStringList localFiles(const QMimeData* data) {
  QStringList files;
  if (data == nullptr) return files;
  for (const QUrl& url : data->urls()) {
    if (url.isLocalFile()) files << QDir::cleanPath(url.toLocalFile());
  }
  return files;
}

}  // namespace spindrift::gui
