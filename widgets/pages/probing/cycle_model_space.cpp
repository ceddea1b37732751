// SPDX-License-Identifier: GPL-3.0-or-later
// What the parameters of a cycle mean in space: the heat map and arrows of a ball artefact, the straightness of a bar.
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/probing/cycle_model_page.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr std::array<Component, 3> shown_components{Component::EX, Component::EY, Component::EZ};

}  // namespace

QWidget* CycleModelPage::makeVolumePart() {
  auto* card = new Card(tr("Volumetric error"));
  component_ = new Segments({QStringLiteral("EX"), QStringLiteral("EY"), QStringLiteral("EZ")}, tr("Component"));
  card->addToTitle(component_);
  view_ = new View3D;
  view_->setEmptyText(tr("The heat map will appear here"),
                      tr("Fit all cycles: the error is drawn on a plane through the working space."));
  view_->setMachineVisible(false);
  card->body()->addWidget(view_, 1);
  auto* line = new WrapLayout;
  line->addWidget(new QLabel(tr("Plane at")));
  normal_ =
      new Segments({QStringLiteral("X"), QStringLiteral("Y"), QStringLiteral("Z")}, tr("Axis the plane is normal to"));
  normal_->setCurrent(2);
  line->addWidget(normal_);
  level_ = new QSlider(Qt::Horizontal);
  level_->setAccessibleName(tr("Place of the plane"));
  level_->setMinimumHeight(sizes::control_height);
  level_->setMinimumWidth(120);
  level_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  line->addWidget(level_);
  level_text_ = new QLabel;
  level_text_->setMinimumWidth(72);
  line->addWidget(level_text_);
  arrows_ = new QCheckBox(tr("Arrows in the volume"));
  arrows_->setChecked(true);
  line->addWidget(arrows_);
  card->body()->addLayout(line);
  connect(component_, &Segments::chosen, this, &CycleModelPage::showVolume);
  connect(arrows_, &QCheckBox::toggled, this, &CycleModelPage::showVolume);
  connect(level_, &QSlider::valueChanged, this, &CycleModelPage::showVolume);
  connect(normal_, &Segments::chosen, this, [this] {
    resetLevel();
    showVolume();
  });
  return card;
}

QWidget* CycleModelPage::makeBarPart() {
  auto* card = new Card(tr("Straightness and the second axis"));
  line_ = new Plot;
  line_->setAxes(tr("Along the bar / mm"), tr("Deviation / µm"));
  line_->setEmptyText(tr("Deviations from a straight line will appear here"),
                      tr("Fit all cycles: the deviation of the axis from uniform expansion is drawn for each hole."));
  card->body()->addWidget(line_, 3);
  auto* extend = new WrapLayout;
  second_axis_ = new QCheckBox(tr("Second axis expands too"));
  second_axis_->setToolTip(tr("One parameter more; needs a bar whose growth is known"));
  second_axis_->setObjectName(QStringLiteral("secondAxis"));
  growth_ = new QuantityBox(QStringLiteral("um/m"), 2);
  trust_ = new QuantityBox(QStringLiteral("um/m"), 2);
  const auto prepare = [](QDoubleSpinBox* box, double low, double high, double value, const QString& name) {
    box->setRange(low, high);
    box->setValue(value);
    box->setAccessibleName(name);
    box->setMinimumHeight(sizes::control_height);
  };
  prepare(growth_, -1000, 1000, 0, tr("Known growth of the bar"));
  prepare(trust_, 0.01, 100, 0.1, tr("Standard uncertainty of that growth"));
  card->body()->addWidget(second_axis_);
  extend->addWidget(new QLabel(tr("Expansion of the bar")));
  auto* known = new QWidget;
  auto* value = new QHBoxLayout(known);
  value->setContentsMargins(0, 0, 0, 0);
  value->addWidget(growth_);
  value->addWidget(new QLabel(QStringLiteral("±")));
  value->addWidget(trust_);
  extend->addWidget(known);
  card->body()->addLayout(extend);
  auto* unnoticed = makeLabel(tr("Effect of an undetected expansion of the second axis"), "sectionTitle");
  unnoticed->setWordWrap(true);
  card->body()->addWidget(unnoticed);
  bias_ = new RowsModel({tr("Parameter"), tr("Change per 10⁻⁶"), tr("Unit")}, this);
  card->body()->addWidget(makeTable(bias_, tr("Bias by the second axis"), tr("The bias appears after the fit.")), 3);
  connect(second_axis_, &QCheckBox::toggled, this, [this](bool on) {
    options_.change(tr("extend by the second axis"), [on](CycleChoice& o) { o.second_axis = on; });
  });
  connect(growth_, &QDoubleSpinBox::editingFinished, this, [this] {
    options_.change(tr("growth of the bar"), [this](CycleChoice& o) { o.growth_um_per_m = growth_->value(); });
  });
  connect(trust_, &QDoubleSpinBox::editingFinished, this, [this] {
    options_.change(tr("uncertainty of the bar"), [this](CycleChoice& o) { o.trust_um_per_m = trust_->value(); });
  });
  return card;
}

