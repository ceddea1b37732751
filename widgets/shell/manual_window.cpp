// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/manual_window.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QShortcut>
#include <QStandardPaths>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
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
    : QDialog(parent), find_(new QLineEdit), place_(new QLabel), chapters_(new QListWidget), view_(new PageView) {
  setWindowTitle(tr("Manual"));
  resize(1120, 760);
  auto* row = new QHBoxLayout(this);
  auto* side = new QVBoxLayout;
  find_->setAccessibleName(tr("Find in the manual"));
  find_->setPlaceholderText(tr("Find in the manual"));
  find_->setToolTip(tr("Return: next place; Shift+Return: the one before"));
  find_->setClearButtonEnabled(true);
  find_->installEventFilter(this);
  side->addWidget(find_);
  side->addWidget(place_);
  chapters_->setAccessibleName(tr("Chapters of the manual"));
  constexpr int side_width = 280;
  for (QWidget* part : {static_cast<QWidget*>(find_), static_cast<QWidget*>(chapters_)})
    part->setFixedWidth(side_width);
  chapters_->setWordWrap(true);
  side->addWidget(chapters_, 1);
  row->addLayout(side);
  row->addWidget(view_, 1);
  connect(new QShortcut(QKeySequence::Find, this), &QShortcut::activated, this, [this] {
    find_->setFocus();
    find_->selectAll();
  });
  connect(find_, &QLineEdit::textChanged, this, [this](const QString& text) {
    if (pages_ != nullptr) pages_->search(text.trimmed());
  });
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

bool ManualWindow::eventFilter(QObject* watched, QEvent* event) {
  if (watched == find_ && event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() == Qt::Key_Return || key->key() == Qt::Key_Enter) {
      step((key->modifiers() & Qt::ShiftModifier) != 0 ? -1 : 1);
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

QString ManualWindow::findText() const {
  return place_->text();
}

void ManualWindow::showMatches(const std::vector<ReportPages::Match>& matches) {
  view_->setMatches(matches);
  match_ = 0;
  if (!matches.empty()) {
    // From where the reader is.
    const auto next = std::find_if(matches.begin(), matches.end(),
                                   [&](const ReportPages::Match& match) { return match.page >= view_->currentPage(); });
    match_ = next == matches.end() ? 0 : static_cast<std::size_t>(next - matches.begin());
    step(0);
  } else {
    place_->setText(find_->text().trimmed().isEmpty() ? QString() : tr("Not found"));
  }
  Q_EMIT searched();
}

void ManualWindow::step(int by) {
  const std::size_t count = view_->matches().size();
  if (count == 0) return;
  match_ = (match_ + count + static_cast<std::size_t>(by + static_cast<int>(count))) % count;
  view_->goToMatch(match_);
  place_->setText(tr("%1 of %2").arg(match_ + 1).arg(count));
}

void ManualWindow::showPages(const std::shared_ptr<ReportPages>& pages) {
  pages_ = pages;
  connect(pages_.get(), &ReportPages::found, this, &ManualWindow::showMatches);
  view_->setPages(pages);
  if (!find_->text().isEmpty()) pages_->search(find_->text().trimmed());  // typed before it was open
  for (const ReportPages::Section& section : pages->sections()) {
    auto* item = new QListWidgetItem(section.title, chapters_);
    item->setData(Qt::UserRole, section.page);
  }
}

}  // namespace spindrift::gui
