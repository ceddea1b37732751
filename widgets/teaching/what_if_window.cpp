// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/teaching/what_if_window.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QTabWidget>
#include <QTableView>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/reporting/test_part_drawing.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/drawing_painter.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr int what_if_steps = 200;
constexpr int box_width = 152;
constexpr double largest_arrow = 0.4;  ///< of the longest travel

QString valueUnit(const WhatIfParameter& p) {
  return gainUnitText(p.unit);
}

/// What one unit of its driver does, in the units on screen.
QString driverNote(const WhatIfParameter& p) {
  const ShownUnit gain = shownUnit(gainUnitText(p.gain_unit));
  const ShownUnit value = shownUnit(valueUnit(p));
  return WhatIfWindow::tr("%1, %2 %3 per %4")
      .arg(sentenceStart(coreSentence(p.driver)), decimalText(p.sensitivity * gain.factor / value.factor, 'g', 3),
           gain.name, value.name);
}

/// One-sided: there is no less than nothing of it.
bool oneSided(const WhatIfParameter& p) {
  return p.unit == "%" || p.unit == "krpm2" || p.unit == "krpm_m";
}

QString groupTitle(const WhatIfParameter& p) {
  if (p.group == "squareness") return WhatIfWindow::tr("Squareness");
  if (p.geometric && p.group == "C") return WhatIfWindow::tr("Location of the rotary table C");
  if (p.geometric) return WhatIfWindow::tr("Axis %1").arg(fromCore(p.group));
  return familyTitle(p.group);
}

QString parameterName(const WhatIfParameter& p) {
  if (!p.geometric) return sentenceStart(effectTitle(p.id));
  return QStringLiteral("%1  %2").arg(fromCore(p.id.substr(0, p.id.find('_'))), coreSentence(p.title));
}

QString featureName(const std::string& id) {
  const std::size_t dot = id.find('.');
  const std::string stem = id.substr(0, dot);
  const QString number = dot == std::string::npos ? QString() : fromCore(id.substr(dot + 1));
  if (stem == "square")
    return number.isEmpty() ? WhatIfWindow::tr("Square") : WhatIfWindow::tr("Square, side %1").arg(number);
  if (stem == "diamond") return WhatIfWindow::tr("Diamond, side %1").arg(number);
  if (stem == "inclined") return WhatIfWindow::tr("Inclined face %1").arg(number);
  if (stem == "circle") return WhatIfWindow::tr("Circle");
  if (stem == "bore") return WhatIfWindow::tr("Centre bore");
  if (stem == "hole") return WhatIfWindow::tr("Hole %1").arg(number);
  return WhatIfWindow::tr("Holes");
}

QString characteristicName(const PartCharacteristic& c) {
  const std::string& what = c.characteristic;
  if (what == "straightness") return WhatIfWindow::tr("Straightness");
  if (what == "perpendicularity") return WhatIfWindow::tr("Perpendicularity to %1").arg(fromCore(c.datum));
  if (what == "parallelism") return WhatIfWindow::tr("Parallelism to %1").arg(fromCore(c.datum));
  if (what == "angularity") return WhatIfWindow::tr("Angularity to %1").arg(fromCore(c.datum));
  if (what == "squareness") return WhatIfWindow::tr("Squareness of its sides");
  if (what == "size_x") return WhatIfWindow::tr("Size along X");
  if (what == "size_y") return WhatIfWindow::tr("Size along Y");
  if (what == "circularity") return WhatIfWindow::tr("Circularity, minimum zone");
  if (what == "circularity_ls") return WhatIfWindow::tr("Circularity, least squares");
  if (what == "diameter") return WhatIfWindow::tr("Diameter");
  if (what == "concentricity") return WhatIfWindow::tr("Concentricity to %1").arg(fromCore(c.datum));
  if (what == "position") return WhatIfWindow::tr("Position from %1 and B").arg(fromCore(c.datum));
  if (what == "distance_x") return WhatIfWindow::tr("Distance along X");
  return WhatIfWindow::tr("Distance along Y");
}

