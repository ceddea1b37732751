// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/verify/verify_page.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QSplitter>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/tasks/task_options.h"
#include "core/workflows/evaluate_campaign.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/common/table_angle.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/verify/verify_maps.h"
#include "widgets/panels/verify/verify_series.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

Tone toneOf(VerifyVerdict verdict) {
  switch (verdict) {
    case VerifyVerdict::Met:
      return Tone::Good;
    case VerifyVerdict::NotMet:
      return Tone::Bad;
    case VerifyVerdict::Undecided:
      return Tone::Attention;
    case VerifyVerdict::NotJudged:
      break;
  }
  return Tone::Neutral;
}

QString wordOf(VerifyVerdict verdict) {
  switch (verdict) {
    case VerifyVerdict::Met:
      return VerifyPage::tr("met");
    case VerifyVerdict::NotMet:
      return VerifyPage::tr("not met");
    case VerifyVerdict::Undecided:
      return VerifyPage::tr("not decided");
    case VerifyVerdict::NotJudged:
      break;
  }
  return VerifyPage::tr("not judged");
}

}  // namespace

VerifyPage::VerifyPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Verify, parent),
      options_(session(), context().undo, [this] { refresh(); }) {
  compare_ = makeButton(tr("Compare before and after"), nullptr, "primary");
  addAction(compare_);
  content()->addWidget(makeChoices());
  auto* left = new Card;
  auto* tiles = new QHBoxLayout;
  before_ = new NumberTile(tr("Before"));
  left_ = new NumberTile(tr("After"));
  verdict_ = new NumberTile(tr("Goal"));
  for (NumberTile* tile : {before_, left_, verdict_}) tiles->addWidget(tile, 1);
  left->body()->addLayout(tiles);
  components_ = new RowsModel(
      {tr("Component"), tr("rms before"), tr("rms after"), tr("Largest before"), tr("Largest after"), tr("Goal")},
      this);
  left->body()->addWidget(makeTable(components_, tr("Before and after of each component"),
                                    tr("Every component before and after appears here after the comparison.")),
                          2);
  points_title_ = makeLabel(tr("Points"), "sectionTitle");
  left->body()->addWidget(points_title_);
  points_ =
      new RowsModel({tr("Point"), tr("rms before"), tr("rms after"), tr("Largest before"), tr("Largest after")}, this);
  auto* point_table =
      makeTable(points_, tr("Before and after of each point"), tr("Every point appears here after the comparison."));
  stretchColumn(point_table, 0);
  left->body()->addWidget(point_table, 3);
  auto* right = new Card;
  auto* choice = new WrapLayout;
  shown_ = new Segments({tr("Every value"), tr("On the table")}, tr("How before and after are shown"));
  choice->addWidget(shown_);
  component_ = new QComboBox;
  component_->setAccessibleName(tr("Component that is drawn"));
  component_->setMinimumWidth(90);
  choice->addWidget(component_);
  angle_ = new TableAngleChoice(tr("Table at its worst angle"));
  choice->addWidget(angle_);
  right->body()->addLayout(choice);
  plot_ = new Plot;
  plot_->setEmptyText(tr("Before and after will appear here"),
                      tr("Choose the campaign that was measured with the compensation on, then compare."));
  maps_ = new VerifyMaps;
  stack_ = new QStackedWidget;
  stack_->addWidget(plot_);
  stack_->addWidget(maps_);
  right->body()->addWidget(stack_, 1);
  content()->addWidget(makeSplitter(this, left, right, 9, 5), 1);
  showHints(plot_);
  connect(compare_, &QPushButton::clicked, this, [this] { runAll(); });
  connect(component_, &QComboBox::activated, this, [this](int) {
    showPlot();
    showMaps();
  });
  connect(angle_, &QComboBox::activated, this, [this](int) { showPlot(); });
  connect(shown_, &Segments::chosen, this, [this] { setShown(shown_->current()); });
  connect(maps_, &VerifyMaps::stateChosen, this, [this] {
    showPoints();
    showMaps();
  });
  connect(point_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this, [this](const QModelIndex& now) {
    for (const int side : {0, 1}) maps_->view(side)->setSelected(points_->idAt(now.row()));
  });
  for (const int side : {0, 1}) {
    connect(maps_->view(side), &View3D::pointPicked, this, [this, point_table](const QString& id) {
      const int row = points_->rowOf(id);
      if (row >= 0) point_table->selectRow(row);
    });
  }
}

