// SPDX-License-Identifier: GPL-3.0-or-later
// All effects that the search can name on this machine, of the catalogue by family and the user's own: physics,
// formula, drivers and the shape on the machine. Each can be switched off; the user's own can be written, loaded and
// saved here, and are checked while they are typed. Nothing is changed by this widget itself: it asks for a new choice,
// which the page keeps in the session. An effect that is being typed is a draft of the campaign.
#pragma once

#include <QTimer>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/tasks/campaign_state.h"
#include "core/tasks/task_options.h"
#include "core/workflows/discrepancy_workflow.h"
#include "widgets/commands/draft.h"
#include "widgets/export/exportable.h"
#include "widgets/jobs/latest_work.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QScrollArea;
class QStackedWidget;
class QTreeWidget;
class QTreeWidgetItem;

namespace spindrift::gui {

class Callout;
class Card;
class EffectEditor;
class EffectPicture;

/// What there is to be listed.
struct EffectListing {
  std::vector<Effect> effects;  ///< those of the user's that could not be bound to the log are without variants
  std::shared_ptr<const OwnEffects> own;
  nlohmann::json document;  ///< effects.json as it is or would be
  QStringList warnings;
  QString problem;  ///< why the effects of the user's cannot be used; empty: they can

  [[nodiscard]] const Effect* find(const std::string& id) const;
};

class EffectsPanel : public QWidget {
  Q_OBJECT
 public:
  /// Under which the effect that is being edited is kept (SessionModel::draft).
  static constexpr auto draft_name = "effect";
  EffectsPanel(SessionModel& session, CampaignUndo& undo, QWidget* parent = nullptr);
  /// Shows what the session holds now; a list that must be made anew follows a little later.
  void refresh();
  /// While the list is being made or an effect checked.
  [[nodiscard]] bool busy() const;
  [[nodiscard]] bool editing() const;
  /// What is typed in the editor and not taken over.
  [[nodiscard]] bool hasUnsavedEdit() const { return editing() && edited_; }
  /// Gives up what is typed in the editor.
  void leaveEditor();
  /// Shows the list; what is typed stays a draft.
  void closeEditor();
  void newEffect();
  void editEffect(const std::string& id);
  void removeEffect(const std::string& id);
  /// Takes over the effects of a file; what is wrong with it is told, and nothing is changed.
  void loadFile(const QString& file);
  void saveFile(const QString& file);
  void choose(const std::string& id);
  [[nodiscard]] std::string chosen() const;
  [[nodiscard]] std::vector<Exportable> exportables();

  [[nodiscard]] const EffectListing& listing() const { return listing_; }
  [[nodiscard]] QLineEdit* searchField() const { return search_; }
  [[nodiscard]] QTreeWidget* tree() const { return tree_; }
  /// Null if it is not listed.
  [[nodiscard]] QTreeWidgetItem* itemOf(const std::string& id) const;
  [[nodiscard]] QLabel* details() const { return details_; }
  [[nodiscard]] EffectPicture* picture() const { return picture_; }
  [[nodiscard]] QCheckBox* builtIn() const { return built_in_; }
  [[nodiscard]] EffectEditor* editor() const { return editor_; }  ///< null before the first edit
  [[nodiscard]] EffectPicture* editorPicture() const { return editor_picture_; }
  [[nodiscard]] Callout* editorState() const { return editor_state_; }
  [[nodiscard]] QPushButton* acceptButton() const { return accept_; }
  [[nodiscard]] Callout* callout() const { return callout_; }

 Q_SIGNALS:
  /// `what` in words for undo; `typed`: what is in the editor is applied with it.
  void changeAsked(const QString& what, const spindrift::EffectOptions& after, bool typed);
  /// What is typed in the editor was taken back or done again and should be seen.
  void editorWanted();

 private:
  void makeBrowser();
  void makeEditor();
  void list();
  void fillTree();
  void markStates();
  void filter();
  void switched();
  void showEffect();
  void showPicture();
  void updateButtons();
  void storeDocument(const QString& what, nlohmann::json document, const std::string& renamed_from = {},
                     const std::string& renamed_to = {});
  // the editor
  void openEditor(const nlohmann::json& entry, const std::string& original);
  /// The editor as the draft has it, or closed where there is none.
  void showDraft();
  [[nodiscard]] nlohmann::json typed() const;
  /// What is to be said of the list: its problem or warnings, or that an effect was typed for another.
  void sayState();
  void editorChanged();
  void checkEdited();
  void showProblem(const InputError& wrong);
  void showMarkedField();
  void showEditorPicture();
  void accept();
  [[nodiscard]] nlohmann::json editedDocument() const;
  [[nodiscard]] std::size_t editedIndex() const;

  SessionModel& session_;
  QStackedWidget* stack_;
  // browsing
  QLineEdit* search_ = nullptr;
  QLabel* count_ = nullptr;
  QTreeWidget* tree_ = nullptr;
  QCheckBox* built_in_ = nullptr;
  QPushButton* new_ = nullptr;
  QPushButton* load_ = nullptr;
  QPushButton* save_ = nullptr;
  QPushButton* original_ = nullptr;
  Callout* callout_ = nullptr;
  Card* detail_ = nullptr;
  QPushButton* edit_ = nullptr;
  QPushButton* remove_ = nullptr;
  QComboBox* gain_ = nullptr;
  EffectPicture* picture_ = nullptr;
  QLabel* details_ = nullptr;
  // editing
  EffectEditor* editor_ = nullptr;
  EffectPicture* editor_picture_ = nullptr;
  QComboBox* editor_gain_ = nullptr;
  Callout* editor_state_ = nullptr;
  Card* editor_card_ = nullptr;
  QScrollArea* editor_scroll_ = nullptr;
  QPushButton* accept_ = nullptr;
  std::string original_id_;  ///< of the effect that is edited; empty: a new one
  bool edited_ = false;
  bool of_another_ = false;  ///< it is said that an effect was typed for other effects
  Draft draft_;
  std::optional<Effect> read_;  ///< the edited one, as it could be read last
  QTimer debounce_;

  std::shared_ptr<const Campaign> campaign_;  ///< what the list was made for
  std::shared_ptr<const StoredEvaluation> evaluation_;
  nlohmann::json effects_of_choice_;
  bool listed_ = false;
  std::string chosen_after_listing_;
  bool filling_ = false;
  bool switch_queued_ = false;
  EffectListing listing_;
  LatestWork list_work_;
  LatestWork check_work_;
};

}  // namespace spindrift::gui
