// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/parameter_card.h"

#include <QHeaderView>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>

#include "core/workflows/simulation_story.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/words.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr int width_for_words = 760;
constexpr int column_what = 1;
constexpr int column_bounds = 3;
constexpr int column_effects = 4;
constexpr int column_put_in = 5;

QString parameterNumber(double value) {
  return decimalText(value, 'g', 5);
}

/// Plain numbers have no unit.
QString unitOf(const SimulatorParameter& p) {
  return p.unit == "1" ? QString() : unitText(p.unit);
}

QString withUnit(double value, const SimulatorParameter& p) {
  const QString unit = unitOf(p);
  return unit.isEmpty() ? parameterNumber(value) : parameterNumber(value) + QLatin1Char(' ') + unit;
}

Cell tipped(const QString& words) {
  Cell cell{words};
  cell.tip = words;
  return cell;
}

Cell valueCell(const SimulatorParameter& p) {
  if (p.off()) {
    Cell cell{ParameterCard::tr("off")};
    cell.tip = ParameterCard::tr("A mechanism that the simulation does not have; it may well be %1.")
                   .arg(withUnit(p.standard_uncertainty, p));
    return cell;
  }
  return {p.standard_uncertainty > 0.0 ? withError(p.value, p.standard_uncertainty, unitOf(p)) : withUnit(p.value, p)};
}

}  // namespace

ParameterCard::ParameterCard(QWidget* parent) : Card(tr("Parameters"), parent) {
  rows_ = new RowsModel({}, this);
  table_ = makeTable(rows_, tr("Parameters of the simulator"),
                     tr("Choose simulator.json: the parameters of the simulation appear here."));
  body()->addWidget(table_, 1);
  showChoice({}, nullptr);
  stretchColumn(table_, column_what);
  connect(rows_, &RowsModel::checkedChanged, this, [this](const QString& id, int, bool checked) {
    const std::vector<std::string> before = ticked();
    ticks_.emplace(before.begin(), before.end());
    if (checked) {
      ticks_->insert(id.toStdString());
    } else {
      ticks_->erase(id.toStdString());
    }
    Q_EMIT ticksChanged();
  });
}

std::vector<std::string> ParameterCard::ticked() const {
  std::vector<std::string> out;
  for (const Row& row : rows_->rows()) {
    if (row.cells.size() > column_put_in && row.cells[column_put_in].checked.value_or(false))
      out.push_back(row.id.toStdString());
  }
  return out;
}

void ParameterCard::show(const OpenedSimulator& simulator, const SimulationStory* story,
                         const SimulationUpdate* update) {
  done_ = update != nullptr && !update->parameters.empty();
  const bool done = done_;
  if (done) {
    showUpdate(*update);
  } else {
    showChoice(simulator, story);
  }
  // Beside what was found there is no room for all columns.
  const bool narrow = story != nullptr && !done;
  for (const int column : {column_bounds, column_effects}) table_->setColumnHidden(column, narrow);
  table_->setColumnHidden(column_put_in, done);
  arrange();
}

void ParameterCard::resizeEvent(QResizeEvent* event) {
  Card::resizeEvent(event);
  arrange();
}

void ParameterCard::arrange() {
  // In a narrow card what a parameter is stands in the tip of its name.
  const bool hidden = done_ && width() < width_for_words;
  table_->setColumnHidden(column_what, hidden);
  // One column takes what the others leave, so that none is pushed out.
  table_->horizontalHeader()->setSectionResizeMode(0, hidden ? QHeaderView::Stretch : QHeaderView::ResizeToContents);
  // Words wrap by the width that the columns have now.
  table_->resizeRowsToContents();
}

void ParameterCard::showChoice(const OpenedSimulator& simulator, const SimulationStory* story) {
  rows_->setHeaders({tr("Parameter"), tr("What it is"), tr("Value"), tr("Bounds"), tr("Can cause"), tr("Put in")});
  std::vector<Row> rows;
  for (const SimulatorParameter& p : simulator.parameters) {
    Row row;
    row.id = coreSentence(p.name);
    const bool found = story != nullptr &&
                       std::find(story->mechanisms.begin(), story->mechanisms.end(), p.name) != story->mechanisms.end();
    Cell name = tipped(coreSentence(p.name));
    name.bold = found;
    const QString causes = p.effects.empty() ? QString() : effectTitles(p.effects, tr("or"));
    const QString bounds = tr("%1 to %2").arg(parameterNumber(p.min), withUnit(p.max, p));
    Cell what = tipped(coreSentence(p.what));
    if (story != nullptr) {
      if (!causes.isEmpty()) what.text += QLatin1Char('\n') + tr("Can cause: %1").arg(causes);
      what.tip = what.text + QLatin1Char('\n') + tr("Bounds: %1").arg(bounds);
    }
    Cell put;
    put.checked = ticks_ ? ticks_->contains(p.name) : found;
    put.tip = tr("Free %1 in the simulation when you press Put it into the simulation").arg(coreSentence(p.name));
    row.cells = {name, what, valueCell(p), Cell{bounds}, tipped(causes), put};
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
}

void ParameterCard::showUpdate(const SimulationUpdate& update) {
  rows_->setHeaders({tr("Parameter"), tr("What it is"), tr("Before"), tr("After"), QString(), QString()});
  std::vector<Row> rows;
  for (const FittedSimulatorParameter& p : update.parameters) {
    Row row;
    row.id = coreSentence(p.parameter.name);
    Cell name = tipped(coreSentence(p.parameter.name));
    name.bold = p.put_in;
    name.tip += QLatin1Char('\n') + coreSentence(p.parameter.what);
    // The unit stands once, below its number: some are long.
    const QString unit = unitOf(p.parameter);
    const QString below = unit.isEmpty() ? QString() : QLatin1Char('\n') + unit;
    Cell before{p.parameter.standard_uncertainty > 0.0 && !p.put_in
                    ? withError(p.parameter.value, p.parameter.standard_uncertainty, {})
                    : parameterNumber(p.parameter.value)};
    Cell after{p.no_influence ? QStringLiteral("–") : withError(p.value, p.standard_uncertainty, {}) + below};
    after.bold = p.put_in;
    Cell mark = p.no_influence                 ? Cell{tr("no influence")}
                : p.at_bound                   ? Cell{tr("at its bound"), Tone::Attention, "alert"}
                : p.put_in                     ? Cell{tr("put in"), Tone::Good, "check-circle"}
                : p.value == p.parameter.value ? Cell{tr("kept")}
                                               : Cell{tr("adjusted")};
    if (!p.put_in && !p.no_influence) mark.tip = tr("adjusted within its stated uncertainty");
    row.cells = {name, tipped(coreSentence(p.parameter.what)), before, after, mark};
    row.faded = p.no_influence;
    rows.push_back(std::move(row));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return (a.cells.front().bold && !a.faded) > (b.cells.front().bold && !b.faded);
  });
  rows_->setRows(std::move(rows));
}

}  // namespace spindrift::gui
