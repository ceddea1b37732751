// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/what_panel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <optional>

#include "core/base/text.h"
#include "core/machine/driver_words.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/page_room.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/shown_angle.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

/// From this height on the plot has room below the text.
constexpr int height_for_plot = 440;

}  // namespace

WhatPanel::WhatPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* left = new Card(tr("Effects"));
  effects_ = new RowsModel({tr("Effect"), tr("Verdict"), tr("Gain in BIC")}, this);
  effect_table_ = makeTable(effects_, tr("Effects found"), tr("Effects appear after the search."));
  stretchColumn(effect_table_, 0);
  left->body()->addWidget(effect_table_, 4);
  which_ = new Segments({tr("Most probable"), tr("Parameters")}, tr("What is listed"));
  left->body()->addWidget(which_);
  candidates_ = new RowsModel({tr("Effect"), tr("Probability"), tr("Answer")}, this);
  candidate_table_ =
      makeTable(candidates_, tr("Most probable effects"), tr("The ten most probable effects appear after the search."));
  stretchColumn(candidate_table_, 0);
  parameters_ = new RowsModel({tr("Parameter, jointly fitted"), tr("Value ± standard uncertainty")}, this);
  below_ = new QStackedWidget;
  below_->addWidget(candidate_table_);
  below_->addWidget(makeTable(parameters_, tr("Parameters of the effect"), tr("No effect is chosen.")));
  left->body()->addWidget(below_, 5);

  detail_ = new Card;
  reject_ = makeButton(tr("Do not consider"), "exclude");
  reject_->setToolTip(tr("Search again without this effect"));
  detail_->addToTitle(reject_);
  auto* tiles = new QHBoxLayout;
  tiles->setSpacing(16);
  confidence_ = new NumberTile(tr("Confidence"));
  gain_ = new NumberTile(tr("Gain in BIC"));
  held_out_ = new NumberTile(tr("Held-out rms"));
  for (NumberTile* tile : {confidence_, gain_, held_out_}) tiles->addWidget(tile, 1);
  detail_->body()->addLayout(tiles);
  rivals_ = new Callout;
  detail_->body()->addWidget(rivals_);
  drivers_ = makeLabel({}, "instruction");
  drivers_->setWordWrap(true);
  physics_ = new QLabel;
  physics_->setWordWrap(true);
  physics_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* text = new QWidget;
  auto* text_column = new QVBoxLayout(text);
  text_column->setContentsMargins(0, 0, 8, 0);
  text_column->addWidget(drivers_);
  physics_title_ = makeLabel(tr("What happens"), "sectionTitle");
  text_column->addWidget(physics_title_);
  text_column->addWidget(physics_);
  text_column->addStretch(1);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(text);
  scroll->setMinimumHeight(112);
  detail_->body()->addWidget(scroll, 3);
  plot_title_ = makeLabel({}, "sectionTitle");
  auto* plot_line = new WrapLayout(16);
  plot_line->addWidget(plot_title_);
  legend_ = makeLabel({}, "secondaryText");
  plot_line->addWidget(legend_);
  detail_->body()->addLayout(plot_line);
  plot_ = new Plot;
  plot_->setLegendVisible(false);
  plot_->setEmptyText(tr("What the effects explain will appear here"), tr("Search, or choose another place."));
  detail_->body()->addWidget(plot_, 4);
  connect(plot_, &Plot::hovered, this, &WhatPanel::hovered);
  column->addWidget(makeSplitter(this, left, detail_, 7, 6), 1);

  connect(effect_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this] {
    showEffect();
    Q_EMIT choiceChanged();
  });
  connect(which_, &Segments::chosen, below_, &QStackedWidget::setCurrentIndex);
  // A candidate that is an effect of the list is shown there.
  connect(candidate_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) {
            const int row = now.isValid() ? effects_->rowOf(candidates_->idAt(now.row())) : -1;
            if (row >= 0) effect_table_->selectRow(row);
          });
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, &WhatPanel::fillCandidates);
  connect(reject_, &QPushButton::clicked, this, [this] {
    if (const std::string id = chosen(); !id.empty()) Q_EMIT rejectAsked(id);
  });
  show(nullptr);
}

