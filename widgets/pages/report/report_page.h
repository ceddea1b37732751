// SPDX-License-Identifier: GPL-3.0-or-later
// Step Report: writes the report of the campaign, shows it as the pages that the PDF will have, saves it as HTML or
// PDF.
#pragma once

#include <filesystem>
#include <memory>

#include "widgets/commands/bound_options.h"
#include "widgets/pages/page.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QStackedWidget;
class QTableView;

namespace spindrift::gui {

class EmptyState;
class PageView;
class ReportPages;
class RowsModel;

class ReportPage : public Page {
  Q_OBJECT
 public:
  explicit ReportPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return write_; }
  void runAll() override { write(); }

  /// Null until the report is opened.
  [[nodiscard]] const ReportPages* document() const { return document_.get(); }
  /// True while a report is being opened.
  [[nodiscard]] bool opening() const { return opening_ != nullptr; }
  [[nodiscard]] QLineEdit* operatorName() const { return operator_; }
  [[nodiscard]] PageView* pages() const { return pages_; }
  /// In the language of the window or in English, as far as it was written so; hidden where the window is English.
  [[nodiscard]] QComboBox* languageChoice() const { return language_; }
  /// The HTML file inside the session, in the chosen language; empty if none was written.
  [[nodiscard]] std::filesystem::path file() { return storedFile("file"); }
  /// The same as PDF; empty also if an earlier version wrote it.
  [[nodiscard]] std::filesystem::path pdf() { return storedFile("pdf"); }
  /// Saves a copy by the ending, .pdf or .html, in the background, and says so when it is there.
  void saveTo(const QString& file);
  /// The name of a saved report in the language of the window, without its ending.
  [[nodiscard]] QString proposedName() const;

 private:
  void write();
  void openInBrowser();
  void askAndSave(const QString& ending, const QString& filter);
  void showDocument(std::shared_ptr<ReportPages> document);
  /// Reads the report of the session in the background.
  void openDocument();
  void showFacts();
  /// Puts the name that was typed into the session; false if it is there.
  void keepOperator();
  [[nodiscard]] std::filesystem::path storedFile(const char* key);

  BoundOptions<ReportChoice> options_;
  QPushButton* write_;
  QPushButton* browser_;
  QPushButton* save_pdf_;
  QPushButton* save_html_;
  QStackedWidget* stack_;
  EmptyState* empty_;
  QLineEdit* operator_;
  QCheckBox* discrepancy_;
  QLabel* language_title_;
  QComboBox* language_;
  QLabel* facts_;
  RowsModel* sections_;
  QTableView* section_table_;
  PageView* pages_;
  std::shared_ptr<ReportPages> document_;
  std::shared_ptr<ReportPages> opening_;
  std::int64_t shown_result_ = 0;
  bool following_ = false;
};

}  // namespace spindrift::gui
