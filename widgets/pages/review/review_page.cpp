// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/review/review_page.h"

#include <Eigen/Geometry>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/review/review_pane.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr int playback_ms = 700;
/// Points this near to a section (part of the table) are drawn in it.
constexpr double section_reach = 0.1;

}  // namespace

ReviewPage::ReviewPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Review, parent),
      sources_(
          session(),
          [this](std::int64_t id, const QString& name, CampaignSource source) {
            readOther(id, name, std::move(source));
          },
          [this] { refresh(); }) {
  play_ = makeButton(tr("Play the states"), "play", "primary");
  play_->setCheckable(true);
  addAction(play_);
  auto* options = new WrapLayout;
  count_ = new Segments({tr("Two panes"), tr("Three"), tr("Four")}, tr("Number of panes"));
  component_ = new Segments({QStringLiteral("EX"), QStringLiteral("EY"), QStringLiteral("EZ"), QStringLiteral("EA"),
                             QStringLiteral("EB"), QStringLiteral("EC")},
                            tr("Component"));
  angle_ = new QComboBox;
  angle_->setAccessibleName(tr("Angle of the table"));
  angle_->setToolTip(tr("Panes, points and section show what was measured at this angle of the table."));
  angle_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  angle_->hide();
  heat_maps_ = new QCheckBox(tr("Between points"));
  heat_maps_->setToolTip(
      tr("A heat map between the points (interpolated with its uncertainty). That of the nine parameters is the model "
         "and always shown."));
  heat_maps_->setChecked(true);
  arrows_ = new QCheckBox(tr("Arrows"));
  machine_ = new QCheckBox(tr("Machine"));
  options->addWidget(count_);
  options->addWidget(component_);
  options->addWidget(angle_);
  options->addWidget(heat_maps_);
  options->addWidget(arrows_);
  options->addWidget(machine_);
  content()->addLayout(options);

  auto* left = new QWidget;
  auto* left_column = new QVBoxLayout(left);
  left_column->setContentsMargins(0, 0, 0, 0);
  grid_ = new QGridLayout;
  grid_->setSpacing(8);
  left_column->addLayout(grid_, 1);
  for (int i = 0; i < 4; ++i) {
    auto* pane = new ReviewPane(i + 1, sources_, left);
    panes_[static_cast<std::size_t>(i)] = pane;
    connect(pane, &ReviewPane::changed, this, [this] {
      if (!states_.empty()) sayWhatIsOutdated();
      showAll();
    });
    connect(pane, &ReviewPane::roomChanged, this, &ReviewPage::alignChoices);
    for (View3D* view : {pane->view(), pane->scanView()}) {
      showHints(view);
      connect(view, &View3D::pointPicked, this, &ReviewPage::select);
      connect(view, &View3D::cursorMoved, this, [this, view](const QPointF& pixel) { probe(view, pixel); });
    }
    for (int other = 0; other < i; ++other) {
      pane->view()->link(panes_[static_cast<std::size_t>(other)]->view());
      pane->scanView()->link(panes_[static_cast<std::size_t>(other)]->scanView());
    }
  }
  auto* time = new QHBoxLayout;
  time->addWidget(makeLabel(tr("State"), "sectionTitle"));
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setAccessibleName(tr("State shown by panes that follow the slider"));
  slider_->setMinimumHeight(sizes::control_height);
  time->addWidget(slider_, 1);
  slider_text_ = new QLabel;
  slider_text_->setMinimumWidth(170);
  time->addWidget(slider_text_);
  left_column->addLayout(time);

  auto* tabs = makeTabs(nullptr);
  rows_ = new RowsModel({tr("Point")}, this);
  table_ = makeTable(rows_, tr("Points"), tr("Points appear with the first evaluated state."));
  tabs->addTab(table_, tr("Points"));
  auto* section_tab = new QWidget;
  auto* section_column = new QVBoxLayout(section_tab);
  auto* section_line = new WrapLayout;
  direction_ = new Segments({tr("Along X"), tr("Along Y")}, tr("Direction of the section"));
  place_ = new QuantityBox(QStringLiteral("mm"), 1);
  place_->setAccessibleName(tr("Where the section runs"));
  section_line->addWidget(direction_);
  section_line->addWidget(place_);
  section_column->addLayout(section_line);
  section_ = new Plot;
  section_->setEmptyText(tr("A section will appear here"), tr("Let a pane show a model, or points near the line."));
  section_column->addWidget(section_, 1);
  tabs->addTab(section_tab, tr("Section"));
  content()->addWidget(makeSplitter(this, left, tabs, 16, 6), 1);
  layOutPanes();

  connect(count_, &Segments::chosen, this, [this] {
    layOutPanes();
    showAll();
  });
  connect(component_, &Segments::chosen, this, &ReviewPage::showAll);
  connect(angle_, &QComboBox::currentIndexChanged, this, &ReviewPage::showAll);
  connect(heat_maps_, &QCheckBox::toggled, this, &ReviewPage::showAll);
  connect(arrows_, &QCheckBox::toggled, this, &ReviewPage::showAll);
  connect(machine_, &QCheckBox::toggled, this, [this] {
    showAll();
    lookAgain();
  });
  connect(slider_, &QSlider::valueChanged, this, &ReviewPage::showAll);
  connect(play_, &QPushButton::toggled, this, &ReviewPage::play);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (!isVisible() || slider_->maximum() < 1) return play_->setChecked(false);
    slider_->setValue(slider_->value() < slider_->maximum() ? slider_->value() + 1 : slider_->minimum());
  });
  connect(direction_, &Segments::chosen, this, &ReviewPage::showSection);
  connect(place_, &QDoubleSpinBox::valueChanged, this, &ReviewPage::showSection);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex& now) {
    if (!filling_ && now.isValid()) select(rows_->idAt(now.row()));
  });
}

