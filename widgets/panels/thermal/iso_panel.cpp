// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/thermal/iso_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/machine/sensor_role.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr std::size_t most_curves = 8;

/// The unit of a displacement or a rotation in its plot, and what a value of the log is multiplied by.
struct PlottedUnit {
  bool rotation = false;
  double factor = 1.0;
};

PlottedUnit plottedUnit(const std::string& column) {
  if (column.ends_with("_urad")) return {true, 1.0};
  if (column.ends_with("_mrad")) return {true, 1000.0};
  return {false, column.ends_with("_nm") ? 0.001 : 1.0};
}

}  // namespace

IsoPanel::IsoPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* line = new QHBoxLayout;
  test_ = new Segments({tr("Environment (ETVE)"), tr("Rotating spindle")}, tr("Test of ISO 230-3"));
  line->addWidget(test_);
  line->addWidget(new QLabel(tr("Ambient")));
  ambient_ = new QComboBox;
  ambient_->setAccessibleName(tr("Ambient temperature"));
  line->addWidget(ambient_, 1);
  line->addWidget(new QLabel(tr("Speed")));
  speed_ = new QComboBox;
  speed_->setAccessibleName(tr("Column of the spindle speed"));
  line->addWidget(speed_, 1);
  line->addWidget(new QLabel(tr("From:to / s")));
  range_ = new QLineEdit;
  range_->setAccessibleName(tr("Seconds of the record that are the test, from:to"));
  range_->setPlaceholderText(tr("whole record"));
  line->addWidget(range_, 1);
  column->addLayout(line);
  note_ = new Callout;
  column->addWidget(note_);
  rows_ = new RowsModel({tr("Component"), tr("Over the test"), tr("Per degree, or first hour"), tr("Slope, or time")},
                        this);
  auto* plots = new QWidget;
  auto* stack = new QVBoxLayout(plots);
  stack->setContentsMargins(0, 0, 0, 0);
  for (Plot*& plot : plots_) {
    plot = new Plot;
    plot->setEmptyText(tr("The test will appear here"), tr("It needs displacements over time."));
    stack->addWidget(plot);
  }
  plot(false)->setAxes(tr("Time / h"), tr("Displacement / µm"));
  plot(true)->setAxes(tr("Time / h"), tr("Rotation / µrad"));
  plot(true)->hide();
  column->addWidget(makeSplitter(this,
                                 makeTable(rows_, tr("Parameters of ISO 230-3"),
                                           tr("Range, change and time of each component appear here.")),
                                 plots, 5, 6, Qt::Vertical),
                    1);
  connect(test_, &Segments::chosen, this, [this](int) { choose(); });
  connect(ambient_, &QComboBox::activated, this, [this](int) { choose(); });
  connect(speed_, &QComboBox::activated, this, [this](int) { choose(); });
  connect(range_, &QLineEdit::editingFinished, this, [this] { choose(); });
}

void IsoPanel::set(std::shared_ptr<const TimeSeries> series, const Iso230Choice& choice) {
  if (series == series_ && choice == choice_) return;
  const bool another = series != series_;
  series_ = std::move(series);
  choice_ = choice;
  if (another) fillColumns();
  fillChoice();
  show(nullptr);
}

void IsoPanel::fillColumns() {
  ambient_->clear();
  ambient_->addItem(tr("none"), QString());
  speed_->clear();
  for (const Signal& s : series_ == nullptr ? std::vector<Signal>{} : series_->signals) {
    const QString name = fromCore(s.name);
    if (s.kind == SignalKind::Speed) speed_->addItem(name, name);
    if (s.kind == SignalKind::Temperature) ambient_->addItem(name, name);
  }
}

void IsoPanel::fillChoice() {
  range_->setText(QString::fromStdString(choice_.range));
  if (series_ == nullptr) return;
  const std::string test = choice_.test.empty() ? standardTestIn(*series_) : choice_.test;
  test_->setCurrent(test == "spindle" ? 1 : 0);
  QString room;
  for (const Signal& s : series_->signals)
    if (s.kind == SignalKind::Temperature && readSensorRole(s.name) == SensorRole::Room) room = fromCore(s.name);
  const QString ambient = choice_.ambient ? QString::fromStdString(*choice_.ambient) : room;
  ambient_->setCurrentIndex(std::max(0, ambient_->findData(ambient)));
  const QString speed = choice_.speed.empty() ? QStringLiteral("spindle_rpm") : QString::fromStdString(choice_.speed);
  speed_->setCurrentIndex(std::max(0, speed_->findData(speed)));
  shown_ = controls();
}

