// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/scanning/artefact_designer.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/machine/component.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr int rest_ms = 200;
constexpr int lattice = 100;  ///< places per side: exact to a per cent, answers at once

std::vector<ArtefactSurface> surfaces() {
  ArtefactSurface paper;
  ArtefactSurface bumps = paper;
  bumps.bumps = {{{3.0, 9.0}, 2.5, 0.5}, {{8.0, 30.0}, 3.0, -0.4}};
  ArtefactSurface crossed = paper;
  crossed.amplitude_xy_mm = 0.8;
  ArtefactSurface wide = paper;
  wide.size_mm = {30.0, 41.0};
  wide.amplitude_x_mm = 2.5;
  wide.wave_number_x_per_mm = 0.25;
  return {paper, bumps, crossed, wide};
}

/// An uncertainty with two digits that tell: "2.0", "0.0014".
QString uncertaintyText(double value) {
  const int decimals = value > 0.0 ? std::max(0, 1 - static_cast<int>(std::floor(std::log10(value)))) : 0;
  return decimalText(value, 'f', decimals);
}

QString lengthText(double um) {
  return std::isfinite(um) ? uncertaintyText(um) : ArtefactDesigner::tr("free");
}

}  // namespace

ArtefactDesigner::ArtefactDesigner(WindowDraft draft, QWidget* parent) : QDialog(parent), draft_(std::move(draft)) {
  setWindowTitle(tr("Artefact designer"));
  resize(1240, 860);
  auto* column = new QVBoxLayout(this);
  column->addWidget(makeLabel(tr("A free-form surface for the laser profiler: see what a scan of it can tell before it "
                                 "is milled or printed."),
                              "instruction"));
  auto* left = new Card(tr("Surface"));
  kind_ = new QComboBox;
  kind_->addItems({tr("The paper's surface"), tr("With two bumps (unique)"), tr("Crossed waves"), tr("Wide and calm")});
  kind_->setAccessibleName(tr("Surface to start from"));
  left->body()->addWidget(kind_);
  auto* form = new QFormLayout;
  addNumber(form, "size x", tr("Size X"), QStringLiteral("mm"), 2, 200, 1, 11, 1);
  addNumber(form, "size y", tr("Size Y, along the scan"), QStringLiteral("mm"), 2, 500, 1, 41, 1);
  addNumber(form, "amplitude x", tr("Wave along X, amplitude"), QStringLiteral("mm"), 0, 20, 0.1, 1, 2);
  addNumber(form, "wave x", tr("Wave along X"), QStringLiteral("rad/mm"), 0.01, 5, 0.05, 0.6, 3);
  addNumber(form, "amplitude y", tr("Wave along Y, amplitude"), QStringLiteral("mm"), 0, 20, 0.1, 2.5, 2);
  addNumber(form, "wave y", tr("Wave along Y"), QStringLiteral("rad/mm"), 0.01, 5, 0.05, 1.0 / 6.0, 3);
  addNumber(form, "amplitude xy", tr("Oblique wave, amplitude"), QStringLiteral("mm"), 0, 10, 0.1, 0, 2);
  addNumber(form, "noise", tr("Noise of a point"), QStringLiteral("µm"), 0.01, 100, 0.1, 0.5, 2);
  addNumber(form, "points", tr("Points of a scan"), tr("thousand"), 1, 20000, 10, 640, 0);
  addNumber(form, "steepest slope", tr("Steepest slope seen"), QStringLiteral("mm/mm"), 0.05, 10, 0.1, 1.2, 2);
  addNumber(form, "base", tr("Base under the lowest point"), QStringLiteral("mm"), 0.5, 100, 1, 10, 1);
  addNumber(form, "step", tr("Facets of the STL"), QStringLiteral("mm"), 0.02, 5, 0.05, 0.1, 2);
  left->body()->addLayout(form);
  left->body()->addStretch();
  auto* stl = makeButton(tr("Save as STL …"), "export", "primary");
  left->body()->addWidget(stl);

  auto* right = new Card;
  verdict_ = new Callout;
  right->body()->addWidget(verdict_);
  colouring_ = new Segments({tr("Height"), tr("Slope against the limit")}, tr("Colours of the surface"));
  right->body()->addWidget(colouring_);
  view_ = new View3D;
  right->body()->addWidget(view_, 3);
  sigmas_ = new RowsModel({tr("Uncertainty of"), tr("rigid"), tr("push broom")}, this);
  weak_ = new RowsModel({tr("Scan model"), tr("Weak direction"), tr("Standard uncertainty / µm")}, this);
  auto* weak = makeTable(weak_, tr("Weak directions"), tr("No direction is weak."));
  weak->setToolTip(
      tr("Directions of the motion that are known thirty times less well than the best one; rotations "
         "times the artefact's length"));
  auto* tables = makeSplitter(nullptr, makeTable(sigmas_, tr("Standard uncertainty of the six errors")), weak, 1, 1);
  tables->setMinimumHeight(300);  // all six errors
  right->body()->addWidget(tables);
  column->addWidget(makeSplitter(this, left, right, 3, 7), 1);

  timer_.setSingleShot(true);
  timer_.setInterval(rest_ms);
  connect(&timer_, &QTimer::timeout, this, &ArtefactDesigner::recompute);
  connect(kind_, &QComboBox::activated, this, &ArtefactDesigner::chooseSurface);
  connect(colouring_, &Segments::chosen, this, &ArtefactDesigner::showSurface);
  connect(stl, &QPushButton::clicked, this, &ArtefactDesigner::askForStl);
  fillForm(0);
  showKept();
  recompute();
}

