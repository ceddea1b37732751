// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/thermal/thermal_model_page.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/unit_text.h"
#include "core/base/units.h"
#include "core/tasks/task_options.h"
#include "core/thermal/response_fit.h"
#include "core/workflows/campaign_series.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/thermal/iso_panel.h"
#include "widgets/panels/thermal/update_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr std::array<const char*, 3> methods{"response", "arx", "oe"};

}  // namespace

ThermalModelPage::ThermalModelPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Model, parent),
      options_(session(), context().undo, [this] { refresh(); }),
      iso_options_(session(), context().undo, [this] { refresh(); }) {
  setInstruction(tr("Train a model over time on one part of the log and judge it in free run on another."));
  identify_ = makeButton(tr("Identify the model"), nullptr, "primary");
  addModelSwitch(false);
  addAction(identify_);
  content()->addWidget(makeChoices());
  auto* top = new Card;
  what_ = new Segments({tr("Output"), tr("Inputs"), tr("Residual")}, tr("What is drawn"));
  top->body()->addWidget(what_);
  auto* tiles = new QHBoxLayout;
  rms_ = new NumberTile(tr("Test, rms"));
  fit_ = new NumberTile(tr("Test, fit"));
  p2p_ = new NumberTile(tr("Test, peak to peak"));
  for (NumberTile* tile : {rms_, fit_, p2p_}) tiles->addWidget(tile, 1);
  top->body()->addLayout(tiles);
  series_plot_ = new Plot;
  series_plot_->setSpansMovable(true);
  series_plot_->setEmptyText(tr("The log will appear here"),
                             tr("It needs a log with at least one displacement (a column ending in _um or _urad)."));
  top->body()->addWidget(series_plot_, 1);
  content()->addWidget(makeSplitter(this, top, makeDetails(), 6, 8), 1);
  for (Plot* plot : {series_plot_, step_plot_, residual_plot_, updates_->plot(), iso_->plot(), iso_->plot(true)})
    showHints(plot);

  connect(identify_, &QPushButton::clicked, this, [this] { runTask("thermal"); });
  connect(what_, &Segments::chosen, this, &ThermalModelPage::showSeries);
  connect(series_plot_, &Plot::spanMoved, this, [this](int index, double from, double to) {
    changeRange(index == 0, from * seconds_per_hour, to * seconds_per_hour);
  });
}

QWidget* ThermalModelPage::makeChoices() {
  auto* box = new QWidget;
  auto* line = new QHBoxLayout(box);
  line->setContentsMargins(0, 0, 0, 0);
  line->addWidget(new QLabel(tr("Output")));
  output_ = new QComboBox;
  output_->setAccessibleName(tr("Measured output"));
  output_->setMinimumWidth(160);
  line->addWidget(output_);
  line->addWidget(new QLabel(tr("Method")));
  method_ = new QComboBox;
  method_->setAccessibleName(tr("How the model is found"));
  method_->addItems({tr("All time constants"), tr("ARX"), tr("Output error")});
  line->addWidget(method_);
  line->addStretch();
  const std::array<QString, 4> names{tr("Training from"), tr("Training to"), tr("Test from"), tr("Test to")};
  for (std::size_t i = 0; i < 4; ++i) {
    if (i % 2 == 0) line->addWidget(new QLabel(i == 0 ? tr("Train") : tr("Test")));
    auto* edge = new QDoubleSpinBox;
    edge->setAccessibleName(names[i]);
    edge->setDecimals(2);
    edge->setRange(0, 1e5);
    edge->setSuffix(QStringLiteral(" h"));
    edge->setMinimumHeight(sizes::control_height);
    edge->setKeyboardTracking(false);
    edges_[i] = edge;
    line->addWidget(edge);
    if (i % 2 == 0) line->addWidget(new QLabel(QStringLiteral("–")));
    connect(edge, &QDoubleSpinBox::valueChanged, this, [this, i](double) {
      if (options_.filling()) return;
      const std::size_t first = i < 2 ? 0 : 2;
      changeRange(i < 2, edges_[first]->value() * seconds_per_hour, edges_[first + 1]->value() * seconds_per_hour);
    });
  }
  connect(output_, &QComboBox::activated, this, [this](int) {
    options_.change(tr("choose the output"),
                    [this](ThermalChoice& o) { o.output = output_->currentText().toStdString(); });
  });
  connect(method_, &QComboBox::activated, this, [this](int index) {
    options_.change(tr("choose the method"),
                    [index](ThermalChoice& o) { o.method = methods[static_cast<std::size_t>(index)]; });
  });
  return box;
}