Iso230Choice IsoPanel::controls() const {
  Iso230Choice choice;
  choice.test = test_->current() == 0 ? "etve" : "spindle";
  choice.ambient = ambient_->currentData().toString().toStdString();
  choice.speed = speed_->currentData().toString().toStdString();
  choice.range = range_->text().trimmed().toStdString();
  return choice;
}

void IsoPanel::choose() {
  if (controls() == shown_) return;
  choice_ = shown_ = controls();
  show(nullptr);
  Q_EMIT chosen(choice_);
}

void IsoPanel::show(std::shared_ptr<const StandardTest> test) {
  if (test != nullptr && test == told_) return;
  told_ = std::move(test);
  note_->set(Tone::Neutral, {});
  rows_->setRows({});
  showCurves(false);
  ambient_->setEnabled(test_->current() == 0);
  speed_->setEnabled(test_->current() == 1 && speed_->count() > 1);
  if (series_ == nullptr || told_ == nullptr) return;
  if (!told_->why_not.empty()) {
    note_->show(Tone::Attention, coreSentence(told_->why_not));
    return;
  }
  if (told_->result.etve) showEtve(*told_->result.etve);
  if (told_->result.spindle) showSpindle(*told_->result.spindle);
  showCurves(true);
}

void IsoPanel::showCurves(bool any) {
  std::array<std::vector<Series>, 2> all;
  for (const Signal& s : any ? series_->signals : std::vector<Signal>{}) {
    const PlottedUnit unit = plottedUnit(s.name);
    std::vector<Series>& curves = all[unit.rotation ? 1 : 0];
    if (s.kind != SignalKind::Displacement || curves.size() >= most_curves) continue;
    Series curve;
    curve.name = fromCore(s.name);
    curve.colour = static_cast<int>(curves.size());
    curve.style = SeriesStyle::Line;
    double zero = std::nan("");
    for (std::size_t i = 0; i < s.values.size(); ++i) {
      if (!std::isfinite(s.values[i])) continue;
      if (std::isnan(zero)) zero = s.values[i];
      curve.x.push_back(series_->time_s[i] / 3600);
      curve.y.push_back(unit.factor * (s.values[i] - zero));
    }
    curves.push_back(std::move(curve));
  }
  plot(true)->setVisible(!all[1].empty());
  plot(false)->setVisible(!all[0].empty() || all[1].empty());
  for (std::size_t i = 0; i < 2; ++i) plots_[i]->setContent(std::move(all[i]));
}

void IsoPanel::showEtve(const EtveResult& result) {
  std::vector<Row> rows;
  for (const EtveComponent& c : result.components) {
    Row row;
    row.id = fromCore(c.name);
    const QString unit = unitText(c.unit);
    row.cells = {nameCell(row.id), Cell{tr("range %1").arg(quantityText(c.range, c.range_sigma, unit))},
                 Cell{std::isfinite(c.range_per_K)
                          ? quantityText(c.range_per_K, c.range_per_K_sigma, unit + QStringLiteral("/K"))
                          : QStringLiteral("–")},
                 Cell{std::isfinite(c.slope_per_K)
                          ? tr("slope %1").arg(quantityText(c.slope_per_K, c.slope_sigma, unit + QStringLiteral("/K")))
                          : QStringLiteral("–")}};
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
  note_->set(Tone::Neutral, tr("Over %1 h, ambient temperature within %2 K.")
                                .arg(decimalText(result.duration_s / 3600, 'f', 1))
                                .arg(decimalText(result.temperature_range_K, 'f', 2)));
}

void IsoPanel::showSpindle(const SpindleResult& result) {
  std::vector<Row> rows;
  for (const SpindleComponent& c : result.components) {
    Row row;
    row.id = fromCore(c.name);
    const QString unit = unitText(c.unit);
    row.cells = {
        nameCell(row.id), Cell{tr("at the end %1").arg(quantityText(c.at_end, c.change_sigma, unit))},
        Cell{std::isfinite(c.first_hour) ? tr("first hour %1").arg(quantityText(c.first_hour, c.first_hour_sigma, unit))
                                         : QStringLiteral("–")},
        Cell{std::isfinite(c.time_to_fraction_s) ? tr("%1 % after %2 min")
                                                       .arg(decimalText(100 * result.fraction, 'f', 0))
                                                       .arg(decimalText(c.time_to_fraction_s / 60, 'f', 0))
                                                 : QStringLiteral("–")}};
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
  note_->set(Tone::Neutral, tr("The spindle ran from %1 h to %2 h.")
                                .arg(decimalText(result.start_s / 3600, 'f', 2))
                                .arg(decimalText(result.stop_s / 3600, 'f', 2)));
}

}  // namespace spindrift::gui
