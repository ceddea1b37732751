// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/review/review_pane.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/services/review_sources.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

Eigen::Vector3d deviationOf(const ReviewPoint& p) {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  for (const auto& [component, index] : {std::pair{Component::EX, 0}, {Component::EY, 1}, {Component::EZ, 2}}) {
    const auto v = p.components.find(component);
    if (v != p.components.end() && std::isfinite(v->second.value)) out[index] = v->second.value;
  }
  return out;
}

/// The same with uncertainties, for distances: NaN where a component was not measured.
PointDeviation measuredDeviation(const ReviewPoint& p) {
  PointDeviation out;
  for (const auto& [component, index] : {std::pair{Component::EX, 0}, {Component::EY, 1}, {Component::EZ, 2}}) {
    const auto v = p.components.find(component);
    out.deviation_um[index] = v == p.components.end() ? std::nan("") : v->second.value;
    out.sigma_um[index] = v == p.components.end() ? std::nan("") : v->second.sigma;
  }
  return out;
}

/// As wide as what is chosen, so that it is never cut; with the longest choice the page would be too wide.
void fitToChoice(QComboBox* box) {
  constexpr int least = 8;
  const QFontMetrics metrics = box->fontMetrics();
  const int letter = std::max(1, metrics.horizontalAdvance(QLatin1Char('X')));
  box->setMinimumContentsLength(std::max(least, metrics.horizontalAdvance(box->currentText()) / letter + 1));
}

}  // namespace

std::optional<ReviewQuantity> quantityOf(PaneContent content) {
  if (content >= PaneContent::Difference) return std::nullopt;
  return static_cast<ReviewQuantity>(content);  // in the same order
}

