// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/noise_panel.h"

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
#include <cmath>
#include <map>

#include "core/machine/driver_words.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

/// Plot above, table below; in a low window this much is kept and scrolls.
constexpr int height_of_both = 328;

QString signedSize(double value, int digits) {
  return decimalText(value, 'f', digits);
}

QWidget* scrolled(QWidget* inside) {
  inside->setMinimumHeight(height_of_both);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(inside);
  return scroll;
}

}  // namespace

QString itemOf(const std::string& state, const std::string& point, Component component) {
  return QString::fromStdString(state + "/" + point + "/" + std::string(toString(component)));
}

NoisePanel::NoisePanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* left = new Card(tr("Noise of a reading"));
  noise_ = new RowsModel({tr("What"), tr("Noise scale"), tr("Common shift"), tr("Correlated")}, this);
  noise_table_ = makeTable(noise_, tr("Noise of every component"), tr("The noise found appears after the search."));
  left->body()->addWidget(noise_table_, 1);
  facts_ = makeLabel({}, "instruction");
  facts_->setWordWrap(true);
  facts_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* text = new QWidget;
  auto* text_column = new QVBoxLayout(text);
  text_column->setContentsMargins(0, 0, 8, 0);
  text_column->addWidget(facts_);
  text_column->addStretch(1);
  auto* text_scroll = new QScrollArea;
  text_scroll->setWidgetResizable(true);
  text_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  text_scroll->setWidget(text);
  left->body()->addWidget(text_scroll, 1);

  auto* right = new Card;
  auto* head = new QHBoxLayout;
  which_ = new Segments({tr("Common shift"), tr("Outlying readings")}, tr("What is shown"));
  head->addWidget(which_);
  head->addStretch(1);
  exclude_ = makeButton(tr("Exclude …"), "exclude");
  exclude_->setToolTip(tr("Leave the marked readings out; they stay in the data and can be brought back"));
  head->addWidget(exclude_);
  right->body()->addLayout(head);
  stack_ = new QStackedWidget;
  shift_plot_ = new Plot;
  shift_plot_->setEmptyText(tr("No common shift"),
                            tr("Where all points of a state are shifted together (re-referencing, refocus), the shift "
                               "of each state appears here."));
  shifts_ = new RowsModel({tr("State"), tr("Time")}, this);
  shift_table_ = makeTable(shifts_, tr("Common shift of every state"), tr("No state is shifted as a whole."));
  stack_->addWidget(scrolled(makeSplitter(nullptr, shift_plot_, shift_table_, 6, 5, Qt::Vertical)));
  readings_ = new RowsModel(
      {tr("Row"), tr("Point"), tr("State"), tr("What"), tr("Time"), tr("Deviation / σ"), tr("Status")}, this);
  reading_table_ = makeTable(readings_, tr("Outlying readings"), tr("No reading lies far from all others."));
  reading_table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  auto* look = new QWidget;
  auto* look_column = new QVBoxLayout(look);
  look_column->setContentsMargins(0, 0, 0, 0);
  look_column->setSpacing(4);
  reading_title_ = makeLabel({}, "sectionTitle");
  look_column->addWidget(reading_title_);
  reading_plot_ = new Plot;
  reading_plot_->setLegendVisible(false);
  reading_plot_->setEmptyText(tr("The series of the reading"), tr("Choose a reading in the table."));
  look_column->addWidget(reading_plot_, 1);
  stack_->addWidget(scrolled(makeSplitter(nullptr, reading_table_, look, 5, 6, Qt::Vertical)));
  right->body()->addWidget(stack_, 1);
  column->addWidget(makeSplitter(this, left, right, 6, 7), 1);

  connect(which_, &Segments::chosen, this, [this](int) { arrange(); });
  connect(exclude_, &QPushButton::clicked, this, &NoisePanel::excludeAsked);
  connect(reading_table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &NoisePanel::readingsChosen);
  connect(reading_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this] {
    showReading();
    const Listed* listed = listedAt(reading_table_->currentIndex().row());
    if (listed == nullptr) return;
    Q_EMIT readingChosen(listed->reading.point, listed->reading.component, listed->reading.time_s);
  });
  connect(shift_plot_, &Plot::hovered, this, &NoisePanel::hovered);
  connect(reading_plot_, &Plot::hovered, this, &NoisePanel::hovered);
  show(nullptr);
}