QString artefactName(const WhatIfArtefact& artefact) {
  QString name = artefact.kind == "hole_bar" ? WhatIfWindow::tr("Hole bar")
                 : artefact.kind == "balls"  ? WhatIfWindow::tr("Ball artefact")
                                             : WhatIfWindow::tr("Fiducial plate");
  const QString pose = coreSentence(artefact.pose);
  return pose.isEmpty() ? name : QStringLiteral("%1, %2").arg(name, pose);
}

}  // namespace

TestPartView::TestPartView(QWidget* parent) : QWidget(parent) {
  setAccessibleName(tr("Milled test piece"));
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, [this] { update(); });
}

void TestPartView::show(const TestPart* part, std::vector<Eigen::Vector3d> deviation_um, const QString& why_none) {
  part_ = part;
  deviation_um_ = std::move(deviation_um);
  why_none_ = why_none;
  update();
}

void TestPartView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& t = theme();
  if (part_ == nullptr) {
    painter.setPen(t.text_secondary);
    painter.setFont(textFont(sizes::font_body));
    painter.drawText(rect().adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap, why_none_);
    return;
  }
  TestPartDrawingOptions options;
  options.width_px = width();
  options.height_px = height();
  options.ground = pictureColour(t.surface);
  options.nominal = pictureColour(mixed(t.surface, t.text_secondary, 0.45));
  options.actual = pictureColour(t.accent);
  options.soft = pictureColour(t.text_secondary);
  options.ink = pictureColour(t.text);
  options.legend = tr("Deviations from bore C, magnified %1 ×").arg(QStringLiteral("{}")).toStdString();
  options.no_deviation = tr("No deviation: the part is as it should be").toStdString();
  paintDrawing(painter, testPartDrawing(*part_, deviation_um_, options));
}

WhatIfWindow::WhatIfWindow(const MachineDescription& machine, WindowDraft draft, QWidget* parent)
    : QDialog(parent), what_if_(machine), draft_(std::move(draft)), kept_(draft_.typed()) {
  setWindowTitle(tr("What if"));
  resize(1280, 800);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(sizes::step);
  column->addWidget(makeLabel(tr("Move an error of the machine and see what it does to probing points, artefacts and a "
                                 "milled part."),
                              "instruction"));
  auto* right = new QWidget;
  auto* right_column = new QVBoxLayout(right);
  right_column->setContentsMargins(0, 0, 0, 0);
  right_column->setSpacing(sizes::step);
  view_ = new View3D;
  view_->setAccessibleName(tr("Machine with the deviations at its probing points"));
  view_->setMachine(what_if_.machine());
  std::vector<ViewPoint> points;
  for (const MachinePoint& point : what_if_.machine().points)
    points.push_back({.id = fromCore(point.id), .position_mm = point.position_mm, .label = fromCore(point.id)});
  view_->setPoints(std::move(points));
  auto* machine_card = new Card(tr("Machine"));
  machine_card->body()->addWidget(view_, 1);
  part_view_ = new TestPartView;
  auto* part_card = new Card(tr("Test piece (of the kind of ISO 10791-7)"));
  part_card->body()->addWidget(part_view_, 1);
  auto* pictures = makeSplitter(nullptr, machine_card, part_card, 1, 1);

  part_rows_ = new RowsModel(
      {tr("Feature"), tr("Characteristic"), tr("Value"), tr("Unit"), tr("Nominal / mm"), QString()}, this);
  point_rows_ = new RowsModel({tr("Point"), tr("X / mm"), tr("Y / mm"), tr("Z / mm"), tr("EX / µm"), tr("EY / µm"),
                               tr("EZ / µm"), tr("EA / µrad"), tr("EB / µrad"), tr("EC / µrad"), QString()},
                              this);
  artefact_rows_ = new RowsModel(
      {tr("Feature"), tr("X / mm"), tr("Y / mm"), tr("Z / mm"), tr("EX / µm"), tr("EY / µm"), tr("EZ / µm"), QString()},
      this);
  tabs_ = makeTabs(nullptr);
  tabs_->addTab(makeTable(part_rows_, tr("Characteristics of the test piece")), tr("Test piece"));
  tabs_->addTab(makeTable(point_rows_, tr("Deviations at the probing points")), tr("Probing points"));
  auto* artefacts = new QWidget;
  auto* artefact_column = new QVBoxLayout(artefacts);
  artefact_column->setContentsMargins(0, sizes::half_step, 0, 0);
  auto* line = new QHBoxLayout;
  artefact_ = new QComboBox;
  artefact_->setAccessibleName(tr("Artefact"));
  for (const WhatIfArtefact& one : what_if_.answer().artefacts) artefact_->addItem(artefactName(one));
  artefact_note_ = makeLabel({}, "secondaryText");
  line->addWidget(artefact_);
  line->addWidget(artefact_note_, 1);
  artefact_column->addLayout(line);
  artefact_column->addWidget(makeTable(artefact_rows_, tr("Deviations of the features of the artefact")), 1);
  tabs_->addTab(artefacts, tr("Artefacts"));
  right_column->addWidget(makeSplitter(right, pictures, tabs_, 5, 4, Qt::Vertical), 1);

  column->addWidget(makeSplitter(this, makeControls(), right, 3, 7), 1);
  connect(tabs_, &QTabWidget::currentChanged, this, [this] { refreshTable(what_if_.answer()); });
  connect(artefact_, &QComboBox::activated, this, [this] { refreshTable(what_if_.answer()); });
  connect(&UnitsNotifier::instance(), &UnitsNotifier::changed, this, [this] {
    for (std::size_t i = 0; i < controls_.size(); ++i)
      if (controls_[i].note != nullptr) controls_[i].note->setText(driverNote(what_if_.parameters()[i]));
    refreshTable(what_if_.answer());
  });
  showKept();
  refresh();
}