void WhatPanel::show(const std::shared_ptr<const DiscrepancyStory>& story) {
  const std::string before = chosen();
  story_ = story;
  std::vector<Row> rows;
  std::optional<int> first;  // that is proposed
  if (story_ != nullptr) {
    for (const FoundEffect& e : story_->effects) {
      Row row;
      row.id = QString::fromStdString(e.id);
      Cell name{sentenceStart(effectTitle(e.id))};
      name.bold = true;
      name.tip = row.id;
      Cell state =
          e.forced ? Cell{tr("added"), Tone::Good, "check-circle"} : Cell{tr("proposed"), Tone::Accent, "discrepancy"};
      row.cells = {name, state, rightCell(decimalText(e.delta_bic, 'f', 0))};
      if (!e.forced && !first) first = static_cast<int>(rows.size());
      rows.push_back(std::move(row));
      for (const std::string& rival : e.rivals) {
        Row other;
        other.id = QString::fromStdString(rival);
        Cell rival_name{tr("or: %1").arg(effectTitle(rival))};
        rival_name.tip = other.id;
        other.cells = {rival_name, {tr("rival"), Tone::Attention, "compare"}, rightCell(QStringLiteral("–"))};
        rows.push_back(std::move(other));
      }
    }
    QString empty = tr("No effect is missing.");
    if (!story_->decided) {
      empty = tr("These data cannot decide what is missing.");
    } else if (story_->verdict == DiscrepancyVerdict::Unknown) {
      const QString remains = remainderText(story_->remainder);
      empty = remains.isEmpty()
                  ? tr("Nothing can be named: no effect of the catalogue explains the residual.")
                  : tr("Nothing can be named: the remainder is %1, which no effect of the catalogue explains.")
                        .arg(remains);
    }
    effect_table_->setProperty("emptyText", empty);
  } else {
    effect_table_->setProperty("emptyText", tr("Effects appear after the search."));
  }
  effects_->setRows(std::move(rows));
  fillCandidates();
  const int again = before.empty() ? -1 : effects_->rowOf(QString::fromStdString(before));
  if (effects_->rowCount() > 0) effect_table_->selectRow(again >= 0 ? again : first.value_or(0));
  showEffect();
}

void WhatPanel::fillCandidates() {
  std::vector<Row> rows;
  const std::vector<EffectCandidate> none;
  for (const EffectCandidate& c : story_ != nullptr ? story_->candidates : none) {
    Row row;
    row.id = QString::fromStdString(c.id);
    Cell name{sentenceStart(effectTitle(c.id))};
    name.tip = row.id;
    const double stated = statedProbability(c, story_->effects);
    const bool named = candidateRole(c.id, story_->effects) == CandidateRole::Named;
    Cell probability = rightCell(percentOf(stated));
    probability.picture = probabilityBar(stated, devicePixelRatioF());
    probability.tip = named ? tr("Confidence that it is right")
                            : tr("Probability that it is among what is missing, before rivals and the remainder are "
                                 "weighed");
    Cell answer{QStringLiteral("–")};
    switch (candidateRole(c.id, story_->effects)) {
      case CandidateRole::Named:
        answer = {tr("named"), Tone::Good, "check-circle"};
        name.bold = true;
        break;
      case CandidateRole::Rival:
        answer = {tr("rival"), Tone::Attention, "compare"};
        break;
      case CandidateRole::Container:
        answer.text = tr("nested model");
        answer.tip = tr("Contains the named effect as a special case");
        break;
      case CandidateRole::None:
        if (c.rejected) answer.text = tr("rejected");
        break;
    }
    row.cells = {name, probability, answer};
    rows.push_back(std::move(row));
  }
  candidate_table_->setProperty("emptyText", story_ == nullptr
                                                 ? tr("The ten most probable effects appear after the search.")
                                                 : tr("No effect of the catalogue is probable."));
  candidates_->setRows(std::move(rows));
}

std::string WhatPanel::chosen() const {
  const QModelIndex now = effect_table_->selectionModel()->currentIndex();
  return now.isValid() ? effects_->idAt(now.row()).toStdString() : std::string();
}

bool WhatPanel::chosenIsAdded() const {
  const std::string id = chosen();
  return story_ != nullptr && std::find(story_->added.begin(), story_->added.end(), id) != story_->added.end();
}

const FoundEffect* WhatPanel::effectOf(const std::string& id) const {
  if (story_ == nullptr) return nullptr;
  for (const FoundEffect& e : story_->effects) {
    if (e.id == id || std::find(e.rivals.begin(), e.rivals.end(), id) != e.rivals.end()) return &e;
  }
  return nullptr;
}

