// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/page_view.h"

#include <QPaintEvent>
#include <QPainter>
#include <QScrollBar>
#include <algorithm>
#include <cmath>

#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr int gap = 16;
constexpr double largest_scale = 1.25;
constexpr std::size_t pages_kept = 6;

}  // namespace

/// All pages; only those in sight are drawn, a few are kept as pictures.
class PageView::Sheet : public QWidget {
 public:
  std::shared_ptr<const ReportDocument> document;
  double scale = 1.0;

  void arrange(int width) {
    const double wanted = static_cast<double>(width - 2 * gap) / ReportDocument::page_width;
    scale = std::clamp(wanted, 0.3, largest_scale);
    pictures_.clear();
    const int pages = document != nullptr ? document->pageCount() : 0;
    setFixedHeight(std::max(1, top(pages)));
    update();
  }
  [[nodiscard]] int pageHeight() const { return static_cast<int>(std::lround(ReportDocument::page_height * scale)); }
  [[nodiscard]] int top(int page) const { return gap + page * (pageHeight() + gap); }

 protected:
  void paintEvent(QPaintEvent* event) override {
    if (document == nullptr) return;
    QPainter painter(this);
    const int page_width = static_cast<int>(std::lround(ReportDocument::page_width * scale));
    const int left = (width() - page_width) / 2;
    for (int page = 0; page < document->pageCount(); ++page) {
      const QRect area(left, top(page), page_width, pageHeight());
      if (!area.intersects(event->rect())) continue;
      painter.drawPixmap(area.topLeft(), picture(page, area.size()));
      painter.setPen(QPen(theme().border_strong, 1));
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(area.adjusted(-1, -1, 0, 0));
    }
  }

 private:
  const QPixmap& picture(int page, const QSize& size) {
    const auto found = pictures_.find(page);
    if (found != pictures_.end()) return found->second;
    if (pictures_.size() >= pages_kept) {
      // The one furthest away goes.
      const auto far = std::abs(pictures_.begin()->first - page) > std::abs(pictures_.rbegin()->first - page)
                           ? pictures_.begin()
                           : std::prev(pictures_.end());
      pictures_.erase(far);
    }
    const double ratio = devicePixelRatioF();
    QPixmap made(size * ratio);
    made.setDevicePixelRatio(ratio);
    made.fill(Qt::white);
    QPainter painter(&made);
    painter.scale(scale, scale);
    document->drawPage(painter, page);
    painter.end();
    return pictures_.emplace(page, std::move(made)).first->second;
  }
  std::map<int, QPixmap> pictures_;
};

PageView::PageView(QWidget* parent) : QScrollArea(parent), sheet_(new Sheet) {
  setWidget(sheet_);
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
  setAccessibleName(tr("Pages of the report"));
  setFocusPolicy(Qt::StrongFocus);
  connect(verticalScrollBar(), &QScrollBar::valueChanged, this, [this] { Q_EMIT pageChanged(currentPage()); });
}

void PageView::setDocument(std::shared_ptr<const ReportDocument> document) {
  sheet_->document = std::move(document);
  sheet_->arrange(viewport()->width());
  verticalScrollBar()->setValue(0);
}

void PageView::goToPage(int page) {
  verticalScrollBar()->setValue(sheet_->top(page) - gap);
}

int PageView::currentPage() const {
  return (verticalScrollBar()->value() + viewport()->height() / 3) / std::max(1, sheet_->pageHeight() + gap);
}

void PageView::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  const int page = currentPage();
  const bool moved = verticalScrollBar()->value() > 0;
  sheet_->arrange(viewport()->width());
  if (moved) goToPage(page);
}

}  // namespace spindrift::gui
