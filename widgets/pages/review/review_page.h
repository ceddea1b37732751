// SPDX-License-Identifier: GPL-3.0-or-later
// Step Review: thermal states, models, campaigns and scans side by side, with linked cameras, one colour scale, a
// slider over the states with playback, a table that selects in the views and a section through the heat maps.
#pragma once

#include <QTimer>
#include <array>
#include <atomic>
#include <memory>

#include "widgets/pages/page.h"
#include "widgets/services/review_sources.h"

class QCheckBox;
class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QSlider;
class QTableView;

namespace spindrift::gui {

class Plot;
class ReviewPane;
class RowsModel;
class Segments;
class View3D;

class ReviewPage : public Page {
  Q_OBJECT
 public:
  explicit ReviewPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return play_; }
  [[nodiscard]] ReviewPane* pane(int number) const { return panes_[static_cast<std::size_t>(number - 1)]; }
  /// 2 to 4.
  void setPanes(int count);
  void setComponent(int index);
  void setArrows(bool on);
  void setHeatMaps(bool on);
  [[nodiscard]] RowsModel* table() const { return rows_; }
  [[nodiscard]] QTableView* tableView() const { return table_; }
  [[nodiscard]] Plot* section() const { return section_; }
  [[nodiscard]] QSlider* slider() const { return slider_; }
  /// Hidden where the table stood at one angle only.
  [[nodiscard]] QComboBox* angleChoice() const { return angle_; }

 private:
  void layOutPanes();
  /// The choices of all panes in one line, or of all in two.
  void alignChoices();
  void lookAgain();
  /// Of the campaigns in the panes.
  void sayWhatIsOutdated();
  void fillSlider();
  /// Angles of the table at which the campaigns in the panes were measured; the choice stays where it can.
  void fillAngles();
  /// Nothing: all angles.
  [[nodiscard]] std::optional<double> angle() const;
  [[nodiscard]] std::string stateAtSlider() const;
  void showAll();
  void showScans();
  void showTable();
  void chooseSection(const ReviewSource& source);
  void showSection();
  void probe(View3D* view, const QPointF& pixel);
  void select(const QString& point);
  void play(bool on);
  [[nodiscard]] double exaggeration() const;

  void showNothingYet();
  void readOther(std::int64_t id, const QString& name, CampaignSource source);
  void takeOther(std::int64_t id, std::shared_ptr<const ReadForReview> read);

  ReviewSources sources_;
  std::string shown_folder_;  ///< of the campaign; ids start again in every session
  std::array<ReviewPane*, 4> panes_{};
  QGridLayout* grid_;
  Segments* count_;
  Segments* component_;
  QComboBox* angle_;
  QCheckBox* arrows_;
  QCheckBox* heat_maps_;
  QCheckBox* machine_;
  QSlider* slider_;
  QLabel* slider_text_;
  QPushButton* play_;
  QTimer timer_;
  RowsModel* rows_;
  QTableView* table_;
  Segments* direction_;
  QDoubleSpinBox* place_;
  Plot* section_;
  QString selected_;
  std::vector<std::string> states_;
  /// The latest request for states and for scans: older jobs have nothing to say.
  std::shared_ptr<std::atomic<int>> states_request_ = std::make_shared<std::atomic<int>>(0);
  std::shared_ptr<std::atomic<int>> request_ = std::make_shared<std::atomic<int>>(0);
  bool filling_ = false;
  bool refit_ = true;  ///< the next pictures are of another campaign: all views are fitted anew
};

}  // namespace spindrift::gui