void NoisePanel::show(const std::shared_ptr<const DiscrepancyStory>& story) {
  story_ = story;
  fillNoise();
  fillFacts();
  fillShifts();
  fillReadings();
  if (story_ != nullptr && story_->shifts.empty() && !listed_.empty()) which_->setCurrent(1);
  arrange();
}

void NoisePanel::setExcluded(std::vector<ExcludedReading> excluded) {
  excluded_ = std::move(excluded);
  fillReadings();
}

void NoisePanel::showReadings(bool readings) {
  which_->setCurrent(readings ? 1 : 0);
  if (readings && reading_table_->currentIndex().row() < 0 && readings_->rowCount() > 0) reading_table_->selectRow(0);
  arrange();
}

void NoisePanel::arrange() {
  stack_->setCurrentIndex(which_->current());
  exclude_->setVisible(which_->current() == 1);
}

void NoisePanel::fillNoise() {
  std::vector<Row> rows;
  const std::vector<NoiseEstimate> none;
  for (const NoiseEstimate& n : story_ != nullptr ? story_->noise : none) {
    Row row;
    row.id = componentName(n.component);
    Cell name{row.id};
    name.bold = true;
    Cell scale = rightCell(withError(n.scale, n.scale_uncertainty, {}));
    scale.tip = tr("Scatter of the readings over their stated σ");
    Cell common =
        rightCell(n.common_um > 0.0 ? sizeText(n.common_um, componentUnit(n.component)) : QStringLiteral("–"));
    common.tip = tr("Standard deviation of the shift common to all points of a state");
    Cell correlated = rightCell(n.correlated_part > 0.0 ? tr("%1 % over %2")
                                                              .arg(decimalText(100 * n.correlated_part, 'f', 0))
                                                              .arg(coreSentence(spanOfTime(n.correlation_time_s)))
                                                        : QStringLiteral("–"));
    correlated.tip = tr("Part of the variance of the noise that is correlated in time, and its correlation time");
    row.cells = {name, scale, common, correlated};
    rows.push_back(std::move(row));
  }
  noise_->setRows(std::move(rows));
}

void NoisePanel::fillFacts() {
  if (story_ == nullptr) {
    facts_->clear();
    return;
  }
  QStringList lines;
  lines << tr("Noise scale: how much the readings scatter, over their stated σ.");
  lines << (story_->tail_dof > 0.0 ? tr("Tails: heavier than normal (Student t, %1 degrees of freedom); readings far "
                                        "out have little weight.")
                                         .arg(decimalText(story_->tail_dof, 'f', 0))
                                   : tr("Tails: normal distribution."));
  if (story_->clock_offset_uncertainty_s > 0.0) {
    const QString offset =
        withError(std::abs(story_->clock_offset_s), story_->clock_offset_uncertainty_s, QStringLiteral("s"));
    lines << (story_->clock_offset_s >= 0.0 ? tr("Clock: the log is %1 ahead of the observations.").arg(offset)
                                            : tr("Clock: the log is %1 behind the observations.").arg(offset));
  } else {
    lines << tr("Clock: these data show no offset between log and observations.");
  }
  const int count = static_cast<int>(story_->outliers.size());
  lines << (count == 0 ? tr("No reading lies far from all others.")
                       : tr("%n readings lie far from all others; they have little weight.", nullptr, count));
  facts_->setText(onScreen(lines.join(QLatin1Char('\n'))));
}

