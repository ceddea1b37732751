// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/where_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/workflows/discrepancy_sizes.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/page_room.h"
#include "widgets/common/parts.h"
#include "widgets/common/table_angle.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/shown_angle.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

/// From this height on view and plot fit below one another.
constexpr int height_for_both = 460;

}  // namespace

WherePanel::WherePanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* left = new Card(tr("Places, the clearest first"));
  places_ = new RowsModel({tr("What"), tr("Points"), tr("Condition"), tr("Excess"), tr("p")}, this);
  place_table_ = makeTable(places_, tr("Places where measured and simulated disagree"),
                           tr("Places where the residual exceeds the noise appear after the search."));
  stretchColumn(place_table_, 1);
  left->body()->addWidget(place_table_, 4);
  auto* points_line = new QHBoxLayout;
  points_title_ = new WrappedLabel;
  points_title_->setProperty("role", QStringLiteral("sectionTitle"));
  points_line->addWidget(points_title_, 1);
  segment_place_ = new QVBoxLayout;
  points_line->addLayout(segment_place_);
  left->body()->addLayout(points_line);
  points_ = new RowsModel({tr("Point"), tr("Before"), tr("After"), tr("Noise"), tr("Excess")}, this);
  point_table_ =
      makeTable(points_, tr("Points with what lies beyond the noise"), tr("Points appear after the search."));
  stretchColumn(point_table_, 0);
  left->body()->addWidget(point_table_, 5);

  auto* right = new QWidget;
  auto* right_column = new QVBoxLayout(right);
  right_column->setContentsMargins(0, 0, 0, 0);
  which_ = new Segments({tr("Over time"), tr("On the machine")}, tr("What is shown"));
  angle_ = new TableAngleChoice;
  auto* shown_line = new WrapLayout;
  shown_line->addWidget(which_);
  shown_line->addWidget(angle_);
  right_column->addLayout(shown_line);
  view_card_ = new Card(tr("On the machine"));
  auto* view_card = view_card_;
  machine_box_ = new QCheckBox(tr("Machine"));
  view_card->addToTitle(machine_box_);
  view_ = new View3D;
  view_->setMachineVisible(false);
  view_->setToolSideVisible(false);
  view_->setEmptyText(tr("The points will appear here"),
                      tr("Search: each point is coloured by what lies beyond the noise."));
  view_card->body()->addWidget(view_, 1);
  plot_card_ = new Card;
  auto* plot_card = plot_card_;
  plot_title_ = makeLabel({}, "sectionTitle");
  auto* plot_line = new WrapLayout(16);
  plot_line->addWidget(plot_title_);
  legend_ = makeLabel({}, "secondaryText");
  plot_line->addWidget(legend_);
  plot_card->body()->addLayout(plot_line);
  plot_ = new Plot;
  plot_->setLegendVisible(false);
  plot_->setEmptyText(tr("The residual over time will appear here"),
                      tr("Search, then choose a place in the table or a point on the machine."));
  plot_card->body()->addWidget(plot_, 1);
  right_column->addWidget(makeSplitter(right, view_card, plot_card, 6, 5, Qt::Vertical), 1);
  column->addWidget(makeSplitter(this, left, right, 6, 7), 1);

  connect(place_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) {
            if (!following_) choosePlace(now.row());
          });
  connect(point_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) {
            if (!following_ && now.isValid()) choosePoint(points_->idAt(now.row()).toStdString());
          });
  plot_->setToolTip(tr("Click a value: its place is chosen, and the machine is shown at its time"));
  connect(plot_, &Plot::picked, this, [this](double x, int, int) { chooseTime(x / plot_second_); });
  connect(view_, &View3D::pointPicked, this, [this](const QString& id) { choosePoint(id.toStdString()); });
  connect(machine_box_, &QCheckBox::toggled, this, [this](bool on) {
    view_->setMachineVisible(on);
    view_->setToolSideVisible(on);
    view_->resetCamera(StandardView::Isometric);
  });
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] {
    if (story_ != nullptr) showPlot();
  });
  connect(which_, &Segments::chosen, this, [this](int) { arrange(); });
  connect(angle_, &QComboBox::activated, this, [this](int) {
    showAngle();
    Q_EMIT chosen();
  });
  connect(view_, &View3D::hovered, this, &WherePanel::hovered);
  connect(plot_, &Plot::hovered, this, &WherePanel::hovered);
}

void WherePanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

void WherePanel::arrange() {
  const bool both = roomOnPage(*this) >= height_for_both;
  which_->setVisible(!both);
  plot_card_->setVisible(both || which_->current() == 0);
  view_card_->setVisible(both || which_->current() == 1);
}

void WherePanel::show(const std::shared_ptr<const DiscrepancyStory>& story, const MachineDescription* machine) {
  story_ = story;
  components_.clear();
  if (story_ == nullptr || machine == nullptr) {
    places_->setRows({});
    points_->setRows({});
    points_title_->setText(tr("Points"));
    view_->clear();
    plot_->setContent({});
    plot_title_->clear();
    legend_->clear();
    angle_->setAngles({});
    place_ = -1;
    fillSegments();
    return;
  }
  for (const Component c : all_components) {
    if (std::any_of(story_->series.begin(), story_->series.end(),
                    [c](const DiscrepancySeries& s) { return s.component == c; })) {
      components_.push_back(c);
    }
  }
  view_->setMachine(*machine);
  const bool keeps = story_->find(point_, component_) != nullptr;
  fillPlaces();
  if (keeps) {
    // The noise found, and with it the places, may be others than before.
    const auto holds = std::find_if(story_->where.begin(), story_->where.end(), [this](const DisagreementPlace& p) {
      return p.component == component_ && std::find(p.points.begin(), p.points.end(), point_) != p.points.end();
    });
    if (holds != story_->where.end()) {
      place_ = static_cast<int>(holds - story_->where.begin());
      following_ = true;
      place_table_->selectRow(place_);
      following_ = false;
    }
  }
  if (!keeps && !components_.empty()) {
    component_ = story_->where.empty() ? components_.front() : story_->where.front().component;
    point_.clear();
  }
  fillSegments();
  if (!keeps && !story_->where.empty()) {
    choosePlace(0);
  } else {
    chooseComponent(component_);
  }
}

void WherePanel::fillPlaces() {
  following_ = true;
  std::vector<Row> rows;
  std::vector<std::string> all;
  double last = 0.0;
  for (const DiscrepancySeries& s : story_->series) {
    if (std::find(all.begin(), all.end(), s.point) == all.end()) all.push_back(s.point);
    if (!s.time_s.empty()) last = std::max(last, s.time_s.back());
  }
  int index = 0;
  for (const DisagreementPlace& place : story_->where) {
    Row row;
    row.id = QString::number(index++);
    Cell what{componentName(place.component)};
    what.bold = true;
    QStringList names;
    for (const std::string& p : place.points) names << QString::fromStdString(p);
    Cell points{pointsText(place.points, all.size())};
    points.tip = names.join(QStringLiteral(", "));
    row.cells = {what,
                 points,
                 {place.condition.empty() ? spanText(place.from_s, place.to_s, last) : coreSentence(place.condition)},
                 rightCell(sizeText(place.excess_um, componentUnit(place.component))),
                 rightCell(probabilityText(place.p_value))};
    row.cells[3].tip = tr("rms beyond what the noise explains");
    row.cells[4].tip = tr("Probability of this by chance, for all places looked at together");
    rows.push_back(std::move(row));
  }
  place_table_->setProperty("emptyText", tr("At no place does the residual exceed the noise."));
  places_->setRows(std::move(rows));
  place_ = -1;
  following_ = false;
}

void WherePanel::fillSegments() {
  delete segments_;
  segments_ = nullptr;
  if (components_.size() < 2) return;
  QStringList names;
  for (const Component c : components_) names << componentName(c);
  segments_ = new Segments(names, tr("Component"));
  segment_place_->addWidget(segments_);
  connect(segments_, &Segments::chosen, this, [this](int index) {
    place_ = -1;
    following_ = true;
    place_table_->clearSelection();
    following_ = false;
    chooseComponent(components_[static_cast<std::size_t>(index)]);
    Q_EMIT chosen();
  });
}

