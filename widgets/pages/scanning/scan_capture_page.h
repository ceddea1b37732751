// SPDX-License-Identifier: GPL-3.0-or-later
// Step Capture for a laser profiler: the list of scans with a verdict each, the cloud in 3D and profile by profile.
#pragma once

#include <memory>

#include "core/scanning/scan_check.h"
#include "core/scanning/scan_picture.h"
#include "widgets/pages/page.h"

class QLabel;
class QSlider;
class QTableView;

namespace spindrift::gui {

class Plot;
class RowsModel;
class ScanMaskBar;
class ScanResults;
class Segments;
class View3D;

class ScanCapturePage : public Page {
  Q_OBJECT
 public:
  explicit ScanCapturePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return check_; }
  void runAll() override { runTask("check"); }
  [[nodiscard]] RowsModel* scans() const { return rows_; }
  [[nodiscard]] View3D* view() const { return view_; }
  [[nodiscard]] Plot* profile() const { return profile_; }
  [[nodiscard]] const ScanPicture& picture() const { return picture_; }
  /// Shows one scan (path of its cloud as in the list).
  void select(const QString& cloud);
  void setColouring(ScanColouring colouring);
  /// 0 as scanned, 1 as used, 2 both side by side.
  void setPart(int part);
  [[nodiscard]] ScanMaskBar* maskBar() const { return mask_; }
  [[nodiscard]] View3D* viewBefore() const { return before_view_; }
  void showProfile(int index);
  [[nodiscard]] QString pickedItem() const override { return selected(); }

 private:
  void fillTable();
  void loadCloud();
  void showCloud();
  void showIn(View3D* view, const ScanPicture& picture, const QString& part);
  void showVerdict();
  void offerExclusion();
  void toggleExcluded();
  [[nodiscard]] QString selected() const;
  [[nodiscard]] std::string referenceOf(const std::string& cloud) const;

  ScanResults& results_;
  std::map<QString, ScanCheck> checks_;
  ScanPicture picture_;
  QString shown_;
  int request_ = 0;
  bool filling_ = false;
  QPushButton* check_;
  RowsModel* rows_;
  QTableView* table_;
  Callout* verdict_;
  QPushButton* exclude_;
  Segments* colouring_;
  Segments* part_;
  ScanMaskBar* mask_;
  QString shown_mask_;
  QString drawn_;  ///< the scan whose cloud is in the view
  View3D* view_;
  View3D* before_view_;
  ScanPicture before_picture_;
  Plot* profile_;
  QSlider* slider_;
  QLabel* slider_text_;
};

}  // namespace spindrift::gui
