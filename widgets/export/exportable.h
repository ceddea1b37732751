// SPDX-License-Identifier: GPL-3.0-or-later
// One place for export: a page lists what it can give away, one dialog writes it.
#pragma once

#include <QDialog>
#include <QImage>
#include <QString>
#include <QStringList>
#include <functional>
#include <thread>
#include <vector>

#include "core/base/job_context.h"

class QAbstractItemModel;
class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;

namespace spindrift::gui {

class ImageView;
class Plot;
class View3D;

/// A picture or a table of a page.
struct Exportable {
  QString name;                                    ///< "Heat map EX"; also the proposed file name
  QStringList formats;                             ///< "png", "svg", "pdf", "csv", "json"; the first is proposed
  std::function<void(const QString& file)> write;  ///< throws InputError
  /// The same for what takes long: on a worker thread, can be cancelled. May be empty.
  std::function<void(const QString& file, JobContext& job)> write_in_background = {};
};

[[nodiscard]] Exportable exportableOf(const QString& name, Plot* plot);
[[nodiscard]] Exportable exportableOf(const QString& name, View3D* view);
[[nodiscard]] Exportable exportableOf(const QString& name, const ImageView* view);
/// What a file of a 3D view holds: light colours, units of files, fine enough for print.
[[nodiscard]] QImage exportedPicture(View3D* view);
/// A table as CSV: the texts of its display role (numbers as they are shown are kept exactly in Qt::UserRole).
[[nodiscard]] Exportable exportableOf(const QString& name, const QAbstractItemModel* model);
[[nodiscard]] QString tableCsv(const QAbstractItemModel& model);

class ExportDialog : public QDialog {
  Q_OBJECT
 public:
  ExportDialog(std::vector<Exportable> items, const QString& folder, QWidget* parent = nullptr);
  [[nodiscard]] QString folder() const;
  /// Writes the checked items; true if all were written.
  bool exportNow();
  /// While something is being written, closing cancels that first.
  void done(int result) override;

 private:
  void write(const Exportable& item, const QString& file);
  std::vector<Exportable> items_;
  QListWidget* list_;
  std::vector<QComboBox*> formats_;
  QLineEdit* folder_;
  class Callout* message_;
  class QPushButton* export_;
  std::jthread writer_;
  bool writing_ = false;
  bool closing_ = false;
};

/// "Heat map EX" -> "heat-map-ex".
[[nodiscard]] QString fileNameOf(const QString& name);

}  // namespace spindrift::gui
