// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/report/page_view.h"

#include <QPaintEvent>
#include <QPainter>
#include <QPixmap>
#include <QScrollBar>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "widgets/theme/theme.h"

namespace spindrift::gui {
namespace {

constexpr int gap = 16;
constexpr double largest_scale = 1.25;
constexpr std::size_t pages_kept = 6;

}  // namespace

/// All pages; only those in sight are drawn, a few are kept as pictures. A page whose picture is not there yet is
/// white, or what was there at another size.
class PageView::Sheet : public QWidget {
 public:
  std::shared_ptr<ReportPages> pages;
  double scale = 1.0;

  void setPages(std::shared_ptr<ReportPages> now, int width) {
    if (pages != nullptr) pages->disconnect(this);
    pages = std::move(now);
    pictures_.clear();
    if (pages != nullptr) {
      connect(pages.get(), &ReportPages::pageDrawn, this, [this](int page, const QImage& picture) {
        asked_.erase(page);
        if (!picture.isNull()) keep(page, QPixmap::fromImage(picture));
        update();
      });
    }
    arrange(width);
  }
  void arrange(int width) {
    const double wanted = static_cast<double>(width - 2 * gap) / ReportPages::page_width;
    scale = std::clamp(wanted, 0.3, largest_scale);
    if (pages != nullptr) pages->forgetRequests();
    asked_.clear();
    setFixedHeight(std::max(1, top(count())));
    update();
  }
  [[nodiscard]] int count() const { return pages != nullptr ? pages->pageCount() : 0; }
  [[nodiscard]] bool drawing() const { return !asked_.empty(); }
  [[nodiscard]] int pageHeight() const { return static_cast<int>(std::lround(ReportPages::page_height * scale)); }
  [[nodiscard]] int top(int page) const { return gap + page * (pageHeight() + gap); }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const int page_width = static_cast<int>(std::lround(ReportPages::page_width * scale));
    const int left = (width() - page_width) / 2;
    for (int page = 0; page < count(); ++page) {
      const QRect area(left, top(page), page_width, pageHeight());
      if (!area.intersects(event->rect())) continue;
      painter.fillRect(area, Qt::white);
      const auto found = pictures_.find(page);
      if (found == pictures_.end() || found->second.width() != std::lround(area.width() * devicePixelRatioF()))
        ask(page, area.size());
      if (found != pictures_.end()) painter.drawPixmap(area, found->second);
      painter.setPen(QPen(theme().border_strong, 1));
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(area.adjusted(-1, -1, 0, 0));
    }
  }

 private:
  void ask(int page, const QSize& size) {
    if (asked_.insert(page).second) pages->draw(page, size, devicePixelRatioF());
  }
  void keep(int page, QPixmap picture) {
    if (pictures_.size() >= pages_kept) {
      // The one furthest away goes.
      const auto far = std::abs(pictures_.begin()->first - page) > std::abs(pictures_.rbegin()->first - page)
                           ? pictures_.begin()
                           : std::prev(pictures_.end());
      pictures_.erase(far);
    }
    pictures_.insert_or_assign(page, std::move(picture));
  }
  std::map<int, QPixmap> pictures_;
  std::set<int> asked_;
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

void PageView::setPages(std::shared_ptr<ReportPages> pages) {
  sheet_->setPages(std::move(pages), viewport()->width());
  verticalScrollBar()->setValue(0);
}

bool PageView::drawing() const {
  return sheet_->drawing();
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
