// SPDX-License-Identifier: GPL-3.0-or-later
// The missing effect goes into the simulation itself: which simulator belongs to the campaign, which of its parameters
// is behind the gap, and what its own new run makes of it. No program is run before the user asks for it.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/workflows/simulation_story.h"
#include "widgets/export/exportable.h"
#include "widgets/jobs/latest_work.h"
#include "widgets/panels/discrepancy/opened_simulator.h"
#include "widgets/panels/page_context.h"

class QLabel;
class QPushButton;
class QStackedWidget;
class QTableView;

namespace spindrift::gui {

class Callout;
class Card;
class ParameterCard;
class RowsModel;
class Segments;
class SimulationHistory;
class SimulationMaps;
class WrappedLabel;

class SimulationPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SimulationPanel(PageContext context, QWidget* parent = nullptr);
  /// Shows what the session holds now.
  void refresh();
  /// From now on this is the campaign's simulator in the session.
  void chooseSimulator(const QString& file);
  /// Runs the simulator.
  void search();
  /// Puts what is ticked (what is found, where nobody has set a tick) into the simulation; the new version goes to a
  /// new folder. A search that is missing is made first.
  void putInto(const QString& folder);
  /// A folder that does not exist yet, in the session.
  [[nodiscard]] QString proposedFolder() const;
  [[nodiscard]] std::vector<Exportable> exportables();

  [[nodiscard]] QPushButton* chooseButton() const { return choose_; }
  [[nodiscard]] QPushButton* searchButton() const { return search_; }
  [[nodiscard]] QPushButton* putButton() const { return put_; }
  [[nodiscard]] Callout* callout() const { return callout_; }
  [[nodiscard]] QLabel* runs() const;
  [[nodiscard]] QLabel* found() const { return found_; }
  [[nodiscard]] QTableView* parameterTable() const;
  [[nodiscard]] QTableView* figureTable() const { return figure_table_; }
  [[nodiscard]] SimulationHistory* history() const { return history_; }
  [[nodiscard]] SimulationMaps* maps() const { return maps_; }  ///< null before it was first shown
  [[nodiscard]] Segments* views() const { return views_; }
  [[nodiscard]] const SimulationStory* story() const { return story_.get(); }
  /// The update that is shown; null: none, or it was undone.
  [[nodiscard]] const SimulationUpdate* update() const;
  /// simulator.json of the version that was written from the simulator at hand; empty: none.
  [[nodiscard]] QString versionMade() const;
  /// simulator.json is being read.
  [[nodiscard]] bool busy() const { return opening_.busy(); }

 Q_SIGNALS:
  void hovered(const QString& text);

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// A search that was made since the window was opened, with all that an update of the simulation takes.
  struct Searched {
    std::int64_t visit = 0;
    std::int64_t result = 0;
    std::shared_ptr<const DiscrepancyRun> run;
  };
  void askForFolder();
  /// Why what is ticked cannot be put in; empty: it can.
  [[nodiscard]] QString whyNotPut() const;
  void openSoon();
  void load();
  void simulatorChanged();
  void fail(const QString& sentence);
  void showHead();
  void showParameters();
  void showFound();
  void showFigures();
  void showCallout();
  void showView(int index);
  void arrange();
  /// With a simulator, for the campaign at hand; other work does not keep it from being asked for.
  [[nodiscard]] bool searching() const;
  void updateButtons();
  [[nodiscard]] bool current() const;
  [[nodiscard]] QString titleOf(const FoundEffect& effect) const;
  /// A sentence of core with what a parameter is in place of its name in the file.
  [[nodiscard]] QString told(std::string sentence) const;

  PageContext context_;
  Card* head_;
  QLabel* title_;
  WrappedLabel* runs_;
  QPushButton* choose_;
  QPushButton* search_;
  QPushButton* put_;
  Callout* callout_;
  Segments* views_;
  QStackedWidget* stack_;
  ParameterCard* parameters_;
  Card* found_card_;
  QWidget* found_scroll_;
  QLabel* found_;
  RowsModel* figures_;
  QTableView* figure_table_;
  SimulationHistory* history_;
  SimulationMaps* maps_ = nullptr;
  LatestWork opening_;
  OpenedSimulator opened_;
  std::string opened_key_;
  std::string simulator_;  ///< name of the one at hand
  StoredResult stored_;    ///< without its payload
  std::int64_t shown_result_ = 0;
  std::int64_t shown_visit_ = -1;
  std::shared_ptr<const SimulationStory> story_;
  bool maps_stale_ = true;
  Searched searched_;
  QString failure_;
};

}  // namespace spindrift::gui