void WherePanel::fillPoints() {
  following_ = true;
  const QString unit = componentUnit(component_);
  points_title_->setText(withAngle(shownTitle(tr("Points, rms over time / %1").arg(unit))));
  std::vector<Row> rows;
  for (const DiscrepancySeries& s : story_->series) {
    if (s.component != component_ || !measuredAt(s, c_deg())) continue;
    const SeriesSizes sizes = sizesAt(s, c_deg());
    Row row;
    row.id = QString::fromStdString(s.point);
    Cell name{row.id};
    name.bold = true;
    Cell beyond = rightCell(sizeText(sizes.excess, {}));
    if (s.significant) {
      beyond.tone = Tone::Attention;
      beyond.icon = "alert";
      beyond.tip = tr("More than the noise allows: at one of the places above, or over all of the time");
    } else {
      beyond.tip = tr("No more than noise may add up to at a point among so many");
    }
    row.cells = {name, rightCell(sizeText(sizes.before, {})), rightCell(sizeText(sizes.after, {})),
                 rightCell(sizeText(s.noise, {})), beyond};
    for (std::size_t i = 1; i < row.cells.size(); ++i) row.cells[i].unit = unit;
    rows.push_back(std::move(row));
  }
  points_->setRows(std::move(rows));
  const int row = points_->rowOf(QString::fromStdString(point_));
  if (row >= 0) point_table_->selectRow(row);
  following_ = false;
}

void WherePanel::choosePlace(int row) {
  if (story_ == nullptr || row < 0 || row >= static_cast<int>(story_->where.size())) return;
  const DisagreementPlace& place = story_->where[static_cast<std::size_t>(row)];
  place_ = row;
  following_ = true;
  place_table_->selectRow(row);
  following_ = false;
  // The point that shows it best.
  const DiscrepancySeries* clearest = nullptr;
  for (const std::string& point : place.points) {
    const DiscrepancySeries* s = story_->find(point, place.component);
    if (s != nullptr && (clearest == nullptr || s->excess_before > clearest->excess_before)) clearest = s;
  }
  // The time at which it shows most, and the angle of the table then.
  std::optional<std::size_t> most;
  const auto residual = [clearest](std::size_t i) {
    return std::abs(clearest->value[i] - clearest->simulated[i] - clearest->constant_before);
  };
  for (std::size_t i = 0; clearest != nullptr && i < clearest->time_s.size(); ++i) {
    if (clearest->time_s[i] < place.from_s || clearest->time_s[i] > place.to_s) continue;
    if (!most || residual(i) > residual(*most)) most = i;
  }
  if (clearest != nullptr) point_ = clearest->point;
  angle_->setAngles(anglesOf(*story_, place.component));
  if (most) angle_->choose(clearest->placeOf(*most).c_deg);
  chooseComponent(place.component);
  Q_EMIT chosen();
  if (most) Q_EMIT timeChosen(clearest->time_s[*most]);
}

double WherePanel::c_deg() const {
  return angle_->chosen().value_or(0.0);
}

QString WherePanel::withAngle(const QString& what) const {
  return angle_->several() ? withTableAngle(what, c_deg()) : what;
}

void WherePanel::chooseMeasuredAngle() {
  const DiscrepancySeries* s = story_->find(point_, component_);
  if (s == nullptr || measuredAt(*s, c_deg())) return;
  angle_->choose(clearestAngle(*s));
}

void WherePanel::showAngle() {
  const DiscrepancySeries* now = story_->find(point_, component_);
  if (now == nullptr || !measuredAt(*now, c_deg())) {
    const auto there = std::find_if(story_->series.begin(), story_->series.end(), [this](const DiscrepancySeries& s) {
      return s.component == component_ && measuredAt(s, c_deg());
    });
    if (there != story_->series.end()) point_ = there->point;
  }
  fillPoints();
  showView();
  showPlot();
}