void ReviewPage::alignChoices() {
  const bool fit =
      std::all_of(panes_.begin(), panes_.end(), [](const ReviewPane* p) { return p == nullptr || p->fitsInOneLine(); });
  for (ReviewPane* pane : panes_)
    if (pane != nullptr) pane->setSecondLine(!fit);
}

void ReviewPage::layOutPanes() {
  const int shown = 2 + count_->current();
  for (int i = 0; i < 4; ++i) {
    ReviewPane* pane = panes_[static_cast<std::size_t>(i)];
    grid_->removeWidget(pane);
    pane->setVisible(i < shown);
    if (i < shown) grid_->addWidget(pane, i / 2, i % 2, 1, shown == 3 && i == 2 ? 2 : 1);
  }
  alignChoices();
  // Other sizes: all views are fitted anew, together.
  lookAgain();
}

void ReviewPage::lookAgain() {
  if (machine_->isChecked()) return panes_[0]->view()->resetCamera(StandardView::Isometric);
  // All follow the first: it looks at the map of whoever has one.
  const auto with_map = std::find_if(panes_.begin(), panes_.end(), [](const ReviewPane* pane) {
    return !pane->isHidden() && !pane->isScan() && pane->picture().field.has_value();
  });
  if (with_map == panes_.end()) return panes_[0]->view()->lookAtMap();
  panes_[0]->view()->resetCamera((*with_map)->view()->mapView());
}

void ReviewPage::setPanes(int count) {
  count_->setCurrent(count - 2);
  layOutPanes();
  showAll();
}

void ReviewPage::setComponent(int index) {
  component_->setCurrent(index);
  showAll();
}

void ReviewPage::setArrows(bool on) {
  arrows_->setChecked(on);
}

void ReviewPage::setHeatMaps(bool on) {
  heat_maps_->setChecked(on);
}

void ReviewPage::refresh() {
  if (session().campaign() == nullptr) return;
  const bool another = noticeCampaign();
  sources_.refresh();
  const auto own = sources_.source(session().campaignId());
  if (own == nullptr && sources_.reading(session().campaignId())) {
    // What is shown stays until they are looked through, but nothing of another campaign.
    if (another) showNothingYet();
    return;
  }
  const std::string folder = session().campaign()->folder.string();
  const bool other = shown_folder_ != folder;
  refit_ = refit_ || other;
  shown_folder_ = folder;
  for (ReviewPane* pane : panes_) pane->refresh(session().campaignId());
  fillSlider();
  filling_ = true;
  if (own != nullptr && other) {
    place_->setRange(-1e5, 1e5);
    chooseSection(*own);
    const bool scans = !own->scans.empty();
    const bool simulated = !own->campaign->simulation.empty();
    panes_[0]->choose(PaneContent::Measured);
    panes_[1]->choose(scans       ? PaneContent::ScanChange
                      : simulated ? PaneContent::Simulation
                                  : PaneContent::NineParameters);
    panes_[2]->choose(scans       ? PaneContent::ScanLeftOver
                      : simulated ? PaneContent::SimulationLeft
                                  : PaneContent::NineParametersLeft);
    panes_[3]->choose(PaneContent::Difference,
                      own->choices.states.size() > 1 ? fromCore(own->choices.states[1]) : QString());
  }
  filling_ = false;
  const bool something = own != nullptr && !(own->choices.states.empty() && own->scans.empty());
  if (!something) {
    callout()->show(Tone::Attention, tr("There is nothing to compare yet: evaluate the captures first."));
    callout()->setAction(tr("Go to Calibrate"), [this] { context().workflow.goTo(StepId::Calibrate); });
  } else {
    callout()->setAction({}, {});
    sayWhatIsOutdated();
  }
  showAll();
  if (isVisible() && something) session().noteReviewed();
}

