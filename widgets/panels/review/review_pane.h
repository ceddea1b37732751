// SPDX-License-Identifier: GPL-3.0-or-later
// One pane of a review: what it shows (campaign, state, quantity) and the picture of it. The page works the contents
// out, so that all panes share one colour scale and one exaggeration.
#pragma once

#include <QFrame>
#include <memory>

#include "core/scanning/scan_picture.h"
#include "core/workflows/review_workflow.h"

class QComboBox;
class QLabel;
class QStackedWidget;

namespace spindrift::gui {

class ReviewSources;
class View3D;
class WrapLayout;
struct ReviewSource;

/// What a pane can show.
enum class PaneContent {
  Measured,
  NineParameters,
  NineParametersLeft,
  Simulation,
  SimulationLeft,
  Completed,
  CompletedLeft,
  Difference,
  ScanChange,
  ScanLeftOver
};
/// Null for a difference and for scans.
[[nodiscard]] std::optional<ReviewQuantity> quantityOf(PaneContent content);

class ReviewPane : public QFrame {
  Q_OBJECT
 public:
  ReviewPane(int number, ReviewSources& sources, QWidget* parent = nullptr);
  /// Fills the choices anew and keeps what was chosen where it is still there.
  void refresh(std::int64_t campaign);
  void choose(PaneContent content, const QString& state = {});  ///< state empty: follows the slider
  [[nodiscard]] std::shared_ptr<const ReviewSource> source() const;
  [[nodiscard]] PaneContent content() const;
  [[nodiscard]] bool isScan() const { return content() >= PaneContent::ScanChange; }
  /// The state chosen, or `at_slider` where the pane follows the slider.
  [[nodiscard]] std::string state(const std::string& at_slider) const;

  void show(const ReviewPicture& picture, const std::optional<double>& limit, bool arrows, double exaggeration,
            bool machine, bool values);
  void showScan(const ScanPicture& picture, const QString& title, double limit);
  void showMessage(const QString& title, const QString& how);
  /// Of the place under the cursor, in the units of files; empty: what the pane says of the whole, its largest value or
  /// the range of its scan.
  void setValue(const QString& text);
  [[nodiscard]] QString value() const;
  /// Whether its choices have room in one line; a hidden pane says yes.
  [[nodiscard]] bool fitsInOneLine() const;
  /// What the pane shows is chosen in a second line, so that panes side by side begin at one height.
  void setSecondLine(bool second);
  [[nodiscard]] const ReviewPicture& picture() const { return picture_; }
  /// What stands at the top left of the view; a low view leaves out all lines but the first.
  [[nodiscard]] const QString& caption() const { return caption_; }
  [[nodiscard]] View3D* view() const { return view_; }
  [[nodiscard]] View3D* scanView() const { return scan_view_; }
  [[nodiscard]] QComboBox* campaignChoice() const { return campaign_; }
  [[nodiscard]] QComboBox* stateChoice() const { return state_; }
  [[nodiscard]] QComboBox* contentChoice() const { return content_; }

 Q_SIGNALS:
  void changed();
  /// The choices take another width, or the pane has another one.
  void roomChanged();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fillStates();
  void sayWhole(const ReviewPicture& picture);

  ReviewSources& sources_;
  WrapLayout* choices_;
  QComboBox* campaign_;
  QComboBox* state_;
  QComboBox* content_;
  QStackedWidget* stack_;
  View3D* view_;
  View3D* scan_view_;
  QLabel* value_;
  ReviewPicture picture_;
  QString caption_;
  QString whole_;           ///< said while the cursor is elsewhere: the largest value, or the range of a scan
  std::string machine_of_;  ///< folder of the campaign whose machine is in the view (ids start again in every session)
  bool filling_ = false;
  bool first_;
};

}  // namespace spindrift::gui
