// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/remainder_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/workflows/discrepancy_sizes.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/shown_angle.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

constexpr std::size_t most_lines = 12;  ///< of all points together

}  // namespace

RemainderPanel::RemainderPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* left = new Card;
  sentence_ = new WrappedLabel;
  sentence_->setProperty("role", QStringLiteral("instruction"));
  left->body()->addWidget(sentence_);
  components_ = new RowsModel({tr("rms"), tr("Residual"), tr("Effects"), tr("Noise"), tr("Remainder")}, this);
  component_table_ =
      makeTable(components_, tr("Remainder of every component"), tr("Components appear after the search."));
  stretchColumn(component_table_, 0);
  left->body()->addWidget(component_table_, 4);
  points_title_ = makeLabel({}, "sectionTitle");
  left->body()->addWidget(points_title_);
  points_ = new RowsModel({tr("Point"), tr("rms"), tr("Largest"), tr("When")}, this);
  point_table_ = makeTable(points_, tr("Remainder at every point"), tr("Nothing remains in this component."));
  left->body()->addWidget(point_table_, 5);

  plot_card_ = new Card;
  which_ = new Segments({tr("This point"), tr("All points")}, tr("What is drawn"));
  auto* head = new QHBoxLayout;
  head->addWidget(which_);
  legend_ = makeLabel({}, "secondaryText");
  legend_->setWordWrap(true);
  legend_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  head->addWidget(legend_, 1);
  plot_card_->body()->addLayout(head);
  plot_ = new Plot;
  plot_->setLegendVisible(false);
  plot_->setEmptyText(tr("The remainder over time"),
                      tr("Search: what neither effects nor noise explain appears here."));
  plot_card_->body()->addWidget(plot_, 1);
  column->addWidget(makeSplitter(this, left, plot_card_, 7, 6), 1);

  connect(component_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) {
            if (following_ || !now.isValid() || story_ == nullptr) return;
            const auto component = componentFromString(components_->idAt(now.row()).toStdString());
            if (!component) return;
            component_ = *component;
            fillPoints();
            showPlot();
            Q_EMIT chosen();
          });
  connect(point_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) {
            if (following_ || !now.isValid() || story_ == nullptr) return;
            point_ = points_->idAt(now.row()).toStdString();
            showPlot();
            Q_EMIT chosen();
          });
  connect(which_, &Segments::chosen, this, [this](int) { showPlot(); });
  connect(plot_, &Plot::hovered, this, &RemainderPanel::hovered);
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] {
    if (story_ != nullptr) showPlot();
  });
  show(nullptr);
}

void RemainderPanel::show(const std::shared_ptr<const DiscrepancyStory>& story) {
  story_ = story;
  if (story_ == nullptr) {
    components_->setRows({});
    points_->setRows({});
    sentence_->clear();
    points_title_->setText(tr("Pattern over the points"));
    plot_card_->setTitle(tr("Over time"));
    plot_->setContent({});
    legend_->clear();
    return;
  }
  const QString remains = remainderText(story_->remainder);
  std::vector<std::string> names;
  for (const FoundEffect& e : story_->effects) names.push_back(e.id);
  const QString named = effectTitles(names, tr("and"));
  sentence_->setText(remains.isEmpty() ? names.empty()
                                             ? tr("Nothing remains beyond the noise.")
                                             : tr("Apart from %1 nothing remains beyond the noise.").arg(named)
                     : names.empty() ? tr("Nothing can be named: the remainder is %1.").arg(remains)
                                       : tr("Apart from %1 the remainder is %2.").arg(named, remains));
  if (story_->find(point_, component_) == nullptr && !story_->series.empty()) {
    const auto largest = std::max_element(story_->remainder.begin(), story_->remainder.end(),
                                          [](const auto& a, const auto& b) { return a.evidence < b.evidence; });
    component_ = largest == story_->remainder.end() ? story_->series.front().component : largest->component;
    point_.clear();
  }
  fillComponents();
  fillPoints();
  showPlot();
}

