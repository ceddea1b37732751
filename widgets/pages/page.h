// SPDX-License-Identifier: GPL-3.0-or-later
// A page of a step: what to do now in one sentence, the controls, the result, what it can export.
//
// Adding a page: derive from Page, and name it in register_pages.cpp with its step and the campaigns it is for.
#pragma once

#include <QWidget>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "widgets/export/exportable.h"
#include "widgets/jobs/task_run.h"
#include "widgets/panels/page_context.h"

class QHBoxLayout;
class QVBoxLayout;

namespace spindrift::gui {

class Callout;
class WrappedLabel;

/// A stored result of a task, and what was given beside it.
struct ShownTask {
  ResultState state;
  bool reading = false;  ///< what was given beside it is being worked out again; the page is refreshed then
  std::shared_ptr<const TaskGiven> given;  ///< of the very result that is stored; null: it is not at hand
  template <class T>
  [[nodiscard]] std::shared_ptr<const T> as() const {
    return given == nullptr ? nullptr : given->result.as<T>();
  }
};

class Page : public QWidget {
  Q_OBJECT
 public:
  Page(PageContext context, StepId step, QWidget* parent = nullptr);

  /// Shows what the session holds now. Called when the page is shown and when the session changed while it is.
  virtual void refresh() = 0;
  [[nodiscard]] virtual std::vector<Exportable> exportables() { return {}; }
  /// The page's main action, for Ctrl+Return; may be null.
  [[nodiscard]] virtual QPushButton* primaryButton() const { return nullptr; }
  /// What is picked on the page, as exclusions and notes call it ("captures/images/a.jpg"); empty: nothing.
  [[nodiscard]] virtual QString pickedItem() const { return {}; }
  /// Runs what the page would be asked to run first (the tour and the tests use it).
  virtual void runAll() {}
  [[nodiscard]] StepId step() const { return step_; }
  [[nodiscard]] Callout* callout() const { return callout_; }

 protected:
  [[nodiscard]] PageContext& context() { return context_; }
  [[nodiscard]] SessionModel& session() { return context_.session; }
  [[nodiscard]] const SessionModel& session() const { return context_.session; }
  [[nodiscard]] QVBoxLayout* content() const { return content_; }
  /// Replaces the sentence under the title where the step's general one does not fit the instrument.
  void setInstruction(const QString& sentence);
  /// Places a button at the right of the title.
  void addAction(QWidget* widget);
  /// A button that switches the step Model between the model of the instrument and the one over time.
  void addModelSwitch(bool over_time);
  /// For the beginning of refresh(): when another campaign is shown than last time (SessionModel::visit, not its
  /// number), tabs go back to the first and the answer is true, so that the page takes away what belongs to the other.
  bool noticeCampaign();
  using Work = std::function<std::function<void()>(JobContext&)>;
  // Jobs. What they give is shown, and their failure is told in the page's callout, only while the campaign that they
  // were started for is at hand.
  /// Runs a task, and before it what it needs (widgets/jobs/task_run.h). The results are stored whatever is at hand
  /// then; `take` gets the task's own, and the page is refreshed. `ends` in place of that.
  void runTask(const std::string& task, WorkEnds ends = {});
  /// For a change of options: runs a task unless it cannot be run, or other work would have to come first.
  void runAlone(const std::string& task);
  /// Whether a task can be run, with what it needs first.
  [[nodiscard]] bool canRun(const std::string& task) const { return session().tasks().whyNot(task).empty(); }
  /// For refresh(): what to show of a task, whoever has run it. Where what was given beside a current result is not at
  /// hand, a job of this title works it out again.
  [[nodiscard]] ShownTask shown(const std::string& task, const QString& title);
  /// What the page's tasks work on; with what the page has read already.
  [[nodiscard]] virtual TaskInputs taskInputs() { return session().taskInputs(); }
  /// Work that leaves no result of the campaign: a proposal, a programme, a file.
  void run(const QString& title, Work work);
  /// Reads or works out again what is only to be shown, in place of what was to be shown before.
  void display(const QString& title, Work work);
  /// In the callout.
  void showFailure(const QString& sentence);
  /// Wires a hover signal to the hint line.
  template <class View>
  void showHints(View* view) {
    connect(view, &View::hovered, this, [this](const QString& text) {
      if (context_.hint) context_.hint(text);
    });
  }

 private:
  [[nodiscard]] Job jobOf(const QString& title, Work work);
  /// What is only to be shown has a key: what was asked for before under this title is not wanted any more.
  [[nodiscard]] std::string keyOf(const QString& title) const;
  /// Works out again what is shown beside the stored result of a task, unless that is being done; the page is
  /// refreshed then.
  void showAgain(const QString& title, const std::string& task);
  void forgetOtherVisits();
  void keepGiven(const TaskGiven& given);

  std::int64_t seen_visit_ = -1;
  std::map<std::string, std::shared_ptr<const TaskGiven>> given_;       ///< the last of each task, of given_visit_
  std::map<std::string, std::shared_ptr<const ResultOrigin>> reading_;  ///< by task: what is worked out again now
  std::int64_t given_visit_ = -1;                                       ///< that given_ and reading_ belong to
  PageContext context_;
  StepId step_;
  WrappedLabel* instruction_;
  Callout* callout_;
  QVBoxLayout* content_;
  QHBoxLayout* actions_;
};

/// Which page a step shows for a campaign.
class PageRegistry {
 public:
  /// Makes a page inside `place`: what is put into a window only when it is whole gets all its styles again.
  using Factory = std::function<Page*(PageContext, QWidget* place)>;
  using Applies = std::function<bool(const SessionModel&)>;
  /// The first entry of a step that applies is shown.
  void add(StepId step, Applies applies, Factory factory, const char* key);
  struct Entry {
    StepId step;
    Applies applies;
    Factory factory;
    const char* key;
  };
  [[nodiscard]] const Entry* find(StepId step, const SessionModel& session) const;

 private:
  std::vector<Entry> entries_;
};

/// All pages of the program.
void registerPages(PageRegistry& registry);

}  // namespace spindrift::gui