void VerifyPage::setShown(int index) {
  shown_->setCurrent(index);
  stack_->setCurrentIndex(index);
  angle_->setVisible(index == 0 && angle_->several());
  showPoints();
  showMaps();
}

QString VerifyPage::pointsTitle() const {
  return points_title_->text();
}

double VerifyPage::shownAngle(Component component) const {
  if (stack_->currentIndex() == 1) return maps_->pose().value_or(worstPose(*result_, component)).c_deg;
  return angle_->chosen().value_or(worstPose(*result_, component).c_deg);
}

QWidget* VerifyPage::makeChoices() {
  auto* box = new QWidget;
  auto* line = new WrapLayout;
  box->setLayout(line);
  // A label stays with what it names when the line goes on below.
  const auto group = [line] {
    auto* together = new QWidget;
    auto* inner = new QHBoxLayout(together);
    inner->setContentsMargins(0, 0, 0, 0);
    line->addWidget(together);
    return inner;
  };
  auto* campaign = group();
  campaign->addWidget(new QLabel(tr("Measured again in")));
  after_ = new QComboBox;
  after_->setAccessibleName(tr("Campaign measured with the compensation on"));
  after_->setMinimumWidth(220);
  campaign->addWidget(after_);
  auto* choose = makeButton(tr("Folder …"), nullptr);
  choose->setAccessibleName(tr("Choose the folder of a campaign"));
  campaign->addWidget(choose);
  const auto goal = [&](const QString& text, const QString& name, const QString& unit, double most) {
    auto* inner = group();
    inner->addWidget(new QLabel(text));
    auto* spin = new QuantityBox(unit, 1);
    spin->setAccessibleName(name);
    spin->setRange(0, most);
    spin->setMinimumHeight(sizes::control_height);
    spin->setKeyboardTracking(false);
    inner->addWidget(spin);
    return spin;
  };
  goal_um_ = goal(tr("Displacements within"), tr("Goal of displacements"), QStringLiteral("um"), 1000);
  goal_um_->setMinimum(0.1);
  goal_urad_ = goal(tr("rotations within"), tr("Goal of rotations"), QStringLiteral("urad"), 10000);
  goal_urad_->setSpecialValueText(tr("none"));
  auto* criterion = group();
  criterion->addWidget(new QLabel(tr("for the")));
  criterion_ = new QComboBox;
  criterion_->setAccessibleName(tr("What the goal bounds"));
  criterion_->addItems({tr("largest value"), tr("rms")});
  criterion->addWidget(criterion_);
  connect(after_, &QComboBox::activated, this, [this](int) {
    options_.change(tr("choose the second campaign"),
                    [this](VerifyOptions& o) { o.after = after_->currentData().toString().toStdString(); });
  });
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Campaign measured with the compensation on"));
    if (!folder.isEmpty()) setAfter(folder);
  });
  connect(goal_um_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    options_.change(tr("set the goal"), [value](VerifyOptions& o) { o.request.goal_um = value; });
  });
  connect(goal_urad_, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    options_.change(tr("set the goal"), [value](VerifyOptions& o) { o.request.goal_urad = value; });
  });
  connect(criterion_, &QComboBox::activated, this, [this](int index) {
    options_.change(tr("choose what the goal bounds"), [index](VerifyOptions& o) {
      o.request.criterion = index == 1 ? VerifyCriterion::Rms : VerifyCriterion::Largest;
    });
  });
  return box;
}

void VerifyPage::setAfter(const QString& folder) {
  const std::string name = placeName(*session().session(), folder.toStdString());
  options_.change(tr("choose the second campaign"), [&](VerifyOptions& o) { o.after = name; });
}

