// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/artefact_editor.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/editor_table.h"
#include "widgets/common/parts.h"
#include "widgets/common/scrolling.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/panels/common/probing_scene.h"
#include "widgets/panels/machine/artefact_fields.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr std::array edited_keys{"artefacts", "styli"};

QString valueText(const nlohmann::json& value) {
  if (value.is_number()) return shownNumbers(QString::fromStdString(exactNumber(value.get<double>())));
  return value.is_string() ? QString::fromStdString(value.get<std::string>()) : QString();
}

/// Where balls stand in the picture while nothing was touched: above the middle of the table.
Eigen::Vector3d shownFirstBall(const MachineDescription& machine) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[k]));
    if (axis != nullptr) place(k) = axis->travel_mm[0] + 0.25 * (axis->travel_mm[1] - axis->travel_mm[0]);
  }
  return place;
}

}  // namespace

ArtefactEditor::ArtefactEditor(PageContext page_context, QWidget* parent)
    : QWidget(parent),
      context_(std::move(page_context)),
      draft_(context_.session, context_.undo, "artefacts", [this] { refresh(); }) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  verdict_ = new Callout;
  column->addWidget(verdict_);
  auto* left = new Card;
  auto* head = new WrapLayout;
  choice_ = new QComboBox;
  choice_->setAccessibleName(tr("Artefact"));
  choice_->setMinimumWidth(108);
  auto* add_bar = makeButton(tr("Hole bar"), "plus");
  auto* add_balls = makeButton(tr("Balls"), "plus");
  remove_ = makeButton(tr("Remove"), "trash");
  choice_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  head->addWidget(choice_);
  head->addWidget(add_bar);
  head->addWidget(add_balls);
  head->addWidget(remove_);
  left->body()->addLayout(head);
  fields_ = new ArtefactFields;
  form_ = makeScrolling(fields_);
  // Below one another on a page that scrolls, each card has the least it asks for: four lines of fields.
  form_->setMinimumHeight(4 * (sizes::control_height + 8));
  left->body()->addWidget(form_, 1);
  none_ = makeLabel(tr("Add a hole bar or balls, and type their certificate."), "secondaryText");
  none_->setWordWrap(true);
  none_->setAlignment(Qt::AlignCenter);
  left->body()->addWidget(none_, 1);
  auto* right = new Card(tr("How it looks"));
  view_ = new View3D;
  view_->setEmptyText(tr("The artefact will appear here"), tr("Add a hole bar or balls, and type their certificate."));
  view_->setMachineVisible(false);
  right->body()->addWidget(view_, 1);
  right->body()->addWidget(makeLabel(tr("Styli"), "sectionTitle"));
  styli_ = makeEditor({tr("Stylus"), tr("Radius\n/ mm"), tr("x / mm"), tr("y / mm"), tr("z / mm")}, tr("Styli"),
                      tr("No stylus yet."));
  styli_->setToolTip(tr("Offset: tip minus spindle reference"));
  right->body()->addWidget(styli_, 1);
  auto* stylus_buttons = new WrapLayout;
  auto* add_stylus = makeButton(tr("Add stylus"), "plus");
  auto* remove_stylus = makeButton(tr("Remove stylus"), "trash");
  discard_ = makeButton(tr("Discard"), "undo");
  apply_ = makeButton(tr("Apply artefacts"), nullptr, "primary");
  stylus_buttons->addWidget(add_stylus);
  stylus_buttons->addWidget(remove_stylus);
  right->body()->addLayout(stylus_buttons);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch();
  buttons->addWidget(discard_);
  buttons->addWidget(apply_);
  left->body()->addLayout(buttons);
  column->addWidget(makeSplitter(this, left, right, 9, 6), 1);

  connect(choice_, &QComboBox::activated, this, &ArtefactEditor::showArtefact);
  connect(add_bar, &QPushButton::clicked, this, [this] { addArtefact("hole_bar"); });
  connect(add_balls, &QPushButton::clicked, this, [this] { addArtefact("balls"); });
  connect(remove_, &QPushButton::clicked, this, [this] {
    const int index = choice_->currentIndex();
    if (index < 0) return;
    machine_["artefacts"].erase(static_cast<std::size_t>(index));
    showArtefact(std::max(0, index - 1));
    changed(tr("remove an artefact"));
  });
  connect(fields_, &ArtefactFields::edited, this, [this] {
    if (filling_ || choice_->currentIndex() < 0) return;
    current() = fields_->read(current());
    choice_->setItemText(choice_->currentIndex(), fromCore(current().value("id", "")));
    changed();
  });
  connect(styli_, &QTableWidget::itemChanged, this, [this] {
    if (!filling_) changed();
  });
  connect(add_stylus, &QPushButton::clicked, this, [this] {
    filling_ = true;
    const int row = styli_->rowCount();
    styli_->insertRow(row);
    setText(styli_, row, 0, QStringLiteral("p%1").arg(row));
    for (int k = 1; k < 5; ++k) setText(styli_, row, k, row > 0 ? textAt(styli_, row - 1, k) : QString());
    filling_ = false;
    styli_->setCurrentCell(row, 1);
    changed(tr("add a stylus"));
  });
  makeRemoving(remove_stylus, styli_, [this] { changed(tr("remove a stylus")); });
  connect(discard_, &QPushButton::clicked, this, &ArtefactEditor::discard);
  connect(apply_, &QPushButton::clicked, this, &ArtefactEditor::apply);
}

