// SPDX-License-Identifier: GPL-3.0-or-later
// Keeping a model over time true by on-machine measurements: the updated prediction beside the free run, and fit and
// peak to peak against the interval of the measurements (30 ... 180 min).
#pragma once

#include <QWidget>
#include <functional>
#include <memory>

#include "core/workflows/thermal_tracking.h"

class QComboBox;
class QPushButton;
class QSpinBox;

namespace spindrift::gui {

class Callout;
class Plot;
class Segments;

class UpdatePanel : public QWidget {
  Q_OBJECT
 public:
  using Work = std::function<std::function<void()>(JobContext&)>;
  /// `run` starts a job of the page.
  UpdatePanel(std::function<void(const QString&, Work)> run, QWidget* parent = nullptr);
  /// What is kept true; null: nothing is identified yet. `sigma`: of one measurement in the output's unit.
  void set(std::shared_ptr<const TimeSeries> series, std::shared_ptr<const IdentifyResult> model, double sigma);
  [[nodiscard]] QPushButton* button() const { return button_; }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] Segments* what() const { return what_; }
  [[nodiscard]] const std::shared_ptr<const TrackResult>& result() const { return result_; }

 private:
  void track();
  void show();

  std::function<void(const QString&, Work)> run_;
  std::shared_ptr<const TimeSeries> series_;
  std::shared_ptr<const IdentifyResult> model_;
  std::shared_ptr<const TrackResult> result_;
  double sigma_ = 0.5;
  QComboBox* kind_;
  QSpinBox* interval_;
  QPushButton* button_;
  Callout* summary_;
  Segments* what_;
  Plot* plot_;
};

}  // namespace spindrift::gui
