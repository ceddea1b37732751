// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/manual_window.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QListWidget>
#include <QStandardPaths>
#include <QTimer>
#include <optional>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/reporting/report_file.h"
#include "core/reporting/report_language.h"
#include "core/workflows/manual.h"
#include "widgets/common/languages.h"
#include "widgets/report/page_view.h"

namespace spindrift::gui {

QString manualFile(const QString& language) {
  const QString name =
      language == QLatin1String("en") ? QStringLiteral("manual.pdf") : QStringLiteral("manual-%1.pdf").arg(language);
  for (const char* place : {"/../share/doc/spindrift/", "/../package/"}) {
    const QFileInfo file(QCoreApplication::applicationDirPath() + QLatin1String(place) + name);
    if (file.isFile()) return file.canonicalFilePath();
  }
  return {};
}

QString translatedManualFile() {
  return QDir(QStandardPaths::writableLocation(QStandardPaths::CacheLocation))
      .filePath(QStringLiteral("manual-%1-%2.pdf").arg(QStringLiteral(SPINDRIFT_VERSION), currentLanguage()));
}

void writeTranslatedManual(const QString& file, const JobContext& job) {
  const std::optional<ReportLanguage>& language = offeredReportLanguage();
  SPINDRIFT_ASSERT(language, "the window has another language than English");
  if (QFileInfo(file).isFile() &&
      QFileInfo(file).lastModified() > QFileInfo(QCoreApplication::applicationFilePath()).lastModified())
    return;
  QDir().mkpath(QFileInfo(file).path());
  writeFileAtomically(file.toStdString(), pdfOf(manualIn(*language), job).bytes);
}

void writeManual(const std::string& file) {
  (void)isReportPdf(file);
  const std::optional<ReportLanguage>& language = offeredReportLanguage();
  if (!language)
    throw InputError(
        {file, ""},
        "would be the English manual, which ends with all commands; it is written by spindrift-cli manual --out "
        "FILE. Allowed here: another language, with --language.");
  (void)writeReportFile(manualIn(*language), file);
}

ManualWindow::ManualWindow(const QString& file, QWidget* parent)
    : QDialog(parent), chapters_(new QListWidget), view_(new PageView) {
  setWindowTitle(tr("Manual"));
  resize(1120, 760);
  auto* row = new QHBoxLayout(this);
  chapters_->setAccessibleName(tr("Chapters of the manual"));
  chapters_->setFixedWidth(280);
  chapters_->setWordWrap(true);
  row->addWidget(chapters_);
  row->addWidget(view_, 1);
  connect(chapters_, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
    if (item != nullptr) view_->goToPage(item->data(Qt::UserRole).toInt());
  });
  opening_ = std::make_shared<ReportPages>(file.toStdString());
  connect(opening_.get(), &ReportPages::opened, this, [this] {
    const auto made = std::exchange(opening_, nullptr);
    if (made->failure().isEmpty()) {
      showPages(made);
    } else {
      QTimer::singleShot(0, this, [made] {});  // it is still telling us
      chapters_->addItem(tr("The manual cannot be shown. %1").arg(made->failure()));
    }
    Q_EMIT opened(made->failure());
  });
}

void ManualWindow::showPages(const std::shared_ptr<ReportPages>& pages) {
  view_->setPages(pages);
  for (const ReportPages::Section& section : pages->sections()) {
    auto* item = new QListWidgetItem(section.title, chapters_);
    item->setData(Qt::UserRole, section.page);
  }
}

}  // namespace spindrift::gui