void VerifyPage::fillChoices() {
  const VerifyOptions now = options_.now();
  const Session& store = *session().session();
  const auto nameOf = [&](const std::filesystem::path& folder) { return fromCore(placeName(store, folder)); };
  // Earlier versions kept where it was then.
  const QString chosen = now.after.empty() ? QString() : nameOf(placeNamed(store, now.after));
  after_->clear();
  after_->addItem(tr("this campaign, while compensating"), nameOf(session().campaign()->folder));
  for (const CampaignRecord& record : session().campaigns()) {
    if (record.id != session().campaignId()) after_->addItem(shownName(record.name), nameOf(record.folder));
  }
  if (!chosen.isEmpty() && after_->findData(chosen) < 0) after_->addItem(QFileInfo(chosen).fileName(), chosen);
  after_->setCurrentIndex(chosen.isEmpty() ? -1 : after_->findData(chosen));
  after_->setPlaceholderText(tr("choose a campaign"));
  goal_um_->setValue(now.request.goal_um);
  goal_urad_->setValue(now.request.goal_urad);
  criterion_->setCurrentIndex(now.request.criterion == VerifyCriterion::Rms ? 1 : 0);
}

void VerifyPage::runAll() {
  if (!options_.now().after.empty()) runTask("verify");
}

void VerifyPage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  if (noticeCampaign()) {
    result_.reset();
    showResult();
  }
  options_.fill([this] { fillChoices(); });
  const bool chosen = !options_.now().after.empty();
  const bool measured = session().observations() != nullptr;
  compare_->setEnabled(chosen && measured && canRun("verify"));
  const ShownTask stored = shown("verify", tr("Reading the comparison"));
  if (stored.reading) return;
  result_ = stored.as<VerifyResult>();
  if (!measured) {
    callout()->set(Tone::Neutral, context().workflow.status(StepId::Verify).sentence);
  } else if (!chosen) {
    callout()->show(Tone::Accent,
                    tr("Load the corrections into the control, switch the compensation on and measure the same plan "
                       "again. Then choose that campaign here; its log says compensation_on = 1."));
  } else if (result_ == nullptr) {
    callout()->show(stored.state.there ? Tone::Outdated : Tone::Accent, tr("Press Compare before and after."));
  } else if (!stored.state.current) {
    callout()->show(Tone::Outdated, tr("Changed since: %1. Compare again.").arg(stored.state.changed));
  } else {
    QString text = coreSentence(result_->reason);
    for (const std::string& note : result_->notes) text += QLatin1Char(' ') + coreSentence(note);
    callout()->show(toneOf(result_->verdict), text);
  }
  showResult();
}

void VerifyPage::showResult() {
  std::vector<Row> rows;
  const QString chosen = component_->currentText();
  component_->clear();
  component_->setVisible(result_ != nullptr);
  if (result_ == nullptr) angle_->hide();
  if (result_ == nullptr) {
    components_->setRows({});
    for (NumberTile* tile : {before_, left_, verdict_}) tile->set(QStringLiteral("–"));
    showPlot();
    showMaps();
    return;
  }
  const bool largest = result_->request.criterion == VerifyCriterion::Largest;
  const VerifyComponent* worst = nullptr;
  for (const VerifyComponent& c : result_->components) {
    const QString name = fromCore(std::string(toString(c.component)));
    const QString unit = unitText(unitOf(c.component));
    component_->addItem(name);
    Row row;
    row.id = name;
    const auto cell = [&](double value, double sigma, const QString& tip = {}) {
      Cell out{quantityText(value, sigma, {})};
      out.right = true;
      out.unit = unit;
      out.tip = tip;
      return out;
    };
    Cell named = nameCell(QStringLiteral("%1 / %2").arg(name, unit));
    named.unit = unit;
    named.tip = tr("%n values compared", nullptr, static_cast<int>(c.values));
    row.cells = {named,
                 cell(c.before.rms, c.before.rms_sigma),
                 cell(c.after.rms, c.after.rms_sigma),
                 cell(c.before.largest, c.before.largest_sigma, fromCore(c.before.largest_at)),
                 cell(c.after.largest, c.after.largest_sigma, fromCore(c.after.largest_at)),
                 toneCell(wordOf(c.verdict), toneOf(c.verdict))};
    rows.push_back(std::move(row));
    const auto size = [&](const VerifyComponent& x) { return largest ? x.after.largest : x.after.rms; };
    if (!isRotation(c.component) && (worst == nullptr || size(c) > size(*worst))) worst = &c;
  }
  components_->setRows(std::move(rows));
  if (worst != nullptr) {
    const QString name = fromCore(std::string(toString(worst->component)));
    const auto text = [&](const VerifyFigures& f) {
      return largest ? quantityText(f.largest, f.largest_sigma, tr("µm")) : quantityText(f.rms, f.rms_sigma, tr("µm"));
    };
    before_->set(text(worst->before), largest ? tr("largest %1").arg(name) : tr("rms %1").arg(name));
    left_->set(text(worst->after), largest ? tr("largest %1").arg(name) : tr("rms %1").arg(name));
    if (chosen.isEmpty()) component_->setCurrentText(name);
  }
  verdict_->set(wordOf(result_->verdict), tr("goal %1 µm").arg(decimalText(result_->request.goal_um, 'g', 3)),
                toneOf(result_->verdict));
  if (component_->findText(chosen) >= 0) component_->setCurrentText(chosen);
  maps_->setPoses(posesOf(*result_));
  angle_->setAngles(anglesOf(*result_));
  angle_->setVisible(stack_->currentIndex() == 0 && angle_->several());
  showPlot();
  showMaps();
}

