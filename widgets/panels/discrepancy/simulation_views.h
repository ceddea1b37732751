// SPDX-License-Identifier: GPL-3.0-or-later
// Measured against the simulation's own runs, before and after something was put into it: one series over time, and
// over the table the moment at which the gap was largest.
#pragma once

#include <QWidget>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/machine_description.h"
#include "core/reporting/discrepancy_figures.h"
#include "core/reporting/series_gaps.h"
#include "core/workflows/simulation_story.h"
#include "widgets/export/exportable.h"
#include "widgets/jobs/latest_work.h"

class QComboBox;
class QLabel;

namespace spindrift::gui {

class Card;
class Plot;
class View3D;

/// One plot: points measured, a line before, a line after; the series with the largest gap first.
class SimulationHistory : public QWidget {
  Q_OBJECT
 public:
  explicit SimulationHistory(QWidget* parent = nullptr);
  void show(const std::vector<DiscrepancyReportRow>& rows);
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] QComboBox* series() const { return series_; }

 Q_SIGNALS:
  void hovered(const QString& text);

 private:
  void draw();

  QComboBox* series_;
  Plot* plot_;
  std::vector<DiscrepancyReportRow> rows_;
  std::vector<SeriesGap> gaps_;
};

/// Two views of the table on one scale.
class SimulationMaps : public QWidget {
  Q_OBJECT
 public:
  explicit SimulationMaps(QWidget* parent = nullptr);
  /// The maps are there a moment later.
  void show(const std::shared_ptr<const SimulationStory>& story, const MachineDescription& machine);
  [[nodiscard]] bool empty() const { return !shown_; }
  [[nodiscard]] View3D* view(bool after) const { return views_[after ? 1 : 0]; }
  [[nodiscard]] std::vector<Exportable> exportables();

 Q_SIGNALS:
  void hovered(const QString& text);

 private:
  void sayWhyEmpty(const QString& why);
  /// Before and after, at `time_s`; the measurement ends at `last_s`.
  void draw(const DiscrepancyMaps& maps, const MachineDescription& machine, double last_s);

  std::array<Card*, 2> cards_{};
  std::array<View3D*, 2> views_{};
  bool shown_ = false;
  LatestWork work_;
};

}  // namespace spindrift::gui