void WhatIfWindow::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  // Only now the view has its size, by which the camera is placed.
  QTimer::singleShot(0, this, [this] { view_->resetCamera(StandardView::Isometric); });
}

QWidget* WhatIfWindow::makeControls() {
  auto* left = new QWidget;
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  auto* line = new QHBoxLayout;
  search_ = new QLineEdit;
  search_->setPlaceholderText(tr("Find a parameter or effect"));
  search_->setAccessibleName(tr("Find a parameter or effect"));
  search_->setClearButtonEnabled(true);
  auto* reset_button = makeButton(tr("All to zero"), "reset-view");
  line->addWidget(search_, 1);
  line->addWidget(reset_button);
  column->addLayout(line);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* list = new QWidget;
  auto* rows = new QVBoxLayout(list);
  rows->setContentsMargins(0, 0, sizes::step, 0);
  rows->setSpacing(sizes::half_step);
  QString group;
  QLabel* heading = nullptr;
  for (std::size_t i = 0; i < what_if_.parameters().size(); ++i) {
    const QString title = groupTitle(what_if_.parameters()[i]);
    if (title != group) {
      heading = makeLabel(title, "sectionTitle");
      rows->addWidget(heading);
      group = title;
    }
    addControl(i, heading, rows);
  }
  rows->addStretch(1);
  scroll->setWidget(list);
  column->addWidget(scroll, 1);
  left->setMinimumWidth(360);
  connect(search_, &QLineEdit::textChanged, this, &WhatIfWindow::filter);
  connect(reset_button, &QPushButton::clicked, this, &WhatIfWindow::reset);
  return left;
}