QWidget* ThermalModelPage::makeDetails() {
  auto* card = new Card;
  tabs_ = makeTabs(card);
  comparison_ = new RowsModel({tr("Model"), tr("Train rms"), tr("Test rms"), tr("Fit / %"), tr("Peak to peak")}, this);
  tabs_->addTab(
      makeTable(comparison_, tr("Comparison"),
                tr("After the identification the model is compared with no model and with a static regression.")),
      tr("Compare"));
  inputs_ = new RowsModel({tr("Input"), tr("Verdict"), tr("Part, rms"), tr("Without / %")}, this);
  tabs_->addTab(makeTable(inputs_, tr("Inputs"), tr("The signals of the log appear here.")), tr("Inputs"));
  auto* step = new QWidget;
  auto* step_column = new QVBoxLayout(step);
  step_column->setContentsMargins(0, 8, 0, 0);
  auto* step_line = new QHBoxLayout;
  step_line->addWidget(new QLabel(tr("Input")));
  step_input_ = new QComboBox;
  step_input_->setAccessibleName(tr("Input whose step response is shown"));
  step_input_->setMinimumWidth(160);
  step_line->addWidget(step_input_);
  step_line->addStretch();
  step_column->addLayout(step_line);
  step_plot_ = new Plot;
  step_plot_->setEmptyText(tr("Step responses will appear here"),
                           tr("Identify the model: the answer to a step of each input with its uncertainty."));
  step_column->addWidget(step_plot_, 1);
  tabs_->addTab(step, tr("Step response"));
  lags_ = new RowsModel({tr("Input"), tr("Time constant"), tr("Pole / (1/h)"), tr("Gain"), tr("Unit")}, this);
  tabs_->addTab(makeTable(lags_, tr("Time constants"),
                          tr("Poles as time constants with their gains appear after the identification.")),
                tr("Time constants"));
  auto* residuals = new QWidget;
  auto* column = new QVBoxLayout(residuals);
  column->setContentsMargins(0, 8, 0, 0);
  whiteness_ = new Callout;
  column->addWidget(whiteness_);
  residual_plot_ = new Plot;
  residual_plot_->setAxes(tr("Lag / min"), tr("Autocorrelation"));
  residual_plot_->setEmptyText(tr("The autocorrelation of the residual will appear here"),
                               tr("Identify the model: its residual in training should be white noise."));
  cross_ = new RowsModel({tr("Input"), tr("Largest correlation"), tr("Limit, 99 %")}, this);
  column->addWidget(makeSplitter(residuals, residual_plot_,
                                 makeTable(cross_, tr("Residual against inputs"),
                                           tr("How the residual depends on each input appears here.")),
                                 6, 5, Qt::Vertical),
                    1);
  tabs_->addTab(residuals, tr("Residuals"));
  updates_ = new UpdatePanel([this](const QString& title, UpdatePanel::Work work) { run(title, std::move(work)); });
  tabs_->addTab(updates_, tr("Updates"));
  iso_ = new IsoPanel;
  connect(iso_, &IsoPanel::chosen, this, [this](const Iso230Choice& choice) {
    iso_options_.change(tr("choose the test of ISO 230-3"), [&](Iso230Choice& o) { o = choice; });
  });
  tabs_->addTab(iso_, QStringLiteral("ISO 230-3"));
  connect(tabs_, &QTabWidget::currentChanged, this, [this](int) {
    tested_.clear();
    showStandardTest();
  });
  card->body()->addWidget(tabs_, 1);
  connect(step_input_, &QComboBox::activated, this, &ThermalModelPage::showStep);
  connect(inputs_, &RowsModel::checkedChanged, this, [this](const QString&, int, bool) {
    std::vector<std::string> chosen;
    for (const Row& row : inputs_->rows()) {
      if (row.cells[0].checked.value_or(false)) chosen.push_back(row.id.toStdString());
    }
    if (chosen.empty()) return fillInputs();  // a model without inputs is none
    options_.change(tr("choose the inputs"), [&](ThermalChoice& o) { o.inputs = chosen; });
  });
  return card;
}

void ThermalModelPage::changeRange(bool train, double from_s, double to_s) {
  if (series_ == nullptr) return;
  const double first = series_->time_s.front();
  const double last = series_->time_s.back();
  from_s = std::clamp(std::round(from_s), first, last);
  to_s = std::clamp(std::round(to_s), first, last);
  if (!(to_s > from_s)) return refresh();
  options_.change(train ? tr("training range") : tr("test range"), [&](ThermalChoice& o) {
    (train ? o.train : o.test) = TimeRange{from_s, to_s};
  });
}

IdentifyRequest ThermalModelPage::request() const {
  return series_ == nullptr ? IdentifyRequest() : options_.now().request(*series_);
}

std::string ThermalModelPage::inputsKey() {
  const auto evaluated = session().evaluation();
  return session().inputsKey() + "|" + std::to_string(evaluated == nullptr ? 0 : evaluated->id);
}

