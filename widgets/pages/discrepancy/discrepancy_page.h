// SPDX-License-Identifier: GPL-3.0-or-later
// Step Discrepancy: the story of what the simulation lacks. Where it disagrees, what is missing, what was taken as
// noise, what remains; add the effect, see the gap close, know what to measure next. Which effects are in the model is
// an option of the session and can be undone.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/workflows/discrepancy_story.h"
#include "widgets/pages/page.h"

class QLabel;
class QStackedWidget;
class QTabWidget;

namespace spindrift::gui {

class EmptyState;
class GapPanel;
class IconLabel;
class NextPanel;
class NoisePanel;
class RemainderPanel;
class WhatPanel;
class WherePanel;

/// Effects that the user has put into the model or does not want considered, kept in the session.
struct DiscrepancyChoice {
  std::vector<std::string> added;
  std::vector<std::string> rejected;
  [[nodiscard]] static DiscrepancyChoice of(const SessionModel& session);
  [[nodiscard]] static std::string key(const SessionModel& session);
  [[nodiscard]] nlohmann::json json() const;
};

class DiscrepancyPage : public Page {
  Q_OBJECT
 public:
  explicit DiscrepancyPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return search_; }
  void runAll() override { search(); }

  [[nodiscard]] QPushButton* addButton() const { return add_; }
  [[nodiscard]] QPushButton* removeButton() const { return remove_; }
  [[nodiscard]] QLabel* verdict() const { return verdict_; }
  [[nodiscard]] QTabWidget* tabs() const { return tabs_; }
  [[nodiscard]] WherePanel* where() const { return where_; }
  [[nodiscard]] WhatPanel* what() const { return what_; }
  [[nodiscard]] NoisePanel* noise() const { return noise_; }
  [[nodiscard]] RemainderPanel* remainder() const { return remainder_; }
  [[nodiscard]] GapPanel* gap() const { return gap_; }
  [[nodiscard]] NextPanel* next() const { return next_; }
  [[nodiscard]] const DiscrepancyStory* story() const { return story_.get(); }
  /// Takes the readings marked in the list of outliers out, or, without a reason, brings them back.
  void excludeReadings(const QString& reason);

 private:
  void search();
  /// After the choice has changed: a stored result with the same choice is shown again, else the search is run.
  void choiceChanged();
  void change(const QString& what, const DiscrepancyChoice& after);
  void add();
  void removeLast();
  void show();
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
  QPushButton* add_;
  QPushButton* remove_;
  QStackedWidget* stack_;
  EmptyState* empty_;
  IconLabel* verdict_icon_;
  QLabel* verdict_;
  QLabel* verdict_note_;
  QTabWidget* tabs_;
  WherePanel* where_;
  WhatPanel* what_ = nullptr;  ///< this and the others: see makePanel
  NoisePanel* noise_ = nullptr;
  RemainderPanel* remainder_ = nullptr;
  GapPanel* gap_;
  NextPanel* next_ = nullptr;
  std::shared_ptr<const DiscrepancyStory> story_;
  std::int64_t shown_result_ = 0;
};

}  // namespace spindrift::gui