void WhatPanel::showEffect() {
  const std::string id = chosen();
  const FoundEffect* e = effectOf(id);
  reject_->setVisible(e != nullptr && !chosenIsAdded());
  arrange();
  std::vector<Row> rows;
  if (e == nullptr) {
    parameters_->setRows({});
    detail_->setTitle(story_ == nullptr || story_->leftover.empty() ? tr("What happens in the machine")
                                                                    : tr("What remains"));
    for (NumberTile* tile : {confidence_, gain_, held_out_}) tile->hide();
    rivals_->set(Tone::Neutral, {});
    drivers_->clear();
    physics_->setText(story_ == nullptr ? tr("The physics of the effect and the evidence for it will appear here.")
                      : story_->leftover.empty() ? tr("Nothing is missing in the simulation.")
                                                 : sentenceStart(titledSentence(story_->leftover)) + QLatin1Char('.'));
    physics_title_->hide();
    return;
  }
  for (NumberTile* tile : {confidence_, gain_, held_out_}) tile->show();
  physics_title_->show();
  const bool rival = id != e->id;
  detail_->setTitle(sentenceStart(effectTitle(id)));
  confidence_->set(percentOf(e->confidence),
                   e->rivals.empty() ? tr("that the named effect is the right one") : tr("that it is one of these"));
  gain_->set(decimalText(e->delta_bic, 'f', 0), tr("above 10 is very strong"));
  held_out_->set(tr("%1 → %2").arg(sizeText(e->heldout_rms_before_um, {}),
                                   sizeText(e->heldout_rms_after_um, QStringLiteral("um"))),
                 story_->has_holdout ? tr("observations held out") : tr("blocks left out in turn"));
  if (e->rivals.empty()) {
    rivals_->set(Tone::Neutral, {});
  } else {
    std::vector<std::string> all{e->id};
    all.insert(all.end(), e->rivals.begin(), e->rivals.end());
    rivals_->show(Tone::Attention, tr("These data cannot distinguish %1. Choose the one that is known to be present, "
                                      "or measure what the last tab proposes.")
                                       .arg(effectTitles(all, tr("or"))));
  }
  QString drivers = tr("Driver: %1.").arg(driverWords(e->drivers));
  if (!e->containers.empty()) {
    drivers += QLatin1Char(' ') + tr("Also part of %1.").arg(effectTitles(e->containers, tr("and")));
  }
  drivers += QLatin1Char(' ') + tr("Displacement at the tool: %1 rms. Id: %2.")
                                    .arg(sizeText(e->rms_um, QStringLiteral("um")), QString::fromStdString(e->id));
  drivers_->setText(onScreen(drivers));
  physics_->setText(
      rival ? tr("The values are those of %1, which fits equally well. Add this effect instead to see its own.")
                  .arg(effectTitle(e->id))
            : coreSentence(e->physics));
  if (!rival) {
    for (const FittedParameter& p : e->parameters) {
      Row row;
      row.id = QString::fromStdString(p.name);
      Cell name{coreSentence(spindrift::parameterTitle(p.name))};
      name.tip = row.id;
      row.cells = {
          name, rightCell(shownNumbers(QString::fromStdString(withUncertainty(p.value, p.standard_uncertainty, ""))))};
      rows.push_back(std::move(row));
    }
  }
  parameters_->setRows(std::move(rows));
}

void WhatPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

void WhatPanel::arrange() {
  const int rivals = story_ != nullptr && effectOf(chosen()) != nullptr && !effectOf(chosen())->rivals.empty() ? 80 : 0;
  const bool room = roomOnPage(*this) - rivals >= height_for_plot && has_plot_;
  plot_->setVisible(room);
  plot_title_->setVisible(room);
  legend_->setVisible(room);
}

void WhatPanel::choose(const std::string& point, Component component) {
  const DiscrepancySeries* s = story_ == nullptr ? nullptr : story_->find(point, component);
  has_plot_ = s != nullptr;
  arrange();
  if (s == nullptr || s->time_s.empty()) {
    plot_->setContent({});
    return;
  }
  const TimeUnit unit = timeUnit(s->time_s.back());
  const double c_deg = clearestAngle(*s);
  const QString at = withShownAngle(QString::fromStdString(point), *s, c_deg);
  plot_title_->setText(s->explained.empty() ? tr("%1 of %2: unexplained").arg(componentName(component), at)
                                            : tr("%1 of %2: explained").arg(componentName(component), at));
  plot_->setAxes(tr("Time / %1").arg(unit.name),
                 tr("%1 residual / %2").arg(componentName(component), componentUnit(component)));
  Series measured;
  measured.name = tr("measured − simulated");
  measured.style = SeriesStyle::Points;
  measured.colour = 1;
  Series line;
  line.name = tr("effects, ± 2 σ noise");
  line.style = SeriesStyle::Line;
  line.colour = 0;
  for (std::size_t i = 0; i < s->time_s.size(); ++i) {
    if (s->placeOf(i).c_deg != c_deg) continue;
    measured.x.push_back(s->time_s[i] / unit.seconds);
    measured.y.push_back(s->value[i] - s->simulated[i] - s->constant_before);
    if (s->explained.empty()) continue;
    line.x.push_back(s->time_s[i] / unit.seconds);
    line.y.push_back(s->explained[i]);
    line.sigma.push_back(s->noise);
  }
  std::vector<std::pair<int, QString>> names{{1, measured.name}};
  if (!line.x.empty()) names.emplace_back(0, line.name);
  legend_->setText(legendText(names));
  std::vector<Series> series{measured};
  if (!line.x.empty()) series.insert(series.begin(), line);
  plot_->setContent(std::move(series));
}

std::vector<Exportable> WhatPanel::exportables() {
  std::vector<Exportable> items;
  if (story_ == nullptr) return items;
  if (candidates_->rowCount() > 0) items.push_back(exportableOf(tr("Most probable effects"), candidates_));
  if (story_->effects.empty()) return items;
  items.push_back(exportableOf(tr("Effects"), effects_));
  items.push_back(exportableOf(tr("Parameters of the effect"), parameters_));
  if (!plot_->empty()) items.push_back(exportableOf(tr("What the effects explain"), plot_));
  return items;
}

}  // namespace spindrift::gui
