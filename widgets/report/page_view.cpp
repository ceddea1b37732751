// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/report/page_view.h"

#include <QPaintEvent>
#include <QPainter>
#include <QPixmap>
#include <QScrollBar>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/base/error.h"
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
  std::vector<ReportPages::Match> matches;
  std::optional<std::size_t> pointed_out;  ///< of the matches

  void setPages(std::shared_ptr<ReportPages> now, int width) {
    if (pages != nullptr) pages->disconnect(this);
    pages = std::move(now);
    pictures_.clear();
    matches.clear();
    pointed_out.reset();
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
  [[nodiscard]] QRect areaOf(int page) const {
    const int page_width = static_cast<int>(std::lround(ReportPages::page_width * scale));
    return {(width() - page_width) / 2, top(page), page_width, pageHeight()};
  }
  [[nodiscard]] QRectF areaOf(const ReportPages::Match& match) const {
    const QRect page = areaOf(match.page);
    return {page.x() + match.area.x() * page.width(), page.y() + match.area.y() * page.height(),
            match.area.width() * page.width(), match.area.height() * page.height()};
  }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    for (int page = 0; page < count(); ++page) {
      const QRect area = areaOf(page);
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
    paintMatches(painter, event->rect());
  }

 private:
  /// As with a marker: the text stays readable. The one that is pointed out has a frame as well.
  void paintMatches(QPainter& painter, const QRect& shown) const {
    static const QColor marker(255, 213, 79);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const QRectF area = areaOf(matches[i]).adjusted(-1, -1, 1, 1);
      if (!area.intersects(shown)) continue;
      painter.setCompositionMode(QPainter::CompositionMode_Multiply);
      painter.fillRect(area, marker);
      painter.setCompositionMode(QPainter::CompositionMode_SourceOver);
      if (i != pointed_out) continue;
      painter.setPen(QPen(QColor(180, 83, 9), 2));
      painter.drawRect(area.adjusted(-1, -1, 1, 1));
    }
  }
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

void PageView::setMatches(std::vector<ReportPages::Match> matches) {
  sheet_->matches = std::move(matches);
  sheet_->pointed_out.reset();
  sheet_->update();
}

const std::vector<ReportPages::Match>& PageView::matches() const {
  return sheet_->matches;
}

void PageView::goToMatch(std::size_t index) {
  SPINDRIFT_ASSERT(index < sheet_->matches.size(), "one of the matches");
  sheet_->pointed_out = index;
  const QRectF area = sheet_->areaOf(sheet_->matches[index]);
  const int at = verticalScrollBar()->value();
  if (area.top() < at + gap || area.bottom() > at + viewport()->height() - gap)
    verticalScrollBar()->setValue(static_cast<int>(area.center().y()) - viewport()->height() / 3);
  sheet_->update();
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
