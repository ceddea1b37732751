// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/next_panel.h"

#include <QHeaderView>
#include <QLabel>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>

#include "core/base/text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

/// What the machine does at a time of the suggested programme.
QString stepAt(const MeasurementSuggestion& suggestion, double time_s) {
  for (const ProgrammeStep& step : suggestion.programme) {
    if (time_s < step.to_s) return coreSentence(step.action);
  }
  return suggestion.programme.empty() ? QString() : coreSentence(suggestion.programme.back().action);
}

}  // namespace

NextPanel::NextPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* left = new Card(tr("What to measure next"));
  suggestion_ = new QLabel;
  suggestion_->setWordWrap(true);
  suggestion_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  left->body()->addWidget(suggestion_);
  gain_ = new NumberTile(tr("Probability of a unique result"));
  left->body()->addWidget(gain_);
  times_ = new RowsModel({tr("Time / s"), tr("Point"), tr("Program")}, this);
  left->body()->addStretch(1);
  planned_ = left;
  auto* right = new Card(tr("How it was found"));
  nothing_ = new Callout;
  right->body()->addWidget(nothing_);
  leftover_ = new Callout;
  right->body()->addWidget(leftover_);
  steps_ = new RowsModel({tr("Effect tried"), tr("Decision"), tr("Gain in BIC"), tr("Why")}, this);
  QTableView* steps =
      makeTable(steps_, tr("Steps of the search"), tr("Every step of the search appears here with its evidence."));
  // Names and reasons share the width and stand in as many lines as they need; there are few steps.
  stretchColumn(steps, 3);
  steps->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  right->body()->addWidget(steps, 1);
  warnings_ = makeLabel({}, "secondaryText");
  warnings_->setWordWrap(true);
  right->body()->addWidget(warnings_);
  column->addWidget(makeSplitter(this, left, right, 4, 8), 1);
  show(nullptr);
}

void NextPanel::show(const std::shared_ptr<const DiscrepancyStory>& story) {
  story_ = story;
  showSuggestion();
  std::vector<Row> rows;
  QStringList notes;
  leftover_->set(Tone::Neutral, {});
  if (story_ != nullptr) {
    if (!story_->leftover.empty()) {
      leftover_->show(Tone::Attention, tr("Remainder: %1.").arg(titledSentence(story_->leftover)));
    } else {
      leftover_->show(Tone::Good, tr("Nothing remains beyond the noise."));
    }
    int index = 0;
    for (const DiscrepancyStep& s : story_->steps) {
      Row row;
      row.id = QString::number(index++);
      Cell name{sentenceStart(effectTitle(s.id))};
      name.tip = QString::fromStdString(s.id);
      Cell gain{decimalText(s.delta_bic, 'f', 0)};
      gain.right = true;
      const bool out_again = takenOutAgain(s, story_->effects);
      Cell reason{titledSentence(s.reason)};
      if (out_again && story_->verdict == DiscrepancyVerdict::Unknown) {
        reason.text = tr("with it too something remains that no effect explains");
      }
      reason.tip = reason.text;
      const Cell decision = out_again    ? Cell{tr("removed"), Tone::Neutral, "undo"}
                            : s.accepted ? Cell{tr("added"), Tone::Good, "check-circle"}
                                         : Cell{tr("not added"), Tone::Neutral, "exclude"};
      row.cells = {name, decision, gain, reason};
      rows.push_back(std::move(row));
    }
    for (const std::string& w : story_->warnings) notes << titledSentence(w);
  }
  steps_->setRows(std::move(rows));
  warnings_->setText(notes.join(QLatin1Char('\n')));
  warnings_->setVisible(!notes.isEmpty());
}

void NextPanel::showSuggestion() {
  std::vector<Row> rows;
  gain_->setVisible(story_ != nullptr && story_->suggestion.has_value());
  if (story_ == nullptr) {
    suggestion_->setText(tr("After the search this says which measurement distinguishes the rivals."));
  } else if (story_->suggestion) {
    const MeasurementSuggestion& s = *story_->suggestion;
    QStringList times;
    for (const double t : s.times_s) {
      times << clockText(t);
      for (const std::string& point : s.points) {
        Row row;
        row.id = QString::number(t);
        row.cells = {{decimalText(t, 'f', 0)}, {QString::fromStdString(point)}, {stepAt(s, t)}};
        rows.push_back(std::move(row));
      }
    }
    QStringList places;
    for (const std::string& p : s.points) places << QString::fromStdString(p);
    // "After a night at rest", then a line for every part of the programme: "0:00 to 2:24 X alone at 12 m/min".
    QStringList programme;
    if (s.programme.empty()) {
      programme << coreSentence(s.conditions);
    } else {
      programme << tr("After a night at rest:");
      for (const ProgrammeStep& step : s.programme) {
        programme << tr("%1 to %2 %3").arg(clockText(step.from_s), clockText(step.to_s), coreSentence(step.action));
      }
      if (s.restart_instrument) programme << tr("The instrument is off until the start.");
      if (!s.c_deg.empty()) programme << tr("The table stands at its angles in turn.");
    }
    const auto item = [](const QString& name, const QStringList& lines) {
      QStringList escaped;
      for (const QString& line : lines) escaped << line.toHtmlEscaped();
      return QStringLiteral("<p><b>%1</b><br>%2</p>").arg(name.toHtmlEscaped(), escaped.join(QStringLiteral("<br>")));
    };
    suggestion_->setText(item(tr("To distinguish"), {titledSentence(s.separates)}) +
                         item(tr("What the machine does (h:min)"), programme) +
                         item(tr("Where"), {places.join(QStringLiteral("; "))}) +
                         item(tr("When, from the start of the program (h:min)"), {times.join(QStringLiteral(", "))}));
    gain_->set(tr("%1 %").arg(decimalText(100.0 * s.probability_alone_expected, 'f', 0)),
               tr("most probable one now: %1 %").arg(decimalText(100.0 * s.probability_alone_now, 'f', 0)));
  } else if (!story_->decided) {
    suggestion_->setText(sentenceStart(titledSentence(story_->message)));
  } else if (story_->verdict == DiscrepancyVerdict::Unknown) {
    suggestion_->setText(
        tr("No effect of the catalogue fits, so there are no rivals to distinguish. Log what else happens at the "
           "machine (hydraulics, pumps, doors, neighbours) at the times of the disagreement, and measure again."));
  } else if (story_->verdict == DiscrepancyVerdict::None) {
    suggestion_->setText(tr("Nothing to measure next: measured and simulated agree."));
  } else {
    suggestion_->setText(tr("Nothing to measure next: no rival fits as well as the named effect."));
  }
  times_->setRows(std::move(rows));
  // A plan has a card of its own; one sentence needs none.
  const bool planned = story_ != nullptr && story_->suggestion.has_value();
  planned_->setVisible(planned);
  nothing_->set(Tone::Neutral, planned ? QString() : suggestion_->text());
}

std::vector<Exportable> NextPanel::exportables() {
  std::vector<Exportable> items;
  if (story_ == nullptr) return items;
  if (story_->suggestion) items.push_back(exportableOf(tr("What to measure next"), times_));
  if (!story_->steps.empty()) items.push_back(exportableOf(tr("Steps of the search"), steps_));
  return items;
}

}  // namespace spindrift::gui
