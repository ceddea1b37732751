// SPDX-License-Identifier: GPL-3.0-or-later
// Step Warm-up: has the instrument settled? Temperatures and the drift of what was measured again and again.
#pragma once

#include <QElapsedTimer>
#include <memory>
#include <string>

#include "core/machine/operating_log.h"
#include "widgets/pages/page.h"

class QTabWidget;

namespace spindrift::gui {

class ClockPanel;
class Plot;
class ResolutionCheckPanel;
class RowsModel;

class WarmUpPage : public Page {
  Q_OBJECT
 public:
  explicit WarmUpPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  void runAll() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return check_; }
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] ResolutionCheckPanel* jogs() const { return jogs_; }
  [[nodiscard]] ClockPanel* clocks() const { return clocks_; }
  [[nodiscard]] ResolutionCheckPanel* repeatability() const { return repeatability_; }
  [[nodiscard]] Plot* temperatures() const { return temperature_; }

 private:
  void confirm();
  void check(const std::string& task);
  /// Of the log, and what has come since it was read.
  void showTemperatures();
  /// What was recorded so far, read beside the window.
  void readRecorded();

  std::shared_ptr<const OperatingLog> recorded_;
  std::int64_t recorded_visit_ = -1;
  QElapsedTimer since_read_;
  QElapsedTimer since_shown_;
  QPushButton* check_;
  QPushButton* confirm_;
  QTabWidget* tabs_;
  ResolutionCheckPanel* jogs_;
  ResolutionCheckPanel* repeatability_;
  ClockPanel* clocks_;
  RowsModel* verdicts_;
  Plot* drift_;
  Plot* temperature_;
};

}  // namespace spindrift::gui
