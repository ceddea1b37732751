// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/gap_panel.h"

#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/machine/driver_words.h"
#include "core/workflows/discrepancy_sizes.h"
#include "core/workflows/residual_map.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/page_room.h"
#include "widgets/common/parts.h"
#include "widgets/common/table_angle.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/gap_bars.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

/// From this height on plots and views fit below one another.
constexpr int height_for_both = 500;
constexpr std::size_t most_single_dots = 300;
constexpr int side_width = 280;

/// As narrow as its controls allow in the language of the window.
class SideCard : public Card {
 public:
  explicit SideCard(const QString& title) : Card(title) { setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred); }
  [[nodiscard]] QSize sizeHint() const override {
    return {std::max(side_width, minimumSizeHint().width()), Card::sizeHint().height()};
  }
};

}  // namespace

GapPanel::GapPanel(QWidget* parent) : QWidget(parent) {
  auto* line = new QHBoxLayout(this);
  line->setContentsMargins(0, 8, 0, 0);
  line->setSpacing(12);
  auto* left = new SideCard(tr("How large the gap is"));
  figures_ = left;
  bars_ = new GapBars;
  left->body()->addWidget(bars_);
  model_ = new WrappedLabel;
  model_->setProperty("role", QStringLiteral("secondaryText"));
  left->body()->addWidget(model_);
  left->body()->addStretch(1);
  left->body()->addWidget(makeLine(Qt::Horizontal));
  auto* choice = new QHBoxLayout;
  component_ = new QComboBox;
  component_->setAccessibleName(tr("Component shown"));
  point_ = new QComboBox;
  point_->setAccessibleName(tr("Point shown over time"));
  choice->addWidget(component_, 1);
  choice->addWidget(point_, 1);
  left->body()->addLayout(choice);
  what_ = new Segments({tr("Over time"), tr("On the machine")}, tr("What is compared"));
  left->body()->addWidget(what_);
  sides_ = new Segments({tr("Before"), tr("After")}, tr("Which side is shown"));
  left->body()->addWidget(sides_);
  story_text_ = makeLabel({}, "secondaryText");
  story_text_->setWordWrap(true);
  left->body()->addWidget(story_text_);
  moment_text_ = makeLabel({}, "secondaryText");
  left->body()->addWidget(moment_text_);
  moment_ = new QSlider(Qt::Horizontal);
  moment_->setAccessibleName(tr("Moment shown on the machine"));
  moment_->setToolTip(tr("Moment shown on the machine; the arrow keys go from one state to the next"));
  left->body()->addWidget(moment_);
  line->addWidget(left);

  grid_ = new QGridLayout;
  auto* grid = grid_;
  grid->setSpacing(12);
  for (int after = 0; after < 2; ++after) {
    const auto i = static_cast<std::size_t>(after);
    plot_cards_[i] = new Card(after != 0 ? tr("After, over time") : tr("Before, over time"));
    plots_[i] = new Plot;
    plots_[i]->setLegendVisible(false);
    legends_[i] = makeLabel({}, "secondaryText");
    plot_cards_[i]->body()->addWidget(legends_[i]);
    plot_cards_[i]->body()->addWidget(plots_[i], 1);
    view_cards_[i] = new Card(after != 0 ? tr("After, on the machine") : tr("Before, on the machine"));
    views_[i] = new View3D;
    views_[i]->setMachineVisible(false);
    views_[i]->setToolSideVisible(false);
    view_cards_[i]->body()->addWidget(views_[i], 1);
    grid->addWidget(plot_cards_[i], 0, after);
    grid->addWidget(view_cards_[i], 1, after);
    grid->setColumnStretch(after, 1);
    connect(plots_[i], &Plot::hovered, this, &GapPanel::hovered);
    connect(views_[i], &View3D::hovered, this, &GapPanel::hovered);
    connect(views_[i], &View3D::pointPicked, this, [this](const QString& id) {
      point_->setCurrentText(id);
      userChose();
    });
    plots_[i]->setToolTip(tr("Click a value: the machine is shown at its time"));
    connect(plots_[i], &Plot::picked, this, [this](double x, int, int) { chooseTime(x / plot_second_); });
  }
  plots_[0]->setEmptyText(tr("Measured and simulated"), tr("Search to compare them over time."));
  plots_[1]->setEmptyText(tr("Nothing has been added yet"),
                          tr("Press Add to the model: the fit with the effect appears here."));
  views_[0]->setEmptyText(tr("Measured minus simulated"), tr("Search to see it on the machine."));
  views_[1]->setEmptyText(tr("Nothing has been added yet"),
                          tr("Press Add to the model: what remains at each point appears here."));
  views_[0]->link(views_[1]);
  line->addLayout(grid, 1);
  connect(moment_, &QSlider::valueChanged, this, [this](int index) {
    if (moments_[static_cast<std::size_t>(index)].c_deg != plotted_c_deg_) showPlots();
    showViews();
    markMoment();
    Q_EMIT timeChosen(moments_[static_cast<std::size_t>(index)].time_s);
  });
  connect(component_, &QComboBox::activated, this, [this](int) {
    fillMoments();
    userChose();
  });
  connect(point_, &QComboBox::activated, this, [this](int) { userChose(); });
  for (Segments* choice_of : {what_, sides_}) connect(choice_of, &Segments::chosen, this, [this](int) { arrange(); });
  arrange();
}

void GapPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (views_stale_) showViews();
}

void GapPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

void GapPanel::arrange() {
  const bool both = roomOnPage(*this) >= height_for_both;
  what_->setVisible(!both);
  story_text_->setVisible(both);
  grid_->setRowStretch(0, both || what_->current() == 0 ? 1 : 0);
  grid_->setRowStretch(1, both || what_->current() == 1 ? 1 : 0);
  const bool both_sides = width() >= widthOf(2);
  sides_->setVisible(!both_sides);
  for (int i = 0; i < 2; ++i) {
    const bool side = both_sides || sides_->current() == i;
    const auto at = static_cast<std::size_t>(i);
    plot_cards_[at]->setVisible(side && (both || what_->current() == 0));
    view_cards_[at]->setVisible(side && (both || what_->current() == 1));
    grid_->setColumnStretch(i, side ? 1 : 0);
  }
}

int GapPanel::widthOf(int sides) const {
  std::array<int, 2> least{};
  for (std::size_t i = 0; i < 2; ++i)
    least[i] = std::max(plot_cards_[i]->minimumSizeHint().width(), view_cards_[i]->minimumSizeHint().width());
  const int beside = figures_->sizeHint().width() + layout()->spacing();
  return beside + (sides == 2 ? least[0] + grid_->spacing() + least[1] : std::max(least[0], least[1]));
}

QSize GapPanel::minimumSizeHint() const {
  return {widthOf(1), QWidget::minimumSizeHint().height()};
}

void GapPanel::fillChoices() {
  const QString component = component_->currentText();
  const QString point = point_->currentText();
  component_->clear();
  point_->clear();
  for (const DiscrepancySeries& s : discrepancy_->series) {
    const QString id = QString::fromStdString(s.point);
    if (point_->findText(id) < 0) point_->addItem(id);
    const QString name = componentName(s.component);
    if (component_->findText(name) < 0) component_->addItem(name, static_cast<int>(s.component));
  }
  component_->setCurrentIndex(std::max(0, component_->findText(component)));
  point_->setCurrentIndex(std::max(0, point_->findText(point)));
  fillMoments();
}

void GapPanel::fillMoments() {
  const auto component = static_cast<Component>(component_->currentData().toInt());
  moments_ = momentsOf(*discrepancy_, component);
  const QSignalBlocker quiet(moment_);
  moment_->setVisible(moments_.size() > 1);
  moment_->setRange(0, static_cast<int>(moments_.empty() ? 0 : moments_.size() - 1));
  const auto worst = static_cast<int>(worstMoment(*discrepancy_, component));
  moment_->setValue(worst);
  largest_ = 0.0;
  if (moments_.empty()) return;
  for (const Field::Marker& point : residualsAt(*discrepancy_, component, shownMoment(), false)) {
    largest_ = std::max(largest_, std::abs(point.value));
  }
}

