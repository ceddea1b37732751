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
#include "core/thermal/response_fit.h"
#include "core/workflows/log_campaign.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/common/cells.h"
#include "widgets/plots/plot.h"

namespace spindrift::gui {
namespace {

constexpr auto options_key = "thermal-model";
constexpr double seconds_per_hour = 3600.0;
constexpr std::array<const char*, 3> methods{"response", "arx", "oe"};

std::vector<double> hours(const std::vector<double>& time_s) {
  std::vector<double> out;
  out.reserve(time_s.size());
  for (const double t : time_s) out.push_back(t / seconds_per_hour);
  return out;
}

/// Time constants from seconds to hours as people read them.
QString durationText(double seconds, double sigma_s) {
  if (!std::isfinite(seconds)) return QStringLiteral("–");
  const TimeUnit unit = timeUnit(seconds);
  if (!(sigma_s > 0)) return QStringLiteral("%1 %2").arg(seconds / unit.seconds, 0, 'g', 3).arg(unit.name);
  return quantityText(seconds / unit.seconds, sigma_s / unit.seconds, unit.name);
}

double numberAt(const nlohmann::json& json, const char* key) {
  const nlohmann::json value = json.value(key, nlohmann::json());
  return value.is_number() ? value.get<double>() : std::nan("");
}

}  // namespace

ThermalModelPage::ThermalModelPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Model, parent) {
  setInstruction(tr("Train a model over time on one part of the log and judge it in free run on another."));
  identify_ = makeButton(tr("Identify the model"), nullptr, "primary");
  addAction(identify_);
  content()->addWidget(makeChoices());
  auto* top = new Card;
  what_ = new Segments({tr("Output"), tr("Inputs"), tr("Left over")}, tr("What is drawn"));
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
  content()->addWidget(makeSplitter(top, makeDetails(), 6, 6), 1);
  for (Plot* plot : {series_plot_, step_plot_, residual_plot_}) showHints(plot);

  connect(identify_, &QPushButton::clicked, this, [this] { identify(true); });
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
  output_->setMinimumWidth(120);
  line->addWidget(output_);
  line->addWidget(new QLabel(tr("Method")));
  method_ = new QComboBox;
  method_->setAccessibleName(tr("How the model is found"));
  method_->addItems({tr("All lags"), tr("ARX"), tr("Output error")});
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
      if (filling_) return;
      const std::size_t first = i < 2 ? 0 : 2;
      changeRange(i < 2, edges_[first]->value() * seconds_per_hour, edges_[first + 1]->value() * seconds_per_hour);
    });
  }
  connect(output_, &QComboBox::activated, this, [this](int) {
    changeOptions(tr("choose the output"), {{"output", output_->currentText().toStdString()}});
  });
  connect(method_, &QComboBox::activated, this, [this](int index) {
    changeOptions(tr("choose the method"), {{"method", methods[static_cast<std::size_t>(index)]}});
  });
  return box;
}

