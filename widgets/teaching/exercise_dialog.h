// SPDX-License-Identifier: GPL-3.0-or-later
// The exercise "find the missing effect": draw one, look at its campaign in the window, name what is hidden, get marks.
// The dialog stays open beside the work. Scores are kept in the preferences.
#pragma once

#include <QDialog>
#include <optional>
#include <vector>

#include "core/workflows/exercise.h"

class QComboBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace spindrift::gui {

class Callout;
class Card;
class JobRunner;
class QuantityBox;
class RowsModel;
class Segments;
class SessionModel;

/// One exercise that was marked.
struct ExerciseRecord {
  QString when;   ///< local date and time, as it is shown
  QString level;  ///< "easy"
  qulonglong seed = 0;
  int score = 0;
  int hints = 0;
};
/// The latest first, at most 50.
[[nodiscard]] std::vector<ExerciseRecord> exerciseHistory();
void addToExerciseHistory(const ExerciseRecord& record);

class ExerciseDialog : public QDialog {
  Q_OBJECT
 public:
  ExerciseDialog(SessionModel& session, JobRunner& jobs, QWidget* parent = nullptr);

  [[nodiscard]] const std::optional<Exercise>& exercise() const { return exercise_; }
  [[nodiscard]] Segments* level() const { return level_; }
  [[nodiscard]] QSpinBox* seed() const { return seed_; }
  [[nodiscard]] QPushButton* startButton() const { return start_; }
  [[nodiscard]] QPushButton* hintButton() const { return hint_; }
  [[nodiscard]] QPushButton* answerButton() const { return answer_; }
  [[nodiscard]] int answerRows() const { return static_cast<int>(rows_.size()); }
  /// Fills a row of the answer as a user does; false if there is no such effect to pick.
  bool pick(int row, const std::string& id, const std::string& driver, const std::optional<NamedSize>& size);
  /// Units of files that a size may have in a row of the answer.
  [[nodiscard]] std::vector<std::string> sizeUnits(int row) const;
  [[nodiscard]] const std::optional<ExerciseScore>& score() const { return score_; }
  [[nodiscard]] RowsModel* resultRows() const { return results_; }
  [[nodiscard]] RowsModel* historyRows() const { return history_; }
  [[nodiscard]] QString hintText() const;
  [[nodiscard]] bool ready() const { return !choices_.empty(); }

 Q_SIGNALS:
  /// A new exercise is wanted: its campaign is to be made and opened.
  void startWanted(spindrift::Exercise exercise);
  /// The answer is given; the search may be looked at.
  void searchWanted();

 private:
  struct AnswerRow {
    QWidget* widget = nullptr;
    QComboBox* family = nullptr;
    QComboBox* effect = nullptr;
    QComboBox* driver = nullptr;
    QComboBox* kind = nullptr;  ///< of the size: its data is the unit of files
    QuantityBox* size = nullptr;
  };
  void refresh();
  void loadChoices();
  void makeRows();
  void fillEffects(const AnswerRow& row);
  void fillDetails(const AnswerRow& row);
  [[nodiscard]] const ExerciseChoice* chosen(const AnswerRow& row) const;
  void withKey(const QString& title, std::function<void(const ExerciseKey&)> use);
  void showHint();
  void giveAnswer();
  void showScore(const ExerciseKey& key);
  void refreshHistory();

  SessionModel& session_;
  JobRunner& jobs_;
  std::optional<Exercise> exercise_;
  std::filesystem::path campaign_;
  std::vector<ExerciseChoice> choices_;
  std::optional<ExerciseKey> key_;
  std::optional<ExerciseScore> score_;
  int hints_ = 0;
  std::vector<AnswerRow> rows_;
  Segments* level_;
  QSpinBox* seed_;
  QPushButton* start_;
  Card* answer_card_;
  Callout* state_;
  QVBoxLayout* answer_rows_;
  QLabel* hint_text_;
  QPushButton* hint_;
  QPushButton* answer_;
  QPushButton* search_;
  RowsModel* results_;
  RowsModel* history_;
  QWidget* results_table_;
};

}  // namespace spindrift::gui
