// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of a report below one another, as wide as the window allows.
#pragma once

#include <QScrollArea>
#include <memory>
#include <vector>

#include "widgets/report/report_pages.h"

namespace spindrift::gui {

class PageView : public QScrollArea {
  Q_OBJECT
 public:
  explicit PageView(QWidget* parent = nullptr);
  /// Null: shows nothing. The pages have to be opened.
  void setPages(std::shared_ptr<ReportPages> pages);
  /// True until the pages in sight are drawn.
  [[nodiscard]] bool drawing() const;
  void goToPage(int page);
  [[nodiscard]] int currentPage() const;
  /// Places of a text, marked on the pages; none is pointed out yet.
  void setMatches(std::vector<ReportPages::Match> matches);
  [[nodiscard]] const std::vector<ReportPages::Match>& matches() const;
  /// Points one out and brings it into sight.
  void goToMatch(std::size_t index);

 Q_SIGNALS:
  void pageChanged(int page);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  class Sheet;
  Sheet* sheet_;
};

}  // namespace spindrift::gui