void GapPanel::userChose() {
  showPlots();
  showViews();
  Q_EMIT chosen();
}

void GapPanel::chooseTime(double time_s) {
  if (moments_.empty()) return;
  // Of readings at one time those at the angle that is shown.
  const auto away = [&](const ResidualMoment& m) {
    return std::pair(std::abs(m.time_s - time_s), m.c_deg != plotted_c_deg_);
  };
  const auto nearest = std::min_element(moments_.begin(), moments_.end(),
                                        [&](const auto& a, const auto& b) { return away(a) < away(b); });
  moment_->setValue(static_cast<int>(nearest - moments_.begin()));
}

void GapPanel::markMoment() {
  for (Plot* plot : plots_) {
    plot->setMoment(moments_.empty() ? std::nullopt : std::optional(shownMoment().time_s * plot_second_));
  }
}

std::string GapPanel::point() const {
  return point_->currentText().toStdString();
}

Component GapPanel::component() const {
  return static_cast<Component>(component_->currentData().toInt());
}

const DiscrepancySeries* GapPanel::series() const {
  if (discrepancy_ == nullptr || component_->count() == 0) return nullptr;
  return discrepancy_->find(point_->currentText().toStdString(),
                            static_cast<Component>(component_->currentData().toInt()));
}

void GapPanel::show(const std::shared_ptr<const DiscrepancyStory>& story, const MachineDescription* machine) {
  discrepancy_ = story;
  machine_ = machine != nullptr ? std::optional<MachineDescription>(*machine) : std::nullopt;
  if (discrepancy_ == nullptr || machine == nullptr) {
    bars_->clear();
    model_->clear();
    story_text_->clear();
    component_->clear();
    point_->clear();
    for (Plot* plot : plots_) plot->setContent({});
    for (View3D* view : views_) view->clear();
    moment_->hide();
    moment_text_->clear();
    return;
  }
  movements_.ask([this, story]() -> std::function<void()> {
    return [this, story, figures = story->movements()] {
      if (story == discrepancy_) bars_->set(story->gap, story->has_holdout, figures[0], figures[1]);
    };
  });
  if (discrepancy_->added.empty()) {
    model_->setText(discrepancy_->proposed
                        ? tr("Nothing has been added yet. With what is proposed the rms would fall to %1.")
                              .arg(onScreen(sizeText(discrepancy_->proposed->rms_after_um, QStringLiteral("um"))))
                        : tr("Nothing has been added to the simulation."));
  } else {
    model_->setText(tr("After: simulation plus %1, fitted jointly.").arg(effectTitles(discrepancy_->added, tr("and"))));
  }
  fillChoices();
  const QString how = discrepancy_->nextProposal() != nullptr
                          ? tr("Press Add to the model: what then remains appears here.")
                          : tr("The search proposes no effect to add.");
  plots_[1]->setEmptyText(tr("Nothing has been added yet"), how);
  views_[1]->setEmptyText(tr("Nothing has been added yet"), how);
  for (std::size_t i = 0; i < 2; ++i) {
    if (i == 1 && discrepancy_->added.empty()) {
      views_[i]->clear();
    } else {
      views_[i]->setMachine(*machine);
    }
  }
  showPlots();
  showViews();
}

void GapPanel::choose(const std::string& point, Component component) {
  if (discrepancy_ == nullptr) return;
  const int p = point_->findText(QString::fromStdString(point));
  const int c = component_->findText(componentName(component));
  if (p < 0 || c < 0) return;
  const bool other = component_->currentIndex() != c;
  point_->setCurrentIndex(p);
  component_->setCurrentIndex(c);
  if (other) fillMoments();
  showPlots();
  showViews();
}

QString GapPanel::withAngle(const QString& what, double c_deg) const {
  const bool one = std::all_of(moments_.begin(), moments_.end(),
                               [this](const ResidualMoment& m) { return m.c_deg == moments_.front().c_deg; });
  return one ? what : withTableAngle(what, c_deg);
}