void ThermalModelPage::load() {
  loaded_ = inputsKey();
  series_.reset();
  result_.reset();
  failure_.clear();
  clear();
  display(tr("Reading the log"),
          [this, snapshot = session().snapshot(), observations = session().observations(),
           key = loaded_](JobContext& job) -> std::function<void()> {
            auto series = std::make_shared<TimeSeries>();
            std::map<std::string, double> sigma;
            std::string failure;
            try {
              CampaignSeries all = campaignSeries(*snapshot.campaign, observations ? &*observations : nullptr, job);
              *series = std::move(all.series);
              sigma = std::move(all.sigma);
              if (series->time_s.size() < 2) failure = "the log has a single row.";
            } catch (const InputError& e) {
              failure = e.what();
            }
            return [this, series, sigma, failure, key] {
              if (key != loaded_) return;
              failure_ = coreSentence(failure);
              sigma_ = sigma;
              if (failure.empty()) series_ = series;
              refresh();
            };
          });
}

TaskInputs ThermalModelPage::taskInputs() {
  TaskInputs inputs = session().taskInputs();
  if (loaded_ == inputsKey()) inputs.series = series_;
  return inputs;
}

void ThermalModelPage::clear() {
  for (RowsModel* rows : {comparison_, inputs_, lags_, cross_}) rows->setRows({});
  for (Plot* plot : {series_plot_, step_plot_, residual_plot_}) plot->setContent({});
  step_input_->clear();
  whiteness_->set(Tone::Neutral, {});
  for (NumberTile* tile : {rms_, fit_, p2p_}) tile->set(QStringLiteral("–"));
}

void ThermalModelPage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  if (loaded_ != inputsKey()) load();
  identify_->setEnabled(series_ != nullptr);
  if (series_ == nullptr) {
    callout()->set(Tone::Bad, failure_);
    return;
  }
  options_.fill([this] { fillChoices(); });
  showStandardTest();
  const auto sigma = sigma_.find(request().output);
  const ShownTask stored = shown("thermal", tr("Reading the model"));
  if (!stored.reading) result_ = stored.as<IdentifyResult>();
  updates_->set(series_, result_, sigma == sigma_.end() ? 0.5 : sigma->second);
  if (stored.reading) return showSeries();
  const ResultState& state = stored.state;
  if (result_ == nullptr) {
    callout()->show(state.there ? Tone::Outdated : Tone::Accent,
                    state.there ? tr("Changed since: %1. Identify the model again.").arg(state.changed)
                                : tr("Drag the edges of the training and the test range, then press Identify the "
                                     "model. Nothing measured in the test range is used."));
  } else if (!state.current) {
    callout()->show(Tone::Outdated, tr("Changed since: %1. Identify the model again.").arg(state.changed));
  } else if (!result_->good_enough) {
    callout()->show(Tone::Attention, tr("In the test range the model is no better than the baselines. Train on a "
                                        "longer range with more excitation, or choose other inputs."));
  } else {
    callout()->show(Tone::Good,
                    tr("Free run over the test range: rms %1 %2, without a model %3 %2.")
                        .arg(decimalText(result_->test.rmse, 'g', 3))
                        .arg(outputUnit())
                        .arg(decimalText(result_->plain.empty() ? 0.0 : result_->plain.front().test.rmse, 'g', 3)));
  }
  fillInputs();
  showSeries();
  showResult();
}

void ThermalModelPage::showStandardTest() {
  if (series_ == nullptr) return;
  iso_->set(series_, iso_options_.now());
  if (tabs_->currentWidget() != iso_) return;
  const ShownTask test = shown("iso-230-3", tr("Reading the test of ISO 230-3"));
  iso_->show(test.state.current ? test.as<StandardTest>() : nullptr);  // not numbers of another choice beside this one
  if (test.reading || test.state.current) return;
  // Once for what is chosen: a test that was cancelled is not begun again by what shows it.
  std::string asked = inputsKey() + "|" + optionsJson(iso_options_.now()).dump();
  if (std::exchange(tested_, asked) != asked) runAlone("iso-230-3");
}

QString ThermalModelPage::outputUnit() const {
  return unitText(unitOfSignal(request().output));
}

void ThermalModelPage::fillChoices() {
  const IdentifyRequest now = request();
  output_->clear();
  for (const std::string& name : outputSignals(*series_)) output_->addItem(fromCore(name));
  output_->setCurrentText(fromCore(now.output));
  const auto method = std::find(methods.begin(), methods.end(), now.method);
  const Signal* measured = series_->find(now.output);
  const bool sparse = measured != nullptr && isSparse(*measured);
  method_->setEnabled(!sparse);
  method_->setToolTip(sparse ? tr("Measured at few rows only: ARX and output error need a value at nearly every one")
                             : QString());
  method_->setCurrentIndex(method == methods.end() ? 0 : static_cast<int>(method - methods.begin()));
  const std::array<double, 4> edges{now.train.from_s, now.train.to_s, now.test.from_s, now.test.to_s};
  for (std::size_t i = 0; i < 4; ++i) {
    edges_[i]->setRange(series_->time_s.front() / seconds_per_hour, series_->time_s.back() / seconds_per_hour);
    edges_[i]->setValue(edges[i] / seconds_per_hour);
  }
}

}  // namespace spindrift::gui
