// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/report/report_pages.h"

#include <poppler-qt6.h>

#include <utility>

namespace spindrift::gui {
namespace {

constexpr double points_per_inch = 72.0;

QImage pictureOf(const Poppler::Document& document, int number, const QSize& size, double ratio) {
  const std::unique_ptr<Poppler::Page> page(document.page(number));
  if (page == nullptr) return {};
  const double dpi = size.width() * ratio / page->pageSizeF().width() * points_per_inch;
  QImage picture = page->renderToImage(dpi, dpi);
  picture.setDevicePixelRatio(ratio);
  return picture;
}

}  // namespace

ReportPages::ReportPages(std::filesystem::path file) : worker_(new QObject) {
  worker_->moveToThread(&thread_);
  connect(&thread_, &QThread::finished, worker_, [this] {
    document_.reset();
    worker_->deleteLater();
  });
  thread_.start();
  QMetaObject::invokeMethod(
      worker_, [this, file = std::move(file)] { read(file); }, Qt::QueuedConnection);
}

ReportPages::~ReportPages() {
  forgetRequests();
  ++searches_;
  thread_.quit();
  thread_.wait();
}

void ReportPages::read(const std::filesystem::path& file) {
  document_ = Poppler::Document::load(QString::fromStdString(file.string()));
  QString failure;
  int pages = 0;
  std::vector<Section> sections;
  if (document_ == nullptr || document_->isLocked() || document_->numPages() == 0) {
    document_.reset();
    failure = tr("%1 is not a readable PDF file.").arg(QString::fromStdString(file.filename().string()));
  } else {
    for (const Poppler::Document::RenderHint hint :
         {Poppler::Document::Antialiasing, Poppler::Document::TextAntialiasing, Poppler::Document::TextSlightHinting})
      document_->setRenderHint(hint);
    pages = document_->numPages();
    for (const Poppler::OutlineItem& item : document_->outline()) {
      const auto place = item.destination();
      sections.push_back({item.name(), place ? place->pageNumber() - 1 : 0});
    }
  }
  QMetaObject::invokeMethod(
      this,
      [this, failure, pages, sections] {
        failure_ = failure;
        page_count_ = pages;
        sections_ = sections;
        Q_EMIT opened();
      },
      Qt::QueuedConnection);
}

void ReportPages::draw(int page, const QSize& size, double ratio) {
  QMetaObject::invokeMethod(
      worker_,
      [this, page, size, ratio, asked = generation_.load()] {
        const bool wanted = document_ != nullptr && asked == generation_;
        const QImage picture = wanted ? pictureOf(*document_, page, size, ratio) : QImage();
        QMetaObject::invokeMethod(
            this, [this, page, picture] { Q_EMIT pageDrawn(page, picture); }, Qt::QueuedConnection);
      },
      Qt::QueuedConnection);
}

void ReportPages::search(const QString& text) {
  const int asked = ++searches_;
  QMetaObject::invokeMethod(
      worker_, [this, text, asked] { searchFrom(0, text, {}, asked); }, Qt::QueuedConnection);
}

void ReportPages::searchFrom(int page, const QString& text, std::vector<Match> matches, int asked) {
  if (asked != searches_) return;
  if (document_ == nullptr || text.isEmpty() || page >= document_->numPages()) {
    QMetaObject::invokeMethod(
        this,
        [this, asked, matches = std::move(matches)] {
          if (asked == searches_) Q_EMIT found(matches);
        },
        Qt::QueuedConnection);
    return;
  }
  if (const std::unique_ptr<Poppler::Page> here(document_->page(page)); here != nullptr) {
    const QSizeF size = here->pageSizeF();
    for (const QRectF& area : here->search(text, Poppler::Page::IgnoreCase)) {
      matches.push_back({page, QRectF(area.x() / size.width(), area.y() / size.height(), area.width() / size.width(),
                                      area.height() / size.height())});
    }
  }
  // What was asked to be drawn meanwhile comes first.
  QMetaObject::invokeMethod(
      worker_,
      [this, page, text, asked, matches = std::move(matches)]() mutable {
        searchFrom(page + 1, text, std::move(matches), asked);
      },
      Qt::QueuedConnection);
}

}  // namespace spindrift::gui