void WhatIfWindow::addControl(std::size_t parameter, QLabel* heading, QVBoxLayout* column) {
  const WhatIfParameter& p = what_if_.parameters()[parameter];
  Control control;
  control.heading = heading;
  control.row = new QWidget;
  auto* box = new QVBoxLayout(control.row);
  box->setContentsMargins(0, 0, 0, 0);
  box->setSpacing(0);
  const QString name = parameterName(p);
  auto* title = new QLabel(name);
  title->setWordWrap(true);
  box->addWidget(title);
  QString tip = name;
  if (!p.geometric) {
    control.note = makeLabel(driverNote(p), "secondaryText");
    control.note->setWordWrap(true);
    box->addWidget(control.note);
    tip = QStringLiteral("%1\n%2").arg(coreSentence(p.physics), formulaText(p.formula));
    control.text = sentenceStart(coreSentence(p.driver));
  }
  control.text += QLatin1Char(' ') + name + QLatin1Char(' ') + fromCore(p.id);
  auto* line = new QHBoxLayout;
  control.slider = new QSlider(Qt::Horizontal);
  control.slider->setRange(oneSided(p) ? 0 : -what_if_steps, what_if_steps);
  control.slider->setAccessibleName(name);
  control.slider->setMinimumHeight(sizes::control_height);
  control.box = new QuantityBox(valueUnit(p), p.largest >= 50.0 ? 1 : 2);
  control.box->setRange(oneSided(p) ? 0.0 : -p.largest, p.largest);
  control.box->setSingleStep(p.largest / 20.0);
  control.box->setAccessibleName(name);
  control.box->setFixedWidth(box_width);
  control.row->setToolTip(tip);
  line->addWidget(control.slider, 1);
  line->addWidget(control.box);
  box->addLayout(line);
  column->addWidget(control.row);
  connect(control.slider, &QSlider::valueChanged, this, [this, parameter](int step) {
    if (!filling_) changed(parameter, what_if_.parameters()[parameter].largest * step / what_if_steps);
  });
  connect(control.slider, &QSlider::sliderReleased, this, &WhatIfWindow::keep);
  connect(control.box, &QuantityBox::valueChanged, this, [this, parameter](double value) {
    if (!filling_) changed(parameter, value);
  });
  controls_.push_back(control);
}

void WhatIfWindow::changed(std::size_t parameter, double value) {
  put(parameter, value);
  refresh();
  // While a slider is held down every step of it would be written to the disk.
  if (!controls_[parameter].slider->isSliderDown()) keep();
}

void WhatIfWindow::put(std::size_t parameter, double value) {
  filling_ = true;
  const Control& control = controls_[parameter];
  control.box->setValue(value);
  control.slider->setValue(
      static_cast<int>(std::lround(what_if_steps * value / what_if_.parameters()[parameter].largest)));
  filling_ = false;
  what_if_.set(parameter, value);
}

void WhatIfWindow::keep() {
  for (std::size_t i = 0; i < what_if_.parameters().size(); ++i) {
    const std::string& id = what_if_.parameters()[i].id;
    if (what_if_.value(i) != 0.0)
      kept_[id] = what_if_.value(i);
    else
      kept_.erase(id);
  }
  draft_.keep(kept_.empty() ? nlohmann::json() : kept_);
}

void WhatIfWindow::showKept() {
  if (!kept_.is_object()) kept_ = nlohmann::json::object();
  for (std::size_t i = 0; i < what_if_.parameters().size(); ++i) {
    const auto value = kept_.find(what_if_.parameters()[i].id);
    const QuantityBox* box = controls_[i].box;
    if (value != kept_.end() && value->is_number())
      put(i, std::clamp(value->get<double>(), box->minimum(), box->maximum()));
  }
}

void WhatIfWindow::set(const std::string& id, double value) {
  changed(what_if_.find(id), value);
}

void WhatIfWindow::reset() {
  filling_ = true;
  for (const Control& control : controls_) {
    control.box->setValue(0.0);
    control.slider->setValue(0);
  }
  filling_ = false;
  what_if_.reset();
  refresh();
  kept_ = nlohmann::json::object();
  keep();
}