void ArtefactDesigner::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  // Only now the view has its size, by which the camera is placed.
  QTimer::singleShot(0, this, [this] { view_->resetCamera(StandardView::Isometric); });
}

void ArtefactDesigner::addNumber(QFormLayout* form, const std::string& name, const QString& label, const QString& unit,
                                 double low, double high, double step, double value, int decimals) {
  auto* box = new QuantityBox(unit, decimals);
  box->setRange(low, high);
  box->setSingleStep(step);
  box->setValue(value);
  box->setAccessibleName(label);
  auto* name_of = new QLabel(label);
  name_of->setMinimumHeight(sizes::control_height);  // beside the middle of the box
  name_of->setBuddy(box);
  form->addRow(name_of, box);
  numbers_[name] = box;
  connect(box, &QDoubleSpinBox::valueChanged, this, [this] {
    if (filling_) return;
    timer_.start();
    keep();
  });
}

void ArtefactDesigner::chooseSurface(int index) {
  fillForm(index);
  keep();
  recompute();
  view_->resetCamera(StandardView::Isometric);
}

void ArtefactDesigner::fillForm(int index) {
  surface_ = surfaces()[static_cast<std::size_t>(index)];
  kind_->setCurrentIndex(index);
  filling_ = true;
  numbers_.at("size x")->setValue(surface_.size_mm.x());
  numbers_.at("size y")->setValue(surface_.size_mm.y());
  numbers_.at("amplitude x")->setValue(surface_.amplitude_x_mm);
  numbers_.at("wave x")->setValue(surface_.wave_number_x_per_mm);
  numbers_.at("amplitude y")->setValue(surface_.amplitude_y_mm);
  numbers_.at("wave y")->setValue(surface_.wave_number_y_per_mm);
  numbers_.at("amplitude xy")->setValue(surface_.amplitude_xy_mm);
  filling_ = false;
}

void ArtefactDesigner::keep() {
  nlohmann::json numbers = nlohmann::json::object();
  for (const auto& [name, box] : numbers_) numbers[name] = box->value();
  draft_.keep({{"surface", kind_->currentIndex()}, {"numbers", numbers}});
}

void ArtefactDesigner::showKept() {
  const nlohmann::json kept = draft_.typed();
  if (!kept.is_object() || !kept.contains("numbers") || !kept.contains("surface")) return;
  const nlohmann::json& surface = kept.at("surface");
  if (surface.is_number_integer() && surface >= 0 && surface < kind_->count()) fillForm(surface.get<int>());
  filling_ = true;
  for (const auto& [name, value] : kept.at("numbers").items()) {
    const auto found = numbers_.find(name);
    if (found != numbers_.end() && value.is_number()) found->second->setValue(value.get<double>());
  }
  filling_ = false;
}

void ArtefactDesigner::takeNumbers() {
  surface_.size_mm = {numbers_.at("size x")->value(), numbers_.at("size y")->value()};
  surface_.amplitude_x_mm = numbers_.at("amplitude x")->value();
  surface_.wave_number_x_per_mm = numbers_.at("wave x")->value();
  surface_.amplitude_y_mm = numbers_.at("amplitude y")->value();
  surface_.wave_number_y_per_mm = numbers_.at("wave y")->value();
  surface_.amplitude_xy_mm = numbers_.at("amplitude xy")->value();
}

void ArtefactDesigner::recompute() {
  timer_.stop();
  takeNumbers();
  ArtefactDesignOptions options;
  options.noise_um = numbers_.at("noise")->value();
  options.point_count = 1000.0 * numbers_.at("points")->value();
  options.steepest_slope = numbers_.at("steepest slope")->value();
  options.lattice = lattice;
  try {
    const ArtefactDesign rigid = designArtefact(surface_, options);
    options.scan_model = ScanModel::PushBroom;
    showDesigns(rigid, designArtefact(surface_, options));
  } catch (const InputError& e) {
    verdict_->show(Tone::Bad, coreSentence(e.what()));
    sigmas_->setRows({});
    weak_->setRows({});
  }
  showSurface();
}