void VerifyPage::showMaps() {
  if (result_ == nullptr) return maps_->clear();
  if (stack_->currentIndex() != 1) return;
  const auto component = componentFromString(component_->currentText().toStdString());
  if (!component) return;
  const double goal = result_->goal(*component);
  display(tr("Drawing before and after"),
          [this, result = result_, campaign = session().campaign(), component = *component, pose = maps_->pose(),
           goal](JobContext&) -> std::function<void()> {
            auto map = std::make_shared<VerifyMap>(verifyMap(*result, campaign->machine, component, pose));
            return [this, result, campaign, map, goal] {
              if (result == result_) maps_->show(*map, campaign->machine, goal);
            };
          });
}

void VerifyPage::showPlot() {
  showPoints();
  const auto component = componentFromString(component_->currentText().toStdString());
  if (result_ == nullptr || !component) return plot_->setContent({});
  const double c_deg = angle_->chosen().value_or(worstPose(*result_, *component).c_deg);
  VerifyCurves curves = verifyCurves(*result_, *component, c_deg);
  plot_->setAxes(angle_->several() ? withTableAngle(curves.x_title, c_deg) : curves.x_title, curves.y_title);
  plot_->setContent(std::move(curves.series));
}

void VerifyPage::showPoints() {
  const auto component = componentFromString(component_->currentText().toStdString());
  if (result_ == nullptr || !component) {
    points_title_->setText(tr("Points"));
    points_->setRows({});
    return;
  }
  const double c_deg = shownAngle(*component);
  const QString heading = tr("%1 at the points").arg(component_->currentText());
  points_title_->setText(angle_->several() ? withTableAngle(heading, c_deg) : heading);
  display(tr("Reading the points"),
          [this, result = result_, component = *component, c_deg](JobContext&) -> std::function<void()> {
            return [this, result, component, c_deg, figures = verifyFiguresOfPoints(*result, component, c_deg)] {
              if (result != result_ || shownAngle(component) != c_deg) return;
              points_->setRows(verifyPointRows(figures, component, result->goal(component)));
            };
          });
}

std::vector<Exportable> VerifyPage::exportables() {
  if (result_ == nullptr) return {};
  std::vector<Exportable> items{exportableOf(tr("Before and after"), components_),
                                exportableOf(tr("Points before and after"), points_),
                                exportableOf(tr("Values before and after"), plot_)};
  if (!maps_->view(0)->empty()) {
    items.push_back(exportableOf(tr("Before on the table"), maps_->view(0)));
    items.push_back(exportableOf(tr("After on the table"), maps_->view(1)));
  }
  return items;
}

}  // namespace spindrift::gui