void WhatIfWindow::filter(const QString& text) {
  const QString wanted = text.trimmed();
  for (const Control& control : controls_) control.heading->setVisible(false);
  for (const Control& control : controls_) {
    const bool shown = wanted.isEmpty() || control.text.contains(wanted, Qt::CaseInsensitive);
    control.row->setVisible(shown);
    if (shown) control.heading->setVisible(true);
  }
}

int WhatIfWindow::visibleSliders() const {
  return static_cast<int>(
      std::count_if(controls_.begin(), controls_.end(), [this](const Control& c) { return c.row->isVisibleTo(this); }));
}

QSlider* WhatIfWindow::slider(const std::string& id) const {
  return controls_[what_if_.find(id)].slider;
}

QuantityBox* WhatIfWindow::box(const std::string& id) const {
  return controls_[what_if_.find(id)].box;
}

void WhatIfWindow::refresh() {
  WhatIfAnswer answer = what_if_.answer();
  refreshMachine(answer);
  refreshTable(answer);
  part_view_->show(what_if_.part(), std::move(answer.part_um), fromCore(what_if_.whyNoPart()));
}

void WhatIfWindow::refreshMachine(const WhatIfAnswer& answer) {
  double longest_mm = 1.0, largest_um = 0.0;
  for (const LinearAxis& axis : what_if_.machine().axes)
    longest_mm = std::max(longest_mm, axis.travel_mm[1] - axis.travel_mm[0]);
  std::vector<ViewArrow> arrows;
  for (const WhatIfPlace& place : answer.points) {
    arrows.push_back({place.position_mm, place.deviation.head<3>(), Tone::Accent});
    largest_um = std::max(largest_um, place.deviation.head<3>().norm());
  }
  const bool any = largest_um > 1e-6;
  if (!any) arrows.clear();
  view_->setArrows(std::move(arrows), any ? roundedDown(largest_arrow * longest_mm / (1e-3 * largest_um)) : 1.0);
}

void WhatIfWindow::refreshTable(const WhatIfAnswer& answer) {
  std::vector<Row> rows;
  const auto placeRow = [](const WhatIfPlace& place, int components) {
    Row row;
    row.id = fromCore(place.id);
    row.cells = {nameCell(row.id)};
    for (int i = 0; i < 3; ++i) row.cells.push_back(numberCell(place.position_mm[i], 0));
    for (int i = 0; i < components; ++i) row.cells.push_back(numberCell(place.deviation[i], 2));
    row.cells.emplace_back();  // the last column takes what is left
    return row;
  };
  switch (tabs_->currentIndex()) {
    case 0:
      for (const PartCharacteristic& c : answer.part) {
        Row row;
        row.id = fromCore(c.feature + "." + c.characteristic);
        row.cells = {nameCell(featureName(c.feature)),
                     {characteristicName(c)},
                     numberCell(c.value, 2),
                     {unitText(c.unit)},
                     c.nominal_mm > 0.0 ? numberCell(c.nominal_mm, 1) : Cell{},
                     {}};
        for (const std::size_t i : {2, 3}) row.cells[i].unit = fromCore(c.unit);
        rows.push_back(std::move(row));
      }
      part_rows_->setRows(std::move(rows));
      break;
    case 1:
      for (const WhatIfPlace& place : answer.points) rows.push_back(placeRow(place, 6));
      point_rows_->setRows(std::move(rows));
      break;
    default: {
      if (artefact_->currentIndex() < 0) break;
      const WhatIfArtefact& artefact = answer.artefacts[static_cast<std::size_t>(artefact_->currentIndex())];
      for (const WhatIfPlace& place : artefact.features) rows.push_back(placeRow(place, 3));
      artefact_rows_->setRows(std::move(rows));
      QString note = tr("Relative to %1").arg(fromCore(artefact.reference));
      if (artefact.along_um_per_m)
        note += tr("; deviation along the bar %1 µm/m").arg(decimalText(*artefact.along_um_per_m, 'f', 1));
      artefact_note_->setText(onScreen(note));
      break;
    }
  }
}

}  // namespace spindrift::gui
