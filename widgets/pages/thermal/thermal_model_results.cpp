// SPDX-License-Identifier: GPL-3.0-or-later
// What was found: series, comparison, step responses, time constants, residuals.
#include <QComboBox>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/machine/driver_words.h"
#include "core/thermal/response_fit.h"
#include "core/workflows/campaign_series.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/thermal/thermal_model_page.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

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
  if (!(sigma_s > 0)) return QStringLiteral("%1 %2").arg(decimalText(seconds / unit.seconds, 'g', 3)).arg(unit.name);
  return quantityText(seconds / unit.seconds, sigma_s / unit.seconds, unit.name);
}

/// "F1_EZ_um" -> "F1 EZ".
QString outputTitle(const std::string& name) {
  QString text = fromCore(name);
  for (const char* ending : {"_um_per_m", "_um", "_urad", "_nm"})
    if (text.endsWith(QLatin1String(ending))) text.chop(static_cast<int>(qstrlen(ending)));
  return text.replace(QLatin1Char('_'), QLatin1Char(' '));
}

/// What one unit of the input does: "µm/K"; of one without a unit, such as a switch, the unit of the output.
QString gainUnitOf(const QString& output, const std::string& input) {
  QString unit = fromCore(signalTitle(input).unit);
  if (unit.isEmpty()) return output;
  if (unit == QStringLiteral("°C")) unit = QStringLiteral("K");
  const qsizetype line = output.indexOf(QLatin1Char('/'));
  if (line >= 0) return QStringLiteral("%1/(%2·%3)").arg(output.left(line), output.mid(line + 1), unit);
  return output + QLatin1Char('/') + (unit.contains(QLatin1Char('/')) ? QStringLiteral("(%1)").arg(unit) : unit);
}

