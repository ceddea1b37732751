// SPDX-License-Identifier: GPL-3.0-or-later
// The manual beside the work: its pages, its chapters to go to, a text to look for. It is the file that the package
// brings.
#pragma once

#include <QDialog>
#include <memory>
#include <string>

#include "core/base/job_context.h"
#include "widgets/report/report_pages.h"

class QLabel;
class QLineEdit;
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
  /// What is typed here is looked for (Ctrl+F); Return goes to the next place, Shift+Return to the one before.
  [[nodiscard]] QLineEdit* findField() const { return find_; }
  /// "3 of 17", "Not found"; empty while nothing is looked for.
  [[nodiscard]] QString findText() const;

 Q_SIGNALS:
  /// Empty: it can be read.
  void opened(const QString& failure);
  /// All places of what is in the field are known.
  void searched();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void showPages(const std::shared_ptr<ReportPages>& pages);
  void showMatches(const std::vector<ReportPages::Match>& matches);
  /// To the next or the previous place, round and round.
  void step(int by);

  std::shared_ptr<ReportPages> opening_;
  std::shared_ptr<ReportPages> pages_;
  QLineEdit* find_;
  QLabel* place_;
  std::size_t match_ = 0;
  QListWidget* chapters_;
  PageView* view_;
};

}  // namespace spindrift::gui
