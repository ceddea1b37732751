// SPDX-License-Identifier: GPL-3.0-or-later
// Step Discrepancy: the story of what the simulation lacks. Where it disagrees, what is missing, what was taken as
// noise, what remains; add the effect, see the gap close, know what to measure next. Which effects are in the model,
// which are left out and which are the user's own is an option of the session and can be undone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/tasks/task_options.h"
#include "core/workflows/discrepancy_story.h"
#include "widgets/common/parts.h"
#include "widgets/pages/page.h"
#include "widgets/services/from_observations.h"

class QLabel;
class QStackedWidget;
class QTabWidget;

namespace spindrift::gui {

class Card;
class EffectsPanel;
class EmptyState;
class GapPanel;
class IconLabel;
class NextPanel;
class NoisePanel;
class RemainderPanel;
class SimulationPanel;
class WhatPanel;
class WherePanel;
struct ExcludedReading;

class DiscrepancyPage : public Page {
  Q_OBJECT
 public:
  explicit DiscrepancyPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return search_; }
  void runAll() override { search(); }
  /// Asks what is to become of an effect that is being edited. False: the user wants to stay with it.
  [[nodiscard]] bool mayBeLeft();
  /// The list of effects in place of the story, or the story again.
  void showEffects(bool shown);

  [[nodiscard]] QPushButton* addButton() const { return add_; }
  [[nodiscard]] QPushButton* removeButton() const { return remove_; }
  [[nodiscard]] QPushButton* effectsButton() const { return effects_button_; }
  [[nodiscard]] EffectsPanel* effects() const { return effects_; }  ///< null before it was first shown
  [[nodiscard]] QLabel* verdict() const { return verdict_; }
  [[nodiscard]] QTabWidget* tabs() const { return tabs_; }
  [[nodiscard]] WherePanel* where() const { return where_; }
  [[nodiscard]] WhatPanel* what() const { return what_; }
  [[nodiscard]] NoisePanel* noise() const { return noise_; }
  [[nodiscard]] RemainderPanel* remainder() const { return remainder_; }
  [[nodiscard]] GapPanel* gap() const { return gap_; }
  [[nodiscard]] NextPanel* next() const { return next_; }
  [[nodiscard]] SimulationPanel* simulation() const { return simulation_; }
  [[nodiscard]] const DiscrepancyStory* story() const { return story_.get(); }
  /// Takes the readings marked in the list of outliers out, or, without a reason, brings them back.
  void excludeReadings(const QString& reason);

 private:
  void search();
  /// After the choice has changed: a stored result with the same choice is shown again, else the search is run.
  void choiceChanged();
  void change(const QString& what, const EffectOptions& after);
  /// After the list of effects has changed: nothing is searched before somebody asks for it.
  void effectsChanged();
  void changeEffects(const QString& what, const EffectOptions& after, bool typed);
  void showContent(int index);
  void knowTitles();
  void add();
  void removeLast();
  void show();
  /// In place of a story: why there is none. What is changed in the simulation itself needs none.
  void showNothing(const QString& title, const QString& how);
  /// The tabs that have something to show, and the verdict where it belongs.
  void arrangeTabs();
  void makeSimulationPanel();
  /// Panels that nobody sees before there is a result are made one at a turn of the event loop.
  void makePanelsSoon();
  /// All that are not there yet, at once.
  void makePanels();
  /// The next one, in the order of the tabs; false when that was the last.
  bool makePanel();
  void showExcluded();
  void toggleExcluded();
  void choose(const std::string& point, Component component);
  void showVerdict();
  void updateButtons();
  [[nodiscard]] QString missing() const;  ///< what the campaign lacks for this step; empty: nothing

  QPushButton* search_;
  QPushButton* effects_button_;
  EffectsPanel* effects_ = nullptr;
  int content_index_ = 0;     ///< what is shown while the effects are not
  nlohmann::json titles_of_;  ///< whose effects' titles are known
  QPushButton* add_;
  QPushButton* remove_;
  QStackedWidget* stack_;
  EmptyState* empty_;
  EmptyState* nothing_yet_;  ///< a tab, where there is something to search
  Card* banner_;
  IconLabel* verdict_icon_;
  WrappedLabel* verdict_;
  WrappedLabel* verdict_note_;
  QTabWidget* tabs_;
  WherePanel* where_;
  WhatPanel* what_ = nullptr;  ///< this and the others: see makePanel
  NoisePanel* noise_ = nullptr;
  FromObservations<std::vector<ExcludedReading>> excluded_;
  RemainderPanel* remainder_ = nullptr;
  GapPanel* gap_;
  SimulationPanel* simulation_ = nullptr;
  NextPanel* next_ = nullptr;
  std::shared_ptr<const DiscrepancyStory> story_;
  std::int64_t shown_result_ = 0;
};

}  // namespace spindrift::gui