void WherePanel::chooseTime(double time_s) {
  for (int i = 0; i < static_cast<int>(story_->where.size()); ++i) {
    const DisagreementPlace& p = story_->where[static_cast<std::size_t>(i)];
    const bool holds = p.component == component_ && time_s >= p.from_s && time_s <= p.to_s &&
                       std::find(p.points.begin(), p.points.end(), point_) != p.points.end();
    if (!holds || i == place_) continue;
    // A place that holds it and is chosen already stays.
    if (place_ >= 0) {
      const DisagreementPlace& now = story_->where[static_cast<std::size_t>(place_)];
      if (time_s >= now.from_s && time_s <= now.to_s) break;
    }
    place_ = i;
    following_ = true;
    place_table_->selectRow(i);
    following_ = false;
    showPlot();
    break;
  }
  Q_EMIT timeChosen(time_s);
}

void WherePanel::markTime(double time_s) {
  plot_->setMoment(time_s * plot_second_);
}

void WherePanel::choose(const std::string& point, Component component) {
  if (story_ == nullptr || story_->find(point, component) == nullptr) return;
  point_ = point;
  if (component != component_) chooseComponent(component);
  selectPoint(point);
}

void WherePanel::chooseComponent(Component component) {
  component_ = component;
  const auto at = std::find(components_.begin(), components_.end(), component);
  if (segments_ != nullptr && at != components_.end()) {
    segments_->setCurrent(static_cast<int>(at - components_.begin()));
  }
  if (story_->find(point_, component_) == nullptr) {
    const auto first = std::find_if(story_->series.begin(), story_->series.end(),
                                    [&](const DiscrepancySeries& s) { return s.component == component_; });
    point_ = first == story_->series.end() ? std::string() : first->point;
  }
  angle_->setAngles(anglesOf(*story_, component_));
  chooseMeasuredAngle();
  fillPoints();
  showView();
  showPlot();
}

void WherePanel::choosePoint(const std::string& point) {
  if (story_ == nullptr || story_->find(point, component_) == nullptr) return;
  selectPoint(point);
  Q_EMIT chosen();
}

void WherePanel::selectPoint(const std::string& point) {
  point_ = point;
  // The place it belongs to, unless the one that is chosen holds it already.
  const auto holds = [&](int index) {
    if (index < 0) return false;
    const DisagreementPlace& p = story_->where[static_cast<std::size_t>(index)];
    return p.component == component_ && std::find(p.points.begin(), p.points.end(), point) != p.points.end();
  };
  if (!holds(place_)) {
    place_ = -1;
    for (int i = 0; i < static_cast<int>(story_->where.size()) && place_ < 0; ++i) {
      if (holds(i)) place_ = i;
    }
  }
  const double before_deg = c_deg();
  chooseMeasuredAngle();
  if (c_deg() != before_deg) fillPoints();
  following_ = true;
  if (place_ >= 0) {
    place_table_->selectRow(place_);
  } else {
    place_table_->clearSelection();
  }
  const int row = points_->rowOf(QString::fromStdString(point));
  if (row >= 0) point_table_->selectRow(row);
  following_ = false;
  showView();
  showPlot();
}

void WherePanel::showView() {
  // One scale for all angles of the table.
  double largest = 0.0;
  for (const DiscrepancySeries& s : story_->series) {
    if (isRotation(s.component) != isRotation(component_)) continue;
    // Not below the noise: what lies within it keeps dark colours.
    largest = std::max({largest, s.excess_before, s.noise});
    for (const TablePlace& place : s.places) {
      if (const double excess = sizesAt(s, place.c_deg).excess; excess > largest) largest = excess;
    }
  }
  const QString unit = componentUnit(component_);
  std::vector<ViewPoint> points;
  for (const DiscrepancySeries& s : story_->series) {
    if (s.component != component_ || !measuredAt(s, c_deg())) continue;
    const SeriesSizes sizes = sizesAt(s, c_deg());
    ViewPoint p;
    p.id = p.label = QString::fromStdString(s.point);
    p.position_mm = sizes.position_mm;
    p.value = sizes.excess;
    if (s.point == point_) p.value_text = sizeText(sizes.excess, unit);
    p.used = s.significant && sizes.excess > 0.0;
    points.push_back(std::move(p));
  }
  view_->setColourScale(ColourScale::magnitude(largest, componentName(component_), unit));
  view_->setPoints(std::move(points));
  view_->setSelected(QString::fromStdString(point_));
  view_->setCaption(withAngle(
      tr("%1 beyond the noise, rms over time; dotted: the noise explains it").arg(componentName(component_))));
}

