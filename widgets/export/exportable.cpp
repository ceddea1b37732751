// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/export/exportable.h"

#include <QAbstractItemModel>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QEventLoop>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>
#include <numeric>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/preferences.h"
#include "widgets/common/table_habits.h"
#include "widgets/image_view/image_view.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/light_colours.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

void savePicture(const QImage& picture, const QString& file) {
  if (!picture.save(file)) throw InputError({file.toStdString(), ""}, "the picture could not be written.");
}

}  // namespace

QString fileNameOf(const QString& name) {
  QString text;
  for (const QChar c : name.toLower()) {
    if (c.isLetterOrNumber()) {
      text += c;
    } else if (!text.isEmpty() && !text.endsWith(QLatin1Char('-'))) {
      text += QLatin1Char('-');
    }
  }
  while (text.endsWith(QLatin1Char('-'))) text.chop(1);
  return text;
}

Exportable exportableOf(const QString& name, Plot* plot) {
  return {name,
          {QStringLiteral("png"), QStringLiteral("svg"), QStringLiteral("pdf"), QStringLiteral("csv")},
          [plot](const QString& file) { plot->exportTo(file); }};
}

QImage exportedPicture(View3D* view) {
  const LightColours light;
  const FileUnits units;
  return view->picture(view->size().expandedTo({800, 600}), picture_ratio);
}

Exportable exportableOf(const QString& name, View3D* view) {
  return {name, {QStringLiteral("png")}, [view](const QString& file) { savePicture(exportedPicture(view), file); }};
}

Exportable exportableOf(const QString& name, const ImageView* view) {
  return {name, {QStringLiteral("png")}, [view](const QString& file) { savePicture(view->annotated(), file); }};
}

QString tableCsv(const QAbstractItemModel& model) {
  std::vector<int> rows(static_cast<std::size_t>(model.rowCount()));
  std::iota(rows.begin(), rows.end(), 0);
  std::vector<int> columns(static_cast<std::size_t>(model.columnCount()));
  std::iota(columns.begin(), columns.end(), 0);
  return tableText(model, rows, columns, true, TableText::Csv);
}

Exportable exportableOf(const QString& name, const QAbstractItemModel* model) {
  return {name, {QStringLiteral("csv")}, [model](const QString& file) {
            writeFileAtomically(file.toStdString(), tableCsv(*model).toStdString());
          }};
}

ExportDialog::ExportDialog(std::vector<Exportable> items, const QString& folder, QWidget* parent)
    : QDialog(parent), items_(std::move(items)) {
  setWindowTitle(tr("Export"));
  setMinimumSize(560, 420);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 16, 16, 16);
  column->setSpacing(12);
  column->addWidget(makeLabel(tr("Pictures and tables of this page"), "sectionTitle"));
  list_ = new QListWidget;
  list_->setAccessibleName(tr("What to export"));
  column->addWidget(list_, 1);
  for (const Exportable& item : items_) {
    auto* entry = new QListWidgetItem(list_);
    entry->setFlags(entry->flags() | Qt::ItemIsUserCheckable);
    entry->setCheckState(Qt::Checked);
    entry->setText(item.name);
    entry->setSizeHint({0, 48});
    auto* line = new QWidget;
    auto* layout = new QHBoxLayout(line);
    layout->setContentsMargins(0, 4, 8, 4);
    layout->addStretch();
    auto* format = new QComboBox;
    for (const QString& f : item.formats) format->addItem(f.toUpper(), f);
    format->setMinimumWidth(96);
    format->setAccessibleName(tr("Format of %1").arg(item.name));
    layout->addWidget(format);
    formats_.push_back(format);
    list_->setItemWidget(entry, line);
  }
  auto* place = new QHBoxLayout;
  place->addWidget(new QLabel(tr("Folder")));
  folder_ = new QLineEdit(folder);
  folder_->setAccessibleName(tr("Folder to export to"));
  place->addWidget(folder_, 1);
  auto* browse = makeButton(tr("Choose …"), "folder-open");
  place->addWidget(browse);
  column->addLayout(place);
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder to export to"), folder_->text());
    if (!chosen.isEmpty()) folder_->setText(chosen);
  });
  message_ = new Callout;
  column->addWidget(message_);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch();
  auto* close = new QPushButton(tr("Close"));
  export_ = makeButton(tr("Export"), nullptr, "primary");
  export_->setDefault(true);
  buttons->addWidget(close);
  buttons->addWidget(export_);
  column->addLayout(buttons);
  connect(close, &QPushButton::clicked, this, &QDialog::accept);
  connect(export_, &QPushButton::clicked, this, [this] { exportNow(); });
}

QString ExportDialog::folder() const {
  return folder_->text();
}

void ExportDialog::done(int result) {
  if (writing_) {
    closing_ = true;
    writer_.request_stop();
    return;
  }
  QDialog::done(result);
}

void ExportDialog::write(const Exportable& item, const QString& file) {
  if (!item.write_in_background) {
    item.write(file);
    return;
  }
  message_->show(Tone::Neutral, tr("Writing %1 … Close cancels.").arg(file));
  QEventLoop loop;
  std::exception_ptr failure;
  writing_ = true;
  export_->setEnabled(false);
  writer_ = std::jthread([&](const std::stop_token& stop) {
    try {
      JobContext job(stop, nullptr);
      item.write_in_background(file, job);
    } catch (...) {
      failure = std::current_exception();
    }
    QMetaObject::invokeMethod(&loop, &QEventLoop::quit, Qt::QueuedConnection);
  });
  loop.exec();
  writer_.join();
  writing_ = false;
  export_->setEnabled(true);
  if (failure != nullptr) std::rethrow_exception(failure);
}

bool ExportDialog::exportNow() {
  if (writing_) return false;
  int count = 0;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (list_->item(static_cast<int>(i))->checkState() != Qt::Checked) continue;
    const QString file =
        QDir(folder_->text())
            .filePath(fileNameOf(items_[i].name) + QLatin1Char('.') + formats_[i]->currentData().toString());
    try {
      QDir().mkpath(folder_->text());
      write(items_[i], file);
      ++count;
    } catch (const Cancelled&) {
      message_->show(Tone::Neutral, tr("Cancelled; files written before: %1").arg(count));
      if (closing_) QDialog::done(QDialog::Rejected);
      return false;
    } catch (const std::exception& e) {
      message_->show(Tone::Bad, coreSentence(e.what()));
      return false;
    }
  }
  if (closing_) QDialog::done(QDialog::Accepted);
  if (count > 0) rememberFolder(QStringLiteral("export"), folder_->text());
  message_->show(Tone::Good, tr("Files written to %1: %2").arg(folder_->text()).arg(count));
  return true;
}

}  // namespace spindrift::gui