QWidget* ThermalModelPage::makeDetails() {
  auto* card = new Card;
  tabs_ = makeTabs();
  comparison_ = new RowsModel({tr("Model"), tr("Train rms"), tr("Test rms"), tr("Fit / %"), tr("p2p")}, this);
  tabs_->addTab(makeTable(comparison_, tr("Comparison"),
                          tr("The model stands beside no model and a static regression after the identification.")),
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
  tabs_->addTab(step, tr("Step"));
  lags_ = new RowsModel({tr("Input"), tr("Time constant"), tr("Gain"), tr("Unit")}, this);
  tabs_->addTab(makeTable(lags_, tr("Time constants"),
                          tr("Poles as time constants with their gains appear after the identification.")),
                tr("Lags"));
  auto* residuals = new QWidget;
  auto* column = new QVBoxLayout(residuals);
  column->setContentsMargins(0, 8, 0, 0);
  whiteness_ = new Callout;
  column->addWidget(whiteness_);
  residual_plot_ = new Plot;
  residual_plot_->setAxes(tr("Lag / min"), tr("Autocorrelation"));
  residual_plot_->setEmptyText(tr("The autocorrelation of the residual will appear here"),
                               tr("Identify the model: what it leaves over in training should look like noise."));
  cross_ = new RowsModel({tr("Input"), tr("Largest correlation"), tr("Limit, 99 %")}, this);
  column->addWidget(makeSplitter(residual_plot_,
                                 makeTable(cross_, tr("Residual against inputs"),
                                           tr("How the residual goes with each input appears here.")),
                                 6, 5, Qt::Vertical),
                    1);
  tabs_->addTab(residuals, tr("Residuals"));
  card->body()->addWidget(tabs_, 1);
  connect(step_input_, &QComboBox::activated, this, &ThermalModelPage::showStep);
  connect(inputs_, &RowsModel::checkedChanged, this, [this](const QString&, int, bool) {
    nlohmann::json chosen = nlohmann::json::array();
    for (const Row& row : inputs_->rows()) {
      if (row.cells[0].checked.value_or(false)) chosen.push_back(row.id.toStdString());
    }
    if (chosen.empty()) return fillInputs();  // a model without inputs is none
    changeOptions(tr("choose the inputs"), {{"inputs", chosen}});
  });
  return card;
}

nlohmann::json ThermalModelPage::optionsJson() const {
  auto* self = const_cast<ThermalModelPage*>(this);
  const std::string key = options_key + ("/" + std::to_string(self->session().campaignId()));
  const nlohmann::json stored = self->session().setting(key, nlohmann::json::object());
  return stored.is_object() ? stored : nlohmann::json::object();
}

void ThermalModelPage::changeOptions(const QString& what, const nlohmann::json& change) {
  if (filling_) return;
  nlohmann::json after = optionsJson();
  after.update(change);
  if (after == optionsJson()) return;
  const std::string key = options_key + ("/" + std::to_string(session().campaignId()));
  context().undo.push(new OptionsCommand(session(), what, key, after, [this] { refresh(); }));
}

void ThermalModelPage::changeRange(bool train, double from_s, double to_s) {
  if (series_ == nullptr) return;
  const double first = series_->time_s.front();
  const double last = series_->time_s.back();
  from_s = std::clamp(std::round(from_s), first, last);
  to_s = std::clamp(std::round(to_s), first, last);
  if (!(to_s > from_s)) return refresh();
  changeOptions(train ? tr("training range") : tr("test range"), {{train ? "train" : "test", {from_s, to_s}}});
}

IdentifyRequest ThermalModelPage::request() const {
  IdentifyRequest r;
  if (series_ == nullptr) return r;
  const nlohmann::json json = optionsJson();
  const std::vector<std::string> outputs = outputSignals(*series_);
  r.log = series_->file;
  r.output = json.value("output", std::string());
  if (std::find(outputs.begin(), outputs.end(), r.output) == outputs.end() && !outputs.empty())
    r.output = outputs.front();
  const double first = series_->time_s.front();
  const double last = series_->time_s.back();
  const double middle = std::round(0.5 * (first + last));
  const auto range = [&](const char* key, double from, double to) {
    const nlohmann::json value = json.value(key, nlohmann::json());
    if (value.is_array() && value.size() == 2) return TimeRange{value[0].get<double>(), value[1].get<double>()};
    return TimeRange{from, to};
  };
  r.train = range("train", first, middle);
  r.test = range("test", middle, last);
  r.method = json.value("method", std::string("response"));
  for (const auto& name : json.value("inputs", nlohmann::json::array())) {
    const auto text = name.get<std::string>();
    if (series_->find(text) != nullptr && text != r.output) r.inputs.push_back(text);
  }
  return r;
}

void ThermalModelPage::load() {
  const auto campaign = session().campaign();
  loaded_ = campaign->folder.string();
  series_.reset();
  result_.reset();
  failure_.clear();
  clear();
  const std::filesystem::path file = campaign->path("log.csv");
  if (!std::filesystem::exists(file)) {
    failure_ = tr("This campaign has no log.csv.");
    return;
  }
  run(tr("Reading the log"), [this, file, folder = loaded_](JobContext&) -> std::function<void()> {
    auto series = std::make_shared<TimeSeries>();
    std::string failure;
    try {
      *series = readTimeSeries(file);
      if (series->time_s.size() < 2 || outputSignals(*series).empty())
        failure = "the log holds no displacement over time.";
    } catch (const InputError& e) {
      failure = e.what();
    }
    return [this, series, failure, folder] {
      if (folder != loaded_) return;
      failure_ = QString::fromStdString(failure);
      if (failure.empty()) series_ = series;
      refresh();
      if (std::exchange(wanted_, false)) identify(true);
    };
  });
}

void ThermalModelPage::runAll() {
  wanted_ = series_ == nullptr;
  identify(true);
}

void ThermalModelPage::identify(bool store) {
  if (series_ == nullptr) return;
  const IdentifyRequest asked = request();
  run(tr("Identifying the model"),
      [this, series = series_, asked, store, json = optionsJson(),
       folder = loaded_](JobContext& job) -> std::function<void()> {
        auto result = std::make_shared<IdentifyResult>(identifyThermalModel(*series, asked, job));
        return [this, result, store, json, folder] {
          if (folder != loaded_) return;
          result_ = result;
          result_options_ = json;
          if (store) session().storeResult("thermal", {{"model", "thermal"}, {"options", json}}, result->json());
          refresh();
        };
      });
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
  if (loaded_ != campaign->folder.string()) load();
  identify_->setEnabled(series_ != nullptr);
  if (series_ == nullptr) {
    callout()->set(Tone::Bad, failure_);
    return;
  }
  fillChoices();
  const ResultState state = session().state("thermal");
  if (result_ == nullptr && state.there) {
    const nlohmann::json options = session().result("thermal")->provenance.options.value("options", nlohmann::json());
    if (state.current && options == optionsJson()) {
      identify(false);
      showSeries();
      return;
    }
  }
  if (result_ == nullptr) {
    callout()->show(state.there ? Tone::Outdated : Tone::Accent,
                    state.there ? tr("Ranges or choices have changed since. Identify the model again.")
                                : tr("Drag the edges of the training and the test range, then press Identify the "
                                     "model. Nothing measured in the test range is used."));
  } else if (!state.current || result_options_ != optionsJson()) {
    callout()->show(Tone::Outdated, tr("Ranges or choices have changed since. Identify the model again."));
  } else if (!result_->good_enough) {
    callout()->show(Tone::Attention, tr("In the test range the model is no better than the plain ones. Train on a "
                                        "longer or livelier part, or choose other inputs."));
  } else {
    callout()->show(Tone::Good, tr("Free run over the test range: rms %1 %2, without a model %3 %2.")
                                    .arg(result_->test.rmse, 0, 'g', 3)
                                    .arg(outputUnit())
                                    .arg(result_->plain.empty() ? 0.0 : result_->plain.front().test.rmse, 0, 'g', 3));
  }
  fillInputs();
  showSeries();
  showResult();
}

QString ThermalModelPage::outputUnit() const {
  return request().output.ends_with("_urad") ? QStringLiteral("urad") : QStringLiteral("um");
}

void ThermalModelPage::fillChoices() {
  filling_ = true;
  const IdentifyRequest now = request();
  output_->clear();
  for (const std::string& name : outputSignals(*series_)) output_->addItem(fromCore(name));
  output_->setCurrentText(fromCore(now.output));
  const auto method = std::find(methods.begin(), methods.end(), now.method);
  method_->setCurrentIndex(method == methods.end() ? 0 : static_cast<int>(method - methods.begin()));
  const std::array<double, 4> edges{now.train.from_s, now.train.to_s, now.test.from_s, now.test.to_s};
  for (std::size_t i = 0; i < 4; ++i) {
    edges_[i]->setRange(series_->time_s.front() / seconds_per_hour, series_->time_s.back() / seconds_per_hour);
    edges_[i]->setValue(edges[i] / seconds_per_hour);
  }
  filling_ = false;
}

void ThermalModelPage::fillInputs() {
  const IdentifyRequest now = request();
  const std::vector<std::string> automatic = automaticInputs(*series_, now.output);
  std::vector<Row> rows;
  for (const std::string& name : automatic) {
    Row row;
    row.id = fromCore(name);
    Cell cell = nameCell(row.id);
    cell.checked = now.inputs.empty() || std::find(now.inputs.begin(), now.inputs.end(), name) != now.inputs.end();
    row.cells = {cell, Cell{QStringLiteral("–")}, dashCell(), dashCell()};
    if (result_ != nullptr) {
      const auto verdict = std::find_if(result_->verdicts.begin(), result_->verdicts.end(),
                                        [&](const InputVerdict& v) { return v.name == name; });
      if (verdict != result_->verdicts.end()) {
        row.cells[1] = verdict->kept ? toneCell(tr("kept"), Tone::Good) : toneCell(tr("dropped"), Tone::Neutral);
        row.cells[1].tip = fromCore(verdict->reason);
        if (verdict->contribution_rms > 0) {
          row.cells[2] = numberCell(verdict->contribution_rms, 3);
          row.cells[3] = numberCell(verdict->error_without_percent, 0);
        }
      }
    }
    rows.push_back(std::move(row));
  }
  inputs_->setRows(std::move(rows));
}

void ThermalModelPage::showSeries() {
  if (series_ == nullptr) return;
  const IdentifyRequest now = request();
  std::vector<Series> series;
  const std::vector<double> time_h = hours(series_->time_s);
  const auto line = [&](const QString& name, const std::vector<double>& values, int colour) {
    Series s;
    s.name = name;
    s.x = time_h;
    s.y = values;
    s.style = SeriesStyle::Line;
    s.colour = colour;
    return s;
  };
  const bool fits = result_ != nullptr && result_->time_s.size() == time_h.size();
  if (what_->current() == 0) {
    series.push_back(line(tr("Measured"), series_->at(now.output).values, 0));
    if (fits) {
      Series predicted = line(tr("Predicted, ± 2 uncertainties"), result_->predicted, 1);
      predicted.sigma = result_->sigma;
      series.push_back(std::move(predicted));
    }
    series_plot_->setAxes(tr("Time / h"),
                          tr("%1 / %2").arg(fromCore(now.output).section(QLatin1Char('_'), 0, 0), outputUnit()));
  } else if (what_->current() == 1) {
    // Signals of different units in one picture: each over its own range.
    const std::vector<std::string> names = now.inputs.empty() ? automaticInputs(*series_, now.output) : now.inputs;
    for (std::size_t i = 0; i < names.size() && i < 6; ++i) {
      std::vector<double> values = series_->at(names[i]).values;
      double low = 1e300, high = -1e300;
      for (const double v : values) {
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
      }
      for (double& v : values) v = high > low ? (v - low) / (high - low) : 0.0;
      series.push_back(line(tr("%1 (%2 … %3)").arg(fromCore(names[i])).arg(low, 0, 'g', 3).arg(high, 0, 'g', 3), values,
                            static_cast<int>(i)));
    }
    series_plot_->setAxes(tr("Time / h"), tr("Part of its range"));
  } else {
    if (fits) {
      std::vector<double> residual(result_->measured.size());
      for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = result_->measured[i] - result_->predicted[i];
      series.push_back(line(tr("Measured minus predicted"), residual, 0));
    }
    series_plot_->setAxes(tr("Time / h"), tr("Left over / %1").arg(outputUnit()));
  }
  std::vector<Span> spans{
      {now.train.from_s / seconds_per_hour, now.train.to_s / seconds_per_hour, tr("Training"), Tone::Accent},
      {now.test.from_s / seconds_per_hour, now.test.to_s / seconds_per_hour, tr("Test"), Tone::Attention}};
  series_plot_->setContent(std::move(series), std::move(spans));
}

void ThermalModelPage::showResult() {
  if (result_ == nullptr) {
    for (RowsModel* rows : {comparison_, lags_, cross_}) rows->setRows({});
    for (Plot* plot : {step_plot_, residual_plot_}) plot->setContent({});
    step_input_->clear();
    whiteness_->set(Tone::Neutral, {});
    for (NumberTile* tile : {rms_, fit_, p2p_}) tile->set(QStringLiteral("–"));
    return;
  }
  const QString unit = outputUnit();
  rms_->set(QStringLiteral("%1 %2").arg(result_->test.rmse, 0, 'g', 3).arg(unit));
  fit_->set(QStringLiteral("%1 %").arg(result_->test.fit_percent, 0, 'f', 1));
  p2p_->set(QStringLiteral("%1 %2").arg(result_->test.p2p, 0, 'g', 3).arg(unit));
  std::vector<Row> rows;
  const auto add = [&](const QString& name, const RunQuality& train, const RunQuality& test, const QString& note) {
    Row row;
    row.id = name;
    row.cells = {nameCell(name), numberCell(train.rmse, 3), numberCell(test.rmse, 3), numberCell(test.fit_percent, 1),
                 numberCell(test.p2p, 2)};
    row.cells.front().tip = note;
    rows.push_back(std::move(row));
  };
  add(tr("This model"), result_->train, result_->test,
      tr("free run, %n input(s)", nullptr, static_cast<int>(result_->inputs.size())));
  for (const ModelComparison& m : result_->plain) {
    // The name without what it is made of: the whole stands in the tip.
    add(fromCore(m.name).section(QStringLiteral(" on "), 0, 0), m.train, m.test,
        fromCore(m.name) + QStringLiteral(": ") + fromCore(m.note));
  }
  comparison_->setRows(std::move(rows));
  const QString chosen = step_input_->currentText();
  step_input_->clear();
  for (const StepResponse& s : result_->step_responses) step_input_->addItem(fromCore(s.input));
  step_input_->setCurrentIndex(std::max(0, step_input_->findText(chosen)));
  showStep();
  showLags();
  showResiduals();
}

void ThermalModelPage::showStep() {
  if (result_ == nullptr) return;
  for (const StepResponse& s : result_->step_responses) {
    if (fromCore(s.input) != step_input_->currentText()) continue;
    Series line;
    line.style = SeriesStyle::Line;
    line.name = tr("Step of %1 by %2").arg(fromCore(s.input)).arg(s.step, 0, 'g', 4);
    line.x = hours(s.time_s);
    line.y = s.value;
    line.sigma = s.sigma;
    step_plot_->setAxes(tr("Time after a step of %1 by %2 / h").arg(fromCore(s.input)).arg(s.step, 0, 'g', 4),
                        tr("Response / %1").arg(outputUnit()));
    step_plot_->setContent({line});
    if (std::isfinite(s.time_to_63_percent_s)) {
      step_plot_->addMark(s.time_to_63_percent_s / seconds_per_hour,
                          tr("63 % after %1").arg(durationText(s.time_to_63_percent_s, 0)));
    }
    return;
  }
  step_plot_->setContent({});
}

void ThermalModelPage::showLags() {
  std::vector<Row> rows;
  const auto add = [&](const QString& input, const QString& tau, const Cell& gain, const QString& unit) {
    Row row;
    row.id = QString::number(rows.size());
    row.cells = {nameCell(input), Cell{tau}, gain, Cell{unit}};
    rows.push_back(std::move(row));
  };
  const nlohmann::json& structure = result_->structure;
  const nlohmann::json none = nlohmann::json::array();
  for (const auto& t : structure.value("time_constants", none))
    add(tr("pole"), durationText(numberAt(t, "value_s"), numberAt(t, "standard_uncertainty_s")), dashCell(), {});
  for (const auto& g : structure.value("static_gain", none))
    add(fromCore(g.value("input", std::string())), tr("static gain"),
        quantityCell(numberAt(g, "value"), numberAt(g, "standard_uncertainty")), tr("%1 per unit").arg(outputUnit()));
  if (rows.empty() && !result_->model.outputs.empty()) {
    const ThermalOutput& output = result_->model.outputs.front();
    std::vector<std::size_t> order(output.terms.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(output.terms[a].gain) > std::abs(output.terms[b].gain);
    });
    for (const std::size_t i : order) {
      const LagTerm& term = output.terms[i];
      const ThermalInput& input = result_->model.inputs[static_cast<std::size_t>(term.input)];
      const auto at = static_cast<Eigen::Index>(i + 1);
      const double sigma = output.covariance.rows() > at ? std::sqrt(output.covariance(at, at)) : std::nan("");
      QString name = fromCore(input.name);
      if (input.power != 1.0) name += QStringLiteral(" ^ %1").arg(input.power);
      add(name, term.tau_s > 0 ? durationText(term.tau_s, 0) : tr("at once"), quantityCell(term.gain, sigma),
          input.scale == 1.0 ? tr("%1 per unit").arg(outputUnit()) : tr("%1 at %2").arg(outputUnit()).arg(input.scale));
    }
  }
  lags_->setRows(std::move(rows));
}

