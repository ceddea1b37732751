// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/report/report_pages.h"

#include <QPainter>
#include <exception>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"

namespace spindrift::gui {
namespace {

QImage pictureOf(const ReportDocument& document, int page, const QSize& size, double ratio) {
  QImage picture(size * ratio, QImage::Format_RGB32);
  picture.setDevicePixelRatio(ratio);
  picture.fill(Qt::white);
  QPainter painter(&picture);
  const double scale = static_cast<double>(size.width()) / ReportDocument::page_width;
  painter.scale(scale, scale);
  document.drawPage(painter, page);
  return picture;
}

/// Runs `work` on a thread that Qt knows: text documents want timers.
void onThreadOfQt(const std::function<void()>& work) {
  std::exception_ptr failure;
  const std::unique_ptr<QThread> thread(QThread::create([&] {
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  }));
  thread->start();
  thread->wait();
  if (failure != nullptr) std::rethrow_exception(failure);
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
      worker_, [this, file = std::move(file)] { layOut(file); }, Qt::QueuedConnection);
}

ReportPages::~ReportPages() {
  forgetRequests();
  thread_.quit();
  thread_.wait();
}

void ReportPages::layOut(const std::filesystem::path& file) {
  QString failure;
  try {
    document_ = std::make_unique<ReportDocument>(QString::fromStdString(readFile(file)));
  } catch (const std::exception& e) {
    failure = QString::fromUtf8(e.what());
  }
  const bool there = document_ != nullptr;
  QMetaObject::invokeMethod(
      this,
      [this, failure, pages = there ? document_->pageCount() : 0, figures = there ? document_->figureCount() : 0,
       tables = there ? document_->tableCount() : 0,
       sections = there ? document_->sections() : std::vector<ReportDocument::Heading>()] {
        failure_ = failure;
        page_count_ = pages;
        figure_count_ = figures;
        table_count_ = tables;
        sections_ = sections;
        ready_ = true;
        Q_EMIT laidOut();
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

void saveReport(const std::filesystem::path& html_file, const QString& target, const JobContext& job) {
  const std::string html = readFile(html_file);
  if (!target.endsWith(QLatin1String(".pdf"), Qt::CaseInsensitive)) {
    writeFileAtomically(target.toStdString(), html);
    return;
  }
  onThreadOfQt([&] {
    const ReportDocument document(QString::fromStdString(html));
    job.throwIfCancelled();
    document.writePdf(target, job);
  });
}

}  // namespace spindrift::gui
