// SPDX-License-Identifier: GPL-3.0-or-later
// What comes into the window and leaves it: recent sessions, sample data, what is dropped, printing, news.
#include <QDialog>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QEventLoop>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMimeData>
#include <QPrintDialog>
#include <QPrinter>
#include <QSettings>
#include <QStandardPaths>

#include "core/base/error.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/preferences.h"
#include "widgets/common/report_files.h"
#include "widgets/export/print.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/models/cells.h"
#include "widgets/report/report_pages.h"
#include "widgets/services/incoming_service.h"
#include "widgets/shell/demo.h"
#include "widgets/shell/dropped.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/news_dialog.h"
#include "widgets/shell/welcome_page.h"
#include "widgets/theme/icons.h"

namespace spindrift::gui {
namespace {

constexpr auto recent_key = "recent";

/// As text of a menu: an ampersand is one.
QString menuText(QString text) {
  return text.replace(QLatin1Char('&'), QStringLiteral("&&"));
}

}  // namespace

/// As they were opened, the last one first. Folders that are gone, such as those of a demo that was not kept, are left
/// out; they are not forgotten, because a disk may be away for a while.
QStringList MainWindow::recentSessions() {
  QStringList there;
  for (const QString& folder : QSettings().value(QLatin1String(recent_key)).toStringList()) {
    if (QFileInfo(folder).isDir()) there << folder;
  }
  return there;
}

void MainWindow::fillRecentMenu() {
  const QStringList recent = recentSessions();
  welcome_->setRecent(recent);
  recent_menu_->clear();
  for (const QString& folder : recent) {
    const QFileInfo info(folder);
    QAction* action = recent_menu_->addAction(menuText(info.fileName()), this, [this, folder] { askAndOpen(folder); });
    action->setToolTip(QDir::toNativeSeparators(folder));
    action->setStatusTip(action->toolTip());
  }
  recent_menu_->setToolTipsVisible(true);
  recent_menu_->menuAction()->setEnabled(!recent.isEmpty());
  if (recent.isEmpty()) return;
  recent_menu_->addSeparator();
  recent_menu_->addAction(icon("trash"), tr("&Clear the list"), this, [this] {
    QSettings().remove(QLatin1String(recent_key));
    // Not now: the menu that is being used would lose its actions.
    QMetaObject::invokeMethod(this, &MainWindow::fillRecentMenu, Qt::QueuedConnection);
  });
}

void MainWindow::addSampleMenu(QMenu* menu) {
  for (const Demo& demo : demos()) {
    QAction* action = menu->addAction(icon(demo.icon), menuText(demo.title), this, [this, name = demo.name] {
      if (maySessionBeLeft()) startDemo(QString::fromStdString(name));
    });
    action->setStatusTip(demo.sentence);
  }
  menu->addSeparator();
  QMenu* files = menu->addMenu(icon("export"), tr("&Write as files"));
  for (const Demo& demo : demos()) {
    files->addAction(icon(demo.icon), tr("Files of: %1").arg(menuText(demo.title)), this, [this, name = demo.name] {
      const QString folder = askForCampaign(tr("Where the folder of the sample campaign is to be made"));
      if (!folder.isEmpty()) writeSample(name, folder);
    });
  }
}

void MainWindow::writeSample(const std::string& demo, const QString& folder) {
  const std::filesystem::path place = std::filesystem::path(folder.toStdString()) / ("spindrift_" + demo);
  if (std::filesystem::exists(place)) {
    tell(tr("%1 is there already and is not written over; choose another folder.")
             .arg(QString::fromStdString(place.string())));
    return;
  }
  Job job;
  job.title = tr("Writing sample data: %1").arg(QString::fromStdString(demo));
  job.work = [this, demo, place](JobContext& context) -> std::function<void()> {
    try {
      makeDemoCampaign(demo, place, false, context);
    } catch (...) {
      std::error_code ignored;
      std::filesystem::remove_all(place, ignored);  // half a campaign looks like one
      throw;
    }
    return [this, place] {
      tell(tr("The sample campaign was written to %1.").arg(QString::fromStdString(place.string())));
    };
  };
  job.failed = [this](const QString& sentence) { tell(sentence); };
  jobs_.run(std::move(job));
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  // What cannot be taken is dropped all the same, and told why.
  if (!localFiles(event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QStringList files = localFiles(event->mimeData());
  if (files.isEmpty()) return;
  event->acceptProposedAction();
  // The program that is dragged from waits for the answer.
  QMetaObject::invokeMethod(
      this, [this, files] { take(files); }, Qt::QueuedConnection);
}

void MainWindow::take(const QStringList& files) {
  const Dropped dropped = droppedFiles(files, session_.campaign() != nullptr);
  if (dropped.kind == Dropped::Kind::Nothing) {
    tell(dropped.why_not);
    return;
  }
  if (dropped.kind == Dropped::Kind::Open) {
    askAndOpen(dropped.files.front());
    return;
  }
  workflow_.goTo(StepId::Capture);
  showSessionOrWelcome();
  IncomingService::of(session_).takeFiles(files, [this](const std::vector<IncomingItem>& items) {
    qsizetype taken = 0;
    QStringList others;
    for (const IncomingItem& item : items) {
      if (item.state == IncomingState::Accepted) {
        ++taken;
      } else {
        others << fromCore(item.name + ": " + item.sentence);
      }
    }
    QString sentence = tr("Captures taken into the campaign: %1 of %2.").arg(taken).arg(items.size());
    if (!others.isEmpty()) sentence += QLatin1Char(' ') + others.front();
    if (others.size() > 1) sentence += QLatin1Char(' ') + tr("And %1 more.").arg(others.size() - 1);
    tell(sentence);
  });
}

void MainWindow::showNews() {
  if (findChild<NewsDialog*>() == nullptr) (new NewsDialog(this))->open();
}

void MainWindow::showNewsIfDue() {
  if (newsAreDue(QStringLiteral(SPINDRIFT_VERSION))) showNews();
}

std::filesystem::path MainWindow::reportFile() {
  if (session_.campaign() == nullptr) return {};
  const StoredResult* stored = session_.latest("report");
  return stored == nullptr ? std::filesystem::path() : storedReport(session_.folder(), stored->payload, "pdf");
}

void MainWindow::askAndPrint(const std::function<void(QPrinter&)>& print) {
  QPrinter printer(QPrinter::HighResolution);
  QPrintDialog dialog(&printer, this);
  if (dialog.exec() != QDialog::Accepted) return;
  try {
    print(printer);
    tell(printer.outputFileName().isEmpty() ? tr("Printed on %1.").arg(printer.printerName())
                                            : tr("Printed to %1.").arg(printer.outputFileName()));
  } catch (const InputError& e) {
    tell(QString::fromUtf8(e.what()));
  }
}

void MainWindow::printPage(QPrinter& printer) {
  if (currentPage() == nullptr || session_.campaign() == nullptr)
    throw InputError(tr("Open a session first.").toStdString());
  // Paper is light; the colours on the screen come back at once.
  const ThemeKind shown = theme().kind;
  applyLook(ThemeKind::Light);
  QImage picture(2 * page_->size(), QImage::Format_RGB32);
  picture.setDevicePixelRatio(2.0);
  picture.fill(theme().window);
  page_->render(&picture);
  applyLook(shown);
  picture.setDevicePixelRatio(1.0);
  if (picture.width() > picture.height()) printer.setPageOrientation(QPageLayout::Landscape);
  printPicture(
      printer, picture,
      tr("%1 · %2 · %3").arg(session_.name(), shownName(session_.campaign()->name), stepTitle(workflow_.current())));
}

void MainWindow::printReportOn(QPrinter& printer) {
  const std::filesystem::path file = reportFile();
  if (file.empty()) throw InputError(tr("The report has not been written yet; the page Report does.").toStdString());
  ReportPages pages(file);
  QEventLoop loop;
  connect(&pages, &ReportPages::opened, &loop, &QEventLoop::quit);
  loop.exec();
  if (!pages.failure().isEmpty()) throw InputError(pages.failure().toStdString());
  printReport(printer, pages);
}

}  // namespace spindrift::gui