void CycleModelPage::setComponent(int index) {
  component_->setCurrent(index);
  showVolume();
}

void CycleModelPage::setPlane(int normal_axis) {
  normal_->setCurrent(normal_axis);
  resetLevel();
  showVolume();
}

void CycleModelPage::resetLevel() {
  const auto campaign = session().campaign();
  const LinearAxis* axis =
      campaign == nullptr ? nullptr : campaign->machine.findAxis(std::string(1, "XYZ"[normal_->current()]));
  if (axis == nullptr) return;
  const QSignalBlocker quiet(level_);
  level_->setRange(static_cast<int>(std::min(axis->travel_mm[0], axis->travel_mm[1])),
                   static_cast<int>(std::max(axis->travel_mm[0], axis->travel_mm[1])));
  level_->setValue((level_->minimum() + level_->maximum()) / 2);
}

void CycleModelPage::showVolume() {
  const auto campaign = session().campaign();
  if (campaign == nullptr || evaluation_ == nullptr || evaluation_->ball_cycles.empty()) return;
  const BallCycleResult& result = evaluation_->ball_cycles.front();
  const int k = cycle_->currentIndex();
  for (const char* axis : {"X", "Y", "Z"}) {
    if (campaign->machine.findAxis(axis) == nullptr) return;
  }
  if (k < 0 || campaign->machine.styli.empty()) return;
  if (view_->empty()) {
    resetLevel();
    view_->setMachine(campaign->machine);
    view_->setMachineVisible(false);
  }
  level_text_->setText(onScreen(QStringLiteral("%1 mm").arg(level_->value())));
  const Eigen::Vector3d offset = campaign->machine.styli.front().offset_mm;
  const BallCycleModel model(result, k);
  const Component component = shown_components[static_cast<std::size_t>(component_->current())];
  // One scale for the three components and all heights, so that pictures can be compared.
  double largest = 0;
  double largest_arrow = 0;
  std::vector<ViewArrow> arrows;
  for (const VolumetricArrow& a : volumetricArrows(model, campaign->machine, offset, 4)) {
    largest = std::max(largest, a.deviation_um.cwiseAbs().maxCoeff());
    largest_arrow = std::max(largest_arrow, a.deviation_um.norm());
    arrows.push_back({a.position_mm, a.deviation_um, Tone::Neutral});
  }
  auto field = std::make_shared<Field>(volumetricField(model, campaign->machine, component, normal_->current(),
                                                       static_cast<double>(level_->value()), offset, 41));
  field_ = field;
  const QString name = fromCore(std::string(toString(component)));
  const double extent =
      std::max(field->grid.x_to_mm - field->grid.x_from_mm, field->grid.y_to_mm - field->grid.y_from_mm);
  view_->setColourScale(ColourScale::symmetric(std::max(largest, 0.1), name, QStringLiteral("um")));
  FieldStyle style;
  style.contours = true;
  view_->setField(field, style);
  if (!arrows_->isChecked()) arrows.clear();
  view_->setArrows(std::move(arrows), exaggerationFor(0.12 * extent, largest_arrow));
  view_->setCaption(
      tr("%1 at %2 = %3 mm in cycle %4 against %5, stylus %6")
          .arg(name)
          .arg(QLatin1Char("XYZ"[normal_->current()]))
          .arg(level_->value())
          .arg(cycle_->currentText(), fromCore(result.cycles.front()), fromCore(campaign->machine.styli.front().id)));
}

void CycleModelPage::showBar() {
  if (evaluation_ == nullptr || evaluation_->hole_cycles.empty()) return;
  const HoleCycleResult& holes = evaluation_->hole_cycles.front();
  Series rms, largest;
  rms.name = tr("rms over all cycles");
  rms.style = SeriesStyle::LinePoints;
  largest.name = tr("Largest");
  largest.style = SeriesStyle::Points;
  largest.colour = 1;
  for (const LinearityDeviation& d : holes.linearity) {
    const double s = holes.setup.along_mm[static_cast<std::size_t>(HoleBarSetup::holeIndex(d.feature))];
    rms.x.push_back(s);
    rms.y.push_back(d.rms_um);
    largest.x.push_back(s);
    largest.y.push_back(d.largest_um);
    largest.sigma.push_back(d.sigma_um);
  }
  line_->setLeastRange(0.5);
  line_->setContent({rms, largest});
  std::vector<Row> rows;
  const SecondAxisBias& bias = holes.bias;
  for (std::size_t p = 0; p < bias.names.size(); ++p) {
    Row row;
    row.id = fromCore(bias.names[p]);
    row.cells = {nameCell(parameterTitle(bias.names[p])), numberCell(bias.bias_per_um_per_m[p], 3),
                 Cell{parameterUnit(bias.names[p])}};
    for (const std::size_t i : {1, 2}) row.cells[i].unit = parameterUnit(bias.names[p]);
    rows.push_back(std::move(row));
  }
  bias_->setRows(std::move(rows));
}

}  // namespace spindrift::gui
