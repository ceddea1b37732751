// SPDX-License-Identifier: GPL-3.0-or-later
// The thermal tests of ISO 230-3 on the log at hand: environmental temperature variation and rotating spindle,
// parameters with uncertainty. What is chosen belongs to the campaign: the report tells the same test.
#pragma once

#include <QWidget>
#include <array>
#include <memory>

#include "core/tasks/task_options.h"
#include "core/workflows/thermal_tests.h"

class QComboBox;
class QLineEdit;

namespace spindrift::gui {

class Callout;
class Plot;
class RowsModel;
class Segments;

class IsoPanel : public QWidget {
  Q_OBJECT
 public:
  explicit IsoPanel(QWidget* parent = nullptr);
  /// What there is to choose of a series, and what is chosen; another choice is told by `chosen`.
  void set(std::shared_ptr<const TimeSeries> series, const Iso230Choice& choice = {});
  /// Its parameters, or why there are none; null: not known yet.
  void show(std::shared_ptr<const StandardTest> test);
  [[nodiscard]] Segments* test() const { return test_; }
  [[nodiscard]] QComboBox* speed() const { return speed_; }
  [[nodiscard]] QLineEdit* range() const { return range_; }
  [[nodiscard]] RowsModel* rows() const { return rows_; }
  /// Displacements and rotations stand in plots of their own; one that has nothing to show is hidden.
  [[nodiscard]] Plot* plot(bool rotations = false) const { return plots_[rotations ? 1 : 0]; }
  [[nodiscard]] Callout* note() const { return note_; }

 Q_SIGNALS:
  void chosen(const Iso230Choice& choice);

 private:
  void fillColumns();
  void fillChoice();
  [[nodiscard]] Iso230Choice controls() const;
  void choose();
  /// Draws what the log holds, or nothing.
  void showCurves(bool any);
  void showEtve(const EtveResult& result);
  void showSpindle(const SpindleResult& result);

  std::shared_ptr<const TimeSeries> series_;
  std::shared_ptr<const StandardTest> told_;
  Iso230Choice choice_;
  Iso230Choice shown_;  ///< the same as the controls say it, with what was not chosen
  Segments* test_;
  QComboBox* ambient_;
  QComboBox* speed_;  ///< column that says when the spindle runs
  QLineEdit* range_;  ///< "FROM:TO" in s; empty: the whole record
  Callout* note_;
  RowsModel* rows_;
  std::array<Plot*, 2> plots_{};
};

}  // namespace spindrift::gui