/// What was taken as noise in the component that is shown.
void GapPanel::showNoise() {
  QString noise = tr("Points: measured. Line: model with the free constant of the series, ± 2 σ of the noise.");
  const Component c = component();
  const auto found = std::find_if(discrepancy_->noise.begin(), discrepancy_->noise.end(),
                                  [c](const NoiseEstimate& n) { return n.component == c; });
  if (found != discrepancy_->noise.end()) {
    noise += QLatin1Char(' ') + tr("Noise scale of %1: %2 times the stated σ")
                                    .arg(componentName(c), withError(found->scale, found->scale_uncertainty, {}));
    if (found->common_um > 0.0) noise += tr(", common shift %1").arg(sizeText(found->common_um, componentUnit(c)));
    if (found->correlated_part > 0.05) {
      noise += tr(", %1 % of it correlated over %2")
                   .arg(decimalText(100 * found->correlated_part, 'f', 0))
                   .arg(coreSentence(spanOfTime(found->correlation_time_s)));
    }
    noise += QLatin1Char('.');
  }
  story_text_->setText(noise);
}

void GapPanel::showPlots() {
  const DiscrepancySeries* s = series();
  if (s == nullptr || s->time_s.empty()) {
    for (Plot* plot : plots_) plot->setContent({});
    return;
  }
  showNoise();
  // What was measured with the table at another angle stood elsewhere and belongs to no line through these.
  plotted_c_deg_ = !moments_.empty() && measuredAt(*s, shownMoment().c_deg) ? shownMoment().c_deg : s->placeOf(0).c_deg;
  std::array<double, 2> squares{};
  double fitted = 0.0;
  const TimeUnit unit = timeUnit(s->time_s.back());
  plot_second_ = 1.0 / unit.seconds;
  const QString y_title = QStringLiteral("%1 / %2").arg(componentName(s->component), componentUnit(s->component));
  double low = 0.0;
  double high = 0.0;
  std::array<std::vector<Series>, 2> content;
  std::vector<Span> spans;
  double held_from = std::nan("");
  double held_to = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::vector<double>& model = side == 0 ? s->simulated : s->completed;
    if (model.empty()) continue;
    // Measured values as they are; the line takes what the fit makes of the free constant.
    const double constant = side == 0 ? s->constant_before : s->constant_after;
    Series measured;
    measured.name = tr("measured");
    measured.style = SeriesStyle::Points;
    measured.colour = 1;
    Series line;
    line.name = side == 0 ? tr("simulated") : tr("simulated + added");
    line.style = SeriesStyle::Line;
    line.colour = 0;
    for (std::size_t i = 0; i < s->time_s.size(); ++i) {
      if (s->placeOf(i).c_deg != plotted_c_deg_) continue;
      const double t = s->time_s[i] / unit.seconds;
      measured.x.push_back(t);
      measured.y.push_back(s->value[i]);
      line.x.push_back(t);
      line.y.push_back(model[i] + constant);
      line.sigma.push_back(s->noise);
      if (!s->held_out[i]) {
        squares[side] += std::pow(s->value[i] - model[i] - constant, 2);
        fitted += side == 0 ? 1.0 : 0.0;
      }
      low = std::min({low, measured.y.back(), line.y.back() - 2 * s->noise});
      high = std::max({high, measured.y.back(), line.y.back() + 2 * s->noise});
      if (side == 0 && s->held_out[i]) {
        if (std::isnan(held_from)) held_from = t;
        held_to = t;
      }
    }
    // Where dots run together the line would vanish below them.
    if (measured.x.size() <= most_single_dots) {
      content[side] = {line, measured};
    } else {
      content[side] = {measured, line};
    }
  }
  const QString error = tr("± 2 σ of a reading");
  legends_[0]->setText(legendText({{1, tr("measured")}, {0, tr("simulated, %1").arg(error)}}));
  legends_[1]->setText(legendText({{1, tr("measured")}, {0, tr("simulated + added, %1").arg(error)}}));
  for (std::size_t side = 0; side < 2; ++side) legends_[side]->setVisible(!content[side].empty());
  if (!std::isnan(held_from)) spans.push_back({held_from, held_to, tr("held out"), Tone::Accent});
  for (std::size_t side = 0; side < 2; ++side) {
    plots_[side]->setAxes(tr("Time / %1").arg(unit.name), y_title);
    plots_[side]->setRange(std::make_pair(low, high));
    plots_[side]->setContent(content[side], content[side].empty() ? std::vector<Span>() : spans);
    const QString point = withAngle(QString::fromStdString(s->point), plotted_c_deg_);
    const double rms = std::sqrt(squares[side] / fitted);
    plot_cards_[side]->setTitle(
        side == 0 ? tr("Before: %1 of %2, rms %3")
                        .arg(componentName(s->component), point, sizeText(rms, componentUnit(s->component)))
        : content[1].empty()
            ? tr("After")
            : tr("After: %1 of %2, rms %3")
                  .arg(componentName(s->component), point, sizeText(rms, componentUnit(s->component))));
  }
  markMoment();
}