nlohmann::json& ArtefactEditor::current() {
  return machine_["artefacts"][static_cast<std::size_t>(choice_->currentIndex())];
}

nlohmann::json ArtefactEditor::partOf(const nlohmann::json& machine) {
  nlohmann::json part = nlohmann::json::object();
  for (const char* key : edited_keys) {
    const auto found = machine.find(key);
    part[key] = found != machine.end() && found->is_array() ? *found : nlohmann::json::array();
  }
  return part;
}

void ArtefactEditor::refresh() {
  const auto campaign = context_.session.campaign();
  if (campaign == nullptr) return;
  machine_ = campaign->machine.source;
  machine_.update(partOf(machine_));
  const nlohmann::json base = partOf(machine_);
  const nlohmann::json draft = draft_.typed(base);
  if (draft.is_object()) machine_.update(draft);
  draft_.shown(partOf(machine_));
  view_->setMachine(campaign->machine);
  view_->setMachineVisible(false);
  showStyli();
  showArtefact(std::clamp(choice_->currentIndex(), 0, std::max(0, static_cast<int>(machine_["artefacts"].size()) - 1)));
  edited_ = draft.is_object();
  of_another_ = draft_.ofAnother(base);
  check();
}

void ArtefactEditor::discard() {
  draft_.discard();
  refresh();
}

void ArtefactEditor::showArtefact(int index) {
  filling_ = true;
  choice_->clear();
  for (const nlohmann::json& a : machine_["artefacts"]) choice_->addItem(fromCore(a.value("id", "")));
  choice_->setCurrentIndex(std::min(index, choice_->count() - 1));
  const bool any = choice_->currentIndex() >= 0;
  form_->setVisible(any);
  none_->setVisible(!any);
  remove_->setEnabled(any);
  if (any) fields_->show(current());
  filling_ = false;
  check();
  showPreview();
}

void ArtefactEditor::showStyli() {
  filling_ = true;
  const nlohmann::json& list = machine_["styli"];
  styli_->setRowCount(static_cast<int>(list.size()));
  for (int row = 0; row < styli_->rowCount(); ++row) {
    const nlohmann::json& s = list[static_cast<std::size_t>(row)];
    setText(styli_, row, 0, valueText(s.value("id", nlohmann::json())));
    setText(styli_, row, 1, valueText(s.value("radius_mm", nlohmann::json())));
    const nlohmann::json offset = s.value("offset_mm", nlohmann::json::array());
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      setText(styli_, row, 2 + k, i < offset.size() ? valueText(offset[i]) : QString());
    }
  }
  filling_ = false;
}

void ArtefactEditor::addArtefact(const std::string& kind) {
  const bool holes = kind == "hole_bar";
  std::string id = holes ? "bar" : "balls";
  const auto taken = [&] {
    return std::any_of(machine_["artefacts"].begin(), machine_["artefacts"].end(),
                       [&](const nlohmann::json& a) { return a.value("id", "") == id; });
  };
  for (int i = 2; taken(); ++i) id = (holes ? "bar" : "balls") + std::to_string(i);
  nlohmann::json artefact = {{"id", id}, {"kind", kind}};
  if (holes) {
    artefact.update({{"nominal_positions_mm", {0, 50, 120}},
                     {"reference_hole", "H1"},
                     {"reference_in_table_mm", {0, 0, 0}},
                     {"direction_at_c0", {1, 0, 0}}});
  } else {
    artefact["balls"] = nlohmann::json::array({{{"id", "B1"}, {"diameter_mm", 25}, {"certified_mm", {0, 0, 0}}}});
  }
  machine_["artefacts"].push_back(artefact);
  showArtefact(static_cast<int>(machine_["artefacts"].size()) - 1);
  changed(tr("add an artefact"));
}