void ReviewPage::showNothingYet() {
  callout()->setAction({}, {});
  callout()->set(Tone::Neutral, {});
  for (ReviewPane* pane : panes_) pane->showMessage(tr("Nothing to show"), tr("This campaign is being read."));
  rows_->setRows({});
  section_->setContent({});
}

void ReviewPage::readOther(std::int64_t id, const QString& name, CampaignSource source) {
  Job job;
  job.title = tr("Reading %1").arg(name);
  job.queue = JobQueue::Reading;
  job.key = "review/" + std::to_string(id);
  job.work = [this, id, session_number = session().sessionNumber(),
              source = std::move(source)](JobContext& context) -> std::function<void()> {
    auto read = std::make_shared<const ReadForReview>(ReadForReview::read(source, context));
    return [this, id, session_number, read] {
      if (session_number == session().sessionNumber()) takeOther(id, read);
    };
  };
  job.failed = [this, id, session_number = session().sessionNumber()](const QString&) {
    if (session_number == session().sessionNumber()) takeOther(id, nullptr);
  };
  job.abandonable = true;
  context().jobs.run(std::move(job));
}

void ReviewPage::takeOther(std::int64_t id, std::shared_ptr<const ReadForReview> read) {
  sources_.take(id, std::move(read));
  for (ReviewPane* pane : panes_) pane->refresh(session().campaignId());
  if (!states_.empty()) sayWhatIsOutdated();
  showAll();
}

void ReviewPage::sayWhatIsOutdated() {
  QStringList told;
  std::set<std::int64_t> looked_at;
  for (const ReviewPane* pane : panes_) {
    if (pane->isHidden()) continue;
    const std::int64_t id = pane->campaignChoice()->currentData().toLongLong();
    const auto source = looked_at.insert(id).second ? sources_.source(id) : nullptr;
    if (source == nullptr || source->changed.empty()) continue;
    QStringList changed;
    for (const std::string& what : source->changed) changed << coreSentence(what);
    told << tr("%1: earlier result. Changed since: %2.").arg(source->name, changed.join(QStringLiteral(", ")));
  }
  if (told.isEmpty()) {
    callout()->set(Tone::Neutral, {});
  } else {
    callout()->show(Tone::Outdated, told.join(QLatin1Char(' ')));
  }
}

void ReviewPage::fillSlider() {
  // The states of the campaign at hand; panes of other campaigns that lack one say so.
  const auto own = sources_.source(session().campaignId());
  std::vector<std::string> states = own == nullptr ? std::vector<std::string>() : own->choices.states;
  if (states.empty() && own != nullptr) {
    for (const ScanCapture& c : own->scans)
      if (std::find(states.begin(), states.end(), c.cycle) == states.end()) states.push_back(c.cycle);
  }
  if (states == states_) return;
  states_ = std::move(states);
  const QSignalBlocker quiet(slider_);
  slider_->setRange(0, std::max(0, static_cast<int>(states_.size()) - 1));
  slider_->setValue(slider_->maximum());
  slider_->setEnabled(states_.size() > 1);
  play_->setEnabled(states_.size() > 1);
}

