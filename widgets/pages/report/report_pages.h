// SPDX-License-Identifier: GPL-3.0-or-later
// A report's pages, laid out and drawn on a thread of their own: a long report takes a second for that.
//
//   GUI thread     ReportPages(file) ----------> laidOut()   draw(page) ----------> pageDrawn(page, picture)
//   its thread              read, lay out                          draw into a picture
#pragma once

#include <QImage>
#include <QObject>
#include <QSize>
#include <QThread>
#include <atomic>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/job_context.h"
#include "widgets/pages/report/report_document.h"

namespace spindrift::gui {

class ReportPages : public QObject {
  Q_OBJECT
 public:
  /// Begins to read the HTML report `file`; laidOut() tells when everything below can be asked for.
  explicit ReportPages(std::filesystem::path file);
  /// Waits for the page that is being drawn.
  ~ReportPages() override;

  [[nodiscard]] bool ready() const { return ready_; }
  /// Why the report cannot be shown; empty if it can.
  [[nodiscard]] const QString& failure() const { return failure_; }
  [[nodiscard]] int pageCount() const { return page_count_; }
  [[nodiscard]] int figureCount() const { return figure_count_; }
  [[nodiscard]] int tableCount() const { return table_count_; }
  [[nodiscard]] const std::vector<ReportDocument::Heading>& sections() const { return sections_; }

  /// Asks for a picture of a page, `size` device-independent pixels.
  void draw(int page, const QSize& size, double device_pixel_ratio);
  /// What was asked for and has not been begun is no longer wanted.
  void forgetRequests() { ++generation_; }

 Q_SIGNALS:
  void laidOut();
  /// A null picture: the request was forgotten.
  void pageDrawn(int page, const QImage& picture);

 private:
  void layOut(const std::filesystem::path& file);  // on the thread

  QThread thread_;
  QObject* worker_;
  std::unique_ptr<ReportDocument> document_;  ///< of the thread only
  std::atomic<int> generation_ = 0;
  bool ready_ = false;
  QString failure_;
  int page_count_ = 0;
  int figure_count_ = 0;
  int table_count_ = 0;
  std::vector<ReportDocument::Heading> sections_;
};

/// Saves a copy of the report by the ending of `target`, .pdf or .html. From a job: any thread but the GUI's, which it
/// would keep waiting. Throws InputError and Cancelled.
void saveReport(const std::filesystem::path& html_file, const QString& target, const JobContext& job);

}  // namespace spindrift::gui