void ArtefactEditor::changed() {
  changed(tr("change the artefacts"));
}

void ArtefactEditor::changed(const QString& what) {
  nlohmann::json styli = nlohmann::json::array();
  for (int row = 0; row < styli_->rowCount(); ++row) {
    nlohmann::json s = nlohmann::json::object();
    if (row < static_cast<int>(machine_["styli"].size())) s = machine_["styli"][static_cast<std::size_t>(row)];
    s["id"] = textAt(styli_, row, 0).toStdString();
    s["radius_mm"] = numberOrText(textAt(styli_, row, 1));
    s["offset_mm"] = {numberOrText(textAt(styli_, row, 2)), numberOrText(textAt(styli_, row, 3)),
                      numberOrText(textAt(styli_, row, 4))};
    styli.push_back(s);
  }
  machine_["styli"] = styli;
  draft_.keep(what, partOf(context_.session.campaign()->machine.source), partOf(machine_));
  edited_ = true;
  of_another_ = false;
  check();
  showPreview();
}

void ArtefactEditor::check() {
  findings_ = checkStyli(machine_["styli"]);
  markCells(styli_, findings_, "styli", 0);
  if (choice_->currentIndex() >= 0) {
    const std::vector<ArtefactFinding> own = checkArtefact(current(), machine_["styli"]);
    fields_->mark(own);
    findings_.insert(findings_.begin(), own.begin(), own.end());
  }
  const auto wrong = std::count_if(findings_.begin(), findings_.end(), [](const auto& f) { return f.wrong; });
  apply_->setEnabled(edited_ && wrong == 0);
  discard_->setEnabled(edited_ || of_another_);
  verdict_->setAction({}, {});
  if (of_another_) {
    verdict_->show(Tone::Attention,
                   tr("Something was typed here for another state of the machine. Show it, or discard it."));
    verdict_->setAction(tr("Show it"), [this] {
      draft_.takeOver(partOf(context_.session.campaign()->machine.source));
      refresh();
    });
    return;
  }
  if (findings_.empty()) {
    verdict_->set(Tone::Neutral, machine_["artefacts"].empty()
                                     ? tr("The machine has no artefact yet. A touch probe needs one and its styli.")
                                     : QString());
    return;
  }
  QString sentence = coreSentence(findings_.front().sentence);
  if (findings_.size() > 1) sentence += tr(" And %1 more: look for the marks.").arg(findings_.size() - 1);
  verdict_->show(wrong > 0 ? Tone::Bad : Tone::Attention, sentence);
}

void ArtefactEditor::showPreview() {
  std::vector<ViewShape> shapes;
  std::vector<ViewPoint> labels;
  QString caption;
  try {
    const MachineDescription machine =
        MachineDescription::parse(JsonNode::parse(machine_.dump(), "machine as edited"), "machine as edited");
    if (choice_->currentIndex() >= 0) {
      const Artefact& artefact = machine.artefacts.at(static_cast<std::size_t>(choice_->currentIndex()));
      const Eigen::Vector3d first = shownFirstBall(machine);
      spindrift::gui::addArtefact(shapes, machine, artefact, first, 0.0);
      labels = featureLabels(machine, artefact, first, 0.0);
      if (!machine.styli.empty() && !labels.empty()) {
        const double above = artefact.balls.empty() ? 10.0 : artefact.balls.front().diameter_mm;
        addStyli(shapes, machine, machine.styli.front().id,
                 labels.front().position_mm + Eigen::Vector3d(0, 0, above + machine.styli.front().radius_mm));
      }
      caption = fromCore(artefact.id);
    }
  } catch (const InputError& e) {
    // What is wrong with a cell stands in the verdict; what only the picture needs is said here.
    if (findings_.empty()) verdict_->show(Tone::Attention, coreSentence(e.what()));
    view_->setCaption(tr("As it was before the mistake"));
    return;
  }
  view_->setShapes(std::move(shapes));
  view_->setPoints(std::move(labels));
  view_->setCaption(caption);
}

void ArtefactEditor::apply() {
  try {
    (void)MachineDescription::parse(JsonNode::parse(machine_.dump(), "machine as edited"), "machine as edited");
  } catch (const InputError& e) {
    verdict_->show(Tone::Bad, coreSentence(e.what()));
    return;
  }
  nlohmann::json machine = machine_;
  for (const char* key : edited_keys) {
    if (machine[key].empty()) machine.erase(key);
  }
  context_.undo.push(new ApplyCommand(context_.session, draft_.name(),
                                      std::make_unique<MachineCommand>(context_.session, std::move(machine))));
}

}  // namespace spindrift::gui