void ReviewPage::fillAngles() {
  std::set<double> angles;
  for (const ReviewPane* pane : panes_) {
    const auto source = pane->isHidden() ? nullptr : pane->source();
    if (source != nullptr) angles.insert(source->choices.angles_deg.begin(), source->choices.angles_deg.end());
  }
  QVariantList wanted;
  if (angles.size() > 1) {
    for (const double c_deg : angles) wanted << c_deg;
    wanted << QVariant();  // all of them
  }
  QVariantList offered;
  for (int i = 0; i < angle_->count(); ++i) offered << angle_->itemData(i);
  if (offered != wanted) {
    const QSignalBlocker quiet(angle_);
    const QString before = angle_->currentText();
    angle_->clear();
    for (const QVariant& c_deg : wanted)
      angle_->addItem(
          c_deg.isValid() ? tr("Table at %1°").arg(decimalText(c_deg.toDouble(), 'g', 6)) : tr("All angles"), c_deg);
    angle_->setCurrentIndex(wanted.isEmpty() ? -1 : std::max(0, angle_->findText(before)));
  }
  angle_->setVisible(!wanted.isEmpty());
}

std::optional<double> ReviewPage::angle() const {
  const QVariant c_deg = angle_->currentData();
  return c_deg.isValid() ? std::optional(c_deg.toDouble()) : std::nullopt;
}

std::string ReviewPage::stateAtSlider() const {
  return states_.empty() ? std::string() : states_[static_cast<std::size_t>(slider_->value())];
}

double ReviewPage::exaggeration() const {
  double largest = 0.0;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
  for (const ReviewPane* pane : panes_) {
    if (pane->isHidden()) continue;
    for (const ReviewPoint& p : pane->picture().points) {
      low = low.cwiseMin(p.position_mm);
      high = high.cwiseMax(p.position_mm);
      for (const auto& [component, v] : p.components)
        if (!isRotation(component) && std::isfinite(v.value)) largest = std::max(largest, std::abs(v.value));
    }
  }
  if (!(largest > 0.0)) return 1.0;
  const double size = std::max(10.0, (high - low).norm());
  return std::max(1.0, roundedDown(0.15 * size / (1e-3 * largest)));
}

void ReviewPage::showTable() {
  QStringList headers{tr("Point")};
  std::vector<QString> order;
  const auto component = static_cast<Component>(component_->current());
  const QString unit = unitText(unitOf(component));
  std::vector<const ReviewPane*> shown;
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    const ReviewPane* pane = panes_[i];
    if (pane->isHidden() || pane->isScan()) continue;
    shown.push_back(pane);
    headers << tr("%1 / %2").arg(i + 1).arg(unit);
    for (const ReviewPoint& p : pane->picture().points)
      if (std::find(order.begin(), order.end(), fromCore(p.id)) == order.end()) order.push_back(fromCore(p.id));
  }
  std::vector<Row> rows;
  for (const QString& id : order) {
    Row row;
    row.id = id;
    row.cells.push_back(nameCell(id));
    for (const ReviewPane* pane : shown) {
      const auto& points = pane->picture().points;
      const auto p =
          std::find_if(points.begin(), points.end(), [&](const ReviewPoint& q) { return fromCore(q.id) == id; });
      const auto v =
          p == points.end() ? std::map<Component, ReviewValue>::const_iterator() : p->components.find(component);
      row.cells.push_back(
          p == points.end() || v == p->components.end() ? dashCell() : quantityCell(v->second.value, v->second.sigma));
    }
    rows.push_back(std::move(row));
  }
  filling_ = true;
  rows_->setHeaders(headers);
  rows_->setRows(std::move(rows));
  if (const int at = rows_->rowOf(selected_); at >= 0) table_->selectRow(at);
  filling_ = false;
}

void ReviewPage::select(const QString& point) {
  if (point == selected_) return;
  selected_ = point;
  bool scans = false;
  for (ReviewPane* pane : panes_) {
    pane->view()->setSelected(point);
    scans = scans || (!pane->isHidden() && pane->isScan());
  }
  filling_ = true;
  if (const int at = rows_->rowOf(point); at >= 0) table_->selectRow(at);
  filling_ = false;
  if (scans) showScans();
}

/// Through the middle of the travel, along X; points that all lie on a line along Y have a section along Y, through
/// them.
void ReviewPage::chooseSection(const ReviewSource& source) {
  const Eigen::AlignedBox2d& extent = source.choices.extent_mm;
  const bool along_y = !extent.isEmpty() && extent.sizes().x() < 1e-6 && extent.sizes().y() > 1e-6;
  direction_->setCurrent(along_y ? 1 : 0);
  const LinearAxis* across = source.campaign->machine.findAxis(along_y ? "X" : "Y");
  const double middle = across == nullptr ? 0.0 : 0.5 * (across->travel_mm[0] + across->travel_mm[1]);
  place_->setValue(along_y ? extent.min().x() : middle);
}