void ArtefactDesigner::showDesigns(const ArtefactDesign& rigid, const ArtefactDesign& push_broom) {
  std::vector<Row> rows;
  for (const Component k : all_components) {
    const auto i = static_cast<std::size_t>(k);
    Row row;
    row.id = fromCore(std::string(toString(k)));
    const QString unit = unitText(unitOf(k));
    row.cells.push_back(nameCell(QStringLiteral("%1 / %2").arg(row.id, unit)));
    row.cells.back().unit = unit;
    for (const ArtefactDesign* d : {&rigid, &push_broom}) {
      Cell cell = std::isfinite(d->sigma[i]) ? Cell{uncertaintyText(d->sigma[i])}
                                             : toneCell(tr("not determined"), Tone::Attention);
      cell.right = true;
      cell.unit = unit;
      row.cells.push_back(cell);
    }
    rows.push_back(std::move(row));
  }
  sigmas_->setRows(std::move(rows));
  rows.clear();
  for (const auto& [name, d] :
       {std::pair<QString, const ArtefactDesign*>{tr("rigid"), &rigid}, {tr("push broom"), &push_broom}}) {
    for (const WeakDirection& w : d->weak) {
      Row row;
      row.id = name + fromCore(w.name);
      Cell sigma{lengthText(w.sigma_um)};
      sigma.right = true;
      row.cells = {{name}, {shownNumbers(fromCore(w.name))}, sigma};
      rows.push_back(std::move(row));
    }
  }
  weak_->setRows(std::move(rows));
  const QString slopes = tr("Slope up to %1 along X and %2 along Y.")
                             .arg(decimalText(rigid.largest_slope_x, 'f', 2))
                             .arg(decimalText(rigid.largest_slope_y, 'f', 2));
  if (rigid.status == FitStatus::Rejected) {
    verdict_->show(Tone::Bad, coreSentence(rigid.message));
  } else if (rigid.visible_part < 0.999) {
    verdict_->show(Tone::Attention, tr("%1 The profiler sees only %2 % of the surface; the rest is too steep (red).")
                                        .arg(slopes)
                                        .arg(decimalText(100.0 * rigid.visible_part, 'f', 1)));
  } else if (rigid.status == FitStatus::Degenerate) {
    verdict_->show(Tone::Attention, coreSentence(rigid.message) + QLatin1Char(' ') + slopes);
  } else {
    verdict_->show(Tone::Good, coreSentence(rigid.message) + QLatin1Char(' ') + slopes + QLatin1Char(' ') +
                                   tr("The profiler sees all of it."));
  }
}

void ArtefactDesigner::showSurface() {
  const bool slope = colouring_->current() == 1;
  const double limit = numbers_.at("steepest slope")->value();
  constexpr int nodes = 260;
  auto xyz = std::make_shared<std::vector<float>>();
  auto scalar = std::make_shared<std::vector<float>>();
  float low = 1e30F, high = -1e30F;
  for (int r = 0; r <= nodes; ++r)
    for (int c = 0; c <= nodes; ++c) {
      const double x = surface_.size_mm.x() * c / nodes, y = surface_.size_mm.y() * r / nodes;
      const double z = surface_.height_mm(x, y);
      for (const double v : {x, y, z}) xyz->push_back(static_cast<float>(v));
      const double steep = surface_.gradient(x, y).cwiseAbs().maxCoeff();
      scalar->push_back(static_cast<float>(slope ? 100.0 * (steep / limit - 1.0) : z));
      low = std::min(low, scalar->back());
      high = std::max(high, scalar->back());
    }
  ColourScale scale = ColourScale::symmetric(20.0, tr("over the limit"), QStringLiteral("%"));
  if (!slope) {
    scale.map = ColourMap::Sequential;
    scale.low = low;
    scale.high = std::max(high, low + 1e-3F);
    scale.title = tr("z");
    scale.unit = QStringLiteral("mm");
  }
  const bool first = view_->empty();
  const Camera camera = view_->camera();
  view_->setColourScale(scale);
  view_->setCloud({xyz, scalar, nullptr, 3.0});
  if (!first) view_->setCamera(camera);
  view_->setCaption(slope ? tr("Red: steeper than the profiler sees") : tr("Height of the surface"));
}

void ArtefactDesigner::writeStl(const std::filesystem::path& file) {
  takeNumbers();
  writeArtefactStl(file, surface_, numbers_.at("base")->value(), numbers_.at("step")->value());
}

void ArtefactDesigner::askForStl() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Save the artefact"), QStringLiteral("artefact.stl"),
                                                    tr("STL, mm (*.stl)"));
  if (file.isEmpty()) return;
  try {
    writeStl(file.toStdString());
    verdict_->show(Tone::Good, tr("Saved as %1.").arg(file));
  } catch (const InputError& e) {
    verdict_->show(Tone::Bad, coreSentence(e.what()));
  }
}

}  // namespace spindrift::gui
