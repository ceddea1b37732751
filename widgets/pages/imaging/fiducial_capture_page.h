// SPDX-License-Identifier: GPL-3.0-or-later
// Step Capture for a microscope: the list of images with a verdict each, the image with what was decoded, the plan.
#pragma once

#include <map>

#include "widgets/pages/page.h"

class QComboBox;
class QTableView;

namespace spindrift::gui {

class ImageView;
class RowsModel;
class Badge;

/// One row of captures/fiducials.csv as the page shows it, and what the check found.
struct ListedCapture {
  QString image;  ///< path relative to the campaign
  QString state;
  QString fiducial;
  QString role;
  int index = 0;
  double z_mm = 0;
  double spindle_deg = 0;
  bool checked = false;
  bool good = false;
  QString sentence;  ///< what was found, or why it cannot be used
  int ellipses = 0;
  double sharpness_px = 0;  ///< sigma of the blur
};

class FiducialCapturePage : public Page {
  Q_OBJECT
 public:
  explicit FiducialCapturePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return check_; }
  void runAll() override { runTask("check"); }
  [[nodiscard]] QString pickedItem() const override { return shown_; }
  /// Shows one image (path as in the list).
  void select(const QString& image);

 private:
  void load();
  void fillTable();
  /// Nothing of another campaign may be seen, nor be excluded.
  void clearImage();
  void fillPlan();
  /// All are good: says what is excluded, and where too few are left.
  void showComplete();
  /// Says which captures are bad, with a button that goes to the first.
  void showBad(const std::vector<const ListedCapture*>& bad);
  void showImage(const QString& image);
  /// The captures that are selected in the list, else the one that is shown.
  [[nodiscard]] QStringList chosen() const;
  void offerExclusion();
  void toggleExcluded();
  [[nodiscard]] const ListedCapture* find(const QString& image) const;

  std::vector<ListedCapture> captures_;
  QPushButton* check_;
  QComboBox* state_filter_;
  QComboBox* verdict_filter_;
  RowsModel* model_;
  QTableView* table_;
  RowsModel* plan_;
  ImageView* image_;
  QPushButton* exclude_;
  QPushButton* overlay_;
  Badge* badge_;
  Callout* verdict_;
  QString shown_;
  int request_ = 0;
};

}  // namespace spindrift::gui