void ReviewPage::showSection() {
  if (filling_) return;
  const bool along_x = direction_->current() == 0;
  const auto component = static_cast<Component>(component_->current());
  const double at = place_->value();
  std::vector<Series> series;
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    const ReviewPane* pane = panes_[i];
    if (pane->isHidden() || pane->isScan()) continue;
    const ReviewPicture& picture = pane->picture();
    Series s;
    s.name = tr("%1: %2").arg(i + 1).arg(coreSentence(picture.title));
    s.colour = static_cast<int>(i);
    if (picture.field) {
      const ReviewSection section = reviewSection(*picture.field, along_x, at);
      s.x = section.place_mm;
      s.y = section.value;
      s.sigma = section.sigma;
      s.style = SeriesStyle::Line;
    } else {
      s.style = SeriesStyle::Points;
      double low = 1e300, high = -1e300;
      for (const ReviewPoint& p : picture.points) {
        low = std::min(low, along_x ? p.position_mm.y() : p.position_mm.x());
        high = std::max(high, along_x ? p.position_mm.y() : p.position_mm.x());
      }
      for (const ReviewPoint& p : picture.points) {
        const double across = along_x ? p.position_mm.y() : p.position_mm.x();
        const auto v = p.components.find(component);
        if (v == p.components.end() || !std::isfinite(v->second.value)) continue;
        if (std::abs(across - at) > section_reach * (high - low) + 1e-6) continue;
        s.x.push_back(along_x ? p.position_mm.x() : p.position_mm.y());
        s.y.push_back(v->second.value);
        s.sigma.push_back(v->second.sigma);
      }
    }
    if (!s.x.empty()) series.push_back(std::move(s));
  }
  section_->setAxes(
      along_x ? tr("X / mm") : tr("Y / mm"),
      QStringLiteral("%1 / %2").arg(fromCore(std::string(toString(component))), unitText(unitOf(component))));
  section_->setContent(std::move(series));
}

void ReviewPage::probe(View3D* view, const QPointF& pixel) {
  const auto component = static_cast<Component>(component_->current());
  for (ReviewPane* pane : panes_) {
    if (pane->isHidden() || pane->isScan()) continue;
    if (view->size() != pane->view()->size()) {
      pane->setValue({});
      continue;
    }
    // The same place in every pane: the cameras are linked.
    if (const auto found = pane->view()->probeAt(pixel)) {
      pane->setValue(tr("x %1 mm, y %2 mm: %3%4")
                         .arg(decimalText(found->xy_mm.x(), 'f', 1))
                         .arg(decimalText(found->xy_mm.y(), 'f', 1))
                         .arg(shownNumbers(fromCore(withUncertainty(found->value, found->sigma, unitOf(component)))),
                              found->extrapolated ? tr(" (extrapolated)") : QString()));
      continue;
    }
    const QString id = pane->view()->pointAt(pixel);
    const auto& points = pane->picture().points;
    const auto at =
        std::find_if(points.begin(), points.end(), [&](const ReviewPoint& p) { return fromCore(p.id) == id; });
    if (id.isEmpty() || at == points.end() || !at->components.contains(component)) {
      pane->setValue({});
      continue;
    }
    const ReviewValue& v = at->components.at(component);
    pane->setValue(
        QStringLiteral("%1: %2").arg(id, shownNumbers(fromCore(withUncertainty(v.value, v.sigma, unitOf(component))))));
  }
}

void ReviewPage::play(bool on) {
  play_->setText(on ? tr("Stop") : tr("Play the states"));
  if (on) {
    timer_.start(playback_ms);
  } else {
    timer_.stop();
  }
}

std::vector<Exportable> ReviewPage::exportables() {
  std::vector<Exportable> items;
  if (rows_->rowCount() > 0) items.push_back(exportableOf(tr("Points compared"), rows_));
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    if (panes_[i]->isHidden()) continue;
    View3D* view = panes_[i]->isScan() ? panes_[i]->scanView() : panes_[i]->view();
    if (!view->empty()) items.push_back(exportableOf(tr("Pane %1").arg(i + 1), view));
  }
  if (!section_->empty()) items.push_back(exportableOf(tr("Section"), section_));
  return items;
}

}  // namespace spindrift::gui
