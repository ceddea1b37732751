// SPDX-License-Identifier: GPL-3.0-or-later
// What the search took as noise: its scale in every component, the shift common to all points of a state, its tails,
// the clock, and the readings that lie far from all others. Each of these can be looked at, taken out and brought back.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "core/workflows/discrepancy_story.h"
#include "widgets/export/exportable.h"

class QLabel;
class QPushButton;
class QStackedWidget;
class QTableView;

namespace spindrift::gui {

class Plot;
class RowsModel;
class Segments;

/// A reading that the user has taken out of the observations, and why.
struct ExcludedReading {
  OutlyingObservation reading;  ///< `deviation` is not known
  QString reason;
};

class NoisePanel : public QWidget {
  Q_OBJECT
 public:
  explicit NoisePanel(QWidget* parent = nullptr);
  /// Null: nothing has been searched.
  void show(const std::shared_ptr<const DiscrepancyStory>& story);
  /// What is taken out at present; listed with the outlying readings, so that it can be brought back.
  void setExcluded(std::vector<ExcludedReading> excluded);
  /// Items of the session ("M1/F3/EX") that are marked in the list of readings, each once.
  [[nodiscard]] QStringList chosenItems() const;
  /// True if all that is marked is taken out.
  [[nodiscard]] bool chosenAreExcluded() const;
  [[nodiscard]] std::vector<Exportable> exportables();
  [[nodiscard]] QTableView* noiseTable() const { return noise_table_; }
  [[nodiscard]] QTableView* readingTable() const { return reading_table_; }
  [[nodiscard]] QTableView* shiftTable() const { return shift_table_; }
  [[nodiscard]] Plot* shiftPlot() const { return shift_plot_; }
  [[nodiscard]] Plot* readingPlot() const { return reading_plot_; }
  [[nodiscard]] QPushButton* excludeButton() const { return exclude_; }
  [[nodiscard]] QLabel* facts() const { return facts_; }
  /// Shows the common shifts (false) or the outlying readings (true).
  void showReadings(bool readings);

 Q_SIGNALS:
  void hovered(const QString& text);
  /// The user looks at a reading.
  void readingChosen(const std::string& point, spindrift::Component component, double time_s);
  /// The user wants the marked readings out, or back in.
  void excludeAsked();

 private:
  struct Listed {
    OutlyingObservation reading;
    QString reason;  ///< empty: it is not taken out
    bool outlying = false;
  };
  void fillNoise();
  void fillFacts();
  void fillShifts();
  void fillReadings();
  void readingsChosen();
  void showReading();
  void arrange();
  [[nodiscard]] const Listed* listedAt(int row) const;

  RowsModel* noise_;
  RowsModel* shifts_;
  RowsModel* readings_;
  QTableView* noise_table_;
  QTableView* shift_table_;
  QTableView* reading_table_;
  QLabel* facts_;
  Segments* which_;
  QStackedWidget* stack_;
  QPushButton* exclude_;
  Plot* shift_plot_;
  Plot* reading_plot_;
  QLabel* reading_title_;
  std::shared_ptr<const DiscrepancyStory> story_;
  std::vector<ExcludedReading> excluded_;
  std::vector<Listed> listed_;
};

/// The item by which a session takes the readings of a point in a state out: "M1/F3/EX".
[[nodiscard]] QString itemOf(const std::string& state, const std::string& point, Component component);

}  // namespace spindrift::gui