void GapPanel::showViews() {
  views_stale_ = true;
  if (!isVisible() || discrepancy_ == nullptr || component_->count() == 0 || moments_.empty() || !machine_) return;
  views_stale_ = false;
  const auto component = static_cast<Component>(component_->currentData().toInt());
  const QString unit = componentUnit(component);
  const ResidualMoment moment = shownMoment();
  const TimeUnit time = timeUnit(moments_.back().time_s);
  const QString when =
      withAngle(tr("%1 %2").arg(decimalText(moment.time_s / time.seconds, 'f', 2)).arg(time.name), moment.c_deg);
  moment_text_->setText(tr("On the machine at %1").arg(when));
  // One scale for both sides and all moments: that of the worst moment before.
  const ColourScale scale = ColourScale::symmetric(largest_, componentName(component), unit);
  for (View3D* view : views_) {
    view->setColourScale(scale);
    view->setSelected(point_->currentText());
    view->setCaption(tr("%1, measured − model at %2").arg(componentName(component), when));
  }
  maps_.ask([this, story = discrepancy_, machine = *machine_, component, moment]() -> std::function<void()> {
    std::array<ResidualMap, 2> maps{residualMap(*story, machine, component, moment, false), {}};
    if (!story->added.empty()) maps[1] = residualMap(*story, machine, component, moment, true);
    return [this, story, component, maps = std::move(maps)] {
      if (story != discrepancy_) return;
      for (std::size_t side = 0; side < maps.size(); ++side) showSide(side, component, maps[side]);
    };
  });
}

void GapPanel::showSide(std::size_t side, Component component, const ResidualMap& map) {
  if (side == 1 && discrepancy_->added.empty()) return;
  std::vector<ViewPoint> points;
  for (const Field::Marker& marker : map.points) {
    ViewPoint p;
    p.id = p.label = QString::fromStdString(marker.point);
    p.position_mm = marker.position_mm;
    p.value = marker.value;
    if (p.id == point_->currentText()) {
      p.value_text = tr("%1 ± %2 %3")
                         .arg(decimalText(marker.value, 'f', 1))
                         .arg(decimalText(marker.sigma, 'f', 1))
                         .arg(componentUnit(component));
    }
    points.push_back(std::move(p));
  }
  views_[side]->setPoints(std::move(points));
  views_[side]->setSelected(point_->currentText());
  views_[side]->setField(map.field, FieldStyle{});
}

std::vector<Exportable> GapPanel::exportables() {
  std::vector<Exportable> items;
  if (discrepancy_ == nullptr) return items;
  items.push_back({tr("Gap rms"), {QStringLiteral("png"), QStringLiteral("svg")}, [this](const QString& file) {
                     bars_->exportTo(file);
                   }});
  const QString name = component_->currentText() + QLatin1Char(' ') + point_->currentText();
  if (!plots_[0]->empty()) items.push_back(exportableOf(tr("Before %1").arg(name), plots_[0]));
  if (!plots_[1]->empty()) items.push_back(exportableOf(tr("After %1").arg(name), plots_[1]));
  items.push_back(exportableOf(tr("Before on the machine %1").arg(component_->currentText()), views_[0]));
  if (!discrepancy_->added.empty()) {
    items.push_back(exportableOf(tr("After on the machine %1").arg(component_->currentText()), views_[1]));
  }
  return items;
}

}  // namespace spindrift::gui