double numberAt(const nlohmann::json& json, const char* key) {
  const nlohmann::json value = json.value(key, nlohmann::json());
  return value.is_number() ? value.get<double>() : std::nan("");
}

}  // namespace

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
        row.cells[1].tip = coreSentence(verdict->reason);
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
  // Rare measurements are points: only where there is a value.
  const bool sparse = isSparse(series_->at(now.output));
  const auto measured = [&](const QString& name, const std::vector<double>& values) {
    Series s = line(name, values, 0);
    if (!sparse) return s;
    s.style = SeriesStyle::Points;
    s.x.clear();
    s.y.clear();
    const auto sigma = sigma_.find(now.output);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!std::isfinite(values[i])) continue;
      s.x.push_back(time_h[i]);
      s.y.push_back(values[i]);
      if (sigma != sigma_.end()) s.sigma.push_back(sigma->second);
    }
    return s;
  };
  if (what_->current() == 0) {
    series.push_back(measured(tr("Measured"), series_->at(now.output).values));
    if (fits) {
      Series predicted = line(tr("Predicted, ± 2 uncertainties"), result_->predicted, 1);
      predicted.sigma = result_->sigma;
      series.push_back(std::move(predicted));
    }
    series_plot_->setAxes(tr("Time / h"), tr("%1 / %2").arg(outputTitle(now.output), outputUnit()));
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
      series.push_back(
          line(tr("%1 (%2 … %3)").arg(fromCore(names[i])).arg(decimalText(low, 'g', 3)).arg(decimalText(high, 'g', 3)),
               values, static_cast<int>(i)));
    }
    series_plot_->setAxes(tr("Time / h"), tr("Part of its range"));
  } else {
    if (fits) series.push_back(measured(tr("Measured minus predicted"), result_->left));
    series_plot_->setAxes(tr("Time / h"), tr("Residual / %1").arg(outputUnit()));
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
  rms_->set(QStringLiteral("%1 %2").arg(decimalText(result_->test.rmse, 'g', 3)).arg(unit));
  fit_->set(QStringLiteral("%1 %").arg(decimalText(result_->test.fit_percent, 'f', 1)));
  p2p_->set(QStringLiteral("%1 %2").arg(decimalText(result_->test.p2p, 'g', 3)).arg(unit));
  std::vector<Row> rows;
  const auto add = [&](const QString& name, const RunQuality& train, const RunQuality& test, const QString& note) {
    Row row;
    row.id = name;
    row.cells = {nameCell(name), numberCell(train.rmse, 3), numberCell(test.rmse, 3), numberCell(test.fit_percent, 1),
                 numberCell(test.p2p, 2)};
    row.cells.front().tip = note;
    rows.push_back(std::move(row));
  };
  add(tr("This model"), result_->train, result_->test, tr("free run, inputs: %1").arg(result_->inputs.size()));
  for (const ModelComparison& m : result_->plain) {
    // The name without what it is made of: the whole stands in the tip.
    add(coreSentence(fromCore(m.name).section(QStringLiteral(" on "), 0, 0)), m.train, m.test,
        coreSentence(m.name) + QStringLiteral(": ") + coreSentence(m.note));
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
    line.name = tr("Step of %1 by %2, 95 % interval").arg(fromCore(s.input)).arg(decimalText(s.step, 'g', 4));
    line.x = hours(s.time_s);
    line.y = s.value;
    line.sigma = s.sigma;
    line.sigma_factor = s.coverage_factor;
    step_plot_->setAxes(tr("Time after a step of %1 by %2 / h").arg(fromCore(s.input)).arg(decimalText(s.step, 'g', 4)),
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
  const nlohmann::json& structure = result_->structure;
  // Where the residual of the ARX equation is not white its uncertainties are no intervals: marked.
  const bool holds = structure.value("uncertainty_holds", true);
  const auto add = [&](const QString& input, double tau_s, double sigma_s, Cell gain, const QString& unit) {
    Row row;
    gain.unit = unit;
    row.id = QString::number(rows.size());
    Cell tau{tau_s > 0 ? durationText(tau_s, sigma_s) : tau_s == 0.0 ? tr("at once") : tr("static gain")};
    if (!holds) {
      tau = toneCell(tau.text, Tone::Attention);
      tau.tip =
          tr("The residual of the ARX equation is not white: this value is biased and its interval does not hold.");
    }
    const Cell pole =
        tau_s > 0 ? quantityCell(-seconds_per_hour / tau_s, sigma_s * seconds_per_hour / (tau_s * tau_s)) : dashCell();
    Cell unit_cell{unit};
    unit_cell.unit = unit;
    row.cells = {nameCell(input), tau, pole, gain, unit_cell};
    rows.push_back(std::move(row));
  };
  const nlohmann::json none = nlohmann::json::array();
  for (const auto& t : structure.value("time_constants", none))
    add(tr("pole"), numberAt(t, "value_s"), numberAt(t, "standard_uncertainty_s"), dashCell(), {});
  for (const auto& l : structure.value("lags", none)) {
    const std::string input = l.value("input", std::string());
    add(fromCore(input), numberAt(l, "tau_s"), numberAt(l, "tau_standard_uncertainty_s"),
        quantityCell(numberAt(l, "gain"), numberAt(l, "gain_standard_uncertainty")), gainUnitOf(outputUnit(), input));
  }
  for (const auto& g : structure.value("static_gain", none)) {
    const std::string input = g.value("input", std::string());
    add(fromCore(input), -1.0, std::nan(""), quantityCell(numberAt(g, "value"), numberAt(g, "standard_uncertainty")),
        gainUnitOf(outputUnit(), input));
  }
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
      // The gain is what the input does at its scale.
      const bool per_unit = input.scale == 1.0 && input.power == 1.0;
      if (!per_unit) name = tr("%1 at %2").arg(name, decimalText(input.scale, 'g', 4));
      add(name, term.tau_s, 0.0, quantityCell(term.gain, sigma),
          per_unit ? gainUnitOf(outputUnit(), input.name) : outputUnit());
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
  const QString p =
      d.whiteness_p_value < 0.001 ? tr("p < 0.001") : tr("p = %1").arg(decimalText(d.whiteness_p_value, 'g', 2));
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
    const QString text = tr("%1 at %2 min").arg(decimalText(c.largest, 'f', 2)).arg(decimalText(c.lag_s / 60, 'f', 0));
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
