// SPDX-License-Identifier: GPL-3.0-or-later
// The manual beside the work: its pages, and its chapters to go to. It is the file that the package brings.
#pragma once

#include <QDialog>
#include <memory>
#include <string>

#include "core/base/job_context.h"
#include "widgets/report/report_pages.h"

class QListWidget;

namespace spindrift::gui {

class PageView;

/// Where the manual in a language is that came with this program: installed, or in the folder it was built in; empty if
/// at neither place.
[[nodiscard]] QString manualFile(const QString& language);
/// Where the manual in the language of the window is kept once it was written: in the user's cache, by its version.
[[nodiscard]] QString translatedManualFile();
/// Writes it there unless it is there. Throws InputError; to be called in a job.
void writeTranslatedManual(const QString& file, const JobContext& job);
/// Writes the manual in the language of the window, by the ending as HTML or PDF. Throws InputError: another ending, a
/// file that cannot be written, or English, whose manual ends with the commands of spindrift-cli and is written by it.
void writeManual(const std::string& file);

class ManualWindow : public QDialog {
  Q_OBJECT
 public:
  explicit ManualWindow(const QString& file, QWidget* parent = nullptr);
  /// One a chapter, once the file is opened.
  [[nodiscard]] QListWidget* chapters() const { return chapters_; }
  [[nodiscard]] PageView* pages() const { return view_; }

 Q_SIGNALS:
  /// Empty: it can be read.
  void opened(const QString& failure);

 private:
  void showPages(const std::shared_ptr<ReportPages>& pages);

  std::shared_ptr<ReportPages> opening_;
  QListWidget* chapters_;
  PageView* view_;
};

}  // namespace spindrift::gui