void NoisePanel::fillShifts() {
  shift_table_->setVisible(story_ != nullptr && !story_->shifts.empty());
  if (!shift_table_->isVisibleTo(shift_table_->parentWidget())) {
    shifts_->setRows({});
    shift_plot_->setContent({});
    return;
  }
  double last_s = 0.0;
  for (const StateShift& s : story_->shifts) last_s = std::max(last_s, s.time_s);
  const TimeUnit unit = timeUnit(last_s);
  std::vector<Component> components;
  std::vector<Series> series;
  QStringList headers{tr("State"), tr("Time / %1").arg(unit.name)};
  for (const Component c : all_components) {
    Series line;
    line.name = componentName(c);
    line.style = SeriesStyle::Points;
    line.sigma_factor = 1.0;
    line.colour = static_cast<int>(c) % 3;
    for (const StateShift& s : story_->shifts) {
      if (s.component != c) continue;
      line.x.push_back(s.time_s / unit.seconds);
      line.y.push_back(s.shift_um);
      line.sigma.push_back(s.standard_uncertainty);
    }
    if (line.x.empty()) continue;
    components.push_back(c);
    headers << QStringLiteral("%1 / %2").arg(componentName(c), componentUnit(c));
    series.push_back(std::move(line));
  }
  const bool displacements =
      std::any_of(components.begin(), components.end(), [](Component c) { return !isRotation(c); });
  const bool rotations = std::any_of(components.begin(), components.end(), [](Component c) { return isRotation(c); });
  shift_plot_->setAxes(tr("Time / %1").arg(unit.name),
                       displacements && rotations
                           ? tr("Common shift / %1, %2").arg(componentUnit(Component::EX), componentUnit(Component::EA))
                           : tr("Common shift / %1").arg(componentUnit(components.front())));
  shift_plot_->setContent(std::move(series));
  std::map<std::pair<double, std::string>, std::map<Component, const StateShift*>> states;
  for (const StateShift& s : story_->shifts) states[{s.time_s, s.state}][s.component] = &s;
  std::vector<Row> rows;
  for (const auto& [key, of_state] : states) {
    Row row;
    row.id = QString::fromStdString(key.second) + QString::number(key.first);
    Cell name{QString::fromStdString(key.second)};
    name.bold = true;
    row.cells = {name, rightCell(decimalText(key.first / unit.seconds, 'f', 2))};
    for (const Component c : components) {
      const auto found = of_state.find(c);
      row.cells.push_back(rightCell(found == of_state.end()
                                        ? QStringLiteral("–")
                                        : withError(found->second->shift_um, found->second->standard_uncertainty, {})));
    }
    rows.push_back(std::move(row));
  }
  shifts_->setHeaders(headers);
  shifts_->setRows(std::move(rows));
}

void NoisePanel::fillReadings() {
  listed_.clear();
  if (story_ != nullptr) {
    std::map<QString, QString> reasons;
    for (const ExcludedReading& e : excluded_) {
      reasons[itemOf(e.reading.state, e.reading.point, e.reading.component)] = e.reason;
    }
    std::vector<std::size_t> rows;
    for (const OutlyingObservation& o : story_->outliers) {
      const auto reason = reasons.find(itemOf(o.state, o.point, o.component));
      listed_.push_back({o, reason == reasons.end() ? QString() : reason->second, true});
      rows.push_back(o.row);
    }
    for (const ExcludedReading& e : excluded_) {
      if (std::find(rows.begin(), rows.end(), e.reading.row) == rows.end())
        listed_.push_back({e.reading, e.reason, false});
    }
  }
  double last_s = 0.0;
  for (const Listed& l : listed_) last_s = std::max(last_s, l.reading.time_s);
  const TimeUnit unit = timeUnit(last_s);
  std::vector<Row> rows;
  for (const Listed& l : listed_) {
    const OutlyingObservation& o = l.reading;
    Row row;
    row.id = QString::number(o.row);
    row.faded = !l.reason.isEmpty();
    Cell point{QString::fromStdString(o.point)};
    point.bold = true;
    Cell status{tr("little weight"), Tone::Attention, "alert"};
    status.tip = tr("Lies far from all others and was given little weight");
    if (row.faded) {
      status = Cell{tr("excluded"), Tone::Neutral, "exclude"};
      status.tip = tr("Excluded: %1").arg(l.reason);
    }
    row.cells = {rightCell(QString::number(o.row + 1)),
                 point,
                 {QString::fromStdString(o.state)},
                 {componentName(o.component)},
                 rightCell(tr("%1 %2").arg(decimalText(o.time_s / unit.seconds, 'f', 2)).arg(unit.name)),
                 rightCell(l.outlying ? signedSize(o.deviation, 1) : QStringLiteral("–")),
                 status};
    row.cells[5].tip = tr("Measured: %1").arg(sizeText(o.value, componentUnit(o.component)));
    rows.push_back(std::move(row));
  }
  const int now = reading_table_->currentIndex().row();
  const QString before = readings_->idAt(now);
  readings_->setRows(std::move(rows));
  const int again = before.isEmpty() ? -1 : readings_->rowOf(before);
  if (again >= 0 && again != reading_table_->currentIndex().row()) reading_table_->selectRow(again);
  which_->button(1)->setText(listed_.empty() ? tr("Outlying readings")
                                             : tr("Outlying readings (%1)").arg(listed_.size()));
  readingsChosen();
  showReading();
}

