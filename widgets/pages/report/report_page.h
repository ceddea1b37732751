// SPDX-License-Identifier: GPL-3.0-or-later
// Step Report: writes the report of the campaign, shows it as the pages that the PDF will have, saves it as HTML or
// PDF.
#pragma once

#include <filesystem>
#include <memory>

#include "core/workflows/report_workflow.h"
#include "widgets/pages/page.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QStackedWidget;
class QTableView;

namespace spindrift::gui {

class EmptyState;
class PageView;
class ReportDocument;
class RowsModel;

class ReportPage : public Page {
  Q_OBJECT
 public:
  explicit ReportPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return write_; }
  void runAll() override { write(); }

  [[nodiscard]] const ReportDocument* document() const { return document_.get(); }
  [[nodiscard]] QLineEdit* operatorName() const { return operator_; }
  [[nodiscard]] PageView* pages() const { return pages_; }
  /// The HTML file inside the session; empty if none was written.
  [[nodiscard]] std::filesystem::path file() const;
  /// Saves a copy by the ending, .pdf or .html, and says so.
  void saveTo(const QString& file);

 private:
  void write();
  void openInBrowser();
  void askAndSave(const QString& ending, const QString& filter);
  void showDocument(std::shared_ptr<const ReportDocument> document);
  [[nodiscard]] ReportOptions options() const;
  [[nodiscard]] nlohmann::json dependencies() const;

  QPushButton* write_;
  QPushButton* browser_;
  QPushButton* save_pdf_;
  QPushButton* save_html_;
  QStackedWidget* stack_;
  EmptyState* empty_;
  QLineEdit* operator_;
  QCheckBox* discrepancy_;
  QLabel* facts_;
  RowsModel* sections_;
  QTableView* section_table_;
  PageView* pages_;
  std::shared_ptr<const ReportDocument> document_;
  std::int64_t shown_result_ = 0;
  bool following_ = false;
};

}  // namespace spindrift::gui
