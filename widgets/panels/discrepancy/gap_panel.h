// SPDX-License-Identifier: GPL-3.0-or-later
// The gap between measured and simulated, before and after, side by side with the same scales.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "core/machine/machine_description.h"
#include "core/workflows/discrepancy_story.h"
#include "core/workflows/residual_map.h"
#include "widgets/export/exportable.h"
#include "widgets/jobs/latest_work.h"

class QComboBox;
class QGridLayout;
class QLabel;
class QSlider;

namespace spindrift::gui {

class Card;
class GapBars;
class Plot;
class Segments;
class View3D;
class WrappedLabel;

class GapPanel : public QWidget {
  Q_OBJECT
 public:
  explicit GapPanel(QWidget* parent = nullptr);
  void show(const std::shared_ptr<const DiscrepancyStory>& story, const MachineDescription* machine);
  /// Shows this series (carried over from the place that was chosen).
  void choose(const std::string& point, Component component);
  /// Shows the machine at the state nearest to this time.
  void chooseTime(double time_s);
  [[nodiscard]] std::string point() const;
  [[nodiscard]] Component component() const;
  [[nodiscard]] std::vector<Exportable> exportables();
  [[nodiscard]] View3D* view(bool after) const { return views_[after ? 1 : 0]; }
  [[nodiscard]] QSlider* moment() const { return moment_; }
  [[nodiscard]] GapBars* bars() const { return bars_; }
  [[nodiscard]] Plot* plot(bool after) const { return plots_[after ? 1 : 0]; }
  /// Before or after, where there is no room for both side by side.
  [[nodiscard]] Segments* sides() const { return sides_; }
  /// One side beside the figures; both where there is room.
  [[nodiscard]] QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void hovered(const QString& text);
  /// The user chose another component or point.
  void chosen();
  /// The machine is shown at another time.
  void timeChosen(double time_s);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void fillChoices();
  void fillMoments();
  void showPlots();
  void showViews();
  void arrange();
  /// Of the figures and so many of the two sides beside one another, px.
  [[nodiscard]] int widthOf(int sides) const;
  void userChose();
  void markMoment();
  void showSide(std::size_t side, Component component, const ResidualMap& map);
  void showNoise();
  [[nodiscard]] const DiscrepancySeries* series() const;
  /// The moment that the slider stands at; there are moments.
  [[nodiscard]] const ResidualMoment& shownMoment() const {
    return moments_[static_cast<std::size_t>(moment_->value())];
  }
  /// With the angle of the table behind it where the component was measured at several.
  [[nodiscard]] QString withAngle(const QString& what, double c_deg) const;

  GapBars* bars_;
  WrappedLabel* model_;
  QLabel* story_text_;
  QComboBox* component_;
  QComboBox* point_;
  QWidget* figures_;
  Segments* what_;
  Segments* sides_;
  QLabel* moment_text_;
  QSlider* moment_;
  QGridLayout* grid_;
  std::array<Card*, 2> plot_cards_{};
  std::array<Card*, 2> view_cards_{};
  std::array<Plot*, 2> plots_{};
  std::array<QLabel*, 2> legends_{};
  std::array<View3D*, 2> views_{};
  std::shared_ptr<const DiscrepancyStory> discrepancy_;
  std::optional<MachineDescription> machine_;
  std::vector<ResidualMoment> moments_;
  double plotted_c_deg_ = 0.0;  ///< angle of the table of the readings in the plots
  double plot_second_ = 1.0;    ///< one second on the plots' axis of time
  bool views_stale_ = false;    ///< something changed while the panel was not in sight
  double largest_ = 0.0;        ///< of the maps of this component, before
  LatestWork maps_, movements_;
};

}  // namespace spindrift::gui
