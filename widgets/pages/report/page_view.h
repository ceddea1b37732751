// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of a report below one another, as wide as the window allows.
#pragma once

#include <QPixmap>
#include <QScrollArea>
#include <map>
#include <memory>

#include "widgets/pages/report/report_document.h"

namespace spindrift::gui {

class PageView : public QScrollArea {
  Q_OBJECT
 public:
  explicit PageView(QWidget* parent = nullptr);
  /// Null: shows nothing.
  void setDocument(std::shared_ptr<const ReportDocument> document);
  void goToPage(int page);
  [[nodiscard]] int currentPage() const;

 Q_SIGNALS:
  void pageChanged(int page);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  class Sheet;
  Sheet* sheet_;
};

}  // namespace spindrift::gui
