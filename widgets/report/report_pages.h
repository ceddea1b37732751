// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of a report that was written as PDF: read and drawn on a thread of their own.
//
//   GUI thread     ReportPages(file) ----------> opened()   draw(page) ----------> pageDrawn(page, picture)
//   its thread              read                                   draw into a picture
//
// A text is looked for there too, a page at a time, so that pages in sight go on being drawn.
#pragma once

#include <QImage>
#include <QObject>
#include <QRectF>
#include <QSize>
#include <QString>
#include <QThread>
#include <atomic>
#include <filesystem>
#include <memory>
#include <vector>

namespace Poppler {
class Document;
}

namespace spindrift::gui {

class ReportPages : public QObject {
  Q_OBJECT
 public:
  /// A4 at 96 dpi.
  static constexpr int page_width = 794;
  static constexpr int page_height = 1123;

  struct Section {
    QString title;
    int page = 0;
  };
  /// A place where a text stands.
  struct Match {
    int page = 0;
    QRectF area;  ///< parts of the page: 0 ... 1 from the left and from the top
  };

  /// Begins to read the PDF `file`; opened() tells when everything below can be asked for.
  explicit ReportPages(std::filesystem::path file);
  /// Waits for the page that is being drawn.
  ~ReportPages() override;

  /// Why the report cannot be shown; empty if it can.
  [[nodiscard]] const QString& failure() const { return failure_; }
  [[nodiscard]] int pageCount() const { return page_count_; }
  /// In order, with the page each begins on.
  [[nodiscard]] const std::vector<Section>& sections() const { return sections_; }

  /// Asks for a picture of a page, `size` device-independent pixels.
  void draw(int page, const QSize& size, double device_pixel_ratio);
  /// What was asked for and has not been begun is no longer wanted.
  void forgetRequests() { ++generation_; }
  /// Looks for a text on all pages, in upper or lower case. Takes the place of a search that still runs.
  void search(const QString& text);

 Q_SIGNALS:
  void opened();
  /// A null picture: the request was forgotten.
  void pageDrawn(int page, const QImage& picture);
  /// Everywhere, from the first page on.
  void found(const std::vector<ReportPages::Match>& matches);

 private:
  // On the thread.
  void read(const std::filesystem::path& file);
  void searchFrom(int page, const QString& text, std::vector<Match> matches, int asked);

  QThread thread_;
  QObject* worker_;
  std::unique_ptr<Poppler::Document> document_;  ///< of the thread only
  std::atomic<int> generation_ = 0;
  std::atomic<int> searches_ = 0;
  QString failure_;
  int page_count_ = 0;
  std::vector<Section> sections_;
};

}  // namespace spindrift::gui