void RemainderPanel::fillComponents() {
  std::vector<Row> rows;
  for (const Component c : all_components) {
    const DiscrepancySizes sizes = sizesOf(story_->series, c);
    if (sizes.rows == 0) continue;
    const auto found = std::find_if(story_->remainder.begin(), story_->remainder.end(),
                                    [c](const ComponentRemainder& r) { return r.component == c; });
    const bool remains = found != story_->remainder.end() && found->evidence >= clear_evidence;
    Row row;
    row.id = componentName(c);
    Cell name{tr("%1 / %2").arg(componentName(c), componentUnit(c))};
    name.bold = true;
    Cell size = rightCell(found == story_->remainder.end() ? QStringLiteral("–") : sizeText(found->rms_um, {}));
    if (remains) {
      size.tone = Tone::Attention;
      size.icon = "alert";
    }
    size.tip =
        found == story_->remainder.end()
            ? tr("Nothing smooth in time and space remains")
            : tr("rms of what is smooth in time and space and neither effect nor noise. Evidence that it is more "
                 "than noise: %1 (2 ln of the odds, clear from %2 on)")
                  .arg(decimalText(found->evidence, 'f', 0))
                  .arg(decimalText(clear_evidence, 'f', 0));
    row.cells = {name, rightCell(sizeText(sizes.residual, {})), rightCell(sizeText(sizes.effects, {})),
                 rightCell(sizeText(sizes.noise, {})), size};
    for (Cell& cell : row.cells) cell.unit = componentUnit(c);
    row.cells[1].tip = tr("rms of measured − simulated");
    row.cells[2].tip = tr("rms of what the effects found explain");
    rows.push_back(std::move(row));
  }
  following_ = true;
  components_->setRows(std::move(rows));
  const int row = components_->rowOf(componentName(component_));
  if (row >= 0) component_table_->selectRow(row);
  following_ = false;
}

void RemainderPanel::fillPoints() {
  const QString unit = componentUnit(component_);
  points_title_->setText(shownTitle(tr("Pattern of %1 over the points / %2").arg(componentName(component_), unit)));
  double last_s = 0.0;
  for (const DiscrepancySeries& s : story_->series) {
    if (!s.time_s.empty()) last_s = std::max(last_s, s.time_s.back());
  }
  const TimeUnit time = timeUnit(last_s);
  std::vector<Row> rows;
  double largest_rms = -1.0;
  std::string clearest;
  for (const DiscrepancySeries& s : story_->series) {
    if (s.component != component_ || s.time_s.empty()) continue;
    const double size = s.remainingRms();
    Row row;
    row.id = QString::fromStdString(s.point);
    Cell name{row.id};
    name.bold = true;
    row.cells = {name, rightCell(sizeText(size, {})), rightCell(QStringLiteral("–")), rightCell(QStringLiteral("–"))};
    if (const auto most = s.largestRemaining(); most && size > 0.0) {
      row.cells[2] = rightCell(sizeText(s.remaining[*most], {}));
      for (const std::size_t i : {1, 2}) row.cells[i].unit = unit;
      row.cells[3] = rightCell(tr("%1 %2").arg(decimalText(s.time_s[*most] / time.seconds, 'f', 1)).arg(time.name));
    }
    if (std::isfinite(size) && size > largest_rms) {
      largest_rms = size;
      clearest = s.point;
    }
    if (clearest.empty()) clearest = s.point;
    rows.push_back(std::move(row));
  }
  if (story_->find(point_, component_) == nullptr) point_ = clearest;
  following_ = true;
  points_->setRows(std::move(rows));
  const int row = points_->rowOf(QString::fromStdString(point_));
  if (row >= 0) point_table_->selectRow(row);
  following_ = false;
}

void RemainderPanel::choose(const std::string& point, Component component) {
  if (story_ == nullptr || story_->find(point, component) == nullptr) return;
  if (point == point_ && component == component_) return;
  const bool other = component != component_;
  point_ = point;
  component_ = component;
  following_ = true;
  const int at = components_->rowOf(componentName(component));
  if (at >= 0) component_table_->selectRow(at);
  const int row = points_->rowOf(QString::fromStdString(point));
  if (!other && row >= 0) point_table_->selectRow(row);
  following_ = false;
  if (other) fillPoints();
  showPlot();
}