void WherePanel::showPlot() {
  const DiscrepancySeries* s = story_->find(point_, component_);
  if (s == nullptr || !measuredAt(*s, c_deg()) || s->time_s.empty()) {
    plot_->setContent({});
    plot_title_->clear();
    legend_->clear();
    return;
  }
  const TimeUnit unit = timeUnit(s->time_s.back());
  plot_second_ = 1.0 / unit.seconds;
  plot_title_->setText(
      withAngle(tr("%1 of point %2 over time").arg(componentName(component_), QString::fromStdString(point_))));
  plot_->setAxes(tr("Time / %1").arg(unit.name),
                 tr("%1 residual / %2").arg(componentName(component_), componentUnit(component_)));
  Series noise;
  noise.name = tr("noise, ± 2 σ");
  noise.style = SeriesStyle::Line;
  noise.colour = 2;
  Series before;
  before.name = story_->added.empty() ? tr("measured − simulated") : tr("before");
  before.style = SeriesStyle::Points;
  before.colour = 1;
  Series after;
  after.name = tr("after adding");
  after.style = SeriesStyle::Points;
  after.colour = 0;
  std::vector<Span> spans;
  double held_from = std::nan("");
  double held_to = 0.0;
  for (std::size_t i = 0; i < s->time_s.size(); ++i) {
    // What was measured with the table at another angle stood elsewhere.
    if (s->placeOf(i).c_deg != c_deg()) continue;
    const double t = s->time_s[i] / unit.seconds;
    before.x.push_back(t);
    before.y.push_back(s->value[i] - s->simulated[i] - s->constant_before);
    if (!s->completed.empty()) {
      after.x.push_back(t);
      after.y.push_back(s->value[i] - s->completed[i] - s->constant_after);
    }
    if (s->held_out[i]) {
      if (std::isnan(held_from)) held_from = t;
      held_to = t;
    } else if (!std::isnan(held_from)) {
      spans.push_back({held_from, held_to, spans.empty() ? tr("held out") : QString(), Tone::Accent});
      held_from = std::nan("");
    }
  }
  if (!std::isnan(held_from)) spans.push_back({held_from, held_to, tr("held out"), Tone::Accent});
  if (place_ >= 0) {
    const DisagreementPlace& place = story_->where[static_cast<std::size_t>(place_)];
    if (place.component == component_) {
      spans.push_back({place.from_s / unit.seconds, place.to_s / unit.seconds, tr("place chosen"), Tone::Attention});
    }
  }
  for (const double t : {before.x.front(), before.x.back()}) {
    noise.x.push_back(t);
    noise.y.push_back(0.0);
    noise.sigma.push_back(s->noise);
  }
  std::vector<std::pair<int, QString>> names{{1, before.name}, {2, noise.name}};
  if (!after.x.empty()) names.insert(names.begin() + 1, {0, after.name});
  legend_->setText(legendText(names));
  std::vector<Series> series{noise, before};
  if (!after.x.empty()) series.push_back(after);
  plot_->setContent(std::move(series), std::move(spans));
}

std::vector<Exportable> WherePanel::exportables() {
  std::vector<Exportable> items;
  if (story_ == nullptr) return items;
  items.push_back(exportableOf(tr("Places"), places_));
  items.push_back(exportableOf(tr("Points %1").arg(componentName(component_)), points_));
  items.push_back(exportableOf(tr("Excess on the machine %1").arg(componentName(component_)), view_));
  if (!plot_->empty()) {
    items.push_back(
        exportableOf(tr("Residual %1 %2").arg(componentName(component_), QString::fromStdString(point_)), plot_));
  }
  return items;
}

}  // namespace spindrift::gui