void ThermalModelPage::showResiduals() {
  const ResidualDiagnosis& d = result_->residual;
  Series bars;
  bars.name = tr("Autocorrelation");
  bars.style = SeriesStyle::LinePoints;
  for (std::size_t k = 0; k < d.autocorrelation.size(); ++k) {
    bars.x.push_back(static_cast<double>(k) * d.period_s / 60.0);
    bars.y.push_back(d.autocorrelation[k]);
  }
  residual_plot_->setLeastRange(0.3);
  residual_plot_->setContent(bars.x.empty() ? std::vector<Series>{} : std::vector<Series>{bars});
  const QString p = d.whiteness_p_value < 0.001 ? tr("p < 0.001") : tr("p = %1").arg(d.whiteness_p_value, 0, 'g', 2);
  if (d.whiteness_p_value < 0.01) {
    whiteness_->show(Tone::Attention,
                     tr("The residual is not white (%1): something slow is left, a drift or a missing input. The "
                        "uncertainty of the prediction carries it.")
                         .arg(p));
  } else {
    whiteness_->show(Tone::Good, tr("The residual looks like white noise (%1).").arg(p));
  }
  std::vector<Row> rows;
  for (const ResidualDiagnosis::Cross& c : d.cross) {
    Row row;
    row.id = fromCore(c.input);
    const QString text = tr("%1 at %2 min").arg(c.largest, 0, 'f', 2).arg(c.lag_s / 60, 0, 'f', 0);
    row.cells = {nameCell(row.id), c.largest > c.limit ? toneCell(text, Tone::Attention) : toneCell(text, Tone::Good),
                 numberCell(c.limit, 2)};
    rows.push_back(std::move(row));
  }
  cross_->setRows(std::move(rows));
}

std::vector<Exportable> ThermalModelPage::exportables() {
  std::vector<Exportable> items;
  if (!series_plot_->empty()) items.push_back(exportableOf(tr("Model over time"), series_plot_));
  if (result_ == nullptr) return items;
  items.push_back(exportableOf(tr("Comparison of models"), comparison_));
  items.push_back(exportableOf(tr("Inputs"), inputs_));
  items.push_back(exportableOf(tr("Time constants"), lags_));
  if (!step_plot_->empty()) items.push_back(exportableOf(tr("Step response"), step_plot_));
  if (!residual_plot_->empty()) items.push_back(exportableOf(tr("Autocorrelation of the residual"), residual_plot_));
  const auto result = result_;
  items.push_back({tr("Thermal model"), {QStringLiteral("json")}, [result](const QString& file) {
                     result->model.write(file.toStdString());
                   }});
  items.push_back({tr("Prediction"), {QStringLiteral("csv")}, [result](const QString& file) {
                     result->writePrediction(file.toStdString());
                   }});
  return items;
}

}  // namespace spindrift::gui