void RemainderPanel::showPlot() {
  const DiscrepancySeries* s = story_ == nullptr ? nullptr : story_->find(point_, component_);
  if (s == nullptr || s->time_s.empty()) {
    plot_->setContent({});
    legend_->clear();
    return;
  }
  const TimeUnit unit = timeUnit(s->time_s.back());
  const double c_deg = clearestAngle(*s);
  plot_->setAxes(tr("Time / %1").arg(unit.name),
                 tr("%1 residual / %2").arg(componentName(component_), componentUnit(component_)));
  plot_->setLeastRange(s->noise);
  std::vector<Series> series;
  if (which_->current() == 1) {
    plot_card_->setTitle(withShownAngle(tr("Remainder of %1 at all points").arg(componentName(component_)), *s, c_deg));
    for (const DiscrepancySeries& other : story_->series) {
      if (other.component != component_ || other.remaining.empty()) continue;
      if (series.size() >= most_lines && other.point != point_) continue;
      Series line;
      line.name = QString::fromStdString(other.point);
      line.style = SeriesStyle::Line;
      // The chosen point stands out; names of the others are shown where the pointer is.
      line.colour = other.point == point_ ? 3 : 4;
      for (std::size_t i = 0; i < other.time_s.size(); ++i) {
        if (!std::isfinite(other.remaining[i]) || other.placeOf(i).c_deg != c_deg) continue;
        line.x.push_back(other.time_s[i] / unit.seconds);
        line.y.push_back(other.remaining[i]);
      }
      series.push_back(std::move(line));
    }
    std::stable_partition(series.begin(), series.end(),
                          [this](const Series& line) { return line.name.toStdString() != point_; });
    legend_->setText(legendText({{3, QString::fromStdString(point_)}, {4, tr("the others")}}));
    plot_->setContent(std::move(series));
    return;
  }
  plot_card_->setTitle(withShownAngle(
      tr("%1 of %2 over time").arg(componentName(component_), QString::fromStdString(point_)), *s, c_deg));
  Series measured;
  measured.name = tr("measured − simulated");
  measured.style = SeriesStyle::Points;
  measured.colour = 1;
  Series noise;
  noise.name = tr("noise, ± 2 σ");
  noise.style = SeriesStyle::Line;
  noise.colour = 2;
  for (const double time_s : {s->time_s.front(), s->time_s.back()}) {
    noise.x.push_back(time_s / unit.seconds);
    noise.y.push_back(0.0);
    noise.sigma.push_back(s->noise);
  }
  Series effects;
  effects.name = tr("effects");
  effects.style = SeriesStyle::Line;
  effects.colour = 0;
  Series remaining;
  remaining.name = tr("remainder");
  remaining.style = SeriesStyle::Line;
  remaining.colour = 3;
  for (std::size_t i = 0; i < s->time_s.size(); ++i) {
    if (s->placeOf(i).c_deg != c_deg) continue;
    const double t = s->time_s[i] / unit.seconds;
    measured.x.push_back(t);
    measured.y.push_back(s->value[i] - s->simulated[i] - s->constant_before);
    if (!s->explained.empty()) {
      effects.x.push_back(t);
      effects.y.push_back(s->explained[i]);
    }
    if (!s->remaining.empty() && std::isfinite(s->remaining[i])) {
      remaining.x.push_back(t);
      remaining.y.push_back(s->remaining[i]);
    }
  }
  std::vector<std::pair<int, QString>> names{{1, measured.name}};
  for (Series* line : {&noise, &effects, &remaining}) {
    if (line->x.empty()) continue;
    names.emplace_back(line->colour, line->name);
    series.push_back(*line);
  }
  series.push_back(std::move(measured));
  legend_->setText(legendText(names));
  plot_->setContent(std::move(series));
}

std::vector<Exportable> RemainderPanel::exportables() {
  std::vector<Exportable> items;
  if (story_ == nullptr) return items;
  items.push_back(exportableOf(tr("Remainder"), components_));
  items.push_back(exportableOf(tr("Remainder at the points %1").arg(componentName(component_)), points_));
  if (!plot_->empty()) {
    items.push_back(
        exportableOf(tr("Remainder %1 %2").arg(componentName(component_), QString::fromStdString(point_)), plot_));
  }
  return items;
}

}  // namespace spindrift::gui