const NoisePanel::Listed* NoisePanel::listedAt(int row) const {
  return row >= 0 && row < static_cast<int>(listed_.size()) ? &listed_[static_cast<std::size_t>(row)] : nullptr;
}

QStringList NoisePanel::chosenItems() const {
  QStringList items;
  for (const QModelIndex& index : reading_table_->selectionModel()->selectedRows()) {
    const Listed* listed = listedAt(index.row());
    if (listed != nullptr) items << itemOf(listed->reading.state, listed->reading.point, listed->reading.component);
  }
  items.removeDuplicates();
  return items;
}

bool NoisePanel::chosenAreExcluded() const {
  const QModelIndexList chosen = reading_table_->selectionModel()->selectedRows();
  return !chosen.isEmpty() && std::all_of(chosen.begin(), chosen.end(), [this](const QModelIndex& index) {
    const Listed* listed = listedAt(index.row());
    return listed != nullptr && !listed->reason.isEmpty();
  });
}

void NoisePanel::readingsChosen() {
  exclude_->setEnabled(!chosenItems().isEmpty());
  exclude_->setText(QChar(0x2009) + (chosenAreExcluded() ? tr("Bring back") : tr("Exclude …")));
}

/// The series of the reading: its residual with all effects found, what was taken as noise around it.
void NoisePanel::showReading() {
  const Listed* listed = listedAt(reading_table_->currentIndex().row());
  const DiscrepancySeries* s =
      listed == nullptr || story_ == nullptr ? nullptr : story_->find(listed->reading.point, listed->reading.component);
  reading_title_->setVisible(s != nullptr);
  if (s == nullptr || s->time_s.empty()) {
    reading_plot_->setContent({});
    reading_plot_->setMoment(std::nullopt);
    return;
  }
  const OutlyingObservation& o = listed->reading;
  const TimeUnit unit = timeUnit(s->time_s.back());
  reading_title_->setText(tr("%1 of %2: residual with the effects found, ± 2 σ of the noise")
                              .arg(componentName(o.component), QString::fromStdString(o.point)));
  reading_plot_->setAxes(tr("Time / %1").arg(unit.name),
                         tr("%1 residual / %2").arg(componentName(o.component), componentUnit(o.component)));
  Series noise;
  noise.name = tr("noise, ± 2 σ");
  noise.style = SeriesStyle::Line;
  noise.colour = 2;
  Series residual;
  residual.name = tr("residual");
  residual.style = SeriesStyle::Points;
  residual.colour = 1;
  for (std::size_t i = 0; i < s->time_s.size(); ++i) {
    residual.x.push_back(s->time_s[i] / unit.seconds);
    residual.y.push_back(s->value[i] - s->simulated[i] - s->constant_before -
                         (s->explained.empty() ? 0.0 : s->explained[i]));
  }
  for (const double t : {residual.x.front(), residual.x.back()}) {
    noise.x.push_back(t);
    noise.y.push_back(0.0);
    noise.sigma.push_back(s->noise);
  }
  reading_plot_->setContent({noise, residual});
  reading_plot_->setMoment(o.time_s / unit.seconds);
}

std::vector<Exportable> NoisePanel::exportables() {
  std::vector<Exportable> items;
  if (story_ == nullptr) return items;
  items.push_back(exportableOf(tr("Noise"), noise_));
  if (shifts_->rowCount() > 0) {
    items.push_back(exportableOf(tr("Common shift of states"), shifts_));
    items.push_back(exportableOf(tr("Common shift over time"), shift_plot_));
  }
  if (readings_->rowCount() > 0) items.push_back(exportableOf(tr("Outlying readings"), readings_));
  return items;
}

}  // namespace spindrift::gui