ReviewPane::ReviewPane(int number, ReviewSources& sources, QWidget* parent)
    : QFrame(parent), sources_(sources), first_(number == 1) {
  setProperty("role", QStringLiteral("card"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(4);
  choices_ = new WrapLayout;
  choices_->addWidget(makeLabel(QString::number(number), "sectionTitle"));
  campaign_ = new QComboBox;
  campaign_->setAccessibleName(tr("Campaign of pane %1").arg(number));
  campaign_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  campaign_->setMinimumContentsLength(8);
  state_ = new QComboBox;
  state_->setAccessibleName(tr("State of pane %1").arg(number));
  content_ = new QComboBox;
  content_->setAccessibleName(tr("What pane %1 shows").arg(number));
  for (QComboBox* box : {state_, content_}) {
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    fitToChoice(box);
    connect(box, &QComboBox::currentIndexChanged, this, [this, box] {
      fitToChoice(box);
      Q_EMIT roomChanged();
    });
  }
  for (QComboBox* box : {campaign_, state_, content_}) {
    box->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    box->setIconSize({0, 0});  // no choice has one, and its place would be kept
  }
  choices_->addWidget(campaign_);
  choices_->addWidget(state_);
  choices_->addWidget(content_);
  column->addLayout(choices_);
  stack_ = new QStackedWidget;
  view_ = new View3D;
  scan_view_ = new View3D;
  stack_->addWidget(view_);
  stack_->addWidget(scan_view_);
  column->addWidget(stack_, 1);
  value_ = makeLabel(QString(), "secondaryText");
  value_->setAccessibleName(tr("Value under the cursor in pane %1").arg(number));
  value_->setMinimumHeight(20);
  column->addWidget(value_);
  view_->lookAtMap();
  connect(scan_view_, &View3D::hovered, this, &ReviewPane::setValue);

  connect(campaign_, &QComboBox::currentIndexChanged, this, [this] {
    if (filling_) return;
    fillStates();
    Q_EMIT changed();
  });
  for (QComboBox* box : {state_, content_})
    connect(box, &QComboBox::currentIndexChanged, this, [this] {
      if (!filling_) Q_EMIT changed();
    });
}

bool ReviewPane::fitsInOneLine() const {
  if (isHidden()) return true;
  const QMargins margins = layout()->contentsMargins();
  return choices_->sizeHint().width() <= width() - margins.left() - margins.right();
}

void ReviewPane::setSecondLine(bool second) {
  choices_->setBreakBefore(second ? choices_->indexOf(content_) : -1);
}

void ReviewPane::resizeEvent(QResizeEvent* event) {
  QFrame::resizeEvent(event);
  Q_EMIT roomChanged();
}

void ReviewPane::refresh(std::int64_t campaign) {
  filling_ = true;
  const qlonglong chosen = campaign_->count() > 0 ? campaign_->currentData().toLongLong() : 0;
  campaign_->clear();
  for (const auto& [id, name] : sources_.campaigns()) campaign_->addItem(name, QVariant::fromValue<qlonglong>(id));
  int at = chosen == 0 ? -1 : campaign_->findData(QVariant::fromValue<qlonglong>(chosen));
  if (at < 0) at = campaign_->findData(QVariant::fromValue<qlonglong>(campaign));
  campaign_->setCurrentIndex(std::max(at, 0));
  campaign_->setVisible(campaign_->count() > 1);
  Q_EMIT roomChanged();
  fillStates();
  filling_ = false;
}

void ReviewPane::fillStates() {
  // While another campaign is read, what was chosen stays to be looked for in it.
  if (const auto none = source();
      none == nullptr && sources_.reading(campaign_->currentData().toLongLong()) && content_->count() > 0)
    return;
  const bool was_filling = filling_;
  filling_ = true;
  const QString state = state_->count() > 0 && state_->currentIndex() > 0 ? state_->currentText() : QString();
  const QVariant content = content_->currentData();
  state_->clear();
  content_->clear();
  state_->addItem(tr("At the slider"));
  const auto offer = [this](const QString& text, PaneContent what) { content_->addItem(text, static_cast<int>(what)); };
  const auto from = source();
  offer(tr("Measured"), PaneContent::Measured);
  offer(tr("Nine parameters"), PaneContent::NineParameters);
  offer(tr("Measured − nine parameters"), PaneContent::NineParametersLeft);
  if (from != nullptr && !from->campaign->simulation.empty()) {
    offer(tr("Simulation"), PaneContent::Simulation);
    offer(tr("Measured − simulation"), PaneContent::SimulationLeft);
    offer(tr("Simulation with effects"), PaneContent::Completed);
    offer(tr("Measured − simulation with effects"), PaneContent::CompletedLeft);
  }
  if (!first_) offer(tr("Minus pane 1"), PaneContent::Difference);  // pane 1 has nothing to be compared with
  if (from != nullptr) {
    for (const std::string& s : from->choices.states) state_->addItem(fromCore(s));
    if (!from->scans.empty()) {
      offer(tr("Scan, change"), PaneContent::ScanChange);
      offer(tr("Scan residual"), PaneContent::ScanLeftOver);
    }
  }
  state_->setCurrentIndex(std::max(0, state_->findText(state)));
  content_->setCurrentIndex(std::max(0, content_->findData(content)));
  filling_ = was_filling;
}

void ReviewPane::choose(PaneContent content, const QString& state) {
  filling_ = true;
  content_->setCurrentIndex(std::max(0, content_->findData(static_cast<int>(content))));
  state_->setCurrentIndex(state.isEmpty() ? 0 : std::max(0, state_->findText(state)));
  filling_ = false;
  Q_EMIT changed();
}

PaneContent ReviewPane::content() const {
  return static_cast<PaneContent>(content_->currentData().toInt());
}

std::shared_ptr<const ReviewSource> ReviewPane::source() const {
  return campaign_->count() == 0 ? nullptr : sources_.source(campaign_->currentData().toLongLong());
}

std::string ReviewPane::state(const std::string& at_slider) const {
  return state_->currentIndex() <= 0 ? at_slider : state_->currentText().toStdString();
}

void ReviewPane::show(const ReviewPicture& picture, const std::optional<double>& limit, bool arrows,
                      double exaggeration, bool machine, bool values) {
  picture_ = picture;
  sayWhole(picture);
  stack_->setCurrentWidget(view_);
  const auto from = source();
  if (from == nullptr) return;
  const std::string folder = from->campaign->folder.string();
  if (machine_of_ != folder) {
    view_->clear();
    view_->setMachine(from->campaign->machine);
    machine_of_ = folder;
  }
  view_->setMachineVisible(machine);
  const QString unit = unitText(unitOf(picture.component));
  if (limit)
    view_->setColourScale(ColourScale::symmetric(*limit, fromCore(std::string(toString(picture.component))), unit));
  view_->setField(picture.field ? std::make_shared<const Field>(*picture.field) : nullptr);
  std::vector<ViewPoint> points;
  std::vector<ViewArrow> shown_arrows;
  for (const ReviewPoint& p : picture.points) {
    ViewPoint v;
    v.id = v.label = fromCore(p.id);
    v.position_mm = p.position_mm;
    v.used = p.used;
    const auto value = p.components.find(picture.component);
    if (value != p.components.end() && std::isfinite(value->second.value)) {
      v.value = value->second.value;
      if (values)
        v.value_text = shownNumbers(
            fromCore(withUncertainty(value->second.value, value->second.sigma, unitOf(picture.component))));
    } else {
      v.tone = Tone::Neutral;
    }
    if (content() == PaneContent::Measured) v.deviation = measuredDeviation(p);
    points.push_back(std::move(v));
    if (arrows) shown_arrows.push_back({p.position_mm, deviationOf(p), Tone::Accent});
  }
  view_->setPoints(std::move(points));
  view_->setArrows(std::move(shown_arrows), exaggeration);
  // What ± is stands in the first line: a view that is low leaves the others out.
  caption_ = coreSentence(picture.title) + QStringLiteral(", ") + fromCore(std::string(toString(picture.component)));
  if (!picture.uncertainty.empty()) caption_ += QStringLiteral(": ") + coreSentence(picture.uncertainty);
  if (!picture.message.empty()) caption_ += QLatin1Char('\n') + coreSentence(picture.message);
  view_->setCaption(caption_);
}

void ReviewPane::showScan(const ScanPicture& picture, const QString& title, double limit) {
  picture_ = {};
  stack_->setCurrentWidget(scan_view_);
  const bool first = scan_view_->empty();
  const Camera camera = scan_view_->camera();
  ColourScale scale = ColourScale::symmetric(limit, tr("dz"), QStringLiteral("um"));
  if (picture.colouring == ScanColouring::Height) {
    scale.map = ColourMap::Sequential;
    scale.low = picture.low;
    scale.high = std::max(picture.high, picture.low + 1e-6);
    scale.title = tr("z");
    scale.unit = QStringLiteral("mm");
  }
  ViewCloud cloud;
  cloud.xyz_mm = picture.xyz_mm;
  cloud.scalar = picture.scalar;
  scan_view_->setColourScale(scale);
  scan_view_->setCloud(cloud);
  if (!first) scan_view_->setCamera(camera);
  scan_view_->setCaption(picture.colouring == ScanColouring::Height
                             ? title + tr(": the reference itself, height")
                             : title + tr(", median |dz| %1 µm").arg(decimalText(picture.median_magnitude, 'f', 2)));
  const bool height = picture.colouring == ScanColouring::Height;
  const int decimals = height ? 3 : 1;
  whole_ = onScreen(tr("98 % of the points: %1 to %2 %3")
                        .arg(decimalText(picture.low, 'f', decimals), decimalText(picture.high, 'f', decimals),
                             height ? QStringLiteral("mm") : QStringLiteral("µm")));
  setValue({});
}

void ReviewPane::showMessage(const QString& title, const QString& how) {
  picture_ = {};
  picture_.message = how.toStdString();
  whole_.clear();
  setValue({});
  machine_of_.clear();
  View3D* shown = isScan() ? scan_view_ : view_;
  stack_->setCurrentWidget(shown);
  shown->clear();
  shown->setEmptyText(title, how);
}

void ReviewPane::setValue(const QString& text) {
  value_->setText(text.isEmpty() ? whole_ : onScreen(text));
}

void ReviewPane::sayWhole(const ReviewPicture& picture) {
  const ReviewPoint* largest = nullptr;
  double most = -1.0;
  for (const ReviewPoint& p : picture.points) {
    const auto v = p.components.find(picture.component);
    if (v == p.components.end() || !(std::abs(v->second.value) > most)) continue;
    most = std::abs(v->second.value);
    largest = &p;
  }
  whole_.clear();
  if (largest != nullptr) {
    const ReviewValue& v = largest->components.at(picture.component);
    whole_ = onScreen(tr("Largest: %1 at %2")
                          .arg(shownNumbers(fromCore(withUncertainty(v.value, v.sigma, unitOf(picture.component)))),
                               fromCore(largest->id)));
  }
  setValue({});
}

QString ReviewPane::value() const {
  return value_->text();
}

}  // namespace spindrift::gui
